// SPDX-License-Identifier: BSD-3-Clause
// Figures of all ranks are brought together, and become tables.
#include "QualityMinMax/vtkMeshQualityReport.h"

#include "vtkCell.h"
#include "vtkCellData.h"
#include "vtkCommunicator.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkMultiProcessController.h"
#include "vtkMultiProcessStream.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>

namespace vtkMeshQualityBridge
{
namespace
{

// Counts are 64 bits wide in the stream.
void Put(vtkMultiProcessStream& stream, std::int64_t count)
{
  stream << static_cast<vtkTypeInt64>(count);
}

std::int64_t TakeCount(vtkMultiProcessStream& stream)
{
  vtkTypeInt64 count = 0;
  stream >> count;
  return count;
}

void Put(vtkMultiProcessStream& stream, const Sums& s)
{
  const meshopt::QualityStatistics& q = s.Quality;
  for (const std::int64_t count : { q.count, q.invalid, q.inverted, s.OtherCells, s.CappedCells })
  {
    Put(stream, count);
  }
  stream << q.minimum << q.maximum << q.mean << q.squares << s.Bound;
}

/**
 * In the order in which Put() has written.
 */
Sums TakeSums(vtkMultiProcessStream& stream)
{
  Sums s;
  meshopt::QualityStatistics& q = s.Quality;
  for (std::int64_t* count : { &q.count, &q.invalid, &q.inverted, &s.OtherCells, &s.CappedCells })
  {
    *count = TakeCount(stream);
  }
  stream >> q.minimum >> q.maximum >> q.mean >> q.squares >> s.Bound;
  return s;
}

/**
 * The order here is the format: TakeFigures() reads in the same.
 */
void Put(vtkMultiProcessStream& stream, const Figures& f)
{
  stream << f.HasTetrahedra << f.HasTriangles;
  Put(stream, f.GhostSimplices);
  Put(stream, f.Total);
  Put(stream, static_cast<std::int64_t>(f.Regions.size()));
  for (const auto& region : f.Regions)
  {
    Put(stream, static_cast<std::int64_t>(region.first));
    Put(stream, region.second);
  }
  const std::vector<meshopt::WorstElement> worst = f.Worst.sorted();
  Put(stream, static_cast<std::int64_t>(worst.size()));
  for (const meshopt::WorstElement& e : worst)
  {
    stream << e.quality;
    Put(stream, e.part);
    Put(stream, e.id);
  }
}

Figures TakeFigures(vtkMultiProcessStream& stream, std::size_t numberOfWorstCells)
{
  Figures f(numberOfWorstCells);
  stream >> f.HasTetrahedra >> f.HasTriangles;
  f.GhostSimplices = TakeCount(stream);
  f.Total = TakeSums(stream);
  // Lists begin with their length.
  for (std::int64_t n = TakeCount(stream); n > 0; --n)
  {
    const long long region = TakeCount(stream);
    f.Regions[region] = TakeSums(stream);
  }
  for (std::int64_t n = TakeCount(stream); n > 0; --n)
  {
    meshopt::WorstElement e;
    stream >> e.quality;
    e.part = TakeCount(stream);
    e.id = TakeCount(stream);
    f.Worst.add(e);
  }
  return f;
}

// One process needs no messages, and no controller.
bool IsAlone(vtkMultiProcessController* controller)
{
  return !controller || controller->GetNumberOfProcesses() == 1;
}

/**
 * A column of a table.
 */
template <class Array>
Array* AddColumn(vtkTable* table, const char* name)
{
  vtkNew<Array> column;
  column->SetName(name);
  table->AddColumn(column);
  return column;
}

} // namespace

//------------------------------------------------------------------------------
bool Reduce(vtkMultiProcessController* controller, bool failed, std::size_t numberOfWorstCells,
  Figures& figures)
{
  if (IsAlone(controller))
  {
    return !failed;
  }
  // Processes that have failed take part, too: the others would wait for them for ever.
  vtkMultiProcessStream mine;
  mine << failed;
  Put(mine, figures);
  std::vector<vtkMultiProcessStream> all;
  // Everybody gets all, and adds up in the order of ranks: the same bits everywhere.
  controller->AllGather(mine, all);
  figures = Figures(numberOfWorstCells);
  bool anyFailed = false;
  for (vtkMultiProcessStream& stream : all)
  {
    bool thisFailed = false;
    stream >> thisFailed;
    anyFailed = anyFailed || thisFailed;
    figures.Merge(TakeFigures(stream, numberOfWorstCells));
  }
  return !anyFailed;
}

//------------------------------------------------------------------------------
void Reduce(vtkMultiProcessController* controller, meshopt::QualityHistogram& histogram)
{
  if (IsAlone(controller))
  {
    return;
  }
  const std::vector<vtkIdType> mine(histogram.counts.begin(), histogram.counts.end());
  std::vector<vtkIdType> all(mine.size());
  controller->AllReduce(
    mine.data(), all.data(), static_cast<vtkIdType>(mine.size()), vtkCommunicator::SUM_OP);
  std::copy(all.begin(), all.end(), histogram.counts.begin());
}

//------------------------------------------------------------------------------
double GreatestQuality(const Options& options, const Figures& figures)
{
  // Triangles and tetrahedra have different regular values where a measure is not normalized.
  const bool onlyTriangles = figures.HasTriangles && !figures.HasTetrahedra;
  return onlyTriangles ? meshopt::regularValue<2>(options.Measure)
                       : meshopt::regularValue<3>(options.Measure);
}

//------------------------------------------------------------------------------
meshopt::QualityHistogram MakeHistogram(
  const Options& options, const Figures& figures, int numberOfBins)
{
  // So all ranks have the same bins, from the reduced figures: counts can be added.
  const meshopt::QualityStatistics& q = figures.Total.Quality;
  // From 0, or from the worst inverted cell.
  const double low = std::min(0.0, q.minimum);
  const double high = std::max(GreatestQuality(options, figures), q.maximum);
  return meshopt::QualityHistogram(low, high, numberOfBins);
}

//------------------------------------------------------------------------------
void FillSummary(const Options& options, const Figures& figures, vtkTable* table)
{
  std::vector<std::pair<std::string, const Sums*>> rows;
  for (const auto& region : figures.Regions)
  {
    rows.emplace_back(std::to_string(region.first), &region.second);
  }
  rows.emplace_back("all", &figures.Total);

  auto* region = AddColumn<vtkStringArray>(table, "Region");
  auto* count = AddColumn<vtkIdTypeArray>(table, "Count");
  auto* minimum = AddColumn<vtkDoubleArray>(table, "Minimum");
  auto* mean = AddColumn<vtkDoubleArray>(table, "Mean");
  auto* maximum = AddColumn<vtkDoubleArray>(table, "Maximum");
  auto* deviation = AddColumn<vtkDoubleArray>(table, "StandardDeviation");
  auto* inverted = AddColumn<vtkIdTypeArray>(table, "Inverted");
  auto* invalid = AddColumn<vtkIdTypeArray>(table, "NotMeasurable");
  auto* other = AddColumn<vtkIdTypeArray>(table, "OtherCells");
  auto* bound = AddColumn<vtkDoubleArray>(table, "Bound");
  auto* capped = AddColumn<vtkIdTypeArray>(table, "CappedCells");
  // A region without cells has no qualities.
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  // No cell is better than the regular one, whatever the bound says.
  const double greatest = GreatestQuality(options, figures);
  for (const auto& row : rows)
  {
    const meshopt::QualityStatistics& q = row.second->Quality;
    const bool any = q.count > 0;
    region->InsertNextValue(row.first);
    count->InsertNextValue(q.count);
    minimum->InsertNextValue(any ? q.minimum : nothing);
    mean->InsertNextValue(any ? q.mean : nothing);
    maximum->InsertNextValue(any ? q.maximum : nothing);
    deviation->InsertNextValue(any ? q.standardDeviation() : nothing);
    inverted->InsertNextValue(q.inverted);
    invalid->InsertNextValue(q.invalid);
    other->InsertNextValue(row.second->OtherCells);
    bound->InsertNextValue(std::min(row.second->Bound, greatest));
    capped->InsertNextValue(row.second->CappedCells);
  }
}

//------------------------------------------------------------------------------
void FillHistogram(const meshopt::QualityHistogram& histogram, vtkTable* table)
{
  auto* centre = AddColumn<vtkDoubleArray>(table, "BinCenter");
  auto* low = AddColumn<vtkDoubleArray>(table, "BinLow");
  auto* high = AddColumn<vtkDoubleArray>(table, "BinHigh");
  auto* count = AddColumn<vtkIdTypeArray>(table, "Count");
  for (std::size_t i = 0; i < histogram.counts.size(); ++i)
  {
    const double a = histogram.edge(static_cast<int>(i));
    const double b = histogram.edge(static_cast<int>(i) + 1);
    centre->InsertNextValue(0.5 * (a + b));
    low->InsertNextValue(a);
    high->InsertNextValue(b);
    count->InsertNextValue(histogram.counts[i]);
  }
}

//------------------------------------------------------------------------------
void FillWorstCells(const Options& options, const std::vector<meshopt::WorstElement>& worst,
  const std::vector<Block>& blocks, int rank, bool isComposite, vtkUnstructuredGrid* output)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> quality, centre;
  vtkNew<vtkIdTypeArray> ids;
  vtkNew<vtkIntArray> ranks, blockIds;
  quality->SetName(ArrayName(options.Measure));
  ids->SetName("OriginalCellIds");
  ranks->SetName("Rank");
  blockIds->SetName("Block");
  centre->SetName("Center");
  centre->SetNumberOfComponents(3);
  output->SetPoints(points);
  output->AllocateExact(
    static_cast<vtkIdType>(worst.size()), 4 * static_cast<vtkIdType>(worst.size()));
  // By block: points of different blocks stay apart, also where they lie on each other.
  std::vector<std::unordered_map<vtkIdType, vtkIdType>> newIds(blocks.size());
  vtkNew<vtkIdList> nodes;
  for (const meshopt::WorstElement& e : worst)
  {
    const auto block = std::find_if(
      blocks.begin(), blocks.end(), [&e](const Block& b) { return b.Part == e.part; });
    // A cell of another rank: it is in the output there.
    if (block == blocks.end())
    {
      continue;
    }
    auto& known = newIds[block - blocks.begin()];
    block->Mesh->GetCellPoints(e.id, nodes);
    const int type = block->Mesh->GetCellType(e.id);
    // Centres make cells findable.
    double sum[3] = { 0.0, 0.0, 0.0 };
    int corners = 0;
    for (vtkIdType k = 0; k < nodes->GetNumberOfIds(); ++k)
    {
      double x[3];
      block->Mesh->GetPoint(nodes->GetId(k), x);
      // Points that several cells share come once.
      const auto at = known.emplace(nodes->GetId(k), points->GetNumberOfPoints());
      if (at.second)
      {
        points->InsertNextPoint(x);
      }
      nodes->SetId(k, at.first->second);
      for (int i = 0; i < 3; ++i)
      {
        sum[i] += x[i];
      }
      ++corners;
    }
    output->InsertNextCell(type, nodes);
    quality->InsertNextValue(e.quality);
    ids->InsertNextValue(e.id);
    ranks->InsertNextValue(rank);
    blockIds->InsertNextValue(static_cast<int>(block->FlatIndex));
    centre->InsertNextTuple3(sum[0] / corners, sum[1] / corners, sum[2] / corners);
  }
  vtkCellData* data = output->GetCellData();
  data->AddArray(ids);
  data->AddArray(ranks);
  if (isComposite)
  {
    data->AddArray(blockIds);
  }
  data->AddArray(centre);
  data->SetScalars(quality);
}

} // namespace vtkMeshQualityBridge
