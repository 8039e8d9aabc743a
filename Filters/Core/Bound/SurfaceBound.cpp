// SPDX-License-Identifier: BSD-3-Clause
// First the cap of each facet by itself, then the wedges between neighbouring sides of one region.
// Whatever rounding leaves in doubt is left out: it must not lower the bound.
#include "Bound/SurfaceBound.h"

#include "Bound/ApexBound.h"
#include "Mesh/SimplexGeometry.h"
#include "Quality/Shape.h"

#include <algorithm>
#include <cmath>

namespace meshopt
{
namespace
{
/// The error of an angle between facets that are no needles, in rounding errors. Rounded up: about
/// ten operations lead to it, and a smaller one would not be certain.
constexpr double AngleRoundings = 16.0;
/// An angle with a greater error, in radians, is not known. It could not certify much.
constexpr double MostAngleError = 1e-3;
/// A cap of an edge is lower than those of its facets only by at least this part: equal ones differ
/// by rounding. With less, many edges would be listed that forbid nothing of their own.
constexpr double ClearlyLower = 1e-9;
/// Added to the quality of the tetrahedron that two facets span: the volume of a flat one differs
/// by some 1e-14, depending on the corner that it is seen from.
constexpr double SpannedError = 1e-13;
/// How well the cap of an edge and the angles of its facets are known: where it sets the bound, and
/// where it is only looked up. The first are seen in the bound; finer ones cost time, and nobody
/// sees a difference. The others are much cheaper and are needed for most edges.
constexpr double ExactCap = 1e-7, ExactAngle = 1e-9, RoughCap = 5e-3, RoughAngle = 1e-3;
/// A rough cap is too high, by RoughCap and by what RoughAngle does. Where this part of it is under
/// the bound, an exact one may be, too: with a larger part the edge that sets the bound could be
/// missed.
constexpr double NearBound = 0.9;

/// Edge (3D) or node (2D) k of a side. Sorted, those that coincide become neighbours.
struct Rim
{
  Index low, high; ///< nodes; in 2D both are the node
  Index region;
  Index side;
  std::int8_t k; ///< local number: the edge from node k to node k + 1; in 2D node k
  bool forward;  ///< from low to high; in 2D: the side begins here
  bool operator<(const Rim& other) const
  {
    // The side comes last: it only makes the order unique.
    return this->low != other.low    ? this->low < other.low
      : this->high != other.high     ? this->high < other.high
      : this->region != other.region ? this->region < other.region
                                     : this->side < other.side;
  }
  bool sameWedge(const Rim& other) const
  {
    return this->low == other.low && this->high == other.high && this->region == other.region;
  }
};

std::vector<Rim> collectRims(const std::vector<KeptSide<3>>& sides)
{
  std::vector<Rim> rims;
  rims.reserve(3 * sides.size());
  for (std::size_t s = 0; s < sides.size(); ++s)
  {
    for (std::int8_t k = 0; k < 3; ++k)
    {
      const Index a = sides[s].nodes[k], b = sides[s].nodes[(k + 1) % 3];
      rims.push_back(
        { std::min(a, b), std::max(a, b), sides[s].region, static_cast<Index>(s), k, a < b });
    }
  }
  std::sort(rims.begin(), rims.end());
  return rims;
}

/// In 2D a side begins at its first node and ends at its second one.
std::vector<Rim> collectRims(const std::vector<KeptSide<2>>& sides)
{
  std::vector<Rim> rims;
  rims.reserve(2 * sides.size());
  for (std::size_t s = 0; s < sides.size(); ++s)
  {
    for (std::int8_t k = 0; k < 2; ++k)
    {
      const Index a = sides[s].nodes[k];
      rims.push_back({ a, a, sides[s].region, static_cast<Index>(s), k, k == 0 });
    }
  }
  std::sort(rims.begin(), rims.end());
  return rims;
}

/// An angle in ]0, 2 pi[, with a bound on its error (also across 0).
struct Angle
{
  double value = 0.0, error = 0.0;

