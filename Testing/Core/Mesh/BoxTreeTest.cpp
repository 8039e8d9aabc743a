// SPDX-License-Identifier: BSD-3-Clause
// The tree of boxes against looking at every box.
#include "Mesh/BoxTree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace meshopt;

namespace
{
/// Boxes at random, many of them equal or flat. Of `step` > 0 all numbers are multiples: ties.
std::vector<BoxTree::Item> boxes(int n, double step, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  const auto point = [&]
  {
    Vec<3> x;
    for (int i = 0; i < 3; ++i)
    {
      const double value = number(random);
      x[i] = step > 0.0 ? step * std::round(value / step) : value;
    }
    return x;
  };
  std::vector<BoxTree::Item> items;
  for (int k = 0; k < n; ++k)
  {
    const Vec<3> x = point();
    // Numbers that are not those of the order: the caller's are given back.
    items.push_back({ 7 * k + 3, BoxTree::around(std::vector<Vec<3>>{ x, x + 0.2 * point() }) });
  }
  return items;
}

/// Numbers of boxes, and the steps that their coordinates are multiples of; 0: none.
const std::vector<std::pair<int, double>> Cases{ { 0, 0.0 }, { 1, 0.0 }, { 2, 0.5 }, { 3, 0.0 },
  { 40, 0.5 }, { 500, 0.0 }, { 500, 0.25 } };

TEST(BoxTree, FindsWhatTouchesABox)
{
  for (const auto& [n, step] : Cases)
  {
    const std::vector<BoxTree::Item> items = boxes(n, step, 1);
    BoxTree tree;
    tree.build(items);
    for (const BoxTree::Item& asked : boxes(50, step, 2))
    {
      std::vector<int> expected, found;
      for (const BoxTree::Item& item : items)
      {
        if (item.box.intersects(asked.box))
        {
          expected.push_back(item.number);
        }
      }
      tree.findTouching(asked.box, [&](int number) { found.push_back(number); });
      std::sort(found.begin(), found.end());
      EXPECT_EQ(found, expected) << n << " boxes";
    }
  }
}

TEST(BoxTree, AsksForAllThatAreNearest)
{
  for (const auto& [n, step] : Cases)
  {
    const std::vector<BoxTree::Item> items = boxes(n, step, 3);
    BoxTree tree;
    tree.build(items);
    std::size_t asked = 0;
    for (const BoxTree::Item& where : boxes(50, step, 4))
    {
      const Eigen::Vector3d x = where.box.min();
      const auto distance = [&](int number)
      { return items[(number - 3) / 7].box.squaredExteriorDistance(x); };
      double least = std::numeric_limits<double>::infinity();
      for (const BoxTree::Item& item : items)
      {
        least = std::min(least, distance(item.number));
      }
      std::vector<int> looked;
      EXPECT_EQ(least,
        tree.findNearest(Vec<3>(x),
          [&](int number)
          {
            looked.push_back(number);
            return distance(number);
          }));
      asked += looked.size();
      for (const BoxTree::Item& item : items)
      {
        EXPECT_TRUE(distance(item.number) > least ||
          std::count(looked.begin(), looked.end(), item.number) == 1);
      }
    }
    // The tree is there to look at few of them.
    EXPECT_TRUE(n < 500 || asked < 50u * static_cast<std::size_t>(n) / 5u) << asked;
  }
}

TEST(BoxTree, FindsWhatASegmentPasses)
{
  for (const auto& [n, step] : Cases)
  {
    const std::vector<BoxTree::Item> items = boxes(n, step, 5);
    BoxTree tree;
    tree.build(items);
    for (const BoxTree::Item& asked : boxes(50, step, 6))
    {
      // Of multiples of a step many components are 0, and many ends lie on a side of a box.
      const Vec<3> from = asked.box.min(), way = asked.box.max() - asked.box.min();
      for (double end : { 1.0, 0.25 })
      {
        std::vector<int> found;
        tree.findAlong(from, way, end, [&](int number) { found.push_back(number); });
        for (const BoxTree::Item& item : items)
        {
          // Exact in quarters of steps; at random nothing is touched only just.
          bool passes = false;
          for (int k = 0; k <= 64 && !passes; ++k)
          {
            passes = item.box.contains(Eigen::Vector3d(from + end * k / 64.0 * way));
          }
          const bool isFound = std::count(found.begin(), found.end(), item.number) == 1;
          EXPECT_TRUE(isFound || !passes);
          EXPECT_TRUE(!isFound || item.box.intersects(asked.box));
        }
      }
      // Once the first is found, and the end is there, hardly any other is asked for.
      double end = 1.0;
      std::size_t after = 0;
      tree.findAlong(from, way, end,
        [&](int)
        {
          end = -1.0;
          ++after;
        });
      EXPECT_LE(after, 1u);
    }
  }
}

TEST(BoxTree, BoxesAreWidenedOnAllSides)
{
  const std::vector<Vec<3>> points{ Vec<3>(1.0, 5.0, -1.0), Vec<3>(2.0, 3.0, 0.0) };
  const BoxTree::Box box = BoxTree::widened(BoxTree::around(points), 0.5);
  EXPECT_EQ(box.min(), Eigen::Vector3d(0.5, 2.5, -1.5));
  EXPECT_EQ(box.max(), Eigen::Vector3d(2.5, 5.5, 0.5));
}
}
