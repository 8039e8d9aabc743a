// SPDX-License-Identifier: BSD-3-Clause
/// @file Control.h
/// Progress, cancelling and threads of the caller: what long work needs of its surroundings.
#ifndef meshopt_Base_Control_h
#define meshopt_Base_Control_h

#include <functional>
#include <string>

namespace meshopt
{
/// Progress and cancelling in one handle.
struct Control
{
  /// Called from the calling thread now and then with a fraction in [0, 1], never falling, and a
  /// short text; false asks to stop. May be empty.
  std::function<bool(double fraction, const std::string& text)> progress;
  /// Runs body(i) for 0 <= i < n, in any order, on several threads. Empty: one after another.
  std::function<void(int n, const std::function<void(int)>& body)> parallelFor;
};
}

#endif
