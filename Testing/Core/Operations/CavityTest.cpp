// SPDX-License-Identifier: BSD-3-Clause
// The bottleneck theorem of Cavity.h against all cavities there are, and what limits a cavity.
#include "Operations/Cavity.h"
#include "Run/Summary.h"
#include "TestMeshes.h"

using namespace meshopt;

namespace
{
/// n tetrahedra around an edge that has a point in its middle: 2 n cells, one free point (2).
MeshInput<3> doubleRing(int n, unsigned seed)
{
  TestRandom random(seed);
  MeshInput<3> in;
  in.points = { { 0, 0, -1 }, { 0, 0, 1 }, { 0.2 * random(), 0.2 * random(), 0.3 * random() } };
  for (int k = 0; k < n; ++k)
  {
    const double a = 2.0 * M_PI * (k + 0.2 * random()) / n;
    in.points.emplace_back(std::cos(a), std::sin(a), 0.3 * random());
    const Index i = 3 + k, j = 3 + (k + 1) % n;
    in.cells.push_back({ 0, 2, i, j });
    in.cells.push_back({ 2, 1, i, j });
  }
  return in;
}

/// Triangles around two free points.
MeshInput<2> disc(unsigned seed)
{
  TestRandom random(seed);
  MeshInput<2> in;
  const double s = 0.15;
  in.points = { { -0.4 + s * random(), s * random() }, { 0.4 + s * random(), s * random() } };
  for (int k = 0; k < 8; ++k)
  {
    const double a = 2.0 * M_PI * (k + 0.3 * random()) / 8;
    in.points.emplace_back(1.3 * std::cos(a), std::sin(a));
  }
  for (int k = 0; k < 8; ++k) // to the point on the same side
  {
    const Index i = 2 + k, j = 2 + (k + 1) % 8;
    in.cells.push_back({ k < 2 || k > 5 ? 1 : 0, i, j });
  }
  in.cells.push_back({ 0, 1, 4 });
  in.cells.push_back({ 1, 0, 8 });
  return in;
}

template <int D, class Shape>
struct Bench
{
  SimplexMesh<D> mesh;
  MeshEditor<D> editor;
  NodalMetric<D> metric;
  QualityModel<D, Shape> model;
  Cavity<D, Shape> cavity;
  Index p;

  Bench(const MeshInput<D>& in, Measure measure)
    : mesh(buildMesh(in))
    , editor(mesh)
    , model(mesh, metric, 0.0)
  {
    computeQualities<D>(this->editor, this->metric, measure, 0.0);
    this->p = this->editor.addPoint(Vec<D>::Zero());
  }

  double grow(Index seed, const Vec<D>& x, int swallowed, int cells = 80,
    double hopeless = -std::numeric_limits<double>::infinity())
  {
    CavityLimits limits{ cells, swallowed };
    limits.hopeless = hopeless;
    this->editor.movePoint(this->p, x);
    return this->cavity.grow(this->editor, this->model, seed, { this->p, x }, limits);
  }

  /// Worst new element for the cavity of these cells (bits).
  double worstOf(unsigned set) const
  {
    double worst = std::numeric_limits<double>::infinity();
    for (Index c = 0; c < this->mesh.numberOfInputCells(); ++c)
    {
      for (int i = 0; i <= D && (set >> c & 1); ++i)
      {
        const Index h = this->mesh.adjacent(c, i);
        if (h != None && !this->mesh.isKept(c, i) && (set >> this->mesh.cellOf(h) & 1))
        {
          continue;
        }
        const Facet<D> f = this->mesh.facet(c, i);
        Simplex<D> cell;
        std::copy(f.begin(), f.end(), cell.begin());
        cell[D] = this->p;
        worst = std::min(worst, this->model(cell));
      }
    }
    return worst;
  }

