// Progress, abort and threads of vtkMeshOptimizeFilter.
#include "MeshOptimizeFilterTesting.h"

#include "vtkSMPTools.h"

using namespace Testing;

namespace
{

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
void TestProgress(int algorithm)
{
  vtkNew<vtkMeshOptimizeFilter> filter;
  filter->SetInputData(MakeBox(7, 0.3));
  filter->SetAlgorithm(algorithm);
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
  CHECK(fractions.size() >= 3); // besides the executive's own 0 and 1
  CHECK(std::is_sorted(fractions.begin(), fractions.end()));
  CHECK(fractions.front() >= 0.0 && fractions.back() == 1.0);
  CHECK(!texts.empty());
}

/**
 * After an abort a valid mesh is there, no worse than before, and the filter can go on later.
 */
void TestAbort(int algorithm)
{
  Grid input = MakeBox(12, 0.3);
  vtkNew<vtkMeshOptimizeFilter> filter;
  Messages messages(filter);
  filter->SetInputData(input);
  filter->SetAlgorithm(algorithm);
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
  CHECK(messages.Errors.empty());
  CHECK(filter->GetStopReason() == vtkMeshOptimizeFilter::Aborted);
  CHECK(std::string(filter->GetStopReasonAsString()).find("abort") != std::string::npos);
  const double whenAborted = filter->GetWorstQualityAfter();
  CHECK(whenAborted >= filter->GetWorstQualityBefore());
  vtkUnstructuredGrid* output = filter->GetOutput();
  CHECK(output->GetNumberOfCells() > 0);
  CHECK(output->GetNumberOfCells() > 0 && KeptFacets(input) == KeptFacets(output));
  CHECK(output->GetNumberOfCells() > 0 &&
    MinimumOf(output->GetCellData()->GetArray("MeshQuality")) == whenAborted);
  CHECK(vtkTable::SafeDownCast(filter->GetOutputDataObject(1))->GetNumberOfRows() >= 1);

  // It is up to date now: nothing runs again just so.
  const vtkMTimeType time = output->GetMTime();
  filter->Update();
  CHECK(filter->GetOutput()->GetMTime() == time);

  stop = false;
  filter->SetAbortExecute(0);
  filter->SetTargetQuality(0.4);
  filter->Update();
  CHECK(filter->GetStopReason() != vtkMeshOptimizeFilter::Aborted);
  CHECK(filter->GetWorstQualityAfter() > whenAborted);
}

/**
 * The same bytes for any number of threads, and the application's backend is left as it was.
 */
void TestThreads()
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
    vtkNew<vtkMeshOptimizeFilter> filter;
    filter->SetInputData(input);
    filter->SetAlgorithmToWorstFirst();
    filter->SetNumberOfThreads(n);
    filter->Update();
    CHECK(SameGrid(one->GetOutput(), filter->GetOutput()));
  }
  CHECK(backend == vtkSMPTools::GetBackend());
  CHECK(threads == vtkSMPTools::GetEstimatedNumberOfThreads());
}

/**
 * A limit of time stops the run soon, with a mesh to show.
 */
void TestTimeLimit(int algorithm)
{
  vtkNew<vtkMeshOptimizeFilter> filter;
  filter->SetInputData(MakeBox(16, 0.3));
  filter->SetAlgorithm(algorithm);
  filter->SetTargetQuality(1.0);
  filter->SetTimeLimit(1e-3);
  filter->Update();
  CHECK(filter->GetStopReason() == vtkMeshOptimizeFilter::TimeLimitReached);
  CHECK(filter->GetWorstQualityAfter() >= filter->GetWorstQualityBefore());
  CHECK(filter->GetOutput()->GetNumberOfCells() > 0);
}

} // namespace

int main(int, char*[])
{
  for (const int algorithm :
    { vtkMeshOptimizeFilter::Paper1996, vtkMeshOptimizeFilter::WorstFirst })
  {
    TestProgress(algorithm);
    TestAbort(algorithm);
    TestTimeLimit(algorithm);
  }
  TestThreads();
  return Testing::Failures;
}
