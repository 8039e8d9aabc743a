// SPDX-License-Identifier: BSD-3-Clause
// What a worker tries, at which level, when it gives up, and what it remembers. Mostly no operation
// is on: each try then fails, and the levels stand in the cells.
#include "WorstFirst/Worker.h"
#include "EngineBench.h"
#include "PlaneMeshes.h"

using namespace meshopt;
using namespace meshopt::worstfirst;

namespace
{
constexpr long Any = std::numeric_limits<long>::max();
constexpr double AnyCost = std::numeric_limits<double>::infinity();
constexpr auto Inserts = static_cast<int>(meshopt::Operation::NodeInsertion);
constexpr auto Looks = static_cast<int>(meshopt::Operation::LookAhead);

/// One worker for the whole mesh. Its orders forbid nothing until a test says so.
template <int D>
struct WorkerBench : EngineBench<D>
{
  WorkerBench(const MeshInput<D>& in, const Options& wanted, const Surface<D>* surface = nullptr)
    : EngineBench<D>(in, wanted, surface)
    , worker(this->workpiece, this->allowance, this->failures)
  {
    this->orders = { Growth(), -1.0, false, None, None, Any, Any, AnyCost };
  }
  /// `below`: how many cells are said to be bad.
  void begin(Phase phase, double target, int level, long below)
  {
    this->task = { phase, target, target, 1e-3, level, 0, below };
    this->worker.begin(this->task, this->orders);
  }
  void give(const std::vector<Index>& cells)
  {
    for (Index c : cells)
    {
      this->worker.queue.emplace(this->mesh.quality(c), c);
    }
    this->worker.given = static_cast<long>(cells.size());
  }
  /// The `n` worst cells.
  std::vector<Index> worst(std::size_t n) const
  {
    std::vector<Index> cells = this->cellsUnder(2.0);
    EXPECT_GE(cells.size(), n);
    cells.resize(n);
    return cells;
  }

  FailureMemory failures;
  Orders orders{};
  Task task{};
  Worker<D, MeanEdgeShape<D>> worker;
};

/// 338 cells, of which 20 are few. No operation is on.
struct Frozen : WorkerBench<2>
{
  Frozen()
    : WorkerBench<2>(jitteredGrid<2>(13, 0.2), frozen(upTo(0.6)))
  {
  }
};

/// A square around a node that is close to one side: only the cell there is under .6. With the node
/// in the middle all four have .866.
MeshInput<2> squareWithNodeAtSide()
{
  return fan({ { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } }, { 0.5, 0.05 });
}
}

TEST(Worker, TriesTheWorstFirstAndSoManyAtOnce)
{
  for (const int level : { Level::LookAhead, Level::LongLookAhead })
  {
    Frozen bench;
    bench.begin(Phase::Polishing, 0.9, level, 300);
    bench.give(bench.worst(300));
    std::size_t tried = 0;
    while (tried < 300)
    {
      bench.worker.work();
      tried = std::min<std::size_t>(300, tried + Tries[level]);
      EXPECT_EQ(bench.triedCells(), bench.worst(tried));
      EXPECT_EQ(bench.worker.queue.size(), 300 - tried);
      EXPECT_EQ(bench.worker.tally().tries, static_cast<long>(tried));
    }
    EXPECT_EQ(bench.worker.tally().accepted, 0);
    EXPECT_EQ(bench.worker.tally().evaluations, 0);
  }
}

TEST(Worker, FailuresAreStampedWithTimeAndLevel)
{
  for (const Phase phase : { Phase::Lifting, Phase::Polishing })
  {
    for (int level = 0; level < Level::Count; ++level)
    {
      Frozen bench;
      bench.worker.editor.setClock(17);
      bench.begin(phase, 0.6, level, 1);
      bench.give({ 5 });
      bench.worker.work();
      EXPECT_EQ(bench.triedCells(), std::vector<Index>{ 5 });
      EXPECT_EQ(bench.triedAt(5), rankOf(phase, level));
      EXPECT_EQ(bench.mesh.cellData(5).stamp, 17u);
    }
  }
}

