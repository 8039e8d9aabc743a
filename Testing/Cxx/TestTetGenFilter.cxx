// SPDX-License-Identifier: BSD-3-Clause
// vtkTetGenFilter on good surfaces: volumes, the surface kept bit for bit, sizes, regions, holes, interior points, data.
#include "TetGenFilterTesting.h"

#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkStringArray.h"
#include "vtkTetra.h"

#include <cstdio>
#include <thread>

#include <sys/wait.h>
#include <unistd.h>

using namespace Testing;

namespace
{

using Prepare = std::function<void(vtkTetGenFilter*)>;

/**
 * The mesh, and that there was no message but so many warnings.
 */
Grid Fill(vtkPolyData* surface, const Prepare& prepare = nullptr, std::size_t warnings = 0)
{
  vtkNew<vtkTetGenFilter> filter;
  Messages messages(filter);
  filter->SetInputData(surface);
  if (prepare)
  {
    prepare(filter);
  }
  filter->Update();
  for (const std::string& error : messages.Errors)
  {
    std::cerr << error;
  }
  CHECK(messages.Errors.empty());
  CHECK(messages.Warnings.size() == warnings);
  CHECK(filter->GetErrorCode() == 0);
  Grid grid = Grid::New();
  grid->DeepCopy(filter->GetOutput());
  return grid;
}

/**
 * Points of the surface come first, same ids, same bits; the mesh has these triangles as its boundary
 * (and as faces between regions) and no others.
 */
void CheckKept(vtkPolyData* surface, vtkUnstructuredGrid* grid)
{
  CHECK(grid->GetPoints()->GetDataType() == VTK_DOUBLE);
  CHECK(grid->GetNumberOfPoints() >= surface->GetNumberOfPoints());
  for (vtkIdType p = 0; p < surface->GetNumberOfPoints(); ++p)
  {
    Point x;
    surface->GetPoint(p, x.data());
    const Point y = GetPoint(grid, p);
    CHECK(std::memcmp(x.data(), y.data(), sizeof x) == 0);
  }
  CHECK(KeptFacets(grid, "Region") == SurfaceFacets(surface));
}

double LargestVolume(vtkUnstructuredGrid* grid)
{
  double largest = 0.0;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    largest = std::max(largest, SignedVolume(grid, c));
  }
  return largest;
}

//------------------------------------------------------------------------------
void TestKeptSurface()
{
  for (const int precision : { VTK_DOUBLE, VTK_FLOAT })
  {
    Surface box = MakeBoxSurface(5, precision);
    Grid grid = Fill(box, [](vtkTetGenFilter* f) { f->SetMaximumVolume(1e-3); });
    CheckKept(box, grid);
    CHECK(Near(VolumeOf(grid), 1.0, 1e-7)); // float: corners are not exactly on the planes
    CHECK(grid->GetNumberOfCells() > 500);
    CHECK(grid->GetNumberOfPoints() > box->GetNumberOfPoints());
  }
  // A ball of uneven triangles.
  std::vector<Point> points;
  std::vector<std::vector<vtkIdType>> cells;
  const int n = 24;
  points.push_back({ { 0, 0, 1 } });
  points.push_back({ { 0, 0, -1 } });
  const auto id = [&](int i, int j) { return vtkIdType(2 + (i - 1) * n + (j + n) % n); };
  for (int i = 1; i < n / 2; ++i)
  {
    for (int j = 0; j < n; ++j)
    {
      const double t = vtkMath::Pi() * i / (n / 2), f = 2 * vtkMath::Pi() * j / n;
      points.push_back({ { std::sin(t) * std::cos(f), std::sin(t) * std::sin(f), std::cos(t) } });
      if (i > 1)
      {
        cells.push_back({ id(i - 1, j), id(i, j), id(i, j + 1) });
        cells.push_back({ id(i - 1, j), id(i, j + 1), id(i - 1, j + 1) });
      }
    }
  }
  for (int j = 0; j < n; ++j)
  {
    cells.push_back({ 0, id(1, j), id(1, j + 1) });
    cells.push_back({ 1, id(n / 2 - 1, j + 1), id(n / 2 - 1, j) });
  }
  Surface ball = MakeSurface(points, cells);
  for (const int level : { 0, 2, 10 })
  {
    Grid grid = Fill(ball,
      [=](vtkTetGenFilter* f)
      {
        f->SetOptimizationLevel(level);
        f->SetMaximumVolume(2e-3);
        f->SetMaximumRadiusEdgeRatio(1.5);
      });
    CheckKept(ball, grid);
    const double volume = VolumeOf(grid);
    CHECK(volume > 4.0 && volume < 4.0 / 3.0 * vtkMath::Pi());
  }
}

