// SPDX-License-Identifier: BSD-3-Clause
// Pairs of kept facets that fold or cross, found by a tree of boxes with exact signs; and the test
// whether cells can overlap.
#include "Surface/SurfaceFaults.h"

#include "Mesh/BoxTree.h"
#include "Mesh/Ids.h"
#include "Mesh/Predicates.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace meshopt
{
namespace
{
/// Marks the given cells and two layers around them; a layer shares nodes with the one before.
template <int D>
std::vector<char> neighbourhood(const SimplexMesh<D>& mesh, const std::vector<Index>& cells)
{
  // Faults come from cells that are bad: far from them the surface is taken for good, which saves
  // the search over all of it.
  std::vector<char> isNear(mesh.numberOfCellSlots(), 0);
  for (Index c : cells)
  {
    isNear[c] = 1;
  }
  std::vector<char> isTouched(mesh.numberOfPointSlots(), 0);
  for (int layer = 0; layer < 2; ++layer)
  {
    for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
    {
      for (Index p : mesh.nodes(c))
      {
        isTouched[p] |= isNear[c];
      }
    }
    for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
    {
      const auto& nodes = mesh.nodes(c);
      isNear[c] = mesh.isAlive(c) &&
        std::any_of(nodes.begin(), nodes.end(), [&](Index p) { return isTouched[p] != 0; });
    }
  }
  return isNear;
}

/// A kept facet: its ids sorted, and its handle from one side.
template <int D>
struct Kept
{
  Facet<D> nodes;
  Index handle;
  bool operator<(const Kept& o) const { return this->nodes < o.nodes; }
  bool operator==(const Kept& o) const { return this->nodes == o.nodes; }
};

/// Kept facets of the marked cells, each once.
template <int D>
std::vector<Kept<D>> keptFacets(const SimplexMesh<D>& mesh, const std::vector<char>& isNear)
{
  std::vector<Kept<D>> facets;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i <= D && isNear[c]; ++i)
    {
      if (mesh.isKept(c, i))
      {
        facets.push_back({ sortedIds(mesh.facet(c, i)), SimplexMesh<D>::handle(c, i) });
      }
    }
  }
  // Stable: of the two sides of a facet, that of the lower cell stays.
  std::stable_sort(facets.begin(), facets.end());
  facets.erase(std::unique(facets.begin(), facets.end()), facets.end());
  return facets;
}

bool hasNoArea(const SimplexMesh<2>& mesh, const Facet<2>& f)
{
  return mesh.point(f[0]) == mesh.point(f[1]);
}

/// Relative to the longest edge: the test does not depend on units.
bool hasNoArea(const SimplexMesh<3>& mesh, const Facet<3>& f)
{
  // By the longest edge, not by that of any fixed corner: numbering must not matter.
  const Vec<3> a = mesh.point(f[1]) - mesh.point(f[0]), b = mesh.point(f[2]) - mesh.point(f[0]);
  const double longest = std::max({ a.squaredNorm(), b.squaredNorm(), (a - b).squaredNorm() });
  return a.cross(b).norm() <= 1e-14 * longest;
}

/// Whether two edges in the plane, from node p to a and to b, lie on each other.
bool lieOnEachOther(const Vec<2>& p, const Vec<2>& a, const Vec<2>& b)
{
  return orient(p, a, b) == 0 && (a - p).dot(b - p) > 0.0;
}

/// Whether two triangles p, q, a and p, q, b lie on each other.
bool lieOnEachOther(const Vec<3>& p, const Vec<3>& q, const Vec<3>& a, const Vec<3>& b)
{
  const Vec<3> e = q - p;
  // The sign comes last: in flat parts of a surface it is 0 for all neighbours, which takes long.
  return e.cross(Vec<3>(a - p)).dot(e.cross(Vec<3>(b - p))) > 0.0 && orient(p, q, a, b) == 0;
}

/// The angle of a cell between its two facets without node a and without node w; negative if the
/// cell is inverted.
double angle(const SimplexMesh<2>& mesh, Index c, Index a, Index w)
{
  // Of three ids two are known: the rest of the sum is the third.
  const Corners<2> x = mesh.corners(c);
  const Index p = mesh.nodes(c)[0] + mesh.nodes(c)[1] + mesh.nodes(c)[2] - a - w;
  const Vec<2> u = mesh.point(a) - mesh.point(p), v = mesh.point(w) - mesh.point(p);
  return orientation(x) * std::atan2(std::fabs(u[0] * v[1] - u[1] * v[0]), u.dot(v));
}

