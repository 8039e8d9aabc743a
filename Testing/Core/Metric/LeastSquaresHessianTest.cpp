// SPDX-License-Identifier: BSD-3-Clause
// Which points a fit takes, and what it makes of them: against patches found by looking at all
// cells, and normal equations of quadratics in plain coordinates.
#include "Metric/LeastSquaresHessian.h"

#include "TestMeshes.h"

#include <Eigen/SVD>

#include <set>

using namespace meshopt;

namespace
{
template <class T>
class LeastSquaresHessian : public ::testing::Test
{
};
TYPED_TEST_SUITE(LeastSquaresHessian, TestDimensions);

template <int D>
constexpr int Unknowns = D == 2 ? 6 : 10;

/// Point p with so many layers of neighbours.
template <int D>
std::set<Index> layersAround(const MeshInput<D>& in, Index p, int layers)
{
  std::set<Index> patch{ p };
  for (int k = 0; k < layers; ++k)
  {
    std::set<Index> wider = patch;
    for (const Simplex<D>& cell : in.cells)
    {
      if (std::any_of(cell.begin(), cell.end(), [&](Index q) { return patch.count(q) > 0; }))
      {
        wider.insert(cell.begin(), cell.end());
      }
    }
    patch = wider;
  }
  return patch;
}

/// The quadratic of least squares through the values at `patch`, by singular values: its Hessian,
/// and how well the points determine it (least over greatest singular value).
template <int D>
std::pair<Tensor<D>, double> fitPlainly(
  const MeshInput<D>& in, const std::set<Index>& patch, Index p, const std::vector<double>& values)
{
  Eigen::MatrixXd a(patch.size(), Unknowns<D>);
  Eigen::VectorXd b(patch.size());
  int row = 0;
  for (Index q : patch)
  {
    const Vec<D> x = in.points[q] - in.points[p];
    int column = 0;
    a(row, column++) = 1.0;
    for (int i = 0; i < D; ++i)
    {
      a(row, column++) = x[i];
      for (int j = 0; j <= i; ++j)
      {
        a(row, column++) = x[i] * x[j];
      }
    }
    b[row++] = values[q];
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd solution = svd.solve(b);
  Tensor<D> h;
  for (int i = 0, column = 1; i < D; ++i)
  {
    ++column; // the slope
    for (int j = 0; j <= i; ++j)
    {
      h(i, j) = h(j, i) = (i == j ? 2.0 : 1.0) * solution[column++];
    }
  }
  const Eigen::VectorXd s = svd.singularValues();
  return { h, static_cast<int>(patch.size()) < Unknowns<D> ? 0.0 : s.minCoeff() / s.maxCoeff() };
}

/// Not a quadratic, so that each other choice of points gives another Hessian.
template <int D>
double wave(const Vec<D>& x)
{
  return std::sin(5.0 * x[0] + 2.0 * x[D - 1]) * std::exp(2.0 * x[1]);
}

template <int D>
std::vector<double> wavesAt(const MeshInput<D>& in)
{
  std::vector<double> values;
  for (const Vec<D>& x : in.points)
  {
    values.push_back(wave<D>(x));
  }
  return values;
}
}

/// The patch is the first one with enough points. It is larger only where these say little.
TYPED_TEST(LeastSquaresHessian, EqualsAPlainFitOfTheSmallestPatch)
{
  constexpr int D = TypeParam::dimension;
  constexpr std::size_t enough = D == 2 ? 7 : 14;
  const MeshInput<D> in = jitteredGrid<D>(D == 2 ? 9 : 5, 0.25);
  const std::vector<double> values = wavesAt(in);
  std::vector<Tensor<D>> hessians;
  ASSERT_EQ(recoverByLeastSquares<D>(buildMesh(in), values, 1, hessians), "");
  ASSERT_EQ(hessians.size(), in.points.size());
  int ofOneLayer = 0, ofTwoLayers = 0, larger = 0;
  for (Index p = 0; p < static_cast<Index>(in.points.size()); ++p)
  {
    int layers = 1;
    while (layersAround(in, p, layers).size() < enough)
    {
      ++layers;
    }
    auto [h, known] = fitPlainly<D>(in, layersAround(in, p, layers), p, values);
    if (known < 1e-3)
    {
      std::tie(h, known) = fitPlainly<D>(in, layersAround(in, p, layers + 1), p, values);
      ++larger;
    }
    ++(layers == 1 ? ofOneLayer : ofTwoLayers);
    EXPECT_LT((hessians[p] - h).norm(), 1e-7 * (1.0 + h.norm())) << p << " " << layers;
    EXPECT_EQ(hessians[p], Tensor<D>(hessians[p].transpose()));
  }
  EXPECT_GT(ofOneLayer, 10);
  EXPECT_GT(ofTwoLayers, 10);
  EXPECT_LT(larger, 5);
}

namespace
{
/// Point 0 in three rings of four points each, the k-th turned by turn[k]. Not turned, all points
/// lie on the axes: on a conic.
MeshInput<2> rings(const std::array<double, 3>& turn)
{
  MeshInput<2> in;
  in.points = { { 0, 0 } };
  for (int ring = 0; ring < 3; ++ring)
  {
    for (int k = 0; k < 4; ++k)
    {
      const double a = 0.5 * M_PI * k + turn[ring];
      in.points.emplace_back((ring + 1) * std::cos(a), (ring + 1) * std::sin(a));
    }
  }
  for (Index k = 0; k < 4; ++k)
  {
    const Index next = (k + 1) % 4;
    in.cells.push_back({ 0, 1 + k, 1 + next });
    for (Index first : { 1, 5 })
    {
      in.cells.push_back({ first + k, first + 4 + k, first + next });
      in.cells.push_back({ first + next, first + 4 + k, first + 4 + next });
    }
  }
  return in;
}
}

TEST(LeastSquaresHessian2D, PointsOnAConicTakeAnotherLayer)
{
  // Five points are too few, nine are not; but of the second case all nine are on the axes.
  const std::array<double, 3> turns[] = { { 0, 0.4, 0.7 }, { 0, 0, 0.4 } };
  for (int k = 0; k < 2; ++k)
  {
    const MeshInput<2> in = rings(turns[k]);
    const std::vector<double> values = wavesAt(in);
    ASSERT_EQ(layersAround(in, 0, 1).size(), 5u);
    ASSERT_EQ(layersAround(in, 0, 2).size(), 9u);
    std::vector<Tensor<2>> hessians;
    ASSERT_EQ(recoverByLeastSquares<2>(buildMesh(in), values, 1, hessians), "");
    const auto [h, known] = fitPlainly<2>(in, layersAround(in, 0, 2 + k), 0, values);
    EXPECT_GT(known, 1e-3);
    EXPECT_LT((hessians[0] - h).norm(), 1e-10 * h.norm()) << k;
  }
}

TEST(LeastSquaresHessian2D, OnlyPointsOnAConicAreAnError)
{
  MeshInput<2> in = rings({ 0, 0, 0 });
  std::vector<Tensor<2>> hessians;
  const std::string error = recoverByLeastSquares<2>(buildMesh(in), wavesAt(in), 1, hessians);
  EXPECT_NE(error.find("point 0 cannot"), std::string::npos) << error;
  EXPECT_NE(error.find("6 points"), std::string::npos) << error;
  // One point off it is enough for all.
  in.points[5] += Vec<2>(0.0, 0.4);
  EXPECT_EQ(recoverByLeastSquares<2>(buildMesh(in), wavesAt(in), 1, hessians), "");
}

/// Several components at once are several fits; a constant in the values changes nothing.
TYPED_TEST(LeastSquaresHessian, ComponentsAreFitsOfTheirOwn)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = jitteredGrid<D>(4, 0.25);
  const SimplexMesh<D> mesh = buildMesh(in);
  std::vector<double> one, other, both;
  for (const Vec<D>& x : in.points)
  {
    one.push_back(wave<D>(x));
    other.push_back(x[0] * x[0] * x[1] - x[D - 1]);
    both.insert(both.end(), { one.back() + 1024.0, other.back() });
  }
  std::vector<Tensor<D>> first, second, together;
  ASSERT_EQ(recoverByLeastSquares<D>(mesh, one, 1, first), "");
  ASSERT_EQ(recoverByLeastSquares<D>(mesh, other, 1, second), "");
  ASSERT_EQ(recoverByLeastSquares<D>(mesh, both, 2, together), "");
  ASSERT_EQ(together.size(), 2 * in.points.size());
  for (std::size_t p = 0; p < in.points.size(); ++p)
  {
    EXPECT_LT((together[2 * p] - first[p]).norm(), 1e-8 * (1.0 + first[p].norm()));
    EXPECT_LT((together[2 * p + 1] - second[p]).norm(), 1e-12 * (1.0 + second[p].norm()));
  }
}

TYPED_TEST(LeastSquaresHessian, TooFewPointsAreAnError)
{
  constexpr int D = TypeParam::dimension;
  const MeshInput<D> in = oneCell<D>();
  std::vector<Tensor<D>> hessians;
  const std::string error = recoverByLeastSquares<D>(buildMesh(in), wavesAt(in), 1, hessians);
  EXPECT_NE(error.find("point 0 cannot"), std::string::npos) << error;
  EXPECT_NE(error.find(std::to_string(Unknowns<D>) + " points"), std::string::npos) << error;
}
