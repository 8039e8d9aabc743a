// SPDX-License-Identifier: BSD-3-Clause
// How qualities are counted.
#include "Edit/QualityModel.h"
#include "Reposition/StarProblem.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <thread>

using namespace meshopt;

TEST(Evaluations, EachQualityCountsOnce)
{
  const SimplexMesh<3> mesh = buildMesh(jitteredGrid<3>(2, 0.1));
  NodalMetric<3> metric;
  const QualityModel<3, MeanEdgeShape<3>> model(mesh, metric, 0.0);
  const EvaluationCount count;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    model(mesh.nodes(c));
  }
  EXPECT_EQ(count.get(), mesh.numberOfCellSlots());
}

TEST(Evaluations, APlaceOfANodeCostsItsFacets)
{
  const ElementQuality<3, MeanEdgeShape<3>> quality{};
  StarProblem<3, MeanEdgeShape<3>> star;
  star.clear(quality, true);
  const Vec<3> corners[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  for (int p = 0; p < 4; ++p)
  {
    star.addPoint(p, corners[p]);
  }
  for (const auto& f : { std::array<int, 3>{ 1, 2, 3 }, { 0, 3, 2 }, { 0, 1, 3 }, { 0, 2, 1 } })
  {
    star.addFacet(f);
  }
  const EvaluationCount count;
  star.evaluate({ 0.2, 0.2, 0.2 });
  EXPECT_EQ(count.get(), 4);
  // A step computes gradients, too.
  Vec<3> x{ 0.1, 0.2, 0.2 };
  star.maximize(x, { 1.0, 1e-3, StarSteps });
  EXPECT_GT(count.get(), 4 + 3 * 4);
}

TEST(Evaluations, WhatIsTakenIsHiddenFromEarlierCounts)
{
  const EvaluationCount outer;
  evaluationsOfThread += 3;
  EvaluationCount inner;
  evaluationsOfThread += 5;
  EXPECT_EQ(outer.get(), 8);
  EXPECT_EQ(inner.take(), 5);
  EXPECT_EQ(inner.take(), 0);
  EXPECT_EQ(outer.get(), 3);
}

TEST(Evaluations, AreThoseOfTheThread)
{
  const EvaluationCount count;
  std::thread([] { evaluationsOfThread += 7; }).join();
  EXPECT_EQ(count.get(), 0);
}
