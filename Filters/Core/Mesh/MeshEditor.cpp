// SPDX-License-Identifier: BSD-3-Clause
// Slots, the journal and single edits; replace() is in MeshEditorReplace.hxx. Whatever changes the
// mesh first saves what it overwrites: that is all that undo needs.
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
  // Continue after whoever edited before: marks and stamps only ever grow.
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
MeshEditor<D> MeshEditor<D>::beside(const MeshEditor& other)
{
  MeshEditor editor;
  editor.mesh_ = other.mesh_;
  // Stamps and marks on the mesh are compared with these: a new start at 0 would match old ones.
  editor.clock_ = other.clock_;
  editor.mark_ = other.mark_;
  for (PointAttachment<D>* attachment : other.attachments_)
  {
    // Makes another journal: editors that work at the same time must not share one.
    editor.attach(*attachment);
  }
  return editor;
}

template <int D>
void MeshEditor<D>::attach(PointAttachment<D>& attachment)
{
  assert(this->depth_ == 0);
  // Room for all points now: nothing may grow while several editors place points.
  attachment.reserve(this->mesh_->numberOfPointSlots());
  this->attachments_.push_back(&attachment);
  this->attachmentJournals_.push_back(attachment.makeJournal());
}

template <int D>
void MeshEditor<D>::detach(PointAttachment<D>& attachment)
{
  assert(this->depth_ == 0);
  const auto at = std::find(this->attachments_.begin(), this->attachments_.end(), &attachment);
  this->attachmentJournals_.erase(
    this->attachmentJournals_.begin() + (at - this->attachments_.begin()));
  this->attachments_.erase(at);
}

/// Patches exist for all cell slots or for none. `isFirst`: create them.
template <int D>
void MeshEditor<D>::growPatches(bool isFirst)
{
  if (isFirst || !this->mesh_->patches_.empty())
  {
    Patches none;
    none.fill(None);
    this->mesh_->patches_.resize(this->mesh_->cells_.size(), none);
  }
}

/// All that is stored per point gets as long as the array of points.
template <int D>
void MeshEditor<D>::growAttachments()
{
  if (!this->mesh_->places_.empty())
  {
    this->mesh_->places_.resize(this->mesh_->points_.size());
  }
  for (PointAttachment<D>* attachment : this->attachments_)
  {
    attachment->reserve(this->mesh_->numberOfPointSlots());
  }
}

// --- slots

template <int D>
void MeshEditor<D>::growCells(Index n)
{
  const Index first = this->mesh_->numberOfCellSlots();
  this->mesh_->cells_.resize(first + n);
  this->mesh_->cellData_.resize(first + n);
  this->growPatches();
  // In reverse, so that the lowest id is taken first from the back.
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
  this->growAttachments();
  for (Index p = first + n; p-- > first;)
  {
    this->freePoints_.push_back(p);
  }
}

/// True if n cells can be taken. The editor of the whole mesh may always grow it. That of a chunk
/// must not: other editors read the same arrays.
template <int D>
bool MeshEditor<D>::reserveCells(std::size_t n)
{
  const bool room = n <= this->freeCells_.size() || this->owner_ == None;
  // Such a failure is due to the pool, not to the mesh.
  this->isHeldUp_ |= !room;
  return room;
}

/// A slot for a new cell, which create() fills. Taken from the back of the pool, where freeCell()
/// puts slots: new cells get the slots of the cavity they replace.
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
      this->saveCell(c); // also of a dead slot: undo is bit for bit
    }
    return c;
  }
  // Only the editor of the whole mesh gets here: reserveCells() has refused the others.
  this->mesh_->cells_.emplace_back();
  this->mesh_->cellData_.emplace_back();
  this->growPatches();
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
  // The rest of the slot stays as it is until create() overwrites it.
  this->mesh_->cellData_[c].flags = 0;
  this->freeCells_.push_back(c);
  if (this->depth_ > 0)
  {
    this->journal_.push_back(Entry::CellFreed);
  }
}

