// SPDX-License-Identifier: BSD-3-Clause
// What Python cannot do to the ranks: a lack of memory anywhere, a message that arrives wrong. Run
// by mpirun. Whatever happens, no rank may wait for ever: the test would be stopped by its time.
#include "Ranks/vtkMeshRanksExchange.h"
#include "Ranks/vtkMeshRanksNode.h"

#include "vtkCallbackCommand.h"
#include "vtkCell.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkCommunicator.h"
#include "vtkIdTypeArray.h"
#include "vtkMPICommunicator.h"
#include "vtkMPIController.h"
#include "vtkMeshOptimizeFilter.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <cmath>
#include <cstring>
#include <iostream>
#include <map>
#include <new>
#include <random>
#include <thread>

namespace
{

int failures = 0;

void Check(bool fine, const std::string& text)
{
  if (!fine)
  {
    ++failures;
    std::cerr << "FAILED on rank "
              << vtkMultiProcessController::GetGlobalController()->GetLocalProcessId() << ": "
              << text << std::endl;
  }
}

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

void Count(vtkObject*, unsigned long, void* count, void*) { ++*static_cast<int*>(count); }

/**
 * A message that arrives wrong: an error on all, told once, and the state before it as output.
 */
void TestLastGoodState(vtkMPIController* controller)
{
  vtkNew<Corrupting> wire;
  wire->CopyFrom(vtkMPICommunicator::GetWorldCommunicator());
  vtkNew<vtkMPIController> wrong;
  wrong->SetCommunicator(wire);
  const int rank = controller->GetLocalProcessId(), ranks = controller->GetNumberOfProcesses();
  vtkNew<vtkUnstructuredGrid> piece;
  MakePiece(Size, rank, ranks, piece);
  vtkIdType cellsBefore = 0;
  for (int kind : { 0, 1, 2, 3 })
  {
    const bool isOn = kind > 0;
    wire->IsOn = isOn;
    wire->SparesBorders = kind == 2;
    wire->ChangesId = kind == 3;
    int told = 0;
    vtkNew<vtkCallbackCommand> listen;
    listen->SetCallback(Count);
    listen->SetClientData(&told);
    vtkNew<vtkMeshOptimizeFilter> f;
    f->AddObserver(vtkCommand::ErrorEvent, listen);
    f->SetController(wrong);
    f->OptimizeBordersOn();
    f->SetNumberOfThreads(1);
    f->SetInputData(piece);
    f->UpdatePiece(rank, ranks, 0);
    Check((f->GetErrorCode() != 0) == isOn, "the error code");
    Check(told == (isOn && rank == 0), "told " + std::to_string(told) + " times");
    auto output = vtkUnstructuredGrid::SafeDownCast(f->GetOutputDataObject(0));
    vtkIdType cells = output->GetNumberOfCells(), all = 0;
    Check(kind != 2 || cells == cellsBefore, "cells have moved, and were not taken back");
    cellsBefore = cells;
    controller->AllReduce(&cells, &all, 1, vtkCommunicator::SUM_OP);
    auto history = vtkTable::SafeDownCast(f->GetOutputDataObject(1));
    if (rank == 0)
    {
      Check(isOn == (history->GetNumberOfRows() == 2), "rows of the history");
      const vtkIdType last = history->GetNumberOfRows() - 1;
      Check(history->GetValueByName(last, "Cells").ToTypeInt64() == all, "another state");
    }
  }
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
 * A boundary that slides, along straight lines and splines, in pieces and from one rank.
 */
void TestSlide(vtkMPIController* controller)
{
  constexpr int n = 12;
  const int rank = controller->GetLocalProcessId(), ranks = controller->GetNumberOfProcesses();
  for (int kind : { 0, 1, 2 })
  {
    const bool isOnOne = kind == 2;
    vtkNew<vtkUnstructuredGrid> piece;
    MakePlanePiece(n, isOnOne ? 0 : rank, isOnOne ? 1 : ranks, piece);
    vtkNew<vtkUnstructuredGrid> nothing;
    vtkNew<vtkMeshOptimizeFilter> f;
    f->SetBoundaryModeToSlide();
    f->SetBoundaryCurve(
      kind == 0 ? vtkMeshOptimizeFilter::Straight : vtkMeshOptimizeFilter::BSpline);
    f->SetInputData(isOnOne && rank > 0 ? nothing : piece);
    f->UpdatePiece(rank, ranks, 0);
    Check(f->GetErrorCode() == 0, "sliding: an error");
    Check(
      f->GetWorstQualityAfter() >= 0.6, "sliding: " + std::to_string(f->GetWorstQualityAfter()));
    auto output = vtkUnstructuredGrid::SafeDownCast(f->GetOutputDataObject(0));
    double area = 0.0, all = 0.0;
    for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c)
    {
      double x[3][3];
      for (int i = 0; i < 3; ++i)
      {
        output->GetPoint(output->GetCell(c)->GetPointId(i), x[i]);
      }
      area += 0.5 *
        ((x[1][0] - x[0][0]) * (x[2][1] - x[0][1]) - (x[1][1] - x[0][1]) * (x[2][0] - x[0][0]));
    }
    controller->AllReduce(&area, &all, 1, vtkCommunicator::SUM_OP);
    Check(std::abs(all - n * n) < 1e-9, "sliding: area " + std::to_string(all));
  }
}

/**
 * A rank that fails at any place, outside of any function of Ranks, ends the work of all.
 */
void TestFailure(vtkMPIController* controller)
{
  const vtkMeshRanks::Ranks ranks(controller);
  for (int place = 0; place < 6; ++place)
  {
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
    Check(error.empty() == (place == 5), "place " + std::to_string(place) + ": " + error);
    const std::string last = "Rank " + std::to_string(ranks.GetCount() - 1) + ": ";
    Check(place == 5 || error.substr(0, last.size()) == last, error);
  }
  // Still in step.
  Check(ranks.Sum(1) == ranks.GetCount(), "the sum");
  std::vector<vtkMeshRanks::Bytes> out(ranks.GetCount());
  for (int r = 0; r < ranks.GetCount(); ++r)
  {
    out[r].assign(1000 * r + ranks.GetRank(), 'c');
  }
  const auto in = ranks.Exchange(std::move(out));
  for (int r = 0; r < ranks.GetCount(); ++r)
  {
    Check(in[r].size() == 1000u * ranks.GetRank() + r, "what was sent is not what came");
  }
}

void TestShareOfCores(vtkMPIController* controller)
{
  const vtkMeshRanks::Ranks ranks(controller);
  const int share = vtkMeshRanks::GetShareOfCores(ranks);
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  Check(share >= 1 && (share == 1 || share * ranks.GetCount() <= std::max(cores, ranks.GetCount())),
    "a share of " + std::to_string(share) + " cores");
}

} // namespace

int main(int argc, char* argv[])
{
  vtkNew<vtkMPIController> controller;
  controller->Initialize(&argc, &argv);
  vtkMultiProcessController::SetGlobalController(controller);
  TestFailure(controller);
  TestShareOfCores(controller);
  TestLastGoodState(controller);
  TestSlide(controller);
  int all = 0;
  controller->AllReduce(&failures, &all, 1, vtkCommunicator::SUM_OP);
  vtkMultiProcessController::SetGlobalController(nullptr);
  controller->Finalize();
  return all > 0 ? 1 : 0;
}
