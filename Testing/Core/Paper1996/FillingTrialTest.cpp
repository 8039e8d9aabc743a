// SPDX-License-Identifier: BSD-3-Clause
// Fillings that are made, and those that are not: all of small meshes, against the fan itself.
#include "Paper1996/FillingTrial.h"
#include "MeshSnapshot.h"
#include "Run/Summary.h"
#include "TestMeshes.h"

using namespace meshopt;

namespace
{
template <class>
class FillingTrials : public ::testing::Test
{
};
TYPED_TEST_SUITE(FillingTrials, TestDimensions);

template <int D>
using Shape = MeanEdgeShape<D>;

/// All that a trial needs, on a mesh of its own.
template <int D>
struct Scene
{
  SimplexMesh<D> mesh;
  MeshEditor<D> editor;
  NodalMetric<D> metric;
  QualityModel<D, Shape<D>> model;
  Switches switches;
  Judge<D, Shape<D>> judge;
  std::vector<std::uint8_t> pinched;
  ReconnectionMemory<D> memory;

  explicit Scene(const MeshInput<D>& in)
    : mesh(buildMesh(in))
    , editor(this->mesh)
    , model(this->mesh, this->metric, 0.0)
    , judge(this->editor, this->model, this->switches)
  {
    computeQualities<D>(this->editor, this->metric, Measure::Shape, 0.0);
    this->judge.setTangled(true, false, this->pinched);
    this->memory.resize(this->mesh);
  }

  /// Calls f(around, kind, apex) for all fillings of all cells.
  template <class F>
  void forAll(F&& f)
  {
    for (Index c = 0; c < this->mesh.numberOfCellSlots(); ++c)
    {
      if (this->mesh.isAlive(c))
      {
        ElementClusters<D> clusters;
        this->memory.resize(this->mesh); // f may have added cells and points
        clusters.gather(this->editor, c, this->memory, 0);
        clusters.forEach(this->mesh,
          [&](const ElementCluster<D>& around, Filling kind, const Apex<D>& apex)
          {
            f(around, kind, apex);
            return false;
          });
      }
    }
  }
};

/// The worst quality of the fan, by hand; `cells`: how many.
template <int D>
double worstOfFan(const FanCluster<D>& cluster, const Apex<D>& apex, std::size_t& cells)
{
  double worst = std::numeric_limits<double>::infinity();
  cells = 0;
  for (const Facet<D>& f : cluster.facets)
  {
    if (std::find(f.begin(), f.end(), apex.local) == f.end())
    {
      Corners<D> x;
      for (int k = 0; k < D; ++k)
      {
        x[k] = cluster.x[f[k]];
      }
      x[D] = apex.x;
      worst = std::min(worst, Shape<D>::value(x));
      ++cells;
    }
  }
  return worst;
}
}

TYPED_TEST(FillingTrials, AreMadeIfAllCellsAreBetter)
{
  constexpr int D = TypeParam::dimension;
  Scene<D> s(jitteredGrid<D>(D == 2 ? 6 : 3, 0.28, 5));
  FillingTrial<D, Shape<D>> trial(s.judge);
  const Snapshot<D> before(s.editor);
  const double volume = s.mesh.volume();
  const long euler = eulerCharacteristic(s.mesh);
  const auto kept = keptFacets(s.mesh);
  std::array<int, NumberOfFillings> made{}, refused{};
  s.forAll(
    [&](const ElementCluster<D>& around, Filling kind, const Apex<D>& apex)
    {
      std::size_t cells = 0;
      const double worst = worstOfFan<D>(around.cluster, apex, cells);
      const double required = around.cluster.worst;
      const auto mark = s.judge.begin(); // so that all fillings are tried on the same mesh
      const bool done = trial.make(around, apex, required);
      EXPECT_EQ(done, worst > required) << static_cast<int>(kind) << " " << worst;
      ++(done ? made : refused)[static_cast<int>(kind)];
      if (done)
      {
        expectSound(s.mesh);
        EXPECT_EQ(trial.made().size(), cells);
        // In the cell the nodes may have another order: to rounding.
        EXPECT_NEAR(s.mesh.worstQuality(trial.made()), worst, 1e-14);
        for (Index c : trial.made())
        {
          EXPECT_EQ(s.mesh.quality(c), s.model(s.mesh.nodes(c)));
        }
        EXPECT_NEAR(s.mesh.volume(), volume, 1e-14);
        EXPECT_EQ(eulerCharacteristic(s.mesh), euler);
        EXPECT_EQ(keptFacets(s.mesh), kept);
      }
      s.judge.rollback(mark);
    });
  EXPECT_TRUE(Snapshot<D>(s.editor) == before);
  for (int k = 0; k < NumberOfFillings; ++k)
  {
    EXPECT_GT(refused[k], 0) << k;
    EXPECT_GT(made[k], 0) << k;
  }
}

