// SPDX-License-Identifier: BSD-3-Clause
// Work shared out among chunks: who has which cells and slots, what borders hold up, and that the
// number of threads changes nothing.
#include "Run/ChunkedPass.h"
#include "Edit/Judge.h"
#include "MeshSnapshot.h"
#include "Operations/NodeInsertion.h"
#include "Operations/NodeMotion.h"
#include "Operations/Reconnect.h"
#include "TestMeshes.h"
#include "TestThreads.h"

using namespace meshopt;

namespace
{
template <int D>
using Shape = MeanEdgeShape<D>;

template <int D>
struct Worker : ChunkWorker<D>
{
  Worker(const MeshEditor<D>& root, const QualityModel<D, Shape<D>>& model)
    : ChunkWorker<D>(root)
    , judge(this->editor, model, this->switches)
  {
    this->judge.growth.left = 100;
  }

  Switches switches;
  Judge<D, Shape<D>> judge;
  Reconnect<D, Shape<D>> reconnect;
  NodeMotion<D, Shape<D>> motion;
  NodeInsertion<D, Shape<D>> insertion;
  long done = 0;

  bool improve(Index c)
  {
    this->judge.start();
    return this->reconnect.improve(this->judge, c, 0) || this->motion.improve(this->judge, c, 0) ||
      this->insertion.improve(this->judge, c, 0);
  }
};

/// A mesh with its qualities, and passes over it.
template <int D>
struct Passes
{
  using Pass = ChunkedPass<D, Worker<D>>;

  explicit Passes(const MeshInput<D>& in)
    : mesh(buildMesh(in))
    , editor(mesh)
    , model(mesh, metric, 0.0)
    , pass(editor, [this] { return std::make_unique<Worker<D>>(this->editor, this->model); })
  {
    for (Index c = 0; c < this->mesh.numberOfCellSlots(); ++c)
    {
      this->editor.setQuality(c, this->model(this->mesh.nodes(c)));
    }
  }
  std::vector<Index> below(double quality) const
  {
    std::vector<Index> cells;
    for (Index c = 0; c < this->mesh.numberOfCellSlots(); ++c)
    {
      if (this->mesh.isAlive(c) && this->mesh.quality(c) < quality)
      {
        cells.push_back(c);
      }
    }
    return cells;
  }
  /// The one owner of all points of a cell, or None.
  Index ownerOf(Index c) const
  {
    const Index owner = this->mesh.pointData(this->mesh.nodes(c)[0]).owner;
    for (Index p : this->mesh.nodes(c))
    {
      if (this->mesh.pointData(p).owner != owner)
      {
        return None;
      }
    }
    return owner;
  }
  std::vector<Index> deadCells() const
  {
    std::vector<Index> dead;
    for (Index c = 0; c < this->mesh.numberOfCellSlots(); ++c)
    {
      if (!this->mesh.isAlive(c))
      {
        dead.push_back(c);
      }
    }
    return dead;
  }

  SimplexMesh<D> mesh;
  MeshEditor<D> editor;
  NodalMetric<D> metric;
  QualityModel<D, Shape<D>> model;
  Pass pass;
};

template <int D>
MeshInput<D> testMesh()
{
  return jitteredGrid<D>(D == 3 ? 6 : 20, 0.3);
}

constexpr int Chunk = 6; // so many

/// Each chunk drains its queue, `most` tries at a time.
template <int D>
void drain(Worker<D>& w, int most)
{
  const SimplexMesh<D>& mesh = w.editor.mesh();
  for (int k = 0; k < most && !w.queue.empty(); ++k)
  {
    const auto [q, c] = w.queue.top();
    w.queue.pop();
    if (!mesh.isAlive(c) || mesh.quality(c) != q)
    {
      continue;
    }
    w.editor.resetHeldUp();
    if (w.improve(c))
    {
      ++w.done;
    }
    else if (w.editor.isHeldUp())
    {
      w.heldUp.push_back(c);
    }
  }
}
}

/// The first cell of a worker's queue is divided by a node in its middle: that takes slots.
template <int D>
void divideFirst(Worker<D>& w)
{
  const SimplexMesh<D>& mesh = w.editor.mesh();
  ASSERT_FALSE(w.queue.empty());
  const Index c = w.queue.top().second;
  const Simplex<D> nodes = mesh.nodes(c);
  Vec<D> centre = Vec<D>::Zero();
  for (Index p : nodes)
  {
    centre += mesh.point(p) / (D + 1);
  }
  const Index p = w.editor.addPoint(centre);
  ASSERT_NE(p, None);
  std::vector<Simplex<D>> cells(D + 1, nodes);
  std::vector<double> qualities;
  for (int i = 0; i <= D; ++i)
  {
    cells[i][i] = p;
    qualities.push_back(w.judge.model()(cells[i]));
  }
  ASSERT_TRUE(w.editor.replace({ c }, cells, qualities));
}

