# SPDX-License-Identifier: BSD-3-Clause
"""Random triangle meshes through vtkMeshOptimizeFilter: sliding boundaries, geometries, sizes and metrics.

    eval "$(./bootstrap.sh env)"
    /usr/bin/python3 Testing/Fuzz/fuzz_boundary.py FIRST COUNT [--limit SECONDS] [--verbose]

As fuzz_filter.py, which is about what is kept. What is checked here:

- unusable sizes, tensors and geometries give one error and empty outputs; a geometry that may or may not fit gives either that or
  a mesh; all else a mesh;
- the input is not touched; the output is a mesh, and has all arrays of the input;
- no cell gets inverted, the worst quality does not fall (where sizes are followed: not under the target);
- the boundary stays on its curves, the side of the mesh and its topology (pieces, holes, regions) are as before;
- fixed points and corners are where they were;
- the same bytes with one thread and with two.
"""
import argparse
import sys

import numpy as np
from fuzz_filter import Checks, bytes_of, cell_lists, coordinates, make_filter, set_measure_and_switches
from fuzz_meshes import base, grid_of, regions_of, spoil, tilt, valid
from meshoptimize import vtkMeshOptimizeFilter
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TRIANGLE, vtkCellArray, vtkPolyData, vtkUnstructuredGrid


def ring(random):
    """A disc, or with a hole; some edges of the circle may be long."""
    n = int(random.integers(3, 40))
    angles = 2.0 * np.pi * (np.arange(n) if random.random() < 0.5 else np.sort(random.random(n) * n)) / n
    circle = np.c_[np.cos(angles), np.sin(angles) * random.choice([1.0, 0.3]), np.zeros(n)]
    following = (np.arange(n) + 1) % n
    if random.random() < 0.5:
        return np.r_[circle, [[0.0, 0.0, 0.0]]], np.c_[np.arange(n), following, np.full(n, n)], f"disc of {n}"
    cells = np.r_[np.c_[np.arange(n), following, n + np.arange(n)], np.c_[following, n + following, n + np.arange(n)]]
    return np.r_[circle, random.choice([0.1, 0.5, 0.95]) * circle], cells, f"ring of {n}"


def plane_mesh(random):
    points, cells, text = ring(random) if random.random() < 0.3 else base(random, 2)
    cells = valid(cells)
    if random.random() < 0.6:
        points, cells, text = spoil(random, points, cells, text)
    if random.random() < 0.3:
        points, text = tilt(random, points), text + ", tilted"
    mesh = {"dimension": 2, "points": points, "cells": cells, "others": [], "regions": None, "fixed": None, "text": text}
    if len(cells) and random.random() < 0.25:
        mesh["regions"] = regions_of(random, points, cells)
    if random.random() < 0.15:
        mesh["fixed"] = random.random(len(points)) < random.choice([0.1, 0.5])
    return mesh


def kept_edges(cells, regions):
    """Edges with one cell, or between two regions, as sorted pairs."""
    use = {}
    for c, cell in enumerate(cells):
        for i in range(3):
            use.setdefault(tuple(sorted((int(cell[i]), int(cell[i - 1])))), []).append(regions[c])
    return [e for e, u in use.items() if len(u) == 1 or len(set(u)) > 1], use


GEOMETRIES = {  # whether it must be an error
    "own": False, "own, as polylines": False, "own, halved": False, "own, spoiled by rounding": False, "own, jittered": False,
    "branches": False, "gaps": False, "noise": False, "closed loop": False, "degenerate lines": False, "empty": True, "no lines": True,
    "one point": True, "far": True, "not finite": True, "no such point": True, "off the plane": True}


