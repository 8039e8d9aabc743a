# SPDX-License-Identifier: BSD-3-Clause
"""The paper's figures 2, 3 and 4: cracked pellets, their meshes and von Mises' stress on the deformed bodies.

    xvfb-run -a pvpython figures.py FOLDER [--meshes crack20 crack40 crack60]

Writes FOLDER/figure2.png (meshes), figure3.png (top views) and figure4.png (side view, of the crack of 40 %). Meshes are those of
table 2, optimized with the default effort. Needs a display and the package meshoptimize (./bootstrap.sh env); takes half a minute.
"""
import argparse
import pathlib

from paraview import servermanager
from paraview.simple import *  # noqa: F403

import pellet
import study

INK = [0.12, 0.16, 0.22]
MEGAPASCAL = 1e-6
SCALE = 8  # of the displacement
GREATEST = 2500  # MPa: above it, at the ends of the cracks, where the stress is singular, all is of one colour
SIZE = 600  # pixels of a picture's side
BAR = 150  # pixels that the scalar bar takes
CAPTIONS = {"crack20": "a", "crack40": "b", "crack60": "c"}


def source_of(grid, name):
    producer = TrivialProducer(registrationName=name)
    producer.GetClientSideObject().SetOutput(grid)
    producer.UpdatePipeline()
    return producer


def solved(name):
    """The optimized mesh with its solution, without rigid motion, as a pipeline source."""
    optimized = study.optimize(pellet.mesh(name), "default")
    f = study.solver(optimized.grid)
    f.SetYoungsModulus(study.YOUNGS_MODULUS * MEGAPASCAL)
    f.SetRigidMotionToProject()
    return source_of(study.solve(f).grid, name)


def new_view(width=SIZE, height=SIZE):
    view = CreateView("RenderView")
    view.ViewSize = [width, height]
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0
    view.CameraParallelProjection = 1
    return view


def text_in(view, text, location, size=18):
    display = Show(Text(Text=text), view)
    display.Color = INK
    display.FontSize = size
    display.WindowLocation = location
    display.Justification = "Center"


def look(view, direction, up, scale, focus=(0, 0, pellet.HEIGHT / 2)):
    view.CameraFocalPoint = list(focus)
    view.CameraPosition = [f + 5 * d for f, d in zip(focus, direction)]
    view.CameraViewUp = up
    view.CameraParallelScale = scale


def colours():
    """Dark where the stress is high, as in the paper."""
    table = GetColorTransferFunction("VonMises")
    table.ApplyPreset("Viridis (matplotlib)", True)
    table.InvertTransferFunction()
    table.RescaleTransferFunction(0, GREATEST)
    return table


def show_stress(solution, view):
    """The deformed body in colours, its edges as lines."""
    warped = WarpByVector(Input=solution, Vectors=["POINTS", "Displacement"], ScaleFactor=SCALE)
    display = Show(warped, view)
    display.SetRepresentationType("Surface")
    ColorBy(display, ("POINTS", "VonMises"))
    display.LookupTable = colours()
    display.Ambient, display.Diffuse = 1.0, 0.0  # colours as in the bar
    display.SetScalarBarVisibility(view, False)
    edges = Show(FeatureEdges(Input=ExtractSurface(Input=warped), FeatureAngle=40), view)
    edges.ColorArrayName = ["POINTS", ""]
    edges.AmbientColor = edges.DiffuseColor = INK
    edges.LineWidth = 1.5
    edges.Ambient, edges.Diffuse = 1.0, 0.0


def bar_view(solution):
    """A narrow view with nothing but the scalar bar."""
    view = new_view(BAR)
    Show(solution, view).SetRepresentationType("Outline")
    look(view, (0, 0, 1), [0, 1, 0], 1.0, (50, 0, 0))  # past the body
    bar = GetScalarBar(colours(), view)
    bar.Title, bar.ComponentTitle = "von Mises, MPa", ""
    bar.TitleColor = bar.LabelColor = INK
    bar.TitleFontSize, bar.LabelFontSize = 20, 18
    bar.Orientation, bar.WindowLocation = "Vertical", "Any Location"
    bar.Position, bar.ScalarBarLength, bar.ScalarBarThickness = [0.08, 0.22], 0.56, 20
    bar.AutomaticLabelFormat, bar.LabelFormat, bar.RangeLabelFormat = 0, "%.0f", "%.0f"
    bar.UseCustomLabels, bar.CustomLabels = 1, list(range(500, GREATEST, 500))
    bar.Visibility = 1
    return view


def save(path, views, widths):
    layout = CreateLayout(path.stem)
    cell = 0
    for i, view in enumerate(views):
        AssignViewToLayout(view, layout, cell)
        if i + 1 < len(views):
            left = layout.SplitHorizontal(cell, widths[i] / sum(widths[i:]))
            cell = left + 1
    layout.SetSize(sum(widths), SIZE)
    SaveScreenshot(str(path), layout, ImageResolution=[sum(widths), SIZE], SeparatorWidth=0, SeparatorColor=[1, 1, 1], CompressionLevel="9")
    print(path)


def title(name):
    return f"({CAPTIONS[name]}) crack {100 * pellet.MESHES[name]['crack']:.0f} %"


def figure2(solutions, path):
    views = []
    for name, solution in solutions.items():
        view = new_view()
        display = Show(solution, view)
        display.SetRepresentationType("Surface With Edges")
        display.ColorArrayName = ["POINTS", ""]
        display.AmbientColor = display.DiffuseColor = [0.80, 0.86, 0.92]
        display.EdgeColor = [0.20, 0.27, 0.36]
        display.Ambient, display.Diffuse = 0.55, 0.5
        grid = servermanager.Fetch(solution)
        text_in(view, f"{title(name)}: {grid.GetNumberOfPoints():,} nodes, {grid.GetNumberOfCells():,} elements", "Lower Center")
        look(view, (0.72, -0.35, 0.60), [0, 0, 1], 0.89, (0, 0, pellet.HEIGHT / 2 - 0.05))
        views.append(view)
    save(path, views, [SIZE] * len(views))


def figure3(solutions, path):
    views = []
    for name, solution in solutions.items():
        view = new_view()
        show_stress(solution, view)
        text_in(view, title(name), "Lower Center")
        look(view, (0, 0, 1), [0, 1, 0], 0.70, (0.02, -0.04, pellet.HEIGHT / 2))
        views.append(view)
    views.append(bar_view(solution))
    save(path, views, [SIZE] * len(solutions) + [BAR])


def figure4(solution, path):
    view = new_view()
    show_stress(solution, view)
    look(view, (1, 0, 0), [0, 0, 1], 0.78)
    save(path, [view, bar_view(solution)], [SIZE, BAR])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--meshes", nargs="+", choices=CAPTIONS, default=list(CAPTIONS))
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    solutions = {name: solved(name) for name in options.meshes}
    figure2(solutions, options.folder / "figure2.png")
    figure3(solutions, options.folder / "figure3.png")
    if "crack40" in solutions:
        figure4(solutions["crack40"], options.folder / "figure4.png")


main()
