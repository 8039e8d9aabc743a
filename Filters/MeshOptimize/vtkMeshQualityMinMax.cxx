// SPDX-License-Identifier: BSD-3-Clause
// Properties, ports and blocks. Each block is measured by the functions of Private; ranks meet for
// the plane of triangles, the surface, the figures and the histogram.
#include "vtkMeshQualityMinMax.h"

#include "QualityMinMax/vtkMeshQualityRanks.h"
#include "QualityMinMax/vtkMeshQualityReport.h"
#include "Request/vtkMeshOptimizeArrays.h"
#include "vtkMeshBridgeBlocks.h"
#include "vtkMeshBridgeControl.h"
#include "vtkMeshBridgeGridView.h"
#include "vtkMeshBridgeVTKCompat.h"

#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkDoubleArray.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkMeshQualityMinMax);
vtkCxxSetObjectMacro(vtkMeshQualityMinMax, Controller, vtkMultiProcessController);

namespace quality = vtkMeshQualityBridge;

//------------------------------------------------------------------------------
vtkMeshQualityMinMax::vtkMeshQualityMinMax()
{
  this->SetNumberOfOutputPorts(4);
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

//------------------------------------------------------------------------------
vtkMeshQualityMinMax::~vtkMeshQualityMinMax() { this->SetController(nullptr); }

//------------------------------------------------------------------------------
void vtkMeshQualityMinMax::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "QualityMeasure: " << this->QualityMeasure << "\n";
  os << indent << "Beta: " << this->Beta << "\n";
  os << indent << "DesiredSize: " << this->DesiredSize << "\n";
  os << indent << "NumberOfWorstCells: " << this->NumberOfWorstCells << "\n";
  os << indent << "NumberOfBins: " << this->NumberOfBins << "\n";
  os << indent << "ComputeBound: " << this->ComputeBound << "\n";
  os << indent << "TargetQuality: " << this->TargetQuality << "\n";
  os << indent << "Controller: " << this->Controller << "\n";
  os << indent << "MinimumQuality: " << this->MinimumQuality << "\n";
  os << indent << "MaximumQuality: " << this->MaximumQuality << "\n";
  os << indent << "MeanQuality: " << this->MeanQuality << "\n";
  os << indent << "StandardDeviation: " << this->StandardDeviation << "\n";
  os << indent << "QualityBound: " << this->QualityBound << "\n";
  os << indent << "NumberOfMeasuredCells: " << this->NumberOfMeasuredCells << "\n";
  os << indent << "NumberOfInvertedCells: " << this->NumberOfInvertedCells << "\n";
  os << indent << "NumberOfNotMeasurableCells: " << this->NumberOfNotMeasurableCells << "\n";
  os << indent << "NumberOfOtherCells: " << this->NumberOfOtherCells << "\n";
  os << indent << "NumberOfCappedCells: " << this->NumberOfCappedCells << "\n";
  os << indent << "WorstCellId: " << this->WorstCellId << "\n";
  os << indent << "WorstCellBlock: " << this->WorstCellBlock << "\n";
  os << indent << "WorstCellRank: " << this->WorstCellRank << "\n";
}

//------------------------------------------------------------------------------
void vtkMeshQualityMinMax::SetRegionArray(const char* name)
{
  vtkMeshOptimizeBridge::ChooseArray(this, vtkMeshOptimizeBridge::RegionArray, name);
}

void vtkMeshQualityMinMax::SetSizeArray(const char* name)
{
  vtkMeshOptimizeBridge::ChooseArray(this, vtkMeshOptimizeBridge::SizeArray, name);
}

void vtkMeshQualityMinMax::SetMetricArray(const char* name)
{
  vtkMeshOptimizeBridge::ChooseArray(this, vtkMeshOptimizeBridge::MetricArray, name);
}

