// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMeshOptimizeFilter
 * @brief   raise the worst element quality of a tetrahedral or triangle mesh
 *
 * vtkMeshOptimizeFilter moves nodes and changes the connectivity of a mesh to make its worst
 * element as good as possible. It maximizes Q(mesh) = min { Q(K) : K in mesh }, equation (2.1) of
 * the paper below. The quality of an element is its shape, optionally times a factor for its size
 * (2.2). A few very bad elements spoil a finite element computation; the mean hardly matters.
 *
 * <b>What is optimized.</b> The tetrahedra if the input has cells of dimension three, otherwise the
 * triangles. Triangles must lie in one plane (any plane). All other cells pass through and keep
 * their points: a triangle between two tetrahedra is kept as a face of the mesh, a line as an edge.
 * Quadratic triangles and tetrahedra also pass through, with a warning. So do ghost cells: those
 * that vtkGhostType marks as duplicate, refined or hidden.
 *
 * <b>What is kept.</b> The surface, bit for bit (in 2D: the boundary edges); the faces between
 * regions, see SetRegionArray(); the points of SetFixedPointArray(). With SetBoundaryMode() Slide
 * the first two take part, within a tolerance. The worst quality never falls; where sizes are
 * followed it may, but not under TargetQuality (see SetBeta()). So no cell becomes inverted if none
 * was. Inverted and flat cells of the input are repaired where the surface allows it; a warning
 * names those that are left, and the reason. (Their number may rise if the worst becomes less
 * inverted.) Cells that are numbered against their neighbours are renumbered (counted in the field
 * data `NumberOfReorientedCells`).
 *
 * <b>Output port 0: the mesh</b>, of the type of the input. If that is a tree of grids GetOutput()
 * is null: call GetOutputDataObject(0). First come the remaining points of the input in their old
 * order, then the new ones; the same holds for cells. Points that have not moved have the same
 * bits. If a point was moved or inserted, points are of type double even for a float input, since
 * rounding could lower the quality again. Data arrays keep name, type, components and attribute:
 * - point data: a point that has not moved keeps its values. For other points, floating point
 *   arrays are interpolated in the input cell that contains the point (constants are exact, linear
 *   fields up to rounding); all other arrays take the value of the nearest node of that cell.
 *   Arrays of boundary conditions (Constraint, Traction) stay 0 inside: those that are 0 at all
 *   points inside and all over some facet of the surface. (Of integers, also if no point is
 *   inside. Not on several ranks.)
 * - cell data: a new cell takes the values of the input cell whose place it takes.
 * - global ids: points and cells of the input keep them; new ones have -1. The array is no longer
 *   the active global id array, since ids that are unique over blocks and processes cannot be made
 *   here. Pedigree ids are not interpolated either, but a moved point keeps its own.
 * - field data: kept; added are `WorstQualityBefore`, `WorstQualityAfter`, `MeanQualityBefore`,
 *   `MeanQualityAfter`, `QualityBound`, `NumberOfCappedCells`, `NumberOfInvertedCellsBefore`,
 *   `NumberOfInvertedCellsAfter`, `NumberOfReorientedCells`, `NumberOfOperations`,
 *   `NumberOfEvaluations`, `StopReason`; with sizes or a metric `EdgeLengthShare` and
 *   `EdgeLengthHistogram`; if the surface of tetrahedra takes part `SurfaceDistance`,
 *   `VolumeChange` and `RegionVolumes`; with OptimizeBorders `NumberOfCellsInBands`.
 * - the cell array `MeshQuality` (double): quality by the chosen measure, also of ghost cells; NaN
 *   for other cells. It is the active scalars, unless another cell array of the input is.
 *   `MinimumDihedralAngle`, which vtkMeshQualityMinMax adds, is of other cells and left out.
 * - the point array `BoundaryPlace` (int), if the surface of tetrahedra takes part: 0 inside, 1 on
 *   a patch, 2 on a curve, 3 at a corner or fixed.
 *
 * <b>Output port 1: the history</b>, a vtkTable with one row per pass; the first row is the input.
 * Columns: Pass, Stage, how often each kind of operation was tried and done, then Worst, Mean,
 * BelowTarget (cells under the target), Cells and Points. For composite input the first column is
 * Block (the flat index). If the surface of tetrahedra takes part, SurfaceChangeTried and
 * SurfaceChangeDone count its changes, whatever the operation.
 *
 * <b>Composite data</b>: each vtkUnstructuredGrid is optimized separately; other leaves pass
 * through. Surfaces are kept, so neighbouring blocks still fit together. Results cover all blocks.
 *
 * <b>Distributed data</b>: the borders between the pieces of the ranks take part, and results are
 * those of the whole; ghost cells of the input are dropped, and made on request. See
 * SetOptimizeBorders(). With it off, each process optimizes its own piece and keeps the piece's
 * surface, so pieces still fit together. Ghost cells then stay as they are, but their originals may
 * have changed: generate ghost cells afterwards, not before. The history is that of the piece.
 *
 * <b>Errors.</b> An unusable input, array or option gives one error message that says what is wrong
 * and where; the outputs are then empty and GetErrorCode() is not 0. Unusable are a point id out of
 * range, a point twice in a cell, coordinates that are not finite, a face with three cells, a cell
 * given twice, triangles that are not in one plane.
 *
 * <b>Abort.</b> Progress is reported and AbortExecute is checked all the time. After an abort the
 * output is a valid mesh with all improvements so far, and GetStopReason() is Aborted. (Filters of
 * VTK usually leave an empty output.) From VTK 9.2 on AbortExecute stays set: call
 * SetAbortExecute(0) before the next run, which otherwise stops at once.
 *
 * <b>Warnings about sizes.</b> Sizes were given up (the worst quality would have become lower than
 * before, and lower than TargetQuality); splitting was stopped at several times the predicted
 * number of elements; kept edges are more than twice as long as wanted (in 2D); splines changed the
 * area by more than a tenth. Angles are those of the metric: in it a right-angled corner can be
 * very acute, and the cell there has no high quality in any mesh.
 *
 * The output is the same, bit for bit, for any number of threads, if no TimeLimit or abort ends it.
 *
 * @par Thanks:
 * G. C. Buscaglia, E. A. Dari, P. D. Zavattieri: Mesh optimization: some results in 3D elasticity
 * (1996). Equation numbers here are those of the paper.
 *
 * @sa
 * vtkMeshQualityMinMax vtkMeshQuality vtkConstrainedSmoothingFilter
 */
