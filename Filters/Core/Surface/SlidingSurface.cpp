// SPDX-License-Identifier: BSD-3-Clause
// What the engine asks of a surface that takes part: where nodes may go, and which changes are
// allowed. How the surface is made stands in SlidingSurfaceBuild.cpp, which nodes may vanish into
// which in SlidingSurfaceJoin.cpp.
#include "Surface/SlidingSurface.h"

#include "Base/SortUnique.h"
#include "Mesh/Ids.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace meshopt
{
namespace
{
/// A node that has been put at the end of its room is there up to rounding.
constexpr double Rounding = 1e-9;
}

/// Points that slide ask their patch or curve: new points have no entry of their own.
std::uint32_t SlidingSurface::sets(const SimplexMesh<3>& mesh, Index v) const
{
  if (this->setsOfPoint_.empty())
  {
    return 0;
  }
  const Place place = mesh.place(v);
  if (place.freedom == Freedom::Patch)
  {
    return this->sets_ & this->patches_[place.part].sets;
  }
  if (place.freedom == Freedom::Curve)
  {
    return this->sets_ & this->setsOfCurve_[place.part];
  }
  return static_cast<std::size_t>(v) < this->setsOfPoint_.size()
    ? this->sets_ & this->setsOfPoint_[v]
    : 0;
}

const Facet<3>& SlidingSurface::inputFacet(Index patch, const Vec<3>& x) const
{
  Vec<3> there;
  return this->inputFacets_[this->reference_.project(patch, x, there)];
}

std::optional<std::array<Index, 2>> SlidingSurface::inputEdge(
  const SimplexMesh<3>& mesh, Index a, Index b) const
{
  const std::optional<Span> span = this->span(mesh, a, b);
  if (!span)
  {
    return std::nullopt;
  }
  const std::vector<Index>& points = this->inputPoints_[span->part];
  const std::size_t k = this->curves_[span->part].line(0.5 * (span->from + span->to));
  // The last line of a closed curve leads back to the first point.
  return sortedIds(points[k], points[(k + 1) % points.size()]);
}

/// On a curve from the present parameter on; in the plane of an exact patch; otherwise to the
/// nearest point of the patch as it was.
Place SlidingSurface::project(const Place& place, const Vec<3>& x, Vec<3>& there) const
{
  Place result = place;
  if (place.freedom == Freedom::Curve)
  {
    const SpaceCurve& curve = this->curves_[place.part];
    result.parameter = curve.closest(x, place.parameter);
    there = curve.at(result.parameter);
  }
  else if (this->isExact_)
  {
    const Patch& patch = this->patches_[place.part];
    const Vec<3> d = x - patch.plane.origin;
    // In this form, points of a plane along axes have exactly the same coordinate.
    there = patch.plane.origin + patch.basis[0] * patch.basis[0].dot(d) +
      patch.basis[1] * patch.basis[1].dot(d);
  }
  else
  {
    this->reference_.project(place.part, x, there);
  }
  return result;
}

/// On the straight way from the surface to x, as far as there is room.
Place SlidingSurface::placeNear(const Place& place, const Vec<3>& x, Vec<3>& there) const
{
  // No distance is allowed off the surface: its planes and lines are all there is.
  if (this->isExact_)
  {
    return this->project(place, x, there);
  }
  Place result = place;
  Vec<3> foot;
  // On curves and corners: only what curves may use. On a patch the nearest facet says how much.
  double room = this->curveRoom();
  if (place.freedom == Freedom::Patch)
  {
    room = this->reference_.tolerance(this->reference_.project(place.part, x, foot));
  }
  else if (place.freedom == Freedom::Curve)
  {
    room = this->rooms_[place.part];
    result = this->project(place, x, foot);
  }
  else
  {
    foot = this->corners_[place.part];
  }
  // Towards other sheets there may be less room than the tolerance.
  there = this->reference_.withinRoom(foot, x, room);
  if (place.freedom == Freedom::Patch)
  {
    // distance() reads from it how far the node is off its patch.
    result.parameter = std::min((there - foot).norm(), room);
  }
  return result;
}

/// Where the node may go: along its curve, in its plane, or in the mean plane of its facets.
int SlidingSurface::tangents(const SimplexMesh<3>& mesh, const std::vector<Index>& star, Index v,
  std::array<Vec<3>, 3>& basis) const
{
  const Place place = mesh.place(v);
  if (place.freedom == Freedom::Corner)
  {
    return 0;
  }
  if (place.freedom == Freedom::Curve)
  {
    basis[0] = this->curves_[place.part].direction(place.parameter);
    return 1;
  }
  if (this->isExact_)
  {
    basis[0] = this->patches_[place.part].basis[0];
    basis[1] = this->patches_[place.part].basis[1];
    return 2;
  }
  // Where facets bend, the first direction is the one along which they bend least, such as that of
  // a ridge.
  const Patch& patch = this->patches_[place.part];
  Vec<3> normal = Vec<3>::Zero();
  Tensor<3> bends = Tensor<3>::Zero();
  for (Index c : star)
  {
    for (int i = 0; i < 4; ++i)
    {
      const Facet<3> f = mesh.facet(c, i);
      if (mesh.isKept(c, i) && hasId(f, v))
      {
        const Vec<3>& a = mesh.point(f[0]);
        const Vec<3> n = (mesh.point(f[1]) - a).cross(mesh.point(f[2]) - a);
        // Both sides of a facet must add the same vector. Inside of a region no side is the outer
        // one: the facets before say which one it is.
        const bool isTurned = patch.isSigned ? mesh.region(c) != patch.region : n.dot(normal) < 0.0;
        normal += isTurned ? Vec<3>(-n) : n; // weighted by area, and so are the bends
        bends += n * n.transpose() / std::max(n.norm(), std::numeric_limits<double>::min());
      }
    }
  }
  if (!(normal.norm() > 0.0))
  {
    return 0;
  }
  normal.normalize();
  // The axis farthest from the normal: with it the product is well away from zero.
  int axis = 0;
  normal.cwiseAbs().minCoeff(&axis);
  const Vec<3> u = normal.cross(Vec<3>(Vec<3>::Unit(axis))).normalized(), w = normal.cross(u);
  const double uu = u.dot(bends * u), uw = u.dot(bends * w), ww = w.dot(bends * w);
  const double angle = 0.5 * std::atan2(2.0 * uw, uu - ww); // of the direction of most bending
  basis[0] = std::cos(angle) * w - std::sin(angle) * u;
  basis[1] = normal.cross(basis[0]);
  return 2;
}

std::optional<Span> SlidingSurface::span(const SimplexMesh<3>& mesh, Index a, Index b) const
{
  const Place pa = mesh.place(a), pb = mesh.place(b);
  if (pa.freedom == Freedom::Patch || pb.freedom == Freedom::Patch)
  {
    return std::nullopt;
  }
  std::optional<Span> span = this->pieces_.span(a, pa, b, pb);
  if (span)
  {
    span = this->measured(*span, mesh.point(a), mesh.point(b));
    // A tip that vanishes leaves no curve that says how far the corner may be from it: the corner
    // stays near to both from the first on.
    for (Index p : { a, b })
    {
      const Index tip = mesh.freedom(p) == Freedom::Corner ? this->pieces_.tipAt(p) : None;
      span->leavesRoom = span->leavesRoom &&
        (tip == None || (mesh.point(p) - this->corners_[tip]).norm() <= this->curveRoom());
    }
  }
  return span;
}

/// The same span, for an edge from a to b.
Span SlidingSurface::measured(Span span, const Vec<3>& a, const Vec<3>& b) const
{
  const SpaceCurve& curve = this->curves_[span.part];
  span.off = curve.deviation(span.from, span.to, a, b);
  span.leavesRoom = curve.leavesRoom(span.from, span.to, a, b);
  return span;
}

/// The neighbours over kept edges. Inside of a curve there are two.
std::optional<SlidingRange> SlidingSurface::range(
  const SimplexMesh<3>& mesh, const std::vector<Index>& star, Index v) const
{
  if (mesh.freedom(v) != Freedom::Curve)
  {
    return std::nullopt;
  }
  std::vector<Index> ends;
  for (Index c : star)
  {
    for (int e = 0; e < 6; ++e)
    {
      const Index a = mesh.nodes(c)[Local<3>::edges[e][0]];
      const Index b = mesh.nodes(c)[Local<3>::edges[e][1]];
      if ((a == v || b == v) && mesh.isEdgeKeptByItself(c, e))
      {
        ends.push_back(a == v ? b : a);
      }
    }
  }
  sortUnique(ends); // the order of the star must not matter
  if (ends.size() != 2)
  {
    return std::nullopt;
  }
  // Both as seen from v: on a closed curve their ends are then on the same turn as v.
  const auto low = this->span(mesh, v, ends[0]), high = this->span(mesh, v, ends[1]);
  return low && high ? std::optional<SlidingRange>({ { ends[0], ends[1] }, low->to, high->to })
                     : std::nullopt;
}

/// Whether the new edge between two points of a curve stays near it.
bool SlidingSurface::follows(const Span& span) const
{
  return this->pieces_.mayBeNeighbours(span) && span.leavesRoom &&
    span.off <= (1.0 + Rounding) * this->rooms_[span.part];
}

/// Inside a patch, or where the edge is on one known curve; never beside a facet that stays.
bool SlidingSurface::mayDivide(
  const SimplexMesh<3>& mesh, const std::vector<Index>& cells, Index a, Index b) const
{
  bool isKept = false;
  std::vector<std::array<Index, 4>> patches; // facet, patch
  for (Index c : cells)
  {
    for (int i = 0; i < 4; ++i)
    {
      const Facet<3> f = mesh.facet(c, i);
      if (mesh.isKept(c, i) && hasId(f, a) && hasId(f, b))
      {
        const Facet<3> key = sortedIds(f);
        patches.push_back({ key[0], key[1], key[2], mesh.patch(c, i) });
      }
    }
    const int e = mesh.localEdge(c, a, b);
    isKept |= e >= 0 && mesh.isEdgeKeptByItself(c, e);
  }
  // A facet between two regions comes from both sides, and from each cell that has it.
  sortUnique(patches);
  // What the caller locked belongs to no patch.
  const bool isLocked = std::any_of(
    patches.begin(), patches.end(), [](const auto& p) { return p[3] == None; });
  if (isLocked || patches.empty())
  {
    return false;
  }
  return isKept ? this->span(mesh, a, b).has_value()
                : patches.size() == 2 && patches[0][3] == patches[1][3];
}

bool SlidingSurface::maySwap(const SimplexMesh<3>&, Index patch, Index other) const
{
  return patch != None && patch == other;
}

/// A facet of the mesh is seen from its cell, one of the reference from outside of its region.
SurfacePiece<3> SlidingSurface::oriented(const SurfacePiece<3>& piece) const
{
  SurfacePiece<3> result = piece;
  if (piece.region == this->patches_[piece.patch].region)
  {
    std::swap(result.x[1], result.x[2]); // seen from outside, as the reference is
  }
  return result;
}

/// In its plane, and not folded.
double SlidingSurface::Patch::offPlane(const std::array<Vec<3>, 3>& facet) const
{
  double off = 0.0;
  for (const Vec<3>& x : facet)
  {
    off = std::max(off, std::fabs(this->plane.normal.dot(x - this->plane.origin)));
  }
  return off;
}

bool SlidingSurface::isFlat(const SurfacePiece<3>& piece) const
{
  const Patch& patch = this->patches_[piece.patch];
  const Vec<3> n = (piece.x[1] - piece.x[0]).cross(piece.x[2] - piece.x[0]);
  // Inside of a region a facet may be seen from either side: its sign says nothing.
  // What it replaces may be on the other side of the plane.
  return (n.dot(patch.plane.normal) > 0.0 || !patch.isSigned) &&
    patch.offPlane(piece.x) <= this->tolerance_ - patch.off;
}

bool SlidingSurface::isRefused(const SurfacePiece<3>& piece) const
{
  return std::any_of(this->refused_.begin(), this->refused_.end(),
    [&](const BoxTree::Box& box) { return box.intersects(BoxTree::around(piece.x)); });
}

/// Locks, sets and curves first, which is cheap; then distances, patch by patch.
bool SlidingSurface::allows(const SurfaceChange<3>& change) const
{
  const auto isLocked = [&](const SurfacePiece<3>& piece)
  { return piece.patch == None || this->isRefused(piece); };
  // A facet with all its nodes in a set must belong to a patch of that set.
  const auto growsASet = [&](const SurfacePiece<3>& piece)
  { return (piece.sets & ~this->patches_[piece.patch].sets) != 0; };
  if (std::any_of(change.gone.begin(), change.gone.end(), isLocked) ||
    std::any_of(change.come.begin(), change.come.end(), isLocked) ||
    std::any_of(change.come.begin(), change.come.end(), growsASet) ||
    !std::all_of(change.spans.begin(), change.spans.end(),
      [&](const Span& span) { return this->follows(span); }))
  {
    return false;
  }
  if (this->isExact_)
  {
    return std::all_of(change.come.begin(), change.come.end(),
      [&](const SurfacePiece<3>& piece) { return this->isFlat(this->oriented(piece)); });
  }
  // A change of a curve moves the border of the patches beside it by this much at most.
  const double sideways = change.spans.empty() ? 0.0 : this->curveRoom();
  std::vector<SurfacePiece<3>> gone, come;
  std::set<Index> patches;
  for (const auto* pieces : { &change.gone, &change.come })
  {
    for (const SurfacePiece<3>& piece : *pieces)
    {
      patches.insert(piece.patch);
    }
  }
  for (Index k : patches) // each by itself
  {
    gone.clear();
    come.clear();
    for (const SurfacePiece<3>& piece : change.gone)
    {
      if (piece.patch == k)
      {
        gone.push_back(this->oriented(piece));
      }
    }
    for (const SurfacePiece<3>& piece : change.come)
    {
      if (piece.patch == k)
      {
        come.push_back(this->oriented(piece));
      }
    }
    // A patch must lose facets where it gets some: otherwise it would spread over another patch,
    // or another one over it.
    if (gone.empty() || come.empty() ||
      (!this->reference_.covers(gone, come, sideways) && !this->allowsDivision(gone, come)))
    {
      return false;
    }
  }
  return true;
}

/// Parts are the same points, but one may look the wrong way where the whole did not.
bool SlidingSurface::allowsDivision(
  const std::vector<SurfacePiece<3>>& gone, const std::vector<SurfacePiece<3>>& come) const
{
  return ReferenceSurface::isDivision(gone, come) &&
    std::none_of(come.begin(), come.end(),
      [this](const SurfacePiece<3>& piece) { return this->reference_.isTurned(piece); });
}

bool SlidingSurface::allowsAngle(
  const SimplexMesh<3>& mesh, Index a, Index b, bool isKept, double cosine) const
{
  if (this->isExact_)
  {
    return true; // planes stay
  }
  const std::optional<Span> span = isKept ? this->span(mesh, a, b) : std::nullopt;
  if (isKept && (!span || this->isSharp_[span->part]))
  {
    return !span || cosine <= this->halfCosine_;
  }
  // A curve that was not sharp, such as the border between two numbers on a plane, must not become
  // so either.
  return cosine >= this->featureCosine_ ||
    this->bent_.isNear(mesh.point(a), mesh.point(b), this->curveRoom());
}

/// There a curve is, which says nothing of their angle: new ridges of the outer surface are no
/// better there than inside of a patch.
bool SlidingSurface::allowsAngleOutside(
  const SimplexMesh<3>& mesh, Index a, Index b, double cosine) const
{
  return this->isExact_ || cosine >= this->featureCosine_ ||
    this->bentOutside_.isNear(mesh.point(a), mesh.point(b), this->curveRoom());
}
}
