// SPDX-License-Identifier: BSD-3-Clause
// Recursive bisection by coordinates: parts of equal size whose cells are near each other.
#include "vtkMeshRanksDivide.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace vtkMeshRanks
{
namespace
{

using Place = std::array<double, 3>;

/**
 * Not divided by the number of corners: centers are only compared with each other.
 */
Place CenterOf(const Part& part, vtkIdType c)
{
  Place sum{};
  for (int i = 0; i < part.Corners; ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      sum[k] += part.GetPoint(part.GetCell(c)[i])[k];
    }
  }
  return sum;
}

using Iterator = std::vector<vtkIdType>::iterator;

int LongestSide(const std::vector<Place>& centers, Iterator first, Iterator last)
{
  constexpr double far = std::numeric_limits<double>::infinity();
  Place low{ { far, far, far } }, high{ { -far, -far, -far } };
  for (; first != last; ++first)
  {
    for (int k = 0; k < 3; ++k)
    {
      low[k] = std::min(low[k], centers[*first][k]);
      high[k] = std::max(high[k], centers[*first][k]);
    }
  }
  int longest = 0;
  for (int k = 1; k < 3; ++k)
  {
    longest = high[k] - low[k] > high[longest] - low[longest] ? k : longest;
  }
  return longest;
}

void Cut(const std::vector<Place>& centers, Iterator first, Iterator last, int begin, int end,
  std::vector<int>& target)
{
  if (end - begin == 1)
  {
    std::for_each(first, last, [&](vtkIdType c) { target[c] = begin; });
    return;
  }
  // Not a power of two: each half gets its share of the parts, and as many cells in proportion.
  const int half = begin + (end - begin) / 2, axis = LongestSide(centers, first, last);
  const auto middle = first + (last - first) * (half - begin) / (end - begin);
  // Ties by number: otherwise, which of two cells on the cut goes where would depend on the
  // library.
  std::nth_element(first, middle, last,
    [&](vtkIdType a, vtkIdType b)
    { return centers[a][axis] != centers[b][axis] ? centers[a][axis] < centers[b][axis] : a < b; });
  Cut(centers, first, middle, begin, half, target);
  Cut(centers, middle, last, half, end, target);
}

/// Of all ranks together: as exact as a percent, and nothing to send.
constexpr vtkIdType MostSamples = 1 << 15;

/**
 * Cuts the samples as Cut() does, and with them the cells of this rank. All ranks have the same
 * samples in the same order, and so the same cuts.
 */
void CutBoth(const std::vector<Place>& samples, Iterator first, Iterator last,
  const std::vector<Place>& centers, Iterator firstCell, Iterator lastCell, int begin, int end,
  std::vector<int>& target)
{
  if (end - begin == 1 || first == last)
  {
    std::for_each(firstCell, lastCell, [&](vtkIdType c) { target[c] = begin; });
    return;
  }
  const int half = begin + (end - begin) / 2, axis = LongestSide(samples, first, last);
  const auto middle = first + (last - first) * (half - begin) / (end - begin);
  std::nth_element(first, middle, last,
    [&](vtkIdType a, vtkIdType b)
    { return samples[a][axis] != samples[b][axis] ? samples[a][axis] < samples[b][axis] : a < b; });
  const double cut = samples[*middle][axis];
  const auto middleCell = std::stable_partition(
    firstCell, lastCell, [&](vtkIdType c) { return centers[c][axis] < cut; });
  CutBoth(samples, first, middle, centers, firstCell, middleCell, begin, half, target);
  CutBoth(samples, middle, last, centers, middleCell, lastCell, half, end, target);
}

std::vector<Place> CentersOf(const Part& part)
{
  std::vector<Place> centers;
  centers.reserve(part.CellIds.size());
  for (vtkIdType c = 0; c < part.GetNumberOfCells(); ++c)
  {
    centers.push_back(CenterOf(part, c));
  }
  return centers;
}

std::vector<vtkIdType> NumbersUpTo(std::size_t n)
{
  std::vector<vtkIdType> numbers(n);
  std::iota(numbers.begin(), numbers.end(), vtkIdType(0));
  return numbers;
}

} // namespace

std::vector<int> Divide(const Part& part, int count)
{
  const std::vector<Place> centers = CentersOf(part);
  std::vector<vtkIdType> cells = NumbersUpTo(centers.size());
  std::vector<int> target(cells.size(), 0);
  Cut(centers, cells.begin(), cells.end(), 0, count, target);
  return target;
}

std::vector<int> DivideAnew(const Ranks& ranks, const Part& part)
{
  const std::vector<Place> centers = CentersOf(part);
  const vtkIdType step = 1 + ranks.Sum(part.GetNumberOfCells()) / MostSamples;
  std::vector<Place> some;
  for (vtkIdType c = 0; c < part.GetNumberOfCells(); c += step)
  {
    some.push_back(centers[c]);
  }
  Bytes mine;
  PutAll(mine, some);
  std::vector<Place> samples;
  for (const Bytes& bytes : ranks.Gather(mine))
  {
    const std::vector<Place> theirs = Reader(bytes).TakeAll<Place>();
    samples.insert(samples.end(), theirs.begin(), theirs.end());
  }
  std::vector<vtkIdType> order = NumbersUpTo(samples.size()), cells = NumbersUpTo(centers.size());
  std::vector<int> target(cells.size(), 0);
  CutBoth(samples, order.begin(), order.end(), centers, cells.begin(), cells.end(), 0,
    ranks.GetCount(), target);
  return target;
}

} // namespace vtkMeshRanks
