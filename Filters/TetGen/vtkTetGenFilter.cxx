// SPDX-License-Identifier: BSD-3-Clause
// Properties, the call of TetGen, and what its failures mean.
#include "vtkTetGenFilter.h"

#include "vtkMeshBridgeBlocks.h"
#include "vtkMeshBridgeControl.h"
#include "vtkMeshBridgeVTKCompat.h"
#include "vtkTetGenChild.h"
#include "vtkTetGenExport.h"
#include "vtkTetGenJob.h"
#include "vtkTetGenSurface.h"

#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <new>
#include <sstream>

vtkStandardNewMacro(vtkTetGenFilter);

namespace bridge = vtkTetGenBridge;

//------------------------------------------------------------------------------
vtkTetGenFilter::vtkTetGenFilter() { this->SetNumberOfInputPorts(2); }

vtkTetGenFilter::~vtkTetGenFilter() = default;

void vtkTetGenFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MaximumVolume: " << this->MaximumVolume << "\n";
  os << indent << "MaximumRadiusEdgeRatio: " << this->MaximumRadiusEdgeRatio << "\n";
  os << indent << "MinimumDihedralAngle: " << this->MinimumDihedralAngle << "\n";
  os << indent << "KeepSurface: " << this->KeepSurface << "\n";
  os << indent << "OptimizationLevel: " << this->OptimizationLevel << "\n";
  os << indent << "NumberOfRegions: " << this->GetNumberOfRegions() << "\n";
  os << indent << "NumberOfHoles: " << this->GetNumberOfHoles() << "\n";
}

//------------------------------------------------------------------------------
// Five numbers each, in the order of TetGen's own list of regions.
void vtkTetGenFilter::AddRegion(
  double x, double y, double z, double attribute, double maximumVolume)
{
  this->Regions.insert(this->Regions.end(), { x, y, z, attribute, maximumVolume });
  this->Modified();
}

void vtkTetGenFilter::RemoveAllRegions()
{
  this->Regions.clear();
  this->Modified();
}

int vtkTetGenFilter::GetNumberOfRegions() { return static_cast<int>(this->Regions.size() / 5); }

void vtkTetGenFilter::AddHole(double x, double y, double z)
{
  this->Holes.insert(this->Holes.end(), { x, y, z });
  this->Modified();
}

void vtkTetGenFilter::RemoveAllHoles()
{
  this->Holes.clear();
  this->Modified();
}

int vtkTetGenFilter::GetNumberOfHoles() { return static_cast<int>(this->Holes.size() / 3); }

void vtkTetGenFilter::SetInteriorPointsConnection(vtkAlgorithmOutput* output)
{
  this->SetInputConnection(1, output);
}

void vtkTetGenFilter::SetInteriorPointsData(vtkPointSet* points) { this->SetInputData(1, points); }

int vtkTetGenFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkPolyData" : "vtkPointSet");
  // Points inside are a wish: TetGen finds its own where it needs them.
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

//------------------------------------------------------------------------------
/**
 * What TetGen could not cope with is refused before a process is started.
 */
std::string vtkTetGenFilter::CheckOptions()
{
  const std::string unusable = vtkMeshBridge::CheckNumbers(
    { { "MaximumVolume", this->MaximumVolume },
      { "MaximumRadiusEdgeRatio", this->MaximumRadiusEdgeRatio },
      { "MinimumDihedralAngle", this->MinimumDihedralAngle } });
  if (!unusable.empty())
  {
    return unusable;
  }
  if (this->MaximumRadiusEdgeRatio > 0.0 && this->MaximumRadiusEdgeRatio < 1.0)
  {
    std::ostringstream text;
    text << "MaximumRadiusEdgeRatio is " << this->MaximumRadiusEdgeRatio
         << "; it must be 0 (no limit) or at least 1: TetGen would not come to an end.";
    return text.str();
  }
  for (const std::vector<double>* seeds : { &this->Regions, &this->Holes })
  {
    const auto wrong = std::find_if(
      seeds->begin(), seeds->end(), [](double value) { return !std::isfinite(value); });
    if (wrong != seeds->end())
    {
      const bool isHole = seeds == &this->Holes;
      return std::string(isHole ? "Hole" : "Region") + " point " +
        std::to_string((wrong - seeds->begin()) / (isHole ? 3 : 5)) +
        " has a value that is not finite.";
    }
  }
  // Five numbers per region: a point, its attribute, its greatest volume.
  for (std::size_t i = 3; i < this->Regions.size(); i += 5)
  {
    // It becomes the integer array Region.
    const double attribute = this->Regions[i];
    if (attribute != std::floor(attribute) || std::abs(attribute) > 1e9)
    {
      std::ostringstream text;
      text << "Region point " << i / 5 << " has the attribute " << attribute
           << "; it must be a whole number within +-1e9.";
      return text.str();
    }
  }
  return {};
}

