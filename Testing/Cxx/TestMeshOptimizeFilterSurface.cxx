// SPDX-License-Identifier: BSD-3-Clause
// The surface of tetrahedra that slides: what vtkMeshOptimizeFilter takes and gives.
#include "SlidingTesting.h"

#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPolyData.h"
#include "vtkTriangle.h"
#include "vtkTypeInt64Array.h"

#include <limits>

using namespace Testing;

namespace
{

TEST(MeshOptimizeFilterSurface, ABadSurfaceGetsBetterAndStaysTheSameSet)
{
  Grid grid = MakeBadBox(6, 0.3);
  OptimizeFilter kept(vtkMeshOptimizeFilter::WorstFirst);
  kept->SetInputData(grid);
  kept->Update();
  Sliding slid(0.0);
  slid->SetInputData(grid);
  slid->Update();
  EXPECT_LT(kept->GetWorstQualityAfter(), 0.6);
  EXPECT_GE(slid->GetWorstQualityAfter(), 0.6);
  // The same set of points, to 8 ulp of the largest coordinate, 1.
  EXPECT_LE(slid->GetSurfaceDistance(), 8.0 * std::numeric_limits<double>::epsilon());
  EXPECT_EQ(Figure(slid->GetOutput(), "SurfaceDistance"), slid->GetSurfaceDistance());
  EXPECT_EQ(kept->GetOutput()->GetFieldData()->GetArray("SurfaceDistance"), nullptr);
  EXPECT_EQ(kept->GetOutput()->GetPointData()->GetArray("BoundaryPlace"), nullptr);
  double volume = 0.0;
  for (vtkIdType c = 0; c < slid->GetOutput()->GetNumberOfCells(); ++c)
  {
    volume += SignedVolume(slid->GetOutput(), c);
  }
  EXPECT_NEAR(volume, 1.0, 1e-13);
  // Each node of the surface has a face's coordinate, exactly, and says what it may do.
  vtkDataArray* places = slid->GetOutput()->GetPointData()->GetArray("BoundaryPlace");
  ASSERT_NE(places, nullptr);
  int corners = 0;
  for (vtkIdType p = 0; p < slid->GetOutput()->GetNumberOfPoints(); ++p)
  {
    const Point x = GetPoint(slid->GetOutput(), p);
    const auto sides = std::count_if(
      x.begin(), x.end(), [](double v) { return v == 0.0 || v == 1.0; });
    EXPECT_EQ(places->GetComponent(p, 0), static_cast<double>(sides));
    corners += sides == 3;
  }
  EXPECT_EQ(corners, 8);
}

/**
 * The top of a box becomes a roof whose sides turn by 60 degrees at x = 1/2.
 */
void AddRoof(vtkUnstructuredGrid* grid)
{
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    Point x = GetPoint(grid, p);
    x[2] *= 1.0 + std::tan(vtkMath::RadiansFromDegrees(30.0)) * (0.5 - std::fabs(x[0] - 0.5));
    grid->GetPoints()->SetPoint(p, x.data());
  }
}

