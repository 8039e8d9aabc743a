// SPDX-License-Identifier: BSD-3-Clause
// Signs of all tetrahedra of a few points, against integer arithmetic of 128 bits.
#include "Operations/PointSigns.h"
#include "Mesh/Predicates.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

using namespace meshopt;

namespace
{
using Wide = __int128;
using LatticePoint = std::array<long, 3>;

/// Of (b - a, c - a, d - a): positive if d is above (a, b, c).
int exactSign(
  const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& d)
{
  Wide m[3][3];
  for (int j = 0; j < 3; ++j)
  {
    m[0][j] = b[j] - a[j];
    m[1][j] = c[j] - a[j];
    m[2][j] = d[j] - a[j];
  }
  const Wide det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
    m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
    m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  return det > 0 ? 1 : det < 0 ? -1 : 0;
}

/// The points as doubles, scaled by a power of two, which changes no sign.
void addAll(PointSigns& signs, const std::vector<LatticePoint>& points, int exponent)
{
  signs.clear();
  for (const LatticePoint& p : points)
  {
    Vec<3> x;
    for (int i = 0; i < 3; ++i)
    {
      x[i] = std::ldexp(static_cast<double>(p[i]), exponent);
    }
    signs.add(x);
  }
  ASSERT_EQ(signs.size(), static_cast<int>(points.size()));
}

void forTriples(int n, const std::function<void(int, int, int)>& f)
{
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < n; ++j)
    {
      for (int k = 0; k < n; ++k)
      {
        if (i != j && j != k && k != i)
        {
          f(i, j, k);
        }
      }
    }
  }
}

/// above() for all triples in all orders. Returns how many of the signs are 0.
int expectAbove(const PointSigns& signs, const std::vector<LatticePoint>& points)
{
  const int n = static_cast<int>(points.size());
  int flat = 0;
  forTriples(n,
    [&](int i, int j, int k)
    {
      PointSigns::Mask wanted = 0;
      for (int l = 0; l < n; ++l)
      {
        const int sign = exactSign(points[i], points[j], points[k], points[l]);
        wanted |= sign > 0 ? PointSigns::Mask(1) << l : 0;
        flat += sign == 0 && l != i && l != j && l != k;
      }
      EXPECT_EQ(signs.above(i, j, k), wanted) << i << " " << j << " " << k;
    });
  return flat;
}

std::vector<LatticePoint> randomPoints(int n, long range, std::mt19937& random)
{
  std::uniform_int_distribution<long> any(-range, range);
  std::vector<LatticePoint> points(n);
  for (LatticePoint& p : points)
  {
    p = { any(random), any(random), any(random) };
  }
  return points;
}
}

/// On a coarse lattice many points lie in one plane, on one line, or on each other.
TEST(PointSigns, EqualsIntegersWhereManyPointsAreCoplanar)
{
  std::mt19937 random(1);
  PointSigns signs; // one for all: what was there before must be forgotten
  for (int n : { 12, 4, 20, 3, 9, 32 })
  {
    const std::vector<LatticePoint> points = randomPoints(n, 2, random);
    addAll(signs, points, n % 2 ? 0 : -7);
    const int flat = expectAbove(signs, points);
    EXPECT_TRUE(n < 12 || flat > 100) << n;
  }
}

/// Next to a plane, the determinants are smaller than what rounding leaves of doubles: some points
/// are close to each other beside some that are far away, so that the bound on the error is great.
TEST(PointSigns, EqualsIntegersWhereRoundingDecides)
{
  constexpr long far = 1L << 38;
  std::mt19937 random(2);
  std::uniform_int_distribution<long> any(-far / 2, far / 2), small(-40, 40), off(-1, 1);
  PointSigns signs;
  int doubtful = 0;
  for (int exponent : { 0, -38, 60, -265 }) // the last one: as small as may be
  {
    std::vector<LatticePoint> points;
    for (int k = 0; k < 16; ++k)
    {
      // Of the plane x + y + z = 0, nearly.
      const bool isNear = k % 3 != 1; // the first and the last, too
      const long x = isNear ? small(random) : any(random), y = isNear ? small(random) : any(random);
      points.push_back({ x, y, -x - y + off(random) });
    }
    addAll(signs, points, exponent);
    expectAbove(signs, points);
    // Products of coordinates have more digits than a double: the naive sign is often wrong.
    forTriples(16,
      [&](int i, int j, int k)
      {
        for (int l = 0; l < 16; ++l)
        {
          double m[3][3];
          const int p[3] = { j, k, l };
          for (int a = 0; a < 3; ++a)
          {
            for (int b = 0; b < 3; ++b)
            {
              m[a][b] = static_cast<double>(points[p[a]][b]) - static_cast<double>(points[i][b]);
            }
          }
          const double det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
            m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
            m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
          doubtful += (det > 0      ? 1
                          : det < 0 ? -1
                                    : 0) != exactSign(points[i], points[j], points[k], points[l]);
        }
      });
  }
  EXPECT_GT(doubtful, 100) << "the case is not hard enough";
}

