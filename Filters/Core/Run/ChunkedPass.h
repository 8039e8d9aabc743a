// SPDX-License-Identifier: BSD-3-Clause
/// @file ChunkedPass.h
/// Shares the work on many cells among chunks of the mesh that can be worked on at the same time.
///
/// The points are split into chunks by place (Chunks.h). A cell belongs to a chunk if all its
/// points do, and the editor of a chunk changes only cells of its own (see MeshEditor::setOwner()).
/// The number of chunks, their borders and their free slots depend on the mesh only. Each chunk is
/// worked on in sequence, and no chunk sees what another does. The result therefore does not depend
/// on the number of threads. Cells at a border are held up: the caller opens again with the borders
/// elsewhere (WorstFirst/Pass.h).
#ifndef meshopt_Run_ChunkedPass_h
#define meshopt_Run_ChunkedPass_h

#include "Base/Control.h"
#include "Run/Chunks.h"

#include <functional>
#include <memory>
#include <numeric>
#include <queue>
#include <utility>
#include <vector>

namespace meshopt
{
/// Cells by (quality, id), the worst on top.
using CellQueue = std::priority_queue<std::pair<double, Index>,
  std::vector<std::pair<double, Index>>, std::greater<std::pair<double, Index>>>;

/// What the worker of one chunk has at hand.
template <int D>
struct ChunkWorker
{
  explicit ChunkWorker(const MeshEditor<D>& root)
    : editor(MeshEditor<D>::beside(root))
  {
  }

  MeshEditor<D> editor;
  CellQueue queue;           ///< cells still to be worked on
  long given = 0;            ///< number of cells in the queue at first
  std::vector<Index> heldUp; ///< cells that need cells of other chunks; filled by the work function
};

/// Worker is derived from ChunkWorker<D>.
template <int D, class Worker>
class ChunkedPass
{
public:
  /// Makes a worker for a chunk. Workers are kept from pass to pass.
  using Make = std::function<std::unique_ptr<Worker>()>;

  /// Between passes, `root` owns all free slots. It must outlive this object.
  ChunkedPass(MeshEditor<D>& root, Make make)
    : root_(root)
    , make_(std::move(make))
  {
  }

  /// Splits the mesh into n chunks and shifts their borders by `shift` of a chunk. With n = 1 the
  /// whole mesh is one chunk without borders. Each chunk gets free slots and those of `cells` that
  /// it owns; cells that lie across a border are held up. Qualities must be up to date.
  void open(int n, double shift, const std::vector<Index>& cells);

  int size() const { return this->size_; }
  Worker& worker(int k) { return *this->workers_[k]; }

  /// Calls work(worker) for all chunks, on several threads if the control has them. Repeats this
  /// while a queue is not empty. Asks goesOn() before each round and stops when it says no.
  template <class Work, class GoesOn>
  void run(const Control& control, Work&& work, GoesOn&& goesOn);

  /// Takes the free slots, the clock and the marks back from the workers.
  void close();

  /// Cells that borders kept from being worked on; complete after close().
  const std::vector<Index>& heldUp() const { return this->heldUp_; }

private:
  /// Free slots of a chunk: a fixed number, plus 1/RoomPart of the chunk's own share of all slots.
  /// A chunk cannot get more during a pass, because growing an array would move it under other
  /// threads.
  static constexpr Index CellRoom = 256, PointRoom = 64, RoomPart = 8;

  void dealSlots();
  void dealCells(const std::vector<Index>& cells);

