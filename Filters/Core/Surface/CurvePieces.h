// SPDX-License-Identifier: BSD-3-Clause
/// @file CurvePieces.h
/// The pieces of curves that nodes slide along, from corner to corner: which piece joins two nodes.
#ifndef meshopt_Surface_CurvePieces_h
#define meshopt_Surface_CurvePieces_h

#include "Mesh/Place.h"
#include "Surface/Surface.h"

#include <map>
#include <optional>
#include <set>
#include <vector>

namespace meshopt
{
struct CurvePiece
{
  Index curve = None;                      ///< None: neighbours on it are on no curve
  std::array<Index, 2> ends{ None, None }; ///< points of the mesh; None: closed
  std::array<double, 2> range{ 0.0, 0.0 }; ///< parameters of the ends
  double period = 0.0;                     ///< of a closed piece
  bool isEdge = false;                     ///< one edge of the input, from end to end
  bool mayVanish = false;                  ///< its ends may become one point
};

/// Pieces are what Surface calls the parts of points on curves.
class CurvePieces
{
public:
  void clear() { this->pieces_.clear(); }
  void add(const CurvePiece& piece) { this->pieces_.push_back(piece); }
  /// To be called after the last piece has been added.
  void join();

  std::size_t size() const { return this->pieces_.size(); }
  const CurvePiece& operator[](Index k) const { return this->pieces_[k]; }

  /// The span from point a to point b, whose places are given. Empty if they are on no common
  /// piece. Two corners that several pieces join are neighbours only on the one that was an edge of
  /// the input.
  std::optional<Span> span(Index a, const Place& placeOfA, Index b, const Place& placeOfB) const;

  /// Whether corner a may become one with b, as the ends of a piece that may vanish. Then b stands
  /// for both: it is an end of the pieces of both. A corner has one partner at most. b has other
  /// pieces, and no third corner (nor a pair of corners) has pieces to both: so it stays clear
  /// which piece an edge is on.
  bool mayBecomeOne(Index a, Index b) const
  {
    return a != b && this->partner(a) == b && this->tips_.count(b) == 0;
  }
  /// The corner without other pieces that may become one with this one; None if there is none.
  Index tipAt(Index corner) const
  {
    const Index other = this->partner(corner);
    return this->tips_.count(other) > 0 ? other : None;
  }

  /// Whether two neighbours on the piece may be this far apart. Not if it would no longer be clear
  /// which way round a closed piece is meant.
  bool mayBeNeighbours(const Span& s) const;

private:
  void joinCorners();
  Index partner(Index corner) const
  {
    const auto found = this->partners_.find(corner);
    return found == this->partners_.end() ? None : found->second;
  }

  std::vector<CurvePiece> pieces_;
  std::map<Index, Index> partners_; ///< of corners that may become one
  std::set<Index> tips_;            ///< those of them that have no other piece
  /// The piece on which two corners may be neighbours. If several pieces join them, it is the one
  /// that was an edge of the input: there is at most one, and the others never become an edge.
  std::map<std::array<Index, 2>, Index> betweenCorners_;
};
}

#endif
