// SPDX-License-Identifier: BSD-3-Clause
#include "Reposition/GlobalAlgorithm.h"

#include "Mesh/WorstQueue.h"

#include <cmath>
#include <limits>

namespace meshopt
{
namespace
{
template <int D, class Shape>
class GlobalAlgorithm
{
public:
  GlobalAlgorithm(MeshEditor<D>& editor, NodalMetric<D>& metric,
    const ElementQuality<D, Shape>& quality, const RepositionParameters& parameters)
    : editor_(editor)
    , metric_(metric)
    , quality_(quality)
    , parameters_(parameters)
    , gatherer_(editor)
    , local_(quality, parameters.local)
    , queue_(editor.mesh(), parameters.target, parameters.naiveSearch)
  {
  }

  RepositionResult run(const KeepGoing& keepGoing, std::vector<Index>* sequence);

private:
  void initialize();
  void setMetrics();
  bool solve(Index worst);
  bool accept();
  bool isGain(double before, double after) const
  {
    return after > before + this->parameters_.leastGain * std::abs(before);
  }

  MeshEditor<D>& editor_;
  NodalMetric<D>& metric_;
  ElementQuality<D, Shape> quality_;
  RepositionParameters parameters_;
  ClusterGatherer<D> gatherer_;
  LocalAlgorithm<D, Shape> local_;
  WorstQueue<D> queue_;
  std::vector<std::uint8_t> movable_;
  Cluster<D> cluster_;
  std::vector<double> oldQuality_;
  std::vector<ElementMetric<D>> metrics_;
};

template <int D, class Shape>
void GlobalAlgorithm<D, Shape>::initialize()
{
  const SimplexMesh<D>& mesh = this->editor_.mesh();
  this->movable_.assign(mesh.numberOfPointSlots(), 0);
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    this->movable_[p] = mesh.isPointAlive(p) && !mesh.isFixed(p);
  }
  this->queue_.fill();
}

// The metric of each element, frozen while the cluster is solved; a single one where it is the same everywhere.
template <int D, class Shape>
void GlobalAlgorithm<D, Shape>::setMetrics()
{
  const SimplexMesh<D>& mesh = this->editor_.mesh();
  this->metrics_.clear();
  const std::size_t count = this->metric_.isTrivial() ? 1 : this->cluster_.cells.size();
  for (std::size_t k = 0; k < count; ++k)
  {
    this->metrics_.push_back(this->metric_.element(mesh.nodes(this->cluster_.cells[k])));
  }
}

template <int D, class Shape>
bool GlobalAlgorithm<D, Shape>::solve(Index worst)
{
  this->gatherer_.gather(
    worst, this->parameters_.neighborhoodLevel, this->movable_, this->cluster_);
  this->setMetrics();
  this->oldQuality_ = this->cluster_.quality;
  const LocalResult result = this->local_.solve(this->cluster_, this->metrics_);
  if (!this->isGain(result.before, result.after))
  {
    return false;
  }
  const std::size_t place = this->editor_.begin();
  for (int k = 0; k < this->cluster_.numberOfMoving; ++k)
  {
    const Index p = this->cluster_.points[k];
    if (this->cluster_.x[k] != this->editor_.mesh().point(p))
    {
      this->editor_.movePoint(p, this->cluster_.x[k]);
    }
  }
  if (!this->accept())
  {
    this->editor_.rollback(place);
    for (int k = 0; k < this->cluster_.numberOfMoving; ++k)
    {
      const Index p = this->cluster_.points[k];
      this->metric_.resample(p, this->editor_.mesh().point(p));
    }
    return false;
  }
  this->editor_.commit(place);
  for (std::size_t k = 0; k < this->cluster_.cells.size(); ++k)
  {
    if (this->cluster_.quality[k] != this->oldQuality_[k])
    {
      this->queue_.push(this->cluster_.cells[k]);
    }
  }
  return true;
}

// Sets the qualities of the cluster; with a metric that varies, those in the metric as it is now.
template <int D, class Shape>
bool GlobalAlgorithm<D, Shape>::accept()
{
  Cluster<D>& cluster = this->cluster_;
  if (!this->metric_.isTrivial())
  {
    for (int k = 0; k < cluster.numberOfMoving; ++k)
    {
      this->metric_.resample(cluster.points[k], cluster.x[k]);
    }
    double before = std::numeric_limits<double>::infinity(), after = before;
    bool inverts = false;
    for (std::size_t k = 0; k < cluster.cells.size(); ++k)
    {
      const Index c = cluster.cells[k];
      const double q = this->quality_.value(
        cluster.corners(static_cast<int>(k)), this->metric_.element(this->editor_.mesh().nodes(c)));
      cluster.quality[k] = q;
      before = std::min(before, this->oldQuality_[k]);
      after = q < after || q != q ? q : after;
      inverts = inverts || (!(q > 0.0) && this->oldQuality_[k] > 0.0);
    }
    if (inverts || !this->isGain(before, after))
    {
      return false;
    }
  }
  for (std::size_t k = 0; k < cluster.cells.size(); ++k)
  {
    if (cluster.quality[k] != this->oldQuality_[k])
    {
      this->editor_.setQuality(cluster.cells[k], cluster.quality[k]);
    }
  }
  return true;
}

template <int D, class Shape>
RepositionResult GlobalAlgorithm<D, Shape>::run(
  const KeepGoing& keepGoing, std::vector<Index>* sequence)
{
  RepositionResult result;
  const SimplexMesh<D>& mesh = this->editor_.mesh();
  this->initialize();
  const auto hasMovableNode = [&](Index c)
  {
    bool any = false;
    for (Index p : mesh.nodes(c))
    {
      any = any || this->movable_[p];
    }
    return any;
  };
  Index previous = None; // PREV
  for (;;)
  {
    const Index worst = this->queue_.worst(hasMovableNode); // step 1
    if (worst == None)
    {
      return result;
    }
    if (sequence)
    {
      sequence->push_back(worst);
    }
    if (worst == previous) // step 2
    {
      for (Index p : mesh.nodes(worst))
      {
        this->movable_[p] = 0;
      }
      continue;
    }
    if (keepGoing && !keepGoing(mesh.quality(worst)))
    {
      result.cancelled = true;
      return result;
    }
    ++result.tried;
    result.done += this->solve(worst) ? 1 : 0; // steps 3 and 4
    previous = worst;                          // step 5
    const long limit = this->parameters_.maximumNumberOfIterations;
    if (limit > 0 && result.tried >= limit) // step 6
    {
      result.limitReached = true;
      return result;
    }
  }
}
}

template <int D>
RepositionResult reposition(MeshEditor<D>& editor, NodalMetric<D>& metric, Measure measure,
  double beta, const RepositionParameters& parameters, const KeepGoing& keepGoing,
  std::vector<Index>* sequence)
{
  return dispatch<D>(measure,
    [&](auto shape)
    {
      using Shape = decltype(shape);
      const ElementQuality<D, Shape> quality{ beta };
      GlobalAlgorithm<D, Shape> algorithm(editor, metric, quality, parameters);
      return algorithm.run(keepGoing, sequence);
    });
}

template RepositionResult reposition<2>(MeshEditor<2>&, NodalMetric<2>&, Measure, double,
  const RepositionParameters&, const KeepGoing&, std::vector<Index>*);
template RepositionResult reposition<3>(MeshEditor<3>&, NodalMetric<3>&, Measure, double,
  const RepositionParameters&, const KeepGoing&, std::vector<Index>*);
}
