# SPDX-License-Identifier: BSD-3-Clause
"""What a newcomer gets wrong first, from Python: one message that says what it is about, and no crash."""
import sys

import meshoptimize
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (VTK_HEXAHEDRON, VTK_TETRA, VTK_TRIANGLE, vtkMultiBlockDataSet, vtkPolyData,
                                           vtkUnstructuredGrid)
from vtkmodules.vtkFiltersSources import vtkCubeSource

FILTERS = [getattr(meshoptimize, name) for name in (
    "vtkMeshOptimizeFilter", "vtkMeshQualityMinMax", "vtkSolutionMetricFilter", "vtkThermoelasticFilter", "vtkTetGenFilter")
           if hasattr(meshoptimize, name)]
failures = []


def cube(cell_type, *cells):
    grid, points = vtkUnstructuredGrid(), vtkPoints()
    for corner in range(8):
        points.InsertNextPoint(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1)
    grid.SetPoints(points)
    for cell in cells:
        grid.InsertNextCell(cell_type, len(cell), cell)
    values = numpy_to_vtk(np.arange(8.0) ** 2, deep=1)
    values.SetName("Temperature")
    grid.GetPointData().SetScalars(values)
    return grid


def tetrahedron():
    return cube(VTK_TETRA, [0, 1, 2, 4])


def hexahedron():
    return cube(VTK_HEXAHEDRON, [0, 1, 3, 2, 4, 5, 7, 6])


def triangles():
    return cube(VTK_TRIANGLE, [0, 1, 3], [0, 3, 2])


def surface():
    source = vtkCubeSource()
    source.Update()
    return source.GetOutput()


def blocks(*objects):
    data = vtkMultiBlockDataSet()
    for index, leaf in enumerate(objects):
        data.SetBlock(index, leaf)
    return data


def expect(title, f, errors, warnings, *inputs):
    """Updates `f`. `errors` and `warnings` have a list of words for each message that must come, and no other may."""
    seen = {"ErrorEvent": [], "WarningEvent": []}
    for event, texts in seen.items():
        def note(caller, event, text, texts=texts):
            texts.append(text)
        note.CallDataType = "string0"
        f.AddObserver(event, note)
        f.GetExecutive().AddObserver(event, note)
    for port, data in enumerate(inputs):
        if data is not None:
            f.SetInputData(port, data)
    f.Update()
    for event, wanted in (("ErrorEvent", errors), ("WarningEvent", warnings)):
        texts = seen[event]
        right = len(texts) == len(wanted) and all(
            word in text for text, words in zip(texts, wanted) for word in words)
        if not right:
            failures.append(f"{f.GetClassName()}, {title}: {event} {texts} instead of {wanted}")


def make(filter_class, **options):
    f = filter_class()
    for name, value in options.items():
        getattr(f, "Set" + name)(value)
    return f


optimize, quality, metric, thermoelastic = FILTERS[:4]
for filter_class in FILTERS:
    expect("no input", filter_class(), [["Input port 0", "0 connections"]], [])

# The executive does not look at the type of the blocks of a composite data set.
for filter_class in (metric, thermoelastic):
    options = {"RigidMotion": 1} if filter_class is thermoelastic else {"Recovery": 1}
    expect("a surface as block", make(filter_class, **options), [], [["vtkPolyData", "left out"]], blocks(surface()))
for filter_class in FILTERS[4:]:
    expect("a grid as block", filter_class(), [], [["vtkUnstructuredGrid", "left out"]], blocks(tetrahedron()))
f = make(thermoelastic, RigidMotion=1)
expect("a surface beside a mesh", f, [], [["vtkPolyData", "left out"]], blocks(tetrahedron(), surface()))
if f.GetOutputDataObject(0).GetBlock(0).GetPointData().GetArray("Displacement") is None:
    failures.append("the mesh beside a surface is not solved on")

# Cells that these filters are not for.
for title, data in (("hexahedra", hexahedron()), ("a surface as block", blocks(surface()))):
    expect(title, optimize(), [], [["Nothing to optimize", "none of the", "triangle"]], data)
    expect(title, quality(), [], [["Nothing to measure", "none of the", "triangle"]], data)
expect("hexahedra beside a mesh", optimize(), [], [], blocks(hexahedron(), tetrahedron()))
expect("hexahedra beside a mesh", quality(), [], [], blocks(hexahedron(), tetrahedron()))
expect("no cells", optimize(), [], [], vtkUnstructuredGrid())
expect("no cells", quality(), [], [], vtkUnstructuredGrid())

# Settings without effect.
no_size = [["Beta is 0", "no effect"]]
expect("a size without Beta", make(optimize, DesiredSize=0.5), [], no_size, tetrahedron())
expect("sizes without Beta", make(optimize, SizeArray="Temperature"), [], no_size, tetrahedron())
expect("ParaView's None", make(optimize, SizeArray="None"), [], [], tetrahedron())
expect("a size to slide by", make(optimize, DesiredSize=0.5, BoundaryMode=1), [], [], triangles())
expect("a size with Beta", make(optimize, DesiredSize=1.0, Beta=1.0), [], [], tetrahedron())
expect("a geometry, fixed", optimize(), [], [["Fixed", "geometry", "port 1"]], triangles(), vtkPolyData())

# The arrays by name.
for filter_class in (optimize, quality):
    for name, kind in (("RegionArray", "cell array"), ("SizeArray", "point array"), ("MetricArray", "point array")):
        f = make(filter_class, Beta=1.0, DesiredSize=1.0, **{name: "nothing"})
        expect(name, f, [["'nothing'", kind]], [], tetrahedron())
        getattr(f, "Set" + name)(None)
        expect(name + " taken back", f, [], [])

for failure in failures:
    print("FAILED:", failure)
sys.exit(1 if failures else 0)
