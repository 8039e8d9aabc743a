// SPDX-License-Identifier: BSD-3-Clause
// Patch recovery and the error estimate. Points are split where regions meet, so that no patch
// looks across a jump of the stress.
#include "Thermoelastic/StressRecovery.h"

#include "Base/SortUnique.h"
#include "Metric/SymmetricEigen.h"
#include "Thermoelastic/Parallel.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace meshopt::fem
{
namespace
{
/// Greatest number of layers of cells in a patch around a point.
constexpr int MostLayers = 4;
/// Least ratio of the squared extents of the centroids of a patch, in its thinnest and its widest
/// direction. Below it the patch counts as flat and determines no polynomial.
constexpr double ThinnestPatch = 1e-6;

template <int D>
Vec<D> centroid(const SimplexMesh<D>& mesh, Index cell)
{
  Vec<D> sum = Vec<D>::Zero();
  for (Index p : mesh.nodes(cell))
  {
    sum += mesh.point(p);
  }
  return sum / (D + 1);
}

/// A linear polynomial: mean + slope (x - centre). The centre is the mean of the sample points:
/// constant and slope then decouple.
template <int D>
struct Fit
{
  Vec<D> centre = Vec<D>::Zero();
  Stress<D> mean = Stress<D>::Zero();
  Eigen::Matrix<double, StressSize<D>, D, Eigen::DontAlign> slope;
  bool isValid = false;

  Stress<D> at(const Vec<D>& x) const { return this->mean + this->slope * (x - this->centre); }
};

/// The linear polynomial nearest to the stresses at the centroids, by least squares: there the
/// stress of linear elements is more accurate than elsewhere. It is not valid with fewer than
/// `leastCells` cells, or if these lie in a plane (2D: on a line).
template <int D>
Fit<D> fitPatch(const std::vector<Vec<D>>& centroids, const std::vector<Stress<D>>& stress,
  const Index* begin, const Index* end, Index leastCells)
{
  Fit<D> fit;
  const Index n = static_cast<Index>(end - begin);
  if (n < leastCells)
  {
    return fit;
  }
  for (const Index* c = begin; c != end; ++c)
  {
    fit.centre += centroids[*c];
    fit.mean += stress[*c];
  }
  fit.centre /= n;
  fit.mean /= n;
  // Normal equations around the mean: slope = sum (s - mean) d' (sum d d')^-1.
  Tensor<D> spread = Tensor<D>::Zero();
  fit.slope.setZero();
  for (const Index* c = begin; c != end; ++c)
  {
    const Vec<D> d = centroids[*c] - fit.centre;
    spread += d * d.transpose();
    fit.slope += (stress[*c] - fit.mean) * d.transpose();
  }
  const Eigen::Matrix<double, D, D> aligned = spread;
  const Vec<D> extent = SymmetricEigen<D>::of(spread).values; // squares of widths
  // Only the ratio of extents matters, so that the test does not depend on units.
  fit.isValid = extent[0] > ThinnestPatch * extent[D - 1];
  if (fit.isValid)
  {
    // Evaluated before it is assigned: the product reads what it writes.
    fit.slope = (fit.slope * aligned.inverse()).eval();
  }
  return fit;
}

/// By volume: the division of a cell into two changes nothing.
template <int D>
Stress<D> volumeAverage(const SimplexMesh<D>& mesh, const std::vector<Stress<D>>& stress,
  const Index* begin, const Index* end)
{
  Stress<D> sum = Stress<D>::Zero();
  double volume = 0.0;
  for (const Index* c = begin; c != end; ++c)
  {
    const double v = signedVolume(mesh.corners(*c));
    sum += v * stress[*c];
    volume += v;
  }
  return sum / volume;
}

/// Fits at the nodes that have a patch of their own; the other nodes are derived from these.
template <int D>
class PatchRecovery
{
public:
  /// A fit needs as many cells as a linear polynomial has coefficients; a local one, as many as a
  /// quadratic one has: on the surface, where it looks to one side only, a fit through hardly more
  /// values than coefficients would follow their errors.
  PatchRecovery(const SimplexMesh<D>& mesh, const RecoveryMesh<D>& nodes,
    const std::vector<Stress<D>>& stress, bool isLocal)
    : mesh_(mesh)
    , nodes_(nodes)
    , stress_(stress)
    , isLocal_(isLocal)
    , leastCells_(isLocal ? (D + 1) * (D + 2) / 2 : D + 1)
    , centroids_(mesh.numberOfCellSlots())
    , fits_(nodes.count())
  {
    // Once: each cell is in the patches of several nodes.
    for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
    {
      this->centroids_[c] = centroid(mesh, c);
    }
  }

  /// For the nodes [begin, end): different threads write different fits.
  void fitOwn(Index begin, Index end)
  {
    for (Index n = begin; n < end; ++n)
    {
      // On the surface a patch is one-sided: by default such nodes take what the interior ones say.
      if (this->isLocal_ || !this->nodes_.isOnSurface[n])
      {
        const Rows& cells = this->nodes_.cellsOfNode;
        this->fits_[n] = fitPatch(
          this->centroids_, this->stress_, cells.begin(n), cells.end(n), this->leastCells_);
      }
    }
  }

  /// By the node's own fit, if it is valid.
  Stress<D> at(Index node) const
  {
    const Vec<D>& x = this->mesh_.point(this->nodes_.pointOfNode[node]);
    if (this->fits_[node].isValid)
    {
      return this->fits_[node].at(x);
    }
    return this->isLocal_ ? this->byEnlargedPatch(node, x) : this->byNeighbours(node, x);
  }

private:
  /// The mean of what the fits of the nodes around say at x, as Zienkiewicz and Zhu advise for the
  /// surface.
  Stress<D> byNeighbours(Index node, const Vec<D>& x) const
  {
    Stress<D> sum = Stress<D>::Zero();
    int count = 0;
    const Rows& cells = this->nodes_.cellsOfNode;
    // In ascending order, so that the sum always has the same bits.
    for (Index n : this->nodesAround(cells.begin(node), cells.end(node)))
    {
      if (this->fits_[n].isValid)
      {
        sum += this->fits_[n].at(x);
        ++count;
      }
    }
    // No interior neighbour has a fit, as in thin parts: only then the node's own surroundings.
    return count > 0 ? Stress<D>(sum / count) : this->byEnlargedPatch(node, x);
  }

  /// Nodes of the cells [begin, end), ascending.
  std::vector<Index> nodesAround(const Index* begin, const Index* end) const
  {
    std::vector<Index> around;
    for (const Index* c = begin; c != end; ++c)
    {
      around.insert(around.end(), this->nodes_.cells[*c].begin(), this->nodes_.cells[*c].end());
    }
    sortUnique(around);
    return around;
  }

  /// By the smallest enlarged patch that determines a polynomial. It grows over nodes, which belong
  /// to one region each: so it does not leave the region.
  Stress<D> byEnlargedPatch(Index node, const Vec<D>& x) const
  {
    const Rows& cells = this->nodes_.cellsOfNode;
    std::vector<Index> around = this->nodesAround(cells.begin(node), cells.end(node));
    // Layer by layer, since a larger patch smooths more.
    for (int layer = 1; layer < MostLayers; ++layer)
    {
      std::vector<Index> patch;
      for (Index n : around)
      {
        patch.insert(patch.end(), cells.begin(n), cells.end(n));
      }
      sortUnique(patch);
      const Index* end = patch.data() + patch.size();
      const Fit<D> fit = fitPatch(
        this->centroids_, this->stress_, patch.data(), end, this->leastCells_);
      if (fit.isValid)
      {
        return fit.at(x);
      }
      around = this->nodesAround(patch.data(), end);
    }
    // As in a region of a few cells: no patch in it determines a slope.
    return volumeAverage(this->mesh_, this->stress_, cells.begin(node), cells.end(node));
  }

  const SimplexMesh<D>& mesh_;
  const RecoveryMesh<D>& nodes_;
  const std::vector<Stress<D>>& stress_;
  bool isLocal_;
  Index leastCells_;
  std::vector<Vec<D>> centroids_;
  std::vector<Fit<D>> fits_;
};

/// A corner of a cell as (point, region). Sorted, equal pairs are neighbours and make one node.
struct Corner
{
  Index point, region, cell;
  int local;
  bool operator<(const Corner& o) const
  {
    // The cell last: sums over the cells of a node then have one order.
    return this->point != o.point ? this->point < o.point
      : this->region != o.region  ? this->region < o.region
                                  : this->cell < o.cell;
  }
};
}

/// By sorting: the cells of a node then stand together, as cellsOfNode has them.
template <int D>
RecoveryMesh<D> makeRecoveryMesh(const SimplexMesh<D>& mesh)
{
  RecoveryMesh<D> nodes;
  const Index cells = mesh.numberOfCellSlots();
  std::vector<Corner> corners;
  corners.reserve(static_cast<std::size_t>(cells) * (D + 1));
  for (Index c = 0; c < cells; ++c)
  {
    for (int i = 0; i <= D; ++i)
    {
      corners.push_back({ mesh.nodes(c)[i], mesh.region(c), c, i });
    }
  }
  // By point first: stressAtPoints() needs the nodes of one point in a row.
  std::sort(corners.begin(), corners.end());
  nodes.cells.resize(cells);
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    const Corner& corner = corners[k];
    if (k == 0 || corner.point != corners[k - 1].point || corner.region != corners[k - 1].region)
    {
      nodes.pointOfNode.push_back(corner.point);
      nodes.cellsOfNode.offsets.push_back(static_cast<Index>(k));
    }
    nodes.cells[corner.cell][corner.local] = nodes.count() - 1;
    nodes.cellsOfNode.items.push_back(corner.cell);
  }
  nodes.cellsOfNode.offsets.push_back(static_cast<Index>(corners.size()));
  nodes.isOnSurface.assign(nodes.pointOfNode.size(), 0);
  for (Index c = 0; c < cells; ++c)
  {
    for (int i = 0; i <= D; ++i)
    {
      const Index other = mesh.adjacent(c, i);
      // A facet between regions counts as surface on both sides: stress may jump there.
      const bool isInside = other != None &&
        mesh.region(SimplexMesh<D>::cellOf(other)) == mesh.region(c);
      for (int k = 0; k < D && !isInside; ++k)
      {
        nodes.isOnSurface[nodes.cells[c][Local<D>::facets[i][k]]] = 1;
      }
    }
  }
  return nodes;
}

