// SPDX-License-Identifier: BSD-3-Clause
// One reader of grids: vtkMeshOptimizeFilter and vtkMeshQualityMinMax say the same about the same
// cells, ghosts, planes, sizes, tensors and regions.
#include "MeshBridgeTesting.h"

using namespace Testing;

namespace
{

/// A mesh that both filters must say the same about, whatever comes along with it.
struct Mesh
{
  std::string Name; ///< of the case
  std::function<Grid()> Make;
};

void PrintTo(const Mesh& mesh, std::ostream* stream) { *stream << mesh.Name; }

std::vector<Mesh> MakeMeshes()
{
  std::vector<Mesh> meshes = { { "Tetrahedra", MakeTetrahedra },
    { "TetrahedraInSinglePrecision", [] { return MakeBox(3, 0.4, VTK_FLOAT); } },
    { "TiltedTrianglesInSinglePrecision",
      [] { return MakeSquare(5, 0.6, Planes[3].Map, VTK_FLOAT); } } };
  for (const Plane& plane : Planes)
  {
    meshes.push_back(
      { "Triangles" + plane.Name, [&plane] { return MakeSquare(5, 0.6, plane.Map); } });
  }
  return meshes;
}

class MeshBridgeSameAnswers : public testing::TestWithParam<Mesh>
{
protected:
  static Grid Make() { return GetParam().Make(); }
};
INSTANTIATE_TEST_SUITE_P(Meshes, MeshBridgeSameAnswers, testing::ValuesIn(MakeMeshes()),
  [](const testing::TestParamInfo<Mesh>& info) { return info.param.Name; });

TEST_P(MeshBridgeSameAnswers, Plain) { Compare("", Make()); }

TEST_P(MeshBridgeSameAnswers, WithOneSize) { Compare("", Make(), 0.7); }

TEST_P(MeshBridgeSameAnswers, WithSizes)
{
  Grid sizes = Make();
  AddSizes(sizes);
  Compare("", sizes, 0.7);
}

TEST_P(MeshBridgeSameAnswers, WithAMetric)
{
  for (const int components : { 6, 9 })
  {
    Grid metric = Make();
    AddMetric(metric, components);
    const std::string title = std::to_string(components) + " components";
    Compare(title, metric);
    AddSizes(metric);
    Compare(title + ", sizes", metric, 0.7);
  }
}

TEST_P(MeshBridgeSameAnswers, WithRegions)
{
  Grid regions = Make();
  AddRegions<vtkIntArray>(regions, { 7, -2, 5 });
  Compare("", regions);
}

TEST_P(MeshBridgeSameAnswers, WithRegionsOf64Bits)
{
  Grid large = Make();
  const long long far = 1LL << 60; // a double does not tell it from the next one
  AddRegions<vtkTypeInt64Array>(large, { far, far + 1, -far, far + 1 });
  Compare("", large);
}

/**
 * Regions that a double does not tell apart are regions all the same.
 */
TEST(MeshBridge, RegionsThatADoubleDoesNotTellApartAreRegions)
{
  Grid grid = MakeTetrahedra();
  const long long far = 1LL << 60;
  AddRegions<vtkTypeInt64Array>(grid, { far, far + 1 });
  vtkNew<vtkMeshQualityMinMax> filter;
  filter->SetInputData(grid);
  filter->SetRegionArray("region");
  filter->Update();
  auto table = vtkTable::SafeDownCast(filter->GetOutputDataObject(1));
  EXPECT_EQ(table->GetNumberOfRows(), 3);
  EXPECT_EQ(table->GetValueByName(1, "Region").ToString(), std::to_string(far + 1));
}

/**
 * The same triangles in any plane: one bound, and the same signs.
 */
TEST(MeshBridge, PlanesHaveOneBound)
{
  const Answer first = AskMinMax(MakeSquare(6, 0.3, Planes[0].Map), 0.0);
  for (const Plane& plane : Planes)
  {
    SCOPED_TRACE(plane.Name);
    const Answer answer = AskMinMax(MakeSquare(6, 0.3, plane.Map), 0.0);
    EXPECT_LT(answer.Bound, 0.97); // right angles at the corners, or triangles that halve them
    EXPECT_TRUE(IsNear(answer.Bound, first.Bound, 1e-9));
    EXPECT_EQ(answer.Inverted, first.Inverted);
    EXPECT_TRUE(IsNear(answer.Minimum, first.Minimum, 1e-9));
  }
}

TEST(MeshBridge, TurnedTriangleIsInvertedInAnyPlane)
{
  for (const Plane& plane : Planes)
  {
    SCOPED_TRACE(plane.Name);
    Grid turned = MakeSquare(4, 0.0, plane.Map);
    const std::vector<vtkIdType> ids = CellPoints(turned, 7);
    const vtkIdType other[3] = { ids[1], ids[0], ids[2] };
    turned->GetCells()->ReplaceCellAtId(7, 3, other);
    const Answer answer = AskMinMax(turned, 0.0);
    EXPECT_EQ(answer.Inverted, 1);
    EXPECT_LT(answer.Quality[7], 0.0);
    EXPECT_GT(answer.Quality[6], 0.0);
  }
}

TEST(MeshBridge, TrianglesInNoPlaneHaveNoSignAndNoBound)
{
  const auto curve = [](double u, double v) -> Point { return { { u, v, u * v } }; };
  const Answer curved = AskMinMax(MakeSquare(4, 0.0, curve), 0.0);
  EXPECT_EQ(curved.Bound, 1.0);
  EXPECT_EQ(curved.Inverted, 0);
}

//------------------------------------------------------------------------------
/**
 * A tensor that was rounded to single precision is a metric, one that is really skew is not.
 */
TEST(MeshBridge, MetricIsSymmetricToSinglePrecision)
{
  for (const bool isSolid : { true, false })
  {
    SCOPED_TRACE(isSolid ? "tetrahedra" : "triangles");
    const auto make = [&](double skew)
    {
      Grid grid = isSolid ? MakeTetrahedra() : MakeSquare(4, 0.5, Planes[3].Map);
      AddMetric(grid, 9, skew);
      return grid;
    };
    Compare("metric skew by 1e-7", make(1e-7));
    EXPECT_TRUE(IsNear(AskMinMax(make(1e-7), 0.0).Mean, AskMinMax(make(0.0), 0.0).Mean, 1e-6));
    for (const Answer& answer : { AskOptimize(make(1e-4), 0.0), AskMinMax(make(1e-4), 0.0) })
    {
      ASSERT_EQ(answer.Errors.size(), 1u);
      EXPECT_TRUE(Says(answer.Errors[0], "not symmetric"));
      EXPECT_TRUE(Says(answer.Errors[0], "at point 0"));
    }
  }
}

} // namespace
