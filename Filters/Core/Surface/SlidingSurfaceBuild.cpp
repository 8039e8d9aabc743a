// SPDX-License-Identifier: BSD-3-Clause
// How a sliding surface is made from the division of a mesh: patches, curves, node sets.
#include "Mesh/Ids.h"
#include "Surface/SlidingSurface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace meshopt
{
namespace
{
double areaOf(const SimplexMesh<3>& mesh, const SurfaceDivision::KeptFacet& facet)
{
  const Vec<3>& a = mesh.point(facet.nodes[0]);
  return 0.5 * (mesh.point(facet.nodes[1]) - a).cross(mesh.point(facet.nodes[2]) - a).norm();
}

/// The mean thickness of each region whose volume would change by a quarter if its surface moved by
/// a quarter of the tolerance, on average.
std::map<Index, double> thinRegions(const SimplexMesh<3>& mesh, const SurfaceDivision& division)
{
  constexpr double most = 0.25, farthest = 0.25; // of the volume; of the tolerance
  struct Size
  {
    double volume = 0.0, area = 0.0;
  };
  std::map<Index, Size> sizes;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    if (mesh.isAlive(c))
    {
      sizes[mesh.region(c)].volume += std::fabs(signedVolume(mesh.corners(c)));
    }
  }
  for (const SurfaceDivision::KeptFacet& facet : division.facets)
  {
    const double area = areaOf(mesh, facet);
    // A facet between two regions takes from one and gives to the other: it counts for both.
    for (Index region : { facet.region, facet.other })
    {
      if (region != None)
      {
        sizes[region].area += area;
      }
    }
  }
  std::map<Index, double> thin;
  for (const auto& [region, size] : sizes)
  {
    if (most * size.volume < farthest * division.tolerance * size.area)
    {
      thin[region] = 2.0 * size.volume / size.area;
    }
  }
  return thin;
}
}

void SlidingSurface::build(MeshEditor<3>& editor, const SurfaceOptions& options)
{
  // Nothing stays of a surface that was built before.
  *this = SlidingSurface();
  if (options.releaseAngle > options.featureAngle)
  {
    this->prepareRelease(editor, options);
  }
  else
  {
    this->divide(editor, options);
  }
}

void SlidingSurface::divide(MeshEditor<3>& editor, const SurfaceOptions& options)
{
  const SurfaceDivision division(editor.mesh(), options);
  this->numberOfTwins_ = division.numberOfTwins;
  this->isExact_ = division.isExact;
  this->tolerance_ = division.tolerance;
  this->freedom_ = division.freedom;
  this->featureCosine_ = SurfaceDivision::cosine(options.featureAngle);
  this->halfCosine_ = SurfaceDivision::cosine(0.5 * options.featureAngle);
  // Angles exist only where the surface stays the same set of points: see surfaceAngles().
  this->angles_ = surfaceAngles(editor.mesh(), division);
  // First the patches: curves ask the reference how much room they have.
  const std::map<Index, double> thin = thinRegions(editor.mesh(), division);
  this->addPatches(editor, division, thin);
  this->addCurves(editor, division);
  for (const auto& [a, b] : division.bentEdges)
  {
    this->bent_.add(editor.mesh().point(a), editor.mesh().point(b));
  }
  this->bent_.finish();
  for (const auto& [a, b] : division.bentOutside)
  {
    this->bentOutside_.add(editor.mesh().point(a), editor.mesh().point(b));
  }
  this->bentOutside_.finish();
  this->corners_.resize(division.freedom.size());
  for (std::size_t p = 0; p < division.freedom.size(); ++p)
  {
    const auto id = static_cast<Index>(p);
    // A point of a curve gets its place with its curve, in addCurves().
    if (division.freedom[p] == Freedom::Patch)
    {
      editor.setPlace(id, { Freedom::Patch, division.patchOfPoint[p], 0.0 });
    }
    else if (division.freedom[p] == Freedom::Corner)
    {
      // Its room is measured from where it was: see placeNear().
      this->corners_[p] = editor.mesh().point(id);
      editor.setPlace(id, { Freedom::Corner, id, 0.0 });
    }
  }
  this->addRooms(editor.mesh(), division, thin);
  if (!options.sets.empty())
  {
    this->addSets(editor, division, options.sets);
  }
}

