# SPDX-License-Identifier: BSD-3-Clause
"""Meshes that are hard for an optimizer: Delaunay meshes of random points, and files. Quality and time, as Markdown tables.

    eval "$(./bootstrap.sh env)"
    /usr/bin/python3 Testing/Benchmarks/hard.py [MESH.vtu ...] [options]

    --kinds KIND ...     of: cube ball slab sphere clusters lattice1e-6 lattice1e-3 lattice.1 lattice.2, or none (default: all)
    --sizes N ...        points of each, about (default: 1000)
    --seeds N ...        default: 1
    --delaunay NAME      scipy or vtk (vtkDelaunay3D, whose hull is not convex); default: scipy
    --effort NAME ...    of: quick default best (default: quick default)
    --limit SECONDS      of processor time for one run, which is then aborted; default 0: none. What was aborted is not the
                         same in every run
    --threads N          optimize again with N threads: the same bytes?
    --judge PROGRAM      called as  PROGRAM AFTER.vtu --before BEFORE.vtu; exit status 0: no fault
    --output FOLDER      where meshes are written for the judge (default: a temporary one)
    --json FILE          writes the results after each run; those of other runs that FILE holds are kept
    --note TEXT          kept in that file, as which engine it was
    --compare FILE       the same runs in an earlier file, side by side

The points are uniform in a cube, a ball or a slab (1 : 1 : .01), near a sphere's surface (.01 of its radius, normally
distributed), normally distributed in two clusters, and a lattice whose points are perturbed by up to that many edges. The
surface is kept. Cells whose volume is exactly zero are left out and counted; all others get a positive volume by their
numbering.

One thread. Time is the processor time of the filter's Update(), per tetrahedron of the input. A bare pass computes the
quality of each tetrahedron once; it is measured over the input just before each run (bare_pass.py, by a C++ compiler).
Evaluations are those that the engine counts (GetNumberOfEvaluations), if it does.

The exit status is 1 if a judge found a fault, if bytes differ, or if a worst quality is less than that of the input; with
--compare also if a worst quality fell by more than 1 %, if cells under .2 rose, or if a mesh is not the earlier one.
"""
import argparse
import hashlib
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np
from bare_pass import bare_pass, program
from digests import digest
from invariance import grid_of, read
from meshoptimize import vtkMeshOptimizeFilter
from optimize_meshes import EFFORTS, write
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkDelaunay3D

KINDS = ["cube", "ball", "slab", "sphere", "clusters", "lattice1e-6", "lattice1e-3", "lattice.1", "lattice.2"]
POOR = 0.2


def cloud(kind, n, seed):
    """Random points [n, 3]."""
    random = np.random.default_rng(seed)
    if kind.startswith("lattice"):
        row = np.arange(max(2, round(n ** (1 / 3))))
        x = np.stack(np.meshgrid(row, row, row, indexing="ij"), axis=-1).reshape(-1, 3).astype(float)
        return x + float(kind[len("lattice"):]) * random.uniform(-1, 1, size=x.shape)
    if kind in ("cube", "slab"):
        return random.random((n, 3)) * (1, 1, 0.01 if kind == "slab" else 1)
    x = random.normal(size=(n, 3))
    if kind == "clusters":
        x *= 0.1
        x[n // 2:, 0] += 1
        return x
    x /= np.linalg.norm(x, axis=1)[:, None]
    return x * (random.random((n, 1)) ** (1 / 3) if kind == "ball" else 1 + 0.01 * random.normal(size=(n, 1)))


def delaunay_by_scipy(points):
    try:
        from scipy.spatial import Delaunay
    except ImportError:
        sys.exit("scipy is missing (Debian's package: python3-scipy); --delaunay vtk needs none")
    return Delaunay(points).simplices.astype(np.int64)


def delaunay_by_vtk(points):
    poly, x = vtkPolyData(), vtkPoints()
    x.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=1))
    poly.SetPoints(x)
    f = vtkDelaunay3D()
    f.SetInputData(poly)
    f.SetTolerance(0.0)
    f.SetOutputPointsPrecision(vtkDelaunay3D.DOUBLE_PRECISION)
    f.Update()
    made = f.GetOutput()
    if made.GetNumberOfCells() == 0:
        raise ValueError("vtkDelaunay3D has made no cell")
    types = np.array([made.GetCellType(c) for c in range(made.GetNumberOfCells())])
    if (types != VTK_TETRA).any() or made.GetNumberOfPoints() != len(points):
        raise ValueError("vtkDelaunay3D has made more than tetrahedra of the points")
    return vtk_to_numpy(made.GetCells().GetConnectivityArray()).reshape(-1, 4).astype(np.int64)


def random_mesh(kind, size, seed, how):
    """Points, cells of positive volume, and how many of none were left out."""
    x = cloud(kind, size, seed)
    cells = delaunay_by_vtk(x) if how == "vtk" else delaunay_by_scipy(x)
    a, b, c, d = (x[cells[:, i]] for i in range(4))
    volume = np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a)
    cells[volume < 0] = cells[volume < 0][:, [1, 0, 2, 3]]
    return x, cells[volume != 0], int(np.count_nonzero(volume == 0))


