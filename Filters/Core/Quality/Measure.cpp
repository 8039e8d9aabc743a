// SPDX-License-Identifier: BSD-3-Clause
// What is asked of a measure by its number, at run time; all else goes by its type.
#include "Quality/Measures.h"

#include <array>

namespace meshopt
{
namespace
{
constexpr std::size_t Count = std::tuple_size_v<MeasureTable>;

/// Made from the table of types, so that nothing about a measure is written twice. A measure has
/// one name in 2D and 3D.
template <std::size_t... K>
constexpr std::array<MeasureInfo, Count> makeInfos(std::index_sequence<K...>)
{
  static_assert(((measures::Row<K>::id == static_cast<Measure>(K)) && ...),
    "rows are in the order of their numbers");
  return { { { measures::Row<K>::template Shape<3>::name, measures::Row<K>::isOptimizable,
    measures::Row<K>::bound, measures::Row<K>::template Shape<2>::regular,
    measures::Row<K>::template Shape<3>::regular }... } };
}

constexpr std::array<MeasureInfo, Count> Infos = makeInfos(std::make_index_sequence<Count>());
}

int numberOfMeasures() { return static_cast<int>(Count); }

const MeasureInfo& infoOf(Measure measure) { return Infos[static_cast<std::size_t>(measure)]; }
}
