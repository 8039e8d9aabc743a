// SPDX-License-Identifier: BSD-3-Clause
// Where the cost model rules and where not, the cells and nodes that it is told, and the
// look-aheads of polishing.
#include "WorstFirst/Allowance.h"
#include "EngineBench.h"

using namespace meshopt;
using worstfirst::Allowance;
using worstfirst::CostModel;
using worstfirst::Phase;
using worstfirst::Task;

namespace
{
constexpr double Any = std::numeric_limits<double>::infinity();

Options inMetric()
{
  Options options;
  options.beta = 0.5;
  options.desiredSize = 0.1;
  return options;
}

/// With a bound that is not that of the mesh.
Options boundBy(double quality)
{
  Options options;
  options.mostQuality = quality;
  return options;
}

template <int D>
Task task(const EngineBench<D>& bench, Phase phase, double target, long moreThanFew)
{
  Task result{ phase, target, target, 1e-3 };
  result.below = bench.workpiece.fewCells() + moreThanFew;
  return result;
}
}

TEST(Allowance, IsWhatTheCostModelSaysOfCellsAndFreeNodes)
{
  MeshInput<3> in = jitteredGrid<3>(8, 0.0);                      // 7^3 nodes inside
  in.points.insert(in.points.end(), 1000, Vec<3>::Constant(0.5)); // no cell uses them
  in.fixedPoints.assign(in.points.size(), 0);
  Index fixed = 0;
  while (!buildMesh(in).isFree(fixed))
  {
    ++fixed;
  }
  in.fixedPoints[fixed] = 1;
  for (const Effort effort : { Effort::Quick, Effort::Default, Effort::Best })
  {
    EngineBench<3> bench(in, upTo(0.6, effort));
    CostModel costs(effort);
    costs.open(6 * 8 * 8 * 8, 7 * 7 * 7 - 1);
    Allowance<3, MeanEdgeShape<3>>& allowance = bench.allowance;
    EXPECT_EQ(allowance.evaluations(Phase::Lifting), costs.leftForPass());
    EXPECT_EQ(allowance.evaluations(Phase::Polishing), costs.leftForPolish());
    EXPECT_EQ(allowance.earned(Phase::Lifting, 3), 3 * costs.pricePerLifted());
    EXPECT_EQ(allowance.earned(Phase::Polishing, 3), 0.0);
    allowance.notePass(100000, 7);
    costs.notePass(100000, 7);
    allowance.notePolish(1000, 0.1);
    costs.notePolish(1000, 0.1);
    allowance.notePolish(1000, 0.1);
    costs.notePolish(1000, 0.1);
    EXPECT_EQ(allowance.evaluations(Phase::Lifting), costs.leftForPass());
    EXPECT_EQ(allowance.evaluations(Phase::Polishing), costs.leftForPolish());
    allowance.endLimits();
    EXPECT_EQ(allowance.evaluations(Phase::Lifting), Any);
    EXPECT_EQ(allowance.evaluations(Phase::Polishing), Any);
  }
}

TEST(Allowance, IsUnlimitedInAMetricAndWhereTheSurfaceSlides)
{
  const MeshInput<3> in = jitteredGrid<3>(3, 0.1);
  const StillSurface<3> judging(true), other(false);
  const EngineBench<3> kept(in, {}), metric(in, inMetric()), follows(in, {}, &other);
  const EngineBench<3> slides(in, {}, &judging);
  for (const Phase phase : { Phase::Lifting, Phase::Polishing })
  {
    EXPECT_LT(kept.allowance.evaluations(phase), Any);
    EXPECT_LT(follows.allowance.evaluations(phase), Any);
    EXPECT_EQ(metric.allowance.evaluations(phase), Any);
  }
  EXPECT_EQ(slides.allowance.evaluations(Phase::Lifting), Any);
}

TEST(Allowance, IsLimitedWhereARunOnASlidingSurfacePolishes)
{
  const StillSurface<3> judging(true);
  for (const Effort effort : { Effort::Quick, Effort::Default, Effort::Best })
  {
    EngineBench<3> bench(jitteredGrid<3>(3, 0.1), upTo(0.6, effort), &judging);
    Allowance<3, MeanEdgeShape<3>>& allowance = bench.allowance;
    ASSERT_TRUE(bench.run.polishesWidely);
    CostModel costs(effort);
    costs.open(6 * 3 * 3 * 3, 2 * 2 * 2);
    EXPECT_EQ(allowance.evaluations(Phase::Polishing),
      costs.leftForPolish(CostModel::PolishFactorOfSliding));
    bench.run.polishesWidely = false;
    EXPECT_EQ(allowance.evaluations(Phase::Polishing),
      costs.leftForPolish(CostModel::PolishFactorOfFew[static_cast<int>(effort)]));
    allowance.endLimits(); // past the target
    EXPECT_EQ(allowance.evaluations(Phase::Polishing), Any);
  }
}

