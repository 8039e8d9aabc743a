// SPDX-License-Identifier: BSD-3-Clause
/// @file GoldenSection.h
/// Maximum of a function of one variable.
#ifndef meshopt_Base_GoldenSection_h
#define meshopt_Base_GoldenSection_h

namespace meshopt
{
/// The place between a and b (in any order) where f is greatest, for an f that first rises and then
/// falls; `best` is the value there. Golden section: each of the `steps` shrinks the interval by
/// .618.
template <class F>
double goldenSection(double a, double b, int steps, F&& f, double& best)
{
  constexpr double ratio = 0.6180339887498949;
  double l = b - ratio * (b - a), r = a + ratio * (b - a);
  double fl = f(l), fr = f(r);
  for (int k = 0; k < steps; ++k)
  {
    if (fl < fr)
    {
      a = l;
      l = r;
      fl = fr;
      r = a + ratio * (b - a);
      fr = f(r);
    }
    else
    {
      b = r;
      r = l;
      fr = fl;
      l = b - ratio * (b - a);
      fl = f(l);
    }
  }
  best = fl < fr ? fr : fl;
  return fl < fr ? r : l;
}
}

#endif
