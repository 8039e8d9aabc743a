// SPDX-License-Identifier: BSD-3-Clause
/// @file Clock.h
/// Whether a run continues: progress, abort and deadline in one place.
#ifndef meshopt_Base_Clock_h
#define meshopt_Base_Clock_h

#include "Base/Progress.h"

namespace meshopt
{
/// Starts when it is constructed. Reports progress to the caller at most about ten times a second;
/// the caller may then ask to stop. No result depends on the clock unless it stops the run.
class Clock
{
public:
  /// The control must outlive the clock.
  explicit Clock(const Control& control)
    : control_(&control)
    , progress_(control)
  {
  }

  /// Reports progress. `fraction`, in [0, 1], is that of the current section; `text` is a callable
  /// that makes a sentence about it. Returns false once the caller has asked to stop or the time is
  /// over.
  template <class Text>
  bool goesOn(double fraction, Text&& text)
  {
    const double done = this->first_ + fraction * (this->last_ - this->first_);
    return this->progress_.report(done, text) && !this->isOutOfTime();
  }
  bool isAborted() const { return this->progress_.cancelled(); }
  /// May be called by any thread.
  bool isOutOfTime() const { return this->control_->isOutOfTime(); }
  bool hasStopped() const { return this->isAborted() || this->isOutOfTime(); }
  /// Since the construction of the clock.
  double seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - this->begin_).count();
  }

  /// While it exists, fractions refer to a section of the work: from `first` to `last` of the
  /// enclosing section.
  class Section
  {
  public:
    Section(Clock& clock, double first, double last)
      : clock_(clock)
      , first_(clock.first_)
      , last_(clock.last_)
    {
      clock.first_ = this->first_ + first * (this->last_ - this->first_);
      clock.last_ = this->first_ + last * (this->last_ - this->first_);
      clock.progress_.expectNews();
    }
    Section(const Section&) = delete;
    Section& operator=(const Section&) = delete;
    ~Section()
    {
      this->clock_.first_ = this->first_;
      this->clock_.last_ = this->last_;
    }

  private:
    Clock& clock_;
    double first_, last_;
  };

private:
  const Control* control_;
  Progress progress_;
  double first_ = 0.0, last_ = 1.0; // the current section
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};
}

#endif
