// SPDX-License-Identifier: BSD-3-Clause
// Walks over the mesh. There is no table of edges or of stars: both are found over facets.
#include "Mesh/SimplexMesh.h"

#include "Mesh/LocalNumbers.h"

#include <algorithm>

namespace meshopt
{
namespace
{
/// Scratch that is not part of the mesh, since several threads may ask for stars at the same time.
/// Not inlined: its address would be asked for at each use, not once per star.
[[gnu::noinline]] LocalNumbers& numbersOfThread()
{
  thread_local LocalNumbers numbers;
  return numbers;
}
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

/// The cells are found over facets, breadth first from any cell of the point. The order depends on
/// that cell and on the numbering only, so that it is the same in each run.
template <int D>
void SimplexMesh<D>::star(Index p, std::vector<Index>& star) const
{
  LocalNumbers& seen = numbersOfThread(); // of the cells, in the order of the list
  seen.clear();
  star.assign(1, this->points_[p].cell);
  seen.add(star[0]);
  for (std::size_t k = 0; k < star.size(); ++k)
  {
    const Cell& cell = this->cells_[star[k]];
    for (int i = 0; i <= D; ++i)
    {
      // Facet i lies opposite to node i: the one opposite to p leads out of the star.
      if (cell.nodes[i] == p || cell.adjacent[i] == None)
      {
        continue;
      }
      const Index next = cellOf(cell.adjacent[i]);
      // A number as high as the list is long is a new one.
      if (seen.add(next) == static_cast<int>(star.size()))
      {
        star.push_back(next);
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
        const bool kept = this->isKept(current, exit);
        if (h == None || (kept && !acrossKept))
        {
          break;
        }
        crossed |= kept;
        const Index nextCell = cellOf(h);
        // Back at the start: the ring is closed, and there is no other way to go.
        if (nextCell == c)
        {
          return !crossed;
        }
        ring.push_back(nextCell);
        exit = this->otherFacet(nextCell, facetOf(h), a, b);
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
