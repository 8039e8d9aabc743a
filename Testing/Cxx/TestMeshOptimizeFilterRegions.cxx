// SPDX-License-Identifier: BSD-3-Clause
// vtkMeshOptimizeFilter on meshes of several regions and components: interfaces where more than two
// regions meet, regions inside others, bodies that touch in a point or along an edge.
#include "MeshOptimizeFilterTesting.h"

#include "vtkIntArray.h"

using namespace Testing;

namespace
{

constexpr const char* Name = "material";

/// Region of a small cube of a box; -1 leaves it out.
using Label = std::function<int(int i, int j, int k)>;

/**
 * The small cubes of a jittered box that have a region, with it as a cell array. Points that are
 * left over stay: a mesh may have points that no cell uses.
 */
Grid MakeRegions(int n, double jitter, const Label& label)
{
  Grid box = MakeBox(n, jitter);
  Grid grid = MakeGrid({});
  grid->GetPoints()->DeepCopy(box->GetPoints());
  vtkNew<vtkIntArray> region;
  region->SetName(Name);
  for (vtkIdType c = 0; c < box->GetNumberOfCells(); ++c)
  {
    const int cube = static_cast<int>(c / 6);
    const int value = label(cube % n, cube / n % n, cube / n / n);
    if (value >= 0)
    {
      AddCell(grid, VTK_TETRA, CellPoints(box, c));
      region->InsertNextValue(value);
    }
  }
  grid->GetCellData()->AddArray(region);
  return grid;
}

int RegionOf(vtkUnstructuredGrid* grid, vtkIdType cell)
{
  return static_cast<int>(grid->GetCellData()->GetArray(Name)->GetComponent(cell, 0));
}

/**
 * The facets of all cells, with the cells that have them.
 */
std::map<std::vector<vtkIdType>, std::vector<vtkIdType>> FacetToCells(vtkUnstructuredGrid* grid)
{
  std::map<std::vector<vtkIdType>, std::vector<vtkIdType>> facets;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    std::vector<vtkIdType> ids = CellPoints(grid, c);
    std::sort(ids.begin(), ids.end());
    for (std::size_t leftOut = 0; leftOut < ids.size(); ++leftOut)
    {
      std::vector<vtkIdType> facet = ids;
      facet.erase(facet.begin() + leftOut);
      facets[facet].push_back(c);
    }
  }
  return facets;
}

struct RegionFigures
{
  double Volume = 0.0;
  int Parts = 0; ///< connected over facets
  long Euler = 0;
};

/**
 * Volume and topology of each region; V - E + F - C with what the cells of the region have.
 */
std::map<int, RegionFigures> Measure(vtkUnstructuredGrid* grid)
{
  std::map<int, RegionFigures> figures;
  std::map<int, std::set<vtkIdType>> points;
  std::map<int, std::set<std::pair<vtkIdType, vtkIdType>>> edges;
  std::map<int, std::set<std::vector<vtkIdType>>> faces;
  std::vector<vtkIdType> leader(grid->GetNumberOfCells());
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    leader[c] = c;
    const int region = RegionOf(grid, c);
    figures[region].Volume += SignedVolume(grid, c);
    --figures[region].Euler;
    const std::vector<vtkIdType> ids = CellPoints(grid, c);
    points[region].insert(ids.begin(), ids.end());
    for (int i = 0; i < 4; ++i)
    {
      for (int j = 0; j < i; ++j)
      {
        edges[region].insert(std::minmax(ids[i], ids[j]));
      }
    }
  }
  const std::function<vtkIdType(vtkIdType)> find = [&](vtkIdType c)
  { return leader[c] == c ? c : leader[c] = find(leader[c]); };
  for (const auto& facet : FacetToCells(grid))
  {
    EXPECT_LE(facet.second.size(), 2u);
    for (const vtkIdType c : facet.second)
    {
      faces[RegionOf(grid, c)].insert(facet.first);
    }
    if (facet.second.size() == 2 &&
      RegionOf(grid, facet.second[0]) == RegionOf(grid, facet.second[1]))
    {
      leader[find(facet.second[0])] = find(facet.second[1]);
    }
  }
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    figures[RegionOf(grid, c)].Parts += leader[c] == c;
  }
  for (auto& region : figures)
  {
    region.second.Euler += static_cast<long>(points[region.first].size()) -
      static_cast<long>(edges[region.first].size()) + static_cast<long>(faces[region.first].size());
  }
  return figures;
}

