// SPDX-License-Identifier: BSD-3-Clause
// Outcomes are sent field by field, and added like those of blocks.
#include "Tasks/vtkMeshOptimizePieces.h"

#include "Ranks/vtkMeshRanksExchange.h"

#include <algorithm>
#include <type_traits>

namespace vtkMeshOptimizeBridge
{
namespace
{

using vtkMeshRanks::Bytes;
using vtkMeshRanks::Ranks;
using vtkMeshRanks::Reader;

/**
 * Calls f for each number of an outcome that Outcome::Add() uses. No surface of tetrahedra slides
 * in pieces, so there are no volumes.
 */
template <class AnyOutcome, class F>
void ForNumbers(AnyOutcome& outcome, F&& f)
{
  auto& report = outcome.Report;
  f(report.stopReason);
  f(report.worstBefore);
  f(report.worstAfter);
  f(report.meanBefore);
  f(report.meanAfter);
  f(report.bound);
  f(report.cappedCells);
  f(report.invertedBefore);
  f(report.invertedAfter);
  f(report.evaluations);
  f(outcome.NumberOfCells);
  f(outcome.NumberOfCellsBefore);
  f(outcome.NumberOfSimplices);
  f(outcome.NumberOfGhostSimplices);
  f(outcome.NumberOfSurfaceTriangles);
  f(outcome.NumberOfReorientedCells);
  f(outcome.NumberOfQuadraticSimplices);
  f(outcome.NumberOfOperations);
  f(outcome.Seconds);
  f(outcome.Lengths);
}

/**
 * The same for its sentences.
 */
template <class AnyOutcome, class F>
void ForTexts(AnyOutcome& outcome, F&& f)
{
  f(outcome.Twins);
  f(outcome.Overlap);
  f(outcome.Tangle);
  f(outcome.Sizes);
}

Bytes PackOutcome(const Outcome& outcome)
{
  Bytes bytes;
  ForNumbers(outcome, [&](const auto& number) { vtkMeshRanks::Put(bytes, number); });
  ForTexts(outcome,
    [&](const std::string& text) { vtkMeshRanks::PutAll(bytes, Bytes(text.begin(), text.end())); });
  return bytes;
}

Outcome UnpackOutcome(const Bytes& bytes, const std::string& title)
{
  Outcome outcome;
  Reader reader(bytes);
  ForNumbers(outcome,
    [&](auto& number) { number = reader.Take<std::remove_reference_t<decltype(number)>>(); });
  ForTexts(outcome,
    [&](std::string& text)
    {
      const Bytes read = reader.TakeAll<char>();
      text = read.empty() ? "" : title + std::string(read.begin(), read.end());
    });
  return outcome;
}

} // namespace

//------------------------------------------------------------------------------
std::string OptimizePieces(vtkMultiProcessController* controller,
  const std::function<std::string(Outcome&)>& work, Outcome& outcome)
{
  const Ranks ranks(controller);
  return ranks.Together(
    [&]()
    {
      Outcome mine, all;
      ranks.Agree(work(mine));
      double longest = 0.0;
      const std::vector<Bytes> every = ranks.Gather(PackOutcome(mine));
      for (int r = 0; r < ranks.GetCount(); ++r)
      {
        const Outcome one = UnpackOutcome(every[r], "Rank " + std::to_string(r) + ": ");
        longest = std::max(longest, one.Seconds);
        all.Add(one);
      }
      all.Seconds = longest; // they worked at the same time
      all.Report.history = std::move(mine.Report.history);
      outcome = std::move(all);
      return std::string();
    });
}

} // namespace vtkMeshOptimizeBridge
