// SPDX-License-Identifier: BSD-3-Clause
// What corners and curves of a sliding surface may do, and what not, asked one by one.
#include "Edit/SurfaceChanges.h"
#include "Mesh/Ids.h"
#include "Operations/EdgeContraction.h"
#include "SlidingBoxes.h"

using namespace meshopt;

namespace
{
/// Whether the surface lets the point move to x, as far as the curves at it are concerned.
bool curvesAllow(Sliding& made, Index p, const Vec<3>& x)
{
  made.editor.movePoint(p, x);
  SurfaceChange<3> change;
  for (Index q = 0; q < made.mesh.numberOfPointSlots(); ++q)
  {
    const auto span = made.surface.span(made.mesh, p, q);
    const bool isNeighbour = span && (made.mesh.point(q) - x).norm() < 0.3;
    if (isNeighbour)
    {
      change.spans.push_back(*span);
    }
  }
  EXPECT_EQ(change.spans.size(), 3u);
  return made.surface.allows(change);
}

TEST(SlidingSurface, ANarrowRegionDoesNotSpreadByItsTolerance)
{
  // A plate of 0.17 by 0.17 by 0.03 in a corner of the box.
  MeshInput<3> in = jitteredGrid<3>(6, 0.0);
  Index ofPlate = None, ofBox = None;
  for (const Simplex<3>& t : in.cells)
  {
    const auto isIn = [&](Index p) { return in.points[p].maxCoeff() < 0.2; };
    in.regions.push_back(std::all_of(t.begin(), t.end(), isIn) ? 1 : 0);
  }
  for (std::size_t p = 0; p < in.points.size(); ++p)
  {
    Vec<3>& x = in.points[p];
    ofPlate = x.minCoeff() > 0.1 && x.maxCoeff() < 0.2 ? static_cast<Index>(p) : ofPlate;
    ofBox = x.minCoeff() == 1.0 ? static_cast<Index>(p) : ofBox;
    x[2] = x[2] > 0.1 && x[2] < 0.2 ? 0.03 : x[2];
  }
  SurfaceOptions options;
  options.tolerance = 0.02;
  Sliding made(in, options);
  ASSERT_EQ(made.mesh.freedom(ofPlate), Freedom::Corner);
  EXPECT_TRUE(curvesAllow(made, ofBox, in.points[ofBox] + 0.01 * Vec<3>::UnitX()));
  EXPECT_FALSE(curvesAllow(made, ofPlate, in.points[ofPlate] + 0.01 * Vec<3>::UnitX()));
  EXPECT_TRUE(curvesAllow(made, ofPlate, in.points[ofPlate] + 0.004 * Vec<3>::UnitX()));
}

bool mayJoin(Sliding& made, Index v, Index u)
{
  std::vector<Index> star;
  made.editor.star(v, star);
  return made.surface.mayJoin(made.mesh, star, v, u);
}

TEST(SlidingSurface, ATipOfACurveMayVanishIfItIsShort)
{
  // A line on the floor, from its side: the last edge has the length 0.05.
  MeshInput<3> in = jitteredGrid<3>(4, 0.0);
  for (Vec<3>& x : in.points)
  {
    x[1] = x[1] == 0.5 ? 0.3 : x[1];
  }
  const auto find = [&](double x, double y, double z)
  {
    return static_cast<Index>(
      std::find(in.points.begin(), in.points.end(), Vec<3>(x, y, z)) - in.points.begin());
  };
  const Index wall = find(0.5, 0.0, 0.0), middle = find(0.5, 0.25, 0.0), tip = find(0.5, 0.3, 0.0);
  in.keptEdges = { { wall, middle }, { middle, tip } };
  SurfaceOptions options;
  options.tolerance = 0.1;
  const Sliding straight(in, options);
  EXPECT_EQ(straight.mesh.freedom(middle), Freedom::Curve); // it is no corner
  in.keptEdges.push_back({ middle, find(0.75, 0.25, 0.0) });
  Sliding made(in, options);
  ASSERT_EQ(made.mesh.freedom(middle), Freedom::Corner);
  EXPECT_TRUE(mayJoin(made, tip, middle));
  EXPECT_FALSE(mayJoin(made, middle, tip)); // the other curves would have to go to the tip
  // The corner may not go too far from where the tip was.
  made.editor.movePoint(middle, in.points[middle] - 0.02 * Vec<3>::UnitY());
  EXPECT_FALSE(made.surface.span(made.mesh, middle, wall)->leavesRoom);
  made.editor.movePoint(middle, in.points[middle] - 0.005 * Vec<3>::UnitY());
  EXPECT_TRUE(made.surface.span(made.mesh, middle, wall)->leavesRoom);
}

/// A box with a strip of another number on its floor; its ends are edges of the length 0.05.
struct Strip
{
  Strip()
  {
    this->in = jitteredGrid<3>(4, 0.0);
    for (Vec<3>& x : this->in.points)
    {
      x[0] = x[0] == 0.75 ? 0.55 : x[0];
    }
    const SimplexMesh<3> mesh = buildMesh(this->in);
    for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
    {
      for (int i = 0; i < 4; ++i)
      {
        const Facet<3> f = mesh.facet(c, i);
        const auto isIn = [&](Index p)
        {
          const Vec<3>& x = mesh.point(p);
          return x[2] == 0.0 && x[0] >= 0.5 && x[0] <= 0.55;
        };
        if (mesh.isKept(c, i) && std::all_of(f.begin(), f.end(), isIn))
        {
          this->options.labels.emplace_back(sortedIds(f), 1);
        }
      }
    }
    std::sort(this->options.labels.begin(), this->options.labels.end());
    this->options.corners.assign(this->in.points.size(), 0);
  }
  Index find(double x, double y) const
  {
    return static_cast<Index>(
      std::find(this->in.points.begin(), this->in.points.end(), Vec<3>(x, y, 0.0)) -
      this->in.points.begin());
  }

