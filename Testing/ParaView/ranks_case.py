# SPDX-License-Identifier: BSD-3-Clause
"""What the tests on ranks share: a mesh in pieces, the filter on them, what all ranks have, and checks. By pvbatch --symmetric."""
import os
import sys
import traceback

import numpy as np
from meshoptimize import vtkMeshOptimizeFilter
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_STRING, vtkCommand, vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, VTK_TRIANGLE, vtkCellArray, vtkUnstructuredGrid
from vtkmodules.vtkParallelCore import vtkMultiProcessController

controller = vtkMultiProcessController.GetGlobalController()
rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
folder = os.environ["MESHOPTIMIZE_OUTPUT"]
failures = []
FACETS = [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]]


def check(fine, text):
    if not fine:
        failures.append(text)


class Mesh:
    """A unit cube of n^3 * 6 tetrahedra whose inner nodes are moved at random, so that some are flat or worse."""

    def __init__(self, n=7, jitter=0.33, keep=lambda x: np.zeros(len(x), bool)):
        i = np.arange((n + 1) ** 3)
        node = np.stack([i // (n + 1) ** 2, i // (n + 1) % (n + 1), i % (n + 1)], 1)
        self.x = node / n
        inner = ((node > 0) & (node < n)).all(axis=1) & ~keep(self.x)
        self.x[inner] += np.random.default_rng(5).uniform(-jitter, jitter, (inner.sum(), 3)) / n
        steps = [np.cumsum([np.zeros(3, int)] + [np.eye(3, dtype=int)[a] for a in order], axis=0)
                 for order in ((0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (2, 1, 0), (1, 0, 2))]
        base = node[(node < n).all(axis=1)]
        corners = base[:, None, None] + np.array(steps)[None]
        self.cells = (corners @ [(n + 1) ** 2, n + 1, 1]).reshape(-1, 4)
        self.node, self.n = node, n
        self.turn()
        self.points, self.values, self.ids = {}, {}, False

    def turn(self):
        """Nodes in the positive order, as the regular grid has them."""
        p = self.node[self.cells].astype(float)
        wrong = np.linalg.det(p[:, 1:] - p[:, :1]) < 0
        self.cells[wrong] = self.cells[wrong][:, [1, 0, 2, 3]]

    def centers(self):
        return self.node[self.cells].mean(axis=1) / self.n

    def grid(self, chosen):
        chosen = np.flatnonzero(chosen)
        used = np.unique(self.cells[chosen])
        local = np.zeros(len(self.x), int)
        local[used] = np.arange(len(used))
        grid = make_grid(self.x[used], local[self.cells[chosen]])
        for data, arrays, ids in ((grid.GetPointData(), self.points, used), (grid.GetCellData(), self.values, chosen)):
            for name, values in arrays.items():
                add(data, name, values[ids])
            if self.ids and len(chosen):
                array = numpy_to_vtkIdTypeArray((ids + self.ids).astype(np.int64), deep=1)
                array.SetName("own ids")
                data.SetGlobalIds(array)
        return grid

    def piece(self, axis=0, count=None):
        count = count or ranks
        return self.grid((self.centers()[:, axis] * count).astype(int) == rank)

    def whole(self):
        return self.grid(np.ones(len(self.cells), bool))


def add(data, name, values):
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=1)
    array.SetName(name)
    data.AddArray(array)


def make_grid(x, cells):
    grid = vtkUnstructuredGrid()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(x, float).reshape(-1, 3), deep=1))
    grid.SetPoints(points)
    array = vtkCellArray()
    corners = cells.shape[1]
    array.SetData(numpy_to_vtkIdTypeArray(np.arange(len(cells) + 1, dtype=np.int64) * corners, deep=1),
                  numpy_to_vtkIdTypeArray(np.ascontiguousarray(cells, np.int64).ravel(), deep=1))
    grid.SetCells(VTK_TETRA if corners == 4 else VTK_TRIANGLE, array)
    return grid


def tell(f):
    """A list that will have the warnings and errors of the filter."""
    told = []

    def note(caller, event, text):
        told.append(text)
    note.CallDataType = VTK_STRING
    f.AddObserver(vtkCommand.ErrorEvent, note)
    f.AddObserver(vtkCommand.WarningEvent, note)
    return told


def alone(mesh, before=lambda f: None):
    """The filter on the whole mesh on the first rank; None on the others."""
    return run(mesh.whole(), False, before) if rank == 0 else None


def run(grid, everywhere=True, before=lambda f: None, asked=0, **options):
    """The filter, updated on this rank's piece with ghost layers, or alone. f.told has its warnings and errors."""
    f = vtkMeshOptimizeFilter()
    f.SetOptimizeBorders(everywhere)
    f.SetNumberOfThreads(1)
    for name, value in options.items():
        getattr(f, "Set" + name)(value)
    f.SetInputData(grid)
    f.told = tell(f)
    before(f)
    f.UpdatePiece(rank, ranks, asked) if everywhere else f.Update()
    return f


