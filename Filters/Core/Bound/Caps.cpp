// SPDX-License-Identifier: BSD-3-Clause
// Keeps the caps of a bound in tables by facet and by edge, since the engine asks for them with
// each try. The caps themselves come from SurfaceBound.
#include "Bound/Caps.h"

#include <algorithm>

namespace meshopt
{
namespace
{
/// Cells above the largest cap by this factor are at none: seen without a look-up. It must exceed
/// rounding, or cells at their caps would be missed; a larger one costs look-ups for nothing.
constexpr double AboveAllCaps = 1.01;
}

/// The bound is computed once. After that caps are looked up for each try.
template <int D>
void Caps<D>::build(const SimplexMesh<D>& mesh, Measure measure, double limit, bool known)
{
  this->bound_ = 1.0;
  this->largest_ = -1.0;
  this->facets_.clear();
  this->edges_.clear();
  this->tiny_.clear();
  this->edgesWithCap_.clear();
  if (!known)
  {
    return;
  }
  SurfaceBoundOptions options;
  options.measure = measure;
  options.enough = limit;
  options.listEdgesBelow = limit;
  const SurfaceBound<D> surface = surfaceBound(mesh, options);
  this->bound_ = surface.bound;
  for (std::size_t k = 0; k < surface.sides.size(); ++k)
  {
    // A cap above the limit holds nothing back, and would only make the table larger.
    if (surface.sideCaps[k] < limit)
    {
      // From either side of a facet the same: the cap depends on its shape only.
      this->facets_.addLeast(sortedIds(surface.sides[k].nodes), surface.sideCaps[k]);
      if (surface.sideCaps[k] < Tiny)
      {
        this->tiny_.add(surface.sides[k].nodes, mesh.numberOfPointSlots());
      }
      this->largest_ = std::max(this->largest_, surface.sideCaps[k]);
    }
  }
  for (const EdgeBound& e : surface.edges)
  {
    // In 2D what has a cap is a node, without a second end: see isCappedByEdge().
    if (e.cap < limit && e.b != None)
    {
      // An edge may have several wedges: the lowest of their caps counts.
      this->edges_.addLeast(sortedIds(e.a, e.b), e.cap);
      this->edgesWithCap_.add(std::array<Index, 2>{ e.a, e.b }, mesh.numberOfPointSlots());
      this->largest_ = std::max(this->largest_, e.cap);
    }
  }
}

template <int D>
double Caps<D>::find(const Facet<D>& f) const
{
  const double* cap = this->facets_.find(sortedIds(f));
  return cap && *cap < Tiny ? this->full_ / std::max(*cap, Rounding) : 1.0;
}

/// Facet i is the cell without its node i; `facets` has a bit for each that may have a tiny cap.
/// The facet with the lowest cap decides.
template <int D>
double Caps<D>::greatestWeight(const Simplex<D>& nodes, unsigned facets) const
{
  double weight = 1.0;
  for (int i = 0; i <= D; ++i)
  {
    if (!(facets >> i & 1u))
    {
      continue;
    }
    Facet<D> f;
    std::copy_n(nodes.begin(), i, f.begin());
    std::copy(nodes.begin() + i + 1, nodes.end(), f.begin() + i);
    weight = std::max(weight, this->find(f));
  }
  return weight;
}

template <int D>
bool Caps<D>::isCapped(const SimplexMesh<D>& mesh, Index c) const
{
  // Stored qualities may be weighed; caps never are.
  const double q = mesh.quality(c) / (this->weighed_ ? this->weight(mesh.nodes(c)) : 1.0);
  // The caps are looked up only for cells that may be at one: most are above the largest cap.
  if (!(q * (1.0 / this->reached_) <= this->largest_ * AboveAllCaps) && !(q <= this->largest_))
  {
    return false;
  }
  for (int i = 0; i <= D && !this->facets_.empty(); ++i)
  {
    if (mesh.isKept(c, i))
    {
      const double* cap = this->facets_.find(sortedIds(mesh.facet(c, i)));
      if (cap && q >= this->reached_ * *cap)
      {
        return true;
      }
    }
  }
  return this->isCappedByEdge(mesh, c);
}

template <int D>
double Caps<D>::enough(const SimplexMesh<D>& mesh, Index c, int i) const
{
  if (this->facets_.empty() || !mesh.isKept(c, i))
  {
    return -1.0;
  }
  const double* cap = this->facets_.find(sortedIds(mesh.facet(c, i)));
  return cap ? std::max(mesh.quality(c), this->reached_ * *cap) : -1.0;
}

/// In 2D no edge is stored: what has a cap there is a node.
template <int D>
bool Caps<D>::isCappedByEdge(const SimplexMesh<D>& mesh, Index c) const
{
  if constexpr (D == 3)
  {
    std::vector<Index> ring;
    for (const auto& e : Local<D>::edges)
    {
      const Index a = mesh.nodes(c)[e[0]], b = mesh.nodes(c)[e[1]];
      if (!this->edgesWithCap_.mayHave(std::array<Index, 2>{ a, b }))
      {
        continue;
      }
      const double* cap = this->edges_.find(sortedIds(a, b));
      if (!cap || !(mesh.quality(c) >= this->reached_ * *cap))
      {
        continue;
      }
      // Some cell at the edge is at most the cap, but it is not known which. It is this one if all
      // others are better.
      mesh.ring(c, a, b, false, ring);
      if (std::none_of(
            ring.begin(), ring.end(), [&](Index o) { return o != c && mesh.quality(o) <= *cap; }))
      {
        return true;
      }
    }
  }
  return false;
}

template class Caps<2>;
template class Caps<3>;
}
