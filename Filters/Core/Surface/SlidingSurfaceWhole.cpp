// SPDX-License-Identifier: BSD-3-Clause
// What is asked of a whole surface: how far it is from that of before, which facets have turned,
// and whether it passes through itself.
#include "Surface/SlidingSurface.h"

#include "Surface/NewCrossings.h"

#include <algorithm>
#include <cmath>

namespace meshopt
{
double SlidingSurface::distance(const SimplexMesh<3>& mesh) const
{
  double most = 0.0, mostOfCurves = 0.0, mostOfAll = 0.0;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i < 4 && mesh.isAlive(c); ++i)
    {
      const Index patch = mesh.isKept(c, i) ? mesh.patch(c, i) : None;
      // A facet between regions counts once, from the side of its patch.
      if (patch == None || mesh.region(c) != this->patches_[patch].region)
      {
        continue;
      }
      const Facet<3> f = mesh.facet(c, i);
      const SurfacePiece<3> piece = this->oriented(
        { { mesh.point(f[0]), mesh.point(f[1]), mesh.point(f[2]) }, patch, mesh.region(c) });
      if (this->isExact_)
      {
        for (const Vec<3>& x : piece.x)
        {
          const SurfaceDivision::Plane& plane = this->patches_[patch].plane;
          most = std::max(most, std::fabs(plane.normal.dot(x - plane.origin)));
        }
      }
      else
      {
        const ReferenceSurface::Offset offset = this->reference_.offset(piece);
        most = std::max(most, offset.height);
        mostOfAll = std::max(mostOfAll, offset.distance);
        // A node off its patch says how far it is (placeNear()): in the wedges between prisms no
        // height does.
        for (Index p : f)
        {
          const Place& place = mesh.place(p);
          most = std::max(most, place.freedom == Freedom::Patch ? place.parameter : 0.0);
        }
      }
    }
    for (int e = 0; e < 6 && mesh.isAlive(c); ++e)
    {
      const Simplex<3>& t = mesh.nodes(c);
      const auto span = mesh.isEdgeKeptByItself(c, e)
        ? this->span(mesh, t[Local<3>::edges[e][0]], t[Local<3>::edges[e][1]])
        : std::nullopt;
      if (span)
      {
        mostOfCurves = std::max(mostOfCurves, span->off);
      }
    }
  }
  // Beside a curve, facets can be off by both.
  return std::max(std::hypot(most, mostOfCurves), mostOfAll);
}

long SlidingSurface::countTurned(const SimplexMesh<3>& mesh) const
{
  long turned = 0;
  for (Index c = 0; c < mesh.numberOfCellSlots() && *this->madeTurned_; ++c)
  {
    for (int i = 0; i < 4 && mesh.isAlive(c); ++i)
    {
      const Index patch = mesh.isKept(c, i) ? mesh.patch(c, i) : None;
      if (patch != None && mesh.region(c) == this->patches_[patch].region)
      {
        const Facet<3> f = mesh.facet(c, i);
        turned += this->reference_.isTurned(this->oriented(
          { { mesh.point(f[0]), mesh.point(f[1]), mesh.point(f[2]) }, patch, mesh.region(c) }));
      }
    }
  }
  return turned;
}

bool SlidingSurface::refuseCrossings(const SimplexMesh<3>& before, const SimplexMesh<3>& now)
{
  if (this->isExact_)
  {
    return false;
  }
  const auto refuse = [this](const std::vector<BoxTree::Box>& boxes)
  {
    this->refused_.insert(this->refused_.end(), boxes.begin(), boxes.end());
    return !boxes.empty();
  };
  const bool crosses = refuse(findNewCrossings(before, now));
  if (crosses)
  {
    // Parts that have always passed through each other would else be found one after the other.
    refuse(findNewCrossings({}, before));
  }
  return crosses;
}
}
