// SPDX-License-Identifier: BSD-3-Clause
// Warnings come after the results are stored: whoever observes them can ask the filter for figures.
#include "Tasks/vtkMeshOptimizeWarnings.h"

#include "Request/vtkMeshOptimizeArrays.h"
#include "vtkMeshBridgeArrays.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"

namespace vtkMeshOptimizeBridge
{
namespace
{

/**
 * The reason why nothing was optimized.
 */
std::string DescribeNothing(vtkDataObject* input, const Outcome& outcome)
{
  // From the most special reason to the most general.
  const std::string all = std::to_string(input->GetNumberOfElements(vtkDataObject::CELL));
  if (outcome.NumberOfGhostSimplices > 0)
  {
    return "all " + std::to_string(outcome.NumberOfGhostSimplices) +
      " triangles or tetrahedra to optimize are ghost cells (duplicate, refined or hidden, says "
      "vtkGhostType). They have passed through as they are.";
  }
  if (outcome.NumberOfSurfaceTriangles > 0)
  {
    return "of the " + all + " cells " + std::to_string(outcome.NumberOfSurfaceTriangles) +
      " are triangles, but there are cells of dimension three, too, and none of these is a "
      "tetrahedron. (In ParaView, Tetrahedralize splits other cells.)";
  }
  return "none of the " + all +
    " cells is a triangle or a tetrahedron of an unstructured grid. They have passed through as "
    "they are. (In ParaView, Tetrahedralize splits other cells, and Append Datasets makes a grid "
    "of polygonal data.)";
}

} // namespace

void Warn(vtkAlgorithm* filter, const Outcome& outcome)
{
  if (outcome.NumberOfQuadraticSimplices > 0)
  {
    vtkWarningWithObjectMacro(filter,
      << "Quadratic triangles and tetrahedra passed through as they are, "
      << outcome.NumberOfQuadraticSimplices << " in all: only linear ones can be optimized.");
  }
  if (outcome.NumberOfReorientedCells > 0)
  {
    vtkWarningWithObjectMacro(filter,
      << "Cells that were numbered the wrong way round (negative volume) have been renumbered, "
      << outcome.NumberOfReorientedCells << " in all.");
  }
  for (const std::string& text : { outcome.Twins, outcome.Overlap, outcome.Tangle, outcome.Sizes })
  {
    if (!text.empty())
    {
      vtkWarningWithObjectMacro(filter, << text);
    }
  }
}

void WarnOfNoEffect(const Request& request, vtkDataObject* input, const Outcome& outcome)
{
  vtkAlgorithm* filter = request.Filter;
  if (input->GetNumberOfElements(vtkDataObject::CELL) > 0 &&
    outcome.NumberOfSimplices + outcome.NumberOfQuadraticSimplices == 0)
  {
    vtkWarningWithObjectMacro(
      filter, << "Nothing to optimize: " << DescribeNothing(input, outcome));
  }
  // What was asked for and can have no effect is worth a word: the run looks as if it had.
  const bool hasSizes = request.Options.desiredSize > 0.0 ||
    vtkMeshBridge::IsWanted(filter, SizeArray);
  if (hasSizes && !request.UsesSizes())
  {
    vtkWarningWithObjectMacro(
      filter, << "Beta is 0, so only the shape counts: the wanted size has no effect.");
  }
  if (request.Geometry && !request.Slide)
  {
    vtkWarningWithObjectMacro(
      filter, << "The boundary mode is Fixed, so the geometry on input port 1 has no effect.");
  }
}

} // namespace vtkMeshOptimizeBridge
