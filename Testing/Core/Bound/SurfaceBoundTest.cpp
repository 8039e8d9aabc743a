// SPDX-License-Identifier: BSD-3-Clause
// The certified bound of a surface, against meshes that exist.
#include "Bound/SurfaceBound.h"
#include "Bound/ApexBound.h"
#include "Quality/Shape.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace meshopt;

namespace
{
constexpr double pi = 3.14159265358979323846;

/// A cube of n^3 small ones with 6 tetrahedra each; inner nodes are moved at random.
MeshInput<3> cube(int n, double move, unsigned seed)
{
  MeshInput<3> in;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-move, move);
  for (int k = 0; k <= n; ++k)
  {
    for (int j = 0; j <= n; ++j)
    {
      for (int i = 0; i <= n; ++i)
      {
        Vec<3> x(i, j, k);
        if (i % n && j % n && k % n)
        {
          x += Vec<3>(shift(random), shift(random), shift(random));
        }
        in.points.push_back(x / n);
      }
    }
  }
  const int paths[6][3] = { { 1, 3, 0 }, { 5, 1, 0 }, { 3, 2, 0 }, { 2, 6, 0 }, { 4, 5, 0 },
    { 6, 4, 0 } };
  for (int k = 0; k < n; ++k)
  {
    for (int j = 0; j < n; ++j)
    {
      for (int i = 0; i < n; ++i)
      {
        const auto id = [&](int c)
        {
          return static_cast<Index>(
            i + (c & 1) + (n + 1) * (j + ((c >> 1) & 1) + (n + 1) * (k + (c >> 2))));
        };
        for (const auto& p : paths)
        {
          in.cells.push_back({ id(0), id(p[0]), id(p[1]), id(7) });
        }
      }
    }
  }
  return in;
}

double worst(const SimplexMesh<3>& mesh)
{
  double q = 1.0;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    q = std::min(q, MeanEdgeShape<3>::value(mesh.corners(c)));
  }
  return q;
}
}

TEST(SurfaceBound, NoMeshIsAboveItsBound)
{
  for (unsigned seed = 0; seed < 8; ++seed)
  {
    SimplexMesh<3> mesh;
    ASSERT_FALSE(SimplexMesh<3>::build(cube(4, 0.3, seed), mesh));
    const SurfaceBound<3> bound = surfaceBound(mesh);
    EXPECT_GE(bound.bound, worst(mesh));
    EXPECT_EQ(bound.sides.size(), 6u * 16u * 2u);
    for (std::size_t s = 0; s < bound.sides.size(); ++s)
    {
      EXPECT_GE(bound.sideCaps[s], MeanEdgeShape<3>::value(mesh.corners(bound.sides[s].cell)));
    }
  }
}

TEST(SurfaceBound, EveryTetrahedronAloneIsItsOwnBound)
{
  // all four facets kept, all six angles: k = 1 is what there is, so no bound may be below it
  std::mt19937 random(11);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int k = 0; k < 200; ++k)
  {
    MeshInput<3> in;
    for (int p = 0; p < 4; ++p)
    {
      in.points.emplace_back(u(random), u(random), u(random));
    }
    in.cells.push_back({ 0, 1, 2, 3 });
    SimplexMesh<3> mesh;
    ASSERT_FALSE(SimplexMesh<3>::build(in, mesh));
    EXPECT_GE(surfaceBound(mesh).bound, worst(mesh));
  }
}

TEST(SurfaceBound, QuickRunsGiveTheSameBound)
{
  SimplexMesh<3> mesh;
  MeshInput<3> in = cube(4, 0.3, 1);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(-0.08, 0.08);
  for (Vec<3>& p : in.points) // surface too
  {
    p += Vec<3>(u(random), u(random), u(random));
  }
  ASSERT_FALSE(SimplexMesh<3>::build(in, mesh));
  SurfaceBoundOptions options;
  const SurfaceBound<3> exact = surfaceBound(mesh, options);
  options.enough = 0.6;
  const SurfaceBound<3> quick = surfaceBound(mesh, options);
  EXPECT_NEAR(quick.bound, exact.bound, 2e-7);
  for (std::size_t s = 0; s < exact.sideCaps.size(); ++s)
  {
    EXPECT_LE(quick.sideCaps[s], exact.sideCaps[s] * (1.0 + 1e-12));
    EXPECT_EQ(quick.sideCaps[s] < 0.6, exact.sideCaps[s] < 0.6);
  }
  options.listEdgesBelow = 0.7;
  const SurfaceBound<3> listed = surfaceBound(mesh, options);
  EXPECT_NEAR(listed.bound, exact.bound, 2e-7);
  for (const EdgeBound& edge : listed.edges)
  {
    EXPECT_LT(edge.cap, 0.7);
    EXPECT_LT(edge.a, edge.b);
  }
}

