// SPDX-License-Identifier: BSD-3-Clause
// Caps in sight against places that were tried one by one, and against meshes that exist.
#include "Bound/SightBound.h"
#include "Bound/ApexBound.h"
#include "Optimize/Optimizer.h"
#include "Quality/Shape.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace meshopt;

namespace
{
constexpr long Many = 1000000;

/// A surface of triangles, numbered as in VTK: from inside they turn like those of a cell.
struct Body
{
  std::vector<Vec<3>> points;
  std::vector<KeptSide<3>> sides;

  void addBox(const Vec<3>& low, const Vec<3>& high, int n)
  {
    // Each face a lattice of n x n squares, of two triangles each; nodes are found by their place.
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int end = 0; end < 2; ++end)
      {
        for (int i = 0; i < n; ++i)
        {
          for (int j = 0; j < n; ++j)
          {
            const auto at = [&](int di, int dj)
            {
              Vec<3> x;
              x[axis] = end ? high[axis] : low[axis];
              const int u = (axis + 1) % 3, v = (axis + 2) % 3;
              x[u] = low[u] + (high[u] - low[u]) * (i + di) / n;
              x[v] = low[v] + (high[v] - low[v]) * (j + dj) / n;
              return this->add(x);
            };
            const Index a = at(0, 0), b = at(1, 0), c = at(1, 1), d = at(0, 1);
            this->sides.push_back({ end ? Facet<3>{ a, c, b } : Facet<3>{ a, b, c } });
            this->sides.push_back({ end ? Facet<3>{ a, d, c } : Facet<3>{ a, c, d } });
          }
        }
      }
    }
  }

  Index add(const Vec<3>& x)
  {
    for (std::size_t p = this->first; p < this->points.size(); ++p)
    {
      if ((this->points[p] - x).norm() < 1e-9)
      {
        return static_cast<Index>(p);
      }
    }
    this->points.push_back(x);
    return static_cast<Index>(this->points.size()) - 1;
  }
  /// What is added from here on has no node in common with what is there.
  void separate() { this->first = this->points.size(); }

  std::array<Vec<3>, 3> corners(std::size_t s) const
  {
    const Facet<3>& f = this->sides[s].nodes;
    return { this->points[f[0]], this->points[f[1]], this->points[f[2]] };
  }
  double shape(std::size_t s, const Vec<3>& apex) const
  {
    const auto x = this->corners(s);
    return MeanEdgeShape<3>::value({ x[0], x[1], x[2], apex });
  }
  /// A box in a box, with the sides of the inner one turned, and a triangle that makes them one
  /// body.
  void addHollowBox(const Vec<3>& low, const Vec<3>& high)
  {
    this->addBox({ 0, 0, 0 }, { 1, 1, 1 }, 2);
    const std::size_t outer = this->sides.size();
    this->addBox(low, high, 2);
    for (std::size_t s = outer; s < this->sides.size(); ++s)
    {
      std::swap(this->sides[s].nodes[0], this->sides[s].nodes[1]);
    }
    this->sides.push_back(
      { { 0, this->sides[outer].nodes[0], this->sides[outer].nodes[1] }, None, 0, false });
  }
  double cap(std::size_t s, long steps = Many) const
  {
    return Sight(this->points.data(), this->sides).cap(s, 1e-9, 1.0, steps);
  }

  std::size_t first = 0;
};

/// Whether the open segment meets the triangle, by solving for the place.
bool meets(const Vec<3>& from, const Vec<3>& to, const std::array<Vec<3>, 3>& x)
{
  Eigen::Matrix3d m;
  m.col(0) = x[1] - x[0];
  m.col(1) = x[2] - x[0];
  m.col(2) = from - to;
  if (std::fabs(m.determinant()) < 1e-14)
  {
    return false;
  }
  const Eigen::Vector3d r = m.partialPivLu().solve(Eigen::Vector3d(from - x[0]));
  return r[0] >= 0.0 && r[1] >= 0.0 && r[0] + r[1] <= 1.0 && r[2] > 1e-9 && r[2] < 1.0 - 1e-9;
}

/// The best place inside a box, by ever smaller steps from many beginnings: an estimate from below.
double bestInBox(const Body& body, std::size_t s, const Vec<3>& low, const Vec<3>& high)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  std::normal_distribution<double> normal;
  double best = 0.0;
  Vec<3> place = 0.5 * (low + high);
  for (int k = 0; k < 20000; ++k)
  {
    const double step = std::pow(10.0, -5.0 * k / 20000.0);
    Vec<3> x = place;
    for (int i = 0; i < 3; ++i)
    {
      x[i] += step * normal(random) * (high[i] - low[i]);
      x[i] = std::min(std::max(x[i], low[i]), high[i]);
    }
    const double q = body.shape(s, x);
    place = q > best ? x : place;
    best = std::max(best, q);
  }
  return best;
}
}

