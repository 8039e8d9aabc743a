// SPDX-License-Identifier: BSD-3-Clause
// Checks a surface before TetGen sees it, so that the user reads where it is wrong instead of how
// TetGen failed. How it is read stands in vtkTetGenSurfaceRead.cxx.
#include "vtkTetGenSurface.h"

#include "vtkCellArray.h"
#include "vtkGenericCell.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStaticCellLocator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

namespace vtkTetGenBridge
{

namespace
{

using Triangle = std::array<int, 3>;
using Edge = std::array<int, 2>;

/// A triangle whose height is below this fraction of its longest edge has no area.
constexpr double Flat = 1e-14;
/// Points nearer than this fraction of the box's diagonal are on the surface: TetGen's own
/// tolerance.
constexpr double OnSurface = 1e-8;

const double* At(const Surface& surface, int point)
{
  return surface.Points.data() + 3 * static_cast<std::size_t>(point);
}

std::string Coordinates(const double* x)
{
  std::ostringstream text;
  text.precision(8);
  text << "(" << x[0] << ", " << x[1] << ", " << x[2] << ")";
  return text.str();
}

/**
 * With the id that the user knows, and the place.
 */
std::string DescribePoint(const Surface& surface, int point)
{
  return "point " + std::to_string(surface.PointIds[point]) + " " + Coordinates(At(surface, point));
}

// A copy: callers sort it.
Triangle TriangleAt(const Surface& surface, int triangle)
{
  Triangle t;
  std::copy_n(surface.Triangles.begin() + 3 * static_cast<std::ptrdiff_t>(triangle), 3, t.begin());
  return t;
}

int NumberOfTriangles(const Surface& surface)
{
  return static_cast<int>(surface.Triangles.size() / 3);
}

//------------------------------------------------------------------------------
/**
 * TetGen cannot start from points in one plane.
 */
std::string CheckCoordinates(const Surface& surface)
{
  double lower[3], upper[3];
  std::fill_n(lower, 3, std::numeric_limits<double>::infinity());
  std::fill_n(upper, 3, -std::numeric_limits<double>::infinity());
  for (std::size_t p = 0; p < surface.PointIds.size(); ++p)
  {
    const double* x = At(surface, static_cast<int>(p));
    if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
    {
      return "Coordinates that are not finite: " + DescribePoint(surface, static_cast<int>(p)) +
        ".";
    }
    for (int i = 0; i < 3; ++i)
    {
      lower[i] = std::min(lower[i], x[i]);
      upper[i] = std::max(upper[i], x[i]);
    }
  }
  // Flat along an axis only: a tilted plane does not show here.
  for (int i = 0; i < 3; ++i)
  {
    if (lower[i] == upper[i])
    {
      return std::string("The surface is flat: ") + "xyz"[i] + " is " + std::to_string(lower[i]) +
        " everywhere. It must enclose a volume.";
    }
  }
  return {};
}

/**
 * Sorted by place: points at the same place stand together. Of several pairs the one with the
 * lowest id is named.
 */
std::string CheckDuplicatePoints(const Surface& surface)
{
  std::vector<int> order(surface.PointIds.size());
  std::iota(order.begin(), order.end(), 0);
  const auto compare = [&](int a, int b)
  {
    return std::lexicographical_compare(
      At(surface, a), At(surface, a) + 3, At(surface, b), At(surface, b) + 3);
  };
  // Ties by id: the first of each group is then the lowest, whatever the library does with equals.
  std::sort(order.begin(), order.end(),
    [&](int a, int b) { return compare(a, b) || (!compare(b, a) && a < b); });
  int pairs = 0;
  std::array<int, 2> first{ { -1, -1 } };
  for (std::size_t i = 1; i < order.size(); ++i)
  {
    if (!compare(order[i - 1], order[i]))
    {
      first = pairs++ == 0 || order[i - 1] < first[0]
        ? std::array<int, 2>{ { order[i - 1], order[i] } }
        : first;
    }
  }
  return pairs == 0 ? ""
                    : "Points of the surface lie on each other (" + std::to_string(pairs) +
      " times), the first: " + DescribePoint(surface, first[0]) + " and point " +
      std::to_string(surface.PointIds[first[1]]) + ". Merge them first (Clean, vtkCleanPolyData).";
}

double Distance2(const double* a, const double* b)
{
  return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
    (a[2] - b[2]) * (a[2] - b[2]);
}

bool HasArea(const Surface& surface, const Triangle& t)
{
  const double *a = At(surface, t[0]), *b = At(surface, t[1]), *c = At(surface, t[2]);
  const double u[3] = { b[0] - a[0], b[1] - a[1], b[2] - a[2] };
  const double v[3] = { c[0] - a[0], c[1] - a[1], c[2] - a[2] };
  const double n[3] = { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
    u[0] * v[1] - u[1] * v[0] };
  // Relative to the longest edge, so that the test does not depend on units.
  const double longest2 = std::max({ Distance2(a, b), Distance2(b, c), Distance2(c, a) });
  return std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) > Flat * longest2;
}

/**
 * Sorted by their points, equal facets stand together.
 */
std::string CheckTriangles(const Surface& surface)
{
  // With sorted corners a facet is the same one from either side.
  std::vector<std::pair<Triangle, int>> sorted;
  for (int i = 0; i < NumberOfTriangles(surface); ++i)
  {
    Triangle t = TriangleAt(surface, i);
    if (!HasArea(surface, t))
    {
      return "A facet of the surface has no area: " + DescribeTriangle(surface, i) + ".";
    }
    std::sort(t.begin(), t.end());
    sorted.emplace_back(t, i);
  }
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 1; i < sorted.size(); ++i)
  {
    if (sorted[i].first == sorted[i - 1].first)
    {
      return "A facet of the surface is there twice: " +
        DescribeTriangle(surface, sorted[i - 1].second) + " and cell " +
        std::to_string(surface.CellIds[sorted[i].second]) + ".";
    }
  }
  return {};
}

