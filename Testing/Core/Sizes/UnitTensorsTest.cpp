// SPDX-License-Identifier: BSD-3-Clause
// The wanted sizes as tensors that follow the points of a mesh.
#include "Sizes/UnitTensors.h"
#include "Mesh/MeshEditor.h"
#include "Metric/AttachedMetric.h"
#include "TestMeshes.h"

using namespace meshopt;

namespace
{
template <class>
class UnitTensorsIn : public ::testing::Test
{
};
TYPED_TEST_SUITE(UnitTensorsIn, TestDimensions);

/// The size exp(-1 + 2 x0) and the metric diag(exp(y), 1 ..): their logarithms, which are
/// interpolated, are linear, so that they are known everywhere.
template <int D>
Tensor<D> wanted(const Vec<D>& x)
{
  Tensor<D> m = Tensor<D>::Identity();
  m(0, 0) = std::exp(x[1]);
  return m / std::exp(2.0 * (-1.0 + 2.0 * x[0]));
}

template <int D>
NodalMetric<D> field(const SimplexMesh<D>& mesh)
{
  std::vector<double> sizes;
  std::vector<Tensor<D>> tensors;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    const Vec<D> x = mesh.point(p);
    sizes.push_back(std::exp(-1.0 + 2.0 * x[0]));
    tensors.push_back(wanted<D>(x) * sizes.back() * sizes.back());
  }
  NodalMetric<D> metric;
  EXPECT_EQ(metric.set(mesh, sizes, tensors), "");
  return metric;
}

template <int D>
void expectNear(const Tensor<D>& a, const Tensor<D>& b)
{
  EXPECT_LT((a - b).norm(), 1e-12 * b.norm());
}
}

TYPED_TEST(UnitTensorsIn, AreTheMetricOverTheSizeSquared)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(3, 0.2));
  const NodalMetric<D> metric = field<D>(mesh);
  UnitTensors<D> units(metric);
  units.reserve(mesh.numberOfPointSlots());
  EXPECT_EQ(units[1], Tensor<D>(Tensor<D>::Identity())); // room without a value
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    units.update(p);
    expectNear<D>(units[p], wanted<D>(mesh.point(p)));
  }
  units.reserve(1); // room is not taken away
  expectNear<D>(units[5], wanted<D>(mesh.point(5)));
}

TYPED_TEST(UnitTensorsIn, OneSizeAndNoMetric)
{
  constexpr int D = TypeParam::dimension;
  const NodalMetric<D> metric(0.25);
  UnitTensors<D> units(metric);
  units.reserve(2);
  units.update(1);
  expectNear<D>(units[1], 16.0 * Tensor<D>::Identity());
}

/// Attached after the metric, in an order that matters: each sees what the one before has sampled.
TYPED_TEST(UnitTensorsIn, FollowPointsAndComeBack)
{
  constexpr int D = TypeParam::dimension;
  SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(3, 0.2));
  NodalMetric<D> metric = field<D>(mesh);
  UnitTensors<D> units(metric);
  units.reserve(mesh.numberOfPointSlots());
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    units.update(p);
  }
  MeshEditor<D> editor(mesh);
  AttachedMetric<D> attached(metric);
  editor.attach(attached);
  editor.attach(units);
  const Index inside = D == 2 ? 5 : 21; // the first point that is not at the boundary
  ASSERT_TRUE(mesh.isFree(inside));
  const Tensor<D> before = units[inside];
  const Vec<D> from = mesh.point(inside), there = Vec<D>::Constant(0.45);

  const std::size_t outer = editor.begin();
  editor.movePoint(inside, there);
  expectNear<D>(units[inside], wanted<D>(there));
  const std::size_t inner = editor.begin();
  const Vec<D> elsewhere = Vec<D>::Constant(0.6);
  const Index come = editor.addPoint(elsewhere);
  editor.movePoint(come, elsewhere, inside);
  expectNear<D>(units[come], wanted<D>(elsewhere));
  editor.movePoint(inside, elsewhere);
  expectNear<D>(units[inside], wanted<D>(elsewhere));
  editor.rollback(inner);
  expectNear<D>(units[inside], wanted<D>(there));
  editor.rollback(outer);
  EXPECT_EQ(units[inside], before); // to the bit
  EXPECT_EQ(mesh.point(inside), from);

  const std::size_t again = editor.begin();
  editor.movePoint(inside, there);
  editor.commit(again);
  expectNear<D>(units[inside], wanted<D>(there));
  editor.detach(units);
  editor.movePoint(inside, from);
  expectNear<D>(units[inside], wanted<D>(there)); // they do not follow any more
  editor.detach(attached);
}
