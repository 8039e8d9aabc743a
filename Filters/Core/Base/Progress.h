// SPDX-License-Identifier: BSD-3-Clause
/// @file Progress.h
/// Progress that never falls, at a sensible rate, and cancelling.
#ifndef meshopt_Base_Progress_h
#define meshopt_Base_Progress_h

#include "Base/Control.h"

#include <algorithm>
#include <chrono>

namespace meshopt
{
/// Stands between an algorithm, which reports as often as it likes, and the caller's Control, which
/// is called at most about ten times a second. The clock only spaces the calls; no result depends
/// on it unless the caller cancels.
class Progress
{
public:
  explicit Progress(const Control& control)
    : control_(&control)
    , last_(Clock::now())
  {
  }

  /// Calls the caller if it is time. `fraction` is in [0, 1]; `text` is a callable that makes the
  /// text. Returns false once the caller has asked to stop.
  template <class Text>
  bool report(double fraction, Text&& text)
  {
    if (this->cancelled_ || !this->control_->progress)
    {
      return !this->cancelled_;
    }
    const auto now = Clock::now();
    if (this->first_ || now - this->last_ >= std::chrono::milliseconds(100))
    {
      this->first_ = false;
      this->fraction_ = std::max(this->fraction_, std::min(1.0, fraction));
      this->cancelled_ = !this->control_->progress(this->fraction_, text());
      // Measured after the call: a slow caller must not be called without pause.
      this->last_ = Clock::now();
    }
    return !this->cancelled_;
  }
  bool cancelled() const { return this->cancelled_; }
  /// The next report is passed on at once, since other work begins.
  void expectNews() { this->first_ = true; }

private:
  using Clock = std::chrono::steady_clock;
  const Control* control_;
  Clock::time_point last_;
  double fraction_ = 0.0;
  bool first_ = true;
  bool cancelled_ = false;
};
}

#endif
