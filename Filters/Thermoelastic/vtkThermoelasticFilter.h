// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkThermoelasticFilter
 * @brief   linear thermoelastic finite element analysis on tetrahedra or triangles
 *
 * vtkThermoelasticFilter computes the deformation and the stress of a body. Loads are a temperature
 * field, forces on the surface, and prescribed displacements. Strains are small, the material is
 * isotropic and linear, elements are linear (P1).
 *
 * <b>What is solved on.</b> The tetrahedra of the input, if there are any; triangles and lines are
 * then marks on the body, and pass through. Otherwise the triangles, which must lie in one plane
 * (any plane), in plane strain or plane stress, per unit of thickness. Quadratic cells and other
 * cells of the same dimension are an error, since without them it would be another body.
 *
 * <b>Units</b> are the caller's, and must be consistent: with metres and Pa, forces are in N and
 * energies in J. Stress is positive in tension.
 *
 * <b>Arrays that are read.</b> Each has a default name, which is used unless another one is chosen
 * (see SetTemperatureArray() and those below it). A chosen array must exist.
 * - point `Temperature`: see TemperatureMode.
 * - cell `YoungsModulus`, `PoissonsRatio`, `ThermalExpansion`: if present, they replace the
 *   properties of the same names.
 * - point `Constraint`: a component of the displacement is prescribed where this is not 0; three
 *   components, or one for all three. The prescribed value is 0, or that of point
 *   `PrescribedDisplacement`. (In 2D the component across the plane is ignored.) NaN is an error.
 * - point `Traction`: force per area along the axes (3 components), or a pressure (1 component,
 *   positive when it pushes). It acts on facets of the surface all of whose points have one that is
 *   not 0, and is linear on them. Tractions without any such facet are an error, and in 2D those
 *   with a part across the plane.
 * - cell `FacetTraction`: the same, constant on a facet. It is read at cells of the input that are
 *   facets of the surface: triangles on tetrahedra, lines on triangles.
 * <b>Constraints</b> come from the arrays and from GeneralizedPlaneStrain; if both prescribe the
 * same component, the array counts. For motions that they leave free see RigidMotion.
 *
 * <b>Output port 0</b>: the input with these arrays added (double; they replace arrays of the same
 * name). Z is the normal of a plane. Outside of the mesh values are NaN, but 0 in the vectors.
 * - point `Displacement` (3), to warp by.
 * - point `Stress` (6: XX YY ZZ XY YZ XZ), see StressRecovery; `VonMises`; `PrincipalStress` (3,
 *   the greatest first). Not with StressRecovery None.
 * - point `Reaction` (3): the force that holds the prescribed components of the point.
 * - cell `ElementStress` (6): at the centroid; the element's own stress, which is less accurate.
 * - cell `StrainEnergyDensity`.
 * - cell `ErrorEstimate`: Zienkiewicz and Zhu's, in the energy norm (the root of an energy). The
 *   sum of its squares is the square of GetErrorEstimate(). Not with StressRecovery None.
 * - point `Temperature`, if it was not an array of the input.
 * - field data `NumberOfUnknowns`, `NumberOfSolverIterations`, `RelativeResidual`, `StrainEnergy`,
 *   `TotalErrorEstimate`, `RelativeErrorEstimate`.
 *
 * <b>Output port 1</b>: a vtkTable with `Iteration` and `RelativeResidual`, from 0 (before the
 * first step) to the last.
 *
 * <b>Errors.</b> A problem that cannot be solved (no temperature, too few constraints, a Poisson's
 * ratio of 0.5, an inverted element, loads without equilibrium, ...) gives one error message that
 * says what is wrong and where; outputs are then empty and GetErrorCode() is not 0. A solver that
 * does not reach its tolerance gives a warning, and GetStopReason() says so. After an abort outputs
 * are empty and GetStopReason() is Aborted.
 *
 * <b>Composite data</b>: each grid is a body of its own; results are those of the last one, and
 * output port 1 has a table for each.
 *
 * <b>Distributed data</b>: a body must be on one process; others may have empty pieces. Otherwise
 * there is an error on all processes.
 *
 * The same input gives the same output, bit for bit, for any number of threads.
 *
 * @par Thanks:
 * The conjugate gradients with diagonal preconditioner are those of G. C. Buscaglia, E. A. Dari,
 * P. D. Zavattieri: Mesh optimization: some results in 3D elasticity (1996). Patch recovery and
 * error estimate: O. C. Zienkiewicz, J. Z. Zhu, Int. J. Numer. Meth. Eng. 33 (1992) 1331-1382.
 *
 * @sa
 * vtkMeshOptimizeFilter vtkWarpVector
 */
