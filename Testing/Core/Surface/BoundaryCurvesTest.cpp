// SPDX-License-Identifier: BSD-3-Clause
// What the boundary slides along: pieces and corners, from the mesh itself or from a geometry.
#include "Surface/BoundaryCurves.h"
#include "PlaneMeshes.h"

using namespace meshopt;

namespace
{
struct Made
{
  SimplexMesh<2> mesh;
  BoundaryCurves curves;
  std::string error;
};

Made make(const MeshInput<2>& in, const CurveOptions& options = {},
  const std::vector<std::uint8_t>& corners = {})
{
  Made made;
  made.mesh = buildMesh(in);
  MeshEditor<2> editor(made.mesh);
  made.curves.build(editor, options, corners);
  expectOnCurves(made.mesh, made.curves, 1e-12);
  return made;
}

Made make(const MeshInput<2>& in, const LineNetwork& geometry, const CurveOptions& options = {},
  const std::vector<std::uint8_t>& corners = {})
{
  Made made;
  made.mesh = buildMesh(in);
  MeshEditor<2> editor(made.mesh);
  made.error = made.curves.build(editor, geometry, options, corners);
  expectOnCurves(made.mesh, made.curves, 3e-3);
  if (!made.error.empty())
  {
    EXPECT_TRUE(slidingPoints(made.mesh).empty());
  }
  return made;
}

/// The boundary points without a place: corners.
std::vector<Vec<2>> corners(const SimplexMesh<2>& mesh)
{
  std::vector<Vec<2>> result;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    if (mesh.isPointAlive(p) && mesh.isBoundary(p) && mesh.freedom(p) == Freedom::Fixed)
    {
      result.push_back(mesh.point(p));
    }
  }
  return result;
}

bool contains(const std::vector<Vec<2>>& list, const Vec<2>& x)
{
  return std::find(list.begin(), list.end(), x) != list.end();
}

bool has(const std::string& text, const std::string& word)
{
  return text.find(word) != std::string::npos;
}
}

TEST(BoundaryCurves, SquareAndBracket)
{
  const Made square = make(jitteredGrid<2>(4, 0.2));
  EXPECT_EQ(square.curves.numberOfPieces(), 4u);
  EXPECT_EQ(corners(square.mesh).size(), 4u);
  EXPECT_EQ(slidingPoints(square.mesh).size(), 12u);
  const Made two = make(twoTriangles());
  EXPECT_EQ(two.curves.numberOfPieces(), 4u);
  const auto side = two.curves.span(two.mesh, 0, 1); // corner to corner
  ASSERT_TRUE(side);
  EXPECT_LT(
    (two.curves.at(side->part, 0.5 * (side->from + side->to)) - Vec<2>(0.5, 0)).norm(), 1e-15);
  EXPECT_FALSE(two.curves.span(two.mesh, 0, 3)); // the diagonal is no piece
  const Made l = make(bracket(4));
  EXPECT_EQ(l.curves.numberOfPieces(), 6u);
  EXPECT_EQ(corners(l.mesh).size(), 6u);
  EXPECT_TRUE(contains(corners(l.mesh), Vec<2>(0.5, 0.5)));
}

TEST(BoundaryCurves, SlitsHaveTwoSidesAndTheirTipsAreCorners)
{
  for (double angle : { 45.0, 170.0, 180.0 })
  {
    const Made inside = make(slitSquare(8, 0.25, 0.75), curveOptions(angle, true));
    EXPECT_EQ(inside.curves.numberOfPieces(), 4u + 2u) << angle; // single turns are corners anyway
    EXPECT_TRUE(contains(corners(inside.mesh), Vec<2>(0.25, 0.5)));
    EXPECT_TRUE(contains(corners(inside.mesh), Vec<2>(0.75, 0.5)));
  }
  const Made edge = make(slitSquare(8, 0.0, 0.5));
  EXPECT_EQ(edge.curves.numberOfPieces(), 5u + 2u);   // the left side is in two
  EXPECT_EQ(corners(edge.mesh).size(), 4u + 2u + 1u); // and the mouth has two lips
}

