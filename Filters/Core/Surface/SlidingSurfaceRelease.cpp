// SPDX-License-Identifier: BSD-3-Clause
// How a sliding surface gives up ridges that it has kept at first.
#include "Mesh/Ids.h"
#include "Surface/SlidingSurface.h"

#include <algorithm>
#include <map>

namespace meshopt
{
/// With fewer curves patches only merge, and with fewer corners curves, so each part lies in one
/// part of `next`.
struct SlidingSurface::Release
{
  struct Line
  {
    Index curve = None; ///< of `next`; None: given up
    double parameter = 0.0;
    bool isForward = true;
  };

  SlidingSurface next;
  std::vector<Place> places;            ///< of each point of the input, on `next`
  std::vector<Index> patches;           ///< of `next`, by patch
  std::vector<std::vector<Line>> lines; ///< by curve, line by line
  std::vector<Index> beside;            ///< by curve: a patch of `next` that it borders on
};

/// First what is left at last, then this surface over it. All its curves are curves here, too, and
/// so are its corners, which `ends` says: no curve of this surface is then kept in part.
void SlidingSurface::prepareRelease(MeshEditor<3>& editor, const SurfaceOptions& options)
{
  const SimplexMesh<3>& mesh = editor.mesh();
  auto later = std::make_shared<Release>();
  SurfaceOptions fewer = options;
  fewer.featureAngle = options.releaseAngle;
  later->next.divide(editor, fewer);
  if (later->next.isExact_)
  {
    // Its curves do not depend on angles, and nothing can be given up.
    *this = std::move(later->next);
    return;
  }
  // Its patches and places stand in the mesh, where this surface will write its own over them.
  std::map<Facet<3>, Index> patchOf; // of the next surface
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i < 4 && mesh.isAlive(c); ++i)
    {
      if (mesh.isKept(c, i))
      {
        patchOf[sortedIds(mesh.facet(c, i))] = mesh.patch(c, i);
      }
    }
  }
  SurfaceOptions more = options;
  more.ends.assign(mesh.numberOfPointSlots(), 0);
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    later->places.push_back(mesh.place(p));
    more.ends[p] = later->next.freedom_[p] == Freedom::Corner;
  }
  this->release_ = later;
  this->divide(editor, more);

  // Curves of both surfaces consist of the same edges of the input, but may run in other directions
  // and begin elsewhere: each line is looked up by its points.
  std::map<std::array<Index, 2>, std::pair<Index, std::size_t>> linesOfNext;
  const auto forLines = [](const SlidingSurface& surface, auto&& f)
  {
    for (std::size_t k = 0; k < surface.curves_.size(); ++k)
    {
      const std::vector<Index>& points = surface.inputPoints_[k];
      const std::size_t n = points.size() - (surface.curves_[k].isClosed() ? 0 : 1);
      for (std::size_t i = 0; i < n; ++i)
      {
        f(static_cast<Index>(k), i, points[i], points[(i + 1) % points.size()]);
      }
    }
  };
  forLines(later->next,
    [&](Index curve, std::size_t i, Index a, Index b) {
      linesOfNext[sortedIds(a, b)] = { curve, i };
    });
  later->lines.resize(this->curves_.size());
  forLines(*this,
    [&](Index curve, std::size_t, Index a, Index b)
    {
      Release::Line line;
      const auto found = linesOfNext.find(sortedIds(a, b));
      if (found != linesOfNext.end())
      {
        const auto [k, i] = found->second;
        line.curve = k;
        line.isForward = later->next.inputPoints_[k][i] == a;
        line.parameter = later->next.curves_[k].parameter(i + (line.isForward ? 0 : 1));
      }
      later->lines[curve].push_back(line);
    });
  later->patches.assign(this->patches_.size(), None);
  later->beside.assign(this->curves_.size(), None);
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i < 4 && mesh.isAlive(c); ++i)
    {
      const Index patch = mesh.isKept(c, i) ? mesh.patch(c, i) : None;
      if (patch == None)
      {
        continue;
      }
      const Facet<3> f = mesh.facet(c, i);
      later->patches[patch] = patchOf[sortedIds(f)];
      for (int k = 0; k < 3; ++k)
      {
        const auto span = this->span(mesh, f[k], f[(k + 1) % 3]);
        if (span)
        {
          later->beside[span->part] = later->patches[patch];
        }
      }
    }
  }
}

/// A corner of this surface, or a place on one of its parts, on the next surface.
Place SlidingSurface::released(const Place& place) const
{
  const Release& later = *this->release_;
  if (place.freedom == Freedom::Patch)
  {
    return { Freedom::Patch, later.patches[place.part], 0.0 };
  }
  if (place.freedom != Freedom::Curve)
  {
    return place.freedom == Freedom::Corner ? later.places[place.part] : place;
  }
  const SpaceCurve& curve = this->curves_[place.part];
  const std::size_t k = curve.line(place.parameter);
  const Release::Line& line = later.lines[place.part][k];
  if (line.curve == None)
  {
    return { Freedom::Patch, later.beside[place.part], 0.0 };
  }
  const double along = (curve.at(place.parameter) - curve.at(curve.parameter(k))).norm();
  return { Freedom::Curve, line.curve, line.parameter + (line.isForward ? along : -along) };
}

bool SlidingSurface::release(MeshEditor<3>& editor)
{
  if (!this->release_)
  {
    return false;
  }
  const std::shared_ptr<Release> later = this->release_; // it must outlive this surface
  SlidingSurface& next = later->next;
  const SimplexMesh<3>& mesh = editor.mesh();
  const SimplexMesh<3> before = mesh; // to go back to
  std::vector<Index> cells;
  // Edges first: which curve they are on, the places of their points say, which change below.
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    if (!mesh.isAlive(c))
    {
      continue;
    }
    cells.push_back(c);
    for (int e = 0; e < 6; ++e)
    {
      const Simplex<3>& t = mesh.nodes(c);
      const auto span = mesh.isEdgeKeptByItself(c, e)
        ? this->span(mesh, t[Local<3>::edges[e][0]], t[Local<3>::edges[e][1]])
        : std::nullopt;
      if (span && later->lines[span->part][0].curve == None)
      {
        editor.giveUpEdge(c, e);
      }
    }
  }
  for (Index c : cells)
  {
    for (int i = 0; i < 4; ++i)
    {
      // Facets of two cells are met twice, but before their patch changes only once.
      const Index patch = mesh.isKept(c, i) ? before.patch(c, i) : None;
      if (patch != None)
      {
        editor.setPatch(c, i, later->patches[patch]);
      }
    }
  }
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    if (mesh.isPointAlive(p) && !mesh.isFree(p))
    {
      Place place = this->released(mesh.place(p));
      if (place.freedom == Freedom::Patch)
      {
        // What was on a ridge or a corner may be as far off as these allowed: see placeNear().
        Vec<3> there;
        next.reference_.project(place.part, mesh.point(p), there);
        place.parameter = (mesh.point(p) - there).norm();
      }
      editor.setPlace(p, place);
    }
  }
  editor.stamp(cells); // what failed before may succeed now
  // Where edges have become so long that it is not clear any more which way round a closed curve
  // they lead, nothing can be said of distances.
  constexpr double rounding = 1.0 + 1e-9;
  if (!(next.distance(mesh) <= rounding * next.tolerance_))
  {
    editor.mesh() = before;
    this->release_ = nullptr;
    return false;
  }
  *this = std::move(next);
  return true;
}
}
