// SPDX-License-Identifier: BSD-3-Clause
// Pressure and tractions on the surface. A load that would be lost is an error, since the result
// would look right.
#include "vtkThermoelasticLoads.h"

#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkUnstructuredGrid.h"

#include "Thermoelastic/Loads.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace vtkThermoelasticBridge
{

using meshopt::Facet;
using meshopt::Index;
using meshopt::Vec;

namespace
{

/**
 * Adds a load to a facet of the surface. Value `ids[k]` of `array` is that of its k-th point: a
 * traction if it has three components, a pressure if it has one.
 */
template <int D>
void AddLoad(
  Model<D>& model, const Facet<D>& facet, vtkDataArray* array, const std::array<vtkIdType, D>& ids)
{
  std::vector<Vec<D>>& forces = model.Problem.forces;
  if (array->GetNumberOfComponents() == 1)
  {
    std::array<double, D> pressure;
    for (int k = 0; k < D; ++k)
    {
      pressure[k] = array->GetComponent(ids[k], 0);
    }
    meshopt::fem::addPressure<D>(model.Mesh, facet, pressure, forces);
    return;
  }
  std::array<Vec<D>, D> traction;
  for (int k = 0; k < D; ++k)
  {
    double value[3];
    array->GetTuple(ids[k], value);
    traction[k] = VectorToCore(model.Frame, value);
  }
  meshopt::fem::addTraction<D>(model.Mesh, facet, traction, forces);
}

// Exactly: 0 says "no load here". NaN is not 0, and is refused later.
bool IsZero(vtkDataArray* array, vtkIdType id)
{
  for (int i = 0; i < array->GetNumberOfComponents(); ++i)
  {
    if (array->GetComponent(id, i) != 0.0)
    {
      return false;
    }
  }
  return true;
}

/**
 * Asked before a load is added: through the solution, one that is not finite would reach all
 * points.
 */
bool IsFinite(vtkDataArray* array, vtkIdType id)
{
  for (int i = 0; i < array->GetNumberOfComponents(); ++i)
  {
    if (!std::isfinite(array->GetComponent(id, i)))
    {
      return false;
    }
  }
  return true;
}

/**
 * Whether a load of a mesh in a plane has a part across it, which plane problems do not know.
 */
bool IsAcross(const vtkMeshBridge::Frame<3>&, vtkDataArray*, vtkIdType) { return false; }
bool IsAcross(const vtkMeshBridge::Frame<2>& frame, vtkDataArray* array, vtkIdType id)
{
  if (array->GetNumberOfComponents() == 1)
  {
    return false; // a pressure
  }
  constexpr double slack = 1e-6; // planes across the axes are rounded
  double value[3];
  array->GetTuple(id, value);
  const Vec<3> load(value[0], value[1], value[2]);
  const double most = load.cwiseAbs().maxCoeff();
  const Vec<3> across = frame.Axes[0].cross(frame.Axes[1]);
  return std::fabs(load.dot(across)) > slack * most;
}

std::string DescribeAcross(vtkDataArray* array, const char* kind, vtkIdType id)
{
  return std::string("The traction '") + array->GetName() + "' at " + kind + " " +
    std::to_string(id) +
    " has a part across the plane of the mesh. In plane problems nothing can bear that.";
}

/**
 * Facets whose points all carry a load. Loads without any such facet are an error: a load must not
 * be lost silently.
 */
template <int D>
std::string AddPointTractions(const std::vector<Facet<D>>& surface, Model<D>& model)
{
  vtkDataArray* array = model.Arrays[TractionArray];
  bool isAnyLoaded = false;
  for (const Facet<D>& facet : surface)
  {
    std::array<vtkIdType, D> ids;
    bool isLoaded = true;
    for (int k = 0; k < D; ++k)
    {
      // A zero at one corner: the facet is beside the loaded part, not in it.
      ids[k] = facet[k];
      isLoaded &= !IsZero(array, ids[k]);
      if (!IsFinite(array, ids[k]))
      {
        return std::string("The traction '") + array->GetName() + "' at point " +
          std::to_string(ids[k]) + " is not finite.";
      }
    }
    if (isLoaded)
    {
      for (const vtkIdType p : ids)
      {
        if (IsAcross(model.Frame, array, p))
        {
          return DescribeAcross(array, "point", p);
        }
      }
      AddLoad<D>(model, facet, array, ids);
      isAnyLoaded = true;
    }
  }
  // An array of zeros is no load, and no fault.
  for (vtkIdType point = 0; point < array->GetNumberOfTuples() && !isAnyLoaded; ++point)
  {
    if (!IsZero(array, point))
    {
      return std::string("The traction '") + array->GetName() + "' at point " +
        std::to_string(point) +
        " has nothing to act on: no facet of the surface has a traction at all of its points.";
    }
  }
  return {};
}

/**
 * Cells of the grid that are facets: triangles in 3D, lines in 2D.
 */
template <int D>
std::string AddFacetTractions(const std::vector<Facet<D>>& surface, Model<D>& model)
{
  vtkDataArray* array = model.Arrays[FacetTractionArray];
  const auto sorted = [](Facet<D> facet)
  {
    std::sort(facet.begin(), facet.end());
    return facet;
  };
  // By sorted corners: the facet's cell may number them in any order.
  std::map<Facet<D>, Facet<D>> oriented;
  for (const Facet<D>& facet : surface)
  {
    // A pressure acts inwards: the mesh tells where that is, the numbering of the facet's cell does
    // not.
    oriented[sorted(facet)] = facet;
  }
  std::map<Facet<D>, vtkIdType> loaded; // by which cell
  for (vtkIdType c = 0; c < model.Grid->GetNumberOfCells(); ++c)
  {
    vtkIdType n = 0;
    const vtkIdType* ids = nullptr;
    model.Grid->GetCellPoints(c, n, ids);
    const int type = model.Grid->GetCellType(c);
    // Marks of the right dimension; other cells of the grid are no loads.
    if (type != (D == 3 ? VTK_TRIANGLE : VTK_LINE) || n != D || IsZero(array, c))
    {
      continue;
    }
    Facet<D> facet;
    std::copy(ids, ids + D, facet.begin());
    const auto found = oriented.find(sorted(facet));
    const std::string title = std::string("The facet traction '") + array->GetName() +
      "' of cell " + std::to_string(c);
    if (!IsFinite(array, c))
    {
      return title + " is not finite.";
    }
    if (found == oriented.end())
    {
      return title + " has nothing to act on: the cell is no facet of the surface of the " +
        (D == 3 ? "tetrahedra." : "triangles.");
    }
    const auto [other, isFirst] = loaded.emplace(found->first, c);
    if (!isFirst)
    {
      return title + " acts on the same facet as that of cell " + std::to_string(other->second) +
        ".";
    }
    if (IsAcross(model.Frame, array, c))
    {
      return DescribeAcross(array, "cell", c);
    }
    // One value for the facet, the same at all its corners.
    std::array<vtkIdType, D> same;
    same.fill(c);
    AddLoad<D>(model, found->second, array, same);
  }
  return {};
}

} // namespace

template <int D>
std::string SetLoads(const Request& request, Model<D>& model)
{
  const bool hasPoints = model.Arrays[TractionArray] != nullptr;
  const bool hasFacets = model.Arrays[FacetTractionArray] != nullptr;
  // No loads: an empty list spares the core all sums.
  if (request.SurfacePressure == 0.0 && !hasPoints && !hasFacets)
  {
    return {};
  }
  // Before it is multiplied: the core would blame a point of the surface.
  if (!std::isfinite(request.SurfacePressure))
  {
    return "The pressure on the surface is not finite.";
  }
  model.Problem.forces.assign(
    static_cast<std::size_t>(model.Grid->GetNumberOfPoints()), Vec<D>::Zero());
  const std::vector<Facet<D>> surface = meshopt::fem::surfaceFacets(model.Mesh);
  // On the whole surface, inner walls of cavities included.
  for (const Facet<D>& facet : surface)
  {
    std::array<double, D> pressure;
    pressure.fill(request.SurfacePressure);
    meshopt::fem::addPressure<D>(model.Mesh, facet, pressure, model.Problem.forces);
  }
  std::string error = hasPoints ? AddPointTractions<D>(surface, model) : std::string();
  if (error.empty() && hasFacets)
  {
    error = AddFacetTractions<D>(surface, model);
  }
  return error;
}

template std::string SetLoads<2>(const Request&, Model<2>&);
template std::string SetLoads<3>(const Request&, Model<3>&);

} // namespace vtkThermoelasticBridge
