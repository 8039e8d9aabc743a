// SPDX-License-Identifier: BSD-3-Clause
/// @file Loads.h
/// Tractions on facets as the consistent forces on their points: f_i = integral of N_i t.
#ifndef meshopt_Thermoelastic_Loads_h
#define meshopt_Thermoelastic_Loads_h

#include "Mesh/SimplexMesh.h"

#include <array>
#include <vector>

namespace meshopt::fem
{
/// Facets of the surface, in the order of (cell, local facet). Ordered as in Local<D>::facets, so
/// that areaVector() looks inward.
template <int D>
std::vector<Facet<D>> surfaceFacets(const SimplexMesh<D>& mesh);

/// Normal times area (length in the plane) of a facet; for a facet of surfaceFacets() it looks into
/// the body.
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

/// Adds to `forces` (one per point) what a traction exerts that is linear on the facet with these
/// values at its points: exact, measure / (D (D + 1)) (t_i + sum t).
template <int D>
void addTraction(const SimplexMesh<D>& mesh, const Facet<D>& facet,
  const std::array<Vec<D>, D>& traction, std::vector<Vec<D>>& forces);

/// The same for a pressure, positive when it pushes against the body, on a facet of
/// surfaceFacets().
template <int D>
void addPressure(const SimplexMesh<D>& mesh, const Facet<D>& facet,
  const std::array<double, D>& pressure, std::vector<Vec<D>>& forces);
}

#endif
