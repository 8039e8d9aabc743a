# SPDX-License-Identifier: BSD-3-Clause
"""A picture of meshes side by side: the surface, pale and translucent, and the bad elements solid within it."""
import contextlib
import os
import shutil
import subprocess

import numpy as np
import vtkmodules.vtkRenderingFreeType  # noqa: F401  (letters)
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (drawing)
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkUnstructuredGrid
from vtkmodules.vtkFiltersCore import vtkAppendFilter
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (vtkActor, vtkColorTransferFunction, vtkPolyDataMapper, vtkRenderer,
                                         vtkRenderWindow, vtkTextActor, vtkWindowToImageFilter)

from ._grids import CELL_OF_CORNERS, grids_of, kinds_of, nodes_of, simplices
from ._run import MeshOptimizeError
from .vtkFiltersMeshOptimize import vtkMeshQualityMinMax

SIZE = 800  # of one view, in pixels
BAD, FEWEST = 0.3, 10  # elements under BAD are shown, and that many of the worst in any case
INK = (0.12, 0.16, 0.22)
# Loud where elements are bad, pale where they are good: the map of ParaViewPlugin/MeshOptimizeColorMaps.cxx
COLOURS = ((0.0, 0.50, 0.00, 0.15), (0.1, 0.80, 0.10, 0.11), (0.2, 0.95, 0.40, 0.05), (0.3, 1.00, 0.75, 0.15),
           (0.301, 0.86, 0.92, 0.96), (1.0, 0.72, 0.83, 0.91))


@contextlib.contextmanager
def _display():
    """A display to draw on: the one that is there, or one of our own where VTK needs X and there is none."""
    if os.environ.get("DISPLAY") or "X" not in vtkRenderWindow().GetClassName():
        yield
        return
    if not shutil.which("Xvfb"):
        raise MeshOptimizeError(
            "a picture needs a display: set DISPLAY, or install Xvfb (Debian: apt-get install xvfb)")
    reading, writing = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(writing), "-screen", "0", "1600x1200x24", "-nolisten", "tcp"],
                              pass_fds=[writing], stderr=subprocess.DEVNULL)
    os.close(writing)
    try:
        with os.fdopen(reading) as pipe:
            number = pipe.readline().strip()  # comes once the server listens, empty if it ends before
        if not number:
            raise MeshOptimizeError("a picture needs a display, and Xvfb does not start")
        os.environ["DISPLAY"] = ":" + number
        yield
    finally:
        os.environ.pop("DISPLAY", None)
        server.terminate()
        server.wait()


def _elements(grid):
    """The tetrahedra of a measured grid (the triangles, where there are none): their nodes and qualities."""
    kinds = kinds_of(grid)
    corners = 4 if (kinds == VTK_TETRA).any() else 3
    ids = np.flatnonzero(kinds == CELL_OF_CORNERS[corners])
    return nodes_of(grid, ids, corners), vtk_to_numpy(grid.GetCellData().GetArray("MeshQuality"))[ids]


def _grid(points, elements, qualities):
    grid = simplices(points, elements)
    grid.GetCellData().SetScalars(numpy_to_vtk(np.ascontiguousarray(qualities), deep=1))
    return grid


def _actor(grid, colours, opacity, edges):
    surface, mapper, actor = vtkDataSetSurfaceFilter(), vtkPolyDataMapper(), vtkActor()
    surface.SetInputData(grid)
    mapper.SetInputConnection(surface.GetOutputPort())
    mapper.SetLookupTable(colours)
    mapper.UseLookupTableScalarRangeOn()
    mapper.SetScalarModeToUseCellData()
    actor.SetMapper(mapper)
    actor.GetProperty().SetOpacity(opacity)
    actor.GetProperty().SetEdgeVisibility(edges)
    actor.GetProperty().SetEdgeColor(*INK)
    actor.GetProperty().SetAmbient(0.4)  # so that colours stay apart in the shade
    actor.GetProperty().SetDiffuse(0.6)
    return actor


def _one_grid(data):
    """All grids of composite data in one; a grid as it is."""
    if isinstance(data, vtkUnstructuredGrid):
        return data
    append = vtkAppendFilter()
    for grid in grids_of(data):
        append.AddInputData(grid)
    append.Update()
    return append.GetOutput()


def _title(text):
    actor = vtkTextActor()
    actor.SetInput(text)
    actor.SetPosition(16, SIZE - 40)
    actor.GetTextProperty().SetFontSize(22)
    actor.GetTextProperty().SetColor(*INK)
    return actor


def _scale(colours):
    bar = vtkScalarBarActor()
    bar.SetLookupTable(colours)
    bar.SetNumberOfLabels(3)
    bar.SetLabelFormat("%.1f")
    for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        text.SetColor(*INK)
        text.ItalicOff()
        text.BoldOff()
    bar.SetPosition(0.93, 0.03)
    bar.SetWidth(0.06)
    bar.SetHeight(0.3)
    return bar


def _view(title, mesh, colours):
    measure = vtkMeshQualityMinMax()
    measure.ComputeBoundOff()
    measure.SetInputDataObject(mesh)
    measure.Update()
    elements, qualities = _elements(measure.GetOutput())
    order = np.argsort(qualities)
    bad = order[:max(FEWEST, np.count_nonzero(qualities < BAD))]
    points = measure.GetOutput().GetPoints()
    view = vtkRenderer()
    view.SetBackground(1, 1, 1)
    view.AddActor(_actor(_grid(points, elements, qualities), colours, 0.25 if elements.shape[1] == 4 else 1.0, False))
    view.AddActor(_actor(_grid(points, elements[bad], qualities[bad]), colours, 1.0, True))
    view.AddActor(_title(f"{title}: worst {qualities[order[0]]:.4f}, {np.count_nonzero(qualities < BAD)} under {BAD}"))
    return view


def draw(grids, path):
    """Draws grids side by side into a PNG file, with one camera for all. `grids`: pairs of a title and a mesh of VTK."""
    grids = [(title, _one_grid(data)) for title, data in grids]
    colours = vtkColorTransferFunction()
    for point in COLOURS:
        colours.AddRGBPoint(*point)
    with _display():
        window = vtkRenderWindow()
        window.SetOffScreenRendering(1)
        window.SetSize(SIZE * len(grids), SIZE)
        window.SetMultiSamples(4)
        for index, (title, grid) in enumerate(grids):
            view = _view(title, grid, colours)
            view.SetViewport(index / len(grids), 0, (index + 1) / len(grids), 1)
            window.AddRenderer(view)
            if index == 0:
                first = view
                first.ResetCamera()
                if np.ptp(np.array(grid.GetBounds())[4:]) > 0:  # not a mesh in a plane
                    first.GetActiveCamera().Azimuth(30)
                    first.GetActiveCamera().Elevation(25)
                    first.ResetCamera()
            view.SetActiveCamera(first.GetActiveCamera())
        bar = _scale(colours)
        view.AddActor(bar)
        window.Render()
        image, writer = vtkWindowToImageFilter(), vtkPNGWriter()
        image.SetInput(window)
        image.ReadFrontBufferOff()
        writer.SetInputConnection(image.GetOutputPort())
        writer.SetFileName(os.fspath(path))
        writer.Write()
        failed = writer.GetErrorCode()
        image.SetInput(None)
        window.Finalize()  # before its display goes
        del window, image, writer, view, first, bar
    if failed:
        raise MeshOptimizeError(f"{path} cannot be written")
