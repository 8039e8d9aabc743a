// SPDX-License-Identifier: BSD-3-Clause
// The place of one node: the ascent against search, the fast path against the generic one.
#include "Reposition/StarProblem.h"
#include "TestMeshes.h"

using namespace meshopt;

namespace
{
/// The star of a node: an octahedron (3D) or a hexagon (2D) with displaced points.
template <int D>
struct Star
{
  std::vector<Vec<D>> points;
  std::vector<std::array<int, D>> facets;
  std::vector<double> weights;
  double flatness = 1.0; ///< see press()

  Star(double jitter, unsigned seed)
  {
    TestRandom random(seed);
    if constexpr (D == 2)
    {
      for (int k = 0; k < 6; ++k)
      {
        this->points.emplace_back(std::cos(k * M_PI / 3.0), std::sin(k * M_PI / 3.0));
        this->facets.push_back({ k, (k + 1) % 6 });
      }
    }
    else
    {
      this->points = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 },
        { 0, 0, -1 } };
      for (int k = 0; k < 8; ++k)
      {
        std::array<int, 3> f = { k & 1, 2 + (k >> 1 & 1), 4 + (k >> 2 & 1) };
        if (this->volume(f, Vec<3>::Zero()) < 0.0)
        {
          std::swap(f[0], f[1]);
        }
        this->facets.push_back(f);
      }
    }
    for (Vec<D>& x : this->points)
    {
      for (int d = 0; d < D; ++d)
      {
        x[d] += jitter * random();
      }
    }
    for (std::size_t k = 0; k < this->facets.size(); ++k) // every other star is weighed
    {
      this->weights.push_back(seed % 2 ? 1.0 : 2.0 + random());
    }
  }

  /// Presses all flat in the last direction.
  void press(double part)
  {
    this->flatness = part;
    for (Vec<D>& x : this->points)
    {
      x[D - 1] *= part;
    }
  }

  Corners<D> corners(const std::array<int, D>& f, const Vec<D>& x) const
  {
    Corners<D> c;
    for (int i = 0; i < D; ++i)
    {
      c[i] = this->points[f[i]];
    }
    c[D] = x;
    return c;
  }
  double volume(const std::array<int, D>& f, const Vec<D>& x) const
  {
    return signedVolume(this->corners(f, x));
  }

  template <class Shape>
  void load(StarProblem<D, Shape>& problem, bool plain) const
  {
    static constexpr ElementQuality<D, Shape> quality;
    problem.clear(quality, plain);
    for (std::size_t k = 0; k < this->points.size(); ++k)
    {
      EXPECT_EQ(problem.addPoint(Index(100 + 7 * k), this->points[k]), int(k));
    }
    EXPECT_EQ(problem.addPoint(100, this->points[0]), 0); // seen already
    for (std::size_t k = 0; k < this->facets.size(); ++k)
    {
      problem.addFacet(this->facets[k], this->weights[k]);
      problem.addFacetMetric({});
    }
  }

  template <class Shape>
  double value(std::size_t k, const Vec<D>& x) const
  {
    return this->weights[k] * Shape::value(this->corners(this->facets[k], x));
  }

  template <class Shape>
  double worst(const Vec<D>& x) const
  {
    double q = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < this->facets.size(); ++k)
    {
      q = std::min(q, this->value<Shape>(k, x));
    }
    return q;
  }

  /// The best place by random search that closes in on the best so far.
  template <class Shape>
  double search(unsigned seed) const
  {
    TestRandom random(seed);
    Vec<D> best = Vec<D>::Zero();
    double value = this->worst<Shape>(best);
    for (double radius = 1.0; radius > 1e-5; radius *= 0.85)
    {
      for (int k = 0; k < 300; ++k)
      {
        Vec<D> x = best;
        for (int d = 0; d < D; ++d)
        {
          x[d] += radius * random() * (d == D - 1 ? this->flatness : 1.0);
        }
        const double q = this->worst<Shape>(x);
        if (q > value)
        {
          value = q;
          best = x;
        }
      }
    }
    return value;
  }
};

template <int D, class Shape>
void findsTheOptimum()
{
  int starts = 0;
  for (unsigned seed = 1; seed <= 8; ++seed)
  {
    const Star<D> star(0.25, seed);
    const double best = star.template search<Shape>(seed);
    ASSERT_GT(best, 0.1);
    TestRandom random(seed);
    for (bool plain : { true, false })
    {
      StarProblem<D, Shape> problem;
      star.load(problem, plain);
      for (int start = 0; start < 12; ++start)
      {
        Vec<D> x;
        for (int d = 0; d < D; ++d)
        {
          x[d] = 0.5 * random();
        }
        const double before = star.template worst<Shape>(x);
        EXPECT_NEAR(problem.evaluate(x), before, 1e-13);
        if (!(before > 0.0))
        {
          continue;
        }
        ++starts;
        const double after = problem.maximize(x, { 2.0, 1e-7, 200 });
        EXPECT_NEAR(after, best, 1e-3) << "seed " << seed << " start " << start;
        EXPECT_NEAR(after, star.template worst<Shape>(x), 1e-13);
        EXPECT_GE(after, before);
        ASSERT_EQ(problem.values().size(), star.facets.size()); // they belong to x
        for (std::size_t k = 0; k < star.facets.size(); ++k)
        {
          EXPECT_NEAR(problem.values()[k], star.template value<Shape>(k, x), 1e-13);
        }
      }
    }
  }
  EXPECT_GT(starts, 80);
}

