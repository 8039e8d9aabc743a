// SPDX-License-Identifier: BSD-3-Clause
/// @file QualityStatistics.h
/// Count, extremes, mean, spread, histogram and worst elements of a list of qualities.
///
/// Everything is mergeable: parts (chunks, blocks, processes) are measured by themselves and merged
/// in a fixed order. Chunks have a fixed length, whatever the number of threads, so that the same
/// bits come out.
#ifndef meshopt_Quality_QualityStatistics_h
#define meshopt_Quality_QualityStatistics_h

#include <cstdint>
#include <limits>
#include <vector>

namespace meshopt
{
/// Length of the chunks that are summed one by one.
inline constexpr std::int64_t StatisticsChunk = 4096;

/// Sums of a set of qualities. Values that are not a number are counted apart and change nothing
/// else.
struct QualityStatistics
{
  std::int64_t count = 0;                                    ///< numbers
  std::int64_t invalid = 0;                                  ///< values that are not a number
  std::int64_t inverted = 0;                                 ///< values < 0
  double minimum = std::numeric_limits<double>::infinity();  ///< +infinity if count = 0
  double maximum = -std::numeric_limits<double>::infinity(); ///< -infinity if count = 0
  double mean = 0.0;                                         ///< 0 if count = 0
  double squares = 0.0;                                      ///< sum of (value - mean)^2

  void add(double value);
  /// Adds n values in two passes over them, which is faster than one by one (and not the same
  /// bits).
  void add(const double* values, std::int64_t n);
  /// Adds another set's; by Chan, Golub, LeVeque (1979), which does not cancel where the spread is
  /// small.
  void merge(const QualityStatistics& other);
  /// Of the whole set (divided by count, not count - 1); 0 if count = 0.
  double standardDeviation() const;
};

/// Counts of values in bins of equal width over [low, high]; the last bin includes `high`. Values
/// out of the range, by rounding or otherwise, go to the first or last bin, such that the counts
/// add up; those that are not a number go nowhere.
struct QualityHistogram
{
  double low = 0.0, high = 1.0;
  std::vector<std::int64_t> counts;

  QualityHistogram(double l, double h, int bins)
    : low(l)
    , high(h)
    , counts(bins, 0)
  {
  }
  void add(double value);
  void merge(const QualityHistogram& other);
  /// Lower end of bin i; i = number of bins gives `high` exactly.
  double edge(int i) const;
};

/// One of the worst elements.
struct WorstElement
{
  double quality = 0.0;
  std::int64_t part = 0; ///< process, block, ...: ties go to the lower part,
  std::int64_t id = 0;   ///< then to the lower id

  bool operator<(const WorstElement& o) const
  {
    return this->quality != o.quality ? this->quality < o.quality
      : this->part != o.part          ? this->part < o.part
                                      : this->id < o.id;
  }
};

/// The n worst of a set, in any order of insertion the same ones.
class WorstElements
{
public:
  explicit WorstElements(std::size_t n)
    : size_(n)
  {
  }
  /// O(1) for most, O(log n) for those that are among the worst so far. Not a number is left out.
  void add(const WorstElement& e)
  {
    if (this->heap_.size() < this->size_ || (this->size_ > 0 && e < this->heap_.front()))
    {
      this->insert(e);
    }
  }
  void merge(const WorstElements& other);
  /// Worst first.
  std::vector<WorstElement> sorted() const;

private:
  void insert(const WorstElement& e);

  std::size_t size_;
  std::vector<WorstElement> heap_; // the best of them in front
};
}

#endif
