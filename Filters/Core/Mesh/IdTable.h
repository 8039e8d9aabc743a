// SPDX-License-Identifier: BSD-3-Clause
/// @file IdTable.h
/// Numbers for facets or edges, found by the ids of their points.
#ifndef meshopt_Mesh_IdTable_h
#define meshopt_Mesh_IdTable_h

#include "Mesh/Ids.h"

#include <vector>

namespace meshopt
{
/// A hash with open addressing: it is asked with each try, and mostly in vain. The first empty slot
/// then ends the search.
template <std::size_t N>
class IdTable
{
public:
  /// Sorted ids of points.
  using Key = std::array<Index, N>;

  void clear()
  {
    this->slots_.clear();
    this->size_ = 0;
  }
  bool empty() const { return this->size_ == 0; }

  /// The value of a key; null if it has none.
  const double* find(const Key& key) const
  {
    if (this->empty())
    {
      return nullptr;
    }
    const Slot& slot = this->slots_[this->search(key)];
    return slot.key[0] == None ? nullptr : &slot.value;
  }

  /// Gives a new key its value; of a known key, the lesser of both counts.
  void addLeast(const Key& key, double value)
  {
    if (2 * (this->size_ + 1) > this->slots_.size())
    {
      this->grow();
    }
    Slot& slot = this->slots_[this->search(key)];
    this->size_ += slot.key[0] == None;
    slot.value = slot.key[0] == None ? value : std::min(value, slot.value);
    slot.key = key;
  }

private:
  struct Slot
  {
    Key key;
    double value = 0.0;

    Slot() { this->key.fill(None); }
  };

  /// Where the key is, or the empty slot where it would be.
  std::size_t search(const Key& key) const
  {
    const std::size_t mask = this->slots_.size() - 1;
    std::size_t k = hashIds(key) & mask;
    while (this->slots_[k].key[0] != None && this->slots_[k].key != key)
    {
      k = (k + 1) & mask;
    }
    return k;
  }

  void grow()
  {
    constexpr std::size_t fewest = 64;
    std::vector<Slot> old(std::max(fewest, 2 * this->slots_.size()));
    old.swap(this->slots_);
    for (const Slot& slot : old)
    {
      if (slot.key[0] != None)
      {
        this->slots_[this->search(slot.key)] = slot;
      }
    }
  }

  std::vector<Slot> slots_;
  std::size_t size_ = 0;
};
}

#endif