TEST(Worker, WhatNeedsNoTryIsSkipped)
{
  Frozen bench;
  bench.editor.growCells(1);
  const Index dead = bench.mesh.numberOfCellSlots() - 1;
  bench.editor.setFailed(1, 1, Level::Removal);
  bench.editor.setFailed(2, 1, Level::Topology);
  bench.editor.setFailed(300, 1, Level::Removal);
  bench.editor.stamp({ 300 }); // something has changed around it
  bench.begin(Phase::Lifting, 0.6, Level::Removal, 1);
  bench.give({ 1, 2, 3, 300, dead });
  bench.worker.queue.emplace(bench.mesh.quality(4) - 0.1, 4); // what it was once
  bench.worker.work();
  EXPECT_EQ(bench.worker.tally().tries, 3);
  EXPECT_EQ(bench.triedAt(2), Level::Removal);
  EXPECT_EQ(bench.triedAt(3), Level::Removal);
  EXPECT_EQ(bench.triedAt(4), None);
  EXPECT_TRUE(bench.worker.queue.empty());
}

TEST(Worker, TriesAboveTheCheapLevelsAreLimited)
{
  for (const int level : { Level::Topology, Level::Removal, Level::LookAhead })
  {
    Frozen bench;
    bench.orders.tries = 30;
    bench.begin(Phase::Lifting, 0.6, level, 20);
    const std::vector<Index> cells = bench.worst(50);
    bench.give(cells);
    bench.worker.work();
    for (std::size_t k = 0; k < cells.size(); ++k)
    {
      EXPECT_EQ(bench.triedAt(cells[k]), k < 30 ? level : std::min<int>(level, Level::Removal));
    }
  }
}

TEST(Worker, SoAreLookAheads)
{
  Frozen bench;
  bench.orders.looks = 3;
  bench.worker.judge().tried[Looks] = 2;
  bench.begin(Phase::Polishing, 0.6, Level::LongLookAhead, 2);
  bench.give({ 0 });
  bench.worker.work();
  EXPECT_EQ(bench.triedAt(0), rankOf(Phase::Polishing, Level::LongLookAhead));
  bench.worker.judge().tried[Looks] = 3;
  bench.give({ 1 });
  bench.worker.work();
  EXPECT_EQ(bench.triedAt(1), rankOf(Phase::Polishing, Level::Removal));
}

namespace
{
/// Whether a level is given up after `tried` tries of its operation, of which `gained` helped.
struct Patient
{
  int level;
  double target;
  long below, given, tried, gained;
  bool isGivenUp;
};

template <int D>
void expectPatience(const std::vector<Patient>& cases, const Options& options,
  const Surface<D>* surface, long vainLooks = 0)
{
  for (const Patient& p : cases)
  {
    WorkerBench<D> bench(jitteredGrid<D>(4, 0.1), frozen(options), surface);
    bench.allowance.noteTries(CostModel::Look, vainLooks, false);
    const int op = p.level == Level::Insertion ? Inserts : Looks;
    bench.worker.judge().tried[op] = p.tried;
    bench.worker.judge().gained[op] = p.gained;
    bench.begin(Phase::Lifting, p.target, p.level, p.below);
    bench.give({ 0 });
    bench.worker.given = p.given;
    bench.worker.work();
    EXPECT_EQ(bench.triedAt(0), p.isGivenUp ? Level::Removal : p.level)
      << p.level << ": " << p.gained << " of " << p.tried << " for " << p.below;
  }
}

constexpr int I = Level::Insertion, L = Level::LookAhead;
}

TEST(Worker, PatienceEndsWhereHardlyAnyTryHelps)
{
  expectPatience<2>(
    {
      { I, 0.45, 20, 1, PatientTries - 1, 0, false },
      { I, 0.45, 20, 1, PatientTries, 0, true },
      { I, 0.45, 20, 1, PatientTries, PatientTries / Patience, false },
      { I, 0.45, 20, 1, PatientTries, PatientTries / Patience - 1, true },
      // where many are bad: after a part of them; in the first stage after all
      { I, 0.45, 2000, 2000, 2000 / PatientPart - 1, 0, false },
      { I, 0.45, 2000, 2000, 2000 / PatientPart, 0, true },
      { I, 0.30, 2000, 2000, 2000 - 1, 0, false },
      { I, 0.30, 2000, 2000, 2000, 0, true },
      // look-ahead: by how many are bad
      { L, 0.45, 20, 1, PatientTries - 1, 0, false },
      { L, 0.45, 20, 1, PatientTries, 0, true },
      { L, 0.45, 21, 1, PatientLooks - 1, 0, false },
      { L, 0.45, 21, 1, PatientLooks, 0, true },
      { L, 0.45, 21, 1, PatientLooks, PatientLooks / Patience, false },
    },
    upTo(0.6), nullptr);
}

