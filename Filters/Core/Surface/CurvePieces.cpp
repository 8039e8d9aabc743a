// SPDX-License-Identifier: BSD-3-Clause
// Which piece of curve an edge is on. Places tell this for all nodes but corners, which several
// pieces share.
#include "Surface/CurvePieces.h"

#include <algorithm>
#include <cmath>

namespace meshopt
{
namespace
{
constexpr double FarthestNeighbours = 0.4; ///< of a closed curve
}

/// Finds the pieces on which two corners can be neighbours.
void CurvePieces::join()
{
  this->betweenCorners_.clear();
  this->partners_.clear();
  this->tips_.clear();
  this->joinCorners();
  for (std::size_t k = 0; k < this->pieces_.size(); ++k)
  {
    std::array<Index, 2> ends = this->pieces_[k].ends;
    std::sort(ends.begin(), ends.end());
    if (ends[0] != None && ends[0] != ends[1])
    {
      const auto [entry, isNew] = this->betweenCorners_.emplace(ends, static_cast<Index>(k));
      if (!isNew)
      {
        // Of several pieces it is not known which one an edge is on, unless one piece is a single
        // edge.
        const Index other = entry->second;
        const bool otherIsEdge = other != None && this->pieces_[other].isEdge;
        entry->second = this->pieces_[k].isEdge ? static_cast<Index>(k)
          : otherIsEdge                         ? other
                                                : None;
      }
    }
  }
}

/// Greedily, in the order of the pieces.
void CurvePieces::joinCorners()
{
  std::map<Index, std::vector<Index>> piecesAt;
  for (std::size_t k = 0; k < this->pieces_.size(); ++k)
  {
    for (Index end : this->pieces_[k].ends)
    {
      piecesAt[end].push_back(static_cast<Index>(k));
    }
  }
  // Partners count as one corner.
  const auto name = [&](Index corner)
  {
    const Index other = this->partner(corner);
    return other == None ? corner : std::min(corner, other);
  };
  for (std::size_t k = 0; k < this->pieces_.size(); ++k)
  {
    const auto [a, b] = this->pieces_[k].ends;
    if (!this->pieces_[k].mayVanish || this->partners_.count(a) + this->partners_.count(b) > 0)
    {
      continue;
    }
    std::vector<Index> far[2]; // where their other pieces lead to
    bool isClear = true;
    for (Index end : { a, b })
    {
      for (Index other : piecesAt[end])
      {
        const std::array<Index, 2>& ends = this->pieces_[other].ends;
        const Index there = ends[0] == end ? ends[1] : ends[0];
        const bool isOther = other != static_cast<Index>(k);
        isClear = isClear && (!isOther || (there != a && there != b));
        if (isOther)
        {
          far[end == b].push_back(name(there));
        }
      }
    }
    for (Index there : far[0])
    {
      isClear = isClear && std::find(far[1].begin(), far[1].end(), there) == far[1].end();
    }
    if (!isClear || (far[0].empty() && far[1].empty()))
    {
      continue;
    }
    this->partners_[a] = b;
    this->partners_[b] = a;
    for (int i = 0; i < 2; ++i)
    {
      if (far[i].empty())
      {
        this->tips_.insert(i == 0 ? a : b);
      }
    }
  }
}

/// Two corners are on no curve themselves: join() has found the piece between them. If one of them
/// is no end of a piece, its partner may be.
std::optional<Span> CurvePieces::span(Index a, const Place& pa, Index b, const Place& pb) const
{
  const auto isOnCurve = [](const Place& place) { return place.freedom == Freedom::Curve; };
  if (!isOnCurve(pa) && !isOnCurve(pb))
  {
    for (Index p : { a, this->partner(a) })
    {
      for (Index q : { b, this->partner(b) })
      {
        const auto found = this->betweenCorners_.find({ std::min(p, q), std::max(p, q) });
        if (p == None || q == None || found == this->betweenCorners_.end())
        {
          continue;
        }
        if (found->second == None || this->pieces_[found->second].curve == None)
        {
          return std::nullopt;
        }
        const CurvePiece& piece = this->pieces_[found->second];
        const bool forward = piece.ends[0] == p;
        return Span{ found->second, piece.range[forward ? 0 : 1], piece.range[forward ? 1 : 0] };
      }
    }
    return std::nullopt;
  }
  const Index k = isOnCurve(pa) ? pa.part : pb.part;
  const CurvePiece& piece = this->pieces_[k];
  // Parameter of p, as seen from the neighbour at s. A corner at both ends of the piece has two.
  const auto parameter = [&](Index p, const Place& place, double s) -> std::optional<double>
  {
    if (isOnCurve(place) && place.part == k)
    {
      return place.parameter;
    }
    const Index other = this->partner(p);
    const bool isEnd = piece.ends[0] == p || piece.ends[1] == p || other == None;
    const Index end = isEnd ? p : other;
    const bool isFirst = piece.ends[0] == end, isLast = piece.ends[1] == end;
    if (isOnCurve(place) || (!isFirst && !isLast))
    {
      return std::nullopt;
    }
    const bool first = isFirst &&
      (!isLast || std::fabs(s - piece.range[0]) < std::fabs(s - piece.range[1]));
    return piece.range[first ? 0 : 1];
  };
  const std::optional<double> from = parameter(a, pa, pb.parameter);
  const std::optional<double> to = parameter(b, pb, pa.parameter);
  if (!from || !to)
  {
    return std::nullopt;
  }
  Span span{ k, *from, *to };
  // On a closed piece the shorter way round is meant.
  if (piece.period > 0.0)
  {
    span.to += std::round((span.from - span.to) / piece.period) * piece.period;
  }
  return span;
}

/// On a closed piece span() takes the shorter way round. It is the right one as long as neighbours
/// are well under half of the piece apart.
bool CurvePieces::mayBeNeighbours(const Span& s) const
{
  const CurvePiece& piece = this->pieces_[s.part];
  if (piece.ends[0] != piece.ends[1])
  {
    return true;
  }
  const double all = piece.ends[0] == None ? piece.period
                                           : std::fabs(piece.range[1] - piece.range[0]);
  return std::fabs(s.to - s.from) <= FarthestNeighbours * all;
}
}
