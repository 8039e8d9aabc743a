# SPDX-License-Identifier: BSD-3-Clause
"""The borders between ranks take part: what one rank promises for a mesh holds for its pieces. By pvbatch --symmetric."""
import os
import sys

import numpy as np
from meshoptimize import vtkMeshOptimizeFilter
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkCommand
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkUnstructuredGrid

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # pvbatch does not
from ranks_case import FACETS, Mesh, alone, check, compare, corners, facets, gather, history, rank, ranks, run, run_tests


def test_whole():
    """As good as alone, the same bits again and with two threads, one history."""
    mesh = Mesh()
    serial, f = alone(mesh), run(mesh.piece())
    kept = run(mesh.piece(), False)
    after = compare("whole", f, corners(mesh.whole()), serial)
    check(min(w.min() for w in gather(kept=np.array([kept.GetWorstQualityAfter()]))["kept"])
          < 0.55, "whole: the test is too easy")
    again = run(mesh.piece(), NumberOfThreads=2)
    check(np.array_equal(corners(f.GetOutput()), corners(again.GetOutput())), "whole: other bits with two threads")
    if rank == 0:
        mine, its = history(f), history(serial)
        check(mine["Stage"][:2] == ["input", "pieces"] and set(mine["Stage"][2:]) == {"borders"}, f"stages {mine['Stage']}")
        for column in ("Cells", "Points", "BelowTarget", "Worst"):
            check(mine[column][0] == its[column][0], f"history: {column} {mine[column][0]}, alone {its[column][0]}")
        check(int(mine["Points"][-1]) == len(np.unique(after.reshape(-1, 3), axis=0)), "history: points at the end")
    else:
        check(f.GetOutputDataObject(1).GetNumberOfRows() == 0, "history: rows on two ranks")


def test_bound():
    """Caps of the surface count, those of borders do not; a surface that cannot get better is named."""
    mesh = Mesh(n=4, jitter=0.1)
    low = mesh.node[:, 2] == 0
    mesh.x[low & (mesh.node[:, 0] == 2) & (mesh.node[:, 1] == 2)] += [0.23, 0.0, 0.0]  # slender facets, on two pieces
    serial, f = alone(mesh), run(mesh.piece())
    compare("bound", f, corners(mesh.whole()), serial)
    check(0 < f.GetNumberOfCappedCells(), "bound: the test is too easy")
    if rank == 0 and f.GetWorstQualityAfter() == serial.GetWorstQualityAfter():
        a, b = f.GetNumberOfCappedCells(), serial.GetNumberOfCappedCells()
        check(a == b, f"bound: {a} capped, alone {b}")


def test_ids():
    """Ids above 2^53 survive; new ones are greater and unique; a moved point keeps its own."""
    mesh = Mesh(n=5)
    mesh.ids = 2 ** 60 + 1
    f = run(mesh.piece())
    compare("ids", f, corners(mesh.whole()))
    out = f.GetOutput()
    cells, points = (vtk_to_numpy(d.GetGlobalIds()) for d in (out.GetCellData(), out.GetPointData()))
    check(out.GetPointData().GetGlobalIds().GetName() == "own ids", "ids: another name")
    x = vtk_to_numpy(out.GetPoints().GetData())
    every = gather(cells=cells, points=points, x=x)
    cells, points, x = (np.concatenate(every[name]) for name in ("cells", "points", "x"))
    check(len(np.unique(cells)) == len(cells) and cells.min() >= mesh.ids, "ids: cells")
    where = {}
    for p, at in zip(points, x):
        check(where.setdefault(int(p), tuple(at)) == tuple(at), f"ids: point {p} at two places")
    surface = np.flatnonzero((mesh.node == 0).any(axis=1) | (mesh.node == mesh.n).any(axis=1))
    check(all(where.get(int(p) + mesh.ids) == tuple(mesh.x[p]) for p in surface), "ids: points of the surface")
    check(len(set(where.values())) == len(where), "ids: two ids at one place")
    # Cells go home.
    first = mesh.ids + np.flatnonzero((mesh.centers()[:, 0] * ranks).astype(int) == rank)
    old = vtk_to_numpy(out.GetCellData().GetGlobalIds())
    old = old[old < mesh.ids + len(mesh.cells)]
    check(np.isin(old, first).all() and len(old) > 0, f"ids: {np.isin(old, first).sum()} of {len(old)} cells at home")
    check(0.7 < out.GetNumberOfCells() / len(first) < 1.4, f"ids: {len(first)} cells, then {out.GetNumberOfCells()}")
    # One id at two places is no id.
    bad = mesh.piece()
    if rank == 1:
        bad.GetPoints().SetPoint(int(np.argmin(vtk_to_numpy(bad.GetPoints().GetData())[:, 0])), 0.4, 0.41, 0.42)
    f = run(bad)
    check(f.GetErrorCode() != 0 and f.GetOutput().GetNumberOfCells() == 0, "ids: a point at two places")
    check(rank > 0 or "other coordinates" in "".join(f.told), f"ids: {f.told}")


