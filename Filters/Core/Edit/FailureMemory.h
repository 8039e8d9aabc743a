// SPDX-License-Identifier: BSD-3-Clause
/// @file FailureMemory.h
/// Which failures of the past still count: a try that failed, although less was demanded of it,
/// fails again.
#ifndef meshopt_Edit_FailureMemory_h
#define meshopt_Edit_FailureMemory_h

#include <algorithm>
#include <cstdint>
#include <vector>

namespace meshopt
{
/// What changes of a pass must bring, and what they may cost: see the setters of Judge.
struct Demand
{
  double gain;
  int steps;
  double guard;
  bool guardsAll;

  bool operator==(const Demand& o) const
  {
    return this->gain == o.gain && this->steps == o.steps && this->guard == o.guard &&
      this->guardsAll == o.guardsAll;
  }
  /// Whether what fails by the other demand fails by this one, too.
  bool implies(const Demand& o) const
  {
    // Guards at different qualities cannot be compared.
    return this->gain >= o.gain && this->steps <= o.steps &&
      (!o.guardsAll || (this->guardsAll && this->guard == o.guard));
  }
};

/// Remembers until when each demand was made. The times are those of MeshEditor::clock().
class FailureMemory
{
public:
  /// The demand has been made up to now.
  void note(const Demand& demand, std::uint32_t now)
  {
    const auto known = std::find_if(
      this->ends_.begin(), this->ends_.end(), [&](const End& end) { return end.demand == demand; });
    if (known != this->ends_.end())
    {
      known->time = now;
    }
    else
    {
      this->ends_.push_back({ demand, now });
    }
  }
  /// Failures after this time count for the demand.
  std::uint32_t since(const Demand& demand) const
  {
    std::uint32_t time = 0;
    for (const End& end : this->ends_)
    {
      time = demand.implies(end.demand) ? time : std::max(time, end.time);
    }
    return time;
  }

private:
  struct End
  {
    Demand demand;
    std::uint32_t time;
  };
  std::vector<End> ends_; // a handful
};
}

#endif