TEST(BoundaryCurves, InterfacesAndHoles)
{
  MeshInput<2> in = jitteredGrid<2>(4, 0.0);
  splitRegions(in);
  const Made regions = make(in);
  EXPECT_EQ(regions.curves.numberOfPieces(), 3u + 3u + 1u);
  EXPECT_EQ(corners(regions.mesh).size(), 4u + 2u);
  const Made hole = make(ring(16, 0.3, 1.0));
  EXPECT_EQ(hole.curves.numberOfPieces(), 2u);
  EXPECT_TRUE(corners(hole.mesh).empty());
  // the last point of a closed curve and the first are neighbours, too
  const auto span = hole.curves.span(hole.mesh, 15, 0);
  ASSERT_TRUE(span);
  EXPECT_NEAR(
    (hole.curves.at(span->part, 0.5 * (span->from + span->to)) - onCircle(15.5 / 16, 0.3)).norm(),
    0.0, 1e-4);
  EXPECT_TRUE(hole.curves.mayBeNeighbours(*span));
  EXPECT_FALSE(hole.curves.mayBeNeighbours({ span->part, 0.0, 0.3 * Pi }));
}

TEST(BoundaryCurves, CornersByAngleAndByFlag)
{
  const MeshInput<2> in = disc(16); // turns by 22.5 degrees
  EXPECT_EQ(make(in, curveOptions(30.0, true)).curves.numberOfPieces(), 1u);
  const Made all = make(in, curveOptions(20.0, true));
  EXPECT_EQ(all.curves.numberOfPieces(), 16u);
  EXPECT_TRUE(slidingPoints(all.mesh).empty());
  std::vector<std::uint8_t> flags(17, 0);
  flags[3] = 1;
  const Made one = make(in, curveOptions(45.0, true), flags);
  EXPECT_EQ(one.curves.numberOfPieces(), 1u); // from the corner around to itself
  EXPECT_EQ(corners(one.mesh).size(), 1u);
  flags[11] = 1;
  const Made two = make(in, curveOptions(45.0, true), flags);
  EXPECT_EQ(two.curves.numberOfPieces(), 2u);
  MeshInput<2> fixed = in;
  fixed.fixedPoints.assign(17, 0);
  fixed.fixedPoints[3] = fixed.fixedPoints[11] = 1;
  EXPECT_EQ(corners(make(fixed).mesh).size(), 2u);
}

TEST(BoundaryCurves, FinerGeometry)
{
  for (bool splines : { false, true })
  {
    const Made made = make(disc(16), loop(circle(64, 1.0, 0.5)), curveOptions(45.0, splines));
    ASSERT_EQ(made.error, "");
    EXPECT_EQ(made.curves.numberOfPieces(), 1u);
    EXPECT_EQ(slidingPoints(made.mesh).size(), 16u);
    for (Index p = 0; p < 16; ++p)
    {
      const auto span = made.curves.span(made.mesh, p, (p + 1) % 16);
      ASSERT_TRUE(span);
      const Vec<2> x = made.curves.at(span->part, 0.5 * (span->from + span->to));
      EXPECT_LT((x - onCircle((p + 0.5) / 16)).norm(), splines ? 1e-5 : 2e-3);
      EXPECT_NEAR(made.curves.sagitta(*span), 1.0 - std::cos(Pi / 16), 2e-3);
    }
  }
  // a corner of the mesh alone cuts the curve
  std::vector<std::uint8_t> flags(17, 0);
  flags[2] = flags[9] = 1;
  const Made cut = make(disc(16), loop(circle(64)), {}, flags);
  ASSERT_EQ(cut.error, "");
  EXPECT_EQ(cut.curves.numberOfPieces(), 2u);
  // the corners of the geometry are corners of the mesh: here every quarter
  LineNetwork quarters = loop(circle(64));
  quarters.corners.assign(64, 0);
  quarters.corners[0] = quarters.corners[16] = quarters.corners[32] = quarters.corners[48] = 1;
  const Made four = make(disc(16), quarters);
  ASSERT_EQ(four.error, "");
  EXPECT_EQ(four.curves.numberOfPieces(), 4u);
}

/// Each line is found among many, which are short and close to each other.
TEST(BoundaryCurves, GeometryOfManyTeeth)
{
  constexpr Index n = 60;
  std::vector<Vec<2>> teeth, fine;
  for (Index k = 0; k < n; ++k)
  {
    teeth.push_back(onCircle(double(k) / n, k % 2 ? 1.0 : 0.8));
  }
  for (Index k = 0; k < n; ++k)
  {
    for (int i = 0; i < 4; ++i)
    {
      fine.push_back(teeth[k] + 0.25 * i * (teeth[(k + 1) % n] - teeth[k]));
    }
  }
  const Made made = make(fan(teeth, Vec<2>::Zero()), loop(fine));
  ASSERT_EQ(made.error, "");
  EXPECT_EQ(made.curves.numberOfPieces(), std::size_t(n));
  for (Index p = 0; p < n; ++p)
  {
    const auto span = made.curves.span(made.mesh, p, (p + 1) % n);
    ASSERT_TRUE(span);
    const Vec<2> x = made.curves.at(span->part, 0.5 * (span->from + span->to));
    EXPECT_LT((x - 0.5 * (teeth[p] + teeth[(p + 1) % n])).norm(), 1e-12) << p;
  }
}

