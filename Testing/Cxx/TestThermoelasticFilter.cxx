// SPDX-License-Identifier: BSD-3-Clause
// vtkThermoelasticFilter: arrays in and out, loads, constraints, planes, figures. What the elements
// themselves compute is tested in the core.
#include "ThermoelasticFilterTesting.h"

#include "vtkFloatArray.h"
#include "vtkIntArray.h"

using namespace Testing;

namespace
{

const std::vector<double> Zero6(6, 0.0);

/**
 * A box that is free, and hotter by 20: it expands by 0.2.
 */
Filter ExpandFreely(vtkUnstructuredGrid* box)
{
  Filter filter = MakeFilter(box);
  filter->SetUniformTemperature(30.0);
  filter->SetReferenceTemperature(10.0);
  filter->SetRigidMotionToProject();
  return Solve(filter);
}

TEST(ThermoelasticFilter, FreeExpansionHasNoStress)
{
  Grid box = MakeBox(4, 0.15);
  Filter filter = ExpandFreely(box);
  vtkDataArray* u = PointArray(filter, "Displacement");
  EXPECT_EQ(u->GetNumberOfComponents(), 3);
  double a[3], b[3];
  u->GetTuple(0, a);
  u->GetTuple(box->GetNumberOfPoints() - 1, b);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(b[i] - a[i], 0.2, 1e-10);
  }
  EXPECT_TRUE(IsUniform(PointArray(filter, "Stress"), Zero6));
  EXPECT_TRUE(IsUniform(CellArray(filter, "ElementStress"), Zero6));
  EXPECT_TRUE(IsUniform(PointArray(filter, "VonMises"), { 0.0 }));
  EXPECT_TRUE(IsUniform(PointArray(filter, "PrincipalStress"), { 0.0, 0.0, 0.0 }));
  EXPECT_TRUE(IsUniform(PointArray(filter, "Reaction"), { 0.0, 0.0, 0.0 }));
  EXPECT_TRUE(IsUniform(PointArray(filter, "Temperature"), { 30.0 }));
  EXPECT_TRUE(IsUniform(CellArray(filter, "StrainEnergyDensity"), { 0.0 }));
  EXPECT_TRUE(IsUniform(CellArray(filter, "ErrorEstimate"), { 0.0 }));
  EXPECT_STREQ(PointArray(filter, "Stress")->GetComponentName(5), "XZ");
}

TEST(ThermoelasticFilter, InputIsCarriedAlongAndLeft)
{
  Grid box = MakeBox(4, 0.15);
  AddArray<vtkFloatArray>(box, false, "Mine", 1, [](const Point& x) { return x; });
  Filter filter = ExpandFreely(box);
  EXPECT_TRUE(SameArray(PointArray(filter, "Mine"), box->GetPointData()->GetArray("Mine")));
  EXPECT_EQ(box->GetPointData()->GetNumberOfArrays(), 1);
  EXPECT_EQ(box->GetCellData()->GetNumberOfArrays(), 0);
}

TEST(ThermoelasticFilter, HistoryAndFiguresAreThoseOfTheRun)
{
  Grid box = MakeBox(4, 0.15);
  Filter filter = ExpandFreely(box);
  vtkTable* history = vtkTable::SafeDownCast(filter->GetOutputDataObject(1));
  EXPECT_EQ(history->GetNumberOfRows(), filter->GetNumberOfSolverIterations() + 1);
  EXPECT_EQ(history->GetValueByName(0, "RelativeResidual").ToDouble(), 1.0);
  EXPECT_EQ(history->GetValueByName(history->GetNumberOfRows() - 1, "RelativeResidual").ToDouble(),
    filter->GetRelativeResidual());
  EXPECT_LE(filter->GetRelativeResidual(), 1e-13);
  EXPECT_EQ(filter->GetNumberOfUnknowns(), 3 * box->GetNumberOfPoints());
  vtkDataArray* steps = filter->GetOutput(0)->GetFieldData()->GetArray("NumberOfSolverIterations");
  ASSERT_TRUE(steps);
  EXPECT_EQ(steps->GetTuple1(0), filter->GetNumberOfSolverIterations());
}

