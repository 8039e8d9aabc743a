// SPDX-License-Identifier: BSD-3-Clause
// The proof of distance against brute force, and changes that it must refuse.
#include "SlidingBoxes.h"

using namespace meshopt;

namespace
{
using Piece = SurfacePiece<3>;

/// A square of n x n boxes, two triangles each, with the heights of a function.
template <class F>
std::vector<Piece> sheet(int n, F&& height)
{
  std::vector<Piece> pieces;
  const auto at = [&](int i, int j)
  {
    const double u = i / double(n), v = j / double(n);
    return Vec<3>(u, v, height(u, v));
  };
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < n; ++j)
    {
      pieces.push_back({ { at(i, j), at(i + 1, j), at(i + 1, j + 1) }, 0, 0 });
      pieces.push_back({ { at(i, j), at(i + 1, j + 1), at(i, j + 1) }, 0, 0 });
    }
  }
  return pieces;
}

ReferenceSurface reference(const std::vector<Piece>& pieces, double tolerance)
{
  ReferenceSurface surface;
  for (const Piece& piece : pieces)
  {
    surface.add(piece.x, piece.patch, true, true);
  }
  surface.finish(tolerance, 1e-15);
  return surface;
}

std::vector<std::array<Vec<3>, 3>> facetsOf(const std::vector<Piece>& pieces)
{
  std::vector<std::array<Vec<3>, 3>> facets;
  for (const Piece& piece : pieces)
  {
    facets.push_back(piece.x);
  }
  return facets;
}

TEST(ReferenceSurface, TheNearestPointAgainstBruteForce)
{
  const auto hill = sheet(8, [](double u, double v) { return 0.3 * std::sin(4 * u) * v; });
  const ReferenceSurface surface = reference(hill, 1e-3);
  TestRandom random(1);
  for (int k = 0; k < 300; ++k)
  {
    const Vec<3> x(random(), random(), random());
    Vec<3> there;
    const int facet = surface.project(0, x, there);
    ASSERT_GE(facet, 0);
    double best = std::numeric_limits<double>::infinity();
    for (const Piece& piece : hill)
    {
      best = std::min(best, distanceTo(piece.x, x));
    }
    EXPECT_NEAR((there - x).norm(), best, 1e-12);
    EXPECT_NEAR(distanceTo(hill[facet].x, there), 0.0, 1e-12);
  }
  Vec<3> there;
  EXPECT_EQ(surface.project(1, Vec<3>::Zero(), there), -1); // no such patch
}

/// Turned: seen from behind, beside the surface, and higher than the tolerance.
TEST(ReferenceSurface, SaysWhichFacetsAreTurned)
{
  constexpr double tolerance = 0.01;
  const ReferenceSurface surface = reference(
    sheet(4, [](double, double) { return 0.0; }), tolerance);
  const auto piece = [](double size, double height)
  {
    return Piece{ { Vec<3>(0.4, 0.4, height), Vec<3>(0.4 + size, 0.4, height),
                    Vec<3>(0.4, 0.4 + size, height) },
      0, 0 };
  };
  const auto turned = [](Piece p)
  {
    std::swap(p.x[1], p.x[2]);
    return p;
  };
  EXPECT_FALSE(surface.isTurned(piece(0.1, 0.001)));
  EXPECT_TRUE(surface.isTurned(turned(piece(0.1, 0.001))));
  EXPECT_FALSE(surface.isTurned(turned(piece(0.1, 2.0 * tolerance)))); // nothing lies there
  // The altitude of a right angle with equal sides is its size over the root of 2.
  EXPECT_FALSE(surface.isTurned(turned(piece(1.4 * tolerance, 0.001))));
  EXPECT_TRUE(surface.isTurned(turned(piece(1.5 * tolerance, 0.001))));
}

