// SPDX-License-Identifier: BSD-3-Clause
// Joins parts of a divided mesh by the ids of their points and cells.
#include "Ranks/vtkMeshRanksPart.h"

#include "vtkAbstractArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"

#include "Mesh/Types.h"

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
  meshopt::Index Index;
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
      sources.push_back({ list[i], static_cast<int>(k), static_cast<meshopt::Index>(i) });
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
 * The joined list of the parts' lists, `n` values of each source. The parts give back their memory.
 */
template <class T>
void Collect(std::vector<Part>& parts, const std::vector<Source>& sources,
  std::vector<T> Part::*list, int n, Part& result)
{
  std::vector<T>& joined = result.*list;
  joined.reserve(sources.size() * n);
  for (const Source& o : sources)
  {
    const auto first = (parts[o.Part].*list).begin() + static_cast<std::ptrdiff_t>(o.Index) * n;
    joined.insert(joined.end(), first, first + n);
  }
  for (Part& part : parts)
  {
    std::vector<T>().swap(part.*list);
  }
}

/**
 * Arrays whose tuple i is that of sources[i].
 */
void CollectArrays(const std::vector<Part>& parts, const std::vector<Source>& sources,
  Arrays Part::*arrays, Arrays& result)
{
  result.clear();
  if ((parts[0].*arrays).empty())
  {
    return;
  }
  // Tuples are copied part by part, in one call each, and not one by one.
  std::vector<vtkNew<vtkIdList>> from(parts.size()), to(parts.size());
  for (std::size_t i = 0; i < sources.size(); ++i)
  {
    from[sources[i].Part]->InsertNextId(sources[i].Index);
    to[sources[i].Part]->InsertNextId(static_cast<vtkIdType>(i));
  }
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
  std::vector<Part>& parts, Part& result, std::vector<std::vector<meshopt::Index>>& newIndex)
{
  std::vector<Source> sources = ListSources(parts, &Part::PointIds);
  for (const Part& part : parts)
  {
    newIndex.emplace_back(part.PointIds.size());
  }
  std::size_t n = 0; // points so far: the first n of sources
  result.Flags.reserve(sources.size());
  for (const Source& o : sources)
  {
    // Sorted by id: the same point of several parts comes in a row.
    const Part& part = parts[o.Part];
    if (n == 0 || sources[n - 1].Id != o.Id)
    {
      sources[n++] = o;
      result.Flags.push_back(0);
    }
    else if (!IsSamePlace(
               parts[sources[n - 1].Part].GetPoint(sources[n - 1].Index), part.GetPoint(o.Index)))
    {
      return "Point " + std::to_string(o.Id) + " is at two places.";
    }
    // What any part knows of a point holds: it may be fixed or waiting.
    result.Flags.back() |= part.Flags[o.Index];
    newIndex[o.Part][o.Index] = static_cast<meshopt::Index>(n) - 1;
  }
  sources.resize(n);
  Collect(parts, sources, &Part::PointIds, 1, result);
  Collect(parts, sources, &Part::Coordinates, 3, result);
  Collect(parts, sources, &Part::Hint, 1, result);
  CollectArrays(parts, sources, &Part::PointArrays, result.PointArrays);
  return {};
}

std::string JoinCells(
  std::vector<Part>& parts, const std::vector<std::vector<meshopt::Index>>& newIndex, Part& result)
{
  const std::vector<Source> sources = ListSources(parts, &Part::CellIds);
  // Points may be shared, cells may not.
  const auto twice = std::adjacent_find(
    sources.begin(), sources.end(), [](const Source& a, const Source& b) { return a.Id == b.Id; });
  if (twice != sources.end())
  {
    return "Cell " + std::to_string(twice->Id) + " was there twice.";
  }
  for (std::size_t k = 0; k < parts.size(); ++k)
  {
    std::for_each(
      parts[k].Cells.begin(), parts[k].Cells.end(), [&](meshopt::Index& p) { p = newIndex[k][p]; });
  }
  Collect(parts, sources, &Part::Cells, result.Corners, result);
  Collect(parts, sources, &Part::CellIds, 1, result);
  Collect(parts, sources, &Part::Quality, 1, result);
  Collect(parts, sources, &Part::Origin, 1, result);
  Collect(parts, sources, &Part::Home, 1, result);
  Collect(parts, sources, &Part::Kept, 1, result);
  CollectArrays(parts, sources, &Part::CellArrays, result.CellArrays);
  return {};
}

} // namespace

//------------------------------------------------------------------------------
std::string Join(std::vector<Part> parts, Part& result)
{
  result = Part();
  result.Corners = parts[0].Corners;
  std::vector<std::vector<meshopt::Index>> newIndex;
  // Cells need the new numbers of their points.
  const std::string error = JoinPoints(parts, result, newIndex);
  return error.empty() ? JoinCells(parts, newIndex, result) : error;
}

} // namespace vtkMeshRanks