/// A closed line with one corner begins and ends there.
TEST(BoundaryCurves, GeometryWithOneCorner)
{
  for (Index at : { 0, 12, 44 })
  {
    LineNetwork geometry = loop(circle(64));
    geometry.corners.assign(64, 0);
    geometry.corners[at] = 1;
    for (bool another : { false, true })
    {
      std::vector<std::uint8_t> flags(17, 0);
      flags[another ? 5 : 16] = 1;
      const Made made = make(disc(16), geometry, {}, flags);
      ASSERT_EQ(made.error, "");
      EXPECT_EQ(made.curves.numberOfPieces(), another ? 2u : 1u);
      EXPECT_EQ(slidingPoints(made.mesh).size(), another ? 14u : 15u);
      for (Index p = 0; p < 16; ++p)
      {
        const auto span = made.curves.span(made.mesh, p, (p + 1) % 16);
        ASSERT_TRUE(span);
        const Vec<2> x = made.curves.at(span->part, 0.5 * (span->from + span->to));
        EXPECT_LT((x - onCircle((p + 0.5) / 16)).norm(), 1e-3) << at << " " << p;
      }
    }
  }
}

TEST(BoundaryCurves, GeometryOfASlitIsOneLineOrTwo)
{
  const LineNetwork square = loop({ { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } });
  LineNetwork one = square;
  one.points.emplace_back(0.25, 0.5);
  one.points.emplace_back(0.75, 0.5);
  one.lines.push_back({ 4, 5 });
  const Made made = make(slitSquare(8, 0.25, 0.75), one);
  EXPECT_EQ(made.error, "");
  EXPECT_EQ(made.curves.numberOfPieces(), 4u + 2u);
  EXPECT_TRUE(contains(corners(made.mesh), Vec<2>(0.25, 0.5)));
  EXPECT_TRUE(contains(corners(made.mesh), Vec<2>(0.75, 0.5)));
}

TEST(BoundaryCurves, WhatDoesNotMatchIsNamed)
{
  const Made off = make(disc(16), loop(circle(64, 1.1)));
  EXPECT_TRUE(has(off.error, "does not lie on the geometry")) << off.error;
  EXPECT_TRUE(has(off.error, "point ")) << off.error;
  EXPECT_TRUE(has(off.error, "0.1")) << off.error;

  MeshInput<2> dent = disc(16);
  dent.points[5] *= 0.97;
  const Made one = make(dent, loop(circle(64)));
  EXPECT_TRUE(has(one.error, "point 5 (")) << one.error;

  LineNetwork corner = loop(circle(64, 1.0, 0.5));
  corner.corners.assign(64, 0);
  corner.corners[7] = 1;
  const Made without = make(disc(16), corner);
  EXPECT_TRUE(has(without.error, "corner at its point 7")) << without.error;

  // along the bottom of a triangle: to .6, a little back, on to 1
  const std::vector<Vec<2>> zigzag{ { 0, 0 }, { 0.6, 0 }, { 0.59, -1.3e-3 }, { 1, 0 }, { 0.5, 1 } };
  MeshInput<2> folded;
  folded.points = zigzag;
  folded.cells = { { 0, 1, 4 }, { 1, 2, 4 }, { 2, 3, 4 } };
  const Made back = make(folded, loop({ { 0, 0 }, { 1, 0 }, { 0.5, 1 } }));
  EXPECT_TRUE(has(back.error, "turns back at its point 2")) << back.error;

  // what is built next has nothing of it
  Made again;
  again.mesh = buildMesh(disc(16));
  MeshEditor<2> editor(again.mesh);
  EXPECT_NE(again.curves.build(editor, loop(circle(64, 1.1)), CurveOptions()), "");
  EXPECT_EQ(again.curves.build(editor, loop(circle(64)), CurveOptions()), "");
  EXPECT_EQ(again.curves.numberOfPieces(), 1u);
  EXPECT_EQ(slidingPoints(again.mesh).size(), 16u);
}

