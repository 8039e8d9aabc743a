// SPDX-License-Identifier: BSD-3-Clause
// Facets of a part, and which points and facets other ranks have, too. Nobody has a list of all
// points: for each id one rank is its directory, which everybody can compute.
#include "Ranks/vtkMeshRanksFacets.h"

#include "Base/Scramble.h"
#include "Mesh/Types.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace vtkMeshRanks
{
namespace
{

// As in the core (Local<D>::facets): with node i appended, facet i is a simplex oriented like the
// cell.
constexpr int TetrahedronFacets[4][3] = { { 1, 3, 2 }, { 0, 2, 3 }, { 0, 3, 1 }, { 0, 1, 2 } };
constexpr int TriangleFacets[3][2] = { { 1, 2 }, { 2, 0 }, { 0, 1 } };

std::uint64_t HashOfPlace(const double* x)
{
  std::uint64_t hash = 0;
  for (int i = 0; i < 3; ++i)
  {
    hash = meshopt::addToHash(hash, x[i]);
  }
  return hash;
}

/**
 * Sorts the first n of three.
 */
void SortFew(std::array<vtkIdType, 3>& nodes, int n)
{
  // By exchange of neighbours: two or three values, for each facet of each cell.
  for (int i = 0; i < n; ++i)
  {
    for (int k = 0; k + 1 < n - i; ++k)
    {
      if (nodes[k + 1] < nodes[k])
      {
        std::swap(nodes[k], nodes[k + 1]);
      }
    }
  }
}

/**
 * A point as the ranks tell each other of it.
 */
struct Notice
{
  vtkIdType Id;
  std::uint64_t Place;
};

struct Entry
{
  Notice Point;
  int Rank;
  bool operator<(const Entry& other) const
  {
    return this->Point.Id != other.Point.Id ? this->Point.Id < other.Point.Id
                                            : this->Rank < other.Rank;
  }
};

/**
 * The rank that knows who has a point. Scrambled, so that all have about as many to look after.
 */
int DirectoryOf(vtkIdType id, int count)
{
  return static_cast<int>(
    meshopt::scramble(static_cast<std::uint64_t>(id)) % static_cast<std::uint64_t>(count));
}

/**
 * Answers to notices: each id that several ranks have, with the list of these ranks.
 */
std::vector<Bytes> Answer(const std::vector<Bytes>& notices, std::string& error)
{
  std::vector<Entry> entries;
  for (std::size_t r = 0; r < notices.size(); ++r)
  {
    for (Reader reader(notices[r]); !reader.IsAtEnd();)
    {
      entries.push_back({ reader.Take<Notice>(), static_cast<int>(r) });
    }
  }
  std::sort(entries.begin(), entries.end());
  std::vector<Bytes> answers(notices.size());
  for (std::size_t i = 0, j = 0; i < entries.size(); i = j)
  {
    std::vector<int> owners;
    for (j = i; j < entries.size() && entries[j].Point.Id == entries[i].Point.Id; ++j)
    {
      owners.push_back(entries[j].Rank);
      // Of the place only the hash was sent, which is all that a comparison needs.
      if (entries[j].Point.Place != entries[i].Point.Place)
      {
        error = "The point with the global id " + std::to_string(entries[i].Point.Id) +
          " has other coordinates on rank " + std::to_string(entries[j].Rank) + " than on rank " +
          std::to_string(entries[i].Rank) + ".";
      }
    }
    // An id that only one rank has needs no answer.
    for (std::size_t k = 0; k < owners.size() && owners.size() > 1; ++k)
    {
      Put(answers[owners[k]], entries[i].Point.Id);
      PutAll(answers[owners[k]], owners);
    }
  }
  return answers;
}

using Key = std::array<vtkIdType, 3>;

Key IdsOf(const Part& part, const CellFacet& facet)
{
  // Triangles have two nodes: the third stays -1, which no id is.
  Key ids = { -1, -1, -1 };
  for (int i = 0; i < part.Corners - 1; ++i)
  {
    ids[i] = part.PointIds[facet.Nodes[i]]; // ascending, as the indices are
  }
  return ids;
}

} // namespace

//------------------------------------------------------------------------------
std::array<vtkIdType, 3> OrientedNodes(const Part& part, vtkIdType cell, int local)
{
  const meshopt::Index* ids = part.GetCell(cell);
  if (part.Corners == 4)
  {
    const int* f = TetrahedronFacets[local];
    return { ids[f[0]], ids[f[1]], ids[f[2]] };
  }
  return { ids[TriangleFacets[local][0]], ids[TriangleFacets[local][1]], -1 };
}

namespace
{

/**
 * A facet among those with the same lowest node, in little memory: there are four times as many as
 * cells.
 */
struct SmallFacet
{
  meshopt::Index Middle, Highest; ///< -1: triangles have no third node
  vtkIdType Place;                ///< 4 * cell + local

  bool HasNodesOf(const SmallFacet& other) const
  {
    return this->Middle == other.Middle && this->Highest == other.Highest;
  }
  bool operator<(const SmallFacet& other) const
  {
    // Ties by cell, so that visitors get cells in one order.
    return this->Middle != other.Middle ? this->Middle < other.Middle
      : this->Highest != other.Highest  ? this->Highest < other.Highest
                                        : this->Place < other.Place;
  }
};

} // namespace

void VisitFacets(const Part& part, const std::vector<char>& isWanted,
  const std::function<void(const CellFacet*, const CellFacet*)>& visit)
{
  // Sorted into buckets by the lowest node; a bucket is small.
  const int corners = part.Corners;
  std::vector<std::size_t> starts(part.PointIds.size() + 1, 0);
  // Called twice: to count, then to fill. Facets of unwanted nodes cost nothing but the test.
  const auto forEach = [&](const auto& call)
  {
    for (vtkIdType c = 0; c < part.GetNumberOfCells(); ++c)
    {
      for (int local = 0; local < corners; ++local)
      {
        std::array<vtkIdType, 3> nodes = OrientedNodes(part, c, local);
        if (std::all_of(nodes.begin(), nodes.begin() + corners - 1,
              [&](vtkIdType p) { return isWanted[p] != 0; }))
        {
          SortFew(nodes, corners - 1);
          call(nodes, 4 * c + local);
        }
      }
    }
  };
  // A counting sort: linear, where a sort of all facets would not be.
  forEach([&](const std::array<vtkIdType, 3>& nodes, vtkIdType) { ++starts[nodes[0] + 1]; });
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  std::vector<SmallFacet> facets(starts.back());
  std::vector<std::size_t> next(starts.begin(), starts.end() - 1);
  forEach(
    [&](const std::array<vtkIdType, 3>& nodes, vtkIdType place)
    {
      facets[next[nodes[0]]++] = { static_cast<meshopt::Index>(nodes[1]),
        static_cast<meshopt::Index>(nodes[2]), place };
    });
  std::vector<CellFacet> equal;
  for (std::size_t p = 0; p + 1 < starts.size(); ++p)
  {
    const auto begin = facets.begin() + starts[p], end = facets.begin() + starts[p + 1];
    std::sort(begin, end);
    for (auto first = begin; first != end;)
    {
      equal.clear();
      const SmallFacet& f = *first;
      for (; first != end && first->HasNodesOf(f); ++first)
      {
        equal.push_back({ { static_cast<vtkIdType>(p), f.Middle, f.Highest }, first->Place / 4,
          static_cast<int>(first->Place % 4) });
      }
      visit(equal.data(), equal.data() + equal.size());
    }
  }
}

std::vector<CellFacet> FindOpenFacets(const Part& part)
{
  // Facets of two cells cancel out, so that most points are known to have no other, and few facets
  // have to be sorted: this takes a fraction of the time and memory.
  std::vector<std::uint64_t> left(part.PointIds.size(), 0);
  for (vtkIdType c = 0; c < part.GetNumberOfCells(); ++c)
  {
    for (int local = 0; local < part.Corners; ++local)
    {
      std::uint64_t hash = 0;
      const std::array<vtkIdType, 3> nodes = OrientedNodes(part, c, local);
      for (int i = 0; i < part.Corners - 1; ++i)
      {
        hash += meshopt::scramble(static_cast<std::uint64_t>(nodes[i]));
      }
      hash = meshopt::scramble(hash);
      std::for_each(
        nodes.begin(), nodes.begin() + part.Corners - 1, [&](vtkIdType p) { left[p] ^= hash; });
    }
  }
  std::vector<char> isWanted(left.size());
  std::transform(left.begin(), left.end(), isWanted.begin(), [](auto hash) { return hash != 0; });
  std::vector<CellFacet> open;
  VisitFacets(part, isWanted,
    [&](const CellFacet* first, const CellFacet* last)
    {
      if (last - first == 1)
      {
        open.push_back(*first);
      }
    });
  return open;
}

std::vector<char> Flagged(const Part& part, PointFlag flag)
{
  std::vector<char> has(part.Flags.size());
  std::transform(part.Flags.begin(), part.Flags.end(), has.begin(),
    [flag](std::uint8_t flags) { return (flags & flag) != 0; });
  return has;
}

//------------------------------------------------------------------------------
vtkIdType IndexOf(const Part& part, vtkIdType id)
{
  const auto found = std::lower_bound(part.PointIds.begin(), part.PointIds.end(), id);
  return found != part.PointIds.end() && *found == id ? found - part.PointIds.begin() : -1;
}

Shared FindShared(const Ranks& ranks, const Part& part)
{
  std::vector<Bytes> notices(ranks.GetCount());
  // A loose point has no cells that could meet those of another rank.
  std::vector<char> isUsed(part.PointIds.size(), 0);
  for (const vtkIdType p : part.Cells)
  {
    isUsed[p] = 1;
  }
  for (vtkIdType p = 0; p < part.GetNumberOfPoints(); ++p)
  {
    if (isUsed[p] && (part.Flags[p] & Skin))
    {
      const vtkIdType id = part.PointIds[p];
      Put(notices[DirectoryOf(id, ranks.GetCount())], Notice{ id, HashOfPlace(part.GetPoint(p)) });
    }
  }
  std::string error;
  std::vector<Bytes> answers = Answer(ranks.Exchange(std::move(notices)), error);
  // Two meanings of one id end the work on all ranks, before anything is built on them.
  ranks.Agree(error);
  answers = ranks.Exchange(std::move(answers));
  Shared shared;
  shared.RanksOf.resize(part.PointIds.size());
  for (const Bytes& bytes : answers)
  {
    for (Reader reader(bytes); !reader.IsAtEnd();)
    {
      const vtkIdType p = IndexOf(part, reader.Take<vtkIdType>());
      for (const int r : reader.TakeAll<int>())
      {
        if (r != ranks.GetRank())
        {
          shared.RanksOf[p].push_back(r);
        }
      }
    }
  }
  // A map, so that neighbours come in the order of ranks; points are met in the order of ids.
  std::map<int, std::vector<vtkIdType>> lists;
  for (vtkIdType p = 0; p < part.GetNumberOfPoints(); ++p)
  {
    for (const int r : shared.RanksOf[p])
    {
      lists[r].push_back(p);
    }
  }
  for (auto& [rank, list] : lists)
  {
    shared.Neighbors.push_back(rank);
    shared.Points.push_back(std::move(list));
  }
  return shared;
}

//------------------------------------------------------------------------------
std::vector<char> AnyOf(const Ranks& ranks, const Shared& shared, std::vector<char> marks)
{
  std::vector<Bytes> out(ranks.GetCount());
  for (std::size_t k = 0; k < shared.Neighbors.size(); ++k)
  {
    for (const vtkIdType p : shared.Points[k])
    {
      out[shared.Neighbors[k]].push_back(marks[p]);
    }
  }
  const std::vector<Bytes> in = ranks.Exchange(std::move(out));
  for (std::size_t k = 0; k < shared.Neighbors.size(); ++k)
  {
    const Bytes& theirs = in[shared.Neighbors[k]];
    for (std::size_t i = 0; i < theirs.size(); ++i)
    {
      marks[shared.Points[k][i]] |= theirs[i];
    }
  }
  return marks;
}

std::vector<std::pair<CellFacet, long long>> FindBorder(const Ranks& ranks, const Part& part,
  const Shared& shared, const std::vector<CellFacet>& open, const std::vector<long long>& values)
{
  std::vector<Bytes> out(ranks.GetCount());
  // A facet is told to every rank that has all of its nodes: more than those that have the facet,
  // which only they can say.
  for (const CellFacet& facet : open)
  {
    for (const int r : shared.RanksOf[facet.Nodes[0]])
    {
      if (std::all_of(facet.Nodes.begin() + 1, facet.Nodes.begin() + part.Corners - 1,
            [&](vtkIdType p)
            {
              const std::vector<int>& others = shared.RanksOf[p];
              return std::find(others.begin(), others.end(), r) != others.end();
            }))
      {
        Put(out[r], IdsOf(part, facet));
        Put(out[r], values.empty() ? 0LL : values[facet.Cell]);
      }
    }
  }
  // Of ids: indices differ between ranks.
  std::map<Key, long long> theirs;
  for (const Bytes& bytes : ranks.Exchange(std::move(out)))
  {
    for (Reader reader(bytes); !reader.IsAtEnd();)
    {
      const Key key = reader.Take<Key>();
      theirs[key] = reader.Take<long long>();
    }
  }
  std::vector<std::pair<CellFacet, long long>> border;
  for (const CellFacet& facet : open)
  {
    const auto found = theirs.find(IdsOf(part, facet));
    if (found != theirs.end())
    {
      border.emplace_back(facet, found->second);
    }
  }
  return border;
}

} // namespace vtkMeshRanks
