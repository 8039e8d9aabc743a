// SPDX-License-Identifier: BSD-3-Clause
// What nodes of the boundary may do, question by question: a Surface as its callers see it.
#include "Surface/Surface.h"
#include "PlaneMeshes.h"

using namespace meshopt;

namespace
{
/// A mesh whose boundary slides along curves through its own points.
struct Made
{
  SimplexMesh<2> mesh;
  BoundaryCurves curves;

  explicit Made(const MeshInput<2>& in, bool splines = true, double cornerAngle = 45.0,
    const std::vector<std::uint8_t>& corners = {})
    : mesh(buildMesh(in))
  {
    MeshEditor<2> editor(this->mesh);
    CurveOptions options;
    options.splines = splines;
    options.cornerAngle = cornerAngle;
    this->curves.build(editor, options, corners);
  }
  const Surface<2>& surface() const { return this->curves; }
  std::vector<Index> star(Index p) const
  {
    std::vector<Index> cells;
    this->mesh.star(p, cells);
    return cells;
  }
  bool mayJoin(Index v, Index u) const
  {
    return this->surface().mayJoin(this->mesh, this->star(v), v, u);
  }
  std::optional<SlidingRange> range(Index v) const
  {
    return this->surface().range(this->mesh, this->star(v), v);
  }
};

std::vector<Made> someMeshes()
{
  std::vector<Made> all;
  for (bool splines : { false, true })
  {
    all.emplace_back(jitteredGrid<2>(4, 0.2), splines);
    all.emplace_back(bracket(4), splines);
    all.emplace_back(ring(24, 0.4, 1.0), splines);
    all.emplace_back(slitSquare(8, 0.25, 0.75), splines);
    all.emplace_back(curvedInterface(8), splines);
  }
  return all;
}

/// Are a and b the ends of a kept facet?
bool isKept(const SimplexMesh<2>& mesh, Index a, Index b)
{
  bool found = false;
  forKeptFacets(mesh,
    [&](Index c, int i)
    {
      const Facet<2> f = mesh.facet(c, i);
      found = found || (f[0] == a && f[1] == b) || (f[0] == b && f[1] == a);
    });
  return found;
}
}

TEST(Surface, FreedomIsThatOfThePlace)
{
  for (const Made& made : someMeshes())
  {
    int slide = 0;
    for (Index p = 0; p < made.mesh.numberOfPointSlots(); ++p)
    {
      const Freedom freedom = made.mesh.freedom(p);
      EXPECT_EQ(freedom == Freedom::Free, !made.mesh.isBoundary(p));
      EXPECT_EQ(freedom == Freedom::Curve, made.mesh.place(p).part != None);
      slide += freedom == Freedom::Curve;
      if (freedom == Freedom::Curve)
      {
        const Place place = made.mesh.place(p);
        EXPECT_LT(
          (made.surface().at(place.part, place.parameter) - made.mesh.point(p)).norm(), 1e-12);
      }
    }
    EXPECT_GT(slide, 4);
  }
}

TEST(Surface, ThePlaceOfAProjectionIsTheNearest)
{
  TestRandom random(6);
  for (const Made& made : someMeshes())
  {
    for (Index p : slidingPoints(made.mesh))
    {
      const Place place = made.mesh.place(p);
      const Vec<2> x = made.mesh.point(p) + 0.05 * Vec<2>(random(), random());
      Vec<2> there;
      const Place found = made.surface().project(place, x, there);
      EXPECT_EQ(found.freedom, Freedom::Curve);
      EXPECT_EQ(found.part, place.part);
      EXPECT_EQ(there, made.surface().at(found.part, found.parameter));
      for (int k = -200; k <= 200; ++k) // nothing is nearer, step by step
      {
        const Vec<2> y = made.surface().at(place.part, place.parameter + 0.002 * k);
        EXPECT_LE((there - x).norm(), (y - x).norm() + 1e-9);
      }
    }
  }
  const Made square(jitteredGrid<2>(4, 0.0));
  Vec<2> there;
  square.surface().project(square.mesh.place(2), Vec<2>(0.3, -0.2), there); // the bottom
  EXPECT_LT((there - Vec<2>(0.3, 0.0)).norm(), 1e-15);
  square.surface().project(square.mesh.place(2), Vec<2>(1.3, 0.2), there); // its end
  EXPECT_LT((there - Vec<2>(1.0, 0.0)).norm(), 1e-15);
}

