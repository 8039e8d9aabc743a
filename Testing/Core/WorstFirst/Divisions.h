// SPDX-License-Identifier: BSD-3-Clause
// One call that divides edges at bad cells of a sliding mesh, and what it has made.
#ifndef meshopt_Testing_Divisions_h
#define meshopt_Testing_Divisions_h

#include "Metric/NodalMetric.h"
#include "Run/Run.h"
#include "SlidingBoxes.h"

namespace meshopt
{
struct Division
{
  /// `divide`: long divide(Run<3>&). The growth is the number of cells that may come.
  template <class Divide>
  Division(Sliding& sliding, long growth, const Surface<3>* surface, const Options& given,
    const Divide& divide)
    : options(given)
    , clock(this->control)
  {
    computeQualities<3>(sliding.editor, this->metric, Measure::Shape, 0.0);
    this->before = sortedQualities(sliding.mesh);
    Run<3> run{ sliding.editor, this->metric, surface, this->options, this->control, this->clock,
      this->report };
    run.growth = growth;
    this->done = divide(run);
    expectSound(sliding.mesh);
  }

  NodalMetric<3> metric;
  Options options;
  Control control;
  Clock clock;
  Report report;
  std::vector<double> before; ///< qualities, ascending
  long done = 0;              ///< divisions
};
}

#endif
