"""Before and after: optimizes a mesh, prints a table, writes the mesh and a picture.

    pvpython demo.py IN.vtu FOLDER [--target Q] [--algorithm "Paper 1996"] [--effort Best]

Writes FOLDER/optimized.vtu and FOLDER/before_after.png. Needs a display (xvfb-run) for the picture.
./bootstrap.sh demo runs it on Data/crack40.vtu.
"""
import argparse
import os

import numpy as np
from paraview import servermanager
from paraview.simple import *  # noqa: F403  (PV_PLUGIN_PATH brings MeshOptimize and MeshQualityMinMax)
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkDataObject, vtkPolyData

STEPS = (0.1, 0.2, 0.3)  # "elements under ..." in the table
INK = [0.12, 0.16, 0.22]
SHOWN = 0.3  # the picture shows every element under this


def measure(source):
    """MeshQualityMinMax on `source`, and what the table shows of it."""
    quality = MeshQualityMinMax(Input=source, NumberOfBins=50)
    quality.UpdatePipeline()
    quality.UpdatePropertyInformation()
    mesh = servermanager.Fetch(quality)
    values = vtk_to_numpy(mesh.GetCellData().GetArray("MeshQuality"))
    row = {"worst quality": f"{quality.MinimumQuality:.4f}",
           "mean quality": f"{quality.MeanQuality:.4f}"}
    for step in STEPS:
        row[f"elements under {step}"] = f"{np.count_nonzero(values < step):,}"
    row["elements"] = f"{mesh.GetNumberOfCells():,}"
    row["nodes"] = f"{mesh.GetNumberOfPoints():,}"
    return quality, row


def print_table(before, after):
    print(f"{'':24}{'before':>12}{'after':>12}")
    for key in before:
        print(f"{key:24}{before[key]:>12}{after[key]:>12}")


def text_in(view, text, size, location, position=None):
    display = Show(Text(Text=text), view)
    display.Color = INK
    display.FontSize = size
    display.WindowLocation = location
    if position:
        display.Position = position


def show_mesh(quality, title, view):
    """The rear half of the mesh, cut open, and every bad element of the whole mesh in colour."""
    bounds = quality.GetDataInformation().GetBounds()
    centre = [(bounds[2 * i] + bounds[2 * i + 1]) / 2 for i in range(3)]
    rear = Clip(Input=quality, Crinkleclip=1, Invert=1)
    rear.ClipType.Origin = centre
    rear.ClipType.Normal = [0.0, -1.0, 0.0]
    bad = Threshold(Input=quality, Scalars=["CELLS", "MeshQuality"], ThresholdMethod="Below Lower Threshold",
                    LowerThreshold=SHOWN)
    bad.UpdatePipeline()
    shown = [(rear, [0.45, 0.53, 0.62])]
    if bad.GetDataInformation().GetNumberOfCells() > 0:
        shown.append((bad, [0.35, 0.05, 0.05]))
    for source, edges in shown:
        display = Show(source, view)
        display.SetRepresentationType("Surface With Edges")
        display.EdgeColor = edges
        display.LineWidth = 1.0
        display.Ambient, display.Diffuse = 0.35, 0.7
        display.SetScalarColoring("MeshQuality", vtkDataObject.CELL)  # ColorBy would fit the range to the data
        display.SetScalarBarVisibility(view, False)
    text_in(view, title, 22, "Upper Center")
    view.CameraFocalPoint = [centre[0], centre[1], centre[2] + 0.04]
    view.CameraPosition = [centre[0] - 1.2, centre[1] - 4.0, centre[2] + 1.2]
    view.CameraViewUp = [0, 0, 1]
    view.CameraParallelProjection = 1
    view.CameraParallelScale = 0.64 * max(bounds[5] - bounds[4], 1.13 * (bounds[1] - bounds[0]))


def histogram(quality, column):
    """A column of the histogram table, output 2 of MeshQualityMinMax."""
    return vtk_to_numpy(servermanager.Fetch(quality, idx=2).GetColumnByName(column))


def bars(qualities, counts, box, decades):
    """The histogram as rectangles in a box (left, bottom, width, height); heights are logarithmic, so that one bad element shows."""
    left, bottom, width, height = box
    points, polygons, colours = vtkPoints(), vtkCellArray(), vtkDoubleArray()
    colours.SetName("MeshQuality")
    step = width / len(counts)
    for quality, count in zip(qualities, counts):
        if count == 0:
            continue
        x = left + quality * width - step / 2
        top = bottom + height * (np.log10(count) + 0.15) / decades  # one element: a low bar, not none
        polygons.InsertNextCell(4)
        for corner in ((x, bottom), (x + 0.86 * step, bottom), (x + 0.86 * step, top), (x, top)):
            polygons.InsertCellPoint(points.InsertNextPoint(corner[0], corner[1], 0))
        colours.InsertNextValue(quality)
    result = vtkPolyData()
    result.SetPoints(points)
    result.SetPolys(polygons)
    result.GetCellData().AddArray(colours)
    return result


