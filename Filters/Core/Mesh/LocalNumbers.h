// SPDX-License-Identifier: BSD-3-Clause
/// @file LocalNumbers.h
/// Local numbers 0, 1, 2, ... for a few points or cells, in the order of their first use.
#ifndef meshopt_Mesh_LocalNumbers_h
#define meshopt_Mesh_LocalNumbers_h

#include "Mesh/Types.h"

#include <vector>

namespace meshopt
{
/// A hash with open addressing that is emptied in O(1): entries of an earlier time count as empty.
class LocalNumbers
{
public:
  LocalNumbers() { this->slots_.resize(256); }

  void clear()
  {
    ++this->time_;
    this->size_ = 0;
  }
  int size() const { return this->size_; }

  /// The number of p; a new one (== size() before the call) if p was not seen since clear().
  int add(Index p)
  {
    if (2 * (this->size_ + 1) > static_cast<int>(this->slots_.size()))
    {
      this->grow();
    }
    Slot& s = this->find(p);
    if (s.time != this->time_)
    {
      s = { this->time_, p, this->size_++ };
    }
    return s.number;
  }

  /// The number of p, or -1.
  int get(Index p)
  {
    const Slot& s = this->find(p);
    return s.time == this->time_ ? s.number : -1;
  }

private:
  struct Slot
  {
    std::uint64_t time = 0;
    Index point = None;
    int number = -1;
  };

  Slot& find(Index p)
  {
    const std::size_t mask = this->slots_.size() - 1;
    // Fibonacci hashing: ids of neighbours are near each other, and the upper bits of the product
    // spread them.
    std::size_t k = (std::uint32_t(p) * 2654435761u >> 9) & mask;
    while (this->slots_[k].time == this->time_ && this->slots_[k].point != p)
    {
      k = (k + 1) & mask;
    }
    return this->slots_[k];
  }

  void grow()
  {
    // Entries of an earlier time are not taken over.
    std::vector<Slot> old(2 * this->slots_.size());
    old.swap(this->slots_);
    for (const Slot& s : old)
    {
      if (s.time == this->time_)
      {
        this->find(s.point) = s;
      }
    }
  }

  std::vector<Slot> slots_;
  std::uint64_t time_ = 1;
  int size_ = 0;
};
}

#endif
