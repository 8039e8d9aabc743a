// SPDX-License-Identifier: BSD-3-Clause
/// @file WholeBoundary.h
/// The corners and curves of the boundary of a plane mesh, of which other meshes may be parts.
#ifndef meshopt_Surface_WholeBoundary_h
#define meshopt_Surface_WholeBoundary_h

#include "Surface/CurvePieces.h"
#include "Surface/LineNetwork.h"
#include "Surface/PlaneCurve.h"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace meshopt
{
struct CurveOptions
{
  /// Degrees. A point where lines turn by more than this is a corner. A point where they turn back
  /// (by 179 degrees), as at the tip of a slit, is always one.
  double cornerAngle = 45.0;
  /// Cubic B-splines through the points between two corners; otherwise straight lines. There are
  /// additional corners where a spline would be farther from its points than a circle that turns by
  /// cornerAngle from point to point: so a straight side that continues in an arc stays straight. A
  /// single point that turns by more than 10 degrees between points that do not is also a corner.
  bool splines = true;
};

struct PartOfBoundary;

/// The curves of a boundary of which meshes have parts only, as the pieces of many ranks have.
/// Corners and splines depend on the whole, so they are found once. Its points are known by their
/// numbers in the boundary that it was made from.
struct WholeBoundary
{
  /// Where a point is that is no corner.
  struct PlaceOnPiece
  {
    Index piece = None;
    double parameter = 0.0;
  };

  std::vector<PlaneCurve> curves;
  std::vector<CurvePiece> pieces; ///< from corner to corner; their ends are numbers of points
  /// The piece that two neighbours who are corners are on: by their numbers, the lower one first.
  /// None if it cannot be told.
  std::map<std::array<Index, 2>, Index> betweenCorners;

  /// Makes the curves of `boundary`, whose lines are the whole boundary; its corners become all
  /// corners. `geometry`: what the curves are made from; nullptr: from the boundary itself. `size`:
  /// the diagonal of the mesh. `places`: of each point. Returns a sentence if mesh and geometry do
  /// not match.
  std::string make(LineNetwork& boundary, const LineNetwork* geometry, const CurveOptions& options,
    double size, std::vector<PlaceOnPiece>& places);

  /// Finds the piece that a chain of a part is on, and the parameters of its points. None if it
  /// cannot be told from the part: the chain then has to stay.
  Index find(const PartOfBoundary& part, const LineChain& chain, std::vector<double>& s) const;

private:
  void add(const LineChain& chain, Index curve, const std::vector<double>& parameters,
    std::vector<PlaceOnPiece>& places);
};

/// What a mesh has of a whole boundary; lists have a value for each point slot.
struct PartOfBoundary
{
  std::vector<Index> corners; ///< the number of the point, if it is a corner; or None
  std::vector<WholeBoundary::PlaceOnPiece> places; ///< of the others on the boundary
  /// Points that cells outside of the mesh use, too. They must be fixed. Kept facets between two of
  /// them are on no piece, whether they are boundary or not.
  std::vector<std::uint8_t> hull;
};

/// The chain as a piece of a curve.
CurvePiece makePiece(const std::vector<PlaneCurve>& curves, const LineChain& chain, Index curve,
  const std::vector<double>& parameters);
}

#endif
