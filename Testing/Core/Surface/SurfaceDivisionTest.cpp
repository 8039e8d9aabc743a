// SPDX-License-Identifier: BSD-3-Clause
// Patches, curves and corners of bodies that are known.
#include "Surface/SurfaceDivision.h"
#include "SlidingBoxes.h"

using namespace meshopt;

namespace
{
struct Counts
{
  Index patches;
  std::size_t curves;
  int corners;
};

void expectCounts(const Sliding& made, const Counts& wanted)
{
  EXPECT_EQ(made.surface.numberOfPatches(), wanted.patches);
  EXPECT_EQ(made.surface.numberOfCurves(), wanted.curves);
  // With a tolerance, corners have some room.
  EXPECT_EQ(made.count(made.surface.isExact() ? Freedom::Fixed : Freedom::Corner), wanted.corners);
  expectSound(made.mesh);
}

TEST(SurfaceDivision, ABoxHasSixPatchesTwelveCurvesAndEightCorners)
{
  for (double tolerance : { 0.0, 1e-7, 1e-3 })
  {
    SurfaceOptions options;
    options.tolerance = tolerance;
    const Sliding box(slidingBox(4, 0.2), options);
    expectCounts(box, { 6, 12, 8 });
    EXPECT_EQ(box.surface.isExact(), tolerance < 1e-6);
    EXPECT_EQ(box.count(Freedom::Curve), 12 * 3);
    EXPECT_EQ(box.count(Freedom::Patch), 6 * 9);
    EXPECT_EQ(box.count(Freedom::Free), 27);
  }
}

TEST(SurfaceDivision, RoundingDoesNotHideWhatIsFlat)
{
  for (double scale : { 1.0, 1e-6, 1e9 })
  {
    MeshInput<3> in = slidingBox(4, 0.2);
    turn(in);
    for (Vec<3>& x : in.points)
    {
      x *= scale;
    }
    const Sliding box(in, {});
    expectCounts(box, { 6, 12, 8 });
    EXPECT_TRUE(box.surface.isExact());
  }
}

/// Rounded coordinates turn needles by much more than they displace points.
TEST(SurfaceDivision, RoundingDoesNotHideWhatIsFlatAmongNeedles)
{
  for (unsigned seed : { 1U, 2U, 3U })
  {
    MeshInput<3> in = slidingBox(6, 0.2, seed);
    for (Vec<3>& x : in.points)
    {
      x = Vec<3>(x[0] + 0.9 * x[1], 0.002 * x[1], x[2]); // flattened and sheared: still six planes
    }
    turn(in);
    expectCounts(Sliding(in, {}), { 6, 12, 8 });
  }
}

/// A ridge that ends on a border of labels: from there on the border is a curve without an angle.
TEST(SurfaceDivision, ARidgeThatEndsOnABorderEndsInACorner)
{
  MeshInput<3> in = slidingBox(4, 0.0);
  for (Vec<3>& x : in.points)
  {
    // The face z = 1 falls away for x > 0.5: as a ridge at y = 0, fading to a plane at y = 1.
    x[2] -= x[2] * std::max(0.0, x[0] - 0.5) * (1.0 - x[1]) * 1.6;
  }
  const auto onRidge = [&](Index p)
  { return std::fabs(in.points[p][0] - 0.5) < 1e-9 && std::fabs(in.points[p][2] - 1.0) < 1e-9; };
  SurfaceOptions options;
  options.tolerance = 1e-3;
  options.featureAngle = 30.0;
  const auto cornersInside = [&](const Sliding& made)
  {
    int count = 0;
    for (Index p = 0; p < static_cast<Index>(in.points.size()); ++p)
    {
      const double y = in.points[p][1];
      count += onRidge(p) && y > 0.1 && y < 0.9 && made.mesh.freedom(p) == Freedom::Corner;
    }
    return count;
  };
  EXPECT_EQ(cornersInside(Sliding(in, options)), 1); // the ridge just ends
  for (Index a = 0; a < static_cast<Index>(in.points.size()); ++a)
  {
    for (Index b = 0; b < static_cast<Index>(in.points.size()); ++b)
    {
      if (onRidge(a) && onRidge(b) && std::fabs(in.points[b][1] - in.points[a][1] - 0.25) < 1e-9)
      {
        in.keptEdges.push_back({ a, b });
      }
    }
  }
  EXPECT_EQ(cornersInside(Sliding(in, options)), 1); // it goes on as a line, and yet ends there
  in.keptEdges.clear();
  splitRegions(in);
  EXPECT_EQ(cornersInside(Sliding(in, options)), 1); // where an interface meets it, too
}

TEST(SurfaceDivision, SinglePrecisionNeedsATolerance)
{
  MeshInput<3> in = slidingBox(4, 0.2);
  turn(in);
  for (Vec<3>& x : in.points)
  {
    x = x.cast<float>().cast<double>();
  }
  EXPECT_GT(Sliding(in, {}).surface.numberOfPatches(), 100);
  SurfaceOptions options;
  options.tolerance = 1.6e-6; // the diagonal is 1.7, coordinates are up to 6
  expectCounts(Sliding(in, options), { 6, 12, 8 });
}

TEST(SurfaceDivision, ACurvedFaceIsOnePatchWithATolerance)
{
  MeshInput<3> in = slidingBox(6, 0.2);
  bend(in);
  SurfaceOptions options;
  options.tolerance = 1e-3;
  expectCounts(Sliding(in, options), { 6, 12, 8 });
  // Exactly flat are only the four straight sides.
  const Sliding exact(in, {});
  EXPECT_GT(exact.surface.numberOfPatches(), 100);
  EXPECT_GT(exact.count(Freedom::Fixed), 8);
  // With a feature angle below that of the facets nothing curved is connected.
  options.featureAngle = 1.0;
  EXPECT_GT(Sliding(in, options).surface.numberOfPatches(), 30);
}

TEST(SurfaceDivision, AnInterfaceIsAPatchAndItsBorderACurve)
{
  MeshInput<3> in = jitteredGrid<3>(4, 0.0);
  splitRegions(in);
  // Four faces are cut in two, and there is one between; 4 edges are cut in two, and 4 are new.
  expectCounts(Sliding(in, {}), { 11, 20, 12 });
}

TEST(SurfaceDivision, WhatTheCallerMarksStays)
{
  MeshInput<3> in = jitteredGrid<3>(4, 0.1);
  SurfaceOptions options;
  options.corners.assign(in.points.size(), 0);
  Index inFace = None, onEdge = None;
  for (std::size_t p = 0; p < in.points.size(); ++p)
  {
    inFace = in.points[p] == Vec<3>(0.5, 0.5, 0.0) ? static_cast<Index>(p) : inFace;
    onEdge = in.points[p] == Vec<3>(0.5, 0.0, 0.0) ? static_cast<Index>(p) : onEdge;
  }
  options.corners[inFace] = options.corners[onEdge] = 1;
  Sliding marked(in, options);
  expectCounts(marked, { 6, 13, 10 });
  EXPECT_EQ(marked.mesh.freedom(inFace), Freedom::Fixed);
  // A fixed point is a corner, too. Three of them lock their facet.
  in.fixedPoints.assign(in.points.size(), 0);
  for (std::size_t p = 0; p < in.points.size(); ++p)
  {
    in.fixedPoints[p] = in.points[p][2] == 0.0;
  }
  const Sliding locked(in, {});
  EXPECT_EQ(locked.surface.numberOfPatches(), 5);
  for (Index c = 0; c < locked.mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i < 4; ++i)
    {
      const Facet<3> f = locked.mesh.facet(c, i);
      const bool isFloor = std::all_of(
        f.begin(), f.end(), [&](Index p) { return locked.mesh.point(p)[2] == 0.0; });
      if (locked.mesh.isKept(c, i))
      {
        EXPECT_EQ(locked.mesh.patch(c, i) == None, isFloor);
      }
    }
  }
}

