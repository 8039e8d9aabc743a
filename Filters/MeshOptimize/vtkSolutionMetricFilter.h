// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSolutionMetricFilter
 * @brief   where a mesh should be fine, and in which direction: a metric from a solution on it
 *
 * vtkSolutionMetricFilter takes a mesh of triangles or tetrahedra with a solution on it, and says
 * what mesh would be right for that solution. vtkMeshOptimizeFilter then makes that mesh.
 *
 * <b>Criterion Hessian</b> (section 5 of the paper below): from a scalar or vector field at the
 * points it recovers the second derivatives (5.4), takes their absolute value G = |D2u| (for
 * vectors (5.2), the root of the sum of squares over the components), and finds the size h* for
 * which a mesh whose edges all have the length h*, measured in G, has the wanted number of elements
 * (5.3). Elements get small where the solution is curved, and long where it is curved in one
 * direction only. Outputs, besides the input as it is:
 * - point array `Metric`: G, 6 components XX YY ZZ XY YZ XZ, symmetric positive definite, within
 *   the limits set below. It is not divided by h*: the length wanted in it is DesiredSize. For
 *   triangles the direction across their plane gets the geometric mean of the other two.
 * - point array `DesiredSize`: h*, the same at all points.
 * - point array `SizeTensor`, if wanted: h* G^(-1/2), whose axes are the wanted edge lengths. Made
 *   for tensor glyphs, which then have the shape of the elements to come.
 *
 * <b>Criterion ErrorIndicator</b> (the paper's other alternative): from an error of each cell, such
 * as that of Zienkiewicz and Zhu, it computes at each point the edge length for which all elements
 * have the same error, without stretching them. Output:
 * - point array `DesiredSize`: that length.
 *
 * <b>To use it</b>, whichever the criterion, pass both arrays on:
 * @code
 * metric->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "u");
 * metric->SetDesiredNumberOfElements(10000);
 * optimize->SetInputConnection(metric->GetOutputPort());
 * optimize->SetMetricArray("Metric");    // not with ErrorIndicator
 * optimize->SetSizeArray("DesiredSize"); // or SetDesiredSize(metric->GetDesiredSize())
 * optimize->SetBeta(2.0);
 * @endcode
 * With Beta 2 an element of perfect shape reaches the quality 0.6, the default target, if its
 * longest edge is right to a factor of sqrt 2. That suits triangles; tetrahedra, whose longest
 * edges differ more from the others, get better and sooner with Beta 1.
 *
 * <b>Input</b>: a vtkUnstructuredGrid whose cells of the greatest dimension are all linear
 * tetrahedra, or all linear triangles in one plane. Cells of lower dimension (faces, lines,
 * vertices) pass through. Ghost cells are left out; they and points that only other cells use get
 * values that mean nothing. Blocks of composite data, and pieces of distributed data, are treated
 * each by itself, with the wanted number for each.
 *
 * <b>Input arrays</b>, by SetInputArrayToProcess() or the setters below:
 * - 0, points: the solution, any number of components. Default: the active scalars.
 * - 1, cells: the error of each cell, one component, not negative. Default: the active scalars.
 *
 * <b>Errors.</b> An array that is missing or not usable (a value that is not finite is named with
 * its point or cell), cells that are no simplices, triangles that are not in one plane, a mesh too
 * small to recover second derivatives from, or contradicting limits give one message; the output is
 * then empty and GetErrorCode() is not 0. A linear solution has no second derivatives: the metric
 * is then the Euclidean one, with a warning; and there is a warning if the limits on the size leave
 * only more or fewer elements than wanted.
 *
 * @par Thanks:
 * G. C. Buscaglia, E. A. Dari, P. D. Zavattieri: Mesh optimization: some results in 3D elasticity
 * (1996). Equation numbers here are its numbers.
 *
 * @sa
 * vtkMeshOptimizeFilter vtkMeshQualityMinMax vtkTensorGlyph
 */
#ifndef vtkSolutionMetricFilter_h
#define vtkSolutionMetricFilter_h

