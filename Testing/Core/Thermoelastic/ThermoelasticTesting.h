// SPDX-License-Identifier: BSD-3-Clause
// What the tests of the thermoelastic room share: meshes, exact solutions, norms of errors.
#ifndef meshopt_Testing_ThermoelasticTesting_h
#define meshopt_Testing_ThermoelasticTesting_h

#include "TestMeshes.h"
#include "Thermoelastic/Analysis.h"

#include <atomic>
#include <functional>
#include <thread>

namespace meshopt::fem
{
template <int D>
SimplexMesh<D> box(int n, double jitter, unsigned seed = 1)
{
  return buildMesh(jitteredGrid<D>(n, jitter, seed));
}

/// A disc of radius R: ring k of n has 6 k points. Triangles near to regular everywhere.
inline MeshInput<2> disc(int n, double radius)
{
  MeshInput<2> in;
  in.points.push_back(Vec<2>::Zero());
  for (int k = 1; k <= n; ++k)
  {
    for (int i = 0; i < 6 * k; ++i)
    {
      const double angle = 2.0 * M_PI * i / (6 * k), r = radius * k / n;
      in.points.push_back(Vec<2>(r * std::cos(angle), r * std::sin(angle)));
    }
  }
  const auto id = [](int k, int i) {
    return k == 0 ? 0 : 1 + 3 * k * (k - 1) + (i % (6 * k));
  }; // ring k starts after 3 k (k - 1) + 1
  for (int k = 1; k <= n; ++k)
  {
    for (int sector = 0; sector < 6; ++sector)
    {
      for (int j = 0; j < k; ++j)
      {
        const int outer = sector * k + j, inner = sector * (k - 1) + j;
        in.cells.push_back({ id(k, outer), id(k, outer + 1), id(k - 1, inner) });
        if (j < k - 1)
        {
          in.cells.push_back({ id(k, outer + 1), id(k - 1, inner + 1), id(k - 1, inner) });
        }
      }
    }
  }
  return in;
}

/// The disc in m layers up to height H; each prism as three tetrahedra, split along the paths of
/// ascending ids, so that neighbours fit.
inline MeshInput<3> cylinder(int n, int m, double radius, double height)
{
  const MeshInput<2> base = disc(n, radius);
  const Index points = static_cast<Index>(base.points.size());
  MeshInput<3> in;
  for (int k = 0; k <= m; ++k)
  {
    for (const Vec<2>& x : base.points)
    {
      in.points.push_back(Vec<3>(x[0], x[1], height * k / m));
    }
  }
  for (int k = 0; k < m; ++k)
  {
    for (Simplex<2> t : base.cells)
    {
      std::sort(t.begin(), t.end());
      const Index low = k * points, up = low + points;
      in.cells.push_back({ low + t[0], low + t[1], low + t[2], up + t[2] });
      in.cells.push_back({ low + t[0], low + t[1], up + t[1], up + t[2] });
      in.cells.push_back({ low + t[0], up + t[0], up + t[1], up + t[2] });
    }
  }
  return in;
}

/// Prescribes all components at the points of the surface: u(x).
template <int D>
void prescribeSurface(
  const SimplexMesh<D>& mesh, const std::function<Vec<D>(const Vec<D>&)>& u, Problem<D>& problem)
{
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    for (int i = 0; i < D && mesh.isBoundary(p); ++i)
    {
      problem.constraints.push_back({ p, i, u(mesh.point(p))[i] });
    }
  }
}

template <int D>
Solution<D> solveOrFail(const SimplexMesh<D>& mesh, const Problem<D>& problem,
  const AnalysisOptions& options = {}, const Control& control = {})
{
  Solution<D> solution;
  const auto error = analyse(mesh, problem, options, control, solution);
  EXPECT_FALSE(error) << (error ? error->message : "");
  EXPECT_EQ(toString(solution.solver.status), std::string("converged"));
  return solution;
}

inline AnalysisOptions precise(double tolerance = 1e-13)
{
  AnalysisOptions options;
  options.solver.tolerance = tolerance;
  return options;
}

