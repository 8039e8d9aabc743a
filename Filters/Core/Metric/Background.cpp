// SPDX-License-Identifier: BSD-3-Clause
// Locates points in the mesh of the input. A walk from a hint finds nearly all; a tree of boxes
// finds the rest, and the nearest cell for points outside.
#include "Metric/Background.h"

#include "Mesh/SimplexGeometry.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace meshopt
{
namespace
{
/// How far outside of a cell a point may be, as a negative weight, and still count as inside.
constexpr double slack = 1e-10;
constexpr Index leafSize = 8;

/// 0 inside of the box. Squares, since distances are only compared.
template <int D>
double squaredDistanceToBox(const Vec<D>& low, const Vec<D>& high, const Vec<D>& x)
{
  double d2 = 0.0;
  for (int i = 0; i < D; ++i)
  {
    const double d = std::max(0.0, std::max(low[i] - x[i], x[i] - high[i]));
    d2 += d * d;
  }
  return d2;
}

/// Sets the weights of the point nearest to x in a face of the simplex; `face` has a bit for each
/// node. False if that point is not in the face (a smaller face has it), or if the face is
/// degenerate.
template <int D>
bool projectOnFace(
  const Corners<D>& corners, const Vec<D>& x, unsigned face, std::array<double, D + 1>& w)
{
  int ids[D + 1];
  int n = 0;
  for (int i = 0; i <= D; ++i)
  {
    w[i] = 0.0;
    if ((face >> i) & 1u)
    {
      ids[n++] = i;
    }
  }
  using Dynamic = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, D, D>;
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, D, 1> t(n - 1);
  if (n > 1)
  {
    Dynamic edges(D, n - 1);
    for (int k = 1; k < n; ++k)
    {
      edges.col(k - 1) = corners[ids[k]] - corners[ids[0]];
    }
    const Dynamic gram = edges.transpose() * edges;
    // A face without area has linearly dependent edges. Its own faces cover all that it covers.
    const Eigen::FullPivLU<Dynamic> lu(gram);
    if (lu.rank() < n - 1)
    {
      return false;
    }
    t = lu.solve(edges.transpose() * (x - corners[ids[0]]));
  }
  double rest = 1.0;
  for (int k = 1; k < n; ++k)
  {
    if (!(t[k - 1] >= 0.0))
    {
      return false;
    }
    w[ids[k]] = t[k - 1];
    rest -= t[k - 1];
  }
  w[ids[0]] = rest;
  return rest >= 0.0;
}
}

/// Cells get numbers without gaps. Points keep theirs, so that values per point of the mesh can be
/// looked up as they are.
template <int D>
Background<D>::Background(const SimplexMesh<D>& mesh)
{
  const Index slots = mesh.numberOfCellSlots();
  std::vector<Index> numbers(slots, None);
  Index n = 0;
  for (Index c = 0; c < slots; ++c)
  {
    if (mesh.isAlive(c))
    {
      numbers[c] = n++;
    }
  }
  this->points_.resize(mesh.numberOfPointSlots());
  this->cellOfPoint_.assign(mesh.numberOfPointSlots(), None);
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    // A copy: the mesh moves on, while values are those of its first state.
    this->points_[p] = mesh.point(p);
  }
  this->cells_.resize(n);
  for (Index c = 0; c < slots; ++c)
  {
    if (numbers[c] == None)
    {
      continue;
    }
    Cell& cell = this->cells_[numbers[c]];
    cell.nodes = mesh.nodes(c);
    for (int i = 0; i <= D; ++i)
    {
      const Index across = mesh.adjacent(c, i);
      cell.neighbours[i] = across == None ? None : numbers[SimplexMesh<D>::cellOf(across)];
      this->cellOfPoint_[cell.nodes[i]] = numbers[c];
    }
  }
}

