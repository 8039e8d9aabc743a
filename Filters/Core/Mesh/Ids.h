// SPDX-License-Identifier: BSD-3-Clause
/// @file Ids.h
/// Small functions on the point ids of a simplex, a facet or an edge.
#ifndef meshopt_Mesh_Ids_h
#define meshopt_Mesh_Ids_h

#include "Mesh/Types.h"

#include <algorithm>

namespace meshopt
{
template <std::size_t N>
bool hasId(const std::array<Index, N>& ids, Index p)
{
  return std::find(ids.begin(), ids.end(), p) != ids.end();
}

/// The same ids with `to` in place of `from`.
template <std::size_t N>
std::array<Index, N> exchanged(std::array<Index, N> ids, Index from, Index to)
{
  std::replace(ids.begin(), ids.end(), from, to);
  return ids;
}

/// In ascending order: the key of a facet or an edge, the same for all cells that have it.
inline std::array<Index, 2> sortedIds(std::array<Index, 2> f)
{
  if (f[0] > f[1])
  {
    std::swap(f[0], f[1]);
  }
  return f;
}

inline std::array<Index, 2> sortedIds(Index a, Index b)
{
  return sortedIds(std::array<Index, 2>{ a, b });
}

inline std::array<Index, 3> sortedIds(std::array<Index, 3> f)
{
  if (f[0] > f[1])
  {
    std::swap(f[0], f[1]);
  }
  if (f[1] > f[2])
  {
    std::swap(f[1], f[2]);
  }
  if (f[0] > f[1])
  {
    std::swap(f[0], f[1]);
  }
  return f;
}

/// A hash for tables with open addressing whose size is a power of two.
template <std::size_t N>
std::size_t hashIds(const std::array<Index, N>& f)
{
  std::uint32_t h = std::uint32_t(f[0]) * 2654435761u;
  h = (h ^ std::uint32_t(f[1])) * 2246822519u;
  if constexpr (N == 3)
  {
    h = (h ^ std::uint32_t(f[2])) * 3266489917u;
  }
  return h ^ (h >> 15);
}
}

#endif
