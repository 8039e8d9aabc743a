// SPDX-License-Identifier: BSD-3-Clause
// Hessians recovered from values at points: exact where they should be, on the boundary too.
#include "Metric/HessianRecovery.h"

#include "TestMeshes.h"

#include <Eigen/LU>

#include <functional>

using namespace meshopt;

namespace
{
template <int D>
using Field = std::function<double(const Vec<D>&)>;

template <int D>
std::vector<double> sample(const MeshInput<D>& in, const std::vector<Field<D>>& fields)
{
  std::vector<double> values;
  for (const Vec<D>& x : in.points)
  {
    for (const Field<D>& f : fields)
    {
      values.push_back(f(x));
    }
  }
  return values;
}

template <int D>
std::vector<Tensor<D>> recover(
  const MeshInput<D>& in, const std::vector<Field<D>>& fields, Recovery recovery)
{
  std::vector<Tensor<D>> hessians;
  const std::string error = recoverHessians(
    buildMesh(in), sample(in, fields), static_cast<int>(fields.size()), recovery, hessians);
  EXPECT_EQ(error, "");
  EXPECT_EQ(hessians.size(), in.points.size() * fields.size());
  return hessians;
}

template <int D>
Tensor<D> someTensor()
{
  Tensor<D> h;
  for (int i = 0; i < D; ++i)
  {
    for (int j = 0; j < D; ++j)
    {
      h(i, j) = i == j ? 2.0 - 3.0 * i : 0.7 + 0.4 * (i + j);
    }
  }
  return h;
}

template <int D>
Field<D> quadratic(const Tensor<D>& h)
{
  return [h](const Vec<D>& x) { return 3.0 + 2.0 * x[0] - x[D - 1] + 0.5 * x.dot(h * x); };
}

template <int D>
bool isOnSquare(const Vec<D>& x)
{
  return (x.array() == 0.0).any() || (x.array() == 1.0).any();
}

/// int |grad f|^2 of the linear interpolation, from the definition: a gradient per cell.
template <int D>
double energy(const MeshInput<D>& in, const std::vector<double>& f)
{
  double sum = 0.0;
  for (const Simplex<D>& cell : in.cells)
  {
    Eigen::Matrix<double, D, D> edges;
    Eigen::Matrix<double, D, 1> rise;
    for (int i = 0; i < D; ++i)
    {
      edges.row(i) = (in.points[cell[i + 1]] - in.points[cell[0]]).transpose();
      rise[i] = f[cell[i + 1]] - f[cell[0]];
    }
    const Eigen::Matrix<double, D, 1> gradient = edges.fullPivLu().solve(rise);
    sum += std::abs(edges.determinant()) / (D == 2 ? 2.0 : 6.0) * gradient.squaredNorm();
  }
  return sum;
}

}

template <class T>
class HessianRecovery : public testing::Test
{
};
TYPED_TEST_SUITE(HessianRecovery, TestDimensions);

TYPED_TEST(HessianRecovery, LinearGivesZero)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = jitteredGrid<D>(5, 0.25);
  const Field<D> linear = [](const Vec<D>& x) { return 1000.0 + 7.0 * x[0] - 3.0 * x[1]; };
  for (const Recovery recovery : { Recovery::LumpedMass, Recovery::LeastSquares })
  {
    for (const Tensor<D>& h : recover<D>(in, { linear }, recovery))
    {
      EXPECT_LT(h.norm(), 1e-9);
    }
  }
}

/// Also where cells are inverted: volumes have signs.
TYPED_TEST(HessianRecovery, LinearGivesZeroOnATangledMesh)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = jitteredGrid<D>(5, 0.8);
  const Field<D> linear = [](const Vec<D>& x) { return 7.0 * x[0] - 3.0 * x[1]; };
  for (const Tensor<D>& h : recover<D>(in, { linear }, Recovery::LumpedMass))
  {
    EXPECT_LT(h.norm(), 1e-9);
  }
}

TYPED_TEST(HessianRecovery, LeastSquaresIsExactOnQuadratics)
{
  constexpr int D = TypeParam::dimension;
  const Tensor<D> h = someTensor<D>();
  for (const Tensor<D>& found :
    recover<D>(jitteredGrid<D>(4, 0.25), { quadratic<D>(h) }, Recovery::LeastSquares))
  {
    EXPECT_LT((found - h).norm(), 1e-10);
  }
}

