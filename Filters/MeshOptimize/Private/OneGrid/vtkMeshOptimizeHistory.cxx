// SPDX-License-Identifier: BSD-3-Clause
// The report of the core as a table, and as field data.
#include "OneGrid/vtkMeshOptimizeHistory.h"

#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

namespace vtkMeshOptimizeBridge
{
namespace
{

template <class Array>
void AddColumn(vtkTable* table, const std::string& name)
{
  vtkNew<Array> column;
  column->SetName(name.c_str());
  table->AddColumn(column);
}

/**
 * By name: the order of the columns is for the eye only.
 */
template <class Array, class Value>
void Append(vtkTable* table, const std::string& name, Value value)
{
  Array::SafeDownCast(table->GetColumnByName(name.c_str()))->InsertNextValue(value);
}

/**
 * As an array of one value: field data hold nothing else.
 */
template <class Array, class Value>
void AddFigure(vtkFieldData* fields, const char* name, Value value)
{
  vtkNew<Array> figure;
  figure->SetName(name);
  figure->InsertNextValue(value);
  fields->AddArray(figure);
}

/**
 * One tuple for each region, by ascending number. All in doubles, which hold numbers up to 2^53
 * exactly.
 */
void AddVolumes(const Outcome& outcome, vtkFieldData* fields)
{
  vtkNew<vtkDoubleArray> volumes;
  volumes->SetName("RegionVolumes");
  volumes->SetNumberOfComponents(3);
  volumes->SetComponentName(0, "Region");
  volumes->SetComponentName(1, "Before");
  volumes->SetComponentName(2, "After");
  for (const auto& [region, volume] : outcome.Volumes)
  {
    volumes->InsertNextTuple3(static_cast<double>(region), volume[0], volume[1]);
  }
  fields->AddArray(volumes);
}

} // namespace

void StartHistory(vtkTable* table, bool isComposite, bool slides)
{
  // No column of times: the same input must give the same table, bit for bit.
  if (isComposite)
  {
    AddColumn<vtkIntArray>(table, "Block");
  }
  AddColumn<vtkIntArray>(table, "Pass");
  AddColumn<vtkStringArray>(table, "Stage");
  // Counts are of vtkIdType: tries of a run on a large mesh can exceed an int.
  // The engine's list: a new operation gets its columns by itself.
  for (const std::string name : meshopt::OperationNames)
  {
    AddColumn<vtkIdTypeArray>(table, name + "Tried");
    AddColumn<vtkIdTypeArray>(table, name + "Done");
  }
  // Where nothing slides these columns would hold only zeros.
  if (slides)
  {
    AddColumn<vtkIdTypeArray>(table, "SurfaceChangeTried");
    AddColumn<vtkIdTypeArray>(table, "SurfaceChangeDone");
  }
  AddColumn<vtkDoubleArray>(table, "Worst");
  AddColumn<vtkDoubleArray>(table, "Mean");
  AddColumn<vtkIdTypeArray>(table, "BelowTarget");
  AddColumn<vtkIdTypeArray>(table, "Cells");
  AddColumn<vtkIdTypeArray>(table, "Points");
}

void AppendHistory(const meshopt::Report& report, int block, vtkTable* table)
{
  for (const meshopt::PassRecord& row : report.history)
  {
    // StartHistory() has decided which columns there are.
    if (table->GetColumnByName("Block"))
    {
      Append<vtkIntArray>(table, "Block", block);
    }
    Append<vtkIntArray>(table, "Pass", row.pass);
    Append<vtkStringArray>(table, "Stage", row.stage);
    for (int i = 0; i < meshopt::NumberOfOperations; ++i)
    {
      const std::string name = meshopt::OperationNames[i];
      Append<vtkIdTypeArray>(table, name + "Tried", row.tried[i]);
      Append<vtkIdTypeArray>(table, name + "Done", row.done[i]);
    }
    if (table->GetColumnByName("SurfaceChangeTried"))
    {
      Append<vtkIdTypeArray>(table, "SurfaceChangeTried", row.surfaceTried);
      Append<vtkIdTypeArray>(table, "SurfaceChangeDone", row.surfaceDone);
    }
    Append<vtkDoubleArray>(table, "Worst", row.worst);
    Append<vtkDoubleArray>(table, "Mean", row.mean);
    Append<vtkIdTypeArray>(table, "BelowTarget", row.belowTarget);
    Append<vtkIdTypeArray>(table, "Cells", row.cells);
    Append<vtkIdTypeArray>(table, "Points", row.points);
  }
}

void AddFigures(const Outcome& outcome, vtkDataObject* output)
{
  vtkFieldData* fields = output->GetFieldData();
  const meshopt::Report& report = outcome.Report;
  // Field data have the same figures as the filter, so that they are saved with the mesh.
  AddFigure<vtkDoubleArray>(fields, "WorstQualityBefore", report.worstBefore);
  AddFigure<vtkDoubleArray>(fields, "WorstQualityAfter", report.worstAfter);
  AddFigure<vtkDoubleArray>(fields, "MeanQualityBefore", report.meanBefore);
  AddFigure<vtkDoubleArray>(fields, "MeanQualityAfter", report.meanAfter);
  AddFigure<vtkDoubleArray>(fields, "QualityBound", outcome.QualityBound());
  AddFigure<vtkIdTypeArray>(fields, "NumberOfCappedCells", report.cappedCells);
  AddFigure<vtkIdTypeArray>(fields, "NumberOfInvertedCellsBefore", report.invertedBefore);
  AddFigure<vtkIdTypeArray>(fields, "NumberOfInvertedCellsAfter", report.invertedAfter);
  AddFigure<vtkIdTypeArray>(fields, "NumberOfReorientedCells", outcome.NumberOfReorientedCells);
  AddFigure<vtkIdTypeArray>(fields, "NumberOfOperations", outcome.NumberOfOperations);
  AddFigure<vtkIdTypeArray>(fields, "NumberOfEvaluations", report.evaluations);
  // Only a surface in space that slides has a distance, and changes volumes.
  if (outcome.HasSurfaceDistance)
  {
    AddFigure<vtkDoubleArray>(fields, "SurfaceDistance", outcome.SurfaceDistance);
    AddFigure<vtkDoubleArray>(fields, "VolumeChange", outcome.VolumeChange());
    AddVolumes(outcome, fields);
  }
  const meshopt::EdgeLengths& lengths = outcome.Lengths;
  // Measured only where sizes or a metric are given.
  if (lengths.edges > 0)
  {
    AddFigure<vtkDoubleArray>(fields, "EdgeLengthShare", lengths.share);
    vtkNew<vtkDoubleArray> histogram;
    histogram->SetName("EdgeLengthHistogram");
    histogram->SetNumberOfComponents(2);
    histogram->SetComponentName(0, "LengthFrom");
    histogram->SetComponentName(1, "Edges");
    for (std::size_t k = 0; k < lengths.histogram.size(); ++k)
    {
      histogram->InsertNextTuple2(
        meshopt::EdgeLengths::lowerEnd(k), static_cast<double>(lengths.histogram[k]));
    }
    fields->AddArray(histogram);
  }
  AddFigure<vtkStringArray>(fields, "StopReason", meshopt::describeStop(report));
}

} // namespace vtkMeshOptimizeBridge