def corners(grid):
    if grid.GetNumberOfCells() == 0:
        return np.zeros((0, 4, 3))
    x = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    return x[vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)]


def gather(**arrays):
    """The arrays of all ranks, a list for each name, on all ranks."""
    script = os.path.basename(sys.argv[0])  # tests run side by side
    for name, values in arrays.items():
        np.save(f"{folder}/{script}.{ranks}.{name}.{rank}.npy", values)
    controller.Barrier()
    all_of = {name: [np.load(f"{folder}/{script}.{ranks}.{name}.{r}.npy") for r in range(ranks)] for name in arrays}
    controller.Barrier()
    return all_of


def facets(tets, of=None):
    """Facets by the bits of their corners, with the number of cells; `of`: only between cells of two kinds."""
    f = np.sort(np.ascontiguousarray(tets[:, FACETS].reshape(-1, 3, 3) + 0.0).view("f8,f8,f8").reshape(-1, 3), axis=1)
    f, inverse, count = np.unique(f.view(f"V{72}").ravel(), return_inverse=True, return_counts=True)
    if of is None:
        return f, count
    kinds = [np.zeros(len(f), bool), np.zeros(len(f), bool)]
    for kind in (0, 1):
        kinds[kind][inverse[np.repeat(of == kind, 4)]] = True
    return f[kinds[0] & kinds[1]], None


def volume(tets):
    return np.linalg.det(tets[:, 1:] - tets[:, :1]).sum() / 6


def figures_of(f):
    return [getattr(f, "Get" + n)() for n in ("WorstQualityBefore", "WorstQualityAfter", "MeanQualityBefore",
            "MeanQualityAfter", "QualityBound", "NumberOfCappedCells", "StopReason", "NumberOfOperations",
            "NumberOfEvaluations")]


def compare(name, f, before, serial=None, works=True):
    """Surface bit for bit, no facet of three cells, volume, figures; worst like serial's. `works`: something was tried. Returns all cells."""
    tets = np.concatenate(gather(tets=corners(f.GetOutput()))["tets"])
    check(f.told == [], f"{name}: {f.told}")
    if rank > 0:
        gather(figures=figures_of(f))
        return tets
    (old, count), (new, now) = facets(before), facets(tets)
    check(now.max() <= count.max(), f"{name}: a facet has {now.max()} cells")
    check(np.array_equal(old[count == 1], new[now == 1]), f"{name}: another surface")
    check(abs(volume(tets) / volume(before) - 1) < 1e-12, f"{name}: another volume")
    check(len({tuple(row) for row in gather(figures=figures_of(f))["figures"]}) == 1, f"{name}: figures differ by rank")
    isLate = f.GetStopReason() == vtkMeshOptimizeFilter.TimeLimitReached
    check(isLate or not works or f.GetNumberOfEvaluations() > f.GetNumberOfOperations(), f"{name}: {f.GetNumberOfEvaluations()} evaluations")
    if serial:
        check(f.GetWorstQualityAfter() >= 0.98 * serial.GetWorstQualityAfter(),
              f"{name}: worst {f.GetWorstQualityAfter()}, alone {serial.GetWorstQualityAfter()}")
        for n, most in (("WorstQualityBefore", 1e-12), ("MeanQualityBefore", 1e-12), ("QualityBound", 1e-6)):
            a, b = getattr(f, "Get" + n)(), getattr(serial, "Get" + n)()
            check(abs(a - b) < most, f"{name}: {n} {a}, alone {b}")
    return tets


def history(f):
    table = f.GetOutputDataObject(1)
    return {table.GetColumnName(i): [table.GetValue(r, i).ToString() for r in range(table.GetNumberOfRows())]
            for i in range(table.GetNumberOfColumns())}


def fail(*what):
    """The others must not wait for a rank whose script has failed."""
    traceback.print_exception(*what)
    sys.stderr.flush()
    os._exit(1)


def run_tests(tests):
    """All functions test_...() among them, or those that the command names."""
    sys.excepthook = fail
    for name, test in list(tests.items()):
        if name.startswith("test_") and (not sys.argv[1:] or name in sys.argv[1:]):
            test()
            for failure in failures[:5]:
                print(f"FAILED on rank {rank}, {name}:", failure, flush=True)
            if sum(len(rows) for rows in gather(failed=np.zeros(len(failures)))["failed"]):
                sys.exit(1)
    if rank == 0:
        print(f"{ranks} ranks: all fine")
