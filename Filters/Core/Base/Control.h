// SPDX-License-Identifier: BSD-3-Clause
/// @file Control.h
/// Progress, cancelling, the deadline and threads: the services of the caller that long work needs.
#ifndef meshopt_Base_Control_h
#define meshopt_Base_Control_h

#include <chrono>
#include <functional>
#include <string>

namespace meshopt
{
/// When the time of a run is over.
using Deadline = std::chrono::steady_clock::time_point;
inline constexpr Deadline NoDeadline = Deadline::max();

/// The time in `seconds` from now; NoDeadline if they are not positive, or above 1e9.
inline Deadline deadlineIn(double seconds)
{
  constexpr double most = 1e9; // thirty years
  if (!(seconds > 0.0) || seconds > most)
  {
    return NoDeadline;
  }
  return std::chrono::steady_clock::now() +
    std::chrono::duration_cast<Deadline::duration>(std::chrono::duration<double>(seconds));
}

/// All of them in one handle.
struct Control
{
  /// Called from the calling thread from time to time, with a fraction in [0, 1] that never falls,
  /// and a short text. Returning false asks to stop. May be empty.
  std::function<bool(double fraction, const std::string& text)> progress;
  /// Runs body(i) for 0 <= i < n, in any order, on several threads. Empty: one after the other.
  std::function<void(int n, const std::function<void(int)>& body)> parallelFor;
  /// All work that has this control ends here, wherever it began. Results are then not
  /// reproducible.
  Deadline deadline = NoDeadline;

  /// May be called by any thread.
  bool isOutOfTime() const
  {
    return this->deadline != NoDeadline && std::chrono::steady_clock::now() >= this->deadline;
  }
};
}

#endif