/// Dense sampling: nowhere is it better than where maximize() ends.
template <int D, class Shape>
void nothingBetterOnAGrid()
{
  const Star<D> star(0.3, 5);
  StarProblem<D, Shape> problem;
  star.load(problem, true);
  Vec<D> x = Vec<D>::Zero();
  const double best = problem.maximize(x, { 2.0, 1e-7, 200 });
  const int n = D == 3 ? 30 : 100;
  for (int k = 0; k < (D == 3 ? n * n * n : n * n); ++k)
  {
    Vec<D> y;
    for (int d = 0, rest = k; d < D; ++d, rest /= n)
    {
      y[d] = 2.4 * (rest % n) / n - 1.2;
    }
    EXPECT_LE(star.template worst<Shape>(y), best + 1e-3);
  }
}

template <int D, class Shape>
void fastPathEqualsGeneric()
{
  TestRandom random(9);
  for (unsigned seed = 1; seed <= 10; ++seed)
  {
    const Star<D> star(0.3, seed);
    StarProblem<D, Shape> fast, generic;
    star.load(fast, true);
    star.load(generic, false);
    for (int k = 0; k < 20; ++k)
    {
      Vec<D> x;
      for (int d = 0; d < D; ++d)
      {
        x[d] = 1.5 * random(); // inside, where all are positive, and outside
      }
      EXPECT_NEAR(fast.evaluate(x), generic.evaluate(x), 1e-13);
      for (std::size_t f = 0; f < star.facets.size(); ++f)
      {
        EXPECT_NEAR(fast.values()[f], generic.values()[f], 1e-13);
      }
      // one step with the same model of the star goes to the same place: gradients are equal
      Vec<D> a = x, b = x;
      fast.maximize(a, { 2.0, 1e-9, 1 });
      generic.maximize(b, { 2.0, 1e-9, 1 });
      EXPECT_LT((a - b).norm(), 1e-9 * (1.0 + (a - x).norm()));
    }
  }
}
}

TEST(StarProblem2D, FindsTheOptimum)
{
  findsTheOptimum<2, MeanEdgeShape<2>>();
  findsTheOptimum<2, VolumeLengthShape<2>>();
  nothingBetterOnAGrid<2, MeanEdgeShape<2>>();
}

TEST(StarProblem3D, FindsTheOptimum)
{
  findsTheOptimum<3, MeanEdgeShape<3>>();
  findsTheOptimum<3, VolumeLengthShape<3>>();
  nothingBetterOnAGrid<3, MeanEdgeShape<3>>();
}

/// How near to the best flat stars come, at worst, by steps of FlatScale or without.
template <int D>
double leastReached(double flatness, bool byFlatScale)
{
  double least = 1.0;
  for (unsigned seed = 1; seed <= 6; ++seed)
  {
    Star<D> star(0.25, seed);
    star.press(flatness);
    const double best = star.template search<MeanEdgeShape<D>>(seed);
    EXPECT_LT(best, 0.1);
    StarProblem<D, MeanEdgeShape<D>> problem;
    star.load(problem, true);
    TestRandom random(seed);
    Vec<D> x;
    do
    {
      for (int d = 0; d < D; ++d)
      {
        x[d] = 0.6 * random() * (d == D - 1 ? flatness : 1.0);
      }
    } while (!(problem.evaluate(x) > 0.0));
    // A usual least gain. Without the last number FlatScale is off.
    const SearchGoal goal = byFlatScale ? SearchGoal{ 2.0, 1e-3 * best, StarSteps, 1.0 }
                                        : SearchGoal{ 2.0, 1e-3 * best, StarSteps };
    least = std::min(least, problem.maximize(x, goal) / best);
  }
  return least;
}

template <int D>
void findsTheOptimumOfFlatStars()
{
  for (const double flatness : { 1e-2, 1e-4, 1e-6 })
  {
    EXPECT_GT(leastReached<D>(flatness, true), 0.99) << flatness;
  }
  EXPECT_LT(leastReached<D>(1e-4, false), 0.9); // no step promises enough
}

TEST(StarProblem, FindsTheOptimumOfFlatStars)
{
  findsTheOptimumOfFlatStars<2>();
  findsTheOptimumOfFlatStars<3>();
}

TEST(StarProblem, FastPathEqualsGenericPath)
{
  fastPathEqualsGeneric<2, MeanEdgeShape<2>>();
  fastPathEqualsGeneric<2, VolumeLengthShape<2>>();
  fastPathEqualsGeneric<3, MeanEdgeShape<3>>();
  fastPathEqualsGeneric<3, VolumeLengthShape<3>>();
}

TEST(StarProblem, StopsWhereItIsEnough)
{
  const Star<3> star(0.2, 2);
  StarProblem<3, MeanEdgeShape<3>> problem;
  star.load(problem, true);
  const Vec<3> start(0.3, 0.3, 0.2);
  Vec<3> x = start;
  const double before = problem.evaluate(x);
  EXPECT_EQ(problem.maximize(x, { 0.5 * before, 1e-7, StarSteps }), before);
  EXPECT_EQ(x, start);
  EXPECT_GT(problem.maximize(x, { before + 0.01, 1e-7, StarSteps }), before + 0.01);
  x = start;
  EXPECT_EQ(problem.maximize(x, { 2.0, 1e9, StarSteps }), before); // no step promises so much
  EXPECT_EQ(x, start);
}