TEST(MeshOptimizeFilterSurface, TheBoundIsThatOfRidgesThatStay)
{
  // A tetrahedron with the dihedral angle of 20 degrees, the best one by the mean ratio.
  const double phi = vtkMath::RadiansFromDegrees(20.0), s = std::sin(0.5 * phi);
  const double r = 1.0 / std::sqrt(1.0 + s * s);
  auto grid = Grid::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->InsertNextPoint(0.0, 0.0, 0.0);
  points->InsertNextPoint(1.0, 0.0, 0.0);
  points->InsertNextPoint(0.5, r, 0.0);
  points->InsertNextPoint(0.5, r * std::cos(phi), r * std::sin(phi));
  grid->SetPoints(points);
  const vtkIdType cell[4] = { 0, 1, 2, 3 };
  grid->InsertNextCell(VTK_TETRA, 4, cell);
  const double best = std::cbrt(std::pow(std::sqrt(2.0) * std::sin(phi) / (1.0 + s * s), 2));
  for (double tolerance : { 0.0, 1e-3 })
  {
    Sliding slid(tolerance);
    slid->SetInputData(grid);
    slid->SetQualityMeasureToMeanRatio();
    slid->SetTargetQuality(0.9);
    slid->SetGrowthBudget(10.0);
    slid->Update();
    EXPECT_NEAR(slid->GetWorstQualityBefore(), best, 1e-12);
    // Where the surface may move, nothing is certain.
    EXPECT_NEAR(slid->GetQualityBound(), tolerance > 0.0 ? 1.0 : best, 1e-5);
    EXPECT_EQ(Figure(slid->GetOutput(), "QualityBound"), slid->GetQualityBound());
    EXPECT_GE(slid->GetQualityBound(), slid->GetWorstQualityAfter());
  }
}

vtkIdType CountPlaces(vtkUnstructuredGrid* grid, int place)
{
  vtkDataArray* places = grid->GetPointData()->GetArray("BoundaryPlace");
  vtkIdType count = 0;
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    count += places->GetComponent(p, 0) == place;
  }
  return count;
}

TEST(MeshOptimizeFilterSurface, RidgesThatAnglesTellNeedNotBeKept)
{
  Grid grid = MakeBox(4, 0.0);
  AddRoof(grid);
  vtkIdType onCurves[2];
  for (bool keeps : { false, true })
  {
    Sliding slid(1e-3);
    slid->SetInputData(grid);
    // Ridges are given up where the target is not reached with them. Here nothing can reach it.
    slid->SetTargetQuality(0.95);
    slid->MoveNodesOff();
    slid->ReconnectOff();
    slid->InsertNodesOff();
    slid->RemoveNodesOff();
    slid->SetKeepFeatures(keeps);
    slid->Update();
    onCurves[keeps] = CountPlaces(slid->GetOutput(), 2);
  }
  // The box has 12 edges with 3 nodes each inside. The roof has a ridge, and so two more corners;
  // its sides turn by 60 degrees from the walls, too.
  EXPECT_EQ(onCurves[0], 12 * 3 - 2 - 2 * 3);
  EXPECT_EQ(onCurves[1], 12 * 3 - 2 + 3);
}

