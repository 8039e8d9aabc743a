"""What the paraview tests share: the plugin, a mesh made in the script, and a check that speaks."""
import os

from paraview import simple
from vtkmodules.vtkCommonCore import vtkMinimalStandardRandomSequence, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkFiltersCore import vtkDelaunay3D

OUTPUT = os.environ["MESHOPTIMIZE_OUTPUT"]
DATA = os.environ["MESHOPTIMIZE_DATA"]


def load_plugin():
    """The plugin is there by PV_PLUGIN_PATH; without that variable it is loaded by LoadPlugin."""
    if "PV_PLUGIN_PATH" not in os.environ:
        simple.LoadPlugin(os.environ["MESHOPTIMIZE_PLUGIN"], remote=False, ns=simple.__dict__)
    check(hasattr(simple, "MeshOptimize"), "the plugin is not loaded")


def random_mesh(points=300, seed=1996):
    """Delaunay tetrahedra of seeded points in the unit cube, slivers included; volumes positive."""
    sequence = vtkMinimalStandardRandomSequence()
    sequence.SetSeed(seed)
    cloud = vtkPoints()
    cloud.SetDataTypeToDouble()
    for _ in range(points):
        xyz = []
        for _ in range(3):
            xyz.append(sequence.GetValue())
            sequence.Next()
        cloud.InsertNextPoint(xyz)
    for corner in range(8):
        cloud.InsertNextPoint(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1)
    poly = vtkPolyData()
    poly.SetPoints(cloud)
    delaunay = vtkDelaunay3D()
    delaunay.SetInputData(poly)
    delaunay.Update()
    grid = vtkUnstructuredGrid()
    grid.DeepCopy(delaunay.GetOutput())
    return grid


def source_of(grid):
    """A pipeline source that gives `grid`."""
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(grid)
    source.UpdatePipeline()
    return source


def check(condition, *message):
    if not condition:
        raise SystemExit("FAILED: " + " ".join(str(m) for m in message))
