// SPDX-License-Identifier: BSD-3-Clause
// Single improvements: where metric and size vary from place to place each must raise the sorted
// vector of qualities, as they really are after it; and the limits of what may go.
#include "Run/Improver.h"
#include "Quality/Shape.h"
#include "Run/Run.h"
#include "TestMeshes.h"

using namespace meshopt;

namespace
{
/// Lengths along x count up to 60 times as much, by a sharp ridge at x = 1/2.
template <int D>
NodalMetric<D> ridge(const SimplexMesh<D>& mesh)
{
  std::vector<Tensor<D>> tensors;
  for (Index p = 0; p < mesh.numberOfInputPoints(); ++p)
  {
    Tensor<D> m = Tensor<D>::Identity();
    const double x = (mesh.point(p)[0] - 0.5) / 0.15;
    m(0, 0) += 3600.0 * std::exp(-x * x);
    tensors.push_back(m);
  }
  NodalMetric<D> metric;
  EXPECT_EQ(metric.set(mesh, {}, tensors), "");
  return metric;
}
}

template <class T>
class Improving : public ::testing::Test
{
};
TYPED_TEST_SUITE(Improving, TestDimensions);

/// An insertion that was judged by the metric at the place where the search had begun could lower
/// the worst quality, and come again and again.
TYPED_TEST(Improving, InAVaryingMetricRaisesWhatIsThere)
{
  constexpr int D = TypeParam::dimension;
  using Shape = MeanEdgeShape<D>;
  using Engine = Improver<D, Shape>;
  long inserted = 0;
  for (unsigned seed = 1; seed <= 3; ++seed)
  {
    SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(D == 3 ? 4 : 12, 0.25, seed));
    NodalMetric<D> metric = ridge<D>(mesh);
    MeshEditor<D> editor(mesh);
    computeQualities<D>(editor, metric, Measure::Shape, 0.0);
    Options options;
    const QualityModel<D, Shape> model(mesh, metric, 0.0);
    ASSERT_FALSE(model.plain);
    const FollowedMetric<D> follows(editor, metric);
    Engine improver(editor, model, options);
    improver.judge().growth.left = 10000;
    improver.judge().setTarget(0.9);
    std::vector<double> before = sortedQualities(mesh);
    for (int level : { Level::Insertion, Level::LookAhead })
    {
      for (Index t = 0; t < 400 && t < mesh.numberOfCellSlots(); ++t)
      {
        if (!mesh.isAlive(t) || mesh.quality(t) > 0.5 || !improver.improve(t, level))
        {
          continue;
        }
        const std::vector<double> after = sortedQualities(mesh);
        EXPECT_TRUE(isAbove(after, before)) << "seed " << seed << ", cell " << t;
        EXPECT_GE(after.front(), before.front());
        before = after;
      }
    }
    inserted += improver.judge().done[static_cast<int>(Operation::NodeInsertion)];
    expectSound(mesh);
    computeQualities<D>(editor, metric, Measure::Shape, 0.0);
    const std::vector<double> computed = sortedQualities(mesh);
    for (std::size_t k = 0; k < before.size(); ++k)
    {
      ASSERT_NEAR(computed[k], before[k], 1e-12);
    }
  }
  EXPECT_TRUE(D == 2 || inserted > 5) << inserted;
}

/// Points that are there after all cells have been tried, if cells may go until `most` is reached.
template <int D>
Index pointsLeft(long growth, long most)
{
  using Shape = MeanEdgeShape<D>;
  SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(D == 3 ? 5 : 12, 0.3));
  NodalMetric<D> metric;
  MeshEditor<D> editor(mesh);
  computeQualities<D>(editor, metric, Measure::Shape, 0.0);
  const QualityModel<D, Shape> model(mesh, metric, 0.0);
  Options options;
  options.moveNodes = options.reconnect = options.insertNodes = false;
  Improver<D, Shape> improver(editor, model, options);
  improver.judge().growth = { growth, most };
  improver.judge().setTarget(0.9);
  for (Index t = 0; t < mesh.numberOfCellSlots(); ++t)
  {
    if (mesh.isAlive(t) && mesh.quality(t) < 0.7)
    {
      improver.improve(t, Level::Insertion);
    }
  }
  expectSound(mesh);
  return mesh.countPoints();
}

TYPED_TEST(Improving, KeepsNodesOnceEnoughCellsAreGone)
{
  constexpr int D = TypeParam::dimension;
  const Index input = buildMesh(jitteredGrid<D>(D == 3 ? 5 : 12, 0.1)).countPoints();
  const long never = std::numeric_limits<long>::max();
  EXPECT_LT(pointsLeft<D>(0, never), input);
  EXPECT_EQ(pointsLeft<D>(0, 0), input);
}
