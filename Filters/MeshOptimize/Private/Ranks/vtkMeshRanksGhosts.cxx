// SPDX-License-Identifier: BSD-3-Clause
// Layers of cells of other ranks around each piece, for filters that look at neighbours. Each rank
// finds what others need of it, and sends that; nobody asks.
#include "Ranks/vtkMeshRanksGhosts.h"

#include "vtkDataSetAttributes.h"

#include <algorithm>
#include <utility>

namespace vtkMeshRanks
{
namespace
{

/**
 * Which points and cells of this rank are in reach of another one.
 */
struct Reach
{
  std::vector<char> Points, Cells;
};

/**
 * Adds the cells that have a point in reach, and their points. Returns the points that are new.
 */
std::vector<vtkIdType> Grow(const Part& part, Reach& reach)
{
  // A copy: cells of one layer must not reach each other.
  std::vector<char> before = reach.Points;
  std::vector<vtkIdType> fresh;
  for (vtkIdType c = 0; c < part.GetNumberOfCells(); ++c)
  {
    const meshopt::Index* ids = part.GetCell(c);
    if (std::any_of(ids, ids + part.Corners, [&](vtkIdType p) { return before[p] != 0; }))
    {
      reach.Cells[c] = 1;
      for (int i = 0; i < part.Corners; ++i)
      {
        if (!reach.Points[ids[i]])
        {
          reach.Points[ids[i]] = 1;
          fresh.push_back(ids[i]);
        }
      }
    }
  }
  return fresh;
}

/**
 * A point that is in reach of `Rank`.
 */
struct NearPoint
{
  vtkIdType Id;
  int Rank;
};

/**
 * For each rank that shares points with this one, and after the first layer for others, the cells
 * here that it gets.
 */
std::vector<Reach> FindReaches(
  const Ranks& ranks, const Part& part, const Shared& shared, int layers)
{
  std::vector<Reach> reaches(ranks.GetCount());
  const auto start = [&](int r)
  {
    if (reaches[r].Points.empty())
    {
      reaches[r] = { std::vector<char>(part.PointIds.size(), 0),
        std::vector<char>(part.CellIds.size(), 0) };
    }
  };
  for (std::size_t k = 0; k < shared.Neighbors.size(); ++k)
  {
    start(shared.Neighbors[k]);
    for (const vtkIdType p : shared.Points[k])
    {
      reaches[shared.Neighbors[k]].Points[p] = 1;
    }
  }
  for (int layer = 0; layer < layers; ++layer)
  {
    // What a third rank has at the new points is in reach, too.
    std::vector<Bytes> out(ranks.GetCount());
    for (int r = 0; r < ranks.GetCount(); ++r)
    {
      if (reaches[r].Points.empty())
      {
        continue;
      }
      // Only new points have to be told: those of earlier layers have been.
      for (const vtkIdType p : Grow(part, reaches[r]))
      {
        for (const int third : shared.RanksOf[p])
        {
          if (third != r)
          {
            Put(out[third], NearPoint{ part.PointIds[p], r });
          }
        }
      }
    }
    for (const Bytes& bytes : ranks.Exchange(std::move(out)))
    {
      for (Reader reader(bytes); !reader.IsAtEnd();)
      {
        const NearPoint notice = reader.Take<NearPoint>();
        start(notice.Rank);
        // A point of a cell in reach of that rank, but on a third one's border.
        reaches[notice.Rank].Points[IndexOf(part, notice.Id)] = 1;
      }
    }
  }
  return reaches;
}

} // namespace

//------------------------------------------------------------------------------
GhostFlags AddGhosts(
  const Ranks& ranks, int layers, const Schema& points, const Schema& cells, Part& part)
{
  const Shared shared = FindShared(ranks, part);
  const std::vector<Reach> reaches = FindReaches(ranks, part, shared, layers);
  std::vector<Bytes> out(ranks.GetCount());
  for (int r = 0; r < ranks.GetCount(); ++r)
  {
    if (!reaches[r].Cells.empty())
    {
      const std::vector<int> target(reaches[r].Cells.begin(), reaches[r].Cells.end());
      out[r] = Pack(Split(part, target, 2, 0)[1]);
    }
  }
  // Its own part first: at points that both have, its values stay.
  std::vector<Part> parts{ part };
  for (const Bytes& bytes : ranks.Exchange(std::move(out)))
  {
    if (!bytes.empty())
    {
      parts.push_back(Unpack(bytes, part.Corners, points, cells));
    }
  }
  Part joined;
  ranks.Agree(Join(std::move(parts), joined));
  GhostFlags flags;
  // All are ghosts at first; what belongs to this rank is freed below.
  flags.Points.assign(joined.PointIds.size(), vtkDataSetAttributes::DUPLICATEPOINT);
  flags.Cells.assign(joined.CellIds.size(), vtkDataSetAttributes::DUPLICATECELL);
  const auto find = [](const std::vector<vtkIdType>& ids, vtkIdType id)
  { return std::lower_bound(ids.begin(), ids.end(), id) - ids.begin(); };
  for (vtkIdType p = 0; p < part.GetNumberOfPoints(); ++p)
  {
    const std::vector<int>& others = shared.RanksOf[p];
    // The lowest rank that has a point owns it.
    if (others.empty() || others.front() > ranks.GetRank())
    {
      flags.Points[find(joined.PointIds, part.PointIds[p])] = 0;
    }
  }
  for (const vtkIdType id : part.CellIds)
  {
    flags.Cells[find(joined.CellIds, id)] = 0;
  }
  part = std::move(joined);
  return flags;
}

} // namespace vtkMeshRanks