/**
 * A bar along x, held at one end and pulled at the other by a prescribed displacement.
 */
Grid MakePulledBar()
{
  Grid box = MakeBox(3, 0.15);
  const auto mask = [](const Point& x)
  {
    const double end = x[0] == 0.0 || x[0] == 1.0 ? 1.0 : 0.0;
    return Point{ { end, x[1] == 0.0 ? 1.0 : 0.0, x[2] == 0.0 ? 1.0 : 0.0 } };
  };
  AddArray<vtkIntArray>(box, false, "Constraint", 3, mask);
  AddArray(box, false, "PrescribedDisplacement", 3,
    [](const Point& x) {
      return Point{ { 0.1 * x[0], 0.0, 0.0 } };
    });
  return box;
}

TEST(ThermoelasticFilter, PrescribedDisplacementStretches)
{
  Grid box = MakePulledBar();
  Filter filter = Solve(MakeFilter(box));
  EXPECT_TRUE(IsUniform(PointArray(filter, "Stress"), { 0.1, 0.0, 0.0, 0.0, 0.0, 0.0 }));
  EXPECT_TRUE(IsUniform(PointArray(filter, "VonMises"), { 0.1 }));
  EXPECT_TRUE(IsUniform(PointArray(filter, "PrincipalStress"), { 0.1, 0.0, 0.0 }));
  EXPECT_TRUE(IsUniform(CellArray(filter, "StrainEnergyDensity"), { 0.005 }));
  EXPECT_NEAR(filter->GetStrainEnergy(), 0.005, 1e-12);
  double pull = 0.0;
  for (vtkIdType p = 0; p < box->GetNumberOfPoints(); ++p)
  {
    const double force = PointArray(filter, "Reaction")->GetComponent(p, 0);
    const double x = GetPoint(box, p)[0];
    pull += x == 1.0 ? force : 0.0;
    EXPECT_TRUE(x == 0.0 || x == 1.0 || force == 0.0) << force << " at point " << p;
  }
  EXPECT_NEAR(pull, 0.1, 1e-11);
}

TEST(ThermoelasticFilter, ArraysMayHaveOtherNames)
{
  Filter filter = Solve(MakeFilter(MakePulledBar()));
  Grid renamed = MakePulledBar();
  renamed->GetPointData()->GetArray("Constraint")->SetName("held");
  renamed->GetPointData()->GetArray("PrescribedDisplacement")->SetName("u");
  Filter other = MakeFilter(renamed);
  other->SetConstraintArray("held");
  other->SetPrescribedDisplacementArray("u");
  Solve(other);
  EXPECT_TRUE(SameArray(PointArray(other, "Stress"), PointArray(filter, "Stress")));
}

TEST(ThermoelasticFilter, OneComponentOfConstraintsHoldsAllThree)
{
  Grid all = MakeBox(3, 0.15);
  AddArray<vtkIntArray>(all, false, "Constraint", 1,
    [](const Point& x) { return Point{ { x[0] == 0.0 ? 2.0 : 0.0 } }; });
  Filter held = MakeFilter(all);
  held->SetUniformTemperature(10.0);
  Solve(held);
  for (vtkIdType p = 0; p < all->GetNumberOfPoints(); ++p)
  {
    double u[3];
    PointArray(held, "Displacement")->GetTuple(p, u);
    EXPECT_EQ(GetPoint(all, p)[0] == 0.0, u[0] == 0.0 && u[1] == 0.0 && u[2] == 0.0);
  }
}

/**
 * The surface triangles with x = 1 as cells of their own.
 */
void AddTrianglesAtEnd(vtkUnstructuredGrid* box)
{
  for (const std::vector<Point>& facet : KeptFacets(box))
  {
    std::vector<vtkIdType> ids;
    for (const Point& x : facet)
    {
      ids.push_back(x[0] == 1.0 ? box->FindPoint(const_cast<double*>(x.data())) : -1);
    }
    if (*std::min_element(ids.begin(), ids.end()) >= 0)
    {
      AddCell(box, VTK_TRIANGLE, ids);
    }
  }
}