  bool isConnected(unsigned set, Index seed) const
  {
    unsigned reached = 1u << seed;
    for (unsigned before = 0; before != reached;)
    {
      before = reached;
      for (Index c = 0; c < this->mesh.numberOfInputCells(); ++c)
      {
        for (int i = 0; i <= D && (reached >> c & 1); ++i)
        {
          const Index h = this->mesh.adjacent(c, i);
          if (h != None && !this->mesh.isKept(c, i))
          {
            reached |= set & (1u << this->mesh.cellOf(h));
          }
        }
      }
    }
    return reached == set;
  }

  double bestOfAll(Index seed) const
  {
    double best = -std::numeric_limits<double>::infinity();
    const unsigned n = 1u << this->mesh.numberOfInputCells();
    for (unsigned set = 1; set < n; ++set)
    {
      if ((set >> seed & 1) && this->isConnected(set, seed))
      {
        best = std::max(best, this->worstOf(set));
      }
    }
    return best;
  }

  /// The points that vanish with the cavity: its cells', but those of its boundary.
  std::set<Index> swallowed() const
  {
    std::set<Index> points;
    for (Index c : this->cavity.cells())
    {
      points.insert(this->mesh.nodes(c).begin(), this->mesh.nodes(c).end());
    }
    for (const Facet<D>& f : this->cavity.facets())
    {
      for (Index q : f)
      {
        points.erase(q);
      }
    }
    return points;
  }

  /// What the cavity says about itself.
  void check(Index seed, double best)
  {
    unsigned set = 0;
    double old = std::numeric_limits<double>::infinity(), worst = old;
    for (Index c : this->cavity.cells())
    {
      EXPECT_EQ(set >> c & 1, 0u);
      set |= 1u << c;
      old = std::min(old, this->mesh.quality(c));
    }
    EXPECT_TRUE(set >> seed & 1);
    EXPECT_TRUE(this->isConnected(set, seed));
    EXPECT_NEAR(this->worstOf(set), best, 1e-12);
    EXPECT_EQ(this->cavity.oldWorst(), old);
    std::vector<Simplex<D>> cells;
    for (const Facet<D>& f : this->cavity.facets())
    {
      Simplex<D> cell;
      std::copy(f.begin(), f.end(), cell.begin());
      cell[D] = this->p;
      cells.push_back(cell);
      worst = std::min(worst, this->model(cell));
    }
    EXPECT_NEAR(worst, best, 1e-12);
    const std::set<Index> swallowed = this->swallowed();
    for (Index q : swallowed)
    {
      EXPECT_TRUE(this->mesh.isFree(q));
    }
    if (best > 0.0) // star-shaped: the elements fill it
    {
      const double volume = this->mesh.volume();
      const auto kept = keptFacets(this->mesh);
      const std::size_t place = this->editor.begin();
      ASSERT_TRUE(
        this->editor.replace(this->cavity.cells(), cells, std::vector<double>(cells.size(), 0.5)));
      expectSound(this->mesh);
      EXPECT_NEAR(this->mesh.volume(), volume, 1e-13);
      EXPECT_EQ(keptFacets(this->mesh), kept);
      this->editor.rollback(place);
    }
  }
};

template <int D, class Shape>
void equalsAll(const MeshInput<D>& in, Measure measure, unsigned seedOfPoints, std::size_t& largest)
{
  Bench<D, Shape> bench(in, measure);
  TestRandom random(seedOfPoints);
  const Index n = bench.mesh.numberOfInputCells();
  for (Index seed = 0; seed < n; ++seed)
  {
    const Corners<D> corners = bench.mesh.corners(seed);
    Vec<D> x = Vec<D>::Zero(); // in the seed or a little off it
    double sum = 0.0;
    for (int i = 0; i <= D; ++i)
    {
      const double w = 0.6 + 0.75 * random();
      x += w * corners[i];
      sum += w;
    }
    x /= sum;
    const double q = bench.grow(seed, x, 1000, 1000);
    EXPECT_NEAR(q, bench.bestOfAll(seed), 1e-12) << "seed " << seed;
    bench.check(seed, q);
    largest = std::max(largest, bench.cavity.cells().size());
  }
}
}

