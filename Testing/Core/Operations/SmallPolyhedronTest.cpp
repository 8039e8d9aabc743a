// SPDX-License-Identifier: BSD-3-Clause
// Small polyhedron reconnection in a mesh: what it finds, and what must stay.
#include "Operations/SmallPolyhedron.h"
#include "Operations/EdgeRemoval.h"
#include "TestMeshes.h"

#include "Mesh/CavityFit.h"

using namespace meshopt;

namespace
{
constexpr double Never = -std::numeric_limits<double>::infinity();
using Reconnection = SmallPolyhedron<MeanEdgeShape<3>>;

/// A mesh with all that works on it; qualities are set.
struct Bench
{
  SimplexMesh<3> mesh;
  MeshEditor<3> editor;
  NodalMetric<3> metric;
  QualityModel<3, MeanEdgeShape<3>> model;

  explicit Bench(const MeshInput<3>& in)
    : mesh(buildMesh(in))
    , editor(this->mesh)
    , model(this->mesh, this->metric, 0.0)
  {
    for (Index c = 0; c < this->mesh.numberOfCellSlots(); ++c)
    {
      this->editor.setQuality(c, this->model(this->mesh.nodes(c)));
    }
  }

  /// Makes what was proposed; everything that must hold holds afterwards.
  void accept(Reconnection& r, double proposed)
  {
    std::vector<Index> ids;
    for (const Vec<3>& x : r.newPoints())
    {
      ids.push_back(this->editor.addPoint(x));
    }
    r.nameNewPoints(ids);
    std::vector<double> qualities;
    for (const Simplex<3>& cell : r.cells())
    {
      qualities.push_back(this->model(cell));
    }
    EXPECT_NEAR(*std::min_element(qualities.begin(), qualities.end()), proposed, 1e-13);
    EXPECT_GT(proposed, r.oldWorst());
    EXPECT_TRUE(fillsCavity<3>(this->mesh, r.cavity(), r.cells()));
    const double volume = this->mesh.volume();
    ASSERT_TRUE(this->editor.replace(r.cavity(), r.cells(), qualities));
    EXPECT_NEAR(this->mesh.volume(), volume, 1e-12 * volume);
  }
};

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

/// Octahedron of eight cells around point 6, which lies near the facet (0, 2, 4).
MeshInput<3> octahedron(double towards)
{
  MeshInput<3> in;
  in.points = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1.1, 0 }, { 0, -1.1, 0 }, { 0, 0, 1.2 },
    { 0, 0, -1.2 }, { towards, towards, towards } };
  for (Index k = 0; k < 8; ++k)
  {
    const Index a = k & 1, b = 2 + (k >> 1 & 1), c = 4 + (k >> 2);
    const bool odd = (a + b + c) % 2;
    in.cells.push_back({ odd ? b : a, odd ? a : b, c, 6 });
  }
  return in;
}

/// What is left when propose() has been asked for ever more.
template <class... Rest>
double best(Reconnection& r, const Bench& b, Index t, const Rest&... rest)
{
  double q = Never;
  for (double next = q; (next = r.propose(b.editor, b.model, t, q, rest...)) > q; q = next)
  {
  }
  return q;
}

/// All cells below `target` once, the worst first; returns how many were replaced.
int improveAll(Bench& b, double target, const PolyhedronLimits& limits)
{
  Reconnection r;
  std::vector<std::pair<double, Index>> order;
  for (Index c = 0; c < b.mesh.numberOfCellSlots(); ++c)
  {
    order.emplace_back(b.mesh.quality(c), c);
  }
  std::sort(order.begin(), order.end());
  int done = 0;
  for (const auto& [q, c] : order)
  {
    if (q >= target || !b.mesh.isAlive(c) || b.mesh.quality(c) != q)
    {
      continue;
    }
    const auto before = sortedQualities(b.mesh);
    const double found = r.propose(b.editor, b.model, c, q, limits);
    EXPECT_TRUE(found == Never || found > q);
    if (found > Never)
    {
      EXPECT_NE(std::find(r.cavity().begin(), r.cavity().end(), c), r.cavity().end());
      EXPECT_LE(int(r.cavity().size()), limits.cells);
      EXPECT_LE(int(r.newPoints().size()), limits.newPoints);
      b.accept(r, found);
      EXPECT_TRUE(isAbove(sortedQualities(b.mesh), before));
      ++done;
    }
  }
  return done;
}
}

