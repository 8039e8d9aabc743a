// SPDX-License-Identifier: BSD-3-Clause
// Meshes in the plane with corners, holes, slits and interfaces, for tests of what the boundary may
// do.
#ifndef meshopt_Testing_PlaneMeshes_h
#define meshopt_Testing_PlaneMeshes_h

#include "Mesh/SimplexGeometry.h"
#include "Surface/BoundaryCurves.h"
#include "TestMeshes.h"

#include <functional>
#include <map>

namespace meshopt
{
inline CurveOptions curveOptions(double cornerAngle, bool splines)
{
  CurveOptions result;
  result.cornerAngle = cornerAngle;
  result.splines = splines;
  return result;
}

inline Vec<2> onCircle(double turns, double radius = 1.0)
{
  return Vec<2>(radius * std::cos(2.0 * Pi * turns), radius * std::sin(2.0 * Pi * turns));
}

inline MeshInput<2> twoTriangles() { return jitteredGrid<2>(1, 0.0); }

/// A polygon around its last point, of which every corner is seen.
inline MeshInput<2> fan(std::vector<Vec<2>> polygon, const Vec<2>& centre)
{
  MeshInput<2> in;
  const Index n = static_cast<Index>(polygon.size());
  in.points = std::move(polygon);
  in.points.push_back(centre);
  for (Index k = 0; k < n; ++k)
  {
    in.cells.push_back({ k, (k + 1) % n, n });
  }
  return in;
}

inline std::vector<Vec<2>> circle(int n, double radius = 1.0, double shift = 0.0)
{
  std::vector<Vec<2>> points;
  for (int k = 0; k < n; ++k)
  {
    points.push_back(onCircle((k + shift) / n, radius));
  }
  return points;
}

inline MeshInput<2> disc(int n, double radius = 1.0)
{
  return fan(circle(n, radius), Vec<2>::Zero());
}

/// The ring between two circles of n points each.
inline MeshInput<2> ring(int n, double inner, double outer)
{
  MeshInput<2> in;
  in.points = circle(n, inner);
  const std::vector<Vec<2>> more = circle(n, outer);
  in.points.insert(in.points.end(), more.begin(), more.end());
  for (Index k = 0; k < n; ++k)
  {
    const Index next = (k + 1) % n;
    in.cells.push_back({ k, n + k, n + next });
    in.cells.push_back({ k, n + next, next });
  }
  return in;
}

/// The unit square without its upper right quarter.
inline MeshInput<2> bracket(int n)
{
  MeshInput<2> in = jitteredGrid<2>(n, 0.0);
  std::vector<Simplex<2>> cells;
  for (const Simplex<2>& c : in.cells)
  {
    const Vec<2> middle = (in.points[c[0]] + in.points[c[1]] + in.points[c[2]]) / 3.0;
    if (middle[0] < 0.5 || middle[1] < 0.5)
    {
      cells.push_back(c);
    }
  }
  in.cells = cells;
  return in;
}

/// The unit square with a slit from x = `from` to x = `to` at half its height: points on it but for
/// its tips are there twice. Where it begins at the side of the square that is its mouth, no tip.
inline MeshInput<2> slitSquare(int n, double from, double to)
{
  MeshInput<2> in = jitteredGrid<2>(n, 0.0);
  std::map<Index, Index> twin;
  const std::size_t points = in.points.size();
  for (std::size_t p = 0; p < points; ++p)
  {
    const Vec<2> x = in.points[p];
    if (x[1] == 0.5 && (x[0] > from || x[0] == 0.0) && x[0] < to && x[0] >= from)
    {
      twin[static_cast<Index>(p)] = static_cast<Index>(in.points.size());
      in.points.push_back(x);
    }
  }
  for (Simplex<2>& c : in.cells)
  {
    const double y = (in.points[c[0]][1] + in.points[c[1]][1] + in.points[c[2]][1]) / 3.0;
    for (Index& p : c)
    {
      const auto found = twin.find(p);
      p = y > 0.5 && found != twin.end() ? found->second : p;
    }
  }
  return in;
}

/// The unit square, x bent such that the line x = 1/2 is a sine of amplitude .1; two regions.
inline MeshInput<2> curvedInterface(int n)
{
  MeshInput<2> in = jitteredGrid<2>(n, 0.0);
  splitRegions(in);
  for (Vec<2>& x : in.points)
  {
    x[0] += 0.4 * x[0] * (1.0 - x[0]) * std::sin(2.0 * Pi * x[1]);
  }
  return in;
}

/// A polygon as lines; closed.
inline LineNetwork loop(const std::vector<Vec<2>>& points)
{
  LineNetwork network;
  network.points = points;
  const Index n = static_cast<Index>(points.size());
  for (Index k = 0; k < n; ++k)
  {
    network.lines.push_back({ k, (k + 1) % n });
  }
  return network;
}

/// Area of each region.
inline std::map<Index, double> regionAreas(const SimplexMesh<2>& mesh)
{
  std::map<Index, double> areas;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    if (mesh.isAlive(c))
    {
      areas[mesh.region(c)] += signedVolume(mesh.corners(c));
    }
  }
  return areas;
}

/// Calls f(cell, facet) for every kept facet; interfaces from both sides.
template <class F>
void forKeptFacets(const SimplexMesh<2>& mesh, F&& f)
{
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i < 3 && mesh.isAlive(c); ++i)
    {
      if (mesh.isKept(c, i))
      {
        f(c, i);
      }
    }
  }
}

/// Points with a place on a curve.
inline std::vector<Index> slidingPoints(const SimplexMesh<2>& mesh)
{
  std::vector<Index> points;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    if (mesh.isPointAlive(p) && mesh.freedom(p) == Freedom::Curve)
    {
      points.push_back(p);
    }
  }
  return points;
}

/// Each sliding point lies where its place says, and every kept facet but those between two corners
/// that several pieces join is on a piece, if changes there are not refused.
inline void expectOnCurves(
  const SimplexMesh<2>& mesh, const BoundaryCurves& curves, double tolerance)
{
  for (Index p : slidingPoints(mesh))
  {
    const Place place = mesh.place(p);
    EXPECT_LE((curves.at(place.part, place.parameter) - mesh.point(p)).norm(), tolerance)
      << "point " << p;
  }
  forKeptFacets(mesh,
    [&](Index c, int i)
    {
      const Facet<2> f = mesh.facet(c, i);
      const auto span = curves.span(mesh, f[0], f[1]);
      if (span)
      {
        EXPECT_LE((curves.at(span->part, span->from) - mesh.point(f[0])).norm(), tolerance);
        EXPECT_LE((curves.at(span->part, span->to) - mesh.point(f[1])).norm(), tolerance);
      }
      else
      {
        EXPECT_TRUE(curves.isRefused(mesh, f[0], f[1]) ||
          (mesh.place(f[0]).part == None && mesh.place(f[1]).part == None))
          << f[0] << " " << f[1];
      }
    });
}
}

#endif