double angle(const SimplexMesh<3>& mesh, Index c, Index a, Index w)
{
  Index ends[2] = { None, None };
  for (Index p : mesh.nodes(c))
  {
    if (p != a && p != w)
    {
      ends[ends[0] == None ? 0 : 1] = p;
    }
  }
  const Vec<3>& o = mesh.point(ends[0]);
  // Seen along the edge, the facets are lines: their angle is that of the two normals of the edge.
  const Vec<3> e = (mesh.point(ends[1]) - o).normalized();
  const Vec<3> u = e.cross(Vec<3>(mesh.point(a) - o)), v = e.cross(Vec<3>(mesh.point(w) - o));
  return orientation(mesh.corners(c)) * std::atan2(u.cross(v).norm(), u.dot(v));
}

/// The angle filled by cells around the side that a kept facet has without its node a, from this
/// facet (`handle`) to the next kept one. Returns the other node of that one in a. A huge value if
/// there is none.
template <int D>
double filledAngle(const SimplexMesh<D>& mesh, Index handle, Index& a)
{
  Index c = SimplexMesh<D>::cellOf(handle);
  Index w = mesh.nodes(c)[SimplexMesh<D>::facetOf(handle)];
  double sum = 0.0;
  for (int step = 0; step < 1000; ++step)
  {
    // Inverted cells count negatively: together the angles are what is between both facets.
    sum += angle(mesh, c, a, w);
    const int i = mesh.localIndex(c, a);
    a = w;
    if (mesh.isKept(c, i))
    {
      return sum;
    }
    const Index next = mesh.adjacent(c, i);
    c = SimplexMesh<D>::cellOf(next);
    w = mesh.nodes(c)[SimplexMesh<D>::facetOf(next)];
  }
  // The walk has not come to an end: nothing is known.
  return 1e9;
}

/// Two facets lie on each other and differ in the nodes a and b. True if the mesh is between them,
/// where it has no room; false if it is all around them, as at the end of a closed crack.
template <int D>
bool isFolded(const SimplexMesh<D>& mesh, const Kept<D>& f, Index a, Index b)
{
  const Index other = mesh.adjacent(
    SimplexMesh<D>::cellOf(f.handle), SimplexMesh<D>::facetOf(f.handle));
  for (Index handle : { f.handle, other })
  {
    Index end = a;
    // About 0 if the mesh is between them, a full turn if it is around them: 1 is far from both.
    if (handle != None && std::fabs(filledAngle(mesh, handle, end)) < 1.0 && end == b)
    {
      return true;
    }
  }
  return false;
}

/// Whether edge (p, q), with p and q on opposite sides of triangle (a, b, c), passes through it. It
/// may hit an edge of the triangle, but not a node: that is what surfaces do that only touch.
bool pierces(const Vec<3>& p, const Vec<3>& q, const Vec<3>& a, const Vec<3>& b, const Vec<3>& c)
{
  // One sign of 0 is a hit on an edge, two are a hit on a node.
  const int s[3] = { orient(p, q, a, b), orient(p, q, b, c), orient(p, q, c, a) };
  const int sum = s[0] + s[1] + s[2];
  const bool agree = *std::min_element(s, s + 3) * *std::max_element(s, s + 3) >= 0;
  return agree && (sum >= 2 || sum <= -2);
}

/// Whether two facets have a fault, and of which kind.
template <int D>
bool isFaulty(const SimplexMesh<D>& mesh, const Kept<D>& f, const Kept<D>& g,
  typename SurfaceFault<D>::Kind& kind)
{
  const Facet<D>&m = f.nodes, &n = g.nodes;
  // The nodes of both, and the last one of each that the other has not.
  std::array<Index, D> shared;
  std::size_t number = 0;
  Index onlyF = None, onlyG = None;
  for (int i = 0; i < D; ++i)
  {
    const bool isShared = hasId(n, m[i]);
    (isShared ? shared[number] : onlyF) = m[i];
    number += isShared;
    onlyG = hasId(m, n[i]) ? onlyG : n[i];
  }
  // Neighbours over an edge (D = 2: at a node) can only fold; the others are asked whether they
  // cross.
  if (number != D - 1)
  {
    kind = SurfaceFault<D>::Crossing;
    return facetsCross(mesh, m, n);
  }
  kind = SurfaceFault<D>::Folded;
  const Vec<D>&p = mesh.point(shared[0]), &a = mesh.point(onlyF), &b = mesh.point(onlyG);
  bool close = false;
  if constexpr (D == 2)
  {
    close = lieOnEachOther(p, a, b);
  }
  else
  {
    close = lieOnEachOther(p, mesh.point(shared[1]), a, b);
  }
  return close && isFolded(mesh, f, onlyF, onlyG);
}
}

