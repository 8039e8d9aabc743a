// SPDX-License-Identifier: BSD-3-Clause
/// @file SurfaceDivision.h
/// Divides the surface of a tetrahedral mesh by its features: patches, curves and corners.
#ifndef meshopt_Surface_SurfaceDivision_h
#define meshopt_Surface_SurfaceDivision_h

#include "Mesh/SimplexMesh.h"

#include <utility>
#include <vector>

namespace meshopt
{
struct SurfaceOptions
{
  /// Length: how far the surface and what it becomes may be from each other, both ways; at most a
  /// tenth of the diagonal counts. 0: the surface stays the same set of points, up to rounding.
  double tolerance = 0.0;
  /// Degrees. An edge whose two facets turn by more than this is part of a curve.
  double featureAngle = 45.0;
  /// Degrees. If greater than featureAngle: curves that are none but for an angle of at most this
  /// are given up by SlidingSurface::release(). 0: none is.
  double releaseAngle = 0.0;
  /// Degrees. A point where a curve turns by more than this is a corner.
  double cornerAngle = 45.0;
  /// One per point, or empty. Nonzero: the point is a corner.
  std::vector<std::uint8_t> corners;
  /// The same for points where curves end, as if the surface itself gave these corners.
  std::vector<std::uint8_t> ends;
  /// Facets (sorted ids) and a number for each, in ascending order. Edges between facets of
  /// different numbers are parts of curves. Facets that are not listed have the number None.
  std::vector<std::pair<Facet<3>, Index>> labels;
  /// Edges (sorted ids) and a number for each, in ascending order. Those in the surface are parts
  /// of curves. A point of a curve where edges of different numbers meet is a corner. Edges that
  /// are not listed have the number None.
  std::vector<std::pair<std::array<Index, 2>, Index>> lines;
  /// Facets (sorted ids) that must stay as they are, in ascending order.
  std::vector<Facet<3>> locked;
  /// One per point, or empty: bit k says that the point is in node set k (SlidingSurface::sets()).
  std::vector<std::uint32_t> sets;
};

/// The kept facets of a mesh: outer surface, interfaces between regions, and those that the caller
/// wants to keep.
///
/// An edge is part of a curve if not exactly two of these facets meet there, if these turn by more
/// than the feature angle, or if they separate other regions or have other numbers; and so is each
/// kept edge in the surface, and each edge with a number. A corner is a point where not exactly two
/// such edges meet, where these separate other patches or have other numbers, where the surface
/// touches itself, where a curve turns by more than the corner angle, or that is fixed. Where the
/// surface touches itself in a point or along an edge, these stay. Patches are facets that hang
/// together without crossing a curve.
///
/// With almost no tolerance (isExact()), patches are flat, and curves are straight: any edge that
/// is not flat belongs to a curve, and any point where a curve turns is a corner.
struct SurfaceDivision
{
  SurfaceDivision(const SimplexMesh<3>& mesh, const SurfaceOptions& options);

  struct KeptFacet
  {
    Facet<3> nodes;      ///< ordered counter-clockwise, as seen from outside of the cell
    Index handle = None; ///< from the side with the lower region
    Index region = 0;    ///< of that cell
    Index other = None;  ///< region on the other side; None: outside
    Index label = None;
    Index patch = None; ///< None: it stays as it is
    bool isLocked = false;
  };
  /// Points from corner to corner, or of a closed curve.
  struct Chain
  {
    std::vector<Index> points;
    bool isClosed = false;
    bool isSharp = true;  ///< all its edges have two facets that exceed the feature angle
    bool isFixed = false; ///< an edge where the surface touches itself, or between locked facets
    bool isLine = false;  ///< its edges have a number of SurfaceOptions::lines
  };
  /// The plane of a flat patch.
  struct Plane
  {
    Vec<3> origin = Vec<3>::Zero(), normal = Vec<3>::Zero();
  };

  static double cosine(double degrees);

  std::vector<KeptFacet> facets; ///< in the order of cells
  Index numberOfPatches = 0;
  /// Facets that are locked because the caller lists them, or because they lie on one another.
  Index numberOfTwins = 0;
  std::vector<Plane> planes; ///< of each patch, only if exact
  std::vector<Chain> chains;
  std::vector<std::array<Index, 2>> curveEdges; ///< sorted ids, in ascending order
  /// Sorted ids of the edges whose facets turn by more than half of the feature angle.
  std::vector<std::array<Index, 2>> bentEdges;
  /// The same for the two facets of the outer surface, also where interfaces end between them.
  std::vector<std::array<Index, 2>> bentOutside;
  std::vector<Freedom> freedom;    ///< of each point slot; Free: not on the surface
  std::vector<Index> patchOfPoint; ///< of those that slide on a patch
  double diagonal = 0.0;
  double tolerance = 0.0; ///< that of the options, but not less than rounding
  double rounding = 0.0;  ///< of coordinates: the least tolerance
  bool isExact = false;

private:
  /// An edge of the surface with the numbers of its facets: [first, last) of incidences_.
  struct Edge
  {
    std::array<Index, 2> nodes;
    std::size_t first, last;
    bool isCurve, isSharp;
    bool isBent; // by more than the feature angle, in the outer surface
    Index label; // that of SurfaceOptions::lines
  };

  /// Half the width of the slab in which lies what is flat.
  double slab() const { return 0.5 * this->tolerance; }
  void measure();
  void collectFacets(const SurfaceOptions& options);
  void lockTwins();
  void collectEdges();
  bool isCurve(const Edge& edge, const SurfaceOptions& options) const;
  bool isFlat(const Edge& edge) const;
  bool isSharp(const Edge& edge, double featureAngle) const;
  bool isSharp(const Edge& edge, const KeptFacet& f, const KeptFacet& g, double featureAngle) const;
  bool isBentOutside(const Edge& edge, double angle) const;
  Vec<3> normal(const KeptFacet& facet) const;
  void findCurves(const SurfaceOptions& options);
  void findPatches();
  void fill(Index seed, const Plane* plane);
  bool fits(const std::vector<Index>& facets, Plane& plane) const;
  void findCorners(const SurfaceOptions& options);
  bool isTouching(const Edge& edge) const;
  bool isLocked(const Edge& edge) const;
  bool isPinched(Index p, const std::vector<Index>& facets, const std::vector<Index>& edges) const;
  bool turns(Index p, const std::vector<Index>& curves, double angle) const;
  std::vector<Index> signature(Index edge) const;
  void findChains();
  void straighten();

  const SimplexMesh<3>& mesh_;
  std::vector<Edge> edges_;
  std::vector<Index> incidences_;             // facets at the edges
  std::vector<std::array<Index, 3>> edgesOf_; // of each facet: opposite to its nodes
  std::vector<Index> filled_;                 // by fill()
  std::vector<std::uint8_t> isCorner_;        // of each point: a line leaves the surface there
};
}

#endif
