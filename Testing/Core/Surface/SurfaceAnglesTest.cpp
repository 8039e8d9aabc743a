// SPDX-License-Identifier: BSD-3-Clause
// Which angles a surface that stays has, and that no run gets above what they allow.
#include "Surface/SurfaceAngles.h"

#include "Bound/AngleBound.h"
#include "Metric/NodalMetric.h"
#include "Optimize/Optimizer.h"
#include "Quality/Measures.h"
#include "SlidingBoxes.h"

using namespace meshopt;

namespace
{
constexpr double pi = 3.14159265358979323846;

AnglesToFill toFill(const SurfaceAngles& angles)
{
  return { angles.dihedral, angles.facial, SurfaceAngles::slack };
}

std::vector<double> distinctDegrees(const std::vector<double>& angles)
{
  std::vector<double> result;
  for (double a : angles)
  {
    const double d = a * 180.0 / pi;
    if (result.empty() || d > result.back() + 1e-6)
    {
      result.push_back(d);
    }
  }
  return result;
}

void expectDegrees(const std::vector<double>& angles, const std::vector<double>& expected)
{
  const std::vector<double> found = distinctDegrees(angles);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k)
  {
    EXPECT_NEAR(found[k], expected[k], 1e-7);
  }
}

/// A prism over an isosceles triangle with the given angle, in layers.
MeshInput<3> sharpPrism(double degrees, int layers)
{
  MeshInput<3> in;
  const double angle = degrees * pi / 180.0;
  for (int k = 0; k <= layers; ++k)
  {
    const double z = 0.6 * k;
    in.points.push_back(Vec<3>(0, 0, z));
    in.points.push_back(Vec<3>(1, 0, z));
    in.points.push_back(Vec<3>(std::cos(angle), std::sin(angle), z));
  }
  for (int k = 0; k < layers; ++k)
  {
    const Index a = 3 * k, b = a + 1, c = a + 2, d = a + 3, e = a + 4, f = a + 5;
    in.cells.push_back({ a, b, c, d });
    in.cells.push_back({ b, c, d, e });
    in.cells.push_back({ c, d, e, f });
  }
  return in;
}

double worstOf(const MeshInput<3>& in, Measure measure, Effort effort, double& bound)
{
  Sliding made(in, SurfaceOptions());
  bound = angleBound(measure, toFill(made.surface.angles()));
  NodalMetric<3> metric;
  Options options;
  options.measure = measure;
  options.effort = effort;
  options.targetQuality = 0.9 * regularValue<3>(measure);
  options.growthBudget = 1.0;
  return optimize<3>(made.mesh, metric, options, Control(), &made.surface).worstAfter;
}

TEST(SurfaceAngles, OfABox)
{
  for (bool isTurned : { false, true })
  {
    MeshInput<3> in = slidingBox(4, 0.3, 2);
    if (isTurned)
    {
      turn(in);
    }
    const Sliding made(in, SurfaceOptions());
    expectDegrees(made.surface.angles().dihedral, { 90.0 });
    expectDegrees(made.surface.angles().facial, { 90.0 });
  }
}

TEST(SurfaceAngles, InsideEachRegion)
{
  MeshInput<3> in = slidingBox(4, 0.0);
  splitRegions(in);
  const Sliding made(in, SurfaceOptions());
  // The interface x = 1/2 divides the faces: no region has more than a quarter at a ridge.
  expectDegrees(made.surface.angles().dihedral, { 90.0 });
  EXPECT_EQ(distinctDegrees(made.surface.angles().facial).size(), 1u);
}

TEST(SurfaceAngles, ReentrantRidgesAreMoreThanHalfATurn)
{
  // An L: the box without a quarter.
  MeshInput<3> box = slidingBox(4, 0.0), in;
  in.points = box.points;
  std::vector<char> used(in.points.size(), 0);
  for (const Simplex<3>& t : box.cells)
  {
    Vec<3> centre = Vec<3>::Zero();
    for (Index p : t)
    {
      centre += 0.25 * box.points[p];
    }
    if (centre[0] < 0.5 || centre[1] < 0.5)
    {
      in.cells.push_back(t);
    }
  }
  const Sliding made(in, SurfaceOptions());
  expectDegrees(made.surface.angles().dihedral, { 90.0, 270.0 });
  expectDegrees(made.surface.angles().facial, { 90.0, 270.0 });
}

TEST(SurfaceAngles, NothingIsCertainWhereTheSurfaceMayMove)
{
  for (double tolerance : { 1e-7, 1e-3 })
  {
    SurfaceOptions options;
    options.tolerance = tolerance;
    const Sliding made(sharpPrism(30.0, 2), options);
    EXPECT_TRUE(made.surface.angles().dihedral.empty()) << tolerance;
    EXPECT_TRUE(made.surface.angles().facial.empty()) << tolerance;
  }
}

TEST(SurfaceAngles, TheBoundIsReached)
{
  // One tetrahedron, the best with this dihedral angle: it is as good as any mesh of this body.
  const double phi = 20.0 * pi / 180.0, s = std::sin(0.5 * phi), r = 1.0 / std::sqrt(1.0 + s * s);
  MeshInput<3> in;
  in.points = { Vec<3>(0, 0, 0), Vec<3>(1, 0, 0), Vec<3>(0.5, r, 0),
    Vec<3>(0.5, r * std::cos(phi), r * std::sin(phi)) };
  in.cells = { { 0, 1, 2, 3 } };
  const Sliding made(in, SurfaceOptions());
  const AnglesToFill angles = toFill(made.surface.angles());
  const double expected = std::sqrt(2.0) * std::sin(phi) / (1.0 + s * s);
  const double value = VolumeLengthShape<3>::value(made.mesh.corners(0));
  EXPECT_NEAR(value, expected, 1e-12);
  EXPECT_NEAR(angleBound(Measure::VolumeLength, angles), expected, 1e-5);
  EXPECT_GE(angleBound(Measure::VolumeLength, angles), value);
  EXPECT_NEAR(angleBound(Measure::MinimumSine, angles), std::sin(phi), 1e-5);
}

TEST(SurfaceAngles, NoRunGetsAboveTheBound)
{
  double nearest = 0.0;
  for (const double degrees : { 12.0, 25.0, 40.0 })
  {
    for (int k = 0; k < 6; ++k)
    {
      const auto measure = static_cast<Measure>(k);
      double bound = 0.0;
      const Effort effort = degrees == 25.0 ? Effort::Best : Effort::Default;
      const double worst = worstOf(sharpPrism(degrees, 3), measure, effort, bound);
      EXPECT_LE(worst, bound) << infoOf(measure).name << ", " << degrees;
      EXPECT_LT(bound, 0.97 * regularValue<3>(measure)) << infoOf(measure).name << ", " << degrees;
      nearest = std::max(nearest, worst / bound);
    }
  }
  EXPECT_GT(nearest, 0.8);
}
}
