// SPDX-License-Identifier: BSD-3-Clause
// Edges split and contracted one by one, those of the boundary and of interfaces included.
#include "MeshSnapshot.h"
#include "Operations/EdgeContraction.h"
#include "Operations/EdgeSplit.h"
#include "PlaneMeshes.h"

using namespace meshopt;

namespace
{
/// A mesh whose boundary slides, and an editor for it.
struct Plane
{
  explicit Plane(const MeshInput<2>& in, bool splines = false)
    : mesh(buildMesh(in))
    , editor(mesh)
  {
    CurveOptions options;
    options.splines = splines;
    this->curves.build(this->editor, options);
    this->euler = eulerCharacteristic(this->mesh);
    this->areas = regionAreas(this->mesh);
  }
  void apply(const Proposal<2>& change)
  {
    const std::vector<double> qualities(change.cells.size(), 0.5);
    ASSERT_TRUE(this->editor.replace(change.cavity, change.cells, qualities, change.keptChange()));
  }
  bool split(Index t, int i)
  {
    const Facet<2> f = this->mesh.facet(t, i);
    Vec<2> x = 0.5 * (this->mesh.point(f[0]) + this->mesh.point(f[1]));
    Place place;
    const auto span = this->curves.span(this->mesh, f[0], f[1]);
    if (this->mesh.isKept(t, i) && span)
    {
      place = { Freedom::Curve, span->part, 0.5 * (span->from + span->to) };
      x = this->curves.at(place.part, place.parameter);
    }
    const std::size_t start = this->editor.begin();
    const Index p = this->editor.addPoint(x);
    Proposal<2> change;
    if (!proposeSplit(this->editor, &this->curves, { t, f[0], f[1], p }, change))
    {
      this->editor.rollback(start);
      return false;
    }
    this->editor.setPlace(p, place);
    this->apply(change);
    this->editor.commit(start);
    return true;
  }
  /// Only if all new cells are positive, as callers do.
  bool contract(Index v, Index u)
  {
    Proposal<2> change;
    if (!proposeContraction(this->editor, &this->curves, v, u, change))
    {
      return false;
    }
    for (const Simplex<2>& c : change.cells)
    {
      if (!(signedVolume(Corners<2>{
              this->mesh.point(c[0]), this->mesh.point(c[1]), this->mesh.point(c[2]) }) > 1e-12))
      {
        return false;
      }
    }
    this->apply(change);
    return true;
  }
  /// What must hold after any change; areas where the boundary is straight.
  void check(bool straight = true)
  {
    expectSound(this->mesh);
    EXPECT_EQ(eulerCharacteristic(this->mesh), this->euler);
    expectOnCurves(this->mesh, this->curves, 1e-12);
    const auto now = regionAreas(this->mesh);
    ASSERT_EQ(now.size(), this->areas.size());
    for (const auto& [region, area] : this->areas)
    {
      EXPECT_NEAR(now.at(region), area, straight ? 1e-14 : 0.1) << region;
    }
  }

  SimplexMesh<2> mesh;
  MeshEditor<2> editor;
  BoundaryCurves curves;
  long euler = 0;
  std::map<Index, double> areas;
};

MeshInput<2> squareOfTwo(int n)
{
  MeshInput<2> in = jitteredGrid<2>(n, 0.0);
  splitRegions(in);
  return in;
}

/// Straight boundaries of all kinds.
std::vector<MeshInput<2>> straightMeshes()
{
  return { twoTriangles(), jitteredGrid<2>(4, 0.2), bracket(4), squareOfTwo(4),
    slitSquare(8, 0.25, 0.75), slitSquare(8, 0.0, 0.5) };
}
}

TEST(EdgeChange, EveryEdgeCanBeSplit)
{
  for (const MeshInput<2>& in : straightMeshes())
  {
    Plane plane(in);
    int kept = 0;
    for (Index t = 0; t < static_cast<Index>(in.cells.size()); ++t)
    {
      for (int i = 0; i < 3 && plane.mesh.isAlive(t); ++i)
      {
        const bool isKept = plane.mesh.isKept(t, i);
        const Index cells = plane.mesh.countCells();
        const bool onSurface = plane.mesh.adjacent(t, i) == None;
        const Snapshot<2> before(plane.editor);
        const std::size_t start = plane.editor.begin();
        ASSERT_TRUE(plane.split(t, i));
        EXPECT_EQ(plane.mesh.countCells(), cells + (onSurface ? 1 : 2));
        plane.check();
        plane.editor.rollback(start);
        EXPECT_TRUE(Snapshot<2>(plane.editor) == before);
        kept += isKept;
      }
    }
    EXPECT_GE(kept, 4);
  }
}