  MeshInput<3> in;
  SurfaceOptions options;
};

TEST(SlidingSurface, CornersNearerThanTheToleranceMayBecomeOne)
{
  Strip strip;
  const Index a = strip.find(0.5, 0.0), b = strip.find(0.55, 0.0);
  strip.options.tolerance = 0.05; // curves may use less
  Sliding near(strip.in, strip.options);
  ASSERT_EQ(near.mesh.freedom(a), Freedom::Corner);
  EXPECT_FALSE(mayJoin(near, a, b));
  strip.options.tolerance = 0.1;
  Sliding made(strip.in, strip.options);
  ASSERT_TRUE(mayJoin(made, a, b));
  EXPECT_TRUE(mayJoin(made, b, a));
  EXPECT_FALSE(mayJoin(made, a, strip.find(0.25, 0.0)));
  // Not also at the other end: of the two sides of the strip it would not be clear which is which.
  EXPECT_FALSE(mayJoin(made, strip.find(0.5, 1.0), strip.find(0.55, 1.0)));
  const Index next = strip.find(0.5, 0.25);
  const auto before = made.surface.span(made.mesh, a, next);
  Proposal<3> proposal;
  ASSERT_TRUE(proposeContraction<3>(made.editor, &made.surface, a, b, proposal));
  proposal.qualities.assign(proposal.cells.size(), 0.0);
  SurfaceChanges<3> changes;
  EXPECT_TRUE(changes.allowsReplacement(made.surface, made.mesh, proposal));
  made.editor.replace(proposal.cavity, proposal.cells, proposal.qualities, proposal.keptChange());
  // b is now the end of the curve that led to a.
  const auto after = made.surface.span(made.mesh, b, next);
  ASSERT_TRUE(before && after);
  EXPECT_EQ(after->part, before->part);
  EXPECT_EQ(after->from, before->from);
  EXPECT_NEAR(after->off, 0.05, 1e-12);
  EXPECT_NEAR(made.surface.distance(made.mesh), 0.05, 1e-12);
  expectSound(made.mesh);
  // A corner that the caller marks stays.
  strip.options.corners[a] = 1;
  Sliding marked(strip.in, strip.options);
  EXPECT_FALSE(mayJoin(marked, a, b));
  EXPECT_FALSE(mayJoin(marked, b, a));
}

TEST(SlidingSurface, ABorderOfNumbersDoesNotBecomeSharp)
{
  const MeshInput<3> in = jitteredGrid<3>(4, 0.0);
  SurfaceOptions options;
  options.tolerance = 1e-3;
  const auto find = [&](const Vec<3>& x)
  {
    return static_cast<Index>(std::find(in.points.begin(), in.points.end(), x) - in.points.begin());
  };
  const Index a = find(Vec<3>(0.5, 0.25, 0.0)), b = find(Vec<3>(0.5, 0.5, 0.0));
  options.lines.emplace_back(sortedIds(a, b), 1);
  const Sliding made(in, options);
  const Index p = find(Vec<3>(0.0, 0.25, 0.0)), q = find(Vec<3>(0.0, 0.5, 0.0));
  const double flat = 1.0, bent = std::cos(1.0), sharp = std::cos(1.7); // radians
  EXPECT_TRUE(made.surface.allowsAngle(made.mesh, a, b, true, flat));
  EXPECT_FALSE(made.surface.allowsAngle(made.mesh, a, b, true, bent));
  EXPECT_TRUE(made.surface.allowsAngle(made.mesh, p, q, true, sharp));
  EXPECT_FALSE(made.surface.allowsAngle(made.mesh, p, q, true, flat));
}

TEST(SlidingSurface, NoRidgeComesWhereAnInterfaceEnds)
{
  MeshInput<3> in = jitteredGrid<3>(4, 0.0);
  splitRegions(in);
  SurfaceOptions options;
  options.tolerance = 1e-3;
  const Sliding made(in, options);
  const auto find = [&](double x, double y)
  {
    return static_cast<Index>(
      std::find(in.points.begin(), in.points.end(), Vec<3>(x, y, 0.0)) - in.points.begin());
  };
  const double sharp = std::cos(1.7); // radians
  const Index a = find(0.5, 0.25), b = find(0.5, 0.5);
  EXPECT_TRUE(made.surface.allowsAngle(made.mesh, a, b, true, sharp)); // with the interface
  EXPECT_FALSE(made.surface.allowsAngleOutside(made.mesh, a, b, sharp));
  EXPECT_TRUE(made.surface.allowsAngleOutside(made.mesh, a, b, 1.0));
  // At the edges of the box there are ridges.
  EXPECT_TRUE(made.surface.allowsAngleOutside(made.mesh, find(0.0, 0.25), find(0.0, 0.5), sharp));
}
}