#include "vtkFiltersMeshOptimizeModule.h" // for export macro
#include "vtkUnstructuredGridAlgorithm.h"

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
   * What the mesh is to be adapted to. Default: Hessian.
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
   * How many elements the mesh made for the result should have, about: (4 / sqrt 3) vol_G / h*^2 of
   * them fill a plane domain, 6 sqrt(2) vol_G / h*^3 one in space, where vol_G is its volume in the
   * metric (5.3). The volume is that of the log-Euclidean interpolation of the metric, limits
   * included. Range >= 0, default 0: as many as the input has.
   */
  vtkSetClampMacro(DesiredNumberOfElements, int, 0, VTK_INT_MAX);
  vtkGetMacro(DesiredNumberOfElements, int);
  ///@}

  ///@{
  /**
   * Elements that came out last time for each one that was wanted: the number predicted is
   * multiplied by it. Real meshes are not made of regular elements only; after one run the quotient
   * of the two numbers, times the correction used in it, puts that right. Range 0.01 to 100,
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
   * How second derivatives are recovered (Hessian only). LumpedMass is the paper's, and smooth; it
   * is exact for quadratics only where a patch of cells is symmetric about its point, and the
   * boundary gets what continues the interior. LeastSquares is exact for quadratics everywhere,
   * needs no interior points, and follows noise more closely. Default: LumpedMass.
   */
  vtkSetClampMacro(Recovery, int, LumpedMass, LeastSquares);
  vtkGetMacro(Recovery, int);
  void SetRecoveryToLumpedMass() { this->SetRecovery(LumpedMass); }
  void SetRecoveryToLeastSquares() { this->SetRecovery(LeastSquares); }
  ///@}

  ///@{
  /**
   * p of the L^p norm whose interpolation error is to be least for the number of elements (Hessian
   * only): G is multiplied by det(G)^(-1 / (2p + D)), D the dimension. 0 stands for infinity, the
   * paper's metric: equal errors on all edges, however strong a singularity is. With p = 1 or 2
   * weaker features get their share. Range >= 0, default 0.
   */
  vtkSetClampMacro(NormOrder, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(NormOrder, double);
  ///@}

  ///@{
  /**
   * Shortest and longest edge to be wanted, in any direction, in the units of the coordinates. At a
   * singularity (the tip of a crack) set MinimumSize: sizes go to zero there. Range >= 0; default
   * 0: no shortest one, and the longest is the diagonal of the mesh.
   */
  vtkSetClampMacro(MinimumSize, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MinimumSize, double);
  vtkSetClampMacro(MaximumSize, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MaximumSize, double);
  ///@}

  ///@{
  /**
   * Longest over shortest wanted edge at a point, at most (Hessian only); the longer ones are made
   * shorter. Range >= 1, or 0 for no limit, which is the paper's. Default 20: where a solution is
   * not curved at all in one direction, longer elements gain little, and noise in the second
   * derivatives turns them.
   */
  vtkSetClampMacro(MaximumAnisotropy, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MaximumAnisotropy, double);
  ///@}

  ///@{
  /**
   * How fast sizes may grow: over an edge of length l (in units of the size wanted at its end) by
   * the factor 1 + l ln(Gradation), about this ratio from one element to the next. Where they would
   * grow faster they are made smaller. Range > 1, or 0 for no limit, which is the paper's. Default
   * 1.5: with sizes that jump there are no good elements in between.
   */
  vtkSetClampMacro(Gradation, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Gradation, double);
  ///@}

  ///@{
  /**
   * If above 0, the number of elements is not DesiredNumberOfElements but what makes the total
   * error this part of the present one (ErrorIndicator only). For a wanted relative error it is the
   * quotient of that and the present relative error. Range >= 0, default 0.
   */
  vtkSetClampMacro(DesiredErrorFraction, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(DesiredErrorFraction, double);
  ///@}

  ///@{
  /**
   * The error goes with this power of the size (ErrorIndicator only): 1 for stresses and energy
   * norms of linear elements, 2 for their values. Range 0.1 to 10, default 1.
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
   * Results of the last run, 0 before it and after an error. DesiredSize: the h* to be given to
   * vtkMeshOptimizeFilter along with `Metric`; 0 with ErrorIndicator, whose sizes vary.
   * PredictedNumberOfElements: what the metric or the sizes stand for; the wanted number, if the
   * limits allow it. TotalError: root of the sum of squares of the indicator (ErrorIndicator only).
   */
  vtkGetMacro(DesiredSize, double);
  vtkGetMacro(PredictedNumberOfElements, double);
  vtkGetMacro(TotalError, double);
  ///@}

protected:
  vtkSolutionMetricFilter();
  ~vtkSolutionMetricFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
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

  double DesiredSize = 0.0;
  double PredictedNumberOfElements = 0.0;
  double TotalError = 0.0;
};

#endif
