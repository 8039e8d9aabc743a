// SPDX-License-Identifier: BSD-3-Clause
// Steps by FlatScale: the same however flat all is pressed, and only where gradients point.
#include "Reposition/FlatScale.h"
#include "TestMeshes.h"

using namespace meshopt;

namespace
{
/// The step along the first of the gradients.
Vec<3> stepOf(const std::vector<Vec<3>>& gradients, const std::vector<double>& qualities)
{
  FlatScale<3> scale;
  for (int round = 0; round < 2; ++round) // nothing is left of what was added before
  {
    scale.clear();
    for (std::size_t k = 0; k < gradients.size(); ++k)
    {
      scale.add(qualities[k], round == 0 ? Vec<3>::Ones() : gradients[k]);
    }
  }
  scale.close();
  Vec<3> step = gradients[0];
  scale.scale(step);
  scale.unscale(step);
  return step;
}
}

TEST(FlatScale, StepsFollowWhenAllIsPressedFlat)
{
  TestRandom random(3);
  for (int k = 0; k < 20; ++k)
  {
    std::vector<Vec<3>> gradients(8);
    std::vector<double> qualities(8);
    for (std::size_t i = 0; i < gradients.size(); ++i)
    {
      gradients[i] = Vec<3>(random(), random(), random());
      qualities[i] = 1.5 + random();
    }
    const Vec<3> step = stepOf(gradients, qualities);
    const Vec<3> pressed(1.0, 0.5, 1.0 / 16.0); // lengths; gradients rise as these fall
    for (Vec<3>& g : gradients)
    {
      g = g.cwiseQuotient(pressed);
    }
    EXPECT_LT(
      (stepOf(gradients, qualities).cwiseQuotient(pressed) - step).norm(), 1e-2 * step.norm());
    // Qualities that are all smaller change nothing.
    for (std::size_t i = 0; i < gradients.size(); ++i)
    {
      gradients[i] *= 1e-9;
      qualities[i] *= 1e-9;
    }
    EXPECT_LT((1e9 * stepOf(gradients, qualities).cwiseQuotient(pressed) - step).norm(),
      1e-2 * step.norm());
  }
}

TEST(FlatScale, StepsStayWhereGradientsPoint)
{
  TestRandom random(5);
  const Vec<3> normal = Vec<3>(1, 2, -1).normalized();
  std::vector<Vec<3>> gradients(6);
  for (Vec<3>& g : gradients)
  {
    g = Vec<3>(random(), random(), random());
    g -= normal.dot(g) * normal;
  }
  const Vec<3> step = stepOf(gradients, { 0.1, 0.2, 0.3, 0.1, 0.2, 0.3 });
  EXPECT_GT(step.norm(), 0.0);
  EXPECT_LT(std::fabs(normal.dot(step)), 1e-3 * step.norm());
  EXPECT_GT(step.dot(gradients[0]), 0.0);
}

TEST(FlatScale, WithoutGradientsStepsAreFinite)
{
  const std::vector<Vec<3>> none(2, Vec<3>::Zero());
  EXPECT_TRUE(stepOf(none, { 0.1, 0.1 }).isZero());
}
