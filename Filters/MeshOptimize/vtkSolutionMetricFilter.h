// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSolutionMetricFilter
 * @brief   where a mesh should be fine, and in which direction: a metric from a solution on it
 *
 * vtkSolutionMetricFilter takes a mesh of triangles or tetrahedra with a solution on it. It
 * computes which mesh would be right for that solution; vtkMeshOptimizeFilter then makes that mesh.
 *
 * <b>Criterion Hessian</b> (section 5 of the paper below): from a scalar or vector field at the
 * points it recovers the second derivatives (5.4) and takes their absolute value G = |D2u| (for
 * vectors (5.2): the root of the sum of squares over the components). Then it finds the size h* for
 * which a mesh with all edges of length h*, measured in G, has the wanted number of elements (5.3).
 * Elements become small where the solution is curved, and long where it is curved in one direction
 * only. Outputs, besides the unchanged input:
 * - point array `Metric`: G, 6 components XX YY ZZ XY YZ XZ, symmetric positive definite, within
 *   the limits set below. It is not divided by h*: the wanted length in it is DesiredSize. For
 *   triangles the direction across their plane gets the geometric mean of the other two.
 * - point array `DesiredSize`: h*, the same at all points.
 * - point array `SizeTensor`, optional: h* G^(-1/2), whose axes are the wanted edge lengths. It is
 *   made for tensor glyphs, which then have the shape of the wanted elements.
 *
 * <b>Criterion ErrorIndicator</b> (the paper's other alternative): from an error of each cell, such
 * as that of Zienkiewicz and Zhu, it computes an edge length at each point with which all elements
 * have the same error. Elements are not stretched. Output:
 * - point array `DesiredSize`: that length.
 *
 * <b>To use it</b>, with either criterion, pass both arrays on:
 * @code
 * metric->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "u");
 * metric->SetDesiredNumberOfElements(10000);
 * optimize->SetInputConnection(metric->GetOutputPort());
 * optimize->SetMetricArray("Metric");    // not with ErrorIndicator
 * optimize->SetSizeArray("DesiredSize"); // or SetDesiredSize(metric->GetDesiredSize())
 * optimize->SetBeta(2.0);
 * @endcode
 * With Beta 2, an element of perfect shape reaches the quality 0.6, the default target, if its
 * longest edge is right up to a factor of sqrt 2. This suits triangles. The longest edges of
 * tetrahedra differ more from the others; tetrahedra become better, and sooner, with Beta 1.
 *
 * <b>Input</b>: a vtkUnstructuredGrid whose cells of the greatest dimension are all linear
 * tetrahedra, or all linear triangles in one plane. Cells of lower dimension (faces, lines,
 * vertices) pass through. Ghost cells are ignored; they, and points that only other cells use, get
 * meaningless values. Blocks of composite data are treated separately; the wanted number applies to
 * each.
 *
 * <b>Distributed data</b>: where the pipeline asks for one piece on each process of the controller,
 * values and figures are those of the whole mesh, the same on all processes. Points, cells and the
 * array come to the first process for that, which needs the memory; see Filters/RANKS.md.
 *
 * <b>Input arrays</b>, by SetInputArrayToProcess() or the setters below:
 * - 0, points: the solution, any number of components. Default: the active scalars.
 * - 1, cells: the error of each cell, one component, not negative. Default: the active scalars.
 *
 * <b>Errors.</b> Each of these gives one message, an empty output, and a GetErrorCode() that is not
 * 0: an array that is missing or unusable (a value that is not finite is named with its point or
 * cell), cells that are not simplices, triangles that are not in one plane, a mesh too small to
 * recover second derivatives, contradicting limits. There are two warnings. A linear solution has
 * no second derivatives: the metric is then Euclidean. And the limits on the size may allow only
 * more or fewer elements than wanted.
 *
 * @par Thanks:
 * G. C. Buscaglia, E. A. Dari, P. D. Zavattieri: Mesh optimization: some results in 3D elasticity
 * (1996). Equation numbers here are those of the paper.
 *
 * @sa
 * vtkMeshOptimizeFilter vtkMeshQualityMinMax vtkTensorGlyph
 */
