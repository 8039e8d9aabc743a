#include "vtkMeshOptimizeFilter.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

vtkStandardNewMacro(vtkMeshOptimizeFilter);

vtkMeshOptimizeFilter::vtkMeshOptimizeFilter()
{
  this->SetNumberOfOutputPorts(2);
}

vtkMeshOptimizeFilter::~vtkMeshOptimizeFilter() = default;

void vtkMeshOptimizeFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

void vtkMeshOptimizeFilter::SetRegionArray(const char*) {}
void vtkMeshOptimizeFilter::SetFixedPointArray(const char*) {}
void vtkMeshOptimizeFilter::SetSizeArray(const char*) {}
void vtkMeshOptimizeFilter::SetMetricArray(const char*) {}

const char* vtkMeshOptimizeFilter::GetStopReasonAsString()
{
  return "not run";
}

vtkTypeBool vtkMeshOptimizeFilter::ProcessRequest(
  vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output)
{
  return this->Superclass::ProcessRequest(request, input, output);
}

int vtkMeshOptimizeFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  return this->Superclass::FillInputPortInformation(port, info);
}

int vtkMeshOptimizeFilter::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkUnstructuredGrid" : "vtkTable");
  return 1;
}

int vtkMeshOptimizeFilter::RequestDataObject(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*)
{
  return 1;
}

int vtkMeshOptimizeFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkUnstructuredGrid::GetData(outputVector, 0)->ShallowCopy(vtkUnstructuredGrid::GetData(inputVector[0]));
  return 1;
}
