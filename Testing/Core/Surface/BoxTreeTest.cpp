// SPDX-License-Identifier: BSD-3-Clause
// The tree of boxes against looking at every box.
#include "Surface/BoxTree.h"

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

TEST(BoxTree, BoxesAreWidenedOnAllSides)
{
  const std::vector<Vec<3>> points{ Vec<3>(1.0, 5.0, -1.0), Vec<3>(2.0, 3.0, 0.0) };
  const BoxTree::Box box = BoxTree::widened(BoxTree::around(points), 0.5);
  EXPECT_EQ(box.min(), Eigen::Vector3d(0.5, 2.5, -1.5));
  EXPECT_EQ(box.max(), Eigen::Vector3d(2.5, 5.5, 0.5));
}
}
