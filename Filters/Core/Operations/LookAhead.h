// SPDX-License-Identifier: BSD-3-Clause
/// @file LookAhead.h
/// Several changes that gain only together: a node is inserted even without gain, then the cells
/// that became worse are improved, worst first. The whole is kept if all cells concerned end up
/// better than the cell that started it. Otherwise it is undone, bit for bit. In place of an
/// insertion all nodes around may be shaken (Shake.h); where the surface takes part, a node of it
/// may vanish.
#ifndef meshopt_Operations_LookAhead_h
#define meshopt_Operations_LookAhead_h

#include "Base/SortUnique.h"
#include "Operations/EdgeContraction.h"
#include "Operations/NodeInsertion.h"
#include "Operations/Shake.h"

#include <functional>

namespace meshopt
{
template <int D, class Shape>
class LookAhead
{
public:
  static constexpr int level = Level::LookAhead;
  static constexpr bool addsCells = true;
  static bool isOn(const Switches& switches) { return switches.lookAhead && switches.insertNodes; }

  /// Improves one cell by the other operations at a level; true if that helped. Must be set before
  /// improve() is called.
  using Improve = std::function<bool(Index t, int level)>;
  void setImprove(const Improve& improve) { this->improve_ = improve; }

  bool improve(Judge<D, Shape>& judge, Index t, int level)
  {
    if (!judge.looksAhead())
    {
      return false;
    }
    const bool isLong = level > Level::LookAhead;
    std::vector<Seed> seeds;
    NodeInsertion<D, Shape>::findAllSeeds(judge, t, isLong, seeds);
    const double old = judge.mesh().quality(t);
    this->insertion_.setUsualLimits(judge);
    bool done = false;
    for (std::size_t k = 0; k < seeds.size() && !done; ++k)
    {
      done = this->tryFrom(judge, t, seeds[k], old, isLong);
    }
    done = done ||
      (judge.slides() && judge.mayRemoveNodes() && this->tryWithout(judge, t, old, isLong));
    for (int k = 0; k < this->numberOfShakes(judge, isLong) && !done; ++k)
    {
      done = this->attempt(
        judge, old, isLong, [&] { return this->shake_.move(judge, t, k, Promising * old); });
    }
    judge.count(Operation::LookAhead, done);
    return done;
  }

private:
  using Seed = typename NodeInsertion<D, Shape>::Seed;

  static constexpr int Operations = 30, ManyOperations = 120; ///< most tries after the insertion
  /// Ways to shake that are tried: where the surface takes part, and where it is kept and holds the
  /// cell far below its bound. With half as many dino ended clearly lower.
  static constexpr int Shakes = 20, ShakesInside = 5;
  static constexpr double Promising = 0.3; ///< least quality at first, relative to the old one

  static int numberOfShakes(const Judge<D, Shape>& judge, bool isLong)
  {
    const bool isFarBelowBound = judge.wide() != None;
    const int most = judge.slides() ? Shakes : isFarBelowBound ? ShakesInside : 0;
    return isLong && judge.switches().moveNodes ? most : 0;
  }

  /// Makes the first change; keeps it and what follows if that reaches the goal, or undoes all.
  template <class First>
  bool attempt(Judge<D, Shape>& judge, double old, bool isLong, First&& first)
  {
    const auto mark = judge.begin();
    judge.start();
    std::vector<Index> affected;
    bool done = first();
    if (done)
    {
      affected = judge.changed(); // a copy: operations overwrite changed()
      done = this->settle(judge, affected, judge.required(old), isLong);
    }
    // The guard is asked only here: in between, single changes may make cells bad.
    done = judge.endGuarded(mark, done);
    judge.start();
    if (done)
    {
      judge.changed() = affected;
    }
    return done;
  }

  bool tryFrom(Judge<D, Shape>& judge, Index t, Seed& seed, double old, bool isLong)
  {
    return this->attempt(judge, old, isLong,
      [&]
      {
        const Index p = judge.editor().addPoint(seed.x);
        return p != None && this->insertion_.find(judge, t, p, seed, false) > Promising * old &&
          this->insertion_.fill(judge, p, seed);
      });
  }

  /// Contracts the edges of the cell that lie on the surface, the shortest first, even without
  /// gain.
  bool tryWithout(Judge<D, Shape>& judge, Index t, double old, bool isLong)
  {
    const SimplexMesh<D>& mesh = judge.mesh();
    std::vector<std::pair<double, std::array<Index, 2>>> edges;
    for (const auto& e : Local<D>::edges)
    {
      const Index a = mesh.nodes(t)[e[0]], b = mesh.nodes(t)[e[1]];
      if (mesh.isBoundary(a) && mesh.isBoundary(b))
      {
        const double l = (mesh.point(a) - mesh.point(b)).squaredNorm();
        edges.push_back({ l, { a, b } });
        edges.push_back({ l, { b, a } });
      }
    }
    std::sort(edges.begin(), edges.end());
    bool done = false;
    for (std::size_t k = 0; k < edges.size() && !done; ++k)
    {
      const Index v = edges[k].second[0], u = edges[k].second[1];
      done = mesh.freedom(v) != Freedom::Fixed &&
        this->attempt(judge, old, isLong,
          [&]
          {
            const bool may = proposeContraction(
              judge.editor(), judge.surface(), v, u, this->proposal_);
            this->proposal_.least = Promising * old;
            return may && judge.measure(this->proposal_) && judge.accept(this->proposal_);
          });
    }
    return done;
  }

  /// Improves the affected cells, worst first, until all are above the goal. False if one of them
  /// cannot be improved.
  bool settle(Judge<D, Shape>& judge, std::vector<Index>& affected, double goal, bool isLong)
  {
    const SimplexMesh<D>& mesh = judge.mesh();
    const int level = isLong ? Level::Insertion : Level::Topology;
    sortUnique(affected);
    for (int left = isLong ? ManyOperations : Operations; left >= 0; --left)
    {
      Index worst = None;
      for (Index c : affected)
      {
        if (mesh.isAlive(c) && !(mesh.quality(c) > goal) &&
          (worst == None || mesh.quality(c) < mesh.quality(worst) ||
            (mesh.quality(c) == mesh.quality(worst) && c < worst)))
        {
          worst = c;
        }
      }
      if (worst == None)
      {
        return true;
      }
      // One cell that cannot be improved is enough to fail: the goal is for all.
      if (left == 0 || !this->improve_(worst, level))
      {
        return false;
      }
      // A set, since the operations often change the same cells again.
      sortUnique(judge.changed());
      this->merged_.clear();
      std::set_union(affected.begin(), affected.end(), judge.changed().begin(),
        judge.changed().end(), std::back_inserter(this->merged_));
      affected.swap(this->merged_);
    }
    return false;
  }

  NodeInsertion<D, Shape> insertion_;
  Shake<D, Shape> shake_;
  Proposal<D> proposal_;
  std::vector<Index> merged_; ///< of settle(), which would make it anew each time
  Improve improve_;
};
}

#endif
