// SPDX-License-Identifier: BSD-3-Clause
// The step of one node against its dual by brute force, and where it is known by hand.
#include "Reposition/ProximalStep.h"
#include "TestMeshes.h"

#include <Eigen/LU>

using namespace meshopt;

namespace
{
/// max over d of min_k (q_k + g_k . d) - |d|^2 / (2 tau), by its dual over all subsets: on each,
/// the stationary point of the affine hull counts if its weights are not negative.
template <int D>
double dual(const std::vector<typename ProximalStep<D>::Function>& f, double tau)
{
  const int m = int(f.size());
  double least = std::numeric_limits<double>::infinity();
  for (unsigned set = 1; set < 1u << m; ++set)
  {
    std::vector<int> id;
    for (int k = 0; k < m; ++k)
    {
      if (set >> k & 1)
      {
        id.push_back(k);
      }
    }
    const int s = int(id.size());
    if (s > D + 1)
    {
      continue; // some D + 1 of them do as well
    }
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(s + 1, s + 1);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(s + 1);
    for (int i = 0; i < s; ++i)
    {
      for (int j = 0; j < s; ++j)
      {
        a(i, j) = tau * f[id[i]].g.dot(f[id[j]].g);
      }
      a(i, s) = a(s, i) = 1.0;
      b[i] = -f[id[i]].q;
    }
    b[s] = 1.0;
    const Eigen::VectorXd mu = a.fullPivLu().solve(b);
    if ((a * mu - b).norm() > 1e-8 || mu.head(s).minCoeff() < -1e-12)
    {
      continue;
    }
    Vec<D> g = Vec<D>::Zero();
    double value = 0.0;
    for (int i = 0; i < s; ++i)
    {
      g += mu[i] * f[id[i]].g;
      value += mu[i] * f[id[i]].q;
    }
    least = std::min(least, value + 0.5 * tau * g.squaredNorm());
  }
  return least;
}

template <int D>
double primal(const std::vector<typename ProximalStep<D>::Function>& f, double tau, const Vec<D>& d)
{
  double least = std::numeric_limits<double>::infinity();
  for (const auto& k : f)
  {
    least = std::min(least, k.q + k.g.dot(d));
  }
  return least - d.squaredNorm() / (2.0 * tau);
}

template <int D>
void stepEqualsBruteForce()
{
  TestRandom random(4);
  ProximalStep<D> solver;
  for (int k = 0; k < 400; ++k)
  {
    std::vector<typename ProximalStep<D>::Function> f(1 + k % 8);
    for (auto& each : f)
    {
      each.q = 0.3 * random();
      for (int d = 0; d < D; ++d)
      {
        each.g[d] = random() + (k % 3 == 0 ? 1.0 : 0.0);
      }
    }
    for (double tau : { 0.01, 0.3, 10.0 })
    {
      Vec<D> d;
      const double level = solver.solve(f, tau, d);
      const double value = primal<D>(f, tau, d);
      EXPECT_NEAR(level, value + d.squaredNorm() / (2.0 * tau), 1e-9);
      EXPECT_NEAR(value, dual<D>(f, tau), 1e-6) << "m " << f.size() << " tau " << tau;
    }
  }
}

/// Many functions, the same several times, all equal, zero gradients: an answer that is sound.
template <int D>
void stepBearsDegeneracy()
{
  TestRandom random(6);
  ProximalStep<D> solver;
  using F = typename ProximalStep<D>::Function;
  for (int k = 0; k < 300; ++k)
  {
    std::vector<F> few(1 + k % (D + 3)), f;
    for (F& each : few)
    {
      each.q = k % 2 ? 0.5 : 0.5 + 0.1 * random();
      each.g.setZero();
      for (int d = 0; d < D && k % 7 != 0; ++d)
      {
        each.g[d] = std::round(2.0 * random()); // parallel and opposite ones are frequent
      }
    }
    for (int copies = 0; copies < 40; ++copies)
    {
      f.insert(f.end(), few.begin(), few.end());
    }
    Vec<D> d;
    const double level = solver.solve(f, 0.3, d);
    ASSERT_TRUE(d.allFinite() && std::isfinite(level));
    EXPECT_NEAR(primal<D>(f, 0.3, d), dual<D>(few, 0.3), 1e-5) << "k " << k;
  }
}
}

TEST(ProximalStep, OneFunctionIsFollowedAlongItsGradient)
{
  ProximalStep<3> solver;
  const Vec<3> g(1.0, -2.0, 0.5);
  Vec<3> d;
  // d = tau g, and the function there is q + tau |g|^2.
  EXPECT_DOUBLE_EQ(solver.solve({ { 0.25, g } }, 0.5, d), 0.25 + 0.5 * g.squaredNorm());
  EXPECT_EQ(d, Vec<3>(0.5 * g));
}

TEST(ProximalStep, TwoFunctionsMeetOnTheirRidge)
{
  // With 0 at the start and the gradients (a, 1) and (-1, 1): the first coordinate stays where both
  // are equal, d_0 = 0, and along the ridge both rise by one a length, d_1 = tau.
  ProximalStep<2> solver;
  for (double a : { 0.5, 1.0, 3.0 })
  {
    std::vector<ProximalStep<2>::Function> f;
    for (double slope : { a, -1.0 })
    {
      f.push_back({ 0.0, { slope, 1.0 } });
    }
    Vec<2> d;
    EXPECT_NEAR(solver.solve(f, 0.2, d), 0.2, 1e-8);
    EXPECT_LT((d - Vec<2>(0.0, 0.2)).norm(), 1e-8);
  }
}

TEST(ProximalStep, AFunctionFarAboveTheOthersDoesNotCount)
{
  TestRandom random(8);
  ProximalStep<3> solver;
  for (int run = 0; run < 50; ++run)
  {
    std::vector<ProximalStep<3>::Function> f(5);
    for (auto& each : f)
    {
      each = { 0.1 * random(), Vec<3>(random(), random(), random()) };
    }
    Vec<3> few, all;
    const double level = solver.solve(f, 0.3, few);
    f.insert(f.begin() + run % 6, { 10.0, Vec<3>(random(), random(), random()) });
    EXPECT_NEAR(solver.solve(f, 0.3, all), level, 1e-12);
    EXPECT_LT((all - few).norm(), 1e-12);
  }
}

/// A solver is used for many stars in turn.
TEST(ProximalStep, KeepsNothingOfTheStepBefore)
{
  TestRandom random(2);
  ProximalStep<2> used;
  for (int run = 0; run < 50; ++run)
  {
    std::vector<ProximalStep<2>::Function> f(1 + run % 7);
    for (auto& each : f)
    {
      each = { 0.3 * random(), Vec<2>(random(), random()) };
    }
    ProximalStep<2> fresh;
    Vec<2> a, b;
    EXPECT_EQ(used.solve(f, 0.5, a), fresh.solve(f, 0.5, b));
    EXPECT_EQ(a, b);
  }
}

TEST(ProximalStep, EqualsBruteForceOfItsDual)
{
  stepEqualsBruteForce<2>();
  stepEqualsBruteForce<3>();
}

TEST(ProximalStep, BearsDegeneracy)
{
  stepBearsDegeneracy<2>();
  stepBearsDegeneracy<3>();
}