//------------------------------------------------------------------------------
int vtkMeshQualityMinMax::FillInputPortInformation(int, vtkInformation* info)
{
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkUnstructuredGrid");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

//------------------------------------------------------------------------------
int vtkMeshQualityMinMax::FillOutputPortInformation(int port, vtkInformation* info)
{
  const char* types[] = { "vtkDataObject", "vtkTable", "vtkTable", "vtkUnstructuredGrid" };
  info->Set(vtkDataObject::DATA_TYPE_NAME(), types[port]);
  return 1;
}

//------------------------------------------------------------------------------
/**
 * The output has the type of the input: a grid, or composite data.
 */
vtkTypeBool vtkMeshQualityMinMax::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
  {
    return this->RequestDataObject(request, inputVector, outputVector);
  }
  return this->Superclass::ProcessRequest(request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
int vtkMeshQualityMinMax::RequestDataObject(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* input = vtkDataObject::GetData(inputVector[0]);
  vtkDataObject* output = vtkDataObject::GetData(outputVector);
  // Without an input the executive reports one error later; returning 0 here would add a second
  // one.
  const char* type = input ? input->GetClassName() : "vtkUnstructuredGrid";
  if (!output || !output->IsA(type))
  {
    // NewInstance(): of the very class of the input, which composite data need.
    vtkSmartPointer<vtkDataObject> made = input
      ? vtk::TakeSmartPointer(input->NewInstance())
      : vtkSmartPointer<vtkDataObject>(vtkSmartPointer<vtkUnstructuredGrid>::New());
    outputVector->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), made);
  }
  return 1;
}

//------------------------------------------------------------------------------
// The data of one update: the grids on this rank, input and output side by side.
struct vtkMeshQualityMinMax::Run
{
  explicit Run(vtkMeshQualityMinMax* self)
    : Self(self)
    , Figures(std::max(1, self->NumberOfWorstCells))
    , Rank(self->Controller ? self->Controller->GetLocalProcessId() : 0)
  {
    this->Options.Measure = static_cast<meshopt::Measure>(self->QualityMeasure);
    this->Options.Beta = self->Beta;
    this->Options.DesiredSize = self->DesiredSize;
    // the worst one is needed in any case, for the figures
    this->Options.NumberOfWorstCells = std::max(1, self->NumberOfWorstCells);
    this->Options.ComputeBound = self->ComputeBound;
    this->Options.TargetQuality = self->TargetQuality;
  }

  // Rank and block in one number; in ties the rank comes first.
  std::int64_t PartOf(unsigned int block) const
  {
    // 32 bits for the block: a flat index is an unsigned int.
    return (static_cast<std::int64_t>(this->Rank) << 32) + block;
  }

  void Pass(vtkDataObject* input, vtkDataObject* output);
  void PassBlock(vtkDataObject* input, vtkDataObject* output, unsigned int block);
  bool IsAlone() const
  {
    return !this->Self->Controller || this->Self->Controller->GetNumberOfProcesses() == 1;
  }
  std::string CheckOptions() const;
  std::string FindArrays();
  std::string Measure();
  std::string MeasureOnRanks();
  std::string MeasureBlocks();
  std::string MeasureBlock(const quality::Block& block);
  void CountInBins(meshopt::QualityHistogram& histogram);

  vtkMeshQualityMinMax* Self;
  quality::Options Options;
  quality::Figures Figures;
  int Rank;
  bool IsComposite = false;
  std::vector<quality::Block> Blocks;                // of the output
  std::map<unsigned int, quality::Planarity> Planes; // of all ranks; only if not alone
  std::vector<quality::Surface> Surfaces;            // of the blocks; only if not alone
};

