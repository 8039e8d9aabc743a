// SPDX-License-Identifier: BSD-3-Clause
/// @file ReferenceSurface.h
/// The surface of a mesh as it was at first: where its points are, and whether other facets stay
/// within a distance of it.
///
/// Every change is judged against this copy, never against the mesh of a moment ago: nothing
/// drifts.
#ifndef meshopt_Surface_ReferenceSurface_h
#define meshopt_Surface_ReferenceSurface_h

#include "Mesh/BoxTree.h"
#include "Surface/RoomLimit.h"
#include "Surface/SurfaceChange.h"

#include <limits>
#include <vector>

namespace meshopt
{
/// The proof of distance. The normals of a facet R of the reference sweep out its prism, and the
/// height of a point in the prism is its distance to R. Suppose that
///  - above each point of R there is a point of the mesh, of a height of at most the tolerance;
///  - the nodes of the mesh are within the tolerance of the reference;
///  - what the mesh has in any prism, nearer than twice the tolerance, is within the tolerance.
/// Then every point of R is within the tolerance of the mesh; and every point of the mesh within
/// that of the reference: those in prisms by their heights; those in the wedges between prisms,
/// above edges and points of the reference, since a facet's part in a wedge is convex, its corners
/// are nodes or lie in the walls of prisms, and the distance to an edge or a point is a convex
/// function.
///
/// A change replaces facets G by facets N with the same border. As seen along the normal of R, both
/// cover the same points, if none of them is turned away. So it keeps the first condition if the
/// heights of N over each R that G covered are small: covers() computes them at the corners of the
/// overlay of N and R, between which they are linear.
///
/// Beside a sharp edge inside a patch, what stands for one side reaches into the prisms of the
/// other, and is turned away there, or too high. Such a facet must be within the tolerance of other
/// facets of the reference (isNear()); and R must be covered as far as before, by area. Or so must
/// the area that stands for R, less what is turned away: as seen along the normal, each point has
/// as many facets that look up, less those that look down, as before, so a fold may be smoothed,
/// which takes as much of both. Areas prove less than heights: they do not see facets that overlap,
/// and where the border moves with a curve, a strip of the width that the curve may move is allowed
/// for.
class ReferenceSurface
{
public:
  using Piece = SurfacePiece<3>;
  static constexpr double Thick = std::numeric_limits<double>::infinity();

  /// Adds a facet: corners in order, seen from outside counter-clockwise. `patch`: a number >= 0.
  /// `isSigned` is false if outside cannot be told from inside, as with a facet within one region;
  /// `isOuter` is true if there is nothing outside. `thickness`: the mean one of the region
  /// behind it, if the volume of that could change by much; less than 0: of that before it.
  void add(const std::array<Vec<3>, 3>& x, Index patch, bool isSigned, bool isOuter,
    double thickness = Thick);
  /// To be called once, after the last facet. `tolerance`: a length; `least`: that of rounding. No
  /// facet may use more of the tolerance than a seventh of the thickness of the wall that it is a
  /// side of, and a quarter of the gap in front of it: no wall is pressed flat, and no gap closed.
  void finish(double tolerance, double least);

  /// The point of the patch nearest to x. Returns the number of its facet, in the order of add();
  /// -1 if the patch has none.
  int project(Index patch, const Vec<3>& x, Vec<3>& there) const;

  /// What the sheets that face point x of the surface leave it, if it moves by `most` at most: the
  /// same parts of their distance. Where two sides of a thin region meet at an acute angle, none
  /// faces x: there the same part of the mean thickness.
  std::vector<RoomLimit> limits(const Vec<3>& x, double most) const;
  /// Those of them that no others imply. Where that would be hundreds, x may move less far instead.
  std::vector<RoomLimit> fewLimits(const Vec<3>& x, double most) const;
  /// The farthest point on the way from x, a point of the surface, to `to`, that keeps these limits
  /// and is at most `most` away from x.
  Vec<3> withinRoom(const Vec<3>& x, const Vec<3>& to, double most) const;

  /// The corners of a facet, as they were given.
  const std::array<Vec<3>, 3>& corners(int facet) const { return this->facets_[facet].x; }
  /// The tolerance that facets near to this facet of the reference may use.
  double tolerance(int facet) const;

  /// Whether facets of one patch may be replaced. Corners are ordered like those of the reference.
  /// `gone` was within the tolerance. A facet cannot stand for one of the reference from which it
  /// turns by more than 75 degrees. `sideways`: how far the border of the facets may have moved.
  bool covers(
    const std::vector<Piece>& gone, const std::vector<Piece>& come, double sideways = 0.0) const;
  /// Whether `come` are parts of `gone`, and all of them: the same points need no proof.
  static bool isDivision(const std::vector<Piece>& gone, const std::vector<Piece>& come);

  /// How far the facet is from the reference of its patch, counted as in covers(): the greatest
  /// height, to which the motion of a curve beside it has to be added at a right angle; and a
  /// distance that is not exceeded, motion included, of what is higher or turned away.
  struct Offset
  {
    double height = 0.0, distance = 0.0;
  };
  Offset offset(const Piece& piece) const;

  /// Whether the reference nearest to the centre of a facet looks the other way. Not for facets
  /// that are no higher than the tolerance: they look nowhere.
  bool isTurned(const Piece& piece) const;

private:
  struct Facet
  {
    Vec<3> origin, along, across, normal; ///< a frame: the corners are (0, 0), (l, 0), (p, q)
    double l, p, q;
    Index patch;
    bool isSigned, isOuter;
    double thickness; ///< Thick; otherwise `normal` times it points out of the thin region
    std::array<Vec<3>, 3> x;
    bool isThin() const { return this->thickness < Thick; }
    double tolerance = 0.0; ///< its own
  };
  struct Heights
  {
    double least, most; ///< in absolute value; least > most: the facet is not in the prism
    double cosine;      ///< between the normals
    double area;        ///< of the overlay, twice
  };
  using Box = BoxTree::Box;

  /// What is left of the tolerance, beside needles and the sides of curves.
  static constexpr double Share = 0.75;
  /// An overlay of less than this part of a facet's area is none.
  static constexpr double Touch = 1e-10;

  bool isNeedle(const Facet& r) const;
  Heights heights(const Facet& r, const Piece& piece) const;
  bool covers(const Facet& r, const std::vector<Piece>& gone, const std::vector<Piece>& come,
    double sideways, std::vector<std::uint8_t>& unclear) const;
  bool isFlatOn(const Facet& r, const Piece& piece, double allowed) const;
  bool isNear(const Piece& piece, const std::vector<int>& near, double part = 1.0) const;
  bool isInsideOut(const Piece& piece, const std::vector<int>& near) const;
  bool isLow(const Piece& piece) const;
  bool turnsInsideOut(const std::vector<Piece>& gone, const std::vector<Piece>& come,
    const std::vector<int>& near) const;
  double room(const Facet& f, std::vector<int>& near) const;
  /// The same, if only sheets up to a distance are looked at.
  double roomWithin(double distance, const Facet& f, std::vector<int>& near) const;
  static void findNear(const BoxTree& tree, const Box& box, std::vector<int>& found);

  std::vector<Facet> facets_;
  BoxTree all_;
  std::vector<BoxTree> patches_; ///< by number: what is nearest to a point in each
  double tolerance_ = 0.0;
  double diameter_ = 0.0;
};
}

#endif