  MeshEditor<D>& root_;
  Make make_;
  Chunks<D> chunks_;
  std::vector<std::unique_ptr<Worker>> workers_;
  int size_ = 0;
  std::vector<Index> heldUp_;
};

template <int D, class Worker>
void ChunkedPass<D, Worker>::open(int n, double shift, const std::vector<Index>& cells)
{
  this->size_ = n;
  if (n > 1)
  {
    this->chunks_.assign(this->root_, n, shift);
  }
  while (static_cast<int>(this->workers_.size()) < n)
  {
    this->workers_.push_back(this->make_());
  }
  this->dealSlots();
  this->dealCells(cells);
}

/// Deals out the free slots. If several chunks work at once, the mesh grows first, so that each
/// gets the same room.
template <int D, class Worker>
void ChunkedPass<D, Worker>::dealSlots()
{
  const int n = this->size_;
  std::vector<Index>& freeCells = this->root_.freeCells();
  std::vector<Index>& freePoints = this->root_.freePoints();
  const SimplexMesh<D>& mesh = this->root_.mesh();
  // A single chunk needs no room of its own: its editor may grow the mesh itself.
  const Index cellRoom = n > 1 ? CellRoom + mesh.numberOfCellSlots() / n / RoomPart : 0;
  const Index pointRoom = n > 1 ? PointRoom + mesh.numberOfPointSlots() / n / RoomPart : 0;
  this->root_.growCells(std::max<Index>(0, n * cellRoom - static_cast<Index>(freeCells.size())));
  this->root_.growPoints(std::max<Index>(0, n * pointRoom - static_cast<Index>(freePoints.size())));
  const auto take = [](std::vector<Index>& from, std::size_t count, std::vector<Index>& to)
  {
    to.assign(from.end() - count, from.end());
    from.resize(from.size() - count);
  };
  for (int k = 0; k < n; ++k)
  {
    MeshEditor<D>& editor = this->workers_[k]->editor;
    editor.setOwner(n > 1 ? k : None);
    // Time stamps and marks are compared across passes, so each editor continues those of the root.
    editor.setClock(this->root_.clock());
    editor.setLastMark(this->root_.lastMark());
    take(freeCells, n > 1 ? cellRoom : freeCells.size(), editor.freeCells());
    take(freePoints, n > 1 ? pointRoom : freePoints.size(), editor.freePoints());
  }
}

template <int D, class Worker>
void ChunkedPass<D, Worker>::dealCells(const std::vector<Index>& cells)
{
  const SimplexMesh<D>& mesh = this->root_.mesh();
  this->heldUp_.clear();
  for (int k = 0; k < this->size_; ++k)
  {
    this->workers_[k]->heldUp.clear();
    this->workers_[k]->queue = CellQueue();
    this->workers_[k]->given = 0;
  }
  for (Index c : cells)
  {
    // One node tells which chunk could own the cell; owns() then asks the other nodes.
    Worker& w = *this->workers_[this->size_ > 1 ? mesh.pointData(mesh.nodes(c)[0]).owner : 0];
    if (w.editor.owns(c))
    {
      w.queue.emplace(mesh.quality(c), c);
      ++w.given;
    }
    else
    {
      this->heldUp_.push_back(c);
    }
  }
}

template <int D, class Worker>
template <class Work, class GoesOn>
void ChunkedPass<D, Worker>::run(const Control& control, Work&& work, GoesOn&& goesOn)
{
  // The most work first, so that the threads finish at about the same time. The order does not
  // change the result.
  std::vector<int> order(this->size_);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
    [&](int a, int b) { return this->workers_[a]->given > this->workers_[b]->given; });
  const auto body = [&](int k) { work(*this->workers_[order[k]]); };
  const auto isBusy = [&](int k) { return !this->workers_[k]->queue.empty(); };
  bool more = true;
  while (more && goesOn())
  {
    if (this->size_ > 1 && control.parallelFor)
    {
      control.parallelFor(this->size_, body);
    }
    else
    {
      for (int k = 0; k < this->size_; ++k)
      {
        body(k);
      }
    }
    more = std::any_of(order.begin(), order.end(), isBusy);
  }
}

template <int D, class Worker>
void ChunkedPass<D, Worker>::close()
{
  const auto give = [](std::vector<Index>& from, std::vector<Index>& to)
  {
    to.insert(to.end(), from.begin(), from.end());
    from.clear();
  };
  for (int k = 0; k < this->size_; ++k)
  {
    Worker& w = *this->workers_[k];
    give(w.editor.freeCells(), this->root_.freeCells());
    give(w.editor.freePoints(), this->root_.freePoints());
    // The latest clock: no stamp of this pass may lie in the future of the next one.
    this->root_.setClock(std::max(this->root_.clock(), w.editor.clock()));
    this->root_.setLastMark(std::max(this->root_.lastMark(), w.editor.lastMark()));
    give(w.heldUp, this->heldUp_);
    w.queue = CellQueue();
  }
}
}

#endif
