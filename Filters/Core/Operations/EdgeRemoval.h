// SPDX-License-Identifier: BSD-3-Clause
/// @file EdgeRemoval.h
/// Removes an interior edge: the ring of points around it is triangulated anew in the best way, and
/// both ends of the edge are joined to the triangles. (The paper's edge cluster to a ring node is
/// the special case of a fan.) In 2D: the swap of an edge.
///
/// Reference: G. T. Klincsek, Minimal triangulations of polygonal domains (1980), with the sum
/// replaced by the minimum: D[i][j] = max over k of min(D[i][k], D[k][j], both tetrahedra on the
/// triangle i k j). O(n^3) qualities at most for a ring of n; pruned by what must be beaten.
#ifndef meshopt_Operations_EdgeRemoval_h
#define meshopt_Operations_EdgeRemoval_h

#include "Mesh/MeshEditor.h"
#include "Edit/QualityModel.h"

#include <algorithm>

namespace meshopt
{
template <int D, class Shape>
class EdgeRemoval
{
public:
  static constexpr int MaximumRing = 12;

  /// Tries to remove edge e (local number) of cell t. Returns the worst quality of the best
  /// refilling if it is above `above` and above the worst of the ring, else -infinity; then also if
  /// the edge must stay (kept, at the surface, ring too large, not owned).
  double propose(
    const MeshEditor<D>& editor, const QualityModel<D, Shape>& model, Index t, int e, double above);

  /// The worst quality of the ring of the last propose() that found a ring.
  double ringWorst() const { return this->ringWorst_; }
  const std::vector<Index>& cavity() const { return this->cavity_; }
  /// The cells of the last successful propose().
  void cells(std::vector<Simplex<D>>& cells) const;

private:
  static constexpr double Never = -std::numeric_limits<double>::infinity();

  bool gather(const MeshEditor<D>& editor, Index t, int e);
  double triangulate(const QualityModel<D, Shape>& model, double above);
  void weigh(const QualityModel<D, Shape>& model);
  double pair(const QualityModel<D, Shape>& model, int i, int k, int j, double above) const;
  void emit(int i, int j, std::vector<Simplex<D>>& cells) const;