TEST(ReferenceSurface, AcceptsOnlyWhatIsWithinTheToleranceBothWays)
{
  int accepted = 0, refused = 0;
  for (double tolerance : { 0.002, 0.01, 0.05 })
  {
    for (double amplitude : { 0.0, 0.003, 0.02, 0.1, 0.15 })
    {
      const auto shape = [&](double u, double v)
      { return amplitude * std::sin(5 * u + 1) * std::cos(4 * v); };
      const auto fine = sheet(9, shape);
      const ReferenceSurface surface = reference(fine, tolerance);
      for (int n : { 2, 3, 5, 6, 9 })
      {
        // Of another number of boxes: the border is another one, too, but only by a sagitta.
        const auto coarse = sheet(n, shape);
        const double there = sampledDistance(facetsOf(coarse), facetsOf(fine), 12);
        const double back = sampledDistance(facetsOf(fine), facetsOf(coarse), 12);
        if (surface.covers(fine, coarse))
        {
          ++accepted;
          EXPECT_LE(there, tolerance) << amplitude << ' ' << n;
          EXPECT_LE(back, tolerance) << amplitude << ' ' << n;
        }
        else
        {
          ++refused;
          EXPECT_GT(std::max(there, back), 0.5 * tolerance) << amplitude << ' ' << n;
        }
      }
    }
  }
  EXPECT_GT(accepted, 10);
  EXPECT_GT(refused, 10);
}

TEST(ReferenceSurface, ABumpIsNotCutOff)
{
  // From after to before all is well; from before to after the tip is lost.
  const auto bump = sheet(10,
    [](double u, double v) { return std::max(0.0, 0.03 - 0.3 * std::hypot(u - 0.5, v - 0.5)); });
  const auto flat = sheet(10, [](double, double) { return 0.0; });
  EXPECT_FALSE(reference(bump, 0.01).covers(bump, flat));
  EXPECT_TRUE(reference(bump, 0.05).covers(bump, flat));
}

TEST(ReferenceSurface, AFoldIsRefused)
{
  const auto flat = sheet(4, [](double, double) { return 0.0; });
  auto folded = flat;
  for (Piece& piece : folded)
  {
    for (Vec<3>& x : piece.x)
    {
      x[0] = x == Vec<3>(0.5, 0.5, 0.0) ? 0.9 : x[0]; // over its neighbours
    }
  }
  EXPECT_FALSE(reference(flat, 0.1).covers(flat, folded));
}

/// A square of six facets with two nodes inside: if the left one is on the right, two of the facets
/// are turned over.
std::vector<Piece> squareWithTwoNodes(double left, double right)
{
  const Vec<3> a(0, 0, 0), b(1, 0, 0), c(1, 1, 0), d(0, 1, 0);
  const Vec<3> p(left, 0.5, 0), q(right, 0.5, 0);
  std::vector<Piece> pieces;
  for (const std::array<Vec<3>, 3>& x : std::vector<std::array<Vec<3>, 3>>{
         { a, p, d }, { a, q, p }, { a, b, q }, { b, c, q }, { c, p, q }, { c, d, p } })
  {
    pieces.push_back({ x, 0, 0 });
  }
  return pieces;
}

TEST(ReferenceSurface, AFoldMayBeSmoothedAndNotGrow)
{
  const auto flat = squareWithTwoNodes(0.3, 0.7), small = squareWithTwoNodes(0.52, 0.48),
             large = squareWithTwoNodes(0.6, 0.4);
  for (double tolerance : { 0.01, 0.2 })
  {
    const ReferenceSurface surface = reference(flat, tolerance);
    EXPECT_TRUE(surface.covers(large, flat));
    EXPECT_TRUE(surface.covers(large, small));
    EXPECT_FALSE(surface.covers(small, large));
    EXPECT_FALSE(surface.covers(flat, small));
  }
}

TEST(ReferenceSurface, AThinWallKeepsItsThickness)
{
  // Two sheets back to back, nearer to each other than the tolerance.
  constexpr double thickness = 0.01;
  auto wall = sheet(6, [](double u, double v) { return 0.02 * std::sin(6 * u) * std::sin(6 * v); });
  const auto front = wall;
  for (const Piece& piece : front)
  {
    Piece back = piece;
    std::swap(back.x[1], back.x[2]);
    for (Vec<3>& x : back.x)
    {
      x[2] -= thickness;
    }
    wall.push_back(back);
  }
  const ReferenceSurface surface = reference(wall, 0.1);
  const auto pressed = sheet(6,
    [&](double u, double v) { return 0.02 * std::sin(6 * u) * std::sin(6 * v) - 0.9 * thickness; });
  EXPECT_FALSE(surface.covers(front, pressed));
  const auto little = sheet(6,
    [&](double u, double v) { return 0.02 * std::sin(6 * u) * std::sin(6 * v) - 0.1 * thickness; });
  EXPECT_TRUE(surface.covers(front, little));
}

