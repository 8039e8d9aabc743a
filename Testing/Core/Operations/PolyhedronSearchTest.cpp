// SPDX-License-Identifier: BSD-3-Clause
// The best filling of a small polyhedron: against the enumeration of all fillings.
#include "Operations/PolyhedronSearch.h"
#include "Mesh/Predicates.h"
#include "PolyhedronOfCells.h"

#include <Eigen/Geometry>

#include <map>

using namespace meshopt;

namespace
{
using Triangle = PolyhedronSearch::Triangle;
using Tetrahedron = PolyhedronSearch::Tetrahedron;
constexpr double Never = PolyhedronSearch::Never;

double solve(PolyhedronSearch& search, const Polyhedron& p, double above = 0.0, long steps = 100000)
{
  load(search, p);
  return search.search(above, steps);
}

/// Matched facets, positive cells, the whole volume, all points that must be there.
void expectFills(const Polyhedron& p, const std::vector<Tetrahedron>& cells, double worst)
{
  std::map<std::array<int, 3>, int> open; // facet: cells on it
  std::vector<bool> used(p.points.size());
  double volume = 0.0, least = 1.0;
  for (const Tetrahedron& t : cells)
  {
    EXPECT_EQ(orientation(p.corners(t)), 1);
    volume += signedVolume(p.corners(t));
    least = std::min(least, p.quality(t));
    for (int i = 0; i < 4; ++i)
    {
      std::array<int, 3> f{ t[Local<3>::facets[i][0]], t[Local<3>::facets[i][1]],
        t[Local<3>::facets[i][2]] };
      std::sort(f.begin(), f.end());
      ++open[f];
      used[t[i]] = true;
    }
  }
  for (const Triangle& f : p.facets)
  {
    std::array<int, 3> key{ f[0], f[1], f[2] };
    std::sort(key.begin(), key.end());
    ++open[key];
  }
  for (const auto& [f, n] : open)
  {
    EXPECT_EQ(n, 2);
  }
  for (std::size_t k = 0; k < used.size(); ++k)
  {
    EXPECT_TRUE(used[k] || !p.stay[k]) << k;
  }
  EXPECT_NEAR(volume, p.volume(), 1e-12 * std::fabs(p.volume()));
  EXPECT_NEAR(least, worst, 1e-14);
}

/// True if the interiors of two tetrahedra have a point in common: no plane parallel to a facet of
/// one, or to an edge of each, parts them.
bool overlap(const Corners<3>& a, const Corners<3>& b)
{
  std::vector<Vec<3>> axes;
  for (const auto* x : { &a, &b })
  {
    for (const auto& f : Local<3>::facets)
    {
      axes.push_back(((*x)[f[1]] - (*x)[f[0]]).cross((*x)[f[2]] - (*x)[f[0]]));
    }
  }
  for (const auto& e : Local<3>::edges)
  {
    for (const auto& f : Local<3>::edges)
    {
      axes.push_back((a[e[1]] - a[e[0]]).cross(b[f[1]] - b[f[0]]));
    }
  }
  for (const Vec<3>& axis : axes)
  {
    double lowA = 1e30, highA = -1e30, lowB = 1e30, highB = -1e30;
    for (int i = 0; i < 4; ++i)
    {
      lowA = std::min(lowA, axis.dot(a[i]));
      highA = std::max(highA, axis.dot(a[i]));
      lowB = std::min(lowB, axis.dot(b[i]));
      highB = std::max(highB, axis.dot(b[i]));
    }
    if (axis.norm() > 1e-12 && (highA < lowB + 1e-10 || highB < lowA + 1e-10))
    {
      return false;
    }
  }
  return true;
}

/// The best worst quality over all fillings, found by trying all; counts the fillings.
struct BruteForce
{
  const Polyhedron& p;
  double best = Never;
  long fillings = 0;
  std::vector<Tetrahedron> placed;