/// Runs the loop on so many threads, parts handed out in the order in which threads ask for them.
inline Control threads(int n)
{
  Control control;
  control.parallelFor = [n](int count, const std::function<void(int)>& body)
  {
    std::atomic<int> next{ 0 };
    std::vector<std::thread> team;
    for (int t = 0; t < n; ++t)
    {
      team.emplace_back(
        [&]
        {
          for (int i = next++; i < count; i = next++)
          {
            body(i);
          }
        });
    }
    for (std::thread& t : team)
    {
      t.join();
    }
  };
  return control;
}

template <class A>
double largestDifference(const std::vector<A>& a, const std::vector<A>& b)
{
  EXPECT_EQ(a.size(), b.size());
  double most = 0.0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
  {
    most = std::max(most, (a[i] - b[i]).cwiseAbs().maxCoeff());
  }
  return most;
}

/// L2 norm of value - exact over the root of the volume, values being linear in each cell. By the
/// rule of degree 2 with D + 1 points.
template <int D, class Value>
double l2Error(const SimplexMesh<D>& mesh, const std::vector<Value>& values,
  const std::function<Value(const Vec<D>&)>& exact)
{
  const double high = D == 3 ? (5.0 + 3.0 * std::sqrt(5.0)) / 20.0 : 2.0 / 3.0;
  const double low = (1.0 - high) / D;
  double sum = 0.0, volume = 0.0;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    const double v = signedVolume(mesh.corners(c));
    volume += v;
    for (int i = 0; i <= D; ++i)
    {
      Vec<D> x = Vec<D>::Zero();
      Value value = Value::Zero();
      for (int k = 0; k <= D; ++k)
      {
        const Index p = mesh.nodes(c)[k];
        x += (k == i ? high : low) * mesh.point(p);
        value += (k == i ? high : low) * values[p];
      }
      sum += v * (value - exact(x)).squaredNorm() / (D + 1);
    }
  }
  return std::sqrt(sum / volume);
}

/// Method: cylinder of radius R, T = T0 - T1 r^2, generalised plane strain, free sides.
struct HotCylinder
{
  double radius = 0.531, height = 1.2, t0 = 2468.0, t1 = 5286.0;
  Material material{ 200.0, 0.316, 1e-5 }; // GPa

  double integral(double r) const { return t0 * r * r / 2.0 - t1 * std::pow(r, 4) / 4.0; }
  double axialStrain() const
  {
    return 2.0 * material.thermalExpansion * integral(radius) / (radius * radius);
  }
  double temperature(double r2) const { return t0 - t1 * r2; }
  double scale() const
  {
    return material.thermalExpansion * material.youngsModulus * t1 /
      (4.0 * (1.0 - material.poissonsRatio));
  }
  /// u_r / r.
  double radialStretch(double r2) const
  {
    const double nu = material.poissonsRatio, r = std::sqrt(r2);
    const double own = r > 0.0 ? integral(r) / r2 : t0 / 2.0;
    return material.thermalExpansion *
      ((1.0 + nu) / (1.0 - nu) * own +
        (1.0 - 3.0 * nu) / (1.0 - nu) * integral(radius) / (radius * radius));
  }
  template <int D>
  Stress<D> stress(const Vec<D>& x) const
  {
    const double r2 = x[0] * x[0] + x[1] * x[1], all = radius * radius;
    const double rr = -scale() * (all - r2), tt = -scale() * (all - 3.0 * r2);
    const double zz = -2.0 * scale() * (all - 2.0 * r2);
    const double c2 = r2 > 0.0 ? x[0] * x[0] / r2 : 1.0, s2 = 1.0 - c2;
    Stress<D> s = Stress<D>::Zero();
    s[0] = rr * c2 + tt * s2;
    s[1] = rr * s2 + tt * c2;
    s[2] = zz;
    s[3] = r2 > 0.0 ? (rr - tt) * x[0] * x[1] / r2 : 0.0;
    return s;
  }
};
}

#endif