template <int D>
std::vector<Stress<D>> recoverStress(const SimplexMesh<D>& mesh, const RecoveryMesh<D>& nodes,
  const std::vector<Stress<D>>& elementStress, StressRecovery method, const Control& control)
{
  std::vector<Stress<D>> stress(nodes.count());
  if (method == StressRecovery::VolumeAverage)
  {
    parallelRanges(control, nodes.count(),
      [&](Index begin, Index end)
      {
        for (Index n = begin; n < end; ++n)
        {
          stress[n] = volumeAverage(
            mesh, elementStress, nodes.cellsOfNode.begin(n), nodes.cellsOfNode.end(n));
        }
      });
    return stress;
  }
  // Two loops over the nodes: the second one reads fits of other nodes.
  PatchRecovery<D> recovery(mesh, nodes, elementStress, method == StressRecovery::LocalPatch);
  parallelRanges(
    control, nodes.count(), [&](Index begin, Index end) { recovery.fitOwn(begin, end); });
  parallelRanges(control, nodes.count(),
    [&](Index begin, Index end)
    {
      for (Index n = begin; n < end; ++n)
      {
        stress[n] = recovery.at(n);
      }
    });
  return stress;
}

/// Nodes of one point stand in a row: see makeRecoveryMesh().
template <int D>
std::vector<Stress<D>> stressAtPoints(const SimplexMesh<D>& mesh, const RecoveryMesh<D>& nodes,
  const std::vector<Stress<D>>& nodalStress)
{
  std::vector<Stress<D>> stress(mesh.numberOfPointSlots(), Stress<D>::Zero());
  for (Index first = 0; first < nodes.count();)
  {
    const Index point = nodes.pointOfNode[first];
    Index last = first;
    double volume = 0.0;
    // Cells of several regions meet here: by volume, as if the regions were one.
    Stress<D> sum = Stress<D>::Zero();
    for (; last < nodes.count() && nodes.pointOfNode[last] == point; ++last)
    {
      double v = 0.0;
      for (const Index* c = nodes.cellsOfNode.begin(last); c != nodes.cellsOfNode.end(last); ++c)
      {
        v += signedVolume(mesh.corners(*c));
      }
      sum += v * nodalStress[last];
      volume += v;
    }
    // In a single region the value stays as it is, without rounding by the division.
    stress[point] = last == first + 1 ? nodalStress[first] : Stress<D>(sum / volume);
    first = last;
  }
  return stress;
}

