// SPDX-License-Identifier: BSD-3-Clause
// The audit: checks all invariants of a SimplexMesh, without trusting any of its data.
#include "Mesh/Ids.h"
#include "Mesh/SimplexMesh.h"

#include <algorithm>
#include <map>
#include <set>

namespace meshopt
{
namespace
{
template <int D>
struct Audit
{
  using Mesh = SimplexMesh<D>;
  const Mesh& mesh;
  std::vector<std::string> faults;

  void fault(const std::string& text)
  {
    // One broken invariant often breaks thousands of others: the first ones say enough.
    if (this->faults.size() < 20)
    {
      this->faults.push_back(text);
    }
  }

  /// Flat and inverted cells are legal before the mesh is untangled: `requirePositive` says whether
  /// they are a fault.
  void cell(Index c, bool requirePositive)
  {
    const std::string name = "cell " + std::to_string(c);
    for (Index p : this->mesh.nodes(c))
    {
      if (p < 0 || p >= this->mesh.numberOfPointSlots() || !this->mesh.isPointAlive(p))
      {
        this->fault(name + " uses the dead point " + std::to_string(p));
        // What follows would read the point.
        return;
      }
    }
    if (requirePositive && !(signedVolume(this->mesh.corners(c)) > 0.0))
    {
      this->fault(name + " is not positive");
    }
    for (int i = 0; i <= D; ++i)
    {
      this->facet(c, i, name + " facet " + std::to_string(i));
    }
  }

  /// A facet is stored on both its sides: each must lead to the other and say the same about it.
  void facet(Index c, int i, const std::string& name)
  {
    const Index h = this->mesh.adjacent(c, i);
    Facet<D> f = this->mesh.facet(c, i);
    if (this->mesh.isKept(c, i))
    {
      // A kept facet holds its points: a free one could move it.
      for (Index p : f)
      {
        if (this->mesh.isFree(p) || !this->mesh.isBoundary(p))
        {
          this->fault(name + " is kept but its point " + std::to_string(p) + " is free");
        }
      }
    }
    if (h == None)
    {
      if (!this->mesh.isKept(c, i))
      {
        this->fault(name + " is at the surface but not kept");
      }
      return;
    }
    // Nothing is trusted here, not even that the handle leads to a slot.
    const Index o = Mesh::cellOf(h);
    const int j = Mesh::facetOf(h);
    // A triangle has facets 0 to 2, but handles have room for 0 to 3.
    if (o < 0 || o >= this->mesh.numberOfCellSlots() || !this->mesh.isAlive(o) || j > D)
    {
      this->fault(name + " leads to a dead cell");
      return;
    }
    if (this->mesh.adjacent(o, j) != Mesh::handle(c, i) ||
      sortedIds(f) != sortedIds(this->mesh.facet(o, j)))
    {
      this->fault(name + " is not the facet of its neighbour");
    }
    if (this->mesh.isKept(c, i) != this->mesh.isKept(o, j))
    {
      this->fault(name + " is kept on one side only");
    }
    if (this->mesh.region(c) != this->mesh.region(o) && !this->mesh.isKept(c, i))
    {
      this->fault(name + " lies between regions but is not kept");
    }
  }

  /// Counts facets again, without the adjacency.
  void counts()
  {
    std::map<Facet<D>, int> count;
    std::set<Simplex<D>> seen;
    for (Index c = 0; c < this->mesh.numberOfCellSlots(); ++c)
    {
      if (!this->mesh.isAlive(c))
      {
        continue;
      }
      // Sorted: two cells with the same points are one cell twice, however they are numbered.
      Simplex<D> t = this->mesh.nodes(c);
      std::sort(t.begin(), t.end());
      if (!seen.insert(t).second)
      {
        this->fault("cell " + std::to_string(c) + " stands twice");
      }
      for (int i = 0; i <= D; ++i)
      {
        const int n = ++count[sortedIds(this->mesh.facet(c, i))];
        // The adjacency cannot even express this: a facet has one cell or two.
        if (n > 2)
        {
          this->fault("a facet of cell " + std::to_string(c) + " has more than two cells");
        }
      }
    }
  }

  /// A point is alive if and only if a cell uses it. Its cell may be any of those that do: stars
  /// are walked from there.
  void points()
  {
    std::vector<bool> used(this->mesh.numberOfPointSlots(), false);
    for (Index c = 0; c < this->mesh.numberOfCellSlots(); ++c)
    {
      if (this->mesh.isAlive(c))
      {
        for (Index p : this->mesh.nodes(c))
        {
          used[p] = true;
        }
      }
    }
    for (Index p = 0; p < this->mesh.numberOfPointSlots(); ++p)
    {
      const std::string name = "point " + std::to_string(p);
      if (used[p] != this->mesh.isPointAlive(p))
      {
        this->fault(name + (used[p] ? " is used but dead" : " is alive but not used"));
      }
      const Index c = this->mesh.cellOfPoint(p);
      if (used[p] && (c == None || !this->mesh.isAlive(c) || this->mesh.localIndex(c, p) < 0))
      {
        this->fault(name + " has a cell that does not use it");
      }
    }
  }
};
}

/// First cell by cell, then the mesh as a whole.
template <int D>
std::vector<std::string> SimplexMesh<D>::audit(bool requirePositive) const
{
  Audit<D> audit{ *this, {} };
  for (Index c = 0; c < this->numberOfCellSlots(); ++c)
  {
    if (this->isAlive(c))
    {
      audit.cell(c, requirePositive);
    }
  }
  // Further checks walk over ids that the first ones have found to be valid.
  if (audit.faults.empty())
  {
    audit.counts();
    audit.points();
  }
  return audit.faults;
}

template std::vector<std::string> SimplexMesh<2>::audit(bool) const;
template std::vector<std::string> SimplexMesh<3>::audit(bool) const;
}
