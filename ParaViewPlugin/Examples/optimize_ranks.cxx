// SPDX-License-Identifier: BSD-3-Clause
// One mesh on many ranks, without ParaView:  mpirun -np 4 optimize_ranks IN.pvtu OUT.pvtu
// IN may be a .vtu, too: the first rank reads it, and the filter divides it.
#include <vtkMPIController.h>
#include <vtkMeshOptimizeFilter.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLPUnstructuredGridWriter.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <iostream>
#include <string>

int main(int argc, char* argv[])
{
  vtkNew<vtkMPIController> controller;
  controller->Initialize(&argc, &argv);
  vtkMultiProcessController::SetGlobalController(controller);
  const int rank = controller->GetLocalProcessId(), ranks = controller->GetNumberOfProcesses();
  const std::string name = argc == 3 ? argv[1] : "";
  vtkSmartPointer<vtkXMLReader> reader;
  if (name.size() > 5 && name.substr(name.size() - 5) == ".pvtu")
  {
    reader = vtkSmartPointer<vtkXMLPUnstructuredGridReader>::New();
  }
  else
  {
    reader = vtkSmartPointer<vtkXMLUnstructuredGridReader>::New();
  }
  reader->SetFileName(name.c_str());
  vtkNew<vtkMeshOptimizeFilter> optimizer;
  optimizer->SetInputConnection(reader->GetOutputPort());
  vtkNew<vtkXMLPUnstructuredGridWriter> writer;
  writer->SetController(controller);
  writer->SetInputConnection(optimizer->GetOutputPort());
  writer->SetFileName(argc == 3 ? argv[2] : "");
  writer->SetNumberOfPieces(ranks); // each rank asks for its own
  writer->SetStartPiece(rank);
  writer->SetEndPiece(rank);
  writer->SetDataModeToBinary();
  const bool good = argc == 3 && writer->Write() == 1 && optimizer->GetErrorCode() == 0;
  if (rank == 0)
  {
    std::cout << "worst quality " << optimizer->GetWorstQualityBefore() << " -> "
              << optimizer->GetWorstQualityAfter() << "; " << optimizer->GetStopReasonAsString()
              << std::endl;
  }
  vtkMultiProcessController::SetGlobalController(nullptr);
  controller->Finalize();
  return good ? 0 : 1;
}