template <int D>
std::vector<double> estimateErrors(const SimplexMesh<D>& mesh, const Problem<D>& problem,
  const Discretization<D>& d, const RecoveryMesh<D>& nodes,
  const std::vector<Stress<D>>& elementStress, const std::vector<Stress<D>>& nodalStress,
  const Control& control)
{
  std::vector<double> errors(mesh.numberOfCellSlots());
  parallelRanges(control, mesh.numberOfCellSlots(),
    [&](Index begin, Index end)
    {
      for (Index c = begin; c < end; ++c)
      {
        // For linear e: integral of q(e) = V / ((D + 1) (D + 2)) (sum of q(e_i) + q(sum of e_i)).
        const Elasticity<D>& law = d.elasticity(c);
        Stress<D> sum = Stress<D>::Zero();
        double squares = 0.0;
        for (int i = 0; i <= D; ++i)
        {
          // The linear temperature makes the stress of the solution linear in the cell.
          const double here = problem.temperature.empty()
            ? 0.0
            : problem.temperature[mesh.nodes(c)[i]] - problem.referenceTemperature - d.rise(c);
          // The recovered stress minus that of the solution, at the corner.
          const Stress<D> e = nodalStress[nodes.cells[c][i]] -
            (elementStress[c] + law.thermalStress(here));
          sum += e;
          squares += law.energyProduct(e);
        }
        // Rounding may make a sum of squares that cancel less than 0: its root would be NaN.
        errors[c] = std::sqrt(std::max(
          0.0, d.elements[c].volume * (squares + law.energyProduct(sum)) / ((D + 1) * (D + 2))));
      }
    });
  return errors;
}