TEST(SurfaceDivision, NumbersOfFacetsAndLinesDivideAFace)
{
  MeshInput<3> in = jitteredGrid<3>(4, 0.1);
  const SimplexMesh<3> mesh = buildMesh(in);
  SurfaceOptions options;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i < 4; ++i)
    {
      const Facet<3> f = mesh.facet(c, i);
      double x = 0.0;
      bool isFloor = mesh.isKept(c, i);
      for (Index p : f)
      {
        x += mesh.point(p)[0] / 3.0;
        isFloor = isFloor && mesh.point(p)[2] == 0.0;
      }
      if (isFloor && x < 0.5)
      {
        options.labels.emplace_back(sortedIds(f), 5);
      }
    }
  }
  std::sort(options.labels.begin(), options.labels.end());
  ASSERT_EQ(options.labels.size(), 16u);
  const Sliding labelled(in, options);
  expectCounts(labelled, { 7, 15, 10 });
  int count = 0;
  for (Index k = 0; k < 7; ++k)
  {
    count += labelled.surface.label(k) == 5;
  }
  EXPECT_EQ(count, 1);
  // The same border as a line of kept edges.
  for (std::size_t p = 0; p < in.points.size(); ++p)
  {
    for (std::size_t q = 0; q < in.points.size(); ++q)
    {
      const Vec<3>&a = in.points[p], &b = in.points[q];
      if (a[0] == 0.5 && a[2] == 0.0 && b == Vec<3>(0.5, a[1] + 0.25, 0.0))
      {
        in.keptEdges.push_back({ static_cast<Index>(p), static_cast<Index>(q) });
      }
    }
  }
  ASSERT_EQ(in.keptEdges.size(), 4u);
  const Sliding lined(in, {});
  EXPECT_EQ(lined.surface.numberOfPatches(), 7); // the line goes from side to side
  EXPECT_EQ(lined.surface.numberOfCurves(), 15u);
  // With numbers: a corner more where they change.
  SurfaceOptions numbered;
  for (const std::array<Index, 2>& e : in.keptEdges)
  {
    const double y = in.points[e[0]][1] + in.points[e[1]][1];
    numbered.lines.emplace_back(sortedIds(e), y < 1.0 ? 3 : 4);
  }
  std::sort(numbered.lines.begin(), numbered.lines.end());
  expectCounts(Sliding(in, numbered), { 7, 16, 11 });
  in.keptEdges.clear();
  const Sliding unkept(in, numbered);
  expectCounts(unkept, { 7, 16, 11 });
  // Each edge lies on itself.
  for (const auto& [edge, number] : numbered.lines)
  {
    EXPECT_EQ(unkept.surface.inputEdge(unkept.mesh, edge[1], edge[0]), edge);
  }
}

