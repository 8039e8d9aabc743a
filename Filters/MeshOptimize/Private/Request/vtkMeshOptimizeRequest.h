// SPDX-License-Identifier: BSD-3-Clause
/**
 * The request for a run and its outcome: the data shared by all its steps.
 */
#ifndef vtkMeshOptimizeRequest_h
#define vtkMeshOptimizeRequest_h

#include "vtkMeshBridgeFrame.h"

#include "Base/Control.h"
#include "Metric/EdgeLengths.h"
#include "Run/Options.h"
#include "Run/Report.h"
#include "Surface/BoundaryCurves.h"
#include "Surface/SurfaceDivision.h"

#include "vtkType.h"

#include <array>
#include <map>
#include <string>

class vtkAlgorithm;
class vtkPolyData;

namespace vtkMeshOptimizeBridge
{

/**
 * The request.
 */
struct Request
{
  vtkAlgorithm* Filter = nullptr; ///< knows the names of the input arrays
  meshopt::Options Options;
  meshopt::Control Control;
  int NumberOfThreads = 0;    ///< 0: all cores; on many ranks a share of them
  double TimeLimit = 0.0;     ///< in seconds, 0: none; what holds is the deadline of Control
  double OptimizeBelow = 0.0; ///< only cells under it, and layers around them, may change; 0: all
  int NumberOfLayers = 0;
  bool Slide = false;               ///< the boundary may be remeshed along its curves
  meshopt::CurveOptions Curves;     ///< of triangles
  meshopt::SurfaceOptions Surface;  ///< of tetrahedra
  bool ToleranceIsAbsolute = false; ///< Surface.tolerance is a length, not a fraction
  int NumberOfGhostLevels = 0;      ///< on many ranks: layers of ghost cells in the output
  vtkPolyData* Geometry = nullptr;  ///< source of the curves; nullptr: the mesh itself
  /// The grid is a piece of a mesh that has cells of dimension three on other ranks: triangles
  /// alone are then a surface, not a mesh.
  bool IsPieceOfVolume = false;
  /// The plane of the triangles, if they are a part of a mesh; nullptr: they say themselves.
  const vtkMeshBridge::Frame<2>* Plane = nullptr;
  /// The boundary of all triangles, if they are a part of a mesh and it slides; and what of it this
  /// part has, which a run replaces by what it has left.
  const meshopt::WholeBoundary* Boundary = nullptr;
  meshopt::PartOfBoundary* BoundaryOfPart = nullptr;
  bool HasGeometryCorners = false; ///< Geometry has the corner array, on many ranks that of any

  /// Whether sizes are used: in the quality, or because the boundary follows them.
  bool UsesSizes() const { return this->Options.beta > 0.0 || this->Slide; }
};

/**
 * The outcome for one grid or, after Add(), for several.
 */
struct Outcome
{
  meshopt::Report Report;
  vtkIdType NumberOfCells = 0; ///< optimized cells, afterwards
  vtkIdType NumberOfCellsBefore = 0;
  vtkIdType NumberOfSimplices = 0; ///< linear ones of the greatest dimension, in the input
  vtkIdType NumberOfGhostSimplices = 0;
  vtkIdType NumberOfSurfaceTriangles = 0; ///< of volumes that are not tetrahedra
  vtkIdType NumberOfReorientedCells = 0;
  vtkIdType NumberOfQuadraticSimplices = 0;
  vtkIdType NumberOfOperations = 0;
  vtkIdType NumberOfCellsInBands = 0; ///< on many ranks: at borders, over all rounds
  double Seconds = 0.0;
  double SurfaceDistance = 0.0;    ///< proved, between the surface of before and that of after
  bool HasSurfaceDistance = false; ///< a surface of tetrahedra took part
  /// By region: before and after; only if a surface of tetrahedra took part.
  std::map<long long, std::array<double, 2>> Volumes;
  meshopt::EdgeLengths Lengths; ///< at the end; no edges if neither sizes nor a metric are given
  std::string Sizes;            ///< information for the user about the wanted sizes, or empty
  std::string Twins;            ///< about facets that lie on one another, or empty
  std::string Overlap;          ///< about cells of the input that overlap, or empty
  std::string Fault;  ///< on many ranks: why a round was undone and the run ended, or empty
  std::string Tangle; ///< about inverted and flat cells that are left; empty if there are none

  /// Adds another grid's outcome: minima, means by number of cells, sums, the strongest stop
  /// reason, sentences. Histories are not joined.
  void Add(const Outcome& other);

  /// Of all regions together, relative to the volume before.
  double VolumeChange() const;
  /// That of the report; 0 if no cell has been optimized.
  double QualityBound() const { return this->NumberOfCells > 0 ? this->Report.bound : 0.0; }
};

/**
 * Two sentences as one text; either may be empty.
 */
std::string Joined(const std::string& a, const std::string& b);

} // namespace vtkMeshOptimizeBridge

#endif
