// SPDX-License-Identifier: BSD-3-Clause
/// @file EdgeRemoval.h
/// Removes an edge: the ring of points around it is triangulated in the best way, and both ends of
/// the edge are joined to the triangles. (The paper's edge cluster to a ring node is the special
/// case of a fan.) In 2D this is the swap of an edge. Where the surface may be remeshed, the ring
/// can be open: it then runs from one facet of the surface to the next, and these two facets are
/// swapped. At an interface there is such a ring on either side.
///
///      r3 ---- r2        r3 ---- r2       The ring seen from high along the edge (o), before and
///      | \   / |         | \     |        after. Each new triangle is joined to low and to high:
///      |   o   |         |   \   |        here (r0 r1 r3) and (r1 r2 r3).
///      | /   \ |         |     \ |
///      r0 ---- r1        r0 ---- r1
///
/// Reference: G. T. Klincsek, Minimal triangulations of polygonal domains (1980), with the minimum
/// in place of the sum: D[i][j] = max over k of min(D[i][k], D[k][j], both tetrahedra on the
/// triangle i k j). At most O(n^3) qualities for a ring of n points, pruned by the quality that
/// must be exceeded.
#ifndef meshopt_Operations_EdgeRemoval_h
#define meshopt_Operations_EdgeRemoval_h

#include "Edit/Proposal.h"
#include "Edit/QualityModel.h"
#include "Surface/Surface.h"

#include <algorithm>
#include <memory>

namespace meshopt
{
template <int D, class Shape>
class EdgeRemoval
{
public:
  /// Larger rings are left alone: time grows with the cube, and a ring has about five cells on
  /// average.
  static constexpr int MaximumRing = 12;

  /// Tries to remove edge e (local number) of cell t. Returns the worst quality of the best
  /// refilling if it is above `above` and above the worst of the ring, else -infinity. It is
  /// -infinity also if the edge must stay: if it is kept, is on a surface where `surface` allows no
  /// swap (null: never), has too large a ring, or has cells that the editor does not own.
  double propose(const MeshEditor<D>& editor, const QualityModel<D, Shape>& model, Index t, int e,
    double above, const Surface<D>* surface = nullptr);

  /// The worst quality in the ring of the last propose() that found a ring.
  double ringWorst() const { return this->ringWorst_; }
  const std::vector<Index>& cavity() const { return this->cavity_; }
  /// The cells of the last successful propose().
  void cells(std::vector<Simplex<D>>& cells) const;
  /// The same as a proposal, with the kept facets and edges that change.
  void fill(Proposal<D>& proposal, const SimplexMesh<D>& mesh) const;

private:
  static constexpr double Never = -std::numeric_limits<double>::infinity();

  /// A cell of the ring with local numbers of its nodes: first the ends of the edge, then two ring
  /// points. The next cell of the ring is opposite to the third node.
  struct Start
  {
    Index cell;
    std::array<int, D + 1> local;
  };
  enum class Ring
  {
    None,
    Closed,
    Blocked ///< ends at a kept facet
  };
  bool gather(const MeshEditor<D>& editor, Index t, int e, const Surface<D>* surface);
  bool gatherPair(const MeshEditor<D>& editor, Index t, int e);
  Ring gatherRing(const MeshEditor<D>& editor, const Start& start);
  bool gatherOpenRing(const MeshEditor<D>& editor, Start start, const Surface<D>& surface);
  bool gatherOther(const MeshEditor<D>& editor, Index first, const Surface<D>& surface);
  double triangulate(const QualityModel<D, Shape>& model, double above);
  void weigh(const QualityModel<D, Shape>& model);
  double pair(const QualityModel<D, Shape>& model, int i, int k, int j, double above) const;
  void emit(int i, int j, std::vector<Simplex<D>>& cells) const;

