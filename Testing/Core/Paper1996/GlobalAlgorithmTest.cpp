// SPDX-License-Identifier: BSD-3-Clause
// The order in which the Global Algorithm takes elements, against its six steps written plainly.
#include "Paper1996/GlobalAlgorithm.h"
#include "Paper1996/ClusterSolver.h"
#include "Run/Run.h"
#include "TestClusters.h"

using namespace meshopt;

namespace
{
template <class>
class GlobalAlgorithm : public ::testing::Test
{
};
TYPED_TEST_SUITE(GlobalAlgorithm, TestDimensions);

/// A mesh with its qualities.
template <int D>
struct Scene
{
  SimplexMesh<D> mesh;
  MeshEditor<D> editor;
  NodalMetric<D> metric;
  RepositionParameters parameters;

  explicit Scene(const MeshInput<D>& in)
    : mesh(buildMesh(in))
    , editor(this->mesh)
  {
    computeQualities<D>(this->editor, this->metric, Measure::Shape, 0.0);
  }

  RepositionResult run(std::vector<Index>* sequence = nullptr, const KeepGoing& keepGoing = {})
  {
    return reposition<D>(
      { this->editor, this->metric, Measure::Shape }, this->parameters, keepGoing, sequence);
  }

  /// Section 2.2, step by step, with a look at all elements each time.
  RepositionResult runPlainly(std::vector<Index>& sequence)
  {
    const QualityModel<D, MeanEdgeShape<D>> model(this->mesh, this->metric, 0.0);
    const Switches switches;
    Judge<D, MeanEdgeShape<D>> judge(this->editor, model, switches);
    judge.setStampsStars(false);
    ClusterSolver<D, MeanEdgeShape<D>> solver(
      judge, this->parameters.local, this->parameters.leastGain);
    std::vector<std::uint8_t> movable;
    for (Index p = 0; p < this->mesh.numberOfPointSlots(); ++p)
    {
      movable.push_back(this->mesh.isFree(p));
    }
    RepositionResult result;
    for (Index previous = None;;)
    {
      Index worst = None;
      for (Index c = 0; c < this->mesh.numberOfCellSlots(); ++c)
      {
        const Simplex<D>& n = this->mesh.nodes(c);
        const bool moves = std::any_of(n.begin(), n.end(), [&](Index p) { return movable[p]; });
        if (moves && this->mesh.quality(c) < this->parameters.target &&
          (worst == None || this->mesh.quality(c) < this->mesh.quality(worst)))
        {
          worst = c;
        }
      }
      if (worst == None)
      {
        return result;
      }
      sequence.push_back(worst);
      if (worst == previous)
      {
        for (Index p : this->mesh.nodes(worst))
        {
          movable[p] = 0;
        }
        continue;
      }
      ++result.tried;
      result.done += solver.solve(worst, this->parameters.neighborhoodLevel, movable);
      previous = worst;
      if (result.tried == this->parameters.maximumNumberOfIterations)
      {
        result.limitReached = true;
        return result;
      }
    }
  }
};

template <int D>
MeshInput<D> grid()
{
  return jitteredGrid<D>(D == 2 ? 7 : 4, 0.3, 11);
}
}

TYPED_TEST(GlobalAlgorithm, TakesElementsInTheOrderOfThePaper)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> grids[] = { grid<D>(), jitteredGrid<D>(D == 3 ? 5 : 10, 0.35, 1) };
  for (int level : { 0, 1 })
  {
    for (double target : { 1.0, 0.6 })
    {
      Scene<D> a(grids[level]), b(grids[level]);
      a.parameters.neighborhoodLevel = b.parameters.neighborhoodLevel = level;
      a.parameters.target = b.parameters.target = target;
      std::vector<Index> sequence, wanted;
      const RepositionResult result = a.run(&sequence), plain = b.runPlainly(wanted);
      EXPECT_EQ(sequence, wanted);
      EXPECT_EQ(bitsOf(a.mesh), bitsOf(b.mesh));
      EXPECT_EQ(result.tried, plain.tried);
      EXPECT_EQ(result.done, plain.done);
      EXPECT_GT(result.done, 0);
      EXPECT_FALSE(result.limitReached);
      if (target == 1.0) // to the end: an element is the worst twice in a row again and again
      {
        EXPECT_GT(result.done, 5);
        EXPECT_GT(static_cast<long>(sequence.size()), result.tried + 5);
      }
    }
  }
}