def inputs(opt):
    """Name, points, cells and left out cells of each mesh."""
    for kind in opt.kinds if "none" not in opt.kinds else []:
        for size in opt.sizes:
            for seed in opt.seeds:
                name = f"{kind} {size} {seed}" + (" vtk" if opt.delaunay == "vtk" else "")
                try:
                    yield (name, *random_mesh(kind, size, seed, opt.delaunay))
                except ValueError as fault:
                    print(f"{name}: {fault}", file=sys.stderr)
    for path in opt.mesh:
        yield (pathlib.Path(path).stem, *read(path), 0)


def optimize(grid, effort, limit, threads):
    """The filter, and its processor seconds."""
    f = vtkMeshOptimizeFilter()
    f.SetInputData(grid)
    f.SetEffort(EFFORTS[effort])
    f.SetNumberOfThreads(threads)
    start = time.process_time()
    if limit > 0.0:  # not TimeLimit, which is by the clock: other programs may have the processor
        f.AddObserver("ProgressEvent", lambda *_: f.SetAbortExecute(time.process_time() - start > limit))
    f.Update()
    return f, time.process_time() - start


def faults_of_judge(judge, before, after, folder, name):
    """What the judge says is wrong, or an empty text."""
    files = [folder / f"{name.replace(' ', '-')}{end}.vtu" for end in ("", "-before")]
    for path, grid in zip(files, (after, before)):
        write(grid, path)
    command = [sys.executable] if judge.endswith(".py") else []
    judged = subprocess.run([*command, judge, files[0], "--before", files[1]], capture_output=True, text=True, check=False)
    if judged.returncode == 0:
        return ""
    lines = (judged.stdout + judged.stderr).splitlines()
    return "; ".join([line for line in lines if "FAULT" in line] or lines[-1:]) or "FAULT"


def run(name, mesh, effort, opt, folder):
    """The results of one run, as they are in the file."""
    points, cells, left_out = mesh
    grid = grid_of(points, cells)
    bare = bare_pass(points, cells)
    f, seconds = optimize(grid, effort, opt.limit, 1)
    quality = vtk_to_numpy(f.GetOutput().GetCellData().GetArray("MeshQuality"))
    evaluations = getattr(f, "GetNumberOfEvaluations", None)
    result = {
        "input": hashlib.sha256(points.tobytes() + cells.tobytes()).hexdigest()[:16], "points": len(points),
        "tets": len(cells), "left_out": left_out, "limit": opt.limit,
        "worst_before": f.GetWorstQualityBefore(), "worst": f.GetWorstQualityAfter(),
        "bound": f.GetQualityBound(), "quantile": float(np.quantile(quality, 0.01)), "mean": float(quality.mean()),
        "poor": int(np.count_nonzero(quality < POOR)), "cells": len(quality), "us_per_tet": 1e6 * seconds / len(cells),
        "bare_ns_per_tet": 1e9 * bare / len(cells), "stop": f.GetStopReasonAsString(), "digest": digest(f),
        "evaluations_per_tet": evaluations() / len(cells) if evaluations else None,
    }
    if opt.threads and not aborted(result):
        result["same"] = digest(optimize(grid, effort, opt.limit, opt.threads)[0]) == result["digest"]
    if opt.judge:
        result["fault"] = faults_of_judge(opt.judge, grid, f.GetOutput(), folder, f"{name} {effort}")
    return result


def aborted(r):
    return r["stop"] == "aborted"


def passes(r):
    return 1e3 * r["us_per_tet"] / r["bare_ns_per_tet"]


def ratio(r):
    return r["worst"] / r["bound"] if r["bound"] > 0 else 1.0


def print_head(opt):
    columns = ["mesh", "effort", "tets", "left out", "worst before", "worst after", "bound", "ratio", "1 % quantile", "mean",
               "cells under .2", "cells", "us/tet", "bare pass, ns/tet", "bare passes", "evaluations/tet", "stopped because"]
    columns += ["same bytes"] if opt.threads else []
    columns += ["fault"] if opt.judge else []
    print("| " + " | ".join(columns) + " |\n" + "|---" * len(columns) + "|")


def print_row(name, effort, r, opt):
    count = r["evaluations_per_tet"]
    row = [name, effort, r["tets"], r["left_out"], f"{r['worst_before']:.2g}", f"{r['worst']:.4g}", f"{r['bound']:.4g}",
           f"{ratio(r):.3g}", f"{r['quantile']:.3f}", f"{r['mean']:.3f}", r["poor"], r["cells"], f"{r['us_per_tet']:.3g}",
           f"{r['bare_ns_per_tet']:.1f}", f"{passes(r):.0f}", "" if count is None else f"{count:.0f}", r["stop"]]
    if opt.threads:
        row.append({True: "yes", False: "NO", None: "not tried"}[r.get("same")])
    row += [r["fault"] or "none"] if "fault" in r else []
    print("| " + " | ".join(str(value) for value in row) + " |", flush=True)


