// SPDX-License-Identifier: BSD-3-Clause
/// @file Judge.h
/// The one place where a proposed change is accepted and made, or refused: the mesh is then as it was.
///
/// What it asks, in this order:
///  - quality: what comes is better than Proposal::least, for the operations of the fast engine the
///    worst of what goes by gain(). The sorted vector of all qualities then rises
///    lexicographically, so that nothing cycles;
///  - topology, where geometry does not tell since cells overlap: what comes fills the cavity and
///    meets the rest of the mesh in its boundary only (CavityFit.h); kept edges stay;
///  - growth: so many cells may still come;
///  - guard: no more bad cells than before, where one bad cell is not to be lifted by others.
#ifndef meshopt_Edit_Judge_h
#define meshopt_Edit_Judge_h

#include "Edit/Growth.h"
#include "Edit/Operation.h"
#include "Edit/Proposal.h"
#include "Edit/QualityModel.h"
#include "Edit/Switches.h"
#include "Mesh/CavityFit.h"
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

  /// All must live as long as the judge. `surface`: what nodes of the surface may slide along, or
  /// null: it is kept. `caps`: for operations that ask how good a cell can get; may be null.
  Judge(MeshEditor<D>& editor, const QualityModel<D, Shape>& model, const Switches& switches,
    const Surface<D>* surface = nullptr, const Caps<D>* caps = nullptr)
    : editor_(&editor)
    , model_(&model)
    , switches_(&switches)
    , surface_(surface)
    , caps_(caps)
  {
  }

  // --- what operations look at
  MeshEditor<D>& editor() { return *this->editor_; }
  const SimplexMesh<D>& mesh() const { return this->editor_->mesh(); }
  const QualityModel<D, Shape>& model() const { return *this->model_; }
  const Switches& switches() const { return *this->switches_; }
  const Surface<D>* surface() const { return this->surface_; }
  const Caps<D>* caps() const { return this->caps_; }

  // --- what is asked
  /// The least gain over a worst quality q that makes a change worth it; less where all is tiny.
  double gain(double q) const
  {
    return std::min(this->gain_, std::max(1e-4 * this->gain_, 2 * this->gain_ * std::fabs(q)));
  }
  /// What has to be beaten where the worst is q.
  double required(double q) const { return q + this->gain(q); }
  /// A search for the place of nodes ends here: more than enough is not paid for.
  double enough(double q) const
  {
    constexpr double margin = 0.02; // above the target
    return std::max(this->target_ + margin, q + 2 * this->gain(q));
  }
  bool mayRemoveNodes() const { return this->switches_->removeNodes && this->growth.mayShrink(); }

  /// Towards which quality cells are lifted.
  void setTarget(double quality) { this->target_ = quality; }
  void setGain(double gain)
  {
    this->failuresSince_ = gain == this->gain_ ? this->failuresSince_ : this->editor_->clock();
    this->gain_ = gain;
  }
  /// No change may bring more bad cells than it takes away: otherwise many cells that are hardly
  /// better come for one that is worst. A cell under `quality` counts once, under two thirds of it
  /// twice, under one third three times. -1: no guard. Insertions are always guarded; `all`: so is
  /// every other change that does not take an inverted cell out.
  void setGuard(double quality, bool all = false)
  {
    this->guard_ = quality;
    this->guardsAll_ = all;
  }
  /// For meshes whose cells overlap. `tangled`: they may, and topology is looked at; `inverted`:
  /// some cells are inverted; `pinched`: see PinchedPoints.h, must live as long as the judge.
  void setTangled(bool tangled, bool inverted, const std::vector<std::uint8_t>& pinched)
  {
    this->tangled_ = tangled;
    this->inverted_ = inverted;
    this->pinched_ = &pinched;
  }
  bool hasInverted() const { return this->inverted_; }
  /// After a move the stars of all nodes around count as changed (MeshEditor::stamp()); else only the
  /// moved nodes are stamped.
  void setStampsStars(bool on) { this->stampsStars_ = on; }

  Growth growth;

  // --- transactions
  struct Mark
  {
    std::size_t journal;
    long growth, bad;
  };
  Mark begin() { return { this->editor_->begin(), this->growth.left, this->bad_ }; }
  void commit(const Mark& mark) { this->editor_->commit(mark.journal); }
  void rollback(const Mark& mark)
  {
    this->editor_->rollback(mark.journal);
    this->growth.left = mark.growth;
    this->bad_ = mark.bad;
  }
  /// Whether the changes since `mark` have brought no more bad cells than they took away.
  bool keepsGuard(const Mark& mark) const { return this->bad_ <= mark.bad; }

  // --- judging
  /// Computes the qualities of the cells that come. False as soon as one is not better than least.
  bool measure(Proposal<D>& p) const;
  /// Whether topology allows what comes; always true where cells do not overlap (setTangled()).
  bool fits(const Proposal<D>& p) const
  {
    return !this->tangled_ ||
      (fillsCavity<D>(this->mesh(), p.cavity, p.cells, p.keptChange()) &&
        !meetsOthers<D>(this->mesh(), p.cavity, p.cells, *this->pinched_));
  }
  /// Makes the change if it is acceptable. `also` is asked after nodes have moved, before their cells
  /// are judged.
  template <class Also>
  bool acceptIf(const Proposal<D>& p, Also&& also)
  {
    return p.moves.empty() ? this->replace(p) : this->move(p, also);
  }
  bool accept(const Proposal<D>& p)
  {
    return this->acceptIf(p, [] { return true; });
  }

  /// A new try begins: changed() is empty.
  void start() { this->changed_.clear(); }
  /// Cells that accepted changes have made, or whose quality they have changed, since start(); some
  /// may be dead.
  std::vector<Index>& changed() { return this->changed_; }

  /// How many of the cells of these qualities are bad, less those of the cavity; see setGuard().
  long badBalance(const std::vector<double>& qualities, const std::vector<Index>& cavity) const;

  // --- bookkeeping
  void count(Operation op, bool success)
  {
    ++this->tried[static_cast<int>(op)];
    this->done[static_cast<int>(op)] += success;
  }
  std::array<long, NumberOfOperations> tried{}, done{};

  /// Whether a try that failed at the time `failed` would fail again: nothing has changed since
  /// `stamp`. Failures within a transaction are not to be remembered: what is undone is another star.
  bool failsAgain(std::uint32_t failed, std::uint32_t stamp) const
  {
    return failed >= stamp && failed > this->failuresSince_;
  }

