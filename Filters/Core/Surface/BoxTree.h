// SPDX-License-Identifier: BSD-3-Clause
/// @file BoxTree.h
/// Finds numbered things in space by their bounding boxes.
///
/// The tree is Eigen's. Its searches are not used: they take memory at each call, and the engine
/// asks for every change of a surface.
#ifndef meshopt_Surface_BoxTree_h
#define meshopt_Surface_BoxTree_h

#include "Mesh/Types.h"

#include <unsupported/Eigen/BVH>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

namespace meshopt
{
class BoxTree
{
public:
  using Box = Eigen::AlignedBox<double, 3>;

  /// A thing: its number, any that the caller likes, and its bounding box.
  struct Item
  {
    int number;
    Box box;
    friend const Box& bounding_box(const Item& item) { return item.box; } // the name Eigen asks for
  };

  /// The box around some points.
  template <class Points>
  static Box around(const Points& points)
  {
    Box box;
    for (const Vec<3>& x : points)
    {
      box.extend(Eigen::Vector3d(x));
    }
    return box;
  }
  /// The box, larger by a length on all sides.
  static Box widened(const Box& box, double margin)
  {
    const Eigen::Vector3d m = Eigen::Vector3d::Constant(margin);
    return Box(box.min() - m, box.max() + m);
  }

  /// Replaces all things. The cost is n log n.
  void build(const std::vector<Item>& items)
  {
    this->isEmpty_ = items.empty();
    this->tree_.init(items.begin(), items.end());
  }

  /// Calls found(number) for all things whose boxes touch the box. The order depends on the things
  /// only.
  template <class Found>
  void findTouching(const Box& box, Found&& found) const
  {
    if (!this->isEmpty_)
    {
      this->findTouching(this->tree_.getRootIndex(), box, found);
    }
  }

  /// Calls squaredDistance(number) for things that may be the nearest to x, in any order: for all
  /// that are, if several are as near. Returns the least value of it; infinity if there is nothing.
  template <class SquaredDistance>
  double findNearest(const Vec<3>& x, SquaredDistance&& squaredDistance) const
  {
    double least = std::numeric_limits<double>::infinity();
    if (!this->isEmpty_)
    {
      this->findNearest(this->tree_.getRootIndex(), Eigen::Vector3d(x), squaredDistance, least);
    }
    return least;
  }

private:
  using Tree = Eigen::KdBVH<double, 3, Item>;

  /// A node has two children: boxes, or things.
  struct Children
  {
    Tree::VolumeIterator box, boxEnd;
    Tree::ObjectIterator item, itemEnd;
  };
  Children children(int node) const
  {
    Children c{};
    this->tree_.getChildren(node, c.box, c.boxEnd, c.item, c.itemEnd);
    return c;
  }

  // Both descend as deep as the tree, the logarithm of the number of things.
  template <class Found>
  void findTouching(int node, const Box& box, Found& found) const
  {
    Children c = this->children(node);
    for (; c.box != c.boxEnd; ++c.box)
    {
      if (this->tree_.getVolume(*c.box).intersects(box))
      {
        this->findTouching(*c.box, box, found);
      }
    }
    for (; c.item != c.itemEnd; ++c.item)
    {
      if (c.item->box.intersects(box))
      {
        found(c.item->number);
      }
    }
  }

  template <class SquaredDistance>
  void findNearest(
    int node, const Eigen::Vector3d& x, SquaredDistance& squaredDistance, double& least) const
  {
    Children c = this->children(node);
    for (; c.item != c.itemEnd; ++c.item)
    {
      if (c.item->box.squaredExteriorDistance(x) <= least)
      {
        least = std::min(least, squaredDistance(c.item->number));
      }
    }
    std::array<std::pair<double, int>, 2> boxes;
    int size = 0;
    for (; c.box != c.boxEnd; ++c.box)
    {
      boxes[size++] = { this->tree_.getVolume(*c.box).squaredExteriorDistance(x), *c.box };
    }
    if (size == 2 && boxes[1] < boxes[0])
    {
      std::swap(boxes[0], boxes[1]); // the nearer first: it may spare the other one
    }
    for (int k = 0; k < size; ++k)
    {
      if (boxes[k].first <= least)
      {
        this->findNearest(boxes[k].second, x, squaredDistance, least);
      }
    }
  }

  Tree tree_;
  bool isEmpty_ = true;
};
}

#endif
