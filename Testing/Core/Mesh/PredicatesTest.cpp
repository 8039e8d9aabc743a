// SPDX-License-Identifier: BSD-3-Clause
// Exact orientation against integer arithmetic of 128 bits, where floating point fails.
#include "Mesh/Predicates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace meshopt;

namespace
{
using Wide = __int128;

int signOf(Wide x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

template <int D>
using Lattice = std::array<std::array<long, D>, D + 1>;

int exact(const Lattice<2>& p)
{
  const Wide a = p[1][0] - p[0][0], b = p[1][1] - p[0][1];
  const Wide c = p[2][0] - p[0][0], d = p[2][1] - p[0][1];
  return signOf(a * d - b * c);
}

int exact(const Lattice<3>& p)
{
  Wide m[3][3];
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      m[i][j] = p[i + 1][j] - p[0][j];
    }
  }
  return signOf(m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
    m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
    m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]));
}

/// The same points as doubles, scaled by a power of two (exact).
template <int D>
Corners<D> toDoubles(const Lattice<D>& p, int exponent)
{
  Corners<D> x;
  for (int a = 0; a <= D; ++a)
  {
    for (int i = 0; i < D; ++i)
    {
      x[a][i] = std::ldexp(static_cast<double>(p[a][i]), exponent);
    }
  }
  return x;
}

double naive(const Corners<3>& x) { return signedVolume(x); }
double naive(const Corners<2>& x) { return signedVolume(x); }

/// Nearly degenerate simplices: the last node is an integer combination of the others, moved by at
/// most 1.
template <int D>
void nearlyDegenerate(long range, int& wrong, int& zeros)
{
  std::mt19937_64 random(3);
  std::uniform_int_distribution<long> coordinate(-range, range), small(-1, 1), factor(-3, 3);
  for (int k = 0; k < 100000; ++k)
  {
    Lattice<D> p;
    for (auto& q : p)
    {
      for (long& c : q)
      {
        c = coordinate(random);
      }
    }
    long f[D];
    for (int j = 1; j < D; ++j)
    {
      f[j] = factor(random);
    }
    for (int i = 0; i < D; ++i)
    {
      long c = p[0][i];
      for (int j = 1; j < D; ++j)
      {
        c += f[j] * (p[j][i] - p[0][i]);
      }
      p[D][i] = c + (k % 2 ? small(random) : 0);
    }
    const Corners<D> x = toDoubles<D>(p, k % 60 - 30);
    const int expected = exact(p);
    ASSERT_EQ(orientation(x), expected);
    const double v = naive(x);
    wrong += (v > 0.0 ? 1 : v < 0.0 ? -1 : 0) != expected;
    zeros += expected == 0;
    // an even permutation keeps the sign, an odd one turns it
    Corners<D> y = x;
    std::swap(y[0], y[D]);
    ASSERT_EQ(orientation(y), -expected);
  }
}
}

TEST(Predicates, PlaneAgainstIntegers)
{
  // differences of 61 bits do not fit a double: the exact stage has to keep their tails
  int wrong = 0, zeros = 0;
  nearlyDegenerate<2>(1L << 50, wrong, zeros);
  EXPECT_GT(wrong, 500) << "too easy: plain floating point gets it right";
  EXPECT_GT(zeros, 30000);
}

TEST(Predicates, SpaceAgainstIntegers)
{
  int wrong = 0, zeros = 0;
  nearlyDegenerate<3>(1L << 36, wrong, zeros);
  EXPECT_GT(wrong, 500) << "too easy: plain floating point gets it right";
  EXPECT_GT(zeros, 30000);
}

TEST(Predicates, WideRangeOfSizes)
{
  // (tiny, 0), (0, 1), (1, -1 / tiny): off the line by one unit in the last place of 1 / tiny, or
  // on it
  for (int e = 1; e < 50; ++e)
  {
    const double tiny = std::ldexp(1.0, -e);
    const Vec<2> a(0.0, 0.0), b(tiny, 1.0);
    const double far = std::ldexp(1.0, e);
    EXPECT_EQ(orient(a, b, Vec<2>(1.0, far)), 0);
    EXPECT_EQ(orient(a, b, Vec<2>(1.0, std::nextafter(far, 2.0 * far))), 1);
    EXPECT_EQ(orient(a, b, Vec<2>(1.0, std::nextafter(far, 0.0))), -1);
  }
  const Vec<3> o(0, 0, 0), x(1e-70, 0, 0), y(0, 1e+30, 0), z(0, 0, 1e+30);
  EXPECT_EQ(orient(o, x, y, z), 1);
  EXPECT_EQ(orient(o, y, x, z), -1);
}

TEST(Predicates, SpaceFarFromTheOrigin)
{
  // a plane through points with large coordinates; one unit in the last place above, on and below
  // it
  const double far = 1e15;
  const Vec<3> a(far, far, far), b(far + 1, far, far + 1), c(far, far + 1, far + 1);
  const Vec<3> on(far + 1, far + 1, far + 2);
  EXPECT_EQ(orient(a, b, c, on), 0);
  EXPECT_EQ(orient(a, b, c, Vec<3>(on[0], on[1], std::nextafter(on[2], 2 * far))), 1);
  EXPECT_EQ(orient(a, b, c, Vec<3>(on[0], on[1], std::nextafter(on[2], 0))), -1);
}
