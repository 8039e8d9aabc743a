// SPDX-License-Identifier: BSD-3-Clause
/// @file PointAttachment.h
/// What belongs to the points of a mesh and is kept beside it: the editor's journal carries it, too.
#ifndef meshopt_Mesh_PointAttachment_h
#define meshopt_Mesh_PointAttachment_h

#include "Mesh/Types.h"

#include <memory>
#include <utility>
#include <vector>

namespace meshopt
{
/// A value at each point, such as the metric there. The editor tells when a point is placed, and
/// takes back what was changed by that where a transaction is undone. Several editors may be at work
/// at the same time, each at its own points; each has its own journal.
template <int D>
class PointAttachment
{
public:
  /// Values of before, of one editor.
  class Journal
  {
  public:
    virtual ~Journal() = default;
    virtual void save(Index p) = 0; ///< on top
    virtual void undo() = 0;        ///< takes the top off, and puts that value back
    virtual void clear() = 0;
  };

  virtual ~PointAttachment() = default;
  virtual std::unique_ptr<Journal> makeJournal() = 0;
  /// Makes room for points 0 ... n - 1. Never called while several editors are at work.
  virtual void reserve(Index n) = 0;
  /// Point p is at x now: it has moved or is new. x is near the place of the point `near`, which may
  /// be p itself.
  virtual void pointPlaced(Index p, const Vec<D>& x, Index near) = 0;
};

/// The journal of an attachment that can get() and set() the value of a point.
template <int D, class Attachment, class Value>
class ValueJournal final : public PointAttachment<D>::Journal
{
public:
  explicit ValueJournal(Attachment& attachment)
    : attachment_(&attachment)
  {
  }
  void save(Index p) override { this->values_.emplace_back(p, this->attachment_->get(p)); }
  void undo() override
  {
    this->attachment_->set(this->values_.back().first, this->values_.back().second);
    this->values_.pop_back();
  }
  void clear() override { this->values_.clear(); }

private:
  Attachment* attachment_;
  std::vector<std::pair<Index, Value>> values_;
};
}

#endif
