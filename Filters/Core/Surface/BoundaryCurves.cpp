// SPDX-License-Identifier: BSD-3-Clause
// The curves of a plane boundary. Either they are made from the boundary itself, or each chain of
// it is put on the nearest curve of a given geometry.
#include "Surface/BoundaryCurves.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace meshopt
{
namespace
{
constexpr double Tolerance = 1e-3; ///< of the diagonal of the mesh
/// How far the curve may be from a new edge of the boundary, as a fraction of the edge's length.
constexpr double Sagitta = 0.1;

double diagonal(const SimplexMesh<2>& mesh)
{
  Vec<2> low = Vec<2>::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    if (mesh.isPointAlive(p))
    {
      low = low.cwiseMin(mesh.point(p));
      high = high.cwiseMax(mesh.point(p));
    }
  }
  return (high - low).norm();
}

/// See PlaneCurve::mostCurvedSegment(): the share of a circle whose polygon turns by `angle`
/// (degrees) at each point, with a margin.
double greatestShare(double angle)
{
  constexpr double margin = 1.2;
  // Of an arc whose chord belongs to an angle a, the height is tan(a / 4) / 2 of the chord.
  return margin * 0.5 * std::tan(angle / 4.0 * std::acos(-1.0) / 180.0);
}

std::string nameOf(const char* what, Index p, const Vec<2>& x)
{
  std::ostringstream text;
  text << what << ' ' << p << " (" << x[0] << ", " << x[1] << ")";
  return text.str();
}
}

PlaneCurve BoundaryCurves::curve(
  const LineNetwork& network, const LineChain& chain, bool splines) const
{
  std::vector<Vec<2>> points;
  for (Index p : chain.points)
  {
    points.push_back(network.points[p]);
  }
  return PlaneCurve(std::move(points), chain.isClosed, splines);
}

/// Makes the ends of segments corners where a spline overshoots. A spline through the short sides
/// of an arc and a long straight side would swing far out on the long one; with corners at its ends
/// that side stays straight.
void BoundaryCurves::markWhereSplinesOvershoot(
  LineNetwork& network, const CurveOptions& options) const
{
  // It ends: each round makes points corners, and a chain of one segment is no spline.
  for (bool again = true; again;)
  {
    again = false;
    for (const LineChain& chain : chains(network))
    {
      const PlaneCurve curve = this->curve(network, chain, true);
      double share = 0.0;
      const std::size_t k = curve.mostCurvedSegment(share);
      if (share > greatestShare(options.cornerAngle))
      {
        for (std::size_t end : { k, (k + 1) % chain.points.size() })
        {
          network.corners[chain.points[end]] = 1;
        }
        // New corners divide the chain, which gives new splines: test these, too.
        again = true;
      }
    }
  }
}

/// First the corners that the geometry has by its angles, then those that only splines need: a
/// spline depends on where its chain ends.
void BoundaryCurves::build(
  MeshEditor<2>& editor, const CurveOptions& options, const std::vector<std::uint8_t>& corners)
{
  this->curves_.clear();
  this->pieces_.clear();
  LineNetwork boundary = keptLines(editor.mesh());
  for (std::size_t p = 0; p < corners.size(); ++p)
  {
    // The caller's corners first: they divide chains before any angle is measured.
    boundary.corners[p] |= corners[p];
  }
  markCorners(boundary, options.cornerAngle);
  if (options.splines)
  {
    markKinks(boundary);
    this->markWhereSplinesOvershoot(boundary, options);
  }
  for (const LineChain& chain : chains(boundary))
  {
    const PlaneCurve curve = this->curve(boundary, chain, options.splines);
    std::vector<double> parameters; // of a line that ends in a corner: also that of its end
    for (std::size_t k = 0; k < chain.points.size(); ++k)
    {
      parameters.push_back(curve.parameter(k));
    }
    this->curves_.push_back(curve);
    this->addPiece(editor, chain, static_cast<Index>(this->curves_.size()) - 1, parameters);
  }
  this->pieces_.join();
}

