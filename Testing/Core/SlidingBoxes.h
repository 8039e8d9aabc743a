// SPDX-License-Identifier: BSD-3-Clause
// Bodies for tests of surfaces that take part: their nodes are displaced on the surface, too.
#ifndef meshopt_Testing_SlidingBoxes_h
#define meshopt_Testing_SlidingBoxes_h

#include "Surface/SlidingSurface.h"
#include "TestBench.h"
#include "TestMeshes.h"

#include <Eigen/Geometry>

namespace meshopt
{
/// The unit cube; its points are displaced inside, in its faces and along its edges.
inline MeshInput<3> slidingBox(int n, double jitter, unsigned seed = 1)
{
  MeshInput<3> in = jitteredGrid<3>(n, jitter, seed);
  TestRandom random(seed + 100);
  for (Vec<3>& x : in.points)
  {
    const Vec<3> at = x;
    const bool isInside = (at.array() > 0.0).all() && (at.array() < 1.0).all();
    for (int d = 0; d < 3 && !isInside; ++d)
    {
      const double move = jitter / n * random();
      x[d] += at[d] > 0.0 && at[d] < 1.0 ? move : 0.0;
    }
  }
  return in;
}

/// Turned about an oblique axis: coordinates are rounded, and no face is exactly flat.
inline void turn(MeshInput<3>& in)
{
  const Eigen::AngleAxisd rotation(0.7, Eigen::Vector3d(1.0, 2.0, 3.0).normalized());
  for (Vec<3>& x : in.points)
  {
    x = rotation * x + Vec<3>(0.3, -0.2, 5.0);
  }
}

/// The cube bent to a quarter of a tube: its faces z = 0 and z = 1 are cylinders of radius 1 and 2.
inline void bend(MeshInput<3>& in)
{
  for (Vec<3>& x : in.points)
  {
    const double angle = 1.5707963267948966 * x[0], radius = 1.0 + x[2];
    x = Vec<3>(radius * std::cos(angle), x[1], radius * std::sin(angle));
  }
}

/// A gear of as many teeth, each three cells between the axis and a facet of its outline. Its
/// ridges lie close to each other and go from one face to the other.
inline MeshInput<3> gear(int teeth, double thickness)
{
  MeshInput<3> in;
  in.points = { { 0, 0, 0 }, { 0, 0, thickness } };
  const Index n = 2 * teeth;
  for (Index k = 0; k < n; ++k)
  {
    const double angle = 2.0 * std::acos(-1.0) * k / n, radius = k % 2 ? 1.0 : 0.9;
    in.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    in.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), thickness);
  }
  for (Index k = 0; k < n; ++k)
  {
    const Index a = 2 + 2 * k, b = 2 + 2 * ((k + 1) % n);
    in.cells.push_back({ 0, a, b, 1 });
    in.cells.push_back({ a, b, 1, a + 1 });
    in.cells.push_back({ b, 1, a + 1, b + 1 });
  }
  return in;
}

inline SurfaceOptions tolerance(double length)
{
  SurfaceOptions options;
  options.tolerance = length;
  return options;
}

/// A mesh with its surface.
struct Sliding
{
  Sliding(const MeshInput<3>& in, const SurfaceOptions& options)
    : mesh(buildMesh(in))
    , editor(mesh)
  {
    this->surface.build(this->editor, options);
  }
  int count(Freedom freedom) const
  {
    return static_cast<int>(
      std::count(this->surface.freedom().begin(), this->surface.freedom().end(), freedom));
  }

  SimplexMesh<3> mesh;
  MeshEditor<3> editor;
  SlidingSurface surface;
};

/// All kept facets of the mesh, each once, by coordinates.
inline std::vector<std::array<Vec<3>, 3>> surfaceOf(const SimplexMesh<3>& mesh)
{
  std::vector<std::array<Vec<3>, 3>> facets;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i < 4 && mesh.isAlive(c); ++i)
    {
      if (mesh.isKept(c, i) && mesh.adjacent(c, i) < mesh.handle(c, i))
      {
        const Facet<3> f = mesh.facet(c, i);
        facets.push_back({ mesh.point(f[0]), mesh.point(f[1]), mesh.point(f[2]) });
      }
    }
  }
  return facets;
}

/// Distance of a point to a triangle, by trying its interior, its edges and its corners.
inline double distanceTo(const std::array<Vec<3>, 3>& t, const Vec<3>& x)
{
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i)
  {
    const Vec<3>&a = t[i], &b = t[(i + 1) % 3];
    const Vec<3> d = b - a;
    const double s = std::clamp((x - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
    best = std::min(best, (a + s * d - x).norm());
  }
  const Vec<3> n = (t[1] - t[0]).cross(t[2] - t[0]);
  bool isAbove = true;
  for (int i = 0; i < 3; ++i)
  {
    isAbove = isAbove && (t[(i + 1) % 3] - t[i]).cross(x - t[i]).dot(n) >= 0.0;
  }
  return isAbove ? std::min(best, std::fabs(n.dot(x - t[0])) / n.norm()) : best;
}

/// Brute force: the greatest distance of sampled points of one surface from the other.
inline double sampledDistance(const std::vector<std::array<Vec<3>, 3>>& from,
  const std::vector<std::array<Vec<3>, 3>>& to, int samples)
{
  double worst = 0.0;
  for (const std::array<Vec<3>, 3>& t : from)
  {
    for (int i = 0; i <= samples; ++i)
    {
      for (int j = 0; i + j <= samples; ++j)
      {
        const Vec<3> x = (i * t[0] + j * t[1] + (samples - i - j) * t[2]) / double(samples);
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < to.size() && nearest > worst; ++k)
        {
          nearest = std::min(nearest, distanceTo(to[k], x));
        }
        worst = std::max(worst, nearest);
      }
    }
  }
  return worst;
}
}

#endif
