// SPDX-License-Identifier: BSD-3-Clause
/// @file BoundaryCurves.h
/// The curves that the boundary of a plane mesh follows, along which its nodes may slide.
#ifndef meshopt_Surface_BoundaryCurves_h
#define meshopt_Surface_BoundaryCurves_h

#include "Mesh/BoxTree.h"
#include "Mesh/MeshEditor.h"
#include "Surface/CurvePieces.h"
#include "Surface/LineNetwork.h"
#include "Surface/PlaneCurve.h"
#include "Surface/Surface.h"
#include "Surface/WholeBoundary.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace meshopt
{
/// The kept facets of a mesh are divided into pieces. Each runs from one corner to the next, or is
/// closed. A corner is a point where not exactly two kept facets meet, where the line turns
/// sharply, or that the caller fixed. Each piece lies on a curve: one through its own points, or a
/// part of the given geometry. Interfaces between regions and both sides of a crack are pieces like
/// those of the outer boundary.
///
/// The points of a piece, except its corners, get a place: Freedom::Curve, the piece and the
/// parameter. A piece is what Surface calls a part.
class BoundaryCurves final : public Surface<2>
{
public:
  /// Makes the curves from the kept facets of the mesh. `corners`: one per point slot, or empty.
  void build(MeshEditor<2>& editor, const CurveOptions& options,
    const std::vector<std::uint8_t>& corners = {});

  /// Makes the curves from `geometry`. Returns a sentence that says where mesh and geometry do not
  /// match: at a boundary point farther than 1e-3 of the diagonal from every curve, or at a corner
  /// of the geometry without a point of the mesh. The mesh then has no places.
  std::string build(MeshEditor<2>& editor, const LineNetwork& geometry, const CurveOptions& options,
    const std::vector<std::uint8_t>& corners = {});

  /// Puts the boundary of a part of a mesh on the curves of the whole.
  void build(MeshEditor<2>& editor, const WholeBoundary& whole, const PartOfBoundary& part);
  /// After that: where a point of this mesh is in the whole; no piece if it is fixed, or not on it.
  WholeBoundary::PlaceOnPiece inWhole(
    const WholeBoundary& whole, const SimplexMesh<2>& mesh, Index point) const;

  std::size_t numberOfPieces() const { return this->pieces_.size(); }

  Vec<2> at(Index piece, double s) const override
  {
    return this->curves_[this->pieces_[piece].curve].at(s);
  }
  Place project(const Place& place, const Vec<2>& x, Vec<2>& there) const override;
  int tangents(const SimplexMesh<2>& mesh, const std::vector<Index>& star, Index v,
    std::array<Vec<2>, 2>& basis) const override;
  /// Nothing where changes are refused: no node there moves, comes or goes.
  std::optional<Span> span(const SimplexMesh<2>& mesh, Index a, Index b) const override
  {
    return this->isRefused(mesh, a, b) ? std::nullopt
                                       : this->pieces_.span(a, mesh.place(a), b, mesh.place(b));
  }
  std::optional<SlidingRange> range(
    const SimplexMesh<2>& mesh, const std::vector<Index>& star, Index v) const override;
  bool mayDivide(
    const SimplexMesh<2>& mesh, const std::vector<Index>&, Index a, Index b) const override
  {
    return this->span(mesh, a, b).has_value();
  }
  bool maySwap(const SimplexMesh<2>&, Index, Index) const override { return false; }
  /// v can join only a neighbour on its piece. Not if that would fold the boundary, or if the curve
  /// would be farther from the new edge than a tenth of its length.
  bool mayJoin(
    const SimplexMesh<2>& mesh, const std::vector<Index>& star, Index v, Index u) const override;

  /// Across a narrow gap, or next to an end, a curve may reach farther than the mesh before.
  bool refuseCrossings(const SimplexMesh<2>& before, const SimplexMesh<2>& now) override;
  /// Whether edge (a, b) is near such a place.
  bool isRefused(const SimplexMesh<2>& mesh, Index a, Index b) const;

  double sagitta(const Span& s) const
  {
    return this->curves_[this->pieces_[s.part].curve].sagitta(s.from, s.to);
  }
  bool mayBeNeighbours(const Span& s) const { return this->pieces_.mayBeNeighbours(s); }

private:
  bool areOnOneCurve(const SimplexMesh<2>& mesh, const Facet<2>& f, const Facet<2>& g) const;
  void keep(const LineChain& chain);
  /// `geometry` may be nullptr.
  std::string buildAll(MeshEditor<2>& editor, const LineNetwork* geometry,
    const CurveOptions& options, const std::vector<std::uint8_t>& corners);

  std::vector<PlaneCurve> curves_;
  CurvePieces pieces_;
  std::vector<Index> wholes_;         ///< of a part: the piece of the whole that each piece is on
  std::vector<BoxTree::Box> refused_; ///< nothing changes there: see refuseCrossings()
};
}

#endif
