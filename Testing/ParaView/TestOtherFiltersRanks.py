# SPDX-License-Identifier: BSD-3-Clause
"""Solution Metric and Thermoelastic on pieces: the metric is that of one rank; a body in pieces is an error on all ranks, and nothing hangs."""
import os
import sys

import numpy as np
from meshoptimize import vtkSolutionMetricFilter, vtkThermoelasticFilter
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkStringArray
from vtkmodules.vtkCommonDataModel import VTK_LINE, vtkMultiBlockDataSet, vtkUnstructuredGrid

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # pvbatch does not
from ranks_case import Mesh, add, check, controller, gather, make_grid, rank, ranks, run_tests, tell

RESULTS = ("DesiredSize", "PredictedNumberOfElements", "TotalError")


def solution(x):
    return np.sin(5 * x[:, 0]) * x[:, 1] + x[:, 2] ** 3 + x[:, 0] ** 2


def mesh_with_solution(n=6, ids=True):
    mesh = Mesh(n, jitter=0.2)
    mesh.ids = 100 if ids else False
    mesh.points["u"] = solution(mesh.x)
    mesh.points["v"] = np.stack([solution(mesh.x), mesh.x[:, 1] ** 2, mesh.x[:, 2]], axis=1)
    mesh.points["place"] = np.arange(len(mesh.x))
    mesh.values["e"] = np.random.default_rng(1).random(len(mesh.cells))
    return mesh


def filter_of(cls, data, options, **arrays):
    f = cls()
    f.SetInputDataObject(data)
    for name, value in options.items():
        getattr(f, "Set" + name)(value)
    for name, array in arrays.items():
        getattr(f, f"Set{name}Array")(array)
    f.told = tell(f)
    return f


def metric_on(data, everywhere=True, array="u", **options):
    f = filter_of(vtkSolutionMetricFilter, data, options, Solution=array, ErrorIndicator="e")
    f.UpdatePiece(rank, ranks, 0) if everywhere else f.Update()
    return f


def compare(name, grid, f, expected, serial, tolerance):
    """At each point what one rank has; figures, too."""
    check(f.GetErrorCode() == 0 and f.told == [], f"{name}: {f.told}")
    data, compared = grid.GetPointData(), 0
    for array in ("Metric", "DesiredSize", "SizeTensor"):
        theirs = expected.GetPointData().GetArray(array)
        mine = data.GetArray(array)
        check(grid.GetNumberOfCells() == 0 or (mine is None) == (theirs is None), f"{name}: {array} is missing")
        if mine is None:
            continue
        a, b = vtk_to_numpy(mine), vtk_to_numpy(theirs)[vtk_to_numpy(data.GetArray("place"))]
        check(abs(a - b).max() <= tolerance * abs(b).max(), f"{name}: {array} differs by {abs(a - b).max() / abs(b).max()}")
        names = [[c.GetComponentName(i) for i in range(c.GetNumberOfComponents())] for c in (mine, theirs)]
        check(names[0] == names[1], f"{name}: {names}")
        compared += len(a)
    for figure in RESULTS:
        a, b = getattr(f, "Get" + figure)(), getattr(serial, "Get" + figure)()
        check(abs(a - b) <= tolerance * abs(b), f"{name}: {figure} {a}, alone {b}")
    return compared


def test_metric():
    """Values and figures of one rank; without ids only if nothing runs over the points in their order, as the gradation does."""
    for ids in (True, False):
        mesh = mesh_with_solution(ids=ids)
        for options in ({}, {"Recovery": 1}, {"array": "v"}, {"NormOrder": 2.0, "ComputeSizeTensor": True},
                        {"DesiredNumberOfElements": 5000, "MinimumSize": 0.02}, {"Criterion": 1},
                        {"Criterion": 1, "DesiredErrorFraction": 0.3}):
            options = options if ids else {"Gradation": 0.0, **options}
            serial = metric_on(mesh.whole(), False, **options)
            f = metric_on(mesh.piece(axis=1), **options)
            compared = compare(f"metric, ids {ids}, {options}", f.GetOutput(), f, serial.GetOutput(), serial, 1e-12 if ids else 1e-10)
            check(compared >= 100, f"metric, ids {ids}, {options}: {compared} values compared")
            if options == {} and ids:
                # The test can fail: by itself a piece has other values.
                own = metric_on(mesh.piece(axis=1), False)
                a, b = (vtk_to_numpy(g.GetOutput().GetPointData().GetArray("Metric")) for g in (own, f))
                check(abs(a - b).max() > 0.01 * abs(b).max(), "metric: pieces alone are as good, the test is too easy")