TEST(Worker, PatienceIsLessAfterTriesInVain)
{
  expectPatience<2>(
    {
      { L, 0.45, 21, 1, PatientLooks / 4 - 1, 0, false },
      { L, 0.45, 21, 1, PatientLooks / 4, 0, true },
      { L, 0.45, 20, 1, PatientTries - 1, 0, false }, // few cells are always worth it
    },
    upTo(0.6), nullptr, PatientLooks);
}

/// Other operations of a level help more often there. Here none has.
TEST(Worker, PatienceInAMetricAndWhereTheSurfaceSlides)
{
  Options metric;
  metric.beta = 0.5;
  metric.desiredSize = 0.1;
  expectPatience<2>(
    {
      { L, 0.45, 2000, 1, PatientTries / Hurry - 1, 0, false },
      { L, 0.45, 2000, 1, PatientTries / Hurry, 0, true },
      { L, 0.45, 2000, 1, PatientTries / Hurry, PatientTries, true },
    },
    metric, nullptr);
  const StillSurface<3> judging(true);
  expectPatience<3>(
    {
      { L, 0.45, 2000, 1, PatientTries - 1, 0, false },
      { L, 0.45, 2000, 1, PatientTries, PatientTries, true },
    },
    {}, &judging);
}

TEST(Worker, WhereTheSurfaceSlidesLookAheadAloneIsGivenUp)
{
  const StillSurface<3> judging(true);
  for (const StillSurface<3>* surface : { &judging, static_cast<const StillSurface<3>*>(nullptr) })
  {
    for (const Phase phase : { Phase::Lifting, Phase::Polishing })
    {
      const auto looks = [&](long tried, long gained)
      {
        WorkerBench<3> bench(jitteredGrid<3>(2, 0.1), frozen(upTo(0.6)), surface);
        bench.worker.judge().tried[Looks] = tried;
        bench.worker.judge().gained[Looks] = gained;
        bench.begin(phase, 0.6, Level::LookAhead, 1);
        bench.give({ 0 });
        bench.worker.work();
        EXPECT_EQ(bench.triedAt(0), rankOf(phase, Level::LookAhead));
        return bench.worker.judge().looksAhead();
      };
      const bool isLimited = surface && phase == Phase::Lifting;
      EXPECT_TRUE(looks(PatientLooksOfSliding - 1, 0));
      EXPECT_EQ(looks(PatientLooksOfSliding, 0), !isLimited);
      EXPECT_TRUE(looks(PatientLooksOfSliding, PatientLooksOfSliding / Patience));
    }
  }
}

TEST(Worker, PolishingEndsAfterSoManyTriesForEachCell)
{
  for (const double beta : { 0.0, 0.5 }) // not in a metric
  {
    Options options = frozen(upTo(0.6));
    options.beta = beta;
    options.desiredSize = 0.1;
    WorkerBench<2> bench(jitteredGrid<2>(13, 0.2), options);
    bench.begin(Phase::Polishing, 0.6, Level::LongLookAhead, 300);
    bench.give(bench.worst(300));
    bench.worker.given = 2;
    for (int k = 0; k < 300 / Tries[Level::LongLookAhead]; ++k)
    {
      bench.worker.work();
    }
    EXPECT_TRUE(bench.worker.queue.empty());
    EXPECT_EQ(bench.worker.tally().tries, beta > 0.0 ? 300 : 2 * MostPolishTries);
  }
}

TEST(Worker, CreepsIfManyTriesLiftFew)
{
  const auto creeps = [](Phase phase, std::size_t tries, long given, long below)
  {
    Frozen bench;
    bench.begin(phase, 0.6, Level::Topology, below);
    bench.give(bench.worst(tries));
    bench.worker.given = given;
    bench.worker.work();
    EXPECT_EQ(bench.worker.tally().tries, static_cast<long>(tries));
    return bench.worker.tally().creeps;
  };
  EXPECT_FALSE(creeps(Phase::Lifting, CreepingTries - 1, 1000, 21));
  EXPECT_FALSE(creeps(Phase::Lifting, CreepingTries, 300, 21)); // a window is half of them
  EXPECT_FALSE(creeps(Phase::Lifting, 149, 300, 21));
  EXPECT_TRUE(creeps(Phase::Lifting, 150, 300, 21));
  EXPECT_TRUE(creeps(Phase::Lifting, CreepingTries, 100, 21));
  EXPECT_FALSE(creeps(Phase::Lifting, 300, 100, 20)); // few are worth it
  EXPECT_FALSE(creeps(Phase::Polishing, 15, 1, 21));
}