/**
 * "As generated" is Delaunay: no node inside the circumsphere of a cell of a convex body.
 */
int CountSpheresWithNodes(vtkUnstructuredGrid* grid)
{
  int count = 0;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    const std::vector<vtkIdType> ids = CellPoints(grid, c);
    Point x[4], centre;
    for (int i = 0; i < 4; ++i)
    {
      x[i] = GetPoint(grid, ids[i]);
    }
    const double radius2 = vtkTetra::Circumsphere(
      x[0].data(), x[1].data(), x[2].data(), x[3].data(), centre.data());
    for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
    {
      if (vtkMath::Distance2BetweenPoints(GetPoint(grid, p).data(), centre.data()) <
        radius2 * (1.0 - 1e-9))
      {
        ++count;
        break;
      }
    }
  }
  return count;
}

/**
 * Circumradius over shortest edge, the greatest of all cells.
 */
double LargestRadiusEdgeRatio(vtkUnstructuredGrid* grid)
{
  double largest2 = 0.0;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    const std::vector<vtkIdType> ids = CellPoints(grid, c);
    Point x[4], centre;
    double shortest2 = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 4; ++i)
    {
      x[i] = GetPoint(grid, ids[i]);
      for (int k = 0; k < i; ++k)
      {
        shortest2 = std::min(shortest2, vtkMath::Distance2BetweenPoints(x[i].data(), x[k].data()));
      }
    }
    const double radius2 = vtkTetra::Circumsphere(
      x[0].data(), x[1].data(), x[2].data(), x[3].data(), centre.data());
    largest2 = std::max(largest2, radius2 / shortest2);
  }
  return std::sqrt(largest2);
}

void TestLimits()
{
  Surface box = MakeBoxSurface(1);
  const auto refine = [](vtkTetGenFilter* f)
  {
    f->SetKeepSurface(false);
    f->SetMaximumVolume(1e-3);
    f->SetMaximumRadiusEdgeRatio(1.4);
    f->SetOptimizationLevel(0);
  };
  Grid grid = Fill(box, refine);
  CHECK(Near(VolumeOf(grid), 1.0));
  CHECK(LargestVolume(grid) <= 1e-3);
  CHECK(LargestRadiusEdgeRatio(grid) <= 1.4 * (1 + 1e-9));
  CHECK(KeptFacets(grid).size() > SurfaceFacets(box).size()); // cut
  CHECK(CountSpheresWithNodes(grid) == 0);
  // Level 0 leaves the mesh alone, level 2 does not; a limit on angles adds nodes.
  Grid optimized = Fill(box,
    [&](vtkTetGenFilter* f)
    {
      refine(f);
      f->SetOptimizationLevel(2);
    });
  CHECK(!SameGrid(grid, optimized));
  CHECK(CountSpheresWithNodes(optimized) > 0);
  Grid angles = Fill(box,
    [&](vtkTetGenFilter* f)
    {
      refine(f);
      f->SetMinimumDihedralAngle(12);
    });
  CHECK(angles->GetNumberOfPoints() > grid->GetNumberOfPoints());
  // No limits at all: nothing is added.
  Grid bare = Fill(box, [](vtkTetGenFilter* f) { f->SetMaximumRadiusEdgeRatio(0); });
  CHECK(bare->GetNumberOfPoints() == box->GetNumberOfPoints());
}

