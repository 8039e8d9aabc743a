// SPDX-License-Identifier: BSD-3-Clause
// The loop of section 2.2 around the Local Algorithm. Names in capitals in comments are those of
// the paper: KWORST, PREV, NL, M.
#include "Paper1996/GlobalAlgorithm.h"

#include "Paper1996/ClusterSolver.h"
#include "Paper1996/WorstQueue.h"
#include "Run/Run.h"

namespace meshopt
{
namespace
{
/// The Global Algorithm of section 2.2. Each turn repositions the cluster of the worst cell that
/// still has a node that may move.
template <int D, class Shape>
class GlobalAlgorithm
{
public:
  GlobalAlgorithm(
    const MeasuredMesh<D>& mesh, const Shape& shape, const RepositionParameters& parameters)
    : editor_(mesh.editor)
    , parameters_(parameters)
    , model_(mesh.editor.mesh(), mesh.metric, mesh.beta, shape)
    , judge_(mesh.editor, this->model_, this->switches_)
    , solver_(this->judge_, parameters.local, parameters.leastGain)
    , queue_(mesh.editor.mesh(), parameters.target)
  {
    // Nothing in this algorithm reads them.
    this->judge_.setStampsStars(false);
  }

  RepositionResult run(const KeepGoing& keepGoing, std::vector<Index>* sequence);

private:
  void initialize();
  bool solve(Index worst);

  MeshEditor<D>& editor_;
  RepositionParameters parameters_;
  Switches switches_;
  QualityModel<D, Shape> model_;
  Judge<D, Shape> judge_;
  ClusterSolver<D, Shape> solver_;
  WorstQueue<D> queue_;
  std::vector<std::uint8_t> movable_;
};

/// What is not free never moves. Others lose the right to move in step 2.
template <int D, class Shape>
void GlobalAlgorithm<D, Shape>::initialize()
{
  const SimplexMesh<D>& mesh = this->editor_.mesh();
  this->movable_.assign(mesh.numberOfPointSlots(), 0);
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    this->movable_[p] = mesh.isPointAlive(p) && mesh.isFree(p);
  }
  // All cells under the target; later ones come by solve().
  this->queue_.fill();
}

/// Steps 3 and 4 for the cluster of the worst cell; then its cells go into the queue again.
template <int D, class Shape>
bool GlobalAlgorithm<D, Shape>::solve(Index worst)
{
  if (!this->solver_.solve(worst, this->parameters_.neighborhoodLevel, this->movable_))
  {
    return false;
  }
  const Cluster<D>& cluster = this->solver_.cluster();
  for (std::size_t k = 0; k < cluster.cells.size(); ++k)
  {
    // The entries of the others in the queue are still right.
    if (cluster.quality[k] != this->solver_.oldQuality()[k])
    {
      this->queue_.push(cluster.cells[k]);
    }
  }
  return true;
}

/// The six steps of the paper, in its order.
template <int D, class Shape>
RepositionResult GlobalAlgorithm<D, Shape>::run(
  const KeepGoing& keepGoing, std::vector<Index>* sequence)
{
  RepositionResult result;
  const SimplexMesh<D>& mesh = this->editor_.mesh();
  this->initialize();
  // Elements whose nodes are all set aside are out of the search for good.
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
    if (worst == previous) // step 2: it has not been improved, so its nodes are set aside
    {
      for (Index p : mesh.nodes(worst))
      {
        this->movable_[p] = 0;
      }
      continue;
    }
    // Asked only before work: setting nodes aside costs nothing.
    if (keepGoing && !keepGoing(mesh.quality(worst)))
    {
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
RepositionResult reposition(const MeasuredMesh<D>& mesh, const RepositionParameters& parameters,
  const KeepGoing& keepGoing, std::vector<Index>* sequence)
{
  // While it lives, the editor tells the metric where nodes go.
  const FollowedMetric<D> follows(mesh.editor, mesh.metric);
  GlobalAlgorithm<D, AnyShape<D>> algorithm(mesh, anyShape<D>(mesh.measure), parameters);
  return algorithm.run(keepGoing, sequence);
}

template RepositionResult reposition<2>(
  const MeasuredMesh<2>&, const RepositionParameters&, const KeepGoing&, std::vector<Index>*);
template RepositionResult reposition<3>(
  const MeasuredMesh<3>&, const RepositionParameters&, const KeepGoing&, std::vector<Index>*);
}
