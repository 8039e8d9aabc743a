// SPDX-License-Identifier: BSD-3-Clause
// Checks options before a run, so that no later step has to doubt them.
#include "Run/Options.h"

#include "Mesh/Types.h"

#include <algorithm>
#include <cmath>

namespace meshopt
{
namespace
{
// Conditions are written as !(x >= 0), so that NaN is refused, too.
std::string checkQuality(const Options& o, bool hasSizes)
{
  // Enums come from callers as numbers (XML, Python): any number may arrive here.
  if (!isMeasure(static_cast<int>(o.measure)))
  {
    return "The quality measure is none of the known ones.";
  }
  if (!infoOf(o.measure).isOptimizable)
  {
    return std::string(infoOf(o.measure).name) +
      " is a measure to report, not to optimize; choose another quality measure.";
  }
  if (!(o.beta >= 0.0) || !std::isfinite(o.beta))
  {
    return "beta must be a number >= 0.";
  }
  if (!(o.desiredSize >= 0.0) || !std::isfinite(o.desiredSize))
  {
    return "The desired size h* must be a number >= 0.";
  }
  // The size factor compares with h*: without one there is nothing to compare with.
  if (o.beta > 0.0 && o.desiredSize == 0.0 && !hasSizes)
  {
    return "With beta > 0 a desired size h* > 0 is needed, or sizes at the points.";
  }
  // With a target of 0, cells without volume would be good enough.
  if (!(o.targetQuality > 0.0 && o.targetQuality <= 1.0))
  {
    return "The target quality must be in ]0, 1].";
  }
  return {};
}

/// Parameters of the paper's algorithms, by the names that they have in the paper.
std::string checkPaper(const Options& o)
{
  if (o.neighborhoodLevel < 0)
  {
    return "The neighborhood level NL must be >= 0.";
  }
  if (o.maximumNumberOfIterations < 0)
  {
    return "The maximum number of iterations M must be >= 0 (0: no limit).";
  }
  // With 0 the active set would be the worst cell alone, and the descent would zigzag between it
  // and the next one.
  if (!(o.epsilon > 0.0 && o.epsilon <= 1.0))
  {
    return "epsilon of the active set must be in ]0, 1].";
  }
  // From 1 on no step along a curved function would be accepted.
  if (!(o.armijo > 0.0 && o.armijo < 1.0))
  {
    return "alpha of Armijo's rule must be in ]0, 1[.";
  }
  if (o.maximumNumberOfAlternations < 1)
  {
    return "The maximum number of alternations must be >= 1.";
  }
  return {};
}

std::string checkEngine(const Options& o)
{
  const int effort = static_cast<int>(o.effort);
  if (effort < 0 || effort > static_cast<int>(Effort::Best))
  {
    return "The effort is none of the known ones.";
  }
  if (!(o.growthBudget >= 0.0) || !std::isfinite(o.growthBudget))
  {
    return "The growth budget must be a number >= 0.";
  }
  return {};
}
}

std::string Options::check(bool hasSizes) const
{
  if (this->algorithm != Algorithm::Paper1996 && this->algorithm != Algorithm::WorstFirst)
  {
    return "The algorithm is none of the known ones.";
  }
  // One sentence, the first that applies: all three parts are checked whatever the algorithm.
  std::string error = checkQuality(*this, hasSizes);
  if (error.empty())
  {
    error = checkPaper(*this);
  }
  return error.empty() ? checkEngine(*this) : error;
}

long growthOf(const Options& options, long cells, int dimension)
{
  // Parts of a mesh share the budget of the whole. The least below is for whole meshes: here it
  // would come once for each part.
  if (options.mostGrowth >= 0)
  {
    return options.mostGrowth;
  }
  // Room for a few nodes: a fraction of a small mesh may be less than what one node brings.
  const long least = dimension == 3 ? 30 : 10;
  const double most = std::floor(options.growthBudget * static_cast<double>(cells));
  return options.growthBudget > 0.0 ? std::max(least, static_cast<long>(most)) : 0;
}

long roomToGrow(long cells) { return std::max(0L, (MaximumNumberOfCells - cells) / 2); }
}