/**
 * The same load in four ways: a bar held at x = 0 (nu = 0) under tension 2.
 */
TEST(ThermoelasticFilter, LoadsOfAllKindsAreTheSame)
{
  const auto isEnd = [](const Point& x) { return x[0] == 1.0; };
  for (int way = 0; way < 4; ++way)
  {
    SCOPED_TRACE(std::string(way % 2 == 0 ? "traction" : "pressure") +
      (way >= 2 ? " on facets" : " at points"));
    Grid box = MakeBox(3, 0.15);
    const vtkIdType tetrahedra = box->GetNumberOfCells();
    AddTrianglesAtEnd(box);
    EXPECT_EQ(box->GetNumberOfCells(), tetrahedra + 2 * 9);
    AddArray(box, false, "Constraint", 1,
      [](const Point& x) { return Point{ { x[0] == 0.0 ? 1.0 : 0.0 } }; });
    const double load = way % 2 == 0 ? 2.0 : -2.0; // traction, or pressure
    AddArray(box, way >= 2, way >= 2 ? "FacetTraction" : "Traction", way % 2 == 0 ? 3 : 1,
      [&](const Point& x) {
        return Point{ { isEnd(x) ? load : 0.0, 0.0, 0.0 } };
      });
    Filter filter = MakeFilter(box);
    filter->SetPoissonsRatio(0.0);
    Solve(filter);
    EXPECT_TRUE(IsUniform(PointArray(filter, "Stress"), { 2.0, 0.0, 0.0, 0.0, 0.0, 0.0 }));
    EXPECT_NEAR(filter->GetStrainEnergy(), 2.0, 1e-10);
    // Triangles pass through, and have no stress.
    EXPECT_EQ(filter->GetOutput(0)->GetNumberOfCells(), box->GetNumberOfCells());
    EXPECT_TRUE(std::isnan(CellArray(filter, "ElementStress")->GetComponent(tetrahedra, 0)));
    EXPECT_TRUE(std::isnan(CellArray(filter, "ErrorEstimate")->GetComponent(tetrahedra, 0)));
    EXPECT_FALSE(std::isnan(CellArray(filter, "ErrorEstimate")->GetComponent(0, 0)));
  }
}

TEST(ThermoelasticFilter, PressureOnAllSidesIsHydrostatic)
{
  Filter filter = MakeFilter(MakeBox(3, 0.15));
  filter->SetSurfacePressure(0.3);
  filter->SetRigidMotionToPin();
  Solve(filter);
  EXPECT_TRUE(IsUniform(PointArray(filter, "Stress"), { -0.3, -0.3, -0.3, 0.0, 0.0, 0.0 }));
}

TEST(ThermoelasticFilter, RadialTemperatureIsThatOfItsFormula)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    SCOPED_TRACE("axis " + std::to_string(axis));
    Grid box = MakeBox(3, 0.15);
    Filter filter = MakeFilter(box);
    filter->SetTemperatureModeToRadial();
    filter->SetAxisTemperature(20.0);
    filter->SetRadialCoefficient(7.0);
    filter->SetAxis(axis);
    filter->SetRigidMotionToPin();
    Solve(filter);
    const auto formula = [&](const Point& x)
    {
      const double a = x[(axis + 1) % 3], b = x[(axis + 2) % 3];
      return Point{ { 20.0 - 7.0 * (a * a + b * b) } };
    };
    AddArray(box, false, "Temperature", 1, formula);
    EXPECT_TRUE(
      SameArray(PointArray(filter, "Temperature"), box->GetPointData()->GetArray("Temperature")));
    box->GetPointData()->GetArray("Temperature")->SetName("T");
    Filter array = MakeFilter(box);
    array->SetTemperatureModeToPointArray();
    array->SetTemperatureArray("T");
    array->SetRigidMotionToPin();
    Solve(array);
    EXPECT_TRUE(SameArray(PointArray(filter, "Stress"), PointArray(array, "Stress")));
    EXPECT_EQ(array->GetOutput(0)->GetPointData()->GetArray("Temperature"), nullptr);
  }
}

