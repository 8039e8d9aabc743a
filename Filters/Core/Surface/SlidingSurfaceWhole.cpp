// SPDX-License-Identifier: BSD-3-Clause
// What is asked of a whole surface: how far it is from that of before, which facets have turned,
// and whether it passes through itself.
#include "Surface/SlidingSurface.h"

#include "Mesh/Ids.h"
#include "Surface/NewCrossings.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace meshopt
{
/// The patch of a kept facet; None if it has none. A facet between regions counts once, from the
/// side of its patch.
Index SlidingSurface::patchOf(const SimplexMesh<3>& mesh, Index c, int i) const
{
  const Index patch = mesh.isKept(c, i) ? mesh.patch(c, i) : None;
  return patch != None && mesh.region(c) == this->patches_[patch].region ? patch : None;
}

/// How far the patches are from what they were, if these are planes. A new facet and what was there
/// before may be on both sides of the plane. Facets that are as they were do not count.
double SlidingSurface::distanceOfPlanes(const SimplexMesh<3>& mesh) const
{
  std::vector<std::pair<Facet<3>, int>> input;
  for (const Facet<3>& f : this->inputFacets_)
  {
    input.emplace_back(f, static_cast<int>(input.size()));
  }
  std::sort(input.begin(), input.end());
  const auto isOld = [&](const Facet<3>& f)
  {
    const Facet<3> key = sortedIds(f);
    const auto known = std::lower_bound(input.begin(), input.end(), std::make_pair(key, 0));
    if (known == input.end() || known->first != key)
    {
      return false;
    }
    const std::array<Vec<3>, 3>& x = this->reference_.corners(known->second);
    return std::all_of(f.begin(), f.end(),
      [&](Index p) { return std::find(x.begin(), x.end(), mesh.point(p)) != x.end(); });
  };
  double most = 0.0;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i < 4 && mesh.isAlive(c); ++i)
    {
      const Index k = this->patchOf(mesh, c, i);
      const Facet<3> f = mesh.facet(c, i);
      if (k != None && !isOld(f))
      {
        const Patch& patch = this->patches_[k];
        most = std::max(most,
          patch.off + patch.offPlane({ mesh.point(f[0]), mesh.point(f[1]), mesh.point(f[2]) }));
      }
    }
  }
  return most;
}

double SlidingSurface::distance(const SimplexMesh<3>& mesh) const
{
  double most = this->isExact_ ? this->distanceOfPlanes(mesh) : 0.0;
  double mostOfCurves = 0.0, mostOfAll = 0.0;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i < 4 && mesh.isAlive(c) && !this->isExact_; ++i)
    {
      const Index patch = this->patchOf(mesh, c, i);
      if (patch == None)
      {
        continue;
      }
      const Facet<3> f = mesh.facet(c, i);
      const ReferenceSurface::Offset offset = this->reference_.offset(this->oriented(
        { { mesh.point(f[0]), mesh.point(f[1]), mesh.point(f[2]) }, patch, mesh.region(c) }));
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

bool SlidingSurface::refuseCrossings(const SimplexMesh<3>& before, const SimplexMesh<3>& now)
{
  return !this->isExact_ && refuseNewCrossings(before, now, this->refused_);
}
}