def geometry_of(random, mesh, kind):
    x = mesh["points"]
    regions = mesh["regions"] if mesh["regions"] is not None else np.zeros(len(mesh["cells"]))
    edges = [list(e) for e in kept_edges(mesh["cells"], regions)[0]]
    random.shuffle(edges)
    extent = np.ptp(x, axis=0).max()
    points, lines = x.copy(), edges
    if kind == "own, as polylines":
        lines = []
        for e in edges:
            if lines and lines[-1][-1] == e[0]:
                lines[-1].append(e[1])
            else:
                lines.append(list(e))
    elif kind == "own, halved":
        points = np.r_[x, [(x[a] + x[b]) / 2.0 for a, b in edges]]
        lines = [[a, len(x) + k, b] for k, (a, b) in enumerate(edges)]
    elif kind == "own, spoiled by rounding":
        points = np.float32(points)
    elif kind == "own, jittered":
        u, v = x[mesh["cells"][0][1]] - x[mesh["cells"][0][0]], x[mesh["cells"][0][2]] - x[mesh["cells"][0][0]]
        points = points + random.choice([1e-5, 1e-3, 0.1]) * (random.normal(size=(len(x), 1)) * u + random.normal(size=(len(x), 1)) * v)
    elif kind == "branches":
        lines = edges + [[int(i) for i in random.integers(len(x), size=2)] for _ in range(3)]
    elif kind == "gaps":
        lines = edges[:int(len(edges) * random.choice([0.1, 0.5, 0.9]))] or edges
    elif kind == "noise":
        lines = [[int(i) for i in random.integers(len(x), size=random.integers(2, 9))] for _ in range(int(random.integers(1, 9)))]
    elif kind == "closed loop":
        used = sorted({p for e in edges for p in e})
        lines = [used + used[:1]]
    elif kind == "degenerate lines":
        lines = edges + [[edges[0][0]] * 2, [edges[0][0]], [], edges[0][::-1], edges[0]]
    elif kind == "one point":
        lines = [[0, 0]]
    elif kind in ("empty", "no lines"):
        lines = []
        points = points if kind == "no lines" else points[:0]
    elif kind == "far":
        edge = x[mesh["cells"][0][1]] - x[mesh["cells"][0][0]]
        points = points + 10.0 * extent * edge / max(np.linalg.norm(edge), 1e-300)
    elif kind == "not finite":
        points[lines[0][0], int(random.integers(3))] = random.choice([np.nan, np.inf, -np.inf])
    elif kind == "no such point":
        lines = lines + [[lines[0][0], int(random.choice([-1, len(x), 2 ** 40]))]]
    elif kind == "off the plane":
        e1, e2 = x[mesh["cells"][0][1]] - x[mesh["cells"][0][0]], x[mesh["cells"][0][2]] - x[mesh["cells"][0][0]]
        n = np.cross(e1, e2)
        points[lines[0][0]] += extent * n / max(np.linalg.norm(n), 1e-300)
    poly, p, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    p.SetDataTypeToDouble()
    for y in points:
        p.InsertNextPoint(y)
    for line in lines:
        cells.InsertNextCell(len(line), line)
    if kind != "empty":
        poly.SetPoints(p)
        poly.SetLines(cells)
    if random.random() < 0.2 and kind != "empty":
        array = numpy_to_vtk((random.random(len(points)) < 0.2).astype(np.int8), deep=1)
        array.SetName("corner")
        poly.GetPointData().AddArray(array)
    return poly


def random_options(random, mesh, extent):
    options = {"TargetQuality": float(random.choice([0.3, 0.6, 0.6, 0.9])), "Effort": int(random.choice([0, 1, 1, 2])),
               "BoundaryMode": int(random.random() < 0.85), "BoundaryCurve": int(random.random() < 0.6),
               "CornerAngle": float(random.choice([0.0, 10.0, 45.0, 45.0, 90.0, 180.0]))}
    set_measure_and_switches(random, options, 0.3, 0.1)
    if random.random() < 0.6:
        options["Beta"] = float(random.choice([0.3, 1.0, 2.0]))
    if random.random() < 0.8 or "Beta" in options:
        options["DesiredSize"] = float(extent / random.choice([0.5, 3.0, 10.0, 25.0]))
    arrays = {}
    for name, array, share in (("SizeArray", "size", 0.4), ("MetricArray", "metric", 0.35), ("CornerArray", "corner", 0.15)):
        if random.random() < share:
            arrays[name] = array
    if mesh["regions"] is not None:
        arrays["RegionArray"] = "region"
    if mesh["fixed"] is not None:
        arrays["FixedPointArray"] = "fixed"
    if "MetricArray" in arrays and "DesiredSize" in options:
        options["DesiredSize"] = float(random.choice([1.0, 0.3, 0.1]))  # in the metric
    return options, arrays


def distance_to_lines(x, ends):
    """Of each point to the nearest of the segments [m, 2, 3]."""
    result = np.full(len(x), np.inf)
    for a, b in ends:
        d = b - a
        t = np.clip((x - a) @ d / max(d @ d, 1e-300), 0.0, 1.0)
        result = np.minimum(result, np.linalg.norm(a + t[:, None] * d - x, axis=1))
    return result


