// SPDX-License-Identifier: BSD-3-Clause
#ifndef meshopt_Operations_SmallPolyhedron_hxx
#define meshopt_Operations_SmallPolyhedron_hxx

namespace meshopt
{
/// All lists keep their memory: propose() is called for thousands of cells.
template <class Shape>
void SmallPolyhedron<Shape>::start(
  const MeshEditor<3>& editor, const QualityModel<3, Shape>& model, const PolyhedronLimits& limits)
{
  this->editor_ = &editor;
  this->model_ = &model;
  this->limits_ = limits;
  this->limits_.points = std::min(limits.points, MaximumPoints);
  // With a metric or sizes, qualities need ids of the mesh, which offered points do not have.
  this->limits_.newPoints = model.plain ? limits.newPoints : 0;
  this->searches_ = 0;
  this->search_.clear();
  this->meshPoints_.clear();
  this->taken_.clear();
  this->numberOf_.clear();
  this->x_.clear();
  this->ids_.clear();
  this->faces_.clear();
  this->anyEnough_ = false;
  this->worst_ = std::numeric_limits<double>::infinity();
  this->cavity_.clear();
  this->cells_.clear();
  this->newPoints_.clear();
  this->offers_.clear();
}

// --- qualities

template <class Shape>
double SmallPolyhedron<Shape>::quality(const PolyhedronSearch::Tetrahedron& t) const
{
  const auto [a, b, c, d] = t;
  if constexpr (QualityModel<3, Shape>::HasSum)
  {
    // Weights of edges are computed once for each pair of points, when a point comes: a cell costs
    // six additions and a determinant.
    if (this->model_->fast())
    {
      ++evaluationsOfThread;
      const Vec<3> u = this->x_[b] - this->x_[a], v = this->x_[c] - this->x_[a];
      return EdgeSum<Shape>::quality(u.cross(v).dot(this->x_[d] - this->x_[a]),
        this->weight_[a][b] + this->weight_[a][c] + this->weight_[a][d] + this->weight_[b][c] +
          this->weight_[b][d] + this->weight_[c][d]);
    }
  }
  if (this->model_->plain)
  {
    ++evaluationsOfThread;
    return this->model_->quality.shape.value(
      Corners<3>{ this->x_[a], this->x_[b], this->x_[c], this->x_[d] });
  }
  return (*this->model_)(Simplex<3>{ this->ids_[a], this->ids_[b], this->ids_[c], this->ids_[d] });
}

/// Quality of the cell (f, p). If it is enough there, it is above every other quality.
template <class Shape>
double SmallPolyhedron<Shape>::qualityOn(const Face& f, int p) const
{
  const double q = this->quality(
    { f.nodes[0], f.nodes[1], f.nodes[2], static_cast<std::uint8_t>(p) });
  return f.enough >= 0.0 && q >= f.enough ? AsGoodAsAny + q : q;
}

// --- the polyhedron

/// Adds a point; returns its number.
template <class Shape>
int SmallPolyhedron<Shape>::addPoint(const Vec<3>& x, Index id, bool stay)
{
  const int n = static_cast<int>(this->x_.size());
  this->x_.push_back(x);
  this->ids_.push_back(id);
  if constexpr (QualityModel<3, Shape>::HasSum)
  {
    for (int i = 0; i < n; ++i)
    {
      this->weight_[i][n] = this->weight_[n][i] = EdgeSum<Shape>::weight(
        (x - this->x_[i]).squaredNorm());
    }
  }
  this->search_.addPoint(x, stay);
  // Each facet keeps its best apex up to date, so that worstFace() needs no search.
  for (Face& f : this->faces_)
  {
    f.best = std::max(f.best, this->qualityOn(f, n));
  }
  return n;
}

/// The number of node p of the mesh, which is added if necessary.
template <class Shape>
int SmallPolyhedron<Shape>::numberOf(Index p)
{
  const int k = this->meshPoints_.add(p);
  if (k == static_cast<int>(this->numberOf_.size()))
  {
    const SimplexMesh<3>& mesh = this->editor_->mesh();
    // Kept points must be in any filling.
    const bool stay = !mesh.isFree(p) || !this->limits_.mayDropPoints;
    this->numberOf_.push_back(static_cast<std::uint8_t>(this->addPoint(mesh.point(p), p, stay)));
  }
  return this->numberOf_[k];
}

/// Number of nodes of cell c that are not among the points yet.
template <class Shape>
int SmallPolyhedron<Shape>::newcomers(Index c)
{
  const Simplex<3>& nodes = this->editor_->mesh().nodes(c);
  return static_cast<int>(std::count_if(
    nodes.begin(), nodes.end(), [&](Index p) { return this->meshPoints_.get(p) < 0; }));
}

/// True if taking cell c would put a kept facet or a kept edge inside the polyhedron.
template <class Shape>
bool SmallPolyhedron<Shape>::closesKept(Index c)
{
  const SimplexMesh<3>& mesh = this->editor_->mesh();
  for (int i = 0; i < 4; ++i)
  {
    const Index h = mesh.adjacent(c, i);
    if (mesh.isKept(c, i) && h != None && this->taken_.get(mesh.cellOf(h)) >= 0)
    {
      return true;
    }
  }
  return enclosesKeptEdge(mesh, c, [&](Index other) { return this->taken_.get(other) >= 0; });
}

/// The cell across facet i of cell c, if it may be taken in.
template <class Shape>
Index SmallPolyhedron<Shape>::behind(Index c, int i) const
{
  const SimplexMesh<3>& mesh = this->editor_->mesh();
  const Index h = mesh.adjacent(c, i);
  return h == None || mesh.isKept(c, i) || !this->editor_->owns(mesh.cellOf(h)) ? None
                                                                                : mesh.cellOf(h);
}

/// Takes cell c in. False, with nothing changed, if it must not be taken, or if a limit is reached.
template <class Shape>
template <class Enough>
bool SmallPolyhedron<Shape>::take(Index c, Enough& enough)
{
  const SimplexMesh<3>& mesh = this->editor_->mesh();
  // Before anything changes: a refusal leaves nothing to undo.
  const int nodes = static_cast<int>(this->numberOf_.size()) + this->newcomers(c);
  if (nodes > this->limits_.points ||
    nodes + static_cast<int>(this->offers_.size()) > MaximumPoints ||
    static_cast<int>(this->cavity_.size()) == this->limits_.cells || this->closesKept(c))
  {
    return false;
  }
  this->cavity_.push_back(c);
  this->taken_.add(c);
  std::uint8_t local[4];
  // Points first: with them all facets that are there get their best apexes.
  for (int i = 0; i < 4; ++i)
  {
    local[i] = static_cast<std::uint8_t>(this->numberOf(mesh.nodes(c)[i]));
  }
  // A cell that already is enough on its kept facet does not limit the search.
  bool counts = true;
  for (int i = 0; i < 4; ++i)
  {
    const Index h = mesh.adjacent(c, i);
    if (h != None && !mesh.isKept(c, i) && this->taken_.get(mesh.cellOf(h)) >= 0)
    {
      // A facet between two taken cells is inside.
      this->faces_.erase(std::find_if(this->faces_.begin(), this->faces_.end(),
        [&](const Face& f) { return f.cell == mesh.cellOf(h) && f.facet == mesh.facetOf(h); }));
      continue;
    }
    Face f{ {}, c, i, this->behind(c, i), -1.0, Never, false };
    f.enough = mesh.isKept(c, i) ? enough(c, i) : -1.0;
    counts &= !(f.enough >= 0.0 && mesh.quality(c) >= f.enough);
    this->anyEnough_ |= f.enough >= 0.0;
    for (int k = 0; k < 3; ++k)
    {
      f.nodes[k] = local[Local<3>::facets[i][k]];
    }
    // The points that are there are offered to the new facet.
    for (int p = 0; p < static_cast<int>(this->x_.size()); ++p)
    {
      if (std::find(f.nodes.begin(), f.nodes.end(), p) == f.nodes.end())
      {
        f.best = std::max(f.best, this->qualityOn(f, p));
      }
    }
    this->faces_.push_back(f);
  }
  this->worst_ = counts ? std::min(this->worst_, mesh.quality(c)) : this->worst_;
  return true;
}

/// Takes in all cells whose nodes are all there: they enlarge the choice without a new point.
template <class Shape>
template <class Enough>
void SmallPolyhedron<Shape>::takeAlong(Enough& enough)
{
  for (std::size_t k = 0; k < this->faces_.size();)
  {
    const Index c = this->faces_[k].behind;
    const bool taken = c != None && this->newcomers(c) == 0 && this->take(c, enough);
    // Taking a cell changes the list of faces: start again.
    k = taken ? 0 : k + 1;
  }
}

/// The cell to take in next, given a facet without a good tetrahedron (or -1); None if there is
/// none.
template <class Shape>
Index SmallPolyhedron<Shape>::nextCell(int bare)
{
  const SimplexMesh<3>& mesh = this->editor_->mesh();
  if (bare >= 0 && this->faces_[bare].behind != None)
  {
    return this->faces_[bare].behind;
  }
  Index next = None;
  double best = Never;
  for (const Face& f : this->faces_)
  {
    if (f.behind == None)
    {
      continue;
    }
    // Near the bare facet, and useful as its apex; without a bare facet, behind the worst facet.
    double score = -f.best;
    if (bare >= 0)
    {
      const Face& b = this->faces_[bare];
      const Index p = mesh.nodes(f.behind)[mesh.facetOf(mesh.adjacent(f.cell, f.facet))];
      score = (*this->model_)(
        Simplex<3>{ this->ids_[b.nodes[0]], this->ids_[b.nodes[1]], this->ids_[b.nodes[2]], p });
      for (int n : f.nodes)
      {
        score += std::find(b.nodes.begin(), b.nodes.end(), n) != b.nodes.end();
      }
    }
    if (score > best)
    {
      best = score;
      next = f.behind;
    }
  }
  return next;
}

/// Offers places for new nodes over a facet without a good tetrahedron. Returns whether it did:
/// false if it has done so before for this facet, or if no more are allowed.
template <class Shape>
bool SmallPolyhedron<Shape>::offerPoints(int bare)
{
  const double heights[] = { this->limits_.height, 0.5 * this->limits_.height };
  const auto room = [this]
  {
    return static_cast<int>(this->offers_.size()) < this->limits_.newPoints &&
      static_cast<int>(this->x_.size()) < MaximumPoints;
  };
  if (bare < 0 || this->faces_[bare].offered || !room())
  {
    return false;
  }
  this->faces_[bare].offered = true;
  const PolyhedronSearch::Triangle f = this->faces_[bare].nodes;
  const Vec<3> middle = (this->x_[f[0]] + this->x_[f[1]] + this->x_[f[2]]) / 3.0;
  Vec<3> apex = middle;
  // Where a cell on this facet would be best; no quality is enough, so that the place is exact.
  facetCap(
    this->x_[f[0]], this->x_[f[1]], this->x_[f[2]], std::numeric_limits<double>::infinity(), &apex);
  for (double height : heights)
  {
    if (room())
    {
      const Index id = FirstNew - static_cast<Index>(this->offers_.size());
      this->offers_.push_back(middle + height * (apex - middle));
      this->addPoint(this->offers_.back(), id, false);
    }
  }
  return true;
}

// --- the search

/// The facet with the lowest best quality over all points, if that is not above `above`; else -1.
template <class Shape>
int SmallPolyhedron<Shape>::worstFace(double above) const
{
  const auto worst = std::min_element(this->faces_.begin(), this->faces_.end(),
    [](const Face& a, const Face& b) { return a.best < b.best; });
  return worst->best > above ? -1 : static_cast<int>(worst - this->faces_.begin());
}

/// Prepares rating().
template <class Shape>
void SmallPolyhedron<Shape>::noteEnough()
{
  if (this->anyEnough_)
  {
    this->enoughOfSide_.assign(PolyhedronSearch::NumberOfSides, -1.0);
    for (const Face& f : this->faces_)
    {
      this->enoughOfSide_[PolyhedronSearch::sideOf(f.nodes[0], f.nodes[1], f.nodes[2])] = f.enough;
    }
  }
}

/// The quality of a candidate. If it is enough on its kept facet, it must not limit the worst one.
template <class Shape>
double SmallPolyhedron<Shape>::rating(const PolyhedronSearch::Candidate& t) const
{
  const double q = this->quality(t.nodes);
  const auto isEnough = [&](int side)
  { return this->enoughOfSide_[side] >= 0.0 && q >= this->enoughOfSide_[side]; };
  return this->anyEnough_ && std::any_of(t.sides.begin(), t.sides.end(), isEnough) ? AsGoodAsAny + q
                                                                                   : q;
}

/// Searches for a filling of the present polyhedron. Never if there is none better than `above`, or
/// if there are too many facets. `bare`: a facet without a good tetrahedron, or -1.
template <class Shape>
double SmallPolyhedron<Shape>::fill(double above, int& bare)
{
  this->boundary_.clear();
  for (const Face& f : this->faces_)
  {
    this->boundary_.push_back(f.nodes);
  }
  if (!this->search_.setBoundary(this->boundary_))
  {
    return Never;
  }
  ++this->searches_;
  this->noteEnough();
  bare = this->search_.findBareFacet(
    [&](const PolyhedronSearch::Candidate& t) { return this->rating(t) > above; });
  if (bare >= 0)
  {
    return Never;
  }
  this->search_.findCandidates();
  for (PolyhedronSearch::Candidate& t : this->search_.candidates())
  {
    t.quality = this->rating(t);
  }
  const double q = this->search_.search(above, this->limits_.steps);
  bare = this->search_.bareFacet();
  return q;
}

/// Puts the result of the search into cells_ and newPoints_. Offers that it did not use are
/// dropped.
template <class Shape>
void SmallPolyhedron<Shape>::keepSolution()
{
  std::vector<Index> place(this->offers_.size(), None);
  for (const PolyhedronSearch::Tetrahedron& t : this->search_.cells())
  {
    Simplex<3> cell;
    for (int i = 0; i < 4; ++i)
    {
      cell[i] = this->ids_[t[i]];
      if (cell[i] <= FirstNew)
      {
        // Numbered in the order of their first use.
        Index& k = place[FirstNew - cell[i]];
        if (k == None)
        {
          k = static_cast<Index>(this->newPoints_.size());
          this->newPoints_.push_back(this->x_[t[i]]);
        }
        cell[i] = FirstNew - k;
      }
    }
    this->cells_.push_back(cell);
  }
}

/// Once the points are in the mesh, their ids take the place of FirstNew - k.
template <class Shape>
void SmallPolyhedron<Shape>::nameNewPoints(const std::vector<Index>& ids)
{
  for (Simplex<3>& cell : this->cells_)
  {
    for (Index& p : cell)
    {
      p = p <= FirstNew ? ids[FirstNew - p] : p;
    }
  }
}

/// Grows the polyhedron cell by cell. After each step it is searched for a filling, if every facet
/// has a good apex.
template <class Shape>
template <class Enough>
double SmallPolyhedron<Shape>::propose(const MeshEditor<3>& editor,
  const QualityModel<3, Shape>& model, Index t, double above, const PolyhedronLimits& limits,
  Enough&& enough)
{
  this->start(editor, model, limits);
  Index next = t;
  while (next != None && this->take(next, enough))
  {
    this->takeAlong(enough);
    int bare = -1;
    do
    {
      // By more than rounding, or two fillings of equal quality could replace each other for ever.
      const double bound = std::max(above, this->worst_) + Rounding;
      // Cheap test first: a facet for which no point is good enough rules out every filling.
      bare = this->worstFace(bound);
      if (bare < 0)
      {
        if (this->searches_ == this->limits_.searches)
        {
          return Never;
        }
        const double q = this->fill(bound, bare);
        if (q > bound)
        {
          this->keepSolution();
          // If all cells are enough on their kept facets, take off what was added.
          return q < AsGoodAsAny ? q : std::min(1.0, q - AsGoodAsAny);
        }
      }
    } while (this->offerPoints(bare));
    next = this->nextCell(bare);
  }
  return Never;
}

template <class Shape>
double SmallPolyhedron<Shape>::propose(const MeshEditor<3>& editor,
  const QualityModel<3, Shape>& model, Index t, double above, const PolyhedronLimits& limits)
{
  return this->propose(editor, model, t, above, limits, [](Index, int) { return -1.0; });
}
}

#endif
