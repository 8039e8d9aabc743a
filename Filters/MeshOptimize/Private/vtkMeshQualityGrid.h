// SPDX-License-Identifier: BSD-3-Clause
/**
 * A grid as vtkMeshQualityMinMax reads it: plain pointers to coordinates, types, corners, ghosts and regions.
 * It takes any grid, also one that an optimizer would refuse, and never reads out of its arrays.
 */
#ifndef vtkMeshQualityGrid_h
#define vtkMeshQualityGrid_h

#include "vtkMeshBridgeArrays.h"

#include "Mesh/Types.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

class vtkUnstructuredGrid;

namespace vtkMeshQuality
{

/**
 * What a cell is to a measure. Quadratic and higher-order simplices count as their corners.
 */
enum class Kind : std::uint8_t
{
  Other,
  Triangle,
  Tetrahedron
};

class Grid
{
public:
  /**
   * Reads `grid`, which must live as long as this. The arrays may be null. Returns a sentence about the first value
   * of them that cannot be used, or an empty string.
   */
  std::string Read(
    vtkUnstructuredGrid* grid, const vtkMeshOptimizeBridge::InputArrays& arrays, bool useSizes);

  vtkIdType GetNumberOfCells() const { return this->NumberOfCells; }
  vtkIdType GetNumberOfPoints() const { return this->NumberOfPoints; }
  Kind GetKind(vtkIdType cell) const { return Kinds[this->Types[cell]]; }

  /**
   * Duplicates of another rank's cells, and hidden ones: measured, not counted.
   */
  bool IsGhost(vtkIdType cell) const
  {
    return this->Ghosts && (this->Ghosts[cell] & (1 /*DUPLICATECELL*/ | 32 /*HIDDENCELL*/)) != 0;
  }

  bool HasTetrahedra() const { return this->NumberOfTetrahedra > 0; }
  bool HasTriangles() const { return this->NumberOfTriangles > 0; }

  /**
   * True if there are triangles only and all lie in one plane z = constant: then their areas have signs.
   */
  bool IsFlat() const { return this->Flat; }

  /**
   * Point ids of the n corners of a cell. False if the cell has fewer points, or one that is not there.
   */
  bool GetCorners(vtkIdType cell, int n, vtkIdType* ids) const
  {
    return this->Wide.Ids ? this->Wide.Get(cell, n, this->NumberOfPoints, ids)
                          : this->Narrow.Get(cell, n, this->NumberOfPoints, ids);
  }
  meshopt::Vec<3> GetPoint(vtkIdType p) const
  {
    return { this->Points[3 * p], this->Points[3 * p + 1], this->Points[3 * p + 2] };
  }

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
   * ln h* and ln M at the points; empty where there is no array.
   */
  const std::vector<double>& GetLogSizes() const { return this->LogSizes; }
  const std::vector<meshopt::Tensor<3>>& GetLogTensors() const { return this->LogTensors; }

private:
  template <class T>
  struct Connectivity
  {
    const T* Ids = nullptr;
    const T* Offsets = nullptr;
    vtkIdType Length = 0;

    bool Get(vtkIdType cell, int n, vtkIdType numberOfPoints, vtkIdType* ids) const
    {
      const vtkIdType first = this->Offsets[cell];
      if (first < 0 || this->Offsets[cell + 1] - first < n || first + n > this->Length)
      {
        return false;
      }
      bool inside = true;
      for (int k = 0; k < n; ++k)
      {
        ids[k] = this->Ids[first + k];
        inside = inside && ids[k] >= 0 && ids[k] < numberOfPoints;
      }
      return inside;
    }
  };

  static const std::array<Kind, 256> Kinds;

  void ReadCells(vtkUnstructuredGrid* grid);
  void ReadPoints(vtkUnstructuredGrid* grid);
  void ReadRegions(vtkDataArray* array);
  std::string ReadSizes(vtkDataArray* array);
  std::string ReadMetric(vtkDataArray* array);
  void CountKinds();
  std::vector<bool> FindUsedPoints() const;

  vtkIdType NumberOfCells = 0, NumberOfPoints = 0;
  vtkIdType NumberOfTetrahedra = 0, NumberOfTriangles = 0;
  bool Flat = false;
  bool RegionArrayGiven = false;
  const double* Points = nullptr;
  const unsigned char* Types = nullptr;
  const unsigned char* Ghosts = nullptr;
  Connectivity<vtkTypeInt64> Wide;
  Connectivity<vtkTypeInt32> Narrow;
  std::vector<int> RegionOfCell;
  std::vector<long long> Regions;
  std::vector<double> LogSizes;
  std::vector<meshopt::Tensor<3>> LogTensors;

  // copies, where the grid has other types
  std::vector<double> PointCopy;
  std::vector<unsigned char> TypeCopy;
  std::vector<vtkTypeInt64> IdCopy, OffsetCopy;
  vtkSmartPointer<vtkObjectBase> Kept;
};

} // namespace vtkMeshQuality

#endif
