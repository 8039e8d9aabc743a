// SPDX-License-Identifier: BSD-3-Clause
// Facets and edges are compared by 64-bit hashes of their corners. Two that differ have the same
// hash once in 2^64; then a facet is taken for border, and the bound is still a bound.
#include "QualityMinMax/vtkMeshQualityRanks.h"

#include "vtkMeshBridgeValues.h"

#include "Base/Scramble.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <unordered_map>
#include <utility>

namespace vtkMeshQualityBridge
{

using namespace vtkMeshRanks;
using meshopt::Index;
using meshopt::KeptSide;
using meshopt::Vec;

namespace
{

using Key = std::uint64_t;

/**
 * What one rank tells of a facet of its piece's surface.
 */
struct Notice
{
  // A cell is told from its copy on another rank by the corner opposite to the facet.
  Key Facet, Opposite; ///< of the corner of the cell that the facet has not
  long long Region;
};

struct Entry
{
  Notice Facet;
  int Rank;
  std::size_t Place; ///< among the notices of that rank
};

enum Verdict : char
{
  Alone,    ///< no other rank has a cell here
  Border,   ///< one of the same region
  Interface ///< one of another region
};

Key HashOfPlace(const Vec<3>& x)
{
  Key hash = 0;
  for (int i = 0; i < 3; ++i)
  {
    hash = meshopt::addToHash(hash, x[i] + 0.0); // -0 is 0
  }
  return hash;
}

/**
 * Hashes of the points of a block. A sum of them does not depend on the order of corners.
 */
class PointHashes
{
public:
  PointHashes(const Block& block, bool byIds)
    : Mesh(block.Mesh)
    // By block: the same ids in two blocks are different points.
    , Seed(meshopt::scramble(~static_cast<Key>(block.FlatIndex)))
  {
    // Ids count only if all ranks have them: otherwise those with and those without would never
    // meet.
    vtkDataArray* ids = byIds ? this->Mesh->GetPointData()->GetGlobalIds() : nullptr;
    if (ids)
    {
      this->Ids = vtkMeshBridge::ReadIntegers(ids);
    }
  }

  Key Of(vtkIdType p) const
  {
    if (!this->Ids.empty())
    {
      return meshopt::scramble(this->Seed ^ static_cast<Key>(this->Ids[p]));
    }
    double x[3];
    this->Mesh->GetPoint(p, x);
    return meshopt::scramble(this->Seed ^ HashOfPlace({ x[0], x[1], x[2] }));
  }

private:
  vtkUnstructuredGrid* Mesh;
  Key Seed;
  std::vector<long long> Ids;
};

/**
 * Answers notices, one verdict for each. The same cell on two ranks, a copy that is not marked as a
 * ghost, is no neighbour.
 */
std::vector<Bytes> Judge(const std::vector<Bytes>& notices)
{
  std::vector<Entry> entries;
  std::vector<Bytes> verdicts(notices.size());
  for (std::size_t r = 0; r < notices.size(); ++r)
  {
    for (Reader reader(notices[r]); !reader.IsAtEnd();)
    {
      const std::size_t place = verdicts[r].size();
      entries.push_back({ reader.Take<Notice>(), static_cast<int>(r), place });
      verdicts[r].push_back(Alone);
    }
  }
  // Stable, so that the order within a facet is that of the ranks.
  std::stable_sort(entries.begin(), entries.end(),
    [](const Entry& a, const Entry& b) { return a.Facet.Facet < b.Facet.Facet; });
  for (std::size_t i = 0, j = 0; i < entries.size(); i = j)
  {
    for (j = i + 1; j < entries.size() && entries[j].Facet.Facet == entries[i].Facet.Facet;)
    {
      ++j;
    }
    for (std::size_t a = i; a < j; ++a)
    {
      char& verdict = verdicts[entries[a].Rank][entries[a].Place];
      for (std::size_t b = i; b < j; ++b)
      {
        const bool isOther = entries[b].Rank != entries[a].Rank &&
          entries[b].Facet.Opposite != entries[a].Facet.Opposite;
        const bool isSame = entries[b].Facet.Region == entries[a].Facet.Region;
        // A cell of the same region outweighs one of another: then the facet is no surface at all.
        if (isOther && verdict != Border)
        {
          verdict = isSame ? Border : Interface;
        }
      }
    }
  }
  return verdicts;
}

/**
 * For each hash that several ranks have told of: these ranks.
 */
std::vector<Bytes> Introduce(const std::vector<Bytes>& notices)
{
  // Sorted by key: answers have the same order on all runs.
  std::map<Key, std::vector<int>> owners;
  for (std::size_t r = 0; r < notices.size(); ++r)
  {
    for (Reader reader(notices[r]); !reader.IsAtEnd();)
    {
      owners[reader.Take<Key>()].push_back(static_cast<int>(r));
    }
  }
  std::vector<Bytes> answers(notices.size());
  for (const auto& [key, ranks] : owners)
  {
    for (std::size_t k = 0; k < ranks.size() && ranks.size() > 1; ++k)
    {
      Put(answers[ranks[k]], key);
      PutAll(answers[ranks[k]], ranks);
    }
  }
  return answers;
}

/**
 * A side on its way to another rank.
 */
struct WireSide
{
  unsigned int Block;
  std::array<Key, 3> Nodes;
  std::array<double, 9> Places;
  long long Region;
  bool IsOriented;
};

/**
 * The work for meshes of one dimension.
 */
template <int D>
class Borders
{
public:
  Borders(const Ranks& ranks, const std::vector<Block>& blocks, std::vector<Surface>& surfaces)
    : All(ranks)
    , Blocks(blocks)
    , Surfaces(surfaces)
  {
    for (std::size_t b = 0; b < blocks.size(); ++b)
    {
      if (!this->Of(b).Sides.empty())
      {
        this->Mine.push_back(b);
      }
    }
  }

