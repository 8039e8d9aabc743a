// SPDX-License-Identifier: BSD-3-Clause
// A tree of boxes around edges, and a line that is halved until each part is near one edge.
#include "Surface/SharpEdges.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace meshopt
{
namespace
{
/// From x to the nearest point between both ends.
double squaredDistance(const std::array<Vec<3>, 2>& edge, const Vec<3>& x)
{
  const Vec<3> d = edge[1] - edge[0];
  const double length = d.squaredNorm();
  const double s = length > 0.0 ? std::clamp((x - edge[0]).dot(d) / length, 0.0, 1.0) : 0.0;
  return (edge[0] + s * d - x).squaredNorm();
}
}

void SharpEdges::finish()
{
  std::vector<BoxTree::Item> items;
  for (const auto& edge : this->edges_)
  {
    items.push_back({ static_cast<int>(items.size()), BoxTree::around(edge) });
  }
  this->tree_.build(items);
}

/// Where there was no sharp edge, none may come.
bool SharpEdges::isNear(const Vec<3>& a, const Vec<3>& b, double distance) const
{
  // An edge that is near to some part of the line has a box that meets this one.
  const BoxTree::Box box = BoxTree::widened(
    BoxTree::around(std::array<Vec<3>, 2>{ a, b }), distance);
  std::vector<int> found;
  this->tree_.findTouching(box, [&](int k) { found.push_back(k); });

  // The distance from one edge is convex: where it is kept at both ends, it is kept between them.
  // What has no such edge is halved.
  // Parts to look at in all.
  constexpr int most = 32;
  const double limit = distance * distance;
  std::vector<std::array<Vec<3>, 2>> open{ { a, b } };
  for (int n = 0; !open.empty(); ++n)
  {
    const auto [p, q] = open.back();
    open.pop_back();
    const auto isNearTo = [&, p = p, q = q](int k)
    {
      return squaredDistance(this->edges_[k], p) <= limit &&
        squaredDistance(this->edges_[k], q) <= limit;
    };
    if (std::any_of(found.begin(), found.end(), isNearTo))
    {
      continue;
    }
    // False is the safe answer: the change is refused.
    if (n >= most)
    {
      return false;
    }
    const Vec<3> middle = 0.5 * (p + q);
    open.push_back({ p, middle });
    open.push_back({ middle, q });
  }
  return true;
}
}