TEST(Allowance, IsThriftyWhereManyCellsAreBadUpToTheTarget)
{
  const MeshInput<3> in = jitteredGrid<3>(3, 0.1);
  const StillSurface<3> judging(true), other(false);
  const EngineBench<3> kept(in, upTo(0.6)), metric(in, inMetric()), follows(in, {}, &other);
  EXPECT_EQ(kept.workpiece.fewCells(), 20); // of 162
  EXPECT_TRUE(kept.allowance.isThrifty(task(kept, Phase::Lifting, 0.6, 1)));
  EXPECT_TRUE(kept.allowance.isThrifty(task(kept, Phase::Lifting, 0.3, 1)));
  EXPECT_FALSE(kept.allowance.isThrifty(task(kept, Phase::Lifting, 0.3, 0)));
  EXPECT_FALSE(kept.allowance.isThrifty(task(kept, Phase::Lifting, 0.64, 1)));
  EXPECT_FALSE(kept.allowance.isThrifty(task(kept, Phase::Polishing, 0.6, 1)));
  EXPECT_TRUE(follows.allowance.isThrifty(task(follows, Phase::Lifting, 0.6, 1)));
  EXPECT_FALSE(metric.allowance.isThrifty(task(metric, Phase::Lifting, 0.6, 1)));
  // On a sliding surface they are more; and once edges are divided, only in a quick run.
  for (const Effort effort : { Effort::Quick, Effort::Default, Effort::Best })
  {
    EngineBench<3> slides(in, upTo(0.6, effort), &judging);
    Task many = task(slides, Phase::Lifting, 0.6, 1);
    EXPECT_FALSE(slides.allowance.isThrifty(many));
    many.below = worstfirst::FewCells + 1;
    EXPECT_TRUE(slides.allowance.isThrifty(many));
    slides.run.dividesEdges = true;
    EXPECT_EQ(slides.allowance.isThrifty(many), effort == Effort::Quick);
  }
}

TEST(Allowance, RemembersTriesInVainOnlyWhereItIsThrifty)
{
  EngineBench<2> bench(jitteredGrid<2>(10, 0.1), upTo(0.6));
  const Task few = task(bench, Phase::Lifting, 0.6, 0), many = task(bench, Phase::Lifting, 0.6, 1);
  EXPECT_EQ(bench.allowance.patience(many, CostModel::Look, 40), 40);
  bench.allowance.noteTries(CostModel::Look, 40, false); // a quarter of them the next time
  EXPECT_EQ(bench.allowance.patience(many, CostModel::Look, 40), 10);
  EXPECT_EQ(bench.allowance.patience(many, CostModel::Insertion, 40), 40);
  EXPECT_EQ(bench.allowance.patience(few, CostModel::Look, 40), 40);
  EXPECT_EQ(bench.allowance.patienceOfSliding(40), 10);
  bench.allowance.startStage(0.45); // half of them
  EXPECT_EQ(bench.allowance.patience(many, CostModel::Look, 40), 20);
  EXPECT_EQ(bench.allowance.patienceOfSliding(40), 20);
  bench.allowance.noteTries(CostModel::Look, 40, true);
  EXPECT_EQ(bench.allowance.patience(many, CostModel::Look, 40), 40);
}

TEST(Allowance, HasALookAheadForSoManyCells)
{
  EngineBench<2> bench(jitteredGrid<2>(50, 0.0), boundBy(0.9)); // 5000 cells, 66 look-aheads
  const long most = 5000 / worstfirst::CellsPerLook;
  ASSERT_EQ(most, 66);
  EXPECT_EQ(bench.allowance.looks(1), most);
  EXPECT_EQ(bench.allowance.looks(4), most / 4);
  bench.allowance.noteLooks(60);
  EXPECT_EQ(bench.allowance.looks(1), most - 60);
  EXPECT_EQ(bench.allowance.looks(4), 1);
  bench.allowance.noteLooks(5);
  EXPECT_TRUE(bench.allowance.hasLooks());
  bench.allowance.noteLooks(1);
  EXPECT_FALSE(bench.allowance.hasLooks());
  EXPECT_EQ(bench.allowance.looks(1), 1); // a chunk has always one
}

TEST(Allowance, LimitsLookAheadsWhereThereIsHope)
{
  constexpr long any = std::numeric_limits<long>::max();
  const MeshInput<2> in = jitteredGrid<2>(4, 0.0);
  const StillSurface<2> judging(true), other(false);
  EXPECT_EQ(EngineBench<2>(in, boundBy(0.9)).allowance.looks(1), worstfirst::FewestLooks);
  EXPECT_EQ(EngineBench<2>(in, boundBy(1.0)).allowance.looks(1), any);
  EXPECT_EQ(EngineBench<2>(in, {}, &other).allowance.looks(1), any);
  EXPECT_EQ(EngineBench<2>(in, {}, &judging).allowance.looks(1), worstfirst::FewestLooks);
}
