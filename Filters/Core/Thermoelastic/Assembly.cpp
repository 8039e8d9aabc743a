// SPDX-License-Identifier: BSD-3-Clause
// The matrix, row by row, from the cells around a point: each thread writes rows of its own.
#include "Thermoelastic/Assembly.h"

#include "Base/SortUnique.h"
#include "Thermoelastic/Parallel.h"

#include <Eigen/LU>

#include <algorithm>
#include <limits>
#include <new>

namespace meshopt::fem
{
namespace
{
/// Gradients of the shape functions are constant in a linear element, and so is its strain.
template <int D>
ElementGeometry<D> elementGeometry(const Corners<D>& x)
{
  Eigen::Matrix<double, D, D> edges;
  for (int i = 0; i < D; ++i)
  {
    edges.row(i) = (x[i + 1] - x[0]).transpose();
  }
  // Gradient i has the product 1 with edge i, and 0 with the others. All gradients add up to 0.
  // There is an inverse: check() refuses flat cells.
  const Eigen::Matrix<double, D, D> inverse = edges.inverse();
  ElementGeometry<D> g;
  g.volume = signedVolume(x);
  g.gradients[0].setZero();
  for (int i = 0; i < D; ++i)
  {
    g.gradients[i + 1] = inverse.col(i);
    g.gradients[0] -= inverse.col(i);
  }
  return g;
}

/// Finds the cells around each point, by counting.
template <int D>
Rows findCellsOfPoints(const SimplexMesh<D>& mesh)
{
  Rows rows;
  rows.offsets.assign(mesh.numberOfPointSlots() + 1, 0);
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (Index p : mesh.nodes(c))
    {
      ++rows.offsets[p + 1];
    }
  }
  for (std::size_t p = 1; p < rows.offsets.size(); ++p)
  {
    rows.offsets[p] += rows.offsets[p - 1];
  }
  // Filled in the order of the cells, which fixes the order of all later sums.
  rows.items.resize(rows.offsets.back());
  std::vector<Index> next(rows.offsets.begin(), rows.offsets.end() - 1);
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (Index p : mesh.nodes(c))
    {
      rows.items[next[p]++] = c;
    }
  }
  return rows;
}

/// Points that share a cell with point p, in ascending order and including p.
template <int D>
void findNeighbours(
  const SimplexMesh<D>& mesh, const Rows& cellsOfPoint, Index p, std::vector<Index>& neighbours)
{
  neighbours.clear();
  for (const Index* c = cellsOfPoint.begin(p); c != cellsOfPoint.end(p); ++c)
  {
    const Simplex<D>& nodes = mesh.nodes(*c);
    neighbours.insert(neighbours.end(), nodes.begin(), nodes.end());
  }
  // In rising order: so are the columns of the rows, as Eigen needs them.
  sortUnique(neighbours);
}

/// Block (i, j) of an element's matrix: the integral of B_i' C B_j, where all is constant. Products
/// are grouped so that block (j, i) is its exact transpose.
template <int D>
Tensor<D> stiffnessBlock(const ElementGeometry<D>& g, const Elasticity<D>& e, int i, int j)
{
  // Hooke's law for an isotropic material, by Lame's constants.
  const Vec<D>&gi = g.gradients[i], &gj = g.gradients[j];
  const double diagonal = e.mu * gi.dot(gj);
  Tensor<D> block;
  for (int a = 0; a < D; ++a)
  {
    for (int b = 0; b < D; ++b)
    {
      block(a, b) = g.volume *
        (e.lambda * (gi[a] * gj[b]) + e.mu * (gi[b] * gj[a]) + (a == b ? diagonal : 0.0));
    }
  }
  return block;
}

/// The part of the right-hand side at node i that comes from temperature and from the strain out of
/// the plane: both cause a stress without any displacement. Its forces change sides, and so signs.
template <int D>
Vec<D> initialForce(const Discretization<D>& d, Index cell, int i)
{
  const Elasticity<D>& e = d.elasticity(cell);
  // In plane stress the strain out of the plane follows from the stress, and is not given.
  const double normal = D == 2 && !e.planeStress ? d.outOfPlaneStrain : 0.0;
  const ElementGeometry<D>& g = d.elements[cell];
  return g.volume * (e.beta * d.rise(cell) - e.lambda * normal) * g.gradients[i];
}

