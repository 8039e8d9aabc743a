// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMeshQualityMinMax
 * @brief   quality of every element, its minimum, maximum and distribution, and the worst elements
 *
 * Measures the triangles and tetrahedra of an unstructured grid, or of all unstructured grids in a
 * composite data set. Quadratic and higher-order ones are judged by their corners. All figures
 * cover all blocks and all ranks. Ghost cells (those that `vtkGhostType` marks as duplicate,
 * refined or hidden) are measured but not counted; its other flags make no difference.
 *
 * Outputs:
 *  - 0: the input with the cell array `MeshQuality`, or `MinimumDihedralAngle` if that is the
 *    measure. It is the active scalars. It is NaN for cells that are neither triangles nor
 *    tetrahedra (these pass through), and for cells with a coordinate that is not finite. It is
 *    0 for elements without volume, negative for inverted ones. Triangles have a sign only in a
 *    grid of nothing but triangles in one plane (any plane, to 1e-6 of their extent): the upper
 *    side is the one for which most of the area is positive. Elsewhere there is no upper side.
 *  - 1: summary (vtkTable), a row for each region and a last one, `all`: Region, Count, Minimum,
 *    Mean, Maximum, StandardDeviation (divided by Count), Inverted, NotMeasurable, OtherCells,
 *    Bound, CappedCells.
 *  - 2: histogram (vtkTable): BinCenter, BinLow, BinHigh, Count; bins of equal width from 0, or the
 *    minimum if that is less, to the value of the regular element, so that histograms before and
 *    after can be compared.
 *  - 3: the worst cells (vtkUnstructuredGrid), worst first: the same array, OriginalCellIds (in
 *    their grid), Rank, Block (flat index; composite input only), Center (mean of the points). Each
 *    rank has only its own ones.
 *
 * Tables are filled on rank 0 and empty elsewhere; the figures that Get...() returns are the same
 * on all ranks. The plane and the upper side of triangles are those of all ranks, too. An error on
 * one rank is one on all, told by the first.
 *
 * Bound and CappedCells say how much of the result is due to the surface. No mesh with this surface
 * (and these facets between regions) can have a worst element above Bound. CappedCells elements
 * belong to facets that keep them below TargetQuality, whatever is done inside. Blocks are treated
 * separately: facets between them count as surface. Facets between the pieces of a block on several
 * ranks do not. Two such facets are the same if their corners have the same global ids; if some
 * piece has no ids, if their corners have the same coordinates. (Then a crack of doubled nodes
 * along a border is taken for a part of the border; the bound still holds.) Facets to ghost cells
 * do not count as surface either. vtkMeshOptimizeFilter keeps them, so that its own bound can be
 * lower. The bound is known for triangles in a plane and for tetrahedra. With the measure Shape it
 * follows from facets, dihedral angles, and, on one rank, from what stands opposite in thin walls;
 * with Mean Ratio and Volume Length from facets. Otherwise, and with a metric array, it is the
 * value of the regular element. What stands opposite is looked for at the worst elements on the
 * surface if they are under TargetQuality. It takes for granted that the surface does not pass
 * through itself. The better the mesh, the fewer places it is looked for at, and the surer the
 * lowest is found; so the bound of an optimized mesh can be lower than that of the input. Both
 * hold.
 *
 * Input arrays, by SetInputArrayToProcess() or the setters below:
 *  - 0, cells: region, integers, one component;
 *  - 2, points: desired size h*, one component, positive; used if Beta > 0;
 *  - 3, points: metric tensor, symmetric positive definite, 6 components (XX YY ZZ XY YZ XZ) or 9
 *    (symmetric to 1e-6). For triangles in a plane only its part in that plane counts.
 *
 * An array that was chosen but is missing or unusable is an error (one message, empty outputs,
 * error code vtkErrorCode::UserError), and so is Beta > 0 without a size. Values that only ghost
 * cells need may be anything. A broken mesh is no error: it is measured as it is.
 *
 * The result has the same bits for any number of threads.
 *
 * @par Reference
 * G. C. Buscaglia, E. A. Dari, P. D. Zavattieri, "Mesh optimization: some results in 3D elasticity"
 * (1996), equations (2.1) to (2.3).
 *
 * @sa vtkMeshOptimizeFilter
 */
