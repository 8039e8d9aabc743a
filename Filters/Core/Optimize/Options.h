// SPDX-License-Identifier: BSD-3-Clause
/// @file Options.h
/// The one plain struct at the door of the optimizer.
#ifndef meshopt_Optimize_Options_h
#define meshopt_Optimize_Options_h

#include "Quality/Measure.h"

#include <functional>
#include <string>

namespace meshopt
{
enum class Algorithm
{
  Paper1996 = 0, ///< the algorithm of the paper, step by step
  WorstFirst = 1 ///< the fast engine
};

enum class Effort
{
  Quick = 0,   ///< up to the target, by single changes; look-ahead only for the very worst cells
  Default = 1, ///< up to the target, with look-ahead
  Best = 2     ///< past the target, with more look-ahead, until nothing lifts the worst cell
};

struct Options
{
  Algorithm algorithm = Algorithm::WorstFirst;
  Measure measure = Measure::Shape;
  /// Weight of the size factor of (2.2); 0: shape only.
  double beta = 0.0;
  /// h* of (2.2), > 0 where beta > 0 unless a size is given at the points.
  double desiredSize = 0.0;
  /// Stop once the worst quality is at least this. In ]0, 1].
  double targetQuality = 0.6;

  bool moveNodes = true;   ///< node repositioning (section 2.2)
  bool reconnect = true;   ///< changes of topology that keep the points
  bool insertNodes = true; ///< changes of topology that add points
  bool removeNodes = true; ///< changes of topology that take points away

  /// When nothing else gains: changes that pay only together, or after nodes have moved. The paper
  /// has no such thing; without it Algorithm::Paper1996 is what the paper says.
  bool lookAhead = true;

  // --- the paper's parameters
  int neighborhoodLevel = 1;            ///< NL >= 0
  long maximumNumberOfIterations = 0;   ///< M, per repositioning; 0: no limit
  double epsilon = 0.02;                ///< (2.8)
  double armijo = 0.01;                 ///< alpha of (2.7)
  int maximumNumberOfAlternations = 20; ///< reconnection, then repositioning; at most so often
  bool naiveSearch = false; ///< rescan for the worst cell instead of the heap; same result (tests)

  // --- the fast engine's
  Effort effort = Effort::Default;
  int numberOfThreads = 0; ///< 0: all
  /// Greatest net growth of the number of cells, as a fraction; growthOf() for small meshes.
  double growthBudget = 0.15;
  double timeLimit = 0.0; ///< seconds, 0: none. Results are then not reproducible.

  /// A sentence that says which option is unusable and why; empty if all are fine.
  std::string check(bool hasSizes) const;
};

enum class StopReason
{
  NotRun = 0,
  TargetReached,   ///< the worst quality is at least the target
  CappedBySurface, ///< what is under the target cannot get better while the surface is kept
  NoFurtherGain,   ///< no operation improves the worst cells any more
  IterationLimit,
  TimeLimit,
  Aborted,     ///< by the caller; the mesh is valid, and as good as it was by then
  NothingToDo, ///< no triangles or tetrahedra
  GrowthLimit  ///< what would help needs more cells than growthBudget allows
};

/// A sentence for the user.
const char* toString(StopReason reason);

/// So many cells may come to so many. In a mesh of a few a fraction of them is not even room for one
/// node: it may have some.
long growthOf(const Options& options, long cells, int dimension);

/// Kinds of operations, as counted in the history.
enum class Operation
{
  NodeMotion = 0,  ///< one solve that moved one node or a cluster's nodes
  EdgeRemoval,     ///< an edge is replaced by faces (the paper: edge cluster to a ring node)
  FaceRemoval,     ///< faces are replaced by an edge (2-3 flip, multi-face removal)
  EdgeContraction, ///< a node goes (the paper: node cluster to a boundary node)
  NodeInsertion,   ///< a node comes (the paper: edge cluster to the midpoint; cavities)
  NodeReplacement, ///< a node is put at the centre of its cluster (the paper: node cluster to centre)
  Retriangulation, ///< a few cells are taken out together and filled anew in the best way
  LookAhead,       ///< several operations that pay only together
  Count
};
inline constexpr int NumberOfOperations = static_cast<int>(Operation::Count);
const char* toString(Operation op);

/// One row of the history.
struct PassRecord
{
  int pass = 0;
  std::string stage; ///< what was done in it: "input", "untangling", "reconnection", ...
  std::array<long, NumberOfOperations> tried{}, done{};
  double worst = 0.0, mean = 0.0; ///< after the pass
  long belowTarget = 0;           ///< cells under targetQuality after the pass
  long cells = 0, points = 0;     ///< live ones after the pass
  double seconds = 0.0;           ///< not part of any output array

  /// Takes over the work of another row, where the two become one.
  void addWork(const PassRecord& other)
  {
    for (int op = 0; op < NumberOfOperations; ++op)
    {
      this->tried[op] += other.tried[op];
      this->done[op] += other.done[op];
    }
    this->seconds += other.seconds;
  }
};

/// What became of the wanted sizes; all 0 where they were not followed.
struct SizeReport
{
  double predictedCells = 0.0; ///< as many elements as the sizes ask for (5.3)
  /// Cells when splitting was stopped: several times as many as predicted, as where the wanted lengths
  /// change faster than edges can follow. 0: it was not.
  long cellsAtBrake = 0;
  /// In the plane: the longest of the edges that had to stay, in the length that is wanted there.
  double longestKept = 0.0;
  bool isGivenUp = false;      ///< all has been undone: the worst would have been lower than before
  double worstWithSizes = 0.0; ///< the worst quality that it would have been; where given up
};

struct Report
{
  StopReason stopReason = StopReason::NotRun;
  double worstBefore = 0.0, worstAfter = 0.0;
  double meanBefore = 0.0, meanAfter = 0.0;
  /// Certified upper bound on the worst quality while the surface is kept (1 where unknown).
  double bound = 1.0;
  long cappedCells = 0; ///< cells under the target at the end that their own cap keeps there
  long invertedBefore = 0, invertedAfter = 0;
  SizeReport sizes;
  std::vector<PassRecord> history; ///< first row: the input
  double seconds = 0.0;
};

/// Progress and cancelling in one handle.
struct Control
{
  /// Called from the calling thread now and then with a fraction in [0, 1], never falling, and a
  /// short text; false asks to stop. May be empty.
  std::function<bool(double fraction, const std::string& text)> progress;
  /// Runs body(i) for 0 <= i < n, in any order, on several threads. Empty: one after another.
  std::function<void(int n, const std::function<void(int)>& body)> parallelFor;
};
}

#endif
