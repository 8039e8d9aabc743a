// SPDX-License-Identifier: BSD-3-Clause
/// @file IdFilter.h
/// Says of most groups of ids that they are not in a table, without a look into the table.
#ifndef meshopt_Mesh_IdFilter_h
#define meshopt_Mesh_IdFilter_h

#include "Mesh/Types.h"

#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

namespace meshopt
{
/// A set of groups of N ids that may say yes where no is true, but never no where yes is (Bloom).
/// Each id has one bit for each of 64 kinds of groups; the kind of a group is taken from the sum of
/// its ids, so that their order does not matter.
class IdFilter
{
public:
  void clear() { this->kinds_.clear(); }
  bool empty() const { return this->kinds_.empty(); }

  /// `numberOfIds`: more than any id of a group that is ever added.
  template <std::size_t N>
  void add(const std::array<Index, N>& ids, std::size_t numberOfIds)
  {
    this->kinds_.resize(numberOfIds, 0);
    const std::uint64_t kind = kindOf(std::accumulate(ids.begin(), ids.end(), std::int64_t(0)));
    for (Index id : ids)
    {
      this->kinds_[id] |= kind;
    }
  }

  /// False: the group was never added. True: it may have been. Any order of the ids.
  template <std::size_t N>
  bool mayHave(const std::array<Index, N>& ids) const
  {
    std::uint64_t common = ~std::uint64_t(0);
    std::int64_t sum = 0;
    for (Index id : ids)
    {
      common &= this->kindsAt(id);
      sum += id;
    }
    return (common & kindOf(sum)) != 0;
  }

  /// The same for the ids without each one of them in turn: bit i of the result is for those
  /// without ids[i].
  template <std::size_t N>
  unsigned mayHaveWithoutOne(const std::array<Index, N>& ids) const
  {
    std::array<std::uint64_t, N> kinds;
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < N; ++i)
    {
      kinds[i] = this->kindsAt(ids[i]);
      sum += ids[i];
    }
    unsigned result = 0;
    for (std::size_t i = 0; i < N; ++i)
    {
      std::uint64_t common = kindOf(sum - ids[i]);
      for (std::size_t k = 0; k < N; ++k)
      {
        common &= k == i ? common : kinds[k];
      }
      result |= unsigned(common != 0) << i;
    }
    return result;
  }

private:
  /// One of 64 bits: the first six of the product with the golden ratio (Knuth).
  static std::uint64_t kindOf(std::int64_t sum)
  {
    return std::uint64_t(1) << (static_cast<std::uint64_t>(sum) * 0x9E3779B97F4A7C15u >> 58);
  }
  /// Points that are new since are in no group.
  std::uint64_t kindsAt(Index id) const
  {
    return static_cast<std::size_t>(id) < this->kinds_.size() ? this->kinds_[id] : 0;
  }

  std::vector<std::uint64_t> kinds_; ///< by id
};
}

#endif
