# SPDX-License-Identifier: BSD-3-Clause
"""vtkMeshQualityMinMax on several ranks gives on each of them the figures of the whole mesh. Run by pvbatch under mpirun."""
import sys

import numpy as np
from meshoptimize import vtkMeshQualityMinMax
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkDataObject, vtkUnstructuredGrid
from vtkmodules.vtkParallelCore import vtkMultiProcessController

controller = vtkMultiProcessController.GetGlobalController()
rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
N = 6000
x = np.random.default_rng(3).random((4 * N, 3))
region = np.arange(N, dtype=np.int32) // 1000  # most regions are on one rank only


def make_grid(cells):
    grid = vtkUnstructuredGrid()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(x[np.concatenate([4 * cells[:, None] + np.arange(4)])].reshape(-1, 3), deep=1))
    grid.SetPoints(points)
    grid.Allocate(len(cells))
    for k in range(len(cells)):
        grid.InsertNextCell(VTK_TETRA, 4, [4 * k, 4 * k + 1, 4 * k + 2, 4 * k + 3])
    array = numpy_to_vtk(region[cells], deep=1)
    array.SetName("region")
    grid.GetCellData().AddArray(array)
    return grid


def run(cells, everywhere):
    f = vtkMeshQualityMinMax()
    f.SetController(controller if everywhere else None)
    f.SetInputData(make_grid(cells))
    f.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_CELLS, "region")
    f.Update()
    return f


failures = []
mine = np.arange(N)[np.arange(N) * ranks // N == rank]
if ranks > 2 and rank == 1:
    mine = mine[:0]  # a rank without cells
counted = np.arange(N) if ranks <= 2 else np.arange(N)[np.arange(N) * ranks // N != 1]
whole, part = run(counted, False), run(mine, True)
for getter in ("MinimumQuality", "MaximumQuality", "NumberOfMeasuredCells", "NumberOfInvertedCells", "QualityBound", "NumberOfCappedCells"):
    a, b = getattr(whole, "Get" + getter)(), getattr(part, "Get" + getter)()
    if a != b:
        failures.append(f"{getter}: {b} on {ranks} ranks, {a} on one")
for getter in ("MeanQuality", "StandardDeviation"):
    a, b = getattr(whole, "Get" + getter)(), getattr(part, "Get" + getter)()
    if abs(a - b) > 1e-14:
        failures.append(f"{getter}: {b} on {ranks} ranks, {a} on one")
q = vtk_to_numpy(whole.GetOutput().GetCellData().GetArray("MeshQuality"))
owner = int(np.argmin(q)) if ranks <= 2 else int(counted[np.argmin(q)])
if part.GetWorstCellRank() != owner * ranks // N:
    failures.append(f"worst cell on rank {part.GetWorstCellRank()}, not {owner * ranks // N}")

table, histogram, worst = (part.GetOutputDataObject(p) for p in (1, 2, 3))
if table.GetNumberOfRows() != (whole.GetOutputDataObject(1).GetNumberOfRows() if rank == 0 else 0):
    failures.append(f"{table.GetNumberOfRows()} rows of summary on rank {rank}")
if rank == 0:
    for name in ("Count", "Minimum", "Maximum", "Bound", "CappedCells"):
        a = vtk_to_numpy(whole.GetOutputDataObject(1).GetColumnByName(name))
        b = vtk_to_numpy(table.GetColumnByName(name))
        if not np.array_equal(a, b):
            failures.append(f"column {name}: {b}, not {a}")
    a = vtk_to_numpy(whole.GetOutputDataObject(2).GetColumnByName("Count"))
    b = vtk_to_numpy(histogram.GetColumnByName("Count"))
    if not np.array_equal(a, b):
        failures.append("histogram")
threshold = np.sort(q)[9]
here = vtk_to_numpy(part.GetOutput().GetCellData().GetArray("MeshQuality")) if len(mine) else np.array([])
if worst.GetNumberOfCells() != (here <= threshold).sum():
    failures.append(f"{worst.GetNumberOfCells()} worst cells on rank {rank}, not {(here <= threshold).sum()}")

# One rank has an unusable value: all stop with an error, none waits for the others.
grid = make_grid(mine)
sizes = np.ones(4 * len(mine))
if rank == ranks - 1:
    sizes[5] = -1.0
sizes = numpy_to_vtk(sizes, deep=1)
sizes.SetName("size")
grid.GetPointData().AddArray(sizes)
messages = []
bad = vtkMeshQualityMinMax()
bad.AddObserver("ErrorEvent", lambda *_: messages.append(1))
bad.SetInputData(grid)
bad.SetBeta(1.0)
bad.SetInputArrayToProcess(2, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "size")
bad.Update()
if len(messages) != 1 or bad.GetErrorCode() == 0:
    failures.append(f"{len(messages)} errors, error code {bad.GetErrorCode()}")

for failure in failures:
    print(f"FAILED on rank {rank}:", failure)
controller.Barrier()
if failures:  # without failures MPI is to be finalized as usual
    sys.exit(1)
