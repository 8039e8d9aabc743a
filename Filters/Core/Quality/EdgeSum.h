// SPDX-License-Identifier: BSD-3-Clause
/// @file EdgeSum.h
/// Shape measures that are functions of the volume and of a sum over the edges.
///
/// For these measures, lengths that several candidate elements share are computed only once. An
/// element around a node then needs no square root of its own (VolumeLength in 3D: one). This makes
/// the kernels of the fast engine fast.
#ifndef meshopt_Quality_EdgeSum_h
#define meshopt_Quality_EdgeSum_h

#include "Quality/Shape.h"

namespace meshopt
{
/// quality = f(det, sum), det = D! V, sum = sum over the edges of weight(l^2).
/// value is false for measures that are not of this form.
template <class Shape>
struct EdgeSum
{
  static constexpr bool value = false;
};

template <int D>
struct EdgeSum<MeanEdgeShape<D>>
{
  static constexpr bool value = true;
  /// c of (2.3) goes with V = det / D!.
  static constexpr double constant = MeanEdgeShape<D>::constant / (D == 2 ? 2.0 : 6.0);

  static double weight(double l2) { return std::sqrt(l2); }
  /// grad weight(|x - r|^2) = slope * (x - r). A collapsed edge has no direction: 0.
  static double slope(double weight) { return weight > 0.0 ? 1.0 / weight : 0.0; }
  static double quality(double det, double sum)
  {
    const double power = D == 2 ? sum * sum : sum * sum * sum;
    return power > 0.0 ? constant * det / power : 0.0;
  }
  /// d quality / d det and d quality / d sum.
  static void derivatives(double det, double sum, double& byDet, double& bySum)
  {
    const double power = D == 2 ? sum * sum : sum * sum * sum;
    byDet = power > 0.0 ? constant / power : 0.0;
    bySum = sum > 0.0 ? -D * byDet * det / sum : 0.0;
  }
};

template <int D>
struct EdgeSum<VolumeLengthShape<D>>
{
  static constexpr bool value = true;
  /// It goes with det already.
  static constexpr double constant = VolumeLengthShape<D>::constant;

  static double weight(double l2) { return l2; }
  static double slope(double) { return 2.0; }
  static double quality(double det, double sum)
  {
    const double power = D == 2 ? sum : sum * std::sqrt(sum);
    return power > 0.0 ? constant * det / power : 0.0;
  }
  static void derivatives(double det, double sum, double& byDet, double& bySum)
  {
    const double power = D == 2 ? sum : sum * std::sqrt(sum);
    byDet = power > 0.0 ? constant / power : 0.0;
    bySum = sum > 0.0 ? -0.5 * D * byDet * det / sum : 0.0;
  }
};
}

#endif