//------------------------------------------------------------------------------
void TestRegionsAndHoles()
{
  // Two boxes with a wall between them, and a cavity in the first one.
  Soup soup;
  soup.AddBox({ { 0, 0, 0 } }, { { 1, 1, 1 } }, 4).AddBox({ { 1, 0, 0 } }, { { 2, 1, 1 } }, 4);
  soup.AddBox({ { 0.25, 0.25, 0.25 } }, { { 0.75, 0.75, 0.75 } }, 2);
  Surface surface = soup.Make();
  Grid plain = Fill(surface);
  CheckKept(surface, plain);
  CHECK(Near(VolumeOf(plain), 2.0));
  std::set<int> numbers;
  for (vtkIdType c = 0; c < plain->GetNumberOfCells(); ++c)
  {
    numbers.insert(static_cast<int>(plain->GetCellData()->GetArray("Region")->GetComponent(c, 0)));
  }
  CHECK((numbers == std::set<int>{ 1, 2, 3 }));

  Grid marked = Fill(surface,
    [](vtkTetGenFilter* f)
    {
      f->AddRegion(0.1, 0.1, 0.1, -5, 0);
      f->AddRegion(1.5, 0.5, 0.5, 40, 5e-4);
      f->AddHole(0.5, 0.5, 0.5);
      f->AddHole(9, 9, 9); // outside: does nothing
      CHECK(f->GetNumberOfRegions() == 2 && f->GetNumberOfHoles() == 2);
    });
  CheckKept(surface, marked);
  const int first = -5, second = 40;
  CHECK(Near(VolumeOf(marked, &first), 1.0 - 0.125));
  CHECK(Near(VolumeOf(marked, &second), 1.0));
  CHECK(Near(VolumeOf(marked), 2.0 - 0.125));
  CHECK(marked->GetNumberOfCells() > plain->GetNumberOfCells() + 500); // the finer region

  // In no tetrahedron, and twice in one compartment: a warning each.
  Fill(
    surface,
    [](vtkTetGenFilter* f)
    {
      f->AddRegion(0.5, 0.5, 0.5, 3, 0);
      f->AddHole(0.5, 0.5, 0.5);
      f->AddRegion(0.1, 0.1, 0.1, 4, 0);
      f->AddRegion(0.9, 0.9, 0.9, 5, 0);
    },
    2);

  vtkNew<vtkTetGenFilter> filter;
  filter->AddRegion(0, 0, 0, 0, 0);
  filter->AddHole(0, 0, 0);
  filter->RemoveAllRegions();
  filter->RemoveAllHoles();
  CHECK(filter->GetNumberOfRegions() == 0 && filter->GetNumberOfHoles() == 0);
}

//------------------------------------------------------------------------------
void TestInteriorPoints()
{
  const std::vector<Point> wanted = { { { 0.41, 0.52, 0.43 } }, { { 0.3, 0.6, 0.7 } },
    { { 0.55, 0.45, 0.35 } } };
  std::vector<Point> given = wanted;
  given.push_back({ { 5, 5, 5 } });         // outside
  given.push_back({ { 0.125, 0.125, 1 } }); // on a facet
  given.push_back({ { 0.25, 0.25, 0 } });   // on a point of the surface
  Grid interior = MakeGrid(given);
  Surface box = MakeBoxSurface(4);
  Grid grid = Fill(box,
    [&](vtkTetGenFilter* f)
    {
      f->SetInteriorPointsData(interior);
      f->SetMaximumRadiusEdgeRatio(0);
      f->SetOptimizationLevel(0);
    });
  CheckKept(box, grid);
  CHECK(Near(VolumeOf(grid), 1.0));
  CHECK(CountSpheresWithNodes(grid) == 0); // level 0 here, too
  std::set<Point> nodes;
  for (vtkIdType p = box->GetNumberOfPoints(); p < grid->GetNumberOfPoints(); ++p)
  {
    nodes.insert(GetPoint(grid, p));
  }
  CHECK(nodes == std::set<Point>(wanted.begin(), wanted.end()));
}

