// SPDX-License-Identifier: BSD-3-Clause
/// @file ImproverBoundary.hxx
/// The changes of Improver that the boundary takes part in (figure 1 of the paper, D = 2): its
/// nodes slide, go and come along the curves that it follows.
#ifndef meshopt_Run_ImproverBoundary_hxx
#define meshopt_Run_ImproverBoundary_hxx

namespace meshopt
{
template <int D, class Shape>
bool Improver<D, Shape>::changeBoundary([[maybe_unused]] Index t, [[maybe_unused]] int level)
{
  if constexpr (D == 2)
  {
    const SimplexMesh<2>& mesh = this->editor_->mesh();
    const Simplex<2> nodes = mesh.nodes(t);
    for (Index v : nodes)
    {
      if (mesh.pointData(v).curve != None &&
        ((this->options_->moveNodes && this->slideNode(v)) ||
          (level >= Insertion && this->options_->removeNodes && this->removeSlidingNode(v))))
      {
        return true;
      }
    }
    for (int i = 0; i < 3 && level >= Insertion && this->options_->insertNodes; ++i)
    {
      if (mesh.isConstrained(t, i) && this->splitBoundary(t, i))
      {
        return true;
      }
    }
  }
  return false;
}

template <int D, class Shape>
bool Improver<D, Shape>::slideNode([[maybe_unused]] Index v)
{
  if constexpr (D == 2)
  {
    const SimplexMesh<2>& mesh = this->editor_->mesh();
    if (!this->editor_->star(v, this->star_))
    {
      return false;
    }
    const auto range = slidingRange(*this->curves_, mesh, this->star_, v);
    if (!range)
    {
      return false;
    }
    const double old = mesh.worstQuality(this->star_);
    this->loadStar(v);
    const Index piece = mesh.pointData(v).curve;
    const double s = mesh.pointData(v).parameter, part = 0.8;
    double now = Never;
    const double there = goldenSection(
      s + part * (range->low - s), s + part * (range->high - s), SearchSteps,
      [&](double u) { return this->problem_.evaluate(this->curves_->at(piece, u)); }, now);
    const bool better = now > old + gain(old);
    this->count(Operation::NodeMotion, better);
    if (!better)
    {
      return false;
    }
    const Place start = this->begin();
    this->place(v, this->curves_->at(piece, there), v);
    this->editor_->setCurvePlace(v, { piece, there });
    if (!this->settleStar(old))
    {
      this->rollback(start);
      return false;
    }
    this->commit(start);
    return true;
  }
  return false;
}

template <int D, class Shape>
bool Improver<D, Shape>::removeSlidingNode([[maybe_unused]] Index v)
{
  if constexpr (D == 2)
  {
    const SimplexMesh<2>& mesh = this->editor_->mesh();
    if (!this->editor_->star(v, this->star_))
    {
      return false;
    }
    const auto range = slidingRange(*this->curves_, mesh, this->star_, v);
    bool done = false;
    for (std::size_t k = 0; k < 2 && range && !done; ++k)
    {
      done = this->edgeChange_.contract(*this->editor_, this->curves_, v, range->ends[k]) &&
        this->replaceKept(this->edgeChange_);
    }
    this->count(Operation::EdgeContraction, done);
    return done;
  }
  return false;
}

template <int D, class Shape>
bool Improver<D, Shape>::splitBoundary([[maybe_unused]] Index t, [[maybe_unused]] int i)
{
  if constexpr (D == 2)
  {
    const SimplexMesh<2>& mesh = this->editor_->mesh();
    const Facet<2> f = mesh.facet(t, i);
    const auto span = this->curves_->span(mesh, f[0], f[1]);
    if (!span || this->growth_ < 2)
    {
      return false;
    }
    // The best place by what is on this side; the other side has its say in replaceKept().
    const Index apex = mesh.nodes(t)[i];
    const ElementMetric<2> metric = this->model_->metric->element(mesh.nodes(t));
    const auto quality = [&](double s)
    {
      const Vec<2> x = this->curves_->at(span->piece, s);
      const Corners<2> first{ mesh.point(f[0]), x, mesh.point(apex) };
      const Corners<2> second{ x, mesh.point(f[1]), mesh.point(apex) };
      return std::min(
        this->model_->quality.value(first, metric), this->model_->quality.value(second, metric));
    };
    double best = Never;
    const double s = goldenSection(span->from, span->to, SearchSteps, quality, best);
    const Vec<2> x = this->curves_->at(span->piece, s);
    const Place start = this->begin();
    const Index p = this->editor_->addPoint(x);
    bool done = p != None;
    if (done)
    {
      this->place(p, x, f[0]);
      this->editor_->setCurvePlace(p, { span->piece, s });
      done = this->edgeChange_.split(*this->editor_, this->curves_, t, f[0], f[1], p) &&
        this->replaceKept(this->edgeChange_);
    }
    this->count(Operation::NodeInsertion, done);
    done ? this->commit(start) : this->rollback(start);
    return done;
  }
  return false;
}

/// Makes the change if the worst of its cells is better than what was there.
template <int D, class Shape>
bool Improver<D, Shape>::replaceKept(const EdgeChange<D>& change)
{
  const double old = this->editor_->mesh().worstQuality(change.cavity);
  for (const Simplex<D>& cell : change.cells)
  {
    if (!((*this->model_)(cell) > old + gain(old)))
    {
      return false;
    }
  }
  return this->replace(change.cavity, change.cells, change.keptChange());
}
}

#endif