/// Every corner of the geometry must be a point of the boundary; that point then becomes a corner.
std::string BoundaryCurves::matchCorners(const SimplexMesh<2>& mesh, const LineNetwork& geometry,
  double tolerance, LineNetwork& boundary) const
{
  std::vector<Index> ends;
  for (const std::array<Index, 2>& l : boundary.lines)
  {
    ends.insert(ends.end(), l.begin(), l.end());
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  for (std::size_t g = 0; g < geometry.points.size(); ++g)
  {
    bool found = !geometry.corners[g];
    for (std::size_t k = 0; k < ends.size() && !found; ++k)
    {
      found = (mesh.point(ends[k]) - geometry.points[g]).norm() <= tolerance;
    }
    if (!found)
    {
      return "The geometry has a corner at its " +
        nameOf("point", static_cast<Index>(g), geometry.points[g]) +
        ", but the boundary of the mesh has no point there.";
    }
    for (Index p : ends) // all such points: at the mouth of a crack there are several
    {
      boundary.corners[p] |= std::uint8_t(
        geometry.corners[g] && (mesh.point(p) - geometry.points[g]).norm() <= tolerance);
    }
  }
  return {};
}

namespace
{
/// A curve from a corner around to itself has two parameters at that corner. The middle of the edge
/// that leaves the corner tells which one is meant at each end of the chain.
void tellEndsApart(const SimplexMesh<2>& mesh, const std::vector<Index>& points,
  const PlaneCurve& curve, double tolerance, std::vector<double>& s)
{
  if ((curve.at(0.0) - curve.at(curve.length())).norm() > tolerance)
  {
    return;
  }
  const std::size_t last = points.size() - 1;
  for (const auto& [end, next] :
    { std::pair<std::size_t, std::size_t>{ 0, 1 }, { last, last - 1 } })
  {
    const Vec<2>&x = mesh.point(points[end]), &y = mesh.point(points[next]);
    if ((x - curve.at(0.0)).norm() <= tolerance)
    {
      double d = 0.0;
      s[end] = curve.closest(Vec<2>(0.5 * (x + y)), d) < s[next] ? 0.0 : curve.length();
    }
  }
}
}

/// Adds the chain as a piece of the curve and gives its points their places.
void BoundaryCurves::addPiece(
  MeshEditor<2>& editor, const LineChain& chain, Index curve, const std::vector<double>& parameters)
{
  CurvePiece piece;
  piece.curve = curve;
  if (!chain.isClosed)
  {
    piece.ends = { chain.points.front(), chain.points.back() };
    piece.range = { parameters.front(), parameters.back() };
    piece.isEdge = chain.points.size() == 2;
  }
  else
  {
    const PlaneCurve& along = this->curves_[curve];
    piece.period = along.isClosed() ? along.length() : 0.0;
  }
  const std::size_t first = chain.isClosed ? 0 : 1;
  for (std::size_t k = first; k + first < chain.points.size(); ++k)
  {
    editor.setPlace(
      chain.points[k], { Freedom::Curve, static_cast<Index>(this->pieces_.size()), parameters[k] });
  }
  this->pieces_.add(piece);
}

/// The curve that is nearest to a chain of the mesh's boundary. `farthest` is the point of the
/// chain with the greatest distance to it, `distance` that distance. None if there are no curves.
Index BoundaryCurves::nearestCurve(const SimplexMesh<2>& mesh, const LineChain& chain,
  double tolerance, Index& farthest, double& distance) const
{
  Index nearest = None;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t g = 0; g < this->curves_.size(); ++g)
  {
    double worst = -1.0;
    Index at = None;
    for (Index p : chain.points)
    {
      double d = 0.0;
      this->curves_[g].closest(mesh.point(p), d);
      at = d > worst ? p : at;
      worst = std::max(worst, d);
      // Too far away already to be the nearest one.
      if (worst > best)
      {
        break;
      }
    }
    // Several curves may join the same two corners: the middle of the first edge tells them apart.
    double middle = 0.0;
    this->curves_[g].closest(
      Vec<2>(0.5 * (mesh.point(chain.points[0]) + mesh.point(chain.points[1]))), middle);
    // The middle counts little: it only decides between curves that are equally near.
    const double rank = std::max(worst, tolerance) + 1e-3 * middle;
    if (rank < best)
    {
      best = rank;
      nearest = static_cast<Index>(g);
      farthest = at;
      distance = worst;
    }
  }
  return nearest;
}

/// Puts a chain of the mesh's boundary on the curve nearest to it.
std::string BoundaryCurves::place(MeshEditor<2>& editor, const LineChain& chain, double tolerance)
{
  const SimplexMesh<2>& mesh = editor.mesh();
  Index farthest = chain.points[0];
  double distance = std::numeric_limits<double>::infinity();
  const Index nearest = this->nearestCurve(mesh, chain, tolerance, farthest, distance);
  if (distance > tolerance)
  {
    std::ostringstream text;
    text << "The boundary of the mesh does not lie on the geometry: "
         << nameOf("point", farthest, mesh.point(farthest)) << " is " << distance
         << " away from it.";
    return text.str();
  }
  const PlaneCurve& curve = this->curves_[nearest];
  const double period = curve.isClosed() ? curve.length() : 0.0;
  std::vector<double> s;
  for (Index p : chain.points)
  {
    double d = 0.0;
    s.push_back(curve.closest(mesh.point(p), d));
    if (s.size() > 1 && period > 0.0)
    {
      // Unwraps the parameters of a closed curve: neighbours on the chain are less than half a turn
      // apart.
      s.back() += std::round((s[s.size() - 2] - s.back()) / period) * period;
    }
  }
  if (!chain.isClosed && period == 0.0)
  {
    tellEndsApart(mesh, chain.points, curve, tolerance, s);
  }
  // A chain may run along the curve in either direction.
  const double direction = s.back() > s.front() ? 1.0 : -1.0;
  // Parameters must rise or fall all along the chain. (Of a closed chain with three points nothing
  // can be told.)
  for (std::size_t k = 1; k < s.size() && !(chain.isClosed && s.size() < 4); ++k)
  {
    if (!(direction * (s[k] - s[k - 1]) > 0.0))
    {
      return "The boundary of the mesh does not follow the geometry: it turns back at its " +
        nameOf("point", chain.points[k], mesh.point(chain.points[k])) + ".";
    }
  }
  this->addPiece(editor, chain, nearest, s);
  return {};
}

