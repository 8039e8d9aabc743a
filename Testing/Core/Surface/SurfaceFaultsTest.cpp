// SPDX-License-Identifier: BSD-3-Clause
// Faults of kept surfaces: made one by one, found with the right facets, and not where there are
// none.
#include "Surface/SurfaceFaults.h"

#include "Mesh/Ids.h"
#include "TestMeshes.h"

#include <random>

namespace meshopt
{
namespace
{
template <int D>
std::vector<SurfaceFault<D>> faults(const SimplexMesh<D>& mesh)
{
  std::vector<Index> all;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    all.push_back(c);
  }
  return findSurfaceFaults(mesh, all);
}

template <int D>
long count(const std::vector<SurfaceFault<D>>& list, typename SurfaceFault<D>::Kind kind)
{
  return std::count_if(list.begin(), list.end(), [=](const auto& f) { return f.kind == kind; });
}

/// Moves the points where `which` holds.
template <int D, class Which>
MeshInput<D> moved(MeshInput<D> in, Which which, const Vec<D>& by)
{
  for (Vec<D>& x : in.points)
  {
    x += which(x) ? by : Vec<D>::Zero();
  }
  return in;
}

bool near(double a, double b) { return std::fabs(a - b) < 1e-9; }

TEST(SurfaceFaults, NoneInSoundOrTangledMeshes)
{
  // Nodes inside may be anywhere: the surface is not at fault.
  for (double jitter : { 0.0, 0.3, 1.5 })
  {
    EXPECT_TRUE(faults(buildMesh(jitteredGrid<2>(5, jitter))).empty());
    EXPECT_TRUE(faults(buildMesh(jitteredGrid<3>(4, jitter))).empty());
  }
}

TEST(SurfaceFaults, NoArea)
{
  MeshInput<3> in;
  in.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 3, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  in.cells = { { 0, 1, 2, 4 }, { 0, 2, 3, 4 } }; // 0 1 2 is a line
  const auto found = faults(buildMesh(in));
  ASSERT_EQ(count(found, SurfaceFault<3>::NoArea), 1);
  EXPECT_EQ(found[0].facets[0], (Facet<3>{ 0, 1, 2 }));

  MeshInput<2> flat;
  flat.points = { { 0, 0 }, { 0, 0 }, { 1, 0 }, { 0, 1 } };
  flat.cells = { { 0, 1, 2 }, { 1, 2, 3 } };
  EXPECT_EQ(count(faults(buildMesh(flat)), SurfaceFault<2>::NoArea), 1);
}

/// A node of the flat upper side is moved along it past the next one.
TEST(SurfaceFaults, FoldedSideOfABox)
{
  const auto in = moved(
    jitteredGrid<3>(4, 0.0),
    [](const Vec<3>& x) { return near(x[0], 0.5) && near(x[1], 0.5) && near(x[2], 1.0); },
    Vec<3>(0.3, 0.02, 0.0));
  const SimplexMesh<3> mesh = buildMesh(in);
  const auto found = faults(mesh);
  EXPECT_GE(count(found, SurfaceFault<3>::Folded), 2);
  for (const auto& fault : found)
  {
    for (Index p : fault.facets[0])
    {
      EXPECT_TRUE(mesh.isBoundary(p));
      EXPECT_EQ(mesh.point(p)[2], 1.0);
    }
  }

  const auto plane = moved(
    jitteredGrid<2>(4, 0.0), [](const Vec<2>& x) { return near(x[0], 0.5) && near(x[1], 1.0); },
    Vec<2>(0.3, 0.0));
  // There and back again: at the node itself, and at the one that it has passed.
  EXPECT_EQ(count(faults(buildMesh(plane)), SurfaceFault<2>::Folded), 2);
}

/// A node of the upper side is pushed out through the lower one.
TEST(SurfaceFaults, CrossingSides)
{
  const auto in = moved(
    jitteredGrid<3>(2, 0.0),
    [](const Vec<3>& x) { return near(x[0], 0.5) && near(x[1], 0.5) && near(x[2], 1.0); },
    Vec<3>(0.07, 0.04, -1.2));
  const SimplexMesh<3> mesh = buildMesh(in);
  const auto found = faults(mesh);
  EXPECT_GE(count(found, SurfaceFault<3>::Crossing), 3);
  EXPECT_EQ(count(found, SurfaceFault<3>::Folded), 0);
  for (const auto& fault : found)
  {
    const double a = mesh.point(fault.facets[0][0])[2] + mesh.point(fault.facets[0][1])[2] +
      mesh.point(fault.facets[0][2])[2];
    const double b = mesh.point(fault.facets[1][0])[2] + mesh.point(fault.facets[1][1])[2] +
      mesh.point(fault.facets[1][2])[2];
    EXPECT_NE(a > 0.5, b > 0.5); // one of the upper side, one of the lower
  }

  const auto plane = moved(
    jitteredGrid<2>(2, 0.0), [](const Vec<2>& x) { return near(x[0], 0.5) && near(x[1], 1.0); },
    Vec<2>(0.07, -1.2));
  EXPECT_EQ(count(faults(buildMesh(plane)), SurfaceFault<2>::Crossing), 2);
}

/// Six times the signed volume, in whole numbers: without rounding.
long volume(const MeshInput<3>& in, Index a, Index b, Index c, Index d)
{
  const auto x = [&](Index p, int i)
  { return std::lround(in.points[p][i]) - std::lround(in.points[a][i]); };
  return x(b, 0) * (x(c, 1) * x(d, 2) - x(c, 2) * x(d, 1)) +
    x(b, 1) * (x(c, 2) * x(d, 0) - x(c, 0) * x(d, 2)) +
    x(b, 2) * (x(c, 0) * x(d, 1) - x(c, 1) * x(d, 0));
}

/// An edge of f without a node of g has its ends on both sides of g, and meets g, but no node of
/// it.
bool passesThrough(const MeshInput<3>& in, const Facet<3>& f, const Facet<3>& g)
{
  for (int i = 0; i < 3; ++i)
  {
    const Index p = f[i], q = f[(i + 1) % 3];
    const long u = volume(in, p, q, g[0], g[1]), v = volume(in, p, q, g[1], g[2]),
               w = volume(in, p, q, g[2], g[0]);
    const bool isShared = hasId(g, p) || hasId(g, q);
    const bool isBetween = volume(in, g[0], g[1], g[2], p) * volume(in, g[0], g[1], g[2], q) < 0;
    const bool isInside = (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
    if (!isShared && isBetween && isInside && (u == 0) + (v == 0) + (w == 0) < 2)
    {
      return true;
    }
  }
  return false;
}

/// Two tetrahedra with corners on a coarse lattice, apart or with one common node: planes, edges
/// and nodes meet in all ways.
TEST(SurfaceFaults, CrossingsAreThoseOfTheDefinition)
{
  std::mt19937 random(5);
  long crossings = 0, none = 0;
  for (int k = 0; k < 3000; ++k)
  {
    MeshInput<3> in;
    for (int p = 0; p < 8; ++p)
    {
      in.points.emplace_back(random() % 4, random() % 4, random() % 4);
    }
    in.cells = { { 0, 1, 2, 3 }, { k % 2 ? 3 : 4, 5, 6, 7 } };
    bool isFlat = false;
    for (Simplex<3>& c : in.cells)
    {
      const long v = volume(in, c[0], c[1], c[2], c[3]);
      isFlat = isFlat || v == 0;
      std::swap(c[0], c[v > 0 ? 0 : 1]);
    }
    if (isFlat)
    {
      continue;
    }
    const SimplexMesh<3> mesh = buildMesh(in);
    std::vector<std::array<Facet<3>, 2>> expected, found;
    for (int i = 0; i < 4; ++i)
    {
      for (int j = 0; j < 4; ++j)
      {
        const Facet<3> f = sortedIds(mesh.facet(0, i)), g = sortedIds(mesh.facet(1, j));
        if (passesThrough(in, f, g) || passesThrough(in, g, f))
        {
          expected.push_back({ std::min(f, g), std::max(f, g) });
        }
      }
    }
    for (const auto& fault : faults(mesh))
    {
      if (fault.kind == SurfaceFault<3>::Crossing)
      {
        found.push_back({ std::min(fault.facets[0], fault.facets[1]),
          std::max(fault.facets[0], fault.facets[1]) });
      }
    }
    std::sort(expected.begin(), expected.end());
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected) << "pair " << k;
    (expected.empty() ? none : crossings) += 1;
  }
  EXPECT_GT(crossings, 300);
  EXPECT_GT(none, 300);
}

/// A closed crack: two sides at one place, the mesh all around its end. No fault.
TEST(SurfaceFaults, ClosedCrackIsNone)
{
  const auto crack = [](auto in)
  {
    constexpr int D = std::tuple_size<typename decltype(in.cells)::value_type>::value - 1;
    const std::size_t n = in.points.size();
    std::vector<Index> twin(n, None);
    for (std::size_t p = 0; p < n; ++p)
    {
      const auto x = in.points[p];
      if (near(x[D - 1], 0.5) && x[0] < 0.4)
      {
        twin[p] = static_cast<Index>(in.points.size());
        in.points.push_back(x);
      }
    }
    for (auto& cell : in.cells)
    {
      double height = 0.0;
      for (Index p : cell)
      {
        height += in.points[p][D - 1] / (D + 1);
      }
      for (Index& p : cell)
      {
        p = height > 0.5 && twin[p] != None ? twin[p] : p;
      }
    }
    return in;
  };
  // Of the 5 points along x those at 0 and 1/4 are there twice: at 1/2 the crack ends.
  const SimplexMesh<2> plane = buildMesh(crack(jitteredGrid<2>(4, 0.0)));
  EXPECT_EQ(plane.countPoints(), 5 * 5 + 2);
  EXPECT_TRUE(faults(plane).empty());
  const SimplexMesh<3> space = buildMesh(crack(jitteredGrid<3>(4, 0.0)));
  EXPECT_EQ(space.countPoints(), 5 * 5 * 5 + 2 * 5);
  EXPECT_TRUE(faults(space).empty());
}

/// Only what is near the given cells is looked at.
TEST(SurfaceFaults, OnlyNearTheCells)
{
  const auto in = moved(
    jitteredGrid<2>(20, 0.0), [](const Vec<2>& x) { return near(x[0], 0.5) && near(x[1], 1.0); },
    Vec<2>(0.07, 0.0));
  const SimplexMesh<2> mesh = buildMesh(in);
  EXPECT_EQ(faults(mesh).size(), 2u);
  Index close = None;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    close = signedVolume(mesh.corners(c)) < 0.0 ? c : close;
  }
  ASSERT_NE(close, None);
  EXPECT_EQ(findSurfaceFaults(mesh, { close }).size(), 2u);
  EXPECT_TRUE(findSurfaceFaults(mesh, { 0 }).empty());
  EXPECT_TRUE(findSurfaceFaults(mesh, {}).empty());
}
}
}
