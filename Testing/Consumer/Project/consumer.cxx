// A program of another project: optimizes a small grid, reports the worst quality.
#include "Sliver.h"

#include <vtkMeshOptimizeFilter.h>

#include <cstdlib>
#include <iostream>

int main()
{
  vtkNew<vtkMeshOptimizeFilter> optimize;
  optimize->SetInputData(makeSliver());
  optimize->SetTargetQuality(0.6);
  optimize->Update();
  std::cout << "worst quality " << optimize->GetWorstQualityBefore() << " -> "
            << optimize->GetWorstQualityAfter() << ", " << optimize->GetStopReasonAsString()
            << '\n';
  const bool better = optimize->GetWorstQualityAfter() > 2 * optimize->GetWorstQualityBefore();
  return better && optimize->GetWorstQualityBefore() > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
