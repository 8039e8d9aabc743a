// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetGenFilter
 * @brief   fill a closed surface with tetrahedra, by TetGen
 *
 * vtkTetGenFilter passes a closed surface to TetGen (Hang Si, version 1.5) and returns its mesh: a
 * constrained Delaunay tetrahedralization, refined as wanted.
 *
 * <b>Licence.</b> TetGen is under the AGPL, version 3 or later. Therefore this module is separate
 * and can be left out of a build: see Filters/TetGen/README.md.
 *
 * <b>Input port 0: the surface</b>, a vtkPolyData of triangles. Polygons and strips are cut into
 * triangles (vtkTriangleFilter); vertices and lines are ignored. It must be closed: every edge has
 * two triangles, or more where inner walls meet. TetGen treats points nearer to each other than
 * 1e-8 of its size as one point, so triangles between them are errors. Each compartment that walls
 * enclose is filled, including cavities, unless AddHole() says otherwise. Orientation does not
 * matter.
 *
 * <b>Input port 1: interior points</b>, any vtkPointSet, optional. Points strictly inside become
 * nodes; those outside or on the surface (within 1e-8 of its size) are left out. TetGen may add
 * more nodes, and may move them at an OptimizationLevel above 0.
 *
 * <b>Output: the mesh</b>, a vtkUnstructuredGrid of tetrahedra with points of type double. All
 * points of the surface come first, even unused ones, with the same ids and bit for bit the same
 * coordinates; then the new ones. Arrays:
 * - cell array `Region` (int): the attribute that AddRegion() gives the compartment. Compartments
 *   without one get the numbers after the highest attribute; without any attribute, from 1.
 * - point data of the surface. A new point has NaN in floating point arrays and 0 in others. Global
 *   ids are left out.
 * - field data of the surface. Cell data are left out: triangles are not cells of the mesh.
 *
 * <b>Where TetGen runs.</b> In a child process (fork): TetGen ends the process on failed
 * assertions, frees memory twice after errors, prints, and keeps its state in statics. None of this
 * reaches the application, and nothing is printed. Progress follows the phases that TetGen reports.
 * After an abort the output is empty. POSIX only.
 *
 * <b>Errors</b> give one message that says what is wrong and where, in ids and coordinates of the
 * input; the output is then empty and GetErrorCode() is not 0. Errors are: a surface that is not
 * closed or intersects itself, points that coincide or are not finite, facets without area or given
 * twice, polygons that cannot be cut, no facets at all, an unusable option, and every other failure
 * of TetGen, with the last line it printed. An input without points and cells gives an empty output
 * and no message.
 *
 * <b>Distributed data</b>: each process fills its own piece of the surface; each piece must be
 * closed.
 *
 * The same input gives the same output, bit for bit.
 *
 * @par Thanks:
 * H. Si: TetGen, a Delaunay-based quality tetrahedral mesh generator. ACM Transactions on
 * Mathematical Software 41 (2015) 11.
 *
 * @sa
 * vtkMeshOptimizeFilter vtkDelaunay3D vtkCleanPolyData
 */
#ifndef vtkTetGenFilter_h
#define vtkTetGenFilter_h

#include "vtkFiltersTetGenModule.h" // for export macro
#include "vtkUnstructuredGridAlgorithm.h"

#include <string> // for std::string
#include <vector> // for std::vector

class vtkPointSet;
class vtkPolyData;

namespace vtkTetGenBridge
{
struct Job;
struct Mesh;
struct Surface;
}

