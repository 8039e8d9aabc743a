// SPDX-License-Identifier: BSD-3-Clause
// Meshes whose cells overlap: what geometry forbids elsewhere must be looked at, so that they stay
// meshes.
#include "Mesh/CavityFit.h"
#include "Mesh/PinchedPoints.h"
#include "Optimize/Optimizer.h"
#include "PlaneMeshes.h"
#include "Surface/SurfaceFaults.h"

#include <Eigen/Geometry>

using namespace meshopt;

namespace
{
using Points = std::vector<Vec<2>>;
using Cells = std::vector<Simplex<2>>;

SimplexMesh<2> build(const Points& points, const Cells& cells)
{
  MeshInput<2> in;
  in.points = points;
  in.cells = cells;
  return buildMesh(in);
}

/// A fan around 3, and a triangle that touches it in two of its points and lies across it.
SimplexMesh<2> fanAndTriangle()
{
  return build({ { 0, 0 }, { 0.9, 0.43 }, { 0.29, -1.17 }, { 4.35, -0.26 }, { 2.16, -0.06 },
                 { 1.86, -1.46 }, { 2.47, -1.03 }, { 3.63, -0.28 } },
    { { 2, 0, 3 }, { 3, 0, 1 }, { 3, 1, 4 }, { 5, 2, 3 }, { 5, 3, 6 }, { 6, 4, 7 } });
}

/// Pieces of a square, thrown over each other; two points are pinched here, too.
SimplexMesh<2> heap()
{
  return build({ { 0, 0 }, { 0.498, -0.867 }, { 0.576, -0.799 }, { 1.621, 0.294 },
                 { 1.644, -1.373 }, { 1.410, -0.196 }, { 2.865, -0.779 }, { 3.598, -0.240 } },
    { { 2, 0, 3 }, { 0, 3, 1 }, { 1, 3, 4 }, { 2, 5, 3 }, { 3, 6, 4 }, { 5, 7, 6 } });
}

/// An inverted cell that a cavity can surround: a node joined to all that is around it closes a
/// bubble.
SimplexMesh<2> crumpledGrid()
{
  return build({ { 0, 0 }, { 0.533456, 0.845828 }, { 1.066913, 1.691655 }, { 1.7781, -0.63998 },
                 { 1.141543, 1.620004 }, { 2.1414, 0.485382 }, { 2.233028, 2.149606 },
                 { 3.189063, 0.199287 }, { 1.950851, 0.983753 }, { 3.427788, 1.505939 },
                 { 3.604395, 0.091286 }, { 4.137852, 0.937113 } },
    { { 0, 3, 4 }, { 0, 4, 1 }, { 4, 1, 5 }, { 1, 5, 2 }, { 2, 5, 6 }, { 3, 7, 4 }, { 4, 7, 8 },
      { 5, 8, 9 }, { 5, 9, 6 }, { 7, 10, 8 }, { 8, 10, 11 }, { 8, 11, 9 } });
}

void optimizeAllWays(const SimplexMesh<2>& mesh)
{
  for (int way = 0; way < 64; ++way)
  {
    SimplexMesh<2> copy = mesh;
    Options options;
    options.algorithm = way & 1 ? Algorithm::Paper1996 : Algorithm::WorstFirst;
    options.effort = way & 2 ? Effort::Best : Effort::Default;
    options.measure = way & 4 ? Measure::VolumeLength : Measure::Shape;
    options.moveNodes = !(way & 8);
    options.removeNodes = !(way & 16);
    options.growthBudget = way & 32 ? 2.0 : 0.1;
    NodalMetric<2> metric;
    const Report report = optimize<2>(copy, metric, options, {});
    EXPECT_TRUE(copy.audit(report.invertedAfter == 0).empty()) << "way " << way;
    EXPECT_EQ(eulerCharacteristic(copy), eulerCharacteristic(mesh)) << "way " << way;
    EXPECT_GE(report.worstAfter, report.worstBefore) << "way " << way;
  }
}
}