TEST(EdgeChange, OneAfterTheOther)
{
  for (const MeshInput<2>& in : straightMeshes())
  {
    Plane plane(in);
    int splits = 0;
    for (Index t = 0; t < plane.mesh.numberOfCellSlots() && splits < 60; ++t)
    {
      for (int i = 0; i < 3 && plane.mesh.isAlive(t); ++i)
      {
        splits += plane.mesh.isKept(t, i) && plane.split(t, i);
      }
    }
    EXPECT_GE(splits, 4);
    plane.check();
    // and all that can go goes again
    for (int round = 0, done = 1; done > 0 && round < 20; ++round)
    {
      done = 0;
      for (Index v = 0; v < plane.mesh.numberOfPointSlots(); ++v)
      {
        std::vector<Index> star, around;
        if (plane.mesh.isPointAlive(v))
        {
          plane.mesh.star(v, star);
          for (Index c : star)
          {
            around.insert(around.end(), plane.mesh.nodes(c).begin(), plane.mesh.nodes(c).end());
          }
        }
        for (std::size_t k = 0; k < around.size() && plane.mesh.isPointAlive(v); ++k)
        {
          done += around[k] != v && plane.contract(v, around[k]);
        }
      }
      plane.check();
    }
    EXPECT_LE(plane.mesh.countPoints(), static_cast<Index>(in.points.size()));
    for (Index p = 0; p < static_cast<Index>(in.points.size()); ++p)
    {
      if (plane.mesh.isBoundary(p) && plane.mesh.freedom(p) == Freedom::Fixed)
      {
        EXPECT_TRUE(plane.mesh.isPointAlive(p)) << "corner " << p;
        EXPECT_EQ(plane.mesh.point(p), in.points[p]);
      }
    }
  }
}

TEST(EdgeChange, EveryNeighbourIsTried)
{
  for (const MeshInput<2>& in : straightMeshes())
  {
    Plane plane(in);
    int boundary = 0, inside = 0;
    for (Index v = 0; v < static_cast<Index>(in.points.size()); ++v)
    {
      if (!plane.mesh.isPointAlive(v))
      {
        continue;
      }
      std::vector<Index> star;
      plane.mesh.star(v, star);
      std::set<Index> around;
      for (Index c : star)
      {
        around.insert(plane.mesh.nodes(c).begin(), plane.mesh.nodes(c).end());
      }
      around.erase(v);
      for (Index u : around)
      {
        const bool slides = plane.mesh.freedom(v) == Freedom::Curve;
        const bool corner = !plane.mesh.isFree(v) && !slides;
        const Snapshot<2> before(plane.editor);
        const std::size_t start = plane.editor.begin();
        const bool done = plane.contract(v, u);
        if (done)
        {
          EXPECT_FALSE(corner) << v;
          EXPECT_FALSE(plane.mesh.isPointAlive(v));
          ++(slides ? boundary : inside);
          plane.check();
        }
        plane.editor.rollback(start);
        EXPECT_TRUE(Snapshot<2>(plane.editor) == before) << v << " " << u;
      }
    }
    if (in.points.size() > 20)
    {
      EXPECT_GT(boundary, 5);
      EXPECT_GT(inside, 5);
    }
  }
}

TEST(EdgeChange, InterfacesKeepTheirRegionsOnBothSides)
{
  for (bool curved : { false, true })
  {
    Plane plane(curved ? curvedInterface(8) : squareOfTwo(4), curved);
    int interfaces = 0;
    for (Index t = 0; t < 100 && t < plane.mesh.numberOfCellSlots(); ++t)
    {
      for (int i = 0; i < 3 && plane.mesh.isAlive(t); ++i)
      {
        const Index h = plane.mesh.adjacent(t, i);
        if (h == None || !plane.mesh.isKept(t, i))
        {
          continue;
        }
        const Index here = plane.mesh.region(t), there = plane.mesh.region(plane.mesh.cellOf(h));
        EXPECT_NE(here, there);
        ASSERT_TRUE(plane.split(t, i));
        ++interfaces;
        const std::vector<Index> created = plane.editor.created();
        EXPECT_EQ(created.size(), 4u);
        EXPECT_EQ(std::count_if(created.begin(), created.end(),
                    [&](Index c) { return plane.mesh.region(c) == here; }),
          2);
        for (Index c : created)
        {
          EXPECT_EQ(plane.mesh.region(c), plane.mesh.region(c) == here ? here : there);
        }
      }
    }
    EXPECT_GE(interfaces, curved ? 8 : 4);
    plane.check(!curved);
  }
}

