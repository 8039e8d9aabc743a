// SPDX-License-Identifier: BSD-3-Clause
// Recovery by the paper's (5.4), with the boundary as a second step: the weak form says nothing
// there, so values are carried from the inside to the boundary as smoothly as possible.
#include "Metric/HessianRecovery.h"

#include "Metric/LeastSquaresHessian.h"

#include <Eigen/LU>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace meshopt
{
namespace
{
/// Gradients of the basis functions on a cell, which are constant there.
template <int D>
struct BasisGradients
{
  bool isFlat = false; ///< then there are no gradients
  double volume = 0.0; ///< signed
  double length = 0.0; ///< longest edge
  Vec<D> of[D + 1];

  explicit BasisGradients(const Corners<D>& x)
  {
    Eigen::Matrix<double, D, D> edges; // rows: x_i - x_0
    for (int i = 0; i < D; ++i)
    {
      edges.row(i) = (x[i + 1] - x[0]).transpose();
    }
    for (const auto& e : Local<D>::edges)
    {
      this->length = std::max(this->length, (x[e[0]] - x[e[1]]).norm());
    }
    this->volume = signedVolume(x);
    // Relative to the longest edge, so that the test does not depend on units.
    this->isFlat = !(std::abs(this->volume) > 1e-14 * std::pow(this->length, D));
    if (!this->isFlat)
    {
      // Gradient i has the product 1 with edge i, and 0 with the others: a column of the inverse.
      // The basis functions add up to 1, so their gradients add up to 0.
      const Eigen::Matrix<double, D, D> inverse = edges.inverse();
      this->of[0].setZero();
      for (int i = 0; i < D; ++i)
      {
        this->of[i + 1] = inverse.col(i);
        this->of[0] -= inverse.col(i);
      }
    }
  }
};

/// Hessians by (5.4) at all points. Each is a row of the symmetric tensor's D (D + 1) / 2 numbers.
template <int D>
class LumpedMassRecovery
{
public:
  static constexpr int Numbers = D * (D + 1) / 2;

  LumpedMassRecovery(const SimplexMesh<D>& mesh, const std::vector<double>& values, int components)
    : mesh_(mesh)
    , values_(values)
    , components_(components)
    , rows_(Rows::Zero(mesh.numberOfPointSlots(), Numbers * components))
    , unknown_(mesh.numberOfPointSlots(), None)
  {
  }

  std::string run(std::vector<Tensor<D>>& hessians)
  {
    // First, since integrate() numbers these points as unknowns.
    this->markBoundary();
    this->integrate();
    std::string error = this->findUnreached();
    if (error.empty() && this->numberOfUnknowns_ > 0)
    {
      this->extrapolate();
    }
    if (error.empty())
    {
      this->unpack(hessians);
    }
    return error;
  }

private:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  void markBoundary();
  void integrate();
  void addCell(Index c, std::vector<double>& mass);
  std::string findUnreached() const;
  void extrapolate();
  void unpack(std::vector<Tensor<D>>& hessians) const;

  const SimplexMesh<D>& mesh_;
  const std::vector<double>& values_;
  int components_;
  Rows rows_;
  std::vector<Index> unknown_; ///< number of the unknown of a boundary point, or None
  Index numberOfUnknowns_ = 0;
};

/// For now any number but None says that the point is on the boundary.
template <int D>
void LumpedMassRecovery<D>::markBoundary()
{
  for (Index c = 0; c < this->mesh_.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i <= D && this->mesh_.isAlive(c); ++i)
    {
      if (this->mesh_.adjacent(c, i) == None)
      {
        for (Index p : this->mesh_.facet(c, i))
        {
          this->unknown_[p] = 0;
        }
      }
    }
  }
}

/// Adds the part of one cell to the sums of its nodes.
template <int D>
void LumpedMassRecovery<D>::addCell(Index c, std::vector<double>& mass)
{
  const BasisGradients<D> basis(this->mesh_.corners(c));
  if (basis.isFlat)
  {
    return;
  }
  const Simplex<D>& nodes = this->mesh_.nodes(c);
  // Lumped mass: each node gets an equal part of the cell.
  for (Index p : nodes)
  {
    mass[p] += std::abs(basis.volume) / (D + 1);
  }
  for (int k = 0; k < this->components_; ++k)
  {
    const auto value = [&](int i)
    { return this->values_[static_cast<std::size_t>(this->components_) * nodes[i] + k]; };
    Vec<D> gradient = Vec<D>::Zero();
    for (int i = 1; i <= D; ++i)
    {
      // Differences, so that a large constant costs no digits.
      gradient += (value(i) - value(0)) * basis.of[i];
    }
    // (5.4), symmetrized: minus the integral of (du / dx_a) (dphi / dx_b), constant in the cell.
    for (int i = 0; i <= D; ++i)
    {
      double* row = &this->rows_(nodes[i], k * Numbers);
      for (int a = 0; a < D; ++a)
      {
        for (int b = 0; b <= a; ++b)
        {
          *row++ -= 0.5 * basis.volume *
            (gradient[a] * basis.of[i][b] + gradient[b] * basis.of[i][a]);
        }
      }
    }
  }
}

/// Computes the Hessians of interior points. Boundary points, and points whose cells are all flat,
/// become unknowns and get numbers.
template <int D>
void LumpedMassRecovery<D>::integrate()
{
  // Of the lumped matrix: its diagonal is the mass of each node.
  std::vector<double> mass(this->unknown_.size(), 0.0);
  for (Index c = 0; c < this->mesh_.numberOfCellSlots(); ++c)
  {
    if (this->mesh_.isAlive(c))
    {
      this->addCell(c, mass);
    }
  }
  for (Index p = 0; p < this->mesh_.numberOfPointSlots(); ++p)
  {
    if (this->mesh_.isPointAlive(p) && (this->unknown_[p] != None || mass[p] == 0.0))
    {
      // The weak form lacks its boundary term there, so these sums are of no use.
      this->unknown_[p] = this->numberOfUnknowns_++;
      this->rows_.row(p).setZero();
    }
    else if (mass[p] > 0.0)
    {
      this->rows_.row(p) /= mass[p];
    }
  }
}

/// Finds a point in a part of the mesh without interior points: there is nothing to extrapolate
/// from.
template <int D>
std::string LumpedMassRecovery<D>::findUnreached() const
{
  // From all interior points at once, over edges of the mesh.
  const PointGraph graph = PointGraph::of(this->mesh_);
  std::vector<std::uint8_t> reached(this->unknown_.size(), 0);
  std::vector<Index> front;
  for (Index p = 0; p < graph.numberOfPoints(); ++p)
  {
    if (this->mesh_.isPointAlive(p) && this->unknown_[p] == None)
    {
      reached[p] = 1;
      front.push_back(p);
    }
  }
  while (!front.empty())
  {
    const Index p = front.back();
    front.pop_back();
    for (Index i = graph.first[p]; i < graph.first[p + 1]; ++i)
    {
      if (!reached[graph.ids[i]])
      {
        reached[graph.ids[i]] = 1;
        front.push_back(graph.ids[i]);
      }
    }
  }
  for (Index p = 0; p < graph.numberOfPoints(); ++p)
  {
    if (this->mesh_.isPointAlive(p) && !reached[p])
    {
      std::ostringstream text;
      text << "Point " << p << " belongs to a part of the mesh without interior points, from which "
           << "the lumped mass matrix recovers no Hessian: use least squares, or a finer mesh.";
      return text.str();
    }
  }
  return std::string();
}

/// Minimizes int |grad H|^2 over the unknown values. In a flat cell, plain differences along its
/// edges replace the integral, so that every unknown is tied to something.
template <int D>
void LumpedMassRecovery<D>::extrapolate()
{
  // Values at interior points are known, those at the boundary are not.
  const Index n = this->numberOfUnknowns_;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n, this->rows_.cols());
  for (Index c = 0; c < this->mesh_.numberOfCellSlots(); ++c)
  {
    if (!this->mesh_.isAlive(c))
    {
      continue;
    }
    const Simplex<D>& nodes = this->mesh_.nodes(c);
    if (std::all_of(
          nodes.begin(), nodes.end(), [this](Index p) { return this->unknown_[p] == None; }))
    {
      continue;
    }
    const BasisGradients<D> basis(this->mesh_.corners(c));
    // Of the same magnitude as the integral: |grad|^2 times volume is a length to the power D - 2.
    const double difference = basis.length > 0.0 ? std::pow(basis.length, D - 2) : 1.0;
    for (int i = 0; i <= D; ++i)
    {
      const Index row = this->unknown_[nodes[i]];
      for (int j = 0; j <= D && row != None; ++j)
      {
        const double entry = basis.isFlat ? (i == j ? D * difference : -difference)
                                          : std::abs(basis.volume) * basis.of[i].dot(basis.of[j]);
        if (this->unknown_[nodes[j]] != None)
        {
          entries.emplace_back(row, this->unknown_[nodes[j]], entry);
        }
        else
        {
          // Known values go to the right-hand side.
          right.row(row) -= entry * this->rows_.row(nodes[j]);
        }
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  // Regular, since every unknown is connected to an interior point: see findUnreached().
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
  // One factorization serves all components and all entries of the tensors.
  const Eigen::MatrixXd solution = solver.solve(right);
  for (std::size_t p = 0; p < this->unknown_.size(); ++p)
  {
    if (this->unknown_[p] != None)
    {
      this->rows_.row(p) = solution.row(this->unknown_[p]);
    }
  }
}

/// In the order in which addCell() has written the numbers: the rows of the lower triangle.
template <int D>
void LumpedMassRecovery<D>::unpack(std::vector<Tensor<D>>& hessians) const
{
  const std::size_t components = static_cast<std::size_t>(this->components_);
  hessians.resize(this->unknown_.size() * components);
  for (std::size_t h = 0; h < hessians.size(); ++h)
  {
    const double* row = &this->rows_(h / components, h % components * Numbers);
    for (int a = 0; a < D; ++a)
    {
      for (int b = 0; b <= a; ++b)
      {
        hessians[h](a, b) = hessians[h](b, a) = *row++;
      }
    }
  }
}
}

template <int D>
std::string recoverHessians(const SimplexMesh<D>& mesh, const std::vector<double>& values,
  int components, Recovery recovery, std::vector<Tensor<D>>& hessians)
{
  return recovery == Recovery::LumpedMass
    ? LumpedMassRecovery<D>(mesh, values, components).run(hessians)
    : recoverByLeastSquares(mesh, values, components, hessians);
}

template std::string recoverHessians<2>(
  const SimplexMesh<2>&, const std::vector<double>&, int, Recovery, std::vector<Tensor<2>>&);
template std::string recoverHessians<3>(
  const SimplexMesh<3>&, const std::vector<double>&, int, Recovery, std::vector<Tensor<3>>&);
}
