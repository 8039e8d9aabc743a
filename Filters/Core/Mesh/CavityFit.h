// SPDX-License-Identifier: BSD-3-Clause
/// @file CavityFit.h
/// Whether cells are a filling of a cavity, by their points alone.
#ifndef meshopt_Mesh_CavityFit_h
#define meshopt_Mesh_CavityFit_h

#include "Mesh/SimplexMesh.h"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace meshopt
{
/// True if every facet of the cavity's boundary is a facet of one of `cells`, and all their other
/// facets are there in pairs: what MeshEditor::replace() asks for. And if they hang together: a new
/// node that is joined to the outside of a cavity and to an inverted cell that the cavity surrounds
/// would close a bubble around that cell. Where cells do not overlap all this follows from geometry; in
/// a tangled mesh it does not. O(n^2) in the number of cells, of which there are few.
template <int D>
bool fillsCavity(const SimplexMesh<D>& mesh, const std::vector<Index>& cavity,
  const std::vector<Simplex<D>>& cells)
{
  const auto inCavity = [&](Index handle)
  {
    return handle != None &&
      std::find(cavity.begin(), cavity.end(), mesh.cellOf(handle)) != cavity.end();
  };
  std::vector<Facet<D>> outer;
  std::vector<std::pair<Facet<D>, std::size_t>> facets; // and whose they are
  for (Index c : cavity)
  {
    for (int i = 0; i <= D; ++i)
    {
      if (!inCavity(mesh.adjacent(c, i)))
      {
        outer.push_back(mesh.facet(c, i));
        std::sort(outer.back().begin(), outer.back().end());
      }
    }
  }
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
  std::sort(outer.begin(), outer.end());
  std::sort(facets.begin(), facets.end());
  std::vector<std::size_t> part(
    cells.size()); // what a cell hangs together with, as far as is known
  std::iota(part.begin(), part.end(), std::size_t(0));
  std::size_t found = 0, parts = cells.size();
  for (std::size_t k = 0; k < facets.size();)
  {
    std::size_t n = 1;
    while (k + n < facets.size() && facets[k + n].first == facets[k].first)
    {
      ++n;
    }
    const auto [a, b] = std::equal_range(outer.begin(), outer.end(), facets[k].first);
    if (b - a > 1 || n != (b == a ? 2 : 1))
    {
      return false;
    }
    const std::size_t one = part[facets[k].second], other = part[facets[k + n - 1].second];
    if (one != other)
    {
      std::replace(part.begin(), part.end(), other, one);
      --parts;
    }
    found += static_cast<std::size_t>(b - a);
    k += n;
  }
  return found == outer.size() && parts <= 1;
}
}

#endif
