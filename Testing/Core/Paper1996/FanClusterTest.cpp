// SPDX-License-Identifier: BSD-3-Clause
// Nodal and edge clusters against a flood over the list of cells, which knows nothing of adjacency.
#include "Paper1996/FanCluster.h"
#include "Run/Summary.h"
#include "TestMeshes.h"

#include <map>

using namespace meshopt;

namespace
{
template <class>
class FanClusters : public ::testing::Test
{
};
TYPED_TEST_SUITE(FanClusters, TestDimensions);

using Face = std::vector<Index>;

template <class List>
bool hasAll(const List& points, const Face& core)
{
  return std::all_of(core.begin(), core.end(),
    [&](Index p) { return std::find(points.begin(), points.end(), p) != points.end(); });
}

/// The cells at each facet, and which facets are kept, from the input alone.
template <int D>
struct Facets
{
  std::map<Face, std::vector<Index>> cells;
  std::set<Face> kept;

  explicit Facets(const MeshInput<D>& in)
  {
    for (std::size_t c = 0; c < in.cells.size(); ++c)
    {
      for (int i = 0; i <= D; ++i)
      {
        Face f(in.cells[c].begin(), in.cells[c].end());
        f.erase(f.begin() + i);
        this->cells[sorted(f)].push_back(static_cast<Index>(c));
      }
    }
    for (const auto& [f, sides] : this->cells)
    {
      if (sides.size() == 1 ||
        (!in.regions.empty() && in.regions[sides[0]] != in.regions[sides[1]]))
      {
        this->kept.insert(f);
      }
    }
    for (const Facet<D>& f : in.keptFacets)
    {
      this->kept.insert(sorted(Face(f.begin(), f.end())));
    }
  }
};

enum class Outcome
{
  Given,
  NotItsWorst,
  AcrossKept
};

template <int D>
struct Expected
{
  std::set<Index> cells;
  std::set<Face> facets;
  Outcome outcome = Outcome::Given;
};

template <int D>
Expected<D> expected(
  const SimplexMesh<D>& mesh, const Facets<D>& facets, Index cell, const Face& core)
{
  Expected<D> result;
  result.cells = { cell };
  for (bool grows = true; grows;)
  {
    grows = false;
    for (const auto& [f, sides] : facets.cells)
    {
      if (sides.size() == 2 && hasAll(f, core) && !facets.kept.count(f) &&
        result.cells.count(sides[0]) != result.cells.count(sides[1]))
      {
        result.cells.insert(sides.begin(), sides.end());
        grows = true;
      }
    }
  }
  for (Index c : result.cells)
  {
    if (std::make_pair(mesh.quality(c), c) < std::make_pair(mesh.quality(cell), cell))
    {
      result.outcome = Outcome::NotItsWorst;
      return result;
    }
  }
  for (const auto& [f, sides] : facets.cells)
  {
    std::size_t inside = 0;
    for (Index c : sides)
    {
      inside += result.cells.count(c);
    }
    if (inside == 2 && facets.kept.count(f))
    {
      result.outcome = Outcome::AcrossKept;
    }
    if (inside == 1)
    {
      result.facets.insert(f);
    }
  }
  return result;
}

template <int D>
void expectFacets(
  const SimplexMesh<D>& mesh, const FanCluster<D>& cluster, const std::set<Face>& facets)
{
  std::set<Face> found;
  std::set<Index> points;
  for (const Facet<D>& local : cluster.facets)
  {
    Face f;
    for (Index p : local)
    {
      f.push_back(cluster.points[p]);
    }
    points.insert(f.begin(), f.end());
    EXPECT_TRUE(found.insert(sorted(f)).second) << "a facet is there twice";
    // Its cell of the cluster is on the positive side.
    for (Index c : cluster.cells)
    {
      if (hasAll(mesh.nodes(c), f))
      {
        Corners<D> x;
        for (int k = 0; k < D; ++k)
        {
          x[k] = mesh.point(f[k]);
        }
        for (Index p : mesh.nodes(c))
        {
          x[D] = std::find(f.begin(), f.end(), p) == f.end() ? mesh.point(p) : x[D];
        }
        EXPECT_GT(signedVolume(x), 0.0);
      }
    }
  }
  EXPECT_EQ(found, facets);
  EXPECT_EQ(cluster.points, std::vector<Index>(points.begin(), points.end()));
  for (std::size_t k = 0; k < cluster.points.size(); ++k)
  {
    EXPECT_EQ(cluster.x[k], mesh.point(cluster.points[k]));
  }
}

/// Compares the clusters around all nodes and edges of all cells; counts how often what happened.
template <int D>
std::map<Outcome, int> compareAll(const MeshInput<D>& in)
{
  SimplexMesh<D> mesh = buildMesh(in);
  MeshEditor<D> editor(mesh);
  NodalMetric<D> metric;
  computeQualities<D>(editor, metric, Measure::Shape, 0.0);
  const Facets<D> facets(in);
  std::map<Outcome, int> count;
  FanCluster<D> cluster;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    const Simplex<D> nodes = mesh.nodes(c);
    std::vector<Face> cores;
    for (Index p : nodes)
    {
      cores.push_back({ p });
    }
    for (const auto& e : Local<D>::edges)
    {
      cores.push_back({ nodes[e[0]], nodes[e[1]] });
    }
    for (const Face& core : cores)
    {
      const Expected<D> wanted = expected<D>(mesh, facets, c, core);
      ++count[wanted.outcome];
      const int n = static_cast<int>(core.size());
      const bool given = gatherFanCluster<D>(editor, c, core.data(), n, cluster);
      EXPECT_EQ(given, wanted.outcome == Outcome::Given) << "cell " << c;
      if (!given || wanted.outcome != Outcome::Given)
      {
        continue;
      }
      EXPECT_EQ(std::set<Index>(cluster.cells.begin(), cluster.cells.end()), wanted.cells);
      EXPECT_EQ(cluster.cells.size(), wanted.cells.size());
      expectFacets<D>(mesh, cluster, wanted.facets);
      EXPECT_EQ(cluster.worst, mesh.quality(c));
      EXPECT_EQ(cluster.inverted, 0);
      const bool touches = std::any_of(
        wanted.facets.begin(), wanted.facets.end(), [&](const Face& f) { return hasAll(f, core); });
      EXPECT_EQ(cluster.closed, !touches);
      const std::vector<Index>& points = cluster.points;
      EXPECT_EQ(cluster.coreInside,
        n == 1 && std::find(points.begin(), points.end(), core[0]) == points.end());
      for (Index k = 0; k < mesh.numberOfCellSlots(); ++k)
      {
        EXPECT_EQ(editor.isMarked(k, editor.lastMark()), wanted.cells.count(k) == 1);
      }
    }
  }
  return count;
}

