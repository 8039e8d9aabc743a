// SPDX-License-Identifier: BSD-3-Clause
/// @file EulerCharacteristic.h
/// The topology of a few cells in one number.
#ifndef meshopt_Testing_EulerCharacteristic_h
#define meshopt_Testing_EulerCharacteristic_h

#include "Mesh/Ids.h"

#include <algorithm>
#include <iterator>
#include <vector>

namespace meshopt
{
/// V - E + F - C (D = 3), V - E + C (D = 2) of the cells with their facets, edges and points.
template <int D>
long eulerCharacteristic(const std::vector<Simplex<D>>& cells)
{
  std::vector<Index> points;
  std::vector<std::array<Index, 2>> edges;
  std::vector<Facet<D>> facets;
  points.reserve(cells.size() * (D + 1));
  edges.reserve(cells.size() * std::size(Local<D>::edges));
  facets.reserve(cells.size() * (D + 1));
  for (const Simplex<D>& c : cells)
  {
    points.insert(points.end(), c.begin(), c.end());
    for (const auto& e : Local<D>::edges)
    {
      edges.push_back(sortedIds(c[e[0]], c[e[1]]));
    }
    for (const auto& local : Local<D>::facets)
    {
      Facet<D> f;
      std::transform(std::begin(local), std::end(local), f.begin(), [&](int i) { return c[i]; });
      facets.push_back(sortedIds(f));
    }
  }
  const auto countDistinct = [](auto& faces)
  {
    std::sort(faces.begin(), faces.end());
    return static_cast<long>(std::unique(faces.begin(), faces.end()) - faces.begin());
  };
  const long v = countDistinct(points), e = countDistinct(edges);
  const long f = countDistinct(facets), c = static_cast<long>(cells.size());
  return D == 3 ? v - e + f - c : v - e + c;
}
}

#endif
