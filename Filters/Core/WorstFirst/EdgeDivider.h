// SPDX-License-Identifier: BSD-3-Clause
/// @file EdgeDivider.h
/// Division of one edge in its middle, as part of many that together make a mesh better.
#ifndef meshopt_WorstFirst_EdgeDivider_h
#define meshopt_WorstFirst_EdgeDivider_h

#include "Edit/Judge.h"
#include "Quality/Shape.h"
#include "Run/Run.h"

namespace meshopt
{
/// Divides edges inside, and those of a surface that takes part; what is kept stays. Stored
/// qualities are shapes (MeanEdgeShape) until record(), whatever the caller measures.
class EdgeDivider
{
public:
  using Shape = MeanEdgeShape<3>;

  /// Collects the cells whose quality, of the caller's measure, is under `below`. The growth of the
  /// run limits the divisions. `run` must outlive this object.
  EdgeDivider(Run<3>& run, double below);
  EdgeDivider(const EdgeDivider&) = delete; // its parts know each other
  EdgeDivider& operator=(const EdgeDivider&) = delete;

  const SimplexMesh<3>& mesh() const { return this->run_.mesh(); }
  Judge<3, Shape>& judge() { return this->judge_; }
  /// By their ids.
  const std::vector<Index>& bad() const { return this->bad_; }

  /// Where the new point of an edge of the surface is sought first; then at the other place.
  enum class Where
  {
    Surface, ///< on the surface of before, which the edge stands for
    Edge     ///< in the middle of the edge, whose ends may have left that surface for better cells
  };
  /// Divides the edge from a to b of cell c. The qualities around it may fall, but no cell is
  /// inverted. Returns the new point; None if the edge has to stay.
  Index divide(Index c, Index a, Index b, Where where);

  /// Computes the qualities in the caller's measure again; with `isRow` adds a row to the history.
  void record(const std::string& stage, bool isRow);

private:
  struct Edge
  {
    Index cell, a, b;
  };
  bool findPatch(const Edge& edge, Index& patch, bool& isKept);
  Index divideAt(const Edge& edge, const Vec<3>& x, const Place& place);

  Run<3>& run_;
  QualityModel<3, Shape> model_;
  Judge<3, Shape> judge_;
  Proposal<3> proposal_;
  std::vector<Index> bad_, ring_;
};
}

#endif
