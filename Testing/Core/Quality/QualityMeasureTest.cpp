// SPDX-License-Identifier: BSD-3-Clause
// The battery that every shape measure has to pass, in 2D and 3D. A new measure is one more line in
// Measures.
#include "Quality/ElementQuality.h"
#include "Quality/Measures.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace meshopt;

namespace
{
constexpr double radians = 3.14159265358979323846 / 180.0;

template <int D>
Corners<D> regular()
{
  if constexpr (D == 2)
  {
    return { Vec<2>(0, 0), Vec<2>(1, 0), Vec<2>(0.5, std::sqrt(0.75)) };
  }
  else
  {
    return { Vec<3>(0, 0, 0), Vec<3>(1, 0, 0), Vec<3>(0.5, std::sqrt(0.75), 0),
      Vec<3>(0.5, std::sqrt(3.0) / 6.0, std::sqrt(2.0 / 3.0)) };
  }
}

/// (0,0), (1,0), (0,1) and so on: edges of length 1 and sqrt(2).
template <int D>
Corners<D> rightAngled()
{
  Corners<D> x;
  x[0].setZero();
  for (int i = 1; i <= D; ++i)
  {
    x[i] = Vec<D>::Unit(i - 1);
  }
  return x;
}

template <int D, class S, Measure M>
struct Case
{
  static constexpr int dimension = D;
  static constexpr Measure measure = M;
  using Shape = S;
  /// Value of the right-angled element, worked out by hand from the definition.
  static double rightAngledValue();
};

template <int D, class S, Measure M>
double Case<D, S, M>::rightAngledValue()
{
  const double r2 = std::sqrt(2.0), r3 = std::sqrt(3.0);
  const bool plane = D == 2;
  switch (M)
  {
    case Measure::Shape: // c V / P^D
      return plane ? 36.0 / r3 * 0.5 / std::pow(2.0 + r2, 2)
                   : 1296.0 * r2 / 6.0 / std::pow(3.0 + 3.0 * r2, 3);
    case Measure::VolumeLength: // l_rms^2 = 4/3 and 3/2
      return plane ? 4.0 * 0.5 / (r3 * 4.0 / 3.0) : 6.0 * r2 / 6.0 / std::pow(1.5, 1.5);
    case Measure::MeanRatio:
      return plane ? 4.0 * r3 * 0.5 / 4.0 : 12.0 * std::pow(0.5, 2.0 / 3.0) / 9.0;
    case Measure::
      RadiusRatio: // r = 1 / (2 + sqrt 2), R = sqrt(2) / 2; r = 1 / (3 + sqrt 3), R = sqrt(3) / 2
      return plane ? 2.0 / (2.0 + r2) / (r2 / 2.0) : 3.0 / (3.0 + r3) / (r3 / 2.0);
    case Measure::MinimumSine: // 45, 90; 54.74 and 90 degrees
      return plane ? std::sqrt(0.5) : std::sqrt(2.0 / 3.0);
    case Measure::WarpedSine: // 90 degrees are not obtuse
      return plane ? std::sqrt(0.5) : std::sqrt(2.0 / 3.0);
    case Measure::MinimumDihedralAngle:
    default:
      return plane ? 45.0 : std::acos(1.0 / std::sqrt(3.0)) / radians;
  }
}

template <class C>
class ShapeMeasure : public testing::Test
{
protected:
  static constexpr int D = C::dimension;
  using S = typename C::Shape;

  std::mt19937 random_{ 7 };