  void Remove()
  {
    bool lacksIds = false;
    for (const std::size_t b : this->Mine)
    {
      // A rank without surface has no say.
      lacksIds = lacksIds || !this->Blocks[b].Mesh->GetPointData()->GetGlobalIds();
    }
    this->HashPoints(!this->All.IsAny(lacksIds));
    // Ranks without any cells of this dimension take part in all exchanges all the same.
    this->DropBorders();
    this->AddSides();
    // What stands in the way may lie on another rank. Without qualities it is not looked for: the
    // bound must not depend on how the mesh is divided.
    for (const std::size_t b : this->Mine)
    {
      for (KeptSide<D>& side : this->Of(b).Sides)
      {
        side.quality = -1.0;
      }
    }
  }

private:
  SurfaceOf<D>& Of(std::size_t b) { return std::get<SurfaceOf<D>>(this->Surfaces[b].Parts); }

  void HashPoints(bool byIds)
  {
    this->Hashes.resize(this->Blocks.size());
    for (const std::size_t b : this->Mine)
    {
      const PointHashes hashes(this->Blocks[b], byIds);
      for (const vtkIdType p : this->Of(b).Points)
      {
        this->Hashes[b].push_back(hashes.Of(p));
      }
      for (const vtkIdType p : this->Of(b).Opposite)
      {
        this->Opposite.push_back(hashes.Of(p));
      }
    }
  }

  Key HashOf(std::size_t b, const meshopt::Facet<D>& nodes, int left = -1) const
  {
    Key sum = 0;
    for (int k = 0; k < D; ++k)
    {
      // Without node `left`: the edge (D = 2: the node) opposite to it.
      sum += k == left ? 0 : this->Hashes[b][nodes[k]];
    }
    return meshopt::scramble(sum);
  }

  int DirectoryOf(Key key) const
  {
    return static_cast<int>(meshopt::scramble(key) % static_cast<Key>(this->All.GetCount()));
  }

  long long RegionOf(std::size_t b, const KeptSide<D>& side) const
  {
    const std::vector<long long>& regions = this->Surfaces[b].Regions;
    return regions.empty() ? 0 : regions[side.region];
  }

  void DropBorders()
  {
    std::vector<Bytes> out(this->All.GetCount());
    std::size_t n = 0;
    for (const std::size_t b : this->Mine)
    {
      for (const KeptSide<D>& side : this->Of(b).Sides)
      {
        const Key key = this->HashOf(b, side.nodes);
        Put(out[this->DirectoryOf(key)], Notice{ key, this->Opposite[n++], RegionOf(b, side) });
      }
    }
    std::vector<Bytes> verdicts = this->All.Exchange(Judge(this->All.Exchange(std::move(out))));
    // Verdicts come in the order of the notices to each rank.
    std::vector<std::size_t> next(this->All.GetCount(), 0);
    for (const std::size_t b : this->Mine)
    {
      std::vector<KeptSide<D>> kept;
      for (const KeptSide<D>& side : this->Of(b).Sides)
      {
        const int r = this->DirectoryOf(this->HashOf(b, side.nodes));
        if (verdicts[r][next[r]++] != Border)
        {
          kept.push_back(side);
          continue;
        }
        // The edges of what was dropped are where surfaces of several ranks meet: a bound of edges
        // needs all kept facets around them.
        for (int k = 0; k < D; ++k)
        {
          this->Ends.insert(this->HashOf(b, side.nodes, k));
        }
      }
      this->Of(b).Sides = std::move(kept);
    }
  }

