// SPDX-License-Identifier: BSD-3-Clause
/// @file Cavity.h
/// The best cavity around a seed cell for a new node: a set of cells to remove, whose boundary is
/// joined to the node.
///
/// It is grown like a minimum spanning tree. Again and again, the boundary facet that makes the
/// worst element with the node is opened, and the cell behind it is taken in. The prefix of this
/// sequence with the largest worst quality is remembered. Among all cavities that contain the seed
/// and cross no kept facet, this prefix maximizes the worst quality of the new elements. Proof: if
/// a prefix P has a boundary facet of quality <= c, then a larger cavity either takes in the cell
/// behind it or has that facet on its own boundary. A positive worst quality makes the cavity
/// star-shaped around the node. O(k log k) for k cells.
#ifndef meshopt_Operations_Cavity_h
#define meshopt_Operations_Cavity_h

#include "Edit/QualityModel.h"
#include "Mesh/KeptEdges.h"
#include "Mesh/LocalNumbers.h"
#include "Mesh/MeshEditor.h"

#include <algorithm>

namespace meshopt
{
template <int D, class Shape>
class Cavity
{
public:
  struct Limits
  {
    int cells = 80;    ///< greatest number of cells taken in
    int swallowed = 1; ///< most free points that may vanish; others never may
  };

  /// Grows the cavity of cell `seed` for a node with id p at x (no cell need use p). Returns the
  /// worst quality of the new elements; -infinity if there is no cavity.
  double grow(MeshEditor<D>& editor, const QualityModel<D, Shape>& model, Index seed, Index p,
    const Vec<D>& x, const Limits& limits);

  /// The cells of the best prefix.
  const std::vector<Index>& cells() const { return this->cells_; }
  double oldWorst() const { return this->oldWorst_; }
  /// Boundary facets of the best prefix. The tetrahedron (facet, node) is positive.
  const std::vector<Facet<D>>& facets() const { return this->facets_; }

private:
  struct Front
  {
    double q;
    Index cell;
    int facet;
    bool operator<(const Front& o) const // the worst on top; ties by id
    {
      return this->q != o.q
        ? this->q > o.q
        : SimplexMesh<D>::handle(this->cell, this->facet) > SimplexMesh<D>::handle(o.cell, o.facet);
    }
  };
  struct PointData
  {
    Vec<D> x;
    double weight;
    int facets = 0; // number of boundary facets that contain it
  };

  bool take(MeshEditor<D>& editor, const QualityModel<D, Shape>& model, Index c, int limit);
  double quality(const QualityModel<D, Shape>& model, const Facet<D>& f, const int* numbers);
  void finish(MeshEditor<D>& editor);