/// Gathers the rows of one point after the other. By points and not by cells: no two threads add to
/// one entry, and each sum has a fixed order. The price: of blocks (i, j) and (j, i) of a cell both
/// are computed, though one is the transpose of the other.
template <int D>
class RowGatherer
{
public:
  RowGatherer(const SimplexMesh<D>& mesh, const Discretization<D>& d, const Unknowns& unknowns,
    const std::vector<Vec<D>>& forces, LinearSystem& system)
    : mesh_(mesh)
    , d_(d)
    , unknowns_(unknowns)
    , forces_(forces)
    , system_(system)
  {
  }

  void run(Index p)
  {
    // The buffers stay from point to point: no allocation in the loop.
    findNeighbours(this->mesh_, this->d_.cellsOfPoint, p, this->neighbours_);
    this->gather(p);
    for (int a = 0; a < D; ++a)
    {
      this->write(p, a);
    }
  }

private:
  /// A block for each neighbour of p, and the load at p.
  void gather(Index p)
  {
    this->blocks_.assign(this->neighbours_.size(), Tensor<D>::Zero());
    this->force_ = this->forces_.empty() ? Vec<D>(Vec<D>::Zero()) : this->forces_[p];
    const Rows& cells = this->d_.cellsOfPoint;
    for (const Index* c = cells.begin(p); c != cells.end(p); ++c)
    {
      // The cell is seen from p: p is its node i, its neighbours are its nodes j.
      const int i = this->mesh_.localIndex(*c, p);
      // neighbours_ is sorted: each block goes to the place of its column.
      for (int j = 0; j <= D; ++j)
      {
        const auto place = std::lower_bound(
          this->neighbours_.begin(), this->neighbours_.end(), this->mesh_.nodes(*c)[j]);
        this->blocks_[place - this->neighbours_.begin()] += stiffnessBlock(
          this->d_.elements[*c], this->d_.elasticity(*c), i, j);
      }
      this->force_ += initialForce(this->d_, *c, i);
    }
  }

  /// Row a of point p, into the place that assemble() has given to it. A prescribed component has
  /// no row: its equation gives the reaction, by internalForces().
  void write(Index p, int a)
  {
    const Index row = this->unknowns_.numbers[D * p + a];
    if (row == None)
    {
      return;
    }
    double right = this->force_[a];
    // Neighbours ascend, and so do the columns: a row is sorted as it is written.
    int next = this->system_.matrix.outerIndexPtr()[row];
    for (std::size_t k = 0; k < this->neighbours_.size(); ++k)
    {
      for (int b = 0; b < D; ++b)
      {
        const Index dof = D * this->neighbours_[k] + b;
        const double value = this->blocks_[k](a, b);
        // Known displacements go to the right-hand side.
        if (this->unknowns_.numbers[dof] == None)
        {
          right -= value * this->unknowns_.prescribed[dof];
          continue;
        }
        this->system_.matrix.innerIndexPtr()[next] = this->unknowns_.numbers[dof];
        this->system_.matrix.valuePtr()[next] = value;
        ++next;
      }
    }
    this->system_.right[row] = right;
  }

  const SimplexMesh<D>& mesh_;
  const Discretization<D>& d_;
  const Unknowns& unknowns_;
  const std::vector<Vec<D>>& forces_;
  LinearSystem& system_;
  std::vector<Index> neighbours_;
  std::vector<Tensor<D>> blocks_;
  Vec<D> force_;
};

/// Number of entries in the rows of each point: the same for all its components.
template <int D>
std::vector<int> countEntries(const SimplexMesh<D>& mesh, const Discretization<D>& d,
  const Unknowns& unknowns, const Control& control)
{
  std::vector<int> counts(mesh.numberOfPointSlots(), 0);
  parallelRanges(control, mesh.numberOfPointSlots(),
    [&](Index begin, Index end)
    {
      // Of each range, hence of each thread.
      std::vector<Index> neighbours;
      for (Index p = begin; p < end; ++p)
      {
        findNeighbours(mesh, d.cellsOfPoint, p, neighbours);
        for (Index q : neighbours)
        {
          for (int b = 0; b < D; ++b)
          {
            counts[p] += unknowns.numbers[D * q + b] != None ? 1 : 0;
          }
        }
      }
    });
  return counts;
}
}

