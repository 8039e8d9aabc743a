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
    expect("a surface as block", make(filter_class, **options), [], [["vtkPolyData", "skipped"]], blocks(surface()))
for filter_class in FILTERS[4:]:
    expect("a grid as block", filter_class(), [], [["vtkUnstructuredGrid", "skipped"]], blocks(tetrahedron()))
f = make(thermoelastic, RigidMotion=1)
expect("a surface beside a mesh", f, [], [["vtkPolyData", "skipped"]], blocks(tetrahedron(), surface()))
if f.GetOutputDataObject(0).GetBlock(0).GetPointData().GetArray("Displacement") is None:
    failures.append("the mesh beside a surface is not solved on")

# Cells that these filters are not for.
for title, data in (("hexahedra", hexahedron()), ("a surface as block", blocks(surface()))):
    expect(title, optimize(), [], [["Nothing to optimize", "none of the", "triangle"]], data)
    expect(title, quality(), [], [["Nothing to measure", "none of the", "triangle"]], data)
f = optimize()
expect("hexahedra", f, [], [["Nothing to optimize"]], hexahedron())
if f.GetStopReasonAsString() != "nothing to do: no triangles or tetrahedra":
    failures.append(f"hexahedra: {f.GetStopReasonAsString()}")
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

# Sizes that cannot be had: what comes out, and why.
def disc(n):
    grid, points = vtkUnstructuredGrid(), vtkPoints()
    points.SetDataTypeToDouble()
    for k in range(n):
        points.InsertNextPoint(np.cos(2 * np.pi * k / n), np.sin(2 * np.pi * k / n), 0)
    points.InsertNextPoint(0, 0, 0)
    grid.SetPoints(points)
    for k in range(n):
        grid.InsertNextCell(VTK_TRIANGLE, 3, [k, (k + 1) % n, n])
    return grid


def square(n, **arrays):
    """n x n x 2 triangles; arrays as functions of x and y."""
    grid, points = vtkUnstructuredGrid(), vtkPoints()
    y, x = (a.ravel() for a in np.mgrid[0:n + 1, 0:n + 1] / n)
    points.SetData(numpy_to_vtk(np.column_stack([x, y, 0 * x]), deep=1))
    grid.SetPoints(points)
    for p in (i + j * (n + 1) for j in range(n) for i in range(n)):
        grid.InsertNextCell(VTK_TRIANGLE, 3, [p, p + 1, p + n + 2])
        grid.InsertNextCell(VTK_TRIANGLE, 3, [p, p + n + 2, p + n + 1])
    for name, function in arrays.items():
        array = numpy_to_vtk(np.ascontiguousarray(function(x, y)), deep=1)
        array.SetName(name)
        grid.GetPointData().AddArray(array)
    return grid


def turning(x, y):
    a = 8 * np.pi * y
    return np.column_stack([1 + 9999 * np.cos(a) ** 2, 1 + 9999 * np.sin(a) ** 2, 0 * a + 1,
                            9999 * np.cos(a) * np.sin(a), 0 * a, 0 * a])


f = make(optimize, DesiredSize=0.03, Beta=1.0)
expect("a fixed boundary that is coarse", f, [], [["up to 13 times as long as wanted", "Slide"]], disc(16))
if f.GetOutput().GetNumberOfCells() < 1000:
    failures.append(f"a fixed boundary that is coarse: {f.GetOutput().GetNumberOfCells()} cells")
f = make(optimize, DesiredSize=0.015, BoundaryMode=1, MetricArray="m")  # two corners are sharp in this metric
expect("sizes given up", f, [], [["given up", "lower than before", "target"]],
       square(8, m=lambda x, y: np.tile([5.05, 5.05, 1, -4.95, 0, 0], (len(x), 1))))
f = make(optimize, DesiredSize=0.3, Beta=1.0, MetricArray="turning", BoundaryMode=1, Effort=0, TargetQuality=0.1)
# det M = 1e4 all over the unit square, so that its area is 100 in the metric; regular triangles of size 0.3 fill it
predicted = round(100 / (3 ** 0.5 / 4 * 0.3 ** 2))
expect("a metric that turns", f, [], [["Splitting of edges was stopped", str(predicted), "faster"]], square(32, turning=turning))
for count, angle, boundary, warnings in ((8, 50.0, 1, ["area", "10.8 %", "greater", "Corner Angle"]), (8, 50.0, 0, None),
                                         (16, 50.0, 1, None)):
    for data, prefix in ((disc(count), ""), (blocks(disc(count)), "Block 1: ")):
        f = make(optimize, DesiredSize=0.1, BoundaryMode=1, CornerAngle=angle, BoundaryCurve=boundary)
        expect("another area", f, [], [[prefix + "The area", *warnings]] if warnings else [], data)
expect("a size that is none", make(optimize, SizeArray="h", Beta=1.0), [["'h'", "point 4", "-1"]], [],
       square(2, h=lambda x, y: np.where((x == 0.5) & (y == 0.5), -1.0, 0.1)))
expect("a metric that is none", make(optimize, SizeArray="h", MetricArray="m", Beta=1.0),
       [["'m'", "point 0", "positive definite"]], [],
       square(2, h=lambda x, y: 0.1 + 0 * x, m=lambda x, y: 0 * turning(x, y)))


# Lengths whose squares and cubes double precision does not hold.
def scaled(grid, factor):
    points = vtkPoints()
    points.SetDataTypeToDouble()
    for p in range(grid.GetNumberOfPoints()):
        points.InsertNextPoint(*(factor * x for x in grid.GetPoint(p)))
    grid.SetPoints(points)
    return grid


for make_grid in (tetrahedron, triangles):
    for filter_class in (optimize, quality):
        for factor, word in ((1e160, "large"), (1e-160, "small")):
            expect(f"times {factor}", filter_class(), [["too " + word, "Scale"]], [], scaled(make_grid(), factor))
        expect("times 1e49", filter_class(), [], [], scaled(make_grid(), 1e49))
        expect("times 1e-49", filter_class(), [], [], scaled(make_grid(), 1e-49))

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
