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

} // namespace

std::vector<int> Divide(const Part& part, int count)
{
  std::vector<Place> centers;
  for (vtkIdType c = 0; c < part.GetNumberOfCells(); ++c)
  {
    centers.push_back(CenterOf(part, c));
  }
  std::vector<vtkIdType> cells(part.CellIds.size());
  std::iota(cells.begin(), cells.end(), vtkIdType(0));
  std::vector<int> target(cells.size(), 0);
  Cut(centers, cells.begin(), cells.end(), 0, count, target);
  return target;
}

} // namespace vtkMeshRanks
