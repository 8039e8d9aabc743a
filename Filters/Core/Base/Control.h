// SPDX-License-Identifier: BSD-3-Clause
/// @file Control.h
/// Progress, cancelling and threads: the services of the caller that long work needs.
#ifndef meshopt_Base_Control_h
#define meshopt_Base_Control_h

#include <functional>
#include <string>

namespace meshopt
{
/// Progress, cancelling and threads in one handle.
struct Control
{
  /// Called from the calling thread from time to time, with a fraction in [0, 1] that never falls,
  /// and a short text. Returning false asks to stop. May be empty.
  std::function<bool(double fraction, const std::string& text)> progress;
  /// Runs body(i) for 0 <= i < n, in any order, on several threads. Empty: one after the other.
  std::function<void(int n, const std::function<void(int)>& body)> parallelFor;
};
}

#endif
