// SPDX-License-Identifier: BSD-3-Clause
/// @file Shake.h
/// Moves all nodes around a cell by chance, the same way on each machine. The beginning of a
/// look-ahead (LookAhead.h): where each node, each edge and each cluster is as good as it can be
/// from here, another start may end higher.
#ifndef meshopt_Operations_Shake_h
#define meshopt_Operations_Shake_h

#include "Base/Scramble.h"
#include "Base/SortUnique.h"
#include "Edit/Judge.h"

namespace meshopt
{
template <int D, class Shape>
class Shake
{
public:
  /// Moves the nodes of cell t and of its neighbours, one after another. Nodes of the surface stay
  /// on it, or as near as they must. A node stays if cells would become worse than `least`, or if
  /// the judge refuses. `number`: which of the many ways. True if any has moved; judge.changed()
  /// then lists their cells, and t.
  bool move(Judge<D, Shape>& judge, Index t, int number, double least)
  {
    const SimplexMesh<D>& mesh = judge.mesh();
    if (!this->findNodes(judge, t))
    {
      return false;
    }
    const double part = Step * (1 + number % Steps);
    std::uint64_t random = scramble(
      (static_cast<std::uint64_t>(number) << 32) + static_cast<std::uint32_t>(t));
    for (Index v : this->nodes_)
    {
      this->proposal_.clear();
      std::vector<Index>& star = this->proposal_.cavity;
      judge.editor().star(v, star);
      const double length = part * this->meanEdge(mesh, v, star);
      Vec<D> x = mesh.point(v);
      for (int i = 0; i < D; ++i)
      {
        random = scramble(random);
        x[i] += length * (2.0 * unit(random) - 1.0);
      }
      const Place place = mesh.isFree(v) ? Place()
                                         : judge.surface()->placeNear(mesh.place(v), x, x);
      this->proposal_.moves.assign(1, { v, x, place });
      this->proposal_.oldWorst = mesh.worstQuality(star);
      this->proposal_.least = least;
      judge.accept(this->proposal_);
    }
    std::vector<Index>& changed = judge.changed();
    const bool any = !changed.empty();
    changed.push_back(t);
    sortUnique(changed);
    return any;
  }

private:
  /// Lengths of the moves: from Step to Steps * Step of the mean edge of the node.
  static constexpr double Step = 0.1;
  static constexpr int Steps = 5;

  /// In [0, 1).
  static double unit(std::uint64_t random)
  {
    constexpr int bits = 53; // of a double
    return std::ldexp(static_cast<double>(random >> (64 - bits)), -bits);
  }

  /// The nodes of all cells that have a node of t, as far as they may move. False if another chunk
  /// has one of these cells.
  bool findNodes(Judge<D, Shape>& judge, Index t)
  {
    const SimplexMesh<D>& mesh = judge.mesh();
    std::vector<Index> star;
    this->nodes_.clear();
    const auto isKept = [&](Index v)
    { return mesh.freedom(v) == Freedom::Fixed || !judge.editor().star(v, star); };
    for (Index v : mesh.nodes(t))
    {
      if (!judge.editor().star(v, star))
      {
        return false;
      }
      for (Index c : star)
      {
        this->nodes_.insert(this->nodes_.end(), mesh.nodes(c).begin(), mesh.nodes(c).end());
      }
    }
    sortUnique(this->nodes_);
    this->nodes_.erase(
      std::remove_if(this->nodes_.begin(), this->nodes_.end(), isKept), this->nodes_.end());
    return true;
  }

  /// Edges count as often as cells have them.
  static double meanEdge(const SimplexMesh<D>& mesh, Index v, const std::vector<Index>& star)
  {
    double sum = 0.0;
    for (Index c : star)
    {
      for (Index p : mesh.nodes(c))
      {
        sum += (mesh.point(p) - mesh.point(v)).norm();
      }
    }
    return sum / static_cast<double>(D * star.size());
  }

  Proposal<D> proposal_;
  std::vector<Index> nodes_;
};
}

#endif
