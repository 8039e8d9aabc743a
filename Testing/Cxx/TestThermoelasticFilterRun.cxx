// SPDX-License-Identifier: BSD-3-Clause
// vtkThermoelasticFilter: threads, solvers, stop reasons, progress and abort.
#include "ThermoelasticFilterTesting.h"

using namespace Testing;

namespace
{

Filter HotBox(vtkUnstructuredGrid* box)
{
  Filter filter = MakeFilter(box);
  filter->SetTemperatureModeToRadial();
  filter->SetRadialCoefficient(1.0);
  filter->SetRigidMotionToPin();
  filter->SetTolerance(1e-8);
  return filter;
}

void TestThreadsAndSolvers()
{
  Grid box = MakeBox(12, 0.15);
  Filter one = HotBox(box);
  one->SetNumberOfThreads(1);
  Run(one);
  for (const int threads : { 0, 2, 3 })
  {
    Filter many = HotBox(box);
    many->SetNumberOfThreads(threads);
    Run(many);
    CHECK(SameGrid(one->GetOutput(0), many->GetOutput(0)));
  }
  Filter cholesky = HotBox(box);
  cholesky->SetSolverToIncompleteCholesky();
  Run(cholesky);
  CHECK(cholesky->GetNumberOfSolverIterations() < one->GetNumberOfSolverIterations());
  CHECK(std::abs(cholesky->GetStrainEnergy() / one->GetStrainEnergy() - 1.0) < 1e-8);
  Filter direct = HotBox(MakeBox(5, 0.15));
  direct->SetSolverToDirect();
  Run(direct);
  CHECK(direct->GetNumberOfSolverIterations() == 0);
  CHECK(direct->GetRelativeResidual() < 1e-12);
}

void TestNotConverged()
{
  Filter filter = HotBox(MakeBox(4, 0.15));
  filter->SetMaximumNumberOfIterations(3);
  Messages messages(filter);
  filter->Update();
  CHECK(messages.Errors.empty() && messages.Warnings.size() == 1);
  CHECK(
    !messages.Warnings.empty() && messages.Warnings[0].find("after 3 steps") != std::string::npos);
  CHECK(filter->GetStopReason() == vtkThermoelasticFilter::IterationLimit);
  CHECK(std::string(filter->GetStopReasonAsString()) == "Tolerance not reached");
  CHECK(filter->GetNumberOfSolverIterations() == 3);
  CHECK(PointArray(filter, "Stress") != nullptr);
}

/**
 * Progress never falls; an abort leaves outputs empty, and the filter works again afterwards.
 */
void TestProgressAndAbort()
{
  struct Watch
  {
    std::vector<double> Fractions;
    bool Abort = false;
  } watch;
  Filter filter = HotBox(MakeBox(10, 0.15));
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&watch);
  observer->SetCallback(
    [](vtkObject* caller, unsigned long, void* data, void* amount)
    {
      auto mine = static_cast<Watch*>(data);
      mine->Fractions.push_back(*static_cast<double*>(amount));
      if (mine->Abort)
      {
        vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1);
      }
    });
  filter->AddObserver(vtkCommand::ProgressEvent, observer);
  Run(filter);
  CHECK(std::is_sorted(watch.Fractions.begin(), watch.Fractions.end()));
  CHECK(!watch.Fractions.empty() && watch.Fractions.back() == 1.0);

  watch.Abort = true;
  Messages messages(filter);
  filter->Modified();
  filter->Update();
  CHECK(messages.Errors.empty());
  CHECK(filter->GetStopReason() == vtkThermoelasticFilter::Aborted);
  CHECK(filter->GetOutput(0)->GetNumberOfCells() == 0);
  CHECK(vtkTable::SafeDownCast(filter->GetOutputDataObject(1))->GetNumberOfRows() == 0);

  watch.Abort = false;
  filter->SetAbortExecute(0);
  filter->Modified();
  Run(filter);
  CHECK(filter->GetOutput(0)->GetNumberOfCells() == 6000);
}

void TestEmpty()
{
  Filter filter = MakeFilter(MakeGrid({}));
  Messages messages(filter);
  filter->Update();
  CHECK(messages.Errors.empty());
  CHECK(filter->GetStopReason() == vtkThermoelasticFilter::NothingToDo);
  CHECK(filter->GetOutput(0)->GetNumberOfCells() == 0);
}

} // namespace

int main()
{
  TestThreadsAndSolvers();
  TestNotConverged();
  TestProgressAndAbort();
  TestEmpty();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
