#include <vtkDataSetMapper.h>
#include <vtkMeshOptimizeFilter.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSliderRepresentation2D.h>
#include <vtkSliderWidget.h>
#include <vtkXMLUnstructuredGridReader.h>
// A slider for the target, and a mesh (the surface of a body) coloured by quality: slider IN.vtu
int main(int, char* argv[])
{
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(argv[1]);
  vtkNew<vtkMeshOptimizeFilter> optimize;
  optimize->SetInputConnection(reader->GetOutputPort());
  vtkNew<vtkDataSetMapper> mapper; // its colours go from red at 0 to blue at 1
  mapper->SetInputConnection(optimize->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkRenderWindow> window;
  window->AddRenderer(renderer);
  window->SetSize(800, 800);
  vtkNew<vtkSliderRepresentation2D> bar;
  bar->SetTitleText("target quality");
  bar->SetValue(optimize->GetTargetQuality());
  bar->GetPoint1Coordinate()->SetCoordinateSystemToNormalizedDisplay();
  bar->GetPoint1Coordinate()->SetValue(0.1, 0.1);
  bar->GetPoint2Coordinate()->SetCoordinateSystemToNormalizedDisplay();
  bar->GetPoint2Coordinate()->SetValue(0.9, 0.1);
  vtkNew<vtkSliderWidget> slider;
  slider->SetInteractor(window->MakeRenderWindowInteractor());
  slider->SetRepresentation(bar);
  auto retarget = [&]() mutable { optimize->SetTargetQuality(bar->GetValue() + 1e-6); }; // not 0
  slider->AddObserver(vtkCommand::EndInteractionEvent, &retarget, &decltype(retarget)::operator());
  slider->EnabledOn();
  window->GetInteractor()->Start(); // the slider draws when it is let go, and the new mesh is shown
}
