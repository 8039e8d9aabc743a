// SPDX-License-Identifier: BSD-3-Clause
/// @file FillingTrial.h
/// Tries a filling virtually, and makes it if it is better.
#ifndef meshopt_Paper1996_FillingTrial_h
#define meshopt_Paper1996_FillingTrial_h

#include "Edit/Judge.h"
#include "Paper1996/Filling.h"

namespace meshopt
{
/// For one shape measure; keeps its scratch memory between calls. Fans are tried even if they may
/// cross what surrounds the cluster, so the judge must check topology (Judge::setTangled()).
template <int D, class Shape>
class FillingTrial
{
public:
  explicit FillingTrial(Judge<D, Shape>& judge)
    : judge_(judge)
  {
  }

  /// Makes the filling if all its cells are better than `required`, no more of them are inverted or
  /// flat than in the cluster, and the judge accepts it. Returns whether it did; made() are then
  /// its cells. Otherwise the mesh is unchanged.
  bool make(const ElementCluster<D>& around, Apex<D> apex, double required);
  const std::vector<Index>& made() { return this->judge_.changed(); }

private:
  bool propose(const ElementCluster<D>& around, const Apex<D>& apex, double required);

  Judge<D, Shape>& judge_;
  Proposal<D> proposal_;
};

template <int D, class Shape>
bool FillingTrial<D, Shape>::make(const ElementCluster<D>& around, Apex<D> apex, double required)
{
  this->judge_.start();
  if (apex.local >= 0)
  {
    return this->propose(around, apex, required) && this->judge_.accept(this->proposal_);
  }
  // The apex is not a node of the boundary: the point has to be placed before its metric is known.
  MeshEditor<D>& editor = this->judge_.editor();
  const auto mark = this->judge_.begin();
  const bool isNew = apex.id == None;
  apex.id = isNew ? editor.addPoint(apex.x) : apex.id;
  editor.movePoint(apex.id, apex.x, isNew ? around.core[0] : None);
  return this->judge_.end(
    mark, this->propose(around, apex, required) && this->judge_.accept(this->proposal_));
}

template <int D, class Shape>
bool FillingTrial<D, Shape>::propose(
  const ElementCluster<D>& around, const Apex<D>& apex, double required)
{
  const QualityModel<D, Shape>& model = this->judge_.model();
  Proposal<D>& p = this->proposal_;
  p.clear();
  p.oldWorst = around.cluster.worst;
  p.least = required;
  const auto qualityOf = [&](const Simplex<D>& nodes, const Corners<D>& x)
  { return model.at(nodes, x); };
  if (!fillFromApex<D>(around.cluster, apex, qualityOf, p))
  {
    return false;
  }
  p.cavity = around.cluster.cells;
  if (apex.local < 0 && apex.id == around.core[0])
  {
    // The node moves to the centre. The cells keep the order of their nodes, which may change the
    // last bit of their quality. So they are measured again.
    p.moves.push_back({ apex.id, apex.x, {} });
    p.cells.clear();
    p.qualities.clear();
    p.least = Proposal<D>::Never;
  }
  return true;
}
}

#endif
