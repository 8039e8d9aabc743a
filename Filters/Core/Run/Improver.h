// SPDX-License-Identifier: BSD-3-Clause
/// @file Improver.h
/// What the fast engine does about one bad cell: it tries the operations of a list, in order, until
/// one helps.
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
#include "Operations/SurfaceMotion.h"
#include "Operations/WideInsertion.h"

#include <tuple>

namespace meshopt
{
/// The operations of the fast engine in the order in which they are tried: mostly the cheap ones
/// first. Wide insertion is not cheap, but where it is tried it gains several times as much for its
/// time as motion of clusters or retriangulation: in slabs of some thousand random points a
/// quick run that tries it after these ends clearly lower.
/// Each has
///   static constexpr int level       the lowest Level at which it is tried
///   static constexpr bool addsCells  skipped when the growth budget is used up
///   static bool isOn(switches)       whether the caller's switches allow it
///   bool improve(judge, t, level)    makes proposals for cell t; true if the judge accepted one
template <int D, class Shape>
using OperationList = std::tuple<Reconnect<D, Shape>, NodeMotion<D, Shape>, NodeRemoval<D, Shape>,
  BoundaryChange<D, Shape>, WideInsertion<D, Shape>, ClusterMotion<D, Shape>,
  Retriangulation<D, Shape>, NodeInsertion<D, Shape>, SurfaceMotion<D, Shape>, LookAhead<D, Shape>>;

template <int D, class Shape>
class Improver
{
public:
  /// Parameters: see Judge.
  Improver(MeshEditor<D>& editor, const QualityModel<D, Shape>& model, const Switches& switches,
    const Surface<D>* surface = nullptr, const Caps<D>* caps = nullptr);
  Improver(const Improver&) = delete;
  Improver& operator=(const Improver&) = delete;

  Judge<D, Shape>& judge() { return this->judge_; }

  /// Tries to improve the neighbourhood of cell t, so that its quality rises. True on success; the
  /// judge's changed() then lists the cells concerned.
  bool improve(Index t, int level);

  /// Tries only changes of connectivity at cell t: edge and face removal. True if one helped.
  bool swap(Index t);

private:
  template <class Operation>
  bool attempt(Operation& operation, Index t, int level)
  {
    if (level < Operation::level || !Operation::isOn(this->judge_.switches()))
    {
      return false;
    }
    // Noted for the report: the run may end because of the budget, not because nothing helps.
    if (Operation::addsCells && !this->judge_.mayAddCells(1))
    {
      return false;
    }
    return operation.improve(this->judge_, t, level);
  }

  Judge<D, Shape> judge_;
  OperationList<D, Shape> operations_;
};

template <int D, class Shape>
Improver<D, Shape>::Improver(MeshEditor<D>& editor, const QualityModel<D, Shape>& model,
  const Switches& switches, const Surface<D>* surface, const Caps<D>* caps)
  : judge_(editor, model, switches, surface, caps)
{
  // The cells that an insertion made worse are improved by all operations of this level. Motion
  // of clusters has a higher level of its own, but here it is tried from Level::Insertion on.
  std::get<LookAhead<D, Shape>>(this->operations_)
    .setImprove(
      [this](Index t, int level)
      {
        return this->improve(t, level) ||
          (level >= Level::Insertion && this->judge_.switches().moveNodes &&
            (std::get<SurfaceMotion<D, Shape>>(this->operations_).improve(this->judge_, t, level) ||
              std::get<ClusterMotion<D, Shape>>(this->operations_)
                .improve(this->judge_, t, level)));
      });
}

template <int D, class Shape>
bool Improver<D, Shape>::improve(Index t, int level)
{
  this->judge_.start();
  return std::apply([&](auto&... operation) { return (this->attempt(operation, t, level) || ...); },
    this->operations_);
}

template <int D, class Shape>
bool Improver<D, Shape>::swap(Index t)
{
  this->judge_.start();
  return std::get<Reconnect<D, Shape>>(this->operations_).improve(this->judge_, t, 0);
}

// The size stage uses these, too. Compiled once, with the part of the engine that they belong to.
extern template class Improver<2, MeanEdgeShape<2>>;
extern template class Improver<3, MeanEdgeShape<3>>;
}

#endif