//------------------------------------------------------------------------------
void TestCellsAndData()
{
  // Squares, a strip, vertices, lines; a point that nothing uses.
  Soup soup;
  soup.AddBox({ { 0, 0, 0 } }, { { 1, 1, 1 } }, 2, true);
  soup.Points.insert(soup.Points.begin() + 3, Point{ { 7, 7, 7 } });
  for (auto& cell : soup.Cells)
  {
    for (vtkIdType& p : cell)
    {
      p += p >= 3 ? 1 : 0;
    }
  }
  const std::vector<vtkIdType> square = soup.Cells.back();
  soup.Cells.pop_back();
  Surface surface = soup.Make();
  vtkNew<vtkCellArray> strips, verts, lines;
  strips->InsertNextCell({ square[0], square[1], square[3], square[2] });
  verts->InsertNextCell({ 0 });
  lines->InsertNextCell({ 0, 1 });
  surface->SetStrips(strips);
  surface->SetVerts(verts);
  surface->SetLines(lines);

  const vtkIdType n = surface->GetNumberOfPoints();
  vtkNew<vtkFloatArray> heat;
  heat->SetName("Heat");
  heat->SetNumberOfComponents(2);
  vtkNew<vtkIntArray> mark;
  mark->SetName("Mark");
  for (vtkIdType p = 0; p < n; ++p)
  {
    heat->InsertNextTuple2(p, -p);
    mark->InsertNextValue(static_cast<int>(p + 1));
  }
  surface->GetPointData()->AddArray(heat);
  surface->GetPointData()->SetScalars(mark);
  vtkNew<vtkStringArray> title;
  title->SetName("Title");
  title->InsertNextValue("box");
  surface->GetFieldData()->AddArray(title);
  const std::vector<Point> inside = { { { 0.5, 0.45, 0.55 } } };
  Grid interior = MakeGrid(inside);
  Grid grid = Fill(surface, [&](vtkTetGenFilter* f) { f->SetInteriorPointsData(interior); });

  CHECK(Near(VolumeOf(grid), 1.0));
  CHECK((GetPoint(grid, 3) == Point{ { 7, 7, 7 } }));
  CHECK(grid->GetNumberOfPoints() > n);
  vtkDataArray* heatOut = grid->GetPointData()->GetArray("Heat");
  vtkDataArray* markOut = grid->GetPointData()->GetScalars();
  CHECK(heatOut && heatOut->GetDataType() == VTK_FLOAT);
  CHECK(markOut && std::string(markOut->GetName()) == "Mark" && markOut->GetDataType() == VTK_INT);
  for (vtkIdType p = 0; heatOut && markOut && p < grid->GetNumberOfPoints(); ++p)
  {
    const double value = heatOut->GetComponent(p, 1);
    CHECK(p < n ? value == -static_cast<double>(p) : std::isnan(value));
    CHECK(markOut->GetComponent(p, 0) == (p < n ? static_cast<double>(p + 1) : 0.0));
  }
  CHECK(grid->GetFieldData()->GetAbstractArray("Title") != nullptr);

  Grid nothing = Fill(Surface::New()); // no message
  CHECK(nothing->GetNumberOfCells() == 0 && nothing->GetNumberOfPoints() == 0);
}

