// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the boundary slides along. Of triangles: curves, from the options, the mesh, and the
 * geometry of the second input. Of tetrahedra: patches and curves of their own surface.
 */
#ifndef vtkMeshOptimizeSurface_h
#define vtkMeshOptimizeSurface_h

#include "Grid/vtkMeshOptimizeExport.h"
#include "Grid/vtkMeshOptimizeModel.h"
#include "Request/vtkMeshOptimizeRequest.h"

#include "Surface/BoundaryCurves.h"
#include "Surface/SlidingSurface.h"

#include <string>
#include <vector>

class vtkUnstructuredGrid;

namespace vtkMeshOptimizeBridge
{

/**
 * What the boundary of a mesh slides along.
 */
template <int D>
struct SurfaceOf;
template <>
struct SurfaceOf<2>
{
  using type = meshopt::BoundaryCurves;
};
template <>
struct SurfaceOf<3>
{
  using type = meshopt::SlidingSurface;
};

/**
 * Makes the tolerance of the surface of tetrahedra a length, and finds its facets that must stay
 * because other blocks share them. `grids`: all that are optimized together. Returns the locked
 * facets of each grid.
 */
std::vector<std::vector<meshopt::Facet<3>>> PrepareSurface(
  Request& request, const std::vector<vtkUnstructuredGrid*>& grids);

/**
 * Makes the surface for the model's mesh, if its boundary is to slide. Returns an empty string, or
 * a sentence about what cannot be used.
 */
std::string BuildSurface(const Request& request, Model<2>& model, meshopt::BoundaryCurves& curves);
std::string BuildSurface(const Request& request, Model<3>& model, meshopt::SlidingSurface& surface);

/**
 * Of a part of a mesh: replaces what its points have of the whole boundary by what those of the
 * output have.
 */
void KeepPlaces(const Request& request, const Model<2>& model, const OutputMap& map,
  const meshopt::BoundaryCurves& curves);
void KeepPlaces(const Request& request, const Model<3>& model, const OutputMap& map,
  const meshopt::SlidingSurface& surface);

/**
 * A sentence about facets that stay because they lie on one another, or nothing.
 */
std::string DescribeTwins(const meshopt::BoundaryCurves& curves);
std::string DescribeTwins(const meshopt::SlidingSurface& surface);

} // namespace vtkMeshOptimizeBridge

#endif
