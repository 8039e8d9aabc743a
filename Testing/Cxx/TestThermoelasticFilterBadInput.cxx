// SPDX-License-Identifier: BSD-3-Clause
// What vtkThermoelasticFilter does with what cannot be solved: one error that names what and where,
// and empty outputs.
#include "ThermoelasticFilterTesting.h"

#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkStringArray.h"

using namespace Testing;

namespace
{

using Prepare = std::function<void(vtkThermoelasticFilter*)>;

const double NaN = std::numeric_limits<double>::quiet_NaN();

/**
 * ExpectError() of FilterTesting.h, also nothing in the history and the figures; others are not
 * affected.
 */
void ExpectError(vtkUnstructuredGrid* input, const Texts& words, const Prepare& prepare = nullptr)
{
  Filter filter = MakeFilter(input);
  filter->SetRigidMotionToPin();
  Testing::ExpectError(filter.Get(), input, words, prepare);
  EXPECT_EQ(vtkTable::SafeDownCast(filter->GetOutputDataObject(1))->GetNumberOfRows(), 0);
  EXPECT_EQ(filter->GetStopReason(), vtkThermoelasticFilter::NotRun);
  EXPECT_EQ(filter->GetStrainEnergy(), 0.0);

  Filter healthy = MakeFilter(MakeBox(2, 0.1));
  healthy->SetRigidMotionToPin();
  Solve(healthy);
}

std::function<Point(const Point&)> Constant(double value)
{
  return [=](const Point&) { return Point{ { value, value, value } }; };
}

Grid With(bool onCells, const char* name, int components,
  const std::function<Point(const Point&)>& function)
{
  Grid box = MakeBox(2, 0.1);
  AddArray(box, onCells, name, components, function);
  return box;
}

TEST(ThermoelasticFilterBadInput, TemperatureArrayMustBeThere)
{
  Grid box = MakeBox(2, 0.1);
  ExpectError(box, { "no temperature", "'Temperature'" },
    [](vtkThermoelasticFilter* f) { f->SetTemperatureModeToPointArray(); });
}

TEST(ThermoelasticFilterBadInput, RigidMotionMustBeHeld)
{
  Grid box = MakeBox(2, 0.1);
  ExpectError(box, { "no constraints", "translate and rotate freely" },
    [](vtkThermoelasticFilter* f) { f->SetRigidMotionToForbid(); });
  ExpectError(box, { "too few constraints", "translate along (1, 0, 0)" },
    [](vtkThermoelasticFilter* f)
    {
      f->SetRigidMotionToForbid();
      f->GeneralizedPlaneStrainOn();
    });
}

TEST(ThermoelasticFilterBadInput, MaterialMustBePossible)
{
  Grid box = MakeBox(2, 0.1);
  ExpectError(
    box, { "Poisson's ratio is 0.5" }, [](vtkThermoelasticFilter* f) { f->SetPoissonsRatio(0.5); });
  ExpectError(
    box, { "Poisson's ratio is -1" }, [](vtkThermoelasticFilter* f) { f->SetPoissonsRatio(-1.0); });
  ExpectError(
    box, { "Young's modulus is 0" }, [](vtkThermoelasticFilter* f) { f->SetYoungsModulus(0.0); });
  ExpectError(box, { "thermal expansion is nan" },
    [](vtkThermoelasticFilter* f) { f->SetThermalExpansion(NaN); });
}

TEST(ThermoelasticFilterBadInput, OptionsMustBeFinite)
{
  Grid box = MakeBox(2, 0.1);
  ExpectError(box, { "temperature at point 0 is nan" },
    [](vtkThermoelasticFilter* f) { f->SetUniformTemperature(NaN); });
  ExpectError(box, { "reference temperature" },
    [](vtkThermoelasticFilter* f) { f->SetReferenceTemperature(NaN); });
  ExpectError(box, { "pressure" }, [](vtkThermoelasticFilter* f) { f->SetSurfacePressure(NaN); });
  ExpectError(box, { "not finite" },
    [](vtkThermoelasticFilter* f)
    {
      f->GeneralizedPlaneStrainOn();
      f->SetAxialStrainModeToGiven();
      f->SetAxialStrain(NaN);
    });
}

/**
 * NaN at point 2.
 */
Point OneBad(const Point& x)
{
  return { { x[0] == 1.0 && x[1] == 0.0 && x[2] == 0.0 ? NaN : 1.0, 0.0, 0.0 } };
}

TEST(ThermoelasticFilterBadInput, TemperatureArray)
{
  const auto useArray = [](vtkThermoelasticFilter* f) { f->SetTemperatureModeToPointArray(); };
  ExpectError(With(false, "Temperature", 1, OneBad), { "temperature at point 2 is nan" }, useArray);
  ExpectError(With(false, "Temperature", 2, Constant(1.0)),
    { "temperature array 'Temperature'", "2 components", "one is needed" }, useArray);
  ExpectError(MakeBox(2, 0.1), { "temperature array 'T'", "no such point array" },
    [](vtkThermoelasticFilter* f)
    {
      f->SetTemperatureModeToPointArray();
      f->SetTemperatureArray("T");
    });
  Grid words = MakeBox(2, 0.1);
  vtkNew<vtkStringArray> strings;
  strings->SetName("Temperature");
  strings->SetNumberOfValues(words->GetNumberOfPoints());
  words->GetPointData()->AddArray(strings);
  ExpectError(words, { "type string", "numbers are needed" }, useArray);
}

TEST(ThermoelasticFilterBadInput, MaterialArrays)
{
  ExpectError(With(true, "PoissonsRatio", 1,
                [](const Point& x) { return Point{ { x[0] > 0.5 ? 0.5 : 0.3 } }; }),
    { "Poisson's ratio of cell ", "is 0.5" });
  ExpectError(With(true, "YoungsModulus", 3, Constant(1.0)), { "3 components" });
  ExpectError(With(true, "part", 1, Constant(1.0)), { "region array 'part'", "integers" },
    [](vtkThermoelasticFilter* f) { f->SetRegionArray("part"); });
}

TEST(ThermoelasticFilterBadInput, ConstraintArrays)
{
  ExpectError(
    With(false, "Constraint", 2, Constant(1.0)), { "constraint array", "one or three are needed" });
  ExpectError(With(false, "PrescribedDisplacement", 3, Constant(1.0)),
    { "prescribed displacements", "no constraint array" });
  // As vtkTetGenFilter fills in what it does not know.
  ExpectError(With(false, "Constraint", 1, OneBad), { "constraint 'Constraint' at point 2" });
  Grid held = With(false, "Constraint", 1, Constant(1.0));
  AddArray(held, false, "PrescribedDisplacement", 3, OneBad);
  ExpectError(held, { "prescribed displacement at point 2" });
}

TEST(ThermoelasticFilterBadInput, TractionsMustBeFinite)
{
  const auto oneBad = [](const Point& x) {
    return Point{ { 0.0, x[0] == 1.0 && x[1] == 0.0 && x[2] == 0.0 ? NaN : 1.0, 0.0 } };
  };
  ExpectError(With(false, "Traction", 3, oneBad), { "traction 'Traction' at point 2" });
}

TEST(ThermoelasticFilterBadInput, TractionsMustHaveAFacetToActOn)
{
  const auto atOnePoint = [](const Point& x) {
    return Point{ { 0.0, x[0] == 1.0 && x[1] == 0.0 && x[2] == 0.0 ? 1.0 : 0.0, 0.0 } };
  };
  ExpectError(With(false, "Traction", 3, atOnePoint),
    { "traction 'Traction' at point 2", "nothing to act on" });
}

TEST(ThermoelasticFilterBadInput, LoadsMustBeInEquilibrium)
{
  const auto onTop = [](const Point& x) { return Point{ { 0.0, 0.0, x[2] == 1.0 ? 2.0 : 0.0 } }; };
  ExpectError(
    With(false, "Traction", 3, onTop), { "not in equilibrium", "translate along (0, 0, 1)" });
}

TEST(ThermoelasticFilterBadInput, FacetTractionsMustBeOnTheSurface)
{
  Grid facets = MakeBox(2, 0.0);
  AddCell(facets, VTK_TRIANGLE, { 0, 1, 13 }); // 13 is the centre
  AddArray(facets, true, "FacetTraction", 1, [](const Point&) { return Point{ { 1.0 } }; });
  ExpectError(facets, { "facet traction 'FacetTraction' of cell 48", "no facet of the surface" });
}

TEST(ThermoelasticFilterBadInput, FacetTractionsMustNotBeThereTwice)
{
  Grid facets = MakeBox(2, 0.0);
  AddCell(facets, VTK_TRIANGLE, { 0, 1, 4 });
  AddCell(facets, VTK_TRIANGLE, { 4, 1, 0 });
  AddArray(facets, true, "FacetTraction", 1, [](const Point&) { return Point{ { 1.0 } }; });
  ExpectError(facets, { "of cell 49", "same facet", "cell 48" });
}

TEST(ThermoelasticFilterBadInput, TractionsOfAPlaneMustBeInIt)
{
  const auto oblique = [](double x, double y) { return Point{ { x, 0.6 * y, 0.8 * y } }; };
  for (const double across : { 1.0, 0.0 })
  {
    Grid square = MakeSquare(3, 0.1, oblique);
    AddArray(square, false, "Traction", 3,
      [&](const Point& x)
      {
        const double in = x[0] - 0.5; // in equilibrium, along the plane
        return Point{ { 0.0, 0.6 * in - 0.8 * across, 0.8 * in + 0.6 * across } };
      });
    if (across > 0.0)
    {
      ExpectError(square, { "traction 'Traction' at point", "across the plane" });
      continue;
    }
    Filter filter = MakeFilter(square);
    filter->SetRigidMotionToPin();
    const Messages messages(filter);
    filter->Update();
    EXPECT_TRUE(messages.Errors.empty() || !Says(messages.Errors[0], "across the plane"));
  }
}

TEST(ThermoelasticFilterBadInput, CellsMustNotBeInvertedOrFlat)
{
  Grid inverted = MakeBox(2, 0.0);
  inverted->GetPoints()->SetPoint(13, 1.2, 0.5, 0.5); // the centre, pulled out of the box
  inverted->Modified();
  ExpectError(inverted, { "Cell ", "is inverted", "volume is -0.0" });
  Grid flat = MakeBox(2, 0.0);
  flat->GetPoints()->SetPoint(13, 1.0, 0.5, 0.5);
  ExpectError(flat, { "Cell ", "is flat" });
}

TEST(ThermoelasticFilterBadInput, ErrorNamesTheCellOfTheGrid)
{
  // With other cells before them, tetrahedra are counted by themselves; both ids are named.
  Grid mixed = MakeGrid({ { { 0, 0, 0 } }, { { 1, 0, 0 } }, { { 0, 1, 0 } }, { { 1, 1, 0 } } });
  AddCell(mixed, VTK_TRIANGLE, { 0, 1, 2 });
  AddCell(mixed, VTK_TETRA, { 0, 1, 2, 3 });
  ExpectError(mixed, { "Cell 0 is flat", "is cell 1 of the grid" });
}

TEST(ThermoelasticFilterBadInput, CellsMustBeLinearTrianglesOrTetrahedra)
{
  Grid hexahedron = MakeBox(1, 0.0);
  AddCell(hexahedron, VTK_HEXAHEDRON, { 0, 1, 3, 2, 4, 5, 7, 6 });
  ExpectError(hexahedron, { "Cell 6 (vtkHexahedron)", "Tetrahedralize" });
  Grid quadratic = MakeGrid({ { { 0, 0, 0 } }, { { 1, 0, 0 } }, { { 0, 1, 0 } }, { { .5, 0, 0 } },
    { { .5, .5, 0 } }, { { 0, .5, 0 } } });
  AddCell(quadratic, VTK_QUADRATIC_TRIANGLE, { 0, 1, 2, 3, 4, 5 });
  ExpectError(quadratic, { "Cell 0 (vtkQuadraticTriangle)" });
  Grid line = MakeGrid({ { { 0, 0, 0 } }, { { 1, 0, 0 } } });
  AddCell(line, VTK_LINE, { 0, 1 });
  ExpectError(line, { "neither triangles nor tetrahedra" });
}

TEST(ThermoelasticFilterBadInput, PointsMustBeFinite)
{
  Grid broken = MakeGrid({ { { 0, 0, 0 } }, { { 1, 0, 0 } }, { { 0, NaN, 0 } } });
  AddCell(broken, VTK_TRIANGLE, { 0, 1, 2 });
  ExpectError(broken, { "Point 2", "not finite" });
}

TEST(ThermoelasticFilterBadInput, ObliquePlaneHasNoAxisAndNoComponents)
{
  const auto oblique = [](double x, double y) { return Point{ { x, 0.6 * y, 0.8 * y } }; };
  Grid square = MakeSquare(3, 0.1, oblique);
  ExpectError(square, { "Generalized plane strain", "not parallel" },
    [](vtkThermoelasticFilter* f) { f->GeneralizedPlaneStrainOn(); });
  AddArray(square, false, "Constraint", 3, [](const Point&) { return Point{ { 1.0, 0.0, 0.0 } }; });
  ExpectError(square, { "Point 0 is held in some components only", "not parallel" });
}

TEST(ThermoelasticFilterBadInput, GeneralizedPlaneStrainIsNoPlaneStress)
{
  Grid flat = MakeSquare(3, 0.1, [](double x, double y) { return Point{ { x, y, 0.0 } }; });
  ExpectError(flat, { "along z", "plane strain" },
    [](vtkThermoelasticFilter* f)
    {
      f->GeneralizedPlaneStrainOn();
      f->SetPlaneStateToPlaneStress();
    });
}

TEST(ThermoelasticFilterBadInput, TrianglesMustBeInOnePlane)
{
  Grid bent = MakeSquare(3, 0.1, [](double x, double y) { return Point{ { x, y, x * x } }; });
  ExpectError(bent, { "not in one plane" });
}
} // namespace