  Angle() = default;
  /// `blur`: relative errors of y and x, in units of the rounding error.
  Angle(double y, double x, double blur)
    : value(std::atan2(y, x))
    , error(AngleRoundings * std::numeric_limits<double>::epsilon() * blur)
  {
    // 0 becomes a full turn. Both are as uncertain: see known().
    this->value += this->value > 0.0 ? 0.0 : 2.0 * Pi;
  }
  /// False if it may be 0 as well as 2 pi, or if nothing is known.
  bool known() const
  {
    return this->error<MostAngleError&& this->value> this->error &&
      this->value < 2.0 * Pi - this->error;
  }
  bool isBelow(const Angle& other) const
  {
    return this->value + this->error < other.value - other.error;
  }
};

/// The part that both dimensions share: caps of facets, then wedges between neighbouring sides of
/// one region.
template <int D>
class BoundBuilder
{
public:
  BoundBuilder(const Vec<D>* points, const SurfaceBoundOptions& options, SurfaceBound<D>& result)
    : points_(points)
    , options_(options)
    , enough_(std::max(options.enough, options.listEdgesBelow))
    , result_(result)
  {
  }

  /// Starts with what no cell can exceed, and lowers that.
  void run()
  {
    const double regular = regularValue<D>(this->options_.measure);
    this->result_.bound = regular;
    this->result_.sideCaps.assign(this->result_.sides.size(), regular);
    // Wedges come later: they need the best apexes of their facets.
    this->capSides();
    if (infoOf(this->options_.measure).bound == FacetBound::BestApex)
    {
      this->capWedges();
    }
  }

private:
  void capSides();
  void capWedges();
  void capWedge(const Rim& from, const Rim& to, const Angle& theta);
  Angle angle(const Rim& from, const Rim& to) const;
  double wedgeCap(const Rim& from, const Rim& to, const Angle& theta, double below) const;
  double capOfSide(std::size_t s, double enough);

  /// The node of a side that is not on the rim.
  Index tip(const Rim& rim) const
  {
    return this->result_.sides[rim.side].nodes[D == 3 ? (rim.k + 2) % 3 : 1 - rim.k];
  }

  /// A wedge begins at one rim, and ends at the first other rim when turning into it.
  struct Wedge
  {
    const Rim* from;
    const Rim* to;
    Angle theta;
  };
  bool findWedge(const Rim& from, const Rim* begin, const Rim* end, Wedge& wedge) const;
  bool findWedges(const Rim* begin, const Rim* end, std::vector<Wedge>& wedges) const;

