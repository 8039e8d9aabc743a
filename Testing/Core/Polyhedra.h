// SPDX-License-Identifier: BSD-3-Clause
// Regular polygons and polyhedra filled from one of their corners: their best fillings are known.
#ifndef meshopt_Testing_Polyhedra_h
#define meshopt_Testing_Polyhedra_h

#include "Quality/Shape.h"
#include "TestMeshes.h"

namespace meshopt
{
/// The corners of a regular hexagon (D = 2) or icosahedron (D = 3) of radius 1.
template <int D>
std::vector<Vec<D>> regularPoints()
{
  std::vector<Vec<D>> points;
  if constexpr (D == 2)
  {
    for (int k = 0; k < 6; ++k)
    {
      points.emplace_back(std::cos(k * M_PI / 3.0), std::sin(k * M_PI / 3.0));
    }
  }
  else
  {
    const double golden = 0.5 * (1.0 + std::sqrt(5.0));
    for (double one : { -1.0, 1.0 })
    {
      for (double phi : { -golden, golden })
      {
        points.push_back(Vec<3>(0.0, one, phi).normalized());
        points.push_back(Vec<3>(one, phi, 0.0).normalized());
        points.push_back(Vec<3>(phi, 0.0, one).normalized());
      }
    }
  }
  return points;
}

/// Length of the edges of these.
template <int D>
double regularEdge()
{
  return D == 2 ? 1.0 : 4.0 / std::sqrt(10.0 + 2.0 * std::sqrt(5.0));
}

/// Facets: all points that are an edge from each other.
template <int D>
std::vector<Facet<D>> regularFacets(const std::vector<Vec<D>>& points)
{
  const auto isEdge = [&](Index a, Index b)
  { return std::fabs((points[a] - points[b]).norm() - regularEdge<D>()) < 1e-9; };
  std::vector<Facet<D>> facets;
  const Index n = static_cast<Index>(points.size());
  for (Index a = 0; a < n; ++a)
  {
    for (Index b = a + 1; b < n; ++b)
    {
      if constexpr (D == 2)
      {
        if (isEdge(a, b))
        {
          facets.push_back({ a, b });
        }
      }
      for (Index c = b + 1; D == 3 && c < n; ++c)
      {
        if (isEdge(a, b) && isEdge(b, c) && isEdge(a, c))
        {
          Facet<D> f{};
          f[0] = a;
          f[1] = b;
          f[D - 1] = c;
          facets.push_back(f);
        }
      }
    }
  }
  return facets;
}

/// All cells meet in point 0: 4 triangles, 15 tetrahedra.
template <int D>
MeshInput<D> fromOneCorner()
{
  MeshInput<D> in;
  in.points = regularPoints<D>();
  for (const Facet<D>& f : regularFacets<D>(in.points))
  {
    if (std::find(f.begin(), f.end(), 0) != f.end())
    {
      continue;
    }
    Simplex<D> cell;
    std::copy(f.begin(), f.end(), cell.begin());
    cell[D] = 0;
    Corners<D> x;
    for (int i = 0; i <= D; ++i)
    {
      x[i] = in.points[cell[i]];
    }
    if (signedVolume(x) < 0.0)
    {
      std::swap(cell[0], cell[1]);
    }
    in.cells.push_back(cell);
  }
  return in;
}

/// Shape of the cells that join the middle to the facets: regular triangles; nearly regular
/// tetrahedra, whose volumes are a twentieth of 5 / 12 (3 + sqrt(5)) edge^3.
template <int D>
double shapeOfRegularCone()
{
  const double a = regularEdge<D>();
  const double volume = D == 2 ? std::sqrt(0.1875) : (3.0 + std::sqrt(5.0)) * a * a * a / 48.0;
  const double regular = D == 2 ? std::sqrt(0.1875) : std::sqrt(1.0 / 72.0);
  return volume / regular / std::pow(0.5 * (a + 1.0), D);
}
}

#endif
