// SPDX-License-Identifier: BSD-3-Clause
/// @file PointSigns.h
/// For a few points: on which side of the plane through any three of them each other one lies. The
/// signs are exact, and are looked up as sets of points.
#ifndef meshopt_Operations_PointSigns_h
#define meshopt_Operations_PointSigns_h

#include "Mesh/Types.h"

#include <vector>

namespace meshopt
{
/// Sets of up to 32 points: bit k stands for point k.
namespace pointset
{
inline std::uint32_t bit(int k) { return std::uint32_t(1) << k; }
inline bool has(std::uint32_t set, int k) { return (set >> k) & 1u; }
inline int count(std::uint32_t set)
{
  set -= (set >> 1) & 0x55555555u;
  set = (set & 0x33333333u) + ((set >> 2) & 0x33333333u);
  return static_cast<int>((((set + (set >> 4)) & 0x0f0f0f0fu) * 0x01010101u) >> 24);
}
/// The lowest member of a set that is not empty.
inline int lowest(std::uint32_t set)
{
#if defined(__GNUC__)
  return __builtin_ctz(set);
#else
  return count((set & (0u - set)) - 1u);
#endif
}
}

/// Points are numbered 0, 1, 2, ... in the order in which they are added.
class PointSigns
{
public:
  using Mask = std::uint32_t; ///< see pointset
  static constexpr int Maximum = 32;

  void clear() { this->size_ = 0; }
  int size() const { return this->size_; }
  /// Adds a point; there must be fewer than Maximum so far. One sign for each triple of earlier
  /// points: O(n^3).
  void add(const Vec<3>& x);

  /// The points l for which the tetrahedron (i, j, k, l) is positive, exactly.
  Mask above(int i, int j, int k) const { return this->above_[place(i, j, k)]; }
  /// above(i, j, k) for all k.
  const Mask* row(int i, int j) const { return &this->above_[place(i, j, 0)]; }
  /// The points inside of the positive tetrahedron (a, b, c, d).
  Mask inside(int a, int b, int c, int d) const
  {
    return this->above(a, b, c) & this->above(a, c, d) & this->above(a, d, b) &
      this->above(b, d, c);
  }

private:
  static int place(int i, int j, int k) { return (i * Maximum + j) * Maximum + k; }

  int size_ = 0;
  double extent_ = 0.0; // greatest difference of a coordinate to that of the first point
  Vec<3> x_[Maximum];
  std::vector<Mask> above_;
};
}

#endif
