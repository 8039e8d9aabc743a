// SPDX-License-Identifier: BSD-3-Clause
// Sums over many cells that can be merged from parts: by chunk for threads, by rank for processes.
// All are exact but for rounding, and the order of merging is the caller's.
#include "Quality/QualityStatistics.h"

#include <algorithm>
#include <cmath>

namespace meshopt
{
void QualityStatistics::add(double value)
{
  if (std::isnan(value))
  {
    ++this->invalid;
    return;
  }
  ++this->count;
  this->inverted += value < 0.0 ? 1 : 0;
  this->minimum = std::min(this->minimum, value);
  this->maximum = std::max(this->maximum, value);
  const double d = value - this->mean;
  this->mean += d / static_cast<double>(this->count);
  // Welford's update: it does not cancel if the spread is small.
  this->squares += d * (value - this->mean);
}

/// Two plain loops, which the compiler can vectorize, in place of an update per value.
void QualityStatistics::add(const double* values, std::int64_t n)
{
  QualityStatistics part;
  double sum = 0.0;
  for (std::int64_t i = 0; i < n; ++i)
  {
    const double v = values[i];
    // v == v excludes NaN, and unlike std::isnan() it lets the loop be vectorized.
    if (v == v)
    {
      ++part.count;
      part.inverted += v < 0.0 ? 1 : 0;
      part.minimum = v < part.minimum ? v : part.minimum;
      part.maximum = v > part.maximum ? v : part.maximum;
      sum += v;
    }
  }
  // Counted by subtraction: one counter less in the loop.
  part.invalid = n - part.count;
  part.mean = part.count > 0 ? sum / static_cast<double>(part.count) : 0.0;
  for (std::int64_t i = 0; i < n; ++i)
  {
    // A pass of its own: around the mean, squares do not cancel.
    const double d = values[i] - part.mean;
    part.squares += values[i] == values[i] ? d * d : 0.0;
  }
  this->merge(part);
}

void QualityStatistics::merge(const QualityStatistics& other)
{
  this->invalid += other.invalid;
  if (other.count == 0)
  {
    return;
  }
  // Chan, Golub and LeVeque: squares around the common mean, from those around both means.
  const double a = static_cast<double>(this->count), b = static_cast<double>(other.count);
  const double d = other.mean - this->mean;
  this->count += other.count;
  this->inverted += other.inverted;
  this->minimum = std::min(this->minimum, other.minimum);
  this->maximum = std::max(this->maximum, other.maximum);
  // The first part is taken over bit for bit.
  this->mean = a == 0.0 ? other.mean : this->mean + d * (b / (a + b));
  this->squares += other.squares + d * d * (a * b / (a + b));
}

/// Of the whole set, not of a sample of it: divided by the count.
double QualityStatistics::standardDeviation() const
{
  return this->count == 0 ? 0.0 : std::sqrt(this->squares / static_cast<double>(this->count));
}

void QualityHistogram::add(double value)
{
  if (std::isnan(value) || this->counts.empty())
  {
    return;
  }
  const int last = static_cast<int>(this->counts.size()) - 1;
  const double width = this->high - this->low;
  // Without a range all values are in the first bin.
  const double place = width > 0.0 ? (value - this->low) / width * (last + 1) : 0.0;
  // Values beyond an end count in the bin there, and the upper end itself in the last one.
  ++this->counts[static_cast<int>(std::min<double>(last, std::max(0.0, std::floor(place))))];
}

/// Both have the same range and the same number of bins, or the sums mean nothing.
void QualityHistogram::merge(const QualityHistogram& other)
{
  for (std::size_t i = 0; i < this->counts.size() && i < other.counts.size(); ++i)
  {
    this->counts[i] += other.counts[i];
  }
}

double QualityHistogram::edge(int i) const
{
  const int n = static_cast<int>(this->counts.size());
  // The last edge exactly, not up to rounding.
  return i >= n ? this->high : this->low + (this->high - this->low) * (static_cast<double>(i) / n);
}

/// A heap of fixed size: a cell costs the logarithm of the number that is wanted, not of the mesh.
void WorstElements::insert(const WorstElement& e)
{
  // NaN has no order: it would break the heap.
  if (std::isnan(e.quality))
  {
    return;
  }
  if (this->heap_.size() == this->size_)
  {
    // The front of the heap is the best of the worst ones: it makes room.
    std::pop_heap(this->heap_.begin(), this->heap_.end());
    this->heap_.back() = e;
  }
  else
  {
    this->heap_.push_back(e);
  }
  std::push_heap(this->heap_.begin(), this->heap_.end());
}

void WorstElements::merge(const WorstElements& other)
{
  for (const WorstElement& e : other.heap_)
  {
    this->add(e);
  }
}

/// A copy, since a heap that is sorted would take no more elements.
std::vector<WorstElement> WorstElements::sorted() const
{
  std::vector<WorstElement> result = this->heap_;
  std::sort(result.begin(), result.end());
  return result;
}
}