/// A slot for a new point; None if the pool has none and the mesh may not grow.
template <int D>
Index MeshEditor<D>::takePoint()
{
  if (!this->freePoints_.empty())
  {
    const Index p = this->freePoints_.back();
    this->freePoints_.pop_back();
    if (this->depth_ > 0)
    {
      this->journal_.push_back(Entry::PointTaken);
      this->slotRecords_.push_back(p);
      // Also of a dead slot: undo is bit for bit.
      this->savePoint(p);
      this->savePlace(p);
    }
    return p;
  }
  if (this->owner_ != None)
  {
    this->isHeldUp_ = true;
    return None;
  }
  this->mesh_->points_.emplace_back();
  this->growAttachments();
  if (this->depth_ > 0)
  {
    this->journal_.push_back(Entry::PointGrown);
  }
  return this->mesh_->numberOfPointSlots() - 1;
}

/// The point is dead until replace() makes a cell with it.
template <int D>
Index MeshEditor<D>::addPoint(const Vec<D>& x)
{
  const Index p = this->takePoint();
  if (p != None)
  {
    Point& point = this->mesh_->points_[p];
    point.x = x;
    point.cell = None;
    // A new time: earlier failures of a point in this slot do not count.
    point.stamp = ++this->clock_;
    point.owner = this->owner_ == None ? 0 : this->owner_;
    point.flags = 0;
    if (!this->mesh_->places_.empty())
    {
      this->mesh_->places_[p] = Place();
    }
  }
  return p;
}

// --- journal