// The other sheet is farther away than a facet is long, by up to sixty times.
TEST(ReferenceSurface, AThickWallLeavesASeventhOfItsThickness)
{
  constexpr double share = 0.75; // of the tolerance, beside needles and the sides of curves
  for (double thickness : { 0.02, 0.3, 3.0, 10.0 })
  {
    const auto front = sheet(8, [](double, double) { return 0.0; });
    auto wall = front;
    for (Piece piece : front)
    {
      std::swap(piece.x[1], piece.x[2]);
      for (Vec<3>& x : piece.x)
      {
        x[2] -= thickness;
      }
      wall.push_back(piece);
    }
    for (double tolerance : { 0.1 * thickness, 20.0 * thickness, 1e300 })
    {
      const ReferenceSurface surface = reference(wall, tolerance);
      for (int k = 0; k < static_cast<int>(wall.size()); ++k)
      {
        const double room = std::min(tolerance, thickness / 7.0);
        EXPECT_NEAR(surface.tolerance(k), share * room, 1e-9 * thickness);
      }
    }
  }
}

TEST(ReferenceSurface, HeightsBoundTheDistance)
{
  const auto shape = [](double u, double v) { return 0.05 * std::sin(5 * u) * std::cos(4 * v); };
  const auto fine = sheet(12, shape), coarse = sheet(5, shape);
  const ReferenceSurface surface = reference(fine, 0.05);
  double proved = 0.0;
  for (const Piece& piece : coarse)
  {
    proved = std::max(
      proved, std::max(surface.offset(piece).height, surface.offset(piece).distance));
  }
  EXPECT_GE(proved, sampledDistance(facetsOf(coarse), facetsOf(fine), 10) - 1e-12);
  EXPECT_LT(proved, 0.05);
}

/// A sheet that turns by 80 degrees at u = 1/2, and goes up from there.
double stepUp(double u, double)
{
  return std::max(0.0, u - 0.5) * std::tan(80.0 * std::acos(-1.0) / 180.0);
}

TEST(ReferenceSurface, FacetsBesideASharpEdgeMayChange)
{
  const auto before = sheet(6, stepUp);
  const ReferenceSurface surface = reference(before, 0.01);
  const auto moved = [&](const Vec<3>& node, const Vec<3>& to)
  {
    auto after = before;
    for (Piece& piece : after)
    {
      for (Vec<3>& x : piece.x)
      {
        x = (x - node).norm() < 1e-9 ? to : x;
      }
    }
    return after;
  };
  const double third = 2.0 / 6.0;
  // In the flat part, and along the edge: the same points.
  const Vec<3> flat(third, 0.5, 0.0), edge(0.5, 0.5, 0.0);
  EXPECT_TRUE(surface.covers(before, moved(flat, flat + Vec<3>(0.05, 0.03, 0.0))));
  EXPECT_TRUE(surface.covers(before, moved(edge, edge + Vec<3>(0.0, 0.05, 0.0))));
  EXPECT_TRUE(surface.covers(before, moved(flat, flat + Vec<3>(0.05, 0.03, 0.004))));
  // Away from the edge, over one of its sides: cuts the other off.
  EXPECT_FALSE(surface.covers(before, moved(edge, edge + Vec<3>(-0.1, 0.0, 0.0))));
  EXPECT_FALSE(surface.covers(before, moved(edge, Vec<3>(0.52, 0.5, stepUp(0.52, 0.5)))));
  // Another number of boxes: the edge is cut off.
  EXPECT_FALSE(surface.covers(before, sheet(5, stepUp)));
}

