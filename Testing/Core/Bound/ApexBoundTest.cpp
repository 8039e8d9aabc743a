// SPDX-License-Identifier: BSD-3-Clause
// What limits an element on kept facets: against brute force and against the table of known values.
#include "Bound/ApexBound.h"
#include "Bound/PairBound.h"
#include "Bound/SurfaceBound.h"
#include "Quality/Shape.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace meshopt;

namespace
{
constexpr double pi = 3.14159265358979323846;

/// Best S over the apex, by trying ever smaller steps: a lower bound of the cap.
double bruteFacet(const Vec<3>& a, const Vec<3>& b, const Vec<3>& c)
{
  const Vec<3> n = (b - a).cross(c - a);
  const double l = std::max((b - a).norm(), std::max((c - b).norm(), (a - c).norm()));
  Vec<3> p = (a + b + c) / 3.0 + n.normalized() * (0.6 * l);
  double q = MeanEdgeShape<3>::value({ a, b, c, p });
  for (double h = 0.3 * l; h > 1e-9 * l; h *= 0.5)
  {
    for (bool better = true; better;)
    {
      better = false;
      for (int d = 0; d < 6; ++d)
      {
        Vec<3> r = p;
        r[d / 2] += d % 2 ? h : -h;
        const double s = MeanEdgeShape<3>::value({ a, b, c, r });
        if (s > q)
        {
          q = s;
          p = r;
          better = true;
        }
      }
    }
  }
  return q;
}

/// Two facets that share an edge of length 1, regular, at the angle theta.
SurfaceBound<3> hinge(double theta, double off = std::sqrt(0.75))
{
  const Vec<3> points[4] = { Vec<3>(0, 0, 0), Vec<3>(1, 0, 0), Vec<3>(0.5, off, 0),
    Vec<3>(0.5, off * std::cos(theta), off * std::sin(theta)) };
  return surfaceBound<3>(points, { { { 0, 1, 2 }, 0, 0, true }, { { 1, 0, 3 }, 0, 0, true } });
}
}

TEST(FacetCap, AgainstBruteForce)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int k = 0; k < 300; ++k)
  {
    Vec<3> x[3];
    for (Vec<3>& p : x)
    {
      p = Vec<3>(u(random), u(random), u(random));
    }
    if (k % 3 == 0) // needles, down to 1 : 1000
    {
      x[1] = x[0] + std::pow(10.0, -1.5 + 1.5 * u(random)) * (x[1] - x[0]);
    }
    if (k % 3 == 1) // caps
    {
      x[2] = 0.4 * x[0] + 0.6 * x[1] + std::pow(10.0, -1.5 + 1.5 * u(random)) * (x[2] - x[0]);
    }
    const double brute = bruteFacet(x[0], x[1], x[2]);
    Vec<3> apex;
    const double cap = facetCap(x[0], x[1], x[2], std::numeric_limits<double>::infinity(), &apex);
    EXPECT_GE(cap, brute * (1.0 - 1e-12)) << "not an upper bound";
    EXPECT_LE(cap, brute * (1.0 + 1e-5)) << "not sharp";
    EXPECT_NEAR(MeanEdgeShape<3>::value({ x[0], x[1], x[2], apex }), cap, 1e-9);
    EXPECT_NEAR(facetCap(x[2], x[1], x[0]), cap, 1e-9) << "order of nodes";
    const double quick = facetCap(x[0], x[1], x[2], 0.5 * cap);
    EXPECT_GE(quick, 0.5 * cap * (1.0 - 1e-12));
    EXPECT_LE(quick, cap * (1.0 + 1e-12));
  }
}

TEST(FacetCap, SpecialFacets)
{
  const Vec<3> a(0, 0, 0), b(1, 0, 0), c(0.5, std::sqrt(0.75), 0);
  EXPECT_NEAR(facetCap(a, b, c), 1.0, 1e-12);
  EXPECT_EQ(facetCap(a, b, a), 0.0);
  EXPECT_EQ(facetCap(a, b, Vec<3>(3, 0, 0)), 0.0);
  EXPECT_EQ(facetCap(a, b, Vec<3>(0, std::nan(""), 0)), 1.0) << "nothing known";
  EXPECT_EQ(facetCap(Vec<3>(std::nan(""), 0, 0), b, c), 1.0);

  // An apex is given all the same: a search begins there.
  for (const Vec<3>& third : { Vec<3>(0, 0, 0), Vec<3>(3, 0, 0), Vec<3>(0.5, 1e-170, 0) })
  {
    Vec<3> apex(7, 7, 7);
    EXPECT_LT(facetCap(a, b, third, std::numeric_limits<double>::infinity(), &apex), 1e-50);
    EXPECT_LT((apex - (a + b + third) / 3.0).norm(), 3.0) << "near the facet";
  }
}

