// SPDX-License-Identifier: BSD-3-Clause
/// @file Proposal.h
/// What an operation wants to do: nothing has happened yet.
#ifndef meshopt_Edit_Proposal_h
#define meshopt_Edit_Proposal_h

#include "Mesh/MeshEditor.h"

#include <limits>
#include <vector>

namespace meshopt
{
/// Either cells come for those of the cavity; or, if there are `moves`, nodes move and the cells stay.
/// New points have been added to the mesh, within a transaction; no cell uses them yet.
template <int D>
struct Proposal
{
  /// A quality that every other is above.
  static constexpr double Never = -std::numeric_limits<double>::infinity();

  struct Move
  {
    Index point;
    Vec<D> x;
    Place place; ///< on the surface, if the point slides
  };

  std::vector<Index> cavity;      ///< cells that go; with moves: all cells around the nodes
  std::vector<Simplex<D>> cells;  ///< cells that come
  std::vector<double> qualities;  ///< of the cells in the end, if they are known already; else empty
  std::vector<Move> moves;
  KeptChange<D> kept; ///< regions always, the rest if changesKept
  bool changesKept = false;

  double oldWorst = 0.0; ///< least quality in the cavity
  double newWorst = 0.0; ///< of what comes; what a search found may differ from it by rounding
  double least = Never;  ///< what comes has to be better than this
  bool keepsPositive = false; ///< with moves: no cell of positive quality may lose that

  void clear()
  {
    this->cavity.clear();
    this->cells.clear();
    this->qualities.clear();
    this->moves.clear();
    this->kept.clear();
    this->changesKept = this->keepsPositive = false;
    this->oldWorst = this->newWorst = 0.0;
    this->least = Never;
  }
  const KeptChange<D>* keptChange() const { return this->changesKept ? &this->kept : nullptr; }
  /// Net number of cells that it brings.
  long growth() const
  {
    return this->moves.empty()
      ? static_cast<long>(this->cells.size()) - static_cast<long>(this->cavity.size())
      : 0;
  }
};
}

#endif
