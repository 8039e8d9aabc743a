// SPDX-License-Identifier: BSD-3-Clause
// Options: the ends of each range, which are taken or not, and budgets in cells.
#include "Run/Options.h"

#include "Mesh/Types.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace meshopt;

namespace
{
constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double Least = std::numeric_limits<double>::denorm_min();
const double BelowZero = -Least, AboveOne = std::nextafter(1.0, 2.0);
const double BelowOne = std::nextafter(1.0, 0.0);

/// What an option may be and what not, and a word of the sentence that says so.
struct Range
{
  double Options::*option;
  const char* word;
  std::vector<double> good, bad; ///< NaN is bad in any case
};
}

TEST(Options, NumbersWithinTheirRangesOnly)
{
  EXPECT_EQ(Options().check(false), "");
  const std::vector<Range> ranges{
    { &Options::targetQuality, "target", { Least, 0.5, 1.0 }, { 0.0, BelowZero, AboveOne } },
    { &Options::beta, "beta", { 0.0, 1e300 }, { BelowZero, Infinity } },
    { &Options::desiredSize, "size", { 0.0, 1e300 }, { BelowZero, Infinity } },
    { &Options::epsilon, "epsilon", { Least, 1.0 }, { 0.0, BelowZero, AboveOne } },
    { &Options::armijo, "Armijo", { Least, BelowOne }, { 0.0, 1.0, Infinity } },
    { &Options::growthBudget, "growth", { 0.0, 1e300 }, { BelowZero, Infinity } },
  };
  for (const Range& range : ranges)
  {
    const auto check = [&](double value)
    {
      Options options;
      options.*range.option = value;
      return options.check(true);
    };
    for (double value : range.good)
    {
      EXPECT_EQ(check(value), "") << range.word << " " << value;
    }
    std::vector<double> bad = range.bad;
    bad.push_back(std::nan(""));
    for (double value : bad)
    {
      const std::string text = check(value);
      EXPECT_NE(text.find(range.word), std::string::npos) << value << ": '" << text << "'";
    }
  }
}

TEST(Options, WholeNumbersWithinTheirRangesOnly)
{
  const auto refused = [](auto change)
  {
    Options options;
    change(options);
    return !options.check(false).empty();
  };
  EXPECT_FALSE(refused([](Options& o) { o.neighborhoodLevel = 0; }));
  EXPECT_TRUE(refused([](Options& o) { o.neighborhoodLevel = -1; }));
  EXPECT_FALSE(refused([](Options& o) { o.maximumNumberOfIterations = 0; }));
  EXPECT_TRUE(refused([](Options& o) { o.maximumNumberOfIterations = -1; }));
  EXPECT_FALSE(refused([](Options& o) { o.maximumNumberOfAlternations = 1; }));
  EXPECT_TRUE(refused([](Options& o) { o.maximumNumberOfAlternations = 0; }));
  for (int k = -1; k <= 3; ++k)
  {
    EXPECT_EQ(refused([=](Options& o) { o.effort = static_cast<Effort>(k); }), k < 0 || k > 2);
    EXPECT_EQ(
      refused([=](Options& o) { o.algorithm = static_cast<Algorithm>(k); }), k < 0 || k > 1);
  }
  for (int k = -1; k <= numberOfMeasures(); ++k)
  {
    // Minimum Dihedral Angle is there to be reported.
    const bool isGood = isMeasure(k) && static_cast<Measure>(k) != Measure::MinimumDihedralAngle;
    EXPECT_EQ(refused([=](Options& o) { o.measure = static_cast<Measure>(k); }), !isGood) << k;
  }
}

/// The size factor needs a size: one for all, or sizes at the points.
TEST(Options, BetaNeedsASize)
{
  for (const double beta : { 0.0, 0.5 })
  {
    for (const double size : { 0.0, 0.1 })
    {
      for (const bool hasSizes : { false, true })
      {
        Options options;
        options.beta = beta;
        options.desiredSize = size;
        EXPECT_EQ(options.check(hasSizes).empty(), beta == 0.0 || size > 0.0 || hasSizes);
      }
    }
  }
}

/// Options of the other algorithm count, too: it may be chosen later, and then nothing may be new.
TEST(Options, AreCheckedWhateverTheAlgorithm)
{
  Options paper, engine;
  paper.algorithm = Algorithm::Paper1996;
  paper.growthBudget = -1.0;
  EXPECT_NE(paper.check(false), "");
  engine.epsilon = -1.0;
  EXPECT_NE(engine.check(false), "");
}

TEST(Options, TheFirstOfTwoFaultsIsNamed)
{
  Options one, both;
  one.beta = both.beta = both.growthBudget = -1.0;
  EXPECT_EQ(both.check(false), one.check(false));
}

/// The budget rounded down, but at least 30 cells in space and 10 in the plane; 0 is 0.
TEST(Options, GrowthInCells)
{
  const std::vector<long> counts{ 0, 1, 99, 100, 101, 299, 300, 309, 310, 10007 };
  for (const int dimension : { 2, 3 })
  {
    for (const long cells : counts)
    {
      Options options;
      options.growthBudget = 0.1;
      EXPECT_EQ(growthOf(options, cells, dimension),
        std::max(dimension == 2 ? 10L : 30L, cells / 10)); // of whole numbers: rounded down
      options.growthBudget = 2.0;
      EXPECT_EQ(
        growthOf(options, cells, dimension), std::max(dimension == 2 ? 10L : 30L, 2 * cells));
      options.growthBudget = 0.0;
      EXPECT_EQ(growthOf(options, cells, dimension), 0);
      for (const long most : { 0L, 7L, 100000L }) // of a part of a mesh, whatever its size
      {
        options.growthBudget = 0.1;
        options.mostGrowth = most;
        EXPECT_EQ(growthOf(options, cells, dimension), most);
      }
    }
  }
}

/// Ids run out at 2^29 cells, whatever the budget is.
TEST(Options, RoomToGrowIsHalfOfTheIdsThatAreLeft)
{
  EXPECT_EQ(roomToGrow(0), 1L << 28);
  EXPECT_EQ(roomToGrow(MaximumNumberOfCells - 100), 50);
  EXPECT_EQ(roomToGrow(MaximumNumberOfCells - 1), 0);
  EXPECT_EQ(roomToGrow(MaximumNumberOfCells), 0);
  EXPECT_EQ(roomToGrow(MaximumNumberOfCells + 1000), 0);
}
