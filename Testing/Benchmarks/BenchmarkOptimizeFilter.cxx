// SPDX-License-Identifier: BSD-3-Clause
// One run of vtkMeshOptimizeFilter in a process of its own: what it cost and what came out, as one
// line of JSON. growth.py calls it.
//
//   BenchmarkOptimizeFilter MESH.vtu [quick|default|best] [threads]
//
// MESH.vtu holds tetrahedra. Memory is the peak of the process during Update() above what it held
// just before (the input, VTK and the program), so that the output is counted; it is known on Linux
// only, elsewhere 0. The bare pass is measured afterwards, so that its arrays are not taken for the
// filter's.
#include "vtkMeshOptimizeFilter.h"

#include "BarePassOfGrid.h"

#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkXMLUnstructuredGridReader.h"

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <string>

#ifdef __linux__
#include <malloc.h>
#endif

namespace
{

/**
 * A line of /proc/self/status, in bytes; 0 where there is none.
 */
double ProcessMemory(const std::string& key)
{
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
  {
    double kilobytes = 0.0;
    if (word == key + ":" && status >> kilobytes)
    {
      return 1024.0 * kilobytes;
    }
  }
  return 0.0;
}

/**
 * Gives freed memory back, and lets VmHWM, the greatest resident size, begin anew.
 */
void ResetPeak()
{
#ifdef __linux__
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
#endif
}

/**
 * FNV-1a over coordinates and node ids: equal for equal meshes.
 */
std::uint64_t Digest(vtkUnstructuredGrid* grid)
{
  std::uint64_t hash = 14695981039346656037u;
  const auto add = [&hash](const void* data, std::size_t n)
  {
    for (const auto* byte = static_cast<const unsigned char*>(data); n > 0; --n, ++byte)
    {
      hash = (hash ^ *byte) * 1099511628211u;
    }
  };
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    double x[3];
    grid->GetPoint(p, x);
    add(x, sizeof x);
  }
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    vtkIdType n = 0;
    const vtkIdType* ids = nullptr;
    grid->GetCellPoints(c, n, ids);
    add(ids, static_cast<std::size_t>(n) * sizeof(vtkIdType));
  }
  return hash;
}

int Usage()
{
  std::cerr << "BenchmarkOptimizeFilter MESH.vtu [quick|default|best] [threads]\n";
  return EXIT_FAILURE;
}

} // namespace

int main(int argc, char** argv)
{
  const std::string effort = argc > 2 ? argv[2] : "default";
  const char* const efforts[] = { "quick", "default", "best" };
  const auto chosen = std::find(efforts, efforts + 3, effort);
  if (argc < 2 || argc > 4 || chosen == efforts + 3)
  {
    return Usage();
  }
  vtkNew<vtkUnstructuredGrid> grid;
  {
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName(argv[1]);
    reader->Update();
    grid->ShallowCopy(reader->GetOutput());
  }
  if (grid->GetNumberOfCells() == 0)
  {
    std::cerr << argv[1] << ": no cells read\n";
    return EXIT_FAILURE;
  }
  vtkNew<vtkMeshOptimizeFilter> filter;
  filter->SetInputData(grid);
  filter->SetAlgorithmToWorstFirst();
  filter->SetEffort(static_cast<int>(chosen - efforts));
  filter->SetNumberOfThreads(argc > 3 ? std::atoi(argv[3]) : 1);

  ResetPeak();
  const double held = ProcessMemory("VmRSS");
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t clock = std::clock();
  filter->Update();
  const double processor = double(std::clock() - clock) / CLOCKS_PER_SEC;
  const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - start;
  const double peak = ProcessMemory("VmHWM");

  auto output = vtkUnstructuredGrid::SafeDownCast(filter->GetOutputDataObject(0));
  const double n = static_cast<double>(grid->GetNumberOfCells());
  const BarePass bare = MeasureBarePass(grid, 20);
  std::printf(
    "{\"cells\": %.0f, \"cells_after\": %lld, \"worst_before\": %.17g, \"worst_after\": %.17g, "
    "\"bound\": %.17g, \"stop\": \"%s\", \"optimize_s\": %.6f, \"whole_s\": %.6f, \"cpu_s\": %.6f, "
    "\"bare_s\": %.6f, \"bytes_per_tet\": %.1f, \"digest\": \"%016llx\"}\n",
    n, static_cast<long long>(output->GetNumberOfCells()), filter->GetWorstQualityBefore(),
    filter->GetWorstQualityAfter(), filter->GetQualityBound(), filter->GetStopReasonAsString(),
    filter->GetOptimizeSeconds(), whole.count(), processor, bare.Seconds, (peak - held) / n,
    static_cast<unsigned long long>(Digest(output)));
  return filter->GetErrorCode() == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