/// All that depends on the mesh and on materials, once: matrix, stresses and reactions use it.
template <int D>
Discretization<D> discretize(
  const SimplexMesh<D>& mesh, const Problem<D>& problem, const Control& control)
{
  Discretization<D> d;
  const Index cells = mesh.numberOfCellSlots();
  d.outOfPlaneStrain = problem.outOfPlaneStrain;
  // One law for all cells, or one for each: as the materials are given.
  for (const Material& m : problem.materials)
  {
    d.materials.emplace_back(m, problem.planeState);
  }
  d.elements.resize(cells);
  d.temperatureRise.resize(problem.temperature.empty() ? 0 : cells);
  parallelRanges(control, cells,
    [&](Index begin, Index end)
    {
      for (Index c = begin; c < end; ++c)
      {
        d.elements[c] = elementGeometry<D>(mesh.corners(c));
        // One temperature per element, the mean of its nodes: the thermal strain is then constant,
        // as the strain is.
        // Differences are summed up: absolute temperatures could be large beside them.
        double sum = 0.0;
        for (int i = 0; i <= D && !problem.temperature.empty(); ++i)
        {
          sum += problem.temperature[mesh.nodes(c)[i]] - problem.referenceTemperature;
        }
        if (!problem.temperature.empty())
        {
          d.temperatureRise[c] = sum / (D + 1);
        }
      }
    });
  d.cellsOfPoint = findCellsOfPoints(mesh);
  return d;
}

/// In the order of points, so that a good numbering of points is one of the unknowns, too.
template <int D>
Unknowns numberUnknowns(const SimplexMesh<D>& mesh, const std::vector<Constraint>& constraints)
{
  Unknowns u;
  const std::size_t n = static_cast<std::size_t>(D) * mesh.numberOfPointSlots();
  u.prescribed.assign(n, 0.0);
  std::vector<std::uint8_t> isFixed(n, 0);
  for (const Constraint& c : constraints)
  {
    // The last constraint of a component holds: those of an end of the body can be replaced.
    isFixed[D * c.point + c.component] = 1;
    u.prescribed[D * c.point + c.component] = c.value;
  }
  u.numbers.assign(n, None);
  for (std::size_t dof = 0; dof < n; ++dof)
  {
    if (!isFixed[dof] && mesh.isPointAlive(static_cast<Index>(dof / D)))
    {
      u.numbers[dof] = u.count++;
    }
  }
  return u;
}

/// Two passes over the points: the first one counts the entries of each row, the second one fills
/// them in. Triplets, Eigen's usual way, would need several times the memory and one thread.
template <int D>
LinearSystem assemble(const SimplexMesh<D>& mesh, const Discretization<D>& d,
  const Unknowns& unknowns, const std::vector<Vec<D>>& forces, const Control& control)
{
  LinearSystem system;
  const std::vector<int> counts = countEntries(mesh, d, unknowns, control);
  system.right.resize(unknowns.count);
  system.matrix.resize(unknowns.count, unknowns.count);
  int* offsets = system.matrix.outerIndexPtr();
  offsets[0] = 0;
  for (std::size_t dof = 0; dof < unknowns.numbers.size(); ++dof)
  {
    const Index row = unknowns.numbers[dof];
    if (row == None)
    {
      continue;
    }
    // The place of each row is known before any is filled: threads then need not wait for each
    // other.
    if (offsets[row] > std::numeric_limits<int>::max() - counts[dof / D])
    {
      throw std::bad_alloc(); // 2^31 entries are 25 GB
    }
    offsets[row + 1] = offsets[row] + counts[dof / D];
  }
  // All at once: to insert entries one by one would move those behind them.
  system.matrix.resizeNonZeros(offsets[unknowns.count]);
  parallelRanges(control, mesh.numberOfPointSlots(),
    [&](Index begin, Index end)
    {
      // Each thread writes rows of its own points, and nothing else.
      RowGatherer<D> gatherer(mesh, d, unknowns, forces, system);
      for (Index p = begin; p < end; ++p)
      {
        if (mesh.isPointAlive(p))
        {
          gatherer.run(p);
        }
      }
    });
  return system;
}