class MeshOptimizeFilterRegions : public BothAlgorithms
{
protected:
  /**
   * Optimizes and checks all that must hold; returns the gain of the worst quality.
   */
  double Gain(vtkUnstructuredGrid* input)
  {
    OptimizeFilter filter(GetParam());
    Messages messages(filter);
    filter->SetInputData(input);
    filter->SetRegionArray(Name);
    filter->SetTargetQuality(0.4);
    filter->Update();
    vtkUnstructuredGrid* output = filter->GetOutput();
    EXPECT_EQ(messages.Errors, NoMessages);
    EXPECT_EQ(messages.Warnings, NoMessages);
    EXPECT_LE(filter->GetWorstQualityAfter(), filter->GetQualityBound());
    EXPECT_EQ(
      filter->GetWorstQualityAfter(), MinimumOf(output->GetCellData()->GetArray("MeshQuality")));
    EXPECT_TRUE(SameFacets(KeptFacets(input, Name), KeptFacets(output, Name)));
    const std::map<int, RegionFigures> before = Measure(input), after = Measure(output);
    EXPECT_EQ(before.size(), after.size());
    for (const auto& region : before)
    {
      SCOPED_TRACE("region " + std::to_string(region.first));
      const auto found = after.find(region.first);
      EXPECT_TRUE(found != after.end());
      if (found != after.end())
      {
        EXPECT_NEAR(found->second.Volume, region.second.Volume, 1e-12);
        EXPECT_EQ(found->second.Parts, region.second.Parts);
        EXPECT_EQ(found->second.Euler, region.second.Euler);
      }
    }
    for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c)
    {
      EXPECT_GT(SignedVolume(output, c), 0.0);
    }
    return filter->GetWorstQualityAfter() - filter->GetWorstQualityBefore();
  }

  double Gain(int n, double jitter, const Label& label)
  {
    return Gain(MakeRegions(n, jitter, label));
  }
};
TEST_BOTH_ALGORITHMS(MeshOptimizeFilterRegions);

//------------------------------------------------------------------------------
TEST_P(MeshOptimizeFilterRegions, ThreeAtALine)
{
  EXPECT_GT(Gain(6, 0.25, [](int i, int j, int) { return j >= 3 ? 2 : i >= 3; }), 0.05);
}

TEST_P(MeshOptimizeFilterRegions, FourAtALine)
{
  EXPECT_GT(Gain(6, 0.25, [](int i, int j, int) { return 10 * (i >= 3) + (j >= 3); }), 0.05);
}

TEST_P(MeshOptimizeFilterRegions, EightPartsOfTwoRegionsAtAPoint)
{
  EXPECT_GT(
    Gain(6, 0.25, [](int i, int j, int k) { return ((i >= 3) + (j >= 3) + (k >= 3)) % 2; }), 0.05);
}

bool IsInside(int i) { return i >= 2 && i < 5; }

TEST_P(MeshOptimizeFilterRegions, OneInsideAnother)
{
  EXPECT_GT(
    Gain(7, 0.25,
      [](int i, int j, int k) { return IsInside(i) && IsInside(j) && IsInside(k) ? 5 : 1; }),
    0.05);
}

TEST_P(MeshOptimizeFilterRegions, ShellRoundAHoleAndAGrainAtTheSurface)
{
  EXPECT_GT(Gain(7, 0.25,
              [](int i, int j, int k)
              {
                return i == 3 && j == 3 && k == 3             ? -1
                  : IsInside(i) && IsInside(j) && IsInside(k) ? 5
                  : i < 2 && j < 3 && k < 3                   ? 7
                                                              : 1;
              }),
    0.02);
}

TEST_P(MeshOptimizeFilterRegions, TwoPartsApart)
{
  EXPECT_GT(Gain(7, 0.25, [](int i, int, int) { return i == 3 ? -1 : 1; }), 0.05);
}

TEST_P(MeshOptimizeFilterRegions, TwoPartsThatTouchAlongAnEdge)
{
  EXPECT_GT(Gain(6, 0.25, [](int i, int j, int) { return (i >= 3) == (j >= 3) ? 1 : -1; }), 0.05);
}

TEST_P(MeshOptimizeFilterRegions, TwoPartsThatTouchInAPoint)
{
  EXPECT_GT(
    Gain(6, 0.25,
      [](int i, int j, int k) { return (i >= 3) == (j >= 3) && (j >= 3) == (k >= 3) ? 1 : -1; }),
    0.05);
}

TEST_P(MeshOptimizeFilterRegions, TwoPartsThatTouchInAPointWithARegionBetween)
{
  EXPECT_GT(
    Gain(6, 0.25,
      [](int i, int j, int k) {
        return (i < 3 && j < 3 && k < 3) || (i >= 3 && j >= 3 && k >= 3) ? 1 : i < 3 ? 2 : -1;
      }),
    0.05);
}

