// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/SimplexMesh.h"

#include <algorithm>

namespace meshopt
{
namespace
{
/// A small set of cells: open addressing, doubling. Stars have about 24 cells, rarely hundreds.
class SmallSet
{
public:
  SmallSet() { this->table_.assign(128, None); }

  bool insert(Index c)
  {
    if (2 * (this->size_ + 1) > this->table_.size())
    {
      std::vector<Index> old(2 * this->table_.size(), None);
      old.swap(this->table_);
      this->size_ = 0;
      for (Index o : old)
      {
        if (o != None)
        {
          this->insert(o);
        }
      }
    }
    const std::size_t mask = this->table_.size() - 1;
    for (std::size_t k = (std::uint32_t(c) * 2654435761u >> 7) & mask;; k = (k + 1) & mask)
    {
      if (this->table_[k] == c)
      {
        return false;
      }
      if (this->table_[k] == None)
      {
        this->table_[k] = c;
        ++this->size_;
        return true;
      }
    }
  }

  void clear()
  {
    // Back to the first size, so that one large star does not slow down all later ones.
    this->table_.assign(128, None);
    this->size_ = 0;
  }

private:
  std::vector<Index> table_;
  std::size_t size_ = 0;
};
}

template <int D>
Index SimplexMesh<D>::countCells() const
{
  return static_cast<Index>(std::count_if(this->cellData_.begin(), this->cellData_.end(),
    [](const CellData& d) { return (d.flags & CellAlive) != 0; }));
}

template <int D>
Index SimplexMesh<D>::countPoints() const
{
  return static_cast<Index>(std::count_if(this->points_.begin(), this->points_.end(),
    [](const Point& p) { return (p.flags & PointAlive) != 0; }));
}

template <int D>
void SimplexMesh<D>::star(Index p, std::vector<Index>& star) const
{
  // The set is not part of the mesh, since several threads may ask for stars at the same time.
  thread_local SmallSet seen;
  seen.clear();
  star.assign(1, this->points_[p].cell);
  seen.insert(star[0]);
  for (std::size_t k = 0; k < star.size(); ++k)
  {
    const Cell& cell = this->cells_[star[k]];
    for (int i = 0; i <= D; ++i)
    {
      if (cell.nodes[i] != p && cell.adjacent[i] != None && seen.insert(cellOf(cell.adjacent[i])))
      {
        star.push_back(cellOf(cell.adjacent[i]));
      }
    }
  }
}

template <int D>
bool SimplexMesh<D>::ring(Index c, [[maybe_unused]] Index a, [[maybe_unused]] Index b,
  [[maybe_unused]] bool acrossKept, std::vector<Index>& ring) const
{
  ring.assign(1, c);
  if constexpr (D == 3)
  {
    // Two nodes are off the edge. Leave through the facet opposite to the first one. If the ring
    // proves open, go the other way round from the start.
    bool crossed = false;
    for (int way = 0; way < 2; ++way)
    {
      Index current = c;
      int exit = -1;
      for (int i = 0, seen = 0; i < 4; ++i)
      {
        const Index p = this->cells_[c].nodes[i];
        if (p != a && p != b && seen++ == way)
        {
          exit = i;
        }
      }
      while (true)
      {
        const Index h = this->cells_[current].adjacent[exit];
        const bool kept = this->isConstrained(current, exit);
        if (h == None || (kept && !acrossKept))
        {
          break;
        }
        crossed |= kept;
        const Index nextCell = cellOf(h);
        if (nextCell == c)
        {
          return !crossed;
        }
        ring.push_back(nextCell);
        // leave through the facet opposite to the node that is neither a, b nor the new one
        const int entry = facetOf(h);
        for (int i = 0; i < 4; ++i)
        {
          const Index p = this->cells_[nextCell].nodes[i];
          if (i != entry && p != a && p != b)
          {
            exit = i;
            break;
          }
        }
        current = nextCell;
      }
      if (way == 0)
      {
        // So far the list runs outwards from c: reverse it, so that it runs from end to end.
        std::reverse(ring.begin(), ring.end());
      }
    }
  }
  return false;
}

template <int D>
double SimplexMesh<D>::volume() const
{
  double sum = 0.0;
  for (Index c = 0; c < this->numberOfCellSlots(); ++c)
  {
    if (this->isAlive(c))
    {
      sum += signedVolume(this->corners(c));
    }
  }
  return sum;
}

template class SimplexMesh<2>;
template class SimplexMesh<3>;
}
