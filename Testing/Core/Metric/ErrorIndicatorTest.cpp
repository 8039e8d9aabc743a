// SPDX-License-Identifier: BSD-3-Clause
// Sizes from an error indicator: equal errors in all new elements, and as many of them as wanted.
#include "Metric/ErrorIndicator.h"

#include "TestMeshes.h"

using namespace meshopt;

namespace
{
template <int D>
double cellVolume(const MeshInput<D>& in, const Simplex<D>& cell)
{
  Corners<D> x;
  for (int i = 0; i <= D; ++i)
  {
    x[i] = in.points[cell[i]];
  }
  return std::abs(signedVolume(x));
}

template <int D>
ErrorIndicatorSizes sizesOf(
  const MeshInput<D>& in, const std::vector<double>& errors, const ErrorIndicatorOptions& options)
{
  ErrorIndicatorSizes sizes;
  EXPECT_EQ(sizesFromErrors(buildMesh(in), errors, options, sizes), "");
  EXPECT_EQ(sizes.sizes.size(), in.points.size());
  return sizes;
}

/// Errors of each cell as if the error's density, which goes with h^order, were e(x).
template <int D, class F>
std::vector<double> errorsFromDensity(const MeshInput<D>& in, double order, F&& e)
{
  std::vector<double> errors;
  for (const Simplex<D>& cell : in.cells)
  {
    Vec<D> centre = Vec<D>::Zero();
    for (Index p : cell)
    {
      centre += in.points[p] / (D + 1);
    }
    const double v = cellVolume(in, cell);
    errors.push_back(e(centre) * std::pow(v, order / D) * std::sqrt(v));
  }
  return errors;
}

/// Regular elements with edges of 1 in a unit of volume: their area is sqrt(3) / 4, their volume
/// sqrt(2) / 12.
template <int D>
const double perVolume = D == 2 ? 4.0 / std::sqrt(3.0) : 12.0 / std::sqrt(2.0);
}

template <class T>
class ErrorIndicator : public testing::Test
{
};
TYPED_TEST_SUITE(ErrorIndicator, TestDimensions);

/// The same density of error at all sizes asks for the same size everywhere, though the cells of
/// the mesh differ.
TYPED_TEST(ErrorIndicator, EvenDensityGivesEvenSizes)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = jitteredGrid<D>(6, 0.25);
  for (const double order : { 1.0, 2.0 })
  {
    ErrorIndicatorOptions options;
    options.desiredCount = 3000.0;
    options.convergenceOrder = order;
    const ErrorIndicatorSizes sizes = sizesOf<D>(
      in, errorsFromDensity(in, order, [](const Vec<D>&) { return 5.0; }), options);
    EXPECT_NEAR(sizes.predictedCount, 3000.0, 1.0);
    const double expected = std::pow(perVolume<D> / 3000.0, 1.0 / D);
    for (double h : sizes.sizes)
    {
      EXPECT_NEAR(h / expected, 1.0, 1e-4);
    }
  }
}

/// Where the density of error is e, sizes go with e^(-2 / (2a + D)).
TYPED_TEST(ErrorIndicator, SizesFollowTheError)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = jitteredGrid<D>(8, 0.2);
  ErrorIndicatorOptions options;
  options.desiredCount = 3000.0;
  const std::vector<double> errors = errorsFromDensity(
    in, 1.0, [](const Vec<D>& x) { return x[0] < 0.5 ? 1.0 : 100.0; });
  const ErrorIndicatorSizes sizes = sizesOf<D>(in, errors, options);
  double left = 0.0, right = 0.0;
  for (std::size_t p = 0; p < in.points.size(); ++p)
  {
    (in.points[p][0] < 0.5 ? left : right) = in.points[p][0] == 0.0 || in.points[p][0] == 1.0
      ? sizes.sizes[p]
      : in.points[p][0] < 0.5 ? left
                              : right;
  }
  EXPECT_NEAR(left / right, std::pow(100.0, 2.0 / (2.0 + D)), 1e-6);
}

