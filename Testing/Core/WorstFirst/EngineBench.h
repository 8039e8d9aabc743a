// SPDX-License-Identifier: BSD-3-Clause
// All parts of the fast engine on one mesh, put together as a schedule does it, for tests of each.
#ifndef meshopt_Testing_EngineBench_h
#define meshopt_Testing_EngineBench_h

#include "Quality/Shape.h"
#include "StillSurface.h"
#include "TestMeshes.h"
#include "WorstFirst/Polish.h"

namespace meshopt
{
inline Options upTo(double target, Effort effort = Effort::Default)
{
  Options options;
  options.targetQuality = target;
  options.effort = effort;
  return options;
}

/// No operation is on: each try fails, and costs nothing. What is tried, and at which level, shows
/// in the cells: see triedAt().
inline Options frozen(Options options)
{
  options.moveNodes = options.reconnect = options.insertNodes = options.removeNodes = false;
  options.lookAhead = false;
  return options;
}

/// Its time begins at 1: the engine takes a failure at time 0 for none.
template <int D>
struct EngineBench
{
  using Shape = MeanEdgeShape<D>;

  EngineBench(const MeshInput<D>& in, const Options& wanted, const Surface<D>* surface = nullptr)
    : options(wanted)
    , clock(this->control)
    , mesh(buildMesh(in))
    , editor(this->mesh)
    , metric(wanted.desiredSize)
    , run(this->start(surface))
    , workpiece(this->run, {})
    , budget(this->options, this->run.growth, this->mesh.countCells(),
        this->workpiece.widthInEdges(), !this->workpiece.model().plain)
    , allowance(this->workpiece)
    , reporter(this->workpiece, 0.0)
    , pass(this->workpiece, this->allowance, this->budget, this->reporter)
    , stage(this->workpiece, this->allowance, this->pass)
    , polish(this->workpiece, this->allowance, this->budget, this->pass, this->stage)
  {
  }
  EngineBench(const EngineBench&) = delete;
  EngineBench& operator=(const EngineBench&) = delete;

  /// The level of the last failed try at a cell, by worstfirst::rankOf(); None if there was none.
  int triedAt(Index c) const
  {
    const auto& data = this->mesh.cellData(c);
    return data.stamp > 0 ? data.level : None;
  }
  /// The live cells under a quality, the worst first.
  std::vector<Index> cellsUnder(double quality) const
  {
    std::vector<std::pair<double, Index>> bad;
    for (Index c = 0; c < this->mesh.numberOfCellSlots(); ++c)
    {
      if (this->mesh.isAlive(c) && this->mesh.quality(c) < quality)
      {
        bad.emplace_back(this->mesh.quality(c), c);
      }
    }
    std::sort(bad.begin(), bad.end());
    std::vector<Index> cells;
    std::transform(bad.begin(), bad.end(), std::back_inserter(cells),
      [](const std::pair<double, Index>& entry) { return entry.second; });
    return cells;
  }
  /// The live cells with a failed try, the worst first.
  std::vector<Index> triedCells() const
  {
    std::vector<Index> cells = this->cellsUnder(std::numeric_limits<double>::infinity());
    cells.erase(std::remove_if(
                  cells.begin(), cells.end(), [this](Index c) { return this->triedAt(c) == None; }),
      cells.end());
    return cells;
  }
  /// How many cells may still come, by lifting.
  long growthLeft() const { return this->budget.share(worstfirst::Phase::Lifting, 1).left; }
  /// Rows of the history beside that of the input.
  std::size_t rows() const { return this->report.history.size() - 1; }

  Options options;
  Control control;
  Clock clock;
  SimplexMesh<D> mesh;
  MeshEditor<D> editor;
  NodalMetric<D> metric;
  Report report;
  Run<D> run;
  worstfirst::Workpiece<D, Shape> workpiece;
  worstfirst::GrowthBudget budget;
  worstfirst::Allowance<D, Shape> allowance;
  worstfirst::Reporter<D, Shape> reporter;
  worstfirst::Pass<D, Shape> pass;
  worstfirst::Stage<D, Shape> stage;
  worstfirst::Polish<D, Shape> polish;

private:
  Run<D> start(const Surface<D>* surface)
  {
    computeQualities<D>(this->editor, this->metric, Measure::Shape, this->options.beta);
    this->editor.setClock(1);
    Run<D> result{ this->editor, this->metric, surface, this->options, this->control, this->clock,
      this->report };
    result.growth = growthOf(this->options, this->mesh.countCells(), D);
    result.record("input");
    summarize(this->mesh, 0.0, &this->report.invertedBefore);
    return result;
  }
};
}

#endif
