"""The borders between ranks take part: worst quality as on one rank, surface and conformity kept. pvbatch --symmetric."""
import os
import sys

import numpy as np
from meshoptimize import vtkMeshOptimizeFilter
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid
from vtkmodules.vtkFiltersCore import vtkExtractCells
from vtkmodules.vtkCommonCore import vtkIdList
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
from vtkmodules.vtkParallelCore import vtkMultiProcessController

controller = vtkMultiProcessController.GetGlobalController()
rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
reader = vtkXMLUnstructuredGridReader()
reader.SetFileName(sys.argv[1] if len(sys.argv) > 1 else os.environ["MESHOPTIMIZE_DATA"] + "/crack40.vtu")
reader.Update()
whole = reader.GetOutput()


def corners(grid):
    """Coordinates of the corners of each tetrahedron."""
    x = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    return x[vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)]


def piece():
    angle = np.arctan2(*corners(whole).mean(axis=1)[:, 1::-1].T)
    owner = ((angle + np.pi) / (2 * np.pi) * ranks).astype(int) % ranks
    ids = vtkIdList()
    for c in np.flatnonzero(owner == rank):
        ids.InsertNextId(int(c))
    extract = vtkExtractCells()
    extract.SetInputData(whole)
    extract.SetCellList(ids)
    extract.Update()
    grid = vtkUnstructuredGrid()
    grid.ShallowCopy(extract.GetOutput())
    for data in (grid.GetPointData(), grid.GetCellData()):
        data.Initialize()
    return grid


def run(grid, everywhere):
    f = vtkMeshOptimizeFilter()
    f.SetController(controller)
    f.SetOptimizeBorders(everywhere)
    f.SetNumberOfThreads(1)
    f.SetInputData(grid)
    f.Update()
    return f


def surface(tets):
    """Facets of one cell, by the bits of their corners; the most cells that a facet has; the volume."""
    f = tets[:, [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]]].reshape(-1, 3, 3)
    p, number = np.unique(f.reshape(-1, 3), axis=0, return_inverse=True)
    number = np.sort(number.reshape(-1, 3), axis=1)
    facets, count = np.unique(number, axis=0, return_counts=True)
    e = tets[:, 1:] - tets[:, :1]
    return sorted(map(tuple, p[facets[count == 1]].reshape(-1, 9))), count.max(), np.linalg.det(e).sum() / 6


together = run(piece(), True)
again = run(piece(), True)
apart = run(piece(), False)
mine = corners(together.GetOutput())
failures = []
if not np.array_equal(mine, corners(again.GetOutput())):
    failures.append("two runs differ")
folder = os.environ["MESHOPTIMIZE_OUTPUT"]
np.save(f"{folder}/ranks{ranks}.{rank}.npy", mine)
controller.Barrier()
if rank == 0:
    serial = run(whole, False)
    tets = np.concatenate([np.load(f"{folder}/ranks{ranks}.{r}.npy") for r in range(ranks)])
    print(f"{ranks} ranks: borders kept {apart.GetWorstQualityAfter():.4f} (rank 0), together "
          f"{together.GetWorstQualityAfter():.4f}, one rank {serial.GetWorstQualityAfter():.4f}; "
          f"{together.GetStopReasonAsString()}")
    before, after = surface(corners(whole)), surface(tets)
    if after[1] > 2 or before[0] != after[0]:
        failures.append(f"surface: {len(before[0])} facets, then {len(after[0])}; a facet has {after[1]} cells")
    if abs(after[2] / before[2] - 1) > 1e-12:
        failures.append(f"volume {before[2]} -> {after[2]}")
    if together.GetWorstQualityAfter() < 0.98 * serial.GetWorstQualityAfter():
        failures.append("worst quality")
for failure in failures:
    print(f"FAILED on rank {rank}:", failure)
controller.Barrier()
if failures:
    sys.exit(1)