def test_data():
    """Fields are as exact as alone, cell data come from the parent, nodes of fixed points stay."""
    mesh = Mesh()
    mesh.points["linear"] = mesh.x @ [1.0, 2.0, 3.0]
    mesh.points["square"] = (mesh.x ** 2) @ [1.0, 1.0, 1.0]
    mesh.points["place"] = (mesh.x * 1000).astype(np.int32)
    mesh.points["fixed"] = ((np.arange(len(mesh.x)) % 11) == 0).astype(np.uint8)
    mesh.values["cell"] = np.arange(len(mesh.cells), dtype=np.float32)

    def fix(f):
        f.SetFixedPointArray("fixed")
    f = run(mesh.piece(), True, fix)
    compare("data", f, corners(mesh.whole()))

    start = corners(mesh.whole())
    inverse = np.linalg.inv(np.transpose(start[:, 1:] - start[:, :1], (0, 2, 1)))

    def sample(name, x):
        """Values of the input at x, interpolated between the corners of the cell there."""
        w = np.einsum("cij,pcj->pci", inverse, x[:, None] - start[:, 0])
        w = np.concatenate([1 - w.sum(axis=2, keepdims=True), w], axis=2)
        at = w.min(axis=2).argmax(axis=1)
        return (mesh.points[name][mesh.cells[at]] * w[np.arange(len(x)), at]).sum(axis=1)
    x = vtk_to_numpy(f.GetOutput().GetPoints().GetData())
    data = f.GetOutput().GetPointData()
    for name in ("linear", "square"):
        error = np.abs(vtk_to_numpy(data.GetArray(name)) - sample(name, x)).max(initial=0)
        check(error < 1e-12, f"data: {name} is off by {error}, which is not one interpolation")
    new = set(map(tuple, x)) - set(map(tuple, mesh.x))
    check(sum(gather(new=np.array(len(new)))["new"]) > 50, "data: the test is too easy")
    place = vtk_to_numpy(data.GetArray("place"))
    check(np.abs(place / 1000 - x).max(initial=0) < 0.3, "data: integers")
    x = {tuple(p) for p in np.concatenate(gather(x=x)["x"])}
    check(all(tuple(p) in x for p in mesh.x[mesh.points["fixed"] == 1]), "data: fixed points")
    check(f.GetOutput().GetCellData().GetArray("cell").GetDataTypeAsString() == "float", "data: cell array")


def test_regions():
    """The interface of two regions is kept bit for bit; it lies in all pieces, or on their border."""
    for axis in (0, 1):
        mesh = Mesh(n=6, keep=lambda x: x[:, 0] == 0.5)
        mesh.values["region"] = (mesh.centers()[:, 0] > 0.5).astype(np.int32)

        def choose(f):
            f.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_CELLS, "region")
        serial, f = alone(mesh, choose), run(mesh.piece(axis), True, choose)
        tets = compare(f"regions {axis}", f, corners(mesh.whole()), serial)
        of = np.concatenate(gather(of=vtk_to_numpy(f.GetOutput().GetCellData().GetArray("region")))["of"])
        before = facets(corners(mesh.whole()), mesh.values["region"])[0]
        check(rank > 0 or len(before) == 72 and np.array_equal(before, facets(tets, of)[0]), f"regions {axis}: another interface")