TEST(EdgeChange, EarsAndCornersAreRefused)
{
  // one cell alone: its sliding node is an ear
  MeshInput<2> ear;
  ear.points = { { 0, 0 }, { 1, 0 }, { 0.5, 0.1 } };
  ear.cells = { { 0, 1, 2 } };
  Plane plane(ear);
  ASSERT_EQ(slidingPoints(plane.mesh), std::vector<Index>{ 2 });
  Proposal<2> change;
  for (Index u : { 0, 1 })
  {
    EXPECT_FALSE(proposeContraction<2>(plane.editor, &plane.curves, 2, u, change));
    EXPECT_FALSE(proposeContraction<2>(plane.editor, &plane.curves, u, 2, change)); // a corner
  }
  // along its piece only: not inwards, nor to another side
  Plane square(jitteredGrid<2>(4, 0.0));
  EXPECT_TRUE(proposeContraction<2>(square.editor, &square.curves, 2, 1, change));
  EXPECT_TRUE(proposeContraction<2>(square.editor, &square.curves, 2, 3, change));
  EXPECT_FALSE(proposeContraction<2>(square.editor, &square.curves, 2, 7, change));
  EXPECT_FALSE(proposeContraction<2>(square.editor, &square.curves, 2, 8, change));
  // nothing of the boundary without curves
  EXPECT_FALSE(proposeContraction<2>(square.editor, nullptr, 2, 1, change));
  const Index p = square.editor.addPoint({ 0.1, 0.0 });
  EXPECT_FALSE(proposeSplit<2>(square.editor, nullptr, { 0, 0, 1, p }, change));
  // not around a ring to less than what can be told apart
  Plane triangle(ring(3, 0.3, 1.0), true);
  for (Index v : slidingPoints(triangle.mesh))
  {
    for (Index u = 0; u < 6; ++u)
    {
      if (u / 3 == v / 3 && u != v)
      {
        EXPECT_FALSE(proposeContraction<2>(triangle.editor, &triangle.curves, v, u, change));
      }
    }
  }
}

TEST(EdgeChange, KeepsShape)
{
  Proposal<2> change;
  Plane circle(disc(32), true);
  EXPECT_TRUE(proposeContraction<2>(circle.editor, &circle.curves, 1, 0, change));
  Plane coarse(disc(9), true); // a node less: sagitta / chord = tan(40 deg / 2) / 2
  EXPECT_FALSE(proposeContraction<2>(coarse.editor, &coarse.curves, 1, 0, change));
}

TEST(EdgeChange, InSpaceTheSurfaceStays)
{
  SimplexMesh<3> mesh = buildMesh(jitteredGrid<3>(3, 0.15));
  MeshEditor<3> editor(mesh);
  const auto kept = keptFacets(mesh);
  const double volume = mesh.volume();
  const long euler = eulerCharacteristic(mesh);
  int splits = 0, refused = 0;
  Proposal<3> change;
  for (Index t = 0; t < 100; ++t)
  {
    for (int e = 0; e < 6 && mesh.isAlive(t); ++e)
    {
      const Index a = mesh.nodes(t)[Local<3>::edges[e][0]],
                  b = mesh.nodes(t)[Local<3>::edges[e][1]];
      const Snapshot<3> before(editor);
      const std::size_t start = editor.begin();
      const Index p = editor.addPoint(Vec<3>(0.5 * (mesh.point(a) + mesh.point(b))));
      if (proposeSplit<3>(editor, nullptr, { t, a, b, p }, change))
      {
        editor.replace(change.cavity, change.cells, std::vector<double>(change.cells.size(), 0.5),
          change.keptChange());
        ++splits;
        expectSound(mesh);
        EXPECT_EQ(eulerCharacteristic(mesh), euler);
        EXPECT_NEAR(mesh.volume(), volume, 1e-13);
        EXPECT_EQ(keptFacets(mesh), kept);
      }
      else
      {
        ++refused;
      }
      editor.rollback(start);
      EXPECT_TRUE(Snapshot<3>(editor) == before);
    }
  }
  EXPECT_GT(splits, 20);
  EXPECT_GT(refused, 20);
  for (Index v = 0; v < mesh.numberOfPointSlots(); ++v)
  {
    std::vector<Index> star;
    mesh.star(v, star);
    const Index u = mesh.nodes(star[0])[mesh.nodes(star[0])[0] == v ? 1 : 0];
    EXPECT_EQ(proposeContraction<3>(editor, nullptr, v, u, change), mesh.isFree(v)) << v;
  }
}
