#include "vtkMeshQualityMinMax.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkUnstructuredGrid.h"

vtkStandardNewMacro(vtkMeshQualityMinMax);

vtkMeshQualityMinMax::vtkMeshQualityMinMax()
{
  this->SetNumberOfOutputPorts(4);
}

void vtkMeshQualityMinMax::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

int vtkMeshQualityMinMax::FillOutputPortInformation(int port, vtkInformation* info)
{
  const bool isTable = port == 1 || port == 2;
  info->Set(vtkDataObject::DATA_TYPE_NAME(), isTable ? "vtkTable" : "vtkUnstructuredGrid");
  return 1;
}

int vtkMeshQualityMinMax::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkUnstructuredGrid::GetData(outputVector, 0)->ShallowCopy(vtkUnstructuredGrid::GetData(inputVector[0]));
  return 1;
}
