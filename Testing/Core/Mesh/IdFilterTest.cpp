// SPDX-License-Identifier: BSD-3-Clause
// The filter before a table, against std::set: it forgets nothing, and spares most look-ups.
#include "Mesh/IdFilter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

using namespace meshopt;

namespace
{
constexpr Index Ids = 60;

Facet<3> sorted(Facet<3> f)
{
  std::sort(f.begin(), f.end());
  return f;
}

struct Filled
{
  /// Neighbouring ids, as in a mesh: each is in about six groups.
  Filled()
  {
    for (Index p = 0; p + 3 < Ids; ++p)
    {
      this->add({ p, p + 1, p + 3 });
      this->add({ p + 3, p, p + 2 });
    }
  }
  void add(const Facet<3>& f)
  {
    this->filter.add(f, Ids);
    this->groups.insert(sorted(f));
  }

  IdFilter filter;
  std::set<Facet<3>> groups;
};
}

TEST(IdFilter, HasAllThatWereAddedInAnyOrder)
{
  Filled filled;
  for (Facet<3> f : filled.groups)
  {
    do
    {
      EXPECT_TRUE(filled.filter.mayHave(f));
    } while (std::next_permutation(f.begin(), f.end()));
  }
}

TEST(IdFilter, KnowsMostOthers)
{
  Filled filled;
  int others = 0, wrong = 0;
  for (Index a = 0; a < Ids; ++a)
  {
    for (Index b = a + 1; b < std::min(Ids, a + 6); ++b)
    {
      for (Index c = b + 1; c < std::min(Ids, b + 6); ++c)
      {
        const Facet<3> f{ a, b, c };
        const bool other = filled.groups.count(f) == 0;
        others += other;
        wrong += other && filled.filter.mayHave(f);
      }
    }
  }
  EXPECT_GT(others, 500);
  EXPECT_LT(20 * wrong, others);
}

TEST(IdFilter, LeavesOutEachInTurn)
{
  Filled filled;
  std::mt19937 random(5);
  std::uniform_int_distribution<Index> step(1, 3), first(0, Ids - 10);
  int some = 0;
  for (int k = 0; k < 2000; ++k)
  {
    Simplex<3> nodes{ first(random) };
    for (int i = 1; i < 4; ++i)
    {
      nodes[i] = nodes[i - 1] + step(random);
    }
    std::shuffle(nodes.begin(), nodes.end(), random);
    const unsigned facets = filled.filter.mayHaveWithoutOne(nodes);
    for (int i = 0; i < 4; ++i)
    {
      Facet<3> f;
      std::copy_n(nodes.begin(), i, f.begin());
      std::copy(nodes.begin() + i + 1, nodes.end(), f.begin() + i);
      ASSERT_EQ((facets >> i & 1u) != 0, filled.filter.mayHave(f));
    }
    some += facets != 0;
  }
  EXPECT_GT(some, 100);
  EXPECT_LT(some, 2000);
}

TEST(IdFilter, HoldsNothingOfNewIds)
{
  Filled filled;
  EXPECT_FALSE(filled.filter.mayHave(Facet<3>{ Ids, Ids + 1, Ids + 3 }));
  EXPECT_EQ(filled.filter.mayHaveWithoutOne(Simplex<3>{ Ids, Ids + 1, Ids + 2, Ids + 3 }), 0u);
  EXPECT_FALSE(filled.filter.empty());
  filled.filter.clear();
  EXPECT_TRUE(filled.filter.empty());
  EXPECT_FALSE(filled.filter.mayHave(Facet<3>{ 0, 1, 3 }));
}