template <class T>
class PassOf : public ::testing::Test
{
};
TYPED_TEST_SUITE(PassOf, TestDimensions);

TYPED_TEST(PassOf, EachCellIsOneWorkersOrHeldUp)
{
  constexpr int D = TypeParam::dimension;
  Passes<D> all(testMesh<D>());
  const std::vector<Index> cells = all.below(2.0);
  all.pass.open(Chunk, 0.0, cells);
  ASSERT_EQ(all.pass.size(), Chunk);
  std::map<Index, Index> owner; // of each cell that is in a queue
  long fewest = std::numeric_limits<long>::max(), most = 0;
  for (int k = 0; k < Chunk; ++k)
  {
    Worker<D>& w = all.pass.worker(k);
    EXPECT_EQ(w.given, static_cast<long>(w.queue.size()));
    std::pair<double, Index> last{ -1.0, None };
    for (CellQueue queue = w.queue; !queue.empty(); queue.pop())
    {
      const auto [q, c] = queue.top();
      EXPECT_TRUE(owner.emplace(c, k).second) << "cell " << c << " twice";
      EXPECT_EQ(q, all.mesh.quality(c));
      EXPECT_LT(last, queue.top()); // the worst first, then by id
      last = queue.top();
    }
    fewest = std::min(fewest, w.given);
    most = std::max(most, w.given);
  }
  EXPECT_GT(fewest, 0);
  EXPECT_LE(most, 2 * fewest); // points are shared out evenly, cells about so
  long held = 0;
  for (Index c : cells)
  {
    const auto& heldUp = all.pass.heldUp();
    const bool isHeldUp = std::find(heldUp.begin(), heldUp.end(), c) != heldUp.end();
    held += isHeldUp;
    const Index expected = all.ownerOf(c); // by brute force
    EXPECT_EQ(isHeldUp, expected == None);
    EXPECT_EQ(owner.count(c), expected == None ? 0u : 1u);
    EXPECT_TRUE(expected == None || owner[c] == expected);
  }
  EXPECT_GT(held, 0);
  all.pass.close();
  all.pass.open(1, 0.0, cells); // one chunk has no borders
  EXPECT_EQ(all.pass.worker(0).given, static_cast<long>(cells.size()));
  EXPECT_TRUE(all.pass.heldUp().empty());
  all.pass.close();
}

TYPED_TEST(PassOf, SlotsAreDealtOnceAndComeBack)
{
  constexpr int D = TypeParam::dimension;
  Passes<D> all(testMesh<D>());
  for (int round = 0; round < 3; ++round)
  {
    const int n = round == 2 ? 1 : Chunk;
    all.pass.open(n, 0.3, all.below(0.8));
    std::set<Index> cells, points;
    for (int k = 0; k < n; ++k)
    {
      MeshEditor<D>& editor = all.pass.worker(k).editor;
      EXPECT_TRUE(n == 1 || editor.freeCells().size() >= 256u);
      EXPECT_TRUE(n == 1 || editor.freePoints().size() >= 64u);
      for (Index c : editor.freeCells())
      {
        EXPECT_TRUE(cells.insert(c).second) << "cell slot " << c << " twice";
        EXPECT_FALSE(all.mesh.isAlive(c));
      }
      for (Index p : editor.freePoints())
      {
        EXPECT_TRUE(points.insert(p).second) << "point slot " << p << " twice";
        EXPECT_FALSE(all.mesh.isPointAlive(p));
      }
    }
    const Index before = all.mesh.countCells();
    for (int k = 0; k < n; ++k)
    {
      divideFirst(all.pass.worker(k));
    }
    EXPECT_EQ(all.mesh.countCells(), before + n * D);
    all.pass.run(
      {}, [](Worker<D>& w) { drain(w, 1000000); }, [] { return true; });
    long made = 0; // slots of the pools that are in use after work
    for (Index c : cells)
    {
      if (all.mesh.isAlive(c))
      {
        ++made;
        EXPECT_TRUE(n == 1 || all.ownerOf(c) != None);
      }
    }
    EXPECT_GT(made, 0);
    all.pass.close();
    EXPECT_EQ(sorted(all.editor.freeCells()), all.deadCells());
    std::set<Index> free(all.editor.freePoints().begin(), all.editor.freePoints().end());
    EXPECT_EQ(free.size(), all.editor.freePoints().size());
    expectSound(all.mesh);
  }
}