std::string vtkTetGenFilter::MakeJob(
  const bridge::Surface& surface, vtkPointSet* interior, bridge::Job& job)
{
  job.Points = surface.Points;
  job.Triangles = surface.Triangles;
  job.Regions = this->Regions;
  job.Holes = this->Holes;
  job.MaximumVolume = this->MaximumVolume;
  job.MaximumRadiusEdgeRatio = this->MaximumRadiusEdgeRatio;
  job.MinimumDihedralAngle = this->MinimumDihedralAngle;
  job.KeepSurface = this->KeepSurface;
  job.OptimizationLevel = this->OptimizationLevel;
  const vtkIdType wanted = interior ? interior->GetNumberOfPoints() : 0;
  if (wanted > std::numeric_limits<int>::max() / 4)
  {
    return "There are too many interior points for TetGen, which counts in 32 bits.";
  }
  for (vtkIdType p = 0; p < wanted; ++p)
  {
    double x[3];
    interior->GetPoint(p, x);
    // Those of the surface have been checked by CheckSurface().
    if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
    {
      return "Interior point " + std::to_string(p) + " has coordinates that are not finite.";
    }
    job.InteriorPoints.insert(job.InteriorPoints.end(), x, x + 3);
  }
  // TetGen would divide the surface at a point on it.
  if (wanted > 0)
  {
    job.InteriorPoints = bridge::PointsOffSurface(surface, job.InteriorPoints);
  }
  return {};
}

/**
 * False ends TetGen.
 */
bool vtkTetGenFilter::ReportProgress(double fraction, const std::string& phase)
{
  this->SetProgressText(phase.c_str());
  this->UpdateProgress(fraction);
  return !vtkMeshBridge::CheckAbort(this);
}

//------------------------------------------------------------------------------
namespace
{

/**
 * TetGen 1.5 warns about a region point outside of the convex hull, and then crashes.
 */
std::string FindRegionOutside(const std::string& text, const std::vector<double>& regions)
{
  const std::size_t place = text.rfind("-th region point");
  // From the end: it is the last thing that TetGen has said.
  const std::size_t begin = text.rfind("The ", place);
  int number = 0;
  if (place == std::string::npos || begin == std::string::npos ||
    std::sscanf(text.c_str() + begin, "The %d-th", &number) != 1 || number < 1 ||
    static_cast<std::size_t>(number) > regions.size() / 5)
  {
    return {};
  }
  const double* x = regions.data() + 5 * (number - 1);
  std::ostringstream message;
  message << "Region point " << number - 1 << " (" << x[0] << ", " << x[1] << ", " << x[2]
          << ") lies outside the surface.";
  return message.str();
}

/**
 * Without the line end, and without empty lines behind it.
 */
std::string LastLine(const std::string& text)
{
  const std::size_t last = text.find_last_not_of(" \n\r\t");
  if (last == std::string::npos)
  {
    return {};
  }
  const std::size_t begin = text.find_last_of('\n', last);
  return text.substr(begin == std::string::npos ? 0 : begin + 1,
    last - (begin == std::string::npos ? 0 : begin + 1) + 1);
}

} // namespace

/**
 * Finds out why TetGen failed: asks it for facets that intersect, which it finds reliably.
 */
std::string vtkTetGenFilter::ExplainFailure(const bridge::Surface& surface, bridge::Job job,
  const std::string& text, const std::string& reason)
{
  // Before the second run: this failure is known by TetGen's own words.
  const std::string outside = FindRegionOutside(text, job.Regions);
  if (!outside.empty())
  {
    return outside;
  }
  // The surface alone: nothing else may make this second run fail.
  job.OnlyFindIntersections = true;
  job.Regions.clear();
  job.Holes.clear();
  job.InteriorPoints.clear();
  // The bar stands still: it must not begin again.
  bridge::Mesh none;
  const bridge::ChildOutcome outcome = bridge::RunInChild(
    job, [this](double, const std::string& phase) { return this->ReportProgress(0.9, phase); },
    none);
  if (outcome.State == bridge::ChildOutcome::Aborted)
  {
    return {};
  }
  const auto pairs = bridge::ParseIntersections(outcome.Text);
  if (!pairs.empty())
  {
    return bridge::DescribeIntersections(surface, pairs);
  }
  const std::string last = LastLine(text);
  // Its last line mostly says more than the signal that ended it.
  return "TetGen failed on this surface: " + reason +
    (last.empty() ? "." : "; the last it said: \"" + last + "\".");
}

