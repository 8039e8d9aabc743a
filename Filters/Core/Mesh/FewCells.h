// SPDX-License-Identifier: BSD-3-Clause
/// @file FewCells.h
/// The topology of a few cells, such as those of a cavity, from the ids of their points alone.
#ifndef meshopt_Mesh_FewCells_h
#define meshopt_Mesh_FewCells_h

#include "Mesh/Ids.h"
#include "Mesh/LocalNumbers.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <utility>
#include <vector>

namespace meshopt
{
/// Which of some items have a point, for each point: all lists in one vector.
class Incidence
{
public:
  template <std::size_t N>
  void build(int points, const std::vector<std::array<Index, N>>& items)
  {
    this->first_.assign(points + 1, 0);
    for (const auto& item : items)
    {
      for (Index p : item)
      {
        ++this->first_[p];
      }
    }
    std::partial_sum(this->first_.begin(), this->first_.end(), this->first_.begin());
    this->items_.resize(N * items.size());
    for (int k = static_cast<int>(items.size()); k-- > 0;)
    {
      for (Index p : items[k])
      {
        this->items_[--this->first_[p]] = k;
      }
    }
  }
  bool isEmpty(Index p) const { return this->first_[p] == this->first_[p + 1]; }
  const int* begin(Index p) const { return this->items_.data() + this->first_[p]; }
  const int* end(Index p) const { return this->items_.data() + this->first_[p + 1]; }

private:
  std::vector<int> first_, items_;
};

/// Calls f(q) for each edge (p, q) of the items that have p, of which `at` knows, with q > p: so a
/// walk over all p, upwards, meets every edge once. `seen`, by point, must not have p yet, and is
/// overwritten. Ends when f returns false, and then returns false.
template <class Item, class F>
bool forEachEdgeOnce(
  Index p, const Incidence& at, const std::vector<Item>& items, std::vector<Index>& seen, F&& f)
{
  for (const int* k = at.begin(p); k != at.end(p); ++k)
  {
    for (Index q : items[*k])
    {
      if (q > p && std::exchange(seen[q], p) != p && !f(q))
      {
        return false;
      }
    }
  }
  return true;
}

/// A few cells, and which of them are joined by a facet.
template <int D>
struct FewCells
{
  /// A facet of a cell. The local numbers of its points, sorted, stand in one number.
  struct Side
  {
    std::uint64_t facet;
    int cell;
    bool isOuter; ///< as the caller of load() says
    bool operator<(const Side& o) const { return this->facet < o.facet; }
  };
  static constexpr int BitsOfPoint = 21;
  static constexpr int MostPoints = 1 << BitsOfPoint;

  static std::uint64_t keyOf(const Facet<D>& f)
  {
    std::uint64_t key = 0;
    for (Index p : sortedIds(f))
    {
      key = (key << BitsOfPoint) | static_cast<std::uint64_t>(p);
    }
    return key;
  }
  static Facet<D> facetOf(std::uint64_t key)
  {
    Facet<D> f;
    for (int k = D; k-- > 0; key >>= BitsOfPoint)
    {
      f[k] = static_cast<Index>(key & (MostPoints - 1));
    }
    return f;
  }

  std::vector<Simplex<D>> cells; ///< local numbers of points
  std::vector<Side> sides;       ///< sorted
  std::vector<Facet<D>> joints;  ///< facets that two cells have
  std::vector<std::array<int, 2>> joined;
  Incidence cellsAt, jointsAt;
  std::vector<int> part; ///< a forest of cells; between two questions, each is a tree of its own

  /// Takes the cells over. New points get new numbers. isOuter(k, i): of facet i of cell k.
  template <class IsOuter>
  void load(const std::vector<Simplex<D>>& from, LocalNumbers& numbers, IsOuter&& isOuter)
  {
    this->cells.clear();
    this->sides.clear();
    for (std::size_t k = 0; k < from.size(); ++k)
    {
      Simplex<D> cell;
      std::transform(
        from[k].begin(), from[k].end(), cell.begin(), [&](Index p) { return numbers.add(p); });
      for (int i = 0; i <= D; ++i)
      {
        Facet<D> f;
        std::transform(std::begin(Local<D>::facets[i]), std::end(Local<D>::facets[i]), f.begin(),
          [&](int m) { return cell[m]; });
        this->sides.push_back({ keyOf(f), static_cast<int>(k), isOuter(k, i) });
      }
      this->cells.push_back(cell);
    }
    std::sort(this->sides.begin(), this->sides.end());
  }

  /// After load(), with the number of all points.
  void connect(int points)
  {
    this->joints.clear();
    this->joined.clear();
    for (std::size_t k = 1; k < this->sides.size(); ++k)
    {
      if (this->sides[k].facet == this->sides[k - 1].facet)
      {
        this->joints.push_back(facetOf(this->sides[k].facet));
        this->joined.push_back({ this->sides[k - 1].cell, this->sides[k].cell });
      }
    }
    this->cellsAt.build(points, this->cells);
    this->jointsAt.build(points, this->joints);
    this->part.resize(this->cells.size());
    std::iota(this->part.begin(), this->part.end(), 0);
  }

  int root(int cell) const
  {
    while (this->part[cell] != cell)
    {
      cell = this->part[cell];
    }
    return cell;
  }
  /// Makes one tree of two, over a joint. False if it is one already.
  bool join(int joint)
  {
    const int one = this->root(this->joined[joint][0]), other = this->root(this->joined[joint][1]);
    this->part[other] = one;
    return one != other;
  }
  void separate(int joint)
  {
    for (int cell : this->joined[joint])
    {
      this->part[cell] = cell;
    }
  }
  /// Whether the cells are connected; leaves the forest as it was.
  bool isOnePiece()
  {
    std::size_t pieces = this->cells.size();
    for (std::size_t k = 0; k < this->joints.size(); ++k)
    {
      pieces -= this->join(static_cast<int>(k));
    }
    std::iota(this->part.begin(), this->part.end(), 0);
    return pieces <= 1;
  }

  bool hasEdge(Index p, Index q) const
  {
    return std::any_of(this->cellsAt.begin(p), this->cellsAt.end(p),
      [&](int k) { return hasId(this->cells[k], q); });
  }

  /// V - E + F - C (D = 3), V - E + C (D = 2). `seen` has None for each of the points, and is
  /// overwritten.
  long eulerCharacteristic(int points, std::vector<Index>& seen) const
  {
    long number = 0;
    const auto count = [&number](Index)
    {
      --number;
      return true;
    };
    for (Index p = 0; p < points; ++p)
    {
      number += !this->cellsAt.isEmpty(p);
      if (D == 3)
      {
        forEachEdgeOnce(p, this->cellsAt, this->cells, seen, count);
      }
    }
    const long facets = static_cast<long>(this->sides.size() - this->joints.size());
    const long size = static_cast<long>(this->cells.size());
    return D == 3 ? number + facets - size : number - facets + size;
  }
};
}

#endif