TEST(MeshOptimizeFilterSurface, WhatHasChangedIsReported)
{
  Grid grid = MakeBadBox(6, 0.3);
  AddRoof(grid);
  vtkNew<vtkIntArray> side;
  side->SetName("Side");
  std::map<int, double> before;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    double x = 0.0;
    for (vtkIdType p : CellPoints(grid, c))
    {
      x += GetPoint(grid, p)[0] / 4.0;
    }
    side->InsertNextValue(x < 0.5 ? 7 : -9);
    before[x < 0.5 ? 7 : -9] += SignedVolume(grid, c);
  }
  grid->GetCellData()->AddArray(side);
  Sliding slid(0.01);
  slid->SetInputData(grid);
  slid->SetRegionArray("Side");
  slid->SetTargetQuality(0.95);
  slid->Update();
  std::map<int, double> after;
  for (vtkIdType c = 0; c < slid->GetOutput()->GetNumberOfCells(); ++c)
  {
    const double region = slid->GetOutput()->GetCellData()->GetArray("Side")->GetComponent(c, 0);
    after[static_cast<int>(region)] += SignedVolume(slid->GetOutput(), c);
  }
  vtkDataArray* volumes = slid->GetOutput()->GetFieldData()->GetArray("RegionVolumes");
  ASSERT_NE(volumes, nullptr);
  ASSERT_EQ(volumes->GetNumberOfTuples(), 2);
  for (vtkIdType k = 0; k < 2; ++k)
  {
    const int region = static_cast<int>(volumes->GetComponent(k, 0));
    EXPECT_NEAR(volumes->GetComponent(k, 1), before[region], 1e-12);
    EXPECT_NEAR(volumes->GetComponent(k, 2), after[region], 1e-12);
  }
  const double was = before[7] + before[-9], is = after[7] + after[-9];
  EXPECT_NE(slid->GetVolumeChange(), 0.0);
  EXPECT_NEAR(slid->GetVolumeChange(), is / was - 1.0, 1e-12);
  EXPECT_EQ(Figure(slid->GetOutput(), "VolumeChange"), slid->GetVolumeChange());
  // The stop reason says where the worst cell is, and the history counts changes of the surface.
  EXPECT_TRUE(Says(slid->GetStopReasonAsString(), "nodes of the worst one"));
  auto history = vtkTable::SafeDownCast(slid->GetOutputDataObject(1));
  double tried = 0.0, done = 0.0;
  for (vtkIdType row = 0; row < history->GetNumberOfRows(); ++row)
  {
    tried += history->GetValueByName(row, "SurfaceChangeTried").ToDouble();
    done += history->GetValueByName(row, "SurfaceChangeDone").ToDouble();
  }
  EXPECT_GT(done, 0.0);
  EXPECT_GT(tried, done);
  // None of that if the surface is kept.
  OptimizeFilter kept(vtkMeshOptimizeFilter::WorstFirst);
  kept->SetInputData(grid);
  kept->Update();
  EXPECT_EQ(kept->GetVolumeChange(), 0.0);
  EXPECT_EQ(kept->GetOutput()->GetFieldData()->GetArray("RegionVolumes"), nullptr);
  EXPECT_EQ(
    vtkTable::SafeDownCast(kept->GetOutputDataObject(1))->GetColumnByName("SurfaceChangeTried"),
    nullptr);
}

/// Numbers that do not fit into 32 bits, too.
TEST(MeshOptimizeFilterSurface, RegionVolumesAreOfTheNumbersOfTheArray)
{
  Grid grid = MakeBadBox(3, 0.2);
  vtkNew<vtkTypeInt64Array> number;
  number->SetName("Number");
  const double numbers[] = { -6000000001.0, 5000000000.0 };
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    number->InsertNextValue(static_cast<vtkTypeInt64>(numbers[c % 2]));
  }
  grid->GetCellData()->AddArray(number);
  Sliding slid(0.01);
  slid->SetInputData(grid);
  slid->SetRegionArray("Number");
  slid->Update();
  vtkDataArray* volumes = slid->GetOutput()->GetFieldData()->GetArray("RegionVolumes");
  ASSERT_NE(volumes, nullptr);
  ASSERT_EQ(volumes->GetNumberOfTuples(), 2);
  for (vtkIdType k = 0; k < 2; ++k)
  {
    EXPECT_EQ(volumes->GetComponent(k, 0), numbers[k]);
    EXPECT_GT(volumes->GetComponent(k, 1), 0.0);
  }
}

TEST(MeshOptimizeFilterSurface, TheToleranceIsAFractionUnlessAbsolute)
{
  Grid grid = MakeBadBox(5, 0.3);
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    Point x = GetPoint(grid, p);
    x[2] += 0.4 * x[0] * (1.0 - x[0]);
    grid->GetPoints()->SetPoint(p, x.data());
  }
  double bounds[6];
  grid->GetBounds(bounds);
  const double diagonal = std::sqrt(std::pow(bounds[1] - bounds[0], 2) +
    std::pow(bounds[3] - bounds[2], 2) + std::pow(bounds[5] - bounds[4], 2));
  Sliding fraction(3e-3), length(3e-3 * diagonal), strict(1e-5);
  length->ToleranceIsAbsoluteOn();
  for (Sliding* filter : { &fraction, &length, &strict })
  {
    (*filter)->SetInputData(grid);
    (*filter)->Update();
  }
  EXPECT_TRUE(SameGrid(fraction->GetOutput(), length->GetOutput()));
  EXPECT_GT(fraction->GetSurfaceDistance(), 1e-5 * diagonal);
  EXPECT_LE(fraction->GetSurfaceDistance(), 3e-3 * diagonal);
  EXPECT_LE(strict->GetSurfaceDistance(), 1e-5 * diagonal);
  EXPECT_GE(fraction->GetWorstQualityAfter(), strict->GetWorstQualityAfter());
}

