// SPDX-License-Identifier: BSD-3-Clause
/// @file Measures.h
/// The table of measures. All else follows from it: which measures can be optimized,
/// instantiations, ranges, bounds.
///
/// A new measure needs a functor in Shape.h, a number in Measure.h, a row here, and a line in the
/// battery of Testing/Core/Quality/QualityMeasureTest.cpp.
#ifndef meshopt_Quality_Measures_h
#define meshopt_Quality_Measures_h

#include "Quality/AnyShape.h"
#include "Quality/EdgeSum.h"
#include "Quality/Measure.h"
#include "Quality/Shape.h"

#include <tuple>
#include <type_traits>

namespace meshopt
{
template <Measure Id, template <int> class Functor, bool Optimizable, FacetBound Bound>
struct MeasureRow
{
  static constexpr Measure id = Id;
  static constexpr bool isOptimizable = Optimizable;
  static constexpr FacetBound bound = Bound;
  template <int D>
  using Shape = Functor<D>;
};

/// In the order of their numbers. Name and value of the regular simplex come from the functor.
using MeasureTable = std::tuple< //
  MeasureRow<Measure::Shape, MeanEdgeShape, true, FacetBound::BestApex>,
  MeasureRow<Measure::RadiusRatio, RadiusRatioShape, true, FacetBound::None>,
  MeasureRow<Measure::MeanRatio, MeanRatioShape, true, FacetBound::MeanRatioToTwoThirds>,
  MeasureRow<Measure::MinimumSine, MinimumSineShape, true, FacetBound::None>,
  MeasureRow<Measure::WarpedSine, WarpedSineShape, true, FacetBound::None>,
  MeasureRow<Measure::VolumeLength, VolumeLengthShape, true, FacetBound::MeanRatio>,
  MeasureRow<Measure::MinimumDihedralAngle, MinimumAngleShape, false, FacetBound::None>>;

namespace measures
{
template <std::size_t K>
using Row = std::tuple_element_t<K, MeasureTable>;

/// What f is called with. Engines are compiled for a functor of its own only where edge lengths can
/// be shared: the others would not become faster by it.
template <int D, bool All, class Shape>
using Called = std::conditional_t<All || EdgeSum<Shape>::value, Shape, AnyShape<D>>;

/// Calls f for the row with the number `measure`, among the rows from K on. The caller must not
/// pass a measure that is not among them: f is then called for the first row.
template <int D, bool All, std::size_t K, class F>
decltype(auto) dispatchFrom(Measure measure, F& f)
{
  if constexpr (K == std::tuple_size_v<MeasureTable>)
  {
    // Not reached with a measure of the table, but the chain of comparisons must return something.
    return f(typename Row<0>::template Shape<D>{});
  }
  else if constexpr (!All && !Row<K>::isOptimizable)
  {
    // Skipped at compile time: no engine asks for it.
    return dispatchFrom<D, All, K + 1>(measure, f);
  }
  else
  {
    using Shape = typename Row<K>::template Shape<D>;
    if (measure == Row<K>::id)
    {
      return f(Called<D, All, Shape>(Shape{}));
    }
    return dispatchFrom<D, All, K + 1>(measure, f);
  }
}
}

/// Calls f(shape) with the functor of `measure`, so that the measure is chosen once per pass, not
/// per element. f is a generic lambda with the same return type for every functor.
template <int D, class F>
decltype(auto) dispatch(Measure measure, F&& f)
{
  return measures::dispatchFrom<D, true, 0>(measure, f);
}

/// For large code that does not gain by a functor of its own.
template <int D>
AnyShape<D> anyShape(Measure measure)
{
  return dispatch<D>(measure, [](auto shape) { return AnyShape<D>(shape); });
}

/// For measures that can be optimized, and for code that becomes faster where edge lengths can be
/// shared: f is called with the functors that can (EdgeSum.h), and with an AnyShape for all others.
template <int D, class F>
decltype(auto) dispatchOptimizable(Measure measure, F&& f)
{
  return measures::dispatchFrom<D, false, 0>(measure, f);
}
}

#endif
