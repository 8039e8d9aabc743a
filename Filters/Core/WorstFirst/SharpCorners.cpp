// SPDX-License-Identifier: BSD-3-Clause
// Both edges of a corner in one go, then the new nodes.
#include "WorstFirst/SharpCorners.h"

#include "Operations/SurfaceMotion.h"
#include "WorstFirst/EdgeDivider.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace meshopt
{
namespace
{
/// The new nodes of a corner are moved in turn, at most this often: each one makes room for the
/// others.
constexpr int MostSweeps = 10;
/// Angles up to 30 degrees: half of the best one.
constexpr double SharpCosine = 0.866;
constexpr int CornersPerLook = 16; ///< between two looks at the clock

class SharpCorners
{
public:
  SharpCorners(Run<3>& run, EdgeDivider& divider)
    : run_(run)
    , divider_(divider)
  {
  }
  long divide();

private:
  using Shape = EdgeDivider::Shape;
  struct Sharp
  {
    double cosine;
    Index corner;
    std::array<Index, 3> ends; ///< of the two edges, and the fourth node
  };

  const SimplexMesh<3>& mesh() const { return this->run_.mesh(); }
  std::optional<Sharp> sharpestOf(const Simplex<3>& nodes);
  Index cellAt(Index a, Index b);
  Index worstAt(Index p);
  void divideAt(const Sharp& sharp);
  void moveNew();

  Run<3>& run_;
  EdgeDivider& divider_;
  std::vector<Index> new_; ///< points
  SurfaceMotion<3, Shape> surfaceMotion_;
  NodeMotion<3, Shape> nodeMotion_;
  std::vector<Index> star_;
};

/// The sharpest angle between two edges on curves that leave a corner of the cell with these nodes,
/// if it is sharp. Nothing either if the cell has gone.
std::optional<SharpCorners::Sharp> SharpCorners::sharpestOf(const Simplex<3>& nodes)
{
  const SimplexMesh<3>& mesh = this->mesh();
  std::optional<Sharp> sharpest;
  for (Index corner : nodes)
  {
    if (mesh.freedom(corner) != Freedom::Corner)
    {
      continue;
    }
    mesh.star(corner, this->star_);
    const auto cell = std::find_if(
      this->star_.begin(), this->star_.end(), [&](Index c) { return mesh.nodes(c) == nodes; });
    std::vector<Index> ends;
    for (int e = 0; e < 6 && cell != this->star_.end(); ++e)
    {
      const Index a = nodes[Local<3>::edges[e][0]], b = nodes[Local<3>::edges[e][1]];
      if ((a == corner || b == corner) && mesh.isEdgeKeptByItself(*cell, e))
      {
        ends.push_back(a == corner ? b : a);
      }
    }
    for (std::size_t k = 1; k < ends.size(); ++k)
    {
      for (std::size_t j = 0; j < k; ++j)
      {
        const Vec<3> u = mesh.point(ends[j]) - mesh.point(corner);
        const Vec<3> v = mesh.point(ends[k]) - mesh.point(corner);
        const double cosine = u.dot(v) / (u.norm() * v.norm());
        if (cosine > (sharpest ? sharpest->cosine : SharpCosine))
        {
          // Node numbers of a cell are all different: what is left of their sum is the fourth.
          const Index fourth = nodes[0] + nodes[1] + nodes[2] + nodes[3] - corner - ends[j] -
            ends[k];
          sharpest = Sharp{ cosine, corner, { ends[j], ends[k], fourth } };
        }
      }
    }
  }
  return sharpest;
}

/// A cell with the edge from a to b. Divisions nearby may have replaced the one it was found in.
Index SharpCorners::cellAt(Index a, Index b)
{
  this->mesh().star(a, this->star_);
  const auto found = std::find_if(this->star_.begin(), this->star_.end(),
    [&](Index c) { return hasId(this->mesh().nodes(c), b); });
  return found == this->star_.end() ? None : *found;
}

Index SharpCorners::worstAt(Index p)
{
  this->mesh().star(p, this->star_);
  return *std::min_element(this->star_.begin(), this->star_.end(),
    [&](Index c, Index o) { return this->mesh().quality(c) < this->mesh().quality(o); });
}

void SharpCorners::divideAt(const Sharp& sharp)
{
  this->new_.clear();
  for (Index end : sharp.ends)
  {
    const Index c = this->cellAt(sharp.corner, end);
    const Index p = c == None
      ? None
      : this->divider_.divide(c, sharp.corner, end, EdgeDivider::Where::Edge);
    if (p != None)
    {
      this->new_.push_back(p);
    }
  }
}

/// Each to where the worst cell at it is better: off its curve, too.
void SharpCorners::moveNew()
{
  Judge<3, Shape>& judge = this->divider_.judge();
  bool moved = this->run_.options.moveNodes;
  for (int sweep = 0; sweep < MostSweeps && moved; ++sweep)
  {
    moved = false;
    for (Index p : this->new_)
    {
      judge.start();
      moved |= this->surfaceMotion_.improve(judge, this->worstAt(p), Level::LookAhead);
      judge.start();
      moved |= this->nodeMotion_.improve(judge, this->worstAt(p), Level::LookAhead);
    }
  }
}

long SharpCorners::divide()
{
  std::vector<std::pair<double, Simplex<3>>> bad; // with their nodes: a cell may be gone by then
  for (Index c : this->divider_.bad())
  {
    bad.emplace_back(this->mesh().quality(c), this->mesh().nodes(c));
  }
  std::sort(bad.begin(), bad.end());
  long done = 0, corners = 0;
  const Judge<3, Shape>& judge = this->divider_.judge();
  for (std::size_t k = 0; k < bad.size() && !judge.growth.isShort; ++k)
  {
    if (const auto sharp = this->sharpestOf(bad[k].second))
    {
      this->divideAt(*sharp);
      this->moveNew();
      done += static_cast<long>(this->new_.size());
      if (++corners % CornersPerLook == 0 &&
        !this->run_.clock.goesOn(0.0, [] { return std::string("dividing edges at corners"); }))
      {
        break;
      }
    }
  }
  return done;
}
}

long divideAtCorners(Run<3>& run, double below)
{
  EdgeDivider divider(run, below);
  const long done = SharpCorners(run, divider).divide();
  divider.record("edges at corners divided", done > 0);
  return done;
}
}
