// SPDX-License-Identifier: BSD-3-Clause
/**
 * A grid as vtkMeshQualityMinMax measures it: any grid, even a broken one, with its regions, sizes
 * and metric.
 */
#ifndef vtkMeshQualityGrid_h
#define vtkMeshQualityGrid_h

#include "Request/vtkMeshOptimizeArrays.h"
#include "vtkMeshBridgeFrame.h"
#include "vtkMeshBridgeGridView.h"

#include "Mesh/Types.h"

#include <string>
#include <vector>

class vtkUnstructuredGrid;

namespace vtkMeshQualityBridge
{

using vtkMeshBridge::Kind;

class Grid
{
public:
  /**
   * `grid` must outlive this object.
   */
  explicit Grid(vtkUnstructuredGrid* grid);

  /**
   * Reads the arrays; they may be null. Returns an empty string, or a sentence about the first
   * unusable value or about coordinates out of range. Values that only ghost cells need may be
   * anything.
   */
  std::string Read(const vtkMeshOptimizeBridge::InputArrays& arrays, bool useSizes);

  vtkIdType GetNumberOfCells() const { return this->View.GetNumberOfCells(); }
  vtkIdType GetNumberOfPoints() const { return this->View.GetNumberOfPoints(); }
  Kind GetKind(vtkIdType cell) const { return this->View.GetKind(cell); }
  /// Ghost cells are measured, but not counted.
  bool IsGhost(vtkIdType cell) const { return this->View.IsGhost(cell); }
  bool GetCorners(vtkIdType cell, int n, vtkIdType* ids) const
  {
    return this->View.GetCorners(cell, n, ids);
  }
  meshopt::Vec<3> GetPoint(vtkIdType p) const { return this->View.GetPoint(p); }

  const vtkMeshBridge::GridView& GetView() const { return this->View; }

  bool HasTetrahedra() const { return this->NumberOfTetrahedra > 0; }
  bool HasTriangles() const { return this->NumberOfTriangles > 0; }

  /**
   * True if there are only triangles and all lie in one plane: their areas then have signs.
   * Triangles with a corner that does not exist or is not finite do not matter.
   */
  bool IsFlat() const { return this->Flat; }
  /// Of a piece of a mesh: the same for the whole.
  void SetPlane(bool isFlat, const vtkMeshBridge::Frame<2>& frame)
  {
    this->Flat = isFlat;
    this->Frame = frame;
  }
  const vtkMeshBridge::Frame<2>& GetFrame() const { return this->Frame; } ///< of that plane

  /**
   * The triangles with finite corners: those that are ghosts, or the others.
   */
  std::vector<vtkIdType> ListTriangles(bool areGhosts) const;

  /**
   * Index of the cell's region in GetRegions(); 0 if there is no region array.
   */
  int GetRegion(vtkIdType cell) const
  {
    return this->RegionOfCell.empty() ? 0 : this->RegionOfCell[cell];
  }
  bool HasRegions() const { return this->RegionArrayGiven; }
  /**
   * Values of the region array, ascending.
   */
  const std::vector<long long>& GetRegions() const { return this->Regions; }

  /**
   * ln h* at the points; empty without an array.
   */
  const std::vector<double>& GetLogSizes() const { return this->LogSizes; }
  /**
   * ln M at the points: of dimension 2 if the grid is flat, otherwise 3. The other one is empty.
   */
  template <int D>
  const std::vector<meshopt::Tensor<D>>& GetLogTensors() const;
  bool HasMetric() const { return !this->LogTensors2.empty() || !this->LogTensors3.empty(); }

private:
  void CountKinds();
  void FindPlane();
  std::vector<bool> FindUsedPoints() const;
  std::string CheckExtent() const;
  void ReadRegions(vtkDataArray* array);
  std::string ReadSizes(vtkDataArray* array);
  template <int D>
  std::string ReadMetric(vtkDataArray* array, const vtkMeshBridge::Frame<D>& frame,
    std::vector<meshopt::Tensor<D>>& logs);

  vtkMeshBridge::GridView View;
  vtkIdType NumberOfTetrahedra = 0, NumberOfTriangles = 0;
  bool Flat = false;
  vtkMeshBridge::Frame<2> Frame;
  bool RegionArrayGiven = false;
  std::vector<int> RegionOfCell;
  std::vector<long long> Regions;
  std::vector<double> LogSizes;
  std::vector<meshopt::Tensor<2>> LogTensors2;
  std::vector<meshopt::Tensor<3>> LogTensors3;
};

template <>
inline const std::vector<meshopt::Tensor<2>>& Grid::GetLogTensors<2>() const
{
  return this->LogTensors2;
}
template <>
inline const std::vector<meshopt::Tensor<3>>& Grid::GetLogTensors<3>() const
{
  return this->LogTensors3;
}

} // namespace vtkMeshQualityBridge

#endif