def test_plane():
    """Triangles in a plane that is tilted; float coordinates are as exact as on one rank."""
    n = 12
    i, k = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
    a = (i * (n + 1) + k).ravel()
    cells = np.concatenate([np.stack([a, a + n + 1, a + 1], 1), np.stack([a + n + 2, a + 1, a + n + 1], 1)])
    y, z = np.divmod(np.arange((n + 1) ** 2), n + 1)
    x = (np.stack([y + 0.3 * z, z, 0.5 * y], axis=1) / n).astype(np.float32)

    def grid(chosen):
        used = np.unique(cells[chosen])
        g = make_grid(x[used], np.searchsorted(used, cells[chosen]))
        g.GetPoints().SetData(numpy_to_vtk(x[used], deep=1))
        add(g.GetPointData(), "u", solution(x[used].astype(float)))
        add(g.GetPointData(), "place", used)
        return g
    owner = (cells.min(axis=1) * ranks) // cells.min(axis=1).max().clip(1)
    owner = owner.clip(0, ranks - 1)
    serial = metric_on(grid(owner >= 0), False, Gradation=0.0)
    f = metric_on(grid(owner == rank), Gradation=0.0)
    check(compare("plane", f.GetOutput(), f, serial.GetOutput(), serial, 1e-10) > 60, "plane: few values")


def test_loose_points():
    """A rank that has points and no cells, with the array or without, or a triangle where others have tetrahedra."""
    mesh = mesh_with_solution()
    serial = metric_on(mesh.whole(), False)
    for kind in ("with the array", "without", "with a triangle"):
        grid = mesh.whole()
        if rank > 0:
            cells = [[0, 1, 2]] if kind == "with a triangle" else np.zeros((0, 4), int)
            grid = make_grid(mesh.x[:9], np.array(cells))
            if kind != "without":
                add(grid.GetPointData(), "u", mesh.points["u"][:9])
        f = metric_on(grid)
        check(f.GetErrorCode() == 0 and f.told == [], f"loose points, {kind}: {f.told}")
        for figure in RESULTS:
            a, b = getattr(f, "Get" + figure)(), getattr(serial, "Get" + figure)()
            check(a == b or abs(a - b) <= 1e-12 * abs(b), f"loose points, {kind}: {figure} {a}, alone {b}")


def test_ghosts_and_faces():
    """Copies that ghost flags mark get the values of what they are copies of; a rank with nothing but lines, or nothing, goes along."""
    mesh = mesh_with_solution()
    serial = metric_on(mesh.whole(), False)
    # One layer beyond the piece, flagged.
    along = mesh.centers()[:, 0] * ranks
    chosen = (along > rank - 0.3) & (along < rank + 1.3)
    grid = mesh.grid(chosen)
    add(grid.GetCellData(), "vtkGhostType", (along.astype(int) != rank)[chosen].astype(np.uint8))
    check(grid.GetCellGhostArray() is not None, "ghosts: no flags")
    f = metric_on(grid)
    check(compare("ghosts", f.GetOutput(), f, serial.GetOutput(), serial, 1e-12) > 100, "ghosts: few values")
    last = rank == ranks - 1
    owner = (mesh.centers()[:, 0] * (ranks - 1)).astype(int)
    grid = vtkUnstructuredGrid() if last else mesh.grid(owner == rank)
    f = metric_on(grid)
    compare("a rank without cells", f.GetOutput(), f, serial.GetOutput(), serial, 1e-12)
    if last:
        grid = make_grid(np.eye(3), np.zeros((0, 4), int))
        grid.InsertNextCell(VTK_LINE, 2, [0, 1])
        add(grid.GetPointData(), "u", np.zeros(3))
        add(grid.GetPointData(), "place", np.zeros(3, int))
    f = metric_on(grid)
    check(f.GetErrorCode() == 0 and f.told == [], f"lines: {f.told}")
    check(abs(f.GetDesiredSize() / serial.GetDesiredSize() - 1) < 1e-12, "lines: another size")


def test_metric_errors():
    """What is wrong on one rank is an error on all, told once with the rank; then nobody waits."""
    mesh = mesh_with_solution(ids=False)

    def with_nan():
        grid = mesh.piece()
        if rank == 1:
            values = vtk_to_numpy(grid.GetPointData().GetArray("u"))
            values[3] = np.nan
        return grid

    def without_array():
        grid = mesh.piece()
        if rank == 1:
            grid.GetPointData().RemoveArray("u")
        return grid

    def with_float():
        grid = mesh.piece()
        if rank == 1:
            values = vtk_to_numpy(grid.GetPointData().GetArray("u")).astype(np.float32)
            add(grid.GetPointData(), "u", values)
        return grid

    def strings():
        grid, array = mesh.piece(), vtkStringArray()
        array.SetName("u")
        array.SetNumberOfValues(grid.GetNumberOfPoints())
        if rank == 0:
            grid.GetPointData().RemoveArray("u")
            grid.GetPointData().AddArray(array)
        return grid
    for name, make, text in (("nan", with_nan, "Rank 1: The solution 'u' is not finite at point 3"),
                             ("no array", without_array, "Rank 1: "), ("strings", strings, "Rank 0: "),
                             ("float", with_float, "same name, type and size on all ranks")):
        f = metric_on(make())
        check(f.GetErrorCode() != 0 and f.GetOutput().GetNumberOfCells() == 0, f"{name}: no error")
        check(len(f.told) == (rank == 0) and all(text in t for t in f.told), f"{name}: {f.told}")
        check(f.GetDesiredSize() == 0, f"{name}: a size")