TEST(MeshOptimizeFilterSurface, AGreatToleranceIsLimited)
{
  Grid grid = MakeBadBox(4, 0.3);
  Sliding filter(std::numeric_limits<double>::infinity());
  filter->SetInputData(grid);
  filter->Update();
  EXPECT_LE(filter->GetSurfaceDistance(), 0.1 * std::sqrt(3.0));
  EXPECT_GE(filter->GetWorstQualityAfter(), filter->GetWorstQualityBefore());
  EXPECT_GT(filter->GetOutput()->GetNumberOfCells(), 0);
}

TEST(MeshOptimizeFilterSurface, CellsThatPassThroughKeepTheirFaces)
{
  Grid grid = MakeBadBox(4, 0.2);
  // A pyramid on each of the first faces z = 1 that make up a square, and a line of its own.
  const vtkIdType top = 4 * 25;
  const Point apex{ { 0.1, 0.1, 1.5 } };
  const vtkIdType p = grid->GetPoints()->InsertNextPoint(apex.data());
  AddCell(grid, VTK_PYRAMID, { top, top + 1, top + 6, top + 5, p });
  AddCell(grid, VTK_LINE, { top + 2, top + 3 });
  Sliding filter(0.0);
  filter->SetInputData(grid);
  filter->Update();
  vtkUnstructuredGrid* output = filter->GetOutput();
  int pyramids = 0, lines = 0;
  for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c)
  {
    const int type = output->GetCellType(c);
    const vtkIdType source = type == VTK_PYRAMID ? grid->GetNumberOfCells() - 2
                                                 : grid->GetNumberOfCells() - 1;
    if (type == VTK_PYRAMID || type == VTK_LINE)
    {
      ++(type == VTK_PYRAMID ? pyramids : lines);
      const std::vector<vtkIdType> now = CellPoints(output, c), then = CellPoints(grid, source);
      for (std::size_t k = 0; k < now.size(); ++k)
      {
        EXPECT_EQ(GetPoint(output, now[k]), GetPoint(grid, then[k]));
      }
    }
  }
  EXPECT_EQ(pyramids, 1);
  EXPECT_EQ(lines, 1);
  // The two triangles under the pyramid are still there.
  const auto before = KeptFacets(grid), after = KeptFacets(output);
  int found = 0;
  for (const std::vector<Point>& facet : before)
  {
    const bool isUnder = std::all_of(facet.begin(), facet.end(),
      [&](const Point& x)
      {
        return x == GetPoint(grid, top) || x == GetPoint(grid, top + 1) ||
          x == GetPoint(grid, top + 5) || x == GetPoint(grid, top + 6);
      });
    found += isUnder && after.count(facet) == 1;
  }
  EXPECT_EQ(found, 2);
}