TEST(SmallPolyhedron, NeverWorseThanEdgeRemoval)
{
  int better = 0, found = 0;
  for (int n = 3; n <= 9; ++n)
  {
    for (unsigned seed = 1; seed <= 20; ++seed)
    {
      Bench b(ringOf(n, 0.6 + 0.2 * (seed % 6), 0.6, 100 * n + seed));
      if (!b.mesh.audit(true).empty())
      {
        continue;
      }
      EdgeRemoval<3, MeanEdgeShape<3>> removal;
      const double byEdge = removal.propose(b.editor, b.model, 0, 0, Never);
      Reconnection r;
      // the first polyhedron that helps need not be the whole ring
      const double q = best(r, b, 0);
      EXPECT_GE(q, byEdge - 1e-9) << n << " " << seed;
      better += q > byEdge + 1e-9;
      found += q > Never;
      if (q > Never)
      {
        const auto kept = keptFacets(b.mesh);
        b.accept(r, r.propose(b.editor, b.model, 0, q - 1e-9));
        expectSound(b.mesh);
        EXPECT_EQ(keptFacets(b.mesh), kept);
      }
    }
  }
  EXPECT_GT(found, 20);
  EXPECT_GT(better, 2); // fillings that no triangulation of the ring gives
}

TEST(SmallPolyhedron, APointInsideMayVanish)
{
  const auto improved = [](const MeshInput<3>& in, bool drop)
  {
    Bench b(in);
    PolyhedronLimits limits;
    limits.mayDropPoints = drop;
    const int done = improveAll(b, 1.0, limits);
    expectSound(b.mesh);
    EXPECT_TRUE(b.mesh.isPointAlive(6) || b.mesh.countCells() == 4);
    return std::make_pair(b.mesh.isPointAlive(6), done > 0);
  };
  const MeshInput<3> in = octahedron(0.3);
  EXPECT_EQ(improved(in, true), std::make_pair(false, true));
  EXPECT_TRUE(improved(in, false).first);
  MeshInput<3> fixed = in;
  fixed.fixedPoints.assign(7, 0);
  fixed.fixedPoints[6] = 1;
  EXPECT_TRUE(improved(fixed, true).first);
}

TEST(SmallPolyhedron, OffersNewPoints)
{
  // an icosahedron, joined to its first node
  MeshInput<3> in;
  const double g = 0.5 + std::sqrt(1.25);
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int s = 0; s < 4; ++s)
    {
      Vec<3> x = Vec<3>::Zero();
      x[axis] = s & 1 ? 1.0 : -1.0;
      x[(axis + 1) % 3] = s & 2 ? g : -g;
      in.points.push_back(x);
    }
  }
  for (Index a = 0; a < 12; ++a)
  {
    for (Index b = 0; b < 12; ++b)
    {
      for (Index c = 0; c < 12; ++c)
      {
        const auto edge = [&](Index i, Index j)
        { return std::fabs((in.points[i] - in.points[j]).norm() - 2.0) < 1e-9; };
        const Simplex<3> t{ a, b, c, 0 };
        if (a < b && a < c && b != c && edge(a, b) && edge(b, c) && edge(c, a) && a != 0 &&
          signedVolume(Corners<3>{ in.points[a], in.points[b], in.points[c], in.points[0] }) > 1e-9)
        {
          in.cells.push_back(t);
        }
      }
    }
  }
  ASSERT_EQ(in.cells.size(), 15u);
  Bench b(in);
  Reconnection r;
  double without = Never;
  for (Index c = 0; c < 15; ++c)
  {
    without = std::max(without, r.propose(b.editor, b.model, c, Never));
  }
  EXPECT_LT(without, 0.5);
  PolyhedronLimits limits;
  limits.newPoints = 8;
  const double above = 0.6;
  const double q = r.propose(b.editor, b.model, 0, above, limits);
  EXPECT_GT(q, above);
  ASSERT_GE(r.newPoints().size(), 1u);
  const Vec<3> place = r.newPoints()[0];
  limits.height = 0.05; // too near to the facets: nothing is as good
  EXPECT_EQ(r.propose(b.editor, b.model, 0, q, limits), Never);
  limits.height = 0.5;
  EXPECT_EQ(r.propose(b.editor, b.model, 0, above, limits), q);
  EXPECT_EQ(r.newPoints()[0], place);
  b.accept(r, q);
  expectSound(b.mesh);
}

