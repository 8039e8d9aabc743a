// SPDX-License-Identifier: BSD-3-Clause
/// @file Allowance.h
/// What the passes of a run may still spend: evaluations of quality, by the cost model, and the
/// look-aheads of polishing.
#ifndef meshopt_WorstFirst_Allowance_h
#define meshopt_WorstFirst_Allowance_h

#include "WorstFirst/CostModel.h"
#include "WorstFirst/Workpiece.h"

namespace meshopt
{
namespace worstfirst
{
/// The cost model does not know the mesh. Here stands where it rules, and where not.
template <int D, class Shape>
class Allowance
{
public:
  /// The workpiece must outlive this object.
  explicit Allowance(const Workpiece<D, Shape>& workpiece)
    : workpiece_(workpiece)
    , costs_(workpiece.effort())
  {
    this->costs_.open(workpiece.mesh().countCells(), countFreeNodes(workpiece.mesh()));
  }

  /// From now on anything may be spent.
  void endLimits() { this->costs_.endLimits(); }
  /// To be called at the start of each stage that lifts.
  void startStage(double target) { this->costs_.startStage(target); }

  // --- evaluations
  /// How many a pass may spend, beside what it earns by lifting cells; none if less than 0. Any
  /// number in a metric, and where the surface takes part, unless it polishes.
  double evaluations(Phase phase) const
  {
    const bool polishes = phase == Phase::Polishing;
    if (!this->workpiece_.isKeptAndPlain() && !(polishes && this->workpiece_.slides()))
    {
      return std::numeric_limits<double>::infinity();
    }
    return polishes ? this->costs_.leftForPolish(this->polishFactor()) : this->costs_.leftForPass();
  }
  /// What a pass has earned that has lifted this number of cells.
  double earned(Phase phase, long lifted) const
  {
    return phase == Phase::Polishing ? 0.0
                                     : this->costs_.pricePerLifted() * static_cast<double>(lifted);
  }
  /// To be called for each chunk after a pass that lifts.
  void notePass(std::int64_t evaluations, long lifted)
  {
    this->costs_.notePass(evaluations, lifted);
  }
  /// To be called after a pass of polishing: what it has spent, and the worst quality at its end.
  void notePolish(std::int64_t evaluations, double worst)
  {
    this->costs_.notePolish(evaluations, worst);
  }

  // --- tries
  /// Whether tries are counted more strictly, and changes must gain more: where so many cells are
  /// bad that they cannot all be worth their tries. Not in a metric, where fewer are stuck for
  /// good. Where the surface takes part, never for FewCells or less, so that small bodies get all
  /// tries; and once edges are divided, only in a quick run: with the usual effort it would halve
  /// the time there, but needles of CGAL end 4 % lower.
  bool isThrifty(const Task& task) const
  {
    const Workpiece<D, Shape>& workpiece = this->workpiece_;
    const bool mayBe = !workpiece.run().dividesEdges || workpiece.effort() == Effort::Quick;
    const long few = workpiece.slides() ? std::max(FewCells, workpiece.fewCells())
                                        : workpiece.fewCells();
    return !task.polishes() && workpiece.model().plain && mayBe && !workpiece.isPast(task.target) &&
      task.below > few;
  }
  /// How many tries of an operation a pass makes before it asks whether they help, if `usual` is
  /// the number where many cells are worth their tries.
  long patience(const Task& task, CostModel::Kind kind, long usual) const
  {
    return this->isThrifty(task) ? this->costs_.patience(kind, usual) : usual;
  }
  /// The same for look-ahead where the surface takes part: with the memory in any case.
  long patienceOfSliding(long usual) const { return this->costs_.patience(CostModel::Look, usual); }
  /// To be called after each drain of a pass that lifts.
  void noteTries(CostModel::Kind kind, long tries, bool helped)
  {
    this->costs_.noteTries(kind, tries, helped);
  }

  // --- look-aheads of polishing up to the target
  /// For each of n chunks.
  long looks(int n) const { return std::max<long>(1, (this->mostLooks() - this->looks_) / n); }
  bool hasLooks() const { return this->looks_ < this->mostLooks(); }
  void noteLooks(long looks) { this->looks_ += looks; }

private:
  double polishFactor() const
  {
    const Workpiece<D, Shape>& workpiece = this->workpiece_;
    return !workpiece.slides() ? 1.0
      : workpiece.run().polishesWidely
      ? CostModel::PolishFactorOfSliding
      : CostModel::PolishFactorOfFew[static_cast<int>(workpiece.effort())];
  }
  /// Limited where there is hope: see Workpiece::isFarBelowBound().
  long mostLooks() const
  {
    return this->workpiece_.bound() < 1.0 || this->workpiece_.slides()
      ? std::max(FewestLooks, this->workpiece_.mesh().numberOfCellSlots() / CellsPerLook)
      : std::numeric_limits<long>::max();
  }
  /// Only those that some cell has.
  static long countFreeNodes(const SimplexMesh<D>& mesh)
  {
    long n = 0;
    for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
    {
      n += mesh.isFree(p) && mesh.cellOfPoint(p) != None;
    }
    return n;
  }

  const Workpiece<D, Shape>& workpiece_;
  CostModel costs_;
  long looks_ = 0; ///< up to now
};
}
}

#endif
