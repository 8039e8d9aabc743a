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
/// behind it or has that facet on its own boundary. So nothing better follows once a facet that
/// cannot be opened makes no better element than the best prefix has. A positive worst quality
/// makes the cavity star-shaped around the node. O(k log k) for k cells.
///
/// If all up to some quality is hopeless (CavityLimits), the cells behind hopeless facets have to
/// be taken in whatever else is, and so in any order: that takes O(k), and ends sooner.
///
/// A node of the surface lies in kept facets or at an edge of the surface (Opening). Facets of its
/// patches that are connected with these are opened, too: they are not joined to the node, but
/// vanish, and what is left of them is joined to it as new facets of the surface.
#ifndef meshopt_Operations_Cavity_h
#define meshopt_Operations_Cavity_h

#include "Edit/QualityModel.h"
#include "Mesh/Ids.h"
#include "Mesh/KeptEdges.h"
#include "Mesh/LocalNumbers.h"
#include "Mesh/MeshEditor.h"

#include <algorithm>
#include <limits>

namespace meshopt
{
/// How far a Cavity may grow. The numbers bound what a try costs when it fails.
struct CavityLimits
{
  int cells = 80;    ///< greatest number of cells taken in
  int swallowed = 1; ///< most free points that may vanish; others never may
  /// Growth ends after a detour: that many cells, and as many as the best prefix has, without a
  /// better one.
  int detour = 12;
  /// No cavity with an element of at most this quality is wanted: growth also ends once a facet
  /// that cannot be opened makes one. No detour counts before all hopeless facets are opened.
  double hopeless = -std::numeric_limits<double>::infinity();
};

template <int D, class Shape>
class Cavity
{
public:
  /// The facet or edge of the surface in which a new node lies (D = 3).
  struct Opening
  {
    std::array<Index, 3> ids{ None, None, None }; ///< of a facet, or of an edge and None
    std::vector<Index> patches;                   ///< of the facets there
    bool isNarrow = false; ///< no other facets are opened: the surface stays as it is
  };
  /// The node that the cavity is for; no cell need use its point.
  struct Node
  {
    Index point;
    Vec<D> x;
    const Opening* opening = nullptr; ///< of a node on the surface; null: the node is inside
  };
  /// A facet of the surface that vanishes with the cavity.
  struct Opened
  {
    Facet<D> nodes; ///< sorted
    Index patch;
    std::size_t since; ///< number of cells of the cavity when it was opened
  };

  /// Grows the cavity of cell `seed` for a node. Returns the worst quality of the new elements;
  /// -infinity if there is no cavity.
  double grow(MeshEditor<D>& editor, const QualityModel<D, Shape>& model, Index seed,
    const Node& node, const CavityLimits& limits);

  /// The cells of the best prefix.
  const std::vector<Index>& cells() const { return this->cells_; }
  double oldWorst() const { return this->oldWorst_; }
  /// Boundary facets of the best prefix. The tetrahedron (facet, node) is positive.
  const std::vector<Facet<D>>& facets() const { return this->facets_; }
  /// The cell of the cavity behind each of these facets.
  const std::vector<Index>& behind() const { return this->behind_; }
  /// The facets of the surface that vanish.
  const std::vector<Opened>& opened() const { return this->opened_; }

private:
  struct Front
  {
    double q;
    Index handle; ///< of the facet
    Index behind; ///< the cell there, or None

    bool operator<(const Front& o) const // the worst on top; ties by id
    {
      return this->q != o.q ? this->q > o.q : this->handle > o.handle;
    }
  };
  struct PointData
  {
    Vec<D> x;
    double weight;
    int facets = 0; // number of boundary facets that contain it
  };

