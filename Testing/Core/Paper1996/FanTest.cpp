// SPDX-License-Identifier: BSD-3-Clause
// Fans: a cluster filled from an apex, on polygons and an octahedron whose fans are known.
#include "Paper1996/Fan.h"
#include "TestMeshes.h"

#include <numeric>

using namespace meshopt;

namespace
{
/// A cluster as gatherFanCluster() would give it; point k has the id 10 + 2 k.
template <int D>
FanCluster<D> clusterOf(std::vector<Vec<D>> x, std::vector<Facet<D>> facets)
{
  FanCluster<D> cluster;
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    cluster.points.push_back(static_cast<Index>(10 + 2 * k));
  }
  cluster.x = std::move(x);
  cluster.facets = std::move(facets);
  return cluster;
}

/// A regular polygon of n points.
FanCluster<2> polygon(int n)
{
  std::vector<Vec<2>> x;
  std::vector<Facet<2>> facets;
  for (int k = 0; k < n; ++k)
  {
    x.emplace_back(std::cos(2.0 * M_PI * k / n), std::sin(2.0 * M_PI * k / n));
    facets.push_back({ k, (k + 1) % n });
  }
  return clusterOf<2>(x, facets);
}

/// The faces of a regular octahedron with the points +-e_k.
FanCluster<3> octahedron()
{
  const std::vector<Vec<3>> x{ { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 },
    { 0, 0, -1 } };
  std::vector<Facet<3>> facets;
  for (Index a : { 0, 1 })
  {
    for (Index b : { 2, 3 })
    {
      for (Index c : { 4, 5 })
      {
        Facet<3> f{ a, b, c };
        if (signedVolume(Corners<3>{ x[a], x[b], x[c], Vec<3>::Zero() }) < 0.0)
        {
          std::swap(f[1], f[2]);
        }
        facets.push_back(f);
      }
    }
  }
  return clusterOf<3>(x, facets);
}

/// A square with a dent at point 3, from where all of it is seen.
FanCluster<2> dented()
{
  return clusterOf<2>({ { 0, 0 }, { 2, 0 }, { 2, 2 }, { 0.5, 0.5 }, { 0, 2 } },
    { { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 4 }, { 4, 0 } });
}

template <int D>
double volumeOf(const Simplex<D>&, const Corners<D>& x)
{
  return signedVolume(x);
}

/// Fills, with the signed volumes as qualities; the cells must be those of the fan.
template <int D>
bool fill(const FanCluster<D>& cluster, const Apex<D>& apex, Proposal<D>& p)
{
  const bool done = fillFromApex<D>(cluster, apex, volumeOf<D>, p);
  for (const Simplex<D>& cell : p.cells)
  {
    EXPECT_EQ(cell[D], apex.id);
  }
  if (done)
  {
    EXPECT_EQ(p.newWorst, *std::min_element(p.qualities.begin(), p.qualities.end()));
    EXPECT_EQ(p.cells.size(), p.qualities.size());
  }
  return done;
}

template <int D>
Apex<D> at(const FanCluster<D>& cluster, int k)
{
  return { k, cluster.points[k], cluster.x[k] };
}

double sum(const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); }
}

TEST(Fan, CentreIsTheMeanOfThePoints)
{
  EXPECT_LT(clusterCentre<2>(polygon(7)).norm(), 1e-15);
  EXPECT_EQ(clusterCentre<3>(octahedron()), Vec<3>::Zero());
  EXPECT_LT((clusterCentre<2>(dented()) - Vec<2>(0.9, 0.9)).norm(), 1e-15);
}

TEST(Fan, FromACornerOfAPolygonTwoCellsLess)
{
  for (int n = 3; n <= 9; ++n)
  {
    const FanCluster<2> cluster = polygon(n);
    const double area = 0.5 * n * std::sin(2.0 * M_PI / n);
    for (int k = 0; k < n; ++k)
    {
      Proposal<2> p;
      ASSERT_TRUE(fill<2>(cluster, at(cluster, k), p));
      EXPECT_EQ(p.cells.size(), std::size_t(n - 2));
      EXPECT_NEAR(sum(p.qualities), area, 1e-14);
      // Each facet that does not have the apex is there once, as it was.
      std::set<std::pair<Index, Index>> bases;
      for (const Simplex<2>& c : p.cells)
      {
        bases.insert({ c[0], c[1] });
      }
      for (int f = 0; f < n; ++f)
      {
        const bool has = f == k || (f + 1) % n == k;
        EXPECT_EQ(bases.count({ 10 + 2 * f, 10 + 2 * ((f + 1) % n) }), has ? 0u : 1u);
        EXPECT_EQ(cluster.contains(f, k), has);
      }
    }
  }
}