  const Vec<D>* points_;
  const SurfaceBoundOptions options_;
  double enough_;
  SurfaceBound<D>& result_;
  std::vector<Vec<D>> apexes_; ///< D = 3
};

template <>
double BoundBuilder<2>::capOfSide(std::size_t, double)
{
  return 1.0; // every edge has an equilateral triangle
}

template <>
double BoundBuilder<3>::capOfSide(std::size_t s, double enough)
{
  const Facet<3>& f = this->result_.sides[s].nodes;
  const Vec<3>&a = this->points_[f[0]], &b = this->points_[f[1]], &c = this->points_[f[2]];
  const FacetBound bound = infoOf(this->options_.measure).bound;
  switch (bound)
  {
    case FacetBound::BestApex:
      return facetCap(a, b, c, enough, &this->apexes_[s]);
    case FacetBound::MeanRatio:
    case FacetBound::MeanRatioToTwoThirds:
    {
      // The best apex is above the centroid. It gives the mean ratio 4 sqrt(3) A / sum l^2 of the
      // facet itself.
      const double squares = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
      const double area = 0.5 * (b - a).cross(c - a).norm();
      const double cap = squares == 0.0 ? 0.0 : std::min(1.0, 6.928203230275509 * area / squares);
      // Too large for its squares. A cap of 1 is always true.
      if (!std::isfinite(squares))
      {
        return 1.0;
      }
      return bound == FacetBound::MeanRatio ? cap : std::cbrt(cap * cap);
    }
    case FacetBound::None:
      break;
  }
  return regularValue<3>(this->options_.measure);
}

template <int D>
void BoundBuilder<D>::capSides()
{
  if (D == 3)
  {
    this->apexes_.resize(this->result_.sides.size());
  }
  double bound = this->result_.bound;
  for (std::size_t s = 0; s < this->result_.sides.size(); ++s)
  {
    // Only caps that can lower the bound or are listed must be exact.
    const double cap = this->capOfSide(s, std::max(bound, this->enough_));
    this->result_.sideCaps[s] = cap;
    bound = std::min(bound, cap);
  }
  this->result_.bound = bound;
}

/// Finds the end of the wedge that begins at `from`: the first side that is met when turning into
/// it. False if rounding leaves open which one that is.
template <int D>
bool BoundBuilder<D>::findWedge(
  const Rim& from, const Rim* begin, const Rim* end, Wedge& wedge) const
{
  wedge = { &from, nullptr, {} };
  // A facet's own back side is behind all others, at exactly 2 pi: computing it could only blur
  // that.
  Angle back;
  back.value = 2.0 * Pi;
  for (const Rim* rim = begin; rim != end; ++rim)
  {
    if (rim->forward)
    {
      continue;
    }
    const bool own = this->tip(*rim) == this->tip(from);
    const Angle t = own ? back : this->angle(from, *rim);
    // An angle that may be 0 as well as 2 pi leaves the order open.
    if (!own && !t.known())
    {
      return false;
    }
    if (!wedge.to || t.value < wedge.theta.value)
    {
      wedge.to = rim;
      wedge.theta = t;
    }
  }
  // Nothing may be as near as the end, except the front of that facet.
  for (const Rim* rim = begin; wedge.to && rim != end; ++rim)
  {
    if (rim == &from || rim == wedge.to)
    {
      continue;
    }
    const Index tip = this->tip(*rim);
    if (tip == this->tip(rim->forward ? from : *wedge.to))
    {
      return false; // one side twice
    }
    if (tip != this->tip(rim->forward ? *wedge.to : from))
    {
      const Angle t = this->angle(from, *rim);
      if (!t.known() || !wedge.theta.isBelow(t))
      {
        return false;
      }
    }
  }
  return wedge.to != nullptr;
}

/// False if the sides at the edge do not bound wedges one after another in an order beyond doubt:
/// facets folded onto each other, wedges that overlap, or missing sides.
template <int D>
bool BoundBuilder<D>::findWedges(const Rim* begin, const Rim* end, std::vector<Wedge>& wedges) const
{
  wedges.clear();
  for (const Rim* rim = begin; rim != end; ++rim)
  {
    if (!this->result_.sides[rim->side].oriented)
    {
      return false;
    }
    if (rim->forward)
    {
      wedges.emplace_back();
      if (!this->findWedge(*rim, begin, end, wedges.back()))
      {
        return false;
      }
    }
  }
  // As many ends as beginnings: then they alternate.
  return 2 * static_cast<std::ptrdiff_t>(wedges.size()) == end - begin;
}

/// Rims of one edge and one region stand together. They bound the wedges there by turns.
template <int D>
void BoundBuilder<D>::capWedges()
{
  const std::vector<Rim> rims = collectRims(this->result_.sides);
  std::vector<Wedge> wedges;
  for (std::size_t i = 0, j = 0; i < rims.size(); i = j)
  {
    for (j = i + 1; j < rims.size() && rims[i].sameWedge(rims[j]);)
    {
      ++j;
    }
    if (this->findWedges(rims.data() + i, rims.data() + j, wedges))
    {
      for (const Wedge& wedge : wedges)
      {
        this->capWedge(*wedge.from, *wedge.to, wedge.theta);
      }
    }
  }
}

template <int D>
void BoundBuilder<D>::capWedge(const Rim& from, const Rim& to, const Angle& theta)
{
  // Only an edge that forbids more than its own facets do needs an entry.
  const double list = this->options_.listEdgesBelow;
  const double facets = std::min(
    this->result_.sideCaps[from.side], this->result_.sideCaps[to.side]);
  const double below = std::min(facets, std::max(this->result_.bound, list));
  const double cap = this->wedgeCap(from, to, theta, below * (1.0 - ClearlyLower));
  if (cap < below * (1.0 - ClearlyLower))
  {
    if (cap < list)
    {
      this->result_.edges.push_back({ from.low, D == 2 ? None : from.high, cap });
    }
    this->result_.bound = std::min(this->result_.bound, cap);
  }
}

template <>
Angle BoundBuilder<2>::angle(const Rim& from, const Rim& to) const
{
  const Vec<2>& x = this->points_[from.low];
  const Vec<2> u = this->points_[this->tip(from)] - x;
  const Vec<2> v = this->points_[this->tip(to)] - x;
  return Angle(u[0] * v[1] - u[1] * v[0], u.dot(v), 1.0);
}

template <>
Angle BoundBuilder<3>::angle(const Rim& from, const Rim& to) const
{
  const Vec<3>& a = this->points_[from.low];
  const Vec<3> t = this->points_[from.high] - a;
  const Vec<3> u = this->points_[this->tip(from)] - a;
  const Vec<3> v = this->points_[this->tip(to)] - a;
  // Normals of both half planes, turned the same way. Cosine and sine are proportional to m . n and
  // (m x n) . t / |t| = |t| u . (v x t).
  const Vec<3> m = t.cross(u), n = t.cross(v);
  // The normal of a needle along the edge is known badly.
  const double l = t.norm();
  const double blur = 1.0 + l * u.norm() / m.norm() + l * v.norm() / n.norm();
  return Angle(l * u.dot(v.cross(t)), m.dot(n), blur);
}

template <>
double BoundBuilder<2>::wedgeCap(
  const Rim& from, const Rim& to, const Angle& angle, double below) const
{
  const Vec<2>& x = this->points_[from.low];
  const Vec<2>& b = this->points_[this->result_.sides[from.side].nodes[1]];
  const Vec<2>& c = this->points_[this->result_.sides[to.side].nodes[0]];
  const double theta = angle.value;
  double cap = theta < Pi ? MeanEdgeShape<2>::value({ x, b, c }) : 0.0;
  const int last = 2 + static_cast<int>(theta); // angles under 60 degrees only get worse
  for (int k = 2; k <= last && cap < below; ++k)
  {
    if (theta / k < Pi)
    {
      cap = std::max(cap, angleCap2(theta / k));
    }
  }
  return cap + angle.error; // the error of theta changes the cap by less than this
}

template <>
double BoundBuilder<3>::wedgeCap(
  const Rim& from, const Rim& to, const Angle& angle, double below) const
{
  const double theta = angle.value, slack = angle.error;
  const Vec<3>&a = this->points_[from.low], &b = this->points_[from.high];
  const Vec<3>&c = this->points_[this->tip(from)], &d = this->points_[this->tip(to)];
  const double spanned = theta < Pi + slack ? MeanEdgeShape<3>::value({ a, b, c, d }) + SpannedError
                                            : 0.0;
  const FacetWedge wedge{ theta, { a, b, c, this->apexes_[from.side] },
    { a, b, d, this->apexes_[to.side] }, spanned, slack };
  // Exact only for edges that set the bound: all others are for look-up.
  const bool exact = below <= this->result_.bound;
  const double width = exact ? ExactAngle : RoughAngle * std::min(1.0, theta);
  const double cap = edgeCap(below, wedge, exact ? ExactCap : RoughCap, width);
  // A coarse cap near the bound could hide that this edge sets it.
  return !exact && NearBound * cap < this->result_.bound
    ? std::min(cap, edgeCap(this->result_.bound, wedge, ExactCap))
    : cap;
}
}

template <int D>
SurfaceBound<D> surfaceBound(
  const Vec<D>* points, std::vector<KeptSide<D>> sides, const SurfaceBoundOptions& options)
{
  SurfaceBound<D> result;
  result.sides = std::move(sides);
  BoundBuilder<D>(points, options, result).run();
  return result;
}

template <int D>
KeptSurface<D>::KeptSurface(const SimplexMesh<D>& mesh)
  : points(mesh.numberOfPointSlots())
{
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    this->points[p] = mesh.point(p);
  }
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; mesh.isAlive(c) && i <= D; ++i)
    {
      if (mesh.isKept(c, i))
      {
        this->sides.push_back({ mesh.facet(c, i), c, mesh.region(c), true, mesh.quality(c) });
      }
    }
  }
}

template <int D>
SurfaceBound<D> surfaceBound(const SimplexMesh<D>& mesh, const SurfaceBoundOptions& options)
{
  KeptSurface<D> surface(mesh);
  return surfaceBound<D>(surface.points.data(), std::move(surface.sides), options);
}

template struct SurfaceBound<2>;
template struct SurfaceBound<3>;
template struct KeptSurface<2>;
template struct KeptSurface<3>;
template SurfaceBound<2> surfaceBound(
  const Vec<2>*, std::vector<KeptSide<2>>, const SurfaceBoundOptions&);
template SurfaceBound<3> surfaceBound(
  const Vec<3>*, std::vector<KeptSide<3>>, const SurfaceBoundOptions&);
template SurfaceBound<2> surfaceBound(const SimplexMesh<2>&, const SurfaceBoundOptions&);
template SurfaceBound<3> surfaceBound(const SimplexMesh<3>&, const SurfaceBoundOptions&);
}
