# SPDX-License-Identifier: BSD-3-Clause
"""A disc of sixteen triangles with a hole gets fine and round by Mesh Optimize, along its own points and along a geometry; a picture of it.

MESHOPTIMIZE_ACCEPT_BASELINES=1 takes the new picture over as Data/Baseline/boundary_slides.png: look at it first.
"""
import math
import os

from paraview import servermanager, simple
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TRIANGLE, vtkCellArray, vtkPolyData, vtkUnstructuredGrid

from paraview_case import OUTPUT, check, compare_picture, load_plugin, source_of

INNER, OUTER = 0.4, 1.0


def circle(points, radius, n):
    return [points.InsertNextPoint(radius * math.cos(2 * math.pi * k / n), radius * math.sin(2 * math.pi * k / n), 0)
            for k in range(n)]


def new_points():
    points = vtkPoints()
    points.SetDataTypeToDouble()
    return points


def ring(n):
    """Between two circles of n points each."""
    grid = vtkUnstructuredGrid()
    points = new_points()
    inner, outer = circle(points, INNER, n), circle(points, OUTER, n)
    grid.SetPoints(points)
    grid.Allocate(2 * n)
    for k in range(n):
        after = (k + 1) % n
        grid.InsertNextCell(VTK_TRIANGLE, 3, [inner[k], outer[k], outer[after]])
        grid.InsertNextCell(VTK_TRIANGLE, 3, [inner[k], outer[after], inner[after]])
    return grid


def circles(n):
    """The same circles as lines, finely."""
    lines = vtkCellArray()
    points = new_points()
    for radius in (INNER, OUTER):
        ids = circle(points, radius, n)
        lines.InsertNextCell(n + 1)
        for k in range(n + 1):
            lines.InsertCellPoint(ids[k % n])
    data = vtkPolyData()
    data.SetPoints(points)
    data.SetLines(lines)
    return data


def out_of_round(mesh):
    """Greatest distance of boundary nodes from their circle."""
    edges = {}
    for c in range(mesh.GetNumberOfCells()):
        cell = mesh.GetCell(c)
        ids = [cell.GetPointId(i) for i in range(3)]
        for i in range(3):
            edge = frozenset((ids[i], ids[(i + 1) % 3]))
            edges[edge] = edges.get(edge, 0) + 1
    nodes = set().union(*(edge for edge, n in edges.items() if n == 1))
    return max(min(abs(math.hypot(*mesh.GetPoint(p)[:2]) - r) for r in (INNER, OUTER)) for p in nodes)


def results(optimize):
    optimize.UpdatePipeline()
    optimize.UpdatePropertyInformation()
    mesh = servermanager.Fetch(optimize)
    print(f"{mesh.GetNumberOfCells()} triangles, worst {optimize.WorstQualityAfter:.3f}, "
          f"{100 * optimize.EdgeLengthShare:.1f} % of the edges as long as wanted, out of round by {out_of_round(mesh):.1e}")
    check(optimize.WorstQualityAfter >= 0.6, "worst", optimize.WorstQualityAfter)
    check(optimize.EdgeLengthShare >= 0.85, "share", optimize.EdgeLengthShare)
    check(abs(mesh.GetFieldData().GetArray("EdgeLengthShare").GetValue(0) - optimize.EdgeLengthShare) < 1e-12, "field data")
    return out_of_round(mesh)


load_plugin()
coarse = source_of(ring(16))
optimize = simple.MeshOptimize(Input=coarse)
check(optimize.BoundaryMode == "Fixed" and optimize.BoundaryCurve == "BSpline", "defaults", optimize.BoundaryMode)
check(optimize.GetPropertyValue("CornerArray")[1] in ("None", ""), "a corner array is taken by itself")
optimize.UpdatePipeline()
check(optimize.GetDataInformation().GetNumberOfCells() < 50, "sizes are followed by default")
optimize.BoundaryMode = "Slide"
optimize.DesiredSize = 0.08
check(results(optimize) < 1e-4, "splines through 16 points are not round")

along = simple.MeshOptimize(Input=coarse, Geometry=source_of(circles(400)), BoundaryMode="Slide", BoundaryCurve="Straight",
                            DesiredSize=0.08)
check(results(along) < 4e-5, "the geometry is not followed")
along.Geometry = source_of(circles(100))
check(4e-5 < results(along) < 5e-4, "another geometry makes no difference")

view = simple.CreateView("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [1, 1, 1]
view.OrientationAxesVisibility = 0
for source, x in ((coarse, -1.1), (optimize, 1.1)):
    moved = simple.Transform(Input=source)
    moved.Transform.Translate = [x, 0, 0]
    display = simple.Show(moved, view)
    display.SetRepresentationType("Surface With Edges")
    display.Ambient, display.Diffuse = 1.0, 0.0
    display.EdgeColor = [0.2, 0.25, 0.32]
    simple.ColorBy(display, ("POINTS", ""))
    display.AmbientColor = display.DiffuseColor = [0.80, 0.88, 0.95]
view.CameraFocalPoint, view.CameraPosition, view.CameraViewUp = [0, 0, 0], [0, 0, 10], [0, 1, 0]
view.CameraParallelProjection, view.CameraParallelScale = 1, 1.15
picture = os.path.join(OUTPUT, "boundary_slides.png")
simple.SaveScreenshot(picture, view, ImageResolution=[1000, 520], CompressionLevel="9")
compare_picture(picture, "boundary_slides.png")
