# SPDX-License-Identifier: BSD-3-Clause
"""Random solids (booleans of boxes, cylinders and spheres) whose surface takes part (Boundary Mode Slide): does what must hold hold?

    eval "$(./bootstrap.sh env)"
    /usr/bin/python3 Testing/Fuzz/fuzz_solids.py SEEDS [FIRST] [--judge FOLDER] [--output FOLDER] [--limit SECONDS]
                                                  [--scan] [--verbose]

Runs the seeds FIRST (0) ... FIRST + SEEDS - 1; each is a solid by Gmsh (python3-gmsh), some of two materials, its surface nodes
moved within flat faces or thrown, filled by TetGen without optimization (vtkTetGenFilter), sometimes with triangles that number
the faces of the solid, or lines that number the borders between them, and random options. Every line of output is a failure with its seed; --output writes input and output
there, and judges.txt says how it was judged. The exit status is 1 if anything failed. Each seed has a process of its own, so
that one that crashes, or takes twice the time limit (20 s), is a failure like any other. --scan: KeepFeatures off for all, and a
target that is seldom reached, so that ridges are given up. What is checked:

- no error; the output is a mesh of positive cells, no facet with three cells; the worst quality does not fall, nor that of the
  paper's formula; every tenth seed: the same bytes with one thread and with two;
- points sampled on the surface of before, interfaces included, are within the tolerance, and within what the filter proves
  (SurfaceDistance), of that of after, and the other way round; what is proved is within the tolerance;
- the volume of each region changes by no more than half the area of its surface times the tolerance, and the triangles that ride
  are those of the surface, their areas by face within what the tolerance allows (the border, and the curvature), and 1 %;
- the lines that ride are edges of the surface; those of each number, and their ends, are within the tolerance of those before;
- with --judge: check_surface.py, and check_patches.py where triangles ride, find no fault in FOLDER's opinion, and the distance
  that check_surface.py measures is no greater than what is proved. What check_patches.py says of areas does not count: it knows
  the border, not the curvature.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import time

import numpy as np
import riding_lines
from fuzz_filter import bytes_of, cell_lists, coordinates, make_filter, shape
from fuzz_surface import ROUNDING, farthest, surface, volumes
from solids import Solid, fill, grid_of, in_child, is_missing
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import VTK_TETRA, VTK_TRIANGLE
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

TIME_LIMIT_REACHED = 5


def write(grid, path):
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetFileName(str(path))
    writer.SetDataModeToBinary()
    writer.SetInputData(grid)
    writer.Write()


def area(points, triangles):
    t = points[triangles]
    return 0.5 * np.linalg.norm(np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0]), axis=1).sum()


def turning(points, triangles):
    """Sum over the inner edges of length times angle: times a distance, what moving by it may change the area by."""
    half = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    order = np.lexsort(half.T)
    half, owner = half[order], order // 3
    first = np.flatnonzero((half[1:] == half[:-1]).all(axis=1))
    t = points[triangles]
    normal = np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0])
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
    cosine = np.abs((normal[owner[first]] * normal[owner[first + 1]]).sum(axis=1))  # however they are turned
    return (np.linalg.norm(points[half[first, 0]] - points[half[first, 1]], axis=1) * np.arccos(np.clip(cosine, -1, 1))).sum()


def border_length(points, triangles):
    edges, count = np.unique(np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1), axis=0, return_counts=True)
    edges = edges[count != 2]
    return np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1).sum()


class Case:
    def __init__(self, seed, limit, scan=False):
        random = np.random.default_rng(seed)
        self.seed, self.failures, self.tries = seed, [], 0
        while True:
            self.tries += 1
            solid = Solid(random)
            if solid.fault:
                continue
            if random.random() < 0.7:
                solid.throw(random)
            filled, _ = fill(solid.points, solid.triangles, ratio=float(random.choice([0.0, 1.5, 2.0, 2.0])))
            if filled is None or not 100 <= len(filled[1]) <= 6000:
                continue
            points, cells, regions = filled
            for region in np.unique(regions):  # TetGen fills cavities, too
                mine = regions == region
                size = np.abs(volumes(points, cells[mine]))
                if size[solid.contains(points[cells[mine]].mean(axis=1))].sum() < 0.5 * size.sum():
                    regions[mine] = -1
            cells, regions = cells[regions >= 0], regions[regions >= 0]
            if len(cells):
                break
        self.text = solid.text
        used = np.unique(cells)
        local = np.full(len(points), -1)
        local[used] = np.arange(len(used))
        self.points, self.cells, self.regions = points[used], local[cells], regions
        if volumes(self.points, self.cells).sum() < 0:
            self.cells[:, [0, 1]] = self.cells[:, [1, 0]]
        riding = None
        if random.random() < 0.4:
            keep = (local[solid.triangles] >= 0).all(axis=1)
            if random.random() < 0.4:  # not all faces have triangles
                keep &= np.isin(solid.faces, random.permutation(np.unique(solid.faces))[::2])
            on = {tuple(x) for x in surface(self.points, self.cells, self.regions)[0].tolist()}
            riding = np.sort(local[solid.triangles[keep]], axis=1)
            there = np.array([tuple(x) in on for x in riding.tolist()], dtype=bool)
            riding, faces = riding[there], solid.faces[keep][there]
        self.has_triangles = riding is not None and len(riding) > 0
        self.grid = grid_of(self.points, self.cells, self.regions, *((riding, faces) if self.has_triangles else ()))
        self.options = {"Algorithm": 1, "BoundaryMode": 1, "SurfaceTolerance": float(random.choice([0.0, 1e-4, 1e-3, 1e-2])),
                        "Effort": int(random.choice([0, 1])), "TimeLimit": limit, "KeepFeatures": bool(random.random() < 0.8)}
        if random.random() < 0.3:
            self.options["QualityMeasure"] = int(random.integers(6))
        if random.random() < 0.3:
            self.options["GrowthBudget"] = float(random.choice([0.0, 0.5]))
        if random.random() < 0.2:
            self.options["FeatureAngle"] = self.options["CornerAngle"] = float(random.choice([30, 60]))
        if scan:
            self.options.update({"KeepFeatures": False, "TargetQuality": 0.7})
        self.arrays = {"RegionArray": "Region"} if len(np.unique(self.regions)) > 1 or random.random() < 0.3 else {}
        if self.has_triangles and random.random() < 0.7:
            self.arrays["PatchArray"] = "Face"
        if "RegionArray" not in self.arrays:
            self.text += ", regions not told"
        self.text += f", {len(np.unique(self.regions))} regions" + (", triangles" if self.has_triangles else "")
        self.lines = None
        if random.random() < 0.3:  # last: the seeds of before lines keep their solids
            self.add_lines(random, solid, local)

    def add_lines(self, random, solid, local):
        there = (local[solid.triangles] >= 0).all(axis=1)
        edges, numbers = riding_lines.borders(random, local[solid.triangles[there]], solid.faces[there])
        if len(edges):
            self.lines = (self.points, edges, numbers)
            riding_lines.add(self.grid, edges, numbers)
            self.arrays["PatchArray"] = "Face"
            self.text += ", lines"

    def check(self, good, text):
        if not good:
            self.failures.append(text)

    def run(self):
        start = time.time()
        f = make_filter(self.grid, self.options, self.arrays, 1)
        self.seconds = time.time() - start
        self.output, self.stop = f.GetOutput(), f.GetStopReasonAsString()
        self.check(not f.messages["ErrorEvent"], f"error {f.messages['ErrorEvent'][:1]}")
        if f.messages["ErrorEvent"]:
            return
        self.is_late = f.GetStopReason() == TIME_LIMIT_REACHED
        self.check(self.seconds < 1.5 * self.options["TimeLimit"] + 2, f"{self.seconds:.0f} s, limit {self.options['TimeLimit']:g}")
        if self.seed % 10 == 0 and not self.is_late:
            self.check(bytes_of(self.output) == bytes_of(make_filter(self.grid, self.options, self.arrays, 2).GetOutput()),
                       "two threads, other bytes")
        regions0 = self.regions if "RegionArray" in self.arrays else np.zeros(len(self.cells), dtype=int)
        points, (cells, ids) = coordinates(self.output), cell_lists(self.output, VTK_TETRA)
        regions = vtk_to_numpy(self.output.GetCellData().GetArray("Region"))[ids] if "RegionArray" in self.arrays else np.zeros(len(cells))
        was_tangled = volumes(self.points, self.cells).min() <= 0
        self.check(was_tangled or volumes(points, cells).min() > 0, f"{(volumes(points, cells) <= 0).sum()} inverted cells")
        self.check(f.GetNumberOfInvertedCellsAfter() <= f.GetNumberOfInvertedCellsBefore(), "more inverted cells")
        self.before, self.after = f.GetWorstQualityBefore(), f.GetWorstQualityAfter()
        self.check(self.after >= self.before, f"the worst quality fell from {self.before:.6g} to {self.after:.6g}")
        if self.options.get("QualityMeasure", 0) == 0:
            own = shape(points[cells]).min()
            self.check(own >= shape(self.points[self.cells]).min() - 1e-12, "the worst quality fell, by the formula")
            self.check(abs(own - self.after) < 1e-9, f"worst quality {self.after:.9g} reported, {own:.9g} by the formula")
        old, new = surface(self.points, self.cells, regions0), surface(points, cells, regions)
        self.check(not new[1], "a facet with three cells")
        diagonal = np.linalg.norm(np.ptp(self.points, axis=0))
        rounding = ROUNDING * (1 + np.abs(self.points).max() / diagonal) * diagonal
        limit = max(self.options["SurfaceTolerance"] * diagonal, rounding)
        self.proved = f.GetSurfaceDistance()
        self.check(self.proved <= limit, f"proved {self.proved / diagonal:.3g}")
        # Facets of both meshes, bit for bit, are at distance 0.
        rows = [{tuple(sorted(map(tuple, x))): k for k, x in enumerate(p[t].tolist())} for p, (t, _) in ((self.points, old), (points, new))]
        fresh = [np.array([k for x, k in rows[i].items() if x not in rows[1 - i]], dtype=int) for i in (0, 1)]
        there = farthest(points, new[0][fresh[1]], self.points, old[0], 4)
        back = farthest(self.points, old[0][fresh[0]], points, new[0], 4)
        self.check(max(there, back) <= self.proved * (1 + 1e-9) + 10 * rounding,
                   f"distance {there / diagonal:.3g} there, {back / diagonal:.3g} back, proved {self.proved / diagonal:.3g}")
        self.changed = bool(len(fresh[0]) or len(fresh[1]))
        for region in np.unique(regions0):
            own = surface(self.points, self.cells[regions0 == region], regions0[regions0 == region])[0]
            allowed = 0.5 * area(self.points, own) * limit
            change = volumes(points, cells[regions == region]).sum() - volumes(self.points, self.cells[regions0 == region]).sum()
            self.check(abs(change) <= allowed, f"volume of region {region} changed by {change:.3g}, {allowed:.3g} allowed")
        if self.has_triangles:
            self.check_riding(points, new[0], limit)
        if self.lines:
            for fault in riding_lines.faults(self.lines, (points, *riding_lines.of(self.output)), new[0], limit):
                self.check(False, fault)

    def check_riding(self, points, facets, limit):
        on = {tuple(x) for x in np.sort(facets, axis=1).tolist()}
        (t0, ids0), (t1, ids1) = cell_lists(self.grid, VTK_TRIANGLE), cell_lists(self.output, VTK_TRIANGLE)
        keys = [tuple(x) for x in np.sort(t1, axis=1).tolist()]
        self.check(all(k in on for k in keys), f"{sum(k not in on for k in keys)} triangles not on the surface")
        self.check(len(set(keys)) == len(keys), "a triangle twice")
        faces0, faces1 = (vtk_to_numpy(g.GetCellData().GetArray("Face"))[i] for g, i in ((self.grid, ids0), (self.output, ids1)))
        self.check(set(faces0) == set(faces1), f"faces {sorted(set(faces0) ^ set(faces1))} came or went")
        for face in np.unique(faces0):
            one, other = area(self.points, t0[faces0 == face]), area(points, t1[faces1 == face])
            reach = sum(f(self.points, t0[faces0 == face]) for f in (border_length, turning))
            self.check(abs(one - other) <= limit * reach + 0.01 * one,
                       f"face {face}: area {one:.4g} became {other:.4g}")

    def judge(self, judges, folder):
        """What the judges say, who know nothing of the project."""
        folder.mkdir(parents=True, exist_ok=True)
        before, after = folder / f"seed{self.seed}-before.vtu", folder / f"seed{self.seed}-after.vtu"
        write(self.grid, before)
        write(self.output, after)
        tolerance = max(self.options["SurfaceTolerance"], 1e-12)
        angle = self.options.get("FeatureAngle", 45.0)
        surface_judge = [sys.executable, judges / "check_surface.py", after, "--before", before, "--tolerance", tolerance, "--json",
                         "--angle", angle if self.options["KeepFeatures"] else 180.0]
        if "RegionArray" in self.arrays:
            surface_judge += ["--region", "Region"]
        commands = [surface_judge]
        if self.has_triangles:
            commands.append([sys.executable, judges / "check_patches.py", after, "--before", before, "--tolerance", tolerance, "--json",
                             "--array", "Face"])
        for command in commands:
            said = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
            self.check(said.returncode in (0, 1), f"{command[1].name}: {said.stderr[-200:]}")
            result = json.loads(said.stdout) if said.returncode in (0, 1) and said.stdout else {"faults": []}
            for fault in result["faults"]:
                if command[1].name != "check_patches.py" or ": area " not in fault:  # see check_riding()
                    self.check(False, f"{command[1].name}: {fault}")
            if "hausdorff" in result:
                measured = result["hausdorff"] * result["diagonal"]
                self.check(measured <= self.proved * (1 + 1e-9) + 1e-12 * result["diagonal"],
                           f"check_surface.py: distance {result['hausdorff']:.3g}, proved {self.proved / result['diagonal']:.3g}")
        if self.failures:
            with open(folder / "judges.txt", "a", encoding="utf-8") as file:
                for command in commands:
                    file.write(" ".join(map(str, command)).replace("--json ", "") + "\n")
        else:
            before.unlink()
            after.unlink()


def run(seed, opt):
    case = Case(seed, opt.limit, opt.scan)
    what = f"{case.text}; {len(case.cells)} cells; {case.options}; {case.arrays}"
    if opt.verbose:
        print(f"seed {seed}: {what}", flush=True)
    case.run()
    if opt.judge and hasattr(case, "changed"):
        case.judge(opt.judge, opt.output)
    elif case.failures and opt.output:
        opt.output.mkdir(parents=True, exist_ok=True)
        write(case.grid, opt.output / f"seed{seed}-before.vtu")
        write(case.output, opt.output / f"seed{seed}-after.vtu")
    figures = {"before": case.before, "after": case.after, "cells": len(case.cells), "seconds": case.seconds, "changed": case.changed,
               "stop": case.stop, "late": case.is_late} if hasattr(case, "changed") else None
    return what, case.failures, figures


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("seeds", type=int)
    parser.add_argument("first", type=int, nargs="?", default=0)
    parser.add_argument("--judge", type=pathlib.Path)
    parser.add_argument("--output", type=pathlib.Path)
    parser.add_argument("--limit", type=float, default=20.0)
    parser.add_argument("--scan", action="store_true")
    parser.add_argument("--verbose", action="store_true")
    opt = parser.parse_args()
    if is_missing():
        sys.exit(is_missing())
    if opt.judge and not opt.output:
        parser.error("--judge needs --output")
    failed, changed, late, slowest = 0, 0, 0, (0.0, opt.first)
    for seed in range(opt.first, opt.first + opt.seeds):
        done, fault = in_child(lambda seed=seed: run(seed, opt), 60 + 4 * opt.limit)
        what, failures, figures = done or ("", [fault], None)
        failed += bool(failures)
        for failure in failures[:4]:
            print(f"FAILED seed {seed} ({what}): {failure}", flush=True)
        if figures:
            changed += figures["changed"]
            late += figures["late"]
            slowest = max(slowest, (figures["seconds"], seed))
            if opt.verbose:
                print(f"seed {seed}: {figures['before']:.4f} -> {figures['after']:.4f}, {figures['seconds']:.2f} s, {figures['stop']}", flush=True)
    print(f"{opt.seeds} seeds, {failed} failed, surface changed in {changed}, {late} at the time limit, "
          f"slowest {slowest[0]:.1f} s (seed {slowest[1]})")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