def show_histogram(quality, title, view, decades):
    """Bars over the quality; the view counts in pixels of an 800 x 460 picture."""
    left, bottom, width, height = 90, 60, 690, 340
    columns = [histogram(quality, name) for name in ("BinCenter", "Count")]
    source = TrivialProducer()
    source.GetClientSideObject().SetOutput(bars(*columns, (left, bottom, width, height), decades))
    display = Show(source, view)
    display.Ambient, display.Diffuse = 1.0, 0.0
    display.SetScalarColoring("MeshQuality", vtkDataObject.CELL)
    display.SetScalarBarVisibility(view, False)
    axis = Show(Line(Point1=[left, bottom, 0], Point2=[left + width, bottom, 0]), view)
    axis.AmbientColor = axis.DiffuseColor = INK
    for tick in range(0, 11, 2):
        text_in(view, f"{tick / 10:g}", 14, "Any Location", [(left + tick / 10 * width - 8) / 800, 0.065])
    for decade in range(int(decades) + 1):
        y = bottom + height * (decade + 0.15) / decades
        text_in(view, f"{10 ** decade:>6,}", 14, "Any Location", [0.02, (y - 10) / 460])
    text_in(view, title, 20, "Upper Center")
    view.CameraFocalPoint, view.CameraPosition = [400, 230, 0], [400, 230, 1000]
    view.CameraViewUp, view.CameraParallelProjection, view.CameraParallelScale = [0, 1, 0], 1, 230


def picture(before, after, rows, path):
    layout = CreateLayout("Before and after")
    views = [CreateView("RenderView") for _ in range(4)]
    for view in views:
        view.UseColorPaletteForBackground = 0
        view.Background = [1, 1, 1]
        view.OrientationAxesVisibility = 0
    left, right, left_chart, right_chart = views
    AssignViewToLayout(left, layout, 0)
    half = layout.SplitHorizontal(0, 0.5)
    AssignViewToLayout(right, layout, half + 1)
    lower_left = layout.SplitVertical(half, 0.64)
    AssignViewToLayout(left_chart, layout, lower_left + 1)
    lower_right = layout.SplitVertical(half + 1, 0.64)
    AssignViewToLayout(right_chart, layout, lower_right + 1)
    layout.SetSize(1600, 1280)

    decades = np.log10(max(np.max(histogram(quality, "Count")) for quality in (before, after))) + 0.25
    for quality, row, name, view, chart in (
            (before, rows[0], "before", left, left_chart), (after, rows[1], "after", right, right_chart)):
        show_mesh(quality, f"{name}: worst element {row['worst quality']}", view)
        show_histogram(quality, f"{row[f'elements under {SHOWN}']} of {row['elements']} elements under {SHOWN}", chart, decades)
    bar = GetScalarBar(GetColorTransferFunction("MeshQuality"), right)  # the plugin's: loud where elements are bad
    bar.Title, bar.ComponentTitle = "Mesh quality", ""
    bar.TitleColor = bar.LabelColor = INK
    bar.Orientation, bar.WindowLocation = "Vertical", "Any Location"
    bar.Position, bar.ScalarBarLength = [0.88, 0.2], 0.5
    bar.AutomaticLabelFormat, bar.LabelFormat, bar.RangeLabelFormat = 0, "%.1f", "%.1f"
    bar.Visibility = 1
    SaveScreenshot(path, layout, ImageResolution=[1600, 1280], SeparatorWidth=0, CompressionLevel="9")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("mesh")
    parser.add_argument("folder")
    parser.add_argument("--target", type=float, default=0.6)
    parser.add_argument("--algorithm")
    parser.add_argument("--effort")
    options = parser.parse_args()
    os.makedirs(options.folder, exist_ok=True)

    reader = XMLUnstructuredGridReader(FileName=[options.mesh])
    optimize = MeshOptimize(Input=reader, TargetQuality=options.target)
    if options.algorithm:
        optimize.Algorithm = options.algorithm
    if options.effort:
        optimize.Effort = options.effort
    optimize.UpdatePipeline()
    optimize.UpdatePropertyInformation()

    before, row_before = measure(reader)
    after, row_after = measure(optimize)
    print_table(row_before, row_after)
    print(f"what the surface allows at most: {before.QualityBound:.4f}")
    print(f"optimizer: {optimize.OptimizeSeconds:.1f} s, {optimize.NumberOfOperations:,} operations; {optimize.StopReason}")

    mesh_path = os.path.join(options.folder, "optimized.vtu")
    SaveData(mesh_path, proxy=optimize, DataMode="Binary")
    picture_path = os.path.join(options.folder, "before_after.png")
    picture(before, after, (row_before, row_after), picture_path)
    print(f"mesh:    {mesh_path}\npicture: {picture_path}")


main()
