// SPDX-License-Identifier: BSD-3-Clause
/// @file FillingLookAhead.h
/// A filling that gains only after its nodes have been repositioned.
///
/// This departs from Buscaglia, Dari, Zavattieri (1996). They judge a filling as it is made, with
/// the centre of a cluster at the mean of its vertices. Here the fillings of section 2.3 are made
/// in a transaction, and the Local Algorithm of section 2.2 moves the nodes of their worst cell.
/// The whole is kept if the worst of all changed cells is better than before; otherwise it is
/// undone, bit for bit.
#ifndef meshopt_Paper1996_FillingLookAhead_h
#define meshopt_Paper1996_FillingLookAhead_h

#include "Base/Raised.h"
#include "Paper1996/ClusterSolver.h"
#include "Paper1996/FillingTrial.h"

#include <algorithm>
#include <utility>

namespace meshopt
{
template <int D, class Shape>
class FillingLookAhead
{
public:
  FillingLookAhead(Judge<D, Shape>& judge, double leastGain)
    : judge_(judge)
    , trial_(judge)
    , solver_(judge, LocalParameters{}, leastGain)
    , leastGain_(leastGain)
  {
  }

  /// Tries one filling (except Filling::Centre). If it is kept, changed() are the cells that are
  /// new or have another quality.
  bool improve(const ElementCluster<D>& around, const Apex<D>& apex);
  const std::vector<Index>& changed() const { return this->changed_; }

private:
  static constexpr int Solves = 3; // of the worst new cell at the time

  void reposition(double& before);
  double worstOfChanged() const;

  Judge<D, Shape>& judge_;
  FillingTrial<D, Shape> trial_;
  ClusterSolver<D, Shape> solver_;
  double leastGain_;
  std::vector<std::uint8_t> movable_;
  std::vector<Index> changed_;
};

template <int D, class Shape>
double FillingLookAhead<D, Shape>::worstOfChanged() const
{
  double worst = std::numeric_limits<double>::infinity();
  for (Index c : this->changed_)
  {
    worst = std::min(worst, this->judge_.mesh().quality(c));
  }
  return worst;
}

// Solves around the worst new cell. If cells outside of the filling change, `before` is lowered to
// the worst of their old qualities.
template <int D, class Shape>
void FillingLookAhead<D, Shape>::reposition(double& before)
{
  const SimplexMesh<D>& mesh = this->judge_.mesh();
  for (Index p = static_cast<Index>(this->movable_.size()); p < mesh.numberOfPointSlots(); ++p)
  {
    this->movable_.push_back(mesh.isFree(p));
  }
  // A copy: changed_ grows in the loop, but only cells of the filling are solved for.
  const std::vector<Index> made = this->changed_;
  for (int k = 0; k < Solves; ++k)
  {
    const Index worst = *std::min_element(made.begin(), made.end(),
      [&](Index a, Index b)
      { return std::make_pair(mesh.quality(a), a) < std::make_pair(mesh.quality(b), b); });
    if (!this->solver_.solve(worst, 0, this->movable_))
    {
      return;
    }
    const Cluster<D>& cluster = this->solver_.cluster();
    for (std::size_t i = 0; i < cluster.cells.size(); ++i)
    {
      const Index c = cluster.cells[i];
      const double old = this->solver_.oldQuality()[i];
      if (cluster.quality[i] != old &&
        std::find(this->changed_.begin(), this->changed_.end(), c) == this->changed_.end())
      {
        this->changed_.push_back(c);
        before = std::min(before, old);
      }
    }
  }
}

template <int D, class Shape>
bool FillingLookAhead<D, Shape>::improve(const ElementCluster<D>& around, const Apex<D>& apex)
{
  // A filling may be worse at first, but not more inverted.
  const double required = std::min(0.0, around.cluster.worst);
  const auto mark = this->judge_.begin();
  if (this->trial_.make(around, apex, required))
  {
    this->changed_ = this->trial_.made();
    double before = around.cluster.worst;
    this->reposition(before);
    if (this->worstOfChanged() > raised(before, this->leastGain_))
    {
      this->judge_.commit(mark);
      return true;
    }
  }
  this->judge_.rollback(mark);
  return false;
}
}

#endif