def print_summary(results, efforts):
    print("\n| effort | runs | us/tet: median | 95 % | greatest | bare passes: median | greatest | ratio: least | cells under .2, all |")
    print("|---" * 9 + "|")
    for effort in efforts:
        of = [r for (_, e), r in results.items() if e == effort]
        if of:
            us, bare = [r["us_per_tet"] for r in of], [passes(r) for r in of]
            print(f"| {effort} | {len(of)} | {statistics.median(us):.3g} | {np.quantile(us, 0.95):.3g} | {max(us):.3g} "
                  f"| {statistics.median(bare):.0f} | {max(bare):.0f} | {min(ratio(r) for r in of):.3g} | {sum(r['poor'] for r in of)} |")
    for effort in efforts if len(results) > 10 * len(efforts) else []:
        low = sorted((ratio(r), name) for (name, e), r in results.items() if e == effort)[:10]
        print(f"\n{effort}, lowest ratios: " + ", ".join(f"{name} {value:.3g}" for value, name in low))


def verdict(then, now):
    """What is worse than it was, or an empty text."""
    if then["input"] != now["input"]:
        return "another mesh"
    fell = ["worst FELL"] if now["worst"] < 0.99 * then["worst"] else []
    return ", ".join(fell + (["under .2 ROSE"] if now["poor"] > then["poor"] else []))


def compare(results, earlier):
    """Today's results beside the earlier ones; how many are worse."""
    print("\n| mesh | effort | worst then | now | change | under .2 then | now | cells then | now | us/tet then | now | now/then "
          "| bare passes then | now | now/then | worse |")
    print("|---" * 16 + "|")
    worse = 0
    for (name, effort), now in results.items():
        then = earlier.get(f"{name}, {effort}")
        if then is None:
            print(f"| {name} | {effort} |" + " |" * 13 + " not in the earlier file |")
            continue
        said = verdict(then, now)
        worse += said != ""
        change = now["worst"] / then["worst"] - 1 if then["worst"] > 0 else 0.0
        us, bare = [r["us_per_tet"] for r in (then, now)], [passes(r) for r in (then, now)]
        limit = "at least " if aborted(then) else ""
        print(f"| {name} | {effort} | {then['worst']:.4g} | {now['worst']:.4g} | {100 * change:+.1f} % "
              f"| {then['poor']} | {now['poor']} | {then['cells']} | {now['cells']} "
              f"| {limit}{us[0]:.3g} | {us[1]:.3g} | {us[1] / us[0]:.3f} "
              f"| {limit}{bare[0]:.0f} | {bare[1]:.0f} | {bare[1] / bare[0]:.3f} | {said or 'no'} |")
    return worse


class File:
    """What --json keeps: the results by name and effort."""

    def __init__(self, path, note):
        self.path = pathlib.Path(path) if path else None
        self.data = json.loads(self.path.read_text()) if self.path and self.path.exists() else {"note": "", "results": {}}
        self.data["note"] = note or self.data["note"]

    def keep(self, name, effort, result):
        self.data["results"][f"{name}, {effort}"] = result
        if self.path:
            self.path.write_text(json.dumps(self.data, indent=1) + "\n")


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", nargs="*")
    parser.add_argument("--kinds", nargs="+", choices=[*KINDS, "none"], default=KINDS)
    parser.add_argument("--sizes", nargs="+", type=int, default=[1000])
    parser.add_argument("--seeds", nargs="+", type=int, default=[1])
    parser.add_argument("--delaunay", choices=("scipy", "vtk"), default="scipy")
    parser.add_argument("--effort", nargs="+", choices=EFFORTS, default=["quick", "default"])
    parser.add_argument("--limit", type=float, default=0.0)
    parser.add_argument("--threads", type=int, default=0)
    parser.add_argument("--judge")
    parser.add_argument("--output", type=pathlib.Path)
    parser.add_argument("--json")
    parser.add_argument("--note")
    parser.add_argument("--compare", type=pathlib.Path)
    return parser.parse_args()


def main():
    opt = parse()
    try:
        program()
    except (OSError, subprocess.CalledProcessError) as fault:
        sys.exit(f"the bare pass cannot be compiled (a C++ compiler and Eigen's headers are needed): {fault}")
    earlier = json.loads(opt.compare.read_text())["results"] if opt.compare else None
    file, results = File(opt.json, opt.note), {}
    with tempfile.TemporaryDirectory() as temporary:
        folder = opt.output or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        print_head(opt)
        for name, *mesh in inputs(opt):
            for effort in opt.effort:
                results[name, effort] = run(name, mesh, effort, opt, folder)
                print_row(name, effort, results[name, effort], opt)
                file.keep(name, effort, results[name, effort])
    print_summary(results, opt.effort)
    bad = compare(results, earlier) if earlier is not None else 0
    bad += sum(r["worst"] < r["worst_before"] or not r.get("same", True) or r.get("fault", "") != "" for r in results.values())
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
