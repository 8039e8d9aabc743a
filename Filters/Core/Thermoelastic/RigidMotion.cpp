// SPDX-License-Identifier: BSD-3-Clause
// Handling of free rigid motions: pins, projection, a check of the loads.
#include "Thermoelastic/RigidModes.h"

#include <Eigen/Dense>

#include <cmath>

namespace meshopt::fem
{
namespace
{
/// Points of each group, ascending. A hinge is there once: its bodies are in one group.
template <int D>
std::vector<std::vector<Index>> pointsOfGroups(const RigidModes<D>& modes)
{
  std::vector<std::vector<Index>> points(modes.groups.size());
  for (Index p = 0; p < static_cast<Index>(modes.bodyOfPoint.size()); ++p)
  {
    if (modes.bodyOfPoint[p] != None)
    {
      points[modes.bodies[modes.bodyOfPoint[p]].group].push_back(p);
    }
  }
  return points;
}

/// The component of `points` that the motions displace most; `row`: its displacement by each
/// motion.
template <int D>
Constraint findPin(const SimplexMesh<D>& mesh, const RigidModes<D>& modes,
  const std::vector<Index>& points, const Eigen::MatrixXd& motions, Eigen::RowVectorXd& row)
{
  Constraint best;
  double most = 0.0;
  for (Index p : points)
  {
    const Eigen::Matrix<double, D, Eigen::Dynamic> u = modes.displacements(mesh, p, motions);
    for (int i = 0; i < D; ++i)
    {
      // With a margin, so that rounding does not choose among equally good points.
      if (u.row(i).squaredNorm() > most * (1.0 + 1e-9))
      {
        most = u.row(i).squaredNorm();
        best = { p, i, 0.0 };
        row = u.row(i);
      }
    }
  }
  return best;
}
}

/// Greedy: each pin holds the component that the motions left over displace most. So pins are far
/// apart, and small errors in them turn the body by little.
template <int D>
std::vector<Constraint> pinRigidMotions(const SimplexMesh<D>& mesh, const RigidModes<D>& modes)
{
  std::vector<Constraint> pins;
  const std::vector<std::vector<Index>> points = pointsOfGroups(modes);
  for (std::size_t g = 0; g < points.size(); ++g)
  {
    // All free motions at first. Each pin takes one away, so that this ends.
    Eigen::MatrixXd left = modes.groups[g].free;
    while (left.cols() > 0)
    {
      Eigen::RowVectorXd row;
      pins.push_back(findPin(mesh, modes, points[g], left, row));
      // The motions left are the combinations that do not displace the pinned component. A
      // reflection turns the row into a multiple of (1, 0, ... 0), and the combinations with it:
      // all but the first one leave the component at rest.
      Eigen::RowVectorXd mirror = row;
      mirror[0] += std::copysign(row.norm(), row[0]);
      left -= (2.0 / mirror.squaredNorm() * (left * mirror.transpose())) * mirror;
      left = left.rightCols(left.cols() - 1).eval();
    }
  }
  return pins;
}

/// Group by group, since groups move independently of each other.
template <int D>
void removeRigidMotions(const SimplexMesh<D>& mesh, const RigidModes<D>& modes,
  const std::vector<double>& weight, std::vector<Vec<D>>& displacement)
{
  const std::vector<std::vector<Index>> points = pointsOfGroups(modes);
  for (std::size_t g = 0; g < points.size(); ++g)
  {
    const Eigen::MatrixXd& free = modes.groups[g].free;
    if (free.cols() == 0)
    {
      continue;
    }
    // Normal equations: the motion that is nearest to the displacement, by weighted squares.
    Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(free.cols(), free.cols());
    Eigen::VectorXd part = Eigen::VectorXd::Zero(free.cols());
    for (Index p : points[g])
    {
      const Eigen::Matrix<double, D, Eigen::Dynamic> u = modes.displacements(mesh, p, free);
      gram += weight[p] * (u.transpose() * u);
      part += weight[p] * (u.transpose() * displacement[p]);
    }
    // Regular, since no free motion leaves all points at rest.
    const Eigen::VectorXd amount = gram.ldlt().solve(part);
    for (Index p : points[g])
    {
      displacement[p] -= modes.displacements(mesh, p, free) * amount;
    }
  }
}

/// With motions that have names, since the user reads which one is not balanced.
template <int D>
std::string findImbalance(const SimplexMesh<D>& mesh, const RigidModes<D>& modes,
  const std::vector<Vec<D>>& forces, double tolerance)
{
  const std::vector<std::vector<Index>> points = pointsOfGroups(modes);
  for (std::size_t g = 0; g < points.size() && !forces.empty(); ++g)
  {
    const Eigen::MatrixXd& named = modes.groups[g].named;
    Eigen::VectorXd resultant = Eigen::VectorXd::Zero(named.cols());
    double sum = 0.0;
    for (Index p : points[g])
    {
      // Virtual work: a load in balance does none in a free motion.
      resultant += modes.displacements(mesh, p, named).transpose() * forces[p];
      sum += forces[p].norm();
    }
    // Motions have norm 1 in units of the group: forces and moments are compared alike.
    for (Index m = 0; m < resultant.size(); ++m)
    {
      if (std::abs(resultant[m]) > tolerance * sum)
      {
        return modes.describe(static_cast<Index>(g), m);
      }
    }
  }
  return {};
}

template std::vector<Constraint> pinRigidMotions<2>(const SimplexMesh<2>&, const RigidModes<2>&);
template std::vector<Constraint> pinRigidMotions<3>(const SimplexMesh<3>&, const RigidModes<3>&);
template void removeRigidMotions<2>(
  const SimplexMesh<2>&, const RigidModes<2>&, const std::vector<double>&, std::vector<Vec<2>>&);
template void removeRigidMotions<3>(
  const SimplexMesh<3>&, const RigidModes<3>&, const std::vector<double>&, std::vector<Vec<3>>&);
template std::string findImbalance<2>(
  const SimplexMesh<2>&, const RigidModes<2>&, const std::vector<Vec<2>>&, double);
template std::string findImbalance<3>(
  const SimplexMesh<3>&, const RigidModes<3>&, const std::vector<Vec<3>>&, double);
}
