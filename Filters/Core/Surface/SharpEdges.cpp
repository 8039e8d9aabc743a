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
  std::vector<int> ids;
  std::vector<Box> boxes;
  for (const auto& [a, b] : this->edges_)
  {
    Box box{ Eigen::Vector3d(a) };
    box.extend(Eigen::Vector3d(b));
    ids.push_back(static_cast<int>(ids.size()));
    boxes.push_back(box);
  }
  this->tree_.init(ids.begin(), ids.end(), boxes.begin(), boxes.end());
}

bool SharpEdges::isNear(const Vec<3>& a, const Vec<3>& b, double distance) const
{
  struct Search
  {
    Box box;
    std::vector<int> found;

    bool intersectVolume(const Box& other) const { return other.intersects(this->box); }
    bool intersectObject(int k)
    {
      this->found.push_back(k);
      return false; // go on
    }
  };
  if (this->edges_.empty())
  {
    // Then no edge was sharp, and none may become so.
    return false;
  }
  // An edge that is near to some part of the line has a box that meets this one.
  Search search;
  search.box.extend(Eigen::Vector3d(a));
  search.box.extend(Eigen::Vector3d(b));
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(distance);
  search.box = Box(search.box.min() - margin, search.box.max() + margin);
  Eigen::BVIntersect(this->tree_, search);

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
    if (std::any_of(search.found.begin(), search.found.end(), isNearTo))
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