template RecoveryMesh<2> makeRecoveryMesh<2>(const SimplexMesh<2>&);
template RecoveryMesh<3> makeRecoveryMesh<3>(const SimplexMesh<3>&);
template std::vector<Stress<2>> recoverStress<2>(const SimplexMesh<2>&, const RecoveryMesh<2>&,
  const std::vector<Stress<2>>&, StressRecovery, const Control&);
template std::vector<Stress<3>> recoverStress<3>(const SimplexMesh<3>&, const RecoveryMesh<3>&,
  const std::vector<Stress<3>>&, StressRecovery, const Control&);
template std::vector<Stress<2>> stressAtPoints<2>(
  const SimplexMesh<2>&, const RecoveryMesh<2>&, const std::vector<Stress<2>>&);
template std::vector<Stress<3>> stressAtPoints<3>(
  const SimplexMesh<3>&, const RecoveryMesh<3>&, const std::vector<Stress<3>>&);
template std::vector<double> estimateErrors<2>(const SimplexMesh<2>&, const Problem<2>&,
  const Discretization<2>&, const RecoveryMesh<2>&, const std::vector<Stress<2>>&,
  const std::vector<Stress<2>>&, const Control&);
template std::vector<double> estimateErrors<3>(const SimplexMesh<3>&, const Problem<3>&,
  const Discretization<3>&, const RecoveryMesh<3>&, const std::vector<Stress<3>>&,
  const std::vector<Stress<3>>&, const Control&);
}