/**
 * Ends held along each axis; free and given strain.
 */
TEST(ThermoelasticFilter, GeneralizedPlaneStrainIsFreeOrGiven)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    SCOPED_TRACE("axis " + std::to_string(axis));
    Filter filter = MakeFilter(MakeBox(3, 0.15));
    filter->SetUniformTemperature(2.0); // free strain 0.02
    filter->GeneralizedPlaneStrainOn();
    filter->SetAxis(axis);
    filter->SetRigidMotionToPin();
    Solve(filter);
    EXPECT_NEAR(filter->GetPrescribedAxialStrain(), 0.02, 1e-14);
    EXPECT_TRUE(IsUniform(PointArray(filter, "Stress"), Zero6));
    filter->SetAxialStrainModeToGiven();
    filter->SetAxialStrain(0.05);
    Solve(filter);
    std::vector<double> pulled(6, 0.0);
    pulled[axis] = 0.03;
    EXPECT_EQ(filter->GetPrescribedAxialStrain(), 0.05);
    EXPECT_TRUE(IsUniform(PointArray(filter, "Stress"), pulled));
  }
}

TEST(ThermoelasticFilter, GeneralizedPlaneStrainOfTrianglesIsAlongTheNormal)
{
  Filter plane = MakeFilter(MakeSquare(4, 0.15,
    [](double x, double y) {
      return Point{ { x, y, 3.0 } };
    }));
  plane->SetUniformTemperature(2.0);
  plane->GeneralizedPlaneStrainOn();
  plane->SetAxialStrainModeToGiven();
  plane->SetAxialStrain(0.05);
  plane->SetRigidMotionToPin();
  Solve(plane);
  EXPECT_TRUE(IsUniform(PointArray(plane, "Stress"), { 0.0, 0.0, 0.03, 0.0, 0.0, 0.0 }));
}

/**
 * A linear displacement on the boundary of a square in any plane: the stress of that plane, turned.
 */
