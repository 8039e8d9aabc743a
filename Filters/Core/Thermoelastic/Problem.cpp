// SPDX-License-Identifier: BSD-3-Clause
// Checks a problem before it is assembled, and prepares generalised plane strain.
#include "Thermoelastic/Problem.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace meshopt::fem
{
namespace
{
/// A wrong length is the caller's mistake, not one of a point or a cell: none is named.
std::optional<Error> checkLength(
  const char* what, std::size_t have, std::size_t want, const char* of)
{
  if (have == want)
  {
    return std::nullopt;
  }
  std::ostringstream text;
  text << what << ": " << have << " values for " << want << " " << of << ".";
  return Error{ text.str() };
}

/// Arrays may be left out, but one that is there must have all its values.
template <int D>
std::optional<Error> checkLengths(const SimplexMesh<D>& mesh, const Problem<D>& problem)
{
  const std::size_t cells = mesh.numberOfCellSlots(), points = mesh.numberOfPointSlots();
  std::optional<Error> error;
  // Later steps rely on at least one cell: rigid motions have a centre, loads a surface.
  if (cells == 0)
  {
    return Error{ "The mesh has no elements." };
  }
  // One material is that of all cells.
  if (problem.materials.size() != 1)
  {
    error = checkLength("Materials", problem.materials.size(), cells, "cells");
  }
  if (!error && !problem.temperature.empty())
  {
    error = checkLength("Temperature", problem.temperature.size(), points, "points");
  }
  if (!error && !problem.forces.empty())
  {
    error = checkLength("Forces", problem.forces.size(), points, "points");
  }
  return error;
}

/// The first cell that is wrong is named, so that the user finds it in the mesh.
template <int D>
std::optional<Error> checkMaterials(const Problem<D>& problem)
{
  // With one material for all, no cell is to blame.
  const bool one = problem.materials.size() == 1;
  for (std::size_t c = 0; c < problem.materials.size(); ++c)
  {
    const std::string error = checkMaterial(
      problem.materials[c], one ? std::string() : " of cell " + std::to_string(c));
    if (!error.empty())
    {
      return Error{ error, one ? None : static_cast<Index>(c) };
    }
  }
  return std::nullopt;
}

/// What belongs to points that cells use, and the reference temperature.
template <int D>
std::optional<Error> checkPoints(const SimplexMesh<D>& mesh, const Problem<D>& problem)
{
  if (!std::isfinite(problem.referenceTemperature))
  {
    return Error{ "The reference temperature is not finite." };
  }
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    // Points that no cell uses may carry anything.
    if (!mesh.isPointAlive(p))
    {
      continue;
    }
    if (!problem.temperature.empty() && !std::isfinite(problem.temperature[p]))
    {
      std::ostringstream text;
      text << "The temperature at point " << p << " is " << problem.temperature[p]
           << "; it must be finite.";
      return Error{ text.str(), None, p };
    }
    if (!problem.forces.empty() && !problem.forces[p].allFinite())
    {
      return Error{ "The load at point " + std::to_string(p) + " is not finite.", None, p };
    }
  }
  return std::nullopt;
}

template <int D>
std::optional<Error> checkConstraints(const SimplexMesh<D>& mesh, const Problem<D>& problem)
{
  for (const Constraint& c : problem.constraints)
  {
    // Ranges first: the last check reads the point.
    if (c.point < 0 || c.point >= mesh.numberOfPointSlots())
    {
      return Error{ "A constraint is on point " + std::to_string(c.point) + ", which is not there.",
        None, c.point };
    }
    if (c.component < 0 || c.component >= D)
    {
      return Error{ "A constraint on point " + std::to_string(c.point) + " is on component " +
          std::to_string(c.component) + ", but there are " + std::to_string(D) + ".",
        None, c.point };
    }
    // Where no cell is, a constraint has no effect.
    if (!std::isfinite(c.value) && mesh.isPointAlive(c.point))
    {
      return Error{ "The prescribed displacement at point " + std::to_string(c.point) +
          " is not finite.",
        None, c.point };
    }
  }
  return std::nullopt;
}

/// Shape quality (2.3).
template <int D>
double shape(const Corners<D>& x)
{
  double perimeter = 0.0;
  // Each edge once; the paper's P is the sum of all edges.
  for (const auto& e : Local<D>::edges)
  {
    perimeter += (x[e[1]] - x[e[0]]).norm();
  }
  // The regular element has 1.
  const double scale = D == 3 ? 1296.0 * std::sqrt(2.0) : 36.0 / std::sqrt(3.0);
  return scale * signedVolume(x) / std::pow(perimeter, D);
}

/// With an inverted or flat cell the matrix is not positive definite: conjugate gradients would
/// break down, and could not say which cell is to blame.
template <int D>
std::optional<Error> checkVolumes(const SimplexMesh<D>& mesh)
{
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    const Corners<D> x = mesh.corners(c);
    // By shape and not by volume: the limit does not depend on units.
    const double s = shape<D>(x);
    // Written so that NaN, from a coordinate that is not finite, is refused, too.
    if (s > FlatShape)
    {
      continue;
    }
    std::ostringstream text;
    text
      << "Cell " << c << (s < -FlatShape ? " is inverted" : " is flat") << ": its "
      << (D == 3 ? "volume" : "area") << " is " << signedVolume(x)
      << ". Every element needs a positive one. Mesh Optimize repairs such cells where the surface "
         "allows it.";
    return Error{ text.str(), c };
  }
  return std::nullopt;
}

