// SPDX-License-Identifier: BSD-3-Clause
// Facets, angles and curves of the division, without a surface that slides: by brute force.
#include "Mesh/Ids.h"
#include "Surface/SurfaceDivision.h"
#include "TestMeshes.h"

#include <Eigen/Geometry>

#include <map>

using namespace meshopt;

namespace
{
using EdgeIds = std::array<Index, 2>;

/// The kept facets by brute force, as seen from outside; each with the facets' sorted ids.
std::map<Facet<3>, Vec<3>> outwardNormals(const SimplexMesh<3>& mesh)
{
  std::map<Facet<3>, Vec<3>> normals;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i < 4; ++i)
    {
      if (!mesh.isKept(c, i))
      {
        continue;
      }
      const Facet<3> f = mesh.facet(c, i);
      const Vec<3>& a = mesh.point(f[0]);
      const Vec<3> n = (mesh.point(f[1]) - a).cross(mesh.point(f[2]) - a).normalized();
      const bool isOutward = n.dot(mesh.point(mesh.nodes(c)[i]) - a) < 0.0;
      normals[sortedIds(f)] = isOutward ? n : Vec<3>(-n);
    }
  }
  return normals;
}

/// The edges of the outer surface whose facets turn by more than `degrees`.
std::vector<EdgeIds> sharpEdges(const SimplexMesh<3>& mesh, double degrees)
{
  std::map<EdgeIds, std::vector<Vec<3>>> at;
  for (const auto& [f, n] : outwardNormals(mesh))
  {
    for (const EdgeIds& e : { EdgeIds{ f[0], f[1] }, EdgeIds{ f[0], f[2] }, EdgeIds{ f[1], f[2] } })
    {
      at[e].push_back(n);
    }
  }
  std::vector<EdgeIds> sharp;
  for (const auto& [e, n] : at)
  {
    EXPECT_EQ(n.size(), 2u);
    if (std::atan2(n[0].cross(n[1]).norm(), n[0].dot(n[1])) * 180.0 / M_PI > degrees)
    {
      sharp.push_back(e);
    }
  }
  return sharp;
}

/// A cube whose nodes are displaced in all directions, also those of the surface.
SimplexMesh<3> roughBox()
{
  MeshInput<3> in = jitteredGrid<3>(5, 0.0);
  TestRandom random(12);
  for (Vec<3>& x : in.points)
  {
    x += 0.04 * Vec<3>(random(), random(), random());
  }
  return buildMesh(in);
}
}

TEST(SurfaceDivisionFacets, AnglesAreThoseOfTheFacets)
{
  const SimplexMesh<3> mesh = roughBox();
  SurfaceOptions options;
  options.tolerance = 1e-3;
  for (double angle : { 20.0, 45.0, 70.0 })
  {
    options.featureAngle = angle;
    const SurfaceDivision division(mesh, options);
    const std::vector<EdgeIds> sharp = sharpEdges(mesh, angle);
    ASSERT_GT(sharp.size(), 12u);
    EXPECT_EQ(division.curveEdges, sharp);
    EXPECT_EQ(division.bentEdges, sharpEdges(mesh, 0.5 * angle));
    EXPECT_EQ(division.bentOutside, division.bentEdges);
  }
}

TEST(SurfaceDivisionFacets, ItsFacetsAreTheKeptOnesOnceAsSeenFromTheLowerRegion)
{
  MeshInput<3> in = jitteredGrid<3>(4, 0.1);
  splitRegions(in);
  const SimplexMesh<3> mesh = buildMesh(in);
  const SurfaceDivision division(mesh, {});
  std::set<Facet<3>> seen;
  int between = 0;
  for (const SurfaceDivision::KeptFacet& facet : division.facets)
  {
    EXPECT_TRUE(seen.insert(sortedIds(facet.nodes)).second);
    const Index c = mesh.cellOf(facet.handle);
    const int i = mesh.facetOf(facet.handle);
    EXPECT_EQ(sortedIds(facet.nodes), sortedIds(mesh.facet(c, i)));
    EXPECT_EQ(facet.region, mesh.region(c));
    const Index h = mesh.adjacent(c, i);
    EXPECT_EQ(facet.other, h == None ? None : mesh.region(mesh.cellOf(h)));
    EXPECT_TRUE(facet.other == None || facet.region < facet.other);
    between += facet.other != None;
    const Vec<3>& a = mesh.point(facet.nodes[0]);
    const Vec<3> n = (mesh.point(facet.nodes[1]) - a).cross(mesh.point(facet.nodes[2]) - a);
    EXPECT_LT(n.dot(mesh.point(mesh.nodes(c)[i]) - a), 0.0);
    // Without a tolerance each patch has its plane.
    const SurfaceDivision::Plane& plane = division.planes.at(facet.patch);
    EXPECT_NEAR(plane.normal.dot(n), n.norm(), 1e-12);
    EXPECT_NEAR(plane.normal.dot(a - plane.origin), 0.0, 1e-12);
  }
  EXPECT_EQ(seen.size(), outwardNormals(mesh).size());
  EXPECT_EQ(between, 2 * 4 * 4);
}