/**
 * Every edge must have facets on two sides, or the inside would leak out.
 */
std::string CheckClosed(const Surface& surface)
{
  // An edge once for each of its facets; sorted, these stand together.
  std::vector<std::pair<Edge, int>> edges;
  edges.reserve(surface.Triangles.size());
  for (int i = 0; i < NumberOfTriangles(surface); ++i)
  {
    const Triangle t = TriangleAt(surface, i);
    for (int k = 0; k < 3; ++k)
    {
      const int a = t[k], b = t[(k + 1) % 3];
      edges.emplace_back(Edge{ { std::min(a, b), std::max(a, b) } }, i);
    }
  }
  std::sort(edges.begin(), edges.end());
  int open = 0;
  std::size_t first = 0;
  for (std::size_t i = 0, next; i < edges.size(); i = next)
  {
    for (next = i + 1; next < edges.size() && edges[next].first == edges[i].first; ++next)
    {
    }
    // Three and more facets at an edge are no fault: walls between compartments meet the hull so.
    if (next - i == 1)
    {
      first = open++ == 0 ? i : first;
    }
  }
  if (open == 0)
  {
    return {};
  }
  const Edge e = edges[first].first;
  return "The surface is not closed: " + std::to_string(open) +
    " edges have a facet on one side only, the first from " + DescribePoint(surface, e[0]) +
    " to " + DescribePoint(surface, e[1]) + ", of cell " +
    std::to_string(surface.CellIds[edges[first].second]) + ".";
}

} // namespace

//------------------------------------------------------------------------------
std::string CheckSurface(const Surface& surface)
{
  // Coordinates first: all others compute with them. Then points that lie on each other, the usual
  // reason of open edges.
  for (const auto check : { CheckCoordinates, CheckDuplicatePoints, CheckTriangles, CheckClosed })
  {
    const std::string error = check(surface);
    if (!error.empty())
    {
      return error;
    }
  }
  return {};
}

