// SPDX-License-Identifier: BSD-3-Clause
/// @file MeshEditorReplace.hxx
/// MeshEditor::replace(): the facets of the cavity's boundary go into a hash table, which links the
/// new cells.
#ifndef meshopt_Mesh_MeshEditorReplace_hxx
#define meshopt_Mesh_MeshEditorReplace_hxx

#include "Mesh/Ids.h"

#include <algorithm>
#include <cassert>

namespace meshopt
{
/// The facets that the new cells must fill, each with what lies behind it: its outer neighbour, the
/// input cell whose data are inherited, and its patch.
template <int D>
void MeshEditor<D>::collectOpenFacets(
  const std::vector<Index>& cavity, std::uint32_t inCavity, const KeptChange<D>* change)
{
  this->facets_.clear();
  const auto isGone = [&](const Facet<D>& key)
  {
    // Ids are compared in sorted order: the two cells of a facet number it differently.
    return change &&
      std::any_of(change->gone.begin(), change->gone.end(),
        [&](const Facet<D>& f) { return sortedIds(f) == key; });
  };
  for (Index c : cavity)
  {
    for (int i = 0; i <= D; ++i)
    {
      const Index h = this->mesh_->cells_[c].adjacent[i];
      const bool kept = this->mesh_->isKept(c, i);
      // No new cell has a kept facet that vanishes: it is not part of the boundary to fill.
      if (kept && isGone(sortedIds(this->mesh_->facet(c, i))))
      {
        continue;
      }
      // Cells of other editors cannot be in the cavity: owns() is asked first, and their marks are
      // not read.
      if (h == None || !this->owns(Mesh::cellOf(h)) || !this->isMarked(Mesh::cellOf(h), inCavity))
      {
        this->facets_.push_back({ sortedIds(this->mesh_->facet(c, i)), h, this->mesh_->parent(c),
          this->mesh_->patch(c, i), kept, false });
      }
      else
      {
        assert(!kept && "a kept facet inside of a cavity");
      }
    }
  }
}

/// Collects the kept edges for the new cells: those of the cavity, with the changes.
template <int D>
void MeshEditor<D>::collectKeptEdges(const std::vector<Index>& cavity, const KeptChange<D>* change)
{
  this->keptEdges_.clear();
  if (!this->mesh_->hasKeptEdges_)
  {
    return;
  }
  const auto isSame = [](const std::array<Index, 2>& e, Index a, Index b)
  { return (e[0] == a && e[1] == b) || (e[0] == b && e[1] == a); };
  for (Index c : cavity)
  {
    for (int e = 0; e < Local<D>::numberOfEdges; ++e)
    {
      if (this->mesh_->isEdgeKeptByItself(c, e))
      {
        const Simplex<D>& t = this->mesh_->nodes(c);
        const Index a = t[Local<D>::edges[e][0]], b = t[Local<D>::edges[e][1]];
        if (!change ||
          std::none_of(change->goneEdges.begin(), change->goneEdges.end(),
            [&](const std::array<Index, 2>& gone) { return isSame(gone, a, b); }))
        {
          // An edge comes once for each of its cells. The list is only asked whether it has an
          // edge.
          this->keptEdges_.push_back({ std::min(a, b), std::max(a, b) });
        }
      }
    }
  }
  for (std::size_t k = 0; change && k < change->comeEdges.size(); ++k)
  {
    const std::array<Index, 2>& e = change->comeEdges[k];
    this->keptEdges_.push_back({ std::min(e[0], e[1]), std::max(e[0], e[1]) });
  }
}

/// Marks the kept edges in a new cell that has them.
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

/// Marks the new kept facets, and their points as held.
template <int D>
void MeshEditor<D>::keepFacets(const KeptChange<D>& change)
{
  for (Index c : this->created_)
  {
    for (int i = 0; i <= D; ++i)
    {
      const Facet<D> key = sortedIds(this->mesh_->facet(c, i));
      // Searched one by one: a change brings few kept facets.
      const auto come = std::find_if(change.come.begin(), change.come.end(),
        [&](const Facet<D>& f) { return sortedIds(f) == key; });
      if (come == change.come.end())
      {
        continue;
      }
      this->mesh_->cellData_[c].flags |= std::uint16_t(1u << i);
      if (!this->mesh_->patches_.empty() && !change.patches.empty())
      {
        this->mesh_->patches_[c][i] = change.patches[come - change.come.begin()];
      }
      for (Index p : key) // saved already: of the cavity, or new
      {
        this->mesh_->points_[p].flags |= Mesh::PointHeld | Mesh::PointBoundary;
      }
    }
  }
}

/// Declares all points of the cavity dead, until a new cell uses them.
template <int D>
void MeshEditor<D>::killPoints(const std::vector<Index>& cavity)
{
  this->cavityPoints_.clear();
  for (Index c : cavity)
  {
    for (Index p : this->mesh_->nodes(c))
    {
      Point& point = this->mesh_->points_[p];
      // Points are shared by cells: the first cell that has the point takes its flag away.
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

/// Points of the cavity that are still dead belong to no new cell: their slots may be used again.
template <int D>
void MeshEditor<D>::buryPoints()
{
  for (Index p : this->cavityPoints_)
  {
    Point& point = this->mesh_->points_[p];
    if (!(point.flags & Mesh::PointAlive))
    {
      point.cell = None;
      if (p >= this->mesh_->inputPoints_) // slots of input points keep their ids
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

/// Linear probing. The table keeps its memory from one replacement to the next.
template <int D>
void MeshEditor<D>::hashOpenFacets(std::size_t numberOfNewCells)
{
  // At least twice as many slots as facets, so that chains stay short.
  // Facets between two new cells enter the table, too, when the first of these is linked.
  std::size_t size = 64;
  while (size < 2 * (this->facets_.size() + (D + 1) * numberOfNewCells))
  {
    size *= 2;
  }
  this->table_.assign(size, None);
  for (std::size_t f = 0; f < this->facets_.size(); ++f)
  {
    std::size_t k = hashIds(this->facets_[f].key) & (size - 1);
    // The size is a power of two: a mask does for a remainder.
    while (this->table_[k] != None)
    {
      k = (k + 1) & (size - 1);
    }
    this->table_[k] = static_cast<Index>(f);
  }
}

/// A new cell without neighbours. linkFacet() finds them once all new cells have their slots.
template <int D>
void MeshEditor<D>::create(const Simplex<D>& nodes, double quality, Index region)
{
  const Index c = this->takeCell();
  this->created_.push_back(c);
  // Sets all that the slot of a dead cell may still hold, except the mark.
  this->mesh_->cells_[c].nodes = nodes;
  this->mesh_->cells_[c].adjacent.fill(None);
  CellData& data = this->mesh_->cellData_[c];
  data.quality = quality;
  data.region = region;
  data.stamp = 0; // it has not failed yet
  data.level = 0;
  data.flags = Mesh::CellAlive;
  if (!this->mesh_->patches_.empty())
  {
    this->mesh_->patches_[c].fill(None);
  }
  for (Index p : nodes)
  {
    Point& point = this->mesh_->points_[p];
    if (!(point.flags & Mesh::PointAlive) && point.cell == None)
    {
      this->savePoint(p); // from addPoint(); points of the cavity are saved already
    }
    point.flags |= Mesh::PointAlive;
    point.cell = c;
    point.stamp = this->clock_;
  }
}

/// Links facet i of the new cell c, or leaves it open for the new cell on its other side. Returns
/// the parent of the cavity cell behind it; None for a facet inside the cavity.
template <int D>
Index MeshEditor<D>::linkFacet(Index c, int i)
{
  const Facet<D> key = sortedIds(this->mesh_->facet(c, i));
  const std::size_t mask = this->table_.size() - 1;
  std::size_t k = hashIds(key) & mask;
  while (this->table_[k] != None && this->facets_[this->table_[k]].key != key)
  {
    k = (k + 1) & mask;
  }
  if (this->table_[k] == None)
  {
    // The first new cell at a facet inside the cavity: the second one finds it here.
    this->table_[k] = static_cast<Index>(this->facets_.size());
    this->facets_.push_back({ key, Mesh::handle(c, i), None, None, false, false });
    return None;
  }
  OpenFacet& f = this->facets_[this->table_[k]];
  assert(!f.closed && "a facet with three cells");
  f.closed = true;
  this->mesh_->cells_[c].adjacent[i] = f.outside;
  this->mesh_->cellData_[c].flags |= std::uint16_t(f.kept ? 1u << i : 0u);
  if (f.patch != None)
  {
    this->mesh_->patches_[c][i] = f.patch;
  }
  if (f.outside != None)
  {
    Index& link = this->mesh_->cells_[Mesh::cellOf(f.outside)].adjacent[Mesh::facetOf(f.outside)];
    if (f.parent != None && this->depth_ > 0) // outside; new cells are saved already
    {
      this->journal_.push_back(Entry::LinkChanged);
      this->linkRecords_.push_back({ f.outside, link });
    }
    link = Mesh::handle(c, i);
  }
  return f.parent;
}

/// For a new cell without a facet of the cavity's boundary: the parent of a cell of its region.
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
  // The cavity has no cell of this region: any parent will do.
  return this->parents_[0][1];
}

/// Takes from the cavity all that the new cells need, frees its slots, makes the new cells, and
/// links them.
template <int D>
bool MeshEditor<D>::replace(const std::vector<Index>& cavity, const std::vector<Simplex<D>>& cells,
  const std::vector<double>& qualities, const KeptChange<D>* change)
{
  assert(cells.size() == qualities.size());
  assert(!change || change->regions.size() == cells.size());
  // The only way to fail comes first, before anything has changed.
  if (cells.size() > cavity.size() && !this->reserveCells(cells.size() - cavity.size()))
  {
    return false;
  }
  // A new time: all points of the cavity and of the new cells get it as their stamp.
  ++this->clock_;
  const std::uint32_t inCavity = this->newMark();
  for (Index c : cavity)
  {
    this->setMark(c, inCavity);
  }
  this->collectOpenFacets(cavity, inCavity, change);
  this->collectKeptEdges(cavity, change);
  this->killPoints(cavity);
  const Index region = this->mesh_->region(cavity[0]);
  this->parents_.clear();
  // Read now, since the slots are used again below.
  for (Index c : cavity)
  {
    this->parents_.push_back({ this->mesh_->region(c), this->mesh_->parent(c) });
  }
  // In reverse, so that the new cells take the slots of the cavity in its order.
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
    this->mesh_->cellData_[c].parent = behind == None ? this->parentIn(this->mesh_->region(c))
                                                      : behind;
    if (!this->keptEdges_.empty())
    {
      this->keepEdges(c);
    }
  }
  if (change)
  {
    this->keepFacets(*change);
  }
#ifndef NDEBUG
  for (const OpenFacet& f : this->facets_)
  {
    assert((f.closed || change) && "the new cells do not fill the cavity");
  }
#endif
  // Only now is it known which points no new cell uses.
  this->buryPoints();
  return true;
}
}

#endif
