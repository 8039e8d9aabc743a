// SPDX-License-Identifier: BSD-3-Clause
/// @file Options.h
/// The one plain struct at the door of the optimizer.
#ifndef meshopt_Run_Options_h
#define meshopt_Run_Options_h

#include "Edit/Switches.h"
#include "Quality/Measure.h"

#include <string>

namespace meshopt
{
enum class Algorithm
{
  Paper1996 = 0, ///< the algorithm of the paper, step by step
  WorstFirst = 1 ///< the fast engine
};

enum class Effort
{
  Quick = 0,   ///< up to the target, by single changes; look-ahead only for the very worst cells
  Default = 1, ///< up to the target, with look-ahead
  Best = 2     ///< past the target, with more look-ahead, until nothing lifts the worst cell
};

struct Options : Switches
{
  Algorithm algorithm = Algorithm::WorstFirst;
  Measure measure = Measure::Shape;
  /// Weight of the size factor of (2.2); 0: shape only.
  double beta = 0.0;
  /// h* of (2.2), > 0 where beta > 0 unless a size is given at the points.
  double desiredSize = 0.0;
  /// Stop once the worst quality is at least this. In ]0, 1].
  double targetQuality = 0.6;

  // --- the paper's parameters
  int neighborhoodLevel = 1;            ///< NL >= 0
  long maximumNumberOfIterations = 0;   ///< M, per repositioning; 0: no limit
  double epsilon = 0.02;                ///< (2.8)
  double armijo = 0.01;                 ///< alpha of (2.7)
  int maximumNumberOfAlternations = 20; ///< reconnection, then repositioning; at most so often
  bool naiveSearch = false; ///< rescan for the worst cell instead of the heap; same result (tests)

  // --- the fast engine's
  Effort effort = Effort::Default;
  /// Greatest net growth of the number of cells, as a fraction; growthOf() for small meshes.
  double growthBudget = 0.15;
  double timeLimit = 0.0; ///< seconds, 0: none. Results are then not reproducible.

  /// A sentence that says which option is unusable and why; empty if all are fine.
  std::string check(bool hasSizes) const;
};

/// So many cells may come to so many. In a mesh of a few a fraction of them is not even room for one
/// node: it may have some.
long growthOf(const Options& options, long cells, int dimension);
}

#endif