TEST(Fan, FromElsewhereACellForEveryFacet)
{
  const FanCluster<2> flat = polygon(6);
  Proposal<2> p;
  ASSERT_TRUE(fill<2>(flat, { -1, 99, Vec<2>(0.1, 0.2) }, p));
  EXPECT_EQ(p.cells.size(), 6u);
  EXPECT_NEAR(sum(p.qualities), 1.5 * std::sqrt(3.0), 1e-14);

  const FanCluster<3> solid = octahedron();
  Proposal<3> q;
  ASSERT_TRUE(fill<3>(solid, { -1, 99, Vec<3>(0.1, 0.2, -0.1) }, q));
  EXPECT_EQ(q.cells.size(), 8u);
  EXPECT_NEAR(sum(q.qualities), 4.0 / 3.0, 1e-14);
}

TEST(Fan, FromAPointOfAnOctahedronItsFarHalf)
{
  const FanCluster<3> cluster = octahedron();
  for (int k = 0; k < 6; ++k)
  {
    Proposal<3> p;
    ASSERT_TRUE(fill<3>(cluster, at(cluster, k), p));
    ASSERT_EQ(p.cells.size(), 4u);
    for (double q : p.qualities)
    {
      EXPECT_NEAR(q, 1.0 / 3.0, 1e-15);
    }
  }
}

TEST(Fan, AllCellsMustBeAboveTheLeast)
{
  const FanCluster<2> cluster = polygon(4); // from a corner: two cells of area 1
  Proposal<2> p;
  p.least = 0.999;
  EXPECT_TRUE(fill<2>(cluster, at(cluster, 0), p));
  p.least = 1.001;
  EXPECT_FALSE(fill<2>(cluster, at(cluster, 0), p));
  // "above" and not "at least": the areas here are exactly 1/2
  const FanCluster<2> square = clusterOf<2>(
    { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } }, { { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 0 } });
  p.least = 0.5;
  EXPECT_FALSE(fill<2>(square, at(square, 0), p));
  p.least = std::nextafter(0.5, 0.0);
  EXPECT_TRUE(fill<2>(square, at(square, 0), p));
}

TEST(Fan, NoMoreInvertedCellsThanThereWere)
{
  FanCluster<2> cluster = dented();
  for (int k = 0; k < 5; ++k)
  {
    // Brute force: facets that the corner sees from behind, or edge on.
    int count = 0;
    for (int f = 0; f < 5; ++f)
    {
      const Facet<2> facet = cluster.facets[f];
      count += !cluster.contains(f, k) &&
        signedVolume(Corners<2>{ cluster.x[facet[0]], cluster.x[facet[1]], cluster.x[k] }) <= 0.0;
    }
    for (int allowed = 0; allowed <= 3; ++allowed)
    {
      cluster.inverted = allowed;
      Proposal<2> p;
      EXPECT_EQ(fill<2>(cluster, at(cluster, k), p), count <= allowed) << k << " " << allowed;
    }
  }
  cluster.inverted = 0;
  Proposal<2> p;
  EXPECT_TRUE(fill<2>(cluster, at(cluster, 3), p)); // the dent sees all corners
  EXPECT_FALSE(fill<2>(cluster, at(cluster, 1), p));
}

TEST(Fan, NothingComesFromAFanWithoutCells)
{
  // Both facets have the apex.
  const FanCluster<2> cluster = clusterOf<2>(
    { { 0, 0 }, { 1, 0 }, { 1, 1 } }, { { 0, 1 }, { 1, 2 } });
  Proposal<2> p;
  p.cells.push_back({ 7, 8, 9 }); // what is left of an earlier try is gone
  EXPECT_FALSE(fillFromApex<2>(cluster, at(cluster, 1), volumeOf<2>, p));
  EXPECT_TRUE(p.cells.empty());
  EXPECT_TRUE(fillFromApex<2>(cluster, at(cluster, 0), volumeOf<2>, p));
}
