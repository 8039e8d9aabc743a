// SPDX-License-Identifier: BSD-3-Clause
// Lengths of edges in the wanted sizes, and how many of them are near 1.
#include "Metric/EdgeLengths.h"

#include "Base/SortUnique.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meshopt
{
double logMeanLength(double la, double lb)
{
  if (la == lb) // also 0 and infinity, whose ratio is not a number
  {
    return la;
  }
  // Near r = 0 the quotient cancels. The plain mean is then right to r^2 / 12, under 1e-9.
  const double r = std::log(la / lb);
  return std::fabs(r) < 1e-4 ? 0.5 * (la + lb) : (la - lb) / r;
}

double EdgeLengths::lowerEnd(std::size_t k)
{
  return std::exp2(static_cast<double>(k) / BinsPerOctave - Octaves);
}

/// As if both were one mesh: shares are weighted by the number of edges.
void EdgeLengths::add(const EdgeLengths& other)
{
  if (other.edges == 0)
  {
    return;
  }
  const long both = this->edges + other.edges;
  this->share = (this->share * static_cast<double>(this->edges) +
                  other.share * static_cast<double>(other.edges)) /
    static_cast<double>(both);
  this->shortest = this->edges > 0 ? std::min(this->shortest, other.shortest) : other.shortest;
  this->longest = std::max(this->longest, other.longest);
  for (std::size_t k = 0; k < this->histogram.size(); ++k)
  {
    this->histogram[k] += other.histogram[k];
  }
  this->edges = both;
}

/// The metric is known at the ends. Between them its length is taken to grow geometrically;
/// logMeanLength() is the integral of that.
template <int D>
double edgeLength(const SimplexMesh<D>& mesh, const NodalMetric<D>& metric, Index a, Index b)
{
  const Vec<D> e = mesh.point(b) - mesh.point(a);
  return logMeanLength(lengthIn<D>(metric.unitTensor(a), e), lengthIn<D>(metric.unitTensor(b), e));
}

template <int D>
EdgeLengths measureEdges(const SimplexMesh<D>& mesh, const NodalMetric<D>& metric)
{
  std::vector<std::array<Index, 2>> edges;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int e = 0; mesh.isAlive(c) && e < Local<D>::numberOfEdges; ++e)
    {
      const Index a = mesh.nodes(c)[Local<D>::edges[e][0]];
      const Index b = mesh.nodes(c)[Local<D>::edges[e][1]];
      edges.push_back({ std::min(a, b), std::max(a, b) });
    }
  }
  // Each edge counts once, though all cells around it have it.
  sortUnique(edges);
  EdgeLengths result;
  result.edges = static_cast<long>(edges.size());
  long inRange = 0;
  for (const std::array<Index, 2>& e : edges)
  {
    const double l = edgeLength<D>(mesh, metric, e[0], e[1]);
    // The usual range, from 1 / sqrt(2) to sqrt(2).
    inRange += l * l >= 0.5 && l * l <= 2.0;
    result.longest = std::max(result.longest, l);
    result.shortest = result.shortest > 0.0 ? std::min(result.shortest, l) : l;
    // A length of 0 has no logarithm: it counts in the first bin.
    const double bin = std::floor(
      EdgeLengths::BinsPerOctave * (std::log2(l > 1e-30 ? l : 1e-30) + EdgeLengths::Octaves));
    ++result.histogram[static_cast<std::size_t>(
      std::clamp(bin, 0.0, static_cast<double>(result.histogram.size() - 1)))];
  }
  result.share = edges.empty() ? 0.0
                               : static_cast<double>(inRange) / static_cast<double>(edges.size());
  return result;
}

template double edgeLength<2>(const SimplexMesh<2>&, const NodalMetric<2>&, Index, Index);
template double edgeLength<3>(const SimplexMesh<3>&, const NodalMetric<3>&, Index, Index);
template EdgeLengths measureEdges<2>(const SimplexMesh<2>&, const NodalMetric<2>&);
template EdgeLengths measureEdges<3>(const SimplexMesh<3>&, const NodalMetric<3>&);
}