#ifndef vtkMeshOptimizeFilter_h
#define vtkMeshOptimizeFilter_h

#include "vtkFiltersMeshOptimizeModule.h" // for export macro
#include "vtkUnstructuredGridAlgorithm.h"

#include <string> // for the stop reason

class vtkAlgorithmOutput;
class vtkMultiProcessController;
class vtkPolyData;

class VTKFILTERSMESHOPTIMIZE_EXPORT vtkMeshOptimizeFilter : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkMeshOptimizeFilter* New();
  vtkTypeMacro(vtkMeshOptimizeFilter, vtkUnstructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum AlgorithmType
  {
    Paper1996 = 0, ///< the algorithm of the paper, step by step
    WorstFirst = 1 ///< the fast engine: priority queue, more operations, threads
  };
  ///@{
  /**
   * How to optimize. WorstFirst takes the worst cells from a queue and makes the cheapest change
   * that helps; it uses Effort, NumberOfThreads and GrowthBudget. A cell that its facet on the
   * surface caps under 0.2 is raised only to half of its cap, to spare its neighbours; only the
   * very worst cells are raised further. Paper1996 alternates the reconnection and the node
   * repositioning of the paper; it uses NeighborhoodLevel, MaximumNumberOfIterations, Epsilon,
   * ArmijoFactor and MaximumNumberOfAlternations. Both use all other properties. Default:
   * WorstFirst.
   */
  vtkSetClampMacro(Algorithm, int, Paper1996, WorstFirst);
  vtkGetMacro(Algorithm, int);
  void SetAlgorithmToPaper1996() { this->SetAlgorithm(Paper1996); }
  void SetAlgorithmToWorstFirst() { this->SetAlgorithm(WorstFirst); }
  ///@}

  ///@{
  /**
   * Stop once the worst quality is at least this (WorstFirst with the effort Best continues). Range
   * [0, 1], default 0.6; 1: continue as long as something improves. 0 is an error when the filter
   * runs: cells without volume would be good enough. Cells under the target are counted as
   * BelowTarget in the history.
   */
  vtkSetClampMacro(TargetQuality, double, 0.0, 1.0);
  vtkGetMacro(TargetQuality, double);
  ///@}

  enum QualityMeasureType
  {
    Shape = 0, ///< the paper's S (2.3): 1832.82 V / P^3, 20.78 A / P^2, P the sum of edge lengths
    RadiusRatio = 1, ///< D times inradius over circumradius
    MeanRatio = 2,   ///< 12 (3V)^(2/3) / sum l^2; 4 sqrt(3) A / sum l^2
    MinimumSine = 3, ///< least sine of the dihedral angles (2D: corner angles), at most .943 (.866)
    WarpedSine = 4,  ///< the same, with the sines of obtuse angles times 0.75
    VolumeLength = 5 ///< 6 sqrt(2) V / l_rms^3; 4 A / (sqrt(3) l_rms^2)
  };
  ///@{
  /**
   * The shape measure S to be optimized. All are 0 for a flat simplex, negative for an inverted
   * one, and greatest for the regular one (1, except for the sines). They do not depend on size.
   * Shape gives good overall shapes, MinimumSine good smallest dihedral angles. Any other number is
   * an error when the filter runs. Default: Shape.
   */
  vtkSetMacro(QualityMeasure, int);
  vtkGetMacro(QualityMeasure, int);
  void SetQualityMeasureToShape() { this->SetQualityMeasure(Shape); }
  void SetQualityMeasureToRadiusRatio() { this->SetQualityMeasure(RadiusRatio); }
  void SetQualityMeasureToMeanRatio() { this->SetQualityMeasure(MeanRatio); }
  void SetQualityMeasureToMinimumSine() { this->SetQualityMeasure(MinimumSine); }
  void SetQualityMeasureToWarpedSine() { this->SetQualityMeasure(WarpedSine); }
  void SetQualityMeasureToVolumeLength() { this->SetQualityMeasure(VolumeLength); }
  ///@}

  ///@{
  /**
   * Weight of size in the quality (2.2): Q = S exp(-beta^2 ln^2(h / h*)), with h the longest edge
   * of the element and h* the wanted size. Range >= 0, default 0: shape only. If it is greater than
   * 0, give the size by DesiredSize or SetSizeArray(). WorstFirst then first splits and contracts
   * edges until they have about the wanted length and the mesh has the number of elements of (5.3),
   * as far as the boundary allows; GrowthBudget, at most 0.05, counts from then on. In the boundary
   * mode Slide this also happens with Beta 0. The worst quality may then fall, but not under
   * TargetQuality.
   */
  vtkSetClampMacro(Beta, double, 0.0, 1e6);
  vtkGetMacro(Beta, double);
  ///@}

  ///@{
  /**
   * h* of (2.2): the longest edge that an element should have, the same everywhere, in units of the
   * coordinates (of the metric, if there is one). Range >= 0, default 0: not set. Used only if Beta
   * > 0 or the boundary slides; a size array takes precedence.
   */
  vtkSetClampMacro(DesiredSize, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(DesiredSize, double);
  ///@}

  ///@{
  /**
   * The parameters of Paper1996.
   * - NeighborhoodLevel, NL of the paper: how far from the worst element nodes are moved together.
   *   0: the nodes of the element; 1: also all that share an edge with them; and so on. Range 0 to
   *   3, default 1.
   * - MaximumNumberOfIterations, M of the paper: most steps of its global algorithm in each
   *   repositioning. Range >= 0, default 0: no limit.
   * - Epsilon of (2.8): elements of a cluster whose quality is at most this above the worst one
   *   determine the direction of a step. A solve ends when it gains less than a tenth of it. Range
   *   1e-6 to 1, default 0.02.
   * - ArmijoFactor, alpha of Armijo's rule (2.7): the fraction of the predicted gain that a step
   *   must reach. Range 1e-6 to 0.99, default 0.01.
   * - MaximumNumberOfAlternations: most rounds of reconnection and repositioning. Range >= 1,
   *   default 20.
   */
  vtkSetClampMacro(NeighborhoodLevel, int, 0, 3);
  vtkGetMacro(NeighborhoodLevel, int);
  vtkSetClampMacro(MaximumNumberOfIterations, int, 0, VTK_INT_MAX);
  vtkGetMacro(MaximumNumberOfIterations, int);
  vtkSetClampMacro(Epsilon, double, 1e-6, 1.0);
  vtkGetMacro(Epsilon, double);
  vtkSetClampMacro(ArmijoFactor, double, 1e-6, 0.99);
  vtkGetMacro(ArmijoFactor, double);
  vtkSetClampMacro(MaximumNumberOfAlternations, int, 1, VTK_INT_MAX);
  vtkGetMacro(MaximumNumberOfAlternations, int);
  ///@}

  ///@{
  /**
   * The allowed kinds of change; all by default. MoveNodes: move nodes (the paper's section 2.2).
   * Reconnect: change the connectivity, keep the nodes (2.3). InsertNodes, RemoveNodes: change the
   * connectivity and add, or remove, nodes. With all off the mesh is only measured.
   */
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
  ///@}

  ///@{
  /**
   * Whether to try, when nothing else gains, changes that gain only together or after nodes have
   * moved. On by default. This is not in the paper: with it off, Paper1996 is the algorithm as
   * printed, which stops at a lower quality where the surface leaves little freedom.
   */
  vtkSetMacro(LookAhead, bool);
  vtkGetMacro(LookAhead, bool);
  vtkBooleanMacro(LookAhead, bool);
  ///@}

  enum EffortType
  {
    Quick = 0,   ///< up to TargetQuality, by cheap changes only
    Default = 1, ///< up to TargetQuality
    Best = 2     ///< past TargetQuality, until nothing gains any more
  };
  ///@{
  /**
   * How much WorstFirst tries. Quick makes single changes, tries more only for the few worst cells,
   * and stops at TargetQuality. Default also tries changes that gain only together, and stops at
   * TargetQuality, too. Best looks further ahead and continues past TargetQuality, up to .76
   * (.80 where the surface of tetrahedra slides) or what the surface allows, until nothing improves
   * the worst cell any more. It takes many times as long as Default. Default: Default.
   */
  vtkSetClampMacro(Effort, int, Quick, Best);
  vtkGetMacro(Effort, int);
  void SetEffortToQuick() { this->SetEffort(Quick); }
  void SetEffortToDefault() { this->SetEffort(Default); }
  void SetEffortToBest() { this->SetEffort(Best); }
  ///@}

  ///@{
  /**
   * Threads that WorstFirst uses. Range >= 0, default 0: all (limited by VTK_SMP_MAX_THREADS, as
   * everywhere in VTK). The output does not depend on it.
   */
  vtkSetClampMacro(NumberOfThreads, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  ///@{
  /**
   * How much WorstFirst may increase the number of cells, as a fraction of the input's. Unless it
   * is 0, at least 30 tetrahedra or 10 triangles may be added. Range >= 0, default 0.15. A mesh
   * with hardly any interior nodes may need 1: if the budget stops it, the stop reason is
   * GrowthLimit. Unless sizes are followed, no more nodes are removed once 12 % of the cells and
   * 12 % of the nodes are gone (at the end of a run 24 % of the nodes), except around the few worst
   * cells: thin slabs full of nodes can lose up to 72 % of them. Where the surface slides, or in a
   * metric, nodes count only at cells below 0.3, and never more than 12 %.
   */
  vtkSetClampMacro(GrowthBudget, double, 0.0, 1e6);
  vtkGetMacro(GrowthBudget, double);
  ///@}

  ///@{
  /**
   * Change only cells whose quality is under this, and NumberOfLayers layers around them, to repair
   * a mesh that is good nearly everywhere. All other cells and their points stay bit for bit. Range
   * 0 to 1, default 0: all cells may change.
   *
   * Qualities, counts and history still cover all cells; QualityBound then holds while the other
   * cells are kept, too. TargetQuality, GrowthBudget, NumberOfCappedCells and StopReason refer to
   * the cells that may change; if there are none, the stop reason is NothingToDo. Cells that are
   * numbered against their neighbours count as inverted, and so may change.
   */
  vtkSetClampMacro(OptimizeBelow, double, 0.0, 1.0);
  vtkGetMacro(OptimizeBelow, double);
  ///@}

  ///@{
  /**
   * Number of layers around the cells under OptimizeBelow that may change, too. A layer shares
   * nodes with the one before. Range >= 0, default 2. Not used if OptimizeBelow is 0.
   */
  vtkSetClampMacro(NumberOfLayers, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfLayers, int);
  ///@}

  enum BoundaryModeType
  {
    Fixed = 0, ///< the boundary is kept, bit for bit
    Slide = 1  ///< its nodes slide along the geometry, and may be added or removed
  };
  ///@{
  /**
   * The treatment of the boundary, including interfaces between regions and the sides of cracks.
   * Slide needs WorstFirst; tetrahedra must be in one piece. Default: Fixed.
   *
   * Slide, triangles: nodes slide along the curves that the boundary follows, edges on them are
   * split and contracted, and new nodes lie on the curve. Corners stay. The curves come from the
   * mesh's own boundary, or from input port 1 if that is connected. Points of FixedPointArray, and
   * of lines and other cells that pass through, are corners. Where the boundary would cross itself,
   * because a gap is narrower than the curves bulge, it stays as it is.
   *
   * Slide, tetrahedra: nodes slide on patches of the surface and along the curves between them;
   * facets and edges there are swapped, split and contracted. The surface stays within
   * SurfaceTolerance of what it was, both ways; where nothing else helps, its nodes leave it, and
   * corners move, by less than that. FeatureAngle, regions, and
   * lines that are cells divide the surface by curves; CornerAngle, CornerArray and
   * FixedPointArray, and points of cells that pass through, are corners. Facets with three fixed
   * points stay as they are, and so do those that lie on one another, like the lips of a closed
   * crack. Not with sizes or a metric.
   */
  vtkSetClampMacro(BoundaryMode, int, Fixed, Slide);
  vtkGetMacro(BoundaryMode, int);
  void SetBoundaryModeToFixed() { this->SetBoundaryMode(Fixed); }
  void SetBoundaryModeToSlide() { this->SetBoundaryMode(Slide); }
  ///@}

  enum BoundaryCurveType
  {
    Straight = 0, ///< straight lines from point to point
    BSpline = 1   ///< a cubic B-spline through the points between two corners
  };
  ///@{
  /**
   * The shape of the boundary between the given points. Lines that continue straight stay straight
   * with both. Default: BSpline.
   */
  vtkSetClampMacro(BoundaryCurve, int, Straight, BSpline);
  vtkGetMacro(BoundaryCurve, int);
  void SetBoundaryCurveToStraight() { this->SetBoundaryCurve(Straight); }
  void SetBoundaryCurveToBSpline() { this->SetBoundaryCurve(BSpline); }
  ///@}

  ///@{
  /**
   * A corner is where the boundary of triangles (or the geometry of port 1), or a curve on the
   * surface of tetrahedra, turns by more than this, in degrees. Range 0 to 180, default 45.
   * SetCornerArray() adds others.
   */
  vtkSetClampMacro(CornerAngle, double, 0.0, 180.0);
  vtkGetMacro(CornerAngle, double);
  ///@}

  ///@{
  /**
   * For BoundaryMode Slide with tetrahedra: an edge of the surface where its two facets turn by
   * more than this is part of a curve. In degrees, range 0 to 180, default 45.
   */
  vtkSetClampMacro(FeatureAngle, double, 0.0, 180.0);
  vtkGetMacro(FeatureAngle, double);
  ///@}

  ///@{
  /**
   * For BoundaryMode Slide with tetrahedra: whether ridges stay. If off, those that turn by less
   * than 80 degrees are given up where the target is not reached with them: for scans, whose noise
   * has angles. From then on they are surface like any other, and may be cut off as far as the
   * tolerance allows. Regions, patches, lines, marked and fixed points stay. It does not matter if
   * the tolerance is 0. Default: on.
   */
  vtkSetMacro(KeepFeatures, bool);
  vtkGetMacro(KeepFeatures, bool);
  vtkBooleanMacro(KeepFeatures, bool);
  ///@}

  ///@{
  /**
   * For BoundaryMode Slide with tetrahedra: how far the surface and what it becomes may be from
   * each other, both ways. A fraction of the diagonal of the bounding box of all tetrahedra, unless
   * ToleranceIsAbsolute. Range >= 0, default 1e-3; a tenth of the diagonal is the most that counts.
   *
   * With 0 the surface stays the same set of points, up to rounding (8 units in the last place of
   * the greatest coordinate): nodes slide in flat parts and along straight edges only. Below 1e-6
   * of the diagonal it is the same, with this tolerance in place of rounding: 1e-7 is for
   * coordinates of single precision.
   */
  vtkSetClampMacro(SurfaceTolerance, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(SurfaceTolerance, double);
  ///@}

  ///@{
  /**
   * Whether SurfaceTolerance is a length, not a fraction. Default: off.
   */
  vtkSetMacro(ToleranceIsAbsolute, bool);
  vtkGetMacro(ToleranceIsAbsolute, bool);
  vtkBooleanMacro(ToleranceIsAbsolute, bool);
  ///@}

  ///@{
  /**
   * Input port 1, optional, for BoundaryMode Slide: the geometry of the boundary, a vtkPolyData
   * whose lines the boundary follows. The boundary points of the mesh must lie on it (to 1e-3 of
   * the diagonal), one of them at each of its corners. Otherwise there is one error that says
   * where. Both sides of a crack may be given as one line.
   */
  void SetGeometryConnection(vtkAlgorithmOutput* output);
  void SetGeometryData(vtkPolyData* geometry);
  ///@}

  ///@{
  /**
   * Stop after this many seconds. Range >= 0, default 0: no limit. With a limit, two runs can
   * differ.
   */
  vtkSetClampMacro(TimeLimit, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(TimeLimit, double);
  ///@}

  ///@{
  /**
   * The input arrays by name; nullptr or "" for none, which is the default. The same as
   * SetInputArrayToProcess() with the index given here.
   * - 0, region: cell array of one integer component. Faces between cells of different regions are
   *   kept, and a new cell lies in one region.
   * - 1, fixed points: point array of one numeric component. Points where it is not 0 neither move
   *   nor vanish.
   * - 2, size: point array of one numeric component greater than 0: h* of (2.2) at the points,
   *   interpolated between them; takes the place of DesiredSize. It matters only with Beta > 0 or
   *   BoundaryMode Slide.
   * - 3, metric: point array of a symmetric positive definite tensor M, 6 components in VTK's order
   *   XX YY ZZ XY YZ XZ or 9 (symmetric to 1e-6); lengths are measured as sqrt(e' M e). Triangles
   *   use its part in their plane.
   * - 4, corners: point array of one numeric component, of the mesh or of the geometry on port 1.
   *   Points where it is not 0 are corners for BoundaryMode Slide.
   * - 5, patches: for BoundaryMode Slide with tetrahedra; the border between two values of this
   *   array is a curve. On cells, one integer component: triangles of the grid that are faces of
   *   tetrahedra ride on the surface, and the faces of the new mesh there get triangles, too, with
   *   the data of the nearest; lines that are edges of the surface are curves of it, and the edges
   *   of the new mesh there get lines. Without it, all cell arrays of one integer count (except
   *   ids). Or on points, if no cell array has this name: node sets, Constraint, Traction; 0 means
   *   that a point is in no set. Facets with three points of one value (of floating-point arrays:
   *   not 0) are a patch. Its area stays what it was, within the tolerance; single points of a set
   *   stay. Whatever is chosen, point arrays that are not 0 just on whole patches and their borders
   *   keep these: new points get values from the same patch, those beside it 0.
   */
  void SetRegionArray(const char* name);
  void SetFixedPointArray(const char* name);
  void SetSizeArray(const char* name);
  void SetMetricArray(const char* name);
  void SetCornerArray(const char* name);
  void SetPatchArray(const char* name);
  ///@}

  ///@{
  /**
   * Whether, on several ranks, the borders between their pieces take part: bands of cells around
   * them move to one rank and are optimized there. A mesh that lies on one rank is divided first.
   * Results are those of the whole on all ranks; the history is on the first. Filters/RANKS.md
   * says what each option then means, and which data are needed.
   *
   * This is for tetrahedra, or triangles in one plane. In composite data the grids of all ranks
   * with the same flat index are one mesh. With sizes, a metric or other cells, one warning says
   * that the borders are kept. Ghost cells of the input are dropped. BoundaryMode Slide is for
   * triangles without sizes; in all other cases it is an error on several pieces.
   *
   * It has an effect if the number of pieces that is asked for is that of the controller's ranks,
   * as in ParaView, or by UpdatePiece(rank, ranks, 0). All ranks must then update together.
   * Default: on.
   */
  vtkSetMacro(OptimizeBorders, bool);
  vtkGetMacro(OptimizeBorders, bool);
  vtkBooleanMacro(OptimizeBorders, bool);
  ///@}

  ///@{
  /**
   * Layers of ghost cells that the output of each rank gets, if OptimizeBorders is in effect:
   * copies of the other ranks' cells around its piece, marked by vtkGhostType. If the pipeline asks
   * for more layers, there are as many as it asks for. Ghost cells of the input are dropped first.
   * Range [0, inf); default 0.
   */
  vtkSetClampMacro(NumberOfGhostLevels, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfGhostLevels, int);
  ///@}

  ///@{
  /**
   * The controller of the ranks. Default: the global controller. Null: this rank only.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

  enum StopReasonType
  {
    NotRun = 0,          ///< not run yet, or stopped by an error
    TargetReached = 1,   ///< the worst quality is at least TargetQuality
    CappedBySurface = 2, ///< no cell under the target can get better while the surface is kept
    NoFurtherGain = 3,   ///< no operation improves the worst cells any more
    IterationLimit = 4,
    TimeLimitReached = 5,
    Aborted = 6,
    NothingToDo = 7, ///< no triangles or tetrahedra, or none under OptimizeBelow
    GrowthLimit = 8  ///< changes that would help need more cells than GrowthBudget allows
  };

  ///@{
  /**
   * Results of the last run: quality of the worst cell and mean quality, before and after; the
   * certified upper bound on the worst quality (1 if unknown); the number of cells that their own
   * cap keeps under the target. 0 before a run, and if there was nothing to optimize.
   *
   * The bound holds while the surface is kept, for the measure Shape also for what stands opposite
   * in thin walls, see vtkMeshQualityMinMax; with BoundaryMode Slide, tetrahedra and
   * SurfaceTolerance 0, while it stays the same set of points: it is then what the angles at
   * straight ridges and in flat corners allow, for all measures. With a tolerance above 0 nothing
   * is certain.
   */
  vtkGetMacro(WorstQualityBefore, double);
  vtkGetMacro(WorstQualityAfter, double);
  vtkGetMacro(MeanQualityBefore, double);
  vtkGetMacro(MeanQualityAfter, double);
  vtkGetMacro(QualityBound, double);
  vtkGetMacro(NumberOfCappedCells, vtkIdType);
  ///@}

  ///@{
  /**
   * Cells without a positive quality, inverted or flat, before and after the last run. A warning
   * names those that are left and the reason; in the output their MeshQuality is 0 or negative.
   * Cells that were only numbered in reverse are not counted.
   */
  vtkGetMacro(NumberOfInvertedCellsBefore, vtkIdType);
  vtkGetMacro(NumberOfInvertedCellsAfter, vtkIdType);
  ///@}

  ///@{
  /**
   * Why the last run stopped, as StopReasonType and as a sentence. For several blocks it is the
   * reason that says most (aborted, a limit, no further gain, capped, target reached). Where the
   * surface of tetrahedra slides, the sentence says how the nodes of the worst cell are held.
   */
  vtkGetMacro(StopReason, int);
  const char* GetStopReasonAsString();
  ///@}

  ///@{
  /**
   * More about the last run. SurfaceDistance: with BoundaryMode Slide and tetrahedra, the distance
   * that is proved between the surface of the input and that of the output, both ways; a length, at
   * most the tolerance. 0 otherwise. VolumeChange: that of the volume, relative to the volume
   * before. Both are also in the field data, as is `RegionVolumes`. EdgeLengthShare: the fraction
   * of edges in the output that are 1/sqrt(2) to sqrt(2) times as long as wanted at their place, in
   * the metric if there is one; 0 if neither a size nor a metric was given. It is also in the field
   * data of the output, as is the histogram `EdgeLengthHistogram`. NumberOfOperations: of all kinds
   * together. NumberOfEvaluations: qualities, and gradients of qualities, that the passes computed.
   * It tells what a run cost, whatever the machine, and is the same for any number of threads.
   * OptimizeSeconds: time in the optimizer, without import and export. It is in no output
   * array: outputs are the same bit for bit.
   */
  vtkGetMacro(EdgeLengthShare, double);
  vtkGetMacro(SurfaceDistance, double);
  vtkGetMacro(VolumeChange, double);
  vtkGetMacro(NumberOfOperations, vtkIdType);
  vtkGetMacro(NumberOfEvaluations, vtkIdType);
  vtkGetMacro(OptimizeSeconds, double);
  ///@}

  vtkTypeBool ProcessRequest(
    vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

protected:
  vtkMeshOptimizeFilter();
  ~vtkMeshOptimizeFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  virtual int RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector*);
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkMeshOptimizeFilter(const vtkMeshOptimizeFilter&) = delete;
  void operator=(const vtkMeshOptimizeFilter&) = delete;

  struct Results;
  void StoreResults(const Results& results);

  int Algorithm = WorstFirst;
  double TargetQuality = 0.6;
  int QualityMeasure = Shape;
  double Beta = 0.0, DesiredSize = 0.0;
  int NeighborhoodLevel = 1;
  int MaximumNumberOfIterations = 0;
  double Epsilon = 0.02, ArmijoFactor = 0.01;
  int MaximumNumberOfAlternations = 20;
  bool MoveNodes = true, Reconnect = true, InsertNodes = true, RemoveNodes = true;
  bool LookAhead = true;
  int Effort = Default;
  int NumberOfThreads = 0;
  double GrowthBudget = 0.15;
  double OptimizeBelow = 0.0;
  int NumberOfLayers = 2;
  double TimeLimit = 0.0;
  int BoundaryMode = Fixed, BoundaryCurve = BSpline;
  double CornerAngle = 45.0, FeatureAngle = 45.0;
  bool KeepFeatures = true;
  double SurfaceTolerance = 1e-3;
  bool ToleranceIsAbsolute = false;
  bool OptimizeBorders = true;
  int NumberOfGhostLevels = 0;
  vtkMultiProcessController* Controller = nullptr;

  double WorstQualityBefore = 0.0, WorstQualityAfter = 0.0;
  double MeanQualityBefore = 0.0, MeanQualityAfter = 0.0;
  double QualityBound = 0.0;
  vtkIdType NumberOfCappedCells = 0;
  vtkIdType NumberOfInvertedCellsBefore = 0, NumberOfInvertedCellsAfter = 0;
  int StopReason = NotRun;
  std::string StopReasonText = "not run";
  vtkIdType NumberOfOperations = 0, NumberOfEvaluations = 0;
  double EdgeLengthShare = 0.0, SurfaceDistance = 0.0, VolumeChange = 0.0;
  double OptimizeSeconds = 0.0;
};

#endif
