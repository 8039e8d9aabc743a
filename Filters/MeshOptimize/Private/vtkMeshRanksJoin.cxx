// SPDX-License-Identifier: BSD-3-Clause
// Joins parts of a divided mesh by the ids of their points and cells.
#include "vtkMeshRanksPart.h"

#include "vtkAbstractArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace vtkMeshRanks
{
namespace
{

/**
 * Where a tuple of a joined array comes from.
 */
struct Source
{
  vtkIdType Id;
  int Part;
  vtkIdType Index;
  bool operator<(const Source& other) const
  {
    // The lower part comes first, and gives the values of points that several have.
    return this->Id != other.Id ? this->Id < other.Id : this->Part < other.Part;
  }
};

std::vector<Source> ListSources(const std::vector<Part>& parts, std::vector<vtkIdType> Part::*ids)
{
  std::vector<Source> sources;
  sources.reserve(std::accumulate(parts.begin(), parts.end(), std::size_t(0),
    [&](std::size_t n, const Part& part) { return n + (part.*ids).size(); }));
  for (std::size_t k = 0; k < parts.size(); ++k)
  {
    const std::vector<vtkIdType>& list = parts[k].*ids;
    const auto first = static_cast<std::ptrdiff_t>(sources.size());
    for (std::size_t i = 0; i < list.size(); ++i)
    {
      sources.push_back({ list[i], static_cast<int>(k), static_cast<vtkIdType>(i) });
    }
    // Mostly they ascend, and a large part meets small ones: nothing is sorted then.
    const auto middle = sources.begin() + first;
    if (!std::is_sorted(middle, sources.end()))
    {
      std::sort(middle, sources.end());
    }
    std::inplace_merge(sources.begin(), middle, sources.end());
  }
  return sources;
}

/**
 * Arrays whose tuple i is that of sources[i].
 */
void Collect(const std::vector<Part>& parts, const std::vector<Source>& sources,
  Arrays Part::*arrays, Arrays& result)
{
  // Tuples are copied part by part, in one call each, and not one by one.
  std::vector<vtkNew<vtkIdList>> from(parts.size()), to(parts.size());
  for (std::size_t i = 0; i < sources.size(); ++i)
  {
    from[sources[i].Part]->InsertNextId(sources[i].Index);
    to[sources[i].Part]->InsertNextId(static_cast<vtkIdType>(i));
  }
  result.clear();
  for (std::size_t a = 0; a < (parts[0].*arrays).size(); ++a)
  {
    vtkSmartPointer<vtkAbstractArray> array = MakeLike((parts[0].*arrays)[a]);
    array->SetNumberOfTuples(static_cast<vtkIdType>(sources.size()));
    for (std::size_t k = 0; k < parts.size(); ++k)
    {
      if (from[k]->GetNumberOfIds() > 0)
      {
        array->InsertTuples(to[k], from[k], (parts[k].*arrays)[a]);
      }
    }
    result.push_back(array);
  }
}

/**
 * Joins the points; newIndex[k][i] is where point i of part k is in the result.
 */
std::string JoinPoints(
  const std::vector<Part>& parts, Part& result, std::vector<std::vector<vtkIdType>>& newIndex)
{
  std::vector<Source> sources;
  for (const Part& part : parts)
  {
    newIndex.emplace_back(part.PointIds.size());
  }
  const std::vector<Source> all = ListSources(parts, &Part::PointIds);
  sources.reserve(all.size());
  result.PointIds.reserve(all.size());
  result.Coordinates.reserve(3 * all.size());
  result.Flags.reserve(all.size());
  result.Hint.reserve(all.size());
  for (const Source& o : all)
  {
    // Sorted by id: the same point of several parts comes in a row.
    const Part& part = parts[o.Part];
    const double* x = part.GetPoint(o.Index);
    if (sources.empty() || sources.back().Id != o.Id)
    {
      sources.push_back(o);
      result.PointIds.push_back(o.Id);
      result.Coordinates.insert(result.Coordinates.end(), x, x + 3);
      result.Flags.push_back(0);
      result.Hint.push_back(part.Hint[o.Index]);
    }
    else if (!IsSamePlace(&result.Coordinates[result.Coordinates.size() - 3], x))
    {
      return "Point " + std::to_string(o.Id) + " is at two places.";
    }
    // What any part knows of a point holds: it may be fixed or waiting.
    result.Flags.back() |= part.Flags[o.Index];
    newIndex[o.Part][o.Index] = result.GetNumberOfPoints() - 1;
  }
  Collect(parts, sources, &Part::PointArrays, result.PointArrays);
  return {};
}

std::string JoinCells(
  const std::vector<Part>& parts, const std::vector<std::vector<vtkIdType>>& newIndex, Part& result)
{
  const std::vector<Source> sources = ListSources(parts, &Part::CellIds);
  result.CellIds.reserve(sources.size());
  result.Cells.reserve(sources.size() * result.Corners);
  result.Quality.reserve(sources.size());
  result.Origin.reserve(sources.size());
  result.Home.reserve(sources.size());
  result.Kept.reserve(sources.size());
  for (const Source& o : sources)
  {
    // Points may be shared, cells may not.
    const Part& part = parts[o.Part];
    if (!result.CellIds.empty() && result.CellIds.back() == o.Id)
    {
      return "Cell " + std::to_string(o.Id) + " was there twice.";
    }
    result.CellIds.push_back(o.Id);
    for (int i = 0; i < part.Corners; ++i)
    {
      result.Cells.push_back(newIndex[o.Part][part.GetCell(o.Index)[i]]);
    }
    result.Quality.push_back(part.Quality[o.Index]);
    result.Origin.push_back(part.Origin[o.Index]);
    result.Home.push_back(part.Home[o.Index]);
    result.Kept.push_back(part.Kept[o.Index]);
  }
  Collect(parts, sources, &Part::CellArrays, result.CellArrays);
  return {};
}

} // namespace

//------------------------------------------------------------------------------
std::string Join(const std::vector<Part>& parts, Part& result)
{
  result = Part();
  result.Corners = parts[0].Corners;
  std::vector<std::vector<vtkIdType>> newIndex;
  // Cells need the new numbers of their points.
  const std::string error = JoinPoints(parts, result, newIndex);
  return error.empty() ? JoinCells(parts, newIndex, result) : error;
}

} // namespace vtkMeshRanks