TYPED_TEST(GlobalAlgorithm, EndsAfterMTries)
{
  constexpr int D = TypeParam::dimension;
  Scene<D> whole(grid<D>());
  std::vector<Index> all;
  whole.run(&all);
  for (long limit : { 1L, 2L, 5L })
  {
    Scene<D> a(grid<D>()), b(grid<D>());
    a.parameters.maximumNumberOfIterations = b.parameters.maximumNumberOfIterations = limit;
    std::vector<Index> sequence, wanted;
    const RepositionResult result = a.run(&sequence);
    b.runPlainly(wanted);
    EXPECT_TRUE(result.limitReached);
    EXPECT_EQ(result.tried, limit);
    EXPECT_EQ(sequence, wanted);
    EXPECT_TRUE(std::equal(sequence.begin(), sequence.end(), all.begin()));
    EXPECT_EQ(bitsOf(a.mesh), bitsOf(b.mesh));
  }
}

TYPED_TEST(GlobalAlgorithm, AsksBeforeEveryTryWithTheWorstQuality)
{
  constexpr int D = TypeParam::dimension;
  Scene<D> s(grid<D>());
  std::vector<double> asked;
  const RepositionResult result = s.run(nullptr,
    [&](double worst)
    {
      asked.push_back(worst);
      const std::vector<double> all = sortedQualities(s.mesh);
      EXPECT_TRUE(std::binary_search(all.begin(), all.end(), worst));
      return asked.size() < 4;
    });
  EXPECT_EQ(result.tried, 3);
  EXPECT_EQ(asked.size(), 4u);
  const Scene<D> fresh(grid<D>());
  double first = 1.0; // the worst of those with a node that may move
  for (Index c = 0; c < fresh.mesh.numberOfCellSlots(); ++c)
  {
    for (Index p : fresh.mesh.nodes(c))
    {
      first = fresh.mesh.isFree(p) ? std::min(first, fresh.mesh.quality(c)) : first;
    }
  }
  EXPECT_EQ(asked.front(), first);
}

TYPED_TEST(GlobalAlgorithm, AStarIsSolvedOnceAndThenSetAside)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = star<D>();
  in.points[0] = Vec<D>::Constant(0.2);
  Scene<D> s(in);
  s.parameters.local.epsilon = 1e-4;
  std::vector<Index> sequence;
  const RepositionResult result = s.run(&sequence);
  EXPECT_GE(result.done, 1);
  EXPECT_LT(s.mesh.point(0).norm(), 2e-2);
  // The last two are one element, whose nodes may then not move any more: nothing is left.
  ASSERT_GE(sequence.size(), 2u);
  EXPECT_EQ(sequence[sequence.size() - 1], sequence[sequence.size() - 2]);
  EXPECT_EQ(static_cast<long>(sequence.size()), result.tried + 1);
}

TYPED_TEST(GlobalAlgorithm, NothingIsTriedWhereAllIsGoodEnoughOrFixed)
{
  constexpr int D = TypeParam::dimension;
  Scene<D> good(star<D>());
  good.parameters.target = 0.5;
  std::vector<Index> sequence;
  EXPECT_EQ(good.run(&sequence).tried, 0);
  MeshInput<D> in = grid<D>();
  in.fixedPoints.assign(in.points.size(), 1);
  Scene<D> fixed(in);
  EXPECT_EQ(fixed.run(&sequence).tried, 0);
  EXPECT_TRUE(sequence.empty());
}