TEST(SurfaceDivisionFacets, ChainsAreTheCurvesFromCornerToCorner)
{
  const SimplexMesh<3> mesh = roughBox();
  SurfaceOptions options;
  options.tolerance = 1e-3;
  for (double cornerAngle : { 20.0, 45.0, 89.0 })
  {
    options.cornerAngle = cornerAngle;
    const SurfaceDivision division(mesh, options);
    std::vector<EdgeIds> walked;
    for (const SurfaceDivision::Chain& chain : division.chains)
    {
      const std::size_t n = chain.points.size();
      for (std::size_t k = 0; k < n; ++k)
      {
        const bool isEnd = !chain.isClosed && (k == 0 || k + 1 == n);
        EXPECT_EQ(division.freedom[chain.points[k]] == Freedom::Curve, !isEnd);
        if (k + 1 < n || chain.isClosed)
        {
          walked.push_back(sortedIds(chain.points[k], chain.points[(k + 1) % n]));
        }
      }
    }
    std::sort(walked.begin(), walked.end());
    EXPECT_EQ(walked, division.curveEdges); // each once
  }
}

/// Two cones of height 1 on a ring of n points at 1, which turns by 360 / n degrees at each. Their
/// facets, at the distance a = cos(pi / n) below, have the normals (cos, sin, a) / sqrt(1 + a^2).
TEST(SurfaceDivisionFacets, ARingIsAClosedCurve)
{
  for (int n : { 12, 24 })
  {
    const SimplexMesh<3> mesh = buildMesh(ringOf(n));
    const auto points = static_cast<std::size_t>(n);
    const double turn = 360.0 / n;
    const double a2 = std::pow(std::cos(M_PI / n), 2);
    const double fold = std::acos((std::cos(2.0 * M_PI / n) + a2) / (1.0 + a2)) * 180.0 / M_PI;
    SurfaceOptions options;
    options.tolerance = 1e-3;
    options.cornerAngle = 1.01 * turn;
    options.featureAngle = 1.01 * fold;
    const SurfaceDivision ring(mesh, options);
    EXPECT_EQ(ring.numberOfPatches, 2);
    ASSERT_EQ(ring.chains.size(), 1u);
    EXPECT_TRUE(ring.chains[0].isClosed);
    EXPECT_TRUE(ring.chains[0].isSharp);
    EXPECT_EQ(ring.chains[0].points.size(), points);
    EXPECT_EQ(ring.freedom[0], Freedom::Patch); // the apexes
    EXPECT_EQ(ring.freedom[1], Freedom::Patch);
    EXPECT_NE(ring.patchOfPoint[0], ring.patchOfPoint[1]);
    options.cornerAngle = 0.99 * turn;
    EXPECT_EQ(SurfaceDivision(mesh, options).chains.size(), points);
    options.featureAngle = 0.99 * fold;
    EXPECT_EQ(SurfaceDivision(mesh, options).numberOfPatches, 2 * n);
  }
}

/// Inside of a region a kept facet has no outer side: its neighbours may be seen from either.
TEST(SurfaceDivisionFacets, KeptFacetsInsideAreSeenFromOneSide)
{
  MeshInput<3> in = jitteredGrid<3>(4, 0.0);
  // In another order: cells of lower numbers then stand on both sides.
  std::shuffle(in.cells.begin(), in.cells.end(), std::mt19937(3));
  const SimplexMesh<3> whole = buildMesh(in);
  const auto isBetween = [&](Index p) { return whole.point(p)[0] == 0.5; };
  for (Index c = 0; c < whole.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i < 4; ++i)
    {
      const Facet<3> f = whole.facet(c, i);
      if (std::all_of(f.begin(), f.end(), isBetween) && whole.adjacent(c, i) < whole.handle(c, i))
      {
        in.keptFacets.push_back(f);
      }
    }
  }
  const SimplexMesh<3> mesh = buildMesh(in);
  for (double tolerance : { 0.0, 1e-3 })
  {
    SurfaceOptions options;
    options.tolerance = tolerance;
    const SurfaceDivision division(mesh, options);
    // As an interface: four faces of the cube are cut in two, and there is one between.
    EXPECT_EQ(division.numberOfPatches, 11);
    EXPECT_EQ(division.chains.size(), 20u);
    int toLow = 0, fromLow = 0, between = 0;
    for (const SurfaceDivision::KeptFacet& facet : division.facets)
    {
      if (facet.other != None)
      {
        const Vec<3>& a = mesh.point(facet.nodes[0]);
        toLow += (mesh.point(facet.nodes[1]) - a).cross(mesh.point(facet.nodes[2]) - a)[0] < 0.0;
        fromLow += facet.handle <
          mesh.adjacent(mesh.cellOf(facet.handle), mesh.facetOf(facet.handle));
        ++between;
      }
    }
    EXPECT_EQ(between, 2 * 4 * 4);
    EXPECT_TRUE(toLow == 0 || toLow == between);
    EXPECT_TRUE(fromLow > 0 && fromLow < between); // some were turned over
  }
}

TEST(SurfaceDivisionFacets, ToleranceIsHeldBetweenRoundingAndATenth)
{
  const SimplexMesh<3> mesh = buildMesh(oneCell<3>());
  SurfaceOptions options;
  const SurfaceDivision none(mesh, options);
  EXPECT_DOUBLE_EQ(none.diagonal, std::sqrt(3.0));
  EXPECT_EQ(none.tolerance, none.rounding);
  EXPECT_EQ(none.rounding, 8.0 * std::numeric_limits<double>::epsilon()); // coordinates up to 1
  EXPECT_TRUE(none.isExact);
  options.tolerance = 0.02;
  EXPECT_EQ(SurfaceDivision(mesh, options).tolerance, 0.02);
  EXPECT_FALSE(SurfaceDivision(mesh, options).isExact);
  options.tolerance = 5.0;
  EXPECT_DOUBLE_EQ(SurfaceDivision(mesh, options).tolerance, 0.1 * std::sqrt(3.0));
}
