// SPDX-License-Identifier: BSD-3-Clause
// Removal of an edge: the best of all refillings, and what must stay.
#include "Operations/EdgeRemoval.h"
#include "TestMeshes.h"

using namespace meshopt;

namespace
{
constexpr double Never = -std::numeric_limits<double>::infinity();

/// n tetrahedra around the edge (0, 1), with points displaced at random.
MeshInput<3> ringOf(int n, double height, double jitter, unsigned seed)
{
  TestRandom random(seed);
  MeshInput<3> in;
  in.points = { { 0, 0, -height }, { 0, 0, height } };
  for (int k = 0; k < n; ++k)
  {
    const double a = 2.0 * M_PI * (k + 0.2 * jitter * random()) / n;
    const double r = 1.0 + 0.5 * jitter * random();
    in.points.emplace_back(r * std::cos(a), r * std::sin(a), jitter * height * random());
    in.cells.push_back({ 0, 1, 2 + k, 2 + (k + 1) % n });
  }
  return in;
}

/// The best worst quality over all triangulations of the ring points first ... last, by trying all.
template <class Model>
void triangulations(int first, int last, const Model& model, std::vector<double>& worst)
{
  worst.clear();
  if (last - first < 2)
  {
    worst.push_back(std::numeric_limits<double>::infinity());
    return;
  }
  for (int k = first + 1; k < last; ++k)
  {
    std::vector<double> left, right;
    triangulations(first, k, model, left);
    triangulations(k, last, model, right);
    const Index i = 2 + first, m = 2 + k, j = 2 + last;
    const double here = std::min(model({ i, m, j, 1 }), model({ m, i, j, 0 }));
    for (double l : left)
    {
      for (double r : right)
      {
        worst.push_back(std::min({ l, r, here }));
      }
    }
  }
}

template <class Shape>
void equalsBruteForce()
{
  const long catalan[] = { 1, 2, 5, 14, 42, 132 };
  int positive = 0, negative = 0;
  for (int n = 3; n <= 8; ++n)
  {
    for (unsigned seed = 1; seed <= 12; ++seed)
    {
      SimplexMesh<3> mesh = buildMesh(ringOf(n, 0.4 + 0.1 * (seed % 6), 0.6, 100 * n + seed));
      MeshEditor<3> editor(mesh);
      NodalMetric<3> metric;
      const QualityModel<3, Shape> model(mesh, metric, 0.0);
      for (Index c = 0; c < n; ++c)
      {
        editor.setQuality(c, -10.0); // so that even inverted refillings are wanted
      }
      std::vector<double> all;
      triangulations(0, n - 1, model, all);
      ASSERT_EQ(long(all.size()), catalan[n - 3]);
      const double best = *std::max_element(all.begin(), all.end());

      EdgeRemoval<3, Shape> removal;
      const Index t = Index(seed) % n; // from any cell of the ring
      int edge = 0;
      for (int e = 0; e < 6; ++e)
      {
        const Index a = mesh.nodes(t)[Local<3>::edges[e][0]];
        const Index b = mesh.nodes(t)[Local<3>::edges[e][1]];
        edge = a + b == 1 ? e : edge;
      }
      EXPECT_NEAR(removal.propose(editor, model, t, edge, Never), best, 1e-12);
      EXPECT_EQ(removal.ringWorst(), -10.0);
      EXPECT_EQ(int(removal.cavity().size()), n);
      // pruned just below the best, and just above it
      EXPECT_NEAR(removal.propose(editor, model, t, edge, best - 1e-6), best, 1e-12);
      std::vector<Simplex<3>> cells;
      removal.cells(cells);
      EXPECT_EQ(removal.propose(editor, model, t, edge, best + 1e-6), Never);

      ASSERT_EQ(int(cells.size()), 2 * (n - 2));
      std::vector<double> qualities;
      double sum = 0.0, worst = 1.0;
      for (const Simplex<3>& cell : cells)
      {
        Corners<3> x;
        for (int i = 0; i < 4; ++i)
        {
          x[i] = mesh.point(cell[i]);
        }
        sum += signedVolume(x);
        qualities.push_back(model(cell));
        worst = std::min(worst, qualities.back());
        EXPECT_EQ(signedVolume(x) > 0.0, qualities.back() > 0.0);
      }
      EXPECT_NEAR(worst, best, 1e-12);
      EXPECT_NEAR(sum, mesh.volume(), 1e-12);
      best > 0.0 ? ++positive : ++negative;
      const double volume = mesh.volume();
      const auto kept = keptFacets(mesh);
      ASSERT_TRUE(editor.replace(removal.cavity(), cells, qualities));
      expectSound(mesh, best > 0.0);
      EXPECT_NEAR(mesh.volume(), volume, 1e-12);
      EXPECT_EQ(keptFacets(mesh), kept);
    }
  }
  EXPECT_GT(positive, 10);
  EXPECT_GE(negative, 3);
}

/// What propose() says to the edge (0, 1) of a regular long ring, where removal pays.
double proposed(MeshInput<3> in, double above = Never, Index quality = -10, Index owner = None)
{
  SimplexMesh<3> mesh = buildMesh(in);
  MeshEditor<3> editor(mesh);
  NodalMetric<3> metric;
  const QualityModel<3, MeanEdgeShape<3>> model(mesh, metric, 0.0);
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    editor.setQuality(c, quality);
  }
  if (owner != None)
  {
    editor.setPointOwner(owner, 1); // the others have 0
    editor.setOwner(0);
  }
  EdgeRemoval<3, MeanEdgeShape<3>> removal;
  return removal.propose(editor, model, 0, 0, above);
}
}

