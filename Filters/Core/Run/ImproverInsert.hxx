// SPDX-License-Identifier: BSD-3-Clause
/// @file ImproverInsert.hxx
/// The costly part of Improver: new nodes, small polyhedra, look-ahead.
#ifndef meshopt_Run_ImproverInsert_hxx
#define meshopt_Run_ImproverInsert_hxx

namespace meshopt
{
// --- nodes that come

/// Barycentre, facet barycentres, edge midpoints; the latter pulled in by 10 %.
template <int D, class Shape>
void Improver<D, Shape>::seeds(Index t, std::vector<Vec<D>>& x) const
{
  const Corners<D> c = this->editor_->mesh().corners(t);
  Vec<D> centre = c[0];
  for (int i = 1; i <= D; ++i)
  {
    centre += c[i];
  }
  centre /= D + 1;
  x.clear();
  for (int i = 0; i <= D; ++i)
  {
    if constexpr (D == 3)
    {
      // where the cell's kept facet has its best fourth node, and half way there
      if (this->editor_->mesh().isConstrained(t, i))
      {
        const Facet<3> f = this->editor_->mesh().facet(t, i);
        Vec<3> apex;
        facetCap(this->editor_->mesh().point(f[0]), this->editor_->mesh().point(f[1]),
          this->editor_->mesh().point(f[2]), std::numeric_limits<double>::infinity(), &apex);
        x.push_back(apex);
        x.push_back(0.5 * (apex + c[i]));
      }
    }
  }
  x.push_back(centre);
  for (int i = 0; D == 3 && i <= D; ++i)
  {
    const Vec<D> f = (Vec<D>(centre * (D + 1)) - c[i]) / D;
    x.push_back(f + 0.1 * (centre - f));
  }
  for (const auto& e : Local<D>::edges)
  {
    const Vec<D> m = 0.5 * (c[e[0]] + c[e[1]]);
    x.push_back(m + 0.1 * (centre - m));
  }
}

/// The cavity for a node that starts at x and is then put at its best place there. Leaves the
/// cavity in cavity_ and the node's place in x.
template <int D, class Shape>
double Improver<D, Shape>::tryInsertion(Index t, Index p, Vec<D>& x, bool needGain)
{
  double q = Never;
  for (int round = 0; round < 2; ++round)
  {
    this->place(p, x, this->editor_->mesh().nodes(t)[0]);
    typename Cavity<D, Shape>::Limits limits;
    limits.swallowed = this->mayRemoveNodes() ? limits.swallowed : 0;
    q = this->cavity_.grow(*this->editor_, *this->model_, t, p, x, limits);
    if (!(q > 0.0))
    {
      return Never;
    }
    const double old = this->cavity_.oldWorst();
    this->problem_.clear(this->model_->quality, this->model_->plain);
    for (const Facet<D>& f : this->cavity_.facets())
    {
      std::array<int, D> local;
      for (int k = 0; k < D; ++k)
      {
        local[k] = this->problem_.addPoint(f[k], this->editor_->mesh().point(f[k]));
      }
      this->problem_.addFacet(local, this->model_->weight(f));
      if (!this->model_->plain)
      {
        Simplex<D> cell;
        std::copy(f.begin(), f.end(), cell.begin());
        cell[D] = p;
        this->problem_.addFacetMetric(this->model_->metric->element(cell));
      }
    }
    q = this->problem_.maximize(x, std::max(this->enough(), old + 2 * gain(old)), 0.5 * gain(old));
    if (!needGain || q > old + gain(old))
    {
      break;
    }
    if (q < 0.5 * old)
    {
      break; // hopeless: a second round gains little
    }
  }
  return q;
}

template <int D, class Shape>
bool Improver<D, Shape>::insertHere(Index p, const Vec<D>& x)
{
  this->place(p, x, this->cavity_.facets()[0][0]);
  this->cells_.clear();
  for (const Facet<D>& f : this->cavity_.facets())
  {
    Simplex<D> cell;
    std::copy(f.begin(), f.end(), cell.begin());
    cell[D] = p;
    this->cells_.push_back(cell);
  }
  return this->replace(this->cavity_.cells(), this->cells_);
}

/// Bad cells of the insertion last tried, less those of its cavity.
template <int D, class Shape>
long Improver<D, Shape>::badBalance() const
{
  long bad = 0;
  for (double q : this->problem_.values())
  {
    bad += this->badness(q);
  }
  for (Index c : this->cavity_.cells())
  {
    bad -= this->badness(this->editor_->mesh().quality(c));
  }
  return bad;
}

template <int D, class Shape>
bool Improver<D, Shape>::insert(Index t)
{
  std::vector<Vec<D>> x;
  this->seeds(t, x);
  const Place start = this->begin();
  const Index p = this->editor_->addPoint(x[0]);
  bool done = false;
  for (std::size_t k = 0; k < x.size() && p != None && !done; ++k)
  {
    const double q = this->tryInsertion(t, p, x[k], true);
    const double old = this->cavity_.oldWorst();
    if (q > old + gain(old) && this->badBalance() <= 0)
    {
      // The search took the metric where the node was, and no notice of the floor: a second look.
      const Place before = this->begin();
      done = this->insertHere(p, x[k]) &&
        ((this->model_->plain && !this->model_->weights) ||
          (this->editor_->mesh().worstQuality(this->editor_->created()) > old + gain(old) &&
            this->bad_ <= start.bad));
      done ? this->commit(before) : this->rollback(before);
      if (!done)
      {
        this->changed_.clear();
      }
    }
  }
  this->count(Operation::NodeInsertion, done);
  done ? this->commit(start) : this->rollback(start);
  return done;
}

// --- a few cells at once

template <int D, class Shape>
bool Improver<D, Shape>::retriangulate(Index t)
{
  bool done = false;
  if constexpr (D == 3)
  {
    if (!this->inverted_)
    {
      typename SmallPolyhedron<Shape>::Limits limits;
      done = this->retriangulate(t, limits);
      limits.newPoints = 4;
      for (double height : { 0.5, 1.0 })
      {
        limits.height = height;
        done = done ||
          (this->options_->insertNodes && this->model_->plain && this->retriangulate(t, limits));
      }
      this->count(Operation::Retriangulation, done);
    }
  }
  return done;
}

template <int D, class Shape>
bool Improver<D, Shape>::retriangulate(
  Index t, const typename SmallPolyhedron<Shape>::Limits& asked)
{
  if constexpr (D == 3)
  {
    typename SmallPolyhedron<Shape>::Limits limits = asked;
    limits.mayDropPoints = this->mayRemoveNodes();
    const SimplexMesh<3>& mesh = this->editor_->mesh();
    const double above = mesh.quality(t) + this->gain(mesh.quality(t));
    const double q = this->smallPolyhedron_.propose(*this->editor_, *this->model_, t, above, limits,
      [&](Index c, int i) { return this->caps_->enough(mesh, c, i); });
    if (!(q > above))
    {
      return false;
    }
    const Place start = this->begin();
    std::vector<Index> ids;
    bool room = true;
    for (const Vec<3>& x : this->smallPolyhedron_.newPoints())
    {
      ids.push_back(this->editor_->addPoint(x));
      room &= ids.back() != None;
      if (room)
      {
        this->place(ids.back(), x, mesh.nodes(t)[0]);
      }
    }
    this->smallPolyhedron_.nameNewPoints(ids);
    if (room && this->replace(this->smallPolyhedron_.cavity(), this->smallPolyhedron_.cells()))
    {
      this->commit(start);
      return true;
    }
    this->rollback(start);
    this->changed_.clear();
  }
  return false;
}

// --- look-ahead

/// Inserts a node even without gain, then improves what it spoiled, worst first. Kept if all that
/// was touched ends better than the cell that started it; otherwise undone, bit for bit.
template <int D, class Shape>
bool Improver<D, Shape>::lookAhead(Index t, int operations)
{
  std::vector<Vec<D>> x;
  this->seeds(t, x);
  const double old = this->editor_->mesh().quality(t);
  const double goal = old + gain(old);
  for (Vec<D>& seed : x)
  {
    const Place start = this->begin();
    const Index p = this->editor_->addPoint(seed);
    std::vector<Index> affected;
    bool done = false;
    this->changed_.clear();
    if (p != None && this->tryInsertion(t, p, seed, false) > 0.3 * old && this->insertHere(p, seed))
    {
      affected = this->changed_;
      done = this->settle(affected, goal, operations) && this->bad_ <= start.bad;
    }
    if (done)
    {
      this->commit(start);
      this->changed_ = affected;
      this->count(Operation::LookAhead, true);
      return true;
    }
    this->rollback(start);
  }
  this->changed_.clear();
  this->count(Operation::LookAhead, false);
  return false;
}

template <int D, class Shape>
bool Improver<D, Shape>::settle(std::vector<Index>& affected, double goal, int operations)
{
  const int level = operations > 30 ? Insertion : Topology;
  const SimplexMesh<D>& mesh = this->editor_->mesh();
  while (true)
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
    if (--operations < 0 ||
      (!this->improve(worst, level) && !(level >= Insertion && this->moveCluster(worst))))
    {
      return false;
    }
    affected.insert(affected.end(), this->changed_.begin(), this->changed_.end());
    std::sort(affected.begin(), affected.end());
    affected.erase(std::unique(affected.begin(), affected.end()), affected.end());
  }
}
}

#endif
