// SPDX-License-Identifier: BSD-3-Clause
/// @file Judge.h
/// The one place where a proposed change is accepted and made, or refused. If refused, the mesh
/// stays as it was.
///
/// It checks, in this order:
///  - quality: the new cells are better than Proposal::least. For operations of the fast engine,
///    demand() sets this to the worst quality of the cavity plus gain(). The sorted vector of all
///    qualities then rises lexicographically, so that no cycle is possible;
///  - topology: kept edges stay. And where cells may overlap, since geometry then says nothing, the
///    new cells fill the cavity and meet the rest of the mesh in its boundary only (CavityFit.h);
///  - surface: where it takes part in space, it stays as near to what it was as it must, and no
///    cell there is inverted;
///  - growth: the budget allows the additional cells;
///  - guard: there are no more bad cells than before, where one bad cell must not be improved at
///    the expense of others.
#ifndef meshopt_Edit_Judge_h
#define meshopt_Edit_Judge_h

#include "Edit/FailureMemory.h"
#include "Edit/Growth.h"
#include "Edit/Operation.h"
#include "Edit/Proposal.h"
#include "Edit/QualityModel.h"
#include "Edit/SurfaceChanges.h"
#include "Edit/Switches.h"
#include "Mesh/CavityFit.h"
#include "Reposition/TrustRegion.h"
#include "Surface/Surface.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace meshopt
{
template <int D, class Shape>
class Judge
{
public:
  static constexpr double Never = Proposal<D>::Never;

  /// All arguments must outlive the judge. `surface`: what nodes of the surface may slide along;
  /// null: the surface is kept. `caps`: for operations that ask how good a cell can get; may be
  /// null.
  Judge(MeshEditor<D>& editor, const QualityModel<D, Shape>& model, const Switches& switches,
    const Surface<D>* surface = nullptr, const Caps<D>* caps = nullptr)
    : editor_(&editor)
    , model_(&model)
    , switches_(&switches)
    , surface_(surface)
    , caps_(caps)
  {
  }

  // --- what operations read
  MeshEditor<D>& editor() { return *this->editor_; }
  const SimplexMesh<D>& mesh() const { return this->editor_->mesh(); }
  const QualityModel<D, Shape>& model() const { return *this->model_; }
  const Switches& switches() const { return *this->switches_; }
  const Surface<D>* surface() const { return this->surface_; }
  /// Whether nodes of the surface may move, come and go by the operations of free nodes: where that
  /// of tetrahedra slides. Nodes on the boundary of triangles do so by BoundaryChange alone.
  bool slides() const { return this->surface_ && this->surface_->judgesChanges(); }
  const Caps<D>* caps() const { return this->caps_; }

  // --- requirements
  /// The least gain over a worst quality q that makes a change worthwhile. Smaller where all
  /// qualities are tiny (with wide insertions down to 1e-8 of it: what rounding allows), and where
  /// a smaller gain reaches the target (down to a tenth). In a metric the target does not count:
  /// there each change costs more, and the many small ones ended lower.
  double gain(double q) const
  {
    constexpr double nearTarget = 0.1; // of the least gain
    // Of the least gain, too. The second is above what qualities are off by rounding.
    const double ofTiny = this->wide_ == None ? 1e-4 : 1e-8;
    const double near = std::max(nearTarget * this->gain_, this->target_ - q);
    const double least = this->model_->plain ? std::min(this->gain_, near) : this->gain_;
    return std::min(least, std::max(ofTiny * this->gain_, 2 * this->gain_ * std::fabs(q)));
  }
  /// The quality that a change must exceed if the worst is q.
  double required(double q) const { return q + this->gain(q); }
  /// Sets what a change must bring to gain. What has been found (newWorst) must exceed required()
  /// of the worst before. Nodes that move are held to that by newWorst; their cells then need only
  /// be better than before, since in a metric the search took that of the old places. `worst`: of
  /// the cells of the cavity that count.
  void demand(Proposal<D>& p, double worst) const
  {
    const bool moves = !p.moves.empty();
    p.least = moves ? worst : this->required(worst);
    p.leastFound = moves ? this->required(worst) : Proposal<D>::Never;
  }
  void demand(Proposal<D>& p) const { this->demand(p, p.oldWorst); }
  /// What a search for better places of nodes is to reach from the worst quality q. It may stop
  /// where anything above is not worth its cost, and ends where a step promises half of the least
  /// gain. Where the surface takes part, flat elements have ways out of their own: there FlatScale
  /// took longer on surfaces of needles, and they ended no higher.
  SearchGoal goal(double q, int steps = StarSteps) const
  {
    return { this->enough(q), 0.5 * this->gain(q), steps,
      this->slides() ? 0.0 : TrustRegion::Flat };
  }
  /// A search for better places of nodes may stop at this quality: anything above is not worth its
  /// cost.
  double enough(double q) const
  {
    constexpr double margin = 0.02; // above the target
    return std::max(this->target_ + margin, q + 2 * this->gain(q));
  }
  /// Before work for a change that would add `cells`: whether the budget has room. If not,
  /// this is noted for the report.
  bool mayAddCells(long cells) { return this->growth.allows(cells); }
  bool mayRemoveNodes() const { return this->switches_->removeNodes && this->growth.mayShrink(); }
  /// Before an insertion is made, by the worst quality of the cavity and the qualities that the
  /// search for the place of the node has found. Insertions are always guarded.
  bool mayInsert(double oldWorst, double newWorst, const std::vector<double>& qualities,
    const std::vector<Index>& cavity) const
  {
    return newWorst > this->required(oldWorst) && this->badBalance(qualities, cavity) <= 0;
  }

  /// The quality that the pass works towards.
  void setTarget(double quality) { this->target_ = quality; }
  /// Whether operations try all they know for a cell, or only what promises most: where many cells
  /// are bad, most of their tries are in vain.
  void setThorough(bool on) { this->isThorough_ = on; }
  bool isThorough() const { return this->isThorough_; }
  /// Whether look-ahead is tried, if the level and the switches allow it.
  void setLooksAhead(bool on) { this->looksAhead_ = on; }
  bool looksAhead() const { return this->looksAhead_; }
  /// Switches wide insertions on (WideInsertion.h): the most nodes that may vanish in one. None:
  /// off.
  /// `patiently`: many places are tried.
  void setWide(int mostSwallowed, bool patiently = false)
  {
    this->wide_ = mostSwallowed;
    this->widePatiently_ = patiently;
  }
  int wide() const { return this->wide_; }
  bool isWidePatient() const { return this->widePatiently_; }
  /// The least gain of a change, and how many steps the search for the best place of a node may
  /// take.
  void setGain(double gain, int steps = StarSteps)
  {
    this->gain_ = gain;
    this->steps_ = steps;
  }
  int steps() const { return this->steps_; }
  /// Sets the guard: no change may add more bad cells than it removes. Otherwise many cells that
  /// are hardly better would replace one that is worst. A cell under `quality` counts once, under
  /// two thirds of it twice, under one third three times. -1: no guard. Insertions are always
  /// guarded. With `all`, so is every other change, except those that remove an inverted cell.
  void setGuard(double quality, bool all = false)
  {
    this->guard_ = quality;
    this->guardsAll_ = all;
  }
  /// For meshes whose cells may overlap. `tangled`: they may, so topology is checked. `inverted`:
  /// some cells are inverted. `pinched`: see PinchedPoints.h; must outlive the judge.
  void setTangled(bool tangled, bool inverted, const std::vector<std::uint8_t>& pinched)
  {
    this->tangled_ = tangled;
    this->inverted_ = inverted;
    this->pinched_ = &pinched;
  }
  bool hasInverted() const { return this->inverted_; }
  Demand demand() const { return { this->gain_, this->steps_, this->guard_, this->guardsAll_ }; }
  /// Only failures after this time count: before it, more may have been demanded (FailureMemory.h).
  void setFailuresSince(std::uint32_t time) { this->failuresSince_ = time; }
  /// If on, all nodes of the moved cells are stamped after a move, since their stars have changed
  /// (MeshEditor::stamp()). If off, only the moved nodes are stamped.
  void setStampsStars(bool on) { this->stampsStars_ = on; }

  Growth growth;

  // --- transactions
  struct Mark
  {
    std::size_t journal;
    long growth, bad;
    std::array<long, NumberOfOperations> done;
  };
  Mark begin() { return { this->editor_->begin(), this->growth.left, this->bad_, this->done }; }
  /// Ends a transaction: keeps all if it is `good`, or undoes it. Returns `good`.
  bool end(const Mark& mark, bool good)
  {
    good ? this->commit(mark) : this->rollback(mark);
    return good;
  }
  /// The same for changes that each alone may add bad cells: all are kept only if, beside that,
  /// together they keep the guard. Returns whether they are kept.
  bool endGuarded(const Mark& mark, bool good)
  {
    return this->end(mark, good && this->keepsGuard(mark));
  }
  void commit(const Mark& mark) { this->editor_->commit(mark.journal); }
  void rollback(const Mark& mark)
  {
    this->editor_->rollback(mark.journal);
    this->growth.left = mark.growth;
    this->bad_ = mark.bad;
    this->done = mark.done;
  }
  /// Whether the changes since `mark` have added no more bad cells than they removed.
  bool keepsGuard(const Mark& mark) const { return this->bad_ <= mark.bad; }

  // --- judging
  /// Computes the qualities of the new cells. Stops and returns false at the first that is not
  /// better than p.least.
  bool measure(Proposal<D>& p) const;
  /// Whether topology allows the new cells. Always true if cells cannot overlap (setTangled()).
  bool fits(const Proposal<D>& p) { return !this->tangled_ || this->fillsAlone(p); }
  /// Makes the change if it is acceptable. `also` is a further condition: it is called after the
  /// nodes have moved, before their cells are judged.
  template <class Also>
  bool acceptIf(const Proposal<D>& p, Also&& also)
  {
    return p.moves.empty() ? this->replace(p) : this->move(p, also);
  }
  bool accept(const Proposal<D>& p)
  {
    return this->acceptIf(p, [] { return true; });
  }

  /// Begins a new try: changed() is emptied.
  void start() { this->changed_.clear(); }
  /// Cells that accepted changes have created, or whose quality they have changed, since start().
  /// Some may be dead.
  std::vector<Index>& changed() { return this->changed_; }

  /// How bad cells of these qualities are in total, minus the same for the cavity; see setGuard().
  long badBalance(const std::vector<double>& qualities, const std::vector<Index>& cavity) const;

  // --- bookkeeping
  /// Counts a try of an operation. `success`: the judge has accepted it.
  void count(Operation op, bool success)
  {
    ++this->tried[static_cast<int>(op)];
    this->done[static_cast<int>(op)] += success;
    this->gained[static_cast<int>(op)] += success;
  }
  /// Tries, and what remains of them: a rollback takes back what it undoes from `done`. `gained`
  /// counts also what a look-ahead undid later: it says whether an operation is worth its tries.
  std::array<long, NumberOfOperations> tried{}, done{}, gained{};
  /// Changes that the surface was asked about, and those of them that it allowed.
  std::array<long, 2> surfaceChanges{};

  /// Whether a try that failed at time `failed` would fail again, because nothing has changed since
  /// `stamp`. Failures within a transaction are not remembered: after a rollback the star is not
  /// what it was then.
  bool failsAgain(std::uint32_t failed, std::uint32_t stamp) const
  {
    return failed >= stamp && failed > this->failuresSince_;
  }
  /// Remembers that node v could not be moved, or removed; not within a transaction.
  void noteMoveFailed(Index v)
  {
    if (!this->editor_->inTransaction())
    {
      this->editor_->setMoveFailed(v, this->editor_->clock());
    }
  }
  void noteRemovalFailed(Index v)
  {
    if (!this->editor_->inTransaction())
    {
      this->editor_->setRemoveFailed(v, this->editor_->clock());
    }
  }

private:
  /// Where the surface is not the same set of points as before, geometry does not tell whether the
  /// new cells meet others: a notch could be closed.
  bool keepsSurface(const Proposal<D>& p)
  {
    ++this->surfaceChanges[0];
    return p.newWorst > 0.0 && this->fillsAlone(p) &&
      this->changes_.allowsReplacement(*this->surface_, this->mesh(), p);
  }
  /// Whether the new cells fill the cavity, and meet the rest of the mesh nowhere else.
  bool fillsAlone(const Proposal<D>& p)
  {
    this->fit_.load(this->mesh(), p.cavity, p.cells);
    return this->fit_.fills(p.keptChange()) && !this->fit_.meetsOthers(this->pinched());
  }
  const std::vector<std::uint8_t>& pinched() const
  {
    static const std::vector<std::uint8_t> none;
    return this->pinched_ ? *this->pinched_ : none;
  }
  /// Fails only if the chunk has no free slot left.
  bool change(const Proposal<D>& p, const std::vector<double>& qualities)
  {
    return this->editor_->replace(p.cavity, p.cells, qualities, p.keptChange());
  }
  bool replaceOnSurface(const Proposal<D>& p, const std::vector<double>& qualities)
  {
    const Mark mark = this->begin();
    const bool good = this->change(p, qualities) &&
      this->changes_.allowsAngles(*this->surface_, this->mesh(), this->editor_->created());
    this->surfaceChanges[1] += good;
    return this->end(mark, good);
  }
  bool replace(const Proposal<D>& p);
  template <class Also>
  bool move(const Proposal<D>& p, Also&& also);
  int badness(double q) const
  {
    return this->guard_ < 0.0
      ? 0
      : (q < this->guard_) + (q < this->guard_ * (2.0 / 3.0)) + (q < this->guard_ * (1.0 / 3.0));
  }

  MeshEditor<D>* editor_;
  const QualityModel<D, Shape>* model_;
  const Switches* switches_;
  const Surface<D>* surface_;
  const Caps<D>* caps_;
  double target_ = 1.0, gain_ = 1e-3;
  int steps_ = StarSteps;
  double guard_ = -1.0;
  bool guardsAll_ = false, stampsStars_ = true, isThorough_ = true;
  bool looksAhead_ = true;
  int wide_ = None; ///< see setWide()
  bool widePatiently_ = false;
  std::uint32_t failuresSince_ = 0;
  long bad_ = 0; ///< badness() of all cells made, minus that of those removed
  bool tangled_ = false, inverted_ = false;
  const std::vector<std::uint8_t>* pinched_ = nullptr; // only if tangled_
  std::vector<Index> changed_;
  std::vector<double> qualities_;
  CavityFit<D> fit_;
  SurfaceChanges<D> changes_; // only if slides()
};

template <int D, class Shape>
bool Judge<D, Shape>::measure(Proposal<D>& p) const
{
  p.qualities.clear();
  p.newWorst = std::numeric_limits<double>::infinity();
  for (const Simplex<D>& cell : p.cells)
  {
    p.qualities.push_back((*this->model_)(cell));
    p.newWorst = std::min(p.newWorst, p.qualities.back());
    if (!(p.qualities.back() > p.least))
    {
      return false;
    }
  }
  return true;
}

template <int D, class Shape>
long Judge<D, Shape>::badBalance(
  const std::vector<double>& qualities, const std::vector<Index>& cavity) const
{
  long bad = 0;
  for (double q : qualities)
  {
    bad += this->badness(q);
  }
  for (Index c : cavity)
  {
    bad -= this->badness(this->mesh().quality(c));
  }
  return bad;
}

template <int D, class Shape>
bool Judge<D, Shape>::replace(const Proposal<D>& p)
{
  // In this order: first the comparison, then tests of topology, which can be expensive.
  const bool knows = !p.qualities.empty();
  if (!(p.newWorst > p.least) || !this->fits(p) ||
    !keepsEdges<D>(this->mesh(), p.cavity, p.cells, p.keptChange()) ||
    (p.changesKept && this->slides() && !this->keepsSurface(p)) || !this->growth.allows(p.growth()))
  {
    return false;
  }
  this->qualities_.clear();
  for (std::size_t k = 0; k < p.cells.size() && !knows; ++k)
  {
    this->qualities_.push_back((*this->model_)(p.cells[k]));
  }
  const std::vector<double>& qualities = knows ? p.qualities : this->qualities_;
  const long bad = this->badBalance(qualities, p.cavity);
  // Within a transaction a single change may break the guard: keepsGuard() judges the sum at the
  // end. Removing an inverted cell is worth any number of bad ones.
  if (this->guardsAll_ && bad > 0 && !this->editor_->inTransaction() &&
    this->mesh().worstQuality(p.cavity) > 0.0)
  {
    return false;
  }
  if (!(p.changesKept && this->slides() ? this->replaceOnSurface(p, qualities)
                                        : this->change(p, qualities)))
  {
    return false;
  }
  this->bad_ += bad;
  this->growth.left -= p.growth();
  const std::vector<Index>& created = this->editor_->created();
  this->changed_.insert(this->changed_.end(), created.begin(), created.end());
  return true;
}

template <int D, class Shape>
template <class Also>
bool Judge<D, Shape>::move(const Proposal<D>& p, Also&& also)
{
  if (!(p.newWorst > p.leastFound))
  {
    return false;
  }
  // The nodes move first: `also` may look at the new surface, and the model reads points from the
  // mesh.
  const Mark mark = this->begin();
  const bool slides = this->slides() &&
    std::any_of(p.moves.begin(), p.moves.end(), [](const auto& m) { return m.place.mayMove(); });
  if (slides)
  {
    ++this->surfaceChanges[0];
    this->changes_.beforeMoves(*this->surface_, this->mesh(), p);
  }
  for (const auto& m : p.moves)
  {
    this->editor_->movePoint(m.point, m.x);
    if (m.place.mayMove())
    {
      this->editor_->setPlace(m.point, m.place);
    }
  }
  long bad = 0;
  bool good = also();
  for (std::size_t k = 0; k < p.cavity.size() && good; ++k)
  {
    const Index c = p.cavity[k];
    const double old = this->mesh().quality(c);
    const double q = p.qualities.empty() ? (*this->model_)(this->mesh().nodes(c)) : p.qualities[k];
    // A cell that was inverted may stay so while it improves; one that was positive may not turn.
    good = q > p.least && (q > 0.0 || !(slides || (p.keepsPositive && old > 0.0)));
    bad += this->badness(q) - this->badness(old);
    this->editor_->setQuality(c, q);
  }
  good = good && !(this->guardsAll_ && bad > 0 && p.oldWorst > 0.0);
  // The proof of distance comes last: it costs most.
  if (!good ||
    (slides &&
      !(this->changes_.allowsAngles(*this->surface_, this->mesh(), p.cavity) &&
        this->changes_.allowsMoves(*this->surface_, this->mesh(), p))))
  {
    this->rollback(mark);
    return false;
  }
  this->surfaceChanges[1] += slides;
  this->bad_ += bad;
  if (this->stampsStars_)
  {
    this->editor_->stamp(p.cavity);
  }
  this->commit(mark);
  this->changed_.insert(this->changed_.end(), p.cavity.begin(), p.cavity.end());
  return true;
}
}

#endif
