// SPDX-License-Identifier: BSD-3-Clause
// What is tried where the surface takes part, how much of the growth each try may use, and what is
// undone.
#include "Optimize/SurfaceRounds.h"

#include "Base/SinceRise.h"
#include "Bound/AngleBound.h"
#include "Bound/SurfaceBound.h"
#include "WorstFirst/Coarsening.h"
#include "WorstFirst/LongEdges.h"
#include "WorstFirst/SharpCorners.h"
#include "WorstFirst/WorstFirst.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace meshopt
{
namespace
{
/// Where the surface takes part: of the growth that is left, what a run may use if others follow,
/// and what divisions may. Found on ten surfaces of CGAL, as the next two: with halves of the
/// growth the worst qualities were a fifth to a third lower.
constexpr double PartOfGrowth = 0.3, PartForDivisions = 0.2;
/// Long edges are divided at cells below AboveWorst times the worst quality. Parts below PartsBelow
/// times it are divided again. If the first way does not help, a gentler one may, which makes less
/// of the mesh worse; or one that goes on until the parts are good, where a needle is left alone.
constexpr double AboveWorst = 1.5, PartsBelow[] = { 0.6, 0.0, 4.0 };
/// The first way of all is to divide edges at sharp corners, at cells below AboveWorstAtCorners
/// times the worst quality, if there are any.
constexpr double AboveWorstAtCorners = 1.05;
constexpr std::size_t AtCorners = 0, NumberOfWays = 1 + std::size(PartsBelow);
/// Once no more than this part of the growth budget is left, nodes elsewhere make room for each
/// division: at most the part PartRemoved of the input's cells. No new cell there is below
/// AboveWorstThere times the worst quality: with 1.5 or 2.5 the worst cells end lower.
constexpr double ShortGrowth = 0.75, PartRemoved = 0.12, AboveWorstThere = 1.2;
/// No more divisions if the worst quality then is less than this many times what it was.
constexpr double DivisionsGain = 1.02;
constexpr int MostDivisions = 16;
/// Nor if they have cost so many times what the run has before them, by effort, since the
/// worst quality last rose clearly (SinceRise). Some small solids took thirty times the first part
/// for a rise of 7 % (fuzz_solids.py, seed 930012). In evaluations of quality. With 4 in place of 8
/// a coarse fan of facets (CGAL's hand) may be left, by how the nodes happen to be numbered.
constexpr double MostPerRise[] = { 2.0, 8.0, 8.0 };
static_assert(std::size(MostPerRise) == NumberOfEfforts);
/// What comes of a division is improved up to AimAboveWorst times the worst quality, at least up to
/// LeastAim: the many cells that are better would take most of the time and of the growth, each
/// time. They have their turn at the end. Where that is above NearTarget times the target, the
/// target itself.
constexpr double AimAboveWorst = 1.3, LeastAim = 0.3, NearTarget = 0.9;
constexpr const char* CrossingUndone = "crossing facets undone"; ///< in the history

/// Improves the worst cells with another effort and with a part of the growth that is left.
/// `toBeat`: see Run.
template <int D>
void optimizeWith(const Run<D>& all, Effort effort, double part, bool polishesWidely, double target,
  double toBeat = 0.0)
{
  Run<D> run = all;
  run.target = target;
  run.toBeat = toBeat;
  run.effort = effort;
  run.polishesWidely = polishesWidely;
  run.limitGrowth(part);
  optimizeWorstFirst<D>(run);
}

template <int D>
class SurfaceRounds
{
public:
  SurfaceRounds(Run<D>& run, Surface<D>& surface)
    : run_(run)
    , surface_(surface)
  {
    run.bound = boundOfAngles<D>(surface, run.options.measure);
  }
  void run();

private:
  struct Division
  {
    bool isCoarser = false, isDivided = false;
  };

  double worst() const { return this->run_.report.history.back().worst; }
  /// The target of what follows a division, if the worst quality was `worst` before it.
  double aim(double worst) const
  {
    const double target = this->run_.options.targetQuality;
    const double aim = std::max(LeastAim, AimAboveWorst * worst);
    return aim < NearTarget * target ? aim : target;
  }
  void noteCost();
  bool isSpent() const;
  bool isWorthDividing() const;
  bool makeRoom();
  Division divide(std::size_t way);
  void divideAndOptimize(
    Effort effort, std::size_t way, bool polishesWidely, std::vector<double>& inVain);
  bool divideInSomeWay(Effort effort, bool polishesWidely);

  Run<D>& run_;
  Surface<D>& surface_;      ///< that of the run
  std::int64_t cost_ = 0;    ///< evaluations up to now
  double costOfFirst_ = 0.0; ///< of them, before the first division
  SinceRise sinceRise_;
};

/// If the growth budget is short, removes nodes where cells are good. Whether there is more room
/// then.
template <int D>
bool SurfaceRounds<D>::makeRoom()
{
  Run<D>& run = this->run_;
  const auto cells = static_cast<double>(run.report.history.front().cells);
  const double budget = static_cast<double>(run.mostCells) - cells;
  run.limitGrowth();
  const bool isShort = static_cast<double>(run.growth) <= ShortGrowth * budget;
  if constexpr (D == 3) // only surfaces in space judge changes
  {
    const auto most = static_cast<long>(PartRemoved * cells);
    return isShort && run.options.removeNodes && coarsen(run, AboveWorstThere, most) > 0;
  }
  return false;
}

/// Divides edges at the worst cells, after room has been made for that.
template <int D>
typename SurfaceRounds<D>::Division SurfaceRounds<D>::divide(std::size_t way)
{
  Run<D>& run = this->run_;
  const double target = run.options.targetQuality, worst = this->worst();
  Division made;
  made.isCoarser = this->makeRoom();
  run.limitGrowth(PartForDivisions);
  if constexpr (D == 3) // as in makeRoom()
  {
    made.isDivided = way == AtCorners
      ? divideAtCorners(run, std::min(target, AboveWorstAtCorners * worst)) > 0
      : divideLongEdges(run, std::min(target, AboveWorst * worst), PartsBelow[way - 1]) > 0;
  }
  return made;
}

/// Divides in one way, and improves what comes of it. If facets pass through others then, does the
/// same once more. The mesh stays as it was if it is no better.
/// `inVain`: the mean qualities of divided meshes that were no better; the same again is the same
/// mesh.
template <int D>
void SurfaceRounds<D>::divideAndOptimize(
  Effort effort, std::size_t way, bool polishesWidely, std::vector<double>& inVain)
{
  Run<D>& run = this->run_;
  const SimplexMesh<D> before = run.mesh();
  const double worst = this->worst();
  const long below = run.report.history.back().belowTarget;
  const StopReason reason = run.report.stopReason;
  bool again = true;
  for (int time = 0; again; ++time)
  {
    const Division made = this->divide(way);
    const double divided = run.report.history.back().mean;
    const bool isKnown = std::find(inVain.begin(), inVain.end(), divided) != inVain.end();
    if (made.isDivided && !isKnown && !run.clock.hasStopped())
    {
      optimizeWith<D>(run, effort, PartOfGrowth, polishesWidely, this->aim(worst), worst);
    }
    if (!made.isDivided && !made.isCoarser)
    {
      return;
    }
    const bool crosses = this->surface_.refuseCrossings(before, run.mesh());
    const PassRecord& now = run.report.history.back();
    // At corners it has to help clearly: else the other ways have more room.
    const bool isBetter = way == AtCorners
      ? now.worst > DivisionsGain * worst
      : now.worst > worst || (now.worst == worst && now.belowTarget < below);
    again = crosses && time == 0 && !run.clock.hasStopped();
    if (crosses || !isBetter)
    {
      restore<D>(run, before);
      run.record(again ? CrossingUndone : "divisions undone");
      run.report.stopReason = run.clock.hasStopped() ? run.stopped() : reason;
      if (!again) // the same division may help where more is refused
      {
        inVain.push_back(divided);
      }
    }
  }
}

/// To be called at the end of each part of the run.
template <int D>
void SurfaceRounds<D>::noteCost()
{
  const std::int64_t before = std::exchange(this->cost_, this->run_.report.evaluations);
  this->sinceRise_.note(static_cast<double>(this->cost_ - before), this->worst());
}

/// Whether divisions have cost too much since the worst quality last rose clearly.
template <int D>
bool SurfaceRounds<D>::isSpent() const
{
  const double most = MostPerRise[static_cast<int>(this->run_.effort)];
  return this->sinceRise_.spent() > most * this->costOfFirst_;
}

/// Whether another division may help.
template <int D>
bool SurfaceRounds<D>::isWorthDividing() const
{
  return !this->run_.clock.hasStopped() && this->run_.options.insertNodes && !this->isSpent() &&
    this->worst() > 0.0 &&
    this->worst() < std::min(this->run_.options.targetQuality, CapReached * this->run_.bound);
}

/// Divides in one way after the other. False if none raises the worst quality clearly.
template <int D>
bool SurfaceRounds<D>::divideInSomeWay(Effort effort, bool polishesWidely)
{
  const double before = this->worst();
  std::vector<double> inVain;
  for (std::size_t way = 0; way < NumberOfWays && this->isWorthDividing(); ++way)
  {
    this->divideAndOptimize(effort, way, polishesWidely, inVain);
    this->noteCost();
    if (this->worst() > DivisionsGain * before)
    {
      return true;
    }
  }
  return false;
}

template <int D>
void SurfaceRounds<D>::run()
{
  Run<D>& run = this->run_;
  const Effort effort = run.effort == Effort::Quick ? Effort::Quick : Effort::Default;
  {
    const Clock::Section part(run.clock, 0.0, 0.5);
    optimizeOnSurface<D>(run, this->surface_, effort, PartOfGrowth, false);
  }
  this->noteCost();
  this->costOfFirst_ = static_cast<double>(this->cost_);
  run.dividesEdges = true;
  double left = 0.5;
  bool helps = true;
  for (int round = 0; round < MostDivisions && helps && this->isWorthDividing(); ++round)
  {
    const Clock::Section part(run.clock, 1.0 - left, 1.0 - 0.5 * left);
    // To polish widely takes most of the time, and mostly another division helps as much.
    helps = this->divideInSomeWay(effort, false) || this->divideInSomeWay(effort, true);
    left *= 0.5;
  }
  const bool isDone = run.report.history.back().belowTarget == 0 && run.effort != Effort::Best;
  if (!isDone && !run.clock.hasStopped())
  {
    const Clock::Section part(run.clock, 1.0 - left, 1.0);
    optimizeOnSurface<D>(run, this->surface_, run.effort, 1.0, true);
  }
}
}

template <int D>
double boundOfAngles(const Surface<D>& surface, Measure measure)
{
  if constexpr (D == 3)
  {
    const SurfaceAngles angles = surface.angles();
    return angleBound(measure, { angles.dihedral, angles.facial, SurfaceAngles::slack });
  }
  return 1.0;
}

template <int D>
void restore(Run<D>& run, const SimplexMesh<D>& mesh)
{
  MeshEditor<D>& editor = run.editor;
  editor.mesh() = mesh;
  // A new editor, since the old one has the marks and the free slots of the other mesh.
  editor = MeshEditor<D>(editor.mesh());
  if (run.surface)
  {
    editor.makeRoomForPlaces(); // before editors of chunks may set some
  }
}

template <int D>
void optimizeOnSurface(
  Run<D>& run, Surface<D>& surface, Effort effort, double part, bool polishesWidely)
{
  const SimplexMesh<D> before = run.mesh();
  for (int time = 0; time <= MostRepeats; ++time)
  {
    optimizeWith<D>(run, effort, part, polishesWidely, run.options.targetQuality);
    if (!surface.refuseCrossings(before, run.mesh()))
    {
      return;
    }
    restore<D>(run, before);
    run.record(CrossingUndone);
  }
  run.report.stopReason = run.clock.hasStopped() ? run.stopped() : StopReason::NoFurtherGain;
}

template <int D>
void optimizeSliding(Run<D>& run, Surface<D>& surface)
{
  SurfaceRounds<D>(run, surface).run();
}

template double boundOfAngles(const Surface<2>&, Measure);
template double boundOfAngles(const Surface<3>&, Measure);
template void restore(Run<2>&, const SimplexMesh<2>&);
template void restore(Run<3>&, const SimplexMesh<3>&);
template void optimizeOnSurface(Run<2>&, Surface<2>&, Effort, double, bool);
template void optimizeOnSurface(Run<3>&, Surface<3>&, Effort, double, bool);
template void optimizeSliding(Run<2>&, Surface<2>&);
template void optimizeSliding(Run<3>&, Surface<3>&);
}