class VTKFILTERSTETGEN_EXPORT vtkTetGenFilter : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkTetGenFilter* New();
  vtkTypeMacro(vtkTetGenFilter, vtkUnstructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * No tetrahedron may be larger than this (TetGen's -a), in units of the coordinates cubed. Range
   * >= 0, default 0: no limit. While the surface is kept, tetrahedra at a coarse surface stay
   * larger.
   */
  vtkSetClampMacro(MaximumVolume, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MaximumVolume, double);
  ///@}

  ///@{
  /**
   * Nodes are added until no tetrahedron has a larger ratio of its circumradius to its shortest
   * edge (TetGen's -q), except where a kept surface or its small angles prevent it. Slivers have a
   * small ratio and stay. The regular tetrahedron has 0.612. Range 0 or >= 1, default 2; 0: no
   * limit. Below about 1.2 TetGen may take very long.
   */
  vtkSetClampMacro(MaximumRadiusEdgeRatio, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MaximumRadiusEdgeRatio, double);
  ///@}

  ///@{
  /**
   * Nodes are also added where a dihedral angle is smaller than this, in degrees (TetGen's -q/).
   * Range 0 to 70, default 0: no limit. Above about 18 TetGen may take very long.
   */
  vtkSetClampMacro(MinimumDihedralAngle, double, 0.0, 70.0);
  vtkGetMacro(MinimumDihedralAngle, double);
  ///@}

  ///@{
  /**
   * Whether each triangle of the surface must be a face of a tetrahedron (TetGen's -Y). On by
   * default. If off, TetGen may cut triangles by points on the surface, and coplanar triangles
   * count as one facet; the points of the surface are still kept.
   */
  vtkSetMacro(KeepSurface, bool);
  vtkGetMacro(KeepSurface, bool);
  vtkBooleanMacro(KeepSurface, bool);
  ///@}

  ///@{
  /**
   * How much TetGen finally improves the mesh by flips, smoothing and splitting (TetGen's -O).
   * Range 0 to 10, default 2. 0: not at all; where triangles of the surface are nearly coplanar,
   * the generated mesh then has tetrahedra that are flat up to rounding.
   */
  vtkSetClampMacro(OptimizationLevel, int, 0, 10);
  vtkGetMacro(OptimizationLevel, int);
  ///@}

  ///@{
  /**
   * Marks the compartment around the point (x, y, z). Its tetrahedra have `attribute`, a whole
   * number, in the array `Region`, and are no larger than `maximumVolume` (0: no limit; if
   * MaximumVolume is set, too, both limits hold). While the surface is kept, tetrahedra at a coarse
   * surface stay larger. A point outside of the mesh gives a warning or, outside of the convex
   * hull, an error.
   */
  void AddRegion(double x, double y, double z, double attribute, double maximumVolume);
  void RemoveAllRegions();
  int GetNumberOfRegions();
  ///@}

  ///@{
  /**
   * Leaves the compartment around the point (x, y, z) empty. If no tetrahedron remains, that is an
   * error. A point outside does nothing.
   */
  void AddHole(double x, double y, double z);
  void RemoveAllHoles();
  int GetNumberOfHoles();
  ///@}

  ///@{
  /**
   * Nodes wanted inside: input port 1.
   */
  void SetInteriorPointsConnection(vtkAlgorithmOutput* output);
  void SetInteriorPointsData(vtkPointSet* points);
  ///@}

protected:
  vtkTetGenFilter();
  ~vtkTetGenFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkTetGenFilter(const vtkTetGenFilter&) = delete;
  void operator=(const vtkTetGenFilter&) = delete;

  std::string CheckOptions();
  std::string MakeJob(
    const vtkTetGenBridge::Surface& surface, vtkPointSet* interior, vtkTetGenBridge::Job& job);
  std::string Run(const vtkTetGenBridge::Surface& surface, const vtkTetGenBridge::Job& job,
    vtkTetGenBridge::Mesh& mesh);
  std::string ExplainFailure(const vtkTetGenBridge::Surface& surface, vtkTetGenBridge::Job job,
    const std::string& text, const std::string& reason);
  std::string Tetrahedralize(
    vtkPolyData* input, vtkPointSet* interior, vtkUnstructuredGrid* output);
  bool ReportProgress(double fraction, const std::string& phase);

  double MaximumVolume = 0.0;
  double MaximumRadiusEdgeRatio = 2.0;
  double MinimumDihedralAngle = 0.0;
  bool KeepSurface = true;
  int OptimizationLevel = 2;
  std::vector<double> Regions; // x, y, z, attribute, greatest volume
  std::vector<double> Holes;   // x, y, z
};

#endif
