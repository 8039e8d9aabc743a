// SPDX-License-Identifier: BSD-3-Clause
// Progress, abort and threads of vtkMeshOptimizeFilter.
#include "MeshOptimizeFilterTesting.h"

#include "vtkSMPTools.h"

using namespace Testing;

namespace
{

class MeshOptimizeFilterControl : public BothAlgorithms
{
};
TEST_BOTH_ALGORITHMS(MeshOptimizeFilterControl);

/**
 * Calls a function on each progress event.
 */
void OnProgress(vtkAlgorithm* filter, std::function<void(vtkAlgorithm*, double)>* react)
{
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(react);
  observer->SetCallback(
    [](vtkObject* caller, unsigned long, void* function, void* amount)
    {
      (*static_cast<std::function<void(vtkAlgorithm*, double)>*>(function))(
        vtkAlgorithm::SafeDownCast(caller), *static_cast<double*>(amount));
    });
  filter->AddObserver(vtkCommand::ProgressEvent, observer);
}

/**
 * Fractions never fall, end at 1, and a text says what is done.
 */
TEST_P(MeshOptimizeFilterControl, ProgressNeverFallsAndEndsAtOne)
{
  OptimizeFilter filter(GetParam());
  filter->SetInputData(MakeBox(7, 0.3));
  filter->SetTargetQuality(1.0);
  std::vector<double> fractions;
  std::set<std::string> texts;
  std::function<void(vtkAlgorithm*, double)> react = [&](vtkAlgorithm* self, double fraction)
  {
    fractions.push_back(fraction);
    if (self->GetProgressText())
    {
      texts.insert(self->GetProgressText());
    }
  };
  OnProgress(filter, &react);
  filter->Update();
  EXPECT_GE(fractions.size(), 3u); // besides the executive's own 0 and 1
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_GE(fractions.front(), 0.0);
  EXPECT_EQ(fractions.back(), 1.0);
  EXPECT_FALSE(texts.empty());
}

/**
 * After an abort a valid mesh is there, no worse than before, and the filter can go on later.
 */
TEST_P(MeshOptimizeFilterControl, AbortLeavesAMeshAndTheFilterGoesOnLater)
{
  Grid input = MakeBox(12, 0.3);
  OptimizeFilter filter(GetParam());
  Messages messages(filter);
  filter->SetInputData(input);
  filter->SetTargetQuality(1.0);
  bool stop = true;
  std::function<void(vtkAlgorithm*, double)> react = [&](vtkAlgorithm* self, double fraction)
  {
    if (stop && fraction < 1.0)
    {
      self->SetAbortExecute(1);
    }
  };
  OnProgress(filter, &react);
  filter->Update();
  EXPECT_EQ(messages.Errors, NoMessages);
  EXPECT_EQ(filter->GetStopReason(), vtkMeshOptimizeFilter::Aborted);
  EXPECT_TRUE(Says(filter->GetStopReasonAsString(), "abort"));
  const double whenAborted = filter->GetWorstQualityAfter();
  EXPECT_GE(whenAborted, filter->GetWorstQualityBefore());
  vtkUnstructuredGrid* output = filter->GetOutput();
  ASSERT_GT(output->GetNumberOfCells(), 0);
  EXPECT_TRUE(SameFacets(KeptFacets(input), KeptFacets(output)));
  EXPECT_EQ(MinimumOf(output->GetCellData()->GetArray("MeshQuality")), whenAborted);
  EXPECT_GE(vtkTable::SafeDownCast(filter->GetOutputDataObject(1))->GetNumberOfRows(), 1);

  // It is up to date now: nothing runs again just so.
  const vtkMTimeType time = output->GetMTime();
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetMTime(), time);

  stop = false;
  filter->SetAbortExecute(0);
  filter->SetTargetQuality(0.4);
  filter->Update();
  EXPECT_NE(filter->GetStopReason(), vtkMeshOptimizeFilter::Aborted);
  EXPECT_GT(filter->GetWorstQualityAfter(), whenAborted);
}

/**
 * The same bytes for any number of threads, and the application's backend is left as it was.
 */
TEST(MeshOptimizeFilterThreads, SameBytesWithAnyNumberAndTheBackendIsLeft)
{
  const std::string backend = vtkSMPTools::GetBackend();
  const int threads = vtkSMPTools::GetEstimatedNumberOfThreads();
  Grid input = MakeBox(10, 0.3);
  vtkNew<vtkMeshOptimizeFilter> one;
  one->SetInputData(input);
  one->SetAlgorithmToWorstFirst();
  one->SetNumberOfThreads(1);
  one->Update();
  for (const int n : { 0, 2, 3, 8 })
  {
    SCOPED_TRACE(std::to_string(n) + " threads");
    vtkNew<vtkMeshOptimizeFilter> filter;
    filter->SetInputData(input);
    filter->SetAlgorithmToWorstFirst();
    filter->SetNumberOfThreads(n);
    filter->Update();
    EXPECT_TRUE(SameGrid(one->GetOutput(), filter->GetOutput()));
  }
  EXPECT_EQ(backend, vtkSMPTools::GetBackend());
  EXPECT_EQ(threads, vtkSMPTools::GetEstimatedNumberOfThreads());
}

/**
 * A limit of time stops the run, with a mesh to show. No machine does it in a microsecond.
 */
TEST_P(MeshOptimizeFilterControl, TimeLimitLeavesAMesh)
{
  OptimizeFilter filter(GetParam());
  filter->SetInputData(MakeBox(16, 0.3));
  filter->SetTargetQuality(1.0);
  filter->SetTimeLimit(1e-6);
  filter->Update();
  EXPECT_EQ(filter->GetStopReason(), vtkMeshOptimizeFilter::TimeLimitReached);
  EXPECT_GE(filter->GetWorstQualityAfter(), filter->GetWorstQualityBefore());
  EXPECT_GT(filter->GetOutput()->GetNumberOfCells(), 0);
}

} // namespace
