// SPDX-License-Identifier: BSD-3-Clause
/// @file NodeRemoval.h
/// Removes a free node of a cell: it is contracted into the neighbour where this gains most.
#ifndef meshopt_Operations_NodeRemoval_h
#define meshopt_Operations_NodeRemoval_h

#include "Base/SortUnique.h"
#include "Edit/Judge.h"
#include "Operations/Level.h"

namespace meshopt
{
/// The link of the node is collected once. Each neighbour is then only joined with its facets, and
/// most are refused at the first of them. Not by proposeContraction(): it is for one neighbour,
/// also on the surface, and would collect the star and all cells anew for each.
template <int D, class Shape>
class NodeRemoval
{
public:
  static constexpr int level = Level::Removal;
  static constexpr bool addsCells = false;
  static bool isOn(const Switches& switches) { return switches.removeNodes; }

  bool improve(Judge<D, Shape>& judge, Index t, int)
  {
    const Simplex<D> nodes = judge.mesh().nodes(t);
    return judge.mayRemoveNodes() &&
      std::any_of(nodes.begin(), nodes.end(),
        [&](Index v) { return judge.mesh().isFree(v) && this->remove(judge, v); });
  }

private:
  /// Tries all neighbours, unless nothing has changed since that last failed.
  bool remove(Judge<D, Shape>& judge, Index v)
  {
    const SimplexMesh<D>& mesh = judge.mesh();
    const auto& data = mesh.pointData(v);
    this->best_.clear();
    if (judge.failsAgain(data.removeFailed, data.stamp) ||
      !judge.editor().star(v, this->best_.cavity))
    {
      return false;
    }
    this->collectLink(mesh, v);
    this->best_.oldWorst = mesh.worstQuality(this->best_.cavity);
    // Each neighbour has to be better than the best so far: most are refused at their first cells.
    judge.demand(this->best_);
    this->best_.newWorst = this->best_.least;
    for (Index u : this->neighbours_)
    {
      this->tryNeighbour(judge.model(), u);
    }
    const bool done = !this->best_.cells.empty() && judge.accept(this->best_);
    judge.count(Operation::EdgeContraction, done);
    if (!done)
    {
      judge.noteRemovalFailed(v);
    }
    return done;
  }

  /// Collects the facets opposite to v in its star, and their points.
  void collectLink(const SimplexMesh<D>& mesh, Index v)
  {
    this->link_.clear();
    this->neighbours_.clear();
    for (Index c : this->best_.cavity)
    {
      const Facet<D> f = mesh.facet(c, mesh.localIndex(c, v));
      this->link_.push_back(f);
      this->neighbours_.insert(this->neighbours_.end(), f.begin(), f.end());
    }
    sortUnique(this->neighbours_);
  }

  /// Joins the facets of the link that do not contain u to u. Remembers the result if it is the
  /// best.
  void tryNeighbour(const QualityModel<D, Shape>& model, Index u)
  {
    double worst = std::numeric_limits<double>::infinity();
    this->cells_.clear();
    for (const Facet<D>& f : this->link_)
    {
      if (std::find(f.begin(), f.end(), u) != f.end())
      {
        continue;
      }
      Simplex<D> cell;
      std::copy(f.begin(), f.end(), cell.begin());
      cell[D] = u;
      worst = std::min(worst, model(cell));
      if (!(worst > this->best_.newWorst))
      {
        return;
      }
      this->cells_.push_back(cell);
    }
    if (!this->cells_.empty())
    {
      this->best_.newWorst = worst;
      this->best_.cells = this->cells_;
    }
  }

  Proposal<D> best_;
  std::vector<Facet<D>> link_;
  std::vector<Index> neighbours_;
  std::vector<Simplex<D>> cells_;
};
}

#endif
