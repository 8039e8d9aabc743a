# SPDX-License-Identifier: BSD-3-Clause
"""From a surface to a good mesh: STL -> TetGen -> optimized, with its surface taking part.

    pvpython slide_stl.py SURFACE.stl OUT.vtu [options]

    --tolerance T    how far the surface may move, as a fraction of the diagonal (default 1e-3)
    --picture PNG    before and after, by quality, and the surface after by its distance from the STL; needs a display (xvfb-run)
    --which          first a table: effort Quick with tolerances 0, 1e-4, 1e-3 and 1e-2, for who does not know his tolerance
    --make           writes SURFACE.stl first: a body of revolution with needles and ridges, as CAD programs write them

With PV_PLUGIN_PATH set (./bootstrap.sh env) the filters are there; otherwise call first
LoadPlugin(".../MeshOptimize.so", ns=globals()).
"""
import argparse
import math
import sys

import numpy as np
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkImplicitPolyDataDistance
from vtkmodules.vtkIOGeometry import vtkSTLWriter

PROFILE = [(0, 0), (1, 0), (1, 0.3), (0.35, 0.45), (0.3, 1.5), (0.55, 1.6), (0.55, 1.9), (0, 1.9)]  # radius, height
AROUND, LONGEST = 32, 0.2  # points around, and the longest edge along the profile, but not on the caps


def write_stl(path):
    """The profile revolved: the caps are fans of needles."""
    points, triangles = vtkPoints(), vtkCellArray()
    rings, profile = [], PROFILE[:1]
    for (r0, z0), (r1, z1) in zip(PROFILE, PROFILE[1:]):
        parts = math.ceil(math.hypot(r1 - r0, z1 - z0) / LONGEST) if r0 and r1 else 1
        profile += [(r0 + (r1 - r0) * k / parts, z0 + (z1 - z0) * k / parts) for k in range(1, parts + 1)]
    for radius, height in profile:
        ring = []
        for k in range(AROUND if radius else 1):
            angle = 2 * math.pi * k / AROUND
            ring.append(points.InsertNextPoint(radius * math.cos(angle), radius * math.sin(angle), height))
        rings.append(ring)
    for low, high in zip(rings, rings[1:]):
        for k in range(AROUND):
            a, b = low[k % len(low)], low[(k + 1) % len(low)]
            c, d = high[k % len(high)], high[(k + 1) % len(high)]
            for ids in {(a, b, d) if a != b else None, (a, d, c) if c != d else None} - {None}:
                triangles.InsertNextCell(3, ids)
    surface = vtkPolyData()
    surface.SetPoints(points)
    surface.SetPolys(triangles)
    writer = vtkSTLWriter()
    writer.SetFileName(path)
    writer.SetInputData(surface)
    writer.Write()


def optimized(mesh, tolerance, **options):
    result = MeshOptimize(Input=mesh, BoundaryMode="Slide", SurfaceTolerance=tolerance, GrowthBudget=0.5, **options)
    result.UpdatePipeline()
    result.UpdatePropertyInformation()
    return result


def with_distance(after, surface):
    """The surface of `after` with the point array Distance: from the triangles of `surface`, in units of its diagonal."""
    reference = servermanager.Fetch(surface)
    distance = vtkImplicitPolyDataDistance()
    distance.SetInput(reference)
    outside = servermanager.Fetch(ExtractSurface(Input=after))
    far = [abs(distance.EvaluateFunction(outside.GetPoint(p))) for p in range(outside.GetNumberOfPoints())]
    array = numpy_to_vtk(np.array(far) / reference.GetLength(), deep=1)
    array.SetName("Distance")
    outside.GetPointData().AddArray(array)
    producer = TrivialProducer(registrationName="Distance")
    producer.GetClientSideObject().SetOutput(outside)
    producer.UpdatePipeline()
    return producer


def picture(path, before, after, surface, tolerance):
    quality = MeshQualityMinMax(Input=before)
    shown = [(Clip(Input=source, ClipType="Plane", Crinkleclip=1), ("CELLS", "MeshQuality")) for source in (quality, after)]
    for clip, _ in shown:
        clip.ClipType.Normal, clip.ClipType.Origin = [0, 1, 0], [0, 0.02, 0.9]
    shown.append((with_distance(after, surface), ("POINTS", "Distance")))
    layout = CreateLayout("Before and after")
    cell = 0
    for k, (source, array) in enumerate(shown):
        view = CreateView("RenderView")
        AssignViewToLayout(view, layout, cell)
        if k < 2:
            cell = layout.SplitHorizontal(cell, [1 / 3, 1 / 2][k]) + 1
        display = Show(source, view)
        display.SetRepresentationType("Surface With Edges")
        ColorBy(display, array)
        if array[1] == "MeshQuality":
            GetColorTransferFunction(array[1]).RescaleTransferFunction(0, 1)  # a clip has a range of its own
        display.SetScalarBarVisibility(view, k > 0)
        if k > 0:
            bar = GetScalarBar(GetColorTransferFunction(array[1]), view)
            bar.Orientation, bar.WindowLocation, bar.ScalarBarLength = "Horizontal", "Lower Center", 0.6
        if array[1] == "Distance":
            GetColorTransferFunction(array[1]).RescaleTransferFunction(0, tolerance)
            bar.AddRangeLabels, bar.UseCustomLabels, bar.CustomLabels = 0, 1, [0, tolerance / 2, tolerance]
        view.OrientationAxesVisibility = 0
        view.CameraFocalPoint, view.CameraPosition, view.CameraViewUp = [0, 0, 0.77], [1.7, 5.0, 2.72], [0, 0, 1]
    layout.SetSize(1500, 700)
    SaveScreenshot(path, layout, OverrideColorPalette="WhiteBackground")


parser = argparse.ArgumentParser()
parser.add_argument("surface")
parser.add_argument("output")
parser.add_argument("--tolerance", type=float, default=1e-3)
parser.add_argument("--picture")
parser.add_argument("--which", action="store_true")
parser.add_argument("--make", action="store_true")
arguments = parser.parse_args()
if arguments.make:
    write_stl(arguments.surface)
surface = STLReader(FileNames=[arguments.surface])
mesh = TetrahedralizeTetGen(Input=surface, MaximumRadiusEdgeRatio=1.6, KeepSurface=1)
mesh.UpdatePipeline()
if mesh.GetDataInformation().GetNumberOfCells() == 0:
    sys.exit(f"{arguments.surface}: no tetrahedra")  # the errors above say why
if arguments.which:
    print("tolerance   worst element   surface moved   elements   seconds")
    for tolerance in (0, 1e-4, 1e-3, 1e-2):
        tried = optimized(mesh, tolerance, Effort="Quick")
        data = tried.GetDataInformation()
        box = data.GetBounds()
        diagonal = math.dist(box[::2], box[1::2])
        print(f"{tolerance:9g}   {tried.WorstQualityAfter:13.4f}   {tried.SurfaceDistance / diagonal:13.1e}   "
              f"{data.GetNumberOfCells():8d}   {tried.OptimizeSeconds:7.2f}")
kept = MeshOptimize(Input=mesh)
kept.UpdatePipeline()
kept.UpdatePropertyInformation()
slid = optimized(mesh, arguments.tolerance)
SaveData(arguments.output, proxy=slid, DataMode="Binary")
for name, source in (("kept", kept), ("sliding", slid)):
    print(f"surface {name}: worst element {source.WorstQualityBefore:.4f} -> {source.WorstQualityAfter:.4f}; {source.StopReason}")
if arguments.picture:
    picture(arguments.picture, mesh, slid, surface, arguments.tolerance)
