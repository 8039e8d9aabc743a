// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeshOptimizeSizes.h"

#include "vtkMeshBridgeArrays.h"
#include "vtkMeshBridgeCells.h"
#include "vtkMeshOptimizeRun.h"

#include "vtkDataArray.h"

#include <cmath>
#include <sstream>
#include <vector>

namespace vtkMeshOptimizeBridge
{
namespace
{

constexpr double MostElements = 1e8; // memory, and the core's 32-bit ids
constexpr double LongEdge = 2.0;     // of an edge that is kept, in the wanted length
constexpr double AreaChange = 0.1;

std::string NameOf(const char* what, vtkDataArray* array)
{
  const char* name = array->GetName();
  return std::string(what) + (name ? " '" + std::string(name) + "'" : "") + ": ";
}

} // namespace

//------------------------------------------------------------------------------
template <int D>
std::string SetMetric(const Cells& cells, const InputArrays& arrays, const Frame<D>& frame,
  const Request& request, const meshopt::SimplexMesh<D>& mesh, meshopt::NodalMetric<D>& metric)
{
  vtkDataArray* sizes = request.UsesSizes() ? arrays.Size : nullptr;
  if (!sizes && !arrays.Metric)
  {
    return {};
  }
  const std::vector<double> sizesAtPoints = ReadSizes(sizes, cells);
  const std::string error = metric.set(
    mesh, sizesAtPoints, ReadMetric(arrays.Metric, cells, frame));
  if (error.empty())
  {
    return {};
  }
  meshopt::NodalMetric<D> alone; // tells which of the two arrays it is
  const bool isSize = sizes && !alone.set(mesh, sizesAtPoints, {}).empty();
  return (isSize || !arrays.Metric ? NameOf("Size array", sizes)
                                   : NameOf("Metric array", arrays.Metric)) +
    error;
}

template <int D>
std::string CheckCount(const Request& request, const meshopt::SimplexMesh<D>& mesh,
  const meshopt::NodalMetric<D>& metric)
{
  const bool hasSizes = request.Options.desiredSize > 0.0 || metric.hasSizes();
  if (!request.UsesSizes() || !hasSizes ||
    request.Options.algorithm != meshopt::Algorithm::WorstFirst)
  {
    return {};
  }
  const double count = metric.predictedNumberOfElements(mesh);
  if (count <= MostElements)
  {
    return {};
  }
  std::ostringstream text;
  text
    << "The wanted sizes stand for some " << count
    << " elements, more than can be made (1e8). Is the size in the units of the coordinates, or, "
       "with a metric, of the metric?";
  return text.str();
}

//------------------------------------------------------------------------------
std::string DescribeSizes(const meshopt::Report& report, const Request& request)
{
  const meshopt::SizeReport& sizes = report.sizes;
  std::ostringstream text;
  text.precision(3);
  if (sizes.isGivenUp)
  {
    text << "The wanted sizes have been given up: with them the worst quality would be "
         << sizes.worstWithSizes << ", lower than before (" << report.worstBefore
         << ") and than the target (" << request.Options.targetQuality
         << "). A lower target takes them. ";
  }
  if (sizes.cellsAtBrake > 0)
  {
    text << "No more edges were split when there were " << sizes.cellsAtBrake
         << " elements where the wanted sizes stand for "
         << static_cast<long>(std::round(sizes.predictedCells))
         << ": the sizes, or the directions of the metric, change faster from point to point than "
            "elements can follow. Give them on a finer mesh, or smoother (Gradation and Maximum "
            "Anisotropy of Solution Metric). ";
  }
  if (sizes.longestKept > LongEdge)
  {
    text << "Edges that are kept are up to " << sizes.longestKept
         << " times as long as wanted, and elements beside them can only grow towards the wanted "
            "size"
         << (request.Slide ? "."
                           : ": set the boundary mode to Slide to have the boundary divided.");
  }
  std::string result = text.str();
  result.erase(result.find_last_not_of(' ') + 1);
  return result;
}

std::string DescribeArea(double before, double after, const Request& request)
{
  const double change = after / before - 1.0;
  if (!request.Slide || !request.Curves.splines || !(std::fabs(change) > AreaChange))
  {
    return {};
  }
  std::ostringstream text;
  text.precision(3);
  text << "The area of the mesh is now " << 100.0 * std::fabs(change) << " % "
       << (change > 0.0 ? "greater" : "smaller")
       << " than before: its boundary follows B-splines through few points. If these are corners, "
          "choose straight lines (Boundary Curve), a smaller Corner Angle or a Corner Array; else "
          "give the geometry on input port 1.";
  return text.str();
}

template std::string SetMetric<2>(const Cells&, const InputArrays&, const Frame<2>&, const Request&,
  const meshopt::SimplexMesh<2>&, meshopt::NodalMetric<2>&);
template std::string SetMetric<3>(const Cells&, const InputArrays&, const Frame<3>&, const Request&,
  const meshopt::SimplexMesh<3>&, meshopt::NodalMetric<3>&);
template std::string CheckCount<2>(
  const Request&, const meshopt::SimplexMesh<2>&, const meshopt::NodalMetric<2>&);
template std::string CheckCount<3>(
  const Request&, const meshopt::SimplexMesh<3>&, const meshopt::NodalMetric<3>&);

} // namespace vtkMeshOptimizeBridge