/// Barycentric weights of x, negative where it lies outside. False for a flat cell, which has none.
template <int D>
bool Background<D>::weights(Index c, const Vec<D>& x, std::array<double, D + 1>& w) const
{
  Corners<D> corners;
  for (int i = 0; i <= D; ++i)
  {
    corners[i] = this->points_[this->cells_[c].nodes[i]];
  }
  const double det = volumeDeterminant(corners);
  if (det == 0.0)
  {
    return false;
  }
  for (int i = 0; i <= D; ++i)
  {
    // Barycentric weight: the part of the volume opposite to the node.
    Corners<D> part = corners;
    part[i] = x;
    w[i] = volumeDeterminant(part) / det;
  }
  return true;
}

/// The place in cell c with these weights, which rounding may have moved out of it.
template <int D>
Location<D> Background<D>::found(Index c, const std::array<double, D + 1>& w) const
{
  Location<D> at;
  at.cell = c;
  at.nodes = this->cells_[c].nodes;
  // Rounding may have left small negative weights: clamp them, and restore the sum 1.
  double sum = 0.0;
  for (int i = 0; i <= D; ++i)
  {
    at.weights[i] = std::max(0.0, w[i]);
    sum += at.weights[i];
  }
  for (double& weight : at.weights)
  {
    weight = std::min(1.0, weight / sum);
  }
  return at;
}

/// The projection on a face counts only if it lies in the face. The nearest of these is the nearest
/// point of the cell, even if the cell is flat or inverted.
template <int D>
Location<D> Background<D>::nearestInCell(Index c, const Vec<D>& x) const
{
  Corners<D> corners;
  for (int i = 0; i <= D; ++i)
  {
    corners[i] = this->points_[this->cells_[c].nodes[i]];
  }
  Location<D> best;
  best.distance = std::numeric_limits<double>::infinity();
  // All faces are tried, from the nodes (one bit) to the cell itself (all bits).
  for (unsigned face = 1; face < (2u << D); ++face)
  {
    std::array<double, D + 1> w;
    if (!projectOnFace<D>(corners, x, face, w))
    {
      continue;
    }
    Vec<D> y = w[0] * (corners[0] - x);
    for (int i = 1; i <= D; ++i)
    {
      y += w[i] * (corners[i] - x);
    }
    if (y.norm() < best.distance)
    {
      best = this->found(c, w);
      best.distance = y.norm();
    }
  }
  return best;
}

/// First a walk, since the hint is mostly next to x. The tree is for walks that leave the mesh or
/// do not end.
template <int D>
Location<D> Background<D>::locate(const Vec<D>& x, Index hint) const
{
  Location<D> nowhere;
  if (this->cells_.empty() || !x.allFinite())
  {
    return nowhere;
  }
  // A straight walk crosses about n^(1/D) cells; with far more it goes in circles.
  const int limit = 50 + 4 * static_cast<int>(std::pow(this->cells_.size(), 1.0 / D));
  Index c = hint >= 0 && hint < this->numberOfCells() ? hint : None;
  for (int step = 0; c != None && step < limit; ++step)
  {
    std::array<double, D + 1> w;
    // A flat cell does not say which way to go.
    if (!this->weights(c, x, w))
    {
      break;
    }
    // Leave through the facet behind which x lies farthest.
    const int i = static_cast<int>(std::min_element(w.begin(), w.end()) - w.begin());
    if (w[i] >= -slack)
    {
      return this->found(c, w);
    }
    // None beyond the surface: x may still lie in the mesh, behind a hollow.
    c = this->cells_[c].neighbours[i];
  }
  return this->searchTree(x);
}

/// Of whole cells, not of their centres: boxes beside each other may overlap.
template <int D>
void Background<D>::fitBox(Box& box) const
{
  box.low.setConstant(std::numeric_limits<double>::infinity());
  box.high.setConstant(-std::numeric_limits<double>::infinity());
  for (Index k = box.first; k < box.last; ++k)
  {
    for (Index p : this->cells_[this->order_[k]].nodes)
    {
      box.low = box.low.cwiseMin(this->points_[p]);
      box.high = box.high.cwiseMax(this->points_[p]);
    }
  }
}