private:
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
  double guard_ = -1.0;
  bool guardsAll_ = false, stampsStars_ = true;
  std::uint32_t failuresSince_ = 0; ///< failures at a node before that were with another gain
  long bad_ = 0;                    ///< badness() of all cells made, less that of those removed
  bool tangled_ = false, inverted_ = false;
  const std::vector<std::uint8_t>* pinched_ = nullptr; // where tangled_
  std::vector<Index> changed_;
  std::vector<double> qualities_;
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
  const bool knows = !p.qualities.empty();
  if (!(p.newWorst > p.least) || !this->fits(p) ||
    !keepsEdges<D>(this->mesh(), p.cavity, p.cells, p.keptChange()) ||
    !this->growth.allows(p.growth()))
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
  // What happens within a transaction is judged at its end, by keepsGuard().
  if (this->guardsAll_ && bad > 0 && !this->editor_->inTransaction() &&
    this->mesh().worstQuality(p.cavity) > 0.0)
  {
    return false;
  }
  if (!this->editor_->replace(p.cavity, p.cells, qualities, p.keptChange()))
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
  const Mark mark = this->begin();
  for (const auto& m : p.moves)
  {
    this->editor_->movePoint(m.point, m.x);
    if (m.place.part != None)
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
    good = q > p.least && (q > 0.0 || !(p.keepsPositive && old > 0.0));
    bad += this->badness(q) - this->badness(old);
    this->editor_->setQuality(c, q);
  }
  if (!good || (this->guardsAll_ && bad > 0 && p.oldWorst > 0.0))
  {
    this->rollback(mark);
    return false;
  }
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
