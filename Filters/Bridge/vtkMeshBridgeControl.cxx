// SPDX-License-Identifier: BSD-3-Clause
// What the core asks of its caller, done by VTK: progress and abort by the filter, loops by
// vtkSMPTools. The core itself knows neither.
#include "vtkMeshBridgeControl.h"

#include "vtkMeshBridgeVTKCompat.h"

#include "vtkAlgorithm.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>

namespace vtkMeshBridge
{

int ResolveNumberOfThreads(int wanted)
{
  // In a scope with all threads: outside of it the application's backend would answer.
  int available = 1;
  vtkSMPTools::LocalScope(vtkSMPTools::Config{ 0, "STDThread", false },
    [&]() { available = vtkSMPTools::GetEstimatedNumberOfThreads(); });
  return wanted > 0 ? wanted : std::max(available, 1);
}

std::string CheckNumbers(const std::vector<std::pair<const char*, double>>& properties)
{
  for (const auto& [name, value] : properties)
  {
    if (std::isnan(value))
    {
      return std::string(name) + " is not a number.";
    }
  }
  return {};
}

meshopt::Control MakeControl(
  vtkAlgorithm* filter, int numberOfThreads, double first, double last, meshopt::Deadline deadline)
{
  meshopt::Control control;
  control.deadline = deadline;
  control.progress = [=](double fraction, const std::string& text)
  {
    filter->SetProgressText(text.c_str());
    filter->UpdateProgress(first + (last - first) * std::min(1.0, std::max(0.0, fraction)));
    return !CheckAbort(filter);
  };
  if (numberOfThreads > 1)
  {
    control.parallelFor = [=](int n, const std::function<void(int)>& body)
    {
      // Only for this call: what the application has set for other filters stays.
      vtkSMPTools::LocalScope(vtkSMPTools::Config{ numberOfThreads, "STDThread", false },
        [&]()
        {
          vtkSMPTools::For(0, n, 1,
            [&](vtkIdType begin, vtkIdType end)
            {
              for (vtkIdType i = begin; i < end; ++i)
              {
                body(static_cast<int>(i));
              }
            });
        });
    };
  }
  return control;
}

} // namespace vtkMeshBridge