  void fill(std::set<std::array<int, 3>> front) // the lowest number first, as it is turned
  {
    if (front.empty())
    {
      double volume = 0.0, worst = 1.0;
      std::vector<bool> used(this->p.points.size());
      for (const Tetrahedron& t : this->placed)
      {
        volume += signedVolume(this->p.corners(t));
        worst = std::min(worst, this->p.quality(t));
        for (int k : t)
        {
          used[k] = true;
        }
      }
      bool all = std::fabs(volume - this->p.volume()) < 1e-10;
      for (std::size_t k = 0; k < used.size(); ++k)
      {
        all &= used[k] || !this->p.stay[k];
      }
      this->fillings += all;
      this->best = all ? std::max(this->best, worst) : this->best;
      return;
    }
    const std::array<int, 3> f = *front.begin();
    for (int k = 0; k < int(this->p.points.size()); ++k)
    {
      const Tetrahedron t{ std::uint8_t(f[0]), std::uint8_t(f[1]), std::uint8_t(f[2]),
        std::uint8_t(k) };
      if (signedVolume(this->p.corners(t)) < 1e-10 ||
        std::any_of(this->placed.begin(), this->placed.end(),
          [&](const Tetrahedron& o) { return overlap(this->p.corners(o), this->p.corners(t)); }))
      {
        continue;
      }
      auto next = front;
      next.erase(f);
      for (int i = 0; i < 3; ++i)
      {
        const auto turned = [](int a, int b, int c)
        {
          return a < b && a < c ? std::array<int, 3>{ a, b, c }
            : b < c             ? std::array<int, 3>{ b, c, a }
                                : std::array<int, 3>{ c, a, b };
        };
        const int a = f[i], b = f[(i + 1) % 3];
        if (!next.erase(turned(b, a, k)))
        {
          next.insert(turned(a, b, k));
        }
      }
      this->placed.push_back(t);
      this->fill(next);
      this->placed.pop_back();
    }
  }

  void run()
  {
    std::set<std::array<int, 3>> front;
    for (const Triangle& f : this->p.facets)
    {
      const int k = int(std::min_element(f.begin(), f.end()) - f.begin());
      front.insert({ f[k], f[(k + 1) % 3], f[(k + 2) % 3] });
    }
    this->fill(front);
  }
};

/// Schoenhardt's: a prism whose upper triangle is turned; no tetrahedron of its points fits in.
Polyhedron schoenhardt()
{
  Polyhedron p;
  for (int k = 0; k < 6; ++k)
  {
    const double a = 2.0 * M_PI / 3.0 * (k % 3) + (k < 3 ? 0.0 : M_PI / 6.0);
    p.points.emplace_back(std::cos(a), std::sin(a), k < 3 ? 0.0 : 1.0);
  }
  p.facets = { { 0, 1, 2 }, { 3, 5, 4 } };
  for (std::uint8_t k = 0; k < 3; ++k)
  {
    const std::uint8_t n = (k + 1) % 3;
    // the quadrangle k, n, n + 3, k + 3 is split by the diagonal that lies inside
    p.facets.push_back({ k, std::uint8_t(k + 3), std::uint8_t(n + 3) });
    p.facets.push_back({ k, std::uint8_t(n + 3), n });
  }
  p.stay.assign(6, true);
  return p;
}
}

