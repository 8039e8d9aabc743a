// SPDX-License-Identifier: BSD-3-Clause
// Checks that need no geometry, for meshes whose cells overlap: by brute force over the few cells
// of a cavity.
#include "Mesh/CavityFit.h"
#include "Mesh/EulerCharacteristic.h"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <numeric>

namespace meshopt
{
namespace
{
/// Sorted facets with the numbers of their cells.
template <int D>
using Facets = std::vector<std::pair<Facet<D>, std::size_t>>;

template <int D>
Facets<D> facetsOf(const std::vector<Simplex<D>>& cells)
{
  Facets<D> facets;
  for (std::size_t k = 0; k < cells.size(); ++k)
  {
    for (const auto& local : Local<D>::facets)
    {
      Facet<D> f;
      std::transform(
        std::begin(local), std::end(local), f.begin(), [&](int i) { return cells[k][i]; });
      facets.push_back({ sortedIds(f), k });
    }
  }
  std::sort(facets.begin(), facets.end());
  return facets;
}

/// A point or an edge, or neither: None stands for no point.
using Face = std::array<Index, 2>;

template <int D>
bool has(const Facet<D>& f, const Face& face)
{
  const auto isIn = [&f](Index p)
  { return p == None || f[0] == p || f[1] == p || (D == 3 && f[D - 1] == p); };
  return isIn(face[0]) && isIn(face[1]);
}

/// A facet that two cells have.
template <int D>
struct Joint
{
  Facet<D> facet;
  std::size_t one, other;
};

/// Of sorted facets, in their order.
template <int D>
std::vector<Joint<D>> jointsOf(const Facets<D>& facets)
{
  std::vector<Joint<D>> joints;
  for (std::size_t k = 1; k < facets.size(); ++k)
  {
    if (facets[k].first == facets[k - 1].first)
    {
      joints.push_back({ facets[k].first, facets[k - 1].second, facets[k].second });
    }
  }
  return joints;
}

/// One number per cell, equal for cells that are connected over facets that contain all of `face`.
/// `part` has the size of the number of cells.
template <int D>
void findParts(
  const std::vector<Joint<D>>& joints, const Face& face, std::vector<std::size_t>& part)
{
  // Every cell is a part of its own at first. O(n) for each join: n is the number of cells of a
  // cavity.
  std::iota(part.begin(), part.end(), std::size_t(0));
  for (const Joint<D>& joint : joints)
  {
    const std::size_t one = part[joint.one], other = part[joint.other];
    if (one != other && has<D>(joint.facet, face))
    {
      std::replace(part.begin(), part.end(), other, one);
    }
  }
}

template <int D>
bool isOnePiece(const std::vector<Joint<D>>& joints, std::size_t numberOfCells)
{
  std::vector<std::size_t> part(numberOfCells);
  // Nothing is in all facets: cells connected in any way.
  findParts<D>(joints, { None, None }, part);
  return std::adjacent_find(part.begin(), part.end(), std::not_equal_to<>()) == part.end();
}

/// All points (D = 3: and edges) of facets.
template <int D>
std::vector<Face> facesOf(const Facets<D>& facets)
{
  std::vector<Face> faces;
  faces.reserve(facets.size() * (D == 3 ? 6 : 2));
  for (const auto& f : facets)
  {
    for (int i = 0; i < D; ++i)
    {
      faces.push_back({ f.first[i], None });
      for (int j = 0; D == 3 && j < i; ++j)
      {
        faces.push_back({ f.first[j], f.first[i] });
      }
    }
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

/// Whether cells that are connected at a point (D = 3: or an edge) of the boundary before are so
/// after, for every such point and edge. `outer`: the boundary, with the old cells; `within`: the
/// new cells, in the same order.
template <int D>
bool staysTogether(std::size_t numberOfOld, const std::vector<Joint<D>>& oldJoints,
  std::size_t numberOfNew, const std::vector<Joint<D>>& newJoints, const Facets<D>& outer,
  const std::vector<std::size_t>& within)
{
  std::vector<std::size_t> before(numberOfOld), after(numberOfNew), now(numberOfOld);
  for (const Face& face : facesOf<D>(outer))
  {
    findParts<D>(oldJoints, face, before);
    findParts<D>(newJoints, face, after);
    std::fill(now.begin(), now.end(), std::size_t(None)); // for each part before: the part after
    for (std::size_t k = 0; k < outer.size(); ++k)
    {
      if (has<D>(outer[k].first, face))
      {
        std::size_t& part = now[before[outer[k].second]];
        if (part != std::size_t(None) && part != after[within[k]])
        {
          return false;
        }
        part = after[within[k]];
      }
    }
  }
  return true;
}
}

template <int D>
bool fillsCavity(const SimplexMesh<D>& mesh, const std::vector<Index>& cavity,
  const std::vector<Simplex<D>>& cells, const KeptChange<D>* change)
{
  const auto inCavity = [&](Index handle)
  {
    return handle != None &&
      std::find(cavity.begin(), cavity.end(), mesh.cellOf(handle)) != cavity.end();
  };
  const auto isAmong = [](const std::vector<Facet<D>>& facets, const Facet<D>& f)
  {
    return std::any_of(facets.begin(), facets.end(),
      [&](const Facet<D>& g) { return std::is_permutation(g.begin(), g.end(), f.begin()); });
  };
  // What the cavity has in common with the rest of the mesh, and what must not change.
  Facets<D> outer;
  std::vector<Simplex<D>> old;
  for (Index c : cavity)
  {
    for (int i = 0; i <= D; ++i)
    {
      const Facet<D> f = mesh.facet(c, i);
      if (!inCavity(mesh.adjacent(c, i)) && !(change && isAmong(change->gone, f)))
      {
        outer.push_back({ sortedIds(f), old.size() });
      }
    }
    old.push_back(mesh.nodes(c));
  }
  std::sort(outer.begin(), outer.end());
  const Facets<D> facets = facetsOf<D>(cells);
  std::vector<std::size_t> within; // for each boundary facet, the new cell that has it
  const auto less = [](const auto& a, const auto& b) { return a.first < b.first; };
  for (std::size_t k = 0; k < facets.size();)
  {
    // Equal facets are treated as one, with the number of cells that have them.
    const auto [first, last] = std::equal_range(facets.begin(), facets.end(), facets[k], less);
    const auto [a, b] = std::equal_range(outer.begin(), outer.end(), facets[k], less);
    const auto n = last - first;
    const bool comes = change && b == a && n == 1 && isAmong(change->come, facets[k].first);
    // A facet must not be on the boundary twice. A boundary facet needs one new cell; one inside
    // needs two, and a new kept facet one.
    if (b - a > 1 || (n != (b == a ? 2 : 1) && !comes))
    {
      return false;
    }
    if (b != a)
    {
      within.push_back(facets[k].second);
    }
    k += static_cast<std::size_t>(n);
  }
  // All of the boundary is filled; the new cells are one piece; no handle and no hollow came or
  // went; nothing was torn apart or joined at the boundary.
  const std::vector<Joint<D>> joints = jointsOf<D>(facets);
  return within.size() == outer.size() && isOnePiece<D>(joints, cells.size()) &&
    eulerCharacteristic<D>(cells) == eulerCharacteristic<D>(old) &&
    staysTogether<D>(
      old.size(), jointsOf<D>(facetsOf<D>(old)), cells.size(), joints, outer, within);
}

template <int D>
bool meetsOthers(const SimplexMesh<D>& mesh, const std::vector<Index>& cavity,
  const std::vector<Simplex<D>>& cells, const std::vector<std::uint8_t>& pinched)
{
  const auto isPinched = [&](Index p)
  { return p < static_cast<Index>(pinched.size()) && pinched[p]; };
  std::vector<Index> star;
  Index centre = None; // of the star
  // `face`: the first n ids are a face of a new cell
  const auto isNewAndTaken = [&](const Index* face, int n)
  {
    // An old face of the cavity may come back. A face with a new point cannot have been there.
    const auto has = [&](Index c)
    { return std::all_of(face, face + n, [&](Index p) { return mesh.localIndex(c, p) >= 0; }); };
    if (std::any_of(cavity.begin(), cavity.end(), has) ||
      !std::all_of(face, face + n, [&](Index p) { return mesh.isPointAlive(p); }))
    {
      return false;
    }
    // Use the present star if it will do; otherwise that of the last point, the apex that many new
    // cells share. The star of a pinched point is incomplete, so it will not do.
    const Index* whole = std::find(face, face + n, centre);
    // From the last point to the first, until one has a star to be trusted.
    for (int k = n; whole == face + n && k-- > 0;)
    {
      whole = isPinched(face[k]) ? whole : face + k;
    }
    if (whole != face + n)
    {
      if (*whole != centre)
      {
        centre = *whole;
        mesh.star(centre, star);
      }
      return std::any_of(star.begin(), star.end(), has);
    }
    bool found = false; // all points are pinched, which is rare: scan all cells
    for (Index c = 0; c < mesh.numberOfCellSlots() && !found; ++c)
    {
      found = mesh.isAlive(c) && has(c);
    }
    return found;
  };
  for (const Simplex<D>& cell : cells)
  {
    for (const auto& e : Local<D>::edges)
    {
      const Index edge[] = { cell[e[0]], cell[e[1]] };
      if (isNewAndTaken(edge, 2))
      {
        return true;
      }
    }
    for (const auto& f : Local<D>::facets)
    {
      Index facet[D];
      std::transform(std::begin(f), std::end(f), facet, [&](int k) { return cell[k]; });
      if (isNewAndTaken(facet, D))
      {
        return true;
      }
    }
  }
  return false;
}

template bool fillsCavity<2>(const SimplexMesh<2>&, const std::vector<Index>&,
  const std::vector<Simplex<2>>&, const KeptChange<2>*);
template bool fillsCavity<3>(const SimplexMesh<3>&, const std::vector<Index>&,
  const std::vector<Simplex<3>>&, const KeptChange<3>*);
template bool meetsOthers<2>(const SimplexMesh<2>&, const std::vector<Index>&,
  const std::vector<Simplex<2>>&, const std::vector<std::uint8_t>&);
template bool meetsOthers<3>(const SimplexMesh<3>&, const std::vector<Index>&,
  const std::vector<Simplex<3>>&, const std::vector<std::uint8_t>&);
}
