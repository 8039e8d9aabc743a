// SPDX-License-Identifier: BSD-3-Clause
/// @file BoxTree.h
/// Finds numbered things in space by their bounding boxes.
///
/// The tree is Eigen's. Its searches are not used: they take memory at each call, and the engine
/// asks for every change of a surface.
#ifndef meshopt_Mesh_BoxTree_h
#define meshopt_Mesh_BoxTree_h

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

  /// The box around some points, in space or in the plane (of height 0).
  template <class Points>
  static Box around(const Points& points)
  {
    Box box;
    for (const auto& x : points)
    {
      box.extend(Eigen::Vector3d(x[0], x[1], x.size() == 3 ? x[x.size() - 1] : 0.0));
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

  /// Calls found(number) for all things whose boxes touch the segment from `from` to `from + t
  /// way`, 0 <= t <= end, in any order. found() may shorten `end` meanwhile.
  template <class Found>
  void findAlong(const Vec<3>& from, const Vec<3>& way, double& end, Found&& found) const
  {
    if (!this->isEmpty_)
    {
      const Segment segment{ Eigen::Array3d(from), Eigen::Array3d(way), end };
      this->findAlong(this->tree_.getRootIndex(), segment, found);
    }
  }

private:
  struct Segment
  {
    Eigen::Array3d from, way;
    const double& end;

    /// By the parameters at which it enters and leaves the slabs between opposite sides.
    bool touches(const Box& box) const
    {
      double first = 0.0, last = this->end;
      for (int i = 0; i < 3; ++i)
      {
        const double low = box.min()[i] - this->from[i], high = box.max()[i] - this->from[i];
        if (this->way[i] == 0.0)
        {
          last = low <= 0.0 && high >= 0.0 ? last : -1.0; // it stays in the slab, or outside
          continue;
        }
        first = std::max(first, (this->way[i] > 0.0 ? low : high) / this->way[i]);
        last = std::min(last, (this->way[i] > 0.0 ? high : low) / this->way[i]);
      }
      return first <= last;
    }
  };

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

  template <class Found>
  void findAlong(int node, const Segment& segment, Found& found) const
  {
    Children c = this->children(node);
    for (; c.box != c.boxEnd; ++c.box)
    {
      if (segment.touches(this->tree_.getVolume(*c.box)))
      {
        this->findAlong(*c.box, segment, found);
      }
    }
    for (; c.item != c.itemEnd; ++c.item)
    {
      if (segment.touches(c.item->box))
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
