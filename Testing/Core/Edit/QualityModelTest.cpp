// SPDX-License-Identifier: BSD-3-Clause
// What a run maximizes: measure, size factor and metric in one object.
#include "Edit/QualityModel.h"
#include "Bound/ApexBound.h"
#include "Quality/Shape.h"
#include "TestMeshes.h"

using namespace meshopt;

namespace
{
template <int D>
using Shape = MeanEdgeShape<D>;

/// Sizes and tensors that vary from point to point.
template <int D>
NodalMetric<D> varying(const SimplexMesh<D>& mesh)
{
  std::vector<double> sizes;
  std::vector<Tensor<D>> tensors;
  for (Index p = 0; p < mesh.numberOfInputPoints(); ++p)
  {
    sizes.push_back(0.2 + 0.1 * mesh.point(p)[0]);
    Tensor<D> m = Tensor<D>::Identity();
    m(0, 0) = 1.0 + 3.0 * mesh.point(p)[1];
    tensors.push_back(m);
  }
  NodalMetric<D> metric;
  EXPECT_EQ(metric.set(mesh, sizes, tensors), "");
  return metric;
}
}

template <class T>
class Model : public ::testing::Test
{
};
TYPED_TEST_SUITE(Model, TestDimensions);

TYPED_TEST(Model, PlainIsTheShapeAlone)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(3, 0.2));
  NodalMetric<D> metric(0.3); // a size that no factor asks for
  const QualityModel<D, Shape<D>> model(mesh, metric, 0.0);
  EXPECT_TRUE(model.plain);
  EXPECT_TRUE(model.fast());
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    EXPECT_EQ(model(mesh.nodes(c)), Shape<D>::value(mesh.corners(c)));
  }
}

TYPED_TEST(Model, AsksTheMetricAtTheNodes)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(3, 0.2));
  NodalMetric<D> metric = varying<D>(mesh);
  for (double beta : { 0.0, 0.7 })
  {
    const QualityModel<D, Shape<D>> model(mesh, metric, beta);
    EXPECT_FALSE(model.plain);
    EXPECT_FALSE(model.fast());
    const ElementQuality<D, Shape<D>> quality{ beta };
    int differ = 0;
    for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
    {
      const double expected = quality.value(mesh.corners(c), metric.element(mesh.nodes(c)));
      EXPECT_EQ(model(mesh.nodes(c)), expected);
      differ += std::fabs(expected - Shape<D>::value(mesh.corners(c))) > 1e-3;
    }
    EXPECT_GT(differ, mesh.numberOfCellSlots() / 2);
  }
}

TYPED_TEST(Model, ASizeFactorAloneIsNotPlain)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = buildMesh(oneCell<D>());
  NodalMetric<D> metric(std::sqrt(2.0)); // the longest edge of the corner of a box
  const QualityModel<D, Shape<D>> fits(mesh, metric, 0.7);
  EXPECT_FALSE(fits.plain);
  EXPECT_NEAR(fits(mesh.nodes(0)), Shape<D>::value(mesh.corners(0)), 1e-15);
  // (2.2): exp(-beta^2 ln^2(h / h*)), here with h = 2 h*
  NodalMetric<D> half(0.5 * std::sqrt(2.0));
  const QualityModel<D, Shape<D>> model(mesh, half, 0.7);
  const double factor = std::exp(-std::pow(0.7 * std::log(2.0), 2));
  EXPECT_NEAR(model(mesh.nodes(0)), factor * Shape<D>::value(mesh.corners(0)), 1e-15);
}

TYPED_TEST(Model, OtherPlacesThanThoseOfTheMesh)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = buildMesh(oneCell<D>());
  NodalMetric<D> metric;
  const QualityModel<D, Shape<D>> model(mesh, metric, 0.0);
  Corners<D> moved = mesh.corners(0);
  moved[D][0] += 0.25;
  EXPECT_EQ(model.at(mesh.nodes(0), moved), Shape<D>::value(moved));
  EXPECT_NE(model.at(mesh.nodes(0), moved), model(mesh.nodes(0)));
}

TEST(Model3D, OnlyFunctionsOfVolumeAndEdgeSumAreFast)
{
  const SimplexMesh<3> mesh = buildMesh(oneCell<3>());
  NodalMetric<3> metric;
  EXPECT_TRUE((QualityModel<3, VolumeLengthShape<3>>(mesh, metric, 0.0).fast()));
  EXPECT_FALSE((QualityModel<3, MinimumSineShape<3>>(mesh, metric, 0.0).fast()));
}

TEST(Model3D, WeightsCountFromTheFloorOn)
{
  // A facet so narrow that its cap is tiny, with its best fourth node.
  MeshInput<3> in;
  in.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0.5, 0.01, 0 } };
  Vec<3> apex;
  const double cap = facetCap(
    in.points[0], in.points[1], in.points[2], std::numeric_limits<double>::infinity(), &apex);
  ASSERT_LT(cap, Caps<3>::Tiny);
  in.points.push_back(apex);
  in.cells = { { 0, 1, 2, 3 } };
  const SimplexMesh<3> mesh = buildMesh(in);
  const Simplex<3> nodes = mesh.nodes(0);
  NodalMetric<3> metric;
  QualityModel<3, Shape<3>> model(mesh, metric, 0.0);
  const double q = model(nodes);
  EXPECT_EQ(model.weight(Facet<3>{ 0, 1, 2 }), 1.0);
  Caps<3> caps;
  caps.build(mesh, Measure::Shape, 0.6, true);
  caps.setFull(0.6);
  model.weights = &caps;
  EXPECT_FALSE(model.fast());
  EXPECT_NEAR(model.weight(Facet<3>{ 0, 1, 2 }), 0.6 / cap, 1e-6 * 0.6 / cap);
  EXPECT_EQ(model(nodes), q * caps.weight(nodes));
  EXPECT_NEAR(model(nodes), 0.6, 1e-6); // at its cap it has what is full
  model.floor = q;
  EXPECT_EQ(model(nodes), q * caps.weight(nodes));
  model.floor = std::nextafter(q, 1.0);
  EXPECT_EQ(model(nodes), q); // worse than the floor: seen as what it is
}