TEST(Surface, OneTangentAlongTheCurve)
{
  constexpr double step = 1e-6;
  for (const Made& made : someMeshes())
  {
    SimplexMesh<2> mesh = made.mesh;
    MeshEditor<2> editor(mesh);
    for (Index p : slidingPoints(made.mesh))
    {
      Place place = made.mesh.place(p);
      place.parameter += 0.013; // between the points: lines have no tangent at them
      editor.setPlace(p, place);
      std::array<Vec<2>, 2> basis;
      ASSERT_EQ(made.surface().tangents(mesh, {}, p, basis), 1);
      const Vec<2> d = made.surface().at(place.part, place.parameter + step) -
        made.surface().at(place.part, place.parameter - step);
      EXPECT_NEAR(basis[0].norm(), 1.0, 1e-14);
      EXPECT_LT((basis[0] - d.normalized()).norm(), 1e-6);
    }
  }
}

TEST(Surface, SpansGoFromPointToPoint)
{
  for (const Made& made : someMeshes())
  {
    const SimplexMesh<2>& mesh = made.mesh;
    int spans = 0;
    for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
    {
      for (int i = 0; i < 3; ++i)
      {
        const Facet<2> f = mesh.facet(c, i);
        const auto span = made.surface().span(mesh, f[0], f[1]);
        const auto back = made.surface().span(mesh, f[1], f[0]);
        ASSERT_EQ(span.has_value(), back.has_value());
        EXPECT_EQ(made.surface().mayDivide(mesh, {}, f[0], f[1]), span.has_value());
        EXPECT_TRUE(span || !mesh.isKept(c, i));
        if (!span || !mesh.isKept(c, i))
        {
          continue;
        }
        ++spans;
        EXPECT_EQ(span->part, back->part);
        EXPECT_NEAR(back->to - back->from, span->from - span->to, 1e-12);
        const Vec<2> a = mesh.point(f[0]), b = mesh.point(f[1]);
        EXPECT_LT((made.surface().at(span->part, span->from) - a).norm(), 1e-12);
        EXPECT_LT((made.surface().at(span->part, span->to) - b).norm(), 1e-12);
        // Parameters are lengths of the polygon: the span is this edge, not the way around.
        EXPECT_NEAR(std::fabs(span->to - span->from), (b - a).norm(), 1e-12);
        EXPECT_TRUE(made.curves.mayBeNeighbours(*span));
      }
    }
    EXPECT_GT(spans, 8);
  }
}

TEST(Surface, NoSpanBetweenDifferentCurves)
{
  const Made square(jitteredGrid<2>(4, 0.0));              // 5 by 5 points, corners 0, 4, 20, 24
  EXPECT_FALSE(square.surface().span(square.mesh, 1, 5));  // bottom and left
  EXPECT_FALSE(square.surface().span(square.mesh, 1, 24)); // not a corner of the bottom
  EXPECT_FALSE(square.surface().span(square.mesh, 0, 24)); // two corners without a line
  EXPECT_FALSE(square.surface().mayDivide(square.mesh, {}, 1, 5));
  EXPECT_TRUE(square.surface().span(square.mesh, 4, 2));
  const Made hole(ring(16, 0.3, 1.0));
  EXPECT_FALSE(hole.surface().span(hole.mesh, 3, 16 + 3));
}

TEST(Surface, ANodeSlidesBetweenItsNeighbours)
{
  for (const Made& made : someMeshes())
  {
    for (Index p = 0; p < made.mesh.numberOfPointSlots(); ++p)
    {
      if (!made.mesh.isPointAlive(p))
      {
        continue;
      }
      const auto range = made.range(p);
      EXPECT_EQ(range.has_value(), made.mesh.freedom(p) == Freedom::Curve) << p;
      if (!range)
      {
        continue;
      }
      const Place place = made.mesh.place(p);
      const auto [low, high] = std::minmax(range->low, range->high);
      EXPECT_LT(low, place.parameter);
      EXPECT_GT(high, place.parameter);
      EXPECT_LT(range->ends[0], range->ends[1]);
      for (int k = 0; k < 2; ++k)
      {
        EXPECT_TRUE(isKept(made.mesh, p, range->ends[k]));
        const Vec<2> x = made.surface().at(place.part, k == 0 ? range->low : range->high);
        EXPECT_LT((x - made.mesh.point(range->ends[k])).norm(), 1e-12);
      }
    }
  }
}

/// On a circle of n points the edge over one of them leaves the arc by tan(pi / n) / 2 of its
/// length, which may be a tenth at most: from 16 points on.
TEST(Surface, ANodeMayVanishWhereTheCurveStaysNear)
{
  for (int n : { 10, 12, 15, 16, 20, 40 })
  {
    const Made made(disc(n));
    ASSERT_EQ(made.curves.numberOfPieces(), 1u);
    const bool isNear = 0.5 * std::tan(Pi / n) <= 0.1;
    EXPECT_EQ(isNear, n >= 16);
    for (Index v = 0; v < n; ++v)
    {
      for (Index u = 0; u <= n; ++u)
      {
        const bool isNext = u < n && (u == (v + 1) % n || v == (u + 1) % n);
        EXPECT_EQ(made.mayJoin(v, u), isNear && isNext) << n << ": " << v << " " << u;
      }
    }
    EXPECT_FALSE(made.mayJoin(n, 0)); // the node inside is none of the surface
    const auto over = made.curves.sagitta(
      { 0, 0.0, 2.0 * (onCircle(1.0 / n) - onCircle(0)).norm() });
    EXPECT_NEAR(over, 1.0 - std::cos(2.0 * Pi / n), 2e-3);
  }
}