/// An end that lies on the other edge is a touch, not a crossing.
bool facetsCross(const SimplexMesh<2>& mesh, const Facet<2>& f, const Facet<2>& g)
{
  const Vec<2>&a = mesh.point(f[0]), &b = mesh.point(f[1]), &c = mesh.point(g[0]),
        &d = mesh.point(g[1]);
  return orient(a, b, c) * orient(a, b, d) < 0 && orient(c, d, a) * orient(c, d, b) < 0;
}

bool facetsCross(const SimplexMesh<3>& mesh, const Facet<3>& f, const Facet<3>& g)
{
  // On which side of the other facet each node is; those of both are on none.
  using Sides = std::array<int, 3>;
  const auto sidesOf = [&](const Facet<3>& nodes, const Facet<3>& face)
  {
    Sides sides;
    std::transform(nodes.begin(), nodes.end(), sides.begin(),
      [&](Index p)
      {
        return hasId(face, p)
          ? 0
          : orient(mesh.point(face[0]), mesh.point(face[1]), mesh.point(face[2]), mesh.point(p));
      });
    return sides;
  };
  // All beside the other facet on one side, as in most pairs whose boxes overlap: nothing crosses.
  const auto areBeside = [](const Sides& s) { return s[0] != 0 && s[0] == s[1] && s[1] == s[2]; };
  const Sides ofF = sidesOf(f, g);
  if (areBeside(ofF))
  {
    return false;
  }
  const Sides ofG = sidesOf(g, f);
  // Two triangles that cross have an edge that passes through the other one: all six are tried.
  const auto oneWay = [&](const Facet<3>& edges, const Sides& sides, const Facet<3>& face)
  {
    for (int i = 0; i < 3; ++i)
    {
      const int j = (i + 1) % 3;
      if (sides[i] * sides[j] < 0 &&
        pierces(mesh.point(edges[i]), mesh.point(edges[j]), mesh.point(face[0]),
          mesh.point(face[1]), mesh.point(face[2])))
      {
        return true;
      }
    }
    return false;
  };
  return oneWay(f, ofF, g) || oneWay(g, ofG, f);
}

/// By a tree of boxes: only pairs whose boxes overlap are looked at.
template <int D>
std::vector<SurfaceFault<D>> findSurfaceFaults(
  const SimplexMesh<D>& mesh, const std::vector<Index>& cells)
{
  using Fault = SurfaceFault<D>;
  const std::vector<Kept<D>> facets = keptFacets(mesh, neighbourhood(mesh, cells));
  std::vector<Fault> faults;
  for (const Kept<D>& f : facets)
  {
    if (hasNoArea(mesh, f.nodes))
    {
      faults.push_back({ Fault::NoArea, { f.nodes, f.nodes } });
    }
  }
  std::vector<BoxTree::Item> items;
  for (const Kept<D>& f : facets)
  {
    std::array<Vec<D>, D> x;
    std::transform(
      f.nodes.begin(), f.nodes.end(), x.begin(), [&](Index p) { return mesh.point(p); });
    items.push_back({ static_cast<int>(items.size()), BoxTree::around(x) });
  }
  BoxTree tree;
  tree.build(items);
  for (const BoxTree::Item& item : items)
  {
    tree.findTouching(item.box,
      [&](int other)
      {
        typename Fault::Kind kind;
        if (other > item.number && isFaulty(mesh, facets[item.number], facets[other], kind))
        {
          faults.push_back({ kind, { facets[item.number].nodes, facets[other].nodes } });
        }
      });
  }
  // By kind and ids: the order of the search would change if the body were turned.
  std::sort(faults.begin(), faults.end(),
    [](const Fault& a, const Fault& b)
    { return std::tie(a.kind, a.facets) < std::tie(b.kind, b.facets); });
  return faults;
}

