// SPDX-License-Identifier: BSD-3-Clause
/// @file Options.h
/// The options of the optimizer: one plain struct.
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
  Quick = 0,   ///< up to the target, by single changes; look-ahead only for the few worst
  Default = 1, ///< up to the target, with look-ahead
  Best = 2     ///< past the target, with more look-ahead, until nothing lifts the worst cell
};
inline constexpr int NumberOfEfforts = 3; ///< of tables by effort

struct Options : Switches
{
  Algorithm algorithm = Algorithm::WorstFirst;
  Measure measure = Measure::Shape;
  /// Weight of the size factor of (2.2); 0: shape only.
  double beta = 0.0;
  /// h* of (2.2). Must be > 0 if beta > 0, unless sizes are given at the points.
  double desiredSize = 0.0;
  /// Stop once the worst quality is at least this. In ]0, 1].
  double targetQuality = 0.6;

  // --- the paper's parameters
  int neighborhoodLevel = 1;            ///< NL >= 0
  long maximumNumberOfIterations = 0;   ///< M, per repositioning; 0: no limit
  double epsilon = 0.02;                ///< (2.8)
  double armijo = 0.01;                 ///< alpha of (2.7)
  int maximumNumberOfAlternations = 20; ///< most rounds of reconnection + repositioning

  // --- the fast engine's
  Effort effort = Effort::Default;
  /// Greatest net growth of the number of cells, as a fraction. Small meshes may grow more: see
  /// growthOf().
  double growthBudget = 0.15;
  /// If not negative: the same as a number of cells, and how many cells may vanish. For a part of a
  /// mesh whose budget is that of the whole.
  long mostGrowth = -1, mostShrink = -1;
  /// If not negative: how far the best effort may go past the target, in place of the certified
  /// bound of this mesh. For a part of a mesh: its own surface includes borders to other parts.
  double mostQuality = -1.0;

  /// One sentence about the first unusable option and the reason; empty if all options are fine.
  std::string check(bool hasSizes) const;
};

/// The number of cells that a mesh of `cells` cells may gain (net): growthBudget as a count,
/// rounded down. At least 30 in 3D and 10 in 2D if growthBudget > 0, since in a small mesh the
/// fraction would not leave room for a single node.
long growthOf(const Options& options, long cells, int dimension);

/// The number of cells that a mesh of `cells` cells can gain until ids run out: half of those that
/// are left, since threads hold ids in reserve. Whatever the options say.
long roomToGrow(long cells);
}

#endif
