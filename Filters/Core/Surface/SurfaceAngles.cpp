// SPDX-License-Identifier: BSD-3-Clause
// Angles between planes and straight lines, with walks over cells and facets that tell how much of
// a turn is meant.
#include "Surface/SurfaceAngles.h"

#include "Base/SortUnique.h"
#include "Mesh/Ids.h"
#include "Mesh/SimplexGeometry.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace meshopt
{
namespace
{
/// An angle by the planes and the sum of those of its cells (or facets) must agree up to this.
constexpr double Agreement = 1e-3;

using Edge = std::array<Index, 2>;

template <std::size_t N>
struct Hash
{
  std::size_t operator()(const std::array<Index, N>& ids) const { return hashIds(ids); }
};

// Angles come from planes of whole patches and from whole straight chains: single facets may be
// needles, whose planes are uncertain. The walk over cells or facets only tells which of the angle
// and the rest of a full turn is meant, and that nothing overlaps there.
class Finder
{
public:
  Finder(const SimplexMesh<3>& mesh, const SurfaceDivision& division, SurfaceAngles& found)
    : mesh_(mesh)
    , division_(division)
    , found_(found)
  {
  }

  void run()
  {
    this->collectChains();
    this->collectFacets();
    for (const SurfaceDivision::KeptFacet& facet : this->division_.facets)
    {
      // A facet between regions has an angle on either side: both bodies have to fill theirs.
      for (Index h :
        { facet.handle, this->mesh_.adjacent(cellOf(facet.handle), facetOf(facet.handle)) })
      {
        for (int k = 0; k < 3 && h != None; ++k)
        {
          this->addDihedral(h, k);
        }
      }
      for (int k = 0; k < 3 && facet.patch != None; ++k)
      {
        // Either edge at the node may be the one on a curve, where the angle begins.
        this->addFacial(facet, k, (k + 1) % 3);
        this->addFacial(facet, k, (k + 2) % 3);
      }
    }
    for (std::vector<double>* list : { &this->found_.dihedral, &this->found_.facial })
    {
      // Each value once: the bound is worked out for each, and a box has the same angle many times.
      sortUnique(*list);
    }
  }

private:
  static Index cellOf(Index handle) { return SimplexMesh<3>::cellOf(handle); }
  static int facetOf(Index handle) { return SimplexMesh<3>::facetOf(handle); }
  const Vec<3>& point(Index p) const { return this->mesh_.point(p); }
  bool isLongEnough(double length) const
  {
    // Two directions with two ends each, all of which may be off by the tolerance: together their
    // angle is then off by less than the slack.
    return SurfaceAngles::slack * length > 4.0 * this->division_.tolerance;
  }

  /// Directions of curve edges: those of their straight chains, which are known best.
  void collectChains()
  {
    for (const SurfaceDivision::Chain& chain : this->division_.chains)
    {
      const Vec<3> along = this->point(chain.points.back()) - this->point(chain.points.front());
      for (std::size_t k = 1; k < chain.points.size(); ++k)
      {
        const Index a = chain.points[k - 1], b = chain.points[k];
        this->along_[sortedIds(a, b)] = a < b ? along : Vec<3>(-along);
      }
    }
  }

  void collectFacets()
  {
    this->widths_.assign(this->division_.numberOfPatches, 0.0);
    const std::vector<SurfaceDivision::KeptFacet>& facets = this->division_.facets;
    for (std::size_t k = 0; k < facets.size(); ++k)
    {
      const Facet<3>& f = facets[k].nodes;
      this->numberOf_[sortedIds(f)] = static_cast<Index>(k);
      if (facets[k].patch != None)
      {
        double& width = this->widths_[facets[k].patch];
        width = std::max(width, this->width(f));
      }
      for (int i = 0; i < 3; ++i)
      {
        // Edges on curves are where a walk within a patch ends. The others have two facets: with
        // more or fewer an edge is a curve.
        const Edge key = sortedIds(f[i], f[(i + 1) % 3]);
        if (!this->along_.count(key))
        {
          Edge& sides = this->sides_.try_emplace(key, Edge{ None, None }).first->second;
          sides[sides[0] == None ? 0 : 1] = static_cast<Index>(k);
        }
      }
    }
  }

  /// The least altitude of a facet.
  double width(const Facet<3>& f) const
  {
    const Vec<3> u = this->point(f[1]) - this->point(f[0]);
    const Vec<3> v = this->point(f[2]) - this->point(f[0]);
    const double longest = std::sqrt(
      std::max({ u.squaredNorm(), v.squaredNorm(), (v - u).squaredNorm() }));
    return longest > 0.0 ? u.cross(v).norm() / longest : 0.0;
  }

  /// The direction in the plane of a kept facet, at a right angle to t, on the side of the facet.
  /// False if the plane is not known well enough.
  bool across(const Facet<3>& f, const Edge& edge, const Vec<3>& t, Vec<3>& u) const
  {
    const auto found = this->numberOf_.find(sortedIds(f));
    if (found == this->numberOf_.end())
    {
      return false;
    }
    const Index patch = this->division_.facets[found->second].patch;
    const double width = patch == None ? this->width(f) : this->widths_[patch];
    const Vec<3> normal = patch == None
      ? Vec<3>((this->point(f[1]) - this->point(f[0])).cross(this->point(f[2]) - this->point(f[0])))
      : this->division_.planes[patch].normal;
    // The node opposite to the edge tells on which side of it the facet lies.
    const auto tip = std::find_if(
      f.begin(), f.end(), [&](Index p) { return p != edge[0] && p != edge[1]; });
    const Vec<3> w = this->point(*tip) - this->point(edge[0]);
    u = normal.cross(t);
    const double side = u.dot(w), length = u.norm();
    u *= (side < 0.0 ? -1.0 : 1.0) / length;
    return this->isLongEnough(width) && length > 0.0 && side != 0.0;
  }

  /// The angle between kept facets that begins at facet `handle` and turns about its edge k, on the
  /// side of its cell.
  void addDihedral(Index handle, int k)
  {
    const Index c = cellOf(handle);
    const Facet<3> first = this->mesh_.facet(c, facetOf(handle));
    const Edge edge = sortedIds(first[(k + 1) % 3], first[(k + 2) % 3]);
    const auto along = this->along_.find(edge);
    if (along == this->along_.end() || !this->isLongEnough(along->second.norm()))
    {
      return;
    }
    double sum = 0.0;
    Facet<3> last;
    if (!this->turn(handle, edge, sum, last) || sortedIds(first) > sortedIds(last))
    {
      return; // the same angle is found from its other side
    }
    const Vec<3> t = along->second.normalized();
    Vec<3> u, v;
    if (this->across(first, edge, t, u) && this->across(last, edge, t, v))
    {
      this->add(std::atan2(u.cross(v).norm(), u.dot(v)), sum, this->found_.dihedral);
    }
  }

  /// Goes around the edge from a kept facet to the next. `sum`: of the dihedral angles passed.
  bool turn(Index handle, const Edge& edge, double& sum, Facet<3>& last) const
  {
    Index c = cellOf(handle);
    int i = facetOf(handle);
    for (int steps = 0; steps < MostCells; ++steps)
    {
      // The other facet of the cell at the edge is opposite to the third node of facet i.
      const Simplex<3>& t = this->mesh_.nodes(c);
      int j = 0;
      while (j == i || t[j] == edge[0] || t[j] == edge[1])
      {
        ++j;
      }
      // By sine and cosine: an arc cosine would lose half of the digits near 0 and 180 degrees.
      const Vec<3> x = this->point(edge[1]) - this->point(edge[0]);
      const Vec<3> m = x.cross(this->point(t[j]) - this->point(edge[0]));
      const Vec<3> n = x.cross(this->point(t[i]) - this->point(edge[0]));
      const double angle = std::atan2(m.cross(n).norm(), m.dot(n));
      // An inverted cell turns back. So the sum is the angle between both facets in that case, too.
      sum += signedVolume(this->mesh_.corners(c)) < 0.0 ? -angle : angle;
      if (this->mesh_.isKept(c, j))
      {
        last = this->mesh_.facet(c, j);
        return true;
      }
      const Index next = this->mesh_.adjacent(c, j);
      if (next == None)
      {
        return false;
      }
      c = cellOf(next);
      i = facetOf(next);
    }
    return false;
  }

  /// The angle of a patch at node k of the facet, from its edge to node l, if that is on a curve,
  /// to the next curve.
  void addFacial(const SurfaceDivision::KeptFacet& facet, int k, int l)
  {
    const Index p = facet.nodes[k], first = facet.nodes[l];
    Vec<3> u, v;
    // Inside of a straight curve the angle is 180 degrees, which asks nothing of a mesh.
    if (this->division_.freedom[p] == Freedom::Curve || !this->alongFrom(p, first, u) ||
      !this->isLongEnough(this->widths_[facet.patch]))
    {
      return;
    }
    Index number = this->numberOf_.at(sortedIds(facet.nodes));
    Index from = first;
    double sum = 0.0;
    for (int steps = 0; steps < MostCells; ++steps)
    {
      const Facet<3>& f = this->division_.facets[number].nodes;
      const Index to = *std::find_if(
        f.begin(), f.end(), [&](Index q) { return q != p && q != from; });
      const Vec<3> a = this->point(from) - this->point(p), b = this->point(to) - this->point(p);
      sum += std::atan2(a.cross(b).norm(), a.dot(b));
      const Edge key = sortedIds(p, to);
      if (this->along_.count(key))
      {
        // The same angle is found from its other end. The lower id reports it.
        if (first < to && this->alongFrom(p, to, v))
        {
          this->add(std::atan2(u.cross(v).norm(), u.dot(v)), sum, this->found_.facial);
        }
        return;
      }
      const Edge& sides = this->sides_.at(key);
      number = sides[0] == number ? sides[1] : sides[0];
      from = to;
      if (number == None)
      {
        return;
      }
    }
  }

  /// The direction of the curve that begins at p with the edge to q.
  bool alongFrom(Index p, Index q, Vec<3>& direction) const
  {
    const auto found = this->along_.find(sortedIds(p, q));
    if (found == this->along_.end() || !this->isLongEnough(found->second.norm()))
    {
      return false;
    }
    direction = (p < q ? 1.0 : -1.0) * found->second.normalized();
    return true;
  }

  /// `angle` is in [0, pi]; the sum tells whether it or the rest of 2 pi is meant.
  static void add(double angle, double sum, std::vector<double>& list)
  {
    const double meant = sum > Pi ? 2.0 * Pi - angle : angle;
    // An angle that rounding could make 0, or a full turn, has no certain bound.
    if (std::fabs(meant - sum) < Agreement && meant > 2.0 * SurfaceAngles::slack &&
      meant < 2.0 * (Pi - SurfaceAngles::slack))
    {
      list.push_back(meant);
    }
  }

  static constexpr int MostCells = 1000000; // around an edge or in a fan: only a fault has more

  const SimplexMesh<3>& mesh_;
  const SurfaceDivision& division_;
  SurfaceAngles& found_;
  std::unordered_map<Edge, Vec<3>, Hash<2>> along_;       // of curve edges, from the lower id
  std::unordered_map<Facet<3>, Index, Hash<3>> numberOf_; // by sorted ids
  std::unordered_map<Edge, Edge, Hash<2>> sides_;         // the facets at the other edges
  std::vector<double> widths_;                            // of patches
};
}

SurfaceAngles surfaceAngles(const SimplexMesh<3>& mesh, const SurfaceDivision& division)
{
  SurfaceAngles found;
  if (division.isExact && division.tolerance <= division.rounding)
  {
    Finder(mesh, division, found).run();
  }
  return found;
}
}
