// What the window of slider.cxx shows.
#ifndef Scene_h
#define Scene_h

#include <vtkActor.h>
#include <vtkCoordinate.h>
#include <vtkDataSetMapper.h>
#include <vtkProperty.h>
#include <vtkSliderRepresentation2D.h>

// What a port of a filter has: coloured by its scalars, or pale.
inline vtkSmartPointer<vtkActor> makePart(vtkAlgorithmOutput* port, double opacity)
{
  vtkNew<vtkDataSetMapper> mapper;
  mapper->SetInputConnection(port);
  mapper->SetScalarVisibility(opacity == 1.0);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetOpacity(opacity);
  return actor;
}

// A slider from 0 to 1 along the lower edge.
inline vtkSmartPointer<vtkSliderRepresentation2D> makeBar(const char* title, double value)
{
  auto bar = vtkSmartPointer<vtkSliderRepresentation2D>::New();
  bar->SetTitleText(title);
  bar->SetValue(value);
  for (auto* end : { bar->GetPoint1Coordinate(), bar->GetPoint2Coordinate() })
  {
    end->SetCoordinateSystemToNormalizedDisplay();
    end->SetValue(end == bar->GetPoint1Coordinate() ? 0.1 : 0.9, 0.1);
  }
  return bar;
}

#endif
