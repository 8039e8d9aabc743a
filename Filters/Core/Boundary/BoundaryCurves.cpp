// SPDX-License-Identifier: BSD-3-Clause
#include "Boundary/BoundaryCurves.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace meshopt
{
namespace
{
constexpr double Tolerance = 1e-3; ///< of the diagonal of the mesh
constexpr double FarthestNeighbours = 0.4; ///< of a closed curve
/// A line that is so much shorter than the next one has no direction: its ends are corners.
constexpr double NoLength = 1e-9;
/// Degrees. Where a line turns by more it goes back, as at the tip of a slit: always a corner.
constexpr double TurnsBack = 179.0;

/// Radians: what turns less is taken for smooth. And how much of the turn of a point a neighbour of it
/// must turn, at least, if both are to be on a curve.
constexpr double LeastKink = 0.17, KinkShare = 0.25;

using Lines = std::vector<std::vector<Index>>;

/// The lines at each point.
Lines linesOfPoints(const LineNetwork& network)
{
  Lines lines(network.points.size());
  for (std::size_t l = 0; l < network.lines.size(); ++l)
  {
    for (Index p : network.lines[l])
    {
      lines[p].push_back(static_cast<Index>(l));
    }
  }
  return lines;
}

Index otherEnd(const LineNetwork& network, Index line, Index p)
{
  const std::array<Index, 2>& l = network.lines[line];
  return l[0] == p ? l[1] : l[0];
}

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

/// See PlaneCurve::mostCurvedSegment(): that of a circle whose polygon turns by `angle`, and some more.
double greatestShare(double angle)
{
  constexpr double margin = 1.2;
  return margin * 0.5 * std::tan(angle / 4.0 * std::acos(-1.0) / 180.0);
}

std::string nameOf(const char* what, Index p, const Vec<2>& x)
{
  std::ostringstream text;
  text << what << ' ' << p << " (" << x[0] << ", " << x[1] << ")";
  return text.str();
}
}

/// All kept facets, each once.
LineNetwork BoundaryCurves::network(const SimplexMesh<2>& mesh)
{
  LineNetwork result;
  result.points.resize(mesh.numberOfPointSlots());
  result.corners.assign(mesh.numberOfPointSlots(), 0);
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    result.points[p] = mesh.point(p);
    result.corners[p] = (mesh.pointData(p).flags & SimplexMesh<2>::PointFixedByUser) != 0;
  }
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i < 3 && mesh.isAlive(c); ++i)
    {
      const Index h = mesh.adjacent(c, i);
      if (mesh.isConstrained(c, i) && (h == None || mesh.cellOf(h) > c))
      {
        result.lines.push_back(mesh.facet(c, i));
      }
    }
  }
  return result;
}

void BoundaryCurves::markCorners(LineNetwork& network, double cornerAngle)
{
  const Lines lines = linesOfPoints(network);
  network.corners.resize(network.points.size(), 0);
  const double limit = std::cos(std::min(cornerAngle, TurnsBack) * std::acos(-1.0) / 180.0);
  for (std::size_t p = 0; p < lines.size(); ++p)
  {
    if (lines[p].empty())
    {
      continue;
    }
    bool isCorner = lines[p].size() != 2;
    if (!isCorner)
    {
      const Index id = static_cast<Index>(p);
      const Vec<2> in = network.points[p] - network.points[otherEnd(network, lines[p][0], id)];
      const Vec<2> out = network.points[otherEnd(network, lines[p][1], id)] - network.points[p];
      const double a = in.norm(), b = out.norm();
      isCorner = !(in.dot(out) >= limit * a * b) || std::min(a, b) <= NoLength * std::max(a, b);
    }
    network.corners[p] = network.corners[p] || isCorner;
  }
}

std::vector<BoundaryCurves::Chain> BoundaryCurves::chains(const LineNetwork& network)
{
  const Lines lines = linesOfPoints(network);
  std::vector<char> seen(network.lines.size(), 0);
  std::vector<Chain> result;
  const auto follow = [&](Index start, Index line)
  {
    Chain chain;
    chain.points.push_back(start);
    for (Index p = start; !seen[line];)
    {
      seen[line] = 1;
      p = otherEnd(network, line, p);
      chain.points.push_back(p);
      if (network.corners[p] || p == start)
      {
        break;
      }
      line = lines[p][0] == line ? lines[p][1] : lines[p][0];
    }
    if (!network.corners[start]) // came back to where it began
    {
      chain.isClosed = true;
      chain.points.pop_back();
    }
    result.push_back(std::move(chain));
  };
  for (const bool fromCorners : { true, false })
  {
    for (std::size_t p = 0; p < lines.size(); ++p)
    {
      for (Index line : lines[p])
      {
        if (!seen[line] && (network.corners[p] != 0) == fromCorners)
        {
          follow(static_cast<Index>(p), line);
        }
      }
    }
  }
  return result;
}

