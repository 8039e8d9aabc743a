// SPDX-License-Identifier: BSD-3-Clause
#ifndef meshopt_Run_Improver_hxx
#define meshopt_Run_Improver_hxx

namespace meshopt
{
template <int D, class Shape>
Improver<D, Shape>::Improver(MeshEditor<D>& editor, const QualityModel<D, Shape>& model,
  const Caps<D>& caps, const Options& options, const BoundaryCurves* curves)
  : editor_(&editor)
  , model_(&model)
  , caps_(&caps)
  , options_(&options)
  , curves_(curves)
  , gatherer_(editor)
{
}

template <int D, class Shape>
bool Improver<D, Shape>::improve(Index t, int level)
{
  this->changed_.clear();
  if (this->options_->reconnect && this->reconnect(t))
  {
    return true;
  }
  if (this->options_->moveNodes && this->move(t))
  {
    return true;
  }
  if (level >= Insertion && this->mayRemoveNodes() && this->removeNodes(t))
  {
    return true;
  }
  if (this->curves_ && this->changeBoundary(t, level))
  {
    return true;
  }
  if (level >= LongLookAhead && this->moveCluster(t))
  {
    return true;
  }
  if (level >= LongLookAhead && this->options_->reconnect && this->retriangulate(t))
  {
    return true;
  }
  if (this->growth_ <= 0)
  {
    this->isShort_ |= level >= Insertion && this->options_->insertNodes;
    return false; // what is left nearly always adds cells
  }
  if (level >= Insertion && this->options_->insertNodes && this->insert(t))
  {
    return true;
  }
  return level >= LookAhead && this->options_->lookAhead && this->options_->insertNodes &&
    this->lookAhead(t, level == LookAhead ? 30 : 120);
}

// --- transactions: the editor's, and with it the metric at the points that moved

template <int D, class Shape>
typename Improver<D, Shape>::Place Improver<D, Shape>::begin()
{
  return { this->editor_->begin(), this->samples_.size(), this->growth_, this->bad_ };
}

template <int D, class Shape>
void Improver<D, Shape>::commit(const Place& place)
{
  this->editor_->commit(place.journal);
  if (!this->editor_->inTransaction())
  {
    this->samples_.clear();
  }
}

template <int D, class Shape>
void Improver<D, Shape>::rollback(const Place& place)
{
  this->editor_->rollback(place.journal);
  while (this->samples_.size() > place.samples)
  {
    this->model_->metric->setSample(this->samples_.back().first, this->samples_.back().second);
    this->samples_.pop_back();
  }
  this->growth_ = place.growth;
  this->bad_ = place.bad;
}

/// Puts p at x, and samples the metric there; within a transaction. `near` is a point close by.
template <int D, class Shape>
void Improver<D, Shape>::place(Index p, const Vec<D>& x, Index near)
{
  this->editor_->movePoint(p, x);
  if (!this->model_->plain)
  {
    this->samples_.emplace_back(p, this->model_->metric->sample(p));
    this->model_->metric->resample(p, x, near);
  }
}

template <int D, class Shape>
bool Improver<D, Shape>::replace(
  const std::vector<Index>& cavity, const std::vector<Simplex<D>>& cells, const KeptChange<D>* kept)
{
  if (this->tangled_ && !this->fits(cavity, cells, kept))
  {
    return false;
  }
  const long growth = static_cast<long>(cells.size()) - static_cast<long>(cavity.size());
  if (growth > 0 && growth > this->growth_)
  {
    this->isShort_ = true;
    return false;
  }
  this->qualities_.clear();
  for (const Simplex<D>& c : cells)
  {
    this->qualities_.push_back((*this->model_)(c));
  }
  long bad = 0;
  for (double q : this->qualities_)
  {
    bad += this->badness(q);
  }
  for (Index c : cavity)
  {
    bad -= this->badness(this->editor_->mesh().quality(c));
  }
  // The guard of swaps; what happens within a transaction is judged at its end.
  if (this->guardsAll_ && bad > 0 && !this->editor_->inTransaction() &&
    this->editor_->mesh().worstQuality(cavity) > 0.0)
  {
    return false;
  }
  if (!this->editor_->replace(cavity, cells, this->qualities_, kept))
  {
    return false;
  }
  this->bad_ += bad;
  this->growth_ -= growth;
  const std::vector<Index>& created = this->editor_->created();
  this->changed_.insert(this->changed_.end(), created.begin(), created.end());
  return true;
}

// --- topology that keeps the points

template <int D, class Shape>
bool Improver<D, Shape>::reconnect(Index t)
{
  const double above = this->editor_->mesh().quality(t) + gain(this->editor_->mesh().quality(t));
  double best = above;
  Operation kind = Operation::EdgeRemoval;
  this->bestCells_.clear();
  for (int e = 0; e < Local<D>::numberOfEdges; ++e)
  {
    const double q = this->edgeRemoval_.propose(*this->editor_, *this->model_, t, e, best);
    if (q > best && q > this->edgeRemoval_.ringWorst() + gain(this->edgeRemoval_.ringWorst()))
    {
      best = q;
      this->edgeRemoval_.cells(this->bestCells_);
      this->bestCavity_ = this->edgeRemoval_.cavity();
    }
  }
  this->count(Operation::EdgeRemoval, !this->bestCells_.empty());
  if constexpr (D == 3)
  {
    for (int i = 0; i < 4; ++i)
    {
      const double q = this->faceRemoval_.propose(*this->editor_, *this->model_, t, i, best);
      if (q > best && q > this->faceRemoval_.oldWorst() + gain(this->faceRemoval_.oldWorst()))
      {
        best = q;
        this->bestCells_ = this->faceRemoval_.cells();
        this->bestCavity_ = this->faceRemoval_.cavity();
        kind = Operation::FaceRemoval;
      }
    }
    this->count(Operation::FaceRemoval, kind == Operation::FaceRemoval);
  }
  return !this->bestCells_.empty() && this->replace(this->bestCavity_, this->bestCells_);
}

template <int D, class Shape>
bool Improver<D, Shape>::conflicts(
  const std::vector<Index>& cavity, const std::vector<Simplex<D>>& cells) const
{
  const SimplexMesh<D>& mesh = this->editor_->mesh();
  const std::vector<std::uint8_t>& pinched = *this->pinched_;
  std::vector<Index> star;
  // a face of a new cell: its points, the first `n` of `face`
  const auto isNewAndTaken = [&](const Index* face, int n)
  {
    const auto has = [&](Index c)
    { return std::all_of(face, face + n, [&](Index p) { return mesh.localIndex(c, p) >= 0; }); };
    if (std::any_of(cavity.begin(), cavity.end(), has) ||
      !std::all_of(face, face + n, [&](Index p) { return mesh.isPointAlive(p); }))
    {
      return false;
    }
    const Index* whole = std::find_if_not(face, face + n,
      [&](Index p) { return p < static_cast<Index>(pinched.size()) && pinched[p]; });
    if (whole != face + n)
    {
      mesh.star(*whole, star);
      return std::any_of(star.begin(), star.end(), has);
    }
    bool found = false; // no star of these points is all of it; there are few such points
    for (Index c = 0; c < mesh.numberOfCellSlots() && !found; ++c)
    {
      found = mesh.isAlive(c) && has(c);
    }
    return found;
  };
  for (const Simplex<D>& cell : cells)
  {
    for (const auto& e : Local<D>::edges)
    {
      const Index edge[] = { cell[e[0]], cell[e[1]] };
      if (isNewAndTaken(edge, 2))
      {
        return true;
      }
    }
    for (const auto& f : Local<D>::facets)
    {
      Index facet[D];
      std::transform(std::begin(f), std::end(f), facet, [&](int k) { return cell[k]; });
      if (isNewAndTaken(facet, D))
      {
        return true;
      }
    }
  }
  return false;
}

// --- node motion

template <int D, class Shape>
void Improver<D, Shape>::loadStar(Index v)
{
  const SimplexMesh<D>& mesh = this->editor_->mesh();
  this->problem_.clear(this->model_->quality, this->model_->plain);
  for (Index c : this->star_)
  {
    const Facet<D> f = mesh.facet(c, mesh.localIndex(c, v));
    std::array<int, D> local;
    for (int k = 0; k < D; ++k)
    {
      local[k] = this->problem_.addPoint(f[k], mesh.point(f[k]));
    }
    this->problem_.addFacet(local, this->model_->weight(f));
    if (!this->model_->plain)
    {
      this->problem_.addFacetMetric(this->model_->metric->element(mesh.nodes(c)));
    }
  }
}

template <int D, class Shape>
bool Improver<D, Shape>::move(Index t)
{
  bool moved = false;
  const Simplex<D> nodes = this->editor_->mesh().nodes(t);
  for (Index v : nodes)
  {
    moved |= !this->editor_->mesh().isFixed(v) && this->moveNode(v);
  }
  return moved;
}

template <int D, class Shape>
bool Improver<D, Shape>::moveNode(Index v)
{
  const SimplexMesh<D>& mesh = this->editor_->mesh();
  const auto& data = mesh.pointData(v);
  if (this->failedAsItIs(data.moveFailed, data.stamp) || !this->editor_->star(v, this->star_))
  {
    return false;
  }
  const double old = mesh.worstQuality(this->star_);
  this->loadStar(v);
  Vec<D> x = mesh.point(v);
  const double now = this->problem_.maximize(
    x, std::max(this->enough(), old + 2 * gain(old)), 0.5 * gain(old));
  const bool better = now > old + gain(old) && (now > 0.0 || this->problem_.isAmidPoints(x));
  this->count(Operation::NodeMotion, better);
  if (!better)
  {
    if (!this->editor_->inTransaction()) // what is undone is another star
    {
      this->editor_->setMoveFailed(v, this->editor_->clock());
    }
    return false;
  }
  const Place start = this->begin();
  this->place(v, x, v);
  if (!this->settleStar(old))
  {
    this->rollback(start);
    return false;
  }
  this->commit(start);
  return true;
}

/// After a move: sets the qualities of star_. False, then to be undone, unless all are above `old`.
template <int D, class Shape>
bool Improver<D, Shape>::settleStar(double old)
{
  long bad = 0;
  for (Index c : this->star_)
  {
    const double q = (*this->model_)(this->editor_->mesh().nodes(c));
    if (!(q > old))
    {
      return false;
    }
    bad += this->badness(q);
    bad -= this->badness(this->editor_->mesh().quality(c));
    this->editor_->setQuality(c, q);
  }
  if (this->guardsAll_ && bad > 0 && old > 0.0)
  {
    return false;
  }
  this->bad_ += bad;
  this->editor_->stamp(this->star_);
  this->changed_.insert(this->changed_.end(), this->star_.begin(), this->star_.end());
  return true;
}

// --- nodes that go

template <int D, class Shape>
bool Improver<D, Shape>::removeNodes(Index t)
{
  const Simplex<D> nodes = this->editor_->mesh().nodes(t);
  for (Index v : nodes)
  {
    if (!this->editor_->mesh().isFixed(v) && this->removeNode(v))
    {
      return true;
    }
  }
  return false;
}

/// Contraction of v to one of its neighbours u: the link of v, less the facets at u, joined to u.
template <int D, class Shape>
bool Improver<D, Shape>::removeNode(Index v)
{
  const SimplexMesh<D>& mesh = this->editor_->mesh();
  const auto& data = mesh.pointData(v);
  if (this->failedAsItIs(data.removeFailed, data.stamp) || !this->editor_->star(v, this->star_))
  {
    return false;
  }
  const double old = mesh.worstQuality(this->star_);
  std::vector<Index> ring;
  std::vector<Facet<D>> link;
  for (Index c : this->star_)
  {
    link.push_back(mesh.facet(c, mesh.localIndex(c, v)));
    ring.insert(ring.end(), link.back().begin(), link.back().end());
  }
  std::sort(ring.begin(), ring.end());
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  double best = old + gain(old);
  this->bestCells_.clear();
  for (Index u : ring)
  {
    double worst = std::numeric_limits<double>::infinity();
    this->cells_.clear();
    for (const Facet<D>& f : link)
    {
      if (std::find(f.begin(), f.end(), u) != f.end())
      {
        continue;
      }
      Simplex<D> cell;
      std::copy(f.begin(), f.end(), cell.begin());
      cell[D] = u;
      worst = std::min(worst, (*this->model_)(cell));
      if (!(worst > best))
      {
        break;
      }
      this->cells_.push_back(cell);
    }
    if (worst > best && !this->cells_.empty())
    {
      best = worst;
      this->bestCells_ = this->cells_;
    }
  }
  this->count(Operation::EdgeContraction, !this->bestCells_.empty());
  if (this->bestCells_.empty() && !this->editor_->inTransaction())
  {
    this->editor_->setRemoveFailed(v, this->editor_->clock());
  }
  return !this->bestCells_.empty() && this->replace(this->star_, this->bestCells_);
}
}

#endif