TEST(SurfaceDivision, ALineThatEndsOnARidgeEndsInACorner)
{
  const MeshInput<3> in = jitteredGrid<3>(4, 0.1);
  SurfaceOptions options;
  options.tolerance = 1e-3;
  for (Index p = 0; p < static_cast<Index>(in.points.size()); ++p)
  {
    for (Index q = 0; q < static_cast<Index>(in.points.size()); ++q)
    {
      const Vec<3>&a = in.points[p], &b = in.points[q];
      if (a[0] == 0.0 && a[2] == 0.0 && a[1] < 0.5 && b == Vec<3>(0.0, a[1] + 0.25, 0.0))
      {
        options.lines.emplace_back(sortedIds(p, q), 7);
      }
    }
  }
  std::sort(options.lines.begin(), options.lines.end());
  ASSERT_EQ(options.lines.size(), 2u);
  expectCounts(Sliding(in, options), { 6, 13, 9 });
}

TEST(SurfaceDivision, FacetsThatLieOnEachOtherAreLocked)
{
  // Two boxes that touch, without common points: the lips of a closed crack.
  MeshInput<3> in = jitteredGrid<3>(3, 0.1);
  const MeshInput<3> one = in;
  const auto n = static_cast<Index>(in.points.size());
  for (const Vec<3>& x : one.points)
  {
    in.points.push_back(Vec<3>(2.0 - x[0], x[1], x[2])); // mirrored at x = 1
  }
  for (Simplex<3> cell : one.cells)
  {
    std::swap(cell[2], cell[3]);
    for (Index& p : cell)
    {
      p += n;
    }
    in.cells.push_back(cell);
  }
  const Sliding boxes(in, {});
  EXPECT_EQ(boxes.surface.numberOfPatches(), 10);
  EXPECT_EQ(boxes.surface.numberOfTwins(), 2 * 18);
  for (std::size_t p = 0; p < in.points.size(); ++p)
  {
    if (in.points[p][0] == 1.0)
    {
      EXPECT_EQ(boxes.mesh.freedom(static_cast<Index>(p)), Freedom::Fixed);
    }
  }
}

