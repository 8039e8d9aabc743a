// SPDX-License-Identifier: BSD-3-Clause
/**
 * A part of a mesh that is divided among ranks: points and simplices with global ids and all their
 * arrays. Parts are taken out, sent, and joined by ids, never by coordinates.
 */
#ifndef vtkMeshRanksPart_h
#define vtkMeshRanksPart_h

#include "Ranks/vtkMeshRanksExchange.h"
#include "vtkMeshBridgeTuples.h"

#include "Mesh/Types.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

class vtkAbstractArray;
class vtkCellArray;
class vtkDataArray;
class vtkDataSetAttributes;
class vtkUnstructuredGrid;

namespace vtkMeshRanks
{

/**
 * Whether two places have the same bits: 0 and -0 have not, and a NaN may.
 */
inline bool IsSamePlace(const double* x, const double* y)
{
  std::array<std::uint64_t, 3> a, b;
  std::memcpy(a.data(), x, sizeof(a));
  std::memcpy(b.data(), y, sizeof(b));
  return a == b;
}

/**
 * Bits of Part::Flags.
 */
enum PointFlag : std::uint8_t
{
  Waiting = 1, ///< what lies around it has never been together in one run
  Fixed = 2,   ///< of the caller's fixed points
  Loose = 4,   ///< no cell of the input uses it
  Skin = 8,    ///< may be on the surface, or on several ranks
  Border = 16, ///< the run leaves the cells around it to others: it is on the Hull, or near it
  Hull = 32    ///< cells outside of the part that runs, or ran last, use it
};

/**
 * The names, types, numbers of components and attributes of the arrays that points or cells have,
 * in their order. The arrays are empty; they belong to the rank.
 */
struct Schema
{
  std::vector<vtkSmartPointer<vtkAbstractArray>> Arrays;
  std::vector<int> Attributes; ///< of vtkDataSetAttributes; -1: none

  enum class Qualities
  {
    Listed,
    LeftOut ///< of cells, in a run: it makes new ones
  };
  /// All arrays but global ids and ghost types.
  static Schema Of(vtkDataSetAttributes* data, Qualities qualities = Qualities::Listed);
  /// Equal if parts of both ranks can be joined: all but the information keys, as bytes.
  Bytes Describe() const;
  /// From such bytes.
  static Schema From(Reader& reader);
};

using Arrays = std::vector<vtkSmartPointer<vtkAbstractArray>>;

struct Part
{
  int Corners = 4;                   ///< of a cell
  std::vector<vtkIdType> PointIds;   ///< ascending
  std::vector<double> Coordinates;   ///< 3 of each point
  std::vector<std::uint8_t> Flags;   ///< PointFlag of each point
  std::vector<vtkIdType> CellIds;    ///< ascending
  std::vector<meshopt::Index> Cells; ///< corners of each cell, as indices of points
  std::vector<double> Quality;       ///< of each cell; 0 before the first run
  /// The cell of the input that each cell comes from: numbered over all ranks (see Origins).
  std::vector<vtkIdType> Origin;
  std::vector<int> Home;  ///< the rank that each cell, or its parent, had at first
  std::vector<char> Kept; ///< of each cell: takes part in no run
  /// -1: the data of the point are those of the input at its place. Else a cell of the input near
  /// it, numbered like Origin: its data have been interpolated more than once.
  std::vector<vtkIdType> Hint;
  Arrays PointArrays, CellArrays; ///< those of the schemas

  vtkIdType GetNumberOfPoints() const { return static_cast<vtkIdType>(this->PointIds.size()); }
  vtkIdType GetNumberOfCells() const { return static_cast<vtkIdType>(this->CellIds.size()); }
  const meshopt::Index* GetCell(vtkIdType c) const { return &this->Cells[c * this->Corners]; }
  const double* GetPoint(vtkIdType p) const { return &this->Coordinates[3 * p]; }
};

using vtkMeshBridge::MakeLike;

/**
 * A part of the tuples `ids` of `source`, as an array of its own.
 */
vtkSmartPointer<vtkAbstractArray> Select(
  vtkAbstractArray* source, const std::vector<vtkIdType>& ids);

/**
 * An empty part whose arrays are those of the schemas.
 */
Part MakePart(int corners, const Schema& points, const Schema& cells);

/**
 * Divides a part: cell c goes to result[target[c]]. Points go with their cells; those of several
 * parts are on the Skin from now on, in all of them. Points without cells go to result[rest].
 */
std::vector<Part> Split(const Part& part, const std::vector<int>& target, int parts, int rest);

/**
 * The same for a part that is not needed any more: its memory is given back on the way.
 */
std::vector<Part> Split(Part&& part, const std::vector<int>& target, int parts, int rest);

/**
 * Joins parts by ids; cells and points are ordered by id, whatever the order of the parts. Returns
 * an error if two have a cell in common, or a point at two places. Parts that are given away, not
 * copied, give back their memory on the way.
 */
std::string Join(std::vector<Part> parts, Part& result);

/**
 * To bytes, and back.
 */
Bytes Pack(const Part& part);
void Pack(vtkAbstractArray* array, Bytes& bytes);
vtkSmartPointer<vtkAbstractArray> Unpack(Reader& reader, vtkAbstractArray* like);
Part Unpack(const Bytes& bytes, int corners, const Schema& points, const Schema& cells);

/**
 * Whether Pack() can write arrays of this kind.
 */
bool CanPack(vtkAbstractArray* array);

/**
 * The simplices of a grid as a part without ids: point i has the id i, cell i too. Points of other
 * cells only are left out; points of no cell stay. `fixedPoints` may be nullptr. The origin of a
 * cell is its id in the grid, from `firstOrigin` on.
 */
Part ReadPiece(vtkUnstructuredGrid* grid, const std::vector<vtkIdType>& simplices, int corners,
  const Schema& points, const Schema& cells, vtkDataArray* fixedPoints, vtkIdType firstOrigin,
  std::vector<vtkIdType>& pointsOfGrid);

/**
 * The part as a grid. Ids are its global ids; origins are a cell array.
 */
vtkSmartPointer<vtkUnstructuredGrid> MakeGrid(
  const Part& part, const Schema& points, const Schema& cellData);

/**
 * The same for a run or a look: the grid has the lists of the part itself, not copies. It must not
 * be written to, and must not outlive the part. `cells`: those of the part, if somebody else has
 * them, too (see HasSameCells()), and the part needs them no more; or nullptr.
 */
vtkSmartPointer<vtkUnstructuredGrid> BorrowGrid(
  const Part& part, const Schema& points, const Schema& cellData, vtkCellArray* cells = nullptr);

/**
 * Whether a grid has the cells of the part, and no others, in the same order and by the same
 * numbers of points.
 */
bool HasSameCells(vtkUnstructuredGrid* grid, const Part& part);

/**
 * Frees the memory of all that a part knows of its cells, for a ReadGrid() that follows.
 */
void ForgetCells(Part& part);

/**
 * What a run made of the grid of a part. `before` needs no cells. Points and cells that are new
 * have the id -1, and no flags. With `isAgain`, points that have moved or come get a hint: their
 * data stem from data that were interpolated before.
 */
Part ReadGrid(vtkUnstructuredGrid* grid, const Part& before, bool isAgain);

/**
 * Removes from a grid the arrays that MakeGrid() has added.
 */
void RemoveOwn(vtkUnstructuredGrid* grid);

/**
 * Gives new points and cells ids from these on: greater ones than any that exist.
 */
void NumberNew(vtkIdType firstPoint, vtkIdType firstCell, Part& part);

} // namespace vtkMeshRanks

#endif