  LocalNumbers numbers_;
  std::vector<PointData> points_;
  std::vector<Front> heap_;
  std::vector<Index> cells_;
  std::vector<Facet<D>> facets_;
  std::uint32_t mark_ = 0;
  Index p_ = None;
  Vec<D> x_;
  int swallowed_ = 0;
  double oldWorst_ = 0.0;
};

template <int D, class Shape>
double Cavity<D, Shape>::quality(
  const QualityModel<D, Shape>& model, const Facet<D>& f, [[maybe_unused]] const int* numbers)
{
  if constexpr (QualityModel<D, Shape>::HasSum)
  {
    // The same quality as below, but each edge to the new node is measured only once.
    if (model.fast())
    {
      const PointData &a = this->points_[numbers[0]], &b = this->points_[numbers[1]];
      const Vec<D> u = b.x - a.x;
      if constexpr (D == 3)
      {
        const PointData& c = this->points_[numbers[2]];
        const Vec<D> v = c.x - a.x;
        return EdgeSum<Shape>::quality(u.cross(v).dot(this->x_ - a.x),
          a.weight + b.weight + c.weight + EdgeSum<Shape>::weight(u.squaredNorm()) +
            EdgeSum<Shape>::weight(v.squaredNorm()) +
            EdgeSum<Shape>::weight((u - v).squaredNorm()));
      }
      else
      {
        const Vec<D> w = this->x_ - a.x;
        return EdgeSum<Shape>::quality(
          u[0] * w[1] - u[1] * w[0], a.weight + b.weight + EdgeSum<Shape>::weight(u.squaredNorm()));
      }
    }
  }
  Simplex<D> cell;
  std::copy(f.begin(), f.end(), cell.begin());
  cell[D] = this->p_;
  return model(cell);
}

/// Takes cell c into the cavity. False if points or edges would then vanish that must not.
template <int D, class Shape>
bool Cavity<D, Shape>::take(
  MeshEditor<D>& editor, const QualityModel<D, Shape>& model, Index c, int limit)
{
  const SimplexMesh<D>& mesh = editor.mesh();
  int local[D + 1];
  for (int i = 0; i <= D; ++i)
  {
    const Index p = mesh.nodes(c)[i];
    local[i] = this->numbers_.add(p);
    if (local[i] == static_cast<int>(this->points_.size()))
    {
      const Vec<D>& x = mesh.point(p);
      double weight = 0.0;
      if constexpr (EdgeSum<Shape>::value)
      {
        weight = EdgeSum<Shape>::weight((this->x_ - x).squaredNorm());
      }
      this->points_.push_back({ x, weight, 0 });
    }
  }
  editor.setMark(c, this->mark_);
  this->cells_.push_back(c);
  for (int i = 0; i <= D; ++i)
  {
    const Index h = mesh.adjacent(c, i);
    int numbers[D];
    for (int k = 0; k < D; ++k)
    {
      numbers[k] = local[Local<D>::facets[i][k]];
    }
    // A facet of which both cells are inside is no boundary facet any more. It remains in the heap:
    // grow() drops it later.
    if (h != None && !mesh.isConstrained(c, i) && editor.owns(mesh.cellOf(h)) &&
      editor.isMarked(mesh.cellOf(h), this->mark_))
    {
      for (int k : numbers)
      {
        --this->points_[k].facets;
      }
      continue;
    }
    for (int k : numbers)
    {
      ++this->points_[k].facets;
    }
    this->heap_.push_back({ this->quality(model, mesh.facet(c, i), numbers), c, i });
    std::push_heap(this->heap_.begin(), this->heap_.end());
  }
  if (enclosesKeptEdge(mesh, c,
        [&](Index other) { return editor.owns(other) && editor.isMarked(other, this->mark_); }))
  {
    return false;
  }
  // A point that no boundary facet contains would vanish with the cavity.
  for (int i = 0; i <= D; ++i)
  {
    if (this->points_[local[i]].facets == 0)
    {
      ++this->swallowed_;
      if (!mesh.isFree(mesh.nodes(c)[i]) || this->swallowed_ > limit)
      {
        return false;
      }
    }
  }
  return true;
}

template <int D, class Shape>
double Cavity<D, Shape>::grow(MeshEditor<D>& editor, const QualityModel<D, Shape>& model,
  Index seed, Index p, const Vec<D>& x, const Limits& limits)
{
  const SimplexMesh<D>& mesh = editor.mesh();
  this->numbers_.clear();
  this->points_.clear();
  this->heap_.clear();
  this->cells_.clear();
  this->mark_ = editor.newMark();
  this->p_ = p;
  this->x_ = x;
  this->swallowed_ = 0;
  double best = -std::numeric_limits<double>::infinity();
  std::size_t bestSize = 0;
  bool more = this->take(editor, model, seed, limits.swallowed);
  while (more)
  {
    // Facets that lie inside by now are dropped when they come to the top.
    while (true)
    {
      const Front& top = this->heap_.front();
      const Index h = mesh.adjacent(top.cell, top.facet);
      if (h == None || mesh.isConstrained(top.cell, top.facet) || !editor.owns(mesh.cellOf(h)) ||
        !editor.isMarked(mesh.cellOf(h), this->mark_))
      {
        break;
      }
      std::pop_heap(this->heap_.begin(), this->heap_.end());
      this->heap_.pop_back();
    }
    const Front top = this->heap_.front();
    // The worst facet on the boundary is the worst quality of the whole prefix.
    if (top.q > best)
    {
      best = top.q;
      bestSize = this->cells_.size();
    }
    const Index h = mesh.adjacent(top.cell, top.facet);
    // If the worst facet cannot be opened, no larger cavity can be better than the best so far.
    if (h == None || mesh.isConstrained(top.cell, top.facet) || !editor.owns(mesh.cellOf(h)) ||
      static_cast<int>(this->cells_.size()) >= limits.cells)
    {
      break;
    }
    more = this->take(editor, model, mesh.cellOf(h), limits.swallowed);
  }
  this->cells_.resize(bestSize);
  this->finish(editor);
  return best;
}

/// Collects the boundary of the best prefix, and the worst quality of its cells.
template <int D, class Shape>
void Cavity<D, Shape>::finish(MeshEditor<D>& editor)
{
  const SimplexMesh<D>& mesh = editor.mesh();
  // A new mark, since the growth may have marked cells beyond the best prefix.
  const std::uint32_t inside = editor.newMark();
  this->oldWorst_ = std::numeric_limits<double>::infinity();
  for (Index c : this->cells_)
  {
    editor.setMark(c, inside);
    this->oldWorst_ = std::min(this->oldWorst_, mesh.quality(c));
  }
  this->facets_.clear();
  for (Index c : this->cells_)
  {
    for (int i = 0; i <= D; ++i)
    {
      const Index h = mesh.adjacent(c, i);
      if (h == None || mesh.isConstrained(c, i) || !editor.owns(mesh.cellOf(h)) ||
        !editor.isMarked(mesh.cellOf(h), inside))
      {
        this->facets_.push_back(mesh.facet(c, i));
      }
    }
  }
}
}

#endif
