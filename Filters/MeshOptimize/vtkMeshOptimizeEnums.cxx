// SPDX-License-Identifier: BSD-3-Clause
// The enums of the filters have the same numbers as the core's: values are cast between them.
#include "vtkMeshOptimizeFilter.h"
#include "vtkSolutionMetricFilter.h"

#include "Metric/SolutionMetric.h"
#include "Run/Options.h"
#include "Run/Report.h"

// At compile time, so that a number that is changed on one side cannot go unseen. (Those of the
// measures are compared by TestXMLAgainstClasses, so that a new one needs nothing here.)
namespace
{

template <class Theirs>
constexpr bool Same(int mine, Theirs theirs)
{
  return mine == static_cast<int>(theirs);
}

using Optimize = vtkMeshOptimizeFilter;
using meshopt::Algorithm;
using meshopt::Effort;
using meshopt::Recovery;
using meshopt::StopReason;

static_assert(Same(Optimize::Paper1996, Algorithm::Paper1996));
static_assert(Same(Optimize::WorstFirst, Algorithm::WorstFirst));

static_assert(Same(Optimize::Quick, Effort::Quick));
static_assert(Same(Optimize::Default, Effort::Default));
static_assert(Same(Optimize::Best, Effort::Best));

static_assert(Same(Optimize::NotRun, StopReason::NotRun));
static_assert(Same(Optimize::TargetReached, StopReason::TargetReached));
static_assert(Same(Optimize::CappedBySurface, StopReason::CappedBySurface));
static_assert(Same(Optimize::NoFurtherGain, StopReason::NoFurtherGain));
static_assert(Same(Optimize::IterationLimit, StopReason::IterationLimit));
static_assert(Same(Optimize::TimeLimitReached, StopReason::TimeLimit));
static_assert(Same(Optimize::Aborted, StopReason::Aborted));
static_assert(Same(Optimize::NothingToDo, StopReason::NothingToDo));
static_assert(Same(Optimize::GrowthLimit, StopReason::GrowthLimit));

static_assert(Same(vtkSolutionMetricFilter::LumpedMass, Recovery::LumpedMass));
static_assert(Same(vtkSolutionMetricFilter::LeastSquares, Recovery::LeastSquares));

} // namespace
