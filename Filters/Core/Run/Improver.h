// SPDX-License-Identifier: BSD-3-Clause
/// @file Improver.h
/// What the fast engine does about one bad cell: tries each operation of a list, in order, until one
/// helps.
#ifndef meshopt_Run_Improver_h
#define meshopt_Run_Improver_h

#include "Edit/Judge.h"
#include "Operations/BoundaryChange.h"
#include "Operations/ClusterMotion.h"
#include "Operations/Level.h"
#include "Operations/LookAhead.h"
#include "Operations/NodeInsertion.h"
#include "Operations/NodeMotion.h"
#include "Operations/NodeRemoval.h"
#include "Operations/Reconnect.h"
#include "Operations/Retriangulation.h"

#include <tuple>

namespace meshopt
{
/// The operations of the fast engine in the order in which they are tried: the cheap ones first. Each
/// has
///   static constexpr int level       the least Level at which it is tried
///   static constexpr bool addsCells  left out where no more cells may come
///   static bool isOn(switches)       whether the caller's switches allow it
///   bool improve(judge, t, level)    makes proposals for cell t; true if the judge took one
template <int D, class Shape>
using OperationList = std::tuple<Reconnect<D, Shape>, NodeMotion<D, Shape>, NodeRemoval<D, Shape>,
  BoundaryChange<D, Shape>, ClusterMotion<D, Shape>, Retriangulation<D, Shape>,
  NodeInsertion<D, Shape>, LookAhead<D, Shape>>;

template <int D, class Shape>
class Improver
{
public:
  /// As the Judge's constructor.
  Improver(MeshEditor<D>& editor, const QualityModel<D, Shape>& model, const Switches& switches,
    const Surface<D>* surface = nullptr, const Caps<D>* caps = nullptr)
    : judge_(editor, model, switches, surface, caps)
  {
    // What an insertion spoils is improved by all that this level has, and by motions of clusters.
    std::get<LookAhead<D, Shape>>(this->operations_)
      .setImprove(
        [this](Index t, int level)
        {
          return this->improve(t, level) ||
            (level >= Level::Insertion && this->judge_.switches().moveNodes &&
              std::get<ClusterMotion<D, Shape>>(this->operations_).improve(this->judge_, t, level));
        });
  }
  Improver(const Improver&) = delete;
  Improver& operator=(const Improver&) = delete;

  Judge<D, Shape>& judge() { return this->judge_; }

  /// Tries to improve the neighbourhood of cell t, whose quality is to rise. True if it did; the
  /// judge's changed() are the cells concerned.
  bool improve(Index t, int level)
  {
    this->judge_.start();
    return std::apply([&](auto&... operation) { return (this->attempt(operation, t, level) || ...); },
      this->operations_);
  }

  /// Only changes of the connectivity: edge and face removal at cell t. True if one helped.
  bool swap(Index t)
  {
    this->judge_.start();
    return std::get<Reconnect<D, Shape>>(this->operations_).improve(this->judge_, t, 0);
  }

private:
  template <class Operation>
  bool attempt(Operation& operation, Index t, int level)
  {
    if (level < Operation::level || !Operation::isOn(this->judge_.switches()))
    {
      return false;
    }
    if (Operation::addsCells && this->judge_.growth.left <= 0)
    {
      this->judge_.growth.isShort = true;
      return false;
    }
    return operation.improve(this->judge_, t, level);
  }

  Judge<D, Shape> judge_;
  OperationList<D, Shape> operations_;
};
}

#endif