def test_crack():
    """A crack of doubled nodes stays open: across the borders, and along one if there are ids."""
    for axis, ids in ((1, False), (1, 10), (2, 10)):
        mesh = Mesh(n=6, keep=lambda x: x[:, 2] == 0.5)
        lips = (mesh.node[:, 2] == 3) & (mesh.node[:, 0] < 4)
        twin = np.arange(len(mesh.x))
        twin[lips] = len(mesh.x) + np.arange(lips.sum())
        above = mesh.centers()[:, 2] > 0.5
        mesh.cells[above] = twin[mesh.cells[above]]
        mesh.x, mesh.node = (np.concatenate([a, a[lips]]) for a in (mesh.x, mesh.node))
        mesh.ids = ids
        f = run(mesh.piece(axis, 2 if axis == 2 and ranks == 2 else None))
        if not ids and ranks > 3 and any("cannot be told apart" in text for told in gather(told=f.told)["told"] for text in told):
            continue  # the border of a thin piece is jagged, and may run along the crack: said, and nothing is closed
        compare(f"crack {axis} {ids}", f, corners(mesh.whole()))
        if ids:
            points = np.concatenate(gather(p=vtk_to_numpy(f.GetOutput().GetPointData().GetGlobalIds()))["p"])
            check(set(np.concatenate([np.flatnonzero(lips), twin[lips]]) + ids) <= set(points), "crack: nodes are gone")
        out = f.GetOutput()
        cells = vtk_to_numpy(out.GetCells().GetConnectivityArray()).reshape(-1, 4) if out.GetNumberOfCells() else np.zeros((0, 4), int)
        name = vtk_to_numpy(out.GetPointData().GetGlobalIds()) if ids else np.arange(out.GetNumberOfPoints()) + rank * 10 ** 6
        every = gather(sides=name[cells[:, FACETS]].reshape(-1, 3), places=corners(out)[:, FACETS].reshape(-1, 3, 3))
        sides, places = (np.concatenate(every[k]) for k in ("sides", "places"))
        inside = (places[:, :, 2] == 0.5).all(axis=1) & (places[:, :, 0] <= 0.5 + 1e-9).all(axis=1)
        number = np.unique(np.sort(sides[inside], axis=1), axis=0, return_counts=True)[1]
        check(len(number) == 72 and number.max(initial=0) == 1, f"crack {axis} {ids}: {len(number)} facets, {number.max(initial=0)} cells")


def test_one_rank():
    """All on one rank: divided first. One rank without cells, and no cells at all."""
    mesh = Mesh(n=6)
    mesh.points["linear"] = mesh.x @ [1.0, 2.0, 3.0]
    serial = alone(mesh)
    for where in range(2):
        f = run(mesh.grid(np.full(len(mesh.cells), rank == where)))
        compare(f"all on rank {where}", f, corners(mesh.whole()), serial)
        out = f.GetOutput()
        check(out.GetNumberOfCells() > 0.1 * len(mesh.cells) / ranks, f"all on rank {where}: not divided")
        x = vtk_to_numpy(out.GetPoints().GetData())
        values = vtk_to_numpy(out.GetPointData().GetArray("linear"))
        check(np.abs(values - x @ [1.0, 2.0, 3.0]).max(initial=0) < 1e-12, f"all on rank {where}: data")
    if ranks > 2:
        f = run(mesh.piece(count=2))
        compare("one without cells", f, corners(mesh.whole()), serial)
    f = run(vtkUnstructuredGrid())
    check((f.GetWorstQualityBefore(), f.GetWorstQualityAfter(), f.GetQualityBound()) == (0, 0, 0), "nothing: figures")
    check(f.told == [] and f.GetStopReason() == vtkMeshOptimizeFilter.NothingToDo, f"nothing: {f.told}")