TEST(Overlap, PinchedPoints)
{
  const std::vector<std::uint8_t> pinched = pinchedPoints<2>(fanAndTriangle());
  EXPECT_EQ(pinched, std::vector<std::uint8_t>({ 0, 0, 0, 0, 1, 0, 1, 0 }));
  EXPECT_TRUE(pinchedPoints<2>(buildMesh(jitteredGrid<2>(4, 0.1))).empty());
  EXPECT_TRUE(pinchedPoints<3>(buildMesh(jitteredGrid<3>(2, 0.1))).empty());

  // four corners of a square around a hole, which only touch
  const SimplexMesh<2> chain = build(
    { { 1, 0 }, { 2, 1 }, { 1, 2 }, { 0, 1 }, { 2, 0 }, { 2, 2 }, { 0, 2 }, { 0, 0 } },
    { { 0, 4, 1 }, { 1, 5, 2 }, { 2, 6, 3 }, { 3, 7, 0 } });
  EXPECT_EQ(pinchedPoints<2>(chain), std::vector<std::uint8_t>({ 1, 1, 1, 1, 0, 0, 0, 0 }));
  const SimplexMesh<2> pair = build(
    { { 1, 0 }, { 2, 1 }, { 1, 2 }, { 0, 1 }, { 2, 0 } }, { { 0, 4, 1 }, { 1, 2, 3 } });
  EXPECT_EQ(pinchedPoints<2>(pair), std::vector<std::uint8_t>({ 0, 1, 0, 0, 0 }));
}

/// A fan around its first point that goes around more, or less, than once.
SimplexMesh<2> spiral(int cells, double angle)
{
  MeshInput<2> in;
  in.points.push_back(Vec<2>::Zero());
  for (int k = 0; k <= cells; ++k)
  {
    in.points.push_back(Vec<2>(std::cos(k * angle), std::sin(k * angle)));
  }
  for (Index k = 1; k <= cells; ++k)
  {
    in.cells.push_back({ 0, k, k + 1 });
  }
  return buildMesh(in);
}

TEST(Overlap, MoreThanAllDirections)
{
  EXPECT_TRUE(mayOverlap<2>(spiral(7, 0.95), {})); // 6.65 > 2 pi
  EXPECT_FALSE(mayOverlap<2>(spiral(7, 0.85), {}));
  EXPECT_FALSE(mayOverlap<2>(buildMesh(disc(9)), {}));
  EXPECT_FALSE(mayOverlap<2>(spiral(7, 2.0 * Pi / 7), {})); // a slit
  EXPECT_TRUE(mayOverlap<2>(fanAndTriangle(), pinchedPoints<2>(fanAndTriangle())));
  EXPECT_FALSE(mayOverlap<3>(buildMesh(jitteredGrid<3>(3, 0.1)), {}));
  MeshInput<3> in = jitteredGrid<3>(3, 0.0);
  in.points.front() = Vec<3>(0.7, 0.7, 0.7); // a corner deep inside
  EXPECT_TRUE(mayOverlap<3>(buildMesh(in), {}));
}

/// The part of a grid around its first corner gets smaller by `factor`.
MeshInput<3> tinyCorner(double factor, unsigned seed)
{
  MeshInput<3> in = jitteredGrid<3>(4, 0.35, seed);
  for (Vec<3>& x : in.points)
  {
    x *= x.maxCoeff() < 0.6 ? factor : 1.0;
  }
  return in;
}

TEST(Overlap, SignsOfTinyCells)
{
  EXPECT_TRUE(hasLostSigns<3>(buildMesh(tinyCorner(1e-152, 1))));
  EXPECT_TRUE(mayOverlap<3>(buildMesh(tinyCorner(1e-152, 1)), {}));
  EXPECT_FALSE(hasLostSigns<3>(buildMesh(tinyCorner(1e-60, 1))));
  EXPECT_FALSE(hasLostSigns<3>(buildMesh(tinyCorner(0.0, 1)))) << "all at one place";
  MeshInput<3> noise = jitteredGrid<3>(3, 0.1); // long edges, of which one coordinate is tiny
  for (Vec<3>& x : noise.points)
  {
    x[2] = x[2] == 0.0 ? 1e-120 * (1.0 + x[0]) : x[2];
  }
  EXPECT_FALSE(hasLostSigns<3>(buildMesh(noise)));
}

