// SPDX-License-Identifier: BSD-3-Clause
/// @file Constants.h
/// What the schedule of the fast engine is tuned by.
#ifndef meshopt_WorstFirst_Constants_h
#define meshopt_WorstFirst_Constants_h

#include "Mesh/Types.h"

#include <cstddef>
#include <limits>

namespace meshopt
{
namespace worstfirst
{
/// Targets of the stages. Steps get smaller where gains cost more.
inline constexpr double Stages[] = { 0.30, 0.45, 0.55, 0.60, 0.64, 0.67, 0.69, 0.705, 0.72, 0.73,
  0.74, 0.75, 0.76 };
inline constexpr double SameTarget = 1e-9;    // targets that differ by less are the same
inline constexpr int MaximumPasses = 10;      // of one stage
inline constexpr int MostIdle = 2;            // stages past the target that may lift nothing
inline constexpr Index CellsPerChunk = 20000; // fewer make borders too long
inline constexpr int BadCellsPerChunk = 32;   // fewer are not worth a chunk
inline constexpr int PolishedPerChunk = 4;    // the same where each is tried long
inline constexpr int MaximumChunks = 256;
inline constexpr double Shifts[] = { 0.0, 0.3, -0.3 }; // of their borders, by turns
/// On the way to the target: where borders hold up more than one in so many bad cells of a pass, these
/// get a pass without borders.
inline constexpr long HeldUpPart = 3;
/// A pass of which less than one in so many bad cells gains is the last one of a stage.
inline constexpr long HardlyAny = 2000;
inline constexpr std::size_t PolishedCells = 10, MostPolishedCells = 80;
inline constexpr int PolishRounds = 50;
inline constexpr double RoundGain =
  10.0; // what a round must gain to be repeated, in least gains of a change
/// How far around the worst cells others are lifted, and by how much per layer.
inline constexpr int LiftedLayers = 3;
inline constexpr double LiftStep = 0.02;
/// The least gain of a change, and how near to its cap a cell is left alone: at first, and where
/// the best effort polishes.
inline constexpr double Gain = 1e-3, FineGain = 1e-4;
inline constexpr double CapReached = 0.998, CapReachedFinely = 0.9995;
/// The part of a tiny cap that is as good as the target where cells are weighed.
inline constexpr double TinyReached = 0.5;
/// The least gain where the metric or a wanted size varies: qualities then cost many times more, and
/// most cells can be under the target.
inline constexpr double CoarseGain = 1e-2;
/// Insertion and look-ahead are given up for a pass of which less than one in so many tries helps.
inline constexpr long Patience[] = { std::numeric_limits<int>::max(), 50, 20, 20 };
inline constexpr long PatientTries = 200; // before that is looked at
/// For insertion it is looked at after one in so many bad cells: the first ones are the most stuck.
inline constexpr long PatientPart = 5;
/// No more nodes are removed once this part of the cells is gone (unless sizes are wanted).
inline constexpr double ShrinkBudget = 0.12;
/// One in so many cells of the growth budget is kept for polishing.
inline constexpr long ReservedPart = 10;
/// The growth budget is used up where no more than this part of it is left, or one node's cells.
inline constexpr double UsedUp = 0.1;
inline constexpr long OneNode = 10;
/// On the way to the target look-ahead is for the worst few cells of a pass: FewCells, or one in
/// FewOfMany of all cells if that is more; in small meshes one in FewCellsPart, at least FewestCells.
inline constexpr long FewCells = 200, FewestCells = 20, FewCellsPart = 20, FewOfMany = 100;
/// After so many tries for each cell that was bad at first nodes only creep, and a pass asks for
/// CoarseGain.
inline constexpr long Creeping = 5;
/// A stage ends where a pass leaves more than this part of many bad cells and does not lift the worst.
inline constexpr double HardlyFewer = 0.99;
/// Where the metric or a wanted size varies a try costs many times more: it counts as so many.
inline constexpr long Hurry = 5;
/// Tries of one chunk between two looks at progress, by level: some tenth of a second.
inline constexpr long Tries[] = { 20000, 4000, 400, 100 };
}
}

#endif
