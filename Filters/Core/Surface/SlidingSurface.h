// SPDX-License-Identifier: BSD-3-Clause
/// @file SlidingSurface.h
/// The surface of a tetrahedral mesh that takes part: patches, and curves between corners, on which
/// nodes slide, come and go, within a distance from where the surface was.
#ifndef meshopt_Surface_SlidingSurface_h
#define meshopt_Surface_SlidingSurface_h

#include "Mesh/MeshEditor.h"
#include "Surface/CurvePieces.h"
#include "Surface/ReferenceSurface.h"
#include "Surface/SharpEdges.h"
#include "Surface/SpaceCurve.h"
#include "Surface/Surface.h"
#include "Surface/SurfaceAngles.h"
#include "Surface/SurfaceDivision.h"

#include <map>
#include <memory>

namespace meshopt
{
/// Nodes of a patch get the place Freedom::Patch and the number of the patch; those of a curve,
/// except its corners, Freedom::Curve, its number and their parameter. Patches and curves are those
/// of SurfaceDivision. Edges on curves become kept edges of the mesh.
///
/// Nodes lie on the old surface, except where placeNear() has put them. Facets and edges between
/// them are accepted if the surface of before and that of after stay within the tolerance of each
/// other (ReferenceSurface, SpaceCurve::deviation()); if exact, if they lie in the plane of their
/// patch and do not fold.
class SlidingSurface final : public Surface<3>
{
public:
  void build(MeshEditor<3>& editor, const SurfaceOptions& options);

  Index numberOfPatches() const { return static_cast<Index>(this->patches_.size()); }
  /// Only tests ask, since it tells how the surface was divided.
  std::size_t numberOfCurves() const { return this->pieces_.size(); }
  /// Facets that stay as they are because they lie on one another, as the lips of a closed crack
  /// do, or because SurfaceOptions::locked lists them.
  Index numberOfTwins() const { return this->numberOfTwins_; }
  bool isExact() const { return this->isExact_; }
  double tolerance() const { return this->tolerance_; }
  /// Freedom of each point of the input; Free if it is not on the surface.
  const std::vector<Freedom>& freedom() const { return this->freedom_; }

  /// The angles that every mesh of this body has to fill; nothing unless exact.
  SurfaceAngles angles() const override { return this->angles_; }

  /// The number that the facets of a patch had in SurfaceOptions::labels.
  Index label(Index patch) const { return this->patches_[patch].label; }
  /// The node sets of SurfaceOptions that are sets of patches: whoever is in one of them, and
  /// slides, is on a patch or beside a patch all of whose nodes are in it. Such a set keeps its
  /// part of the surface: no facet of another patch gets three nodes of it. The other sets mean
  /// nothing to the surface.
  std::uint32_t sets() const { return this->sets_; }
  /// Those that the patch is in as a whole.
  std::uint32_t setsOfPatch(Index patch) const { return this->patches_[patch].sets; }
  /// The facet of the input (sorted ids) that is nearest to x, of those of the patch.
  const Facet<3>& inputFacet(Index patch, const Vec<3>& x) const;
  /// The edge of the input (sorted ids) on which the middle of the kept edge from a to b lies, by
  /// its parameter. Empty if the edge is on no curve that may change.
  std::optional<std::array<Index, 2>> inputEdge(const SimplexMesh<3>& mesh, Index a, Index b) const;

  /// The distance that is proved between the surface of before and that of `mesh` (both ways).
  double distance(const SimplexMesh<3>& mesh) const;
  /// With tolerance 0 it never does. If it does, changes are refused also where the surface of
  /// `before` passes through itself.
  bool refuseCrossings(const SimplexMesh<3>& before, const SimplexMesh<3>& now) override;

  Vec<3> at(Index curve, double parameter) const override
  {
    return this->curves_[curve].at(parameter);
  }
  Place project(const Place& place, const Vec<3>& x, Vec<3>& there) const override;
  Place placeNear(const Place& place, const Vec<3>& x, Vec<3>& there) const override;
  int tangents(const SimplexMesh<3>& mesh, const std::vector<Index>& star, Index v,
    std::array<Vec<3>, 3>& basis) const override;
  std::optional<Span> span(const SimplexMesh<3>& mesh, Index a, Index b) const override;
  std::optional<SlidingRange> range(
    const SimplexMesh<3>& mesh, const std::vector<Index>& star, Index v) const override;
  bool mayDivide(
    const SimplexMesh<3>& mesh, const std::vector<Index>& cells, Index a, Index b) const override;
  bool maySwap(const SimplexMesh<3>& mesh, Index patch, Index other) const override;
  bool mayJoin(
    const SimplexMesh<3>& mesh, const std::vector<Index>& star, Index v, Index u) const override;
  bool judgesChanges() const override { return true; }
  std::uint32_t sets(const SimplexMesh<3>& mesh, Index v) const override;
  bool allows(const SurfaceChange<3>& change) const override;
  /// Inside a patch, and at a curve that was not sharp, up to the feature angle; beyond, only along
  /// edges that were as sharp as half of it. At a curve that was sharp, from half of it on.
  bool allowsAngle(
    const SimplexMesh<3>& mesh, Index a, Index b, bool isKept, double cosine) const override;
  bool allowsAngleOutside(
    const SimplexMesh<3>& mesh, Index a, Index b, double cosine) const override;

