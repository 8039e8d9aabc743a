// SPDX-License-Identifier: BSD-3-Clause
/// @file CavityFit.h
/// Whether cells are a filling of a cavity, by their points alone.
#ifndef meshopt_Mesh_CavityFit_h
#define meshopt_Mesh_CavityFit_h

#include "Mesh/EulerCharacteristic.h"
#include "Mesh/SimplexMesh.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <numeric>

namespace meshopt
{
namespace fitting
{
/// Facets in order, with the numbers of their cells.
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
      std::sort(f.begin(), f.end());
      facets.push_back({ f, k });
    }
  }
  std::sort(facets.begin(), facets.end());
  return facets;
}

template <int D>
bool has(const Facet<D>& f, const std::vector<Index>& face)
{
  return std::includes(f.begin(), f.end(), face.begin(), face.end());
}

/// One number per cell, the same for cells that hang together over facets that have all of `face`.
template <int D>
std::vector<std::size_t> parts(
  const Facets<D>& facets, std::size_t numberOfCells, const std::vector<Index>& face)
{
  std::vector<std::size_t> part(numberOfCells);
  std::iota(part.begin(), part.end(), std::size_t(0));
  for (std::size_t k = 1; k < facets.size(); ++k)
  {
    const std::size_t one = part[facets[k - 1].second], other = part[facets[k].second];
    if (facets[k].first == facets[k - 1].first && one != other && has<D>(facets[k].first, face))
    {
      std::replace(part.begin(), part.end(), other, one);
    }
  }
  return part;
}
}

/// Whether `cells` may come for those of the cavity, where that does not follow from geometry since
/// cells overlap. O(n^2) in the number of cells, of which there are few. True if
/// - every facet of the cavity's boundary is a facet of one of `cells`, and all their other facets
///   are there in pairs: what MeshEditor::replace() asks for;
/// - they hang together: a new node that is joined to the outside of a cavity and to an inverted cell
///   that the cavity surrounds would close a bubble around that cell;
/// - their Euler characteristic is that of the cavity: a node joined to all of a ring makes no ring;
/// - so do, at every point (D = 3: and edge) of the boundary, those that did before: otherwise the
///   mesh could be pinched there, and a star be found in part only.
template <int D>
bool fillsCavity(const SimplexMesh<D>& mesh, const std::vector<Index>& cavity,
  const std::vector<Simplex<D>>& cells)
{
  const auto inCavity = [&](Index handle)
  {
    return handle != None &&
      std::find(cavity.begin(), cavity.end(), mesh.cellOf(handle)) != cavity.end();
  };
  fitting::Facets<D> outer;
  std::vector<Simplex<D>> old;
  for (Index c : cavity)
  {
    for (int i = 0; i <= D; ++i)
    {
      if (!inCavity(mesh.adjacent(c, i)))
      {
        outer.push_back({ mesh.facet(c, i), old.size() });
        std::sort(outer.back().first.begin(), outer.back().first.end());
      }
    }
    old.push_back(mesh.nodes(c));
  }
  std::sort(outer.begin(), outer.end());
  const fitting::Facets<D> facets = fitting::facetsOf<D>(cells);
  std::vector<std::size_t> within; // for each facet of the boundary, the new cell that has it
  const auto less = [](const auto& a, const auto& b) { return a.first < b.first; };
  for (std::size_t k = 0; k < facets.size();)
  {
    std::size_t n = 1;
    while (k + n < facets.size() && facets[k + n].first == facets[k].first)
    {
      ++n;
    }
    const auto [a, b] = std::equal_range(outer.begin(), outer.end(), facets[k], less);
    if (b - a > 1 || n != (b == a ? 2 : 1))
    {
      return false;
    }
    if (b != a)
    {
      within.push_back(facets[k].second);
    }
    k += n;
  }
  const std::vector<std::size_t> whole = fitting::parts<D>(facets, cells.size(), {});
  if (within.size() != outer.size() ||
    std::adjacent_find(whole.begin(), whole.end(), std::not_equal_to<>()) != whole.end() ||
    eulerCharacteristic<D>(cells) != eulerCharacteristic<D>(old))
  {
    return false;
  }
  const fitting::Facets<D> oldFacets = fitting::facetsOf<D>(old);
  std::vector<std::vector<Index>> faces;
  for (const auto& f : outer)
  {
    for (int i = 0; i < D; ++i)
    {
      faces.push_back({ f.first[i] });
      for (int j = 0; D == 3 && j < i; ++j)
      {
        faces.push_back({ f.first[j], f.first[i] });
      }
    }
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  for (const std::vector<Index>& face : faces)
  {
    const std::vector<std::size_t> before = fitting::parts<D>(oldFacets, old.size(), face);
    const std::vector<std::size_t> after = fitting::parts<D>(facets, cells.size(), face);
    std::vector<std::size_t> now(old.size(), None); // the part after, for each part before
    for (std::size_t k = 0; k < outer.size(); ++k)
    {
      if (fitting::has<D>(outer[k].first, face))
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

#endif
