// SPDX-License-Identifier: BSD-3-Clause
// What Python cannot do to the ranks: a lack of memory anywhere, a message that arrives wrong. Run
// by mpirun: all ranks run the same cases in the same order. Whatever happens, no rank may wait for
// ever: the test would be stopped by its time. So no case ends early on one rank (no ASSERT).
#include "FilterTesting.h"
#include "Ranks/vtkMeshRanksExchange.h"
#include "Ranks/vtkMeshRanksNode.h"

#include "vtkCell.h"
#include "vtkCommunicator.h"
#include "vtkIdTypeArray.h"
#include "vtkMPICommunicator.h"
#include "vtkMPIController.h"
#include "vtkMeshOptimizeFilter.h"
#include "vtkObjectFactory.h"

#include <new>
#include <random>
#include <thread>

using namespace Testing;

namespace
{

vtkMultiProcessController* GetController()
{
  return vtkMultiProcessController::GetGlobalController();
}

int GetRank() { return GetController()->GetLocalProcessId(); }
int GetRanks() { return GetController()->GetNumberOfProcesses(); }

/**
 * A case that fails on one rank fails on all: the first rank, which tells what has passed, too.
 */
class MeshOptimizeRanks : public testing::Test
{
protected:
  void TearDown() override
  {
    const int mine = HasFailure() ? 1 : 0;
    int failed = 0;
    GetController()->AllReduce(&mine, &failed, 1, vtkCommunicator::SUM_OP);
    EXPECT_TRUE(failed == 0 || HasFailure()) << "failed on " << failed << " other ranks";
  }
};

/**
 * What ranks other than the first tell: only what has failed, in which case.
 */
class TellFailures : public testing::EmptyTestEventListener
{
public:
  void OnTestStart(const testing::TestInfo& test) override { this->Case = test.name(); }

  void OnTestPartResult(const testing::TestPartResult& result) override
  {
    if (result.failed())
    {
      std::cerr << "rank " << GetRank() << ", " << this->Case << ": "
                << (result.file_name() ? result.file_name() : "") << ":" << result.line_number()
                << ": " << result.message() << std::endl;
    }
  }

private:
  std::string Case; // it cannot be asked for while a result is told
};

constexpr int Size = 6; // of the cube

/**
 * Changes, the first time, the id of the first cell that a rank sends, or the last bits of points:
 * of all, or only of those that are not on the borders of the slabs. The former differ from the
 * points that the other rank has already, the latter only from those that stay behind.
 */
class Corrupting : public vtkMPICommunicator
{
public:
  static Corrupting* New() { VTK_STANDARD_NEW_BODY(Corrupting); }
  vtkTypeMacro(Corrupting, vtkMPICommunicator);
  bool IsOn = false, SparesBorders = false, ChangesId = false;