//------------------------------------------------------------------------------
void TestSameBitsAndThreads()
{
  Surface box = MakeBoxSurface(6);
  const auto refine = [](vtkTetGenFilter* f) { f->SetMaximumVolume(2e-4); };
  Grid first = Fill(box, refine);
  std::rand(); // TetGen uses rand(): the state of the application must not matter
  CHECK(SameGrid(first, Fill(box, refine)));

  Grid grids[3];
  Surface boxes[3];
  std::vector<std::thread> threads;
  for (int i = 0; i < 3; ++i)
  {
    grids[i] = Grid::New();
    boxes[i] = MakeBoxSurface(6);
    threads.emplace_back(
      [&, i]()
      {
        vtkNew<vtkTetGenFilter> filter;
        filter->SetInputData(boxes[i]);
        refine(filter);
        filter->Update();
        grids[i]->ShallowCopy(filter->GetOutput());
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  for (const Grid& grid : grids)
  {
    CHECK(SameGrid(first, grid));
  }
}

/**
 * Nothing on stdout or stderr, and no process left behind.
 */
void TestQuiet()
{
  std::fflush(stdout);
  std::FILE* file = std::tmpfile();
  const int out = ::dup(STDOUT_FILENO), err = ::dup(STDERR_FILENO);
  std::printf("written before");
  ::dup2(::fileno(file), STDOUT_FILENO);
  ::dup2(::fileno(file), STDERR_FILENO);
  vtkNew<vtkTetGenFilter> filter;
  Messages messages(filter);
  filter->SetInputData(MakeBoxSurface(3));
  filter->Update();
  Soup crossing;
  crossing.AddBox({ { 0, 0, 0 } }, { { 1, 1, 1 } }, 1);
  crossing.AddBox({ { 0.3, 0.3, 0.3 } }, { { 1.3, 1.3, 1.3 } }, 1);
  filter->SetInputData(crossing.Make());
  filter->Update();
  std::fflush(stdout);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(err, STDERR_FILENO);
  CHECK(std::ftell(file) == static_cast<long>(std::strlen("written before"))); // once, not twice
  CHECK(messages.Errors.size() == 1);
  CHECK(::waitpid(-1, nullptr, WNOHANG) == -1); // no child
  std::fclose(file);
  ::close(out);
  ::close(err);
}

void TestProgressAndAbort()
{
  Surface box = MakeBoxSurface(10);
  vtkNew<vtkTetGenFilter> filter;
  Messages messages(filter);
  filter->SetInputData(box);
  filter->SetMaximumVolume(2e-6);
  struct Seen
  {
    double Last = 0.0;
    bool Falls = false;
    bool Stop = false;
    int Phases = 0;
    std::string Text;
  } seen;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&seen);
  observer->SetCallback(
    [](vtkObject* caller, unsigned long, void* self, void* fraction)
    {
      auto mine = static_cast<Seen*>(self);
      auto algorithm = static_cast<vtkTetGenFilter*>(caller);
      const double now = *static_cast<double*>(fraction);
      mine->Falls |= now < mine->Last;
      mine->Last = now;
      const char* text = algorithm->GetProgressText();
      mine->Phases += text && mine->Text != text;
      mine->Text = text ? text : "";
      if (mine->Stop && mine->Text == "Refining")
      {
        algorithm->SetAbortExecute(1);
      }
    });
  filter->AddObserver(vtkCommand::ProgressEvent, observer);
  seen.Stop = true;
  filter->Update();
  CHECK(messages.Errors.empty());
  CHECK(seen.Text == "Refining" && !seen.Falls && seen.Phases >= 3);
  CHECK(filter->GetOutput()->GetNumberOfCells() == 0);
  CHECK(::waitpid(-1, nullptr, WNOHANG) == -1);

  seen = Seen();
  filter->SetAbortExecute(0);
  filter->SetMaximumVolume(1e-3);
  filter->Update();
  CHECK(!seen.Falls && seen.Phases >= 3 && seen.Last == 1.0);
  CHECK(filter->GetOutput()->GetNumberOfCells() > 0);
}

} // namespace

int main(int, char*[])
{
  TestKeptSurface();
  TestLimits();
  TestRegionsAndHoles();
  TestInteriorPoints();
  TestCellsAndData();
  TestSameBitsAndThreads();
  TestQuiet();
  TestProgressAndAbort();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