  bool isOpened(const SimplexMesh<D>& mesh, Index c, int i) const;
  bool opens(const SimplexMesh<D>& mesh, Index c, int i);
  bool isWall(const MeshEditor<D>& editor, Index c, int i) const;
  bool take(MeshEditor<D>& editor, const QualityModel<D, Shape>& model, Index c,
    const CavityLimits& limits);
  bool takeHopeless(
    MeshEditor<D>& editor, const QualityModel<D, Shape>& model, const CavityLimits& limits);
  double quality(const QualityModel<D, Shape>& model, const SimplexMesh<D>& mesh, Index c, int i,
    const int* numbers) const;
  double plainQuality(const int* numbers) const;
  bool isClosed(const MeshEditor<D>& editor, const Front& f) const;
  void push(const Front& f);
  void dropInside(const MeshEditor<D>& editor);
  void finish(MeshEditor<D>& editor);

  LocalNumbers numbers_;
  std::vector<PointData> points_;
  std::vector<Front> heap_;     ///< in no order during takeHopeless()
  std::vector<Index> hopeless_; ///< cells behind hopeless facets
  std::vector<Index> cells_;
  std::vector<Facet<D>> facets_;
  std::vector<Index> behind_;
  const Opening* opening_ = nullptr;
  std::vector<Opened> opened_;
  std::uint32_t mark_ = 0;
  Index p_ = None;
  Vec<D> x_;
  bool ordersHeap_ = true;
  bool skipsInverted_ = false; ///< inverted elements are hopeless, whatever their quality
  int swallowed_ = 0;
  double oldWorst_ = 0.0;
  double worstWall_ = 0.0; ///< of the elements on facets that cannot be opened, without an opening
};

/// The quality of the element that joins facet i of cell c to the new node; `numbers` are those of
/// the facet's points in points_.
template <int D, class Shape>
double Cavity<D, Shape>::quality(const QualityModel<D, Shape>& model, const SimplexMesh<D>& mesh,
  Index c, int i, [[maybe_unused]] const int* numbers) const
{
  const Facet<D> f = mesh.facet(c, i);
  if constexpr (QualityModel<D, Shape>::HasSum)
  {
    // The same quality as below, but each edge to the new node is measured only once. And only the
    // facet, if it is kept, can have a weight: the others have the new node.
    if (model.plain)
    {
      const double q = this->plainQuality(numbers);
      return model.weights && mesh.isKept(c, i) && !(q < model.floor) ? q * model.weight(f) : q;
    }
  }
  Simplex<D> cell;
  std::copy(f.begin(), f.end(), cell.begin());
  cell[D] = this->p_;
  return model(cell);
}

template <int D, class Shape>
double Cavity<D, Shape>::plainQuality(const int* numbers) const
{
  const PointData &a = this->points_[numbers[0]], &b = this->points_[numbers[1]];
  const Vec<D> u = b.x - a.x, w = this->x_ - a.x;
  const auto sum = [&] { return a.weight + b.weight + EdgeSum<Shape>::weight(u.squaredNorm()); };
  ++evaluationsOfThread;
  if constexpr (D == 3)
  {
    const PointData& c = this->points_[numbers[2]];
    const Vec<D> v = c.x - a.x;
    const double volume = u.cross(v).dot(w);
    if (this->skipsInverted_ && volume <= 0.0)
    {
      return -std::numeric_limits<double>::infinity();
    }
    return EdgeSum<Shape>::quality(volume,
      sum() + c.weight + EdgeSum<Shape>::weight(v.squaredNorm()) +
        EdgeSum<Shape>::weight((u - v).squaredNorm()));
  }
  else
  {
    return EdgeSum<Shape>::quality(u[0] * w[1] - u[1] * w[0], sum());
  }
}

template <int D, class Shape>
bool Cavity<D, Shape>::isOpened(const SimplexMesh<D>& mesh, Index c, int i) const
{
  if (this->opened_.empty())
  {
    return false;
  }
  const Facet<D> key = sortedIds(mesh.facet(c, i));
  return std::any_of(
    this->opened_.begin(), this->opened_.end(), [&](const Opened& o) { return o.nodes == key; });
}

/// Whether the cavity cannot grow through facet i of cell c.
template <int D, class Shape>
bool Cavity<D, Shape>::isWall(const MeshEditor<D>& editor, Index c, int i) const
{
  const Index h = editor.mesh().adjacent(c, i);
  return h == None || (editor.mesh().isKept(c, i) && !this->isOpened(editor.mesh(), c, i)) ||
    !editor.owns(editor.mesh().cellOf(h));
}

/// Opens kept facet i of cell c if the new node lies in it, or at its edge, or if it is connected
/// with an open facet over an edge that is not kept. Returns whether it is open.
template <int D, class Shape>
bool Cavity<D, Shape>::opens(const SimplexMesh<D>& mesh, Index c, int i)
{
  if (D != 3 || !this->opening_)
  {
    return false;
  }
  const Index patch = mesh.patch(c, i);
  const auto& patches = this->opening_->patches;
  if (patch == None || std::find(patches.begin(), patches.end(), patch) == patches.end())
  {
    return false;
  }
  if (this->isOpened(mesh, c, i))
  {
    return true;
  }
  const Facet<D> key = sortedIds(mesh.facet(c, i));
  bool opens = std::all_of(this->opening_->ids.begin(), this->opening_->ids.end(),
    [&](Index p) { return p == None || hasId(key, p); });
  for (int e = 0; e < Local<D>::numberOfEdges && !opens && !this->opening_->isNarrow; ++e)
  {
    const Index a = mesh.nodes(c)[Local<D>::edges[e][0]], b = mesh.nodes(c)[Local<D>::edges[e][1]];
    opens = hasId(key, a) && hasId(key, b) && !mesh.isEdgeKept(c, e) &&
      std::any_of(this->opened_.begin(), this->opened_.end(),
        [&](const Opened& o)
        { return o.patch == patch && hasId(o.nodes, a) && hasId(o.nodes, b); });
  }
  if (opens)
  {
    this->opened_.push_back({ key, patch, this->cells_.size() });
  }
  return opens;
}

/// Takes cell c into the cavity. False if points or edges would then vanish that must not.
template <int D, class Shape>
bool Cavity<D, Shape>::take(
  MeshEditor<D>& editor, const QualityModel<D, Shape>& model, Index c, const CavityLimits& limits)
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
    if (mesh.isKept(c, i) && this->opens(mesh, c, i))
    {
      if (h != None &&
        !(editor.owns(mesh.cellOf(h)) && editor.isMarked(mesh.cellOf(h), this->mark_)))
      {
        // Of an interface both sides are needed: the other cell comes next.
        this->push({ -std::numeric_limits<double>::infinity(), mesh.handle(c, i), mesh.cellOf(h) });
      }
      continue;
    }
    // A facet of which both cells are inside is no boundary facet any more. It remains in the heap:
    // grow() drops it later.
    if (h != None && !mesh.isKept(c, i) && editor.owns(mesh.cellOf(h)) &&
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
    const double q = this->quality(model, mesh, c, i, numbers);
    if (!this->opening_ && this->isWall(editor, c, i)) // with an opening it may open later
    {
      this->worstWall_ = std::min(this->worstWall_, q);
    }
    else if (!this->opening_ && q <= limits.hopeless)
    {
      this->hopeless_.push_back(mesh.cellOf(h));
    }
    else
    {
      this->push({ q, mesh.handle(c, i), h == None ? None : mesh.cellOf(h) });
    }
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
      if (!mesh.isFree(mesh.nodes(c)[i]) || this->swallowed_ > limits.swallowed)
      {
        return false;
      }
    }
  }
  return true;
}