/// Nothing there may change: to measure its room would be in vain, and takes long in a mesh whose
/// cells share no points.
TEST(SurfaceDivision, AnEdgeBetweenLockedFacetsIsNoCurve)
{
  const MeshInput<3> grid = jitteredGrid<3>(2, 0.0);
  MeshInput<3> apart;
  std::size_t wanted = 0;
  for (const Simplex<3>& cell : grid.cells)
  {
    const auto first = static_cast<Index>(apart.points.size());
    apart.cells.push_back({ first, first + 1, first + 2, first + 3 });
    std::array<bool, 4> isOuter; // the facet opposite each node
    for (int i = 0; i < 4; ++i)
    {
      apart.points.push_back(grid.points[cell[i]]);
      isOuter[i] = false;
      for (int d = 0; d < 3; ++d)
      {
        for (const double side : { 0.0, 1.0 })
        {
          const auto lies = [&](int k) { return k == i || grid.points[cell[k]][d] == side; };
          isOuter[i] = isOuter[i] || (lies(0) && lies(1) && lies(2) && lies(3));
        }
      }
    }
    for (int i = 0; i < 4; ++i)
    {
      for (int j = 0; j < i; ++j)
      {
        wanted += isOuter[i] || isOuter[j]; // an edge lies in the two facets opposite the others
      }
    }
  }
  SurfaceOptions options;
  options.tolerance = 1e-2;
  const Sliding made(apart, options);
  EXPECT_EQ(made.surface.numberOfCurves(), wanted);
  EXPECT_LT(wanted, 6 * apart.cells.size());
}

TEST(SurfaceDivision, WhereTheSurfaceTouchesItselfIsACorner)
{
  MeshInput<3> in = jitteredGrid<3>(2, 0.0);
  // Only the cells of two boxes that share a point of a plane, none of them an edge.
  std::vector<Simplex<3>> cells;
  for (const Simplex<3>& cell : in.cells)
  {
    Vec<3> centre = Vec<3>::Zero();
    for (Index p : cell)
    {
      centre += 0.25 * in.points[p];
    }
    const bool low = centre[0] < 0.5 && centre[1] < 0.5 && centre[2] < 0.5;
    const bool high = centre[0] > 0.5 && centre[1] > 0.5 && centre[2] > 0.5;
    if (low || high)
    {
      cells.push_back(cell);
    }
  }
  in.cells = cells;
  const Sliding made(in, {});
  for (std::size_t p = 0; p < in.points.size(); ++p)
  {
    if (in.points[p] == Vec<3>(0.5, 0.5, 0.5))
    {
      EXPECT_EQ(made.mesh.freedom(static_cast<Index>(p)), Freedom::Fixed);
    }
  }
  EXPECT_EQ(made.surface.numberOfPatches(), 12);
}
}
