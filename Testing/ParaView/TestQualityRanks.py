# SPDX-License-Identifier: BSD-3-Clause
"""vtkMeshQualityMinMax on several ranks gives on each of them the figures of the whole mesh. By pvbatch --symmetric."""
import os
import sys

import numpy as np
from meshoptimize import vtkMeshQualityMinMax
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_STRING
from vtkmodules.vtkCommonDataModel import vtkDataObject

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # pvbatch does not
from ranks_case import Mesh, add, check, controller, gather, make_grid, rank, ranks, run_tests


def measure(grid, everywhere, regions):
    f = vtkMeshQualityMinMax()
    f.SetController(controller if everywhere else None)
    f.SetInputData(grid)
    if regions:
        f.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_CELLS, "region")
    f.UpdatePiece(rank, ranks, 0) if everywhere else f.Update()
    return f


def compare(name, whole, part):
    """All figures, on all ranks; the tables on the first; the worst cells on those that have them."""
    for getter in ("MinimumQuality", "MaximumQuality", "NumberOfMeasuredCells", "NumberOfInvertedCells", "NumberOfOtherCells",
                   "NumberOfNotMeasurableCells", "QualityBound", "NumberOfCappedCells", "MeanQuality", "StandardDeviation"):
        a, b = getattr(whole, "Get" + getter)(), getattr(part, "Get" + getter)()
        check(abs(a - b) < (1e-6 if getter == "QualityBound" else 1e-12), f"{name}: {getter} {b}, alone {a}")
    tables = [[f.GetOutputDataObject(port) for f in (whole, part)] for port in (1, 2)]
    for (mine, its), columns in zip(tables, (("Count", "Minimum", "Maximum", "Mean", "Bound", "CappedCells"), ("Count",))):
        check(its.GetNumberOfRows() == (mine.GetNumberOfRows() if rank == 0 else 0), f"{name}: {its.GetNumberOfRows()} rows")
        for column in columns if rank == 0 else ():
            a, b = (vtk_to_numpy(t.GetColumnByName(column)) for t in (mine, its))
            check(len(a) == len(b) and np.nanmax(np.abs(a - b)) < 1e-6, f"{name}: column {column} {b}, alone {a}")
    worst = [f.GetOutputDataObject(3).GetCellData().GetArray("MeshQuality") for f in (whole, part)]
    every = np.concatenate(gather(worst=vtk_to_numpy(worst[1]) if worst[1].GetNumberOfTuples() else np.zeros(0))["worst"])
    check(np.allclose(np.sort(every), np.sort(vtk_to_numpy(worst[0])), 0, 1e-12), f"{name}: worst cells {np.sort(every)}")
    owners = gather(owner=np.array([part.GetWorstCellRank()]))["owner"]
    here = part.GetOutputDataObject(3).GetNumberOfCells()
    check(rank != owners[0][0] or (here > 0 and worst[1].GetValue(0) == part.GetMinimumQuality()), f"{name}: worst cell's rank")


