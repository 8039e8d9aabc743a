// SPDX-License-Identifier: BSD-3-Clause
// Sweeps over the points until no metric is coarser than its neighbours permit. A sweep looks only
// at points whose own metric has changed.
#include "Metric/Gradation.h"

#include "Metric/SymmetricEigen.h"

#include <Eigen/Cholesky>

#include <cmath>

namespace meshopt
{
namespace
{
/// The fraction of a metric that may be missing: without it the last digits would never settle.
constexpr double gradationSlack = 1e-3;
/// Never reached in practice: one sweep carries a change through the mesh.
constexpr int maximumNumberOfSweeps = 1000;

/// True if a (1 + gradationSlack) - b is positive definite. Cholesky by hand, since most edges pass
/// this test.
bool isAtLeast(const Tensor<2>& a, const Tensor<2>& b)
{
  const Tensor<2> d = (1.0 + gradationSlack) * a - b;
  return d(0, 0) > 0.0 && d(0, 0) * d(1, 1) > d(0, 1) * d(0, 1);
}

/// All pivots of the factorization must be positive.
bool isAtLeast(const Tensor<3>& a, const Tensor<3>& b)
{
  const Tensor<3> d = (1.0 + gradationSlack) * a - b;
  if (!(d(0, 0) > 0.0))
  {
    return false;
  }
  const double u = d(0, 1) / d(0, 0), v = d(0, 2) / d(0, 0);
  const double e = d(1, 1) - u * d(0, 1), f = d(1, 2) - u * d(0, 2), g = d(2, 2) - v * d(0, 2);
  return e > 0.0 && e * g > f * f;
}
}

/// The unit ball of the result is the largest ellipsoid within those of a and b: both metrics are
/// reduced to diagonal form at once, and the greater eigenvalue is taken in each direction.
template <int D>
Tensor<D> intersection(const Tensor<D>& a, const Tensor<D>& b)
{
  using Matrix = Eigen::Matrix<double, D, D>;
  const Eigen::LLT<Matrix> cholesky{ Matrix(a) };
  const Matrix l = cholesky.matrixL();
  // b in the coordinates in which a is the identity
  Matrix c = cholesky.matrixL().solve(Matrix(b));
  c.transposeInPlace();
  c = cholesky.matrixL().solve(c).eval();
  // In these coordinates the intersection takes the larger of 1 and each eigenvalue of b.
  SymmetricEigen<D> e = SymmetricEigen<D>::of(Tensor<D>(0.5 * (c + c.transpose())));
  e.values = e.values.cwiseMax(1.0);
  const Matrix q = l * Matrix(e.vectors);
  const Tensor<D> m = q * e.values.asDiagonal() * q.transpose();
  return 0.5 * (m + m.transpose());
}

/// What the metric at one end of an edge permits at the other: sizes may grow by the factor 1 + l
/// ln(gradation) over the length l of the edge in that metric.
template <int D>
Tensor<D> grown(const Tensor<D>& m, const Vec<D>& edge, double gradation)
{
  const double length = std::sqrt(edge.dot(m * edge));
  const double factor = 1.0 + length * std::log(gradation);
  return m / (factor * factor);
}

/// In place and in a fixed order of points, so that the same input gives the same bits.
template <int D>
int limitGradation(const SimplexMesh<D>& mesh, const PointGraph& graph, double gradation,
  std::vector<Tensor<D>>& metrics)
{
  const Index n = graph.numberOfPoints();
  std::vector<std::uint8_t> changed(n, 1); // since its neighbours were last compared with it
  bool again = true;
  int sweeps = 0;
  for (; again && sweeps < maximumNumberOfSweeps; ++sweeps)
  {
    again = false;
    for (Index k = 0; k < n; ++k)
    {
      const Index p = sweeps % 2 == 0 ? k : n - 1 - k; // to and fro: changes travel both ways
      if (!changed[p])
      {
        continue;
      }
      changed[p] = 0;
      for (Index i = graph.first[p]; i < graph.first[p + 1]; ++i)
      {
        const Index q = graph.ids[i];
        const Vec<D> edge = mesh.point(q) - mesh.point(p);
        const Tensor<D> wanted = grown<D>(metrics[p], edge, gradation);
        // Most edges end here: only what is too coarse is intersected.
        if (!isAtLeast(metrics[q], wanted))
        {
          metrics[q] = intersection<D>(metrics[q], wanted);
          changed[q] = 1;
          again = true;
        }
      }
    }
  }
  return sweeps;
}

template Tensor<2> intersection<2>(const Tensor<2>&, const Tensor<2>&);
template Tensor<3> intersection<3>(const Tensor<3>&, const Tensor<3>&);
template Tensor<2> grown<2>(const Tensor<2>&, const Vec<2>&, double);
template Tensor<3> grown<3>(const Tensor<3>&, const Vec<3>&, double);
template int limitGradation<2>(
  const SimplexMesh<2>&, const PointGraph&, double, std::vector<Tensor<2>>&);
template int limitGradation<3>(
  const SimplexMesh<3>&, const PointGraph&, double, std::vector<Tensor<3>>&);
}
