# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of the unit square in the metric of a function: Mesh Optimize beside FreeFEM's adaptmesh and BAMG in Gmsh.

    /usr/bin/python3 adapt.py [--functions tanh shock ring] [--elements 10000] [--doublings 5] [--steps 4] [--tools ...]
                              [--growth] [--png FILE] [--json FILE]

Tables in Markdown:
1. The same metric for all, that of vtkSolutionMetricFilter on a mesh that one of the tools has adapted (--background): worst
   quality in it, share of the edges that are right to a factor of sqrt 2, error, elements, seconds of the mesh generator on one
   thread. The row "turned" is a metric that is the same everywhere: edges ten times as long at 120 degrees as across. Gmsh 4.8.4, as Debian has
   it, does not look at the component xy of a metric: with "shock" and "ring" it makes other meshes than it should.
2. Each tool by itself, from a uniform mesh, for numbers of elements that double: L2 error of the interpolation and its slope.
3. --growth: seconds of each for 12.5 k to 100 k elements of the ring's metric.

All meshes are judged by one routine, which knows no tool: the metric is interpolated between the points of the background mesh by
its logarithm; the length of an edge is that for a length per unit that changes exponentially from one end to the other; the
quality of an element is the paper's S (2.3), in the mean logarithm of the metric at its nodes. Tools that are not installed are
left out (Debian: freefem++ python3-gmsh). Needs numpy, matplotlib for --png, and the package meshoptimize (./bootstrap.sh env).
"""
import argparse
import json
import os
import subprocess
import sys
import time

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from meshoptimize import vtkMeshOptimizeFilter
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStaticCellLocator
from vtkmodules.vtkFiltersCore import vtkProbeFilter

import adapt_peers

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../ParaViewPlugin/Examples"))
from adapt_function import (FUNCTIONS, adapt, add_metric, arrays_of, interpolation_error, make_grid,  # noqa: E402
                            optimize, slope, unit_square)


def tensors_of(grid):
    """xx, xy, yy at the points: edges shall have the length 1 in them."""
    metric = vtk_to_numpy(grid.GetPointData().GetArray("Metric"))[:, [0, 3, 1]]
    return metric / vtk_to_numpy(grid.GetPointData().GetArray("DesiredSize"))[:, None] ** 2


def peer(tool):
    def mesher(background):
        points, triangles, seconds = tool(*arrays_of(background), tensors_of(background))
        return make_grid(points, triangles), seconds
    return mesher


def ours(background):
    """One thread, seconds of the processor, as with the others."""
    start = time.process_time()
    grid, _ = optimize(background, threads=1)
    return grid, time.process_time() - start


TOOLS = {
    "ours": ("Mesh Optimize", ours, lambda: hasattr(vtkMeshOptimizeFilter, "SetBoundaryModeToSlide")),
    "freefem": ("FreeFEM adaptmesh", peer(adapt_peers.freefem), adapt_peers.have_freefem),
    "bamg": ("BAMG in Gmsh", peer(adapt_peers.bamg), adapt_peers.have_gmsh),
}


def of_eigenvalues(tensors, function):
    """A function of symmetric matrices n x 2 x 2."""
    values, vectors = np.linalg.eigh(tensors)
    return np.einsum("nij,nj,nkj->nik", vectors, function(values), vectors)


class Background:
    """The metric, anywhere: its logarithm is linear in each triangle."""

    def __init__(self, grid):
        xx, xy, yy = tensors_of(grid).T
        self.grid = make_grid(*arrays_of(grid))
        logarithm = of_eigenvalues(np.stack([xx, xy, xy, yy], axis=1).reshape(-1, 2, 2), np.log).reshape(-1, 4)
        array = numpy_to_vtk(logarithm, deep=1)
        array.SetName("Logarithm")
        self.grid.GetPointData().AddArray(array)

    def logarithm(self, points):
        """Of the metric at points, n x 2 x 2."""
        points = 0.5 + (1 - 1e-9) * (points - 0.5)  # those on the sides, too, to the rounding of a text file
        targets, vtk_points = vtkPolyData(), vtkPoints()
        vtk_points.SetData(numpy_to_vtk(np.column_stack([points, np.zeros(len(points))]), deep=1))
        targets.SetPoints(vtk_points)
        probe = vtkProbeFilter()
        probe.SetInputData(targets)
        probe.SetSourceData(self.grid)
        probe.SetCellLocatorPrototype(vtkStaticCellLocator())
        probe.SetComputeTolerance(False)
        probe.SetTolerance(1e-7)
        probe.Update()
        found = probe.GetOutput().GetPointData()
        valid = vtk_to_numpy(found.GetArray(probe.GetValidPointMaskArrayName())) != 0
        if not valid.all():
            raise RuntimeError(f"{np.count_nonzero(~valid)} points outside of the background mesh")
        return vtk_to_numpy(found.GetArray("Logarithm")).reshape(-1, 2, 2)


def judge(grid, background, function):
    """What is to be said of a mesh that was made for that metric."""
    points, triangles = arrays_of(grid)
    logarithm = background.logarithm(points)
    corners = points[triangles]
    sides = np.roll(corners, -1, axis=1) - corners
    double = sides[:, 0, 0] * sides[:, 1, 1] - sides[:, 0, 1] * sides[:, 1, 0]
    if abs(np.abs(double).sum() / 2 - 1) > 1e-9:
        raise RuntimeError("the triangles do not cover the square once")
    mean = of_eigenvalues(logarithm[triangles].mean(axis=1), np.exp)
    around = np.sqrt(np.einsum("nki,nij,nkj->nk", sides, mean, sides)).sum(axis=1)
    quality = 36 / np.sqrt(3) * np.abs(double) / 2 * np.sqrt(np.linalg.det(mean)) / around**2
    lengths = edge_lengths(points, triangles, logarithm)
    return {"cells": len(triangles), "worst": float(quality.min()), "mean": float(quality.mean()),
            "share": float(np.mean((lengths >= np.sqrt(0.5)) & (lengths <= np.sqrt(2)))),
            "shortest": float(lengths.min()), "longest": float(lengths.max()),
            "error": float(interpolation_error(grid, function)) if function else float("nan")}


def edge_lengths(points, triangles, logarithm):
    edges = np.unique(np.sort(np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)]), axis=1), axis=0)
    metric = of_eigenvalues(logarithm, np.exp)
    along = points[edges[:, 1]] - points[edges[:, 0]]
    a, b = (np.sqrt(np.einsum("ni,nij,nj->n", along, metric[edges[:, end]], along)) for end in (0, 1))
    ratio = np.log(a / b)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(np.abs(ratio) < 1e-6, (a + b) / 2, (a - b) / ratio)


def structured(elements):
    """(mesh, seconds) of about so many elements, to begin with."""
    return unit_square(max(2, round(np.sqrt(elements / 2)))), 0.0


def adapted(tool, function, elements, steps):
    """The last (mesh, background, seconds) of the tool by itself."""
    return list(adapt(function, elements, steps, first=structured, mesher=TOOLS[tool][1]))[-1]


def turned(elements):
    """A grid with a metric that is the same everywhere."""
    c, s = np.cos(np.pi / 6), np.sin(np.pi / 6)
    m = np.array([[c, -s], [s, c]]) @ np.diag([10.0, 0.1]) @ np.array([[c, s], [-s, c]])
    grid = unit_square(50)
    for name, value in (("Metric", [m[0, 0], m[1, 1], 1, m[0, 1], 0, 0]), ("DesiredSize", np.sqrt(4 / np.sqrt(3) / elements))):
        array = numpy_to_vtk(np.tile(value, (grid.GetNumberOfPoints(), 1)), deep=1)
        array.SetName(name)
        grid.GetPointData().AddArray(array)
    return grid


def metric_of(name, elements, opt):
    function = FUNCTIONS[name]
    return add_metric(adapted(opt.background, function, elements, opt.steps)[0], function, elements)


def timed(tool, background):
    """(mesh, seconds): the faster of two."""
    (grid, first), (_, second) = (TOOLS[tool][1](background) for _ in range(2))
    return grid, min(first, second)


def same_metric(name, opt):
    background = turned(opt.elements) if name == "turned" else metric_of(name, opt.elements, opt)
    field = Background(background)
    rows = []
    for tool in opt.tools:
        row = {"function": name, "tool": tool}
        try:
            grid, seconds = timed(tool, background)
            row.update(judge(grid, field, FUNCTIONS.get(name)), seconds=seconds, status="ok")
        except (RuntimeError, subprocess.TimeoutExpired) as error:
            row["status"] = str(error).splitlines()[0][:80]
        rows.append(row)
        print_row(row)
    return rows


def growth(opt):
    print("\n| elements wanted | " + " | ".join(TOOLS[tool][0] + ", s" for tool in opt.tools) + " |\n|---"
          + "|---" * len(opt.tools) + "|")
    for elements in (12500, 25000, 50000, 100000):
        background = metric_of("ring", elements, opt)
        print(f"| {elements} | " + " | ".join(f"{timed(tool, background)[1]:.2f}" for tool in opt.tools) + " |", flush=True)


def print_row(row):
    label = TOOLS[row["tool"]][0]
    if row["status"] != "ok":
        print(f"| {row['function']} | {label} | {row['status']} | | | | | | |", flush=True)
        return
    print(f"| {row['function']} | {label} | {row['cells']} | {row['worst']:.3f} | {row['mean']:.3f} | {row['share']:.1%} "
          f"| {row['shortest']:.2f}-{row['longest']:.2f} | {row['error']:.2e} | {row['seconds']:.2f} |", flush=True)


def slopes(name, opt):
    function = FUNCTIONS[name]
    numbers = [opt.elements // 2 ** k for k in range(opt.doublings, -1, -1)]
    result = {"uniform": [(mesh.GetNumberOfCells(), interpolation_error(mesh, function))
                          for mesh in (structured(n)[0] for n in numbers)]}
    for tool in opt.tools:
        try:
            meshes = [adapted(tool, function, n, opt.steps)[0] for n in numbers]
        except (RuntimeError, subprocess.TimeoutExpired) as error:
            print(f"| {name} | {TOOLS[tool][0]} | {str(error).splitlines()[0][:80]} | |")
            continue
        result[tool] = [(mesh.GetNumberOfCells(), interpolation_error(mesh, function)) for mesh in meshes]
    for tool, rows in result.items():
        label = TOOLS[tool][0] if tool in TOOLS else "uniform"
        print(f"| {name} | {label} | " + ", ".join(f"{n}: {error:.1e}" for n, error in rows)
              + f" | {slope(*np.transpose(rows)):.2f} |", flush=True)
    return {"function": name, "rows": result}


def draw(results, path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, panels = pyplot.subplots(1, len(results), figsize=(4.6 * len(results), 4.4), squeeze=False, layout="constrained")
    for result, panel in zip(results, panels[0]):
        for tool, rows in result["rows"].items():
            label, color = {"uniform": ("uniform", "0.5"), "ours": (TOOLS["ours"][0], "#c0392b"),
                            "freefem": (TOOLS["freefem"][0], "#1f618d"), "bamg": (TOOLS["bamg"][0], "#239b56")}[tool]
            panel.loglog(*np.transpose(rows), marker="o", color=color, label=f"{label}, slope {slope(*np.transpose(rows)):.2f}")
        panel.set(title=result["function"], xlabel="elements")
        panel.grid(True, which="both", color="0.92")
        panel.legend(fontsize="small")
    panels[0][0].set_ylabel("L2 error of the interpolation")
    figure.savefig(path, dpi=130)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--functions", nargs="+", choices=FUNCTIONS, default=list(FUNCTIONS))
    parser.add_argument("--elements", type=int, default=10000)
    parser.add_argument("--doublings", type=int, default=5)
    parser.add_argument("--steps", type=int, default=4)
    parser.add_argument("--tools", nargs="+", choices=TOOLS, default=list(TOOLS))
    parser.add_argument("--background", choices=TOOLS)
    parser.add_argument("--no-slopes", action="store_true")
    parser.add_argument("--growth", action="store_true")
    parser.add_argument("--png")
    parser.add_argument("--json")
    opt = parser.parse_args()
    opt.tools = [tool for tool in opt.tools if TOOLS[tool][2]()]
    opt.background = opt.background or ("freefem" if "freefem" in opt.tools else opt.tools[0])

    print(f"Same metric, on a mesh from {TOOLS[opt.background][0]}:\n")
    print("| function | tool | elements | worst quality | mean | edges in [.71, 1.41] | shortest-longest | L2 error | s |\n"
          "|---|---|---|---|---|---|---|---|---|")
    table = [row for name in [*opt.functions, "turned"] for row in same_metric(name, opt)]
    results = []
    if not opt.no_slopes:
        print("\nEach by itself:\n\n| function | tool | elements: L2 error | slope |\n|---|---|---|---|")
        results = [slopes(name, opt) for name in opt.functions]
        if opt.png:
            draw(results, opt.png)
    if opt.growth:
        growth(opt)
    if opt.json:
        with open(opt.json, "w", encoding="ascii") as f:
            json.dump({"metric": table, "slopes": results}, f, indent=1)


if __name__ == "__main__":
    main()
