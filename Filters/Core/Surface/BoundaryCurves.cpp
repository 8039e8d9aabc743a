// SPDX-License-Identifier: BSD-3-Clause
// The curves of a plane boundary, as a surface along which the nodes of a mesh slide.
#include "Surface/BoundaryCurves.h"

#include "Base/SortUnique.h"
#include "Surface/NewCrossings.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meshopt
{
namespace
{
/// How far the curve may be from a new edge of the boundary, as a fraction of the edge's length.
constexpr double Sagitta = 0.1;

double diagonal(const SimplexMesh<2>& mesh)
{
  Vec<2> low = Vec<2>::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    if (mesh.isPointAlive(p))
    {
      low = low.cwiseMin(mesh.point(p));
      high = high.cwiseMax(mesh.point(p));
    }
  }
  return (high - low).norm();
}
}

void BoundaryCurves::build(
  MeshEditor<2>& editor, const CurveOptions& options, const std::vector<std::uint8_t>& corners)
{
  this->buildAll(editor, nullptr, options, corners);
}

std::string BoundaryCurves::build(MeshEditor<2>& editor, const LineNetwork& geometry,
  const CurveOptions& options, const std::vector<std::uint8_t>& corners)
{
  return this->buildAll(editor, &geometry, options, corners);
}

/// The mesh has its whole boundary. All or nothing: a mesh that does not match the geometry gets no
/// places.
std::string BoundaryCurves::buildAll(MeshEditor<2>& editor, const LineNetwork* geometry,
  const CurveOptions& options, const std::vector<std::uint8_t>& corners)
{
  this->pieces_.clear();
  LineNetwork boundary = keptLines(editor.mesh());
  for (std::size_t p = 0; p < corners.size(); ++p)
  {
    // The caller's corners first: they divide chains before any angle is measured.
    boundary.corners[p] |= corners[p];
  }
  WholeBoundary whole;
  std::vector<WholeBoundary::PlaceOnPiece> places;
  std::string error = whole.make(boundary, geometry, options, diagonal(editor.mesh()), places);
  this->curves_ = std::move(whole.curves);
  if (error.empty())
  {
    for (std::size_t p = 0; p < places.size(); ++p)
    {
      if (places[p].piece != None)
      {
        editor.setPlace(
          static_cast<Index>(p), { Freedom::Curve, places[p].piece, places[p].parameter });
      }
    }
    for (const CurvePiece& piece : whole.pieces)
    {
      this->pieces_.add(piece);
    }
  }
  this->pieces_.join();
  return error;
}

/// Between its ends no other piece is meant.
void BoundaryCurves::keep(const LineChain& chain)
{
  CurvePiece piece;
  if (!chain.isClosed)
  {
    piece.ends = { chain.points.front(), chain.points.back() };
    piece.isEdge = chain.points.size() == 2;
  }
  this->pieces_.add(piece);
  this->wholes_.push_back(None);
}

/// A part's corners are those of the whole, and the points where it meets other parts.
void BoundaryCurves::build(
  MeshEditor<2>& editor, const WholeBoundary& whole, const PartOfBoundary& part)
{
  this->pieces_.clear();
  this->wholes_.clear();
  this->curves_ = whole.curves;
  LineNetwork boundary = keptLines(editor.mesh());
  for (std::size_t p = 0; p < boundary.corners.size(); ++p)
  {
    boundary.corners[p] |= static_cast<std::uint8_t>(part.corners[p] != None || part.hull[p]);
  }
  std::vector<std::array<Index, 2>> inside;
  for (const std::array<Index, 2>& line : boundary.lines)
  {
    if (part.hull[line[0]] && part.hull[line[1]])
    {
      this->keep({ { line[0], line[1] }, false });
    }
    else
    {
      inside.push_back(line);
    }
  }
  boundary.lines.swap(inside);
  markCorners(boundary, TurnsNever);
  for (const LineChain& chain : chains(boundary))
  {
    std::vector<double> s;
    const Index k = whole.find(part, chain, s);
    if (k == None)
    {
      this->keep(chain);
      continue;
    }
    // The points between its ends, which are corners.
    const std::size_t first = chain.isClosed ? 0 : 1;
    const auto piece = static_cast<Index>(this->pieces_.size());
    for (std::size_t i = first; i + first < chain.points.size(); ++i)
    {
      editor.setPlace(chain.points[i], { Freedom::Curve, piece, s[i] });
    }
    this->pieces_.add(makePiece(this->curves_, chain, whole.pieces[k].curve, s));
    this->wholes_.push_back(k);
  }
  this->pieces_.join();
}

WholeBoundary::PlaceOnPiece BoundaryCurves::inWhole(
  const WholeBoundary& whole, const SimplexMesh<2>& mesh, Index point) const
{
  if (mesh.freedom(point) != Freedom::Curve)
  {
    return {};
  }
  const Place place = mesh.place(point);
  const Index k = this->wholes_[place.part];
  const double period = whole.pieces[k].period;
  const double turns = period > 0.0 ? std::floor(place.parameter / period) : 0.0;
  return { k, place.parameter - turns * period };
}

