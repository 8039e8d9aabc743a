// SPDX-License-Identifier: BSD-3-Clause
// The curves of a plane boundary. Either they are made from the boundary itself, or each chain of
// it is put on the nearest curve of a given geometry.
#include "Surface/WholeBoundary.h"

#include "Base/SortUnique.h"
#include "Mesh/Ids.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace meshopt
{
namespace
{
constexpr double Tolerance = 1e-3; ///< of the diagonal of the mesh

/// See PlaneCurve::mostCurvedSegment(): the share of a circle whose polygon turns by `angle`
/// (degrees) at each point, with a margin.
double greatestShare(double angle)
{
  constexpr double margin = 1.2;
  // Of an arc whose chord belongs to an angle a, the height is tan(a / 4) / 2 of the chord.
  return margin * 0.5 * std::tan(angle / 4.0 * std::acos(-1.0) / 180.0);
}

/// As a word for messages.
std::string nameOf(const LineNetwork& network, Index p)
{
  const Vec<2>& x = network.points[p];
  std::ostringstream text;
  text << "point " << (network.names.empty() ? p : network.names[p]) << " (" << x[0] << ", " << x[1]
       << ")";
  return text.str();
}

PlaneCurve curveOf(const LineNetwork& network, const LineChain& chain, bool splines)
{
  std::vector<Vec<2>> points;
  for (Index p : chain.points)
  {
    points.push_back(network.points[p]);
  }
  return PlaneCurve(std::move(points), chain.isClosed, splines);
}

/// Makes the ends of segments corners where a spline overshoots. A spline through the short sides
/// of an arc and a long straight side would swing far out on the long one; with corners at its ends
/// that side stays straight.
void markWhereSplinesOvershoot(LineNetwork& network, const CurveOptions& options)
{
  // It ends: each round makes points corners, and a chain of one segment is no spline.
  for (bool again = true; again;)
  {
    again = false;
    for (const LineChain& chain : chains(network))
    {
      const PlaneCurve curve = curveOf(network, chain, true);
      double share = 0.0;
      const std::size_t k = curve.mostCurvedSegment(share);
      if (share > greatestShare(options.cornerAngle))
      {
        for (std::size_t end : { k, (k + 1) % chain.points.size() })
        {
          network.corners[chain.points[end]] = 1;
        }
        // New corners divide the chain, which gives new splines: test these, too.
        again = true;
      }
    }
  }
}

/// First the corners that the boundary has by its angles, then those that only splines need: a
/// spline depends on where its chain ends.
void markAllCorners(LineNetwork& boundary, const CurveOptions& options)
{
  markCorners(boundary, options.cornerAngle);
  if (options.splines)
  {
    markKinks(boundary);
    markWhereSplinesOvershoot(boundary, options);
  }
}

/// Every corner of the geometry must be a point of the boundary; that point then becomes a corner.
std::string matchCorners(const LineNetwork& geometry, double tolerance, LineNetwork& boundary)
{
  std::vector<Index> ends;
  for (const std::array<Index, 2>& l : boundary.lines)
  {
    ends.insert(ends.end(), l.begin(), l.end());
  }
  sortUnique(ends);
  std::vector<BoxTree::Item> items;
  for (Index p : ends)
  {
    items.push_back({ p, BoxTree::around(std::array{ boundary.points[p] }) });
  }
  BoxTree tree;
  tree.build(items);
  for (std::size_t g = 0; g < geometry.points.size(); ++g)
  {
    bool found = !geometry.corners[g];
    const auto look = [&](Index p) // at all such points: at the mouth of a crack there are several
    {
      if ((boundary.points[p] - geometry.points[g]).norm() <= tolerance)
      {
        boundary.corners[p] = 1;
        found = true;
      }
    };
    if (!found)
    {
      const BoxTree::Box there = BoxTree::around(std::array{ geometry.points[g] });
      tree.findTouching(BoxTree::widened(there, tolerance), look);
    }
    if (!found)
    {
      return "The geometry has a corner at its " + nameOf(geometry, static_cast<Index>(g)) +
        ", but the boundary of the mesh has no point there.";
    }
  }
  return {};
}

/// A curve from a corner around to itself has two parameters at that corner. The middle of the edge
/// that leaves the corner tells which one is meant at each end of the chain.
void tellEndsApart(const LineNetwork& boundary, const std::vector<Index>& points,
  const PlaneCurve& curve, double tolerance, std::vector<double>& s)
{
  if ((curve.at(0.0) - curve.at(curve.length())).norm() > tolerance)
  {
    return;
  }
  const std::size_t last = points.size() - 1;
  for (const auto& [end, next] :
    { std::pair<std::size_t, std::size_t>{ 0, 1 }, { last, last - 1 } })
  {
    const Vec<2>&x = boundary.points[points[end]], &y = boundary.points[points[next]];
    if ((x - curve.at(0.0)).norm() <= tolerance)
    {
      double d = 0.0;
      s[end] = curve.closest(Vec<2>(0.5 * (x + y)), d) < s[next] ? 0.0 : curve.length();
    }
  }
}

/// The curves of a geometry, and a tree of them.
struct Curves
{
  explicit Curves(const std::vector<PlaneCurve>& given)
    : curves(given)
  {
    std::vector<BoxTree::Item> items;
    for (const PlaneCurve& curve : given)
    {
      items.push_back({ static_cast<Index>(items.size()), curve.box() });
    }
    this->tree.build(items);
  }
  const std::vector<PlaneCurve>& curves;
  BoxTree tree;
};

/// The curve that is nearest to a chain of the mesh's boundary. `farthest` is the point of the
/// chain with the greatest distance to it, `distance` that distance. None if there are no curves.
Index nearestCurve(const Curves& all, const LineNetwork& boundary, const LineChain& chain,
  double tolerance, Index& farthest, double& distance)
{
  const auto& points = boundary.points;
  const Vec<2>& first = points[chain.points[0]];
  const Vec<2> middleOfFirst = 0.5 * (first + points[chain.points[1]]);
  Index nearest = None;
  double best = std::numeric_limits<double>::infinity();
  const auto look = [&](Index g)
  {
    const PlaneCurve& curve = all.curves[g];
    double worst = -1.0;
    Index at = None;
    for (Index p : chain.points)
    {
      double d = 0.0;
      curve.closest(points[p], d);
      at = d > worst ? p : at;
      worst = std::max(worst, d);
      // Too far away already to be the nearest one.
      if (worst > best)
      {
        break;
      }
    }
    // Several curves may join the same two corners: the middle of the first edge tells them apart.
    double middle = 0.0;
    curve.closest(middleOfFirst, middle);
    // The middle counts little: it only decides between curves that are equally near.
    const double rank = std::max(worst, tolerance) + 1e-3 * middle;
    // Of equals the first: the order in which the tree is searched must not matter.
    if (rank < best || (rank == best && g < nearest))
    {
      best = rank;
      nearest = g;
      farthest = at;
      distance = worst;
    }
    return best * best;
  };
  // No curve is nearer than its box is to the first point.
  all.tree.findNearest(Vec<3>(first[0], first[1], 0.0), look);
  return nearest;
}

/// Where a chain of the boundary is: the number of its curve, and a parameter for each point.
struct PlacedChain
{
  Index curve = None;
  std::vector<double> parameters;
};

/// Puts a chain of the boundary on the curve nearest to it.
std::string placeOn(const Curves& all, const LineNetwork& boundary, const LineChain& chain,
  double tolerance, PlacedChain& placed)
{
  Index farthest = chain.points[0];
  double distance = std::numeric_limits<double>::infinity();
  placed.curve = nearestCurve(all, boundary, chain, tolerance, farthest, distance);
  if (distance > tolerance)
  {
    std::ostringstream text;
    text << "The boundary of the mesh does not lie on the geometry: " << nameOf(boundary, farthest)
         << " is " << distance << " away from it.";
    return text.str();
  }
  const PlaneCurve& curve = all.curves[placed.curve];
  const double period = curve.isClosed() ? curve.length() : 0.0;
  std::vector<double>& s = placed.parameters;
  s.clear();
  for (Index p : chain.points)
  {
    double d = 0.0;
    s.push_back(curve.closest(boundary.points[p], d));
    if (s.size() > 1 && period > 0.0)
    {
      // Unwraps the parameters of a closed curve: neighbours on the chain are less than half a turn
      // apart.
      s.back() += std::round((s[s.size() - 2] - s.back()) / period) * period;
    }
  }
  if (!chain.isClosed && period == 0.0)
  {
    tellEndsApart(boundary, chain.points, curve, tolerance, s);
  }
  // A chain may run along the curve in either direction.
  const double direction = s.back() > s.front() ? 1.0 : -1.0;
  // Parameters must rise or fall all along the chain. (Of a closed chain with three points nothing
  // can be told.)
  for (std::size_t k = 1; k < s.size() && !(chain.isClosed && s.size() < 4); ++k)
  {
    if (!(direction * (s[k] - s[k - 1]) > 0.0))
    {
      return "The boundary of the mesh does not follow the geometry: it turns back at its " +
        nameOf(boundary, chain.points[k]) + ".";
    }
  }
  return {};
}

/// Of the points of a curve that was made through them.
std::vector<double> parametersOf(const PlaneCurve& curve, const LineChain& chain)
{
  std::vector<double> parameters;
  for (std::size_t k = 0; k < chain.points.size(); ++k)
  {
    parameters.push_back(curve.parameter(k));
  }
  return parameters;
}

/// The curves of a given geometry, whose corners are marked on the way.
std::vector<PlaneCurve> curvesOf(LineNetwork& geometry, const CurveOptions& options)
{
  markCorners(geometry, options.cornerAngle);
  if (options.splines)
  {
    markKinks(geometry);
  }
  std::vector<PlaneCurve> curves;
  for (const LineChain& chain : chains(geometry))
  {
    const PlaneCurve curve = curveOf(geometry, chain, options.splines);
    double share = 0.0;
    curve.mostCurvedSegment(share);
    // A spline that overshoots is given up: the geometry has no further corners to divide it at.
    const bool overshoots = share > greatestShare(options.cornerAngle);
    curves.push_back(overshoots ? curveOf(geometry, chain, false) : curve);
  }
  return curves;
}
}

CurvePiece makePiece(const std::vector<PlaneCurve>& curves, const LineChain& chain, Index curve,
  const std::vector<double>& parameters)
{
  CurvePiece piece;
  piece.curve = curve;
  if (!chain.isClosed)
  {
    piece.ends = { chain.points.front(), chain.points.back() };
    piece.range = { parameters.front(), parameters.back() };
    piece.isEdge = chain.points.size() == 2;
  }
  else
  {
    piece.period = curves[curve].isClosed() ? curves[curve].length() : 0.0;
  }
  return piece;
}

void WholeBoundary::add(const LineChain& chain, Index curve, const std::vector<double>& parameters,
  std::vector<PlaceOnPiece>& places)
{
  const auto number = static_cast<Index>(this->pieces.size());
  // The points between its ends, which are corners.
  const std::size_t first = chain.isClosed ? 0 : 1;
  for (std::size_t k = first; k + first < chain.points.size(); ++k)
  {
    places[chain.points[k]] = { number, parameters[k] };
  }
  this->pieces.push_back(makePiece(this->curves, chain, curve, parameters));
  const CurvePiece& piece = this->pieces.back();
  if (!chain.isClosed)
  {
    // As in CurvePieces: where several join two corners, only an edge of the input is one later.
    const auto [found, isFirst] = this->betweenCorners.emplace(
      sortedIds(piece.ends[0], piece.ends[1]), number);
    const bool wasEdge = !isFirst && found->second != None && this->pieces[found->second].isEdge;
    found->second = isFirst || piece.isEdge ? number : wasEdge ? found->second : None;
  }
}

std::string WholeBoundary::make(LineNetwork& boundary, const LineNetwork* given,
  const CurveOptions& options, double size, std::vector<PlaceOnPiece>& places)
{
  places.assign(boundary.points.size(), PlaceOnPiece());
  std::string error;
  if (!given)
  {
    markAllCorners(boundary, options);
    for (const LineChain& chain : chains(boundary))
    {
      this->curves.push_back(curveOf(boundary, chain, options.splines));
      this->add(chain, static_cast<Index>(this->curves.size()) - 1,
        parametersOf(this->curves.back(), chain), places);
    }
    return error;
  }
  LineNetwork geometry = *given;
  this->curves = curvesOf(geometry, options);
  const double tolerance = Tolerance * size;
  error = matchCorners(geometry, tolerance, boundary);
  markCorners(boundary, TurnsNever);
  const Curves all(this->curves);
  for (const LineChain& chain : chains(boundary))
  {
    PlacedChain placed;
    error = error.empty() ? placeOn(all, boundary, chain, tolerance, placed) : error;
    if (error.empty())
    {
      this->add(chain, placed.curve, placed.parameters, places);
    }
  }
  return error;
}

Index WholeBoundary::find(
  const PartOfBoundary& part, const LineChain& chain, std::vector<double>& s) const
{
  Index k = None;
  s.clear();
  for (Index p : chain.points)
  {
    const PlaceOnPiece& place = part.places[p];
    s.push_back(place.parameter);
    // Pieces end at corners, and so do chains.
    k = place.piece != None ? place.piece : k;
  }
  const Index front = part.corners[chain.points.front()], back = part.corners[chain.points.back()];
  if (k == None && front != None && back != None && chain.points.size() == 2)
  {
    const auto found = this->betweenCorners.find(sortedIds(front, back));
    k = found != this->betweenCorners.end() ? found->second : None;
  }
  if (k == None)
  {
    return None;
  }
  const CurvePiece& piece = this->pieces[k];
  for (std::size_t i = 1; i < s.size() && piece.period > 0.0; ++i)
  {
    s[i] += std::round((s[i - 1] - s[i]) / piece.period) * piece.period;
  }
  // Corners: the end of the piece, or, where it begins and ends in the same, the one from which the
  // chain goes on as it goes later.
  const bool isLoop = piece.ends[0] == piece.ends[1];
  const std::size_t last = s.size() - 1;
  const bool isKnown = !isLoop || (last > 2 && front != None && back != None) ||
    (last > 1 && (front == None || back == None));
  const std::size_t inner = front != None ? 1 : 0; // two points in a row that are no corners
  const bool rises = last > 1 && s[inner + 1] > s[inner];
  for (const auto& [corner, i] : { std::pair{ front, std::size_t(0) }, std::pair{ back, last } })
  {
    if (corner != None && piece.period == 0.0)
    {
      const bool isLow = isLoop ? (piece.range[0] < piece.range[1]) == (rises == (i == 0))
                                : corner == piece.ends[0];
      s[i] = piece.range[isLow ? 0 : 1];
      k = isKnown && (corner == piece.ends[0] || corner == piece.ends[1]) ? k : None;
    }
  }
  const double direction = s.back() > s.front() ? 1.0 : -1.0;
  for (std::size_t i = 1; i < s.size() && !(chain.isClosed && s.size() < 4); ++i)
  {
    k = direction * (s[i] - s[i - 1]) > 0.0 ? k : None;
  }
  return k;
}
}