  double uniform(double a, double b)
  {
    return std::uniform_real_distribution<double>(a, b)(this->random_);
  }
  Vec<D> point()
  {
    Vec<D> p;
    for (int i = 0; i < D; ++i)
    {
      p[i] = this->uniform(-1.0, 1.0);
    }
    return p;
  }
  Corners<D> element()
  {
    Corners<D> x;
    for (Vec<D>& p : x)
    {
      p = this->point();
    }
    return x;
  }
  Tensor<D> rotation()
  {
    if constexpr (D == 2)
    {
      return Eigen::Rotation2Dd(this->uniform(0.0, 6.0)).toRotationMatrix();
    }
    else
    {
      return Eigen::AngleAxisd(this->uniform(0.0, 6.0), this->point().normalized())
        .toRotationMatrix();
    }
  }
  double scaleOfValue() const { return regularValue<D>(C::measure); }
};

template <int D>
using MeasuresOf = testing::Types<Case<D, MeanEdgeShape<D>, Measure::Shape>,
  Case<D, RadiusRatioShape<D>, Measure::RadiusRatio>,
  Case<D, MeanRatioShape<D>, Measure::MeanRatio>,
  Case<D, MinimumSineShape<D>, Measure::MinimumSine>,
  Case<D, WarpedSineShape<D>, Measure::WarpedSine>,
  Case<D, VolumeLengthShape<D>, Measure::VolumeLength>,
  Case<D, MinimumAngleShape<D>, Measure::MinimumDihedralAngle>>;

template <class List>
struct NumberOfCases;
template <class... Cases>
struct NumberOfCases<testing::Types<Cases...>>
{
  static constexpr std::size_t value = sizeof...(Cases);
};
static_assert(NumberOfCases<MeasuresOf<3>>::value == std::tuple_size_v<MeasureTable>,
  "a case for each measure");

TYPED_TEST_SUITE_P(ShapeMeasure);

TYPED_TEST_P(ShapeMeasure, IdealElement)
{
  constexpr int D = TypeParam::dimension;
  using S = typename TypeParam::Shape;
  EXPECT_NEAR(S::value(regular<D>()), this->scaleOfValue(), 1e-14 * this->scaleOfValue());
  for (int k = 0; k < 2000; ++k) // and nothing is better
  {
    EXPECT_LE(S::value(this->element()), this->scaleOfValue() * (1.0 + 1e-12));
  }
}

TYPED_TEST_P(ShapeMeasure, ValueByHand)
{
  constexpr int D = TypeParam::dimension;
  EXPECT_NEAR(TypeParam::Shape::value(rightAngled<D>()), TypeParam::rightAngledValue(),
    1e-14 * this->scaleOfValue());
}

TYPED_TEST_P(ShapeMeasure, GetsWorseWithDistortion)
{
  constexpr int D = TypeParam::dimension;
  using S = typename TypeParam::Shape;
  for (int axis = 0; axis < D; ++axis)
  {
    for (double factor : { 0.9, 1.0 / 0.9 })
    {
      Corners<D> x = regular<D>();
      double before = S::value(x);
      for (int k = 0; k < 40; ++k)
      {
        for (Vec<D>& p : x)
        {
          p[axis] *= factor;
        }
        const double now = S::value(x);
        EXPECT_LT(now, before * (1.0 + 1e-12)) << "axis " << axis << ", factor " << factor;
        EXPECT_GT(now, 0.0);
        before = now;
      }
      // a long needle keeps dihedral angles of 54 degrees and more
      const Measure m = TypeParam::measure;
      const bool angles = m == Measure::MinimumSine || m == Measure::WarpedSine ||
        m == Measure::MinimumDihedralAngle;
      EXPECT_LT(before, (D == 3 && angles ? 0.95 : 0.1) * this->scaleOfValue());
    }
  }
}

TYPED_TEST_P(ShapeMeasure, InvertedHasOppositeSign)
{
  constexpr int D = TypeParam::dimension;
  using S = typename TypeParam::Shape;
  int negative = 0;
  for (int k = 0; k < 500; ++k)
  {
    const Corners<D> x = this->element();
    Corners<D> mirrored = x;
    for (Vec<D>& p : mirrored)
    {
      p[0] = -p[0];
    }
    const double q = S::value(x);
    EXPECT_EQ(S::value(mirrored), -q);
    EXPECT_EQ(q > 0.0, signedVolume(x) > 0.0);
    negative += q < 0.0;
  }
  EXPECT_GT(negative, 150);
  EXPECT_LT(negative, 350);
}

TYPED_TEST_P(ShapeMeasure, GradientAgainstCentralDifferences)
{
  constexpr int D = TypeParam::dimension;
  using S = typename TypeParam::Shape;
  const double h = 1e-6;
  int checked = 0;
  for (int k = 0; k < 300; ++k)
  {
    const Corners<D> x = this->element();
    if (std::fabs(signedVolume(x)) < 0.02) // differences are too coarse near a kink of |V|^(2/3)
    {
      continue;
    }
    std::array<Vec<D>, D + 1> g;
    EXPECT_NEAR(S::gradient(x, g), S::value(x), 1e-13 * this->scaleOfValue());
    Vec<D> sum = Vec<D>::Zero();
    for (int a = 0; a <= D; ++a)
    {
      sum += g[a];
      for (int i = 0; i < D; ++i)
      {
        Corners<D> y = x, z = x;
        y[a][i] += h;
        z[a][i] -= h;
        const double up = S::value(y) - S::value(x), down = S::value(x) - S::value(z);
        if (std::fabs(up - down) > 1e-3 * (std::fabs(up) + std::fabs(down)) + 1e-8 * h)
        {
          continue; // another angle takes over here
        }
        EXPECT_NEAR(
          g[a][i], (up + down) / (2.0 * h), 1e-5 * (this->scaleOfValue() + std::fabs(g[a][i])));
        ++checked;
      }
    }
    EXPECT_LT(sum.norm(), 1e-9 * this->scaleOfValue()); // translation changes nothing
  }
  EXPECT_GT(checked, 1000);
}

TYPED_TEST_P(ShapeMeasure, Invariance)
{
  constexpr int D = TypeParam::dimension;
  using S = typename TypeParam::Shape;
  const double tolerance = 1e-11 * this->scaleOfValue();
  for (int k = 0; k < 300; ++k)
  {
    const Corners<D> x = this->element();
    const double q = S::value(x);
    const Tensor<D> r = this->rotation();
    const Vec<D> t = this->point();
    Corners<D> rotated = x, moved = x, scaled = x, large = x;
    for (int a = 0; a <= D; ++a)
    {
      rotated[a] = r * x[a];
      moved[a] = x[a] + t;
      scaled[a] = 3.7 * x[a];
      large[a] = std::ldexp(1.0, k * 7 % 181 - 90) * x[a];
    }
    EXPECT_NEAR(S::value(rotated), q, tolerance);
    EXPECT_NEAR(S::value(moved), q, tolerance);
    EXPECT_NEAR(S::value(scaled), q, tolerance);
    EXPECT_EQ(S::value(large), q) << "scaling by a power of two keeps the bits";
  }
}

TYPED_TEST_P(ShapeMeasure, OrderOfNodes)
{
  constexpr int D = TypeParam::dimension;
  using S = typename TypeParam::Shape;
  for (int k = 0; k < 200; ++k)
  {
    Corners<D> x = this->element();
    const double q = S::value(x);
    double sign = 1.0;
    for (int swap = 0; swap < 10; ++swap)
    {
      const int a = static_cast<int>(this->random_() % (D + 1));
      const int b = static_cast<int>((a + 1 + this->random_() % D) % (D + 1));
      std::swap(x[a], x[b]);
      sign = -sign;
      EXPECT_NEAR(S::value(x), sign * q, 1e-11 * this->scaleOfValue());
    }
  }
}

TYPED_TEST_P(ShapeMeasure, Degenerate)
{
  constexpr int D = TypeParam::dimension;
  using S = typename TypeParam::Shape;
  std::vector<Corners<D>> flat(5);
  for (Vec<D>& p : flat[0]) // a point
  {
    p.setConstant(2.0);
  }
  for (int a = 0; a <= D; ++a)
  {
    flat[1][a] = Vec<D>::Constant(static_cast<double>(a));          // a line
    flat[2][a] = a == 0 ? Vec<D>::Zero() : Vec<D>(Vec<D>::Unit(0)); // coinciding nodes
    flat[3][a] = rightAngled<D>()[a == D ? 0 : a];                  // two coincide
    flat[4][a] = Vec<D>::Zero();                                    // flat, nodes apart
    flat[4][a][0] = a % 2;
    flat[4][a][D - 2] += a / 2;
  }
  if (D == 2)
  {
    flat[4] = flat[1];
  }
  for (std::size_t k = 0; k < flat.size(); ++k)
  {
    std::array<Vec<D>, D + 1> g;
    EXPECT_EQ(S::value(flat[k]), 0.0) << "case " << k;
    EXPECT_EQ(S::gradient(flat[k], g), 0.0) << "case " << k;
    for (const Vec<D>& ga : g)
    {
      EXPECT_TRUE(ga.allFinite()) << "case " << k;
    }
  }
  for (double bad :
    { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
  {
    Corners<D> x = regular<D>();
    x[1][0] = bad;
    EXPECT_FALSE(std::isfinite(S::value(x)));
  }
}

TYPED_TEST_P(ShapeMeasure, DispatchGivesTheSame)
{
  constexpr int D = TypeParam::dimension;
  const Corners<D> x = this->element();
  const double q = dispatch<D>(TypeParam::measure, [&x](auto shape) { return shape.value(x); });
  EXPECT_EQ(q, TypeParam::Shape::value(x));
}

/// Engines are compiled for AnyShape in place of most functors.
TYPED_TEST_P(ShapeMeasure, AnyShapeGivesTheSameBits)
{
  constexpr int D = TypeParam::dimension;
  using S = typename TypeParam::Shape;
  const AnyShape<D> any{ S{} };
  for (int k = 0; k < 20; ++k)
  {
    const Corners<D> x = this->element();
    std::array<Vec<D>, D + 1> g, wanted;
    EXPECT_EQ(any.value(x), S::value(x));
    EXPECT_EQ(any.gradient(x, g), S::gradient(x, wanted));
    EXPECT_EQ(g, wanted);
  }
}

TYPED_TEST_P(ShapeMeasure, SizeFactorAndMetric)
{
  constexpr int D = TypeParam::dimension;
  using S = typename TypeParam::Shape;
  ElementQuality<D, S> quality;
  quality.beta = 0.7;
  ElementMetric<D> metric;
  metric.desiredSize = 0.9;
  metric.euclidean = false;
  const double h = 1e-6;
  int checked = 0;
  for (int k = 0; k < 200; ++k)
  {
    const Corners<D> x = this->element();
    if (signedVolume(x) < 0.02)
    {
      continue;
    }
    const Tensor<D> r = this->rotation();
    Vec<D> stretch;
    for (int i = 0; i < D; ++i)
    {
      stretch[i] = this->uniform(0.4, 3.0);
    }
    metric.map = r * stretch.asDiagonal() * r.transpose();
    // a constant metric is the mesh mapped by M^(1/2): (2.2) by hand
    Corners<D> y;
    double longest = 0.0;
    for (int a = 0; a <= D; ++a)
    {
      y[a] = metric.map * x[a];
      for (int b = 0; b < a; ++b)
      {
        longest = std::max(longest, (y[a] - y[b]).norm());
      }
    }
    const double expected = S::value(y) * std::exp(-0.49 * std::pow(std::log(longest / 0.9), 2));
    std::array<Vec<D>, D + 1> g;
    EXPECT_NEAR(quality.value(x, metric), expected, 1e-11 * this->scaleOfValue());
    EXPECT_NEAR(quality.gradient(x, metric, g), expected, 1e-11 * this->scaleOfValue());
    for (int a = 0; a <= D; ++a)
    {
      for (int i = 0; i < D; ++i)
      {
        Corners<D> up = x, down = x;
        up[a][i] += h;
        down[a][i] -= h;
        const double u = quality.value(up, metric) - expected,
                     d = expected - quality.value(down, metric);
        if (std::fabs(u - d) < 1e-3 * (std::fabs(u) + std::fabs(d)))
        {
          EXPECT_NEAR(
            g[a][i], (u + d) / (2.0 * h), 1e-4 * (this->scaleOfValue() + std::fabs(g[a][i])));
          ++checked;
        }
      }
    }
  }
  EXPECT_GT(checked, 200);
}

REGISTER_TYPED_TEST_SUITE_P(ShapeMeasure, IdealElement, ValueByHand, GetsWorseWithDistortion,
  InvertedHasOppositeSign, GradientAgainstCentralDifferences, Invariance, OrderOfNodes, Degenerate,
  DispatchGivesTheSame, AnyShapeGivesTheSameBits, SizeFactorAndMetric);
INSTANTIATE_TYPED_TEST_SUITE_P(Plane, ShapeMeasure, MeasuresOf<2>);
INSTANTIATE_TYPED_TEST_SUITE_P(Space, ShapeMeasure, MeasuresOf<3>);

TEST(ElementQuality, PaperConstants)
{
  EXPECT_DOUBLE_EQ(MeanEdgeShape<2>::constant, 36.0 / std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(MeanEdgeShape<3>::constant, 1296.0 * std::sqrt(2.0));
}

TEST(ElementQuality, FarFromTheSizeRanksRemain)
{
  ElementQuality<3, MeanEdgeShape<3>> quality;
  quality.beta = 20.0;
  ElementMetric<3> metric;
  metric.desiredSize = 1.0;
  double before = 2.0;
  for (int k = 0; k < 200; ++k) // exp(-t) is 0 in doubles from here on: t = 400 ln^2(4) = 769
  {
    Corners<3> x = regular<3>();
    for (Vec<3>& p : x)
    {
      p *= 4.0 * std::pow(1.1, k);
    }
    std::array<Vec<3>, 4> g;
    const double q = quality.gradient(x, metric, g);
    EXPECT_NEAR(q / quality.value(x, metric), 1.0, 1e-12);
    EXPECT_GT(q, 0.0);
    EXPECT_LT(q, before);
    EXPECT_GT((g[0] - g[1]).cwiseAbs().maxCoeff() + (g[2] - g[3]).cwiseAbs().maxCoeff(), 0.0);
    before = q;
  }
}

TEST(ElementQuality, NoSizeFactorWhereInverted)
{
  ElementQuality<3, MeanEdgeShape<3>> quality;
  quality.beta = 1.0;
  ElementMetric<3> metric;
  metric.desiredSize = 100.0;
  Corners<3> x = regular<3>();
  std::swap(x[0], x[1]);
  EXPECT_NEAR(quality.value(x, metric), -1.0, 1e-14);
}

TEST(WarpedSine, ObtuseAnglesCountLess)
{
  const Corners<2> obtuse = { Vec<2>(0, 0), Vec<2>(1, 0), Vec<2>(-0.8, 0.6) };
  EXPECT_NEAR(MinimumSineShape<2>::value(obtuse), std::sin(std::atan2(0.6, 1.8)), 1e-14);
  const Corners<2> right = { Vec<2>(0, 0), Vec<2>(1, 0), Vec<2>(-0.1, 1.0) };
  EXPECT_NEAR(WarpedSineShape<2>::value(right),
    std::min(0.75 * std::sin(std::atan2(1.0, -0.1)), MinimumSineShape<2>::value(right)), 1e-14);
}
}
