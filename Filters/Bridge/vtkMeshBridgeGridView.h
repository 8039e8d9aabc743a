// SPDX-License-Identifier: BSD-3-Clause
/**
 * A vtkUnstructuredGrid accessed by plain pointers: coordinates, kinds and corners of cells,
 * ghosts. It accepts any grid, even one that no solver would, and never reads beyond its arrays.
 */
#ifndef vtkMeshBridgeGridView_h
#define vtkMeshBridgeGridView_h

#include "Mesh/Types.h"

#include "vtkDataSetAttributes.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <cstdint>
#include <vector>

class vtkObjectBase;
class vtkUnstructuredGrid;

namespace vtkMeshBridge
{

/**
 * The kind of a cell for a measure. Quadratic and higher-order simplices count by their corners.
 */
enum class Kind : std::uint8_t
{
  Other,
  Triangle,
  Tetrahedron
};

/**
 * Tells the cells that do not count, by their flags in vtkGhostType: copies of another process'
 * cells, cells replaced by finer ones, and hidden cells. These are the flags that vtkCellData
 * documents as to be skipped. The other flags only describe the position of a cell (many or few
 * neighbours, at the outside): such cells count.
 */
class GhostCells
{
public:
  static constexpr unsigned char Skipped = vtkDataSetAttributes::DUPLICATECELL |
    vtkDataSetAttributes::REFINEDCELL | vtkDataSetAttributes::HIDDENCELL;

  /**
   * `grid` must outlive this object. An array of the wrong length is ignored.
   */
  explicit GhostCells(vtkUnstructuredGrid* grid);

  bool Has(vtkIdType cell) const { return this->Flags && (this->Flags[cell] & Skipped) != 0; }

  /**
   * Whether the cell is hidden, or replaced by finer ones. It is then no mere copy.
   */
  bool IsHidden(vtkIdType cell) const
  {
    constexpr unsigned char hidden = Skipped &
      ~static_cast<unsigned char>(vtkDataSetAttributes::DUPLICATECELL);
    return this->Flags && (this->Flags[cell] & hidden) != 0;
  }

private:
  const unsigned char* Flags = nullptr;
};

class GridView
{
public:
  /**
   * `grid` must outlive this object. Arrays of unusual types are copied.
   */
  explicit GridView(vtkUnstructuredGrid* grid);
  GridView(const GridView&) = delete;
  void operator=(const GridView&) = delete;

  vtkIdType GetNumberOfCells() const { return this->NumberOfCells; }
  vtkIdType GetNumberOfPoints() const { return this->NumberOfPoints; }
  Kind GetKind(vtkIdType cell) const { return Kinds[this->Types[cell]]; }
  bool IsGhost(vtkIdType cell) const { return this->Ghosts.Has(cell); }

  /**
   * Point ids of the n corners of a cell. False if the cell has fewer points, or a point that does
   * not exist.
   */
  bool GetCorners(vtkIdType cell, int n, vtkIdType* ids) const
  {
    return this->Wide.Offsets ? this->Wide.Get(cell, n, this->NumberOfPoints, ids)
                              : this->Narrow.Get(cell, n, this->NumberOfPoints, ids);
  }
  meshopt::Vec<3> GetPoint(vtkIdType p) const
  {
    return { this->Points[3 * p], this->Points[3 * p + 1], this->Points[3 * p + 2] };
  }

  /**
   * Relative rounding error of the type of the coordinates.
   */
  double GetPrecision() const { return this->Precision; }

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
      if (first < 0 || this->Offsets[cell + 1] - first < n || first > this->Length - n)
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

  vtkIdType NumberOfCells, NumberOfPoints;
  GhostCells Ghosts;
  double Precision = 0.0;
  const double* Points = nullptr;
  const unsigned char* Types = nullptr;
  Connectivity<vtkTypeInt64> Wide;
  Connectivity<vtkTypeInt32> Narrow;

  // copies, if the grid uses other types
  std::vector<double> PointCopy;
  std::vector<unsigned char> TypeCopy;
  std::vector<vtkTypeInt64> IdCopy, OffsetCopy;
  vtkSmartPointer<vtkObjectBase> Kept; ///< keeps an array alive that the grid made for this
};

} // namespace vtkMeshBridge

#endif