TEST(BoundaryCurves, SingleTurnsAreCorners)
{
  const double c = std::cos(40 * Pi / 180), d = std::sin(40 * Pi / 180);
  const std::vector<Vec<2>> parallelogram{ { 0, 0 }, { 2, 0 }, { 2 + c, d }, { c, d } };
  const Made made = make(fan(parallelogram, Vec<2>(1.3, 0.3)));
  EXPECT_EQ(made.curves.numberOfPieces(), 4u);
  EXPECT_EQ(corners(made.mesh).size(), 4u);
}

// Two half circles and the long straight sides between them: those must not bulge.
TEST(BoundaryCurves, StraightSidesStayStraight)
{
  std::vector<Vec<2>> stadium;
  for (int side : { 1, -1 })
  {
    for (int k = 0; k <= 8; ++k)
    {
      const double a = side * (-Pi / 2) + k * Pi / 8;
      stadium.emplace_back(side * 10 + std::cos(a), std::sin(a));
    }
  }
  Made made = make(fan(stadium, Vec<2>(0, 0)));
  EXPECT_EQ(corners(made.mesh).size(), 4u);
  for (Index k : { 8, 17 }) // the straight sides
  {
    const auto span = made.curves.span(made.mesh, k, (k + 1) % 18);
    ASSERT_TRUE(span);
    for (double t : { 0.1, 0.5, 0.9 })
    {
      const double y = made.curves.at(span->part, span->from + t * (span->to - span->from))[1];
      EXPECT_EQ(std::fabs(y), 1.0);
    }
  }
  const auto arc = made.curves.span(made.mesh, 3, 4);
  ASSERT_TRUE(arc);
  const Vec<2> x = made.curves.at(arc->part, 0.5 * (arc->from + arc->to));
  EXPECT_NEAR((x - Vec<2>(10, 0)).norm(), 1.0, 1e-3);
}

TEST(BoundaryCurves, LensOfTwoArcs)
{
  const auto arc = [](double x) { return 0.4 * x * (1.0 - x); };
  for (int n : { 4, 8 }) // edges of each arc
  {
    std::vector<Vec<2>> points, fine;
    for (int k = 0; k < n; ++k)
    {
      points.emplace_back(k / double(n), -arc(k / double(n)));
    }
    for (int k = 0; k < n; ++k)
    {
      points.emplace_back(1.0 - k / double(n), arc(1.0 - k / double(n)));
    }
    for (int k = 0; k < 32; ++k)
    {
      fine.emplace_back(k / 32.0, -arc(k / 32.0));
    }
    for (int k = 0; k < 32; ++k)
    {
      fine.emplace_back(1.0 - k / 32.0, arc(1.0 - k / 32.0));
    }
    for (bool given : { false, true })
    {
      const MeshInput<2> in = fan(points, Vec<2>(0.5, 0.0));
      const CurveOptions o = curveOptions(43.0, true); // at the tips it turns by 2 (90 - 21.8)
      Made made = given ? make(in, loop(fine), o) : make(in, curveOptions(60.0, true));
      ASSERT_EQ(made.error, "");
      EXPECT_EQ(made.curves.numberOfPieces(), 2u) << n << given;
      EXPECT_EQ(corners(made.mesh).size(), 2u);
      for (Index k = 0; k < 2 * n; ++k)
      {
        const auto span = made.curves.span(made.mesh, k, (k + 1) % (2 * n));
        ASSERT_TRUE(span);
        const double y = made.curves.at(span->part, 0.5 * (span->from + span->to))[1];
        EXPECT_EQ(y > 0.0, k >= n) << n << " " << k << " " << given;
      }
    }
  }
}

/// Two boundary points at one place, or nearly: legal in a mesh, whose cell there is flat.
TEST(BoundaryCurves, PointsAtOnePlaceAreCorners)
{
  for (double gap : { 0.0, 1e-14 })
  {
    MeshInput<2> in = disc(16);
    in.points[5] = (1.0 - gap) * in.points[4] + gap * in.points[5];
    const Made made = make(in);
    EXPECT_EQ(corners(made.mesh).size(), 2u);
    for (Index p = 0; p < 16; ++p)
    {
      const auto span = made.curves.span(made.mesh, p, (p + 1) % 16);
      EXPECT_TRUE(p == 4 || span) << p;
      if (span)
      {
        EXPECT_TRUE(made.curves.at(span->part, 0.5 * (span->from + span->to)).allFinite());
      }
    }
  }
}
