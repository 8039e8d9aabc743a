// SPDX-License-Identifier: BSD-3-Clause
/**
 * The quality of every cell of a grid, and its statistics over the grid and over each region.
 */
#ifndef vtkMeshQualityMeasure_h
#define vtkMeshQualityMeasure_h

#include "QualityMinMax/vtkMeshQualityGrid.h"

#include "Bound/SurfaceBound.h"
#include "Quality/Measure.h"
#include "Quality/QualityStatistics.h"

#include <map>
#include <tuple>
#include <vector>

namespace vtkMeshQualityBridge
{

/**
 * The name of the cell array of qualities. Degrees have one of their own: ParaView keeps a colour
 * map for each name, and theirs does not go from 0 to 1.
 */
inline const char* ArrayName(meshopt::Measure measure)
{
  return measure == meshopt::Measure::MinimumDihedralAngle ? "MinimumDihedralAngle" : "MeshQuality";
}

/**
 * What to measure, and how.
 */
struct Options
{
  meshopt::Measure Measure = meshopt::Measure::Shape;
  double Beta = 0.0;
  double DesiredSize = 0.0;
  std::size_t NumberOfWorstCells = 10;
  bool ComputeBound = true;
  double TargetQuality = 0.6;
};

/**
 * One row of the summary.
 */
struct Sums
{
  meshopt::QualityStatistics Quality;
  std::int64_t OtherCells = 0;
  double Bound = std::numeric_limits<double>::infinity(); ///< infinity: nothing known
  std::int64_t CappedCells = 0;

  void Merge(const Sums& other);
};

/**
 * All figures of one grid, of several, or of all ranks.
 */
struct Figures
{
  explicit Figures(std::size_t numberOfWorstCells)
    : Worst(numberOfWorstCells)
  {
  }
  void Merge(const Figures& other);

  Sums Total;
  std::map<long long, Sums> Regions; ///< by the value of the region array; empty without one
  meshopt::WorstElements Worst;
  std::int64_t GhostSimplices = 0; ///< triangles and tetrahedra that are not counted
  bool HasTetrahedra = false, HasTriangles = false;
};

/**
 * Writes the quality of each cell to `quality` (one per cell), and sums up those that are not
 * ghosts. It is NaN for cells that are neither triangles nor tetrahedra, that lack a point, or have
 * a coordinate that is not finite. `part` goes into the worst elements. The bits do not depend on
 * the number of threads.
 */
Figures MeasureGrid(const Grid& grid, const Options& options, std::int64_t part, double* quality);

/**
 * The kept facets of a grid's simplices of dimension D.
 */
template <int D>
struct SurfaceOf
{
  std::vector<vtkIdType> Points; ///< of the grid, as the sides number them
  std::vector<meshopt::Vec<D>> Places;
  std::vector<meshopt::KeptSide<D>> Sides; ///< in the order of their cells
  std::vector<vtkIdType> Opposite;         ///< for each side the corner that its cell has besides
};

/**
 * The surface and the facets between regions, with all that their bound needs; empty where nothing
 * is known of the bound. Only one of the parts is used.
 */
struct Surface
{
  std::tuple<SurfaceOf<2>, SurfaceOf<3>> Parts;
  std::vector<long long> Regions; ///< the values of `region` in the sides; empty without an array
  vtkMeshBridge::Frame<2> Frame;

  template <int D>
  meshopt::Vec<D> PlaceOf(const double* x) const;
};

Surface FindSurface(const Grid& grid, const Options& options, const double* quality);

/**
 * Adds to `figures` the certified bound of a surface and the number of cells that it caps. Sides
 * without a cell belong to other ranks: they only help with the angles.
 */
void MeasureSurface(const Surface& surface, const Options& options, Figures& figures);

} // namespace vtkMeshQualityBridge

#endif