/// Cells of other chunks are neither changed nor asked: what lies across a border waits for a pass
/// whose borders are elsewhere.
TYPED_TEST(PassOf, ABorderHoldsUp)
{
  constexpr int D = TypeParam::dimension;
  Passes<D> all(testMesh<D>());
  const std::vector<Index> bad = all.below(0.8);
  all.pass.open(2, 0.0, bad);
  const std::vector<Index> across = all.pass.heldUp();
  ASSERT_FALSE(across.empty());
  const Snapshot<D> before(all.editor);
  for (Index c : across)
  {
    for (int k = 0; k < 2; ++k)
    {
      Worker<D>& w = all.pass.worker(k);
      w.editor.resetHeldUp();
      EXPECT_FALSE(w.editor.owns(c));
      EXPECT_TRUE(w.editor.isHeldUp());
    }
  }
  EXPECT_TRUE(Snapshot<D>(all.editor) == before);
  std::map<Index, Simplex<D>> nodes; // of all cells that lie across the border
  std::map<Index, Vec<D>> places;
  for (Index c = 0; c < all.mesh.numberOfCellSlots(); ++c)
  {
    if (all.mesh.isAlive(c) && all.ownerOf(c) == None)
    {
      nodes[c] = all.mesh.nodes(c);
      for (Index p : nodes[c])
      {
        places[p] = all.mesh.point(p);
      }
    }
  }
  all.pass.run(
    {}, [](Worker<D>& w) { drain(w, 1000000); }, [] { return true; });
  EXPECT_GT(all.pass.worker(0).done + all.pass.worker(1).done, 5);
  for (const auto& [c, n] : nodes)
  {
    EXPECT_TRUE(all.mesh.isAlive(c));
    EXPECT_EQ(all.mesh.nodes(c), n);
  }
  for (const auto& [p, x] : places)
  {
    EXPECT_EQ(all.mesh.point(p), x);
  }
  all.pass.close();
  const std::vector<Index>& heldUp = all.pass.heldUp(); // with those that workers have met
  for (Index c : across)
  {
    EXPECT_EQ(std::count(heldUp.begin(), heldUp.end(), c), 1);
  }
  EXPECT_GT(heldUp.size(), across.size());
  // with one chunk some of them can be helped
  const std::vector<Index> rest(across);
  all.pass.open(1, 0.0, rest);
  all.pass.worker(0).done = 0;
  all.pass.run(
    {}, [](Worker<D>& w) { drain(w, 1000000); }, [] { return true; });
  EXPECT_GT(all.pass.worker(0).done, 0);
  all.pass.close();
  expectSound(all.mesh);
}

TYPED_TEST(PassOf, SameBytesForAnyNumberOfThreads)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = testMesh<D>();
  const auto result = [&](const Control& control)
  {
    Passes<D> all(in);
    for (double shift : { 0.0, 0.3, -0.3 })
    {
      all.pass.open(Chunk, shift, all.below(0.7));
      all.pass.run(
        control, [](Worker<D>& w) { drain(w, 7); }, [] { return true; });
      all.pass.close();
    }
    expectSound(all.mesh);
    EXPECT_GT(all.mesh.numberOfCellSlots(), static_cast<Index>(in.cells.size()));
    return Snapshot<D>(all.editor); // slots, stamps and pools, too
  };
  const Snapshot<D> alone = result({});
  for (int n : { 1, 2, 3, 4 })
  {
    EXPECT_TRUE(result(threads(n, 10 + n)) == alone) << n << " threads";
  }
}

TYPED_TEST(PassOf, EndsWhenItIsToldTo)
{
  constexpr int D = TypeParam::dimension;
  Passes<D> all(testMesh<D>());
  all.pass.open(Chunk, 0.0, all.below(0.7));
  const Snapshot<D> before(all.editor);
  int asked = 0, worked = 0;
  all.pass.run(
    {}, [&](Worker<D>&) { ++worked; }, [&] { return ++asked < 1; });
  EXPECT_EQ(asked, 1); // before anything is done
  EXPECT_EQ(worked, 0);
  EXPECT_TRUE(Snapshot<D>(all.editor) == before);
  asked = 0;
  all.pass.run(
    {}, [&](Worker<D>&) { ++worked; }, [&] { return ++asked < 4; });
  EXPECT_EQ(worked, 3 * Chunk); // queues are not empty: again and again
  all.pass.run(
    {}, [](Worker<D>& w) { w.queue = CellQueue(); }, [&] { return ++asked > 0; });
  EXPECT_EQ(asked, 5); // once, since then they are
  all.pass.close();
  EXPECT_EQ(sorted(all.editor.freeCells()), all.deadCells());
}