TEST(EdgeBound, TableOfKnownValues)
{
  const double table[][2] = { { 5, .155 }, { 10, .295 }, { 20, .530 }, { 30, .712 }, { 45, .894 },
    { 60, .983 }, { 70.5, 1.0 }, { 90, .951 }, { 110, .816 }, { 120, .725 }, { 140, .508 },
    { 160, .261 }, { 170, .132 } };
  for (const auto& row : table)
  {
    EXPECT_NEAR(angleCap(row[0] * pi / 180.0), row[1], 6e-4) << row[0] << " degrees";
  }
}

TEST(EdgeBound, NoTetrahedronWithThisAngleIsBetter)
{
  std::mt19937 random(4);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  double closest = 1.0;
  for (int k = 0; k < 200000; ++k)
  {
    const double phi = 0.02 + 3.1 * std::fabs(u(random));
    const double r = 0.9 + 0.5 * u(random), s = 0.9 + 0.5 * u(random);
    const Vec<3> x[4] = { Vec<3>(0, 0, 0), Vec<3>(1, 0, 0), Vec<3>(0.5 + 0.3 * u(random), r, 0),
      Vec<3>(0.5 + 0.3 * u(random), s * std::cos(phi), s * std::sin(phi)) };
    const double q = MeanEdgeShape<3>::value({ x[0], x[1], x[2], x[3] });
    ASSERT_LE(q, angleCap(phi) * (1.0 + 1e-12));
    closest = std::min(closest, angleCap(phi) - q);
  }
  EXPECT_LT(closest, 0.005);
}

TEST(EdgeBound, RegularFacetsGiveTheTable)
{
  // one tetrahedron fills a small angle best; at 141 degrees two regular ones fit exactly
  for (double degrees : { 5.0, 10.0, 30.0, 60.0 })
  {
    EXPECT_NEAR(hinge(degrees * pi / 180.0).bound, angleCap(degrees * pi / 180.0), 5e-3);
  }
  EXPECT_NEAR(hinge(2.0 * std::acos(1.0 / 3.0)).bound, 1.0, 1e-6);
  EXPECT_GT(hinge(350.0 * pi / 180.0).bound, 0.99);
  EXPECT_EQ(hinge(0.0).bound, hinge(2.0 * pi).bound) << "folded onto each other: all around";
}

TEST(EdgeBound, NoFillingByOneOrTwoIsBetter)
{
  // brute force over the shared apex of two tetrahedra, and the one that both facets span
  std::mt19937 random(9);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  for (int k = 0; k < 15; ++k)
  {
    const double theta = 0.5 + u(random), r = 0.6 + 0.8 * u(random), s = 0.6 + 0.8 * u(random);
    const Vec<3> a(0, 0, 0), b(1, 0, 0), c(u(random), r, 0);
    const Vec<3> d(u(random), s * std::cos(theta), s * std::sin(theta));
    double best = MeanEdgeShape<3>::value({ a, b, c, d });
    for (int j = 0; j < 4000; ++j)
    {
      const double phi = theta * u(random), t = 0.4 + 1.2 * u(random);
      const Vec<3> p(u(random), t * std::cos(phi), t * std::sin(phi));
      best = std::max(best,
        std::min(MeanEdgeShape<3>::value({ a, b, c, p }), MeanEdgeShape<3>::value({ a, b, p, d })));
    }
    const Vec<3> points[4] = { a, b, c, d };
    const double bound =
      surfaceBound<3>(points, { { { 0, 1, 2 }, 0, 0, true }, { { 1, 0, 3 }, 0, 0, true } }).bound;
    EXPECT_GE(bound, best);
  }
}

namespace
{
/// Two kept facets with the edge (0, 0, 0), (1, 0, 0) in common, at the angle theta; some are
/// needles.
struct Wedge
{
  Vec<3> a = Vec<3>(0, 0, 0), b = Vec<3>(1, 0, 0), c, d;
  double theta;

  explicit Wedge(TestRandom& random)
    : theta(3.14 + 3.1 * random())
  {
    const double r = std::pow(10.0, random()), s = std::pow(10.0, random());
    this->c = Vec<3>(0.5 + random(), r, 0);
    this->d = Vec<3>(0.5 + random(), s * std::cos(this->theta), s * std::sin(this->theta));
  }

