// SPDX-License-Identifier: BSD-3-Clause
// What an angle of a tetrahedron allows, for each measure, against tetrahedra that exist.
#include "Bound/AngleBound.h"

#include "Bound/ApexBound.h"
#include "Quality/Measures.h"
#include "TestMeshes.h"

using namespace meshopt;

namespace
{
constexpr double pi = 3.14159265358979323846;

const Measure Six[] = { Measure::Shape, Measure::RadiusRatio, Measure::MeanRatio,
  Measure::MinimumSine, Measure::WarpedSine, Measure::VolumeLength };

double valueOf(Measure measure, const Corners<3>& x)
{
  return dispatch<3>(measure, [&](auto shape) { return decltype(shape)::value(x); });
}

/// The edge from (0, 0, 0) to (1, 0, 0), with the dihedral angle phi; p: the place of the other two
/// nodes, each in its half plane.
Corners<3> withDihedral(double phi, const std::array<double, 4>& p)
{
  return { Vec<3>(0, 0, 0), Vec<3>(1, 0, 0), Vec<3>(p[0], p[1], 0),
    Vec<3>(p[2], p[3] * std::cos(phi), p[3] * std::sin(phi)) };
}

/// A face with the angle alpha between the sides 1 and p[3]; the other node at (p[0], p[1], p[2]).
Corners<3> withFacial(double alpha, const std::array<double, 4>& p)
{
  return { Vec<3>(0, 0, 0), Vec<3>(1, 0, 0),
    Vec<3>(p[3] * std::cos(alpha), p[3] * std::sin(alpha), 0), Vec<3>(p[0], p[1], p[2]) };
}

/// The best value found by steps at random that shrink.
template <class Make>
double searched(Measure measure, double angle, std::array<double, 4> p, int last, Make&& make)
{
  TestRandom random(7);
  double best = valueOf(measure, make(angle, p));
  for (double step = 0.4; step > 1e-5; step *= 0.93)
  {
    for (int k = 0; k < 12; ++k)
    {
      std::array<double, 4> q = p;
      for (double& v : q)
      {
        v += step * random();
      }
      const double value = q[last] > 0.0 ? valueOf(measure, make(angle, q)) : -1.0;
      if (value > best)
      {
        best = value;
        p = q;
      }
    }
  }
  return best;
}

TEST(AngleBound, NoTetrahedronWithThisAngleIsBetter)
{
  for (Measure measure : Six)
  {
    const bool isSine = measure == Measure::MinimumSine || measure == Measure::WarpedSine;
    for (double degrees : { 2.0, 5.0, 10.0, 20.0, 40.0, 58.0, 70.53, 85.0, 100.0, 130.0, 170.0 })
    {
      const double phi = degrees * pi / 180.0;
      const double dihedral = searched(measure, phi, { 0.5, 0.8, 0.5, 0.8 }, 3, withDihedral);
      const double cap = dihedralCap(measure, phi);
      EXPECT_LE(dihedral, cap + 1e-12) << infoOf(measure).name << ", dihedral " << degrees;
      if (measure != Measure::RadiusRatio && (!isSine || degrees < 60.0))
      {
        EXPECT_GE(dihedral, cap - 2e-3) << infoOf(measure).name << ", dihedral " << degrees;
      }
      const double facial = searched(measure, phi,
        { 0.5 * std::cos(0.5 * phi), 0.5 * std::sin(0.5 * phi), 0.8, 1.0 }, 2, withFacial);
      const double other = faceAngleCap(measure, phi);
      EXPECT_LE(facial, other + 1e-12) << infoOf(measure).name << ", facial " << degrees;
      if (measure != Measure::RadiusRatio && !isSine)
      {
        EXPECT_GE(facial, other - 2e-3) << infoOf(measure).name << ", facial " << degrees;
      }
    }
  }
}

TEST(AngleBound, OtherTetrahedraAreNotBetterEither)
{
  TestRandom random(3);
  for (int k = 0; k < 20000; ++k)
  {
    const double phi = 0.02 + 1.55 * (1.0 + random());
    const auto place = [&]() -> std::array<double, 4> {
      return { 0.5 + random(), 1.01 + random(), 0.5 + random(), 1.01 + random() };
    };
    const Corners<3> x = withDihedral(phi, place()), y = withFacial(phi, place());
    for (Measure measure : Six)
    {
      ASSERT_LE(valueOf(measure, x), dihedralCap(measure, phi) + 1e-12) << infoOf(measure).name;
      ASSERT_LE(valueOf(measure, y), faceAngleCap(measure, phi) + 1e-12) << infoOf(measure).name;
    }
  }
}

TEST(AngleBound, CapsRiseAndFall)
{
  // What allows to say that equal angles are the best.
  for (Measure measure : Six)
  {
    double last[2] = { 0.0, 0.0 };
    for (int k = 1; k < 1800; ++k)
    {
      const double angle = 0.1 * k * pi / 180.0;
      const double now[2] = { dihedralCap(measure, angle), faceAngleCap(measure, angle) };
      const double tops[2] = { std::acos(1.0 / 3.0), pi / 3.0 };
      for (int i : { 0, 1 })
      {
        const bool rises = angle<tops[i] + 1e-9, falls = angle> tops[i] + 0.1 * pi / 180.0;
        EXPECT_TRUE(
          (rises && now[i] >= last[i]) || (falls && now[i] <= last[i]) || (!rises && !falls))
          << infoOf(measure).name << ", " << 0.1 * k << " degrees";
        last[i] = now[i];
      }
    }
  }
}

TEST(AngleBound, AnAngleIsFilledByTheBestNumberOfCells)
{
  const auto degrees = [](double d) { return d * pi / 180.0; };
  const auto bound = [&](double dihedral) {
    return angleBound(Measure::Shape, { { degrees(dihedral) }, {}, 0.0 });
  };
  EXPECT_NEAR(bound(20), angleCap(degrees(20)), 1e-12);
  EXPECT_NEAR(bound(90), angleCap(degrees(90)), 1e-12);  // .951; two of 45 degrees: .894
  EXPECT_NEAR(bound(120), angleCap(degrees(60)), 1e-12); // .983; one: .725
  EXPECT_NEAR(bound(180), angleCap(degrees(60)), 1e-12); // three; two of 90 degrees: .951
  EXPECT_NEAR(bound(355), angleCap(degrees(71)), 1e-12); // five
  EXPECT_EQ(angleBound(Measure::Shape, {}), 1.0);
  EXPECT_NEAR(angleBound(Measure::MinimumSine, {}), std::sqrt(8.0) / 3.0, 1e-15);
  // The least of all counts.
  const AnglesToFill several{ { degrees(90), degrees(20) }, { degrees(150), degrees(10) }, 0.0 };
  EXPECT_NEAR(
    angleBound(Measure::Shape, several), faceAngleCap(Measure::Shape, degrees(10)), 1e-12);
  EXPECT_NEAR(angleBound(Measure::MinimumSine, several), std::sin(degrees(20)), 1e-12);
  // Slack only raises it.
  EXPECT_GT(angleBound(Measure::MeanRatio, { { degrees(20) }, {}, 1e-3 }),
    angleBound(Measure::MeanRatio, { { degrees(20) }, {}, 0.0 }));
}
}