TEST(SightBound, InABoxItIsTheBestPlaceInTheBox)
{
  // From a cube, where nothing is in the way, to a plate a hundred times as wide as it is thick.
  for (const double thick : { 1.0, 0.3, 0.03, 0.01 })
  {
    const Vec<3> low(0.1, 0.2, 0.3), high(1.1, 1.2, 0.3 + thick);
    Body body;
    body.addBox(low, high, 3);
    for (std::size_t s = 0; s < body.sides.size(); s += 5)
    {
      const double best = bestInBox(body, s, low, high), cap = body.cap(s);
      EXPECT_GE(cap * (1.0 + 1e-9), best) << "side " << s << " thickness " << thick;
      EXPECT_LE(cap, best * 1.01) << "side " << s << " thickness " << thick;
    }
  }
}

TEST(SightBound, ThinWallsAreBoundByWhatIsOpposite)
{
  Body body; // all its facets are well shaped; one wall is thin
  body.addHollowBox({ 0.1, 0.1, 0.02 }, { 0.9, 0.9, 0.9 });
  for (KeptSide<3>& side : body.sides)
  {
    side.quality = 1e-3; // of any bad cells
  }
  double alone = 1.0, least = 1.0;
  for (std::size_t s = 0; s + 1 < body.sides.size(); ++s)
  {
    const auto x = body.corners(s);
    alone = std::min(alone, facetCap(x[0], x[1], x[2]));
    least = std::min(least, body.cap(s));
  }
  const double inSight = boundInSight(body.points.data(), body.sides, alone, Many);
  EXPECT_LT(inSight, 0.2 * alone);
  EXPECT_NEAR(inSight, least, 0.01 * least);
}

TEST(SightBound, TheOneThatSeesLeastComesFirst)
{
  Body body;
  body.addHollowBox({ 0.1, 0.1, 0.02 }, { 0.9, 0.9, 0.9 });
  double least = 1.0;
  std::size_t narrowest = 0;
  for (std::size_t s = 0; s + 1 < body.sides.size(); ++s)
  {
    const double cap = body.cap(s);
    narrowest = cap < least ? s : narrowest;
    least = std::min(least, cap);
    body.sides[s].quality = 1e-3; // of a cell that is stuck
  }
  const double alone = 1.0;
  long left = Many;
  Sight(body.points.data(), body.sides).cap(narrowest, 2e-3, alone, left);
  // Others have worse cells, and the steps are enough for one side; those around it are alike.
  body.sides[narrowest].quality = 2e-3;
  EXPECT_LT(boundInSight(body.points.data(), body.sides, alone, Many - left), 1.5 * least);
}

TEST(SightBound, NoPlaceInSightIsBetter)
{
  Body body; // what is between the boxes is not convex
  body.addHollowBox({ 0.3, 0.05, 0.1 }, { 0.6, 0.8, 0.5 });
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  int seen = 0, lowered = 0;
  for (std::size_t s = 0; s + 1 < body.sides.size(); ++s)
  {
    const auto x = body.corners(s);
    const double cap = body.cap(s);
    lowered += cap < 0.99 * facetCap(x[0], x[1], x[2]);
    for (int k = 0; k < 300; ++k)
    {
      const Vec<3> apex(u(random), u(random), u(random));
      const auto blocked = [&](const std::array<double, 3>& w)
      {
        const Vec<3> from = w[0] * x[0] + w[1] * x[1] + w[2] * x[2];
        for (std::size_t o = 0; o < body.sides.size(); ++o)
        {
          if (o != s && meets(from, apex, body.corners(o)))
          {
            return true;
          }
        }
        return false;
      };
      const double third = 1.0 / 3.0;
      if (!blocked({ third, third, third }) && !blocked({ 0.8, 0.1, 0.1 }) &&
        !blocked({ 0.1, 0.8, 0.1 }) && !blocked({ 0.1, 0.1, 0.8 }))
      {
        ++seen;
        EXPECT_LE(body.shape(s, apex), cap * (1.0 + 1e-9));
      }
    }
  }
  EXPECT_GT(seen, 1000);
  EXPECT_GT(lowered, 10);
}

