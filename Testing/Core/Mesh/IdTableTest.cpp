// SPDX-License-Identifier: BSD-3-Clause
// The table of caps against std::map.
#include "Mesh/IdTable.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

using namespace meshopt;

TEST(IdTable, IsAMapThatKeepsTheLeast)
{
  std::mt19937 random(3);
  std::uniform_int_distribution<Index> id(0, 40);
  std::uniform_real_distribution<double> value(0.0, 1.0);
  IdTable<3> table;
  std::map<Facet<3>, double> expected;
  EXPECT_TRUE(table.empty());
  EXPECT_EQ(table.find({ 1, 2, 3 }), nullptr);
  for (int k = 0; k < 20000; ++k)
  {
    const Facet<3> key = sortedIds(Facet<3>{ id(random), id(random), id(random) });
    const double* found = table.find(key);
    ASSERT_EQ(found != nullptr, expected.count(key) > 0);
    if (found)
    {
      ASSERT_EQ(*found, expected[key]);
    }
    const double v = value(random);
    const auto [place, isNew] = expected.try_emplace(key, v);
    place->second = isNew ? v : std::min(place->second, v);
    table.addLeast(key, v);
  }
  EXPECT_GT(expected.size(), 1000u);
  table.clear();
  EXPECT_TRUE(table.empty());
  EXPECT_EQ(table.find(expected.begin()->first), nullptr);
}