/// Whether the cavity cannot grow through a facet of the heap.
template <int D, class Shape>
bool Cavity<D, Shape>::isClosed(const MeshEditor<D>& editor, const Front& f) const
{
  return this->opening_ &&
    this->isWall(editor, SimplexMesh<D>::cellOf(f.handle), SimplexMesh<D>::facetOf(f.handle));
}

template <int D, class Shape>
void Cavity<D, Shape>::push(const Front& f)
{
  this->heap_.push_back(f);
  if (this->ordersHeap_)
  {
    std::push_heap(this->heap_.begin(), this->heap_.end());
  }
}

/// Facets that lie inside by now leave the heap when they come to the top.
template <int D, class Shape>
void Cavity<D, Shape>::dropInside(const MeshEditor<D>& editor)
{
  while (!this->heap_.empty() && !this->isClosed(editor, this->heap_.front()) &&
    editor.isMarked(this->heap_.front().behind, this->mark_))
  {
    std::pop_heap(this->heap_.begin(), this->heap_.end());
    this->heap_.pop_back();
  }
}

/// Takes in all that lies behind hopeless facets, the nearest first: so it meets those that cannot
/// be opened soonest. False if the cavity is hopeless.
template <int D, class Shape>
bool Cavity<D, Shape>::takeHopeless(
  MeshEditor<D>& editor, const QualityModel<D, Shape>& model, const CavityLimits& limits)
{
  bool more = this->worstWall_ > limits.hopeless;
  if (this->hopeless_.empty())
  {
    return more;
  }
  this->ordersHeap_ = false;
  for (std::size_t k = 0; k < this->hopeless_.size() && more; ++k)
  {
    const Index c = this->hopeless_[k];
    more = editor.isMarked(c, this->mark_) ||
      (static_cast<int>(this->cells_.size()) < limits.cells &&
        this->take(editor, model, c, limits) && this->worstWall_ > limits.hopeless);
  }
  this->hopeless_.clear();
  this->ordersHeap_ = true;
  if (more)
  {
    std::make_heap(this->heap_.begin(), this->heap_.end());
  }
  return more;
}

