/**
 * @class   vtkMeshQualityMinMax
 * @brief   quality of every element, its minimum, maximum and distribution, and the worst elements
 *
 * Placeholder: the whole set of properties, passes its input through.
 */
#ifndef vtkMeshQualityMinMax_h
#define vtkMeshQualityMinMax_h

#include "vtkFiltersMeshOptimizeModule.h" // for export macro
#include "vtkUnstructuredGridAlgorithm.h"

class VTKFILTERSMESHOPTIMIZE_EXPORT vtkMeshQualityMinMax : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkMeshQualityMinMax* New();
  vtkTypeMacro(vtkMeshQualityMinMax, vtkUnstructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum QualityMeasureType
  {
    Shape = 0,
    RadiusRatio = 1,
    MeanRatio = 2,
    MinimumSine = 3,
    WarpedSine = 4,
    VolumeLength = 5,
    MinimumDihedralAngle = 6
  };
  vtkSetClampMacro(QualityMeasure, int, Shape, MinimumDihedralAngle);
  vtkGetMacro(QualityMeasure, int);
  void SetQualityMeasureToShape() { this->SetQualityMeasure(Shape); }
  void SetQualityMeasureToRadiusRatio() { this->SetQualityMeasure(RadiusRatio); }
  void SetQualityMeasureToMeanRatio() { this->SetQualityMeasure(MeanRatio); }
  void SetQualityMeasureToMinimumSine() { this->SetQualityMeasure(MinimumSine); }
  void SetQualityMeasureToWarpedSine() { this->SetQualityMeasure(WarpedSine); }
  void SetQualityMeasureToVolumeLength() { this->SetQualityMeasure(VolumeLength); }
  void SetQualityMeasureToMinimumDihedralAngle() { this->SetQualityMeasure(MinimumDihedralAngle); }

  vtkSetClampMacro(Beta, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Beta, double);
  vtkSetClampMacro(DesiredSize, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(DesiredSize, double);
  vtkSetClampMacro(NumberOfWorstCells, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfWorstCells, int);
  vtkSetClampMacro(NumberOfBins, int, 1, VTK_INT_MAX);
  vtkGetMacro(NumberOfBins, int);

  vtkGetMacro(MinimumQuality, double);
  vtkGetMacro(MaximumQuality, double);
  vtkGetMacro(MeanQuality, double);
  vtkGetMacro(QualityBound, double);

protected:
  vtkMeshQualityMinMax();
  ~vtkMeshQualityMinMax() override = default;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkMeshQualityMinMax(const vtkMeshQualityMinMax&) = delete;
  void operator=(const vtkMeshQualityMinMax&) = delete;

  int QualityMeasure = Shape;
  double Beta = 0.0;
  double DesiredSize = 0.0;
  int NumberOfWorstCells = 10;
  int NumberOfBins = 20;
  double MinimumQuality = 0.0;
  double MaximumQuality = 0.0;
  double MeanQuality = 0.0;
  double QualityBound = 0.0;
};

#endif
