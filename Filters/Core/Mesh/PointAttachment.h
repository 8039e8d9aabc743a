// SPDX-License-Identifier: BSD-3-Clause
/// @file PointAttachment.h
/// Values at the points of a mesh that are stored elsewhere. The editor's journal covers them, too.
#ifndef meshopt_Mesh_PointAttachment_h
#define meshopt_Mesh_PointAttachment_h

#include "Mesh/Types.h"

#include <memory>
#include <utility>
#include <vector>

namespace meshopt
{
/// A value at each point, such as the metric. The editor calls it when a point is placed, and
/// restores the value when a transaction is undone. Several editors may work at the same time, each
/// on its own points and with its own journal.
template <int D>
class PointAttachment
{
public:
  /// Earlier values, of one editor.
  class Journal
  {
  public:
    virtual ~Journal() = default;
    virtual void save(Index p) = 0; ///< pushes the value of p
    virtual void undo() = 0;        ///< pops the last value and restores it
    virtual void clear() = 0;
  };

  virtual ~PointAttachment() = default;
  virtual std::unique_ptr<Journal> makeJournal() = 0;
  /// Makes room for points 0 ... n - 1. Never called while several editors work.
  virtual void reserve(Index n) = 0;
  /// Called when point p, moved or new, is now at x. The point `near` is near x; it may be p
  /// itself.
  virtual void pointPlaced(Index p, const Vec<D>& x, Index near) = 0;
};

/// The journal of an attachment that has get() and set() for the value of a point.
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
