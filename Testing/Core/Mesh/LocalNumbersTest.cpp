// SPDX-License-Identifier: BSD-3-Clause
// Local numbers against a map.
#include "Mesh/LocalNumbers.h"
#include "TestMeshes.h"

#include <map>

using namespace meshopt;

TEST(LocalNumbers, InTheOrderOfFirstMention)
{
  LocalNumbers numbers;
  EXPECT_EQ(numbers.size(), 0);
  EXPECT_EQ(numbers.get(7), -1);
  EXPECT_EQ(numbers.add(7), 0);
  EXPECT_EQ(numbers.add(3), 1);
  EXPECT_EQ(numbers.add(7), 0);
  EXPECT_EQ(numbers.get(3), 1);
  EXPECT_EQ(numbers.size(), 2);
  numbers.clear();
  EXPECT_EQ(numbers.size(), 0);
  EXPECT_EQ(numbers.get(7), -1);
  EXPECT_EQ(numbers.add(3), 0);
}

/// Few points and many, so that the table grows, and ids that are near and far apart.
TEST(LocalNumbers, EqualAMap)
{
  TestRandom random(2);
  LocalNumbers numbers;
  for (int round = 0; round < 60; ++round)
  {
    std::map<Index, int> wanted;
    const double range = round % 3 == 0 ? 1e9 : round % 3 == 1 ? 3000.0 : 50.0;
    const int calls = round % 5 == 0 ? 5000 : 100;
    for (int k = 0; k < calls; ++k)
    {
      const Index p = static_cast<Index>(0.5 * (random() + 1.0) * range);
      const auto found = wanted.find(p);
      ASSERT_EQ(numbers.get(p), found == wanted.end() ? -1 : found->second);
      if (random() > 0.0)
      {
        const int next = static_cast<int>(wanted.size());
        ASSERT_EQ(numbers.add(p), wanted.emplace(p, next).first->second);
      }
      ASSERT_EQ(numbers.size(), static_cast<int>(wanted.size()));
    }
    for (const auto& [p, number] : wanted) // also after the table has grown
    {
      ASSERT_EQ(numbers.get(p), number);
    }
    numbers.clear();
  }
}