TEST(ThermoelasticFilter, StressTurnsWithThePlane)
{
  const double c = 0.6, s = 0.8;
  const Point e1{ { c, s, 0.0 } }, e2{ { -s * c, c * c, s } }; // orthonormal
  const std::vector<std::array<Point, 2>> planes = {
    { Point{ { 1.0, 0.0, 0.0 } }, Point{ { 0.0, 1.0, 0.0 } } },
    { Point{ { 0.0, 1.0, 0.0 } }, Point{ { 1.0, 0.0, 0.0 } } }, // clockwise
    { Point{ { 0.0, 0.0, 1.0 } }, Point{ { 1.0, 0.0, 0.0 } } },
    { Point{ { 0.0, 1.0, 0.0 } }, Point{ { 0.0, 0.0, 1.0 } } },
    { e1, e2 },
  };
  const double E = 1.0, nu = 0.25, pull = 0.01, shear = 0.004;
  for (const auto& axes : planes)
  {
    SCOPED_TRACE("plane of " + testing::PrintToString(axes));
    const auto map = [&](double x, double y)
    {
      Point p;
      for (int i = 0; i < 3; ++i)
      {
        p[i] = x * axes[0][i] + y * axes[1][i];
      }
      return p;
    };
    Grid square = MakeSquare(4, 0.15, map);
    const auto local = [&](const Point& p, int k)
    { return p[0] * axes[k][0] + p[1] * axes[k][1] + p[2] * axes[k][2]; };
    const auto isEdge = [&](const Point& p)
    {
      const double x = local(p, 0), y = local(p, 1);
      return std::min(std::min(x, 1.0 - x), std::min(y, 1.0 - y)) < 1e-9;
    };
    AddArray(square, false, "Constraint", 3,
      [&](const Point& p)
      {
        const double held = isEdge(p) ? 1.0 : 0.0;
        return Point{ { held, held, held } };
      });
    AddArray(square, false, "PrescribedDisplacement", 3,
      [&](const Point& p)
      { return map(pull * local(p, 0) + 2.0 * shear * local(p, 1), -pull * 0.5 * local(p, 1)); });
    for (const int state :
      { vtkThermoelasticFilter::PlaneStrain, vtkThermoelasticFilter::PlaneStress })
    {
      Filter filter = MakeFilter(square);
      filter->SetPlaneState(state);
      Solve(filter);
      const double a = pull, b = -0.5 * pull, g = E / (2.0 * (1.0 + nu));
      const bool isStress = state == vtkThermoelasticFilter::PlaneStress;
      const double l = 2.0 * g * nu / (1.0 - (isStress ? 1.0 : 2.0) * nu);
      const double s11 = l * (a + b) + 2.0 * g * a, s22 = l * (a + b) + 2.0 * g * b;
      const double s33 = isStress ? 0.0 : l * (a + b), s12 = 2.0 * g * shear;
      double expected[3][3];
      const Point &u = axes[0], &v = axes[1];
      const Point n{ { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
        u[0] * v[1] - u[1] * v[0] } };
      for (int i = 0; i < 3; ++i)
      {
        for (int j = 0; j < 3; ++j)
        {
          expected[i][j] = s11 * u[i] * u[j] + s22 * v[i] * v[j] +
            s12 * (u[i] * v[j] + v[i] * u[j]) + s33 * n[i] * n[j];
        }
      }
      EXPECT_TRUE(IsUniform(PointArray(filter, "Stress"),
        { expected[0][0], expected[1][1], expected[2][2], expected[0][1], expected[1][2],
          expected[0][2] },
        1e-11));
      vtkDataArray* displacement = PointArray(filter, "Displacement");
      vtkDataArray* exact = square->GetPointData()->GetArray("PrescribedDisplacement");
      for (vtkIdType p = 0; p < square->GetNumberOfPoints(); ++p)
      {
        for (int i = 0; i < 3; ++i)
        {
          EXPECT_NEAR(displacement->GetComponent(p, i), exact->GetComponent(p, i), 1e-12);
        }
      }
    }
  }
}

/**
 * Lines on triangles carry loads too; single components are held in a plane parallel to two axes.
 */
TEST(ThermoelasticFilter, LinesInThePlaneCarryLoads)
{
  Grid square = MakeSquare(4, 0.15, [](double x, double y) { return Point{ { 2.0, x, y } }; });
  for (int i = 0; i < 4; ++i)
  {
    AddCell(square, VTK_LINE, { 4 + 5 * i, 4 + 5 * (i + 1) }); // y = 1
  }
  AddArray(square, true, "FacetTraction", 3,
    [](const Point& x) {
      return Point{ { 0.0, x[1] == 1.0 ? 2.0 : 0.0, 0.0 } };
    });
  AddArray(square, false, "Constraint", 3,
    [](const Point& x) {
      return Point{ { 0.0, x[1] == 0.0 ? 1.0 : 0.0, x[2] == 0.0 ? 1.0 : 0.0 } };
    });
  Filter filter = MakeFilter(square);
  filter->SetPlaneStateToPlaneStress();
  Solve(filter);
  EXPECT_TRUE(IsUniform(PointArray(filter, "Stress"), { 0.0, 2.0, 0.0, 0.0, 0.0, 0.0 }));
  for (vtkIdType p = 0; p < square->GetNumberOfPoints(); ++p)
  {
    vtkDataArray* u = PointArray(filter, "Displacement");
    const Point x = GetPoint(square, p);
    EXPECT_EQ(u->GetComponent(p, 0), 0.0);
    EXPECT_NEAR(u->GetComponent(p, 1), 2.0 * x[1], 1e-11);
    EXPECT_NEAR(u->GetComponent(p, 2), -0.5 * x[2], 1e-11); // nu / E * 2
  }
}