TYPED_TEST(FillingTrials, ARefusedOneLeavesTheMeshAsItWas)
{
  constexpr int D = TypeParam::dimension;
  Scene<D> s(jitteredGrid<D>(D == 2 ? 5 : 2, 0.25, 4));
  FillingTrial<D, Shape<D>> trial(s.judge);
  const MeshBits<D> bits = bitsOf(s.mesh);
  const std::vector<double> qualities = sortedQualities(s.mesh);
  int tried = 0;
  s.forAll(
    [&](const ElementCluster<D>& around, Filling, const Apex<D>& apex)
    {
      EXPECT_FALSE(trial.make(around, apex, 1.0)); // no cell is better than the best
      EXPECT_TRUE(trial.made().empty());
      ++tried;
    });
  EXPECT_GT(tried, 100);
  EXPECT_EQ(bitsOf(s.mesh), bits);
  EXPECT_EQ(sortedQualities(s.mesh), qualities);
  EXPECT_FALSE(s.editor.inTransaction());
  expectSound(s.mesh);
}

/// Fans that reach out of their cluster have inverted cells; with few of them in the cluster before
/// they are not made, however low the quality that is required.
TYPED_TEST(FillingTrials, NoMoreInvertedCellsThanBefore)
{
  constexpr int D = TypeParam::dimension;
  Scene<D> s(jitteredGrid<D>(D == 2 ? 5 : 2, 0.25, 4));
  FillingTrial<D, Shape<D>> trial(s.judge);
  int inverted = 0;
  s.forAll(
    [&](const ElementCluster<D>& around, Filling, const Apex<D>& apex)
    {
      std::size_t cells = 0;
      const bool isInverted = worstOfFan<D>(around.cluster, apex, cells) <= 0.0;
      const auto mark = s.judge.begin();
      EXPECT_EQ(trial.make(around, apex, -1.0), !isInverted);
      s.judge.rollback(mark);
      inverted += isInverted;
    });
  EXPECT_GT(inverted, 10);
}

TEST(FillingTrial2D, SwapAndSplitOfADiamond)
{
  MeshInput<2> in;
  in.points = { { -1, 0 }, { 1, 0 }, { 0, 0.3 }, { 0, -0.3 } };
  in.cells = { { 0, 1, 2 }, { 1, 0, 3 } };
  for (Filling wanted : { Filling::RingNode, Filling::Midpoint })
  {
    Scene<2> s(in);
    FillingTrial<2, Shape<2>> trial(s.judge);
    bool done = false;
    s.forAll([&](const ElementCluster<2>& around, Filling kind, const Apex<2>& apex)
      { done = done || (kind == wanted && trial.make(around, apex, around.cluster.worst)); });
    ASSERT_TRUE(done);
    const bool isSplit = wanted == Filling::Midpoint;
    EXPECT_EQ(s.mesh.countCells(), isSplit ? 4 : 2);
    EXPECT_EQ(s.mesh.countPoints(), isSplit ? 5 : 4);
    // All are the same: half a swapped one is a right triangle of sides 1, .3.
    const Corners<2> one = isSplit ? Corners<2>{ Vec<2>(0, 0), Vec<2>(1, 0), Vec<2>(0, 0.3) }
                                   : Corners<2>{ Vec<2>(0, -0.3), Vec<2>(1, 0), Vec<2>(0, 0.3) };
    for (double q : sortedQualities(s.mesh))
    {
      EXPECT_NEAR(q, Shape<2>::value(one), 1e-15);
    }
  }
}
