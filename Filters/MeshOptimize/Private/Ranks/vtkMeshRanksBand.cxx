// SPDX-License-Identifier: BSD-3-Clause
// A band of cells around what has never been together in one run moves to one rank. Points have
// labels, which spread from layer to layer over all ranks at once: so all agree on who takes a
// cell.
#include "Ranks/vtkMeshRanksBand.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace vtkMeshRanks
{
namespace
{

/// Layers * ranks + place of the rank that takes: the least one wins.
using Label = long long;
constexpr Label None = std::numeric_limits<Label>::max();

/**
 * The ranks, fewest cells first.
 */
std::vector<int> OrderRanks(const Ranks& ranks, const Part& part)
{
  const std::vector<vtkIdType> counts = ranks.Gather(part.GetNumberOfCells());
  std::vector<int> order(ranks.GetCount());
  std::iota(order.begin(), order.end(), 0);
  // Stable: of equal counts the lower rank.
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return counts[a] < counts[b]; });
  return order;
}

/**
 * Takes the least label of each point over the ranks that have it.
 */
void TakeLeast(const Ranks& ranks, const Shared& shared, std::vector<Label>& labels)
{
  std::vector<Bytes> out(ranks.GetCount());
  for (std::size_t k = 0; k < shared.Neighbors.size(); ++k)
  {
    std::vector<Label> mine;
    for (const vtkIdType p : shared.Points[k])
    {
      mine.push_back(labels[p]);
    }
    PutAll(out[shared.Neighbors[k]], mine);
  }
  const std::vector<Bytes> in = ranks.Exchange(std::move(out));
  for (std::size_t k = 0; k < shared.Neighbors.size(); ++k)
  {
    const std::vector<Label> theirs = Reader(in[shared.Neighbors[k]]).TakeAll<Label>();
    for (std::size_t i = 0; i < theirs.size(); ++i)
    {
      Label& mine = labels[shared.Points[k][i]];
      mine = std::min(mine, theirs[i]);
    }
  }
}

Label LabelOfCell(const Part& part, const std::vector<Label>& labels, vtkIdType c)
{
  Label least = None;
  for (int i = 0; i < part.Corners; ++i)
  {
    least = std::min(least, labels[part.GetCell(c)[i]]);
  }
  return least;
}

} // namespace

//------------------------------------------------------------------------------
std::vector<int> FindBands(const Ranks& ranks, const Part& part, const Shared& shared, int layers)
{
  const std::vector<int> order = OrderRanks(ranks, part);
  std::vector<int> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
  {
    place[order[k]] = static_cast<int>(k);
  }
  std::vector<Label> labels(part.PointIds.size(), None);
  for (vtkIdType p = 0; p < part.GetNumberOfPoints(); ++p)
  {
    if (part.Flags[p] & Waiting)
    {
      // The one with the fewest cells of those that have the point takes its band.
      labels[p] = place[ranks.GetRank()];
      for (const int r : shared.RanksOf[p])
      {
        labels[p] = std::min<Label>(labels[p], place[r]);
      }
    }
  }
  TakeLeast(ranks, shared, labels); // where only one of two ranks lets a point wait
  for (int layer = 1; layer < layers; ++layer)
  {
    // From the labels of the layer before: cells within a layer must not depend on their order.
    std::vector<Label> next = labels;
    for (vtkIdType c = 0; c < part.GetNumberOfCells(); ++c)
    {
      const Label least = LabelOfCell(part, labels, c);
      for (int i = 0; i < part.Corners && least != None; ++i)
      {
        Label& label = next[part.GetCell(c)[i]];
        label = std::min(label, least + ranks.GetCount());
      }
    }
    labels.swap(next);
    TakeLeast(ranks, shared, labels);
  }
  std::vector<int> target(part.CellIds.size(), -1);
  for (vtkIdType c = 0; c < part.GetNumberOfCells(); ++c)
  {
    const Label least = LabelOfCell(part, labels, c);
    target[c] = least == None ? -1 : order[least % ranks.GetCount()];
  }
  return target;
}

//------------------------------------------------------------------------------
void Move(const Ranks& ranks, const std::vector<int>& target, const Schema& points,
  const Schema& cells, const Part& from, Part& part, std::vector<char>& isMoved)
{
  // Cells that stay and cells that have this rank as target must be told apart afterwards.
  const int count = ranks.GetCount();
  std::vector<int> place(target.size());
  std::transform(
    target.begin(), target.end(), place.begin(), [&](int t) { return t < 0 ? count : t; });
  std::vector<Part> parts = Split(from, place, count + 1, count);
  std::vector<Bytes> out(count);
  for (int r = 0; r < count; ++r)
  {
    // What moves within this rank is not packed at all.
    if (r != ranks.GetRank())
    {
      out[r] = Pack(parts[r]);
      parts[r] = Part();
    }
  }
  std::vector<Bytes> in = ranks.Exchange(std::move(out));
  std::vector<Part> here;
  const std::vector<vtkIdType> stayed = parts[count].CellIds;
  here.push_back(std::move(parts[count]));
  here.push_back(std::move(parts[ranks.GetRank()]));
  for (Bytes& bytes : in)
  {
    if (!bytes.empty())
    {
      here.push_back(Unpack(bytes, from.Corners, points, cells));
      Bytes().swap(bytes);
    }
  }
  // Two ranks that disagree about a cell would have it twice, or not at all.
  ranks.Agree(Join(std::move(here), part));
  isMoved.assign(part.CellIds.size(), 1);
  std::size_t at = 0;
  for (const vtkIdType id : stayed) // both ascend
  {
    while (part.CellIds[at] != id)
    {
      ++at;
    }
    isMoved[at] = 0;
  }
}

} // namespace vtkMeshRanks