/// A point is inside if it may stand in for each of the four nodes.
TEST(PointSigns, InsideIsStrictlyInside)
{
  std::mt19937 random(3);
  PointSigns signs;
  int found = 0, onBorder = 0;
  for (int run = 0; run < 20; ++run)
  {
    const std::vector<LatticePoint> points = randomPoints(14, run % 2 ? 3 : 1000, random);
    addAll(signs, points, 0);
    forTriples(14,
      [&](int a, int b, int c)
      {
        for (int d = 0; d < 14; ++d)
        {
          if (exactSign(points[a], points[b], points[c], points[d]) <= 0)
          {
            continue;
          }
          PointSigns::Mask wanted = 0;
          for (int l = 0; l < 14; ++l)
          {
            std::array<int, 4> corner{ a, b, c, d };
            int least = 1;
            for (int& replaced : corner)
            {
              std::swap(replaced, l);
              least = std::min(least,
                exactSign(
                  points[corner[0]], points[corner[1]], points[corner[2]], points[corner[3]]));
              std::swap(replaced, l);
            }
            wanted |= least > 0 ? PointSigns::Mask(1) << l : 0;
            found += least > 0;
            onBorder += least == 0;
          }
          EXPECT_EQ(signs.inside(a, b, c, d), wanted);
        }
      });
  }
  EXPECT_GT(found, 1000);
  EXPECT_GT(onBorder, 1000);
}

TEST(PointSet, EqualsCountingBits)
{
  std::mt19937 random(4);
  for (int run = 0; run < 1000; ++run)
  {
    // Sets of few members, and of many.
    std::uint32_t set = random() & random();
    set = run % 3 == 0 ? ~set : run % 3 == 1 ? set & random() : set;
    int count = 0, lowest = -1;
    std::uint32_t again = 0;
    for (int k = 0; k < 32; ++k)
    {
      if (pointset::has(set, k))
      {
        EXPECT_NE(set & pointset::bit(k), 0u);
        again += pointset::bit(k);
        ++count;
        lowest = lowest < 0 ? k : lowest;
      }
    }
    EXPECT_EQ(again, set);
    EXPECT_EQ(pointset::count(set), count);
    if (set != 0)
    {
      EXPECT_EQ(pointset::lowest(set), lowest);
    }
  }
  EXPECT_EQ(pointset::count(0), 0);
  EXPECT_EQ(pointset::count(~0u), 32);
  EXPECT_EQ(pointset::lowest(1u << 31), 31);
}

TEST(PointSigns, EqualPredicates)
{
  TestRandom random(5);
  for (int kind = 0; kind < 3; ++kind)
  {
    PointSigns signs;
    for (int repeat = 0; repeat < 2; ++repeat) // the second time nothing is left of the first
    {
      signs.clear();
      std::vector<Vec<3>> x;
      for (int k = 0; k < 12; ++k)
      {
        Vec<3> p(random(), random(), random());
        p = kind == 1 ? Vec<3>((2.0 * p).array().round()) : p; // many coplanar
        p[2] = kind == 2 ? 0.1 * p[0] + 0.3 * p[1] : p[2];     // all nearly so
        x.push_back(p);
        signs.add(p);
      }
      ASSERT_EQ(signs.size(), 12);
      for (int i = 0; i < 12; ++i)
      {
        for (int j = 0; j < 12; ++j)
        {
          for (int k = 0; k < 12; ++k)
          {
            for (int l = 0; l < 12; ++l)
            {
              const bool distinct = i != j && i != k && i != l && j != k && j != l && k != l;
              ASSERT_EQ(pointset::has(signs.above(i, j, k), l),
                distinct && orient(x[i], x[j], x[k], x[l]) > 0);
            }
          }
        }
      }
    }
  }
  EXPECT_EQ(pointset::count(0xffffffffu), 32);
  EXPECT_EQ(pointset::lowest(0x80000000u), 31);
  EXPECT_EQ(pointset::lowest(12u), 2);
}
