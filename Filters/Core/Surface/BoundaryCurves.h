// SPDX-License-Identifier: BSD-3-Clause
/// @file BoundaryCurves.h
/// The curves that the boundary of a plane mesh follows, and where its nodes may slide along them.
#ifndef meshopt_Surface_BoundaryCurves_h
#define meshopt_Surface_BoundaryCurves_h

#include "Surface/LineNetwork.h"
#include "Surface/PlaneCurve.h"
#include "Surface/Surface.h"
#include "Mesh/MeshEditor.h"

#include <map>
#include <optional>
#include <string>

namespace meshopt
{
struct CurveOptions
{
  /// Degrees. Where lines turn by more than this there is a corner; in any case where they turn back
  /// (179 degrees), as at the tip of a slit.
  double cornerAngle = 45.0;
  /// Cubic B-splines through the points between two corners; else straight lines. Where a spline
  /// would go farther from its points than a circle does that turns by cornerAngle from point to
  /// point, there are corners after all: a straight side that goes over into an arc stays straight.
  /// So there are where only a single point turns, by more than 10 degrees.
  bool splines = true;
};

/// The kept facets of a mesh are divided into pieces, each from one corner to the next, or closed.
/// A corner is a point where not exactly two kept facets meet, where the line turns sharply, or
/// that the caller fixed. Each piece lies on a curve: through its own points, or a part of the
/// geometry that is given. Interfaces between regions and both sides of a crack are pieces like
/// those of the outer boundary.
///
/// Points of a piece, but for its corners, get a place: Freedom::Curve, the piece and the parameter.
/// A piece is what Surface calls a part.
class BoundaryCurves final : public Surface<2>
{
public:
  /// Makes the curves from the mesh's own kept facets; `corners`: one per point slot, or empty.
  void build(MeshEditor<2>& editor, const CurveOptions& options,
    const std::vector<std::uint8_t>& corners = {});

  /// Makes them from `geometry`. Returns a sentence that says where mesh and geometry do not match:
  /// a boundary point farther than 1e-3 of the diagonal from every curve, or a corner of the geometry
  /// without a point of the mesh; the mesh then has no places.
  std::string build(MeshEditor<2>& editor, const LineNetwork& geometry, const CurveOptions& options,
    const std::vector<std::uint8_t>& corners = {});

  std::size_t numberOfPieces() const { return this->pieces_.size(); }

  Vec<2> at(Index piece, double s) const override
  {
    return this->curves_[this->pieces_[piece].curve].at(s);
  }
  Place project(const Place& place, const Vec<2>& x, Vec<2>& there) const override;
  int tangents(
    const Place& place, const Vec<2>& x, std::array<Vec<2>, 2>& basis) const override;
  std::optional<Span> span(const SimplexMesh<2>& mesh, Index a, Index b) const override;
  std::optional<SlidingRange> range(
    const SimplexMesh<2>& mesh, const std::vector<Index>& star, Index v) const override;
  bool mayDivide(const SimplexMesh<2>& mesh, Index a, Index b) const override
  {
    return this->span(mesh, a, b).has_value();
  }
  /// v can only go along its piece, and not if that would fold the boundary, or leave the curve a
  /// tenth of the new edge's length away from it.
  bool mayJoin(const SimplexMesh<2>& mesh, const std::vector<Index>& star, Index v,
    Index u) const override;

  double sagitta(const Span& s) const
  {
    return this->curves_[this->pieces_[s.part].curve].sagitta(s.from, s.to);
  }
  /// Whether two neighbours on the piece may be so far apart, from one parameter to the other: not
  /// if the way around a closed curve could no longer be told.
  bool mayBeNeighbours(const Span& s) const;

private:
  struct Piece
  {
    Index curve = None;
    std::array<Index, 2> ends{ None, None }; ///< points of the mesh; None: closed
    std::array<double, 2> range{ 0.0, 0.0 }; ///< parameters of the ends
    bool isEdge = false;                     ///< one edge of the input, from end to end
  };
  void markWhereSplinesOvershoot(LineNetwork& network, const CurveOptions& options) const;
  PlaneCurve curve(const LineNetwork& network, const LineChain& chain, bool splines) const;
  std::string matchCorners(const SimplexMesh<2>& mesh, const LineNetwork& geometry,
    double tolerance, LineNetwork& boundary) const;
  void addPiece(MeshEditor<2>& editor, const LineChain& chain, Index curve,
    const std::vector<double>& parameters);
  Index nearestCurve(const SimplexMesh<2>& mesh, const LineChain& chain, double tolerance,
    Index& farthest, double& distance) const;
  std::string place(MeshEditor<2>& editor, const LineChain& chain, double tolerance);
  double period(const Piece& piece) const;
  void join();

  std::vector<PlaneCurve> curves_;
  std::vector<Piece> pieces_;
  /// The piece by which two corners may be neighbours. Of several that join them it is the one that was
  /// an edge of the input: there is at most one, and the others never become one.
  std::map<std::array<Index, 2>, Index> betweenCorners_;
};
}

#endif
