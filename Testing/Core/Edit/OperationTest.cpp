// SPDX-License-Identifier: BSD-3-Clause
// Kinds of operations: each has a name of its own, and a place in every row of the history.
#include "Edit/Operation.h"
#include "Run/Report.h"

#include <gtest/gtest.h>

#include <iterator>
#include <set>
#include <string>

using namespace meshopt;

TEST(Operation, EachHasANameOfItsOwn)
{
  const std::set<std::string> names(std::begin(OperationNames), std::end(OperationNames));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(NumberOfOperations));
  EXPECT_EQ(names.count(""), 0u);
}

TEST(Operation, ARowOfTheHistoryCountsEach)
{
  PassRecord row, other;
  EXPECT_EQ(row.tried.size(), static_cast<std::size_t>(NumberOfOperations));
  for (int op = 0; op < NumberOfOperations; ++op)
  {
    EXPECT_EQ(row.tried[op], 0);
    row.tried[op] = 10 * op;
    row.done[op] = op;
    other.tried[op] = 7;
    other.done[op] = 1;
  }
  row.worst = 0.25;
  row.seconds = 0.5;
  other.worst = 0.75;
  other.seconds = 2.0;
  row.addWork(other);
  for (int op = 0; op < NumberOfOperations; ++op)
  {
    EXPECT_EQ(row.tried[op], 10 * op + 7);
    EXPECT_EQ(row.done[op], op + 1);
  }
  EXPECT_EQ(row.seconds, 2.5);
  EXPECT_EQ(row.worst, 0.25); // work only: what the mesh is, is said by one of the rows
}
