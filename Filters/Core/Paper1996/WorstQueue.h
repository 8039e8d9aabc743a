// SPDX-License-Identifier: BSD-3-Clause
/// @file WorstQueue.h
/// Finds the worst cell repeatedly: a heap with lazy deletion.
#ifndef meshopt_Paper1996_WorstQueue_h
#define meshopt_Paper1996_WorstQueue_h

#include "Mesh/SimplexMesh.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace meshopt
{
/// The next cell by (quality, id) among the live cells with a quality under `limit` that the caller
/// says are eligible. It is the one that a scan of all cells would find, if every cell is pushed
/// when its quality changes and when it becomes eligible (again). Entries of the heap are checked
/// when they come to the top. An entry is dropped if its cell is dead, has another quality, or is
/// not eligible. A push costs O(log n), and so does a cell found.
template <int D>
class WorstQueue
{
public:
  WorstQueue(const SimplexMesh<D>& mesh, double limit)
    : mesh_(&mesh)
    , limit_(limit)
  {
  }

  /// Starts with all cells; linear.
  void fill()
  {
    this->heap_.clear();
    this->queued_.assign(this->mesh_->numberOfCellSlots(), NotQueued);
    for (Index c = 0; c < this->mesh_->numberOfCellSlots(); ++c)
    {
      if (this->isCandidate(c))
      {
        this->queued_[c] = this->mesh_->quality(c);
        this->heap_.emplace_back(this->mesh_->quality(c), c);
      }
    }
    std::make_heap(this->heap_.begin(), this->heap_.end(), std::greater<>());
  }

  void push(Index c)
  {
    if (!this->isCandidate(c))
    {
      return;
    }
    if (c >= static_cast<Index>(this->queued_.size()))
    {
      this->queued_.resize(this->mesh_->numberOfCellSlots(), NotQueued);
    }
    const double q = this->mesh_->quality(c);
    if (this->queued_[c] != q)
    {
      this->queued_[c] = q;
      this->heap_.emplace_back(q, c);
      std::push_heap(this->heap_.begin(), this->heap_.end(), std::greater<>());
    }
  }

  /// The worst eligible cell; it stays in the queue. None if there is no such cell.
  template <class Eligible>
  Index worst(Eligible&& eligible)
  {
    while (!this->heap_.empty())
    {
      const auto [q, c] = this->heap_.front();
      if (this->isCandidate(c) && this->mesh_->quality(c) == q && eligible(c))
      {
        return c;
      }
      if (this->queued_[c] == q)
      {
        this->queued_[c] = NotQueued;
      }
      std::pop_heap(this->heap_.begin(), this->heap_.end(), std::greater<>());
      this->heap_.pop_back();
    }
    return None;
  }

private:
  static constexpr double NotQueued = std::numeric_limits<double>::infinity();

  bool isCandidate(Index c) const
  {
    return this->mesh_->isAlive(c) && this->mesh_->quality(c) < this->limit_;
  }

  const SimplexMesh<D>* mesh_;
  double limit_;
  std::vector<std::pair<double, Index>> heap_;
  std::vector<double> queued_; // per cell: quality of its last push, if still queued
};
}

#endif
