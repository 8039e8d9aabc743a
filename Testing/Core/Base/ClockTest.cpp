// SPDX-License-Identifier: BSD-3-Clause
// Progress and the clock: what is told, in which parts, and when a run has to stop.
#include "Base/Clock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

using namespace meshopt;

namespace
{
/// A caller who writes down what is told; asks to stop at the call number `stopAt`.
struct Caller
{
  std::vector<double> told;
  std::vector<std::string> texts;
  Control control;

  explicit Caller(std::size_t stopAt = 0)
  {
    this->control.progress = [this, stopAt](double fraction, const std::string& text)
    {
      this->told.push_back(fraction);
      this->texts.push_back(text);
      return this->told.size() != stopAt;
    };
  }
};

std::string words() { return "words"; }

constexpr double Long = 1e8; // seconds
}

TEST(Progress, TheFirstReportIsToldAtOnce)
{
  Caller caller;
  Progress progress(caller.control);
  EXPECT_TRUE(progress.report(0.25, words));
  EXPECT_EQ(caller.told, std::vector<double>{ 0.25 });
  EXPECT_EQ(caller.texts, std::vector<std::string>{ "words" });
}

TEST(Progress, IsToldAtMostTenTimesASecond)
{
  Caller caller;
  Progress progress(caller.control);
  long made = 0;
  const auto begin = std::chrono::steady_clock::now();
  for (int k = 0; k < 100000; ++k)
  {
    progress.report(1e-5 * k,
      [&made]
      {
        ++made;
        return std::string();
      });
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  EXPECT_LE(static_cast<double>(caller.told.size()), 1.0 + took.count() / 0.1); // whatever it took
  EXPECT_EQ(made, static_cast<long>(caller.told.size())); // no text is made for nothing
}

TEST(Progress, NeverFallsAndEndsAtOne)
{
  Caller caller;
  Progress progress(caller.control);
  for (double fraction : { 0.5, 0.3, 0.6, 1.7, 0.2 })
  {
    progress.expectNews();
    progress.report(fraction, words);
  }
  EXPECT_EQ(caller.told, (std::vector<double>{ 0.5, 0.5, 0.6, 1.0, 1.0 }));
}

TEST(Progress, WhoHasAskedToStopIsNotAskedAgain)
{
  Caller caller(2);
  Progress progress(caller.control);
  EXPECT_TRUE(progress.report(0.1, words));
  EXPECT_FALSE(progress.cancelled());
  progress.expectNews();
  EXPECT_FALSE(progress.report(0.2, words));
  EXPECT_TRUE(progress.cancelled());
  progress.expectNews();
  EXPECT_FALSE(progress.report(0.3, words));
  EXPECT_EQ(caller.told.size(), 2u);
}

TEST(Progress, NobodyNeedListen)
{
  const Control silent;
  Progress progress(silent);
  EXPECT_TRUE(progress.report(0.5,
    []
    {
      ADD_FAILURE() << "a text for nobody";
      return std::string();
    }));
}

TEST(Clock, APartHasItsShareOfTheWhole)
{
  Caller caller;
  Clock clock(caller.control);
  EXPECT_TRUE(clock.goesOn(0.125, words));
  {
    const Clock::Section part(clock, 0.25, 0.75); // each part has news at once
    EXPECT_TRUE(clock.goesOn(0.5, words));
    {
      const Clock::Section inner(clock, 0.5, 1.0); // of the part: 0.5 to 0.75 of the whole
      EXPECT_TRUE(clock.goesOn(0.5, words));
    }
    const Clock::Section rest(clock, 1.0, 1.0);
    EXPECT_TRUE(clock.goesOn(0.3, words));
  }
  const Clock::Section whole(clock, 0.0, 1.0);
  EXPECT_TRUE(clock.goesOn(0.875, words));
  EXPECT_EQ(caller.told, (std::vector<double>{ 0.125, 0.5, 0.625, 0.75, 0.875 }));
}

TEST(Clock, StopsWhenTheTimeIsOver)
{
  Caller caller;
  caller.control.deadline = std::chrono::steady_clock::now();
  Clock clock(caller.control);
  EXPECT_TRUE(clock.isOutOfTime());
  EXPECT_TRUE(clock.hasStopped());
  EXPECT_FALSE(clock.goesOn(0.5, words));
  EXPECT_EQ(caller.told.size(), 1u); // the caller is told all the same
  EXPECT_FALSE(clock.isAborted());
}

TEST(Clock, OneDeadlineForAllThatHaveTheControl)
{
  Control control;
  const Clock before(control);
  control.deadline = std::chrono::steady_clock::now();
  const Clock after(control);
  EXPECT_TRUE(control.isOutOfTime());
  EXPECT_TRUE(before.isOutOfTime());
  EXPECT_TRUE(after.isOutOfTime());
}

TEST(Deadline, CountsFromNow)
{
  const Deadline begin = std::chrono::steady_clock::now();
  const Deadline deadline = deadlineIn(2.5);
  const Deadline end = std::chrono::steady_clock::now();
  EXPECT_GE(deadline - begin, std::chrono::milliseconds(2500));
  EXPECT_LE(deadline - end, std::chrono::milliseconds(2500));
}

TEST(Deadline, IsNoneForWhatNoClockCounts)
{
  for (double seconds : { 0.0, -1.0, std::nan(""), 1e300, std::numeric_limits<double>::infinity() })
  {
    EXPECT_EQ(deadlineIn(seconds), NoDeadline) << seconds;
  }
  EXPECT_NE(deadlineIn(Long), NoDeadline);
}

TEST(Clock, WithoutLimitTimeIsNeverOver)
{
  for (double limit : { 0.0, Long })
  {
    Control silent;
    silent.deadline = deadlineIn(limit);
    Clock clock(silent);
    EXPECT_FALSE(clock.isOutOfTime()) << limit;
    EXPECT_FALSE(clock.hasStopped());
    EXPECT_TRUE(clock.goesOn(0.5, words));
  }
}

TEST(Clock, StopsWhenTheCallerAsks)
{
  Caller caller(1);
  caller.control.deadline = deadlineIn(Long);
  Clock clock(caller.control);
  EXPECT_FALSE(clock.hasStopped());
  EXPECT_FALSE(clock.goesOn(0.0, words));
  EXPECT_TRUE(clock.isAborted());
  EXPECT_TRUE(clock.hasStopped());
  EXPECT_FALSE(clock.isOutOfTime());
}

TEST(Clock, SecondsOnlyGrow)
{
  const Control silent;
  const Clock clock(silent);
  double last = 0.0;
  for (int k = 0; k < 1000; ++k)
  {
    const double now = clock.seconds();
    EXPECT_GE(now, last);
    last = now;
  }
}