  /// Both facets are given in the plane: the second is turned by the angle.
  Wedge(const Vec<3>& first, const Vec<3>& last, double angle)
    : c(first)
    , d(last[0], last[1] * std::cos(angle), last[1] * std::sin(angle))
    , theta(angle)
  {
  }

  /// The worse of the two tetrahedra that share p.
  double value(const Vec<3>& p) const
  {
    return std::min(MeanEdgeShape<3>::value({ this->a, this->b, this->c, p }),
      MeanEdgeShape<3>::value({ this->a, this->b, p, this->d }));
  }

  Vec<3> place(TestRandom& random) const
  {
    const double phi = this->theta * (0.5 + 0.499 * random()), t = std::pow(10.0, random() - 0.3);
    return Vec<3>(0.5 + random(), t * std::cos(phi), t * std::sin(phi));
  }

  /// The best of the two, by trying ever smaller steps: a lower bound.
  double brute(TestRandom& random) const
  {
    Vec<3> p = this->place(random);
    for (int k = 0; k < 500; ++k)
    {
      const Vec<3> other = this->place(random);
      p = this->value(other) > this->value(p) ? other : p;
    }
    for (double h = 0.3; h > 1e-7; h *= 0.7)
    {
      for (int k = 0; k < 60; ++k)
      {
        const Vec<3> other = p + h * Vec<3>(random(), random(), random());
        p = this->value(other) > this->value(p) ? other : p;
      }
    }
    return this->value(p);
  }

  double cap() const
  {
    Vec<3> apex1, apex2;
    const double exactly = std::numeric_limits<double>::infinity();
    facetCap(this->a, this->b, this->c, exactly, &apex1);
    facetCap(this->a, this->b, this->d, exactly, &apex2);
    return pairCap(this->theta, EdgeView(this->a, this->b, this->c, apex1),
      EdgeView(this->a, this->b, this->d, apex2), 1e-4);
  }
};
}

TEST(EdgeBound, ForbidsAsMuchIfAskedJustAboveIt)
{
  // that coarse levels prove nothing there must not be taken for a proof that nothing is forbidden
  TestRandom random(7);
  const double exactly = std::numeric_limits<double>::infinity();
  int found = 0;
  for (int k = 0; k < 400; ++k)
  {
    const Wedge wedge(random);
    Vec<3> apex1, apex2;
    const double facets = std::min(facetCap(wedge.a, wedge.b, wedge.c, exactly, &apex1),
      facetCap(wedge.a, wedge.b, wedge.d, exactly, &apex2));
    const FacetWedge angle{ wedge.theta, EdgeView(wedge.a, wedge.b, wedge.c, apex1),
      EdgeView(wedge.a, wedge.b, wedge.d, apex2), 0.0 };
    const double cap = edgeCap(facets, angle);
    if (cap < 0.99 * facets)
    {
      ++found;
      EXPECT_NEAR(edgeCap(cap * (1.0 + 1e-5), angle) / cap, 1.0, 1e-5) << "angle " << wedge.theta;
    }
  }
  EXPECT_GE(found, 20);
}

TEST(PairBound, WhatTwoTetrahedraHaveIsReached)
{
  TestRandom random(5);
  for (int k = 0; k < 3000; ++k)
  {
    const Wedge wedge(random);
    const double quality = wedge.value(wedge.place(random));
    if (quality > 0.0)
    {
      ASSERT_GE(wedge.cap(), quality * (1.0 - 1e-12)) << "angle " << wedge.theta;
    }
  }
}

TEST(PairBound, AgainstBruteForce)
{
  TestRandom random(6);
  int sharp = 0;
  for (int k = 0; k < 200; ++k)
  {
    const Wedge wedge(random);
    const double best = wedge.brute(random);
    if (best > 0.0)
    {
      const double cap = wedge.cap();
      EXPECT_GE(cap, best * (1.0 - 1e-12)) << "not an upper bound";
      sharp += cap < best * 1.002 + 1e-12;
    }
  }
  EXPECT_GT(sharp, 150) << "brute force may fail now and then, not often";
}

