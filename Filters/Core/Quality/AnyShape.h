// SPDX-License-Identifier: BSD-3-Clause
/// @file AnyShape.h
/// A shape measure that is chosen at run time.
#ifndef meshopt_Quality_AnyShape_h
#define meshopt_Quality_AnyShape_h

#include "Quality/Shape.h"

namespace meshopt
{
/// Stands for one of the functors of Shape.h and gives the same bits. Large code is compiled once
/// for it, instead of once for each functor; in return each element costs a call.
template <int D>
class AnyShape
{
public:
  template <class Shape>
  explicit AnyShape(Shape)
    : value_(&Shape::value)
    , gradient_(&Shape::gradient)
  {
  }

  double value(const Corners<D>& x) const { return this->value_(x); }
  double gradient(const Corners<D>& x, std::array<Vec<D>, D + 1>& g) const
  {
    return this->gradient_(x, g);
  }

private:
  double (*value_)(const Corners<D>&);
  double (*gradient_)(const Corners<D>&, std::array<Vec<D>, D + 1>&);
};
}

#endif
