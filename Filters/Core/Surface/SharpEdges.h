// SPDX-License-Identifier: BSD-3-Clause
/// @file SharpEdges.h
/// Where the surface of a mesh bent sharply at first.
#ifndef meshopt_Surface_SharpEdges_h
#define meshopt_Surface_SharpEdges_h

#include "Mesh/BoxTree.h"

#include <array>
#include <vector>

namespace meshopt
{
class SharpEdges
{
public:
  void add(const Vec<3>& a, const Vec<3>& b) { this->edges_.push_back({ a, b }); }
  /// To be called once, after the last edge.
  void finish();

  /// Whether all of the line from a to b is within the distance of these edges.
  bool isNear(const Vec<3>& a, const Vec<3>& b, double distance) const;

private:
  std::vector<std::array<Vec<3>, 2>> edges_;
  BoxTree tree_;
};
}

#endif
