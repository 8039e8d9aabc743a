// SPDX-License-Identifier: BSD-3-Clause
// What fills a cavity: all triangulations are counted. What it meets outside: all cells asked.
#include "Mesh/CavityFit.h"
#include "Mesh/PinchedPoints.h"
#include "TestMeshes.h"

#include <numeric>

using namespace meshopt;

namespace
{
template <class>
class CavityFits : public ::testing::Test
{
};
TYPED_TEST_SUITE(CavityFits, TestDimensions);

/// All cells on the points 0 .. n - 1.
template <int D>
std::vector<Simplex<D>> allCells(int n)
{
  std::vector<Simplex<D>> cells;
  std::vector<char> chosen(n, 0);
  std::fill(chosen.begin(), chosen.begin() + D + 1, 1);
  do
  {
    Simplex<D> c;
    int k = 0;
    for (int p = 0; p < n; ++p)
    {
      if (chosen[p])
      {
        c[k++] = p;
      }
    }
    cells.push_back(c);
  } while (std::prev_permutation(chosen.begin(), chosen.end()));
  return cells;
}

/// How many sets of so many cells on n points fill the whole mesh.
template <int D>
int countFillings(const SimplexMesh<D>& mesh, int n, int size)
{
  const std::vector<Simplex<D>> all = allCells<D>(n);
  std::vector<Index> cavity(mesh.numberOfCellSlots());
  std::iota(cavity.begin(), cavity.end(), 0);
  std::vector<char> chosen(all.size(), 0);
  std::fill(chosen.begin(), chosen.begin() + size, 1);
  int count = 0;
  do
  {
    std::vector<Simplex<D>> cells;
    for (std::size_t k = 0; k < all.size(); ++k)
    {
      if (chosen[k])
      {
        cells.push_back(all[k]);
      }
    }
    count += fillsCavity<D>(mesh, cavity, cells);
  } while (std::prev_permutation(chosen.begin(), chosen.end()));
  return count;
}

/// n points on a circle, joined to the last one.
SimplexMesh<2> polygon(int n)
{
  MeshInput<2> in;
  for (int k = 0; k < n; ++k)
  {
    in.points.emplace_back(std::cos(2 * M_PI * k / n), std::sin(2 * M_PI * k / n));
    in.cells.push_back({ k, (k + 1) % n, n });
  }
  in.points.emplace_back(0.0, 0.0);
  return buildMesh(in);
}

template <int D>
std::set<std::vector<Index>> facesOf(const Simplex<D>& cell)
{
  std::set<std::vector<Index>> faces;
  for (const auto& e : Local<D>::edges)
  {
    faces.insert(sorted({ cell[e[0]], cell[e[1]] }));
  }
  for (int i = 0; i <= D; ++i)
  {
    std::vector<Index> f(cell.begin(), cell.end());
    f.erase(f.begin() + i);
    faces.insert(sorted(f));
  }
  return faces;
}

/// meetsOthers() by sets of all edges and facets.
template <int D>
bool meets(const SimplexMesh<D>& mesh, const std::vector<Index>& cavity,
  const std::vector<Simplex<D>>& cells)
{
  std::set<std::vector<Index>> inside, outside;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    const bool isIn = std::find(cavity.begin(), cavity.end(), c) != cavity.end();
    (isIn ? inside : outside).merge(facesOf<D>(mesh.nodes(c)));
  }
  for (const Simplex<D>& cell : cells)
  {
    for (const std::vector<Index>& f : facesOf<D>(cell))
    {
      if (!inside.count(f) && outside.count(f))
      {
        return true;
      }
    }
  }
  return false;
}