/// After many tries for each cell nodes only creep: changes must gain more then.
TEST(Worker, DemandsMoreAfterManyTries)
{
  for (const long tries : { Creeping, Creeping + 1 })
  {
    Frozen bench;
    bench.begin(Phase::Lifting, 0.6, Level::Topology, 1);
    bench.give(bench.worst(tries));
    bench.worker.given = 1;
    bench.worker.work();
    EXPECT_FALSE(bench.worker.tally().creeps);
    EXPECT_EQ(bench.worker.judge().demand().gain, tries > Creeping ? CoarseGain : 1e-3);
    EXPECT_EQ(bench.worker.usualDemand().gain, 1e-3);
  }
}

TEST(Worker, OrdersReachTheJudge)
{
  Frozen bench;
  bench.orders.growth.left = 12;
  bench.orders.guard = 0.3;
  bench.orders.guardsAll = true;
  bench.orders.wide = 7;
  const auto& judge = bench.worker.judge();
  for (const long below : { 20L, 21L }) // few; many: the cost model rules
  {
    bench.begin(Phase::Lifting, 0.6, Level::Topology, below);
    const bool isThrifty = below > 20;
    const Demand expected{ isThrifty ? ThriftyGain : 1e-3, isThrifty ? ThriftySteps : StarSteps,
      0.3, true };
    EXPECT_TRUE(judge.demand() == expected);
    EXPECT_TRUE(bench.worker.usualDemand() == expected);
    EXPECT_EQ(judge.isThorough(), !isThrifty);
    EXPECT_EQ(judge.growth.left, 12);
    EXPECT_EQ(judge.wide(), 7);
  }
  bench.begin(Phase::Polishing, 0.6, Level::Topology, 1);
  EXPECT_FALSE(judge.isThorough());
}

TEST(Worker, ForTheWorstCellMoreNodesMayVanishAndMorePlacesAreTried)
{
  Frozen bench;
  bench.orders.wide = 7;
  bench.orders.wideOfWorst = 9;
  const std::vector<Index> cells = bench.worst(2);
  ASSERT_LT(bench.mesh.quality(cells[0]), bench.mesh.quality(cells[1]));
  for (const std::size_t k : { 0, 1 })
  {
    bench.begin(Phase::Polishing, 0.6, Level::Topology, 1);
    bench.give({ cells[k] });
    bench.worker.work();
    EXPECT_EQ(bench.worker.judge().wide(), k == 0 ? 9 : 7);
    EXPECT_EQ(bench.worker.judge().isWidePatient(), k == 0);
  }
}

TEST(Worker, WhatWasInVainForTheWorstCellIsNotTriedAgainWhileItStays)
{
  Frozen bench;
  bench.orders.wide = bench.orders.wideOfWorst = 9;
  const std::vector<Index> cells = bench.worst(2);
  const auto isPatient = [&](Index c)
  {
    bench.begin(Phase::Polishing, 0.6, Level::Topology, 1);
    bench.give({ c });
    bench.worker.work();
    return bench.worker.judge().isWidePatient();
  };
  const Known none(None, 0.0), failed(cells[0], bench.mesh.quality(cells[0]));
  EXPECT_FALSE(isPatient(cells[1]));
  EXPECT_EQ(bench.worker.tally().inVain, none);
  EXPECT_TRUE(isPatient(cells[0]));
  EXPECT_EQ(bench.worker.tally().inVain, failed);
  bench.orders.inVain = failed;
  EXPECT_FALSE(isPatient(cells[0]));
  EXPECT_EQ(bench.worker.tally().inVain, none);
  bench.orders.inVain.second *= 0.9; // it has become better since then
  EXPECT_TRUE(isPatient(cells[0]));
}

