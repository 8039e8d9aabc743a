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

TEST(ThermoelasticFilterRun, SameBitsWithAnyNumberOfThreads)
{
  Grid box = MakeBox(12, 0.15);
  Filter one = HotBox(box);
  one->SetNumberOfThreads(1);
  Solve(one);
  for (const int threads : { 0, 2, 3 })
  {
    SCOPED_TRACE(std::to_string(threads) + " threads");
    Filter many = HotBox(box);
    many->SetNumberOfThreads(threads);
    Solve(many);
    EXPECT_TRUE(SameGrid(one->GetOutput(0), many->GetOutput(0)));
  }
}

TEST(ThermoelasticFilterRun, IncompleteCholeskyTakesFewerSteps)
{
  Grid box = MakeBox(12, 0.15);
  Filter one = Solve(HotBox(box));
  Filter cholesky = HotBox(box);
  cholesky->SetSolverToIncompleteCholesky();
  Solve(cholesky);
  EXPECT_LT(cholesky->GetNumberOfSolverIterations(), one->GetNumberOfSolverIterations());
  EXPECT_NEAR(cholesky->GetStrainEnergy() / one->GetStrainEnergy(), 1.0, 1e-8);
}

TEST(ThermoelasticFilterRun, DirectSolverTakesNone)
{
  Filter direct = HotBox(MakeBox(5, 0.15));
  direct->SetSolverToDirect();
  Solve(direct);
  EXPECT_EQ(direct->GetNumberOfSolverIterations(), 0);
  EXPECT_LT(direct->GetRelativeResidual(), 1e-12);
}

TEST(ThermoelasticFilterRun, IterationLimitIsAWarning)
{
  Filter filter = HotBox(MakeBox(4, 0.15));
  filter->SetMaximumNumberOfIterations(3);
  Messages messages(filter);
  filter->Update();
  EXPECT_EQ(messages.Errors, NoMessages);
  ASSERT_EQ(messages.Warnings.size(), 1u);
  EXPECT_TRUE(Says(messages.Warnings[0], "after 3 steps"));
  EXPECT_EQ(filter->GetStopReason(), vtkThermoelasticFilter::IterationLimit);
  EXPECT_STREQ(filter->GetStopReasonAsString(), "Tolerance not reached");
  EXPECT_EQ(filter->GetNumberOfSolverIterations(), 3);
  EXPECT_NE(PointArray(filter, "Stress"), nullptr);
}

/**
 * Progress never falls; an abort leaves outputs empty, and the filter works again afterwards.
 */
TEST(ThermoelasticFilterRun, ProgressNeverFallsAndAnAbortLeavesNothing)
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
  Solve(filter);
  EXPECT_TRUE(std::is_sorted(watch.Fractions.begin(), watch.Fractions.end()));
  ASSERT_FALSE(watch.Fractions.empty());
  EXPECT_EQ(watch.Fractions.back(), 1.0);

  watch.Abort = true;
  Messages messages(filter);
  filter->Modified();
  filter->Update();
  EXPECT_EQ(messages.Errors, NoMessages);
  EXPECT_EQ(filter->GetStopReason(), vtkThermoelasticFilter::Aborted);
  EXPECT_EQ(filter->GetOutput(0)->GetNumberOfCells(), 0);
  EXPECT_EQ(vtkTable::SafeDownCast(filter->GetOutputDataObject(1))->GetNumberOfRows(), 0);

  watch.Abort = false;
  filter->SetAbortExecute(0);
  filter->Modified();
  Solve(filter);
  EXPECT_EQ(filter->GetOutput(0)->GetNumberOfCells(), 6 * 1000);
}

TEST(ThermoelasticFilterRun, EmptyGridIsNothingToDo)
{
  Filter filter = MakeFilter(MakeGrid({}));
  Messages messages(filter);
  filter->Update();
  EXPECT_EQ(messages.Errors, NoMessages);
  EXPECT_EQ(filter->GetStopReason(), vtkThermoelasticFilter::NothingToDo);
  EXPECT_EQ(filter->GetOutput(0)->GetNumberOfCells(), 0);
}

} // namespace
