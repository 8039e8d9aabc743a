// The worst elements of a mesh in its pale body, and a slider for the target: slider IN.vtu
#include "Scene.h"

#include <vtkMeshOptimizeFilter.h>
#include <vtkMeshQualityMinMax.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSliderWidget.h>
#include <vtkXMLUnstructuredGridReader.h>

int main(int, char* argv[])
{
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(argv[1]);
  vtkNew<vtkMeshOptimizeFilter> optimize;
  optimize->SetInputConnection(reader->GetOutputPort());
  vtkNew<vtkMeshQualityMinMax> measure;
  measure->SetInputConnection(optimize->GetOutputPort());
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(makePart(measure->GetOutputPort(0), 0.2)); // the mesh
  renderer->AddActor(makePart(measure->GetOutputPort(3), 1.0)); // its worst elements
  vtkNew<vtkRenderWindow> window;
  window->AddRenderer(renderer);
  window->SetSize(800, 800);
  const auto bar = makeBar("target quality", optimize->GetTargetQuality());
  vtkNew<vtkSliderWidget> slider;
  slider->SetInteractor(window->MakeRenderWindowInteractor());
  slider->SetRepresentation(bar);
  auto retarget = [&]() mutable { optimize->SetTargetQuality(bar->GetValue()); };
  slider->AddObserver(vtkCommand::EndInteractionEvent, &retarget, &decltype(retarget)::operator());
  window->Render(); // so does the slider when it is let go, and the new mesh is shown
  slider->EnabledOn();
  window->GetInteractor()->Start();
}