/// Removal of a node joined its facets to one that signs put on the wrong side: what came of it was
/// no mesh (8). Or qualities rose by a hundredth, again and again, from 1e-300 (72).
TEST(Overlap, TinyCellsStayAMesh)
{
  for (unsigned seed : { 1, 2, 3, 4, 5, 6, 7, 8, 72 })
  {
    SimplexMesh<3> mesh = buildMesh(tinyCorner(std::pow(10.0, -148.0 - seed % 14), seed));
    const auto before = eulerCharacteristic(mesh);
    Options options;
    options.targetQuality = 0.3;
    NodalMetric<3> metric;
    const Report report = optimize<3>(mesh, metric, options, {});
    EXPECT_TRUE(mesh.audit(false).empty()) << "seed " << seed;
    EXPECT_EQ(eulerCharacteristic(mesh), before) << "seed " << seed;
    EXPECT_GE(report.worstAfter, report.worstBefore) << "seed " << seed;
  }
}

TEST(Overlap, WhatFillsACavityHangsTogether)
{
  // the ring of cells around a cell, and a node joined to both of its sides
  MeshInput<2> in;
  in.points = { { -1, -1 }, { 1, -1 }, { 0, 1 }, { -4, -3 }, { 4, -3 }, { 0, 5 } };
  in.cells = { { 0, 1, 2 }, { 3, 4, 0 }, { 4, 1, 0 }, { 4, 5, 1 }, { 5, 2, 1 }, { 5, 3, 2 },
    { 3, 0, 2 } };
  const SimplexMesh<2> mesh = buildMesh(in);
  const std::vector<Index> cavity{ 1, 2, 3, 4, 5, 6 };
  Cells same,
    joined{ { 3, 4, 6 }, { 4, 5, 6 }, { 5, 3, 6 }, { 1, 0, 6 }, { 2, 1, 6 }, { 0, 2, 6 } };
  for (Index c : cavity)
  {
    same.push_back(mesh.nodes(c));
  }
  EXPECT_TRUE(fillsCavity<2>(mesh, cavity, same));
  EXPECT_FALSE(fillsCavity<2>(mesh, cavity, joined));
}

TEST(Overlap, WhatHangsTogetherAtAPointStaysSo)
{
  // two cells of a fan; the other filling leaves two rings around its point that only touch
  MeshInput<2> in;
  in.points.push_back(Vec<2>::Zero());
  for (int k = 0; k < 6; ++k)
  {
    in.points.push_back(Vec<2>(std::cos(k * Pi / 3), std::sin(k * Pi / 3)));
    in.cells.push_back({ 0, k + 1, (k + 1) % 6 + 1 });
  }
  const SimplexMesh<2> mesh = buildMesh(in);
  const std::vector<Index> cavity{ 0, 3 };
  EXPECT_FALSE(
    fillsCavity<2>(mesh, cavity, { { 0, 1, 5 }, { 0, 4, 2 }, { 1, 5, 4 }, { 1, 4, 2 } }));
  // all of the fan but one cell: the point stays at the boundary of the cavity
  EXPECT_TRUE(fillsCavity<2>(
    mesh, { 0, 1, 2, 3, 4 }, { { 0, 1, 3 }, { 0, 3, 6 }, { 1, 2, 3 }, { 3, 4, 5 }, { 3, 5, 6 } }));
}

TEST(Overlap, CrumpledGridsAreUntangledAndNotPinched)
{
  long inverted = 0;
  for (unsigned seed = 1; seed <= 40; ++seed)
  {
    SimplexMesh<3> mesh = buildMesh(jitteredGrid<3>(3, 2.0, seed));
    const long euler = eulerCharacteristic(mesh);
    NodalMetric<3> metric;
    const Report report = optimize<3>(mesh, metric, {}, {});
    EXPECT_TRUE(mesh.audit(report.invertedAfter == 0).empty()) << seed;
    EXPECT_EQ(eulerCharacteristic(mesh), euler) << seed;
    EXPECT_TRUE(pinchedPoints<3>(mesh).empty()) << seed;
    inverted += report.invertedAfter;
  }
  EXPECT_LE(inverted, 5); // more than 200 where single nodes move first
}

