// SPDX-License-Identifier: BSD-3-Clause
// A boundary of triangles that slides, on many ranks. Its corners and curves depend on the whole of
// it, so all ranks get it once, from the input. After that each run slides what boundary its part
// has, along these curves.
#include "Rounds/vtkMeshOptimizeRounds.h"

#include "Boundary/vtkMeshOptimizeGeometry.h"
#include "OneGrid/vtkMeshOptimizeSizes.h"
#include "Request/vtkMeshOptimizeArrays.h"

#include "vtkBoundingBox.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <map>

namespace vtkMeshOptimizeBridge
{

using namespace vtkMeshRanks;
using meshopt::Index;
using meshopt::LineNetwork;

namespace
{

constexpr const char* PieceName = "vtkMeshRanks.Piece";
constexpr const char* ParameterName = "vtkMeshRanks.Parameter";

/**
 * An end of a line, as the ranks tell each other of it. Its name is the same on all ranks that have
 * it.
 */
template <class Name>
struct LineEnd
{
  Name Point;
  std::array<double, 2> X;
  int IsCorner;
};

/**
 * All lines of all ranks, each once; points in the order of their names.
 */
template <class Name>
LineNetwork GatherLines(const Ranks& ranks, const std::vector<std::array<LineEnd<Name>, 2>>& mine,
  std::vector<Name>& names)
{
  Bytes bytes;
  PutAll(bytes, mine);
  std::vector<std::array<LineEnd<Name>, 2>> lines;
  for (const Bytes& one : ranks.Gather(bytes))
  {
    const auto theirs = Reader(one).TakeAll<std::array<LineEnd<Name>, 2>>();
    lines.insert(lines.end(), theirs.begin(), theirs.end());
  }
  std::map<Name, Index> numbers;
  for (const auto& line : lines)
  {
    for (const LineEnd<Name>& end : line)
    {
      numbers.emplace(end.Point, 0);
    }
  }
  for (auto& [name, number] : numbers)
  {
    number = static_cast<Index>(names.size());
    names.push_back(name);
  }
  LineNetwork network;
  network.points.resize(names.size());
  network.corners.assign(names.size(), 0);
  for (const auto& line : lines)
  {
    std::array<Index, 2> ends;
    for (int i = 0; i < 2; ++i)
    {
      ends[i] = numbers.at(line[i].Point);
      network.points[ends[i]] = meshopt::Vec<2>(line[i].X[0], line[i].X[1]);
      network.corners[ends[i]] |= static_cast<std::uint8_t>(line[i].IsCorner != 0);
    }
    network.lines.push_back({ std::min(ends[0], ends[1]), std::max(ends[0], ends[1]) });
  }
  // Both sides of a line between regions tell of it, and all ranks may have the same geometry.
  std::sort(network.lines.begin(), network.lines.end());
  network.lines.erase(std::unique(network.lines.begin(), network.lines.end()), network.lines.end());
  return network;
}

/**
 * Marks points at one place as corners. Without ids pieces that have no more than a point in common
 * have it twice, and must not part there.
 */
void MarkTwins(LineNetwork& network)
{
  std::map<std::array<double, 2>, std::vector<std::size_t>> places;
  for (std::size_t p = 0; p < network.points.size(); ++p)
  {
    places[{ { network.points[p][0], network.points[p][1] } }].push_back(p);
  }
  for (const auto& [place, points] : places)
  {
    for (const std::size_t p : points)
    {
      network.corners[p] |= static_cast<std::uint8_t>(points.size() > 1);
    }
  }
}

} // namespace

//------------------------------------------------------------------------------
/**
 * The geometry may be on one rank, in pieces, or on all ranks. Points are told apart by their
 * coordinates.
 */
LineNetwork Rounds::GatherGeometry() const
{
  using Position = std::array<double, 2>;
  std::vector<std::array<LineEnd<Position>, 2>> mine;
  std::string error;
  if (this->Wanted.Geometry && this->Wanted.Geometry->GetNumberOfLines() > 0)
  {
    LineNetwork network;
    error = ReadGeometry(this->Wanted, this->Plane, network);
    const auto end = [&](Index p)
    {
      const Position x{ { network.points[p][0], network.points[p][1] } };
      return LineEnd<Position>{ x, x, network.corners[p] };
    };
    for (const std::array<Index, 2>& line : network.lines)
    {
      mine.push_back({ end(line[0]), end(line[1]) });
    }
  }
  this->All.Agree(error);
  std::vector<Position> positions;
  LineNetwork all = GatherLines(this->All, mine, positions);
  this->All.Agree(all.lines.empty() ? "The geometry has no lines on any rank." : "");
  return all;
}

/**
 * All ranks get the boundary of the whole, and make its curves. Does nothing where it is kept.
 */
void Rounds::GatherBoundary()
{
  if (!this->Wanted.Slide)
  {
    return;
  }
  const Shared shared = FindShared(this->All, this->Mine);
  const auto grid = BorrowGrid(this->Mine, this->Points, this->Cells);
  InputArrays arrays;
  FindInputArrays(this->Wanted.Filter, grid, arrays); // has been checked
  std::vector<std::array<LineEnd<vtkIdType>, 2>> mine;
  for (const Side& side : FindSides(this->All, this->Mine, shared, this->ReadRegions()))
  {
    std::array<LineEnd<vtkIdType>, 2> line;
    for (int i = 0; i < 2; ++i)
    {
      const vtkIdType p = IndexOf(this->Mine, side.Ids[i]);
      const bool isCorner = arrays.Corners && arrays.Corners->GetComponent(p, 0) != 0.0;
      const bool isFixed = (this->Mine.Flags[p] & PointFlag::Fixed) != 0;
      const meshopt::Vec<2> x = this->Plane.ToCore(&side.Places[3 * i]);
      line[i] = { side.Ids[i], { { x[0], x[1] } }, isCorner || isFixed };
    }
    mine.push_back(line);
  }
  std::vector<vtkIdType> ids;
  LineNetwork boundary = GatherLines(this->All, mine, ids);
  boundary.names.assign(ids.begin(), ids.end());
  if (!this->Ids.HasPointIds)
  {
    MarkTwins(boundary);
  }
  vtkBoundingBox box;
  for (const meshopt::Vec<2>& x : boundary.points)
  {
    box.AddPoint(x[0], x[1], 0.0);
  }
  const double size = box.IsValid() ? box.GetDiagonalLength() : 0.0;
  std::vector<meshopt::WholeBoundary::PlaceOnPiece> places;
  LineNetwork geometry;
  const bool hasGeometry = this->All.IsAny(this->Wanted.Geometry != nullptr);
  if (hasGeometry)
  {
    geometry = this->GatherGeometry();
  }
  this->All.Agree(this->Boundary.make(
    boundary, hasGeometry ? &geometry : nullptr, this->Wanted.Curves, size, places));
  // Places travel with the points, like their data.
  vtkNew<vtkIntArray> pieces;
  vtkNew<vtkDoubleArray> parameters;
  pieces->SetName(PieceName);
  parameters->SetName(ParameterName);
  this->Points.Arrays.insert(this->Points.Arrays.end(), { MakeLike(pieces), MakeLike(parameters) });
  this->Points.Attributes.insert(this->Points.Attributes.end(), { -1, -1 });
  pieces->SetNumberOfValues(this->Mine.GetNumberOfPoints());
  parameters->SetNumberOfValues(this->Mine.GetNumberOfPoints());
  pieces->FillValue(meshopt::None);
  parameters->FillValue(0.0);
  for (std::size_t k = 0; k < ids.size(); ++k)
  {
    const vtkIdType p = IndexOf(this->Mine, ids[k]);
    if (boundary.corners[k])
    {
      this->Corners.emplace(ids[k], static_cast<Index>(k));
    }
    if (p >= 0)
    {
      pieces->SetValue(p, places[k].piece);
      parameters->SetValue(p, places[k].parameter);
    }
  }
  this->Mine.PointArrays.emplace_back(pieces);
  this->Mine.PointArrays.emplace_back(parameters);
  this->Wanted.Boundary = &this->Boundary;
  this->AreaAtFirst = this->Sign().Volume;
}

/**
 * What a part has of the boundary, for a run.
 */
meshopt::PartOfBoundary Rounds::ReadBoundary(const Part& part) const
{
  meshopt::PartOfBoundary boundary;
  if (!this->Wanted.Slide)
  {
    return boundary;
  }
  const auto n = static_cast<std::size_t>(part.GetNumberOfPoints());
  boundary.corners.assign(n, meshopt::None);
  boundary.places.resize(n);
  boundary.hull.resize(n);
  const std::size_t last = part.PointArrays.size();
  auto pieces = vtkIntArray::SafeDownCast(part.PointArrays[last - 2]);
  auto parameters = vtkDoubleArray::SafeDownCast(part.PointArrays[last - 1]);
  for (std::size_t p = 0; p < n; ++p)
  {
    const auto id = static_cast<vtkIdType>(p);
    const auto corner = this->Corners.find(part.PointIds[p]);
    boundary.corners[p] = corner == this->Corners.end() ? meshopt::None : corner->second;
    boundary.places[p] = { pieces->GetValue(id), parameters->GetValue(id) };
    boundary.hull[p] = (part.Flags[p] & Hull) != 0;
  }
  return boundary;
}

/**
 * After a run. `hull`: the hashes of before; there may be more now, where all points of the
 * boundary between two of the hull have vanished. Points that the run has made on the boundary may
 * later be points of several ranks.
 */
void Rounds::FinishBoundary(
  Part& part, const std::vector<std::uint64_t>& hull, const meshopt::PartOfBoundary& boundary) const
{
  if (!this->Wanted.Slide)
  {
    return;
  }
  const std::vector<std::uint64_t> now = HashesOfHull(part);
  this->All.Agree(std::includes(now.begin(), now.end(), hull.begin(), hull.end())
      ? ""
      : "A run has changed the border of its part.");
  for (const CellFacet& facet : FindOpenFacets(part))
  {
    std::for_each(facet.Nodes.begin(), facet.Nodes.begin() + part.Corners - 1,
      [&](vtkIdType p) { part.Flags[p] |= Skin; });
  }
  // The run has interpolated them like data of the user.
  const std::size_t last = part.PointArrays.size();
  auto pieces = vtkIntArray::SafeDownCast(part.PointArrays[last - 2]);
  auto parameters = vtkDoubleArray::SafeDownCast(part.PointArrays[last - 1]);
  for (vtkIdType p = 0; p < part.GetNumberOfPoints(); ++p)
  {
    pieces->SetValue(p, boundary.places[p].piece);
    parameters->SetValue(p, boundary.places[p].parameter);
  }
}

/**
 * After the last run. Where a boundary has followed splines, the area may be another.
 */
void Rounds::CloseBoundary()
{
  if (this->Wanted.Slide)
  {
    this->Result.Sizes = DescribeArea(this->AreaAtFirst, this->Sign().Volume, this->Wanted);
    // They are no data of the user.
    for (int i = 0; i < 2; ++i)
    {
      this->Points.Arrays.pop_back();
      this->Points.Attributes.pop_back();
      this->Mine.PointArrays.pop_back();
    }
  }
}

} // namespace vtkMeshOptimizeBridge