TEST(SmallPolyhedron, KeepsWhatMustStay)
{
  const auto proposed = [](const MeshInput<3>& in, Index owner = None)
  {
    Bench b(in);
    if (owner != None)
    {
      b.editor.setPointOwner(owner, 1); // the others have 0
      b.editor.setOwner(0);
    }
    Reconnection r;
    const double q = r.propose(b.editor, b.model, 0, Never);
    EXPECT_TRUE(q == Never || owner == None);
    if (q > Never)
    {
      b.accept(r, q);
      expectSound(b.mesh); // kept edges are there as well
    }
    return q;
  };
  const MeshInput<3> good = ringOf(5, 1.5, 0.0, 1);
  EXPECT_GT(proposed(good), 0.1);
  MeshInput<3> in = good;
  in.keptEdges = { { 0, 1 } };
  EXPECT_EQ(proposed(in), Never);
  in.keptEdges = { { 0, 2 } }; // at the surface anyway
  EXPECT_GT(proposed(in), 0.1);
  for (Index k = 0; k < 5; ++k)
  {
    in = good;
    in.keptFacets = { { 0, 1, 2 + k } };
    EXPECT_EQ(proposed(in), Never) << k;
    EXPECT_EQ(proposed(good, 2 + k), Never) << k;
  }
  in = good;
  in.regions = { 0, 0, 1, 1, 1 };
  EXPECT_EQ(proposed(in), Never);
}

TEST(SmallPolyhedron, WhatIsEnoughDoesNotCount)
{
  Bench b(ringOf(5, 1.5, 0.0, 1));
  for (Index c = 0; c < 5; ++c)
  {
    b.editor.setQuality(c, 0.1);
  }
  Reconnection r;
  const double q = best(r, b, 0);
  ASSERT_GT(q, 0.1);
  const double above = q + 0.05; // more than can be had
  // ... unless the cells at some facets do not count
  int asked = 0;
  const double all = r.propose(b.editor, b.model, 0, above, {},
    [&](Index c, int i)
    {
      EXPECT_TRUE(b.mesh.isKept(c, i));
      ++asked;
      return 0.5 * q;
    });
  EXPECT_GT(asked, 0);
  EXPECT_GT(all, 0.9 * q);
  const double none = r.propose(b.editor, b.model, 0, above, {}, [&](Index, int) { return above; });
  EXPECT_EQ(none, Never);
}

TEST(SmallPolyhedron, WholeMeshes)
{
  for (unsigned seed = 1; seed <= 3; ++seed)
  {
    MeshInput<3> in = jitteredGrid<3>(4, 0.3, seed);
    if (seed == 3)
    {
      splitRegions<3>(in);
      in.keptEdges = { { 31, 62 } };
    }
    PolyhedronLimits limits;
    limits.newPoints = seed == 2 ? 6 : 0;
    std::unique_ptr<MeshBits<3>> bits;
    for (int run = 0; run < 2; ++run)
    {
      Bench b(in);
      const auto kept = keptFacets(b.mesh);
      const double volume = b.mesh.volume();
      EXPECT_GT(improveAll(b, 0.5, limits), 5);
      expectSound(b.mesh);
      EXPECT_EQ(keptFacets(b.mesh), kept);
      EXPECT_NEAR(b.mesh.volume(), volume, 1e-12);
      EXPECT_EQ(eulerCharacteristic(b.mesh), 1);
      if (run == 0)
      {
        bits = std::make_unique<MeshBits<3>>(bitsOf(b.mesh));
      }
      else
      {
        EXPECT_TRUE(bitsOf(b.mesh) == *bits);
      }
    }
  }
}

TEST(SmallPolyhedron, InvertedCellsAndOtherMeasures)
{
  MeshInput<3> in = jitteredGrid<3>(3, 0.6, 4);
  SimplexMesh<3> mesh = buildMesh(in);
  MeshEditor<3> editor(mesh);
  NodalMetric<3> metric;
  const QualityModel<3, MinimumSineShape<3>> model(mesh, metric, 0.0);
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    editor.setQuality(c, model(mesh.nodes(c)));
  }
  SmallPolyhedron<MinimumSineShape<3>> r;
  int found = 0, inverted = 0;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    const double q = r.propose(editor, model, c, mesh.quality(c));
    inverted += mesh.quality(c) <= 0.0;
    if (q == Never)
    {
      continue;
    }
    ++found;
    double worst = 1.0, before = 0.0, after = 0.0;
    for (const Simplex<3>& cell : r.cells())
    {
      Corners<3> x;
      for (int i = 0; i < 4; ++i)
      {
        x[i] = mesh.point(cell[i]);
      }
      worst = std::min(worst, model(cell));
      after += signedVolume(x);
    }
    for (Index o : r.cavity())
    {
      before += signedVolume(mesh.corners(o));
    }
    EXPECT_NEAR(worst, q, 1e-13);
    EXPECT_NEAR(before, after, 1e-13);
    EXPECT_TRUE(fillsCavity<3>(mesh, r.cavity(), r.cells()));
  }
  EXPECT_GT(found, 20);
  EXPECT_GT(inverted, 3);
}
