// SPDX-License-Identifier: BSD-3-Clause
/// @file Evaluations.h
/// Counts how many qualities (and gradients of qualities) are computed: what a run costs, whatever
/// the machine and whatever runs beside it.
#ifndef meshopt_Quality_Evaluations_h
#define meshopt_Quality_Evaluations_h

#include <cstdint>

namespace meshopt
{
/// Of this thread. The searches add to it where they compute qualities: a parameter would have to
/// pass through all of them. With this model an access costs one instruction, also in a shared
/// library.
[[gnu::tls_model("initial-exec")]] inline thread_local std::int64_t evaluationsOfThread = 0;

/// Counts what the thread that made it has computed since. take() ends the count, and hides it from
/// counts that began earlier: work on several threads is summed up in the same way as on one.
class EvaluationCount
{
public:
  std::int64_t get() const { return evaluationsOfThread - this->before_; }
  std::int64_t take()
  {
    const std::int64_t count = this->get();
    evaluationsOfThread = this->before_;
    return count;
  }

private:
  std::int64_t before_ = evaluationsOfThread;
};
}

#endif