PlaneCurve BoundaryCurves::curve(
  const LineNetwork& network, const Chain& chain, bool splines) const
{
  std::vector<Vec<2>> points;
  for (Index p : chain.points)
  {
    points.push_back(network.points[p]);
  }
  return PlaneCurve(std::move(points), chain.isClosed, splines);
}

/// A point where the line turns while it does not at the neighbours is no sample of a curve, but a
/// corner that is not very sharp.
void BoundaryCurves::markKinks(LineNetwork& network)
{
  const Lines lines = linesOfPoints(network);
  const std::vector<std::uint8_t> corners = network.corners;
  const auto next = [&](Index from, Index p) // None beyond a corner
  {
    if (corners[p])
    {
      return None;
    }
    const Index a = otherEnd(network, lines[p][0], p);
    return a == from ? otherEnd(network, lines[p][1], p) : a;
  };
  const auto turn = [&](Index from, Index p, Index to)
  {
    if (to == None)
    {
      return 0.0;
    }
    const Vec<2> in = network.points[p] - network.points[from];
    const Vec<2> out = network.points[to] - network.points[p];
    return std::atan2(in[0] * out[1] - in[1] * out[0], in.dot(out));
  };
  for (std::size_t k = 0; k < lines.size(); ++k)
  {
    const Index p = static_cast<Index>(k);
    if (lines[k].size() != 2 || corners[k])
    {
      continue;
    }
    const Index a = otherEnd(network, lines[k][0], p), b = otherEnd(network, lines[k][1], p);
    const double here = turn(a, p, b);
    const double before = -turn(p, a, next(p, a)), after = turn(p, b, next(p, b));
    network.corners[k] = std::fabs(here) > LeastKink && !(before / here > KinkShare) &&
      !(after / here > KinkShare);
  }
}

/// A spline through a long straight side and the short ones of an arc would swing far out on the
/// long one: its ends become corners, and it stays straight.
void BoundaryCurves::markWhereSplinesOvershoot(
  LineNetwork& network, const CurveOptions& options) const
{
  for (bool again = true; again;)
  {
    again = false;
    for (const Chain& chain : chains(network))
    {
      const PlaneCurve curve = this->curve(network, chain, true);
      double share = 0.0;
      const std::size_t k = curve.mostCurvedSegment(share);
      if (share > greatestShare(options.cornerAngle))
      {
        for (std::size_t end : { k, (k + 1) % chain.points.size() })
        {
          network.corners[chain.points[end]] = 1;
        }
        again = true;
      }
    }
  }
}

void BoundaryCurves::build(MeshEditor<2>& editor, const CurveOptions& options,
  const std::vector<std::uint8_t>& corners)
{
  this->curves_.clear();
  this->pieces_.clear();
  LineNetwork boundary = network(editor.mesh());
  for (std::size_t p = 0; p < corners.size(); ++p)
  {
    boundary.corners[p] |= corners[p];
  }
  markCorners(boundary, options.cornerAngle);
  if (options.splines)
  {
    markKinks(boundary);
    this->markWhereSplinesOvershoot(boundary, options);
  }
  for (const Chain& chain : chains(boundary))
  {
    const PlaneCurve curve = this->curve(boundary, chain, options.splines);
    Piece piece;
    piece.curve = static_cast<Index>(this->curves_.size());
    const bool isClosed = chain.isClosed;
    if (!isClosed)
    {
      piece.ends = { chain.points.front(), chain.points.back() };
      piece.range = { 0.0, curve.length() };
    }
    for (std::size_t k = 0; k < chain.points.size(); ++k)
    {
      if (isClosed || (k > 0 && k + 1 < chain.points.size()))
      {
        CurvePlace<2> place;
        place.curve = static_cast<Index>(this->pieces_.size());
        place.parameter = curve.parameter(k);
        editor.setCurvePlace(chain.points[k], place);
      }
    }
    this->curves_.push_back(curve);
    this->pieces_.push_back(piece);
  }
  this->join();
}

