# SPDX-License-Identifier: BSD-3-Clause
"""Borders between ranks in other inputs: triangles, ghost cells, blocks, folded meshes, copies. By pvbatch --symmetric."""
import os
import sys

import numpy as np
from meshoptimize import vtkMeshQualityMinMax
from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkMultiBlockDataSet, vtkUnstructuredGrid

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # pvbatch does not
from ranks_case import (Mesh, add, check, compare, corners, facets, figures_of, gather, history, make_grid, rank, ranks,
                        run, run_tests, volume)


class PlaneMesh:
    """A square of 2 n^2 triangles whose inner nodes are moved at random, in any plane; some part of it lies on its back."""

    def __init__(self, n=16, tilted=False, back=0.0):
        i = np.arange((n + 1) ** 2)
        node = np.stack([i // (n + 1), i % (n + 1)], 1)
        self.flat = node / n
        inner = ((node > 0) & (node < n)).all(axis=1) & (node[:, 1] != n // 2)
        self.flat[inner] += np.random.default_rng(3).uniform(-0.42, 0.42, (inner.sum(), 2)) / n
        self.flat[n // 2 * (n + 1) + 5] = self.flat[n // 2 * (n + 1) + 4] + [0.0, 0.05 / n]  # on the border of two ranks
        base = i[(node < n).all(axis=1)]
        self.cells = np.concatenate([np.stack([base, base + n + 1, base + n + 2], 1), np.stack([base, base + n + 2, base + 1], 1)])
        self.turn = np.array([[0.36, 0.48, 0.8], [-0.8, 0.6, 0.0]] if tilted else [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
        self.x = self.flat @ self.turn
        self.centers = node[self.cells].mean(axis=1) / n
        turned = self.centers[:, 0] < back
        self.cells[turned] = self.cells[turned][:, [0, 2, 1]]
        self.square = (self.flat ** 2).sum(axis=1)
        self.region = (self.centers[:, 1] > 0.5).astype(np.int32)

    def grid(self, chosen):
        used = np.unique(self.cells[chosen])
        grid = make_grid(self.x[used], np.searchsorted(used, self.cells[chosen]))
        add(grid.GetPointData(), "square", self.square[used])
        add(grid.GetCellData(), "region", self.region[chosen])
        return grid

    def piece(self):
        return self.grid((self.centers[:, 0] * ranks).astype(int) == rank)

    def whole(self):
        return self.grid(np.ones(len(self.cells), bool))


def edges_of(triangles, of=None):
    """Edges by the bits of their ends, with the number of triangles; `of`: only those between two kinds."""
    e = np.sort(np.ascontiguousarray(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2, 3) + 0.0).view(
        "f8,f8,f8").reshape(-1, 2), axis=1).view("V48").ravel()
    e, inverse, count = np.unique(e, return_inverse=True, return_counts=True)
    kinds = [np.isin(np.arange(len(e)), inverse[np.repeat(of == kind, 3)]) for kind in (0, 1)] if of is not None else None
    return (e, count) if of is None else (e[kinds[0] & kinds[1]], None)


def area(triangles):
    return np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]).sum(axis=0) / 2


def test_plane():
    """Triangles in any plane: as good as alone, edge and interface kept bit for bit, one upper side, data as exact."""
    for name, options in (("level", {}), ("tilted", {"tilted": True}), ("back", {"back": 0.3})):
        mesh = PlaneMesh(**options)

        def regions(f):
            f.SetTargetQuality(0.8)
            f.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_CELLS, "region")
        serial = run(mesh.whole(), False, regions) if rank == 0 else None
        f, kept = run(mesh.piece(), True, regions), run(mesh.piece(), False, regions)
        out, before = f.GetOutput(), mesh.x[mesh.cells]
        x = vtk_to_numpy(out.GetPoints().GetData()) if out.GetNumberOfPoints() else np.zeros((0, 3))
        triangles = x[vtk_to_numpy(out.GetCells().GetConnectivityArray()).reshape(-1, 3)]
        flat = x @ mesh.turn.T
        error = np.abs(vtk_to_numpy(out.GetPointData().GetArray("square")) - (flat ** 2).sum(axis=1)).max(initial=0)
        every = gather(tets=triangles, kind=vtk_to_numpy(out.GetCellData().GetArray("region")), figures=figures_of(f),
                       kept=np.array([kept.GetWorstQualityAfter()]), error=np.array([error]))
        tets, kind = np.concatenate(every["tets"]), np.concatenate(every["kind"])
        check(len({tuple(row) for row in every["figures"]}) == 1, f"{name}: figures differ by rank")
        if rank > 0:
            check(f.told == [], f"{name}: {f.told}")
            continue
        check([text.split("):")[1] for text in f.told] == [text.split("):")[1] for text in serial.told], f"{name}: {f.told}")
        (old, count), (new, now) = edges_of(before), edges_of(tets)
        check(now.max() == 2 and np.array_equal(old[count == 1], new[now == 1]), f"{name}: another surface")
        check(np.array_equal(edges_of(before, mesh.region)[0], edges_of(tets, kind)[0]), f"{name}: another interface")
        worst = f.GetWorstQualityAfter()
        check(worst >= 0.98 * serial.GetWorstQualityAfter(), f"{name}: worst {worst}, alone {serial.GetWorstQualityAfter()}")
        for n in ("WorstQualityBefore", "MeanQualityBefore", "QualityBound", "NumberOfInvertedCellsBefore"):
            a, b = getattr(f, "Get" + n)(), getattr(serial, "Get" + n)()
            check(abs(a - b) < 1e-6, f"{name}: {n} {a}, alone {b}")
        check(np.abs(area(tets) - area(before)).max() < 1e-12 or name == "back", f"{name}: area {area(tets)}")
        check(np.max(every["error"]) < 2.0 / 16 ** 2, f"{name}: field {np.max(every['error'])}")
        if name == "level" and ranks == 2:
            check(np.min(every["kept"]) < 0.95 * worst, f"{name}: {every['kept']}, {worst}: the test is too easy")
    mesh = PlaneMesh()
    mesh.x[:, 2] = np.maximum(0.0, mesh.x[:, 0] - 0.5)
    f = run(mesh.piece())
    check(f.GetErrorCode() != 0 and (rank > 0 or "not in one plane" in f.told[0]), f"bent: {f.told}")


def test_ghosts():
    """Ghost cells in the input are dropped, with and without ids: the same mesh as without them. Hidden cells are kept."""
    mesh = Mesh(n=6)
    mesh.points["linear"] = mesh.x @ [1.0, 2.0, 3.0]
    for ids in (False, 10):
        mesh.ids = ids
        own = (mesh.centers()[:, 0] * ranks).astype(int) == rank
        near = np.isin(mesh.cells, np.unique(mesh.cells[own])).any(axis=1)  # one layer: all cells that share a point
        grid, marks = mesh.grid(near), np.where(own[near], 0, 1).astype(np.uint8)
        add(grid.GetCellData(), "vtkGhostType", marks)
        owned = np.isin(np.unique(mesh.cells[near]), np.unique(mesh.cells[own]))
        add(grid.GetPointData(), "vtkGhostType", np.where(owned, 0, 1).astype(np.uint8))
        check(marks.any(), "ghosts: the test is too easy")
        f, plain = run(grid), run(mesh.piece())
        compare(f"ghosts {ids}", f, corners(mesh.whole()))
        a, b = corners(f.GetOutput()), corners(plain.GetOutput())
        check(len(a) == len(b) and np.array_equal(a, b), f"ghosts {ids}: another mesh")
        check(f.GetOutput().GetCellData().GetArray("vtkGhostType") is None, f"ghosts {ids}: marks are left")
        same = vtk_to_numpy(f.GetOutput().GetPointData().GetArray("linear")) - vtk_to_numpy(plain.GetOutput().GetPointData().GetArray("linear"))
        check(np.abs(same).max(initial=0) < 1e-12, f"ghosts {ids}: data")
    hidden = mesh.piece()
    add(hidden.GetCellData(), "vtkGhostType", np.where(np.arange(hidden.GetNumberOfCells()) == 0, 32, 0).astype(np.uint8))
    f = run(hidden)
    check(rank > 0 or "borders between the ranks' pieces are kept" in "".join(f.told), f"hidden: {f.told}")
    check(f.GetOutput().GetCellData().GetArray("vtkGhostType").GetRange()[1] == 32, "hidden: lost")


def test_ghost_levels():
    """Layers of ghost cells, as the property or the pipeline asks: just the cells that share a point with the layer before."""
    mesh = Mesh(n=6)
    mesh.points["linear"] = mesh.x @ [1.0, 2.0, 3.0]
    mesh.ids = 10
    for layers, options in ((1, {"NumberOfGhostLevels": 1}), (2, {"asked": 2}), (2, {"NumberOfGhostLevels": 2, "asked": 1})):
        f = run(mesh.piece(), **options)
        out = f.GetOutput()
        ghost, twin = (vtk_to_numpy(d.GetArray("vtkGhostType")) for d in (out.GetCellData(), out.GetPointData()))
        names = vtk_to_numpy(out.GetPointData().GetGlobalIds())
        cells = names[vtk_to_numpy(out.GetCells().GetConnectivityArray()).reshape(-1, 4)]
        ids, x = vtk_to_numpy(out.GetCellData().GetGlobalIds()), vtk_to_numpy(out.GetPoints().GetData())
        every = gather(own=cells[ghost == 0], ids=ids[ghost == 0], names=names[twin == 0])
        own, all_ids, all_names = (np.concatenate(every[k]) for k in ("own", "ids", "names"))
        check(len(np.unique(all_ids)) == len(all_ids), f"levels {layers}: a cell on two ranks")
        check(len(np.unique(all_names)) == len(all_names) == len(np.unique(own)), f"levels {layers}: owners of points")
        near = np.isin(all_ids, ids[ghost == 0])
        for _ in range(layers):
            near = np.isin(own, np.unique(own[near])).any(axis=1)
        check(np.array_equal(np.sort(ids), np.sort(all_ids[near])), f"levels {layers}: {len(ids)} cells, not {near.sum()}")
        check((ghost == 1).any() and set(ghost) == {0, 1}, f"levels {layers}: the test is too easy")
        check(np.abs(vtk_to_numpy(out.GetPointData().GetArray("linear")) - x @ [1.0, 2.0, 3.0]).max() < 1e-12, f"levels {layers}: data")
        again = vtkMeshQualityMinMax()
        again.SetInputData(out)
        again.UpdatePiece(rank, ranks, 0)
        for a, b in ((again.GetMinimumQuality(), f.GetWorstQualityAfter()), (again.GetNumberOfMeasuredCells(), len(all_ids)),
                     (again.GetQualityBound(), f.GetQualityBound())):
            check(abs(a - b) < 1e-6, f"levels {layers}: measured {a}, not {b}")


def test_blocks():
    """Each block of composite data is a mesh of all ranks, also one that is on one rank only; the first failing one tells which."""
    first, second = Mesh(n=5), Mesh(n=4, jitter=0.3)

    def compose(alone, obstacle=None):
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, first.whole() if alone else first.piece())
        blocks.SetBlock(1, None)
        if alone or rank == ranks - 1:
            blocks.SetBlock(1, second.whole())
        blocks.SetBlock(2, obstacle)
        return blocks
    f, serial = run(compose(False)), run(compose(True), False) if rank == 0 else None
    out = f.GetOutputDataObject(0)
    for i, mesh in enumerate((first, second)):
        block = out.GetBlock(i)
        tets = np.concatenate(gather(tets=corners(block if block else vtkUnstructuredGrid()))["tets"])
        (old, count), (new, now) = facets(corners(mesh.whole())), facets(tets)
        check(now.max() == 2 and np.array_equal(old[count == 1], new[now == 1]), f"block {i}: another surface")
        check(abs(volume(tets) / volume(corners(mesh.whole())) - 1) < 1e-12, f"block {i}: another volume")
    check(len({tuple(row) for row in gather(figures=figures_of(f))["figures"]}) == 1, "blocks: figures differ by rank")
    check(f.told == [], f"blocks: {f.told}")
    if rank == 0:
        check(f.GetWorstQualityAfter() >= 0.98 * serial.GetWorstQualityAfter(), f"blocks: worst {f.GetWorstQualityAfter()}")
        check(abs(f.GetMeanQualityBefore() - serial.GetMeanQualityBefore()) < 1e-12, "blocks: mean")
        check(set(history(f)["Block"]) == set(history(serial)["Block"]) and "borders" in history(f)["Stage"], "blocks: history")
    # Another cell in the last block: all borders are kept, and no block is left with what was done before.
    bad = second.whole()
    bad.InsertNextCell(3, 2, [0, 1])  # VTK_LINE
    f = run(compose(False, bad if rank == 0 else None))
    check(f.GetErrorCode() == 0 and len(f.told) == (rank == 0), f"blocks: {f.told}")
    check((f.GetOutputDataObject(0).GetBlock(1) is not None) == (rank == ranks - 1), "blocks: a leaf is left")
    check("borders" not in history(f)["Stage"], "blocks: history of what was done before")


def test_folded():
    """A mesh that is folded where the pieces meet: neighbours on two ranks lie on one side, but are no copies of each other."""
    mesh = Mesh(n=6)
    at, slopes = mesh.x[:, 0].copy(), (1.0, -0.7, 0.5)
    mesh.x[:, 0] = sum(slopes[k] * np.clip(at - k / ranks, 0.0, 1.0 / ranks) for k in range(ranks))
    for ids, options in ((False, {}), (10, {}), (10, {"OptimizeBelow": 0.3, "NumberOfLayers": 1})):
        mesh.ids = ids
        f = run(mesh.piece(), **options)
        check(f.GetErrorCode() == 0 and not any("borders" in text for text in f.told), f"folded {ids} {options}: {f.told}")
        rows = {tuple(row) for row in gather(figures=figures_of(f))["figures"]}
        check(len(rows) == 1, f"folded {ids} {options}: figures differ by rank")
        check(rank > 0 or "borders" in history(f)["Stage"], f"folded {ids} {options}: no rounds")


def points_only(mesh, arrays=()):
    """Some points of the mesh, and no cells."""
    grid = make_grid(mesh.x[:40], np.zeros((0, 4), int))
    for name in arrays:
        add(grid.GetPointData(), name, mesh.points[name][:40])
    return grid


def test_arrays():
    """Qualities of an earlier run are left out, arrays that share a name are not; a rank of loose points lacks the others' arrays."""
    mesh = Mesh(n=6)
    mesh.points["linear"] = mesh.x @ [1.0, 2.0, 3.0]
    for name, value in (("MinimumDihedralAngle", 0.5), ("mat", 7), ("load", 3.25)):
        mesh.values[name] = np.full(len(mesh.cells), value)
    grid = mesh.piece()
    grid.GetCellData().GetArray("load").SetName("mat")
    data = run(grid).GetOutput().GetCellData()
    arrays = [data.GetArray(i) for i in range(data.GetNumberOfArrays())]
    found = [(a.GetName(), *a.GetRange()) for a in arrays if a.GetName() in ("mat", "MinimumDihedralAngle")]
    check(found == [("mat", 7.0, 7.0), ("mat", 3.25, 3.25)], f"arrays: {found}")
    for names in ([], ["linear"]):
        f = run(mesh.whole() if rank == 0 else points_only(mesh, names))
        out = f.GetOutput()
        check(f.GetErrorCode() == 0 and f.told == [], f"loose points, {names}: {f.told}")
        linear, x = vtk_to_numpy(out.GetPointData().GetArray("linear")), vtk_to_numpy(out.GetPoints().GetData())
        used = np.unique(vtk_to_numpy(out.GetCells().GetConnectivityArray()))
        check(np.abs(linear - x @ [1.0, 2.0, 3.0])[used].max(initial=0) < 1e-12, f"loose points, {names}: data")
        count = sum(gather(count=np.array([out.GetNumberOfPoints() - len(used)]))["count"])[0]
        check(count == 40 * (ranks - 1), f"loose points, {names}: {count} of {40 * (ranks - 1)}")


def test_kept_borders():
    """Where borders are kept, errors and results still are those of all ranks, and the first tells them."""
    mesh = Mesh(n=6)
    for broken in (False, True):
        grid = mesh.piece()
        grid.InsertNextCell(3, 2, [0, 1])  # VTK_LINE: borders are kept
        if broken and rank == ranks - 1:
            ids = grid.GetCell(4).GetPointIds()
            grid.InsertNextCell(10, 4, [ids.GetId(i) for i in range(4)])  # the same tetrahedron again
        f = run(grid)
        told = [text for text in f.told if "borders between the ranks' pieces are kept" not in text]
        check(len({tuple(row) for row in gather(figures=figures_of(f))["figures"]}) == 1, f"kept, {broken}: figures differ by rank")
        if broken:
            check(f.GetErrorCode() != 0 and f.GetOutput().GetNumberOfCells() == 0, f"kept: no error, {f.GetOutput().GetNumberOfCells()} cells")
            check(len(told) == (rank == 0) and all(f"Rank {ranks - 1}: Cells 4 and" in text for text in told), f"kept: {told}")
            continue
        q = vtk_to_numpy(f.GetOutput().GetCellData().GetArray("MeshQuality"))
        worst = min(gather(worst=np.array([np.nanmin(q)]))["worst"])[0]
        check(abs(worst - f.GetWorstQualityAfter()) < 1e-12, f"kept: worst {f.GetWorstQualityAfter()}, not {worst}")


def test_copies():
    """Each rank has a mesh of the whole body, with ids or without, or one of its own: no pieces of one mesh. Their borders are kept."""
    for name in ("same", "with ids", "with other cells"):
        mesh = Mesh(n=4, jitter=0.2 + 0.1 * rank if name == "with other cells" else 0.3)
        grid = mesh.whole()
        if name == "with ids":  # of points only: an id of a cell on two ranks is an error
            ids = numpy_to_vtkIdTypeArray(np.arange(len(mesh.x)), deep=1)
            ids.SetName("ids")
            grid.GetPointData().SetGlobalIds(ids)
        f = run(grid)
        told = [text for text in f.told if "as if each had read the whole mesh" in text]
        check(f.GetErrorCode() == 0 and len(told) == (rank == 0), f"copies, {name}: {f.told}")
        check(f.GetWorstQualityAfter() >= 0.5, f"copies, {name}: worst {f.GetWorstQualityAfter()}")


run_tests(globals())
