// SPDX-License-Identifier: BSD-3-Clause
// Each new point brings one sign for each triple of earlier points, and each sign is entered in all
// the places from which it can be asked for.
#include "Operations/PointSigns.h"

#include "Mesh/Predicates.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace meshopt
{
void PointSigns::add(const Vec<3>& x)
{
  assert(this->size_ < Maximum);
  this->above_.resize(Maximum * Maximum * Maximum);
  const int l = this->size_++;
  this->x_[l] = x;
  // The table may still hold the signs of an earlier set of points.
  for (int i = 0; i <= l; ++i)
  {
    for (int j = 0; j <= l; ++j)
    {
      this->above_[place(i, j, l)] = this->above_[place(i, l, j)] = this->above_[place(l, i, j)] =
        0;
    }
  }
  this->extent_ = l == 0 ? 0.0 : std::max(this->extent_, (x - this->x_[0]).cwiseAbs().maxCoeff());
  // Error bound. Coordinates differ by at most 2 extents; six products of three; some sixteen
  // roundings.
  const double doubt = 6.0 * 8.0 * 16.0 * 1.2e-16 * std::pow(this->extent_, 3);
  for (int k = 2; k < l; ++k)
  {
    const Vec<3> c = this->x_[k] - x;
    for (int j = 1; j < k; ++j)
    {
      const Vec<3> normal = c.cross(this->x_[j] - x);
      for (int i = 0; i < j; ++i)
      {
        const double det = normal.dot(this->x_[i] - x); // of (i, j, k, l)
        // Only doubtful signs are computed exactly. (With a tiny extent the bound itself may
        // underflow.)
        const int sign = std::fabs(det) > doubt && doubt > 1e-200
          ? (det > 0.0 ? 1 : -1)
          : orient(this->x_[i], this->x_[j], this->x_[k], x);
        if (sign == 0)
        {
          continue;
        }
        // A positive tetrahedron (p0, p1, p2, p3) has each node above the opposite facet, in all
        // three rotations of the facet.
        const int p[4] = { sign > 0 ? i : j, sign > 0 ? j : i, k, l }; // positive
        for (int m = 0; m < 4; ++m)
        {
          const int u = p[Local<3>::facets[m][0]], v = p[Local<3>::facets[m][1]],
                    w = p[Local<3>::facets[m][2]];
          const Mask apex = pointset::bit(p[m]);
          this->above_[place(u, v, w)] |= apex;
          this->above_[place(v, w, u)] |= apex;
          this->above_[place(w, u, v)] |= apex;
        }
      }
    }
  }
}
}
