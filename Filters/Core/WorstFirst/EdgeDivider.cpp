// SPDX-License-Identifier: BSD-3-Clause
// Where the new point of a divided edge lies, and whether the edge may be divided at all.
#include "WorstFirst/EdgeDivider.h"

#include "Operations/EdgeSplit.h"

#include <algorithm>

namespace meshopt
{
namespace
{
/// A division may lower the worst quality around it to this part: halves are worse at first.
constexpr double WorstDivision = 0.2;
}

EdgeDivider::EdgeDivider(Run<3>& run, double below)
  : run_(run)
  , model_(run.mesh(), run.metric, 0.0)
  , judge_(run.editor, this->model_, run.options, run.surface)
{
  this->judge_.growth.left = run.growth;
  for (Index c = 0; c < run.mesh().numberOfCellSlots(); ++c)
  {
    if (run.mesh().isAlive(c) && run.mesh().quality(c) < below)
    {
      this->bad_.push_back(c);
    }
  }
  computeQualities<3>(run.editor, run.metric, Measure::Shape, 0.0);
}

void EdgeDivider::record(const std::string& stage, bool isRow)
{
  const Options& o = this->run_.options;
  computeQualities<3>(this->run_.editor, this->run_.metric, o.measure, o.beta);
  if (isRow)
  {
    this->run_.record(stage, this->judge_);
  }
}

/// Whether the edge is in the surface, and on a patch of it or on a curve. False if it must stay.
bool EdgeDivider::findPatch(const Edge& edge, Index& patch, bool& isKept)
{
  patch = None;
  isKept = false;
  this->mesh().ring(edge.cell, edge.a, edge.b, true, this->ring_);
  for (Index other : this->ring_)
  {
    for (int i = 0; i < 4; ++i)
    {
      const Facet<3> f = this->mesh().facet(other, i);
      if (this->mesh().isKept(other, i) && hasId(f, edge.a) && hasId(f, edge.b))
      {
        // The least of its patches, so that it does not matter where the ring begins. Where one of
        // its facets is locked, mayDivide() refuses.
        isKept = true;
        const Index p = this->mesh().patch(other, i);
        patch = patch == None ? p : std::min(patch, p);
      }
    }
  }
  return !isKept ||
    (patch != None && this->run_.surface &&
      this->run_.surface->mayDivide(this->mesh(), this->ring_, edge.a, edge.b));
}

Index EdgeDivider::divide(Index c, Index a, Index b, Where where)
{
  const Edge edge{ c, a, b };
  Index patch = None;
  bool isKept = false;
  if (!this->findPatch(edge, patch, isKept))
  {
    return None;
  }
  const Vec<3> middle = 0.5 * (this->mesh().point(a) + this->mesh().point(b));
  if (!isKept)
  {
    return this->divideAt(edge, middle, {});
  }
  const auto span = this->run_.surface->span(this->mesh(), a, b);
  Place place = span ? Place{ Freedom::Curve, span->part, 0.5 * (span->from + span->to) }
                     : Place{ Freedom::Patch, patch, 0.0 };
  Vec<3> x = middle;
  const auto divideNear = [&]
  {
    Vec<3> y = middle;
    const Place near = this->run_.surface->placeNear(place, middle, y);
    return this->divideAt(edge, y, near);
  };
  Index p = where == Where::Edge ? divideNear() : None;
  if (p == None)
  {
    if (span)
    {
      x = this->run_.surface->at(span->part, place.parameter);
    }
    else
    {
      place = this->run_.surface->project(place, middle, x);
    }
    p = this->divideAt(edge, x, place);
  }
  return p == None && where == Where::Surface ? divideNear() : p;
}

Index EdgeDivider::divideAt(const Edge& edge, const Vec<3>& x, const Place& place)
{
  MeshEditor<3>& editor = this->run_.editor;
  const auto mark = this->judge_.begin();
  const Index p = editor.addPoint(x, edge.a, place);
  bool done = p != None &&
    proposeSplit(editor, this->run_.surface, { edge.cell, edge.a, edge.b, p }, this->proposal_);
  if (done)
  {
    this->proposal_.least = WorstDivision * this->proposal_.oldWorst;
    this->judge_.start();
    done = this->judge_.measure(this->proposal_) && this->judge_.accept(this->proposal_);
  }
  this->judge_.end(mark, done);
  this->judge_.count(Operation::NodeInsertion, done);
  return done ? p : None;
}
}
