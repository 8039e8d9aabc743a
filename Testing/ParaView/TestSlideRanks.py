# SPDX-License-Identifier: BSD-3-Clause
"""Triangles whose boundary slides, on several ranks: the same curves and corners as on one rank. By pvbatch --symmetric."""
import os
import sys

import numpy as np
from meshoptimize import vtkMeshOptimizeFilter
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkDataObject, vtkMultiBlockDataSet, vtkPolyData

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # pvbatch does not
from ranks_case import Mesh, add, check, figures_of, gather, make_grid, rank, ranks, run, run_tests

LINES, SPLINE = vtkMeshOptimizeFilter.Straight, vtkMeshOptimizeFilter.BSpline


class Plane:
    """A square or a ring of triangles, in a tilted plane. Nodes on its boundary and on the interface are moved along it at random."""

    def __init__(self, kind, n=16, throw=0.42):
        random = np.random.default_rng(7)
        m = n if kind == "square" else 4 * n  # along the first direction, which closes in a ring
        rows = m + (kind == "square")
        i = np.arange(rows * (n + 1))
        node = np.stack([i // (n + 1), i % (n + 1)], 1)
        at = node / [m, n]
        at += random.uniform(-throw, throw, at.shape) / [m, n]
        for side in (0, 1, 0.5):  # moved along it; corners of the square stay
            on = node[:, 1] == side * n
            at[on, 1] = side
            if kind == "square":
                at[node[:, 0] == side * m, 0] = side
        self.kind, self.flat = kind, at
        if kind == "ring":
            turn, radius = 2 * np.pi * at[:, :1], 0.3 + 0.7 * at[:, 1:]
            self.flat = np.hstack([np.cos(turn), np.sin(turn)]) * radius
        base = i[(node[:, 0] < m) & (node[:, 1] < n)]
        right = (base + n + 1) % (rows * (n + 1))
        self.cells = np.concatenate([np.stack([base, right, right + 1], 1), np.stack([base, right + 1, base + 1], 1)])
        if kind == "ring":
            self.cells = self.cells[:, [0, 2, 1]]
        self.turn = np.array([[0.36, 0.48, 0.8], [-0.8, 0.6, 0.0]])
        self.x = self.flat @ self.turn
        self.centers = self.flat[self.cells].mean(axis=1)
        self.region = (at[self.cells, 1].mean(axis=1) > 0.5).astype(np.int32)
        self.ids = False

    def grid(self, chosen):
        used = np.unique(self.cells[chosen])
        grid = make_grid(self.x[used], np.searchsorted(used, self.cells[chosen]))
        add(grid.GetPointData(), "linear", self.flat[used] @ [1.0, 2.0])
        add(grid.GetPointData(), "corner", np.isin(used, 5 * 17).astype(np.int32))
        add(grid.GetCellData(), "region", self.region[chosen])
        return grid

    def piece(self):
        low, high = self.centers[:, 0].min(), self.centers[:, 0].max()
        return self.grid(np.minimum(((self.centers[:, 0] - low) / (high - low) * ranks).astype(int), ranks - 1) == rank)

    def whole(self):
        return self.grid(np.ones(len(self.cells), bool))

    def geometry(self, here=True):
        """Lines that the boundary and the interface lie on; without lines if not `here`."""
        lines, points = [], []
        for radius in (0.3, 0.65, 1.0):
            turn = 2 * np.pi * np.arange(200) / 200
            lines.append(np.arange(201) % 200 + 200 * len(lines))
            points.append(radius * np.stack([np.cos(turn), np.sin(turn)], 1) @ self.turn)
        data, cells, vtk_points = vtkPolyData(), vtkCellArray(), vtkPoints()
        vtk_points.SetData(numpy_to_vtk(np.concatenate(points), deep=1))
        data.SetPoints(vtk_points)
        for line in lines if here else []:
            cells.InsertNextCell(len(line), list(line))
        data.SetLines(cells)
        return data


def slide(curve, regions=True, corner=False, geometry=None, **options):
    """What is set before the run."""
    def set_all(f):
        f.SetBoundaryMode(vtkMeshOptimizeFilter.Slide)
        f.SetBoundaryCurve(curve)
        if regions:
            f.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_CELLS, "region")
        if corner:
            f.SetInputArrayToProcess(4, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "corner")
        if geometry is not None:
            f.SetInputData(1, geometry)
        for name, value in options.items():
            getattr(f, "Set" + name)(value)
    return set_all


def result_of(name, f, mesh):
    """All cells, as coordinates in the plane, with their regions; what every rank must say. Only for the first rank."""
    out = f.GetOutput()
    x = vtk_to_numpy(out.GetPoints().GetData()) if out.GetNumberOfPoints() else np.zeros((0, 3))
    cells = vtk_to_numpy(out.GetCells().GetConnectivityArray()).reshape(-1, 3)
    flat = x @ mesh.turn.T
    away = np.abs(x - flat @ mesh.turn).max(initial=0)
    error = np.abs(vtk_to_numpy(out.GetPointData().GetArray("linear")) - flat @ [1.0, 2.0]).max(initial=0)
    every = gather(cells=flat[cells], region=vtk_to_numpy(out.GetCellData().GetArray("region")),
                   figures=figures_of(f), error=np.array([error]))
    check(f.told == [], f"{name}: {f.told}")
    check(away < 1e-12, f"{name}: {away} away from the plane")
    check(len({tuple(row) for row in every["figures"]}) == 1, f"{name}: figures differ by rank")
    return np.concatenate(every["cells"]), np.concatenate(every["region"]), np.max(every["error"])


def ends_of(cells, region=None):
    """The ends of edges that one triangle has, or two of different regions; the greatest number of triangles at an edge."""
    e = np.sort(np.ascontiguousarray(cells[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2, 2) + 0.0).view("f8,f8").reshape(-1, 2), axis=1)
    e, inverse, count = np.unique(e.view("V32").ravel(), return_inverse=True, return_counts=True)
    chosen = count == 1
    if region is not None:
        sides = [np.isin(np.arange(len(e)), inverse[np.repeat(region == k, 3)]) for k in (0, 1)]
        chosen = sides[0] & sides[1]
    return e[chosen].view("f8").reshape(-1, 2, 2), count.max()


def area(cells):
    return np.cross(cells[:, 1] - cells[:, 0], cells[:, 2] - cells[:, 0]).sum() / 2


def is_closed(edges):
    """Whether every node has two of these edges."""
    ends = np.ascontiguousarray(edges.reshape(-1, 2)).view("V16").ravel()
    return (np.unique(ends, return_counts=True)[1] == 2).all()


def radius_of(edges):
    return np.linalg.norm(edges.reshape(-1, 2), axis=1)


def both(name, mesh, before, alone=None):
    """The run on all ranks, compared with one rank alone. Cells and regions on the first rank."""
    f = run(mesh.piece(), True, before)
    cells, region, error = result_of(name, f, mesh)
    if rank > 0:
        return None, None
    serial = run(mesh.whole(), False, alone or before)
    worst, alone = f.GetWorstQualityAfter(), serial.GetWorstQualityAfter()
    print(f"{name}: {f.GetWorstQualityBefore():.4f} -> {worst:.4f}, alone {alone:.4f}, {f.GetStopReasonAsString()}", flush=True)
    check(worst >= 0.98 * alone, f"{name}: worst {worst}, alone {alone}")
    check(f.GetQualityBound() == serial.GetQualityBound(), f"{name}: bound {f.GetQualityBound()}")
    check(np.cross(cells[:, 1] - cells[:, 0], cells[:, 2] - cells[:, 0]).min() > 0, f"{name}: inverted cells")
    edges, most = ends_of(cells)
    check(most == 2, f"{name}: an edge of {most} triangles")
    check(is_closed(edges), f"{name}: the boundary is not closed")
    old, new = ({tuple(x) for x in e.reshape(-1, 2)} for e in (ends_of(mesh.flat[mesh.cells])[0], edges))
    moved = len(new - old) / len(new)
    check(moved > 0.02, f"{name}: {moved} of the nodes on the boundary are new: the test is too easy")
    check(error < (1e-12 if mesh.kind == "square" else 0.02), f"{name}: field {error}")
    return cells, region


def test_square():
    """Straight sides: the same set of points to rounding, with all corners; the interface too."""
    mesh = Plane("square")
    for name, options in (("lines", {"TargetQuality": 0.8}), ("quick", {"Effort": 0}), ("best", {"Effort": 2})):
        cells, region = both(f"square, {name}", mesh, slide(LINES, **options))
        if rank > 0:
            continue
        check(abs(area(cells) - 1) < 1e-12, f"square, {name}: area {area(cells)}")
        points = cells.reshape(-1, 2)
        for corner in ((0, 0), (0, 1), (1, 0), (1, 1)):
            check((np.abs(points - corner).max(axis=1) < 1e-12).any(), f"square, {name}: corner {corner} is gone")
        at = ends_of(cells, region)[0][:, :, 1]
        check(len(at) and np.abs(at - 0.5).max() < 1e-12, f"square, {name}: interface at {at.min()} to {at.max()}")


def test_ring():
    """Splines through circles: nodes stay near them, and the area changes little."""
    mesh = Plane("ring")
    before = area(mesh.flat[mesh.cells])
    for name, options in (("spline", {}), ("best", {"Effort": 2})):
        cells, region = both(f"ring, {name}", mesh, slide(SPLINE, **options))
        if rank > 0:
            continue
        radius, middle = radius_of(ends_of(cells)[0]), radius_of(ends_of(cells, region)[0])
        away = np.minimum(np.abs(radius - 0.3), np.abs(radius - 1.0)).max()
        check(away < 1e-4 and np.abs(middle - 0.65).max() < 1e-4, f"ring, {name}: {away} away from the circles")
        check(abs(area(cells) / before - 1) < 0.01, f"ring, {name}: area {area(cells)}, before {before}")


def test_corner_array():
    """A point that the corner array marks stays, wherever it is."""
    mesh = Plane("ring")
    cells, _ = both("corner", mesh, slide(SPLINE, corner=True))
    if rank == 0:
        away = np.abs(cells.reshape(-1, 2) - mesh.flat[5 * 17]).max(axis=1).min()
        check(away < 1e-12, f"corner: {away} away")


def test_geometry():
    """The geometry on one rank alone, on all, or nowhere; and one that the mesh does not lie on."""
    mesh = Plane("ring")
    results = []
    for name, here in (("on one", rank == ranks - 1), ("on all", True)):
        cells, _ = both(f"geometry {name}", mesh, slide(SPLINE, geometry=mesh.geometry(here)), slide(SPLINE, geometry=mesh.geometry()))
        results.append(cells)
        if rank == 0:
            radius = radius_of(ends_of(cells)[0])
            away = np.minimum(np.abs(radius - 0.3), np.abs(radius - 1.0)).max()
            check(away < 1e-6, f"geometry {name}: {away} away from the circles")
    check(rank > 0 or np.array_equal(*results), "geometry: where it is makes a difference")
    f = run(mesh.piece(), True, slide(SPLINE, geometry=mesh.geometry(False)))
    check(f.GetErrorCode() != 0 and (rank > 0 or "no lines on any rank" in f.told[0]), f"no geometry: {f.told}")
    mesh.x *= 1.01
    f = run(mesh.piece(), True, slide(SPLINE, geometry=mesh.geometry()))
    mesh.x /= 1.01
    check(f.GetErrorCode() != 0 and len(f.told) == (rank == 0) and f.GetOutput().GetNumberOfCells() == 0, f"elsewhere: {f.told}")
    check(rank > 0 or "does not lie on the geometry" in f.told[0], f"elsewhere: {f.told}")


def test_division():
    """All cells on one rank, uneven pieces, and blocks."""
    mesh = Plane("square")
    before = slide(LINES, TargetQuality=0.8)
    nothing = mesh.grid(np.zeros(len(mesh.cells), bool))
    results = []
    for name, grid in (("one rank", mesh.whole() if rank == 0 else nothing),
                       ("uneven", mesh.grid((mesh.centers[:, 1] < 0.1) == (rank == 1)) if rank < 2 else nothing)):
        f = run(grid, True, before)
        cells, _, _ = result_of(name, f, mesh)
        check(f.GetWorstQualityAfter() > 0.75, f"{name}: {f.GetWorstQualityAfter()}")
        check(abs(area(cells) - 1) < 1e-12, f"{name}: area {area(cells)}")
        results.append(f.GetWorstQualityAfter())
    blocks = vtkMultiBlockDataSet()
    blocks.SetBlock(0, mesh.piece())
    blocks.SetBlock(1, Plane("ring").piece())
    f = vtkMeshOptimizeFilter()
    before(f)
    f.SetInputDataObject(blocks)
    f.UpdatePiece(rank, ranks, 0)
    check(f.GetErrorCode() == 0 and f.GetWorstQualityAfter() > 0.5, f"blocks: {f.GetWorstQualityAfter()}")


def test_errors():
    """What is not built is an error on all ranks, told once, and nothing comes out."""
    plane, body = Plane("square"), Mesh(n=4)
    for name, grid, before, text in (
            ("tetrahedra", body.piece(), slide(LINES, False), "the surface of tetrahedra slides on one rank only"),
            ("sizes", plane.piece(), slide(LINES, DesiredSize=0.1), "sizes or a metric are used"),
            ("below", plane.piece(), slide(LINES, OptimizeBelow=0.2), "cannot be used with OptimizeBelow")):
        f = run(grid, True, before)
        check(f.GetErrorCode() != 0 and f.GetOutput().GetNumberOfCells() == 0, f"{name}: no error")
        check(len(f.told) == (rank == 0) and all(text in told for told in f.told), f"{name}: {f.told}")


run_tests(globals())
