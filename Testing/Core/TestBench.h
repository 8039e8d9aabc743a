// SPDX-License-Identifier: BSD-3-Clause
// A mesh with all that works on it, for tests of single operations; what doing and undoing keep.
#ifndef meshopt_Testing_TestBench_h
#define meshopt_Testing_TestBench_h

#include "Edit/Judge.h"
#include "MeshSnapshot.h"
#include "Quality/Shape.h"
#include "TestMeshes.h"

namespace meshopt
{
/// Its qualities are set. Nothing is guarded and any growth allowed until a test says so.
template <int D, class S = MeanEdgeShape<D>>
struct Bench
{
  using Shape = S;

  explicit Bench(const MeshInput<D>& in, const Surface<D>* surface = nullptr)
    : mesh(buildMesh(in))
    , editor(this->mesh)
    , model(this->mesh, this->metric, 0.0)
    , judge(this->editor, this->model, this->switches, surface)
  {
    for (Index c = 0; c < this->mesh.numberOfCellSlots(); ++c)
    {
      this->editor.setQuality(c, this->model(this->mesh.nodes(c)));
    }
  }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  /// The points of the list belong to another worker; the judge's editor has all others.
  void giveAway(const std::vector<Index>& points)
  {
    for (Index p : points)
    {
      this->editor.setPointOwner(p, 1); // the others have 0
    }
    this->editor.setOwner(0);
  }
  double worst() const { return sortedQualities(this->mesh).front(); }

  SimplexMesh<D> mesh;
  MeshEditor<D> editor;
  NodalMetric<D> metric;
  QualityModel<D, Shape> model;
  Switches switches;
  Judge<D, Shape> judge;
};

/// What no operation may change, and that qualities are those of the cells.
template <int D, class Shape>
class Unchanged
{
public:
  explicit Unchanged(const Bench<D, Shape>& bench)
    : bench_(bench)
    , kept_(keptFacets(bench.mesh))
    , volume_(bench.mesh.volume())
    , euler_(eulerCharacteristic(bench.mesh))
  {
  }
  void check(bool positive = true) const
  {
    const SimplexMesh<D>& mesh = this->bench_.mesh;
    expectSound(mesh, positive);
    EXPECT_EQ(keptFacets(mesh), this->kept_);
    EXPECT_NEAR(mesh.volume(), this->volume_, 1e-12 * std::max(1.0, std::fabs(this->volume_)));
    EXPECT_EQ(eulerCharacteristic(mesh), this->euler_);
    for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
    {
      if (mesh.isAlive(c))
      {
        EXPECT_EQ(mesh.quality(c), this->bench_.model(mesh.nodes(c))) << "cell " << c;
      }
    }
  }

private:
  const Bench<D, Shape>& bench_;
  std::multiset<std::vector<double>> kept_;
  double volume_;
  long euler_;
};

/// change() must change the mesh, and undoing that restore every bit; then it is done to stay.
template <int D, class Shape, class Change>
void doUndoAndDo(Bench<D, Shape>& bench, Change&& change, bool positive = true)
{
  const Unchanged<D, Shape> unchanged(bench);
  const Snapshot<D> before(bench.editor);
  const auto mark = bench.judge.begin();
  ASSERT_TRUE(change());
  unchanged.check(positive);
  EXPECT_FALSE(Snapshot<D>(bench.editor) == before);
  bench.judge.rollback(mark);
  EXPECT_TRUE(Snapshot<D>(bench.editor) == before);
  ASSERT_TRUE(change());
  unchanged.check(positive);
}

/// change() must refuse, and leave every bit as it was.
template <int D, class Shape, class Change>
void expectRefused(Bench<D, Shape>& bench, Change&& change)
{
  const Snapshot<D> before(bench.editor);
  EXPECT_FALSE(change());
  EXPECT_TRUE(Snapshot<D>(bench.editor) == before);
}

/// Tries `operation` at every cell under `quality`, each time from the same mesh. Where it helps,
/// what no operation may change is looked at, and that the sorted qualities have risen; where it
/// does not, that every bit is as it was. Returns how many tries have helped.
template <class Operation, int D, class Shape>
int tryEverywhere(Operation& operation, Bench<D, Shape>& bench, int level, double quality = 0.8)
{
  const Unchanged<D, Shape> unchanged(bench);
  const std::vector<double> before = sortedQualities(bench.mesh);
  const Snapshot<D> bits(bench.editor);
  const long growth = bench.judge.growth.left;
  int helped = 0;
  for (Index t = 0; t < bench.mesh.numberOfCellSlots(); ++t)
  {
    if (!bench.mesh.isAlive(t) || !(bench.mesh.quality(t) < quality))
    {
      continue;
    }
    const Index cells = bench.mesh.countCells();
    const auto mark = bench.judge.begin();
    bench.judge.start();
    if (operation.improve(bench.judge, t, level))
    {
      ++helped;
      unchanged.check();
      EXPECT_TRUE(isAbove(sortedQualities(bench.mesh), before)) << "cell " << t;
      EXPECT_FALSE(bench.judge.changed().empty());
      EXPECT_EQ(growth - bench.judge.growth.left, bench.mesh.countCells() - cells);
      bench.judge.rollback(mark);
    }
    else
    {
      EXPECT_TRUE(Snapshot<D>(bench.editor) == bits) << "cell " << t;
      bench.judge.commit(mark);
    }
    EXPECT_TRUE(Snapshot<D>(bench.editor) == bits) << "cell " << t;
    EXPECT_EQ(bench.judge.growth.left, growth);
  }
  return helped;
}

/// The live cell whose centre is nearest to x.
template <int D>
Index cellNear(const SimplexMesh<D>& mesh, const Vec<D>& x)
{
  Index nearest = None;
  double least = std::numeric_limits<double>::infinity();
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    Vec<D> centre = Vec<D>::Zero();
    for (int i = 0; i <= D && mesh.isAlive(c); ++i)
    {
      centre += mesh.point(mesh.nodes(c)[i]) / (D + 1);
    }
    if (mesh.isAlive(c) && (centre - x).norm() < least)
    {
      least = (centre - x).norm();
      nearest = c;
    }
  }
  return nearest;
}

/// Number of the edge (a, b) in cell c.
template <int D>
int localEdge(const SimplexMesh<D>& mesh, Index c, Index a, Index b)
{
  for (int e = 0; e < Local<D>::numberOfEdges; ++e)
  {
    const Index i = mesh.nodes(c)[Local<D>::edges[e][0]], j = mesh.nodes(c)[Local<D>::edges[e][1]];
    if ((i == a && j == b) || (i == b && j == a))
    {
      return e;
    }
  }
  return -1;
}

inline long triedOf(const std::array<long, NumberOfOperations>& counts, Operation op)
{
  return counts[static_cast<int>(op)];
}
}

#endif
