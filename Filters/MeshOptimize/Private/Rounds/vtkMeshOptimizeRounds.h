// SPDX-License-Identifier: BSD-3-Clause
/**
 * The steps of one run on many ranks: pieces, rounds at the borders, figures of the whole.
 */
#ifndef vtkMeshOptimizeRounds_h
#define vtkMeshOptimizeRounds_h

#include "Ranks/vtkMeshRanksBound.h"
#include "Ranks/vtkMeshRanksCheck.h"
#include "Ranks/vtkMeshRanksIds.h"
#include "Request/vtkMeshOptimizeRequest.h"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

class vtkUnstructuredGrid;

namespace vtkMeshOptimizeBridge
{

/**
 * All functions are collective and fail as those of Ranks do.
 */
class Rounds
{
public:
  /**
   * `outcome` becomes that of the whole, the same on all ranks.
   */
  Rounds(const vtkMeshRanks::Ranks& ranks, const Request& request, Outcome& outcome);

  /**
   * Reads this rank's piece, numbers points and cells over all ranks, and divides the mesh if one
   * rank has all of it, or far more than the others. `simplices`: the cells that are the mesh; all
   * others are copies of those of other ranks, and are dropped. `dimension` is that of the cells of
   * all ranks. Returns why borders cannot take part, or an empty string. `input` must outlive the
   * rounds.
   */
  std::string Read(
    vtkUnstructuredGrid* input, const std::vector<vtkIdType>& simplices, int dimension);

  /**
   * Finds the zone that may change, and optimizes the piece of each rank with its border kept.
   */
  void OptimizePieces();

  /**
   * Bands around the borders move to one rank and are optimized there, until no cell under the goal
   * that can get better waits for another round, four times at most. A round that fails is undone
   * on all ranks, and ends them: outcome.Fault then says why.
   */
  void OptimizeBorders();

  /**
   * Cells go back to the rank that had them, or their parents, at first; except to ranks that would
   * have more than 1.2 of the mean, and more than any rank has without. If that fails, they stay,
   * and outcome.Fault says why.
   */
  void SendHome();

  /**
   * Completes data and figures, and makes the output.
   */
  void Write(vtkUnstructuredGrid* input, vtkUnstructuredGrid* output);

private:
  void FindPlane(vtkUnstructuredGrid* input, const std::vector<vtkIdType>& triangles);
  vtkMeshRanks::Signature Sign() const;
  void Divide();
  void GatherBoundary();
  meshopt::LineNetwork GatherGeometry() const;
  meshopt::PartOfBoundary ReadBoundary(const vtkMeshRanks::Part& part) const;
  void FinishBoundary(vtkMeshRanks::Part& part, const std::vector<std::uint64_t>& hull,
    const meshopt::PartOfBoundary& boundary) const;
  void CloseBoundary();
  void FindZone();
  void ShareGrowth();
  void RunIdle(vtkMeshRanks::Part& part, Outcome& idle);
  void Optimize(vtkMeshRanks::Part& part, double weight, double share, Outcome& outcome);
  vtkSmartPointer<vtkUnstructuredGrid> Lend(vtkMeshRanks::Part& part, int& home) const;
  void UndoConflicts(const vtkMeshRanks::Part& before, Outcome& run);
  void NumberNew(vtkMeshRanks::Part& part);
  void Round(int round, const vtkMeshRanks::Part& from);
  bool IsBest() const { return this->Wanted.Options.effort == meshopt::Effort::Best; }
  double GetGoal() const;
  void FindCaps(const vtkMeshRanks::Shared& shared);
  void MarkBorder(const vtkMeshRanks::Shared& shared, const std::vector<char>& isMoved);
  void WidenBorder(int layers);
  void FindGoalOfPieces();
  void FindGoalOfBands(const vtkMeshRanks::Part& part, const std::vector<int>& target);
  bool IsDone();
  void WaitWhereStuck();
  bool MustStop(const Outcome& run);
  std::vector<long long> ReadRegions() const;
  void RecordInput(const Outcome& run);
  void Record(const char* stage, const Outcome& run);
  meshopt::StopReason FindReason() const;

  const vtkMeshRanks::Ranks& All;
  Request Wanted;
  Outcome& Result;
  vtkMeshRanks::Schema Points, Cells;
  vtkMeshRanks::Numbering Ids;
  vtkIdType FirstNewPoint = 0;
  vtkMeshBridge::Frame<2> Plane;                        ///< of triangles
  std::array<double, 3> Normal = { { 0.0, 0.0, 1.0 } }; ///< of that plane
  std::vector<vtkIdType> FirstCell;                     ///< of each rank's input, over all ranks
  vtkUnstructuredGrid* Input = nullptr;                 ///< of this rank
  vtkMeshRanks::Part Mine;
  vtkIdType CellsAtFirst = 0, PointsAtFirst = 0; ///< of all ranks
  meshopt::WholeBoundary Boundary;               ///< of all ranks, if it slides
  std::map<vtkIdType, meshopt::Index> Corners;   ///< of the same: id and number in it
  double AreaAtFirst = 0.0;                      ///< the same
  long Growth = 0, Shrink = 0;    ///< how many cells all ranks may gain and lose, from CellsAtFirst
  bool HasZone = false;           ///< some cells may not change: those that are Kept
  vtkIdType CellsInZone = 0;      ///< of all ranks, at first
  vtkIdType BelowOutside = 0;     ///< cells outside of the zone that are under the target
  double WorstOutside = 1.0;      ///< of the cells outside of the zone, if there is one
  Outcome AtFirst;                ///< of a run that has measured only, if there is a zone
  double First = 0.0, Last = 1.0; ///< the part of the progress that runs now
  meshopt::StopReason Stopped = meshopt::StopReason::NotRun; ///< Aborted, TimeLimit, or NotRun
  vtkMeshRanks::SurfaceFigures Surface;                      ///< of the present state
  std::optional<vtkMeshRanks::Signature> Present;            ///< the same, after a round
  /// The quality up to which the best effort goes in the present runs. No part need get much better
  /// than what holds the whole elsewhere: the bound of its surface, or the worst cell outside of
  /// the bands.
  double Most = 1.0;
  /// Cells of the input are flat or inverted, or numbered so: runs may turn cells, and what two of
  /// them make side by side may not fit together.
  bool IsTangled = false;
  bool IsShort = false;    ///< the last run on some rank needed more cells than it may add
  bool MayTakeAll = false; ///< that run was allowed all that may still grow
};

} // namespace vtkMeshOptimizeBridge

#endif