TEST(SurfaceBound, InterfacesAreKeptOnBothSides)
{
  MeshInput<3> in = cube(2, 0.0, 1);
  in.regions.resize(in.cells.size());
  std::size_t interfaceSides = 2 * 2 * 2 *
    2; // a plane of 2 x 2 squares, two triangles each, two sides
  for (std::size_t c = 0; c < in.cells.size(); ++c)
  {
    double x = 0.0;
    for (Index p : in.cells[c])
    {
      x += in.points[p][0] / 4.0;
    }
    in.regions[c] = x > 0.5;
  }
  SimplexMesh<3> mesh;
  ASSERT_FALSE(SimplexMesh<3>::build(in, mesh));
  const SurfaceBound<3> bound = surfaceBound(mesh);
  EXPECT_EQ(bound.sides.size(), 6u * 4u * 2u + interfaceSides);
  EXPECT_GE(bound.bound, worst(mesh));
}

TEST(SurfaceBound, OtherMeasures)
{
  SimplexMesh<3> mesh;
  ASSERT_FALSE(SimplexMesh<3>::build(cube(3, 0.3, 2), mesh));
  SurfaceBoundOptions options;
  for (Measure m : { Measure::VolumeLength, Measure::MeanRatio })
  {
    options.measure = m;
    const SurfaceBound<3> bound = surfaceBound(mesh, options);
    // right isosceles triangles: 4 sqrt(3) A / sum l^2 = sqrt(3) / 2
    const double expected = m == Measure::VolumeLength ? std::sqrt(0.75) : std::cbrt(0.75);
    EXPECT_NEAR(bound.bound, expected, 1e-12);
    for (std::size_t s = 0; s < bound.sides.size(); ++s)
    {
      const Corners<3> x = mesh.corners(bound.sides[s].cell);
      const double q = m == Measure::VolumeLength ? VolumeLengthShape<3>::value(x)
                                                  : MeanRatioShape<3>::value(x);
      EXPECT_LE(q, bound.sideCaps[s] * (1.0 + 1e-12));
    }
  }
  options.measure = Measure::MinimumSine;
  EXPECT_EQ(surfaceBound(mesh, options).bound, regularValue<3>(Measure::MinimumSine));
}

TEST(SurfaceBound, PlaneCorner)
{
  // a corner of 20 degrees between edges of length 1 and 0.5: one triangle has it all, or several
  // share it
  const double theta = 20.0 * pi / 180.0;
  MeshInput<2> in;
  in.points = { Vec<2>(0, 0), Vec<2>(1, 0), Vec<2>(0.5 * std::cos(theta), 0.5 * std::sin(theta)) };
  in.cells = { { 0, 1, 2 } };
  SimplexMesh<2> mesh;
  ASSERT_FALSE(SimplexMesh<2>::build(in, mesh));
  const double alone = MeanEdgeShape<2>::value(mesh.corners(0));
  const double corner20 = std::max(alone, angleCap2(0.5 * theta));
  EXPECT_NEAR(surfaceBound(mesh).bound, corner20, 1e-9);
  // the isosceles triangle is the best with its angle
  EXPECT_NEAR(angleCap2(pi / 3.0), 1.0, 1e-15);
  for (double r = 0.5; r < 2.0; r += 0.01)
  {
    EXPECT_LE(MeanEdgeShape<2>::value(
                { Vec<2>(0, 0), Vec<2>(1, 0), Vec<2>(r * std::cos(theta), r * std::sin(theta)) }),
      angleCap2(theta) * (1.0 + 1e-14));
  }
}

namespace
{
/// The vectors of the box are bent, turned and squeezed: no coordinates are round numbers any more.
template <int D>
void bend(MeshInput<D>& in, TestRandom& random, double squeeze)
{
  Eigen::Matrix<double, D, D> map = Eigen::Matrix<double, D, D>::Identity();
  for (int i = 0; i < D; ++i)
  {
    for (int j = 0; j < D; ++j)
    {
      map(i, j) += 0.3 * random();
    }
  }
  map.col(0) *= squeeze;
  for (Vec<D>& x : in.points)
  {
    x = map * x + Vec<D>::Constant(0.1);
  }
}

/// Some facets of the cells, at random, to be kept.
template <int D>
void keepSome(MeshInput<D>& in, TestRandom& random, double share)
{
  for (const Simplex<D>& cell : in.cells)
  {
    for (int i = 0; i <= D; ++i)
    {
      if (random() < 2.0 * share - 1.0)
      {
        Facet<D> f;
        for (int k = 0; k < D; ++k)
        {
          f[k] = cell[Local<D>::facets[i][k]];
        }
        in.keptFacets.push_back(f);
      }
    }
  }
}

template <int D>
double worstShape(const SimplexMesh<D>& mesh)
{
  double q = 1.0;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    q = std::min(q, MeanEdgeShape<D>::value(mesh.corners(c)));
  }
  return q;
}