/// Stretched by 1000 and turned, as adapted meshes are: as exact in the mesh's own scale.
TYPED_TEST(HessianRecovery, LeastSquaresIsAffineInvariant)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = jitteredGrid<D>(4, 0.25);
  Tensor<D> map = Tensor<D>::Identity();
  map(0, 0) = 1000.0;
  Tensor<D> turn = Tensor<D>::Identity();
  turn(0, 0) = turn(1, 1) = 0.6;
  turn(0, 1) = -0.8;
  turn(1, 0) = 0.8;
  map = turn * map;
  const Tensor<D> h = someTensor<D>();
  const std::vector<double> values = sample<D>(in, { quadratic<D>(h) });
  for (Vec<D>& x : in.points)
  {
    x = map * x;
  }
  std::vector<Tensor<D>> found;
  ASSERT_EQ(recoverHessians(buildMesh(in), values, 1, Recovery::LeastSquares, found), "");
  for (const Tensor<D>& f : found)
  {
    EXPECT_LT((map.transpose() * f * map - h).norm(), 1e-7);
  }
}

/// Patches that are symmetric about their point; from there the boundary gets the same constant.
TYPED_TEST(HessianRecovery, LumpedMassIsExactOnSymmetricPatches)
{
  constexpr int D = TypeParam::dimension;
  const Tensor<D> h = someTensor<D>();
  for (const Tensor<D>& found :
    recover<D>(jitteredGrid<D>(4, 0.0), { quadratic<D>(h) }, Recovery::LumpedMass))
  {
    EXPECT_LT((found - h).norm(), 1e-11);
  }
}

/// (5.4) written down once more, and the boundary values by what defines them: no change of one of
/// them lowers the energy.
TYPED_TEST(HessianRecovery, BoundaryMinimizesTheEnergy)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = jitteredGrid<D>(4, 0.2);
  const Field<D> f = [](const Vec<D>& x) { return std::sin(3.0 * x[0]) * std::exp(x[1]); };
  const std::vector<Tensor<D>> h = recover<D>(in, { f }, Recovery::LumpedMass);
  std::vector<double> entry;
  for (const Tensor<D>& t : h)
  {
    EXPECT_EQ(t, Tensor<D>(t.transpose()));
    entry.push_back(t(0, 1));
  }
  const double least = energy(in, entry);
  for (std::size_t p = 0; p < entry.size(); ++p)
  {
    std::vector<double> up = entry, down = entry;
    up[p] += 1e-3;
    down[p] -= 1e-3;
    const double slope = (energy(in, up) - energy(in, down)) / 2e-3;
    if (isOnSquare<D>(in.points[p]))
    {
      EXPECT_LT(std::abs(slope), 1e-8 * (1.0 + least)) << p;
    }
  }
}

TYPED_TEST(HessianRecovery, ComponentsDoNotMix)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = jitteredGrid<D>(4, 0.2);
  const Field<D> f = [](const Vec<D>& x) { return std::sin(3.0 * x[0]) * std::exp(x[1]); };
  const Field<D> g = [](const Vec<D>& x) { return x[0] * x[0] * x[D - 1]; };
  for (const Recovery recovery : { Recovery::LumpedMass, Recovery::LeastSquares })
  {
    const std::vector<Tensor<D>> both = recover<D>(in, { f, g }, recovery);
    const std::vector<Tensor<D>> first = recover<D>(in, { f }, recovery);
    const std::vector<Tensor<D>> second = recover<D>(in, { g }, recovery);
    for (std::size_t p = 0; p < first.size(); ++p)
    {
      EXPECT_LT((both[2 * p] - first[p]).norm(), 1e-12 * (1.0 + first[p].norm()));
      EXPECT_LT((both[2 * p + 1] - second[p]).norm(), 1e-12 * (1.0 + second[p].norm()));
    }
  }
}

/// Two parts that touch nowhere in the topology (a crack through and through): each its own field.
TYPED_TEST(HessianRecovery, SidesOfACrackDoNotMix)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = jitteredGrid<D>(4, 0.0);
  const MeshInput<D> other = in;
  const Index n = static_cast<Index>(in.points.size());
  for (const Vec<D>& x : other.points)
  {
    in.points.push_back(x + Vec<D>::Unit(0));
  }
  for (Simplex<D> cell : other.cells)
  {
    for (Index& p : cell)
    {
      p += n;
    }
    in.cells.push_back(cell);
  }
  std::vector<double> values(2 * n);
  for (Index p = 0; p < 2 * n; ++p)
  {
    values[p] = p < n ? in.points[p].squaredNorm() : 5.0;
  }
  for (const Recovery recovery : { Recovery::LumpedMass, Recovery::LeastSquares })
  {
    std::vector<Tensor<D>> h;
    ASSERT_EQ(recoverHessians(buildMesh(in), values, 1, recovery, h), "");
    for (Index p = 0; p < n; ++p)
    {
      EXPECT_LT((h[p] - 2.0 * Tensor<D>::Identity()).norm(), 1e-9);
      EXPECT_LT(h[p + n].norm(), 1e-9);
    }
  }
}

