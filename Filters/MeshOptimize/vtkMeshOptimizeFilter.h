/**
 * @class   vtkMeshOptimizeFilter
 * @brief   raise the worst element quality of a triangle or tetrahedral mesh
 *
 * Placeholder: the whole set of properties, passes its input through.
 */
#ifndef vtkMeshOptimizeFilter_h
#define vtkMeshOptimizeFilter_h

#include "vtkFiltersMeshOptimizeModule.h" // for export macro
#include "vtkUnstructuredGridAlgorithm.h"

#include <string> // for StopReasonString

class VTKFILTERSMESHOPTIMIZE_EXPORT vtkMeshOptimizeFilter : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkMeshOptimizeFilter* New();
  vtkTypeMacro(vtkMeshOptimizeFilter, vtkUnstructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum AlgorithmType
  {
    Paper1996 = 0,
    WorstFirst = 1
  };
  vtkSetClampMacro(Algorithm, int, Paper1996, WorstFirst);
  vtkGetMacro(Algorithm, int);
  void SetAlgorithmToPaper1996() { this->SetAlgorithm(Paper1996); }
  void SetAlgorithmToWorstFirst() { this->SetAlgorithm(WorstFirst); }

  vtkSetClampMacro(TargetQuality, double, 0.0, 1.0);
  vtkGetMacro(TargetQuality, double);

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
  vtkSetClampMacro(NeighborhoodLevel, int, 0, 3);
  vtkGetMacro(NeighborhoodLevel, int);
  vtkSetClampMacro(MaximumNumberOfIterations, int, 0, VTK_INT_MAX);
  vtkGetMacro(MaximumNumberOfIterations, int);
  vtkSetClampMacro(Epsilon, double, 0.0, 1.0);
  vtkGetMacro(Epsilon, double);
  vtkSetClampMacro(ArmijoFactor, double, 0.0, 1.0);
  vtkGetMacro(ArmijoFactor, double);
  vtkSetClampMacro(MaximumNumberOfAlternations, int, 0, VTK_INT_MAX);
  vtkGetMacro(MaximumNumberOfAlternations, int);
  vtkSetMacro(MoveNodes, bool);
  vtkGetMacro(MoveNodes, bool);
  vtkBooleanMacro(MoveNodes, bool);
  vtkSetMacro(Reconnect, bool);
  vtkGetMacro(Reconnect, bool);
  vtkBooleanMacro(Reconnect, bool);
  vtkSetMacro(InsertNodes, bool);
  vtkGetMacro(InsertNodes, bool);
  vtkBooleanMacro(InsertNodes, bool);
  vtkSetMacro(RemoveNodes, bool);
  vtkGetMacro(RemoveNodes, bool);
  vtkBooleanMacro(RemoveNodes, bool);

  enum EffortType
  {
    Quick = 0,
    Default = 1,
    Best = 2
  };
  vtkSetClampMacro(Effort, int, Quick, Best);
  vtkGetMacro(Effort, int);
  void SetEffortToQuick() { this->SetEffort(Quick); }
  void SetEffortToDefault() { this->SetEffort(Default); }
  void SetEffortToBest() { this->SetEffort(Best); }
  vtkSetClampMacro(NumberOfThreads, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfThreads, int);
  vtkSetClampMacro(GrowthBudget, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(GrowthBudget, double);
  vtkSetClampMacro(TimeLimit, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(TimeLimit, double);

  vtkGetMacro(WorstQualityBefore, double);
  vtkGetMacro(WorstQualityAfter, double);
  vtkGetMacro(QualityBound, double);
  vtkGetMacro(StopReason, int);
  const char* GetStopReasonAsString() { return this->StopReasonString.c_str(); }
  vtkGetMacro(NumberOfOperations, vtkIdType);
  vtkGetMacro(OptimizeSeconds, double);

protected:
  vtkMeshOptimizeFilter();
  ~vtkMeshOptimizeFilter() override = default;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkMeshOptimizeFilter(const vtkMeshOptimizeFilter&) = delete;
  void operator=(const vtkMeshOptimizeFilter&) = delete;

  int Algorithm = Paper1996;
  double TargetQuality = 0.6;
  int QualityMeasure = Shape;
  double Beta = 0.0;
  double DesiredSize = 0.0;
  int NeighborhoodLevel = 1;
  int MaximumNumberOfIterations = 0;
  double Epsilon = 0.02;
  double ArmijoFactor = 0.01;
  int MaximumNumberOfAlternations = 20;
  bool MoveNodes = true;
  bool Reconnect = true;
  bool InsertNodes = true;
  bool RemoveNodes = true;
  int Effort = Default;
  int NumberOfThreads = 0;
  double GrowthBudget = 0.1;
  double TimeLimit = 0.0;

  double WorstQualityBefore = 0.0;
  double WorstQualityAfter = 0.0;
  double QualityBound = 0.0;
  int StopReason = 0;
  std::string StopReasonString;
  vtkIdType NumberOfOperations = 0;
  double OptimizeSeconds = 0.0;
};

#endif