#ifndef vtkThermoelasticFilter_h
#define vtkThermoelasticFilter_h

#include "vtkFiltersThermoelasticModule.h" // for export macro
#include "vtkUnstructuredGridAlgorithm.h"

#include <string>

class vtkMultiProcessController;
class vtkTable;

class VTKFILTERSTHERMOELASTIC_EXPORT vtkThermoelasticFilter : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkThermoelasticFilter* New();
  vtkTypeMacro(vtkThermoelasticFilter, vtkUnstructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum TemperatureModeType
  {
    PointArray = 0, ///< the temperature array
    Radial = 1,     ///< T = AxisTemperature - RadialCoefficient r^2, r the distance from Axis
    Uniform = 2     ///< UniformTemperature everywhere
  };
  ///@{
  /**
   * Source of the temperature. It is linear in each element, from its values at the points. For an
   * analysis without temperature choose Uniform with UniformTemperature equal to
   * ReferenceTemperature, as the defaults are. Default: PointArray.
   */
  vtkSetClampMacro(TemperatureMode, int, PointArray, Uniform);
  vtkGetMacro(TemperatureMode, int);
  void SetTemperatureModeToPointArray() { this->SetTemperatureMode(PointArray); }
  void SetTemperatureModeToRadial() { this->SetTemperatureMode(Radial); }
  void SetTemperatureModeToUniform() { this->SetTemperatureMode(Uniform); }
  ///@}

  ///@{
  /**
   * For TemperatureMode Uniform. Default 0.
   */
  vtkSetMacro(UniformTemperature, double);
  vtkGetMacro(UniformTemperature, double);
  ///@}

  ///@{
  /**
   * T0 and T1 of TemperatureMode Radial, T = T0 - T1 r^2: the profile of a cylinder with a uniform
   * heat source. r is the distance from the coordinate axis that Axis names. Both default to 0.
   */
  vtkSetMacro(AxisTemperature, double);
  vtkGetMacro(AxisTemperature, double);
  vtkSetMacro(RadialCoefficient, double);
  vtkGetMacro(RadialCoefficient, double);
  ///@}

  ///@{
  /**
   * The temperature at which there is no thermal strain. Default 0.
   */
  vtkSetMacro(ReferenceTemperature, double);
  vtkGetMacro(ReferenceTemperature, double);
  ///@}

  ///@{
  /**
   * Material where there are no cell arrays for it. YoungsModulus > 0, default 2e11; PoissonsRatio
   * in ]-1, 0.5[, default 0.316; ThermalExpansion per unit of temperature, default 1e-5. The
   * defaults are uranium dioxide in SI.
   */
  vtkSetMacro(YoungsModulus, double);
  vtkGetMacro(YoungsModulus, double);
  vtkSetMacro(PoissonsRatio, double);
  vtkGetMacro(PoissonsRatio, double);
  vtkSetMacro(ThermalExpansion, double);
  vtkGetMacro(ThermalExpansion, double);
  ///@}

  enum PlaneStateType
  {
    PlaneStrain = 0, ///< no strain along the normal (or that of GeneralizedPlaneStrain)
    PlaneStress = 1  ///< no stress along the normal
  };
  ///@{
  /**
   * The state across the plane, for triangles. Default: PlaneStrain.
   */
  vtkSetClampMacro(PlaneState, int, PlaneStrain, PlaneStress);
  vtkGetMacro(PlaneState, int);
  void SetPlaneStateToPlaneStrain() { this->SetPlaneState(PlaneStrain); }
  void SetPlaneStateToPlaneStress() { this->SetPlaneState(PlaneStress); }
  ///@}

  ///@{
  /**
   * Constrain the two ends of the body along Axis, as if it were a piece of a long body. All points
   * of the lowest plane (within 1e-6 of the height) stay in it; all of the highest plane move by
   * the same amount, AxialStrain times the height; sideways they are free. On triangles with Axis
   * the normal of their plane, the strain along it is AxialStrain. Off by default.
   */
  vtkSetMacro(GeneralizedPlaneStrain, bool);
  vtkGetMacro(GeneralizedPlaneStrain, bool);
  vtkBooleanMacro(GeneralizedPlaneStrain, bool);
  ///@}

  enum AxisType
  {
    X = 0,
    Y = 1,
    Z = 2
  };
  ///@{
  /**
   * The coordinate axis of TemperatureMode Radial and of GeneralizedPlaneStrain. Default: Z.
   */
  vtkSetClampMacro(Axis, int, X, Z);
  vtkGetMacro(Axis, int);
  void SetAxisToX() { this->SetAxis(X); }
  void SetAxisToY() { this->SetAxis(Y); }
  void SetAxisToZ() { this->SetAxis(Z); }
  ///@}

  enum AxialStrainModeType
  {
    Free = 0, ///< such that the ends carry no resultant force
    Given = 1 ///< AxialStrain
  };
  ///@{
  /**
   * The strain of GeneralizedPlaneStrain. Free: the mean of thermal expansion times temperature,
   * weighted with Young's modulus and volume. This leaves no resultant force on the ends of a prism
   * with free sides and the same Poisson's ratio everywhere. Default: Free; AxialStrain 0.
   */
  vtkSetClampMacro(AxialStrainMode, int, Free, Given);
  vtkGetMacro(AxialStrainMode, int);
  void SetAxialStrainModeToFree() { this->SetAxialStrainMode(Free); }
  void SetAxialStrainModeToGiven() { this->SetAxialStrainMode(Given); }
  vtkSetMacro(AxialStrain, double);
  vtkGetMacro(AxialStrain, double);
  ///@}

  enum RigidMotionType
  {
    Forbid = 0, ///< an error that names a motion that is free
    Pin = 1,    ///< single components of points are held at 0, as many as needed
    Project = 2 ///< the displacement without mean translation and rotation
  };
  ///@{
  /**
   * How to handle rigid motions that the constraints leave free: without constraints all six (2D:
   * three). They do not change stress, but loads must be in equilibrium along them. Pin holds as
   * many components of points far apart as there are motions (the 3-2-1 rule). Project removes the
   * motions from the displacement instead, which needs fewer steps of the conjugate gradients.
   * Default: Forbid.
   */
  vtkSetClampMacro(RigidMotion, int, Forbid, Project);
  vtkGetMacro(RigidMotion, int);
  void SetRigidMotionToForbid() { this->SetRigidMotion(Forbid); }
  void SetRigidMotionToPin() { this->SetRigidMotion(Pin); }
  void SetRigidMotionToProject() { this->SetRigidMotion(Project); }
  ///@}

  ///@{
  /**
   * A pressure on the whole surface, positive when it pushes. Default 0.
   */
  vtkSetMacro(SurfacePressure, double);
  vtkGetMacro(SurfacePressure, double);
  ///@}

  ///@{
  /**
   * The input arrays by name; nullptr or "" for the default name, under which the array may be
   * absent (except for the temperature). The same as SetInputArrayToProcess() with the index given
   * here. For their meaning see above.
   * - 0, temperature: points, 1 component, `Temperature`.
   * - 1 to 3, Young's modulus, Poisson's ratio, thermal expansion: cells, 1 component,
   *   `YoungsModulus`, `PoissonsRatio`, `ThermalExpansion`.
   * - 4, region: cells, 1 integer component, no default name. Recovery of stress does not cross the
   *   border of a region: choose it where materials differ much.
   * - 5, constraint: points, 1 or 3 components, `Constraint`.
   * - 6, prescribed displacement: points, 3 components, `PrescribedDisplacement`. Needs a
   *   constraint array.
   * - 7, traction: points, 1 or 3 components, `Traction`.
   * - 8, facet traction: cells, 1 or 3 components, `FacetTraction`.
   */
  void SetTemperatureArray(const char* name);
  void SetYoungsModulusArray(const char* name);
  void SetPoissonsRatioArray(const char* name);
  void SetThermalExpansionArray(const char* name);
  void SetRegionArray(const char* name);
  void SetConstraintArray(const char* name);
  void SetPrescribedDisplacementArray(const char* name);
  void SetTractionArray(const char* name);
  void SetFacetTractionArray(const char* name);
  ///@}

  enum StressRecoveryType
  {
    Patch = 0,         ///< superconvergent patch recovery; on the surface from interior points
    LocalPatch = 1,    ///< the same, each point from its own cells
    VolumeAverage = 2, ///< mean of the cells around the point, weighted by volume
    None = 3           ///< no point stress, no error estimate
  };
  ///@{
  /**
   * How the stress at points is computed from that of the elements. Patch fits linear polynomials
   * to the elements around each interior point; points of the surface take the values of the
   * polynomials of their interior neighbours. This is accurate, and hides bad elements at the
   * surface. LocalPatch fits at each point, also on the surface, and shows them. VolumeAverage is
   * smooth, with low accuracy at the surface. Default: Patch.
   */
  vtkSetClampMacro(StressRecovery, int, Patch, None);
  vtkGetMacro(StressRecovery, int);
  void SetStressRecoveryToPatch() { this->SetStressRecovery(Patch); }
  void SetStressRecoveryToLocalPatch() { this->SetStressRecovery(LocalPatch); }
  void SetStressRecoveryToVolumeAverage() { this->SetStressRecovery(VolumeAverage); }
  void SetStressRecoveryToNone() { this->SetStressRecovery(None); }
  ///@}

  enum SolverType
  {
    ConjugateGradient = 0,  ///< preconditioned by the diagonal
    IncompleteCholesky = 1, ///< conjugate gradients, preconditioned by an incomplete factorization
    Direct = 2              ///< sparse LDL' factorization
  };
  ///@{
  /**
   * How the equations are solved. IncompleteCholesky needs about a third of the steps, each twice
   * as long. Direct is for small meshes: time and memory grow fast, and it cannot be aborted.
   * Default: ConjugateGradient.
   */
  vtkSetClampMacro(Solver, int, ConjugateGradient, Direct);
  vtkGetMacro(Solver, int);
  void SetSolverToConjugateGradient() { this->SetSolver(ConjugateGradient); }
  void SetSolverToIncompleteCholesky() { this->SetSolver(IncompleteCholesky); }
  void SetSolverToDirect() { this->SetSolver(Direct); }
  ///@}

  ///@{
  /**
   * The solver stops when the residual has fallen to this fraction of the right-hand side. Range
   * 1e-15 to 0.1, default 1e-8.
   */
  vtkSetClampMacro(Tolerance, double, 1e-15, 0.1);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Most steps of the conjugate gradients. Range >= 1, default 10000.
   */
  vtkSetClampMacro(MaximumNumberOfIterations, int, 1, VTK_INT_MAX);
  vtkGetMacro(MaximumNumberOfIterations, int);
  ///@}

  ///@{
  /**
   * Threads to use. Range >= 0, default 0: all (limited by VTK_SMP_MAX_THREADS, as everywhere in
   * VTK). The output does not depend on it.
   */
  vtkSetClampMacro(NumberOfThreads, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  enum StopReasonType
  {
    NotRun = 0,         ///< not run yet, or stopped by an error
    Converged = 1,      ///< solved to the tolerance
    IterationLimit = 2, ///< the tolerance was not reached
    Breakdown = 3,      ///< no further step is possible: singular up to rounding
    Aborted = 4,
    NothingToDo = 5 ///< no cells
  };

  ///@{
  /**
   * How the last run ended, as StopReasonType and in words.
   */
  vtkGetMacro(StopReason, int);
  const char* GetStopReasonAsString();
  ///@}

  ///@{
  /**
   * Results of the last run: unknowns; steps of the conjugate gradients (0 for Direct); final
   * residual over right-hand side; the strain energy; the error estimate in the energy norm and
   * relative to the norm of the solution, 0 to 1; the strain prescribed by GeneralizedPlaneStrain.
   * 0 before a run and after an error.
   */
  vtkGetMacro(NumberOfUnknowns, vtkIdType);
  vtkGetMacro(NumberOfSolverIterations, int);
  vtkGetMacro(RelativeResidual, double);
  vtkGetMacro(StrainEnergy, double);
  vtkGetMacro(ErrorEstimate, double);
  vtkGetMacro(RelativeErrorEstimate, double);
  vtkGetMacro(PrescribedAxialStrain, double);
  ///@}

  ///@{
  /**
   * Seconds of the last run for assembly, for solving, and for stresses and their recovery. Not
   * part of any output array.
   */
  vtkGetMacro(AssemblySeconds, double);
  vtkGetMacro(SolveSeconds, double);
  vtkGetMacro(RecoverySeconds, double);
  ///@}

  ///@{
  /**
   * The controller that tells whether the body is spread over several processes. Default: the
   * global controller. Null: this process only. Asked with UpdatePiece() for one piece on each of
   * its processes, all must update together; asked for the whole, a process works alone.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

  vtkTypeBool ProcessRequest(
    vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

protected:
  vtkThermoelasticFilter();
  ~vtkThermoelasticFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkThermoelasticFilter(const vtkThermoelasticFilter&) = delete;
  void operator=(const vtkThermoelasticFilter&) = delete;

  struct Results;
  void StoreResults(const Results& results);
  void Solve(const std::string& title, vtkUnstructuredGrid* input, vtkUnstructuredGrid* output,
    vtkTable* history);
  void ChooseArray(int index, bool onCells, const char* name);

  int TemperatureMode = PointArray;
  double UniformTemperature = 0.0;
  double AxisTemperature = 0.0;
  double RadialCoefficient = 0.0;
  double ReferenceTemperature = 0.0;
  double YoungsModulus = 2e11;
  double PoissonsRatio = 0.316;
  double ThermalExpansion = 1e-5;
  int PlaneState = PlaneStrain;
  bool GeneralizedPlaneStrain = false;
  int Axis = Z;
  int AxialStrainMode = Free;
  double AxialStrain = 0.0;
  int RigidMotion = Forbid;
  double SurfacePressure = 0.0;
  int StressRecovery = Patch;
  int Solver = ConjugateGradient;
  double Tolerance = 1e-8;
  int MaximumNumberOfIterations = 10000;
  int NumberOfThreads = 0;
  vtkMultiProcessController* Controller = nullptr;

  int StopReason = NotRun;
  vtkIdType NumberOfUnknowns = 0;
  int NumberOfSolverIterations = 0;
  double RelativeResidual = 0.0;
  double StrainEnergy = 0.0;
  double ErrorEstimate = 0.0;
  double RelativeErrorEstimate = 0.0;
  double PrescribedAxialStrain = 0.0;
  double AssemblySeconds = 0.0;
  double SolveSeconds = 0.0;
  double RecoverySeconds = 0.0;
};

#endif
