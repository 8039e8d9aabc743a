// SPDX-License-Identifier: BSD-3-Clause
// Plane meshes only: finds the kept edges that are too long for the wanted sizes.
#include "Surface/KeptSizes.h"

#include <algorithm>
#include <limits>

namespace meshopt
{
namespace
{
/// Edges longer than this (in units of the wanted length) call for a floor.
constexpr double LongEdge = 2.0;
}

template <>
std::shared_ptr<const SizeFloor<3>> keptSizeFloor<3>(
  const SimplexMesh<3>&, const NodalMetric<3>&, const Surface<3>*, double&)
{
  return nullptr;
}

template <>
std::shared_ptr<const SizeFloor<2>> keptSizeFloor<2>(const SimplexMesh<2>& mesh,
  const NodalMetric<2>& metric, const Surface<2>* surface, double& longest)
{
  std::vector<SizeFloor<2>::Edge> edges;
  longest = 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i < 3 && mesh.isAlive(c); ++i)
    {
      const Facet<2> f = mesh.facet(c, i);
      // Only edges that must stay count. One that can be divided gets its sizes.
      if (!mesh.isKept(c, i) || (surface && surface->mayDivide(mesh, { c }, f[0], f[1])))
      {
        continue;
      }
      const ElementMetric<2> m = metric.element(mesh.nodes(c));
      SizeFloor<2>::Edge e{ mesh.point(f[0]), mesh.point(f[1]), Tensor<2>::Identity(), 0.0 };
      if (!m.euclidean)
      {
        e.metric = m.map.transpose() * m.map;
      }
      e.size = std::sqrt((e.b - e.a).dot(e.metric * (e.b - e.a)));
      longest = std::max(longest, e.size / m.desiredSize);
      least = std::min(least, m.desiredSize);
      // The floor of a shorter edge is below the wanted size everywhere.
      if (e.size > m.desiredSize)
      {
        edges.push_back(e);
      }
    }
  }
  return longest > LongEdge ? std::make_shared<const SizeFloor<2>>(std::move(edges), least)
                            : nullptr;
}
}