std::vector<double> PointsOffSurface(const Surface& surface, const std::vector<double>& points)
{
  vtkNew<vtkPoints> corners;
  // Rounded to floats, the surface would move by more than the tolerance.
  corners->SetDataTypeToDouble();
  for (std::size_t p = 0; p < surface.PointIds.size(); ++p)
  {
    corners->InsertNextPoint(At(surface, static_cast<int>(p)));
  }
  vtkNew<vtkCellArray> triangles;
  for (int i = 0; i < NumberOfTriangles(surface); ++i)
  {
    const Triangle t = TriangleAt(surface, i);
    triangles->InsertNextCell({ t[0], t[1], t[2] });
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(corners);
  data->SetPolys(triangles);
  // A search tree, since there may be many points and many triangles.
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(data);
  locator->BuildLocator();
  // Relative to the box, as TetGen's tolerance is.
  const double tolerance2 = std::pow(OnSurface * data->GetLength(), 2);
  std::vector<double> off;
  vtkNew<vtkGenericCell> cell;
  for (std::size_t i = 0; i < points.size(); i += 3)
  {
    const double x[3] = { points[i], points[i + 1], points[i + 2] };
    double closest[3], distance2 = 0.0;
    vtkIdType cellId;
    int subId;
    locator->FindClosestPoint(x, closest, cell, cellId, subId, distance2);
    // A point on the surface would divide one of its triangles.
    if (distance2 > tolerance2)
    {
      off.insert(off.end(), x, x + 3);
    }
  }
  return off;
}

//------------------------------------------------------------------------------
std::string DescribeTriangle(const Surface& surface, int triangle)
{
  const Triangle t = TriangleAt(surface, triangle);
  double centre[3] = { 0.0, 0.0, 0.0 };
  std::string ids;
  for (const int p : t)
  {
    for (int i = 0; i < 3; ++i)
    {
      centre[i] += At(surface, p)[i] / 3.0;
    }
    // By the ids of the input: TetGen's own leave out unused points.
    ids += (ids.empty() ? "" : ", ") + std::to_string(surface.PointIds[p]);
  }
  return "cell " + std::to_string(surface.CellIds[triangle]) + " (points " + ids + " around " +
    Coordinates(centre) + ")";
}

std::vector<std::pair<int, int>> ParseIntersections(const std::string& text)
{
  // Lines of TetGen: "  Facet #41 intersects facet #50 at triangles:",
  // "  Facet #1 duplicates facet #49 ..."
  // Both kinds of fault have this form, whatever the verb.
  std::vector<std::pair<int, int>> pairs;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
  {
    int a = 0, b = 0;
    char verb[16];
    if (std::sscanf(line.c_str(), " Facet #%d %15s facet #%d", &a, verb, &b) == 3)
    {
      pairs.emplace_back(std::min(a, b) - 1, std::max(a, b) - 1); // markers count from 1
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

std::string DescribeIntersections(
  const Surface& surface, const std::vector<std::pair<int, int>>& pairs)
{
  // A surface that is wrong once is often wrong in many places: a few show which kind it is.
  constexpr std::size_t shown = 3;
  std::string text = "The surface intersects itself: " + std::to_string(pairs.size()) +
    " pairs of facets meet elsewhere than in common edges and points";
  for (std::size_t i = 0; i < std::min(shown, pairs.size()); ++i)
  {
    text += (i == 0 ? ": " : "; ") + DescribeTriangle(surface, pairs[i].first) + " and " +
      DescribeTriangle(surface, pairs[i].second);
  }
  return text + (pairs.size() > shown ? "; ..." : ".");
}

/**
 * Compared as sorted triples: the mesh numbers its faces in another order. TetGen may cut a facet
 * without an error.
 */
int FindLostTriangle(const Surface& surface, const std::vector<int>& tetrahedra)
{
  std::vector<Triangle> faces;
  faces.reserve(tetrahedra.size());
  const int corners = static_cast<int>(surface.PointIds.size());
  for (std::size_t t = 0; t < tetrahedra.size(); t += 4)
  {
    for (std::size_t leftOut = 0; leftOut < 4; ++leftOut)
    {
      Triangle face;
      int n = 0;
      for (std::size_t i = 0; i < 4; ++i)
      {
        if (i != leftOut)
        {
          face[n++] = tetrahedra[t + i];
        }
      }
      std::sort(face.begin(), face.end());
      if (face[2] < corners) // otherwise not of the surface
      {
        faces.push_back(face);
      }
    }
  }
  std::sort(faces.begin(), faces.end());
  for (int i = 0; i < NumberOfTriangles(surface); ++i)
  {
    Triangle t = TriangleAt(surface, i);
    std::sort(t.begin(), t.end());
    if (!std::binary_search(faces.begin(), faces.end(), t))
    {
      return i;
    }
  }
  return -1;
}

} // namespace vtkTetGenBridge
