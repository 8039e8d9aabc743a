// SPDX-License-Identifier: BSD-3-Clause
/// @file Loads.h
/// Tractions on facets, as the consistent forces on their points: f_i = integral of N_i t.
#ifndef meshopt_Thermoelastic_Loads_h
#define meshopt_Thermoelastic_Loads_h

#include "Mesh/SimplexMesh.h"

#include <array>
#include <vector>

namespace meshopt::fem
{
/// Facets of the surface, ordered by (cell, local facet). Their points are ordered as in
/// Local<D>::facets, so that areaVector() points inward.
template <int D>
std::vector<Facet<D>> surfaceFacets(const SimplexMesh<D>& mesh);

/// Normal times area (2D: length) of a facet. For a facet of surfaceFacets() it points into the
/// body.
template <int D>
Vec<D> areaVector(const std::array<Vec<D>, D>& x);

template <int D>
std::array<Vec<D>, D> facetCorners(const SimplexMesh<D>& mesh, const Facet<D>& facet)
{
  std::array<Vec<D>, D> x;
  for (int i = 0; i < D; ++i)
  {
    x[i] = mesh.point(facet[i]);
  }
  return x;
}

/// Adds to `forces` (one per point) the exact forces of a traction that is linear on the facet,
/// with these values at its points: measure / (D (D + 1)) (t_i + sum t).
template <int D>
void addTraction(const SimplexMesh<D>& mesh, const Facet<D>& facet,
  const std::array<Vec<D>, D>& traction, std::vector<Vec<D>>& forces);

/// The same for a pressure on a facet of surfaceFacets(); positive if it pushes against the body.
template <int D>
void addPressure(const SimplexMesh<D>& mesh, const Facet<D>& facet,
  const std::array<double, D>& pressure, std::vector<Vec<D>>& forces);
}

#endif
