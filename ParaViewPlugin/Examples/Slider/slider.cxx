// The worst elements of a mesh in its pale body, and a slider for the target:
//   slider IN.vtu            until the window is closed
//   slider IN.vtu TARGET     once
#include <vtkActor.h>
#include <vtkCommand.h>
#include <vtkCoordinate.h>
#include <vtkDataSetMapper.h>
#include <vtkMeshOptimizeFilter.h>
#include <vtkMeshQualityMinMax.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSliderRepresentation2D.h>
#include <vtkSliderWidget.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <iostream>
#include <string>

struct Program
{
  vtkNew<vtkMeshOptimizeFilter> Optimize;
  vtkNew<vtkMeshQualityMinMax> Measure;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkSliderRepresentation2D> Bar;

  // Port 0 is the mesh, 3 its worst elements, coloured by quality.
  void Show(int port, double opacity)
  {
    vtkNew<vtkDataSetMapper> mapper;
    mapper->SetInputConnection(Measure->GetOutputPort(port));
    mapper->SetScalarVisibility(port == 3);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetOpacity(opacity);
    Renderer->AddActor(actor);
  }

  void Retarget() // when the slider is let go; the next frame shows the new mesh
  {
    Optimize->SetTargetQuality(Bar->GetValue());
    Measure->Update();
    std::cout << "target " << Bar->GetValue() << ": worst " << Measure->GetMinimumQuality()
              << std::endl;
  }
};

int main(int argc, char** argv)
{
  Program program;
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(argc > 1 ? argv[1] : "");
  program.Optimize->SetInputConnection(reader->GetOutputPort());
  program.Measure->SetInputConnection(program.Optimize->GetOutputPort());
  program.Show(0, 0.2);
  program.Show(3, 1.0);
  program.Renderer->SetBackground(0.2, 0.24, 0.3);
  vtkNew<vtkRenderWindow> window;
  window->AddRenderer(program.Renderer);
  window->SetSize(800, 800);
  program.Bar->SetMinimumValue(0.01);
  program.Bar->SetMaximumValue(0.75);
  program.Bar->SetValue(argc > 2 ? std::stod(argv[2]) : 0.01);
  program.Bar->SetTitleText("target quality");
  for (auto* end : { program.Bar->GetPoint1Coordinate(), program.Bar->GetPoint2Coordinate() })
  {
    end->SetCoordinateSystemToNormalizedDisplay();
    end->SetValue(end == program.Bar->GetPoint1Coordinate() ? 0.1 : 0.9, 0.1);
  }
  vtkNew<vtkSliderWidget> slider;
  slider->SetInteractor(window->MakeRenderWindowInteractor());
  slider->SetRepresentation(program.Bar);
  slider->AddObserver(vtkCommand::EndInteractionEvent, &program, &Program::Retarget);
  slider->InvokeEvent(vtkCommand::EndInteractionEvent);
  window->Render();
  slider->EnabledOn();
  if (argc < 3)
    window->GetInteractor()->Start();
}