  /// Sides of other ranks, at edges (D = 2: nodes) of border facets.
  void AddSides()
  {
    std::vector<Bytes> out(this->All.GetCount());
    for (const Key key : this->Ends)
    {
      Put(out[this->DirectoryOf(key)], key);
    }
    std::unordered_map<Key, std::vector<int>> ranksOf;
    for (const Bytes& bytes : this->All.Exchange(Introduce(this->All.Exchange(std::move(out)))))
    {
      for (Reader reader(bytes); !reader.IsAtEnd();)
      {
        const Key key = reader.Take<Key>();
        ranksOf[key] = reader.TakeAll<int>();
      }
    }
    out.assign(this->All.GetCount(), {});
    for (const std::size_t b : this->Mine)
    {
      for (const KeptSide<D>& side : this->Of(b).Sides)
      {
        // Each rank once, though it may have several edges of the facet.
        std::set<int> targets;
        for (int k = 0; k < D; ++k)
        {
          const auto found = ranksOf.find(this->HashOf(b, side.nodes, k));
          if (found != ranksOf.end())
          {
            targets.insert(found->second.begin(), found->second.end());
          }
        }
        for (const int r : targets)
        {
          if (r != this->All.GetRank())
          {
            Put(out[r], this->MakeWireSide(b, side));
          }
        }
      }
    }
    std::map<unsigned int, std::vector<WireSide>> theirs;
    for (const Bytes& bytes : this->All.Exchange(std::move(out)))
    {
      for (Reader reader(bytes); !reader.IsAtEnd();)
      {
        const WireSide side = reader.Take<WireSide>();
        theirs[side.Block].push_back(side);
      }
    }
    for (const std::size_t b : this->Mine)
    {
      this->Insert(b, theirs[this->Blocks[b].FlatIndex]);
    }
  }

  WireSide MakeWireSide(std::size_t b, const KeptSide<D>& side)
  {
    // All bytes are sent, also those between the members: they must have a value.
    WireSide wire{};
    wire.Block = this->Blocks[b].FlatIndex;
    for (int k = 0; k < D; ++k)
    {
      wire.Nodes[k] = this->Hashes[b][side.nodes[k]];
      this->Blocks[b].Mesh->GetPoint(this->Of(b).Points[side.nodes[k]], &wire.Places[3 * k]);
    }
    wire.Region = this->RegionOf(b, side);
    wire.IsOriented = side.oriented;
    return wire;
  }

  void Insert(std::size_t b, const std::vector<WireSide>& sides)
  {
    if (sides.empty())
    {
      return;
    }
    SurfaceOf<D>& surface = this->Of(b);
    const std::vector<long long>& regions = this->Surfaces[b].Regions;
    std::set<Key> foreign;
    for (const WireSide& wire : sides)
    {
      foreign.insert(wire.Nodes.begin(), wire.Nodes.begin() + D);
    }
    // Foreign points that are here, too, get the number that they have here.
    std::unordered_map<Key, Index> numbers;
    std::set<Index> twins; // which of them another rank means is not known
    for (std::size_t p = 0; p < this->Hashes[b].size(); ++p)
    {
      const auto [at, isNew] = numbers.try_emplace(this->Hashes[b][p], static_cast<Index>(p));
      if (!isNew && foreign.count(at->first) > 0)
      {
        twins.insert(at->second);
        twins.insert(static_cast<Index>(p));
      }
    }
    for (KeptSide<D>& side : surface.Sides)
    {
      side.oriented = side.oriented &&
        std::none_of(
          side.nodes.begin(), side.nodes.end(), [&](Index p) { return twins.count(p) > 0; });
    }
    for (const WireSide& wire : sides)
    {
      // Regions are known by their values: numbers differ between ranks.
      const auto region = std::lower_bound(regions.begin(), regions.end(), wire.Region);
      if (!regions.empty() && (region == regions.end() || *region != wire.Region))
      {
        continue; // no cell of this piece is in that region
      }
      KeptSide<D> side;
      for (int k = 0; k < D; ++k)
      {
        const auto [at, isNew] = numbers.try_emplace(
          wire.Nodes[k], static_cast<Index>(surface.Places.size()));
        if (isNew)
        {
          surface.Places.push_back(this->Surfaces[b].template PlaceOf<D>(&wire.Places[3 * k]));
        }
        side.nodes[k] = at->second;
      }
      side.region = regions.empty() ? 0 : static_cast<Index>(region - regions.begin());
      side.oriented = wire.IsOriented;
      // No cell of this rank: the caps of such sides go to nobody here.
      side.cell = meshopt::None;
      surface.Sides.push_back(side);
    }
  }

  const Ranks& All;
  const std::vector<Block>& Blocks;
  std::vector<Surface>& Surfaces;
  std::vector<std::size_t> Mine;        ///< blocks with sides of this dimension
  std::vector<std::vector<Key>> Hashes; ///< of each block's points of the surface
  std::vector<Key> Opposite;            ///< of each side
  std::set<Key> Ends;                   ///< edges (D = 2: nodes) of border facets
};

} // namespace

//------------------------------------------------------------------------------
void RemoveBorders(
  const Ranks& ranks, const std::vector<Block>& blocks, std::vector<Surface>& surfaces)
{
  Borders<3>(ranks, blocks, surfaces).Remove();
  Borders<2>(ranks, blocks, surfaces).Remove();
}

} // namespace vtkMeshQualityBridge