TEST(Cavity3D, BestPrefixIsTheBestOfAllCavities)
{
  std::size_t largest = 0;
  for (unsigned k = 1; k <= 6; ++k)
  {
    equalsAll<3, MeanEdgeShape<3>>(doubleRing(5, k), Measure::Shape, k, largest);
    equalsAll<3, MinimumSineShape<3>>(doubleRing(4, k), Measure::MinimumSine, k, largest);
  }
  EXPECT_GE(largest, 6u);
}

TEST(Cavity3D, KeptFacetsAreNotCrossed)
{
  std::size_t largest = 0;
  for (unsigned k = 1; k <= 4; ++k)
  {
    MeshInput<3> in = doubleRing(5, k);
    in.keptFacets = { { 0, 2, 3 }, { 2, 4, 5 } };
    equalsAll<3, MeanEdgeShape<3>>(in, Measure::Shape, k, largest);
    in.regions.assign(10, 0);
    in.regions[2] = in.regions[3] = in.regions[4] = 1;
    in.keptFacets.clear();
    equalsAll<3, MeanEdgeShape<3>>(in, Measure::Shape, k, largest);
  }
  EXPECT_GE(largest, 2u);
}

TEST(Cavity2D, BestPrefixIsTheBestOfAllCavities)
{
  std::size_t largest = 0;
  for (unsigned k = 1; k <= 10; ++k)
  {
    MeshInput<2> in = disc(k);
    equalsAll<2, MeanEdgeShape<2>>(in, Measure::Shape, k, largest);
    in.keptFacets = { { 0, 1 } };
    equalsAll<2, VolumeLengthShape<2>>(in, Measure::VolumeLength, k, largest);
  }
  EXPECT_GE(largest, 4u);
}

TEST(Cavity3D, SwallowsNoMoreThanAllowed)
{
  MeshInput<3> in = doubleRing(5, 1);
  Bench<3, MeanEdgeShape<3>> bench(in, Measure::Shape);
  const Vec<3> x(0.02, 0.01, 0.03); // close to the free point: it had better go
  const double best = bench.grow(0, x, 1);
  EXPECT_EQ(bench.swallowed().size(), 1u);
  EXPECT_EQ(bench.cavity.cells().size(), 10u);
  const double guarded = bench.grow(0, x, 0);
  EXPECT_EQ(bench.swallowed().size(), 0u);
  EXPECT_LT(bench.cavity.cells().size(), 10u);
  EXPECT_LT(guarded, best);
  bench.check(0, guarded);

  in.fixedPoints.assign(in.points.size(), 0);
  in.fixedPoints[2] = 1;
  Bench<3, MeanEdgeShape<3>> fixed(in, Measure::Shape);
  EXPECT_EQ(fixed.grow(0, x, 1000), guarded);
  EXPECT_EQ(fixed.swallowed().size(), 0u);
  fixed.check(0, guarded);
}

TEST(Cavity3D, TakesNoMoreCellsThanAllowed)
{
  Bench<3, MeanEdgeShape<3>> bench(doubleRing(5, 1), Measure::Shape);
  const Vec<3> x(0.02, 0.01, 0.03);
  double before = -std::numeric_limits<double>::infinity();
  for (int cells = 1; cells <= 10; ++cells)
  {
    const double q = bench.grow(0, x, 1000, cells);
    EXPECT_LE(int(bench.cavity.cells().size()), cells);
    EXPECT_GE(q, before);
    before = q;
    bench.check(0, q);
  }
  EXPECT_NEAR(before, bench.bestOfAll(0), 1e-12);
}

// The outer facets are walls, and the first cell has one.
TEST(Cavity3D, EndsWhereAWallIsHopeless)
{
  Bench<3, MeanEdgeShape<3>> bench(doubleRing(5, 1), Measure::Shape);
  const Vec<3> x(0.02, 0.01, 0.03);
  const auto evaluationsOf = [&](double hopeless)
  {
    EvaluationCount count;
    bench.grow(0, x, 1, 80, hopeless);
    return count.get();
  };
  const double best = bench.grow(0, x, 1);
  const std::vector<Index> cells = bench.cavity.cells();
  EXPECT_EQ(bench.grow(0, x, 1, 80, 0.999 * best), best); // no wall is worse than the best cavity
  EXPECT_TRUE(std::is_permutation(
    cells.begin(), cells.end(), bench.cavity.cells().begin(), bench.cavity.cells().end()));
  EXPECT_LE(bench.grow(0, x, 1, 80, 1.0), best);
  EXPECT_LE(bench.cavity.cells().size(), 1u);
  EXPECT_LT(evaluationsOf(1.0), evaluationsOf(0.999 * best) / 2);
}

