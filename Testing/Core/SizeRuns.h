// SPDX-License-Identifier: BSD-3-Clause
// Runs of the optimizer on meshes with wanted sizes, and what holds for every one of them.
#ifndef meshopt_Testing_SizeRuns_h
#define meshopt_Testing_SizeRuns_h

#include "Metric/EdgeLengths.h"
#include "Optimize/Optimizer.h"
#include "PlaneMeshes.h"

#include <numeric>

namespace meshopt
{
inline constexpr double Wanted = 0.6;

template <int D>
struct Result
{
  SimplexMesh<D> mesh;
  NodalMetric<D> metric;
  BoundaryCurves curves;
  Report report;
  EdgeLengths lengths;
  double predicted = 0.0;
  long cells = 0;
};

inline Options options(double beta = 0.0, double target = Wanted)
{
  Options result;
  result.beta = beta;
  result.targetQuality = target;
  return result;
}

/// All changes that were tried: how much work a run was, on any machine.
inline long tries(const Report& report)
{
  long sum = 0;
  for (const PassRecord& row : report.history)
  {
    sum = std::accumulate(row.tried.begin(), row.tried.end(), sum);
  }
  return sum;
}

/// What holds for every run.
template <int D>
void check(const Result<D>& run, long euler, const Options& o)
{
  expectSound(run.mesh);
  EXPECT_EQ(eulerCharacteristic(run.mesh), euler);
  EXPECT_EQ(run.report.invertedAfter, 0);
  EXPECT_GE(run.report.worstAfter, std::min(run.report.worstBefore, o.targetQuality));
  EXPECT_EQ(run.report.worstAfter, sortedQualities(run.mesh).front());
  // worst-first rows never fall
  for (std::size_t k = 1; k < run.report.history.size(); ++k)
  {
    const PassRecord& row = run.report.history[k];
    if (row.stage.rfind("sizes", 0) != 0 && row.stage != "crossing boundary undone")
    {
      EXPECT_GE(row.worst, run.report.history[k - 1].worst - 1e-12) << row.stage;
    }
  }
}

template <int D>
Result<D> optimized(const MeshInput<D>& in, const NodalMetric<D>& metric, const Options& given,
  bool slide, const Control& control = {}, const std::function<void(Result<D>&)>& prepare = {})
{
  Result<D> run;
  run.mesh = buildMesh(in);
  run.metric = metric;
  const long euler = eulerCharacteristic(run.mesh);
  if constexpr (D == 2)
  {
    if (slide)
    {
      MeshEditor<2> editor(run.mesh);
      run.curves.build(editor, CurveOptions());
    }
  }
  if (prepare)
  {
    prepare(run);
  }
  run.predicted = run.metric.predictedNumberOfElements(run.mesh);
  const auto kept = keptFacets(run.mesh);
  Options o = given;
  o.desiredSize = metric.hasSizes() ? 0.0 : metric.element(Simplex<D>()).desiredSize;
  EXPECT_EQ(o.check(metric.hasSizes()), "");
  Surface<D>* surface = nullptr;
  if constexpr (D == 2)
  {
    surface = slide ? &run.curves : nullptr;
  }
  run.report = optimize<D>(run.mesh, run.metric, o, control, surface);
  check(run, euler, o);
  if (!slide)
  {
    EXPECT_EQ(keptFacets(run.mesh), kept);
  }
  else if constexpr (D == 2)
  {
    expectOnCurves(run.mesh, run.curves, 1e-7); // of a geometry that is given: found again
  }
  run.lengths = measureEdges<D>(run.mesh, run.metric);
  run.cells = run.mesh.countCells();
  return run;
}

/// Sizes at the points of `in` as f says; `tensors`: one per point, or none.
template <int D, class F>
NodalMetric<D> sizesAt(const MeshInput<D>& in, F&& f, const std::vector<Tensor<D>>& tensors = {})
{
  std::vector<double> sizes;
  for (const Vec<D>& x : in.points)
  {
    sizes.push_back(f(x));
  }
  NodalMetric<D> metric;
  EXPECT_EQ(metric.set(buildMesh(in), sizes, tensors), "");
  return metric;
}

/// The tensor m at all points of `in`.
template <int D>
NodalMetric<D> constantMetric(const MeshInput<D>& in, const Tensor<D>& m, double h)
{
  NodalMetric<D> metric(h);
  EXPECT_EQ(metric.set(buildMesh(in), {}, std::vector<Tensor<D>>(in.points.size(), m)), "");
  return metric;
}
}

#endif
