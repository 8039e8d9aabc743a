// SPDX-License-Identifier: BSD-3-Clause
/**
 * The wanted sizes: what cannot be asked for, and what became of them, in sentences.
 */
#ifndef vtkMeshOptimizeSizes_h
#define vtkMeshOptimizeSizes_h

#include "vtkMeshOptimizeModel.h"
#include "vtkMeshOptimizeRequest.h"

#include <string>

namespace vtkMeshOptimizeBridge
{

/**
 * Hands sizes and metric at the points over to the core: model.Metric. Returns a sentence about the
 * first value that cannot be used, with the name of its array, or an empty string.
 */
template <int D>
std::string SetMetric(const Request& request, Model<D>& model);

/**
 * The same at points that only ghost cells have: these are measured, too, and no more than that.
 * A value that cannot be used is no error, but NaN.
 */
template <int D>
void SetMetricOfGhosts(const Request& request, Model<D>& model);

/**
 * A sentence if the sizes stand for more elements than can be made.
 */
template <int D>
std::string CheckCount(const Request& request, const Model<D>& model);

/**
 * What the user should know: sizes given up, splitting stopped, kept edges that are far too long.
 */
std::string DescribeSizes(const meshopt::Report& report, const Request& request);

/**
 * A sentence if a plane mesh whose boundary follows splines has another area than before, by a
 * tenth or more.
 */
std::string DescribeArea(double before, double after, const Request& request);

} // namespace vtkMeshOptimizeBridge

#endif
