// SPDX-License-Identifier: BSD-3-Clause
// Pieces first, each on its rank; then rounds in which bands of cells around borders are brought to
// one rank and optimized there. What moves is checked at each step, and a fault takes back the
// round, not the run.
#include "Rounds/vtkMeshOptimizeRounds.h"

#include "Ranks/vtkMeshRanksBand.h"
#include "Ranks/vtkMeshRanksCheck.h"
#include "Ranks/vtkMeshRanksDivide.h"
#include "Ranks/vtkMeshRanksPlane.h"
#include "Request/vtkMeshOptimizeArrays.h"
#include "vtkMeshBridgeControl.h"
#include "vtkMeshBridgeValues.h"

#include "vtkCellData.h"
#include "vtkPointData.h"
#include "vtkUnstructuredGrid.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>
#include <sstream>

namespace vtkMeshOptimizeBridge
{

using namespace vtkMeshRanks;
using meshopt::StopReason;

namespace
{

constexpr int MostRounds = 4;
/// Layers of cells around a border that take part in each round.
constexpr int Layers[MostRounds] = { 2, 2, 3, 4 };
/// The least number of layers with the best effort, whose pieces leave more cells to the first
/// round.
constexpr int LayersOfBest = 3;
/// The part of what may still grow that a round uses; the last may use all.
constexpr double ShareOfRound = 0.75;
/// If a rank has more than this times the mean, the mesh is divided anew.
constexpr double MostOfMeanAtFirst = 1.5;
/// The part of the progress that the pieces take.
constexpr double PiecesDone = 0.7;

/**
 * The values of an array of integers, without the way through doubles.
 */
std::vector<vtkIdType> ReadIds(vtkDataArray* array, const std::vector<vtkIdType>& chosen)
{
  if (!array)
  {
    return {};
  }
  const std::vector<long long> all = vtkMeshBridge::ReadIntegers(array);
  std::vector<vtkIdType> ids;
  ids.reserve(chosen.size());
  for (const vtkIdType i : chosen)
  {
    ids.push_back(static_cast<vtkIdType>(all[i]));
  }
  return ids;
}

/**
 * The text of the first rank that has one.
 */
std::string FirstOf(const Ranks& ranks, const std::string& text)
{
  for (const Bytes& bytes : ranks.Gather(Bytes(text.begin(), text.end())))
  {
    if (!bytes.empty())
    {
      return { bytes.begin(), bytes.end() };
    }
  }
  return {};
}

} // namespace

//------------------------------------------------------------------------------
Rounds::Rounds(const Ranks& ranks, const Request& request, Outcome& outcome)
  : All(ranks)
  , Wanted(request)
  , Result(outcome)
{
}

std::string Rounds::Read(
  vtkUnstructuredGrid* input, const std::vector<vtkIdType>& simplices, int dimension)
{
  this->Input = input;
  InputArrays arrays;
  this->All.Agree(FindInputArrays(this->Wanted.Filter, input, arrays));
  // A rank without cells may lack the arrays, too: it takes over those of the others.
  const vtkIdType count = input->GetNumberOfCells();
  Bytes schemas;
  if (count > 0)
  {
    schemas = Schema::Of(input->GetPointData()).Describe();
    const Bytes cells = Schema::Of(input->GetCellData(), Schema::Qualities::LeftOut).Describe();
    schemas.insert(schemas.end(), cells.begin(), cells.end());
  }
  for (const Bytes& bytes : this->All.Gather(schemas))
  {
    if (!bytes.empty())
    {
      Reader reader(bytes);
      this->Points = Schema::From(reader);
      this->Cells = Schema::From(reader);
      break;
    }
  }
  // Described and read again they would lose their information keys.
  if (count > 0) // with the arrays' information keys, which are not sent
  {
    this->Points = Schema::Of(input->GetPointData());
    this->Cells = Schema::Of(input->GetCellData(), Schema::Qualities::LeftOut);
  }
  this->FirstCell = this->All.Gather(count);
  this->CellsAtFirst = this->All.Sum(static_cast<vtkIdType>(simplices.size()));
  // Where the origins of each rank begin.
  std::exclusive_scan(
    this->FirstCell.begin(), this->FirstCell.end(), this->FirstCell.begin(), vtkIdType(0));
  std::vector<vtkIdType> points;
  if (dimension == 2)
  {
    this->FindPlane(input, simplices);
  }
  this->Mine = ReadPiece(input, simplices, dimension + 1, this->Points, this->Cells,
    arrays.FixedPoints, this->FirstCell[this->All.GetRank()], points);
  vtkDataArray* pointIds = input->GetPointData()->GetGlobalIds();
  vtkDataArray* cellIds = input->GetCellData()->GetGlobalIds();
  this->Ids.HasPointIds = this->All.IsAny(pointIds && count > 0);
  this->Ids.HasCellIds = this->All.IsAny(cellIds && count > 0);
  const std::vector<CellFacet> open = FindOpenFacets(this->Mine);
  // Before points are joined: copies would look like cracks then. Ids of cells say more of them.
  const bool coincide = DoPiecesCoincide(this->All, this->Mine, open, this->Normal);
  if (!coincide || this->Ids.HasCellIds)
  {
    Number(this->All, ReadIds(pointIds, points), ReadIds(cellIds, simplices), open, this->Ids,
      this->Mine);
    this->FirstNewPoint = this->Ids.NextPoint;
  }
  // As one mesh, copies would have their whole surface in common, and none left that is kept.
  if (coincide)
  {
    return "the pieces of the ranks lie on each other, as if each had read the whole mesh";
  }
  this->Divide();
  this->Mine.Home.assign(this->Mine.CellIds.size(), this->All.GetRank());
  const Shared shared = FindShared(this->All, this->Mine);
  for (vtkIdType p = 0; p < this->Mine.GetNumberOfPoints(); ++p)
  {
    // Points that several ranks have: no run has seen all that is around them.
    this->Mine.Flags[p] |= shared.Has(p) ? Waiting : 0;
  }
  this->PointsAtFirst = Measure(this->All, this->Mine, shared, 0.0).Points;
  this->CellsInZone = this->CellsAtFirst;
  this->ShareGrowth();
  this->GatherBoundary();
  return {};
}

/**
 * All triangles lie in one plane, and have one upper side, whatever the piece of a rank is like.
 */
void Rounds::FindPlane(vtkUnstructuredGrid* input, const std::vector<vtkIdType>& triangles)
{
  const vtkMeshBridge::GridView view(input);
  vtkMeshBridge::Box box;
  const vtkMeshBridge::Plane plane = vtkMeshRanks::FindPlane(this->All, view, triangles, box);
  std::string error = vtkMeshBridge::CheckExtent(box);
  if (error.empty() && !plane.HasAll())
  {
    std::ostringstream text;
    text << "The triangles are not in one plane: a point is " << plane.Farthest
         << " away from it (extent of the mesh " << plane.Extent
         << "). Triangles are optimized in a plane only; a volume needs tetrahedra.";
    error = text.str();
  }
  this->All.Agree(error);
  this->Plane = plane.Frame;
  const meshopt::Vec<3> normal = this->Plane.Axes[0].cross(this->Plane.Axes[1]);
  this->Normal = { { normal[0], normal[1], normal[2] } };
  this->Wanted.Plane = &this->Plane;
}

Signature Rounds::Sign() const { return vtkMeshRanks::Sign(this->All, this->Mine, this->Normal); }

void Rounds::Divide()
{
  const std::vector<vtkIdType> counts = this->All.Gather(this->Mine.GetNumberOfCells());
  const vtkIdType most = *std::max_element(counts.begin(), counts.end());
  // All cells on one rank, as a reader without pieces leaves them.
  const bool isOnOne = most == this->CellsAtFirst;
  const double mean = static_cast<double>(this->CellsAtFirst) / this->All.GetCount();
  if (static_cast<double>(most) <= MostOfMeanAtFirst * mean)
  {
    return;
  }
  const std::vector<double> work = PredictWork(this->All, this->Mine, this->Wanted.Options.measure,
    this->Wanted.Options.targetQuality, this->Plane);
  const std::vector<int> target = isOnOne
    ? vtkMeshRanks::Divide(this->Mine, work, this->All.GetCount())
    : vtkMeshRanks::DivideAnew(this->All, this->Mine, work);
  const Signature before = this->Sign();
  std::vector<char> isMoved;
  const Part all = std::move(this->Mine);
  Move(this->All, target, this->Points, this->Cells, all, this->Mine, isMoved);
  const std::string problem = Compare(before, this->Sign(), true);
  this->All.Agree(
    problem.empty() ? "" : "After the mesh was divided among the ranks " + problem + ".");
}

//------------------------------------------------------------------------------
void Rounds::NumberNew(Part& part)
{
  const auto count = [](const std::vector<vtkIdType>& ids)
  { return static_cast<vtkIdType>(std::count(ids.begin(), ids.end(), -1)); };
  const std::vector<vtkIdType> points = this->All.Gather(count(part.PointIds));
  const std::vector<vtkIdType> cells = this->All.Gather(count(part.CellIds));
  // Ids of new ones follow in the order of the ranks, so that they depend on no message.
  const auto before = [&](const std::vector<vtkIdType>& counts, vtkIdType next)
  { return std::accumulate(counts.begin(), counts.begin() + this->All.GetRank(), next); };
  vtkMeshRanks::NumberNew(
    before(points, this->Ids.NextPoint), before(cells, this->Ids.NextCell), part);
  this->Ids.NextPoint = std::accumulate(points.begin(), points.end(), this->Ids.NextPoint);
  this->Ids.NextCell = std::accumulate(cells.begin(), cells.end(), this->Ids.NextCell);
}

/**
 * Whether the user or the time limit ends the run, on any rank.
 */
bool Rounds::MustStop(const Outcome& run)
{
  const auto has = [&](StopReason reason)
  { return this->All.IsAny(run.Report.stopReason == reason); };
  if (has(StopReason::Aborted))
  {
    this->Stopped = StopReason::Aborted;
  }
  else if (has(StopReason::TimeLimit) || this->All.IsAny(this->Wanted.Control.isOutOfTime()))
  {
    this->Stopped = StopReason::TimeLimit;
  }
  return this->Stopped != StopReason::NotRun;
}

/**
 * Takes back what ranks have made of their pieces where cells that lie on each other have led two
 * ranks to the same facet. `run` is then one without any change, which gives the qualities.
 */
void Rounds::UndoConflicts(const Part& before, Outcome& run)
{
  bool isUndone = false;
  // A piece that is undone may meet pieces that are not: so this goes on until none has to. It
  // ends, since each piece is undone at most once.
  for (bool goesOn = true; goesOn;)
  {
    const bool undoes = HasOverusedFacet(this->All, this->Mine) && !isUndone;
    goesOn = this->All.IsAny(undoes);
    if (goesOn)
    {
      Part part = undoes ? before : MakePart(before.Corners, this->Points, this->Cells);
      Outcome idle;
      this->RunIdle(part, idle);
      if (undoes)
      {
        run = std::move(idle);
        this->Mine = std::move(part);
        isUndone = true;
      }
    }
  }
}

void Rounds::OptimizePieces()
{
  // Before any run, which may turn cells.
  this->IsTangled = this->All.IsAny(HasNotPositive(this->Mine, this->Normal));
  this->FindZone();
  if (this->IsBest())
  {
    this->FindGoalOfPieces();
  }
  else if (this->Wanted.Slide)
  {
    this->MarkBorder(FindShared(this->All, this->Mine), {});
  }
  // What is at a border cannot get much better now: its share is left for the rounds.
  double inside = 0.0;
  for (vtkIdType c = 0; c < this->Mine.GetNumberOfCells(); ++c)
  {
    const meshopt::Index* ids = this->Mine.GetCell(c);
    inside += !this->Mine.Kept[c] &&
      std::none_of(ids, ids + this->Mine.Corners,
        [&](vtkIdType p) { return (this->Mine.Flags[p] & Waiting) != 0; });
  }
  Outcome run;
  const Part before = this->IsTangled ? this->Mine : Part(); // shares the arrays
  this->Last = PiecesDone;
  this->Optimize(
    this->Mine, inside / static_cast<double>(std::max<vtkIdType>(this->CellsInZone, 1)), 1.0, run);
  if (this->IsTangled)
  {
    this->UndoConflicts(before, run);
  }
  const Outcome& atFirst = this->HasZone ? this->AtFirst : run; // of all cells
  this->Result.NumberOfSimplices = this->All.Sum(atFirst.NumberOfSimplices);
  this->Result.NumberOfCellsBefore = this->All.Sum(atFirst.NumberOfCellsBefore);
  this->Result.NumberOfReorientedCells = this->All.Sum(atFirst.NumberOfReorientedCells);
  this->Result.NumberOfOperations = this->All.Sum(run.NumberOfOperations);
  this->Result.Report.evaluations = this->All.Sum(run.Report.evaluations);
  this->Result.Overlap = FirstOf(this->All, atFirst.Overlap);
  this->RecordInput(atFirst);
  this->Record("pieces", run);
  this->MustStop(run);
}

//------------------------------------------------------------------------------
void Rounds::OptimizeBorders()
{
  for (int round = 0; round < MostRounds; ++round)
  {
    if (this->Stopped != StopReason::NotRun || this->IsDone())
    {
      return;
    }
    this->First = PiecesDone + (1.0 - PiecesDone) * round / MostRounds;
    this->Last = PiecesDone + (1.0 - PiecesDone) * (round + 1) / MostRounds;
    // A rank without a band would not hear of the user's wish in this round.
    const bool goesOn = vtkMeshBridge::MakeControl(this->Wanted.Filter, 1, this->First, this->Last)
                          .progress(0.0, "Borders, round " + std::to_string(round + 1));
    if (this->All.IsAny(!goesOn))
    {
      this->Stopped = StopReason::Aborted;
      return;
    }
    Part before = std::move(this->Mine); // for a round that is given up
    const vtkMeshRanks::Numbering ids = this->Ids;
    this->Result.Fault = this->All.Together(
      [&]()
      {
        this->Round(round, before);
        return std::string();
      });
    if (!this->Result.Fault.empty())
    {
      this->Mine = std::move(before);
      this->Ids = ids;
      return;
    }
  }
}

// Every step is collective, also for ranks without a band.
void Rounds::Round(int round, const Part& from)
{
  const Signature before = this->Present ? *this->Present
                                         : vtkMeshRanks::Sign(this->All, from, this->Normal);
  // Ids and places tell whether a move has lost anything.
  Shared shared = FindShared(this->All, from);
  std::vector<char> isMoved;
  const int layers = this->IsBest() ? std::max(LayersOfBest, Layers[round]) : Layers[round];
  const std::vector<int> target = FindBands(this->All, from, shared, layers);
  if (this->IsBest())
  {
    this->FindGoalOfBands(from, target);
  }
  Move(this->All, target, this->Points, this->Cells, from, this->Mine, isMoved);
  shared = FindShared(this->All, this->Mine);
  std::string problem = Compare(before, this->Sign(), true);
  this->All.Agree(problem.empty() ? "" : "After cells have moved between ranks " + problem + ".");
  for (vtkIdType p = 0; p < this->Mine.GetNumberOfPoints(); ++p)
  {
    if (!shared.Has(p))
    {
      // A point that one rank alone has now has all of its surroundings there.
      this->Mine.Flags[p] &= static_cast<std::uint8_t>(~Waiting);
    }
  }
  if (this->IsBest() || this->Wanted.Slide)
  {
    this->MarkBorder(shared, isMoved);
  }
  // Part 0 stays, part 1 is the band that this rank runs.
  std::vector<Part> parts = Split(
    std::move(this->Mine), std::vector<int>(isMoved.begin(), isMoved.end()), 2, 0);
  Outcome run;
  // What may be taken back. The arrays are shared.
  const Part rest = this->IsTangled ? parts[0] : Part(), band = this->IsTangled ? parts[1] : Part();
  // Growth is shared out by cells.
  const vtkIdType free = std::count(parts[1].Kept.begin(), parts[1].Kept.end(), 0);
  const double mine = static_cast<double>(free);
  const double bands = static_cast<double>(this->All.Sum(free));
  this->Result.NumberOfCellsInBands += this->All.Sum(parts[1].GetNumberOfCells());
  // What is kept back for later rounds goes to the one after a round that was short of cells.
  this->MayTakeAll = round + 1 == MostRounds || (round > 0 && this->IsShort);
  this->Optimize(
    parts[1], bands > 0.0 ? mine / bands : 0.0, this->MayTakeAll ? 1.0 : ShareOfRound, run);
  this->All.Agree(Join(std::move(parts), this->Mine));
  // As in UndoConflicts(): one rank takes back its band, which may bring up another fault.
  for (bool goesOn = this->IsTangled, isUndone = false; goesOn;)
  {
    const bool undoes = HasOverusedFacet(this->All, this->Mine) && !isUndone;
    goesOn = this->All.IsAny(undoes);
    if (undoes)
    {
      run = Outcome();
      isUndone = true;
    }
    this->All.Agree(undoes ? Join({ rest, band }, this->Mine) : "");
  }
  const Signature after = this->Sign();
  // A boundary that slides is another one now; what may not change is seen to after each run.
  problem = this->Wanted.Slide ? "" : Compare(before, after, false, this->IsTangled);
  this->All.Agree(problem.empty() ? "" : "After a round at the borders " + problem + ".");
  this->Result.NumberOfOperations += this->All.Sum(run.NumberOfOperations);
  this->Result.Report.evaluations += this->All.Sum(run.Report.evaluations);
  this->Record("borders", run);
  this->WaitWhereStuck();
  this->MustStop(run);
  this->Present = after; // last, since a fault up to here takes back the round
}

} // namespace vtkMeshOptimizeBridge
