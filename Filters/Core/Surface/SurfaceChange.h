// SPDX-License-Identifier: BSD-3-Clause
/// @file SurfaceChange.h
/// What a change does to the surface: the facets that go and those that come, by coordinates.
#ifndef meshopt_Surface_SurfaceChange_h
#define meshopt_Surface_SurfaceChange_h

#include "Mesh/Types.h"

#include <array>
#include <vector>

namespace meshopt
{
/// The part of a curve between two points that are neighbours on it.
struct Span
{
  Index part;      ///< number of the curve
  double from, to; ///< parameters; for a closed curve they may be out of its range
  /// In space: how far the edge between the points and this part of the curve are from each other,
  /// both ways; and whether the edge leaves other sheets their room.
  double off = 0.0;
  bool leavesRoom = true;
};

/// A facet of the surface.
template <int D>
struct SurfacePiece
{
  std::array<Vec<D>, D> x; ///< ordered as in Local<D>::facets, as seen from a cell of `region`
  Index patch;             ///< None: it must not change
  Index region;            ///< of a cell on one side of it
  std::uint32_t sets = 0;  ///< the node sets that all its nodes are in
};

template <int D>
struct SurfaceChange
{
  std::vector<SurfacePiece<D>> gone, come;
  std::vector<Span> spans; ///< of the edges on curves that come

  void clear()
  {
    this->gone.clear();
    this->come.clear();
    this->spans.clear();
  }
};
}

#endif