// What is hopeless is taken in at once, in another order. Inverted elements are among it.
TEST(Cavity3D, IsTheSameWhateverIsHopelessBelowIt)
{
  int inverted = 0;
  for (unsigned k = 1; k <= 20; ++k)
  {
    Bench<3, MeanEdgeShape<3>> bench(doubleRing(6, k), Measure::Shape);
    TestRandom random(k);
    const Vec<3> x(0.8 * random(), 0.8 * random(), 0.8 * random());
    const auto sortedCells = [&]
    {
      std::vector<Index> cells = bench.cavity.cells();
      std::sort(cells.begin(), cells.end());
      return cells;
    };
    for (Index seed = 0; seed < 12; ++seed)
    {
      const double best = bench.grow(seed, x, 1);
      const std::vector<Index> cells = sortedCells();
      for (double part : { 0.0, 0.5, 0.999 })
      {
        const double hopeless = part * best;
        if (best > 0.0)
        {
          EXPECT_EQ(bench.grow(seed, x, 1, 80, hopeless), best) << k << " " << seed << " " << part;
          EXPECT_EQ(sortedCells(), cells);
        }
        else
        {
          ++inverted;
          EXPECT_LE(bench.grow(seed, x, 1, 80, 0.0), 0.0);
        }
      }
      EXPECT_LE(bench.grow(seed, x, 1, 80, std::abs(best)), std::abs(best));
    }
  }
  EXPECT_GT(inverted, 0);
  EXPECT_LT(inverted, 20 * 12 * 3);
}

TEST(Cavity3D, StaysWithinWhatTheEditorOwns)
{
  Bench<3, MeanEdgeShape<3>> bench(doubleRing(5, 1), Measure::Shape);
  const Vec<3> x(0.02, 0.01, 0.03);
  for (Index p = 0; p < bench.mesh.numberOfPointSlots(); ++p)
  {
    bench.editor.setPointOwner(p, p == 1 ? 1 : 0); // the upper half belongs to another
  }
  bench.editor.setOwner(0);
  bench.editor.resetHeldUp();
  bench.grow(0, x, 1000);
  EXPECT_TRUE(bench.editor.isHeldUp());
  for (Index c : bench.cavity.cells())
  {
    EXPECT_LT(bench.mesh.localIndex(c, 1), 0);
  }
}

TEST(Cavity3D, KeptEdgesStay)
{
  MeshInput<3> in = doubleRing(5, 1);
  in.fixedPoints.assign(in.points.size(), 1);
  const Vec<3> x(0.02, 0.01, -0.4); // the edge (0, 2) had better go
  Bench<3, MeanEdgeShape<3>> free(in, Measure::Shape);
  const double best = free.grow(0, x, 1000);
  for (Index c = 0; c < 10; c += 2)
  {
    const auto& cells = free.cavity.cells();
    EXPECT_EQ(std::count(cells.begin(), cells.end(), c), 1);
  }
  in.keptEdges = { { 2, 0 } };
  for (Index seed = 0; seed < 10; seed += 2)
  {
    Bench<3, MeanEdgeShape<3>> kept(in, Measure::Shape);
    const double q = kept.grow(seed, x, 1000);
    EXPECT_LT(q, best);
    int around = 0;
    for (Index c : kept.cavity.cells())
    {
      around += kept.mesh.localIndex(c, 0) >= 0 && kept.mesh.localIndex(c, 2) >= 0;
    }
    EXPECT_LT(around, 5);
    kept.check(seed, q);
  }
}