namespace
{
/// Climbs from x by ever smaller steps along the axes: the greatest value that is found.
template <std::size_t N, class F>
double climb(std::array<double, N> x, F&& value)
{
  double best = value(x);
  for (double h = 0.3; h > 1e-7; h *= 0.5)
  {
    for (bool better = true; better;)
    {
      better = false;
      for (std::size_t k = 0; k < 2 * N; ++k)
      {
        std::array<double, N> y = x;
        y[k / 2] += k % 2 ? h : -h;
        const double other = value(y);
        better = better || other > best;
        x = other > best ? y : x;
        best = std::max(best, other);
      }
    }
  }
  return best;
}

/// Best S of a tetrahedron with the edge (0, 0, 0), (1, 0, 0) and the angle phi there: on the
/// facet whose third node is c, or on any.
double bruteAngle(const Vec<3>& c, double phi)
{
  return climb<2>({ 0.5, 0.5 },
    [&](const std::array<double, 2>& x)
    {
      return MeanEdgeShape<3>::value({ Vec<3>(0, 0, 0), Vec<3>(1, 0, 0), c,
        Vec<3>(x[0], std::fabs(x[1]) * std::cos(phi), std::fabs(x[1]) * std::sin(phi)) });
    });
}

double bruteAngle(double phi)
{
  return climb<2>({ 0.5, 0.5 },
    [&](const std::array<double, 2>& x)
    { return bruteAngle(Vec<3>(x[0], std::fabs(x[1]), 0.0), phi); });
}

/// The least angle, up to `most`, at which best(angle), which grows up to there, reaches q.
template <class F>
double leastAngle(double q, double most, F&& best)
{
  double low = 0.0, high = most;
  for (int k = 0; k < 20; ++k)
  {
    const double middle = 0.5 * (low + high);
    (best(middle) < q ? low : high) = middle;
  }
  return high;
}
}

/// The edge that limits CGAL's dino. One tetrahedron is bad there. Two could have .0859 by their
/// angles, but not with one node. Three need the least angles at which the outer ones, on their
/// facets, and the inner one have that quality, and more of them need more.
TEST(PairBound, NeedlesOfTheDinosaur)
{
  const Vec<3> points[4] = { Vec<3>(0, 0, 0), Vec<3>(56.043, 6.976, -13.05),
    Vec<3>(55.704, 14.619, -9.98), Vec<3>(-5.683, 4.337, -0.62) };
  const double bound =
    surfaceBound<3>(points, { { { 1, 0, 2 }, 0, 0, true }, { { 0, 1, 3 }, 0, 0, true } }).bound;

  // The edge becomes (0, 0, 0), (1, 0, 0): each third node is at `along` and `off`.
  const double length = points[1].norm();
  const Vec<3> edge = points[1] / length, c = points[2] / length, d = points[3] / length;
  const Vec<3> awayC = c - c.dot(edge) * edge, awayD = d - d.dot(edge) * edge;
  const double theta = std::acos(awayC.dot(awayD) / (awayC.norm() * awayD.norm()));
  const Vec<3> first(c.dot(edge), awayC.norm(), 0.0), last(d.dot(edge), awayD.norm(), 0.0);

  const Wedge wedge(first, last, theta);
  EXPECT_LT(MeanEdgeShape<3>::value({ wedge.a, wedge.b, wedge.c, wedge.d }), bound);
  TestRandom random(7);
  EXPECT_LT(wedge.brute(random), bound);
  const auto needed = [&](double q)
  {
    return leastAngle(q, 0.5, [&](double phi) { return bruteAngle(first, phi); }) +
      leastAngle(q, 0.5, [&](double phi) { return bruteAngle(phi); }) +
      leastAngle(q, 0.5, [&](double phi) { return bruteAngle(last, phi); });
  };
  EXPECT_LE(needed(bound * (1.0 - 1e-4)), theta) << "not sharp";
  EXPECT_GT(needed(bound * (1.0 + 1e-4)), theta) << "not an upper bound";
}

TEST(PairBound, UnusualFacets)
{
  const EdgeView usual(
    Vec<3>(0, 0, 0), Vec<3>(1, 0, 0), Vec<3>(0.5, 0.9, 0), Vec<3>(0.5, 0.3, 0.8));
  for (double off : { 1e-6, 1e-80, 1e-160, 1e-300 })
  {
    const EdgeView needle(
      Vec<3>(0, 0, 0), Vec<3>(1, 0, 0), Vec<3>(0.5, off, 0), Vec<3>(0.5, 0.3, 0.8));
    for (double theta : { 1e-9, 1.0, pi, 6.2831853 })
    {
      EXPECT_GE(pairCap(1.0, usual, needle, 1e-3), 1e-3 * off) << off << ": it is as good as that";
      EXPECT_TRUE(off < 1e-6 || pairCap(theta, usual, needle, 1e-3) < 0.1) << off << ", " << theta;
    }
  }
  EXPECT_GE(pairCap(2.0 * std::acos(1.0 / 3.0), usual, usual, 1e-3), 0.99);
  EXPECT_GE(pairCap(2.0 * std::acos(1.0 / 3.0), usual, usual, 1e-3, 0.5), 0.5) << "enough";
}