TEST(Overlap, NodesDoNotFlyOff)
{
  // a surface that passes through itself: some cells stay inverted, and the farther a node, the
  // flatter they are
  TestRandom random(1);
  for (int k = 0; k < 10; ++k)
  {
    MeshInput<3> in = jitteredGrid<3>(4, 0.0);
    Eigen::AlignedBox<double, 3> box;
    for (Vec<3>& x : in.points)
    {
      x += 0.5 * Vec<3>(random(), random(), random());
      box.extend(x);
    }
    SimplexMesh<3> mesh = buildMesh(in);
    Options options;
    options.algorithm = k % 4 < 2 ? Algorithm::WorstFirst : Algorithm::Paper1996;
    options.reconnect = options.insertNodes = options.removeNodes = k % 2 == 0;
    NodalMetric<3> metric;
    const Report report = optimize<3>(mesh, metric, options, {});
    EXPECT_GT(report.invertedAfter, 0);
    for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
    {
      EXPECT_LE(box.exteriorDistance(mesh.point(p)), 1e-9) << p;
    }
  }
}

TEST(Overlap, NoEdgeGetsAThirdCellAtPinchedPoints)
{
  optimizeAllWays(fanAndTriangle());
  optimizeAllWays(heap());
}

TEST(Overlap, NoBubbleAroundAnInvertedCell) { optimizeAllWays(crumpledGrid()); }

TEST(Overlap, SizesInACrumpledMesh)
{
  for (const SimplexMesh<2>& mesh : { fanAndTriangle(), heap(), crumpledGrid() })
  {
    for (double size : { 0.1, 0.5, 2.0 })
    {
      SimplexMesh<2> copy = mesh;
      MeshEditor<2> editor(copy);
      BoundaryCurves curves;
      CurveOptions straight;
      straight.splines = false;
      curves.build(editor, straight);
      Options options;
      options.desiredSize = size;
      NodalMetric<2> metric(size);
      const Report report = optimize<2>(copy, metric, options, {}, &curves);
      EXPECT_TRUE(copy.audit(report.invertedAfter == 0).empty()) << size;
      EXPECT_EQ(eulerCharacteristic(copy), eulerCharacteristic(mesh)) << size;
    }
  }
}

namespace
{
/// Nodes thrown until cells are inverted, and these renumbered: all volumes are positive, but cells
/// lie on each other.
template <int D>
MeshInput<D> foldedGrid(unsigned seed)
{
  MeshInput<D> in = jitteredGrid<D>(D == 3 ? 3 : 6, 0.9, seed);
  for (Simplex<D>& cell : in.cells)
  {
    Corners<D> x;
    std::transform(cell.begin(), cell.end(), x.begin(), [&](Index p) { return in.points[p]; });
    if (signedVolume(x) < 0.0)
    {
      std::swap(cell[D - 1], cell[D]);
    }
  }
  return in;
}

/// Renumbering made such cells inverted, and the worst quality negative.
template <int D>
void expectNoneInverted()
{
  int folded = 0;
  for (unsigned seed = 1; seed <= 8; ++seed)
  {
    for (Algorithm algorithm : { Algorithm::WorstFirst, Algorithm::Paper1996 })
    {
      SimplexMesh<D> mesh = buildMesh(foldedGrid<D>(seed));
      EXPECT_EQ(mesh.numberOfReorientedCells(), 0);
      folded += mesh.numberOfFoldedFacets() > 0;
      Options options;
      options.algorithm = algorithm;
      NodalMetric<D> metric;
      const long euler = eulerCharacteristic(mesh);
      const Report report = optimize<D>(mesh, metric, options, {});
      EXPECT_GT(report.worstBefore, 0.0);
      EXPECT_GE(report.worstAfter, report.worstBefore) << "seed " << seed;
      EXPECT_EQ(report.invertedAfter, 0);
      EXPECT_TRUE(mesh.audit(true).empty()) << "seed " << seed;
      EXPECT_EQ(eulerCharacteristic(mesh), euler);
    }
  }
  EXPECT_GE(folded, 8);
}
}

TEST(Overlap, PositiveCellsThatLieOnEachOtherStayPositive)
{
  expectNoneInverted<2>();
  expectNoneInverted<3>();
}
