// SPDX-License-Identifier: BSD-3-Clause
// The volume of a mesh in a metric, which is the number of elements up to a factor (5.3). It is
// integrated exactly for the interpolation that the metric has elsewhere.
#include "Metric/MetricVolume.h"

#include <algorithm>
#include <cmath>

namespace meshopt
{
namespace
{
/// The divided difference exp[a_0, ..., a_{n-1}] of ascending numbers, none above 0. For close
/// numbers the recursion of divided differences would cancel. There the series sum_k h_k / (n - 1 +
/// k)! around their mean is used, with h_k the complete homogeneous symmetric polynomials.
double dividedDifference(const double* a, int n)
{
  const double spread = a[n - 1] - a[0];
  if (n == 1)
  {
    return std::exp(a[0]);
  }
  if (spread > 1.0)
  {
    return (dividedDifference(a + 1, n - 1) - dividedDifference(a, n - 1)) / spread;
  }
  double mean = 0.0;
  for (int i = 0; i < n; ++i)
  {
    mean += a[i] / n;
  }
  double factorial = 1.0;
  for (int i = 2; i < n; ++i)
  {
    factorial *= i;
  }
  // h[i]: the polynomial of the current degree in the first i + 1 numbers
  double h[4] = { 1.0, 1.0, 1.0, 1.0 };
  double sum = 1.0 / factorial;
  // No number is farther than 3/4 from the mean: what comes after 16 terms is below rounding.
  for (int k = 1; k <= 16; ++k)
  {
    factorial *= n - 1 + k;
    double before = 0.0;
    for (int i = 0; i < n; ++i)
    {
      before = h[i] = before + (a[i] - mean) * h[i];
    }
    sum += h[n - 1] / factorial;
  }
  return std::exp(mean) * sum;
}
}

/// The mean over a simplex of exp(f), f linear with the values a at the nodes, is D! times the
/// divided difference of exp (Hermite and Genocchi).
template <int D>
double meanOfExponential(const std::array<double, D + 1>& a)
{
  std::array<double, D + 1> sorted = a;
  std::sort(sorted.begin(), sorted.end());
  // Relative to the greatest, so that nothing overflows.
  const double greatest = sorted[D];
  for (double& value : sorted)
  {
    value -= greatest;
  }
  return (D == 2 ? 2.0 : 6.0) * std::exp(greatest) * dividedDifference(sorted.data(), D + 1);
}

/// The logarithm of the density is linear in each cell, as the metric is interpolated. The integral
/// over a cell is then exact.
template <int D>
double metricVolume(const SimplexMesh<D>& mesh, const std::vector<double>& halfLogDeterminants)
{
  double volume = 0.0;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    if (mesh.isAlive(c))
    {
      std::array<double, D + 1> a;
      for (int i = 0; i <= D; ++i)
      {
        a[i] = halfLogDeterminants[mesh.nodes(c)[i]];
      }
      volume += std::abs(signedVolume(mesh.corners(c))) * meanOfExponential<D>(a);
    }
  }
  return volume;
}

template double meanOfExponential<2>(const std::array<double, 3>&);
template double meanOfExponential<3>(const std::array<double, 4>&);
template double metricVolume<2>(const SimplexMesh<2>&, const std::vector<double>&);
template double metricVolume<3>(const SimplexMesh<3>&, const std::vector<double>&);
}