//------------------------------------------------------------------------------
void vtkMeshQualityMinMax::Run::Pass(vtkDataObject* input, vtkDataObject* output)
{
  auto* from = vtkCompositeDataSet::SafeDownCast(input);
  auto* to = vtkCompositeDataSet::SafeDownCast(output);
  this->IsComposite = from && to;
  if (!this->IsComposite)
  {
    this->PassBlock(input, output, 0);
    return;
  }
  // Same tree, own leaves: arrays are added to them, and the input must stay as it was.
  to->CopyStructure(from);
  to->GetFieldData()->PassData(from->GetFieldData());
  vtkSmartPointer<vtkCompositeDataIterator> it = vtk::TakeSmartPointer(from->NewIterator());
  for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem())
  {
    vtkDataObject* leaf = it->GetCurrentDataObject();
    vtkSmartPointer<vtkDataObject> copy = vtk::TakeSmartPointer(leaf->NewInstance());
    to->SetDataSet(it, copy);
    this->PassBlock(leaf, copy, it->GetCurrentFlatIndex());
  }
}

//------------------------------------------------------------------------------
void vtkMeshQualityMinMax::Run::PassBlock(
  vtkDataObject* input, vtkDataObject* output, unsigned int block)
{
  output->ShallowCopy(input);
  if (auto* grid = vtkUnstructuredGrid::SafeDownCast(output))
  {
    this->Blocks.push_back({ this->PartOf(block), block, grid, {} });
  }
  // Other data sets have cells, too, which count as not measured.
  else if (auto* set = vtkDataSet::SafeDownCast(output))
  {
    this->Figures.Total.OtherCells += set->GetNumberOfCells();
  }
}

//------------------------------------------------------------------------------
std::string vtkMeshQualityMinMax::Run::CheckOptions() const
{
  if (!meshopt::isMeasure(this->Self->GetQualityMeasure()))
  {
    return "QualityMeasure is " + std::to_string(this->Self->GetQualityMeasure()) +
      ", which is none of the known measures.";
  }
  return vtkMeshBridge::CheckNumbers(
    { { "Beta", this->Options.Beta }, { "DesiredSize", this->Options.DesiredSize },
      { "TargetQuality", this->Options.TargetQuality } });
}

//------------------------------------------------------------------------------
std::string vtkMeshQualityMinMax::Run::FindArrays()
{
  std::vector<vtkUnstructuredGrid*> grids;
  for (const quality::Block& block : this->Blocks)
  {
    grids.push_back(block.Mesh);
  }
  std::string error = this->CheckOptions();
  if (error.empty())
  {
    error = vtkMeshOptimizeBridge::CheckArraysAreThere(this->Self, grids);
  }
  bool hasSizes = this->Options.DesiredSize > 0.0, hasCells = false;
  for (quality::Block& block : this->Blocks)
  {
    if (error.empty())
    {
      error = vtkMeshOptimizeBridge::FindInputArrays(this->Self, block.Mesh, block.Arrays);
    }
    // Sizes of any block will do: others may have none.
    hasSizes = hasSizes || block.Arrays.Size;
    hasCells = hasCells || block.Mesh->GetNumberOfCells() > 0;
  }
  if (error.empty() && hasCells && this->Options.Beta > 0.0 && !hasSizes)
  {
    error = "Beta is above 0, but there is neither a DesiredSize above 0 nor a size array.";
  }
  return error;
}

//------------------------------------------------------------------------------
std::string vtkMeshQualityMinMax::Run::MeasureBlock(const quality::Block& block)
{
  quality::Grid grid(block.Mesh);
  // A piece alone might seem to lie in another plane, or in none.
  if (!this->IsAlone())
  {
    const auto plane = this->Planes.find(block.FlatIndex);
    const bool isPlane = plane != this->Planes.end();
    grid.SetPlane(
      isPlane && plane->second.IsFlat, isPlane ? plane->second.Frame : vtkMeshBridge::Frame<2>());
  }
  const std::string error = grid.Read(block.Arrays, this->Options.Beta > 0.0);
  if (!error.empty())
  {
    return error;
  }
  vtkSmartPointer<vtkDoubleArray> values = vtkSmartPointer<vtkDoubleArray>::New();
  values->SetName(quality::ArrayName(this->Options.Measure));
  values->SetNumberOfValues(grid.GetNumberOfCells());
  quality::Figures figures = quality::MeasureGrid(
    grid, this->Options, block.Part, values->GetPointer(0));
  if (!vtkMeshBridge::CheckAbort(this->Self))
  {
    quality::Surface surface = quality::FindSurface(grid, this->Options, values->GetPointer(0));
    if (this->IsAlone())
    {
      quality::MeasureSurface(surface, this->Options, figures);
    }
    else
    {
      this->Surfaces[&block - this->Blocks.data()] = std::move(surface);
    }
  }
  this->Figures.Merge(figures);
  block.Mesh->GetCellData()->AddArray(values);
  block.Mesh->GetCellData()->SetActiveScalars(values->GetName());
  return {};
}

