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

void vtkMeshOptimizeFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

int vtkMeshOptimizeFilter::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkUnstructuredGrid" : "vtkTable");
  return 1;
}

int vtkMeshOptimizeFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkUnstructuredGrid::GetData(outputVector, 0)->ShallowCopy(vtkUnstructuredGrid::GetData(inputVector[0]));
  return 1;
}