/// Saves the cell as a whole. It may be saved several times in one transaction: undo goes in
/// reverse and ends with the oldest record, so nobody has to look for an earlier one.
template <int D>
void MeshEditor<D>::saveCell(Index c)
{
  if (this->depth_ > 0)
  {
    this->journal_.push_back(Entry::CellChanged);
    this->cellRecords_.push_back({ c, this->mesh_->cells_[c], this->mesh_->cellData_[c] });
    if (!this->mesh_->patches_.empty())
    {
      this->patchRecords_.push_back(this->mesh_->patches_[c]);
    }
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

/// Apart from savePoint(), since few meshes have places and few edits change them.
template <int D>
void MeshEditor<D>::savePlace(Index p)
{
  if (this->depth_ > 0 && !this->mesh_->places_.empty())
  {
    this->journal_.push_back(Entry::PlaceChanged);
    this->placeRecords_.push_back({ p, this->mesh_->places_[p] });
  }
}

/// One entry for all attachments: their journals save and undo in step with each other.
template <int D>
void MeshEditor<D>::saveAttachments(Index p)
{
  if (this->depth_ > 0 && !this->attachments_.empty())
  {
    this->journal_.push_back(Entry::AttachmentsChanged);
    for (const auto& values : this->attachmentJournals_)
    {
      values->save(p);
    }
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
  // An inner transaction keeps its entries: the outer one may still be rolled back.
  if (--this->depth_ == 0)
  {
    this->journal_.clear();
    this->cellRecords_.clear();
    this->patchRecords_.clear();
    this->linkRecords_.clear();
    this->pointRecords_.clear();
    this->placeRecords_.clear();
    this->slotRecords_.clear();
    for (const auto& values : this->attachmentJournals_)
    {
      values->clear();
    }
  }
}

template <int D>
void MeshEditor<D>::rollback(std::size_t place)
{
  while (this->journal_.size() > place)
  {
    const Entry last = this->journal_.back();
    this->journal_.pop_back();
    this->undo(last);
  }
  // Closes the transaction; its entries are gone already.
  this->commit(place);
}

/// Undoes one entry. Records lie on a stack for each kind, so the kind alone tells what to pop.
template <int D>
void MeshEditor<D>::undo(Entry entry)
{
  const auto pop = [](auto& stack)
  {
    auto last = stack.back();
    stack.pop_back();
    return last;
  };
  switch (entry)
  {
    case Entry::CellChanged:
    {
      const CellRecord r = pop(this->cellRecords_);
      const std::uint32_t mark = this->mesh_->cellData_[r.id].mark;
      this->mesh_->cells_[r.id] = r.cell;
      // The mark is scratch, not state: code that is using it must find it as it left it.
      this->mesh_->cellData_[r.id] = r.data;
      this->mesh_->cellData_[r.id].mark = mark;
      if (!this->mesh_->patches_.empty())
      {
        this->mesh_->patches_[r.id] = pop(this->patchRecords_);
      }
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
      // Without the owner, which other threads may be reading.
      this->mesh_->points_[r.id].restore(r.point);
      break;
    }
    case Entry::PlaceChanged:
    {
      const PlaceRecord r = pop(this->placeRecords_);
      this->mesh_->places_[r.id] = r.place;
      break;
    }
    case Entry::AttachmentsChanged:
      for (const auto& values : this->attachmentJournals_)
      {
        values->undo();
      }
      break;
    case Entry::CellTaken:
      this->freeCells_.push_back(pop(this->slotRecords_));
      break;
    case Entry::CellGrown:
      // Entries are undone in reverse, so the last slot of the array is the one that was added.
      this->mesh_->cells_.pop_back();
      this->mesh_->cellData_.pop_back();
      if (!this->mesh_->patches_.empty())
      {
        this->mesh_->patches_.pop_back();
      }
      break;
    case Entry::CellFreed:
      // Later entries are undone already, so the slot that was freed is the last one again.
      this->freeCells_.pop_back();
      break;
    case Entry::PointTaken:
      this->freePoints_.push_back(pop(this->slotRecords_));
      break;
    case Entry::PointGrown:
      // Attachments keep their room. Their values have entries of their own.
      this->mesh_->points_.pop_back();
      if (!this->mesh_->places_.empty())
      {
        this->mesh_->places_.pop_back();
      }
      break;
    case Entry::PointFreed:
      this->freePoints_.pop_back();
      break;
  }
}

// --- edits

template <int D>
void MeshEditor<D>::movePoint(Index p, const Vec<D>& x, Index near)
{
  // Saved even if the point does not move: attachments may change nevertheless.
  this->savePoint(p);
  this->saveAttachments(p);
  Point& point = this->mesh_->points_[p];
  // A point that stays where it is changes no star: earlier failures around it still count.
  point.stamp = point.x == x ? point.stamp : ++this->clock_;
  point.x = x;
  for (PointAttachment<D>* attachment : this->attachments_)
  {
    attachment->pointPlaced(p, x, near == None ? p : near);
  }
}

template <int D>
void MeshEditor<D>::setQuality(Index c, double q)
{
  this->saveCell(c);
  this->mesh_->cellData_[c].quality = q;
}

/// Algorithms compare stamps of points with the time of their failed tries. A new stamp says that a
/// new try around the point may succeed.
template <int D>
void MeshEditor<D>::stamp(const std::vector<Index>& cells)
{
  ++this->clock_;
  for (Index c : cells)
  {
    for (Index p : this->mesh_->cells_[c].nodes)
    {
      // Saves each point once, although several cells share it.
      if (this->mesh_->points_[p].stamp != this->clock_)
      {
        this->savePoint(p);
        this->mesh_->points_[p].stamp = this->clock_;
      }
    }
  }
}

/// The same cells in the same order as SimplexMesh::star(), as far as the editor owns them.
template <int D>
bool MeshEditor<D>::star(Index p, std::vector<Index>& star)
{
  const Mesh& mesh = *this->mesh_;
  const std::uint32_t seen = this->newMark();
  star.clear();
  if (this->owner_ != None && mesh.points_[p].owner != this->owner_)
  {
    this->isHeldUp_ = true;
    return false; // the point's cell may be changing at this moment
  }
  star.push_back(mesh.points_[p].cell);
  if (!this->owns(star[0]))
  {
    return false;
  }
  // Marks are written only on cells that the editor owns: others may be in use by another thread.
  this->setMark(star[0], seen);
  for (std::size_t k = 0; k < star.size(); ++k)
  {
    // The list is the queue, too: cells that are found are looked at later in this loop.
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
        return false; // not even its mark may be read
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