def test_uneven():
    """Where one rank has nearly all cells the mesh is divided anew; pieces that are not very uneven stay where they are."""
    mesh = Mesh(n=8)
    mesh.ids = 7
    serial = alone(mesh)
    along = np.argsort(np.argsort(mesh.centers() @ [1.0, 0.01, 0.0001]))
    for share in (0.95, 0.45 if ranks == 2 else 0.36):
        owner = np.where(along < share * len(along), 0, 1 + (along - share * len(along)) * (ranks - 1) // ((1 - share) * len(along)))
        owner = np.minimum(owner.astype(int), ranks - 1)
        mesh.values["owner"] = owner
        f = run(mesh.grid(owner == rank))
        compare(f"uneven {share}", f, corners(mesh.whole()), serial)
        counts = np.array(gather(n=np.array(f.GetOutput().GetNumberOfCells()))["n"])
        stayed = (vtk_to_numpy(f.GetOutput().GetCellData().GetArray("owner")) == rank).all()
        if share == 0.95:
            check(np.bincount(owner).max() > 0.94 * len(owner), "uneven: the test is too easy")
            check(counts.max() < 1.25 * counts.mean(), f"uneven: {counts} cells")
        else:
            check(stayed, f"uneven: cells have left their rank at {np.bincount(owner)} cells")


def test_work():
    """A mesh on one rank is divided by work: where cells are bad a rank gets fewer, but no rank gets more than 1.3 of the mean."""
    mesh = Mesh(n=9, keep=lambda x: x[:, 0] > 0.35)
    mesh.x[:, 0] *= 1.2  # cut across the longest side
    empty = mesh.grid(np.zeros(len(mesh.cells), bool))
    for target, most in ((0.35, 8.0), (0.5, 7.0)):  # few bad cells; more than .3 of the work
        f = run(mesh.whole() if rank == 0 else empty, TargetQuality=target, MoveNodes=0, Reconnect=0, InsertNodes=0, RemoveNodes=0,
                LookAhead=0)
        quality = vtk_to_numpy(f.GetOutput().GetCellData().GetArray("MeshQuality"))
        every = gather(n=np.array(len(quality)), bad=np.array((quality < target).sum()))
        cells, bad = np.array(every["n"]), np.array(every["bad"])
        mean, more = len(mesh.cells) / ranks, min(8.0, 0.3 * len(mesh.cells) / bad.sum())
        work = cells + bad * more
        check(more <= most and bad.max() > 1.5 * bad.mean(), f"work: {bad}, {more}: the test is too easy")
        check(cells[bad.argmax()] < 0.95 * mean and cells.max() < 1.31 * mean, f"work: {cells} cells, {bad} bad")
        check(work.max() - work.min() < 20, f"work: {work}")


def test_budget():
    """The growth budget is that of the whole run, all ranks and rounds together."""
    mesh = Mesh()
    for budget in (0.0, 0.02):
        f = run(mesh.piece(), GrowthBudget=budget)
        cells = len(compare(f"budget {budget}", f, corners(mesh.whole())))
        check(cells <= (1 + budget) * len(mesh.cells), f"budget {budget}: {len(mesh.cells)} cells, then {cells}")
    # Where it is what stops the run, the rounds leave little of it.
    mesh, budget = Mesh(n=5, jitter=0.4), 0.04
    f = run(mesh.piece(), GrowthBudget=budget, TargetQuality=0.8)
    share = (len(compare("short", f, corners(mesh.whole()))) / len(mesh.cells) - 1) / budget
    check(f.GetStopReason() == vtkMeshOptimizeFilter.GrowthLimit, f"short: {f.GetStopReasonAsString()}")
    check(0.8 < share < 1 + 1e-9, f"short: {share} of the budget")


def test_below():
    """Only cells under the threshold and layers around them change, across borders, too; all others stay bit for bit."""
    mesh = Mesh(n=9, jitter=0.1)
    # Bad places: one on each border, where layers go over to the other rank, and one inside of a piece.
    at = [np.argmin(np.abs(mesh.x - x).sum(axis=1)) for x in [(k / ranks, 0.45, 0.55) for k in range(1, ranks)] + [(0.1, 0.2, 0.8)]]
    for p in at:
        q = p + mesh.n + 1
        mesh.x[p] += 0.85 * (mesh.x[q] - mesh.x[p])
    mesh.points["place"] = np.arange(len(mesh.x))
    mesh.values["cell"] = np.arange(len(mesh.cells))
    before = corners(mesh.whole())
    still = {"MoveNodes": False, "Reconnect": False, "InsertNodes": False, "RemoveNodes": False}
    first = run(mesh.whole(), False, **still)
    quality = vtk_to_numpy(first.GetOutput().GetCellData().GetArray("MeshQuality"))
    below = {}
    for layers in (0, 2, 30):
        inside = quality < 0.3
        check(0 < inside.sum() < 0.05 * len(inside), f"below: {inside.sum()} bad cells, the test is too easy")
        for _ in range(layers):
            inside = np.isin(mesh.cells, mesh.cells[inside]).any(axis=1)
        options = {"OptimizeBelow": 0.3, "NumberOfLayers": layers}
        serial, f = (run(mesh.whole(), False, **options) if rank == 0 else None), run(mesh.piece(), **options)
        tets = compare(f"below, {layers} layers", f, before, serial, layers > 0)
        below[layers] = f.GetWorstQualityAfter()
        if rank > 0:
            continue
        check(f.GetStopReason() == serial.GetStopReason(), f"below: {f.GetStopReasonAsString()}, alone {serial.GetStopReasonAsString()}")
        check(int(history(f)["BelowTarget"][0]) == (quality < 0.6).sum(), f"below: {history(f)['BelowTarget'][0]} under the target")

        def keys(cells):
            return {tuple(sorted(map(tuple, cell))) for cell in cells}
        after = keys(tets)
        lost = [k for k in np.flatnonzero(~inside) if tuple(sorted(map(tuple, before[k]))) not in after]
        check(lost == [], f"below, {layers} layers: {len(lost)} cells outside have changed")
        check(layers == 0 or len(keys(before[inside]) - after) > 0.02 * inside.sum(), f"below, {layers} layers: nothing has changed inside")
    check(below[2] > max(below[0], 1.3 * quality.min()), f"below: {below}")
    # Nothing is under it: nothing happens.
    f = run(mesh.piece(), OptimizeBelow=1e-9, NumberOfLayers=5)
    tets = compare("below 0", f, before, None, False)
    check(f.GetNumberOfOperations() == 0 and len(tets) == len(before), "below 0: something has changed")


def test_below_renumbered():
    """Cells that were numbered the wrong way round may change, as on one rank; what is outside keeps the order of its nodes."""
    mesh = Mesh(n=5, jitter=0.3)
    turned = np.flatnonzero(mesh.centers()[:, 1] < 0.6)
    mesh.cells[turned] = mesh.cells[turned][:, [1, 0, 2, 3]]
    before = corners(mesh.whole())
    options = {"OptimizeBelow": 1e-6, "NumberOfLayers": 0}
    serial, f = (run(mesh.whole(), False, **options) if rank == 0 else None), run(mesh.piece(), **options)
    tets = np.concatenate(gather(tets=corners(f.GetOutput()))["tets"])
    check(f.GetErrorCode() == 0, f"renumbered: {f.told}")
    if rank == 0:
        for name in ("WorstQualityBefore", "MeanQualityBefore", "QualityBound"):
            a, b = getattr(f, "Get" + name)(), getattr(serial, "Get" + name)()
            check(abs(a - b) < 1e-6, f"renumbered: {name} {a}, alone {b}")
        check(f.GetWorstQualityAfter() >= 0.98 * serial.GetWorstQualityAfter(), f"renumbered: worst {f.GetWorstQualityAfter()}")
        check(f.GetNumberOfOperations() > 0, "renumbered: nothing has changed")
        after = {cell.tobytes() for cell in tets}
        lost = [k for k in range(len(before)) if before[k].tobytes() not in after]
        check(set(lost) <= set(turned), f"renumbered: {len(set(lost) - set(turned))} cells outside have changed")


def test_stops():
    """Time limit and abort on one rank reach all; the mesh is whole."""
    mesh = Mesh()
    f = run(mesh.piece(), TimeLimit=1e-6)
    compare("late", f, corners(mesh.whole()))
    check(f.GetStopReason() == vtkMeshOptimizeFilter.TimeLimitReached, f"late: {f.GetStopReasonAsString()}")
    for after in (0.0, 0.69):  # in the pieces, and at the borders
        def abort(f):
            if rank == ranks - 1:
                f.AddObserver(vtkCommand.ProgressEvent, lambda o, e: o.SetAbortExecute(o.GetProgress() > after))
        f = run(mesh.piece(), True, abort)
        compare(f"abort after {after}", f, corners(mesh.whole()))
        check(f.GetStopReason() == vtkMeshOptimizeFilter.Aborted, f"abort after {after}: {f.GetStopReasonAsString()}")


def test_errors():
    """An error on one rank is one on all, told once, with the rank; what is not built is told once, too."""
    mesh = Mesh(n=4)
    bad = mesh.piece()
    if rank == 1:
        bad.GetPoints().SetPoint(3, np.nan, 0.0, 0.0)
    f = run(bad)
    check(f.GetErrorCode() != 0 and f.GetOutput().GetNumberOfCells() == 0, "errors: no error")
    check(len(f.told) == (rank == 0) and all("Rank 1: " in text for text in f.told), f"errors: {f.told}")
    f = run(mesh.piece(), BoundaryMode=vtkMeshOptimizeFilter.Slide)
    check(f.GetErrorCode() != 0 and len(f.told) == (rank == 0), f"errors: Slide {f.told}")
    f = run(mesh.piece(), Beta=1.0, DesiredSize=0.25)
    check(f.GetErrorCode() == 0 and len(f.told) == (rank == 0), f"errors: sizes {f.told}")
    check(rank > 0 or "borders between the ranks' pieces are kept" in f.told[0], f"errors: sizes {f.told}")
    check(f.GetOutputDataObject(0).GetNumberOfElements(1) > 0, "errors: sizes without output")


run_tests(globals())
