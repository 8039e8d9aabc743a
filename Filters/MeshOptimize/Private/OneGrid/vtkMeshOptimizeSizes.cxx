// SPDX-License-Identifier: BSD-3-Clause
// Sizes and metric on their way into the core, and what the user has to know about their result.
#include "OneGrid/vtkMeshOptimizeSizes.h"

#include "vtkMeshBridgeGridView.h"
#include "vtkMeshBridgeValues.h"

#include "vtkDataArray.h"

#include "Metric/TensorFunctions.h"

#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

namespace vtkMeshOptimizeBridge
{
namespace
{

constexpr double MostElements = 1e8; // memory, and the core's 32-bit ids
constexpr double LongEdge = 2.0;     // length of a kept edge in units of the wanted length
// Of the area: a change that is worth a word.
constexpr double AreaChange = 0.1;

std::string NameOf(const char* what, vtkDataArray* array)
{
  const char* name = array->GetName();
  return std::string(what) + (name ? " '" + std::string(name) + "'" : "") + ": ";
}

/// The sizes, if they are used.
template <int D>
vtkDataArray* SizesOf(const Request& request, const Model<D>& model)
{
  return request.UsesSizes() ? model.Arrays.Size : nullptr;
}

template <int D>
constexpr vtkMeshBridge::Kind SimplexKind = D == 3 ? vtkMeshBridge::Kind::Tetrahedron
                                                   : vtkMeshBridge::Kind::Triangle;

/**
 * The result of NodalMetric::set() for the values at one point. Either array may be nullptr.
 */
template <int D>
typename meshopt::NodalMetric<D>::Sample ReadSample(
  vtkDataArray* sizes, vtkDataArray* tensors, vtkIdType p, const vtkMeshBridge::Frame<D>& frame)
{
  typename meshopt::NodalMetric<D>::Sample sample;
  if (sizes)
  {
    sample.logSize = vtkMeshBridge::LogOfSize(sizes->GetComponent(p, 0));
  }
  if (tensors &&
    !meshopt::logarithm<D>(vtkMeshBridge::ReadTensor(tensors, p, frame), sample.logTensor))
  {
    sample.logTensor.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return sample;
}

} // namespace

//------------------------------------------------------------------------------
template <int D>
std::string SetMetric(const Request& request, Model<D>& model)
{
  vtkDataArray* tensors = model.Arrays.Metric;
  vtkDataArray* sizes = SizesOf(request, model);
  if (!sizes && !tensors)
  {
    return {};
  }
  // The core knows points, not arrays: it says which of the two the sentence is about.
  meshopt::NodalValues blamed;
  const std::string error = model.Metric.set(model.Mesh, vtkMeshBridge::ReadSizes(sizes),
    vtkMeshBridge::ReadTensors(tensors, model.Frame), &blamed);
  if (error.empty())
  {
    return {};
  }
  return (blamed == meshopt::NodalValues::Sizes ? NameOf("Size array", sizes)
                                                : NameOf("Metric array", tensors)) +
    error;
}

/**
 * Only points that no simplex of the mesh uses: the values of a run must not depend on ghosts.
 */
template <int D>
void SetMetricOfGhosts(const Request& request, Model<D>& model)
{
  vtkDataArray* tensors = model.Arrays.Metric;
  vtkDataArray* sizes = SizesOf(request, model);
  const vtkMeshBridge::GridView view(model.Grid);
  for (vtkIdType c = 0; c < view.GetNumberOfCells() && (sizes || tensors); ++c)
  {
    vtkIdType ids[D + 1];
    if (view.IsGhost(c) && view.GetKind(c) == SimplexKind<D> && view.GetCorners(c, D + 1, ids))
    {
      for (vtkIdType p : ids)
      {
        // Values at the nodes of the mesh have been set, from the same arrays.
        if (!model.Mesh.isPointAlive(static_cast<meshopt::Index>(p)))
        {
          model.Metric.setSample(
            static_cast<meshopt::Index>(p), ReadSample<D>(sizes, tensors, p, model.Frame));
        }
      }
    }
  }
}

template <int D>
std::string CheckCount(const Request& request, const Model<D>& model)
{
  const bool hasSizes = request.Options.desiredSize > 0.0 || model.Metric.hasSizes();
  // Only the fast engine has a size stage, which makes as many elements as are predicted.
  if (!request.UsesSizes() || !hasSizes ||
    request.Options.algorithm != meshopt::Algorithm::WorstFirst)
  {
    return {};
  }
  const double count = model.Metric.predictedNumberOfElements(model.Mesh);
  if (count <= MostElements)
  {
    return {};
  }
  std::ostringstream text;
  text << "The wanted sizes need about " << count
       << " elements; the limit is 1e8. Is the size in the units of the coordinates, or, "
          "with a metric, of the metric?";
  return text.str();
}

//------------------------------------------------------------------------------
/**
 * More than one sentence may apply; each says what the user can do.
 */
std::string DescribeSizes(const meshopt::Report& report, const Request& request)
{
  const meshopt::SizeReport& sizes = report.sizes;
  std::ostringstream text;
  text.precision(3);
  if (sizes.isGivenUp)
  {
    text << "The wanted sizes were given up: with them the worst quality would be "
         << sizes.worstWithSizes << ", which is lower than before (" << report.worstBefore
         << ") and lower than the target (" << request.Options.targetQuality
         << "). Choose a lower target to get the sizes. ";
  }
  if (sizes.cellsAtBrake > 0)
  {
    text << "Splitting of edges was stopped at " << sizes.cellsAtBrake << " elements; "
         << static_cast<long>(std::round(sizes.predictedCells))
         << " were predicted. The sizes, or the directions of the metric, change faster from point "
            "to point than elements can follow. Give them on a finer mesh, or smoother (Gradation "
            "and Maximum "
            "Anisotropy of Solution Metric). ";
  }
  if (sizes.longestKept > LongEdge)
  {
    text << "Kept edges are up to " << sizes.longestKept
         << " times as long as wanted, and elements beside them can only approach the wanted size."
         << (request.Slide ? "" : " Set the boundary mode to Slide to have the boundary divided.");
  }
  // Each sentence ends with a blank, for one that may follow.
  std::string result = text.str();
  result.erase(result.find_last_not_of(' ') + 1);
  return result;
}

std::string DescribeArea(double before, double after, const Request& request)
{
  const double change = after / before - 1.0;
  // Straight lines keep their corners, and the area with them.
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

template std::string SetMetric<2>(const Request&, Model<2>&);
template std::string SetMetric<3>(const Request&, Model<3>&);
template void SetMetricOfGhosts<2>(const Request&, Model<2>&);
template void SetMetricOfGhosts<3>(const Request&, Model<3>&);
template std::string CheckCount<2>(const Request&, const Model<2>&);
template std::string CheckCount<3>(const Request&, const Model<3>&);

} // namespace vtkMeshOptimizeBridge