#ifndef vtkSolutionMetricFilter_h
#define vtkSolutionMetricFilter_h

#include "vtkFiltersMeshOptimizeModule.h" // for export macro
#include "vtkUnstructuredGridAlgorithm.h"

class vtkMultiProcessController;

class VTKFILTERSMESHOPTIMIZE_EXPORT vtkSolutionMetricFilter : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkSolutionMetricFilter* New();
  vtkTypeMacro(vtkSolutionMetricFilter, vtkUnstructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum CriterionType
  {
    Hessian = 0,       ///< second derivatives of a solution at the points: metric
    ErrorIndicator = 1 ///< an error of each cell: sizes
  };
  ///@{
  /**
   * The data that the mesh is adapted to. Default: Hessian.
   */
  vtkSetClampMacro(Criterion, int, Hessian, ErrorIndicator);
  vtkGetMacro(Criterion, int);
  void SetCriterionToHessian() { this->SetCriterion(Hessian); }
  void SetCriterionToErrorIndicator() { this->SetCriterion(ErrorIndicator); }
  ///@}

  ///@{
  /**
   * The input arrays by name, the same as SetInputArrayToProcess() with index 0 (points) and 1
   * (cells). nullptr or "": the active scalars, which is the default.
   */
  void SetSolutionArray(const char* name);
  void SetErrorIndicatorArray(const char* name);
  ///@}

  ///@{
  /**
   * The approximate number of elements of the mesh to be made: (4 / sqrt 3) vol_G / h*^2 in 2D, 6
   * sqrt(2) vol_G / h*^3 in 3D, where vol_G is the volume of the domain in the metric (5.3). This
   * is the volume of the log-Euclidean interpolation of the metric, limits included. Range >= 0,
   * default 0: as many as the input has.
   */
  vtkSetClampMacro(DesiredNumberOfElements, int, 0, VTK_INT_MAX);
  vtkGetMacro(DesiredNumberOfElements, int);
  ///@}

  ///@{
  /**
   * Number of elements that the last run made for each wanted one; the predicted number is
   * multiplied by it. Real meshes do not consist of regular elements only. After one run set it to
   * the quotient of the two numbers, times the correction used in that run. Range 0.01 to 100,
   * default 1.
   */
  vtkSetClampMacro(CountCorrection, double, 0.01, 100.0);
  vtkGetMacro(CountCorrection, double);
  ///@}

  enum RecoveryType
  {
    LumpedMass = 0,  ///< the paper's (5.4); dH/dn = 0 on the boundary
    LeastSquares = 1 ///< a quadratic through the neighbours of each point, in the least squares
  };
  ///@{
  /**
   * How second derivatives are recovered (Hessian only). LumpedMass is the paper's method, and
   * smooth. It is exact for quadratics only where a patch of cells is symmetric about its point; on
   * the boundary it continues the interior. LeastSquares is exact for quadratics everywhere, needs
   * no interior points, and follows noise more closely. Default: LumpedMass.
   */
  vtkSetClampMacro(Recovery, int, LumpedMass, LeastSquares);
  vtkGetMacro(Recovery, int);
  void SetRecoveryToLumpedMass() { this->SetRecovery(LumpedMass); }
  void SetRecoveryToLeastSquares() { this->SetRecovery(LeastSquares); }
  ///@}

  ///@{
  /**
   * p of the L^p norm of the interpolation error that the metric minimizes for its number of
   * elements (Hessian only): G is multiplied by det(G)^(-1 / (2p + D)), D the dimension. 0 means
   * infinity, the paper's metric: equal errors on all edges, even at a strong singularity. With p =
   * 1 or 2 weaker features get their share. Range >= 0, default 0.
   */
  vtkSetClampMacro(NormOrder, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(NormOrder, double);
  ///@}

  ///@{
  /**
   * Shortest and longest wanted edge, in any direction, in units of the coordinates. At a
   * singularity (the tip of a crack) set MinimumSize: sizes go to zero there. 0, or from 1e-50
   * to 1e50; default 0: no shortest edge, and the longest is the diagonal of the mesh.
   */
  vtkSetClampMacro(MinimumSize, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MinimumSize, double);
  vtkSetClampMacro(MaximumSize, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MaximumSize, double);
  ///@}

  ///@{
  /**
   * Greatest ratio of the longest to the shortest wanted edge at a point (Hessian only); longer
   * edges are made shorter. Range >= 1, or 0 for no limit, as in the paper. Default 20: where a
   * solution is not curved at all in one direction, longer elements gain little, and noise in the
   * second derivatives changes their direction.
   */
  vtkSetClampMacro(MaximumAnisotropy, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MaximumAnisotropy, double);
  ///@}

  ///@{
  /**
   * How fast sizes may grow: over an edge of length l (in units of the size wanted at its end) by
   * the factor 1 + l ln(Gradation), which is about this ratio from one element to the next. Where
   * they would grow faster, they are made smaller. Range > 1, or 0 for no limit, as in the paper.
   * Default 1.5: between sizes that jump there are no good elements.
   */
  vtkSetClampMacro(Gradation, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Gradation, double);
  ///@}

  ///@{
  /**
   * If above 0, the number of elements is chosen to make the total error this fraction of the
   * present one, and DesiredNumberOfElements is not used (ErrorIndicator only). To get a certain
   * relative error, divide it by the present relative error. Range >= 0, default 0.
   */
  vtkSetClampMacro(DesiredErrorFraction, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(DesiredErrorFraction, double);
  ///@}

  ///@{
  /**
   * The error is proportional to this power of the size (ErrorIndicator only): 1 for stresses and
   * energy norms of linear elements, 2 for their values. Range 0.1 to 10, default 1.
   */
  vtkSetClampMacro(ConvergenceOrder, double, 0.1, 10.0);
  vtkGetMacro(ConvergenceOrder, double);
  ///@}

  ///@{
  /**
   * Whether the point array `SizeTensor` is made (Hessian only). Default: off.
   */
  vtkSetMacro(ComputeSizeTensor, bool);
  vtkGetMacro(ComputeSizeTensor, bool);
  vtkBooleanMacro(ComputeSizeTensor, bool);
  ///@}

  ///@{
  /**
   * Results of the last run; 0 before it and after an error. DesiredSize: the h* for
   * vtkMeshOptimizeFilter, to be used with `Metric`; 0 with ErrorIndicator, whose sizes vary.
   * PredictedNumberOfElements: the number predicted from the metric or the sizes; it is the wanted
   * number if the limits allow it. TotalError: root of the sum of squares of the indicator
   * (ErrorIndicator only).
   */
  vtkGetMacro(DesiredSize, double);
  vtkGetMacro(PredictedNumberOfElements, double);
  vtkGetMacro(TotalError, double);
  ///@}

  ///@{
  /**
   * The controller whose processes each have a piece of the mesh. Default: the global controller.
   * Null: this process only. All its processes must update together, with UpdatePiece().
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

  vtkTypeBool ProcessRequest(
    vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

protected:
  vtkSolutionMetricFilter();
  ~vtkSolutionMetricFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkSolutionMetricFilter(const vtkSolutionMetricFilter&) = delete;
  void operator=(const vtkSolutionMetricFilter&) = delete;

  int Criterion = Hessian;
  int DesiredNumberOfElements = 0;
  double CountCorrection = 1.0;
  int Recovery = LumpedMass;
  double NormOrder = 0.0;
  double MinimumSize = 0.0;
  double MaximumSize = 0.0;
  double MaximumAnisotropy = 20.0;
  double Gradation = 1.5;
  double DesiredErrorFraction = 0.0;
  double ConvergenceOrder = 1.0;
  bool ComputeSizeTensor = false;
  vtkMultiProcessController* Controller = nullptr;

  double DesiredSize = 0.0;
  double PredictedNumberOfElements = 0.0;
  double TotalError = 0.0;
};

#endif