TEST(ReferenceSurface, RoomIsKeptTowardsSheetsThatFaceThePoint)
{
  const auto flat = [](double, double) { return 0.0; };
  auto two = sheet(6, flat);
  const auto alone = reference(two, 0.1);
  const Vec<3> x(0.5, 0.5, 0.0), down(0.5, 0.5, -0.08), up(0.5, 0.5, 0.08);
  EXPECT_TRUE(alone.limits(x, 0.1).empty()); // neighbours do not count
  EXPECT_EQ(alone.withinRoom(x, down, 0.1), down);
  EXPECT_NEAR((alone.withinRoom(x, down, 0.05) - Vec<3>(0.5, 0.5, -0.05)).norm(), 0.0, 1e-15);
  for (Piece piece : sheet(6, flat))
  {
    std::swap(piece.x[1], piece.x[2]);
    for (Vec<3>& p : piece.x)
    {
      p[2] -= 0.04;
    }
    two.push_back(piece);
  }
  const auto wall = reference(two, 0.1);
  EXPECT_NEAR(wall.withinRoom(x, down, 0.1)[2], -0.04 / 7.0, 1e-15);
  EXPECT_FALSE(wall.limits(x, 0.041 / 7.0).empty());
  EXPECT_TRUE(wall.limits(x, 0.039 / 7.0).empty()); // no motion is that long
  EXPECT_EQ(wall.withinRoom(x, up, 0.1), up);       // the wall becomes thicker
  const Vec<3> along(0.58, 0.5, 0.0);
  EXPECT_EQ(wall.withinRoom(x, along, 0.1), along);
  // A region that is thin as a whole may not become much thicker either.
  ReferenceSurface thin;
  for (const Piece& piece : two)
  {
    thin.add(piece.x, piece.patch, true, true, 0.04);
  }
  thin.finish(0.1, 1e-15);
  EXPECT_NEAR(thin.withinRoom(x, up, 0.1)[2], 0.04 / 7.0, 1e-15);
  EXPECT_EQ(thin.withinRoom(x, along, 0.1), along);
}

TEST(ReferenceSurface, AtAFeatherEdgeOfAThinRegionOnlyAPartOfItsThicknessMayBeUsed)
{
  // A wedge over the unit square, of height 0.04 at x = 1, and mean thickness 0.02.
  // `isBehind`: whether its base is seen from outside, or belongs to the region below.
  const auto wedge = [](double thickness, bool isBehind)
  {
    ReferenceSurface result;
    for (const Piece& piece : sheet(4, [](double x, double) { return 0.04 * x; }))
    {
      result.add(piece.x, 0, true, true, thickness);
    }
    for (Piece piece : sheet(4, [](double, double) { return 0.0; }))
    {
      if (isBehind)
      {
        std::swap(piece.x[1], piece.x[2]);
      }
      result.add(piece.x, 1, true, isBehind, isBehind ? thickness : -thickness);
    }
    result.finish(0.1, 1e-15);
    return result;
  };
  const Vec<3> edge(0.0, 0.6, 0.0), up(0.0, 0.6, 0.05), along(0.0, 0.65, 0.0);
  EXPECT_EQ(wedge(ReferenceSurface::Thick, true).withinRoom(edge, up, 0.1), up);
  for (const bool isBehind : { true, false })
  {
    const ReferenceSurface thin = wedge(0.02, isBehind);
    EXPECT_NEAR(thin.withinRoom(edge, up, 0.1)[2], 0.02 / 7.0, 1e-15);
    EXPECT_EQ(thin.withinRoom(edge, along, 0.1), along);
  }
}

TEST(ReferenceSurface, WhatWasHighMayBeReplacedByWhatIsAsHigh)
{
  // Beside a curve that has moved, facets may be higher than elsewhere.
  const auto at = [](double z) { return [z](double, double) { return z; }; };
  const auto surface = reference(sheet(4, at(0.0)), 0.1);
  EXPECT_TRUE(surface.covers(sheet(4, at(0.0)), sheet(3, at(0.07))));
  EXPECT_FALSE(surface.covers(sheet(4, at(0.0)), sheet(3, at(0.08))));
  EXPECT_TRUE(surface.covers(sheet(4, at(0.085)), sheet(3, at(0.08))));
  EXPECT_FALSE(surface.covers(sheet(4, at(0.085)), sheet(3, at(0.09))));
  EXPECT_FALSE(surface.covers(sheet(4, at(0.098)), sheet(3, at(0.098))));
}
}