  int SendVoidArray(
    const void* data, vtkIdType length, int type, int remoteHandle, int tag) override
  {
    // A part of a mesh: the number of its points, their ids, the number of coordinates, these.
    vtkTypeInt64 points = 0, coordinates = 0;
    const char* bytes = static_cast<const char*>(data);
    if (this->IsOn && type == VTK_CHAR && length > 1000)
    {
      std::memcpy(&points, bytes, 8);
      if (points > 8 && points < length / 33 && length > 16 + 32 * points)
      {
        std::memcpy(&coordinates, bytes + 8 + 8 * points, 8);
      }
    }
    if (coordinates == 0 || coordinates != 3 * points) // other bytes make any number of points
    {
      return this->Superclass::SendVoidArray(data, length, type, remoteHandle, tag);
    }
    this->IsOn = false;
    std::vector<char> wrong(bytes, bytes + length);
    if (this->ChangesId)
    {
      // Flags of points and the number of cells come next, then the ids of these: of the first one.
      const std::size_t at = 32 + 33 * points;
      ++wrong[at + 5];
      return this->Superclass::SendVoidArray(wrong.data(), length, type, remoteHandle, tag);
    }
    for (vtkTypeInt64 i = 0; i < coordinates; ++i)
    {
      const std::size_t at = 16 + 8 * points + 8 * i;
      double x = 0.0;
      std::memcpy(&x, bytes + at - 8 * (i % 3), 8);
      wrong[at] ^= this->SparesBorders && this->IsAtBorder(x) ? 0 : 1;
    }
    return this->Superclass::SendVoidArray(wrong.data(), length, type, remoteHandle, tag);
  }

private:
  bool IsAtBorder(double x)
  {
    const int ranks = this->GetNumberOfProcesses();
    bool isAt = false;
    for (int r = 1; r < ranks; ++r)
    {
      isAt = isAt || std::abs(x - Size * r / ranks) < 0.5;
    }
    return isAt;
  }
};

/**
 * The slab of this rank of a cube of n^3 * 6 tetrahedra whose inner nodes are moved.
 */
void MakePiece(int n, int rank, int ranks, vtkUnstructuredGrid* grid)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> move(-0.3, 0.3);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("ids");
  std::map<vtkIdType, vtkIdType> local;
  const int first = n * rank / ranks, last = n * (rank + 1) / ranks;
  for (vtkIdType id = 0; id < (n + 1) * (n + 1) * (n + 1); ++id)
  {
    double x[3] = { double(id / ((n + 1) * (n + 1))), double(id / (n + 1) % (n + 1)),
      double(id % (n + 1)) };
    const bool isMine = first <= x[0] && x[0] <= last;
    const bool isInner = x[0] * x[1] * x[2] > 0 && x[0] < n && x[1] < n && x[2] < n;
    for (double& c : x)
    {
      c += isInner ? move(random) : 0.0;
    }
    if (isMine)
    {
      local[id] = points->InsertNextPoint(x);
      ids->InsertNextValue(id);
    }
  }
  grid->SetPoints(points);
  grid->GetPointData()->SetGlobalIds(ids);
  grid->Allocate();
  const int orders[6][3] = { { 0, 1, 2 }, { 1, 2, 0 }, { 2, 0, 1 }, { 0, 2, 1 }, { 2, 1, 0 },
    { 1, 0, 2 } };
  const vtkIdType step[3] = { (n + 1) * (n + 1), n + 1, 1 };
  for (int i = first; i < last; ++i)
  {
    for (int jk = 0; jk < n * n; ++jk)
    {
      for (int o = 0; o < 6; ++o)
      {
        vtkIdType at = i * step[0] + jk / n * step[1] + jk % n, corners[4] = { local[at] };
        for (int k = 0; k < 3; ++k)
        {
          at += step[orders[o][k]];
          corners[k + 1] = local[at];
        }
        if (o > 2)
        {
          std::swap(corners[0], corners[1]);
        }
        grid->InsertNextCell(VTK_TETRA, 4, corners);
      }
    }
  }
}

enum class Wrong
{
  Nothing,
  Points,
  InnerPoints,
  CellId
};

/**
 * What became of a run in which one message arrives wrong.
 */
struct Outcome
{
  bool HasFailed;
  std::size_t ErrorsTold;
  vtkIdType Cells, AllCells;              ///< of this rank, of all ranks
  vtkIdType Rows = 0, CellsInHistory = 0; ///< on the first rank
};

Outcome RunWith(Wrong what)
{
  vtkNew<Corrupting> wire;
  wire->CopyFrom(vtkMPICommunicator::GetWorldCommunicator());
  vtkNew<vtkMPIController> wrong;
  wrong->SetCommunicator(wire);
  wire->IsOn = what != Wrong::Nothing;
  wire->SparesBorders = what == Wrong::InnerPoints;
  wire->ChangesId = what == Wrong::CellId;
  vtkNew<vtkUnstructuredGrid> piece;
  MakePiece(Size, GetRank(), GetRanks(), piece);
  vtkNew<vtkMeshOptimizeFilter> f;
  Messages messages(f);
  f->SetController(wrong);
  f->OptimizeBordersOn();
  f->SetNumberOfThreads(1);
  f->SetInputData(piece);
  f->UpdatePiece(GetRank(), GetRanks(), 0);

  Outcome result;
  result.HasFailed = f->GetErrorCode() != 0;
  result.ErrorsTold = messages.Errors.size();
  result.Cells = f->GetOutput()->GetNumberOfCells();
  GetController()->AllReduce(&result.Cells, &result.AllCells, 1, vtkCommunicator::SUM_OP);
  auto history = vtkTable::SafeDownCast(f->GetOutputDataObject(1));
  if (GetRank() == 0)
  {
    result.Rows = history->GetNumberOfRows();
    result.CellsInHistory = history->GetValueByName(result.Rows - 1, "Cells").ToTypeInt64();
  }
  return result;
}

