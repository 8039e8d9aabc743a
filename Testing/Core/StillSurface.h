// SPDX-License-Identifier: BSD-3-Clause
// A surface on which nothing slides, for tests that need one.
#ifndef meshopt_Testing_StillSurface_h
#define meshopt_Testing_StillSurface_h

#include "Surface/Surface.h"

namespace meshopt
{
/// Nothing slides on it. What matters is that it takes part, and whether it judges changes.
template <int D>
class StillSurface : public Surface<D>
{
public:
  explicit StillSurface(bool judges = false)
    : judges_(judges)
  {
  }
  Vec<D> at(Index, double) const override { return Vec<D>::Zero(); }
  Place project(const Place& place, const Vec<D>& x, Vec<D>& there) const override
  {
    there = x;
    return place;
  }
  int tangents(
    const SimplexMesh<D>&, const std::vector<Index>&, Index, std::array<Vec<D>, D>&) const override
  {
    return 0;
  }
  std::optional<Span> span(const SimplexMesh<D>&, Index, Index) const override { return {}; }
  std::optional<SlidingRange> range(
    const SimplexMesh<D>&, const std::vector<Index>&, Index) const override
  {
    return {};
  }
  bool mayDivide(const SimplexMesh<D>&, const std::vector<Index>&, Index, Index) const override
  {
    return false;
  }
  bool maySwap(const SimplexMesh<D>&, Index, Index) const override { return false; }
  bool mayJoin(const SimplexMesh<D>&, const std::vector<Index>&, Index, Index) const override
  {
    return false;
  }
  bool judgesChanges() const override { return this->judges_; }

private:
  bool judges_;
};
}

#endif
