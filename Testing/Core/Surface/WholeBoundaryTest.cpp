// SPDX-License-Identifier: BSD-3-Clause
// A part of a plane mesh slides along the curves of the whole: where its points are must not depend
// on the part.
#include "Surface/WholeBoundary.h"
#include "PlaneMeshes.h"

#include <set>

using namespace meshopt;

namespace
{
/// A part of a mesh: some of its cells, with the points in the order of the whole.
struct PartOfMesh
{
  SimplexMesh<2> mesh;
  std::vector<Index> names; ///< of the whole, by point of the part
  PartOfBoundary boundary;
};

struct Whole
{
  MeshInput<2> in;
  SimplexMesh<2> mesh;
  LineNetwork network; ///< by points of the mesh
  WholeBoundary boundary;
  std::vector<WholeBoundary::PlaceOnPiece> places;

  explicit Whole(const MeshInput<2>& input, const CurveOptions& options = {})
    : in(input)
    , mesh(buildMesh(input))
    , network(keptLines(mesh))
  {
    EXPECT_EQ(this->boundary.make(this->network, nullptr, options, 1.0, this->places), "");
  }

  PartOfMesh part(const std::function<bool(Index)>& has) const
  {
    std::set<Index> used, beyond;
    for (Index c = 0; c < static_cast<Index>(this->in.cells.size()); ++c)
    {
      (has(c) ? used : beyond).insert(this->in.cells[c].begin(), this->in.cells[c].end());
    }
    PartOfMesh part;
    part.names.assign(used.begin(), used.end());
    std::map<Index, Index> numbers;
    MeshInput<2> some;
    for (Index p : part.names)
    {
      numbers[p] = static_cast<Index>(numbers.size());
      some.points.push_back(this->in.points[p]);
      part.boundary.corners.push_back(this->network.corners[p] ? p : None);
      part.boundary.places.push_back(this->places[p]);
      part.boundary.hull.push_back(beyond.count(p) > 0);
    }
    some.fixedPoints = part.boundary.hull;
    for (Index c = 0; c < static_cast<Index>(this->in.cells.size()); ++c)
    {
      if (has(c))
      {
        const Simplex<2>& nodes = this->in.cells[c];
        some.cells.push_back({ numbers[nodes[0]], numbers[nodes[1]], numbers[nodes[2]] });
      }
    }
    part.mesh = buildMesh(some);
    return part;
  }

  /// Puts a part on the curves, and compares all that it says with the whole. Returns how many of
  /// its points may slide.
  int compare(PartOfMesh& part, BoundaryCurves& curves) const
  {
    MeshEditor<2> editor(part.mesh);
    curves.build(editor, this->boundary, part.boundary);
    expectOnCurves(part.mesh, curves, 1e-12);
    int sliding = 0;
    for (Index p = 0; p < static_cast<Index>(part.names.size()); ++p)
    {
      const WholeBoundary::PlaceOnPiece here = curves.inWhole(this->boundary, part.mesh, p);
      const WholeBoundary::PlaceOnPiece there = this->places[part.names[p]];
      const bool mayMove = there.piece != None && !part.boundary.hull[p];
      EXPECT_EQ(here.piece, mayMove ? there.piece : None) << p;
      EXPECT_NEAR(here.parameter, mayMove ? there.parameter : 0.0, 1e-14) << p;
      sliding += mayMove;
    }
    for (const std::array<Index, 2>& line : keptLines(part.mesh).lines)
    {
      // Between two points of the hull nothing may happen; elsewhere the span is that of the whole.
      const auto [a, b] = line;
      const auto span = curves.span(part.mesh, a, b);
      EXPECT_EQ(span.has_value(), !(part.boundary.hull[a] && part.boundary.hull[b]))
        << a << ' ' << b;
      if (span)
      {
        const Vec<2> middle = curves.at(span->part, 0.5 * (span->from + span->to));
        const Vec<2> chord = 0.5 * (part.mesh.point(a) + part.mesh.point(b));
        const double length = (part.mesh.point(a) - part.mesh.point(b)).norm();
        EXPECT_LT((middle - chord).norm(), 0.3 * length) << a << ' ' << b;
      }
    }
    return sliding;
  }
};

}

// All of the mesh is its largest part: the same pieces as without the detour.
TEST(WholeBoundary, TheWholeIsAPart)
{
  for (const MeshInput<2>& in : { jitteredGrid<2>(5, 0.2), ring(9, 0.5, 1.0), disc(7) })
  {
    const Whole whole(in);
    PartOfMesh part = whole.part([](Index) { return true; });
    BoundaryCurves curves, direct;
    whole.compare(part, curves);
    SimplexMesh<2> mesh = buildMesh(in);
    MeshEditor<2> editor(mesh);
    direct.build(editor, CurveOptions());
    EXPECT_EQ(curves.numberOfPieces(), direct.numberOfPieces());
    for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
    {
      EXPECT_EQ(mesh.freedom(p), part.mesh.freedom(p)) << p;
    }
  }
}