/**
 * An error on all, told once, and the state before it as output. The first message with a part of
 * a mesh is that of the first band of borders: the input and the pieces, each by itself, are in the
 * history.
 */
void ExpectLastGoodState(const Outcome& outcome)
{
  EXPECT_TRUE(outcome.HasFailed);
  EXPECT_EQ(outcome.ErrorsTold, GetRank() == 0 ? 1u : 0u);
  if (GetRank() == 0)
  {
    EXPECT_EQ(outcome.Rows, 2);
    EXPECT_EQ(outcome.CellsInHistory, outcome.AllCells);
  }
}

//------------------------------------------------------------------------------
TEST_F(MeshOptimizeRanks, ASoundWireIsNoError)
{
  const Outcome outcome = RunWith(Wrong::Nothing);
  EXPECT_FALSE(outcome.HasFailed);
  EXPECT_EQ(outcome.ErrorsTold, 0u);
  if (GetRank() == 0)
  {
    EXPECT_NE(outcome.Rows, 2); // so the other cases end before the end
    EXPECT_EQ(outcome.CellsInHistory, outcome.AllCells);
  }
}

TEST_F(MeshOptimizeRanks, PointsThatArriveWrongLeaveTheLastGoodState)
{
  ExpectLastGoodState(RunWith(Wrong::Points));
}

/**
 * Only points that the other rank does not have yet: it notices when the cells have moved, and they
 * are taken back.
 */
TEST_F(MeshOptimizeRanks, CellsThatHaveMovedAreTakenBack)
{
  const Outcome outcome = RunWith(Wrong::InnerPoints);
  ExpectLastGoodState(outcome);
  EXPECT_EQ(outcome.Cells, RunWith(Wrong::Points).Cells);
}

TEST_F(MeshOptimizeRanks, AnIdThatArrivesWrongLeavesTheLastGoodState)
{
  ExpectLastGoodState(RunWith(Wrong::CellId));
}

/**
 * The slab of this rank of a square of n^2 * 2 triangles. Inner nodes are moved, nodes on the sides
 * along these.
 */
void MakePlanePiece(int n, int rank, int ranks, vtkUnstructuredGrid* grid)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> move(-0.4, 0.4);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  std::map<vtkIdType, vtkIdType> local;
  const int first = n * rank / ranks, last = n * (rank + 1) / ranks;
  for (vtkIdType id = 0; id < (n + 1) * (n + 1); ++id)
  {
    const double at[2] = { double(id / (n + 1)), double(id % (n + 1)) };
    double x[3] = { at[0], at[1], 0.0 };
    for (int k = 0; k < 2; ++k)
    {
      const double away = move(random);
      x[k] += at[k] > 0 && at[k] < n ? away : 0.0;
    }
    if (first <= at[0] && at[0] <= last)
    {
      local[id] = points->InsertNextPoint(x);
    }
  }
  grid->SetPoints(points);
  grid->Allocate();
  for (vtkIdType id = first * (n + 1); id < last * (n + 1); ++id)
  {
    if (id % (n + 1) < n)
    {
      const vtkIdType a[3] = { local[id], local[id + n + 1], local[id + n + 2] };
      const vtkIdType b[3] = { local[id], local[id + n + 2], local[id + 1] };
      grid->InsertNextCell(VTK_TRIANGLE, 3, a);
      grid->InsertNextCell(VTK_TRIANGLE, 3, b);
    }
  }
}

/**
 * Slides the boundary of a square whose pieces are on all ranks, or all on the first.
 */
void CheckSlide(int curve, bool isOnOne)
{
  constexpr int n = 12;
  vtkNew<vtkUnstructuredGrid> piece, nothing;
  MakePlanePiece(n, isOnOne ? 0 : GetRank(), isOnOne ? 1 : GetRanks(), piece);
  vtkNew<vtkMeshOptimizeFilter> f;
  Messages messages(f);
  f->SetBoundaryModeToSlide();
  f->SetBoundaryCurve(curve);
  f->SetInputData(isOnOne && GetRank() > 0 ? nothing : piece);
  f->UpdatePiece(GetRank(), GetRanks(), 0);
  EXPECT_EQ(f->GetErrorCode(), 0u);
  EXPECT_EQ(messages.Errors, NoMessages);
  EXPECT_GE(f->GetWorstQualityAfter(), f->GetTargetQuality());
  vtkUnstructuredGrid* output = f->GetOutput();
  double area = 0.0, all = 0.0;
  for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c)
  {
    const std::vector<vtkIdType> ids = CellPoints(output, c);
    const Point x = GetPoint(output, ids[0]), y = GetPoint(output, ids[1]),
                z = GetPoint(output, ids[2]);
    area += 0.5 * ((y[0] - x[0]) * (z[1] - x[1]) - (y[1] - x[1]) * (z[0] - x[0]));
  }
  GetController()->AllReduce(&area, &all, 1, vtkCommunicator::SUM_OP);
  EXPECT_NEAR(all, n * n, 1e-9); // sides are straight whatever the curve
}

