// SPDX-License-Identifier: BSD-3-Clause
// Checks that what the ranks have is still the mesh that was divided.
#include "Ranks/vtkMeshRanksCheck.h"

#include "Base/Scramble.h"
#include "Mesh/SimplexGeometry.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace vtkMeshRanks
{
namespace
{

/**
 * By id and place: a point that was moved, or exchanged for another, changes the hash.
 */
std::uint64_t HashOfPoint(const Part& part, vtkIdType p)
{
  std::uint64_t hash = meshopt::scramble(static_cast<std::uint64_t>(part.PointIds[p]));
  for (int i = 0; i < 3; ++i)
  {
    hash = meshopt::addToHash(hash, part.GetPoint(p)[i]);
  }
  return hash;
}

std::vector<std::uint64_t> HashesOfPoints(const Part& part)
{
  std::vector<std::uint64_t> hashes(part.PointIds.size());
  for (vtkIdType p = 0; p < part.GetNumberOfPoints(); ++p)
  {
    hashes[p] = HashOfPoint(part, p);
  }
  return hashes;
}

/**
 * The hash of a facet, in whatever order its nodes are.
 */
std::uint64_t HashOfFacet(
  const std::array<vtkIdType, 3>& nodes, int n, const std::vector<std::uint64_t>& hashes)
{
  std::uint64_t sum = 0;
  for (int i = 0; i < n; ++i)
  {
    // A sum does not depend on the order. Scrambled, since these sums are combined by exclusive or.
    sum += hashes[nodes[i]];
  }
  return meshopt::scramble(sum);
}

using Vector = meshopt::Vec<3>;

double VolumeOf(const Part& part, vtkIdType c, const Vector& up)
{
  Vector x[4];
  for (int i = 0; i < part.Corners; ++i)
  {
    const double* p = part.GetPoint(part.GetCell(c)[i]);
    x[i] = Vector(p[0], p[1], p[2]);
  }
  // In their plane triangles have signed areas, as tetrahedra have volumes.
  const Vector normal = (x[1] - x[0]).cross(x[2] - x[0]);
  return part.Corners == 4 ? normal.dot(x[3] - x[0]) / 6.0 : normal.dot(up) / 2.0;
}

} // namespace

//------------------------------------------------------------------------------
Figures Measure(const Ranks& ranks, const Part& part, const Shared& shared, double target)
{
  Figures mine;
  mine.Worst = std::numeric_limits<double>::infinity();
  // Each rank over its own cells, in their order.
  for (const double q : part.Quality)
  {
    mine.BelowTarget += q < target;
    // Written so that a quality that is not a number counts.
    mine.NotPositive += !(q > 0.0);
    mine.Worst = std::min(mine.Worst, q);
    mine.Mean += q;
  }
  mine.Cells = part.GetNumberOfCells();
  for (const std::vector<int>& others : shared.RanksOf) // the lowest rank counts a point
  {
    mine.Points += others.empty() || others.front() > ranks.GetRank();
  }
  Figures sum;
  sum.Worst = std::numeric_limits<double>::infinity();
  // In the order of the ranks, so that all get the same bits.
  for (const Figures& one : ranks.Gather(mine))
  {
    sum.Cells += one.Cells;
    sum.Points += one.Points;
    sum.BelowTarget += one.BelowTarget;
    sum.NotPositive += one.NotPositive;
    sum.Worst = std::min(sum.Worst, one.Worst);
    sum.Mean += one.Mean;
  }
  sum.Worst = sum.Cells > 0 ? sum.Worst : 0.0;
  sum.Mean /= static_cast<double>(std::max<vtkIdType>(sum.Cells, 1));
  return sum;
}

//------------------------------------------------------------------------------
Signature Sign(const Ranks& ranks, const Part& part, const std::array<double, 3>& normal)
{
  const std::vector<std::uint64_t> hashes = HashesOfPoints(part);
  const Vector up(normal[0], normal[1], normal[2]);
  Signature mine;
  mine.Cells = part.GetNumberOfCells();
  for (vtkIdType c = 0; c < part.GetNumberOfCells(); ++c)
  {
    mine.Volume += VolumeOf(part, c, up);
    // A sum, and not an exclusive or: a cell that came twice would cancel out.
    mine.Ids += meshopt::scramble(static_cast<std::uint64_t>(part.CellIds[c]));
    // A facet inside comes from both its cells, of whatever rank, and cancels out: the surface is
    // left.
    for (int local = 0; local < part.Corners; ++local)
    {
      mine.Surface ^= HashOfFacet(OrientedNodes(part, c, local), part.Corners - 1, hashes);
    }
  }
  Signature sum;
  for (const Signature& one : ranks.Gather(mine))
  {
    sum.Cells += one.Cells;
    sum.Ids += one.Ids;
    sum.Volume += one.Volume;
    sum.Surface ^= one.Surface;
  }
  return sum;
}

std::vector<std::uint64_t> HashesOfHull(const Part& part)
{
  const std::vector<std::uint64_t> points = HashesOfPoints(part);
  std::vector<std::uint64_t> hashes;
  for (const CellFacet& facet : FindOpenFacets(part))
  {
    if (std::all_of(facet.Nodes.begin(), facet.Nodes.begin() + part.Corners - 1,
          [&](vtkIdType p) { return (part.Flags[p] & Hull) != 0; }))
    {
      hashes.push_back(HashOfFacet(facet.Nodes, part.Corners - 1, points));
    }
  }
  std::sort(hashes.begin(), hashes.end());
  return hashes;
}

bool HasNotPositive(const Part& part, const std::array<double, 3>& normal)
{
  const Vector up(normal[0], normal[1], normal[2]);
  vtkIdType c = 0;
  while (c < part.GetNumberOfCells() && VolumeOf(part, c, up) > 0.0)
  {
    ++c;
  }
  return c < part.GetNumberOfCells();
}

bool HasOverusedFacet(const Ranks& ranks, const Part& part)
{
  std::vector<std::uint64_t> hashes(part.PointIds.size());
  std::transform(part.PointIds.begin(), part.PointIds.end(), hashes.begin(),
    [](vtkIdType id) { return meshopt::scramble(static_cast<std::uint64_t>(id)); });
  const auto count = static_cast<std::uint64_t>(ranks.GetCount());
  std::vector<Bytes> out(ranks.GetCount());
  // Only facets with all nodes on the skin may have cells on several ranks.
  VisitFacets(part, Flagged(part, Skin),
    [&](const CellFacet* first, const CellFacet* last)
    {
      const std::uint64_t hash = HashOfFacet(first->Nodes, part.Corners - 1, hashes);
      // Each facet is counted by one rank, the same for all.
      Bytes& bytes = out[meshopt::scramble(hash) % count];
      Put(bytes, hash);
      Put(bytes, static_cast<vtkIdType>(last - first));
    });
  const std::vector<Bytes> in = ranks.Exchange(std::move(out));
  std::unordered_map<std::uint64_t, vtkIdType> uses;
  for (const Bytes& bytes : in)
  {
    for (Reader reader(bytes); !reader.IsAtEnd();)
    {
      vtkIdType& use = uses[reader.Take<std::uint64_t>()];
      use += reader.Take<vtkIdType>();
    }
  }
  std::vector<Bytes> answers(ranks.GetCount(), Bytes(1, 0));
  for (int r = 0; r < ranks.GetCount(); ++r)
  {
    // One byte to each rank: whether any of its facets has too many cells.
    for (Reader reader(in[r]); !reader.IsAtEnd(); reader.Take<vtkIdType>())
    {
      answers[r][0] |= uses[reader.Take<std::uint64_t>()] > 2;
    }
  }
  const std::vector<Bytes> told = ranks.Exchange(std::move(answers));
  return std::any_of(told.begin(), told.end(), [](const Bytes& bytes) { return bytes[0] != 0; });
}

namespace
{

/**
 * A facet that a rank has once, and the cell on it, as the ranks tell each other of them: by
 * places, since there may be no ids yet.
 */
struct Lid
{
  std::uint64_t Facet, Apex; ///< hashes; the apex is the corner that is not on the facet
  int Side;                  ///< 1 or -1: on which side of the facet the cell lies
  int Rank;
};

Lid MakeLid(int rank, const Part& part, const CellFacet& facet, const Vector& up)
{
  const int n = part.Corners - 1;
  const auto place = [&part](vtkIdType p)
  {
    const double* x = part.GetPoint(p);
    return std::array<double, 3>{ { x[0] + 0.0, x[1] + 0.0, x[2] + 0.0 } }; // -0 is 0
  };
  std::array<std::array<double, 3>, 4> places{};
  for (int i = 0; i < n; ++i)
  {
    places[i] = place(facet.Nodes[i]);
  }
  // A side then means the same on all ranks.
  for (int i = 0; i < n; ++i)
  {
    for (int k = 0; k + 1 < n - i; ++k)
    {
      if (places[k + 1] < places[k])
      {
        std::swap(places[k], places[k + 1]);
      }
    }
  }
  places[n] = place(part.GetCell(facet.Cell)[facet.Local]);
  Lid lid{};
  for (int i = 0; i <= n; ++i)
  {
    std::uint64_t& hash = i < n ? lid.Facet : lid.Apex;
    for (const double x : places[i])
    {
      hash = meshopt::addToHash(hash, x);
    }
  }
  const Vector from(places[0].data());
  const Vector a = Vector(places[1].data()) - from, apex = Vector(places[n].data()) - from;
  const Vector b = n == 3 ? Vector(Vector(places[2].data()) - from) : up;
  lid.Side = a.cross(b).dot(apex) < 0.0 ? -1 : 1;
  lid.Rank = rank;
  return lid;
}

} // namespace

bool DoPiecesCoincide(const Ranks& ranks, const Part& part, const std::vector<CellFacet>& open,
  const std::array<double, 3>& normal)
{
  std::vector<Bytes> out(ranks.GetCount());
  for (const CellFacet& facet : open)
  {
    const Lid lid = MakeLid(ranks.GetRank(), part, facet, Vector(normal.data()));
    // Each facet is looked at by one rank, the same for all.
    Put(out[meshopt::scramble(lid.Facet) % static_cast<std::uint64_t>(ranks.GetCount())], lid);
  }
  std::unordered_map<std::uint64_t, std::vector<Lid>> lids;
  vtkIdType same = 0, oneSide = 0; // the same cell, or on one side, more often than not
  for (const Bytes& bytes : ranks.Exchange(std::move(out)))
  {
    for (Reader reader(bytes); !reader.IsAtEnd();)
    {
      const Lid lid = reader.Take<Lid>();
      std::vector<Lid>& others = lids[lid.Facet]; // of ranks before, or of this one: a crack
      const auto has = [&](const auto& fits)
      {
        return std::any_of(others.begin(), others.end(),
          [&](const Lid& other) { return other.Rank != lid.Rank && fits(other); });
      };
      if (has([](const Lid&) { return true; }))
      {
        same += has([&](const Lid& other) { return other.Apex == lid.Apex; }) ? 1 : -1;
        oneSide += has([&](const Lid& other) { return other.Side == lid.Side; }) ? 1 : -1;
      }
      others.push_back(lid);
    }
  }
  const bool hasSurface = ranks.IsAny(std::any_of(lids.begin(), lids.end(),
    [](const auto& one) { return one.second.front().Rank == one.second.back().Rank; }));
  // Most, not any: a cell may lie on another here and there. Where many cells are inverted,
  // neighbours of different ranks lie on one side, too; but then the mesh has a surface that one
  // rank alone knows. Copies of a whole mesh have theirs in common, whatever cells are inside.
  const bool areOnOneSide = ranks.Sum(oneSide) > 0;
  return ranks.Sum(same) > 0 || (areOnOneSide && !hasSurface);
}

std::string Compare(const Signature& before, const Signature& after, bool cells, bool isTangled)
{
  if (cells && before.Cells != after.Cells)
  {
    return "there are " + std::to_string(after.Cells) + " cells in place of " +
      std::to_string(before.Cells);
  }
  if (cells && before.Ids != after.Ids)
  {
    return "the ids of the cells are not the same";
  }
  if (before.Surface != after.Surface)
  {
    return "the surface is not the same";
  }
  // Sums over millions of cells, in another order.
  constexpr double rounding = 1e-9;
  return !isTangled && std::abs(after.Volume - before.Volume) > rounding * std::abs(before.Volume)
    ? "the volume is not the same"
    : "";
}

} // namespace vtkMeshRanks
