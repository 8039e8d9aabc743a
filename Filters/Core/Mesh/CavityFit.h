// SPDX-License-Identifier: BSD-3-Clause
/// @file CavityFit.h
/// Whether cells are a filling of a cavity, by their points alone.
#ifndef meshopt_Mesh_CavityFit_h
#define meshopt_Mesh_CavityFit_h

#include "Mesh/SimplexMesh.h"

#include <algorithm>
#include <iterator>

namespace meshopt
{
/// True if every facet of the cavity's boundary is a facet of one of `cells`, and all their other
/// facets are there in pairs: what MeshEditor::replace() asks for. Where cells do not overlap this
/// follows from geometry; in a tangled mesh it does not. O(n^2) in the number of cells, of which
/// there are few.
template <int D>
bool fillsCavity(const SimplexMesh<D>& mesh, const std::vector<Index>& cavity,
  const std::vector<Simplex<D>>& cells)
{
  const auto inCavity = [&](Index handle)
  {
    return handle != None &&
      std::find(cavity.begin(), cavity.end(), mesh.cellOf(handle)) != cavity.end();
  };
  std::vector<Facet<D>> outer, facets;
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
  for (const Simplex<D>& cell : cells)
  {
    for (const auto& local : Local<D>::facets)
    {
      Facet<D> f;
      std::transform(std::begin(local), std::end(local), f.begin(), [&](int k) { return cell[k]; });
      std::sort(f.begin(), f.end());
      facets.push_back(f);
    }
  }
  std::sort(outer.begin(), outer.end());
  std::sort(facets.begin(), facets.end());
  std::size_t found = 0;
  for (std::size_t k = 0; k < facets.size();)
  {
    const auto [first, last] = std::equal_range(facets.begin() + k, facets.end(), facets[k]);
    const auto n = last - first;
    const auto [a, b] = std::equal_range(outer.begin(), outer.end(), facets[k]);
    if (b - a > 1 || n != (b == a ? 2 : 1))
    {
      return false;
    }
    found += static_cast<std::size_t>(b - a);
    k += static_cast<std::size_t>(n);
  }
  return found == outer.size();
}
}

#endif