/**
 * An empty mesh without error: aborted.
 */
std::string vtkTetGenFilter::Run(
  const bridge::Surface& surface, const bridge::Job& job, bridge::Mesh& mesh)
{
  const bridge::ChildOutcome outcome = bridge::RunInChild(
    job,
    [this](double fraction, const std::string& phase)
    { return this->ReportProgress(fraction, phase); },
    mesh);
  // A failure of the child is an answer: the application goes on, with an error.
  switch (outcome.State)
  {
    case bridge::ChildOutcome::Aborted:
      return {};
    case bridge::ChildOutcome::NotStarted:
      return "No process could be started for TetGen: " + outcome.Reason + ".";
    case bridge::ChildOutcome::Failed:
      return this->ExplainFailure(surface, job, outcome.Text, outcome.Reason);
    case bridge::ChildOutcome::Done:
      break;
  }
  // TetGen itself takes that for a success.
  if (mesh.Regions.empty())
  {
    return job.Holes.empty()
      ? "TetGen found nothing inside the surface."
      : "No tetrahedron remains: hole points lie in all compartments of the surface.";
  }
  // Without holes every triangle must be a face; a hole takes its triangles away.
  const int lost = job.KeepSurface && job.Holes.empty()
    ? bridge::FindLostTriangle(surface, mesh.Tetrahedra)
    : -1;
  return lost < 0
    ? ""
    : "TetGen could not keep the surface: " + bridge::DescribeTriangle(surface, lost) +
      " is no face of its mesh.";
}

/**
 * Step by step, each only if those before it have succeeded. An abort is no error.
 */
std::string vtkTetGenFilter::Tetrahedralize(
  vtkPolyData* input, vtkPointSet* interior, vtkUnstructuredGrid* output)
{
  bridge::Surface surface;
  bridge::Job job;
  bridge::Mesh mesh;
  std::string error = this->CheckOptions();
  // An earlier error stands; later steps need what it has refused.
  error = error.empty() ? bridge::ReadSurface(input, surface) : error;
  error = error.empty() ? bridge::CheckSurface(surface) : error;
  error = error.empty() ? this->MakeJob(surface, interior, job) : error;
  if (!error.empty() || !this->ReportProgress(0.01, "Surface checked"))
  {
    return error;
  }
  error = this->Run(surface, job, mesh);
  if (!error.empty() || mesh.Regions.empty())
  {
    return error;
  }
  for (const std::string& warning : bridge::CheckRegions(job.Regions, mesh))
  {
    vtkWarningMacro(<< warning);
  }
  bridge::ExportMesh(input, surface, mesh, output);
  return {};
}

int vtkTetGenFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkPointSet* interior = vtkPointSet::GetData(inputVector[1]);
  vtkUnstructuredGrid* output = vtkUnstructuredGrid::GetData(outputVector);
  this->SetErrorCode(vtkErrorCode::NoError);
  if (!input) // a block of another type: the executive does not check it
  {
    vtkWarningMacro(<< "A block of type " << vtkDataObject::GetData(inputVector[0])->GetClassName()
                    << " was skipped: it is not a vtkPolyData.");
    vtkMeshBridge::MakeEmpty(output);
    return 1;
  }
  if (input->GetNumberOfPoints() == 0 && input->GetNumberOfCells() == 0)
  {
    return 1; // for example an empty piece of distributed data
  }
  std::string error;
  try
  {
    error = this->Tetrahedralize(input, interior, output);
  }
  catch (const std::bad_alloc&)
  {
    // Of this process: if the child has none left, it fails, and Run() says so.
    error = "Not enough memory for this mesh.";
  }
  if (!error.empty())
  {
    // Returning 0 would make the executive add an error of its own.
    vtkErrorMacro(<< error);
    this->SetErrorCode(vtkErrorCode::UserError);
    vtkMeshBridge::MakeEmpty(output);
  }
  return 1;
}