/// From the gradient of the displacement, which is constant in each cell.
template <int D>
std::vector<Stress<D>> elementStresses(const SimplexMesh<D>& mesh, const Discretization<D>& d,
  const std::vector<Vec<D>>& displacement, const Control& control)
{
  std::vector<Stress<D>> stress(mesh.numberOfCellSlots());
  parallelRanges(control, mesh.numberOfCellSlots(),
    [&](Index begin, Index end)
    {
      for (Index c = begin; c < end; ++c)
      {
        // Of the displacement: sum of u_i times the gradient of the shape function N_i.
        Tensor<D> gradient = Tensor<D>::Zero();
        for (int i = 0; i <= D; ++i)
        {
          gradient += displacement[mesh.nodes(c)[i]] * d.elements[c].gradients[i].transpose();
        }
        stress[c] = d.elasticity(c).stress(gradient, d.rise(c), d.outOfPlaneStrain);
      }
    });
  return stress;
}

/// Gathered by point, as the matrix is: no two threads add to the same sum.
template <int D>
std::vector<Vec<D>> internalForces(const SimplexMesh<D>& mesh, const Discretization<D>& d,
  const std::vector<Stress<D>>& stress, const Control& control)
{
  std::vector<Vec<D>> forces(mesh.numberOfPointSlots(), Vec<D>::Zero());
  parallelRanges(control, mesh.numberOfPointSlots(),
    [&](Index begin, Index end)
    {
      for (Index p = begin; p < end; ++p)
      {
        for (const Index* c = d.cellsOfPoint.begin(p); c != d.cellsOfPoint.end(p); ++c)
        {
          // The transpose of the assembly: internal forces balance the loads where nothing is
          // prescribed.
          // In 2D the stress along the normal does no work in the plane.
          const Tensor<3> s = toTensor<D>(stress[*c]);
          const ElementGeometry<D>& g = d.elements[*c];
          forces[p] += g.volume *
            (s.template topLeftCorner<D, D>() * g.gradients[mesh.localIndex(*c, p)]);
        }
      }
    });
  return forces;
}

/// Eigen's own product does not use the caller's threads.
void multiply(
  const SparseMatrix& a, const Eigen::VectorXd& x, const Control& control, Eigen::VectorXd& y)
{
  const int* offsets = a.outerIndexPtr();
  const int* columns = a.innerIndexPtr();
  const double* values = a.valuePtr();
  const double* from = x.data();
  double* to = y.data();
  // Rows are summed in order, whoever does it: any number of threads gives the same bits.
  parallelRanges(control, static_cast<Index>(a.rows()),
    [=](Index begin, Index end)
    {
      for (Index row = begin; row < end; ++row)
      {
        double sum = 0.0;
        for (int k = offsets[row]; k < offsets[row + 1]; ++k)
        {
          sum += values[k] * from[columns[k]];
        }
        to[row] = sum;
      }
    });
}

template Discretization<2> discretize<2>(const SimplexMesh<2>&, const Problem<2>&, const Control&);
template Discretization<3> discretize<3>(const SimplexMesh<3>&, const Problem<3>&, const Control&);
template Unknowns numberUnknowns<2>(const SimplexMesh<2>&, const std::vector<Constraint>&);
template Unknowns numberUnknowns<3>(const SimplexMesh<3>&, const std::vector<Constraint>&);
template LinearSystem assemble<2>(const SimplexMesh<2>&, const Discretization<2>&, const Unknowns&,
  const std::vector<Vec<2>>&, const Control&);
template LinearSystem assemble<3>(const SimplexMesh<3>&, const Discretization<3>&, const Unknowns&,
  const std::vector<Vec<3>>&, const Control&);
template std::vector<Stress<2>> elementStresses<2>(
  const SimplexMesh<2>&, const Discretization<2>&, const std::vector<Vec<2>>&, const Control&);
template std::vector<Stress<3>> elementStresses<3>(
  const SimplexMesh<3>&, const Discretization<3>&, const std::vector<Vec<3>>&, const Control&);
template std::vector<Vec<2>> internalForces<2>(
  const SimplexMesh<2>&, const Discretization<2>&, const std::vector<Stress<2>>&, const Control&);
template std::vector<Vec<3>> internalForces<3>(
  const SimplexMesh<3>&, const Discretization<3>&, const std::vector<Stress<3>>&, const Control&);
}