//------------------------------------------------------------------------------
std::string vtkMeshQualityMinMax::Run::MeasureBlocks()
{
  std::string error;
  for (std::size_t b = 0; b < this->Blocks.size() && error.empty(); ++b)
  {
    // What has been measured so far stays.
    if (vtkMeshBridge::CheckAbort(this->Self))
    {
      break;
    }
    error = this->MeasureBlock(this->Blocks[b]);
    if (!error.empty() && this->IsComposite)
    {
      error = "Block " + std::to_string(this->Blocks[b].FlatIndex) + ": " + error;
    }
    this->Self->UpdateProgress(static_cast<double>(b + 1) / this->Blocks.size());
  }
  return error;
}

/**
 * With the plane of all triangles, and without the borders of the pieces. An error of one rank is
 * one of all.
 */
std::string vtkMeshQualityMinMax::Run::MeasureOnRanks()
{
  const vtkMeshRanks::Ranks ranks(this->Self->Controller);
  return ranks.Together(
    [&]()
    {
      ranks.Agree(this->FindArrays());
      this->Planes = quality::FindPlanes(ranks, this->Blocks);
      this->Surfaces.resize(this->Blocks.size());
      ranks.Agree(this->MeasureBlocks());
      // Where a rank has not looked at its surface, all facets at its border would seem to be it.
      if (this->Options.ComputeBound && !ranks.IsAny(vtkMeshBridge::CheckAbort(this->Self)))
      {
        quality::RemoveBorders(ranks, this->Blocks, this->Surfaces);
        for (const quality::Surface& surface : this->Surfaces)
        {
          quality::MeasureSurface(surface, this->Options, this->Figures);
        }
      }
      return std::string();
    });
}

std::string vtkMeshQualityMinMax::Run::Measure()
{
  if (!this->IsAlone())
  {
    return this->MeasureOnRanks();
  }
  const std::string error = this->FindArrays();
  return error.empty() ? this->MeasureBlocks() : error;
}

//------------------------------------------------------------------------------
/**
 * A second pass over the values: the range of the bins is known only when all ranks have measured.
 */
void vtkMeshQualityMinMax::Run::CountInBins(meshopt::QualityHistogram& histogram)
{
  for (const quality::Block& block : this->Blocks)
  {
    auto* values = vtkDoubleArray::SafeDownCast(
      block.Mesh->GetCellData()->GetArray(quality::ArrayName(this->Options.Measure)));
    const vtkMeshBridge::GhostCells ghosts(block.Mesh);
    for (vtkIdType c = 0; values && c < values->GetNumberOfValues(); ++c)
    {
      if (!ghosts.Has(c))
      {
        histogram.add(values->GetValue(c));
      }
    }
  }
}

