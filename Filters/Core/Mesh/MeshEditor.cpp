// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/MeshEditor.h"

#include <algorithm>
#include <cassert>

namespace meshopt
{
namespace
{
template <int D>
Facet<D> sorted(Facet<D> f)
{
  if (f[0] > f[1])
  {
    std::swap(f[0], f[1]);
  }
  if constexpr (D == 3)
  {
    if (f[1] > f[2])
    {
      std::swap(f[1], f[2]);
    }
    if (f[0] > f[1])
    {
      std::swap(f[0], f[1]);
    }
  }
  return f;
}

template <int D>
std::size_t hash(const Facet<D>& f)
{
  std::uint32_t h = std::uint32_t(f[0]) * 2654435761u;
  h = (h ^ std::uint32_t(f[1])) * 2246822519u;
  if constexpr (D == 3)
  {
    h = (h ^ std::uint32_t(f[2])) * 3266489917u;
  }
  return h ^ (h >> 15);
}
}

template <int D>
MeshEditor<D>::MeshEditor(Mesh& mesh)
  : mesh_(&mesh)
{
  // Take over from whoever edited before: marks and stamps only ever grow.
  for (const CellData& data : mesh.cellData_)
  {
    this->mark_ = std::max(this->mark_, data.mark);
  }
  for (const Point& p : mesh.points_)
  {
    this->clock_ = std::max(this->clock_, p.stamp);
  }
}

template <int D>
MeshEditor<D>::MeshEditor(Mesh& mesh, std::uint32_t clock, std::uint32_t mark)
  : mesh_(&mesh)
  , clock_(clock)
  , mark_(mark)
{
}

// --- slots

template <int D>
void MeshEditor<D>::growCells(Index n)
{
  const Index first = this->mesh_->numberOfCellSlots();
  this->mesh_->cells_.resize(first + n);
  this->mesh_->cellData_.resize(first + n);
  for (Index c = first + n; c-- > first;)
  {
    this->freeCells_.push_back(c);
  }
}

template <int D>
void MeshEditor<D>::growPoints(Index n)
{
  const Index first = this->mesh_->numberOfPointSlots();
  this->mesh_->points_.resize(first + n);
  for (Index p = first + n; p-- > first;)
  {
    this->freePoints_.push_back(p);
  }
}

template <int D>
bool MeshEditor<D>::reserveCells(std::size_t n)
{
  const bool room = n <= this->freeCells_.size() || this->owner_ == None;
  this->blocked_ |= !room;
  return room;
}

template <int D>
Index MeshEditor<D>::takeCell()
{
  if (!this->freeCells_.empty())
  {
    const Index c = this->freeCells_.back();
    this->freeCells_.pop_back();
    if (this->depth_ > 0)
    {
      this->journal_.push_back(Entry::CellTaken);
      this->slotRecords_.push_back(c);
      this->saveCell(c);
    }
    return c;
  }
  this->mesh_->cells_.emplace_back();
  this->mesh_->cellData_.emplace_back();
  if (this->depth_ > 0)
  {
    this->journal_.push_back(Entry::CellGrown);
  }
  return this->mesh_->numberOfCellSlots() - 1;
}

template <int D>
void MeshEditor<D>::freeCell(Index c)
{
  this->saveCell(c);
  this->mesh_->cellData_[c].flags = 0;
  this->freeCells_.push_back(c);
  if (this->depth_ > 0)
  {
    this->journal_.push_back(Entry::CellFreed);
  }
}

template <int D>
Index MeshEditor<D>::addPoint(const Vec<D>& x)
{
  Index p = None;
  if (!this->freePoints_.empty())
  {
    p = this->freePoints_.back();
    this->freePoints_.pop_back();
    if (this->depth_ > 0)
    {
      this->journal_.push_back(Entry::PointTaken);
      this->slotRecords_.push_back(p);
      this->savePoint(p);
    }
  }
  else if (this->owner_ == None)
  {
    p = this->mesh_->numberOfPointSlots();
    this->mesh_->points_.emplace_back();
    if (this->depth_ > 0)
    {
      this->journal_.push_back(Entry::PointGrown);
    }
  }
  else
  {
    this->blocked_ = true;
    return None;
  }
  Point& point = this->mesh_->points_[p];
  point.x = x;
  point.cell = None;
  point.stamp = ++this->clock_;
  point.owner = this->owner_ == None ? 0 : this->owner_;
  point.flags = Mesh::PointMoved;
  static_cast<CurvePlace<D>&>(point) = CurvePlace<D>();
  return p;
}

template <int D>
void MeshEditor<D>::dropPoint(Index p)
{
  assert(!this->mesh_->isPointAlive(p) && p >= this->mesh_->inputPoints_);
  this->savePoint(p);
  this->freePoints_.push_back(p);
  if (this->depth_ > 0)
  {
    this->journal_.push_back(Entry::PointFreed);
  }
}

// --- journal

template <int D>
void MeshEditor<D>::saveCell(Index c)
{
  if (this->depth_ > 0)
  {
    this->journal_.push_back(Entry::CellChanged);
    this->cellRecords_.push_back({ c, this->mesh_->cells_[c], this->mesh_->cellData_[c] });
  }
}

template <int D>
void MeshEditor<D>::savePoint(Index p)
{
  if (this->depth_ > 0)
  {
    this->journal_.push_back(Entry::PointChanged);
    this->pointRecords_.push_back({ p, this->mesh_->points_[p] });
  }
}

template <int D>
std::size_t MeshEditor<D>::begin()
{
  ++this->depth_;
  return this->journal_.size();
}

template <int D>
void MeshEditor<D>::commit(std::size_t)
{
  if (--this->depth_ == 0)
  {
    this->journal_.clear();
    this->cellRecords_.clear();
    this->linkRecords_.clear();
    this->pointRecords_.clear();
    this->slotRecords_.clear();
  }
}

template <int D>
void MeshEditor<D>::rollback(std::size_t place)
{
  const auto pop = [](auto& stack)
  {
    auto last = stack.back();
    stack.pop_back();
    return last;
  };
  while (this->journal_.size() > place)
  {
    switch (pop(this->journal_))
    {
      case Entry::CellChanged:
      {
        const CellRecord r = pop(this->cellRecords_);
        const std::uint32_t mark = this->mesh_->cellData_[r.id].mark;
        this->mesh_->cells_[r.id] = r.cell;
        this->mesh_->cellData_[r.id] = r.data;
        this->mesh_->cellData_[r.id].mark = mark;
        break;
      }
      case Entry::LinkChanged:
      {
        const LinkRecord r = pop(this->linkRecords_);
        this->mesh_->cells_[Mesh::cellOf(r.handle)].adjacent[Mesh::facetOf(r.handle)] = r.adjacent;
        break;
      }
      case Entry::PointChanged:
      {
        const PointRecord r = pop(this->pointRecords_);
        this->mesh_->points_[r.id] = r.point;
        break;
      }
      case Entry::CellTaken:
        this->freeCells_.push_back(pop(this->slotRecords_));
        break;
      case Entry::CellGrown:
        this->mesh_->cells_.pop_back();
        this->mesh_->cellData_.pop_back();
        break;
      case Entry::CellFreed:
        this->freeCells_.pop_back();
        break;
      case Entry::PointTaken:
        this->freePoints_.push_back(pop(this->slotRecords_));
        break;
      case Entry::PointGrown:
        this->mesh_->points_.pop_back();
        break;
      case Entry::PointFreed:
        this->freePoints_.pop_back();
        break;
    }
  }
  this->commit(place);
}

// --- edits

template <int D>
void MeshEditor<D>::movePoint(Index p, const Vec<D>& x)
{
  this->savePoint(p);
  Point& point = this->mesh_->points_[p];
  point.x = x;
  point.flags |= Mesh::PointMoved;
  point.stamp = ++this->clock_;
}

template <int D>
void MeshEditor<D>::setCurvePlace(Index p, const CurvePlace<D>& place)
{
  this->savePoint(p);
  static_cast<CurvePlace<D>&>(this->mesh_->points_[p]) = place;
}

template <int D>
void MeshEditor<D>::setQuality(Index c, double q)
{
  this->saveCell(c);
  this->mesh_->cellData_[c].quality = q;
}

template <int D>
void MeshEditor<D>::stamp(const std::vector<Index>& cells)
{
  ++this->clock_;
  for (Index c : cells)
  {
    for (Index p : this->mesh_->cells_[c].nodes)
    {
      if (this->mesh_->points_[p].stamp != this->clock_)
      {
        this->savePoint(p);
        this->mesh_->points_[p].stamp = this->clock_;
      }
    }
  }
}

template <int D>
void MeshEditor<D>::collectOpenFacets(
  const std::vector<Index>& cavity, std::uint32_t inCavity, const KeptChange<D>* change)
{
  this->facets_.clear();
  const auto isGone = [&](const Facet<D>& key)
  {
    return change &&
      std::any_of(change->gone.begin(), change->gone.end(),
        [&](const Facet<D>& f) { return sorted<D>(f) == key; });
  };
  for (Index c : cavity)
  {
    for (int i = 0; i <= D; ++i)
    {
      const Index h = this->mesh_->cells_[c].adjacent[i];
      const bool kept = this->mesh_->isConstrained(c, i);
      if (kept && isGone(sorted<D>(this->mesh_->facet(c, i))))
      {
        continue;
      }
      if (h == None || !this->owns(Mesh::cellOf(h)) || !this->isMarked(Mesh::cellOf(h), inCavity))
      {
        this->facets_.push_back(
          { sorted<D>(this->mesh_->facet(c, i)), h, this->mesh_->parent(c), kept, false });
      }
      else
      {
        assert(!kept && "a kept facet inside of a cavity");
      }
    }
  }
}

template <int D>
void MeshEditor<D>::collectKeptEdges(const std::vector<Index>& cavity)
{
  this->keptEdges_.clear();
  if (!this->mesh_->hasConstrainedEdges_)
  {
    return;
  }
  for (Index c : cavity)
  {
    for (int e = 0; e < Local<D>::numberOfEdges; ++e)
    {
      if (this->mesh_->isEdgeConstrained(c, e))
      {
        const Simplex<D>& t = this->mesh_->nodes(c);
        const Index a = t[Local<D>::edges[e][0]], b = t[Local<D>::edges[e][1]];
        this->keptEdges_.push_back({ std::min(a, b), std::max(a, b) });
      }
    }
  }
}

/// Copies the marks of kept edges to a new cell that has them.
template <int D>
void MeshEditor<D>::keepEdges(Index c)
{
  const Simplex<D>& t = this->mesh_->nodes(c);
  for (int e = 0; e < Local<D>::numberOfEdges; ++e)
  {
    const Index a = t[Local<D>::edges[e][0]], b = t[Local<D>::edges[e][1]];
    const std::array<Index, 2> edge{ std::min(a, b), std::max(a, b) };
    if (std::find(this->keptEdges_.begin(), this->keptEdges_.end(), edge) != this->keptEdges_.end())
    {
      this->mesh_->cellData_[c].flags |= std::uint16_t(1u << (Mesh::FirstEdgeBit + e));
    }
  }
}

/// Marks facets of the new cells as kept, and their points as fixed.
template <int D>
void MeshEditor<D>::keepFacets(const std::vector<Facet<D>>& facets)
{
  for (Index c : this->created_)
  {
    for (int i = 0; i <= D; ++i)
    {
      const Facet<D> key = sorted<D>(this->mesh_->facet(c, i));
      if (std::any_of(facets.begin(), facets.end(),
            [&](const Facet<D>& f) { return sorted<D>(f) == key; }))
      {
        this->mesh_->cellData_[c].flags |= std::uint16_t(1u << i);
        for (Index p : key) // saved already: they are of the cavity, or new
        {
          this->mesh_->points_[p].flags |= Mesh::PointFixed | Mesh::PointBoundary;
        }
      }
    }
  }
}

/// All points of the cavity are dead until a new cell uses them.
template <int D>
void MeshEditor<D>::killPoints(const std::vector<Index>& cavity)
{
  this->cavityPoints_.clear();
  for (Index c : cavity)
  {
    for (Index p : this->mesh_->nodes(c))
    {
      Point& point = this->mesh_->points_[p];
      if (point.flags & Mesh::PointAlive)
      {
        this->savePoint(p);
        point.flags &= std::uint8_t(~Mesh::PointAlive);
        point.stamp = this->clock_;
        this->cavityPoints_.push_back(p);
      }
    }
  }
}

template <int D>
void MeshEditor<D>::buryPoints()
{
  for (Index p : this->cavityPoints_)
  {
    Point& point = this->mesh_->points_[p];
    if (!(point.flags & Mesh::PointAlive))
    {
      point.cell = None;
      if (p >= this->mesh_->inputPoints_) // slots of input points keep their meaning
      {
        this->freePoints_.push_back(p);
        if (this->depth_ > 0)
        {
          this->journal_.push_back(Entry::PointFreed);
        }
      }
    }
  }
}

template <int D>
void MeshEditor<D>::hashOpenFacets(std::size_t numberOfNewCells)
{
  std::size_t size = 64;
  while (size < 2 * (this->facets_.size() + (D + 1) * numberOfNewCells))
  {
    size *= 2;
  }
  this->table_.assign(size, None);
  for (std::size_t f = 0; f < this->facets_.size(); ++f)
  {
    std::size_t k = hash<D>(this->facets_[f].key) & (size - 1);
    while (this->table_[k] != None)
    {
      k = (k + 1) & (size - 1);
    }
    this->table_[k] = static_cast<Index>(f);
  }
}

template <int D>
void MeshEditor<D>::create(const Simplex<D>& nodes, double quality, Index region)
{
  const Index c = this->takeCell();
  this->created_.push_back(c);
  this->mesh_->cells_[c].nodes = nodes;
  this->mesh_->cells_[c].adjacent.fill(None);
  CellData& data = this->mesh_->cellData_[c];
  data.quality = quality;
  data.region = region;
  data.stamp = 0;
  data.level = 0;
  data.flags = Mesh::CellAlive;
  for (Index p : nodes)
  {
    Point& point = this->mesh_->points_[p];
    if (!(point.flags & Mesh::PointAlive) && point.cell == None)
    {
      this->savePoint(p); // comes from addPoint(); the points of the cavity are saved already
    }
    point.flags |= Mesh::PointAlive;
    point.cell = c;
    point.stamp = this->clock_;
  }
}

/// Links facet i of the new cell c, or leaves it open for the cell to come on its other side.
/// Returns the parent of the cavity cell behind it, or None for a facet inside of the cavity.
template <int D>
Index MeshEditor<D>::linkFacet(Index c, int i)
{
  const Facet<D> key = sorted<D>(this->mesh_->facet(c, i));
  const std::size_t mask = this->table_.size() - 1;
  std::size_t k = hash<D>(key) & mask;
  while (this->table_[k] != None && this->facets_[this->table_[k]].key != key)
  {
    k = (k + 1) & mask;
  }
  if (this->table_[k] == None)
  {
    this->table_[k] = static_cast<Index>(this->facets_.size());
    this->facets_.push_back({ key, Mesh::handle(c, i), None, false, false });
    return None;
  }
  OpenFacet& f = this->facets_[this->table_[k]];
  assert(!f.closed && "a facet with three cells");
  f.closed = true;
  this->mesh_->cells_[c].adjacent[i] = f.outside;
  this->mesh_->cellData_[c].flags |= std::uint16_t(f.kept ? 1u << i : 0u);
  if (f.outside != None)
  {
    Index& link = this->mesh_->cells_[Mesh::cellOf(f.outside)].adjacent[Mesh::facetOf(f.outside)];
    if (f.parent != None && this->depth_ > 0) // outside of the cavity; new cells are saved already
    {
      this->journal_.push_back(Entry::LinkChanged);
      this->linkRecords_.push_back({ f.outside, link });
    }
    link = Mesh::handle(c, i);
  }
  return f.parent;
}

/// For a new cell that has no facet of the cavity's boundary: the parent of a cell of its region.
template <int D>
Index MeshEditor<D>::parentIn(Index region) const
{
  for (const std::array<Index, 2>& r : this->parents_)
  {
    if (r[0] == region)
    {
      return r[1];
    }
  }
  return this->parents_[0][1];
}

template <int D>
bool MeshEditor<D>::replace(const std::vector<Index>& cavity, const std::vector<Simplex<D>>& cells,
  const std::vector<double>& qualities, const KeptChange<D>* change)
{
  assert(cells.size() == qualities.size());
  assert(!change || change->regions.size() == cells.size());
  if (cells.size() > cavity.size() && !this->reserveCells(cells.size() - cavity.size()))
  {
    return false;
  }
  ++this->clock_;
  const std::uint32_t inCavity = this->newMark();
  for (Index c : cavity)
  {
    this->setMark(c, inCavity);
  }
  this->collectOpenFacets(cavity, inCavity, change);
  this->collectKeptEdges(cavity);
  this->killPoints(cavity);
  const Index region = this->mesh_->region(cavity[0]);
  this->parents_.clear();
  for (Index c : cavity)
  {
    this->parents_.push_back({ this->mesh_->region(c), this->mesh_->parent(c) });
  }
  for (std::size_t k = cavity.size(); k-- > 0;)
  {
    this->freeCell(cavity[k]);
  }
  this->hashOpenFacets(cells.size());
  this->created_.clear();
  for (std::size_t n = 0; n < cells.size(); ++n)
  {
    this->create(cells[n], qualities[n], change ? change->regions[n] : region);
  }
  for (Index c : this->created_)
  {
    Index behind = None;
    for (int i = 0; i <= D; ++i)
    {
      const Index facetParent = this->linkFacet(c, i);
      behind = behind == None ? facetParent : behind;
    }
    this->mesh_->cellData_[c].parent =
      behind == None ? this->parentIn(this->mesh_->region(c)) : behind;
    if (!this->keptEdges_.empty())
    {
      this->keepEdges(c);
    }
  }
  if (change)
  {
    this->keepFacets(change->come);
  }
#ifndef NDEBUG
  for (const OpenFacet& f : this->facets_)
  {
    assert((f.closed || change) && "the new cells do not fill the cavity");
  }
#endif
  this->buryPoints();
  return true;
}

template <int D>
bool MeshEditor<D>::star(Index p, std::vector<Index>& star)
{
  const Mesh& mesh = *this->mesh_;
  const std::uint32_t seen = this->newMark();
  star.assign(1, mesh.points_[p].cell);
  if (!this->owns(star[0]))
  {
    return false;
  }
  this->setMark(star[0], seen);
  for (std::size_t k = 0; k < star.size(); ++k)
  {
    const Cell& cell = mesh.cells_[star[k]];
    for (int i = 0; i <= D; ++i)
    {
      const Index h = cell.adjacent[i];
      if (cell.nodes[i] == p || h == None)
      {
        continue;
      }
      if (!this->owns(Mesh::cellOf(h)))
      {
        return false; // not even its mark may be looked at
      }
      if (this->isMarked(Mesh::cellOf(h), seen))
      {
        continue;
      }
      this->setMark(Mesh::cellOf(h), seen);
      star.push_back(Mesh::cellOf(h));
    }
  }
  return true;
}

template class MeshEditor<2>;
template class MeshEditor<3>;
}