TEST_F(MeshOptimizeRanks, ABoundaryInPiecesSlidesAlongLines)
{
  CheckSlide(vtkMeshOptimizeFilter::Straight, false);
}

TEST_F(MeshOptimizeRanks, ABoundaryInPiecesSlidesAlongSplines)
{
  CheckSlide(vtkMeshOptimizeFilter::BSpline, false);
}

TEST_F(MeshOptimizeRanks, ABoundaryOfOneRankSlides)
{
  CheckSlide(vtkMeshOptimizeFilter::BSpline, true);
}

/**
 * A rank that fails at any place, outside of any function of Ranks, ends the work of all.
 */
TEST_F(MeshOptimizeRanks, AFailureAtAnyPlaceEndsTheWorkOfAll)
{
  const vtkMeshRanks::Ranks ranks(GetController());
  const std::string last = "Rank " + std::to_string(ranks.GetCount() - 1) + ": ";
  for (int place = 0; place < 6; ++place)
  {
    SCOPED_TRACE("place " + std::to_string(place));
    const std::string error = ranks.Together(
      [&]()
      {
        for (int step = 0; step < 5; ++step)
        {
          if (step == place && ranks.GetRank() == ranks.GetCount() - 1)
          {
            throw std::bad_alloc();
          }
          switch (step)
          {
            case 0:
              ranks.Exchange(std::vector<vtkMeshRanks::Bytes>(ranks.GetCount(), { 'a' }));
              break;
            case 1:
              ranks.Gather(vtkMeshRanks::Bytes(ranks.GetRank(), 'b'));
              break;
            case 2:
              ranks.Sum(1);
              break;
            case 3:
              ranks.Agree("");
              break;
            default:
              ranks.Gather(1.0);
          }
        }
        return std::string();
      });
    EXPECT_EQ(error.empty(), place == 5) << error; // there is no step 5
    EXPECT_TRUE(place == 5 || error.substr(0, last.size()) == last) << error;
  }
  EXPECT_EQ(ranks.Sum(1), ranks.GetCount()) << "no longer in step";
}

TEST_F(MeshOptimizeRanks, WhatIsSentComes)
{
  const vtkMeshRanks::Ranks ranks(GetController());
  const auto message = [](int from, int to)
  { return vtkMeshRanks::Bytes(1000 * to + from, static_cast<char>('a' + from)); };
  std::vector<vtkMeshRanks::Bytes> out;
  for (int r = 0; r < ranks.GetCount(); ++r)
  {
    out.push_back(message(ranks.GetRank(), r));
  }
  const auto in = ranks.Exchange(std::move(out));
  for (int r = 0; r < ranks.GetCount(); ++r)
  {
    EXPECT_EQ(in[r], message(r, ranks.GetRank())) << "from rank " << r;
  }
}

/**
 * All ranks run on this computer.
 */
TEST_F(MeshOptimizeRanks, CoresAreShared)
{
  const vtkMeshRanks::Ranks ranks(GetController());
  const int share = vtkMeshRanks::GetShareOfCores(ranks);
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  EXPECT_GE(share, 1);
  EXPECT_TRUE(share == 1 || share * ranks.GetCount() <= cores) << share << " of " << cores;
}

} // namespace

int main(int argc, char* argv[])
{
  vtkNew<vtkMPIController> controller;
  controller->Initialize(&argc, &argv);
  vtkMultiProcessController::SetGlobalController(controller);
  testing::InitGoogleTest(&argc, argv);
  if (GetRank() > 0)
  {
    testing::TestEventListeners& listeners = testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
    listeners.Append(new TellFailures);
  }
  const int result = RUN_ALL_TESTS();
  vtkMultiProcessController::SetGlobalController(nullptr);
  controller->Finalize();
  return result;
}