class Case(Checks):
    def __init__(self, seed, limit):
        random = np.random.default_rng([seed, 2])
        self.mesh = plane_mesh(random)
        while not len(self.mesh["cells"]):
            self.mesh = plane_mesh(random)
        self.grid = grid_of(self.mesh, random)
        extent = max(np.ptp(self.mesh["points"], axis=0).max(), 1e-300)
        self.extent = extent
        self.options, self.arrays = random_options(random, self.mesh, extent)
        self.slides = self.options["BoundaryMode"] == 1
        if "MetricArray" in self.arrays:  # sizes are in its units, then
            size = self.grid.GetPointData().GetArray("size")
            for p in range(size.GetNumberOfTuples()):
                size.SetValue(p, size.GetValue(p) / extent)
        self.options["TimeLimit"] = limit
        corner = numpy_to_vtk((random.random(len(self.mesh["points"])) < 0.2).astype(float), deep=1)
        corner.SetName("corner")
        self.grid.GetPointData().AddArray(corner)
        self.kind, self.must_fail, self.failures = "", False, []
        self.spoil_values(random)
        if self.slides and random.random() < 0.4:
            self.kind = str(random.choice(list(GEOMETRIES)))
            self.options["GeometryData"] = geometry_of(random, self.mesh, self.kind)
            if not self.must_fail:
                self.must_fail = True if GEOMETRIES[self.kind] else None  # a mesh folded onto itself may have no curves to follow

    def spoil_values(self, random):
        used = self.mesh["cells"][random.integers(len(self.mesh["cells"]))][0]
        self.fault = ""
        if random.random() < 0.05:
            size = self.grid.GetPointData().GetArray("size")
            size.SetValue(int(used), float(random.choice([0.0, -1.0, np.nan, np.inf])))
            uses = "SizeArray" in self.arrays and (self.slides or self.options.get("Beta", 0) > 0)
            self.fault, self.must_fail = "size", uses
        elif random.random() < 0.05:
            metric = self.grid.GetPointData().GetArray("metric")
            component, value = [(0, -1.0), (4, 0.0), (1, np.nan), (8, np.inf), (3, 1e30)][random.integers(5)]
            metric.SetComponent(int(used), int(component), value)
            self.fault, self.must_fail = "metric", "MetricArray" in self.arrays or False
            if self.must_fail and abs(value) <= 1.0:
                self.must_fail = None  # in the plane of the mesh it may still be one

    def run(self):
        before = vtkUnstructuredGrid()
        before.DeepCopy(self.grid)
        f = self.f = make_filter(self.grid, self.options, self.arrays, 1)
        self.seconds = f.GetOptimizeSeconds()
        errors, warnings = f.messages["ErrorEvent"], f.messages["WarningEvent"]
        self.failed = bool(errors)
        self.check(bytes_of(before) == bytes_of(self.grid), "the input changed")
        self.check(bool(errors) == (f.GetErrorCode() != 0) and len(errors) < 2, f"errors {errors}, code {f.GetErrorCode()}")
        self.check(len(warnings) <= 3, "more than three warnings")
        if self.must_fail is not None and not any("1e8" in e for e in errors):
            self.check(bool(errors) == self.must_fail, f"errors {errors}, expected {self.must_fail}")
        if errors:
            self.check(f.GetOutput().GetNumberOfCells() == 0 and f.GetOutput().GetNumberOfPoints() == 0, "output is not empty")
            return
        if f.GetStopReason() == vtkMeshOptimizeFilter.TimeLimitReached:
            self.failures.append("too slow")
            return
        self.check_two_threads()
        self.check_figures()
        self.check_arrays()
        self.check_shape()

    def check_figures(self):
        f = self.f
        worst, now = f.GetWorstQualityBefore(), f.GetWorstQualityAfter()
        sizes = ("DesiredSize" in self.options or "SizeArray" in self.arrays) and (self.slides or self.options.get("Beta", 0) > 0)
        self.check(now >= (min(worst, self.options["TargetQuality"]) if sizes else worst), f"the worst quality fell from {worst} to {now}")
        quality = vtk_to_numpy(f.GetOutput().GetCellData().GetArray("MeshQuality"))
        self.check(np.nanmin(quality) == now, f"least MeshQuality {np.nanmin(quality)}, reported {now}")
        self.check(not np.isnan(quality).any(), "MeshQuality is not a number")
        self.check(f.GetNumberOfInvertedCellsBefore() > 0 or f.GetNumberOfInvertedCellsAfter() == 0, "cells got inverted")
        share = f.GetEdgeLengthShare()
        self.check(0.0 <= share <= 1.0, f"share of edges {share}")

    def check_arrays(self):
        out = self.f.GetOutput()
        for mine, its, count in ((self.grid.GetPointData(), out.GetPointData(), out.GetNumberOfPoints()),
                                 (self.grid.GetCellData(), out.GetCellData(), out.GetNumberOfCells())):
            for i in range(mine.GetNumberOfArrays()):
                a = mine.GetArray(i)
                b = its.GetArray(a.GetName())
                self.check(b is not None and b.GetDataType() == a.GetDataType() and b.GetNumberOfComponents() == a.GetNumberOfComponents()
                           and b.GetNumberOfTuples() == count, f"array {a.GetName()} is lost")

    def topology(self, grid):
        """Of the cells: ids, region by region Euler characteristic; boundary lines at points."""
        cells, ids = cell_lists(grid, VTK_TRIANGLE)
        regions = np.zeros(len(ids), dtype=np.int64)
        if "RegionArray" in self.arrays:
            regions = vtk_to_numpy(grid.GetCellData().GetArray("region"))[ids]
        kept, use = kept_edges(cells, regions)
        self.check(max(len(u) for u in use.values()) <= 2, "an edge with three cells")
        self.check((np.diff(np.sort(cells, axis=1), axis=1) > 0).all(), "a point twice in a cell")
        self.check(len(np.unique(np.sort(cells, axis=1), axis=0)) == len(cells), "a cell twice")
        euler = {}
        for r in np.unique(regions):
            own = cells[regions == r]
            edges = {tuple(sorted((int(c[i]), int(c[i - 1])))) for c in own for i in range(3)}
            euler[int(r)] = len(np.unique(own)) - len(edges) + len(own)
        at = {}
        for e in kept:
            for p in e:
                at[p] = at.get(p, 0) + 1
        return cells, ids, regions, kept, euler, sorted(n for n in at.values() if n != 2), coordinates(grid)

    def check_shape(self):
        f = self.f
        cells, _, regions, kept, euler, branches, x = self.topology(self.grid)
        cells2, _, regions2, kept2, euler2, branches2, y = self.topology(f.GetOutput())
        self.check(euler == euler2, f"Euler characteristics of regions {euler} became {euler2}")
        self.check(branches == branches2, "points where boundaries meet changed")
        ends, ends2 = x[np.array(kept)], y[np.array(kept2)]
        if not self.slides:
            before, after = (sorted(tuple(sorted(map(tuple, line))) for line in lines) for lines in (ends, ends2))
            self.check(before == after, "the kept boundary changed")
        elif not self.kind:
            longest = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).max()
            share = 1.2 * 0.5 * np.tan(np.radians(self.options["CornerAngle"]) / 4.0) if self.options["BoundaryCurve"] else 0.0
            away = distance_to_lines(ends2.reshape(-1, 3), ends).max()
            size = np.abs(x).max()
            self.check(away <= share * longest + 1e-9 * self.extent + 1e-13 * size, f"the boundary went {away} away (extent {self.extent})")
        places = {tuple(p) for p in y[np.unique(cells2)]}
        stay = np.zeros(len(x), dtype=bool)
        if "FixedPointArray" in self.arrays:
            stay |= self.mesh["fixed"]
        on_boundary = np.isin(np.arange(len(x)), np.array(kept))
        if "CornerArray" in self.arrays and self.slides and not self.kind:
            stay |= on_boundary & (vtk_to_numpy(self.grid.GetPointData().GetArray("corner")) != 0)
        stay &= np.isin(np.arange(len(x)), cells)
        self.check(all(tuple(p) in places for p in x[stay]), "a fixed point or a corner is gone")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("first", type=int)
    parser.add_argument("count", type=int)
    parser.add_argument("--limit", type=float, default=60.0)
    parser.add_argument("--verbose", action="store_true")
    opt = parser.parse_args()
    failed, refused, slowest, operations = 0, 0, (0.0, opt.first), 0
    for seed in range(opt.first, opt.first + opt.count):
        case = Case(seed, opt.limit)
        text = f"{case.mesh['text']}; {len(case.mesh['cells'])} cells; {case.options} {case.arrays} {case.fault} {case.kind}"
        if opt.verbose:
            print(f"seed {seed}: {text}", flush=True)
        case.run()
        slowest = max(slowest, (case.seconds, seed))
        refused += case.failed
        operations += case.f.GetNumberOfOperations()
        for failure in case.failures[:3]:
            print(f"FAILED seed {seed} ({text}): {failure}", flush=True)
        failed += bool(case.failures)
    print(f"{opt.count} seeds, {failed} failed, {refused} refused, {operations} operations, slowest {slowest[0]:.1f} s (seed {slowest[1]})")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
