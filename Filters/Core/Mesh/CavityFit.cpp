// SPDX-License-Identifier: BSD-3-Clause
// Checks that need no geometry, for meshes whose cells overlap: the few cells of a cavity and those
// that are to replace them, with local numbers for their points.
#include "Mesh/CavityFit.h"

#include <algorithm>
#include <array>
#include <utility>

namespace meshopt
{
template <int D>
void CavityFit<D>::load(const SimplexMesh<D>& mesh, const std::vector<Index>& cavity,
  const std::vector<Simplex<D>>& cells)
{
  this->mesh_ = &mesh;
  this->numbers_.clear();
  this->cavity_.clear();
  this->nodes_.clear();
  for (Index c : cavity)
  {
    this->cavity_.add(c);
    this->nodes_.push_back(mesh.nodes(c));
  }
  this->old_.load(this->nodes_, this->numbers_,
    [&](std::size_t k, int i)
    {
      const Index handle = mesh.adjacent(cavity[k], i);
      return handle == None || this->cavity_.get(mesh.cellOf(handle)) < 0;
    });
  this->new_.load(cells, this->numbers_, [](std::size_t, int) { return false; });
  const int points = this->numbers_.size();
  this->isTooLarge_ = points > FewCells<D>::MostPoints;
  if (this->isTooLarge_)
  {
    return;
  }
  this->points_.resize(points);
  for (const std::vector<Simplex<D>>* from : { &std::as_const(this->nodes_), &cells })
  {
    for (const Simplex<D>& cell : *from)
    {
      for (Index p : cell)
      {
        this->points_[this->numbers_.get(p)] = p;
      }
    }
  }
  this->old_.connect(points);
  this->new_.connect(points);
}

template <int D>
void CavityFit<D>::keysOf(const std::vector<Facet<D>>& facets, std::vector<std::uint64_t>& keys)
{
  keys.clear();
  for (Facet<D> f : facets)
  {
    std::transform(f.begin(), f.end(), f.begin(), [&](Index p) { return this->numbers_.get(p); });
    if (!hasId(f, -1)) // else no cell here has it
    {
      keys.push_back(FewCells<D>::keyOf(f));
    }
  }
}

/// Whether each facet of the boundary has one new cell, and each one inside two. Finds outer_.
template <int D>
bool CavityFit<D>::matchesBoundary(const KeptChange<D>* change)
{
  const auto isAmong = [](const std::vector<std::uint64_t>& keys, std::uint64_t key)
  { return std::find(keys.begin(), keys.end(), key) != keys.end(); };
  this->keysOf(change ? change->gone : std::vector<Facet<D>>(), this->gone_);
  this->keysOf(change ? change->come : std::vector<Facet<D>>(), this->come_);
  this->outer_.clear();
  this->sides_.clear();
  // What the cavity has in common with the rest of the mesh, and what must not change.
  const auto next = [&](std::size_t k)
  {
    const auto& sides = this->old_.sides;
    while (k < sides.size() && (!sides[k].isOuter || isAmong(this->gone_, sides[k].facet)))
    {
      ++k;
    }
    return k;
  };
  const std::vector<typename FewCells<D>::Side>&before = this->old_.sides,
                             &after = this->new_.sides;
  std::size_t at = next(0);
  for (std::size_t k = 0; k < after.size();)
  {
    // Equal facets are treated as one, with the number of cells that have them.
    const std::uint64_t facet = after[k].facet;
    std::size_t n = 1;
    while (k + n < after.size() && after[k + n].facet == facet)
    {
      ++n;
    }
    if (at < before.size() && before[at].facet < facet)
    {
      return false; // no new cell has it
    }
    const bool isOuter = at < before.size() && before[at].facet == facet;
    // A boundary facet needs one new cell; one inside needs two, and a new kept facet one.
    if (n != (isOuter ? 1 : 2) && (isOuter || n != 1 || !isAmong(this->come_, facet)))
    {
      return false;
    }
    if (isOuter)
    {
      this->outer_.push_back(FewCells<D>::facetOf(facet));
      this->sides_.push_back({ before[at].cell, after[k].cell });
      at = next(at + 1);
      if (at < before.size() && before[at].facet == facet)
      {
        return false; // a facet must not be on the boundary twice
      }
    }
    k += n;
  }
  return at == before.size();
}

/// Whether cells connected at point p of the boundary before, over facets that have q, too, are so
/// after.
template <int D>
bool CavityFit<D>::agrees(Index p, Index q)
{
  for (FewCells<D>* few : { &this->old_, &this->new_ })
  {
    for (const int* k = few->jointsAt.begin(p); k != few->jointsAt.end(p); ++k)
    {
      if (hasId(few->joints[*k], q))
      {
        few->join(*k);
      }
    }
  }
  bool good = true;
  for (const int* k = this->outerAt_.begin(p); k != this->outerAt_.end(p); ++k)
  {
    if (hasId(this->outer_[*k], q))
    {
      int& link = this->link_[this->old_.root(this->sides_[*k][0])];
      const int root = this->new_.root(this->sides_[*k][1]);
      good = good && (link == None || link == root);
      link = root;
    }
  }
  for (const int* k = this->outerAt_.begin(p); k != this->outerAt_.end(p); ++k)
  {
    this->link_[this->old_.root(this->sides_[*k][0])] = None;
  }
  for (FewCells<D>* few : { &this->old_, &this->new_ })
  {
    std::for_each(few->jointsAt.begin(p), few->jointsAt.end(p), [few](int k) { few->separate(k); });
  }
  return good;
}

/// For every point of the boundary (D = 3: and every edge).
template <int D>
bool CavityFit<D>::staysTogether()
{
  const int points = this->numbers_.size();
  this->outerAt_.build(points, this->outer_);
  this->link_.assign(this->old_.cells.size(), None);
  this->seen_.assign(points, None);
  for (Index p = 0; p < points; ++p)
  {
    if (!this->outerAt_.isEmpty(p) && !this->agrees(p, p))
    {
      return false;
    }
    if (D == 3 &&
      !forEachEdgeOnce(
        p, this->outerAt_, this->outer_, this->seen_, [&](Index q) { return this->agrees(p, q); }))
    {
      return false;
    }
  }
  return true;
}

template <int D>
bool CavityFit<D>::fills(const KeptChange<D>* change)
{
  if (this->isTooLarge_)
  {
    return false;
  }
  // All of the boundary is filled; the new cells are one piece; no handle and no hollow came or
  // went; nothing was torn apart or joined at the boundary.
  if (!this->matchesBoundary(change) || !this->new_.isOnePiece())
  {
    return false;
  }
  const int points = this->numbers_.size();
  const auto euler = [&](const FewCells<D>& few)
  {
    this->seen_.assign(points, None);
    return few.eulerCharacteristic(points, this->seen_);
  };
  return euler(this->new_) == euler(this->old_) && this->staysTogether();
}

/// Whether a cell of the mesh has the n points of a face that the cavity does not have.
template <int D>
bool CavityFit<D>::isTaken(const std::vector<std::uint8_t>& pinched, const Index* face, int n)
{
  const SimplexMesh<D>& mesh = *this->mesh_;
  const auto isPinched = [&](Index p)
  { return p < static_cast<Index>(pinched.size()) && pinched[p]; };
  const auto has = [&](Index c)
  { return std::all_of(face, face + n, [&](Index p) { return mesh.localIndex(c, p) >= 0; }); };
  // A face with a new point cannot be there.
  if (!std::all_of(face, face + n, [&](Index p) { return mesh.isPointAlive(p); }))
  {
    return false;
  }
  // Use the present star if it will do; otherwise that of the last point, the apex that many new
  // cells share. The star of a pinched point is incomplete, so it will not do.
  const Index* whole = std::find(face, face + n, this->centre_);
  // From the last point to the first, until one has a star to be trusted.
  for (int k = n; whole == face + n && k-- > 0;)
  {
    whole = isPinched(face[k]) ? whole : face + k;
  }
  if (whole != face + n)
  {
    if (*whole != this->centre_)
    {
      this->centre_ = *whole;
      mesh.star(this->centre_, this->star_);
    }
    return std::any_of(this->star_.begin(), this->star_.end(), has);
  }
  bool found = false; // all points are pinched, which is rare: scan all cells
  for (Index c = 0; c < mesh.numberOfCellSlots() && !found; ++c)
  {
    found = mesh.isAlive(c) && has(c);
  }
  return found;
}

template <int D>
bool CavityFit<D>::meetsOthers(const std::vector<std::uint8_t>& pinched)
{
  if (this->isTooLarge_)
  {
    return true;
  }
  this->centre_ = None;
  const int points = this->numbers_.size();
  this->seen_.assign(points, None);
  for (Index p = 0; p < points; ++p)
  {
    const auto isFree = [&](Index q)
    {
      const Index edge[] = { this->points_[p], this->points_[q] };
      return this->old_.hasEdge(p, q) || !this->isTaken(pinched, edge, 2); // old ones may come back
    };
    if (!forEachEdgeOnce(p, this->new_.cellsAt, this->new_.cells, this->seen_, isFree))
    {
      return true;
    }
  }
  // Where an edge is new, and not taken, no facet is.
  const auto& sides = this->new_.sides;
  for (std::size_t k = 0; D == 3 && k < sides.size(); ++k)
  {
    const Facet<D> f = FewCells<D>::facetOf(sides[k].facet);
    if ((k == 0 || sides[k].facet != sides[k - 1].facet) &&
      !std::binary_search(this->old_.sides.begin(), this->old_.sides.end(), sides[k]) &&
      this->old_.hasEdge(f[0], f[1]) && this->old_.hasEdge(f[D - 2], f[D - 1]) &&
      this->old_.hasEdge(f[0], f[D - 1]))
    {
      Index facet[D];
      std::transform(f.begin(), f.end(), facet, [&](Index p) { return this->points_[p]; });
      if (this->isTaken(pinched, facet, D))
      {
        return true;
      }
    }
  }
  return false;
}

template class CavityFit<2>;
template class CavityFit<3>;
}
