// SPDX-License-Identifier: BSD-3-Clause
// Lines near a set of edges, against sampling.
#include "Surface/SharpEdges.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace meshopt;

namespace
{
/// A circle of n edges.
SharpEdges circle(int n)
{
  SharpEdges edges;
  const auto at = [&](int k)
  {
    const double angle = 2.0 * std::acos(-1.0) * k / n;
    return Vec<3>(std::cos(angle), std::sin(angle), 0.0);
  };
  for (int k = 0; k < n; ++k)
  {
    edges.add(at(k), at(k + 1));
  }
  edges.finish();
  return edges;
}

TEST(SharpEdges, AChordIsNearIfItsSagittaIsSmall)
{
  const SharpEdges edges = circle(200);
  for (double angle : { 0.05, 0.1, 0.2, 0.4 })
  {
    const Vec<3> a(1.0, 0.0, 0.0), b(std::cos(angle), std::sin(angle), 0.0);
    const double sagitta = 1.0 - std::cos(0.5 * angle);
    EXPECT_TRUE(edges.isNear(a, b, 1.5 * sagitta + 1e-3)) << angle;
    EXPECT_FALSE(edges.isNear(a, b, 0.8 * sagitta - 2e-4)) << angle;
  }
}

TEST(SharpEdges, BothEndsNearIsNotEnough)
{
  const SharpEdges edges = circle(50);
  EXPECT_FALSE(edges.isNear(Vec<3>(1.0, 0.0, 0.0), Vec<3>(-1.0, 0.0, 0.0), 0.1));
  EXPECT_TRUE(edges.isNear(Vec<3>(1.0, 0.0, 0.0), Vec<3>(-1.0, 0.0, 0.0), 1.1));
}

TEST(SharpEdges, NothingIsNearNoEdge)
{
  SharpEdges edges;
  edges.finish();
  EXPECT_FALSE(edges.isNear(Vec<3>::Zero(), Vec<3>::Ones(), 10.0));
}
}