/// Halving the mesh halves the error of a smooth field at least, boundary included (least squares;
/// the lumped mass matrix converges in the mean only).
TYPED_TEST(HessianRecovery, LeastSquaresConverges)
{
  constexpr int D = TypeParam::dimension;
  const Field<D> f = [](const Vec<D>& x) { return std::sin(x[0] + 2.0 * x[1]); };
  double error[2];
  for (int k = 0; k < 2; ++k)
  {
    const MeshInput<D> in = jitteredGrid<D>(6 << k, 0.2);
    const std::vector<Tensor<D>> h = recover<D>(in, { f }, Recovery::LeastSquares);
    error[k] = 0.0;
    for (std::size_t p = 0; p < h.size(); ++p)
    {
      Tensor<D> exact = Tensor<D>::Zero();
      exact.template topLeftCorner<2, 2>() << 1.0, 2.0, 2.0, 4.0;
      exact *= -std::sin(in.points[p][0] + 2.0 * in.points[p][1]);
      error[k] = std::max(error[k], (h[p] - exact).norm());
    }
  }
  EXPECT_LT(error[1], 0.6 * error[0]);
  EXPECT_LT(error[1], 1.5); // of 5
}

/// Cells without volume have no gradients; the field stays finite, and right elsewhere.
TEST(HessianRecovery2, FlatCells)
{
  MeshInput<2> in = jitteredGrid<2>(4, 0.0);
  // a flat triangle on the right side, beyond it nothing
  in.points.emplace_back(1.0, 0.3);
  in.cells.push_back({ 4, 9, 25 });
  const Tensor<2> h = someTensor<2>();
  for (const Recovery recovery : { Recovery::LumpedMass, Recovery::LeastSquares })
  {
    for (const Tensor<2>& found : recover<2>(in, { quadratic<2>(h) }, recovery))
    {
      EXPECT_LT((found - h).norm(), 1e-9);
    }
  }
}

TEST(HessianRecovery2, TooSmallMeshesAreNamed)
{
  const MeshInput<2> in = jitteredGrid<2>(1, 0.0);
  std::vector<Tensor<2>> h;
  const std::vector<double> values(4, 1.0);
  EXPECT_NE(recoverHessians(buildMesh(in), values, 1, Recovery::LumpedMass, h)
              .find("Point 0 belongs to a part of the mesh without interior points"),
    std::string::npos);
  EXPECT_NE(recoverHessians(buildMesh(in), values, 1, Recovery::LeastSquares, h).find("at point 0"),
    std::string::npos);
  // enough points, but all on one conic: two lines
  MeshInput<2> strip;
  for (int i = 0; i < 6; ++i)
  {
    strip.points.emplace_back(i, 0.0);
    strip.points.emplace_back(i, 1.0);
  }
  for (Index i = 0; i < 5; ++i)
  {
    strip.cells.push_back({ 2 * i, 2 * i + 2, 2 * i + 1 });
    strip.cells.push_back({ 2 * i + 1, 2 * i + 2, 2 * i + 3 });
  }
  EXPECT_NE(
    recoverHessians(buildMesh(strip), std::vector<double>(12, 1.0), 1, Recovery::LeastSquares, h)
      .find("at point 0"),
    std::string::npos);
}

TEST(HessianRecovery2, PointsThatNoCellUses)
{
  MeshInput<2> in = jitteredGrid<2>(4, 0.1);
  in.points.emplace_back(std::nan(""), 0.0);
  std::vector<double> values(in.points.size(), 1.0);
  values.back() = std::nan("");
  for (const Recovery recovery : { Recovery::LumpedMass, Recovery::LeastSquares })
  {
    std::vector<Tensor<2>> h;
    ASSERT_EQ(recoverHessians(buildMesh(in), values, 1, recovery, h), "");
    EXPECT_EQ(h.back(), Tensor<2>(Tensor<2>::Zero()));
  }
}
