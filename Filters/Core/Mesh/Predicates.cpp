// SPDX-License-Identifier: BSD-3-Clause
// A filter in floating point, then expansions without rounding. The order of operations is what
// makes them exact: nothing may be regrouped.
#include "Mesh/Predicates.h"

#include <cmath>

namespace meshopt
{
namespace
{
constexpr double epsilon = 1.0 / 9007199254740992.0; // 2^-53, half a unit in the last place of 1
constexpr double splitter = 134217729.0;             // 2^27 + 1

/// An exact sum of n doubles that do not overlap, from small to large, without zeros.
template <int N>
struct Expansion
{
  double c[N];
  int n = 0;

  void push(double x)
  {
    if (x != 0.0)
    {
      this->c[this->n++] = x;
    }
  }
  /// The sign of the largest component, since it outweighs all others together.
  int sign() const { return this->n == 0 ? 0 : this->c[this->n - 1] > 0.0 ? 1 : -1; }
};

/// a + b = sum + error
void twoSum(double a, double b, double& sum, double& error)
{
  // Knuth's order of operations: right whichever of a and b is the greater one.
  sum = a + b;
  const double bVirtual = sum - a;
  const double aVirtual = sum - bVirtual;
  error = (a - aVirtual) + (b - bVirtual);
}

// Veltkamp: the halves have at most 26 bits each, so that their products are exact.
void split(double a, double& high, double& low)
{
  const double c = splitter * a;
  high = c - (c - a);
  low = a - high;
}

/// a b = product + error (Dekker)
void twoProduct(double a, double b, double& product, double& error)
{
  product = a * b;
  double aHigh, aLow, bHigh, bLow;
  split(a, aHigh, aLow);
  split(b, bHigh, bLow);
  error = aLow * bLow - (((product - aHigh * bHigh) - aLow * bHigh) - aHigh * bLow);
}

/// a - b without rounding: the difference of two doubles is the sum of two.
Expansion<2> difference(double a, double b)
{
  double sum, error;
  twoSum(a, -b, sum, error);
  Expansion<2> e;
  e.push(error);
  e.push(sum);
  return e;
}

/// Adds one double to an expansion that has room for it (GROW-EXPANSION).
template <int N>
void grow(Expansion<N>& e, double b)
{
  Expansion<N> result;
  double q = b;
  for (int i = 0; i < e.n; ++i)
  {
    double sum, error;
    twoSum(q, e.c[i], sum, error);
    // Zeros are left out by push(): the expansion stays short.
    result.push(error);
    q = sum;
  }
  result.push(q);
  e = result;
}

/// Grown one by one, which is quadratic. It runs only where the filter in orient() cannot decide.
template <int M, int N>
Expansion<M + N> sum(const Expansion<M>& a, const Expansion<N>& b)
{
  Expansion<M + N> result;
  for (int i = 0; i < a.n; ++i)
  {
    result.push(a.c[i]);
  }
  for (int i = 0; i < b.n; ++i)
  {
    grow(result, b.c[i]);
  }
  return result;
}

template <int N>
Expansion<N> negative(Expansion<N> e)
{
  for (int i = 0; i < e.n; ++i)
  {
    e.c[i] = -e.c[i];
  }
  return e;
}

/// All products of two components, each as two doubles.
template <int M, int N>
Expansion<2 * M * N> product(const Expansion<M>& a, const Expansion<N>& b)
{
  Expansion<2 * M * N> result;
  for (int i = 0; i < a.n; ++i)
  {
    for (int j = 0; j < b.n; ++j)
    {
      double high, low;
      twoProduct(a.c[i], b.c[j], high, low);
      grow(result, low);
      grow(result, high);
    }
  }
  return result;
}

/// a d - b c
template <int N>
auto determinant(
  const Expansion<N>& a, const Expansion<N>& b, const Expansion<N>& c, const Expansion<N>& d)
{
  return sum(product(a, d), negative(product(b, c)));
}

/// The differences are expansions, too: the sign is that of the points as given, not rounded.
int exactOrient(const Vec<2>& a, const Vec<2>& b, const Vec<2>& c)
{
  return determinant(
    difference(b[0], a[0]), difference(b[1], a[1]), difference(c[0], a[0]), difference(c[1], a[1]))
    .sign();
}

/// Expanded by the first column; b - a, c - a and d - a are the rows.
int exactOrient(const Vec<3>& a, const Vec<3>& b, const Vec<3>& c, const Vec<3>& d)
{
  Expansion<2> u[3], v[3], w[3];
  for (int i = 0; i < 3; ++i)
  {
    u[i] = difference(b[i], a[i]);
    v[i] = difference(c[i], a[i]);
    w[i] = difference(d[i], a[i]);
  }
  const auto x = product(u[0], determinant(v[1], v[2], w[1], w[2]));
  const auto y = product(u[1], determinant(v[2], v[0], w[2], w[0]));
  const auto z = product(u[2], determinant(v[0], v[1], w[0], w[1]));
  return sum(sum(x, y), z).sign();
}

/// Never asked for 0: the filters let through what is surely not 0.
int signOf(double x) { return x > 0.0 ? 1 : -1; }
}

/// Floating point decides nearly always. Only a doubtful sign is computed exactly.
int orient(const Vec<2>& a, const Vec<2>& b, const Vec<2>& c)
{
  const double left = (b[0] - a[0]) * (c[1] - a[1]);
  const double right = (b[1] - a[1]) * (c[0] - a[0]);
  const double det = left - right;
  // Shewchuk's ccwerrboundA. It is relative, so it does not hold where products may underflow.
  const double size = std::fabs(left) + std::fabs(right);
  if (std::fabs(det) > (3.0 + 16.0 * epsilon) * epsilon * size && size > 1e-140)
  {
    return signOf(det);
  }
  return exactOrient(a, b, c);
}

int orient(const Vec<3>& a, const Vec<3>& b, const Vec<3>& c, const Vec<3>& d)
{
  const double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
  const double vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
  const double wx = d[0] - a[0], wy = d[1] - a[1], wz = d[2] - a[2];
  const double vywz = vy * wz, vzwy = vz * wy;
  const double vzwx = vz * wx, vxwz = vx * wz;
  const double vxwy = vx * wy, vywx = vy * wx;
  const double det = ux * (vywz - vzwy) + uy * (vzwx - vxwz) + uz * (vxwy - vywx);
  // Shewchuk's o3derrboundA; the second condition as in 2D.
  const double size = (std::fabs(vywz) + std::fabs(vzwy)) * std::fabs(ux) +
    (std::fabs(vzwx) + std::fabs(vxwz)) * std::fabs(uy) +
    (std::fabs(vxwy) + std::fabs(vywx)) * std::fabs(uz);
  if (std::fabs(det) > (7.0 + 56.0 * epsilon) * epsilon * size && size > 1e-200)
  {
    return signOf(det);
  }
  return exactOrient(a, b, c, d);
}
}