/// The geometry has the corners. The boundary of the mesh is only cut there.
std::string BoundaryCurves::build(MeshEditor<2>& editor, const LineNetwork& given,
  const CurveOptions& options, const std::vector<std::uint8_t>& corners)
{
  this->curves_.clear();
  this->pieces_.clear();
  LineNetwork geometry = given;
  markCorners(geometry, options.cornerAngle);
  if (options.splines)
  {
    markKinks(geometry);
  }
  for (const LineChain& chain : chains(geometry))
  {
    const PlaneCurve curve = this->curve(geometry, chain, options.splines);
    double share = 0.0;
    curve.mostCurvedSegment(share);
    // A spline that overshoots is given up: the geometry has no further corners to divide it at.
    const bool overshoots = share > greatestShare(options.cornerAngle);
    this->curves_.push_back(overshoots ? this->curve(geometry, chain, false) : curve);
  }
  LineNetwork boundary = keptLines(editor.mesh());
  for (std::size_t p = 0; p < corners.size(); ++p)
  {
    boundary.corners[p] |= corners[p];
  }
  const double tolerance = Tolerance * diagonal(editor.mesh());
  std::string error = this->matchCorners(editor.mesh(), geometry, tolerance, boundary);
  markCorners(boundary, 180.0); // not by angle: the geometry has the corners
  for (const LineChain& chain : chains(boundary))
  {
    error = error.empty() ? this->place(editor, chain, tolerance) : error;
  }
  // All or nothing: a mesh that does not match gets no places.
  if (!error.empty())
  {
    for (Index p = 0; p < editor.mesh().numberOfPointSlots(); ++p)
    {
      editor.setPlace(p, Place());
    }
  }
  this->pieces_.join();
  return error;
}

/// Along the whole curve: the nearest place may be far from the old one.
Place BoundaryCurves::project(const Place& place, const Vec<2>& x, Vec<2>& there) const
{
  Place result = place;
  double distance = 0.0;
  result.parameter = this->curves_[this->pieces_[place.part].curve].closest(x, distance);
  there = this->at(result.part, result.parameter);
  return result;
}

int BoundaryCurves::tangents(const SimplexMesh<2>& mesh, const std::vector<Index>&, Index v,
  std::array<Vec<2>, 2>& basis) const
{
  const Place place = mesh.place(v);
  basis[0] = this->curves_[this->pieces_[place.part].curve].direction(place.parameter);
  return 1;
}

/// The two neighbours over kept facets, and their parameters.
std::optional<SlidingRange> BoundaryCurves::range(
  const SimplexMesh<2>& mesh, const std::vector<Index>& star, Index v) const
{
  std::vector<Index> ends; // the neighbours over kept facets
  for (Index c : star)
  {
    for (int i = 0; i < 3; ++i)
    {
      const Facet<2> f = mesh.facet(c, i);
      if (mesh.isKept(c, i) && (f[0] == v || f[1] == v))
      {
        ends.push_back(f[0] == v ? f[1] : f[0]);
      }
    }
  }
  // As in space: exactly two neighbours, or the point is an end.
  std::sort(ends.begin(), ends.end()); // the order of the star must not matter
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  if (mesh.freedom(v) != Freedom::Curve || ends.size() != 2)
  {
    return std::nullopt;
  }
  const auto low = this->span(mesh, v, ends[0]), high = this->span(mesh, v, ends[1]);
  return low && high ? std::optional<SlidingRange>({ { ends[0], ends[1] }, low->to, high->to })
                     : std::nullopt;
}

bool BoundaryCurves::mayJoin(
  const SimplexMesh<2>& mesh, const std::vector<Index>& star, Index v, Index u) const
{
  const auto range = this->range(mesh, star, v);
  if (!range || (range->ends[0] != u && range->ends[1] != u))
  {
    return false;
  }
  const Index w = range->ends[0] == u ? range->ends[1] : range->ends[0];
  // At an ear (a cell with both neighbours) the contraction would fold the boundary.
  const bool isEar = std::any_of(star.begin(), star.end(),
    [&](Index c) { return mesh.localIndex(c, u) >= 0 && mesh.localIndex(c, w) >= 0; });
  const Span joined{ mesh.place(v).part, range->low, range->high };
  if (isEar || !this->pieces_.mayBeNeighbours(joined) ||
    this->sagitta(joined) > Sagitta * (mesh.point(u) - mesh.point(w)).norm())
  {
    return false;
  }
  if (mesh.freedom(u) != Freedom::Curve && mesh.freedom(w) != Freedom::Curve)
  {
    const auto between = this->span(mesh, u, w);
    return between && between->part == joined.part; // several pieces may join two corners
  }
  return true;
}
}
