// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/MeshEditor.h"

#include "Mesh/MeshEditorReplace.hxx"

#include <algorithm>
#include <cassert>

namespace meshopt
{
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
        this->mesh_->points_[r.id].restore(r.point);
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
bool MeshEditor<D>::star(Index p, std::vector<Index>& star)
{
  const Mesh& mesh = *this->mesh_;
  const std::uint32_t seen = this->newMark();
  star.clear();
  if (this->owner_ != None && mesh.points_[p].owner != this->owner_)
  {
    this->blocked_ = true;
    return false; // the point's cell may be changing
  }
  star.push_back(mesh.points_[p].cell);
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