template <int D, class Shape>
double Cavity<D, Shape>::grow(MeshEditor<D>& editor, const QualityModel<D, Shape>& model,
  Index seed, const Node& node, const CavityLimits& limits)
{
  this->opening_ = node.opening;
  this->opened_.clear();
  this->numbers_.clear();
  this->points_.clear();
  this->heap_.clear();
  this->hopeless_.clear();
  this->skipsInverted_ = limits.hopeless >= 0.0;
  this->cells_.clear();
  this->mark_ = editor.newMark();
  this->p_ = node.point;
  this->x_ = node.x;
  this->swallowed_ = 0;
  double best = -std::numeric_limits<double>::infinity();
  std::size_t bestSize = 0;
  this->worstWall_ = std::numeric_limits<double>::infinity();
  bool more = this->take(editor, model, seed, limits);
  while (more && this->takeHopeless(editor, model, limits))
  {
    this->dropInside(editor);
    // The worst facet on the boundary is the worst quality of the whole prefix.
    const double q = this->heap_.empty() ? this->worstWall_
                                         : std::min(this->worstWall_, this->heap_.front().q);
    if (q > best)
    {
      best = q;
      bestSize = this->cells_.size();
    }
    // If the worst facet cannot be opened, no larger cavity can be better than the best so far.
    if (this->worstWall_ <= std::max(best, limits.hopeless) || this->heap_.empty() ||
      this->isClosed(editor, this->heap_.front()) ||
      static_cast<int>(this->cells_.size()) >= limits.cells ||
      this->cells_.size() > 2 * bestSize + limits.detour)
    {
      break;
    }
    more = this->take(editor, model, this->heap_.front().behind, limits);
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
  this->behind_.clear();
  const std::size_t size = this->cells_.size();
  this->opened_.erase(std::remove_if(this->opened_.begin(), this->opened_.end(),
                        [&](const Opened& o) { return o.since > size; }),
    this->opened_.end());
  for (Index c : this->cells_)
  {
    for (int i = 0; i <= D; ++i)
    {
      if (mesh.isKept(c, i) && this->isOpened(mesh, c, i))
      {
        continue; // of the outer surface, or between two cells of the cavity
      }
      if (this->isWall(editor, c, i) || !editor.isMarked(mesh.cellOf(mesh.adjacent(c, i)), inside))
      {
        this->facets_.push_back(mesh.facet(c, i));
        this->behind_.push_back(c);
      }
    }
  }
}
}

#endif
