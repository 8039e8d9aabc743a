// SPDX-License-Identifier: BSD-3-Clause
/// @file QualityStatistics.h
/// Count, extremes, mean, spread, histogram and worst elements of a list of qualities.
///
/// Everything can be merged: parts (chunks, blocks, processes) are measured separately and merged
/// in a fixed order. The length of chunks does not depend on the number of threads, so that the
/// result has the same bits.
#ifndef meshopt_Quality_QualityStatistics_h
#define meshopt_Quality_QualityStatistics_h

#include <cstdint>
#include <limits>
#include <vector>

namespace meshopt
{
/// Length of the chunks that are summed separately.
inline constexpr std::int64_t StatisticsChunk = 4096;

/// Sums over a set of qualities. NaN values are counted separately and change nothing else.
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
  /// Adds n values in two passes over them. This is faster than one by one, but does not give the
  /// same bits.
  void add(const double* values, std::int64_t n);
  /// Adds the sums of another set, by Chan, Golub, LeVeque (1979): no cancellation if the spread is
  /// small.
  void merge(const QualityStatistics& other);
  /// Standard deviation of the whole set (divided by count, not count - 1); 0 if count = 0.
  double standardDeviation() const;
};

/// Counts of values in bins of equal width over [low, high]; the last bin includes `high`. Values
/// outside of the range go to the first or last bin, so that the counts add up. NaN values are not
/// counted.
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
  std::int64_t part = 0; ///< process, block, ...: ties go to the lower part
  std::int64_t id = 0;   ///< and then to the lower id

  bool operator<(const WorstElement& o) const
  {
    return this->quality != o.quality ? this->quality < o.quality
      : this->part != o.part          ? this->part < o.part
                                      : this->id < o.id;
  }
};

/// The n worst elements of a set: the same ones for any order of insertion.
class WorstElements
{
public:
  explicit WorstElements(std::size_t n)
    : size_(n)
  {
  }
  /// O(1) for most elements, O(log n) for those among the worst so far. Ignores NaN.
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
  std::vector<WorstElement> heap_; // a heap with the best of them in front
};
}

#endif