TEST(PolyhedronSearch, EqualsBruteForce)
{
  TestRandom random(7);
  PolyhedronSearch search;
  long several = 0, none = 0, dropped = 0;
  for (unsigned seed = 1; seed <= 60; ++seed)
  {
    MeshInput<3> in = jitteredGrid<3>(3, 0.28, seed);
    const SimplexMesh<3> mesh = buildMesh(in);
    const int points = 5 + seed % 3;
    const auto cells = someCells(mesh, Index(seed * 37 % in.cells.size()), points, random);
    const Polyhedron p = polyhedronOf(mesh, cells);
    BruteForce all{ p, Never, 0, {} };
    all.run();
    EXPECT_GE(all.fillings, 1); // that of the mesh
    EXPECT_NEAR(solve(search, p), all.best, 1e-14);
    expectFills(p, search.cells(), all.best);
    EXPECT_FALSE(search.ranOut());
    EXPECT_EQ(search.search(all.best + 1e-12, 100000), Never);
    EXPECT_NEAR(search.search(all.best - 1e-12, 100000), all.best, 1e-14);
    several += all.fillings > 1;
    none += search.search(0.9, 1000) == Never;
    EXPECT_TRUE(search.cells().empty());
  }
  // with points inside: the star of one, which may vanish or not
  for (unsigned seed = 1; seed <= 24; ++seed)
  {
    MeshInput<3> in;
    in.points = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 } };
    for (Vec<3>& x : in.points)
    {
      x += 0.4 * Vec<3>(random(), random(), random());
    }
    in.points.emplace_back(0.3 * random(), 0.3 * random(), 0.1 * random());
    for (Index k = 0; k < 8; ++k)
    {
      const Index a = k & 1, b = 2 + (k >> 1 & 1), c = 4 + (k >> 2);
      const bool odd = (a + b + c) % 2;
      in.cells.push_back({ odd ? b : a, odd ? a : b, c, 6 });
    }
    const SimplexMesh<3> mesh = buildMesh(in);
    if (mesh.audit(true).size() > 0)
    {
      continue;
    }
    Polyhedron p = polyhedronOf(mesh, { 0, 1, 2, 3, 4, 5, 6, 7 });
    const int inner = int(std::find(p.stay.begin(), p.stay.end(), false) - p.stay.begin());
    ASSERT_LT(inner, 7);
    for (int keep = 0; keep < 2; ++keep)
    {
      p.stay[inner] = keep;
      BruteForce all{ p, Never, 0, {} };
      all.run();
      EXPECT_NEAR(solve(search, p), all.best, 1e-14);
      expectFills(p, search.cells(), all.best);
      const bool used = std::any_of(search.cells().begin(), search.cells().end(),
        [&](const Tetrahedron& t) { return std::find(t.begin(), t.end(), inner) != t.end(); });
      EXPECT_TRUE(used || !keep);
      dropped += !used;
    }
  }
  EXPECT_GT(several, 25);
  EXPECT_GT(none, 50);
  EXPECT_GT(dropped, 5);
}

TEST(PolyhedronSearch, OctahedronTakesTheBestDiagonal)
{
  Polyhedron p;
  p.points = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 2, 0 }, { 0, -2, 0 }, { 0, 0, 3 }, { 0, 0, -3 } };
  p.stay.assign(6, true);
  p.facets = { { 0, 4, 2 }, { 2, 4, 1 }, { 1, 4, 3 }, { 3, 4, 0 }, { 2, 5, 0 }, { 1, 5, 2 },
    { 3, 5, 1 }, { 0, 5, 3 } };
  ASSERT_NEAR(p.volume(), 8.0, 1e-12);
  PolyhedronSearch search;
  const double q = solve(search, p);
  expectFills(p, search.cells(), q);
  ASSERT_EQ(search.cells().size(), 4u);
  for (const Tetrahedron& t : search.cells()) // all around the shortest one
  {
    EXPECT_EQ(std::count(t.begin(), t.end(), 0) + std::count(t.begin(), t.end(), 1), 2);
  }
}

TEST(PolyhedronSearch, TwoToThreeAndBack)
{
  Polyhedron p; // two tetrahedra on a triangle
  p.points = { { 1, 0, 0 }, { -0.5, 0.9, 0 }, { -0.5, -0.9, 0 }, { 0, 0, 0 }, { 0, 0, 0 } };
  p.stay.assign(5, true);
  p.facets = { { 1, 0, 3 }, { 2, 1, 3 }, { 0, 2, 3 }, { 0, 1, 4 }, { 1, 2, 4 }, { 2, 0, 4 } };
  PolyhedronSearch search;
  for (double height : { 0.3, 2.0 })
  {
    p.points[3][2] = height;
    p.points[4][2] = -height;
    const double q = solve(search, p);
    expectFills(p, search.cells(), q);
    EXPECT_EQ(search.cells().size(), height < 1.0 ? 3u : 2u);
  }
}