/// Facets go into the reference as they are now. From here on it does not change.
void SlidingSurface::addPatches(
  MeshEditor<3>& editor, const SurfaceDivision& division, const std::map<Index, double>& thin)
{
  const SimplexMesh<3>& mesh = editor.mesh();
  this->patches_.resize(division.numberOfPatches);
  for (Index k = 0; k < division.numberOfPatches && this->isExact_; ++k)
  {
    Patch& patch = this->patches_[k];
    patch.plane = division.planes[k];
    const Vec<3>& n = patch.plane.normal;
    // A plane along axes gets a basis along axes: coordinates that are equal then stay so.
    int axis = 0;
    n.cwiseAbs().minCoeff(&axis);
    patch.basis[0] = n.cross(Vec<3>(Vec<3>::Unit(axis))).normalized();
    patch.basis[1] = n.cross(patch.basis[0]);
  }
  for (const SurfaceDivision::KeptFacet& facet : division.facets)
  {
    editor.setPatch(mesh.cellOf(facet.handle), mesh.facetOf(facet.handle), facet.patch);
    if (facet.patch == None)
    {
      continue;
    }
    Patch& patch = this->patches_[facet.patch];
    patch.region = facet.region;
    // With the same region on both sides, neither of them is the outer one.
    patch.isSigned = facet.region != facet.other;
    patch.label = facet.label;
    const auto behind = thin.find(facet.region), before = thin.find(facet.other);
    const double thickness = behind != thin.end() ? behind->second
      : before != thin.end()                      ? -before->second
                                                  : ReferenceSurface::Thick;
    const std::array<Vec<3>, 3> x{ mesh.point(facet.nodes[0]), mesh.point(facet.nodes[1]),
      mesh.point(facet.nodes[2]) };
    patch.off = this->isExact_ ? std::max(patch.off, patch.offPlane(x)) : 0.0;
    this->reference_.add(x, facet.patch, patch.isSigned, facet.other == None, thickness);
    // For inputFacet(): the reference knows facets by the order in which they were added.
    this->inputFacets_.push_back(sortedIds(facet.nodes));
  }
  this->reference_.finish(this->tolerance_, division.rounding);
}

namespace
{
/// Whether each surface between two regions, or of one, that has both points also has the edge
/// between them. Otherwise it would touch itself if they became one.
bool meetOnlyAlong(const SurfaceDivision& division, Index a, Index b)
{
  std::set<std::array<Index, 2>> atA, atB, along;
  for (const SurfaceDivision::KeptFacet& facet : division.facets)
  {
    const std::array<Index, 2> regions{ facet.region, facet.other };
    const bool hasA = hasId(facet.nodes, a), hasB = hasId(facet.nodes, b);
    if (hasA || hasB)
    {
      (hasA && hasB ? along : hasA ? atA : atB).insert(regions);
    }
  }
  return std::none_of(atA.begin(), atA.end(),
    [&](const auto& regions) { return atB.count(regions) > 0 && along.count(regions) == 0; });
}
}

/// A curve for each chain that may change, and the places of its nodes. After that all edges on
/// curves are kept, also of chains that stay.
void SlidingSurface::addCurves(MeshEditor<3>& editor, const SurfaceDivision& division)
{
  const SimplexMesh<3>& mesh = editor.mesh();
  for (const SurfaceDivision::Chain& chain : division.chains)
  {
    if (chain.isFixed)
    {
      continue; // its edge is kept like the others, but belongs to no curve that may change
    }
    std::vector<Vec<3>> points;
    for (Index p : chain.points)
    {
      points.push_back(mesh.point(p));
    }
    std::vector<std::vector<RoomLimit>> limits;
    // An exact surface moves within itself: there is no room to measure.
    for (std::size_t k = 0; k < points.size() && !this->isExact_; ++k)
    {
      // An edge that is farther from the curve is refused for that: see follows().
      const double most = 1.01 * this->curveRoom();
      limits.push_back(this->reference_.fewLimits(points[k], most));
    }
    SpaceCurve curve(std::move(points), chain.isClosed);
    curve.setLimits(std::move(limits));
    const auto number = static_cast<Index>(this->curves_.size());
    CurvePiece piece;
    piece.curve = number;
    if (chain.isClosed)
    {
      piece.period = curve.length();
    }
    // A closed curve without corners has no ends: only the period relates its parameters.
    else
    {
      piece.ends = { chain.points.front(), chain.points.back() };
      piece.range = { 0.0, curve.length() };
      piece.isEdge = chain.points.size() == 2;
      // Its ends may become one if both are corners that the surface itself gives, and all of it is
      // then near to that one. Not yet if some will not be corners any more.
      const auto isCorner = [&](Index p) { return division.freedom[p] == Freedom::Corner; };
      piece.mayVanish = !this->release_ && piece.isEdge && !chain.isLine &&
        isCorner(piece.ends[0]) && isCorner(piece.ends[1]) && curve.length() <= this->curveRoom() &&
        meetOnlyAlong(division, piece.ends[0], piece.ends[1]);
    }
    for (std::size_t k = 0; k < chain.points.size(); ++k)
    {
      // Corners belong to several curves, and have their parameter from the piece's ends.
      if (division.freedom[chain.points[k]] == Freedom::Curve)
      {
        editor.setPlace(chain.points[k], { Freedom::Curve, number, curve.parameter(k) });
      }
    }
    this->pieces_.add(piece);
    this->curves_.push_back(curve);
    this->isSharp_.push_back(chain.isSharp);
    this->inputPoints_.push_back(chain.points);
  }
  this->pieces_.join();
  const auto isOnCurve = [&](Index a, Index b)
  {
    return std::binary_search(
      division.curveEdges.begin(), division.curveEdges.end(), sortedIds(a, b));
  };
  for (const SurfaceDivision::KeptFacet& facet : division.facets)
  {
    // From each facet and from both its sides: not all cells at an edge need be reachable from one.
    const Index handles[2] = { facet.handle,
      mesh.adjacent(mesh.cellOf(facet.handle), mesh.facetOf(facet.handle)) };
    for (Index h : handles)
    {
      for (int i = 0; i < 3 && h != None; ++i)
      {
        const Index a = facet.nodes[i], b = facet.nodes[(i + 1) % 3];
        if (isOnCurve(a, b))
        {
          editor.keepEdge(mesh.cellOf(h), a, b);
        }
      }
    }
  }
}