/// Compares for cavities and cells at random; returns how often something was met.
template <int D>
int compareMeets(const SimplexMesh<D>& mesh, int runs)
{
  const std::vector<std::uint8_t> pinched = pinchedPoints<D>(mesh);
  TestRandom random(5);
  const auto any = [&](std::size_t n)
  { return static_cast<std::size_t>(0.4999 * (random() + 1) * n); };
  int met = 0;
  for (int run = 0; run < runs; ++run)
  {
    const Index c = static_cast<Index>(any(mesh.numberOfCellSlots()));
    std::vector<Index> cavity{ c };
    for (int i = 0; i <= D; ++i)
    {
      if (mesh.adjacent(c, i) != None && random() > 0.0)
      {
        cavity.push_back(mesh.cellOf(mesh.adjacent(c, i)));
      }
    }
    std::vector<Index> near; // the points of the cavity, and now and then others
    for (Index k : cavity)
    {
      near.insert(near.end(), mesh.nodes(k).begin(), mesh.nodes(k).end());
    }
    for (int k = 0; k < run % 3; ++k)
    {
      near.push_back(mesh.nodes(static_cast<Index>(any(mesh.numberOfCellSlots())))[0]);
    }
    near = sorted(near);
    near.erase(std::unique(near.begin(), near.end()), near.end());
    std::vector<Simplex<D>> cells;
    for (int k = 0; k < 2; ++k)
    {
      std::vector<Index> points = near;
      Simplex<D> cell;
      for (Index& p : cell)
      {
        const std::size_t at = any(points.size());
        p = points[at];
        points.erase(points.begin() + static_cast<std::ptrdiff_t>(at));
      }
      cells.push_back(cell);
    }
    const bool wanted = meets<D>(mesh, cavity, cells);
    EXPECT_EQ(meetsOthers<D>(mesh, cavity, cells, pinched), wanted) << run;
    met += wanted;
  }
  return met;
}
}

// A polygon of n corners has Catalan(n - 2) triangulations.
TEST(CavityFit2D, FillingsOfAPolygonAreItsTriangulations)
{
  EXPECT_EQ(countFillings<2>(polygon(4), 4, 2), 2);
  EXPECT_EQ(countFillings<2>(polygon(5), 5, 3), 5);
  EXPECT_EQ(countFillings<2>(polygon(6), 6, 4), 14);
}

// With the centre there are n cells. It is joined to d >= 3 of the corners, whichever they are;
// what they cut off are polygons, each with its own triangulations.
TEST(CavityFit2D, FillingsOfAPolygonWithAPointInside)
{
  // d = 4, and 4 times d = 3. Then d = 5, 5 times d = 4, and 10 times d = 3: 5 of these cut off a
  // square, which has two diagonals, and 5 two triangles.
  EXPECT_EQ(countFillings<2>(polygon(4), 5, 4), 1 + 4);
  EXPECT_EQ(countFillings<2>(polygon(5), 6, 5), 1 + 5 + 5 * 2 + 5);
}

// An octahedron has three diagonals, each with four cells around it.
TEST(CavityFit3D, FillingsOfAnOctahedronAreItsDiagonals)
{
  MeshInput<3> in = ringOf(4);
  EXPECT_EQ(countFillings<3>(buildMesh(in), 6, 4), 3);
}

TEST(CavityFit3D, TwoToThreeAndBack)
{
  const std::vector<Simplex<3>> two{ { 2, 3, 4, 1 }, { 2, 4, 3, 0 } };
  const SimplexMesh<3> mesh = buildMesh(ringOf(3));
  const std::vector<Index> all{ 0, 1, 2 };
  EXPECT_TRUE(fillsCavity<3>(mesh, all, two));
  EXPECT_FALSE(fillsCavity<3>(mesh, all, { two[0] }));
  EXPECT_FALSE(fillsCavity<3>(mesh, { 0, 1 }, two));
  EXPECT_FALSE(fillsCavity<3>(mesh, all, { two[0], two[0] }));
  EXPECT_FALSE(fillsCavity<3>(mesh, all, { two[0], two[1], two[1] }));
}

