// SPDX-License-Identifier: BSD-3-Clause
/// @file ApexInCone.h
/// How good an element on a given facet can be whose fourth node lies in a given tetrahedron.
#ifndef meshopt_Bound_ApexInCone_h
#define meshopt_Bound_ApexInCone_h

#include "Mesh/Types.h"

#include <array>

namespace meshopt
{
/// A cone of directions from a place on a facet, cut off by a plane: what lies between the place
/// and the three ends. The ends are relative to the place, in units of the facet's longest edge.
using Cone = std::array<Vec<3>, 3>;

/// A facet (a, b, c) and a place on it. The fourth node is on the side where (a, b, c, apex) is
/// positive.
class ApexInCone
{
public:
  /// `weights` of the corners, of sum 1, give the place. Not usable if the facet is collapsed or
  /// not finite.
  ApexInCone(const std::array<Vec<3>, 3>& corners, const Vec<3>& weights);

  bool isUsable() const { return this->usable_; }
  const Vec<3>& from() const { return this->from_; }
  double unit() const { return this->unit_; }
  /// The unit normal, towards the fourth node.
  const Vec<3>& normal() const { return this->normal_; }

  struct Best
  {
    double bound = 0.0; ///< no apex in the cone gives a greater S, but for rounding
    Vec<3> place;       ///< a good apex, inside the cone, as its ends are
  };
  /// The greatest S (2.3) with an apex in the cone: a certified bound, rounded up by at most the
  /// relative Tolerance unless it is below `atLeast`, a place with `enough` is found, or it hardly
  /// converges.
  ///
  /// As in ApexBound.h, V^(1/3) - lambda P is concave. Its tangent plane at any place is above it,
  /// and greatest at a corner of the cone. The place is found by Newton steps from inside (a
  /// barrier at the faces).
  Best best(const Cone& cone, double atLeast, double enough) const;
  static constexpr double Tolerance = 2e-3;

  /// S with the apex at a place, relative as those of cones.
  double shape(const Vec<3>& place) const;
  /// No apex farther away than this, in units, gives S.
  double reach(double shape) const;

private:
  double sum(const Vec<3>& place, Vec<3>* gradient = nullptr, Tensor<3>* hessian = nullptr) const;

  std::array<Vec<3>, 3> poles_; ///< the corners, relative to the place, in units
  Vec<3> from_, normal_;
  double unit_ = 1.0;
  double perimeter_ = 0.0, area_ = 0.0; ///< of the facet, in units
  bool usable_ = false;
};
}

#endif
