// SPDX-License-Identifier: BSD-3-Clause
// Nanoseconds per element of each measure: value and gradient, in 2D and 3D. Google Benchmark.
#include "Mesh/Predicates.h"
#include "Quality/ElementQuality.h"

#include <benchmark/benchmark.h>

#include <random>
#include <vector>

namespace
{

using namespace meshopt;

template <int D>
std::vector<Corners<D>> randomElements()
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<Corners<D>> elements(1024);
  for (Corners<D>& x : elements)
  {
    for (Vec<D>& p : x)
    {
      for (int i = 0; i < D; ++i)
      {
        p[i] = uniform(random);
      }
    }
  }
  return elements;
}

template <int D, class Shape>
void value(benchmark::State& state)
{
  const auto elements = randomElements<D>();
  for (auto _ : state)
  {
    for (const Corners<D>& x : elements)
    {
      benchmark::DoNotOptimize(Shape::value(x));
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(elements.size()));
}

template <int D, class Shape>
void gradient(benchmark::State& state)
{
  const auto elements = randomElements<D>();
  std::array<Vec<D>, D + 1> g;
  for (auto _ : state)
  {
    for (const Corners<D>& x : elements)
    {
      benchmark::DoNotOptimize(Shape::gradient(x, g));
      benchmark::DoNotOptimize(g);
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(elements.size()));
}

template <int D>
void orientations(benchmark::State& state)
{
  const auto elements = randomElements<D>();
  for (auto _ : state)
  {
    for (const Corners<D>& x : elements)
    {
      benchmark::DoNotOptimize(orientation(x));
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(elements.size()));
}

#define MESHOPT_BENCHMARK(SHAPE)             \
  BENCHMARK_TEMPLATE(value, 3, SHAPE<3>);    \
  BENCHMARK_TEMPLATE(gradient, 3, SHAPE<3>); \
  BENCHMARK_TEMPLATE(value, 2, SHAPE<2>);    \
  BENCHMARK_TEMPLATE(gradient, 2, SHAPE<2>)

MESHOPT_BENCHMARK(MeanEdgeShape);
MESHOPT_BENCHMARK(VolumeLengthShape);
MESHOPT_BENCHMARK(MeanRatioShape);
MESHOPT_BENCHMARK(RadiusRatioShape);
MESHOPT_BENCHMARK(MinimumSineShape);
MESHOPT_BENCHMARK(WarpedSineShape);
MESHOPT_BENCHMARK(MinimumAngleShape);
BENCHMARK_TEMPLATE(orientations, 2);
BENCHMARK_TEMPLATE(orientations, 3);

} // namespace

BENCHMARK_MAIN();
