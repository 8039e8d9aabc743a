// SPDX-License-Identifier: BSD-3-Clause
/// @file Constants.h
/// The constants that tune the schedule of the fast engine.
#ifndef meshopt_WorstFirst_Constants_h
#define meshopt_WorstFirst_Constants_h

#include "Mesh/Types.h"
#include "Operations/Level.h"
#include "Run/Options.h"

#include <cstddef>
#include <iterator>
#include <limits>

namespace meshopt
{
namespace worstfirst
{
/// Targets of the stages. Steps get smaller where gains cost more.
inline constexpr double Stages[] = { 0.30, 0.45, 0.60, 0.64, 0.67, 0.69, 0.705, 0.72, 0.73, 0.74,
  0.75, 0.76 };
/// More of them for the best effort where the surface of tetrahedra takes part.
inline constexpr double StagesOfSliding[] = { 0.77, 0.78, 0.79, 0.80 };
/// After a division the first stage is at BeatenBy times the worst quality before it, for the few
/// cells that the division has made worse. The next is at AboveBeaten times that, or more.
inline constexpr double BeatenBy = 1.02, AboveBeaten = 1.1;
inline constexpr double SameTarget = 1e-9;    // targets that differ by less are the same
inline constexpr int MaximumPasses = 10;      // of one stage
inline constexpr int MostIdle = 2;            // stages in a row, past the target, without gain
inline constexpr int MostIdleOfPart = 4;      // the same in a part of a mesh
inline constexpr Index CellsPerChunk = 20000; // with fewer, too many cells lie at borders
inline constexpr int BadCellsPerChunk = 32;   // with fewer, a chunk does not pay
inline constexpr int PolishedPerChunk = 4;    // the same for polishing, where each cell takes long
inline constexpr int MaximumChunks = 256;
inline constexpr double Shifts[] = { 0.0, 0.3, -0.3 }; // of the borders, in turn
/// A stage ends with a pass in which fewer than 1 in HardlyAny of the bad cells gain.
inline constexpr long HardlyAny = 2000;
/// Where the cost model rules: the least gain of a change, and the most steps of a search for the
/// place of one node. The first steps bring most, and the node is tried again when its neighbours
/// have moved.
inline constexpr double ThriftyGain = 1e-2;
inline constexpr int ThriftySteps = 4;
/// How many of the worst cells are polished together: at first, and at most. Best: this many per
/// CellsPerPolish cells. A round lifts the worst only a little, and there are at most PolishRounds.
/// In a mesh of 2 million cells, ten at a time leave the worst at .700 instead of .740.
inline constexpr std::size_t PolishedCells = 10, MostPolishedCells = 80;
inline constexpr Index CellsPerPolish = 500000;
/// Where the worst cell is below the part FarBelowBound of the certified bound, up to
/// MostBelowBound cells are polished together already on the way to the target.
inline constexpr double FarBelowBound = 0.97;
inline constexpr std::size_t MostBelowBound = 80;
/// A round on more than PolishedCells cells, or a cycle of polishing and repair, has gained if the
/// worst quality has risen by more than WideGain, relatively. The cycles end after more than
/// MostIdleCycles in a row without gain, and after PolishCycles in all.
inline constexpr double WideGain = 0.02;
inline constexpr int MostIdleCycles = 2;
inline constexpr int PolishCycles = 8;
/// Up to the target, polishing may spend 1 look-ahead per CellsPerLook cells in a run; in small
/// meshes FewestLooks in all. Each takes as long as a pass over thousands of cells.
inline constexpr Index CellsPerLook = 75;
inline constexpr Index FewestLooks = 40;
inline constexpr int PolishRounds = 50;
inline constexpr double RoundGain =
  10.0; // what a round must gain to be repeated, in least gains of a change
/// How many layers around the worst cells are lifted, and by how much per layer.
inline constexpr int LiftedLayers = 3;
inline constexpr double LiftStep = 0.02;
/// The least gain of a change: in general, and where the best effort polishes finely. There a cell
/// is left alone at this fraction of its cap, elsewhere at CapReached.
inline constexpr double Gain = 1e-3, FineGain = 1e-4;
inline constexpr double CapReachedFinely = 0.9995;
/// With weights on, a cell that reaches this fraction of its tiny cap counts as being at the
/// target.
inline constexpr double TinyReached = 0.5;
/// The least gain if the metric or a wanted size varies. Qualities then cost many times more, and
/// most cells can be under the target.
inline constexpr double CoarseGain = 1e-2;
/// Insertion and look-ahead are given up for a pass if fewer than 1 in Patience of their tries
/// helps, after PatientTries of them; look-ahead where many cells are bad after PatientLooks.
inline constexpr long Patience = 20, PatientTries = 200, PatientLooks = 40;
/// The same where the surface takes part. With 200 needle meshes took a third longer, and ended no
/// higher.
inline constexpr long PatientLooksOfSliding = 20;
/// For insertion, patience is checked only after 1 in PatientPart of the bad cells has been tried:
/// the worst cells come first, and these are the most stuck.
inline constexpr long PatientPart = 5;
/// Stop removing nodes once this fraction of the cells and this fraction of the nodes is gone
/// (unless sizes are followed): swaps alone can remove that many cells. Where the surface takes
/// part, or in a metric, nodes count only at very bad cells. See also GrowthBudget::openNodes().
inline constexpr double ShrinkBudget = 0.12;
/// At the end of a run, where the surface is kept and lengths are plain, this many times that
/// fraction of the nodes may be gone.
inline constexpr long ShrinkAtEnd = 2;
/// The most nodes that may vanish in one wide insertion: SwallowedPerEdge for each mean edge that
/// the mesh is wide, since needles of the surface can be as long as that, but at least
/// MostSwallowed; parts that lie far from each other make a mesh wide, too, so that there is a most
/// of all. With 30 in all of them, the worst cells of some lattices of 30 000 points end at
/// a third. Only FewestSwallowed once WideShrink times ShrinkBudget of the nodes is gone, for the
/// worst cell WideShrinkOfWorst times: otherwise others take the nodes that the worst cell needs.
/// Thin slabs need so much: their long facets leave no room for the many nodes behind them. In a
/// part of a mesh cells count, and ShrinkAtEnd times ShrinkBudget of them.
inline constexpr int MostSwallowed = 30, FewestSwallowed = 1;
inline constexpr double SwallowedPerEdge = 3.0, MostSwallowedAtAll = 1000.0;
inline constexpr long WideShrink = 5, WideShrinkOfWorst = 6;
/// 1 in ReservedPart of the growth budget is reserved for polishing.
inline constexpr long ReservedPart = 10;
/// The growth budget counts as used up if at most this fraction of it plus one node's cells is
/// left.
inline constexpr double UsedUp = 0.1;
inline constexpr long OneNode = 10;
/// Up to the target, look-ahead is for the worst few cells of a pass. "Few" is 1 in FewOfMany of
/// all cells, but at least FewCells; in small meshes 1 in FewCellsPart, but at least FewestCells.
inline constexpr long FewCells = 200, FewestCells = 20, FewCellsPart = 20, FewOfMany = 100;
/// The most tries of polishing in a pass, for each of its cells: mostly it takes less than half.
inline constexpr long MostPolishTries = 100;
/// After this many tries per initially bad cell, nodes only creep. From then on a pass requires
/// CoarseGain.
inline constexpr long Creeping = 5;
/// Where many cells are bad, tries are counted in windows: 1 in CreepingPart of the cells that the
/// pass was given, but at least CreepingTries. The pass creeps if fewer than 1 in CreepingLift of
/// the tries in a window lift a cell above the target; in healthy meshes 1 in 2 or more do. It then
/// requires CoarseGain, and ends after CreepingRounds rounds, by effort. With 1 in 5 fewer of the
/// many bad cells of random points are lifted, but a quick run is to end sooner: with 1 in 10 it
/// leaves the worst cell of a lattice at a quarter of its bound. Where the surface takes part,
/// lifting comes later, also in a quick run.
inline constexpr long CreepingPart = 2, CreepingTries = 100;
inline constexpr long CreepingLift = 10, CreepingLiftOfQuick = 5;
inline constexpr int CreepingRounds[] = { 0, 8, 8 };
static_assert(std::size(CreepingRounds) == NumberOfEfforts);
/// A run that creeps gives up the many if they are more than the fraction ManyStuck of the cells,
/// and a pass leaves more than HopelesslyMany of them; a quick run past the first stage in any
/// case, if they are more than ManyStuckQuick.
inline constexpr double ManyStuck = 0.8, ManyStuckQuick = 0.05, HopelesslyMany = 0.98;
/// A stage ends if many cells are bad, and a pass leaves more than this fraction of them and does
/// not lift the worst one.
inline constexpr double HardlyFewer = 0.99;
/// If the metric or a wanted size varies, a try costs many times more: patience counts it this many
/// times.
inline constexpr long Hurry = 5;
/// By level: the most tries of one chunk between two looks at progress (some tenths of a second).
inline constexpr long Tries[] = { 20000, 10000, 2000, 200, 20 };
static_assert(std::size(Tries) == Level::Count);
}
}

#endif