TEST(EdgeRemoval3D, EqualsBruteForceOverAllTriangulations)
{
  equalsBruteForce<MeanEdgeShape<3>>(); // lengths shared
  equalsBruteForce<VolumeLengthShape<3>>();
  equalsBruteForce<MinimumSineShape<3>>(); // element by element
}

TEST(EdgeRemoval3D, RefusesWhatMustStay)
{
  const MeshInput<3> good = ringOf(5, 1.5, 0.0, 1);
  EXPECT_GT(proposed(good), 0.1);

  MeshInput<3> edge = good;
  edge.keptEdges = { { 1, 0 } };
  EXPECT_EQ(proposed(edge), Never);
  edge.keptEdges = { { 0, 2 } }; // another edge
  EXPECT_GT(proposed(edge), 0.1);

  for (Index k = 0; k < 5; ++k) // wherever the kept facet lies, also at the cell asked about
  {
    MeshInput<3> facet = good;
    facet.keptFacets = { { 0, 1, 2 + k } };
    EXPECT_EQ(proposed(facet), Never) << k;
    MeshInput<3> open = good; // the same for the surface
    open.cells.erase(open.cells.begin() + k);
    EXPECT_EQ(proposed(open), Never) << k;
  }
  MeshInput<3> regions = good;
  regions.regions = { 0, 0, 1, 1, 1 };
  EXPECT_EQ(proposed(regions), Never);
}

TEST(EdgeRemoval3D, RefusesWhatIsNotOwned)
{
  const MeshInput<3> good = ringOf(5, 1.5, 0.0, 1);
  for (Index p = 2; p < 7; ++p)
  {
    EXPECT_EQ(proposed(good, Never, -10, p), Never) << p;
  }
}

TEST(EdgeRemoval3D, RingsUpToTwelve)
{
  EXPECT_GT(proposed(ringOf(12, 4.0, 0.0, 1)), 0.0);
  EXPECT_EQ(proposed(ringOf(13, 4.0, 0.0, 1)), Never);
}

TEST(EdgeRemoval3D, OnlyIfBetterThanTheRing)
{
  const MeshInput<3> good = ringOf(5, 1.5, 0.0, 1);
  EXPECT_EQ(proposed(good, Never, 1), Never);
  EXPECT_EQ(proposed(good, 1.0), Never);
}

TEST(EdgeRemoval2D, Swap)
{
  TestRandom random(3);
  int better = 0, inverted = 0;
  for (int k = 0; k < 200; ++k)
  {
    MeshInput<2> in;
    in.points = { { -1, 0 }, { 1, 0 }, { 0.9 * random(), 0.7 + 0.6 * random() },
      { 1.5 * random(), -0.7 - 0.6 * random() } };
    in.cells = { { 0, 1, 2 }, { 1, 0, 3 } };
    for (int kept = 0; kept < 2; ++kept)
    {
      if (kept)
      {
        in.keptFacets = { { 1, 0 } };
      }
      SimplexMesh<2> mesh = buildMesh(in);
      MeshEditor<2> editor(mesh);
      NodalMetric<2> metric;
      const QualityModel<2, MeanEdgeShape<2>> model(mesh, metric, 0.0);
      for (Index c : { 0, 1 })
      {
        editor.setQuality(c, model(mesh.nodes(c)));
      }
      const double old = std::min(mesh.quality(0), mesh.quality(1));
      const double swapped = std::min(model({ 0, 3, 2 }), model({ 3, 1, 2 }));
      inverted += swapped < 0.0;
      const double expected = !kept && swapped > old ? swapped : Never;
      EdgeRemoval<2, MeanEdgeShape<2>> removal;
      for (Index c : { 0, 1 })
      {
        for (int e = 0; e < 3; ++e)
        {
          const Index a = mesh.nodes(c)[Local<2>::edges[e][0]];
          const Index b = mesh.nodes(c)[Local<2>::edges[e][1]];
          const double q = removal.propose(editor, model, c, e, Never);
          // the other edges lie at the surface
          const double wanted = a + b == 1 ? expected : Never;
          EXPECT_TRUE(q == wanted || std::abs(q - wanted) < 1e-14) << q << " " << wanted;
          if (q != Never && c == 1)
          {
            ++better;
            std::vector<Simplex<2>> cells;
            removal.cells(cells);
            const double volume = mesh.volume();
            ASSERT_TRUE(editor.replace(removal.cavity(), cells, { q, q }));
            expectSound(mesh);
            EXPECT_NEAR(mesh.volume(), volume, 1e-14);
            break;
          }
        }
      }
    }
  }
  EXPECT_GT(better, 20);
  EXPECT_GT(inverted, 20);
}