/// As far as CurveShare says; but beside a thin region that is narrow, too, only so far that its
/// volume changes by a tenth if all its curves move sideways.
void SlidingSurface::addRooms(
  const SimplexMesh<3>& mesh, const SurfaceDivision& division, const std::map<Index, double>& thin)
{
  constexpr double most = 0.1; // of the volume
  struct Size
  {
    double area = 0.0, curves = 0.0;
  };
  std::map<Index, Size> sizes;
  this->rooms_.assign(this->curves_.size(), this->curveRoom());
  // Twice: the sizes of regions first, then what these leave to their curves.
  for (const bool isSummed : { false, true })
  {
    for (const SurfaceDivision::KeptFacet& facet : division.facets)
    {
      for (Index region : { facet.region, facet.other })
      {
        if (thin.count(region) == 0)
        {
          continue;
        }
        Size& size = sizes[region];
        size.area += isSummed ? 0.0 : areaOf(mesh, facet);
        for (int i = 0; i < 3; ++i)
        {
          const Index a = facet.nodes[i], b = facet.nodes[(i + 1) % 3];
          const auto span = this->span(mesh, a, b);
          if (!span)
          {
            continue;
          }
          // Half: each of its curves has two facets of a region.
          size.curves += isSummed ? 0.0 : 0.5 * (mesh.point(b) - mesh.point(a)).norm();
          double& room = this->rooms_[span->part];
          room = isSummed ? std::min(room, most * size.area / size.curves) : room;
        }
      }
    }
  }
}

/// A patch is in a set if all its nodes are.
void SlidingSurface::addSets(const MeshEditor<3>& editor, const SurfaceDivision& division,
  const std::vector<std::uint32_t>& sets)
{
  const SimplexMesh<3>& mesh = editor.mesh();
  constexpr std::uint32_t all = ~std::uint32_t(0);
  for (Patch& patch : this->patches_)
  {
    // Intersected below, facet by facet, starting with all.
    patch.sets = all;
  }
  for (const SurfaceDivision::KeptFacet& facet : division.facets)
  {
    for (int i = 0; i < 3 && facet.patch != None; ++i)
    {
      this->patches_[facet.patch].sets &= sets[facet.nodes[i]];
    }
  }
  // A curve is in the sets of the patches beside it.
  this->setsOfCurve_.assign(this->curves_.size(), 0);
  for (const SurfaceDivision::KeptFacet& facet : division.facets)
  {
    for (int i = 0; i < 3 && facet.patch != None; ++i)
    {
      // Edges inside of a patch have none.
      const auto span = this->span(mesh, facet.nodes[i], facet.nodes[(i + 1) % 3]);
      if (span)
      {
        this->setsOfCurve_[span->part] |= this->patches_[facet.patch].sets;
      }
    }
  }
  // A set with a node that slides where the set does not go says nothing about the surface.
  this->sets_ = all;
  for (std::size_t p = 0; p < sets.size(); ++p)
  {
    const Place place = mesh.place(static_cast<Index>(p));
    if (place.freedom == Freedom::Curve)
    {
      this->sets_ &= ~(sets[p] & ~this->setsOfCurve_[place.part]);
    }
    else if (place.freedom == Freedom::Patch)
    {
      this->sets_ &= ~(sets[p] & ~this->patches_[place.part].sets);
    }
  }
  this->setsOfPoint_ = sets;
}
}
