// SPDX-License-Identifier: BSD-3-Clause
/// @file Background.h
/// A frozen copy of a mesh for locating points: the cell of a point, and the weights of its nodes.
#ifndef meshopt_Metric_Background_h
#define meshopt_Metric_Background_h

#include "Mesh/SimplexMesh.h"

#include <memory>
#include <mutex>
#include <vector>

namespace meshopt
{
/// The location of a point.
template <int D>
struct Location
{
  Index cell = None;  ///< in the background; None only if the background has no usable cell
  Simplex<D> nodes{}; ///< its points
  /// Barycentric weights: each in [0, 1], with sum 1 up to rounding. For a point outside of the
  /// mesh they are those of the nearest point of the nearest cell.
  std::array<double, D + 1> weights{};
  /// Distance to that cell; 0 if the point is in it.
  double distance = 0.0;
};

/// A copy of the points, cells and adjacency of a mesh at this moment, with a search. Immutable:
/// any number of threads may search at the same time.
///
/// A search walks from a given cell over facets towards the point, which is cheap if the point is
/// near. If the walk leaves the mesh or goes in circles, a tree of bounding boxes is used. The tree
/// is built when it is first needed (O(n log n)).
template <int D>
class Background
{
public:
  explicit Background(const SimplexMesh<D>& mesh);

  /// Live cells are numbered without gaps, in the order of the mesh's slots.
  Index numberOfCells() const { return static_cast<Index>(this->cells_.size()); }
  /// All point slots of the mesh, with the same ids.
  Index numberOfPoints() const { return static_cast<Index>(this->points_.size()); }
  const Simplex<D>& nodes(Index cell) const { return this->cells_[cell].nodes; }
  const Vec<D>& point(Index p) const { return this->points_[p]; }
  /// A cell that uses point p of the mesh, or None: a hint for locate().
  Index cellOfPoint(Index p) const
  {
    return p >= 0 && p < this->numberOfPoints() ? this->cellOfPoint_[p] : None;
  }

  /// Finds x, starting at cell `hint` (None: with the tree). Flat cells contain nothing. On a facet
  /// between cells, the one that the walk meets first is taken; both give the same interpolated
  /// values up to rounding. For a point that is not finite, the cell is None.
  Location<D> locate(const Vec<D>& x, Index hint = None) const;

  /// Linear interpolation of values at points: exact for constants, to the last bit.
  /// `value(p)` returns a double or an Eigen object.
  template <class F>
  static auto interpolate(const Location<D>& at, F&& value)
  {
    auto result = value(at.nodes[0]);
    for (int i = 1; i <= D; ++i)
    {
      result += at.weights[i] * (value(at.nodes[i]) - value(at.nodes[0]));
    }
    return result;
  }

private:
  struct Cell
  {
    Simplex<D> nodes;
    std::array<Index, D + 1> neighbours; ///< across facet i, or None
  };
  struct Box
  {
    Vec<D> low = Vec<D>::Zero(), high = Vec<D>::Zero();
    Index first = 0, last = 0; ///< range of order_
    Index left = None;         ///< children left and left + 1; None: a leaf
  };

  bool weights(Index cell, const Vec<D>& x, std::array<double, D + 1>& w) const;
  Location<D> found(Index cell, const std::array<double, D + 1>& w) const;
  Location<D> nearestInCell(Index cell, const Vec<D>& x) const;
  Location<D> searchTree(const Vec<D>& x) const;
  void buildTree() const;
  void fitBox(Box& box) const;
  bool isFartherThan(Index cell, const Vec<D>& x, double distance) const;

  std::vector<Vec<D>> points_;
  std::vector<Cell> cells_;
  std::vector<Index> cellOfPoint_;

  mutable std::once_flag treeFlag_;
  mutable std::vector<Box> boxes_;
  mutable std::vector<Index> order_;
};

extern template class Background<2>;
extern template class Background<3>;
}

#endif
