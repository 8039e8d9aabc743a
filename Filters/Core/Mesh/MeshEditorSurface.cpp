// SPDX-License-Identifier: BSD-3-Clause
// What the editor sets on a surface that takes part: places, patches and kept edges.
#include "Mesh/MeshEditor.h"

#include <cassert>

namespace meshopt
{
template <int D>
void MeshEditor<D>::makeRoomForPlaces()
{
  // Most meshes slide nowhere: no memory for them.
  if (this->mesh_->places_.empty())
  {
    assert(this->owner_ == None); // others would read while this one grows
    this->mesh_->places_.resize(this->mesh_->points_.size());
  }
}

template <int D>
void MeshEditor<D>::setPlace(Index p, const Place& place)
{
  this->makeRoomForPlaces();
  this->savePlace(p);
  this->mesh_->places_[p] = place;
}

template <int D>
Index MeshEditor<D>::addPoint(const Vec<D>& x, Index near, const Place& place)
{
  const Index p = this->addPoint(x);
  if (p != None)
  {
    // To where it is: this tells attachments.
    this->movePoint(p, x, near);
    if (place.mayMove())
    {
      this->setPlace(p, place);
    }
  }
  return p;
}

template <int D>
void MeshEditor<D>::setPatch(Index c, int i, Index patch)
{
  if (this->mesh_->patches_.empty())
  {
    assert(this->owner_ == None && this->depth_ == 0);
    this->growPatches(true);
  }
  this->saveCell(c);
  this->mesh_->patches_[c][i] = patch;
  // The facet is stored twice, once for each of its cells.
  const Index h = this->mesh_->adjacent(c, i);
  if (h != None)
  {
    this->saveCell(Mesh::cellOf(h));
    this->mesh_->patches_[Mesh::cellOf(h)][Mesh::facetOf(h)] = patch;
  }
}

/// Kept facets are crossed: an edge between regions is marked in the cells of all of them. Flags
/// are set without saving the cells, hence not within a transaction.
template <int D>
void MeshEditor<D>::keepEdge(Index c, Index a, Index b)
{
  assert(D == 3 && this->depth_ == 0);
  std::vector<Index> cells;
  // A plane has no edges besides facets.
  if constexpr (D == 3)
  {
    this->mesh_->ring(c, a, b, true, cells);
  }
  for (Index k : cells)
  {
    // The edge has another local number in each cell: its points tell which one.
    for (int e = 0; e < Local<D>::numberOfEdges; ++e)
    {
      const Simplex<D>& t = this->mesh_->nodes(k);
      const Index p = t[Local<D>::edges[e][0]], q = t[Local<D>::edges[e][1]];
      if ((p == a && q == b) || (p == b && q == a))
      {
        this->mesh_->cellData_[k].flags |= std::uint16_t(1u << (Mesh::FirstEdgeBit + e));
      }
    }
  }
  this->mesh_->hasKeptEdges_ = true;
}

template <int D>
void MeshEditor<D>::giveUpEdge(Index c, int e)
{
  assert(D == 3 && this->depth_ == 0);
  this->mesh_->cellData_[c].flags &= std::uint16_t(~(1u << (Mesh::FirstEdgeBit + e)));
}

template void MeshEditor<2>::makeRoomForPlaces();
template void MeshEditor<3>::makeRoomForPlaces();
template Index MeshEditor<2>::addPoint(const Vec<2>&, Index, const Place&);
template Index MeshEditor<3>::addPoint(const Vec<3>&, Index, const Place&);
template void MeshEditor<2>::setPlace(Index, const Place&);
template void MeshEditor<3>::setPlace(Index, const Place&);
template void MeshEditor<2>::setPatch(Index, int, Index);
template void MeshEditor<3>::setPatch(Index, int, Index);
template void MeshEditor<2>::keepEdge(Index, Index, Index);
template void MeshEditor<3>::keepEdge(Index, Index, Index);
template void MeshEditor<3>::giveUpEdge(Index, int);
}