/**
 * Cell arrays of the material, and regions: two bars side by side, stretched alike (nu = 0).
 */
TEST(ThermoelasticFilter, MaterialMayDifferFromCellToCell)
{
  Grid box = MakeBox(4, 0.0);
  const auto isLeft = [](const Point& x) { return x[1] < 0.5; };
  AddArray<vtkFloatArray>(box, true, "YoungsModulus", 1,
    [&](const Point& x) { return Point{ { isLeft(x) ? 1.0 : 3.0 } }; });
  AddArray(box, true, "nu", 1, [](const Point&) { return Point{ { 0.0 } }; });
  AddArray<vtkIntArray>(
    box, true, "part", 1, [&](const Point& x) { return Point{ { isLeft(x) ? 7.0 : -2.0 } }; });
  AddArray(box, false, "Constraint", 3,
    [](const Point& x)
    {
      const double end = x[0] == 0.0 || x[0] == 1.0 ? 1.0 : 0.0;
      return Point{ { end, end, end } };
    });
  AddArray(box, false, "PrescribedDisplacement", 3,
    [](const Point& x) {
      return Point{ { 0.1 * x[0], 0.0, 0.0 } };
    });
  Filter filter = MakeFilter(box);
  filter->SetPoissonsRatioArray("nu");
  Solve(filter);
  EXPECT_GT(filter->GetRelativeErrorEstimate(), 0.01); // the jump is taken for an error
  filter->SetRegionArray("part");
  Solve(filter);
  EXPECT_LT(filter->GetRelativeErrorEstimate(), 1e-9);
  for (vtkIdType p = 0; p < box->GetNumberOfPoints(); ++p)
  {
    const double y = GetPoint(box, p)[1];
    const double stress = PointArray(filter, "Stress")->GetComponent(p, 0);
    EXPECT_TRUE(std::abs(stress - (y < 0.5 ? 0.1 : 0.3)) < 1e-9 ||
      (y == 0.5 && stress > 0.1 && stress < 0.3));
  }
}

TEST(ThermoelasticFilter, RecoveriesDifferAndCanBeLeftOut)
{
  Grid box = MakeBox(4, 0.15);
  std::vector<vtkSmartPointer<vtkDataArray>> stresses;
  for (const int recovery : { vtkThermoelasticFilter::Patch, vtkThermoelasticFilter::LocalPatch,
         vtkThermoelasticFilter::VolumeAverage })
  {
    SCOPED_TRACE("recovery " + std::to_string(recovery));
    Filter filter = MakeFilter(box);
    filter->SetTemperatureModeToRadial();
    filter->SetRadialCoefficient(1.0);
    filter->SetRigidMotionToPin();
    filter->SetStressRecovery(recovery);
    Solve(filter);
    for (const auto& other : stresses)
    {
      EXPECT_FALSE(SameArray(other, PointArray(filter, "Stress")));
    }
    stresses.emplace_back(PointArray(filter, "Stress"));
    double squares = 0.0;
    for (vtkIdType c = 0; c < box->GetNumberOfCells(); ++c)
    {
      squares += std::pow(CellArray(filter, "ErrorEstimate")->GetTuple1(c), 2);
    }
    EXPECT_NEAR(std::sqrt(squares) / filter->GetErrorEstimate(), 1.0, 1e-12);
    filter->SetStressRecoveryToNone();
    Solve(filter);
    EXPECT_FALSE(filter->GetOutput(0)->GetPointData()->GetArray("Stress"));
    EXPECT_FALSE(filter->GetOutput(0)->GetPointData()->GetArray("VonMises"));
    EXPECT_FALSE(filter->GetOutput(0)->GetCellData()->GetArray("ErrorEstimate"));
    EXPECT_NE(CellArray(filter, "ElementStress"), nullptr);
    EXPECT_EQ(filter->GetErrorEstimate(), 0.0);
  }
}

} // namespace
