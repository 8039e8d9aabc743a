// SPDX-License-Identifier: BSD-3-Clause
// From arrays and properties to the problem of the core: temperature, materials, what is held.
#include "vtkThermoelasticProblem.h"

#include "vtkThermoelasticFilter.h"
#include "vtkThermoelasticLoads.h"

#include "vtkDataArray.h"
#include "vtkUnstructuredGrid.h"

#include <cmath>

namespace vtkThermoelasticBridge
{

using meshopt::Index;
using meshopt::Vec;
using vtkMeshBridge::Frame;
using vtkMeshBridge::UsedBySimplex;

namespace
{

/**
 * Points within this fraction of the extent belong to an end of the body.
 */
constexpr double EndTolerance = 1e-6;

/**
 * The coordinate of the grid that is component `i` of the core; -1 if there is none (in a plane
 * that is not parallel to two axes).
 */
int GridAxis(const Frame<3>&, int i) { return i; }
int GridAxis(const Frame<2>& frame, int i) { return frame.Direct[i]; }

bool IsAligned(const Frame<3>&) { return true; }
bool IsAligned(const Frame<2>& frame) { return frame.Direct[0] >= 0; }

/**
 * Points that no element has carry nothing: their values need not be usable.
 */
template <int D>
bool IsUsed(const Model<D>& model, vtkIdType p)
{
  return (model.Cells.PointUse[static_cast<std::size_t>(p)] & UsedBySimplex) != 0;
}

/**
 * By formula at the points, as from an array: within an element the temperature is linear in any
 * case.
 */
template <int D>
std::string SetTemperature(const Request& request, Model<D>& model)
{
  const vtkIdType n = model.Grid->GetNumberOfPoints();
  std::vector<double>& temperature = model.Problem.temperature;
  model.Problem.referenceTemperature = request.ReferenceTemperature;
  vtkDataArray* array = model.Arrays[TemperatureArray];
  if (request.TemperatureMode == vtkThermoelasticFilter::PointArray && !array)
  {
    return std::string("There is no temperature: the input has no point array '") +
      DefaultName(TemperatureArray) +
      "'. Choose another array, or let the temperature be radial or uniform.";
  }
  // For the uniform mode; the others overwrite it.
  temperature.assign(static_cast<std::size_t>(n), request.UniformTemperature);
  for (vtkIdType p = 0; p < n; ++p)
  {
    if (request.TemperatureMode == vtkThermoelasticFilter::PointArray)
    {
      temperature[p] = array->GetComponent(p, 0);
    }
    else if (request.TemperatureMode == vtkThermoelasticFilter::Radial)
    {
      double x[3];
      model.Grid->GetPoint(p, x);
      // The square of the distance from the axis, which runs through the origin.
      const double a = x[(request.Axis + 1) % 3], b = x[(request.Axis + 2) % 3];
      temperature[p] = request.AxisTemperature - request.RadialCoefficient * (a * a + b * b);
    }
  }
  return {};
}

/**
 * One material for all, unless an array makes them differ.
 */
template <int D>
void SetMaterials(const Request& request, Model<D>& model)
{
  std::vector<meshopt::fem::Material>& materials = model.Problem.materials;
  const InputArrays& arrays = model.Arrays;
  materials.assign(1, request.Material);
  model.Problem.planeState = request.PlaneState;
  if (!arrays[YoungsModulusArray] && !arrays[PoissonsRatioArray] && !arrays[ThermalExpansionArray])
  {
    // One for all: the core then stores one, and no list with the length of the mesh.
    return;
  }
  materials.assign(model.Cells.Simplices.size(), request.Material);
  // An array replaces one property; the others stay those of the request.
  const auto read = [&](ArrayIndex index, double meshopt::fem::Material::*member)
  {
    for (std::size_t c = 0; c < materials.size() && arrays[index]; ++c)
    {
      materials[c].*member = arrays[index]->GetComponent(model.Cells.Simplices[c], 0);
    }
  };
  read(YoungsModulusArray, &meshopt::fem::Material::youngsModulus);
  read(PoissonsRatioArray, &meshopt::fem::Material::poissonsRatio);
  read(ThermalExpansionArray, &meshopt::fem::Material::thermalExpansion);
}

template <int D>
void Prescribe(Model<D>& model, vtkIdType p, int component, const Vec<D>& value)
{
  model.Problem.constraints.push_back({ static_cast<Index>(p), component, value[component] });
}

/**
 * The components of a point that are held: none where the mask is 0; all if it has one component.
 */
void ReadMask(vtkDataArray* mask, vtkIdType p, bool held[3])
{
  for (int i = 0; i < 3; ++i)
  {
    held[i] = mask->GetComponent(p, mask->GetNumberOfComponents() == 3 ? i : 0) != 0.0;
  }
}

bool HasNaN(vtkDataArray* array, vtkIdType p)
{
  bool found = false;
  for (int i = 0; i < array->GetNumberOfComponents(); ++i)
  {
    found |= std::isnan(array->GetComponent(p, i));
  }
  return found;
}

/**
 * Components of the core are components of the grid if the plane is parallel to two axes. Otherwise
 * all components of a point must be held, or none.
 */
template <int D>
std::string SetConstraints(Model<D>& model)
{
  vtkDataArray* mask = model.Arrays[ConstraintArray];
  vtkDataArray* displacement = model.Arrays[PrescribedDisplacementArray];
  if (displacement && !mask)
  {
    return std::string("There are prescribed displacements ('") + displacement->GetName() +
      "'), but no constraint array ('" + DefaultName(ConstraintArray) +
      "') that says which components they are prescribed for.";
  }
  // A mask without displacements holds points where they are.
  for (vtkIdType p = 0; p < model.Grid->GetNumberOfPoints() && mask; ++p)
  {
    bool held[3];
    ReadMask(mask, p, held);
    // NaN is not 0: points of which nothing is known, as of vtkTetGenFilter, would be held.
    if (IsUsed(model, p) && HasNaN(mask, p))
    {
      return std::string("The constraint '") + mask->GetName() + "' at point " + std::to_string(p) +
        " is not a number.";
    }
    if (!IsUsed(model, p) || (!held[0] && !held[1] && !held[2]))
    {
      continue;
    }
    double value[3] = { 0.0, 0.0, 0.0 };
    if (displacement)
    {
      displacement->GetTuple(p, value);
    }
    if (!IsAligned(model.Frame) && !(held[0] && held[1] && held[2]))
    {
      return "Point " + std::to_string(p) +
        " is held in some components only, but the mesh lies in a plane that is not parallel to "
        "two "
        "axes: hold all three, or none.";
    }
    // In a plane across axes all components are held: those of the core are then given, too.
    for (int i = 0; i < D; ++i)
    {
      if (!IsAligned(model.Frame) || held[GridAxis(model.Frame, i)])
      {
        Prescribe(model, p, i, VectorToCore(model.Frame, value));
      }
    }
  }
  return {};
}

template <int D>
std::string SetGeneralizedPlaneStrain(const Request& request, Model<D>& model, double& axialStrain)
{
  if (!request.GeneralizedPlaneStrain)
  {
    return {};
  }
  if (!IsAligned(model.Frame))
  {
    return "Generalized plane strain: the mesh lies in a plane that is not parallel to two axes.";
  }
  // The strain is a mean of material and temperature: check these first.
  const auto error = meshopt::fem::check(model.Mesh, model.Problem);
  if (error)
  {
    return vtkMeshBridge::WithGridIds(error->message, error->cell, model.Cells);
  }
  // Free: such that the ends carry no force, found before anything is solved.
  axialStrain = request.IsAxialStrainGiven
    ? request.AxialStrain
    : meshopt::fem::freeAxialStrain(model.Mesh, model.Problem);
  for (int i = 0; i < D; ++i)
  {
    // The axis lies in the mesh: its ends are held apart by the strain.
    if (GridAxis(model.Frame, i) == request.Axis)
    {
      meshopt::fem::constrainEnds(model.Mesh, i, axialStrain, EndTolerance, model.Problem);
      return {};
    }
  }
  // Otherwise the axis is the normal of the plane.
  if (request.PlaneState == meshopt::fem::PlaneState::PlaneStress)
  {
    return std::string("Generalized plane strain along ") + static_cast<char>('x' + request.Axis) +
      ", the normal of the plane, needs the plane state to be plane strain.";
  }
  model.Problem.outOfPlaneStrain = axialStrain;
  return {};
}

} // namespace

template <int D>
std::string MakeProblem(const Request& request, Model<D>& model, double& axialStrain)
{
  model.Problem.rigidMotion = request.RigidMotion;
  std::string error = SetTemperature(request, model);
  if (!error.empty())
  {
    return error;
  }
  SetMaterials(request, model);
  // The ends come first, so that constraints of single points take precedence.
  error = SetGeneralizedPlaneStrain(request, model, axialStrain);
  if (error.empty())
  {
    error = SetConstraints(model);
  }
  return error.empty() ? SetLoads(request, model) : error;
}

template std::string MakeProblem<2>(const Request&, Model<2>&, double&);
template std::string MakeProblem<3>(const Request&, Model<3>&, double&);

} // namespace vtkThermoelasticBridge
