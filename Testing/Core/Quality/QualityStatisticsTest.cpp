// SPDX-License-Identifier: BSD-3-Clause
#include "Quality/QualityStatistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

using namespace meshopt;

namespace
{
constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

std::vector<double> sample(std::size_t n)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-0.1, 1.0);
  std::vector<double> values(n);
  for (double& v : values)
  {
    v = uniform(random);
  }
  return values;
}
}

TEST(QualityStatistics, AgainstTheDefinition)
{
  const std::vector<double> v = sample(10001);
  QualityStatistics one, chunk;
  for (double x : v)
  {
    one.add(x);
  }
  one.add(notANumber);
  chunk.add(v.data(), 5000);
  QualityStatistics rest;
  rest.add(v.data() + 5000, 5001);
  chunk.merge(rest);
  chunk.add(&notANumber, 1);
  const double mean = std::accumulate(v.begin(), v.end(), 0.0) / v.size();
  double squares = 0.0;
  for (double x : v)
  {
    squares += (x - mean) * (x - mean);
  }
  for (const QualityStatistics& s : { one, chunk })
  {
    EXPECT_EQ(s.count, 10001);
    EXPECT_EQ(s.invalid, 1);
    EXPECT_EQ(s.inverted, std::count_if(v.begin(), v.end(), [](double x) { return x < 0.0; }));
    EXPECT_EQ(s.minimum, *std::min_element(v.begin(), v.end()));
    EXPECT_EQ(s.maximum, *std::max_element(v.begin(), v.end()));
    EXPECT_NEAR(s.mean, mean, 1e-14);
    EXPECT_NEAR(s.standardDeviation(), std::sqrt(squares / v.size()), 1e-14);
  }
}

TEST(QualityStatistics, SmallSpreadDoesNotCancel)
{
  QualityStatistics s, t;
  for (int k = 0; k < 1000; ++k)
  {
    (k % 2 ? s : t).add(1e8 + (k % 2));
  }
  s.merge(t);
  EXPECT_NEAR(s.standardDeviation(), 0.5, 1e-9);
}

TEST(QualityStatistics, EmptyAndMerge)
{
  QualityStatistics empty, s;
  s.add(0.25);
  const QualityStatistics before = s;
  s.merge(empty);
  EXPECT_EQ(s.count, before.count);
  EXPECT_EQ(s.mean, 0.25);
  empty.merge(s);
  EXPECT_EQ(empty.mean, 0.25);
  EXPECT_EQ(empty.minimum, 0.25);
  EXPECT_EQ(QualityStatistics().standardDeviation(), 0.0);
}

TEST(QualityHistogram, CountsAddUpAndEndsBelong)
{
  QualityHistogram h(0.0, 1.0, 4);
  for (double v : { 0.0, 0.249, 0.25, 0.5, 0.99, 1.0, 1.5, -3.0, notANumber })
  {
    h.add(v);
  }
  EXPECT_EQ(h.counts, (std::vector<std::int64_t>{ 3, 1, 1, 3 }));
  EXPECT_EQ(h.edge(0), 0.0);
  EXPECT_EQ(h.edge(3), 0.75);
  EXPECT_EQ(h.edge(4), 1.0);
  QualityHistogram other = h;
  h.merge(other);
  EXPECT_EQ(h.counts[0], 6);
  QualityHistogram point(0.5, 0.5, 3);
  point.add(0.5);
  EXPECT_EQ(point.counts[0], 1);
}

TEST(WorstElements, SameInAnyOrderTiesById)
{
  std::vector<WorstElement> all;
  std::mt19937 random(2);
  for (int id = 0; id < 500; ++id)
  {
    all.push_back({ static_cast<double>(random() % 20), id % 3, id });
  }
  std::vector<WorstElement> sorted = all;
  std::sort(sorted.begin(), sorted.end());
  for (int repeat = 0; repeat < 5; ++repeat)
  {
    std::shuffle(all.begin(), all.end(), random);
    WorstElements a(7), b(7);
    for (std::size_t k = 0; k < all.size(); ++k)
    {
      (k % 2 ? a : b).add(all[k]);
    }
    a.add({ notANumber, 0, 0 });
    a.merge(b);
    const std::vector<WorstElement> worst = a.sorted();
    ASSERT_EQ(worst.size(), 7u);
    for (std::size_t k = 0; k < worst.size(); ++k)
    {
      EXPECT_EQ(worst[k].quality, sorted[k].quality);
      EXPECT_EQ(worst[k].part, sorted[k].part);
      EXPECT_EQ(worst[k].id, sorted[k].id);
    }
  }
  WorstElements none(0);
  none.add(all[0]);
  EXPECT_TRUE(none.sorted().empty());
}
