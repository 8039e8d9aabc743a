// SPDX-License-Identifier: BSD-3-Clause
// When a pass over many bad cells creeps: by effort, and by whether the surface takes part.
#include "EngineBench.h"

using namespace meshopt;
using namespace meshopt::worstfirst;

namespace
{
constexpr long MostTries = CreepingTries;

/// Flat rhombi that a swap lifts, and flat triangles that stay.
MeshInput<2> rhombiAndTriangles(long rhombi, long triangles)
{
  MeshInput<2> in;
  for (long k = 0; k < rhombi + triangles; ++k)
  {
    const auto first = static_cast<Index>(in.points.size());
    for (const Vec<2>& x : { Vec<2>(-1, 0), Vec<2>(1, 0), Vec<2>(0, 0.3), Vec<2>(0, -0.3) })
    {
      in.points.push_back(x + Vec<2>(3.0 * static_cast<double>(k), 0.0));
    }
    in.cells.push_back({ first, first + 1, first + 2 });
    if (k < rhombi)
    {
      in.cells.push_back({ first + 1, first, first + 3 });
    }
  }
  return in;
}

/// Whether a pass creeps that lifts so many cells in MostTries tries.
bool creeps(long lifted, Effort effort, const StillSurface<2>* surface = nullptr)
{
  Options options = frozen(upTo(0.6, effort));
  options.reconnect = true;
  EngineBench<2> bench(rhombiAndTriangles(lifted, MostTries - lifted), options, surface);
  Task task{ Phase::Lifting, 0.6, 0.6, 1e-3, Level::Topology };
  task.below = 1000; // many
  const PassResult result = bench.pass.run(task, bench.cellsUnder(0.6));
  EXPECT_EQ(result.accepted, lifted);
  EXPECT_EQ(bench.cellsUnder(0.6).size(), static_cast<std::size_t>(MostTries - lifted));
  return result.creeps;
}
}

/// Of a window of tries 1 in CreepingLift must lift a cell.
TEST(Creeping, APassCreepsIfFewTriesLift)
{
  for (const Effort effort : { Effort::Default, Effort::Best })
  {
    EXPECT_TRUE(creeps(MostTries / CreepingLift - 2, effort));
    EXPECT_FALSE(creeps(MostTries / CreepingLift + 1, effort));
  }
}

/// Not where the surface takes part.
TEST(Creeping, AQuickRunCreepsSooner)
{
  EXPECT_TRUE(creeps(MostTries / CreepingLift + 1, Effort::Quick));
  EXPECT_TRUE(creeps(MostTries / CreepingLiftOfQuick - 2, Effort::Quick));
  EXPECT_FALSE(creeps(MostTries / CreepingLiftOfQuick + 1, Effort::Quick));
  const StillSurface<2> judging(true);
  EXPECT_FALSE(creeps(MostTries / CreepingLift + 1, Effort::Quick, &judging));
}