/// Every corner of the geometry must be a point of the boundary: that is a corner then, too.
std::string BoundaryCurves::matchCorners(const SimplexMesh<2>& mesh, const LineNetwork& geometry,
  double tolerance, LineNetwork& boundary) const
{
  std::vector<Index> ends;
  for (const std::array<Index, 2>& l : boundary.lines)
  {
    ends.insert(ends.end(), l.begin(), l.end());
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  for (std::size_t g = 0; g < geometry.points.size(); ++g)
  {
    bool found = !geometry.corners[g];
    for (std::size_t k = 0; k < ends.size() && !found; ++k)
    {
      found = (mesh.point(ends[k]) - geometry.points[g]).norm() <= tolerance;
    }
    if (!found)
    {
      return "The geometry has a corner at its " +
        nameOf("point", static_cast<Index>(g), geometry.points[g]) +
        ", but the boundary of the mesh has no point there.";
    }
    for (Index p : ends) // all of them: at the mouth of a crack there are several
    {
      boundary.corners[p] |= std::uint8_t(geometry.corners[g] &&
        (mesh.point(p) - geometry.points[g]).norm() <= tolerance);
    }
  }
  return {};
}

double BoundaryCurves::period(const Piece& piece) const
{
  const PlaneCurve& curve = this->curves_[piece.curve];
  return curve.isClosed() ? curve.length() : 0.0;
}

namespace
{
/// A curve that goes from a corner around to itself has two parameters there: the middle of the edge
/// that leaves the corner tells which is the one of the end of the chain.
void tellEndsApart(const SimplexMesh<2>& mesh, const std::vector<Index>& points,
  const PlaneCurve& curve, double tolerance, std::vector<double>& s)
{
  if ((curve.at(0.0) - curve.at(curve.length())).norm() > tolerance)
  {
    return;
  }
  const std::size_t last = points.size() - 1;
  for (const auto& [end, next] : { std::pair<std::size_t, std::size_t>{ 0, 1 }, { last, last - 1 } })
  {
    const Vec<2> &x = mesh.point(points[end]), &y = mesh.point(points[next]);
    if ((x - curve.at(0.0)).norm() <= tolerance)
    {
      double d = 0.0;
      s[end] = curve.closest(Vec<2>(0.5 * (x + y)), d) < s[next] ? 0.0 : curve.length();
    }
  }
}
}

/// Puts a chain of the mesh's boundary on the curve that is nearest to it.
std::string BoundaryCurves::place(MeshEditor<2>& editor, const Chain& chain, double tolerance)
{
  const SimplexMesh<2>& mesh = editor.mesh();
  Piece piece;
  double best = std::numeric_limits<double>::infinity();
  Index farthest = None;
  for (std::size_t g = 0; g < this->curves_.size(); ++g)
  {
    double worst = 0.0;
    Index at = None;
    for (Index p : chain.points)
    {
      double d = 0.0;
      this->curves_[g].closest(mesh.point(p), d);
      if (at == None || d > worst)
      {
        worst = d;
        at = p;
      }
      if (worst > best)
      {
        break;
      }
    }
    // Two corners may be joined by several curves: the middle tells them apart.
    double middle = 0.0;
    this->curves_[g].closest(
      Vec<2>(0.5 * (mesh.point(chain.points[0]) + mesh.point(chain.points[1]))), middle);
    if (std::max(worst, tolerance) + 1e-3 * middle < best)
    {
      best = std::max(worst, tolerance) + 1e-3 * middle;
      piece.curve = static_cast<Index>(g);
      farthest = worst > tolerance ? at : None;
    }
  }
  if (piece.curve == None || farthest != None)
  {
    std::ostringstream text;
    const Index p = farthest == None ? chain.points[0] : farthest;
    double d = 0.0;
    if (piece.curve != None)
    {
      this->curves_[piece.curve].closest(mesh.point(p), d);
    }
    text << "The boundary of the mesh does not lie on the geometry: "
         << nameOf("point", p, mesh.point(p)) << " is " << d << " away from it.";
    return text.str();
  }
  const PlaneCurve& curve = this->curves_[piece.curve];
  const double period = this->period(piece);
  std::vector<double> s;
  for (Index p : chain.points)
  {
    double d = 0.0;
    s.push_back(curve.closest(mesh.point(p), d));
    if (s.size() > 1 && period > 0.0)
    {
      s.back() += std::round((s[s.size() - 2] - s.back()) / period) * period;
    }
  }
  if (!chain.isClosed && period == 0.0)
  {
    tellEndsApart(mesh, chain.points, curve, tolerance, s);
  }
  const double direction = s.back() > s.front() ? 1.0 : -1.0;
  for (std::size_t k = 1; k < s.size() && !(chain.isClosed && s.size() < 4); ++k)
  {
    if (!(direction * (s[k] - s[k - 1]) > 0.0))
    {
      return "The boundary of the mesh does not follow the geometry: it turns back at its " +
        nameOf("point", chain.points[k], mesh.point(chain.points[k])) + ".";
    }
  }
  if (!chain.isClosed)
  {
    piece.ends = { chain.points.front(), chain.points.back() };
    piece.range = { s.front(), s.back() };
  }
  for (std::size_t k = 0; k < chain.points.size(); ++k)
  {
    if (chain.isClosed || (k > 0 && k + 1 < chain.points.size()))
    {
      CurvePlace<2> place;
      place.curve = static_cast<Index>(this->pieces_.size());
      place.parameter = s[k];
      editor.setCurvePlace(chain.points[k], place);
    }
  }
  this->pieces_.push_back(piece);
  return {};
}

std::string BoundaryCurves::build(MeshEditor<2>& editor, const LineNetwork& given,
  const CurveOptions& options, const std::vector<std::uint8_t>& corners)
{
  this->curves_.clear();
  this->pieces_.clear();
  LineNetwork geometry = given;
  markCorners(geometry, options.cornerAngle);
  if (options.splines)
  {
    markKinks(geometry);
  }
  for (const Chain& chain : chains(geometry))
  {
    const PlaneCurve curve = this->curve(geometry, chain, options.splines);
    double share = 0.0;
    curve.mostCurvedSegment(share);
    const bool overshoots = share > greatestShare(options.cornerAngle);
    this->curves_.push_back(overshoots ? this->curve(geometry, chain, false) : curve);
  }
  LineNetwork boundary = network(editor.mesh());
  for (std::size_t p = 0; p < corners.size(); ++p)
  {
    boundary.corners[p] |= corners[p];
  }
  const double tolerance = Tolerance * diagonal(editor.mesh());
  std::string error = this->matchCorners(editor.mesh(), geometry, tolerance, boundary);
  markCorners(boundary, TurnsBack); // else only where not exactly two lines meet
  for (const Chain& chain : chains(boundary))
  {
    error = error.empty() ? this->place(editor, chain, tolerance) : error;
  }
  if (!error.empty())
  {
    for (Index p = 0; p < editor.mesh().numberOfPointSlots(); ++p)
    {
      editor.setCurvePlace(p, CurvePlace<2>());
    }
  }
  this->join();
  return error;
}

/// Finds the pieces by which two corners can be neighbours.
void BoundaryCurves::join()
{
  this->betweenCorners_.clear();
  for (std::size_t k = 0; k < this->pieces_.size(); ++k)
  {
    std::array<Index, 2> ends = this->pieces_[k].ends;
    std::sort(ends.begin(), ends.end());
    if (ends[0] != None && ends[0] != ends[1])
    {
      const auto [entry, isNew] = this->betweenCorners_.emplace(ends, static_cast<Index>(k));
      entry->second = isNew ? entry->second : None;
    }
  }
}

std::optional<BoundaryCurves::Span> BoundaryCurves::span(
  const SimplexMesh<2>& mesh, Index a, Index b) const
{
  const CurvePlace<2>& pa = mesh.pointData(a);
  const CurvePlace<2>& pb = mesh.pointData(b);
  if (pa.curve == None && pb.curve == None)
  {
    const auto found = this->betweenCorners_.find({ std::min(a, b), std::max(a, b) });
    if (found == this->betweenCorners_.end() || found->second == None)
    {
      return std::nullopt;
    }
    const Piece& piece = this->pieces_[found->second];
    const bool forward = piece.ends[0] == a;
    return Span{ found->second, piece.range[forward ? 0 : 1], piece.range[forward ? 1 : 0] };
  }
  const Index k = pa.curve != None ? pa.curve : pb.curve;
  const Piece& piece = this->pieces_[k];
  // Parameter of p, as seen from the neighbour at s.
  const auto parameter = [&](Index p, const CurvePlace<2>& place, double s) -> std::optional<double>
  {
    if (place.curve == k)
    {
      return place.parameter;
    }
    const bool isFirst = piece.ends[0] == p, isLast = piece.ends[1] == p;
    if (place.curve != None || (!isFirst && !isLast))
    {
      return std::nullopt;
    }
    const bool first =
      isFirst && (!isLast || std::fabs(s - piece.range[0]) < std::fabs(s - piece.range[1]));
    return piece.range[first ? 0 : 1];
  };
  const std::optional<double> from = parameter(a, pa, pb.parameter);
  const std::optional<double> to = parameter(b, pb, pa.parameter);
  if (!from || !to)
  {
    return std::nullopt;
  }
  Span span{ k, *from, *to };
  const double period = piece.ends[0] == None ? this->period(piece) : 0.0;
  if (period > 0.0)
  {
    span.to += std::round((span.from - span.to) / period) * period;
  }
  return span;
}

bool BoundaryCurves::mayBeNeighbours(const Span& s) const
{
  const Piece& piece = this->pieces_[s.piece];
  if (piece.ends[0] != piece.ends[1])
  {
    return true;
  }
  const double all =
    piece.ends[0] == None ? this->period(piece) : std::fabs(piece.range[1] - piece.range[0]);
  return std::fabs(s.to - s.from) <= FarthestNeighbours * all;
}
}