def test_loose():
    """Cells that touch nothing, at random; most regions are on one rank only, and with three ranks one has no cells."""
    n = 6000
    x = np.random.default_rng(3).random((4 * n, 3))
    cells = np.arange(4 * n).reshape(-1, 4)

    def grid(chosen):
        grid = make_grid(x[cells[chosen]].reshape(-1, 3), np.arange(4 * len(chosen)).reshape(-1, 4))
        add(grid.GetCellData(), "region", (chosen // 1000).astype(np.int32))
        return grid
    owner = np.arange(n) * ranks // n
    counted = np.flatnonzero((owner != 1) | (ranks < 3))
    compare("loose", measure(grid(counted), False, True), measure(grid(counted[owner[counted] == rank]), True, True))


def test_surface():
    """What is at a border is no surface: bound, caps, summary and worst cells are those of the whole, by ids and without."""
    mesh = Mesh(n=5, jitter=0.2)
    low = mesh.node[:, 2] == 0
    mesh.x[low & (mesh.node[:, 0] == 2) & (mesh.node[:, 1] == 2)] += [0.18, 0.0, 0.0]  # slender facets at the border
    mesh.values["region"] = (mesh.centers()[:, 1] > 0.55).astype(np.int32)
    for axis in (0, 1):  # along the regions' interface, too
        for ids in (False, 2 ** 60):
            for regions in (False, True):
                mesh.ids = ids
                compare(f"surface {axis} {ids} {regions}", measure(mesh.whole(), False, regions),
                        measure(mesh.piece(axis), True, regions))


def test_interface_on_border():
    """A facet between two regions is kept, also where it lies between two ranks."""
    mesh = Mesh(n=4, jitter=0.2, keep=lambda x: np.abs(x[:, 0] - 0.5) < 0.01)
    middle = mesh.node[:, 0] == 2
    mesh.x[middle & (mesh.node[:, 1] == 2) & (mesh.node[:, 2] == 2)] += [0.0, 0.23, 0.0]
    mesh.values["region"] = (mesh.centers()[:, 0] > 0.5).astype(np.int32)
    whole = measure(mesh.whole(), False, True)
    check(whole.GetQualityBound() < measure(mesh.whole(), False, False).GetQualityBound() - 0.01, "interface: too easy")
    compare("interface", whole, measure(mesh.piece(0, 2), True, True))


def test_triangles():
    """One plane and one upper side for all: also if a piece alone would have another, and in space."""
    i = np.arange(64)
    node = np.stack([i // 8, i % 8], 1)
    base = i[(node < 7).all(axis=1)]
    cells = np.concatenate([np.stack([base, base + 8, base + 9], 1), np.stack([base, base + 9, base + 1], 1)])
    x = np.zeros((64, 3))
    x[:, :2] = node + np.random.default_rng(2).uniform(-0.3, 0.3, (64, 2)) * ((node > 0) & (node < 7))
    x[7, :2] -= 0.4  # a corner that bounds the quality
    first = x[cells, 0].mean(axis=1) < 3
    cells[first] = cells[first][:, [0, 2, 1]]  # the smaller part lies on its back
    tilted = x @ np.array([[0.6, 0.0, 0.8], [0.0, 1.0, 0.0], [-0.8, 0.0, 0.6]])
    bent = x + np.where(x[:, :1] > 4, (x[:, :1] - 4) * [[0.0, 0.0, 1.0]], 0.0)
    for name, at in (("plane", x), ("tilted", tilted), ("bent", bent)):
        mine = np.minimum((x[cells, 0].mean(axis=1) * ranks / 7).astype(int), ranks - 1) == rank
        used = np.unique(cells[mine])
        whole = measure(make_grid(at, cells), False, False)
        check((whole.GetNumberOfInvertedCells() > 0) == (name != "bent"), f"{name}: too easy")
        compare(name, whole, measure(make_grid(at[used], np.searchsorted(used, cells[mine])), True, False))


def test_crack():
    """A crack of doubled nodes is surface; along a border it is one if there are ids, and else the bound is still one."""
    mesh = Mesh(n=6, jitter=0.2, keep=lambda x: np.abs(x[:, 0] - 0.5) < 0.01)
    lips = (mesh.node[:, 0] == 3) & (mesh.node[:, 1] < 5)
    mesh.x[lips & (mesh.node[:, 1] == 3) & (mesh.node[:, 2] == 3)] += [0.0, 0.15, 0.0]
    twin = np.arange(len(mesh.x))
    twin[lips] = len(mesh.x) + np.arange(lips.sum())
    above = mesh.centers()[:, 0] > 0.5
    mesh.cells[above] = twin[mesh.cells[above]]
    mesh.x, mesh.node = (np.concatenate([a, a[lips]]) for a in (mesh.x, mesh.node))
    for axis, count, ids in ((1, None, False), (1, None, 7), (0, 2, 7)):
        mesh.ids = ids
        compare(f"crack {axis} {ids}", measure(mesh.whole(), False, False), measure(mesh.piece(axis, count), True, False))
    mesh.ids = False
    whole, part = measure(mesh.whole(), False, False), measure(mesh.piece(0, 2), True, False)
    check(part.GetQualityBound() >= whole.GetQualityBound(), "crack without ids: no bound")


def test_error():
    """An unusable value on one rank: all stop, none waits for the others; told once, with the rank."""
    grid = Mesh(n=3).piece()
    sizes = np.ones(grid.GetNumberOfPoints())
    if rank == ranks - 1:
        sizes[5] = -1.0
    add(grid.GetPointData(), "size", sizes)
    messages = []
    bad = vtkMeshQualityMinMax()

    def tell(caller, event, text):
        messages.append(text)
    tell.CallDataType = VTK_STRING
    bad.AddObserver("ErrorEvent", tell)
    bad.SetInputData(grid)
    bad.SetBeta(1.0)
    bad.SetInputArrayToProcess(2, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "size")
    bad.Update()
    check(bad.GetErrorCode() != 0 and len(messages) == (rank == 0), f"error: {messages}, code {bad.GetErrorCode()}")
    check(all(f"Rank {ranks - 1}: " in text for text in messages), f"error: {messages}")


run_tests(globals())
