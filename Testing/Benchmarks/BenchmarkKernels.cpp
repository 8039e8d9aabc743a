// SPDX-License-Identifier: BSD-3-Clause
// Nanoseconds of what the optimizer does again and again, one call each, and how many tetrahedra of
// a bare pass that is. Google Benchmark.
//
//   BenchmarkKernels [options of Google Benchmark]
//
// The mesh is a cube of 105 456 tetrahedra with displaced nodes. The bare pass, the unit of the
// counter `tets`, loads the corners of every cell, computes S and stores it: nothing that looks at
// each cell once can be faster, the one-pass limit. It is measured first, in the same run, the best
// of several. The kernels work on 1024 places drawn at random, which stay in the cache, as the
// surroundings of the worst element do.
#include "../Core/TestMeshes.h"
#include "BarePass.h"

#include "Operations/Cavity.h"
#include "Operations/EdgeRemoval.h"
#include "Operations/FaceRemoval.h"
#include "Reposition/StarProblem.h"
#include "Run/Summary.h"

#include <benchmark/benchmark.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <iostream>

namespace
{

using namespace meshopt;

using Shape = MeanEdgeShape<3>;

constexpr int Boxes = 26;
constexpr double Jitter = 0.2;
constexpr double Never = -std::numeric_limits<double>::infinity();

/// What one call of MeshEditor::replace() takes.
struct Edit
{
  std::vector<Index> cavity;
  std::vector<Simplex<3>> cells;
  std::vector<double> qualities;
};

/// A cell and one of its edges or facets.
struct EdgeOrFacet
{
  Index cell;
  int local;
};

/// The mesh, and the places that the kernels visit in turn. No kernel leaves it changed.
struct Bench
{
  SimplexMesh<3> mesh;
  NodalMetric<3> metric;
  MeshEditor<3> editor;
  QualityModel<3, Shape> model;
  std::vector<Corners<3>> elements;
  std::vector<EdgeOrFacet> edges, facets;
  std::vector<Index> nodes;
  std::vector<Edit> edits;
  double secondsPerTet = 0.0;

  Bench()
    : mesh(makeMesh())
    , editor(mesh)
    , model(mesh, metric, 0.0)
  {
    computeQualities<3>(this->editor, this->metric, Measure::Shape, 0.0);
    this->drawPlaces();
    this->findEdits();
    this->secondsPerTet = this->barePass();
  }

  static SimplexMesh<3> makeMesh()
  {
    SimplexMesh<3> mesh;
    const auto error = SimplexMesh<3>::build(jitteredGrid<3>(Boxes, Jitter), mesh);
    if (error)
    {
      std::cerr << error->message << "\n";
      std::exit(EXIT_FAILURE);
    }
    return mesh;
  }

  void drawPlaces()
  {
    std::mt19937 random(1);
    while (this->edges.size() < 1024)
    {
      const Index c = static_cast<Index>(random() % this->mesh.numberOfInputCells());
      this->edges.push_back({ c, static_cast<int>(random() % 6) });
      this->facets.push_back({ c, static_cast<int>(random() % 4) });
      this->elements.push_back(this->mesh.corners(c));
    }
    while (this->nodes.size() < 1024)
    {
      const Index p = static_cast<Index>(random() % this->mesh.numberOfInputPoints());
      if (this->mesh.isFree(p))
      {
        this->nodes.push_back(p);
      }
    }
  }

  /// Faces whose replacement by an edge is possible, and better: something to do and to undo.
  void findEdits()
  {
    FaceRemoval<Shape> removal;
    for (Index c = 0; c < this->mesh.numberOfInputCells() && this->edits.size() < 1024; ++c)
    {
      for (int i = 0; i < 4; ++i)
      {
        if (removal.propose(this->editor, this->model, c, i, 0.0) > 0.0)
        {
          Edit edit{ removal.cavity(), removal.cells(), {} };
          for (const Simplex<3>& cell : edit.cells)
          {
            edit.qualities.push_back(this->model(cell));
          }
          this->edits.push_back(edit);
        }
      }
    }
    if (this->edits.empty())
    {
      std::cerr << "no face can be replaced\n";
      std::exit(EXIT_FAILURE);
    }
  }

  double barePass() const
  {
    std::vector<double> x;
    for (Index p = 0; p < this->mesh.numberOfInputPoints(); ++p)
    {
      x.insert(x.end(), this->mesh.point(p).data(), this->mesh.point(p).data() + 3);
    }
    std::vector<std::int64_t> ids;
    for (Index c = 0; c < this->mesh.numberOfInputCells(); ++c)
    {
      ids.insert(ids.end(), this->mesh.nodes(c).begin(), this->mesh.nodes(c).end());
    }
    return measureBarePass(x, ids, 200).Seconds / this->mesh.numberOfInputCells();
  }

  static Bench& instance()
  {
    static Bench bench;
    return bench;
  }
};

/// CPU time of the loop of one benchmark, reported in tetrahedra of the bare pass per iteration.
class InTets
{
public:
  explicit InTets(benchmark::State& state)
    : state_(&state)
    , start_(std::clock())
  {
  }
  ~InTets()
  {
    const double seconds = double(std::clock() - this->start_) / CLOCKS_PER_SEC;
    this->state_->counters["tets"] = seconds / double(this->state_->iterations()) /
      Bench::instance().secondsPerTet;
  }

private:
  benchmark::State* state_;
  std::clock_t start_;
};

/// A pass through the data structure of the optimizer, per cell.
void meshPass(benchmark::State& state)
{
  const Bench& bench = Bench::instance();
  std::vector<double> values(bench.mesh.numberOfInputCells());
  Index c = 0;
  const InTets count(state);
  for (auto _ : state)
  {
    values[c] = Shape::value(bench.mesh.corners(c));
    c = c + 1 == bench.mesh.numberOfInputCells() ? 0 : c + 1;
  }
  benchmark::DoNotOptimize(values.data());
}

void quality(benchmark::State& state)
{
  const Bench& bench = Bench::instance();
  std::size_t k = 0;
  const InTets count(state);
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(Shape::value(bench.elements[k++ % 1024]));
  }
}