/// Of a temperature that is linear in the cell the mean over the nodes is that over the cell.
template <int D>
double meanTemperatureRise(const SimplexMesh<D>& mesh, const Problem<D>& problem, Index cell)
{
  if (problem.temperature.empty())
  {
    return 0.0;
  }
  double sum = 0.0;
  for (Index p : mesh.nodes(cell))
  {
    sum += problem.temperature[p];
  }
  return sum / (D + 1) - problem.referenceTemperature;
}
}

/// Lengths come first: all other checks index the arrays.
template <int D>
std::optional<Error> check(const SimplexMesh<D>& mesh, const Problem<D>& problem)
{
  std::optional<Error> error = checkLengths(mesh, problem);
  if (!error)
  {
    error = checkMaterials(problem);
  }
  if (!error)
  {
    error = checkPoints(mesh, problem);
  }
  if (!error && !std::isfinite(problem.outOfPlaneStrain))
  {
    error = Error{ "The strain out of the plane is not finite." };
  }
  if (!error)
  {
    error = checkConstraints(mesh, problem);
  }
  if (!error)
  {
    error = checkVolumes(mesh);
  }
  return error;
}

template <int D>
double freeAxialStrain(const SimplexMesh<D>& mesh, const Problem<D>& problem)
{
  // Generalised plane strain: the strain along the axis is one number for the body, and free ends
  // carry no resulting force.
  double strain = 0.0, weight = 0.0;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    const Material& m = problem.material(c);
    // Weighted by stiffness: the stress along the axis then adds up to no force.
    // (With free sides the stress across the axis adds up to zero, too: it drops out where all of
    // the body has one Poisson's ratio.)
    const double w = m.youngsModulus * signedVolume(mesh.corners(c));
    strain += w * m.thermalExpansion * meanTemperatureRise(mesh, problem, c);
    weight += w;
  }
  return strain / weight;
}

/// By coordinates with a tolerance: the ends of a mesh are planes only up to rounding.
template <int D>
void constrainEnds(
  const SimplexMesh<D>& mesh, int axis, double strain, double tolerance, Problem<D>& problem)
{
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    if (mesh.isPointAlive(p))
    {
      low = std::min(low, mesh.point(p)[axis]);
      high = std::max(high, mesh.point(p)[axis]);
    }
  }
  const double near = tolerance * (high - low);
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    if (!mesh.isPointAlive(p))
    {
      continue;
    }
    // Along the axis only: sideways the ends are free, as in a long body.
    if (mesh.point(p)[axis] <= low + near)
    {
      // The low end stays where it is, and the high end moves by the whole elongation.
      problem.constraints.push_back({ p, axis, 0.0 });
    }
    else if (mesh.point(p)[axis] >= high - near)
    {
      problem.constraints.push_back({ p, axis, strain * (high - low) });
    }
  }
}

template std::optional<Error> check<2>(const SimplexMesh<2>&, const Problem<2>&);
template std::optional<Error> check<3>(const SimplexMesh<3>&, const Problem<3>&);
template double freeAxialStrain<2>(const SimplexMesh<2>&, const Problem<2>&);
template double freeAxialStrain<3>(const SimplexMesh<3>&, const Problem<3>&);
template void constrainEnds<2>(const SimplexMesh<2>&, int, double, double, Problem<2>&);
template void constrainEnds<3>(const SimplexMesh<3>&, int, double, double, Problem<3>&);
}
