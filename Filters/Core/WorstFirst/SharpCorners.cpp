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
    std::array<Index, 3> ends; ///< of the two edges, and the fourth node of the cell
  };

  const SimplexMesh<3>& mesh() const { return this->run_.mesh(); }
  Index cellOf(const Simplex<3>& nodes);
  bool isOnCurve(Index c, Index a, Index b) const
  {
    return this->mesh().isEdgeKeptByItself(c, this->mesh().localEdge(c, a, b));
  }
  std::optional<Sharp> sharpestOf(Index c) const;
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

/// The cell with these nodes; None if it has gone.
Index SharpCorners::cellOf(const Simplex<3>& nodes)
{
  this->mesh().star(nodes[0], this->star_); // divisions remove no node
  const auto found = std::find_if(this->star_.begin(), this->star_.end(),
    [&](Index c) { return this->mesh().nodes(c) == nodes; });
  return found == this->star_.end() ? None : *found;
}

/// The sharpest angle between two edges of cell c on curves that leave a corner, if it is sharp.
std::optional<SharpCorners::Sharp> SharpCorners::sharpestOf(Index c) const
{
  const SimplexMesh<3>& mesh = this->mesh();
  const Simplex<3>& t = mesh.nodes(c);
  std::optional<Sharp> sharpest;
  for (int k = 0; k < 12; ++k) // the angles of the faces: each node without one of the others
  {
    const int i = k / 3, fourth = (i + 1 + k % 3) % 4;
    const auto [a, b] = std::minmax({ (i + 1 + (k + 1) % 3) % 4, (i + 1 + (k + 2) % 3) % 4 });
    const Vec<3> u = mesh.point(t[a]) - mesh.point(t[i]), v = mesh.point(t[b]) - mesh.point(t[i]);
    const double cosine = u.dot(v) / (u.norm() * v.norm());
    if (cosine > (sharpest ? sharpest->cosine : SharpCosine) &&
      mesh.freedom(t[i]) == Freedom::Corner && this->isOnCurve(c, t[i], t[a]) &&
      this->isOnCurve(c, t[i], t[b]))
    {
      sharpest = Sharp{ cosine, t[i], { t[a], t[b], t[fourth] } };
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
    const Index c = this->cellOf(bad[k].second);
    const std::optional<Sharp> sharp = c == None ? std::nullopt : this->sharpestOf(c);
    if (sharp)
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