/**
 * Hardly anything may change: every cube is a region of its neighbours' neighbours.
 */
TEST_P(MeshOptimizeFilterRegions, EveryCubeDiffersFromItsNeighbours)
{
  EXPECT_GE(Gain(5, 0.2, [](int i, int j, int k) { return (i + j + k) % 2; }), 0.0);
}

TEST_P(MeshOptimizeFilterRegions, EveryCellIsOfARegionByChance)
{
  Grid cells = MakeRegions(3, 0.2, [](int, int, int) { return 0; });
  vtkNew<vtkIntArray> region;
  region->SetName(Name);
  for (vtkIdType c = 0; c < cells->GetNumberOfCells(); ++c)
  {
    region->InsertNextValue(static_cast<int>(c * 7919 % 5));
  }
  cells->GetCellData()->AddArray(region);
  EXPECT_GE(Gain(cells), 0.0);
}

/**
 * Two regions that overlap in nothing but touch all over with points of their own: a contact, no
 * common facet. Both sides stay where they are.
 */
TEST_P(MeshOptimizeFilterRegions, BothSidesOfAContactStay)
{
  Grid lower = MakeBox(4, 0.25), upper = MakeBox(4, 0.25);
  Grid grid = MakeGrid({});
  grid->GetPoints()->DeepCopy(lower->GetPoints());
  vtkNew<vtkIntArray> region;
  region->SetName(Name);
  const vtkIdType first = grid->GetNumberOfPoints();
  for (vtkIdType p = 0; p < upper->GetNumberOfPoints(); ++p)
  {
    const Point x = GetPoint(upper, p);
    grid->GetPoints()->InsertNextPoint(x[0], x[1], x[2] + 1.0);
  }
  for (vtkIdType c = 0; c < lower->GetNumberOfCells(); ++c)
  {
    AddCell(grid, VTK_TETRA, CellPoints(lower, c));
    region->InsertNextValue(1);
  }
  for (vtkIdType c = 0; c < upper->GetNumberOfCells(); ++c)
  {
    std::vector<vtkIdType> ids = CellPoints(upper, c);
    for (vtkIdType& p : ids)
    {
      p += first;
    }
    AddCell(grid, VTK_TETRA, ids);
    region->InsertNextValue(2);
  }
  grid->GetCellData()->AddArray(region);
  // By coordinates each contact facet is one of two regions: KeptFacets() holds it.
  EXPECT_GT(Gain(grid), 0.05);
}

/**
 * Three regions of a plane that meet in a point, one of them in two parts.
 */
TEST_P(MeshOptimizeFilterRegions, InThePlaneTheyKeepTheirAreas)
{
  Grid input = MakeSquare(12, 0.3, [](double u, double v) { return Point{ { u, v, 0 } }; });
  vtkNew<vtkIntArray> region;
  region->SetName(Name);
  std::map<int, double> area;
  const auto areaOf = [](vtkUnstructuredGrid* grid, vtkIdType c)
  {
    const std::vector<vtkIdType> ids = CellPoints(grid, c);
    const Point a = GetPoint(grid, ids[0]), b = GetPoint(grid, ids[1]), d = GetPoint(grid, ids[2]);
    return 0.5 * ((b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0]));
  };
  for (vtkIdType c = 0; c < input->GetNumberOfCells(); ++c)
  {
    const vtkIdType i = c / 2 % 12, j = c / 24;
    const int value = (i >= 6) == (j >= 6) ? 1 : i >= 6 ? 2 : 3;
    region->InsertNextValue(value);
    area[value] += areaOf(input, c);
  }
  input->GetCellData()->AddArray(region);
  OptimizeFilter filter(GetParam());
  Messages messages(filter);
  filter->SetInputData(input);
  filter->SetRegionArray(Name);
  filter->Update();
  EXPECT_EQ(messages.Errors, NoMessages);
  EXPECT_EQ(messages.Warnings, NoMessages);
  EXPECT_GT(filter->GetWorstQualityAfter(), filter->GetWorstQualityBefore() + 0.05);
  EXPECT_TRUE(SameFacets(KeptFacets(input, Name), KeptFacets(filter->GetOutput(), Name)));
  for (vtkIdType c = 0; c < filter->GetOutput()->GetNumberOfCells(); ++c)
  {
    const double a = areaOf(filter->GetOutput(), c);
    EXPECT_GT(a, 0.0);
    area[RegionOf(filter->GetOutput(), c)] -= a;
  }
  for (const auto& left : area)
  {
    EXPECT_NEAR(left.second, 0.0, 1e-13) << "region " << left.first;
  }
}

} // namespace