/// Cells of kept facets at an edge that is listed: the worst of the cells there must not be above.
template <int D>
void expectAboveItself(const SimplexMesh<D>& mesh, const std::string& what)
{
  SurfaceBoundOptions quick;
  quick.enough = quick.listEdgesBelow = 0.6;
  for (const SurfaceBoundOptions& options : { SurfaceBoundOptions(), quick })
  {
    const SurfaceBound<D> bound = surfaceBound(mesh, options);
    EXPECT_GE(bound.bound, 0.0) << what;
    EXPECT_GE(bound.bound * (1.0 + 1e-9) + 1e-13, worstShape(mesh)) << what;
    for (const EdgeBound& edge : bound.edges)
    {
      double there = 1.0;
      for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
      {
        if (mesh.localIndex(c, edge.a) >= 0 && (D == 2 || mesh.localIndex(c, edge.b) >= 0))
        {
          there = std::min(there, MeanEdgeShape<D>::value(mesh.corners(c)));
        }
      }
      EXPECT_GE(edge.cap * (1.0 + 1e-9) + 1e-13, there)
        << what << ", edge " << edge.a << " " << edge.b;
    }
  }
}

template <int D>
void keptInside()
{
  const double shares[] = { 0.0, 0.01, 0.1, 0.3, 1.0 };
  const double squeezes[] = { 1.0, 0.1, 1e-3, 1e-6, 1e-9 };
  for (unsigned seed = 0; seed < 25; ++seed)
  {
    const std::string what = "seed " + std::to_string(seed);
    TestRandom random(seed);
    const double jitter = 0.1 * (seed % 4), squeeze = squeezes[seed / 5 % 5];
    MeshInput<D> in = jitteredGrid<D>(2 + seed % 2, jitter, seed);
    if (seed % 3 == 1)
    {
      splitRegions(in);
    }
    bend(in, random, squeeze);
    keepSome(in, random, shares[seed % 5]);
    if (seed % 7 == 3) // regions at random: edges of many kept facets
    {
      in.regions.clear();
      for (std::size_t c = 0; c < in.cells.size(); ++c)
      {
        in.regions.push_back(random() > 0.8 ? 1 : 0);
      }
    }
    const SimplexMesh<D> mesh = buildMesh(in);
    expectAboveItself(mesh, what);

    // the same facets, but a node that is on none of them goes astray: it may be put back
    for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
    {
      if (!mesh.isBoundary(p))
      {
        in.points[p] += Vec<D>::Constant(1.5 * squeeze * random());
      }
    }
    const SimplexMesh<D> astray = buildMesh(in);
    expectAboveItself(astray, what + " astray");
    EXPECT_GE(surfaceBound(astray).bound * (1.0 + 1e-9) + 1e-13, worstShape(mesh)) << what;

    // any node: inverted and flat cells everywhere
    for (Vec<D>& x : in.points)
    {
      if (random() > 0.6)
      {
        x += Vec<D>::Constant(0.5 * random());
      }
    }
    expectAboveItself(buildMesh(in), what + " tangled");
  }
}
}

TEST(SurfaceBound, FacetsKeptInside) { keptInside<3>(); }

TEST(SurfaceBound, FacetsKeptInsidePlane) { keptInside<2>(); }

TEST(SurfaceBound, BothSidesOfOneFacetAreAllAround)
{
  // whatever the rounding errors of the angle, which is 2 pi and never 0
  TestRandom random(1);
  for (int k = 0; k < 500; ++k)
  {
    Vec<3> points[3];
    for (Vec<3>& p : points)
    {
      p = Vec<3>(random(), random(), random());
    }
    const double cap = facetCap(points[0], points[1], points[2]);
    const auto bound = surfaceBound<3>(
      points, { { { 0, 1, 2 }, 0, 0, true }, { { 1, 0, 2 }, 1, 0, true } });
    EXPECT_GT(bound.bound, 0.9 * cap);
  }
}

TEST(SurfaceBound, DoubtfulSidesAreNoGaps)
{
  // three facets at an edge, at 0, 60 and 240 degrees; only 0 to 60 is filled, and where one of
  // these sides is in doubt nothing may be said
  const auto at = [](double degrees)
  { return Vec<3>(0.5, std::cos(degrees * pi / 180.0), std::sin(degrees * pi / 180.0)); };
  const Vec<3> points[6] = { Vec<3>(0, 0, 0), Vec<3>(1, 0, 0), at(0), at(60), at(62), at(64) };
  std::vector<KeptSide<3>> sides = { { { 0, 1, 2 }, 0, 0, true }, { { 1, 0, 3 }, 0, 0, true },
    { { 0, 1, 4 }, 1, 0, true }, { { 1, 0, 5 }, 1, 0, true } };
  EXPECT_LT(surfaceBound<3>(points, sides).bound, 0.1);
  sides[1].oriented = false;
  EXPECT_GT(surfaceBound<3>(points, sides).bound, 0.5);
  sides[1].oriented = true;
  std::swap(sides[1].nodes[2], sides[2].nodes[2]); // 0 to 62 and 60 to 64 overlap: no mesh in space
  EXPECT_GT(surfaceBound<3>(points, sides).bound, 0.5);
}