/// Each try on a regular grid costs evaluations and fails.
TEST(Worker, StopsWhenAllIsSpent)
{
  for (const double most : { -1.0, 0.0, AnyCost })
  {
    Options options = upTo(0.9);
    options.insertNodes = options.removeNodes = options.lookAhead = false;
    WorkerBench<2> bench(jitteredGrid<2>(6, 0.0), options);
    bench.orders.evaluations = most;
    bench.begin(Phase::Lifting, 0.9, Level::Topology, 1);
    bench.give(bench.worst(72));
    bench.worker.work();
    const Tally& tally = bench.worker.tally();
    EXPECT_EQ(tally.accepted, 0);
    EXPECT_TRUE(bench.worker.queue.empty());
    EXPECT_EQ(tally.tries, most < 0.0 ? 0 : most > 0.0 ? 72 : 1);
    EXPECT_EQ(tally.evaluations > 0, most >= 0.0);
  }
}

TEST(Worker, WhatIsLiftedPaysForMore)
{
  MeshInput<2> in = squareWithNodeAtSide(); // and once more beside it
  for (std::size_t p = 0; p < 5; ++p)
  {
    in.points.push_back(in.points[p] + Vec<2>(3.0, 0.0));
  }
  for (std::size_t c = 0; c < 4; ++c)
  {
    in.cells.push_back({ in.cells[c][0] + 5, in.cells[c][1] + 5, in.cells[c][2] + 5 });
  }
  for (const Phase phase : { Phase::Lifting, Phase::Polishing }) // which earns nothing
  {
    WorkerBench<2> bench(in, upTo(0.6));
    bench.orders.evaluations = 0.0;
    bench.begin(phase, 0.6, Level::Topology, 2);
    ASSERT_EQ(bench.cellsUnder(0.6).size(), 2u);
    bench.give(bench.cellsUnder(0.6));
    bench.worker.work();
    const long expected = phase == Phase::Lifting ? 2 : 1;
    EXPECT_EQ(bench.worker.tally().tries, expected);
    EXPECT_EQ(bench.worker.tally().accepted, expected);
    EXPECT_EQ(bench.worker.tally().lifted, expected);
    EXPECT_EQ(bench.cellsUnder(0.6).size(), static_cast<std::size_t>(2 - expected));
    EXPECT_TRUE(bench.triedCells().empty()); // none has failed
  }
}

/// With all that a change has made: until nothing helps any more.
TEST(Worker, WhatIsStillBadIsTriedAgain)
{
  Options options = upTo(0.9);
  options.insertNodes = options.removeNodes = options.lookAhead = false;
  WorkerBench<2> bench(squareWithNodeAtSide(), options);
  bench.begin(Phase::Lifting, 0.9, Level::Topology, 1);
  bench.give(bench.cellsUnder(0.6));
  ASSERT_EQ(bench.worker.given, 1);
  bench.worker.work();
  EXPECT_GE(bench.worker.tally().accepted, 1);
  EXPECT_EQ(bench.worker.tally().lifted, 0);
  EXPECT_EQ(bench.cellsUnder(0.86).size(), 0u);
  EXPECT_EQ(bench.triedCells().size(), 4u);
}

TEST(Worker, WhatABorderHoldsUpHasNotFailed)
{
  Options options = upTo(0.6);
  options.reconnect = options.insertNodes = options.removeNodes = options.lookAhead = false;
  WorkerBench<2> bench(squareWithNodeAtSide(), options);
  const Index bad = bench.cellsUnder(0.6).front();
  bench.editor.setPointOwner(2, 1); // a corner that the cell does not have
  ASSERT_EQ(bench.mesh.localIndex(bad, 2), -1);
  bench.worker.editor.setOwner(0);
  bench.begin(Phase::Lifting, 0.6, Level::Topology, 1);
  bench.give({ bad });
  bench.worker.work();
  EXPECT_EQ(bench.worker.heldUp, std::vector<Index>{ bad });
  EXPECT_EQ(bench.triedAt(bad), None);
  EXPECT_EQ(bench.worker.tally().tries, 1);
  EXPECT_EQ(bench.worker.tally().accepted, 0);
}

TEST(Worker, EndsWithTheTime)
{
  Frozen bench;
  bench.begin(Phase::Lifting, 0.6, Level::Topology, 1);
  bench.give(bench.worst(5));
  bench.control.deadline = std::chrono::steady_clock::now();
  bench.worker.work();
  EXPECT_EQ(bench.worker.tally().tries, 0);
  EXPECT_EQ(bench.worker.queue.size(), 5u);
}
