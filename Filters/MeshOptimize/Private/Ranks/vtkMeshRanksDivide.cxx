// SPDX-License-Identifier: BSD-3-Clause
// Recursive bisection by coordinates: parts of equal work whose cells are near each other.
#include "Ranks/vtkMeshRanksDivide.h"

#include "Quality/Measures.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace vtkMeshRanks
{
namespace
{

using Position = std::array<double, 3>;

/**
 * Not divided by the number of corners: centers are only compared with each other.
 */
Position CenterOf(const Part& part, vtkIdType c)
{
  Position sum{};
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

int LongestSide(const std::vector<Position>& centers, Iterator first, Iterator last)
{
  constexpr double far = std::numeric_limits<double>::infinity();
  Position low{ { far, far, far } }, high{ { -far, -far, -far } };
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

/**
 * Parts [first, last) such that the work before the result is `share` of the whole, as nearly as
 * may be. By halves, each of which is found in linear time.
 */
Iterator CutAt(const std::vector<Position>& centers, const std::vector<double>& work, int axis,
  double share, Iterator first, Iterator last)
{
  const auto sum = [&](Iterator from, Iterator to) {
    return std::accumulate(from, to, 0.0, [&](double all, vtkIdType c) { return all + work[c]; });
  };
  // Ties by number: otherwise, which of two cells on the cut goes where would depend on the
  // library.
  const auto isBefore = [&](vtkIdType a, vtkIdType b)
  { return centers[a][axis] != centers[b][axis] ? centers[a][axis] < centers[b][axis] : a < b; };
  double left = share * sum(first, last); // of what has not been put before the cut yet
  while (last - first > 1)
  {
    const auto middle = first + (last - first) / 2;
    std::nth_element(first, middle, last, isBefore);
    const double before = sum(first, middle);
    if (before > left)
    {
      last = middle;
    }
    else
    {
      left -= before;
      first = middle;
    }
  }
  // One cell is left, on this side or on that one.
  return first != last && 2.0 * left >= work[*first] ? last : first;
}

void Cut(const std::vector<Position>& centers, const std::vector<double>& work, Iterator first,
  Iterator last, int begin, int end, std::vector<int>& target)
{
  if (end - begin == 1)
  {
    std::for_each(first, last, [&](vtkIdType c) { target[c] = begin; });
    return;
  }
  // Not a power of two: each half gets its share of the parts, and as much work in proportion.
  const int half = begin + (end - begin) / 2, axis = LongestSide(centers, first, last);
  const double share = static_cast<double>(half - begin) / (end - begin);
  const auto middle = CutAt(centers, work, axis, share, first, last);
  Cut(centers, work, first, middle, begin, half, target);
  Cut(centers, work, middle, last, half, end, target);
}

/// Of all ranks together: as exact as a percent, and nothing to send.
constexpr vtkIdType MostSamples = 1 << 15;

/// The samples of all ranks, with their work.
struct Samples
{
  std::vector<Position> Centers;
  std::vector<double> Work;
};

struct Range
{
  Iterator First, Last;
};

/**
 * Cuts the samples as Cut() does, and with them the cells of this rank, which have `centers`, into
 * the parts `begin` to `end` - 1. All ranks have the same samples in the same order, and so the
 * same cuts.
 */
void CutBoth(const Samples& samples, const std::vector<Position>& centers, Range some, Range cells,
  int begin, int end, std::vector<int>& target)
{
  if (end - begin == 1 || some.First == some.Last)
  {
    std::for_each(cells.First, cells.Last, [&](vtkIdType c) { target[c] = begin; });
    return;
  }
  const int half = begin + (end - begin) / 2;
  const int axis = LongestSide(samples.Centers, some.First, some.Last);
  const double share = static_cast<double>(half - begin) / (end - begin);
  const auto middle = CutAt(samples.Centers, samples.Work, axis, share, some.First, some.Last);
  const auto least = std::min_element(middle, some.Last,
    [&](vtkIdType a, vtkIdType b) { return samples.Centers[a][axis] < samples.Centers[b][axis]; });
  const double cut = least == some.Last ? std::numeric_limits<double>::infinity()
                                        : samples.Centers[*least][axis];
  const auto middleCell = std::stable_partition(
    cells.First, cells.Last, [&](vtkIdType c) { return centers[c][axis] < cut; });
  CutBoth(
    samples, centers, { some.First, middle }, { cells.First, middleCell }, begin, half, target);
  CutBoth(samples, centers, { middle, some.Last }, { middleCell, cells.Last }, half, end, target);
}

std::vector<Position> CentersOf(const Part& part)
{
  std::vector<Position> centers;
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

/**
 * Of each cell whether it is under the target.
 */
template <int D>
std::vector<char> FindBad(
  const Part& part, meshopt::Measure measure, double target, const vtkMeshBridge::Frame<D>& frame)
{
  std::vector<char> isBad(part.CellIds.size());
  meshopt::dispatch<D>(measure,
    [&](auto shape)
    {
      for (vtkIdType c = 0; c < part.GetNumberOfCells(); ++c)
      {
        meshopt::Corners<D> x;
        for (int i = 0; i <= D; ++i)
        {
          x[i] = frame.ToCore(part.GetPoint(part.GetCell(c)[i]));
        }
        isBad[c] = !(shape.value(x) >= target);
      }
    });
  return isBad;
}

/// What a cell under the target takes beside what each cell takes, in the latter: 7 to 15 on five
/// meshes with the default effort, and ranks have more to do with each cell.
constexpr double WorkOfBad = 8.0;
/// But all of them together no more than this part of the cells: no rank then has more than 1.3 of
/// the mean.
constexpr double MostWorkOfBad = 0.3;

} // namespace

//------------------------------------------------------------------------------
std::vector<double> PredictWork(const Ranks& ranks, const Part& part, meshopt::Measure measure,
  double target, const vtkMeshBridge::Frame<2>& plane)
{
  const std::vector<char> isBad = part.Corners == 4
    ? FindBad<3>(part, measure, target, vtkMeshBridge::Frame<3>())
    : FindBad<2>(part, measure, target, plane);
  const auto bad = static_cast<double>(
    ranks.Sum(static_cast<vtkIdType>(std::count(isBad.begin(), isBad.end(), 1))));
  const auto cells = static_cast<double>(ranks.Sum(part.GetNumberOfCells()));
  const double more = std::min(WorkOfBad, MostWorkOfBad * cells / std::max(bad, 1.0));
  std::vector<double> work;
  work.reserve(isBad.size());
  for (const char is : isBad)
  {
    work.push_back(is ? 1.0 + more : 1.0);
  }
  return work;
}

std::vector<int> Divide(const Part& part, const std::vector<double>& work, int count)
{
  const std::vector<Position> centers = CentersOf(part);
  std::vector<vtkIdType> cells = NumbersUpTo(centers.size());
  std::vector<int> target(cells.size(), 0);
  Cut(centers, work, cells.begin(), cells.end(), 0, count, target);
  return target;
}

std::vector<int> DivideAnew(const Ranks& ranks, const Part& part, const std::vector<double>& work)
{
  const std::vector<Position> centers = CentersOf(part);
  const vtkIdType step = 1 + ranks.Sum(part.GetNumberOfCells()) / MostSamples;
  Bytes mine;
  // A sample stands for the cells up to the next one.
  for (vtkIdType c = 0; c < part.GetNumberOfCells(); c += step)
  {
    const auto from = work.begin() + c;
    const auto to = work.begin() + std::min(c + step, part.GetNumberOfCells());
    Put(mine, centers[c]);
    Put(mine, std::accumulate(from, to, 0.0));
  }
  Samples samples;
  for (const Bytes& bytes : ranks.Gather(mine))
  {
    for (Reader reader(bytes); !reader.IsAtEnd();)
    {
      samples.Centers.push_back(reader.Take<Position>());
      samples.Work.push_back(reader.Take<double>());
    }
  }
  std::vector<vtkIdType> order = NumbersUpTo(samples.Work.size());
  std::vector<vtkIdType> cells = NumbersUpTo(centers.size());
  std::vector<int> target(cells.size(), 0);
  CutBoth(samples, centers, { order.begin(), order.end() }, { cells.begin(), cells.end() }, 0,
    ranks.GetCount(), target);
  return target;
}

} // namespace vtkMeshRanks