// Closed curves and straight sides, cut anywhere, with and without corners.
TEST(WholeBoundary, PartsAreOnTheSamePieces)
{
  for (const CurveOptions& o : { curveOptions(45.0, true), curveOptions(45.0, false),
         curveOptions(180.0, true), curveOptions(0.0, false), curveOptions(0.0, true) })
  {
    for (const MeshInput<2>& in : { jitteredGrid<2>(6, 0.2), ring(12, 0.5, 1.0), disc(9) })
    {
      const Whole whole(in, o);
      const auto n = static_cast<Index>(in.cells.size());
      for (Index from = 0; from < n; ++from)
      {
        for (Index length : { Index(1), Index(2), Index(n / 3), Index(n / 2), Index(n - 1) })
        {
          PartOfMesh part = whole.part([&](Index c) { return (c - from + n) % n < length; });
          BoundaryCurves curves;
          whole.compare(part, curves);
        }
      }
    }
  }
}

// By places alone the sides of a slit could not be told apart.
TEST(WholeBoundary, SidesOfASlitAreToldApart)
{
  const MeshInput<2> in = slitSquare(8, 0.25, 0.75);
  const Whole whole(in, curveOptions(180.0, true));
  int sliding = 0;
  const auto n = static_cast<Index>(in.cells.size());
  for (Index from = 0; from < n; from += 3)
  {
    PartOfMesh part = whole.part([&](Index c) { return (c - from + n) % n < n / 2; });
    BoundaryCurves curves;
    sliding += whole.compare(part, curves);
  }
  EXPECT_GT(sliding, 50);
}

// Two points of the hull that are the ends of one piece, and neighbours across the part, too.
TEST(WholeBoundary, HullBetweenTheEndsOfAPiece)
{
  const Whole whole(disc(6), curveOptions(180.0, true));
  PartOfMesh part = whole.part([](Index c) { return c < 2; }); // 0, 1, 2 and the centre
  BoundaryCurves curves;
  EXPECT_EQ(whole.compare(part, curves), 1);
  EXPECT_FALSE(curves.span(part.mesh, 0, 3).has_value());
  EXPECT_TRUE(curves.span(part.mesh, 0, 1).has_value());
}

// Where the only edge of a loop that a part has may be its first or its last, it stays.
TEST(WholeBoundary, WhatCannotBeToldStays)
{
  const MeshInput<2> in = disc(8);
  const CurveOptions smooth = curveOptions(180.0, true);
  Whole whole(in, smooth);
  whole.network.corners[0] = 1; // the only one: the circle begins and ends there
  whole.boundary = WholeBoundary();
  ASSERT_EQ(whole.boundary.make(whole.network, nullptr, smooth, 1.0, whole.places), "");
  ASSERT_EQ(whole.boundary.pieces.size(), 1u);
  for (Index first : { 0, 7 })
  {
    PartOfMesh part = whole.part([&](Index c) { return c == first; });
    MeshEditor<2> editor(part.mesh);
    BoundaryCurves curves;
    curves.build(editor, whole.boundary, part.boundary);
    for (Index p = 0; p < part.mesh.numberOfPointSlots(); ++p)
    {
      EXPECT_EQ(part.mesh.freedom(p), Freedom::Fixed);
    }
  }
  // With two edges the order of the parameters tells.
  for (Index first : { 0, 6 })
  {
    PartOfMesh part = whole.part([&](Index c) { return c == first || c == first + 1; });
    BoundaryCurves curves;
    EXPECT_EQ(whole.compare(part, curves), 1);
  }
}

TEST(WholeBoundary, MessagesHaveTheNamesOfPoints)
{
  const MeshInput<2> in = jitteredGrid<2>(3, 0.0);
  LineNetwork boundary = keptLines(buildMesh(in)), geometry = boundary;
  for (std::size_t p = 0; p < boundary.points.size(); ++p)
  {
    boundary.names.push_back(1000 + static_cast<std::int64_t>(p));
  }
  boundary.points[1] += Vec<2>(0.0, -0.3);
  WholeBoundary whole;
  std::vector<WholeBoundary::PlaceOnPiece> places;
  const std::string error = whole.make(boundary, &geometry, CurveOptions(), 1.0, places);
  EXPECT_NE(error.find("point 1001 "), std::string::npos) << error;
}