TEST(SightBound, ABodyThatPassesThroughIsNotInTheWay)
{
  Body body;
  body.addBox({ 0, 0, 0 }, { 1, 1, 1 }, 2);
  const double alone = body.cap(0);
  body.separate();
  body.addBox({ -1, -1, -0.5 }, { 2, 2, 0.02 }, 2);
  EXPECT_EQ(body.cap(0), alone);
  Body joined = body;
  // One triangle that has nodes of both makes them one.
  joined.sides.push_back({ { 0, 1, static_cast<Index>(body.points.size()) - 1 } });
  bool lower = false;
  for (std::size_t s = 0; s < 48; ++s)
  {
    lower = lower || joined.cap(s) < 0.5 * body.cap(s);
  }
  EXPECT_TRUE(lower);
}

TEST(SightBound, WhatLiesInThePlaneOfAFacetHidesNothing)
{
  Body body;
  body.addBox({ 0.1, 0.2, 0.3 }, { 1.1, 0.9, 1.2 }, 3);
  std::vector<double> caps;
  for (std::size_t s = 0; s < body.sides.size(); ++s)
  {
    caps.push_back(body.cap(s));
  }
  // All facets once more, from the other side, as between two regions or at the lips of a crack.
  const std::size_t number = body.sides.size();
  for (std::size_t s = 0; s < number; ++s)
  {
    Facet<3> f = body.sides[s].nodes;
    std::swap(f[0], f[1]);
    body.sides.push_back({ f });
  }
  for (std::size_t s = 0; s < number; ++s)
  {
    EXPECT_NEAR(body.cap(s), caps[s], 1e-3 * caps[s]);
  }
}

TEST(SightBound, FewerStepsLeaveAHigherBound)
{
  Body body;
  body.addHollowBox({ 0.1, 0.1, 0.02 }, { 0.9, 0.9, 0.9 });
  std::size_t thin = 0; // a side of the thin wall, seen from outside the hollow
  while (body.corners(thin)[0][2] + body.corners(thin)[1][2] + body.corners(thin)[2][2] > 0.0)
  {
    ++thin;
  }
  double last = 1.0;
  for (const long steps : { 0L, 3L, 10L, 100L, Many })
  {
    const double cap = body.cap(thin, steps);
    EXPECT_LE(cap, last * (1.0 + 1e-12));
    last = cap;
  }
  EXPECT_LT(last, 0.5 * body.cap(thin, 0));
}

TEST(SightBound, SidesThatSayNothing)
{
  Body body;
  body.addBox({ 0, 0, 0 }, { 1, 1, 0.01 }, 2);
  // Qualities that are not known, inverted cells, and sides of which it is not known where the mesh
  // is; cells that are as good as the bound.
  EXPECT_EQ(boundInSight(body.points.data(), body.sides, 0.5, Many), 0.5);
  for (KeptSide<3>& side : body.sides)
  {
    side.quality = 0.499;
  }
  EXPECT_EQ(boundInSight(body.points.data(), body.sides, 0.5, Many), 0.5);
  for (KeptSide<3>& side : body.sides)
  {
    side.quality = 1e-3;
    side.oriented = false;
  }
  EXPECT_EQ(boundInSight(body.points.data(), body.sides, 0.5, Many), 0.5);
  // Points that are not finite: no side has them in the way, and none begins there.
  for (KeptSide<3>& side : body.sides)
  {
    side.oriented = true;
  }
  body.points[0][1] = std::nan("");
  EXPECT_GT(boundInSight(body.points.data(), body.sides, 0.5, Many), 1e-3);
}

TEST(SightBound, StepsFollowTheCells)
{
  EXPECT_EQ(stepsInSight(1), 500);
  EXPECT_EQ(stepsInSight(3000), 1500);
  EXPECT_EQ(stepsInSight(100000), 7000);
  EXPECT_EQ(stepsInSight(1000000000), 20000);
  for (long cells = 1; cells < 1000000; cells += 1 + cells / 10)
  {
    EXPECT_LE(stepsInSight(cells), stepsInSight(cells + 1));
  }
}

TEST(SightBound, NoMeshIsAboveTheBoundOfARun)
{
  // A thin plate whose inner nodes were moved: what stands opposite holds its worst cells.
  MeshInput<3> in = jitteredGrid<3>(6, 0.2, 3);
  for (Vec<3>& x : in.points)
  {
    x[2] *= 0.05;
  }
  SimplexMesh<3> mesh;
  ASSERT_FALSE(SimplexMesh<3>::build(in, mesh));
  const double alone = surfaceBound(mesh).bound;
  NodalMetric<3> metric;
  Options options;
  const Report report = optimize(mesh, metric, options, Control());
  EXPECT_GE(report.bound, report.worstAfter);
  EXPECT_LE(report.bound, alone);
  const KeptSurface<3> surface(mesh);
  EXPECT_EQ(report.bound,
    boundInSight(
      surface.points.data(), surface.sides, alone, stepsInSight(report.history.back().cells)));
}