/// Half the error with elements of order 1 on an even field: half the size, 2^D times the elements.
TYPED_TEST(ErrorIndicator, WantedError)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = jitteredGrid<D>(6, 0.0);
  ErrorIndicatorOptions options;
  for (const double order : { 1.0, 2.0 })
  {
    options.convergenceOrder = order;
    options.desiredErrorFraction = std::pow(0.5, order);
    const std::vector<double> errors(in.cells.size(), 0.01);
    const ErrorIndicatorSizes sizes = sizesOf<D>(in, errors, options);
    EXPECT_NEAR(sizes.predictedCount / in.cells.size(), 1 << D, 1e-9);
  }
  // and where the error varies: that of the new mesh, element by element of the old one
  options.convergenceOrder = 1.0;
  options.desiredErrorFraction = 0.1;
  const std::vector<double> errors = errorsFromDensity(
    in, 1.0, [](const Vec<D>& x) { return std::exp(3.0 * x[0]); });
  const ErrorIndicatorSizes sizes = sizesOf<D>(in, errors, options);
  double now = 0.0, then = 0.0;
  for (std::size_t c = 0; c < in.cells.size(); ++c)
  {
    double logSize = 0.0;
    for (Index p : in.cells[c])
    {
      logSize += std::log(sizes.sizes[p]) / (D + 1);
    }
    const double h = std::pow(perVolume<D> * cellVolume(in, in.cells[c]), 1.0 / D);
    now += errors[c] * errors[c];
    then += std::pow(errors[c] * std::exp(logSize) / h, 2.0);
  }
  EXPECT_NEAR(std::sqrt(then / now), 0.1, 0.003);
}

TYPED_TEST(ErrorIndicator, Limits)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = jitteredGrid<D>(8, 0.1);
  ErrorIndicatorOptions options;
  options.desiredCount = D == 2 ? 3000.0 : 20000.0;
  options.limits.minimumSize = 0.02;
  options.limits.maximumSize = 0.2;
  options.limits.gradation = 1.4;
  const std::vector<double> errors = errorsFromDensity(
    in, 1.0, [](const Vec<D>& x) { return x[0] < 0.5 ? 0.0 : std::exp(30.0 * x[0]); });
  const ErrorIndicatorSizes sizes = sizesOf<D>(in, errors, options);
  EXPECT_TRUE(sizes.isCountReached);
  EXPECT_NEAR(sizes.predictedCount / options.desiredCount, 1.0, 2e-3);
  for (double h : sizes.sizes)
  {
    EXPECT_GE(h, 0.02 * (1.0 - 1e-9));
    EXPECT_LE(h, 0.2 * (1.0 + 1e-9));
  }
  for (const Simplex<D>& cell : in.cells)
  {
    for (Index p : cell)
    {
      for (Index q : cell)
      {
        const double most = sizes.sizes[p] + (in.points[p] - in.points[q]).norm() * std::log(1.4);
        EXPECT_LE(sizes.sizes[q], most * 1.001);
      }
    }
  }
}

TEST(ErrorIndicator2, WhatIsUnusableIsNamed)
{
  const MeshInput<2> in = jitteredGrid<2>(4, 0.1);
  std::vector<double> errors(in.cells.size(), 1.0);
  ErrorIndicatorSizes sizes;
  ErrorIndicatorOptions options;
  const auto complaint = [&]() { return sizesFromErrors(buildMesh(in), errors, options, sizes); };
  EXPECT_NE(complaint().find("number of elements"), std::string::npos);
  options.desiredCount = 100.0;
  EXPECT_EQ(complaint(), "");
  for (const double bad : { -1.0, std::nan(""), std::numeric_limits<double>::infinity() })
  {
    errors[7] = bad;
    EXPECT_NE(complaint().find("cell 7"), std::string::npos);
  }
  errors.assign(errors.size(), 0.0);
  EXPECT_EQ(complaint(), "");
  EXPECT_TRUE(sizes.isZero);
  EXPECT_NEAR(sizes.sizes[3], std::sqrt(perVolume<2> / 100.0), 1e-4);
  options.convergenceOrder = 0.0;
  EXPECT_NE(complaint().find("order"), std::string::npos);
  options.convergenceOrder = 1.0;
  options.desiredErrorFraction = -1.0;
  EXPECT_NE(complaint().find("error"), std::string::npos);
  errors.assign(errors.size(), 1.0);
  for (const double tiny : { 1e-100, 1e-200, 1e-320 })
  {
    options.desiredErrorFraction = tiny;
    EXPECT_NE(complaint().find("beyond the range of numbers"), std::string::npos);
  }
  options.desiredErrorFraction = 0.0;
  options.limits.gradation = 0.5;
  EXPECT_NE(complaint().find("gradation"), std::string::npos);
}