  bool mayRelease() const override { return this->release_ != nullptr; }
  /// Gives up the curves of SurfaceOptions::releaseAngle: patches grow together over them, and
  /// their points and corners slide on what is left. A mesh whose ridges have helped to hold its
  /// form is a better start for that than the input is.
  bool release(MeshEditor<3>& editor) override;

private:
  bool allowsDivision(
    const std::vector<SurfacePiece<3>>& gone, const std::vector<SurfacePiece<3>>& come) const;

  struct Patch
  {
    Index region = 0; ///< facets are ordered as seen from outside of it
    Index label = None;
    std::uint32_t sets = 0;
    bool isSigned = true; ///< the other side has another region, or none
    SurfaceDivision::Plane plane;
    std::array<Vec<3>, 2> basis{ Vec<3>::Zero(), Vec<3>::Zero() }; ///< of the plane
    double off = 0.0; ///< how far from the plane its facets were, at most

    double offPlane(const std::array<Vec<3>, 3>& facet) const;
  };

  /// The part of the tolerance that curves may use. A facet beside a curve may be this far from it
  /// sideways, and above the reference besides.
  static constexpr double CurveShare = 0.6;

  /// What the parts of this surface become by release().
  struct Release;

  void divide(MeshEditor<3>& editor, const SurfaceOptions& options);
  void prepareRelease(MeshEditor<3>& editor, const SurfaceOptions& options);
  Place released(const Place& place) const;
  void addPatches(
    MeshEditor<3>& editor, const SurfaceDivision& division, const std::map<Index, double>& thin);
  void addRooms(const SimplexMesh<3>& mesh, const SurfaceDivision& division,
    const std::map<Index, double>& thin);
  void addCurves(MeshEditor<3>& editor, const SurfaceDivision& division);
  void addSets(const MeshEditor<3>& editor, const SurfaceDivision& division,
    const std::vector<std::uint32_t>& sets);
  Span measured(Span span, const Vec<3>& a, const Vec<3>& b) const;
  double curveRoom() const { return CurveShare * this->tolerance_; }
  bool follows(const Span& span) const;
  bool mayJoinCorners(
    const SimplexMesh<3>& mesh, const std::vector<Index>& star, Index v, Index u) const;
  bool isFlat(const SurfacePiece<3>& piece) const;
  double distanceOfPlanes(const SimplexMesh<3>& mesh) const;
  Index patchOf(const SimplexMesh<3>& mesh, Index c, int i) const;
  bool isRefused(const SurfacePiece<3>& piece) const;
  SurfacePiece<3> oriented(const SurfacePiece<3>& piece) const;

  std::vector<Patch> patches_;
  std::vector<SpaceCurve> curves_;    ///< of the pieces with the same numbers
  std::vector<std::uint8_t> isSharp_; ///< the same: all its edges exceed the feature angle
  std::vector<std::vector<Index>> inputPoints_; ///< the same: its points, as point ids
  std::vector<double> rooms_; ///< the same: how far nodes and edges may be from it
  CurvePieces pieces_;
  ReferenceSurface reference_;
  SurfaceAngles angles_;
  SharpEdges bent_;                   ///< by more than half of the feature angle
  SharpEdges bentOutside_;            ///< the same of the outer surface alone
  std::vector<Facet<3>> inputFacets_; ///< those of the reference, in its order
  std::vector<Freedom> freedom_;
  std::vector<Vec<3>> corners_; ///< by point of the input: where those that are corners were
  std::uint32_t sets_ = 0;
  std::vector<std::uint32_t> setsOfPoint_, setsOfCurve_; ///< empty if there are none
  Index numberOfTwins_ = 0;
  bool isExact_ = false;
  std::vector<BoxTree::Box> refused_; ///< nothing changes there: see refuseCrossings()
  double tolerance_ = 0.0;
  double featureCosine_ = 0.0, halfCosine_ = 0.0; ///< of the feature angle, and of half of it
  std::shared_ptr<Release> release_;              ///< null: there is nothing to give up
};
}

#endif
