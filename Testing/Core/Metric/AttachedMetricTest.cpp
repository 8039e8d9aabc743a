// SPDX-License-Identifier: BSD-3-Clause
// The samples of a metric follow the points of a mesh, and come back where a change is undone.
#include "Metric/AttachedMetric.h"
#include "Mesh/MeshEditor.h"
#include "TestMeshes.h"

using namespace meshopt;

namespace
{
template <class>
class AttachedMetricIn : public ::testing::Test
{
};
TYPED_TEST_SUITE(AttachedMetricIn, TestDimensions);

/// Sizes whose logarithm is linear, so that samples are exact everywhere.
template <int D>
double sizeAt(const Vec<D>& x)
{
  return std::exp(0.3 - x[0] + 2.0 * x[D - 1]);
}

template <int D>
struct Scene
{
  SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(3, 0.2));
  NodalMetric<D> metric;
  MeshEditor<D> editor{ this->mesh };
  AttachedMetric<D> attached{ this->metric };
  Index inside = D == 2 ? 5 : 21;

  Scene()
  {
    std::vector<double> sizes;
    for (Index p = 0; p < this->mesh.numberOfPointSlots(); ++p)
    {
      sizes.push_back(sizeAt<D>(this->mesh.point(p)));
    }
    EXPECT_EQ(this->metric.set(this->mesh, sizes, {}), "");
    EXPECT_TRUE(this->mesh.isFree(this->inside));
    this->editor.attach(this->attached);
  }
  double size(Index p) const { return std::exp(this->metric.sample(p).logSize); }
};
}

TYPED_TEST(AttachedMetricIn, SamplesWhereAPointIsPlaced)
{
  constexpr int D = TypeParam::dimension;
  Scene<D> s;
  TestRandom random(1);
  for (int k = 0; k < 50; ++k)
  {
    Vec<D> x;
    for (int d = 0; d < D; ++d)
    {
      x[d] = 0.5 + 0.5 * random();
    }
    s.editor.movePoint(s.inside, x);
    EXPECT_NEAR(s.size(s.inside), sizeAt<D>(x), 1e-12);
    const Index come = s.editor.addPoint(x);
    s.editor.movePoint(come, x, s.inside);
    EXPECT_NEAR(s.size(come), sizeAt<D>(x), 1e-12);
  }
}

TYPED_TEST(AttachedMetricIn, TransactionsGiveBackTheSamplesToTheBit)
{
  constexpr int D = TypeParam::dimension;
  Scene<D> s;
  std::vector<double> before;
  for (Index p = 0; p < s.mesh.numberOfPointSlots(); ++p)
  {
    before.push_back(s.metric.sample(p).logSize);
  }
  const Index hint = s.metric.sample(s.inside).hint;
  const std::size_t mark = s.editor.begin();
  for (int k = 0; k < 5; ++k)
  {
    s.editor.movePoint(s.inside, Vec<D>::Constant(0.2 * k));
    EXPECT_NE(s.metric.sample(s.inside).logSize, before[s.inside]);
  }
  s.editor.rollback(mark);
  for (std::size_t p = 0; p < before.size(); ++p)
  {
    EXPECT_EQ(s.metric.sample(static_cast<Index>(p)).logSize, before[p]);
  }
  EXPECT_EQ(s.metric.sample(s.inside).hint, hint);
}

TYPED_TEST(AttachedMetricIn, GetAndSetAreTheSamples)
{
  constexpr int D = TypeParam::dimension;
  Scene<D> s;
  typename AttachedMetric<D>::Sample value = s.attached.get(3);
  EXPECT_EQ(value.logSize, s.metric.sample(3).logSize);
  value.logSize = 4.5;
  s.attached.set(3, value);
  EXPECT_EQ(s.metric.sample(3).logSize, 4.5);
}