/// Each box is halved at the median cell, so that the tree is log n deep for any mesh.
template <int D>
void Background<D>::buildTree() const
{
  this->order_.resize(this->cells_.size());
  std::iota(this->order_.begin(), this->order_.end(), 0);
  std::vector<Vec<D>> centres(this->cells_.size());
  for (std::size_t c = 0; c < this->cells_.size(); ++c)
  {
    // Sums do for centres: only their order counts.
    centres[c].setZero();
    for (Index p : this->cells_[c].nodes)
    {
      centres[c] += this->points_[p];
    }
  }
  Box root;
  root.last = this->numberOfCells();
  this->boxes_.push_back(root);
  for (std::size_t b = 0; b < this->boxes_.size(); ++b)
  {
    // A copy, since push_back() below may move the boxes.
    Box box = this->boxes_[b];
    this->fitBox(box);
    if (box.last - box.first > leafSize)
    {
      // Along the longest side, so that boxes do not become thin.
      int axis;
      (box.high - box.low).maxCoeff(&axis);
      const auto begin = this->order_.begin();
      const Index middle = box.first + (box.last - box.first) / 2;
      std::nth_element(begin + box.first, begin + middle, begin + box.last,
        [&centres, axis](Index a, Index c)
        {
          // With ties by id, both halves are the same on every machine.
          const double x = centres[a][axis], y = centres[c][axis];
          return x != y ? x < y : a < c;
        });
      box.left = static_cast<Index>(this->boxes_.size());
      Box child;
      child.first = box.first;
      child.last = middle;
      this->boxes_.push_back(child);
      child.first = middle;
      child.last = box.last;
      this->boxes_.push_back(child);
    }
    this->boxes_[b] = box;
  }
}

/// Cheap, and it spares most cells of a leaf the projections on all their faces.
template <int D>
bool Background<D>::isFartherThan(Index c, const Vec<D>& x, double distance) const
{
  Vec<D> low = this->points_[this->cells_[c].nodes[0]], high = low;
  for (int i = 1; i <= D; ++i)
  {
    low = low.cwiseMin(this->points_[this->cells_[c].nodes[i]]);
    high = high.cwiseMax(this->points_[this->cells_[c].nodes[i]]);
  }
  return squaredDistanceToBox<D>(low, high, x) > distance * distance;
}

template <int D>
Location<D> Background<D>::searchTree(const Vec<D>& x) const
{
  // Built at the first need: most points are found by a walk. Several threads may ask.
  std::call_once(this->treeFlag_, [this] { this->buildTree(); });
  // Depth first, the nearer child first, until a cell contains x; ties to the lowest id.
  Location<D> best;
  best.distance = std::numeric_limits<double>::infinity();
  std::vector<Index> stack(1, 0);
  while (!stack.empty() && best.distance > 0.0)
  {
    const Box& box = this->boxes_[stack.back()];
    stack.pop_back();
    if (squaredDistanceToBox<D>(box.low, box.high, x) > best.distance * best.distance)
    {
      continue;
    }
    if (box.left != None)
    {
      const Box &l = this->boxes_[box.left], &r = this->boxes_[box.left + 1];
      const bool leftFirst = squaredDistanceToBox<D>(l.low, l.high, x) <=
        squaredDistanceToBox<D>(r.low, r.high, x);
      // The nearer child goes on top.
      stack.push_back(leftFirst ? box.left + 1 : box.left);
      stack.push_back(leftFirst ? box.left : box.left + 1);
      continue;
    }
    for (Index k = box.first; k < box.last && best.distance > 0.0; ++k)
    {
      const Index c = this->order_[k];
      if (this->isFartherThan(c, x, best.distance))
      {
        continue;
      }
      std::array<double, D + 1> w;
      const bool solid = this->weights(c, x, w);
      const bool inside = solid && *std::min_element(w.begin(), w.end()) >= -slack;
      const Location<D> at = inside ? this->found(c, w) : this->nearestInCell(c, x);
      if (at.distance < best.distance || (at.distance == best.distance && c < best.cell))
      {
        best = at;
      }
    }
  }
  return best;
}

template class Background<2>;
template class Background<3>;
}
