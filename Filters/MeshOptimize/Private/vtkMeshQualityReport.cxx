// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeshQualityReport.h"

#include "vtkCell.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>

namespace vtkMeshQuality
{
namespace
{

/**
 * Figures as a row of numbers, to be sent. Counts are exact up to 2^53.
 */
class Packer
{
public:
  std::vector<double> Data;

  void Pack(const Figures& f)
  {
    this->Data.push_back(f.HasTetrahedra);
    this->Data.push_back(f.HasTriangles);
    this->Pack(f.Total);
    this->Data.push_back(static_cast<double>(f.Regions.size()));
    for (const auto& region : f.Regions)
    {
      this->Data.push_back(static_cast<double>(region.first));
      this->Pack(region.second);
    }
    for (const meshopt::WorstElement& e : f.Worst.sorted())
    {
      this->Data.insert(
        this->Data.end(), { e.quality, static_cast<double>(e.part), static_cast<double>(e.id) });
    }
  }

private:
  void Pack(const Sums& s)
  {
    const meshopt::QualityStatistics& q = s.Quality;
    this->Data.insert(this->Data.end(),
      { static_cast<double>(q.count), static_cast<double>(q.invalid),
        static_cast<double>(q.inverted), q.minimum, q.maximum, q.mean, q.squares,
        static_cast<double>(s.OtherCells), s.Bound, static_cast<double>(s.CappedCells) });
  }
};

class Unpacker
{
public:
  Unpacker(const double* begin, const double* end)
    : At(begin)
    , End(end)
  {
  }

  Figures Unpack(std::size_t numberOfWorstCells)
  {
    Figures f(numberOfWorstCells);
    f.HasTetrahedra = this->Next() != 0.0;
    f.HasTriangles = this->Next() != 0.0;
    f.Total = this->UnpackSums();
    for (auto n = static_cast<std::size_t>(this->Next()); n > 0; --n)
    {
      const auto region = static_cast<long long>(this->Next());
      f.Regions[region] = this->UnpackSums();
    }
    while (this->At < this->End)
    {
      meshopt::WorstElement e;
      e.quality = this->Next();
      e.part = static_cast<std::int64_t>(this->Next());
      e.id = static_cast<std::int64_t>(this->Next());
      f.Worst.add(e);
    }
    return f;
  }

private:
  double Next() { return *this->At++; }

  Sums UnpackSums()
  {
    Sums s;
    meshopt::QualityStatistics& q = s.Quality;
    q.count = static_cast<std::int64_t>(this->Next());
    q.invalid = static_cast<std::int64_t>(this->Next());
    q.inverted = static_cast<std::int64_t>(this->Next());
    q.minimum = this->Next();
    q.maximum = this->Next();
    q.mean = this->Next();
    q.squares = this->Next();
    s.OtherCells = static_cast<std::int64_t>(this->Next());
    s.Bound = this->Next();
    s.CappedCells = static_cast<std::int64_t>(this->Next());
    return s;
  }

  const double* At;
  const double* End;
};

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
  Packer packer;
  packer.Pack(figures);
  const int ranks = controller->GetNumberOfProcesses();
  const vtkIdType mine[2] = { failed ? 1 : 0, static_cast<vtkIdType>(packer.Data.size()) };
  std::vector<vtkIdType> all(2 * ranks);
  controller->AllGather(mine, all.data(), 2);
  std::vector<vtkIdType> lengths(ranks), offsets(ranks);
  vtkIdType total = 0;
  for (int r = 0; r < ranks; ++r)
  {
    failed = failed || all[2 * r] != 0;
    lengths[r] = all[2 * r + 1];
    offsets[r] = total;
    total += lengths[r];
  }
  if (failed)
  {
    return false;
  }
  std::vector<double> data(total);
  controller->AllGatherV(packer.Data.data(), data.data(), mine[1], lengths.data(), offsets.data());
  figures = Figures(numberOfWorstCells);
  for (int r = 0; r < ranks; ++r)
  {
    const double* begin = data.data() + offsets[r];
    figures.Merge(Unpacker(begin, begin + lengths[r]).Unpack(numberOfWorstCells));
  }
  return true;
}

//------------------------------------------------------------------------------
void Reduce(vtkMultiProcessController* controller, meshopt::QualityHistogram& histogram)
{
  if (IsAlone(controller))
  {
    return;
  }
  const std::vector<vtkIdType> mine(histogram.counts.begin(), histogram.counts.end());
  const auto n = static_cast<vtkIdType>(mine.size());
  std::vector<vtkIdType> all(n * controller->GetNumberOfProcesses());
  controller->AllGather(mine.data(), all.data(), n);
  std::fill(histogram.counts.begin(), histogram.counts.end(), 0);
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    histogram.counts[i % n] += all[i];
  }
}

//------------------------------------------------------------------------------
double GreatestQuality(const Options& options, const Figures& figures)
{
  const bool onlyTriangles = figures.HasTriangles && !figures.HasTetrahedra;
  return onlyTriangles ? meshopt::regularValue<2>(options.Measure)
                       : meshopt::regularValue<3>(options.Measure);
}

//------------------------------------------------------------------------------
meshopt::QualityHistogram MakeHistogram(
  const Options& options, const Figures& figures, int numberOfBins)
{
  const meshopt::QualityStatistics& q = figures.Total.Quality;
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
  const double nothing = std::numeric_limits<double>::quiet_NaN();
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
void FillWorstCells(const std::vector<meshopt::WorstElement>& worst,
  const std::vector<Block>& blocks, int rank, bool isComposite, vtkUnstructuredGrid* output)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> quality, centre;
  vtkNew<vtkIdTypeArray> ids;
  vtkNew<vtkIntArray> ranks, blockIds;
  quality->SetName("MeshQuality");
  ids->SetName("OriginalCellIds");
  ranks->SetName("Rank");
  blockIds->SetName("Block");
  centre->SetName("Center");
  centre->SetNumberOfComponents(3);
  output->SetPoints(points);
  output->AllocateExact(
    static_cast<vtkIdType>(worst.size()), 4 * static_cast<vtkIdType>(worst.size()));
  std::vector<std::unordered_map<vtkIdType, vtkIdType>> newIds(blocks.size());
  vtkNew<vtkIdList> nodes;
  for (const meshopt::WorstElement& e : worst)
  {
    const auto block = std::find_if(
      blocks.begin(), blocks.end(), [&e](const Block& b) { return b.Part == e.part; });
    if (block == blocks.end())
    {
      continue;
    }
    auto& known = newIds[block - blocks.begin()];
    block->Mesh->GetCellPoints(e.id, nodes);
    const int type = block->Mesh->GetCellType(e.id);
    double sum[3] = { 0.0, 0.0, 0.0 };
    int corners = 0;
    for (vtkIdType k = 0; k < nodes->GetNumberOfIds(); ++k)
    {
      double x[3];
      block->Mesh->GetPoint(nodes->GetId(k), x);
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

} // namespace vtkMeshQuality