TEST(MeshOptimizeFilterSurface, BlocksKeepTheFacesThatTheyShare)
{
  Grid one = MakeBadBox(4, 0.2), two = MakeBadBox(4, 0.2);
  for (vtkIdType p = 0; p < two->GetNumberOfPoints(); ++p)
  {
    Point x = GetPoint(two, p);
    x[0] = 2.0 - x[0]; // mirrored: the two touch at x = 1
    two->GetPoints()->SetPoint(p, x.data());
  }
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, one);
  blocks->SetBlock(1, two);
  Sliding filter(1e-3);
  Messages messages(filter.Get());
  filter->SetInputData(blocks);
  filter->Update();
  auto output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  std::set<std::vector<Point>> at[2];
  for (unsigned int k = 0; k < 2; ++k)
  {
    for (const std::vector<Point>& facet :
      KeptFacets(vtkUnstructuredGrid::SafeDownCast(output->GetBlock(k))))
    {
      if (std::all_of(facet.begin(), facet.end(), [](const Point& x) { return x[0] == 1.0; }))
      {
        at[k].insert(facet);
      }
    }
  }
  EXPECT_EQ(at[0].size(), 32u);
  EXPECT_TRUE(SameFacets(at[0], at[1]));
  // The user is told.
  const auto tells = [&](const std::string& start)
  {
    return std::any_of(messages.Warnings.begin(), messages.Warnings.end(),
      [&](const std::string& text) { return text.find(start) != std::string::npos; });
  };
  EXPECT_TRUE(tells("Block 1: 32 facets of the surface lie on other facets"));
  EXPECT_TRUE(tells("Block 2: 32 facets of the surface lie on other facets"));
}

TEST(MeshOptimizeFilterSurface, TheSameBytesWithAnyNumberOfThreads)
{
  Grid grid = MakeBadBox(20, 0.2);
  Sliding one(1e-3), four(1e-3);
  one->SetNumberOfThreads(1);
  four->SetNumberOfThreads(4);
  for (Sliding* filter : { &one, &four })
  {
    (*filter)->SetEffort(vtkMeshOptimizeFilter::Quick);
    (*filter)->SetInputData(grid);
    (*filter)->Update();
  }
  EXPECT_TRUE(SameGrid(one->GetOutput(), four->GetOutput()));
  EXPECT_TRUE(SameArrays(one->GetOutput()->GetPointData(), four->GetOutput()->GetPointData()));
}

TEST(MeshOptimizeFilterSurface, WhatItCannotDoIsAnError)
{
  const auto expect = [](const Texts& words, const Prepare& prepare, vtkUnstructuredGrid* grid)
  {
    ExpectOptimizeError(vtkMeshOptimizeFilter::WorstFirst, grid, words,
      [&](vtkMeshOptimizeFilter* f)
      {
        f->SetBoundaryModeToSlide();
        prepare(f);
      });
  };
  Grid box = MakeBox(2, 0.1);
  expect(
    { "Slide", "tetrahedra", "sizes" }, [](vtkMeshOptimizeFilter* f) { f->SetDesiredSize(0.1); },
    box);
  expect(
    { "Slide", "OptimizeBelow" }, [](vtkMeshOptimizeFilter* f) { f->SetOptimizeBelow(0.3); }, box);
  expect(
    { "Slide", "WorstFirst" }, [](vtkMeshOptimizeFilter* f) { f->SetAlgorithmToPaper1996(); }, box);
  expect(
    { "geometry", "triangles" },
    [](vtkMeshOptimizeFilter* f) { f->SetGeometryData(vtkSmartPointer<vtkPolyData>::New()); }, box);
  expect(
    { "SurfaceTolerance" },
    [](vtkMeshOptimizeFilter* f)
    { f->SetSurfaceTolerance(std::numeric_limits<double>::quiet_NaN()); },
    box);
  expect(
    { "None here" }, [](vtkMeshOptimizeFilter* f) { f->SetPatchArray("None here"); }, box);
  Grid metric = MakeBox(2, 0.1);
  vtkNew<vtkDoubleArray> tensors;
  tensors->SetName("M");
  tensors->SetNumberOfComponents(6);
  for (vtkIdType p = 0; p < metric->GetNumberOfPoints(); ++p)
  {
    tensors->InsertNextTuple6(4, 1, 1 + GetPoint(metric, p)[0], 0, 0, 0);
  }
  metric->GetPointData()->AddArray(tensors);
  expect(
    { "Slide", "metric" }, [](vtkMeshOptimizeFilter* f) { f->SetMetricArray("M"); }, metric);
}

} // namespace