void gradient(benchmark::State& state)
{
  const Bench& bench = Bench::instance();
  std::array<Vec<3>, 4> g;
  std::size_t k = 0;
  const InTets count(state);
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(Shape::gradient(bench.elements[k++ % 1024], g));
    benchmark::DoNotOptimize(g);
  }
}

/// Star of a node, loaded as the optimizer does it; `smooth`: and the best place in it found.
void star(benchmark::State& state, bool smooth)
{
  Bench& bench = Bench::instance();
  StarProblem<3, Shape> problem;
  std::vector<Index> cells;
  std::size_t k = 0, facets = 0;
  const InTets count(state);
  for (auto _ : state)
  {
    const Index p = bench.nodes[k++ % 1024];
    bench.editor.star(p, cells);
    problem.clear(bench.model.quality, true);
    for (Index c : cells)
    {
      const Facet<3> f = bench.mesh.facet(c, bench.mesh.localIndex(c, p));
      std::array<int, 3> local;
      for (int i = 0; i < 3; ++i)
      {
        local[i] = problem.addPoint(f[i], bench.mesh.point(f[i]));
      }
      problem.addFacet(local);
    }
    facets += cells.size();
    Vec<3> x = bench.mesh.point(p);
    benchmark::DoNotOptimize(
      smooth ? problem.maximize(x, { 1.0, 5e-4, StarSteps }) : problem.evaluate(x));
  }
  state.counters["cells"] = benchmark::Counter(double(facets), benchmark::Counter::kAvgIterations);
}

/// `all`: every refilling of the ring is weighed; otherwise what is not better is left out early.
void edgeRemoval(benchmark::State& state, bool all)
{
  Bench& bench = Bench::instance();
  EdgeRemoval<3, Shape> removal;
  std::size_t k = 0, cells = 0;
  const InTets count(state);
  for (auto _ : state)
  {
    const EdgeOrFacet& at = bench.edges[k++ % 1024];
    const double above = all ? Never : bench.mesh.quality(at.cell);
    benchmark::DoNotOptimize(removal.propose(bench.editor, bench.model, at.cell, at.local, above));
    cells += removal.cavity().size();
  }
  state.counters["cells"] = benchmark::Counter(double(cells), benchmark::Counter::kAvgIterations);
}

void faceRemoval(benchmark::State& state)
{
  Bench& bench = Bench::instance();
  FaceRemoval<Shape> removal;
  std::size_t k = 0;
  const InTets count(state);
  for (auto _ : state)
  {
    const EdgeOrFacet& at = bench.facets[k++ % 1024];
    benchmark::DoNotOptimize(
      removal.propose(bench.editor, bench.model, at.cell, at.local, bench.mesh.quality(at.cell)));
  }
}

/// Cavity for a new node in the middle of a cell.
void insertionCavity(benchmark::State& state)
{
  Bench& bench = Bench::instance();
  Cavity<3, Shape> cavity;
  const std::size_t start = bench.editor.begin();
  const Index p = bench.editor.addPoint(Vec<3>::Zero());
  std::size_t k = 0, cells = 0;
  const InTets count(state);
  for (auto _ : state)
  {
    const Index c = bench.edges[k++ % 1024].cell;
    const Corners<3> x = bench.mesh.corners(c);
    const Vec<3> middle = 0.25 * (x[0] + x[1] + x[2] + x[3]);
    benchmark::DoNotOptimize(cavity.grow(bench.editor, bench.model, c, { p, middle }, {}));
    cells += cavity.cells().size();
  }
  bench.editor.rollback(start);
  state.counters["cells"] = benchmark::Counter(double(cells), benchmark::Counter::kAvgIterations);
}

/// Two cells replaced by three in a transaction that is undone.
void editAndUndo(benchmark::State& state)
{
  Bench& bench = Bench::instance();
  std::size_t k = 0;
  const InTets count(state);
  for (auto _ : state)
  {
    const Edit& edit = bench.edits[k++ % bench.edits.size()];
    const std::size_t place = bench.editor.begin();
    bench.editor.replace(edit.cavity, edit.cells, edit.qualities);
    bench.editor.rollback(place);
  }
}

BENCHMARK(meshPass);
BENCHMARK(quality);
BENCHMARK(gradient);
BENCHMARK_CAPTURE(star, evaluate, false);
BENCHMARK_CAPTURE(star, smooth, true);
BENCHMARK_CAPTURE(edgeRemoval, pruned, false);
BENCHMARK_CAPTURE(edgeRemoval, all, true);
BENCHMARK(faceRemoval);
BENCHMARK(insertionCavity);
BENCHMARK(editAndUndo);

} // namespace

int main(int argc, char** argv)
{
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv))
  {
    return EXIT_FAILURE;
  }
  const Bench& bench = Bench::instance();
  std::printf("bare pass over %d tetrahedra: %.1f ns per tetrahedron; worst quality %.4f\n",
    bench.mesh.numberOfInputCells(), 1e9 * bench.secondsPerTet,
    sortedQualities(bench.mesh).front());
  benchmark::RunSpecifiedBenchmarks();
  return EXIT_SUCCESS;
}