  std::vector<Index> cavity_;
  double ringWorst_ = 0.0;
  bool isOpen_ = false;   // the ring begins and ends at the surface
  bool isSecond_ = false; // this object is the other side of an interface
  bool hasOther_ = false; // the ring begins and ends at an interface
  std::unique_ptr<EdgeRemoval> other_;
  Index low_ = None, high_ = None; // the edge; the ring runs counterclockwise seen from high_
  int n_ = 0;
  Index ring_[MaximumRing];
  Vec<D> x_[MaximumRing], xLow_, xHigh_;
  double weight_[MaximumRing][MaximumRing], weightLow_[MaximumRing], weightHigh_[MaximumRing];
  double best_[MaximumRing][MaximumRing];
  int split_[MaximumRing][MaximumRing];
};

/// In 2D: the cavity is the two cells of the edge; the ring is the two nodes opposite to it.
template <int D, class Shape>
bool EdgeRemoval<D, Shape>::gatherPair(const MeshEditor<D>& editor, Index t, int e)
{
  const SimplexMesh<D>& mesh = editor.mesh();
  const int o = 3 - Local<D>::edges[e][0] - Local<D>::edges[e][1];
  const Index h = mesh.adjacent(t, o);
  if (h == None || mesh.isKept(t, o) || !editor.owns(mesh.cellOf(h)))
  {
    return false;
  }
  this->cavity_ = { t, mesh.cellOf(h) };
  this->ringWorst_ = std::min(mesh.quality(t), mesh.quality(mesh.cellOf(h)));
  const Facet<D> f = mesh.facet(t, o);
  this->low_ = f[0];
  this->high_ = f[1];
  this->ring_[0] = mesh.nodes(t)[o];
  this->ring_[1] = mesh.nodes(mesh.cellOf(h))[mesh.facetOf(h)];
  this->n_ = 2;
  return true;
}

/// In 3D: collects the cells around the edge, beginning with the start, and their ring points.
template <int D, class Shape>
typename EdgeRemoval<D, Shape>::Ring EdgeRemoval<D, Shape>::gatherRing(
  const MeshEditor<D>& editor, const Start& start)
{
  const SimplexMesh<D>& mesh = editor.mesh();
  const Simplex<D>& nodes = mesh.nodes(start.cell);
  this->cavity_.assign(1, start.cell);
  this->ringWorst_ = mesh.quality(start.cell);
  this->low_ = nodes[start.local[0]];
  this->high_ = nodes[start.local[1]];
  this->ring_[0] = nodes[start.local[2]];
  this->ring_[1] = nodes[start.local[D]];
  this->n_ = 2;
  Index current = start.cell;
  int exit = start.local[2]; // leave through the facet opposite to the older ring point
  while (true)
  {
    const Index h = mesh.adjacent(current, exit);
    if (h == None || mesh.isKept(current, exit))
    {
      return Ring::Blocked;
    }
    const Index next = mesh.cellOf(h);
    if (next == start.cell || !editor.owns(next))
    {
      return Ring::None;
    }
    this->cavity_.push_back(next);
    this->ringWorst_ = std::min(this->ringWorst_, mesh.quality(next));
    const Index newcomer = mesh.nodes(next)[mesh.facetOf(h)];
    exit = mesh.localIndex(next, this->ring_[this->n_ - 1]);
    current = next;
    if (newcomer == this->ring_[0])
    {
      // closed if the next facet leads back to the start
      const Index back = mesh.adjacent(current, exit);
      const bool isClosed = back != None && !mesh.isKept(current, exit) &&
        mesh.cellOf(back) == start.cell;
      return isClosed && this->n_ > 2 ? Ring::Closed : Ring::None;
    }
    if (this->n_ == MaximumRing)
    {
      return Ring::None;
    }
    this->ring_[this->n_++] = newcomer;
  }
}

/// From one facet of the surface to the next: goes back from the start to the first facet, then all
/// the way to the other.
template <int D, class Shape>
bool EdgeRemoval<D, Shape>::gatherOpenRing(
  const MeshEditor<D>& editor, Start start, const Surface<D>& surface)
{
  const SimplexMesh<D>& mesh = editor.mesh();
  while (!mesh.isKept(start.cell, start.local[D]))
  {
    const Simplex<D>& nodes = mesh.nodes(start.cell);
    const Index h = mesh.adjacent(start.cell, start.local[D]);
    const Index next = mesh.cellOf(h), c = nodes[start.local[2]];
    if (!editor.owns(next))
    {
      return false;
    }
    start.local = { mesh.localIndex(next, nodes[start.local[0]]),
      mesh.localIndex(next, nodes[start.local[1]]), mesh.facetOf(h) };
    start.local[D] = mesh.localIndex(next, c);
    start.cell = next;
  }
  if (this->gatherRing(editor, start) != Ring::Blocked || this->n_ < 3)
  {
    return false;
  }
  // The facet of the surface is opposite to the second last ring point.
  const Index first = this->cavity_[0], last = this->cavity_.back();
  const int i = mesh.localIndex(first, this->ring_[1]);
  const int j = mesh.localIndex(last, this->ring_[this->n_ - 2]);
  this->isOpen_ = surface.maySwap(mesh, mesh.patch(first, i), mesh.patch(last, j));
  // A facet between regions has cells on both sides, and both change.
  const Index across = mesh.adjacent(first, i);
  this->hasOther_ = across != None && !this->isSecond_;
  return this->isOpen_ &&
    (!this->hasOther_ || this->gatherOther(editor, mesh.cellOf(across), surface));
}

/// The ring on the other side of an interface; `first`: a cell of it. It must join the same points.
template <int D, class Shape>
bool EdgeRemoval<D, Shape>::gatherOther(
  const MeshEditor<D>& editor, Index first, const Surface<D>& surface)
{
  if (!this->other_)
  {
    this->other_ = std::make_unique<EdgeRemoval>();
    this->other_->isSecond_ = true;
  }
  const int e = editor.mesh().localEdge(first, this->low_, this->high_);
  if (!editor.owns(first) || !this->other_->gather(editor, first, e, &surface))
  {
    return false;
  }
  const EdgeRemoval& o = *this->other_;
  this->ringWorst_ = std::min(this->ringWorst_, o.ringWorst_);
  return o.isOpen_ && o.ring_[0] == this->ring_[this->n_ - 1] &&
    o.ring_[o.n_ - 1] == this->ring_[0];
}

template <int D, class Shape>
bool EdgeRemoval<D, Shape>::gather(
  const MeshEditor<D>& editor, Index t, int e, [[maybe_unused]] const Surface<D>* surface)
{
  const SimplexMesh<D>& mesh = editor.mesh();
  this->isOpen_ = this->hasOther_ = false;
  bool found = false;
  if constexpr (D == 2)
  {
    found = this->gatherPair(editor, t, e);
  }
  else if (!mesh.isEdgeKeptByItself(t, e))
  {
    Start start{ t, {} };
    std::copy_n(Local<D>::edgeFirst[e], D + 1, start.local.begin());
    const Ring ring = this->gatherRing(editor, start);
    found = ring == Ring::Closed ||
      (ring == Ring::Blocked && surface && this->gatherOpenRing(editor, start, *surface));
  }
  if (found)
  {
    for (int i = 0; i < this->n_; ++i)
    {
      this->x_[i] = mesh.point(this->ring_[i]);
    }
    this->xLow_ = mesh.point(this->low_);
    this->xHigh_ = mesh.point(this->high_);
  }
  return found;
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
    // Every length is needed for many triangles: measure each only once.
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

/// The worse of the two tetrahedra on triangle (i, k, j), i < k < j. The second is not measured if
/// the first is not above `above`.
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
        ++evaluationsOfThread;
        if (!(high > above))
        {
          return high;
        }
        ++evaluationsOfThread;
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
  // Two neighbours on the ring need no triangle between them.
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
        // Only what exceeds the best so far counts: most triangles are pruned before they are
        // measured.
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
double EdgeRemoval<D, Shape>::propose(const MeshEditor<D>& editor,
  const QualityModel<D, Shape>& model, Index t, int e, double above, const Surface<D>* surface)
{
  if (!this->gather(editor, t, e, surface))
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
    const double required = std::max(above, this->ringWorst_);
    const double q = this->triangulate(model, required);
    return q > required && this->hasOther_ ? std::min(q, this->other_->triangulate(model, required))
                                           : q;
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

template <int D, class Shape>
void EdgeRemoval<D, Shape>::fill(Proposal<D>& proposal, const SimplexMesh<D>& mesh) const
{
  this->cells(proposal.cells);
  proposal.cavity = this->cavity_;
  proposal.oldWorst = this->ringWorst_;
  proposal.changesKept = this->isOpen_;
  if constexpr (D == 3)
  {
    if (this->isOpen_)
    {
      // The two facets of the surface at the edge are exchanged for the two at the new diagonal.
      const Index first = this->ring_[0], last = this->ring_[this->n_ - 1];
      const Index c = this->cavity_[0];
      const Index patch = mesh.patch(c, mesh.localIndex(c, this->ring_[1]));
      proposal.kept.clear();
      proposal.kept.gone = { { this->low_, this->high_, first },
        { this->low_, this->high_, last } };
      proposal.kept.come = { { first, last, this->low_ }, { first, last, this->high_ } };
      proposal.kept.patches.assign(2, patch);
      proposal.kept.regions.assign(proposal.cells.size(), mesh.region(c));
    }
    if (this->hasOther_)
    {
      std::vector<Simplex<D>> cells;
      this->other_->cells(cells);
      const std::vector<Index>& cavity = this->other_->cavity_;
      proposal.cells.insert(proposal.cells.end(), cells.begin(), cells.end());
      proposal.cavity.insert(proposal.cavity.end(), cavity.begin(), cavity.end());
      proposal.kept.regions.resize(proposal.cells.size(), mesh.region(cavity[0]));
    }
  }
}
}

#endif