namespace
{
/// The fraction of all directions within the angle between these edges.
double shareOfDirections(const std::array<Vec<2>, 2>& e)
{
  const double cross = e[0][0] * e[1][1] - e[0][1] * e[1][0];
  return std::atan2(std::fabs(cross), e[0].dot(e[1])) / (2.0 * std::acos(-1.0));
}

/// The same for the solid angle (van Oosterom and Strackee).
double shareOfDirections(const std::array<Vec<3>, 3>& e)
{
  const double a = e[0].norm(), b = e[1].norm(), c = e[2].norm();
  const double part = a * b * c + e[0].dot(e[1]) * c + e[0].dot(e[2]) * b + e[1].dot(e[2]) * a;
  const double half = std::atan2(std::fabs(e[0].dot(e[1].cross(e[2]))), part);
  return half / (2.0 * std::acos(-1.0));
}

/// Cells that fill more than all directions around a point overlap there. Points of the surface
/// have fewer directions to fill, so that not all overlaps show.
template <int D>
bool fillsMoreThanAll(const SimplexMesh<D>& mesh)
{
  constexpr double most = 1.0 + 1e-6; // rounding
  std::vector<double> share(static_cast<std::size_t>(mesh.numberOfPointSlots()), 0.0);
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i <= D && mesh.isAlive(c); ++i)
    {
      const Index p = mesh.nodes(c)[i];
      const Facet<D> f = mesh.facet(c, i);
      std::array<Vec<D>, D> edges;
      for (int k = 0; k < D; ++k)
      {
        edges[k] = mesh.point(f[k]) - mesh.point(p);
      }
      share[p] += shareOfDirections(edges);
    }
  }
  // Written so that a share that is not a number counts as too much.
  return std::any_of(share.begin(), share.end(), [](double s) { return !(s <= most); });
}
}

template <int D>
bool hasLostSigns(const SimplexMesh<D>& mesh)
{
  constexpr double shortest = 1e-90, most = 1e-70; // far from the smallest number of all, 5e-324
  // Two numbers differ by so little only if both are tiny: most meshes have none such.
  bool hasTiny = false;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    const Vec<D> x = mesh.point(p).cwiseAbs();
    hasTiny |= (x.array() > 0.0 && x.array() < most).any();
  }
  for (Index c = 0; c < mesh.numberOfCellSlots() && hasTiny; ++c)
  {
    for (int e = 0; e < Local<D>::numberOfEdges && mesh.isAlive(c); ++e)
    {
      const Vec<D>&a = mesh.point(mesh.nodes(c)[Local<D>::edges[e][0]]),
            &b = mesh.point(mesh.nodes(c)[Local<D>::edges[e][1]]);
      if (a != b && (a - b).template lpNorm<Eigen::Infinity>() < shortest)
      {
        return true;
      }
    }
  }
  return false;
}

/// From the cheapest test to the dearest.
template <int D>
bool mayOverlap(const SimplexMesh<D>& mesh, const std::vector<std::uint8_t>& pinched)
{
  if (!pinched.empty() || hasLostSigns(mesh) || fillsMoreThanAll(mesh))
  {
    return true;
  }
  std::vector<Index> cells;
  for (Index c = 0; D == 3 && c < mesh.numberOfCellSlots(); ++c)
  {
    if (mesh.isAlive(c))
    {
      cells.push_back(c);
    }
  }
  return !findSurfaceFaults<D>(mesh, cells).empty();
}

template bool hasLostSigns<2>(const SimplexMesh<2>&);
template bool hasLostSigns<3>(const SimplexMesh<3>&);
template bool mayOverlap<2>(const SimplexMesh<2>&, const std::vector<std::uint8_t>&);
template bool mayOverlap<3>(const SimplexMesh<3>&, const std::vector<std::uint8_t>&);
template std::vector<SurfaceFault<2>> findSurfaceFaults<2>(
  const SimplexMesh<2>&, const std::vector<Index>&);
template std::vector<SurfaceFault<3>> findSurfaceFaults<3>(
  const SimplexMesh<3>&, const std::vector<Index>&);
}