TEST(Surface, CornersStayAndOthersMayGoToThem)
{
  const Made square(jitteredGrid<2>(4, 0.0));
  for (Index u = 0; u < 25; ++u)
  {
    EXPECT_FALSE(square.mayJoin(0, u));
    EXPECT_EQ(square.mayJoin(1, u), u == 0 || u == 2); // along the bottom
  }
  // Of one edge a side, the last node between two corners may go as well.
  const Made two(jitteredGrid<2>(2, 0.0)); // corners 0, 2, 6, 8
  EXPECT_TRUE(two.mayJoin(1, 0));
  EXPECT_TRUE(two.mayJoin(1, 2));
  EXPECT_FALSE(two.mayJoin(1, 4));
}

/// A cell with two sides at the boundary would have none left.
TEST(Surface, TheTipOfAnEarStays)
{
  MeshInput<2> in;
  in.points = circle(20);
  in.points.push_back(Vec<2>::Zero());
  in.cells = { { 4, 5, 6 }, { 4, 6, 20 } }; // point 5 is the tip
  for (Index k = 6; k != 4; k = (k + 1) % 20)
  {
    in.cells.push_back({ k, (k + 1) % 20, 20 });
  }
  const Made made(in);
  ASSERT_EQ(made.curves.numberOfPieces(), 1u);
  EXPECT_FALSE(made.mayJoin(5, 4));
  EXPECT_FALSE(made.mayJoin(5, 6));
  EXPECT_TRUE(made.mayJoin(6, 5));
  EXPECT_TRUE(made.mayJoin(12, 13));
}

/// Where two pieces join the same corners, neither may become an edge: there would be two of them.
TEST(Surface, TwoWaysBetweenTwoCornersStayApart)
{
  const std::vector<Vec<2>> lens{ { 0, 0 }, { 0.5, -0.02 }, { 1, 0 }, { 0.5, 0.02 } };
  const Made both(fan(lens, Vec<2>(0.5, 0.0)));
  ASSERT_EQ(both.curves.numberOfPieces(), 2u);
  EXPECT_FALSE(both.mayJoin(1, 0));
  EXPECT_FALSE(both.mayJoin(3, 2));
  EXPECT_FALSE(both.surface().span(both.mesh, 0, 2));
  const std::vector<Vec<2>> roof{ { 0, 0 }, { 0.5, -0.02 }, { 1, 0 }, { 0.5, 1.0 } };
  const Made one(fan(roof, Vec<2>(0.5, 0.3)));
  ASSERT_EQ(one.curves.numberOfPieces(), 3u);
  EXPECT_TRUE(one.mayJoin(1, 0));
  EXPECT_TRUE(one.mayJoin(1, 2));
}

TEST(Surface, NeighboursOnAClosedCurveAreNotFarApart)
{
  const MeshInput<2> in = disc(16);
  const double around = 16.0 * 2.0 * std::sin(Pi / 16);
  const Made closed(in);
  std::vector<std::uint8_t> flags(17, 0);
  flags[7] = 1;
  const Made pinned(in, true, 45.0, flags); // from its corner around to itself
  for (const Made* made : { &closed, &pinned })
  {
    ASSERT_EQ(made->curves.numberOfPieces(), 1u);
    for (double from : { 0.0, 0.3 * around })
    {
      EXPECT_TRUE(made->curves.mayBeNeighbours({ 0, from, from + 0.399 * around }));
      EXPECT_FALSE(made->curves.mayBeNeighbours({ 0, from, from + 0.401 * around }));
      EXPECT_FALSE(made->curves.mayBeNeighbours({ 0, from + 0.401 * around, from }));
    }
  }
  flags[2] = 1;
  const Made open(in, true, 45.0, flags);
  ASSERT_EQ(open.curves.numberOfPieces(), 2u);
  EXPECT_TRUE(open.curves.mayBeNeighbours({ 0, 0.0, 0.6 * around }));
}

TEST(Surface, FacetsInThePlaneAreNotSwapped)
{
  const Made square(jitteredGrid<2>(4, 0.0));
  EXPECT_FALSE(square.surface().maySwap(square.mesh, 0, 0));
}