TEST(PolyhedronSearch, SchoenhardtNeedsAPointInside)
{
  Polyhedron p = schoenhardt();
  PolyhedronSearch search;
  EXPECT_EQ(solve(search, p), Never);
  EXPECT_TRUE(search.cells().empty());
  EXPECT_EQ(search.steps(), 0);
  EXPECT_GE(search.bareFacet(), 0);

  p.points.emplace_back(0.0, 0.0, 0.5);
  p.stay.push_back(false);
  const double q = solve(search, p);
  EXPECT_GT(q, 0.1);
  expectFills(p, search.cells(), q);
  EXPECT_EQ(search.cells().size(), 8u);
  EXPECT_EQ(search.bareFacet(), -1);
}

TEST(PolyhedronSearch, LargerOnesStepsAndTheSameBits)
{
  TestRandom random(11);
  long longest = 0;
  for (unsigned seed = 1; seed <= 12; ++seed)
  {
    const MeshInput<3> in = jitteredGrid<3>(4, 0.3, seed);
    const SimplexMesh<3> mesh = buildMesh(in);
    const auto cells = someCells(mesh, Index(seed * 31 % in.cells.size()), 10 + int(seed), random);
    const Polyhedron p = polyhedronOf(mesh, cells);
    PolyhedronSearch search, again;
    double old = 1.0;
    for (Index c : cells)
    {
      old = std::min(old, MeanEdgeShape<3>::value(mesh.corners(c)));
    }
    const double q = solve(search, p, 0.0, 3000);
    EXPECT_LE(search.steps(), 3000);
    if (!search.ranOut())
    {
      EXPECT_GE(q, old - 1e-14);
    }
    if (q > Never)
    {
      expectFills(p, search.cells(), q);
    }
    longest = std::max(longest, search.steps());
    // whatever was searched before
    EXPECT_EQ(solve(again, schoenhardt()), Never);
    EXPECT_EQ(solve(again, p, 0.0, 3000), q);
    EXPECT_EQ(again.cells(), search.cells());
    EXPECT_EQ(again.steps(), search.steps());
    const long few = search.steps() / 2;
    EXPECT_LE(solve(again, p, 0.0, few), q);
    EXPECT_LE(again.steps(), few);
    EXPECT_EQ(again.ranOut(), few < search.steps());
  }
  EXPECT_GT(longest, 50);
}

/// Two of three cells around an edge, which sees more than half a turn from outside: it passes
/// through the triangle of the three other points. So nothing on that triangle is a candidate.
TEST(PolyhedronSearch, CandidatesAreNotCrossedByAReflexEdge)
{
  const MeshInput<3> in = ringOf(3);
  PolyhedronSearch search;
  search.clear();
  for (const Vec<3>& x : in.points)
  {
    search.addPoint(x, true);
  }
  std::vector<PolyhedronSearch::Triangle> boundary;
  const auto add = [&](int a, int b, int c, int inner)
  {
    if (signedVolume({ in.points[a], in.points[b], in.points[c], in.points[inner] }) < 0.0)
    {
      std::swap(b, c);
    }
    boundary.push_back({ std::uint8_t(a), std::uint8_t(b), std::uint8_t(c) });
  };
  for (int k : { 2, 3 }) // cells (0, 1, k, k + 1)
  {
    add(0, k, k + 1, 1);
    add(1, k, k + 1, 0);
  }
  add(0, 1, 2, 3);
  add(0, 1, 4, 3);
  ASSERT_TRUE(search.setBoundary(boundary));
  search.findCandidates();
  EXPECT_EQ(search.candidates().size(), 2u);
}
