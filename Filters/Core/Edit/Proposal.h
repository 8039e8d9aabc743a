// SPDX-License-Identifier: BSD-3-Clause
/// @file Proposal.h
/// A change that an operation proposes; nothing has been changed yet.
#ifndef meshopt_Edit_Proposal_h
#define meshopt_Edit_Proposal_h

#include "Mesh/MeshEditor.h"

#include <limits>
#include <vector>

namespace meshopt
{
/// Either `cells` replace those of the cavity; or, if there are `moves`, nodes move and the cells
/// stay. New points have already been added to the mesh, within a transaction, but no cell uses
/// them yet.
template <int D>
struct Proposal
{
  /// A value below every quality.
  static constexpr double Never = -std::numeric_limits<double>::infinity();

  struct Move
  {
    Index point;
    Vec<D> x;
    Place place; ///< on the surface, if the point slides
  };

  std::vector<Index> cavity;     ///< cells that vanish; with moves: all cells around the nodes
  std::vector<Simplex<D>> cells; ///< the new cells
  std::vector<double> qualities; ///< final qualities of the cells, if already known; else empty
  std::vector<Move> moves;
  KeptChange<D> kept; ///< used only if changesKept
  bool changesKept = false;

  double oldWorst = 0.0;      ///< least quality in the cavity
  double newWorst = 0.0;      ///< of the new cells; a search may give it with rounding errors
  double least = Never;       ///< the new cells must be better than this
  double leastFound = Never;  ///< with moves: newWorst must be better than this
  bool keepsPositive = false; ///< with moves: no cell with positive quality may lose it

  void clear()
  {
    this->cavity.clear();
    this->cells.clear();
    this->qualities.clear();
    this->moves.clear();
    this->kept.clear();
    this->changesKept = this->keepsPositive = false;
    this->oldWorst = this->newWorst = 0.0;
    this->least = this->leastFound = Never;
  }
  const KeptChange<D>* keptChange() const { return this->changesKept ? &this->kept : nullptr; }
  /// Net number of cells that it adds.
  long growth() const
  {
    return this->moves.empty()
      ? static_cast<long>(this->cells.size()) - static_cast<long>(this->cavity.size())
      : 0;
  }
};
}

#endif
