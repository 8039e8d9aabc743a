// SPDX-License-Identifier: BSD-3-Clause
/**
 * What is wanted of a run, and what came out of it: what all its steps speak of.
 */
#ifndef vtkMeshOptimizeRequest_h
#define vtkMeshOptimizeRequest_h

#include "Base/Control.h"
#include "Metric/EdgeLengths.h"
#include "Run/Options.h"
#include "Run/Report.h"
#include "Surface/BoundaryCurves.h"

#include "vtkType.h"

#include <chrono>
#include <string>

class vtkAlgorithm;
class vtkPolyData;

namespace vtkMeshOptimizeBridge
{

/**
 * What is wanted.
 */
struct Request
{
  vtkAlgorithm* Filter = nullptr; ///< knows the names of the input arrays
  meshopt::Options Options;
  meshopt::Control Control;
  int NumberOfThreads = 1;
  /// The time limit counts from here on: reading the grid is part of it, and so are other grids.
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
  double OptimizeBelow = 0.0; ///< only cells under it may change, and layers around; 0: all
  int NumberOfLayers = 0;
  bool Slide = false; ///< the boundary may be remeshed along its curves
  meshopt::CurveOptions Curves;
  vtkPolyData* Geometry = nullptr; ///< what the curves are made from; nullptr: the mesh itself

  /// Sizes count for the quality, or the boundary follows them.
  bool UsesSizes() const { return this->Options.beta > 0.0 || this->Slide; }

  /// The options for a run that begins now: with what is left of the time limit.
  meshopt::Options OptionsNow() const;
};

/**
 * What came out, for one grid or, after Add(), several.
 */
struct Outcome
{
  meshopt::Report Report;
  vtkIdType NumberOfCells = 0; ///< that were optimized, after it
  vtkIdType NumberOfCellsBefore = 0;
  vtkIdType NumberOfSimplices = 0; ///< linear ones of the greatest dimension, in the input
  vtkIdType NumberOfGhostSimplices = 0;
  vtkIdType NumberOfSurfaceTriangles = 0; ///< of volumes that are no tetrahedra
  vtkIdType NumberOfReorientedCells = 0;
  vtkIdType NumberOfQuadraticSimplices = 0;
  vtkIdType NumberOfOperations = 0;
  double Seconds = 0.0;
  meshopt::EdgeLengths Lengths; ///< in the end; no edges if neither sizes nor a metric are given
  std::string Sizes;            ///< what the user should know about the wanted sizes; or empty
  std::string Overlap;          ///< about cells of the input that lie on each other; or empty
  std::string Tangle; ///< about inverted and flat cells that are left; empty if there are none

  /// Takes another grid's outcome in: minima, means by number of cells, sums, the strongest stop
  /// reason, sentences. Histories are not joined.
  void Add(const Outcome& other);
};

/**
 * Two sentences, either of which may be empty, as one text.
 */
std::string Joined(const std::string& a, const std::string& b);

} // namespace vtkMeshOptimizeBridge

#endif