template <int D>
MeshInput<D> grid()
{
  return jitteredGrid<D>(D == 2 ? 5 : 3, 0.2, 3);
}
}

TYPED_TEST(FanClusters, EqualAFloodOverCommonFacets)
{
  constexpr int D = TypeParam::dimension;
  std::map<Outcome, int> count = compareAll<D>(grid<D>());
  EXPECT_GT(count[Outcome::Given], 20);
  EXPECT_GT(count[Outcome::NotItsWorst], 20);
  EXPECT_EQ(count[Outcome::AcrossKept], 0);
}

TYPED_TEST(FanClusters, EndAtInterfacesBetweenRegions)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = grid<D>();
  splitRegions(in);
  std::map<Outcome, int> count = compareAll<D>(in);
  EXPECT_GT(count[Outcome::Given], 20);
}

// At the rim of a kept facet that ends inside, cells are connected around it.
TYPED_TEST(FanClusters, OnBothSidesOfAKeptFacetAreNotGiven)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = grid<D>();
  int across = 0;
  for (const Simplex<D>& cell : { in.cells[in.cells.size() / 2], in.cells[in.cells.size() / 3] })
  {
    for (const auto& local : Local<D>::facets)
    {
      Facet<D> f;
      std::transform(std::begin(local), std::end(local), f.begin(), [&](int k) { return cell[k]; });
      in.keptFacets = { f };
      across += compareAll<D>(in)[Outcome::AcrossKept];
    }
  }
  EXPECT_GT(across, 3);
}

TEST(FanCluster, CountsInvertedCells)
{
  MeshInput<2> in;
  in.points = { { 0, -2 }, { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } }; // node 0 is outside
  in.cells = { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 4 }, { 0, 4, 1 } };
  SimplexMesh<2> mesh;
  ASSERT_FALSE(SimplexMesh<2>::build(in, mesh));
  MeshEditor<2> editor(mesh);
  NodalMetric<2> metric;
  computeQualities<2>(editor, metric, Measure::Shape, 0.0);
  const Index core = 0;
  FanCluster<2> cluster;
  int given = 0;
  for (Index c = 0; c < 4; ++c)
  {
    if (gatherFanCluster<2>(editor, c, &core, 1, cluster))
    {
      ++given;
      EXPECT_EQ(c, 0); // the only one of negative area
      EXPECT_EQ(cluster.inverted, 1);
      EXPECT_LT(cluster.worst, 0.0);
      EXPECT_TRUE(cluster.coreInside);
    }
  }
  EXPECT_EQ(given, 1);
}