def blocks_of(*grids):
    data = vtkMultiBlockDataSet()
    data.SetNumberOfBlocks(len(grids))
    for i, grid in enumerate(grids):
        data.SetBlock(i, grid)
    return data


def test_metric_blocks():
    """Each block is a mesh of all ranks; ranks whose blocks differ are an error on all."""
    mesh, small = mesh_with_solution(), mesh_with_solution(n=4)
    pieces = blocks_of(mesh.piece(), small.whole() if rank == 1 else None)
    f = metric_on(pieces)
    serial = [metric_on(m.whole(), False) for m in (mesh, small)]
    out = f.GetOutputDataObject(0)
    compared = []
    for i, grid in enumerate((out.GetBlock(0), out.GetBlock(1))):
        if grid is not None and grid.GetNumberOfCells():
            array, theirs = (vtk_to_numpy(g.GetPointData().GetArray("Metric")) for g in (grid, serial[i].GetOutput()))
            places = vtk_to_numpy(grid.GetPointData().GetArray("place"))
            check(np.allclose(array, theirs[places], rtol=1e-12, atol=1e-12 * abs(theirs).max()), f"block {i}: another metric")
            compared.append(i)
    check(compared == ([0, 1] if rank == 1 else [0]), f"blocks: {compared} compared")
    check(f.GetErrorCode() == 0 and f.told == [], f"blocks: {f.told}")
    f = metric_on(blocks_of(mesh.piece()) if rank else blocks_of(mesh.piece(), small.piece()))
    check(f.GetErrorCode() != 0, "other blocks: no error")
    check(len(f.told) == (rank == 0) and all("blocks of the ranks differ" in t for t in f.told), f"other blocks: {f.told}")


def solve(data, everywhere=True):
    f = filter_of(vtkThermoelasticFilter, data, {"TemperatureMode": 2, "UniformTemperature": 50.0, "RigidMotion": 1})
    f.UpdatePiece(rank, ranks, 0) if everywhere else f.Update()
    return f


def test_thermoelastic():
    """A body in pieces: the same error on all ranks, told once, also in blocks that only some ranks have. A body on one rank is solved there."""
    mesh = Mesh(n=4)
    empty = mesh.grid(np.zeros(len(mesh.cells), bool))
    for name, data in (("pieces", mesh.piece()), ("blocks", blocks_of(mesh.piece(), None)),
                       ("a block less on some ranks", blocks_of(mesh.piece()) if rank else blocks_of(mesh.piece(), mesh.piece()))):
        f = solve(data)
        check(f.GetErrorCode() != 0, f"{name}: no error")
        check(f.GetOutputDataObject(0).GetNumberOfElements(1) == 0, f"{name}: cells come out")
        check(len(f.told) == (rank == 0), f"{name}: {f.told}")
        check(all(f"spread over {ranks} processes" in t and "Aggregate" in t for t in f.told), f"{name}: {f.told}")
    # Two bodies, each whole on a rank of its own, the last rank without any block.
    data = (blocks_of(mesh.whole(), empty), blocks_of(empty, mesh.whole()), blocks_of())[min(rank, 2)]
    for name, data, own in (("one rank", mesh.whole() if rank == 1 else empty, None), ("two bodies", data, rank)):
        f = solve(data)
        check(f.GetErrorCode() == 0 and f.told == [], f"{name}: {f.told}")
        out = f.GetOutputDataObject(0)
        grid = out.GetBlock(own) if own is not None and own < 2 else out if own is None else None
        if grid is not None and grid.GetNumberOfCells():
            stress = vtk_to_numpy(grid.GetPointData().GetArray("VonMises"))
            check(len(stress) == len(mesh.x) and stress.max() < 1e3, f"{name}: a free body is stressed by {stress.max()}")
            table = f.GetOutputDataObject(1)
            table = table.GetBlock(own) if own is not None else table
            check(table.GetNumberOfRows() > 1, f"{name}: no history")
        check((grid is not None and grid.GetNumberOfCells() > 0) == (rank == 1 if own is None else rank < 2), f"{name}: rank {rank}")


def test_alone():
    """Asked for the whole, a rank works alone: it waits for nobody."""
    mesh = mesh_with_solution()
    if rank == 0:
        f = solve(mesh.whole(), False)
        check(f.GetErrorCode() == 0 and f.GetOutput().GetNumberOfCells() == len(mesh.cells), f"alone: {f.told}")
        f = metric_on(mesh.whole(), False)
        check(f.GetErrorCode() == 0 and f.GetDesiredSize() > 0, f"alone: {f.told}")
    controller.Barrier()
    check(len(gather(rank=np.array([rank]))["rank"]) == ranks, "alone: ranks are lost")


run_tests(globals())