//------------------------------------------------------------------------------
void vtkMeshQualityMinMax::StoreFigures(const Run& run)
{
  // Figures are NaN where nothing was measured: 0 would be a quality.
  const quality::Sums& total = run.Figures.Total;
  const meshopt::QualityStatistics& q = total.Quality;
  // No cell was measured.
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  this->MinimumQuality = q.count ? q.minimum : nothing;
  this->MaximumQuality = q.count ? q.maximum : nothing;
  this->MeanQuality = q.count ? q.mean : nothing;
  this->StandardDeviation = q.count ? q.standardDeviation() : nothing;
  this->NumberOfMeasuredCells = q.count;
  this->NumberOfInvertedCells = q.inverted;
  this->NumberOfNotMeasurableCells = q.invalid;
  this->NumberOfOtherCells = total.OtherCells;
  this->NumberOfCappedCells = total.CappedCells;
  // No cell is better than the regular one.
  this->QualityBound = std::min(total.Bound, quality::GreatestQuality(run.Options, run.Figures));
  const std::vector<meshopt::WorstElement> worst = run.Figures.Worst.sorted();
  this->WorstCellId = worst.empty() ? -1 : worst[0].id;
  this->WorstCellBlock = worst.empty() ? -1 : static_cast<int>(worst[0].part & 0xffffffff);
  this->WorstCellRank = worst.empty() ? -1 : static_cast<int>(worst[0].part >> 32);
}

//------------------------------------------------------------------------------
void vtkMeshQualityMinMax::FillOutputs(Run& run, vtkInformationVector* outputVector)
{
  meshopt::QualityHistogram histogram = quality::MakeHistogram(
    run.Options, run.Figures, this->NumberOfBins);
  run.CountInBins(histogram);
  quality::Reduce(this->Controller, histogram);
  // One table for all ranks, on the first.
  if (run.Rank == 0)
  {
    quality::FillSummary(run.Options, run.Figures, vtkTable::GetData(outputVector, 1));
    quality::FillHistogram(histogram, vtkTable::GetData(outputVector, 2));
  }
  std::vector<meshopt::WorstElement> worst = run.Figures.Worst.sorted();
  // The figures needed one, even if none is wanted as output.
  worst.resize(std::min(worst.size(), static_cast<std::size_t>(this->NumberOfWorstCells)));
  quality::FillWorstCells(run.Options, worst, run.Blocks, run.Rank, run.IsComposite,
    vtkUnstructuredGrid::GetData(outputVector, 3));
}

//------------------------------------------------------------------------------
void vtkMeshQualityMinMax::WarnOfNothing(const Run& run)
{
  if (this->NumberOfMeasuredCells + this->NumberOfNotMeasurableCells > 0)
  {
    return;
  }
  if (run.Figures.GhostSimplices > 0)
  {
    vtkWarningMacro(<< "Nothing to measure: all " << run.Figures.GhostSimplices
                    << " triangles and tetrahedra are ghost cells (duplicate, refined or hidden, "
                       "says vtkGhostType), which do not count.");
  }
  else if (this->NumberOfOtherCells > 0)
  {
    vtkWarningMacro(<< "Nothing to measure: none of the " << this->NumberOfOtherCells
                    << " cells is a triangle or a tetrahedron of an unstructured grid.");
  }
}

//------------------------------------------------------------------------------
int vtkMeshQualityMinMax::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  Run run(this);
  run.Pass(vtkDataObject::GetData(inputVector[0]), vtkDataObject::GetData(outputVector, 0));
  const std::string error = run.Measure();
  // All ranks meet here, including those with an error: otherwise the others would wait forever.
  const bool usable = quality::Reduce(
    this->Controller, !error.empty(), run.Options.NumberOfWorstCells, run.Figures);
  if (!usable)
  {
    // Nothing of a part of the data is told: it would look like all.
    run.Figures = quality::Figures(1);
    run.Options = quality::Options(); // the measure may be none
    for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
    {
      vtkMeshBridge::MakeEmpty(vtkDataObject::GetData(outputVector, port));
    }
    // Returning 0 would make the executive add an error of its own. What all ranks know is told
    // by the first.
    if (run.Rank == 0)
    {
      vtkErrorMacro(<< error);
    }
  }
  this->SetErrorCode(usable ? vtkErrorCode::NoError : vtkErrorCode::UserError);
  this->StoreFigures(run);
  if (usable)
  {
    this->FillOutputs(run, outputVector);
  }
  if (usable && run.Rank == 0)
  {
    this->WarnOfNothing(run);
  }
  return 1;
}
