// SPDX-License-Identifier: BSD-3-Clause
// Global ids of points and cells: those of the caller, if all have them. Otherwise facets on the
// surfaces of pieces are matched by their coordinates, and points by the facets; points alone would
// not do, since at a crack several lie at one place.
#include "Ranks/vtkMeshRanksIds.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkUnstructuredGrid.h"

#include "Base/Scramble.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <utility>

namespace vtkMeshRanks
{
namespace
{

using Position = std::array<double, 3>;

/**
 * A facet on the surface of a piece: its corners in the order of their coordinates.
 */
struct OpenFacet
{
  std::array<Position, 3> Positions;
  std::array<vtkIdType, 3> Points; ///< indices on its rank
};

struct Entry
{
  OpenFacet Facet;
  int Rank;
  bool operator<(const Entry& other) const
  {
    return this->Facet.Positions != other.Facet.Positions
      ? this->Facet.Positions < other.Facet.Positions
      : this->Rank < other.Rank;
  }
};

/**
 * A point here and the point there that it is one with.
 */
struct Link
{
  vtkIdType Mine, Theirs;
  bool operator<(const Link& other) const
  {
    return this->Mine != other.Mine ? this->Mine < other.Mine : this->Theirs < other.Theirs;
  }
  bool operator==(const Link& other) const
  {
    return this->Mine == other.Mine && this->Theirs == other.Theirs;
  }
};

// Bits decide: neighbours' pieces come from one mesh, and have the same coordinates.
std::uint64_t HashOf(const std::array<Position, 3>& positions)
{
  std::uint64_t hash = 0;
  for (const Position& position : positions)
  {
    for (const double x : position)
    {
      hash = meshopt::addToHash(hash, x + 0.0); // -0 is 0
    }
  }
  return hash;
}

/**
 * False if two corners coincide: nothing tells them apart.
 */
bool MakeOpenFacet(const Part& part, const CellFacet& facet, OpenFacet& open)
{
  const int n = part.Corners - 1;
  std::array<std::pair<Position, vtkIdType>, 3> corners{};
  for (int i = 0; i < n; ++i)
  {
    const double* x = part.GetPoint(facet.Nodes[i]);
    corners[i] = { { x[0], x[1], x[2] }, facet.Nodes[i] };
  }
  for (int i = 0; i < n; ++i)
  {
    for (int k = 0; k + 1 < n - i; ++k)
    {
      if (corners[k + 1] < corners[k])
      {
        std::swap(corners[k], corners[k + 1]);
      }
    }
  }
  open = OpenFacet{};
  for (int i = 0; i < n; ++i)
  {
    open.Positions[i] = corners[i].first;
    open.Points[i] = corners[i].second;
    if (i > 0 && corners[i].first == corners[i - 1].first)
    {
      return false;
    }
  }
  return true;
}

/**
 * Tells each rank which of its facets are also another's.
 */
std::vector<Bytes> Match(
  const std::vector<Bytes>& facets, int n, const Numbering& numbering, std::string& error)
{
  std::vector<Entry> entries;
  for (std::size_t r = 0; r < facets.size(); ++r)
  {
    for (Reader reader(facets[r]); !reader.IsAtEnd();)
    {
      entries.push_back({ reader.Take<OpenFacet>(), static_cast<int>(r) });
    }
  }
  std::sort(entries.begin(), entries.end());
  std::vector<Bytes> answers(facets.size());
  for (std::size_t i = 0, j = 0; i < entries.size(); i = j)
  {
    for (j = i + 1; j < entries.size() && entries[j].Facet.Positions == entries[i].Facet.Positions;)
    {
      ++j;
    }
    // Sorted by rank within a place: the first and the last are the same if all are.
    if (entries[i].Rank == entries[j - 1].Rank)
    {
      continue; // one facet, or both sides of a crack in one piece
    }
    if (j - i > 2)
    {
      error = std::string("Facets of more than two cells lie on each other where pieces meet, as "
                          "at a crack of doubled nodes. Which cells are neighbours is not known "
                          "without global point ids: give the points global ids") +
        numbering.Else + ".";
      continue;
    }
    for (int k = 0; k < 2; ++k)
    {
      const Entry& mine = entries[i + k];
      const Entry& other = entries[i + 1 - k];
      Put(answers[mine.Rank], other.Rank);
      for (int c = 0; c < n; ++c)
      {
        Put(answers[mine.Rank], Link{ mine.Facet.Points[c], other.Facet.Points[c] });
      }
    }
  }
  return answers;
}

/**
 * Links to each rank, found by facets with the same corners.
 */
std::vector<std::vector<Link>> FindLinks(const Ranks& ranks, const Part& part,
  const std::vector<CellFacet>& facets, const Numbering& numbering)
{
  std::vector<Bytes> out(ranks.GetCount());
  for (const CellFacet& facet : facets)
  {
    OpenFacet open;
    if (MakeOpenFacet(part, facet, open))
    {
      // Any rank can be asked where a place is looked after: the hash says.
      Put(out[HashOf(open.Positions) % ranks.GetCount()], open);
    }
  }
  std::string error;
  std::vector<Bytes> answers = Match(
    ranks.Exchange(std::move(out)), part.Corners - 1, numbering, error);
  ranks.Agree(error);
  std::vector<std::vector<Link>> links(ranks.GetCount());
  for (const Bytes& bytes : ranks.Exchange(std::move(answers)))
  {
    for (Reader reader(bytes); !reader.IsAtEnd();)
    {
      const int rank = reader.Take<int>();
      for (int c = 0; c < part.Corners - 1; ++c)
      {
        links[rank].push_back(reader.Take<Link>());
      }
    }
  }
  // Facets share points, so that links come several times.
  for (std::vector<Link>& list : links)
  {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return links;
}

/**
 * Lets linked points have the lowest id of any of them. As many exchanges as ranks meet in a row
 * around a point.
 */
void Spread(
  const Ranks& ranks, const std::vector<std::vector<Link>>& links, std::vector<vtkIdType>& ids)
{
  // A point can be linked over a chain of ranks: the lowest id has to travel along it.
  for (bool changes = true; ranks.IsAny(changes);)
  {
    std::vector<Bytes> out(ranks.GetCount());
    for (int r = 0; r < ranks.GetCount(); ++r)
    {
      for (const Link& link : links[r])
      {
        // The partner's index and the id here; the partner knows its own points only.
        Put(out[r], Link{ link.Theirs, ids[link.Mine] });
      }
    }
    changes = false;
    for (const Bytes& bytes : ranks.Exchange(std::move(out)))
    {
      for (Reader reader(bytes); !reader.IsAtEnd();)
      {
        const Link link = reader.Take<Link>();
        changes = changes || link.Theirs < ids[link.Mine];
        ids[link.Mine] = std::min(ids[link.Mine], link.Theirs);
      }
    }
  }
}

bool AreAscending(const std::vector<vtkIdType>& ids)
{
  return std::adjacent_find(ids.begin(), ids.end(), std::greater_equal<>()) == ids.end();
}

bool HasTwins(std::vector<vtkIdType> ids)
{
  std::sort(ids.begin(), ids.end());
  return std::adjacent_find(ids.begin(), ids.end()) != ids.end();
}

vtkIdType FirstOf(const Ranks& ranks, std::size_t count, vtkIdType& end)
{
  const std::vector<vtkIdType> counts = ranks.Gather(static_cast<vtkIdType>(count));
  end = std::accumulate(counts.begin(), counts.end(), vtkIdType(0));
  return std::accumulate(counts.begin(), counts.begin() + ranks.GetRank(), vtkIdType(0));
}

void MakePointIds(
  const Ranks& ranks, const std::vector<CellFacet>& open, Numbering& numbering, Part& part)
{
  const std::vector<std::vector<Link>> links = FindLinks(ranks, part, open, numbering);
  const vtkIdType first = FirstOf(ranks, part.PointIds.size(), numbering.NextPoint);
  std::iota(part.PointIds.begin(), part.PointIds.end(), first);
  Spread(ranks, links, part.PointIds);
  // Two points of one piece that got the same id would become one.
  ranks.Agree(HasTwins(part.PointIds)
      ? std::string("A crack of doubled nodes runs into the border of a piece, so that points at "
                    "the same place cannot be told apart without global ids: give the points "
                    "global ids") +
        numbering.Else + "."
      : "");
}

vtkIdType EndOf(const Ranks& ranks, const std::vector<vtkIdType>& ids)
{
  // -1 on a rank without points: the first new id is then 0.
  const vtkIdType mine = ids.empty() ? -1 : *std::max_element(ids.begin(), ids.end());
  const std::vector<vtkIdType> all = ranks.Gather(mine);
  return *std::max_element(all.begin(), all.end()) + 1;
}

void CheckIds(const Ranks& ranks, const std::vector<vtkIdType>& ids, const char* what,
  const Numbering& numbering)
{
  const bool isNegative = std::any_of(ids.begin(), ids.end(), [](vtkIdType id) { return id < 0; });
  ranks.Agree(isNegative || (!AreAscending(ids) && HasTwins(ids))
      ? std::string("The global ids of ") + what +
        " are negative or occur twice in one piece. Remove the array, or give unique ids" +
        numbering.Else + "."
      : "");
}

/**
 * Cells are on one rank each, so that an id on two ranks is an error.
 */
void CheckCellIds(const Ranks& ranks, const std::vector<vtkIdType>& ids, const Numbering& numbering)
{
  std::vector<Bytes> out(ranks.GetCount());
  for (Bytes& bytes : out)
  {
    // Scrambled, ids are dealt out evenly, but for some.
    bytes.reserve((ids.size() / out.size() + ids.size() / 64 + 64) * sizeof(vtkIdType));
  }
  for (const vtkIdType id : ids)
  {
    // Each id is looked at by one rank, the same for all.
    Put(out[meshopt::scramble(static_cast<std::uint64_t>(id)) % out.size()], id);
  }
  std::vector<Bytes> in = ranks.Exchange(std::move(out));
  std::vector<vtkIdType> all;
  all.reserve(std::accumulate(in.begin(), in.end(), std::size_t(0),
    [](std::size_t n, const Bytes& bytes) { return n + bytes.size() / sizeof(vtkIdType); }));
  for (Bytes& bytes : in)
  {
    for (Reader reader(bytes); !reader.IsAtEnd();)
    {
      all.push_back(reader.Take<vtkIdType>());
    }
    Bytes().swap(bytes);
  }
  ranks.Agree(HasTwins(std::move(all))
      ? std::string("A global cell id occurs on two ranks. Ghost cells must "
                    "be marked by vtkGhostType") +
        numbering.Else + "."
      : "");
}

/**
 * Orders points and cells by their ids.
 */
void Order(Part& part)
{
  if (AreAscending(part.PointIds) && AreAscending(part.CellIds))
  {
    return; // mostly they do
  }
  // Join() orders by id, also a single part.
  std::vector<Part> one(1);
  one[0] = std::move(part);
  Join(std::move(one), part); // ids are unique
}

} // namespace

//------------------------------------------------------------------------------
void Number(const Ranks& ranks, std::vector<vtkIdType> gridPointIds,
  std::vector<vtkIdType> gridCellIds, const std::vector<CellFacet>& open, Numbering& numbering,
  Part& part)
{
  // Cells first: of cells that come twice their ids tell more than their points.
  if (numbering.HasCellIds)
  {
    CheckIds(ranks, gridCellIds, "cells", numbering);
    CheckCellIds(ranks, gridCellIds, numbering);
    part.CellIds = std::move(gridCellIds);
    numbering.NextCell = EndOf(ranks, part.CellIds);
  }
  else
  {
    const vtkIdType first = FirstOf(ranks, part.CellIds.size(), numbering.NextCell);
    std::iota(part.CellIds.begin(), part.CellIds.end(), first);
  }
  if (numbering.HasPointIds)
  {
    CheckIds(ranks, gridPointIds, "points", numbering);
    part.PointIds = std::move(gridPointIds);
    numbering.NextPoint = EndOf(ranks, part.PointIds);
  }
  else
  {
    MakePointIds(ranks, open, numbering, part);
  }
  // Points on the surface of the piece: all that other ranks may have.
  for (const CellFacet& facet : open)
  {
    for (int i = 0; i < part.Corners - 1; ++i)
    {
      part.Flags[facet.Nodes[i]] |= Skin;
    }
  }
  Order(part);
}

} // namespace vtkMeshRanks