#ifndef vtkMeshQualityMinMax_h
#define vtkMeshQualityMinMax_h

#include "vtkFiltersMeshOptimizeModule.h" // for export macro
#include "vtkUnstructuredGridAlgorithm.h"

class vtkMultiProcessController;

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

  ///@{
  /**
   * The measure of quality. All are 0 for a flat element and keep the sign of the volume; the
   * regular element has the greatest value, 1 unless stated otherwise.
   *  - Shape (default): c V / P^3, with P the sum of the edges, c = 1296 sqrt(2);
   *    triangles: 36 / sqrt(3) A / P^2;
   *  - RadiusRatio: 3 r / R (triangles: 2 r / R) of inscribed and circumscribed sphere;
   *  - MeanRatio: 12 (3 V)^(2/3) / sum l^2; triangles: 4 sqrt(3) A / sum l^2;
   *  - MinimumSine: least sine of the dihedral (triangles: corner) angles, at most .9428 (.8660);
   *  - WarpedSine: the same, with sines of obtuse angles times .75;
   *  - VolumeLength: 6 sqrt(2) V / l_rms^3; triangles: 4 A / (sqrt(3) l_rms^2);
   *  - MinimumDihedralAngle: least dihedral (corner) angle in degrees, at most 70.53 (60).
   * Any other number is an error when the filter runs.
   */
  vtkSetMacro(QualityMeasure, int);
  vtkGetMacro(QualityMeasure, int);
  void SetQualityMeasureToShape() { this->SetQualityMeasure(Shape); }
  void SetQualityMeasureToRadiusRatio() { this->SetQualityMeasure(RadiusRatio); }
  void SetQualityMeasureToMeanRatio() { this->SetQualityMeasure(MeanRatio); }
  void SetQualityMeasureToMinimumSine() { this->SetQualityMeasure(MinimumSine); }
  void SetQualityMeasureToWarpedSine() { this->SetQualityMeasure(WarpedSine); }
  void SetQualityMeasureToVolumeLength() { this->SetQualityMeasure(VolumeLength); }
  void SetQualityMeasureToMinimumDihedralAngle() { this->SetQualityMeasure(MinimumDihedralAngle); }
  ///@}

  ///@{
  /**
   * Width of the size factor exp(-Beta^2 ln^2(h / h*)) by which the measure is multiplied, with h
   * the longest edge (in the metric). >= 0; default 0: no size factor. If above 0, DesiredSize or a
   * size array is needed.
   */
  vtkSetClampMacro(Beta, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Beta, double);
  ///@}

  ///@{
  /**
   * Desired size h*, in units of length, used if Beta > 0 and no size array is chosen. >= 0;
   * default 0: not given.
   */
  vtkSetClampMacro(DesiredSize, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(DesiredSize, double);
  ///@}

  ///@{
  /**
   * Number of cells in the output of the worst cells, over all blocks and ranks. >= 0; default 10.
   */
  vtkSetClampMacro(NumberOfWorstCells, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfWorstCells, int);
  ///@}

  ///@{
  /**
   * Number of bins of the histogram. 1 to 1 000 000; default 20.
   */
  vtkSetClampMacro(NumberOfBins, int, 1, 1000000);
  vtkGetMacro(NumberOfBins, int);
  ///@}

  ///@{
  /**
   * Whether to find the surface and compute its bound. Default on. If off, Bound is the value of
   * the regular element and CappedCells is 0; this saves about nine tenths of the time.
   */
  vtkSetMacro(ComputeBound, bool);
  vtkGetMacro(ComputeBound, bool);
  vtkBooleanMacro(ComputeBound, bool);
  ///@}

  ///@{
  /**
   * CappedCells counts the elements that the surface keeps under this quality. >= 0; default 0.6,
   * as in vtkMeshOptimizeFilter.
   */
  vtkSetClampMacro(TargetQuality, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(TargetQuality, double);
  ///@}

  ///@{
  /**
   * The input arrays by name, the same as SetInputArrayToProcess() with index 0 (cells), 2 and 3
   * (points); nullptr or "" for none, which is the default.
   */
  void SetRegionArray(const char* name);
  void SetSizeArray(const char* name);
  void SetMetricArray(const char* name);
  ///@}

  ///@{
  /**
   * The controller whose ranks the figures cover. Default: the global controller. Null: this rank
   * only. All its ranks must update the filter together.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

  ///@{
  /**
   * Figures of the last update over all blocks and ranks. The first four are NaN if there was
   * nothing to measure.
   */
  vtkGetMacro(MinimumQuality, double);
  vtkGetMacro(MaximumQuality, double);
  vtkGetMacro(MeanQuality, double);
  vtkGetMacro(StandardDeviation, double);
  vtkGetMacro(NumberOfMeasuredCells, vtkIdType);
  vtkGetMacro(NumberOfInvertedCells, vtkIdType);
  ///@}

  /**
   * Cells with a coordinate that is not finite, or with a point that does not exist. They are in no
   * other figure.
   */
  vtkGetMacro(NumberOfNotMeasurableCells, vtkIdType);

  /**
   * Cells that are neither triangles nor tetrahedra.
   */
  vtkGetMacro(NumberOfOtherCells, vtkIdType);

  /**
   * Upper bound on the worst quality while the surface is kept; see the class documentation.
   */
  vtkGetMacro(QualityBound, double);

  /**
   * Number of elements that their facets on the surface keep below TargetQuality.
   */
  vtkGetMacro(NumberOfCappedCells, vtkIdType);

  ///@{
  /**
   * The worst cell: its id in its grid, the flat index of its block (0 for a grid that is not in a
   * composite data set), and its rank. -1 if there is none. Ties go to the lowest rank, block, id.
   */
  vtkGetMacro(WorstCellId, vtkIdType);
  vtkGetMacro(WorstCellBlock, int);
  vtkGetMacro(WorstCellRank, int);
  ///@}

protected:
  vtkMeshQualityMinMax();
  ~vtkMeshQualityMinMax() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  vtkTypeBool ProcessRequest(
    vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector*);
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkMeshQualityMinMax(const vtkMeshQualityMinMax&) = delete;
  void operator=(const vtkMeshQualityMinMax&) = delete;

  struct Run;
  void StoreFigures(const Run& run);
  void FillOutputs(Run& run, vtkInformationVector* outputVector);
  void WarnOfNothing(const Run& run);

  int QualityMeasure = Shape;
  double Beta = 0.0;
  double DesiredSize = 0.0;
  int NumberOfWorstCells = 10;
  int NumberOfBins = 20;
  bool ComputeBound = true;
  double TargetQuality = 0.6;
  vtkMultiProcessController* Controller = nullptr;

  double MinimumQuality = 0.0;
  double MaximumQuality = 0.0;
  double MeanQuality = 0.0;
  double StandardDeviation = 0.0;
  double QualityBound = 0.0;
  vtkIdType NumberOfMeasuredCells = 0;
  vtkIdType NumberOfInvertedCells = 0;
  vtkIdType NumberOfNotMeasurableCells = 0;
  vtkIdType NumberOfOtherCells = 0;
  vtkIdType NumberOfCappedCells = 0;
  vtkIdType WorstCellId = -1;
  int WorstCellBlock = -1;
  int WorstCellRank = -1;
};

#endif