/// The cells themselves fit, a new node fits in the star of a node, one cell less does not.
TYPED_TEST(CavityFits, StarsOfNodes)
{
  constexpr int D = TypeParam::dimension;
  const SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(3, 0.2));
  const Index come = mesh.numberOfPointSlots();
  std::vector<Index> star;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    mesh.star(p, star);
    std::vector<Simplex<D>> same, other;
    for (Index c : star)
    {
      same.push_back(mesh.nodes(c));
      other.push_back(mesh.nodes(c));
      std::replace(other.back().begin(), other.back().end(), p, come);
    }
    EXPECT_TRUE(fillsCavity<D>(mesh, star, same));
    EXPECT_EQ(fillsCavity<D>(mesh, star, other), mesh.isFree(p)); // at the surface p must stay
    same.pop_back();
    EXPECT_FALSE(fillsCavity<D>(mesh, star, same));
  }
}

TEST(CavityFit2D, AChangeOfTheSurfaceMustBeSaid)
{
  MeshInput<2> in = oneCell<2>();
  const SimplexMesh<2> mesh = buildMesh(in);
  const std::vector<Simplex<2>> cells{ { 0, 3, 2 }, { 3, 1, 2 } }; // the edge (0, 1) is divided
  EXPECT_FALSE(fillsCavity<2>(mesh, { 0 }, cells));
  KeptChange<2> change;
  change.gone = { { 1, 0 } };
  EXPECT_FALSE(fillsCavity<2>(mesh, { 0 }, cells, &change));
  change.come = { { 0, 3 } };
  EXPECT_FALSE(fillsCavity<2>(mesh, { 0 }, cells, &change));
  change.come.push_back({ 1, 3 });
  EXPECT_TRUE(fillsCavity<2>(mesh, { 0 }, cells, &change));
}

TYPED_TEST(CavityFits, MeetsWhatASearchOfAllCellsFinds)
{
  constexpr int D = TypeParam::dimension;
  const int met = compareMeets<D>(buildMesh(jitteredGrid<D>(D == 2 ? 4 : 3, 0.2)), 600);
  EXPECT_GT(met, 50);
  EXPECT_LT(met, 550);
}

/// At pinched points a star is not all of the cells there.
TYPED_TEST(CavityFits, MeetsWhatIsBeyondPinchedPoints)
{
  constexpr int D = TypeParam::dimension;
  TestRandom random(3);
  MeshInput<D> in = jitteredGrid<D>(D == 2 ? 5 : 3, 0.2);
  in.cells.erase(std::remove_if(in.cells.begin(), in.cells.end(),
                   [&](const Simplex<D>&) { return random() > 0.3; }),
    in.cells.end());
  const SimplexMesh<D> mesh = buildMesh(in);
  EXPECT_FALSE(pinchedPoints<D>(mesh).empty());
  EXPECT_GT(compareMeets<D>(mesh, 600), 50);
}

TEST(CavityFit3D, KeptEdgesMustBeThereOrGo)
{
  const std::vector<Simplex<3>> two{ { 2, 3, 4, 1 }, { 2, 4, 3, 0 } };
  const std::vector<Index> all{ 0, 1, 2 };
  MeshInput<3> in = ringOf(3);
  EXPECT_TRUE(keepsEdges<3>(buildMesh(in), all, two)); // none is kept
  in.keptEdges = { { 2, 3 } };
  EXPECT_TRUE(keepsEdges<3>(buildMesh(in), all, two));
  in.keptEdges = { { 1, 0 } };
  const SimplexMesh<3> mesh = buildMesh(in);
  EXPECT_FALSE(keepsEdges<3>(mesh, all, two));
  EXPECT_TRUE(keepsEdges<3>(mesh, all, { mesh.nodes(1) }));
  KeptChange<3> change;
  change.goneEdges = { { 2, 3 } };
  EXPECT_FALSE(keepsEdges<3>(mesh, all, two, &change));
  for (const std::array<Index, 2>& edge : { std::array<Index, 2>{ 0, 1 }, { 1, 0 } })
  {
    change.goneEdges = { edge };
    EXPECT_TRUE(keepsEdges<3>(mesh, all, two, &change));
  }
}