/// Along the whole curve: the nearest place may be far from the old one.
Place BoundaryCurves::project(const Place& place, const Vec<2>& x, Vec<2>& there) const
{
  Place result = place;
  double distance = 0.0;
  result.parameter = this->curves_[this->pieces_[place.part].curve].closest(x, distance);
  there = this->at(result.part, result.parameter);
  return result;
}

int BoundaryCurves::tangents(const SimplexMesh<2>& mesh, const std::vector<Index>&, Index v,
  std::array<Vec<2>, 2>& basis) const
{
  const Place place = mesh.place(v);
  basis[0] = this->curves_[this->pieces_[place.part].curve].direction(place.parameter);
  return 1;
}

/// The two neighbours over kept facets, and their parameters.
std::optional<SlidingRange> BoundaryCurves::range(
  const SimplexMesh<2>& mesh, const std::vector<Index>& star, Index v) const
{
  std::vector<Index> ends; // the neighbours over kept facets
  for (Index c : star)
  {
    for (int i = 0; i < 3; ++i)
    {
      const Facet<2> f = mesh.facet(c, i);
      if (mesh.isKept(c, i) && (f[0] == v || f[1] == v))
      {
        ends.push_back(f[0] == v ? f[1] : f[0]);
      }
    }
  }
  // As in space: exactly two neighbours, or the point is an end.
  sortUnique(ends); // the order of the star must not matter
  if (mesh.freedom(v) != Freedom::Curve || ends.size() != 2)
  {
    return std::nullopt;
  }
  const auto low = this->span(mesh, v, ends[0]), high = this->span(mesh, v, ends[1]);
  return low && high ? std::optional<SlidingRange>({ { ends[0], ends[1] }, low->to, high->to })
                     : std::nullopt;
}

bool BoundaryCurves::mayJoin(
  const SimplexMesh<2>& mesh, const std::vector<Index>& star, Index v, Index u) const
{
  const auto range = this->range(mesh, star, v);
  if (!range || (range->ends[0] != u && range->ends[1] != u))
  {
    return false;
  }
  const Index w = range->ends[0] == u ? range->ends[1] : range->ends[0];
  // At an ear (a cell with both neighbours) the contraction would fold the boundary.
  const bool isEar = std::any_of(star.begin(), star.end(),
    [&](Index c) { return mesh.localIndex(c, u) >= 0 && mesh.localIndex(c, w) >= 0; });
  const Span joined{ mesh.place(v).part, range->low, range->high };
  if (isEar || !this->pieces_.mayBeNeighbours(joined) ||
    this->sagitta(joined) > Sagitta * (mesh.point(u) - mesh.point(w)).norm())
  {
    return false;
  }
  if (mesh.freedom(u) != Freedom::Curve && mesh.freedom(w) != Freedom::Curve)
  {
    const auto between = this->span(mesh, u, w);
    return between && between->part == joined.part; // several pieces may join two corners
  }
  return true;
}

bool BoundaryCurves::refuseCrossings(const SimplexMesh<2>& before, const SimplexMesh<2>& now)
{
  const auto counts = [this](const SimplexMesh<2>& mesh, const Facet<2>& f, const Facet<2>& g)
  { return !this->areOnOneCurve(mesh, f, g); };
  return refuseNewCrossings<2>(before, now, this->refused_, counts);
}

/// The lips of a closed crack lie on each other. Where they have different nodes, their edges cross
/// by rounding, or by as much as the curve is away from them.
bool BoundaryCurves::areOnOneCurve(
  const SimplexMesh<2>& mesh, const Facet<2>& f, const Facet<2>& g) const
{
  constexpr double tolerance = 1e-6; // of the length of the curve
  const auto hasOther = [&](const Facet<2>& edge, const Facet<2>& other)
  {
    const auto span = this->pieces_.span(
      edge[0], mesh.place(edge[0]), edge[1], mesh.place(edge[1]));
    return span &&
      std::all_of(other.begin(), other.end(),
        [&](Index p)
        {
          const PlaneCurve& curve = this->curves_[this->pieces_[span->part].curve];
          double distance = 0.0;
          curve.closest(mesh.point(p), distance);
          return distance <= tolerance * curve.length();
        });
  };
  return hasOther(f, g) || hasOther(g, f);
}

bool BoundaryCurves::isRefused(const SimplexMesh<2>& mesh, Index a, Index b) const
{
  const auto touches = [&](const BoxTree::Box& box) {
    return box.intersects(BoxTree::around(std::array{ mesh.point(a), mesh.point(b) }));
  };
  return std::any_of(this->refused_.begin(), this->refused_.end(), touches);
}
}
