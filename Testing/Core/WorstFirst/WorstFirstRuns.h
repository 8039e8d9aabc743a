// SPDX-License-Identifier: BSD-3-Clause
// Runs of the fast engine as a whole, and what holds for every one of them.
#ifndef meshopt_Testing_WorstFirstRuns_h
#define meshopt_Testing_WorstFirstRuns_h

#include "Optimize/Optimizer.h"
#include "Run/Summary.h"
#include "TestMeshes.h"

namespace meshopt
{
inline Options target(double quality)
{
  Options options;
  options.algorithm = Algorithm::WorstFirst;
  options.targetQuality = quality;
  return options;
}

/// Runs the engine; checks what holds for every run.
template <int D>
Report run(
  SimplexMesh<D>& mesh, const Options& options, NodalMetric<D> metric, const Control& control = {})
{
  EXPECT_EQ(options.check(metric.hasSizes()), "");
  const auto kept = keptFacets(mesh);
  const double volume = mesh.volume();
  const long euler = eulerCharacteristic(mesh);
  const long cells = mesh.countCells();
  const Report report = optimize<D>(mesh, metric, options, control);
  expectSound(mesh, report.invertedAfter == 0);
  EXPECT_EQ(keptFacets(mesh), kept);
  EXPECT_NEAR(mesh.volume(), volume, 1e-11 * std::max(1.0, std::abs(volume)));
  EXPECT_EQ(eulerCharacteristic(mesh), euler);
  const bool hasSizes = options.beta > 0.0 && (options.desiredSize > 0.0 || metric.hasSizes());
  EXPECT_TRUE(hasSizes || mesh.countCells() <= cells + growthOf(options, cells, D))
    << cells << " -> " << mesh.countCells();
  for (std::size_t k = 1; k < report.history.size(); ++k)
  {
    if (report.history[k].stage.rfind("sizes", 0) != 0) // those may lower it
    {
      EXPECT_GE(report.history[k].worst, report.history[k - 1].worst) << report.history[k].stage;
    }
  }
  EXPECT_GE(report.worstAfter, std::min(report.worstBefore, options.targetQuality));
  EXPECT_LE(report.invertedAfter, report.invertedBefore);
  EXPECT_LE(report.worstAfter, report.bound + 1e-12);

  // the qualities that are stored are those of the cells
  const std::vector<double> stored = sortedQualities(mesh);
  MeshEditor<D> editor(mesh);
  computeQualities<D>(editor, metric, options.measure, options.beta);
  const std::vector<double> computed = sortedQualities(mesh);
  EXPECT_EQ(stored.size(), computed.size());
  for (std::size_t k = 0; k < std::min(stored.size(), computed.size()); ++k)
  {
    EXPECT_NEAR(stored[k], computed[k], 1e-9 * (1.0 + std::abs(computed[k])));
  }
  EXPECT_EQ(report.worstAfter, stored.front());
  return report;
}

template <int D>
Report run(SimplexMesh<D>& mesh, const Options& options, const Control& control = {})
{
  return run<D>(mesh, options, NodalMetric<D>(options.desiredSize), control);
}

template <int D>
MeshInput<D> testMesh(double jitter = 0.3, unsigned seed = 1)
{
  return jitteredGrid<D>(D == 3 ? 6 : 14, jitter, seed);
}

/// Some interior cells are pressed nearly flat: one node close to the facet opposite to it.
template <int D>
MeshInput<D> withSlivers()
{
  MeshInput<D> in = testMesh<D>(0.1);
  const SimplexMesh<D> mesh = buildMesh(in);
  std::vector<Index> star;
  std::vector<bool> used(in.points.size(), false);
  for (Index p = 0; p < mesh.numberOfPointSlots(); p += 5)
  {
    if (!mesh.isFree(p))
    {
      continue;
    }
    mesh.star(p, star);
    const Index c = star[0];
    const Facet<D> f = mesh.facet(c, mesh.localIndex(c, p));
    Vec<D> foot = Vec<D>::Zero();
    bool free = true;
    for (Index q : f)
    {
      foot += in.points[q] / D;
      free = free && !used[q];
    }
    if (free)
    {
      in.points[p] += 0.93 * (foot - in.points[p]);
      used[p] = true;
    }
  }
  return in;
}

inline long count(const Report& report, Operation op)
{
  long n = 0;
  for (const PassRecord& row : report.history)
  {
    n += row.done[static_cast<int>(op)];
  }
  return n;
}

}

#endif
