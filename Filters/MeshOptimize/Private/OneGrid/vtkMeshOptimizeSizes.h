// SPDX-License-Identifier: BSD-3-Clause
/**
 * The wanted sizes: which cannot be used, and a report about their result, in sentences.
 */
#ifndef vtkMeshOptimizeSizes_h
#define vtkMeshOptimizeSizes_h

#include "Grid/vtkMeshOptimizeModel.h"
#include "Request/vtkMeshOptimizeRequest.h"

#include <string>

namespace vtkMeshOptimizeBridge
{

/**
 * Passes sizes and metric at the points to the core: model.Metric. Returns an empty string, or a
 * sentence about the first unusable value with the name of its array.
 */
template <int D>
std::string SetMetric(const Request& request, Model<D>& model);

/**
 * The same at points that only ghost cells use: these cells are only measured. An unusable value is
 * no error there, but gives NaN.
 */
template <int D>
void SetMetricOfGhosts(const Request& request, Model<D>& model);

/**
 * A sentence if the predicted number of elements is too large.
 */
template <int D>
std::string CheckCount(const Request& request, const Model<D>& model);

/**
 * Information for the user: sizes given up, splitting stopped, kept edges that are far too long.
 */
std::string DescribeSizes(const meshopt::Report& report, const Request& request);

/**
 * A sentence if the area of a plane mesh whose boundary follows splines has changed by a tenth or
 * more.
 */
std::string DescribeArea(double before, double after, const Request& request);

} // namespace vtkMeshOptimizeBridge

#endif
