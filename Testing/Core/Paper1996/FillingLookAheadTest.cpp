// SPDX-License-Identifier: BSD-3-Clause
// Fillings that pay only after nodes have moved: kept if the worst of what has changed is better.
#include "Paper1996/FillingLookAhead.h"
#include "MeshSnapshot.h"
#include "Run/Summary.h"
#include "TestMeshes.h"

#include <map>

using namespace meshopt;

namespace
{
template <class>
class FillingLookAheads : public ::testing::Test
{
};
TYPED_TEST_SUITE(FillingLookAheads, TestDimensions);

template <int D>
using Shape = MeanEdgeShape<D>;

/// Cells by their nodes, with quality.
template <int D>
std::map<Simplex<D>, double> cellsOf(const SimplexMesh<D>& mesh)
{
  std::map<Simplex<D>, double> cells;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    if (mesh.isAlive(c))
    {
      cells[mesh.nodes(c)] = mesh.quality(c);
    }
  }
  return cells;
}

constexpr double LeastGain = 1e-3;

template <int D>
struct Outcome
{
  int kept = 0, undone = 0;
  int notByItself = 0; ///< kept ones that FillingTrial alone would not have made
};

/// Tries all fillings of all cells with a look-ahead, and undoes what is kept after a look at it.
template <int D>
Outcome<D> tryAll(const MeshInput<D>& in, double leastGain)
{
  SimplexMesh<D> mesh = buildMesh(in);
  MeshEditor<D> editor(mesh);
  NodalMetric<D> metric;
  computeQualities<D>(editor, metric, Measure::Shape, 0.0);
  const QualityModel<D, Shape<D>> model(mesh, metric, 0.0);
  const Switches switches;
  Judge<D, Shape<D>> judge(editor, model, switches);
  const std::vector<std::uint8_t> pinched;
  judge.setTangled(true, false, pinched);
  ReconnectionMemory<D> memory;
  memory.resize(mesh);
  FillingLookAhead<D, Shape<D>> ahead(judge, leastGain);
  FillingTrial<D, Shape<D>> alone(judge);
  const std::map<Simplex<D>, double> before = cellsOf(mesh);
  const Snapshot<D> bits(editor);
  const double volume = mesh.volume();
  const auto kept = keptFacets(mesh);
  Outcome<D> outcome;
  const auto check = [&](const FanCluster<D>& cluster)
  {
    expectSound(mesh);
    EXPECT_NEAR(mesh.volume(), volume, 1e-13);
    EXPECT_EQ(keptFacets(mesh), kept);
    // changed() are the cells that are new or have another quality; the worst of them is better
    // than the worst of those that they were.
    std::set<Simplex<D>> changed;
    for (Index c : ahead.changed())
    {
      ASSERT_TRUE(mesh.isAlive(c));
      EXPECT_TRUE(changed.insert(mesh.nodes(c)).second) << "a cell is there twice";
      EXPECT_EQ(mesh.quality(c), model(mesh.nodes(c)));
    }
    double old = cluster.worst;
    for (const auto& [nodes, q] : cellsOf(mesh))
    {
      const auto was = before.find(nodes);
      if (was == before.end() || was->second != q)
      {
        EXPECT_EQ(changed.count(nodes), 1u) << "a cell has changed and is not named";
        old = was == before.end() ? old : std::min(old, was->second);
      }
    }
    EXPECT_GT(mesh.worstQuality(ahead.changed()), old + leastGain * std::abs(old));
  };
  for (Index c = 0; c < static_cast<Index>(in.cells.size()); ++c)
  {
    ElementClusters<D> clusters;
    clusters.gather(editor, c, memory, 0);
    clusters.forEach(mesh,
      [&](const ElementCluster<D>& around, Filling kind, const Apex<D>& apex)
      {
        if (kind == Filling::Centre)
        {
          return false;
        }
        const auto mark = judge.begin();
        const bool byItself = alone.make(
          around, apex, around.cluster.worst + leastGain * std::abs(around.cluster.worst));
        judge.rollback(mark);
        const auto next = judge.begin();
        const bool done = ahead.improve(around, apex);
        ++(done ? outcome.kept : outcome.undone);
        outcome.notByItself += done && !byItself;
        EXPECT_TRUE(done || !byItself) << "moving nodes makes nothing worse";
        if (done)
        {
          check(around.cluster);
        }
        else
        {
          EXPECT_EQ(cellsOf(mesh), before);
        }
        judge.rollback(next);
        return false;
      });
  }
  EXPECT_FALSE(editor.inTransaction());
  EXPECT_TRUE(Snapshot<D>(editor) == bits);
  return outcome;
}

template <int D>
MeshInput<D> grid()
{
  return jitteredGrid<D>(D == 2 ? 6 : 3, 0.3, 6);
}
}

TYPED_TEST(FillingLookAheads, WhatIsKeptIsBetterAndNamed)
{
  constexpr int D = TypeParam::dimension;
  const Outcome<D> outcome = tryAll<D>(grid<D>(), LeastGain);
  EXPECT_GT(outcome.kept, 10);
  EXPECT_GT(outcome.undone, 10);
  EXPECT_GT(outcome.notByItself, 5);
}

TYPED_TEST(FillingLookAheads, NothingGainsEnoughForAHighDemand)
{
  constexpr int D = TypeParam::dimension;
  EXPECT_EQ(tryAll<D>(grid<D>(), 1e6).kept, 0);
}

/// Again and again at the worst cell: the sorted qualities rise lexicographically.
TEST(FillingLookAhead2D, OutsideOfATransactionItCommitsOrUndoes)
{
  SimplexMesh<2> mesh = buildMesh(grid<2>());
  MeshEditor<2> editor(mesh);
  NodalMetric<2> metric;
  computeQualities<2>(editor, metric, Measure::Shape, 0.0);
  const QualityModel<2, Shape<2>> model(mesh, metric, 0.0);
  const Switches switches;
  Judge<2, Shape<2>> judge(editor, model, switches);
  const std::vector<std::uint8_t> pinched;
  judge.setTangled(true, false, pinched);
  FillingLookAhead<2, Shape<2>> ahead(judge, LeastGain);
  int kept = 0;
  for (int round = 0; round < 30; ++round)
  {
    Index worst = None;
    for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
    {
      worst = mesh.isAlive(c) && (worst == None || mesh.quality(c) < mesh.quality(worst)) ? c
                                                                                          : worst;
    }
    ReconnectionMemory<2> memory;
    memory.resize(mesh);
    ElementClusters<2> clusters;
    clusters.gather(editor, worst, memory, 0);
    const std::vector<double> before = sortedQualities(mesh);
    const bool done = clusters.forEach(mesh,
      [&](const ElementCluster<2>& around, Filling kind, const Apex<2>& apex)
      {
        const bool gained = kind != Filling::Centre && ahead.improve(around, apex);
        EXPECT_FALSE(editor.inTransaction());
        EXPECT_TRUE(gained || sortedQualities(mesh) == before);
        return gained;
      });
    if (!done)
    {
      break;
    }
    ++kept;
    EXPECT_TRUE(isAbove(sortedQualities(mesh), before));
    expectSound(mesh);
  }
  EXPECT_GT(kept, 5);
}