  std::vector<Index> cavity_;
  double ringWorst_ = 0.0;
  Index low_ = None, high_ = None; // the edge; the ring runs counterclockwise seen from high_
  int n_ = 0;
  Index ring_[MaximumRing];
  Vec<D> x_[MaximumRing], xLow_, xHigh_;
  double weight_[MaximumRing][MaximumRing], weightLow_[MaximumRing], weightHigh_[MaximumRing];
  double best_[MaximumRing][MaximumRing];
  int split_[MaximumRing][MaximumRing];
};

template <int D, class Shape>
bool EdgeRemoval<D, Shape>::gather(const MeshEditor<D>& editor, Index t, int e)
{
  const SimplexMesh<D>& mesh = editor.mesh();
  this->cavity_.assign(1, t);
  this->ringWorst_ = mesh.quality(t);
  const Simplex<D>& nodes = mesh.nodes(t);
  if constexpr (D == 2)
  {
    // the edge lies opposite to node o; the ring is: o, the node across
    const int o = 3 - Local<2>::edges[e][0] - Local<2>::edges[e][1];
    const Index h = mesh.adjacent(t, o);
    if (h == None || mesh.isConstrained(t, o) || !editor.owns(mesh.cellOf(h)))
    {
      return false;
    }
    this->cavity_.push_back(mesh.cellOf(h));
    this->ringWorst_ = std::min(this->ringWorst_, mesh.quality(mesh.cellOf(h)));
    const Facet<2> f = mesh.facet(t, o);
    this->low_ = f[0];
    this->high_ = f[1];
    this->ring_[0] = nodes[o];
    this->ring_[1] = mesh.nodes(mesh.cellOf(h))[mesh.facetOf(h)];
    this->n_ = 2;
  }
  else
  {
    if (mesh.isEdgeConstrained(t, e))
    {
      return false;
    }
    const auto& local = Local<3>::edgeFirst[e];
    this->low_ = nodes[local[0]];
    this->high_ = nodes[local[1]];
    this->ring_[0] = nodes[local[2]];
    this->ring_[1] = nodes[local[3]];
    this->n_ = 2;
    Index current = t;
    int exit = local[2]; // leave through the facet opposite to the older ring point
    while (true)
    {
      const Index h = mesh.adjacent(current, exit);
      if (h == None || mesh.isConstrained(current, exit))
      {
        return false;
      }
      const Index next = mesh.cellOf(h);
      if (next == t || !editor.owns(next))
      {
        return false;
      }
      this->cavity_.push_back(next);
      this->ringWorst_ = std::min(this->ringWorst_, mesh.quality(next));
      const Index newcomer = mesh.nodes(next)[mesh.facetOf(h)];
      exit = mesh.localIndex(next, this->ring_[this->n_ - 1]);
      current = next;
      if (newcomer == this->ring_[0])
      {
        // closed if the way on leads back to t
        const Index back = mesh.adjacent(current, exit);
        if (back == None || mesh.isConstrained(current, exit) || mesh.cellOf(back) != t)
        {
          return false;
        }
        break;
      }
      if (this->n_ == MaximumRing)
      {
        return false;
      }
      this->ring_[this->n_++] = newcomer;
    }
    if (this->n_ < 3)
    {
      return false;
    }
  }
  for (int i = 0; i < this->n_; ++i)
  {
    this->x_[i] = mesh.point(this->ring_[i]);
  }
  this->xLow_ = mesh.point(this->low_);
  this->xHigh_ = mesh.point(this->high_);
  return true;
}

template <int D, class Shape>
void EdgeRemoval<D, Shape>::weigh(const QualityModel<D, Shape>& model)
{
  if constexpr (QualityModel<D, Shape>::HasSum)
  {
    if (!model.fast())
    {
      return;
    }
    for (int i = 0; i < this->n_; ++i)
    {
      this->weightLow_[i] = EdgeSum<Shape>::weight((this->x_[i] - this->xLow_).squaredNorm());
      this->weightHigh_[i] = EdgeSum<Shape>::weight((this->x_[i] - this->xHigh_).squaredNorm());
      for (int j = 0; j < i; ++j)
      {
        this->weight_[j][i] = EdgeSum<Shape>::weight((this->x_[i] - this->x_[j]).squaredNorm());
      }
    }
  }
}

/// The worse of the two tetrahedra on triangle (i, k, j), i < k < j; the second is not looked at
/// if the first is not above.
template <int D, class Shape>
double EdgeRemoval<D, Shape>::pair(
  const QualityModel<D, Shape>& model, int i, int k, int j, double above) const
{
  if constexpr (D == 3)
  {
    if constexpr (QualityModel<D, Shape>::HasSum)
    {
      if (model.fast())
      {
        const Vec<3> normal = (this->x_[k] - this->x_[i]).cross(this->x_[j] - this->x_[i]);
        const double base = this->weight_[i][k] + this->weight_[k][j] + this->weight_[i][j];
        const double high = EdgeSum<Shape>::quality(normal.dot(this->xHigh_ - this->x_[i]),
          base + this->weightHigh_[i] + this->weightHigh_[k] + this->weightHigh_[j]);
        if (!(high > above))
        {
          return high;
        }
        const double low = EdgeSum<Shape>::quality(normal.dot(this->x_[i] - this->xLow_),
          base + this->weightLow_[i] + this->weightLow_[k] + this->weightLow_[j]);
        return std::min(high, low);
      }
    }
    const double high = model(
      Simplex<3>{ this->ring_[i], this->ring_[k], this->ring_[j], this->high_ });
    if (!(high > above))
    {
      return high;
    }
    return std::min(
      high, model(Simplex<3>{ this->ring_[k], this->ring_[i], this->ring_[j], this->low_ }));
  }
  return Never;
}

template <int D, class Shape>
double EdgeRemoval<D, Shape>::triangulate(const QualityModel<D, Shape>& model, double above)
{
  this->weigh(model);
  const int n = this->n_;
  for (int i = 0; i + 1 < n; ++i)
  {
    this->best_[i][i + 1] = std::numeric_limits<double>::infinity();
  }
  for (int width = 2; width < n; ++width)
  {
    for (int i = 0; i + width < n; ++i)
    {
      const int j = i + width;
      double best = above;
      this->split_[i][j] = -1;
      for (int k = i + 1; k < j; ++k)
      {
        const double parts = std::min(this->best_[i][k], this->best_[k][j]);
        if (!(parts > best))
        {
          continue;
        }
        const double q = std::min(parts, this->pair(model, i, k, j, best));
        if (q > best)
        {
          best = q;
          this->split_[i][j] = k;
        }
      }
      this->best_[i][j] = this->split_[i][j] < 0 ? Never : best;
    }
  }
  return this->best_[0][n - 1];
}

template <int D, class Shape>
double EdgeRemoval<D, Shape>::propose(
  const MeshEditor<D>& editor, const QualityModel<D, Shape>& model, Index t, int e, double above)
{
  if (!this->gather(editor, t, e))
  {
    return Never;
  }
  if constexpr (D == 2)
  {
    std::vector<Simplex<2>> pairOfCells;
    this->cells(pairOfCells);
    const double q = std::min(model(pairOfCells[0]), model(pairOfCells[1]));
    return q > std::max(above, this->ringWorst_) ? q : Never;
  }
  else
  {
    return this->triangulate(model, std::max(above, this->ringWorst_));
  }
}

template <int D, class Shape>
void EdgeRemoval<D, Shape>::emit(int i, int j, std::vector<Simplex<D>>& cells) const
{
  if constexpr (D == 3)
  {
    if (j - i < 2)
    {
      return;
    }
    const int k = this->split_[i][j];
    cells.push_back({ this->ring_[i], this->ring_[k], this->ring_[j], this->high_ });
    cells.push_back({ this->ring_[k], this->ring_[i], this->ring_[j], this->low_ });
    this->emit(i, k, cells);
    this->emit(k, j, cells);
  }
}

template <int D, class Shape>
void EdgeRemoval<D, Shape>::cells(std::vector<Simplex<D>>& cells) const
{
  cells.clear();
  if constexpr (D == 2)
  {
    cells.push_back({ this->low_, this->ring_[1], this->ring_[0] });
    cells.push_back({ this->ring_[1], this->high_, this->ring_[0] });
  }
  else
  {
    this->emit(0, this->n_ - 1, cells);
  }
}
}

#endif
