// SPDX-License-Identifier: BSD-3-Clause
// Forces at points that do the same work as loads on facets, for loads that are linear on a facet.
#include "Thermoelastic/Loads.h"

#include <Eigen/Geometry>

namespace meshopt::fem
{
template <int D>
std::vector<Facet<D>> surfaceFacets(const SimplexMesh<D>& mesh)
{
  // Facets of the outside only: a kept facet between regions carries no load of its own. In the
  // order of the cells, so that forces are always summed up in the same order.
  std::vector<Facet<D>> facets;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i <= D && mesh.isAlive(c); ++i)
    {
      if (mesh.adjacent(c, i) == None)
      {
        facets.push_back(mesh.facet(c, i));
      }
    }
  }
  return facets;
}

/// A quarter turn to the left, where the body lies.
template <>
Vec<2> areaVector<2>(const std::array<Vec<2>, 2>& x)
{
  const Vec<2> e = x[1] - x[0];
  return { -e[1], e[0] };
}

/// Half of the cross product: a triangle is half of the parallelogram of its edges.
template <>
Vec<3> areaVector<3>(const std::array<Vec<3>, 3>& x)
{
  const Vec<3> a = x[1] - x[0], b = x[2] - x[0];
  return 0.5 * a.cross(b);
}

template <int D>
void addTraction(const SimplexMesh<D>& mesh, const Facet<D>& facet,
  const std::array<Vec<D>, D>& traction, std::vector<Vec<D>>& forces)
{
  const double measure = areaVector<D>(facetCorners<D>(mesh, facet)).norm();
  // Consistent loads: their work in any linear displacement is that of the traction.
  // The integral of phi_i phi_j over a facet is its measure / (D (D + 1)), and twice that for i =
  // j.
  Vec<D> sum = Vec<D>::Zero();
  for (const Vec<D>& t : traction)
  {
    sum += t;
  }
  for (int i = 0; i < D; ++i)
  {
    forces[facet[i]] += measure / (D * (D + 1)) * (traction[i] + sum);
  }
}

template <int D>
void addPressure(const SimplexMesh<D>& mesh, const Facet<D>& facet,
  const std::array<double, D>& pressure, std::vector<Vec<D>>& forces)
{
  // Area and normal in one vector: nothing is divided by, and a facet without area adds nothing.
  const Vec<D> inward = areaVector<D>(facetCorners<D>(mesh, facet));
  // Weights as in addTraction().
  double sum = 0.0;
  for (double p : pressure)
  {
    sum += p;
  }
  for (int i = 0; i < D; ++i)
  {
    forces[facet[i]] += (pressure[i] + sum) / (D * (D + 1)) * inward;
  }
}

template std::vector<Facet<2>> surfaceFacets<2>(const SimplexMesh<2>&);
template std::vector<Facet<3>> surfaceFacets<3>(const SimplexMesh<3>&);
template void addTraction<2>(
  const SimplexMesh<2>&, const Facet<2>&, const std::array<Vec<2>, 2>&, std::vector<Vec<2>>&);
template void addTraction<3>(
  const SimplexMesh<3>&, const Facet<3>&, const std::array<Vec<3>, 3>&, std::vector<Vec<3>>&);
template void addPressure<2>(
  const SimplexMesh<2>&, const Facet<2>&, const std::array<double, 2>&, std::vector<Vec<2>>&);
template void addPressure<3>(
  const SimplexMesh<3>&, const Facet<3>&, const std::array<double, 3>&, std::vector<Vec<3>>&);
}
