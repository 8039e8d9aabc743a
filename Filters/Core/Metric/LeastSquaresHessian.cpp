// SPDX-License-Identifier: BSD-3-Clause
// Recovery by a quadratic polynomial around each point. The patch grows ring by ring until its
// points determine all coefficients.
#include "Metric/LeastSquaresHessian.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <cmath>
#include <sstream>

namespace meshopt
{
namespace
{
/// Coefficients of a quadratic: constant, slopes, second derivatives.
template <int D>
constexpr int Unknowns = 1 + D + D*(D + 1) / 2;
/// More points than unknowns, so that noise is averaged out: the size of a regular interior patch.
template <int D>
constexpr std::size_t WantedPoints = D == 2 ? 7 : 14;

/// Ratio of the least to the greatest diagonal entry of the triangular factor: for a fit that is
/// well determined, and for one that is just determined.
constexpr double goodRank = 1e-3, leastRank = 1e-7;

template <int D>
class PatchFit
{
public:
  PatchFit(const SimplexMesh<D>& mesh, const std::vector<double>& values, int components)
    : mesh_(mesh)
    , values_(values)
    , components_(components)
    , graph_(PointGraph::of(mesh))
    , seen_(mesh.numberOfPointSlots(), None)
  {
  }

  /// Hessians of all components at p. False if the part of the mesh around p has too few points.
  bool at(Index p, Tensor<D>* hessians)
  {
    this->patch_.assign(1, p);
    this->seen_[p] = p;
    this->ringBegin_ = 0;
    bool more = this->addRing(p);
    while (more && this->patch_.size() < WantedPoints<D>)
    {
      more = this->addRing(p);
    }
    // Larger patches smooth more, so they are used only as long as the fit is badly determined.
    bool done = this->fit(goodRank, hessians);
    while (!done && more)
    {
      more = this->addRing(p);
      done = this->fit(more ? goodRank : leastRank, hessians);
    }
    return done || this->fit(leastRank, hessians);
  }

private:
  /// Adds the neighbours of the outermost ring. False if there are none left.
  bool addRing(Index p)
  {
    const std::size_t end = this->patch_.size();
    for (std::size_t k = this->ringBegin_; k < end; ++k)
    {
      const Index q = this->patch_[k];
      for (Index i = this->graph_.first[q]; i < this->graph_.first[q + 1]; ++i)
      {
        const Index r = this->graph_.ids[i];
        // The point of the patch is the mark: nothing has to be cleared for the next patch.
        if (this->seen_[r] != p)
        {
          this->seen_[r] = p;
          this->patch_.push_back(r);
        }
      }
    }
    this->ringBegin_ = end;
    return this->patch_.size() > end;
  }

  /// Fits the quadratic to the patch. False if the points determine it badly; `rank` says what is
  /// accepted as well determined.
  bool fit(double rank, Tensor<D>* hessians)
  {
    const Eigen::Index n = static_cast<Eigen::Index>(this->patch_.size());
    if (n < Unknowns<D>)
    {
      return false;
    }
    // Coordinates z in which the patch is as wide as it is long: x - x_p = L z, spread = L L^T.
    Eigen::Matrix<double, D, D> spread = Eigen::Matrix<double, D, D>::Zero();
    const Vec<D> centre = this->mesh_.point(this->patch_[0]);
    for (Index q : this->patch_)
    {
      const Vec<D> x = this->mesh_.point(q) - centre;
      spread += x * x.transpose() / double(n);
    }
    const Eigen::LLT<Eigen::Matrix<double, D, D>> scale(spread);
    // The patch lies in a plane, or on a line.
    if (scale.info() != Eigen::Success)
    {
      return false;
    }
    this->columns_.resize(n, Unknowns<D>);
    this->right_.resize(n, this->components_);
    for (Eigen::Index k = 0; k < n; ++k)
    {
      this->fillRow(k, scale);
    }
    this->qr_.compute(this->columns_);
    // Columns are pivoted, so small entries say which combinations of unknowns remain open.
    const auto diagonal = this->qr_.matrixQR().diagonal().cwiseAbs();
    if (!(diagonal.minCoeff() > rank * diagonal.maxCoeff()))
    {
      return false;
    }
    const Eigen::MatrixXd solution = this->qr_.solve(this->right_);
    for (int i = 0; i < this->components_; ++i)
    {
      Eigen::Matrix<double, D, D> h;
      int row = 1 + D;
      for (int a = 0; a < D; ++a)
      {
        for (int b = 0; b <= a; ++b)
        {
          h(a, b) = h(b, a) = solution(row++, i);
        }
      }
      // Back from z to x: H = L^-T h L^-1.
      // Two triangular solves with a transpose between them, in place of an inverse.
      scale.matrixU().solveInPlace(h);
      h.transposeInPlace();
      scale.matrixU().solveInPlace(h);
      hessians[i] = 0.5 * (h + h.transpose());
    }
    return true;
  }

  /// The equation of one point of the patch: value of the quadratic there = value of the field.
  void fillRow(Eigen::Index k, const Eigen::LLT<Eigen::Matrix<double, D, D>>& scale)
  {
    const Index p = this->patch_[0], q = this->patch_[k];
    Eigen::Matrix<double, D, 1> z = this->mesh_.point(q) - this->mesh_.point(p);
    scale.matrixL().solveInPlace(z);
    int column = 0;
    this->columns_(k, column++) = 1.0;
    for (int a = 0; a < D; ++a)
    {
      this->columns_(k, column++) = z[a];
    }
    for (int a = 0; a < D; ++a)
    {
      for (int b = 0; b <= a; ++b)
      {
        // With these factors the coefficients are the second derivatives.
        this->columns_(k, column++) = (a == b ? 0.5 : 1.0) * z[a] * z[b];
      }
    }
    // Differences to p, so that a large constant costs no digits.
    const std::size_t stride = static_cast<std::size_t>(this->components_);
    for (int i = 0; i < this->components_; ++i)
    {
      this->right_(k, i) = this->values_[stride * q + i] - this->values_[stride * p + i];
    }
  }

  const SimplexMesh<D>& mesh_;
  const std::vector<double>& values_;
  int components_;
  PointGraph graph_;
  std::vector<Index> seen_;  ///< the last patch that contained the point
  std::vector<Index> patch_; ///< first the point itself, then ring by ring
  std::size_t ringBegin_ = 0;
  // Of any size, so that the factorization, which is large, is compiled once for both dimensions.
  Eigen::MatrixXd columns_, right_;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr_;
};
}

template <int D>
std::string recoverByLeastSquares(const SimplexMesh<D>& mesh, const std::vector<double>& values,
  int components, std::vector<Tensor<D>>& hessians)
{
  const std::size_t stride = static_cast<std::size_t>(components);
  hessians.assign(stride * mesh.numberOfPointSlots(), Tensor<D>::Zero());
  PatchFit<D> fit(mesh, values, components);
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    if (mesh.isPointAlive(p) && !fit.at(p, &hessians[stride * p]))
    {
      std::ostringstream text;
      text
        << "The Hessian at point " << p << " cannot be recovered: "
        << Unknowns<D>
        << " points that do not lie on one curve or surface of second degree are needed, and the "
           "part of the mesh it belongs to has no such points.";
      return text.str();
    }
  }
  return std::string();
}

template std::string recoverByLeastSquares<2>(
  const SimplexMesh<2>&, const std::vector<double>&, int, std::vector<Tensor<2>>&);
template std::string recoverByLeastSquares<3>(
  const SimplexMesh<3>&, const std::vector<double>&, int, std::vector<Tensor<3>>&);
}
