# SPDX-License-Identifier: BSD-3-Clause
"""Tetrahedra of the unit cube in the metric of a function, by ParaViewPlugin/Examples/adapt_box.py: the surface fits the metric, too.

    /usr/bin/python3 adapt_3d.py [--functions tanh shock shell] [--elements 64000] [--doublings 5] [--steps 5] [--surface uniform]
                                 [--json FILE] [--check]

A table in Markdown for numbers of elements that double, each in --steps steps: worst quality in the metric (the paper's S, in the mean
logarithm of the metric at its nodes), share of all edges that are right to a factor of sqrt 2, L2 error of the interpolation
beside that of the uniform mesh of as many elements, seconds of the processor that the surface, TetGen and the optimizer took
in the last step. Then the slope of the error. Each mesh is tested: no element is inverted, the cube is filled, the surface is, bit for
bit, what the optimizer got; else the program ends.
--surface uniform: tetrahedra of equal boxes to begin with, whose surface is kept through all steps; for comparison.
--check: exit status 1 unless each worst quality is at least .2, each share of edges at least 90 %, each slope at most -2/3, and the error
of tanh with the most elements at most a tenth of the uniform mesh's.
Needs numpy and the package meshoptimize with TetGen (./bootstrap.sh env).
"""
import argparse
import json
import os
import sys
import time

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../ParaViewPlugin/Examples"))
from adapt_box import (EDGES, FUNCTIONS, adapt, arrays_of, interpolation_error, metric_of,  # noqa: E402
                       outer_faces, processor_seconds, unit_cube)
from box_surface import add_metric, lengths, of_eigenvalues, optimize  # noqa: E402


def keep_surface(function, elements, steps):
    """As adapt() does, but with the surface of the first mesh."""
    grid = unit_cube(elements / 2)
    for _ in range(steps):
        add_metric(grid, metric_of(grid, function, elements))
        start = processor_seconds()
        optimizer = optimize(grid, 1.0)
        yield grid, optimizer, np.array([0, 0, processor_seconds() - start])
        grid = optimizer.GetOutput()


def signed_volumes(points, tetrahedra):
    return np.linalg.det(points[tetrahedra[:, 1:]] - points[tetrahedra[:, :1]]) / 6


def surface_of(grid):
    """The corners of its triangles, whatever their numbers."""
    points, tetrahedra = arrays_of(grid)
    return {tuple(sorted(map(tuple, corners))) for corners in points[outer_faces(tetrahedra)].tolist()}


def test(before, after):
    volumes = signed_volumes(*arrays_of(after))
    if volumes.min() <= 0 or abs(volumes.sum() - 1) > 1e-9:
        sys.exit(f"{np.count_nonzero(volumes <= 0)} elements inverted or flat, volume {volumes.sum()}")
    if surface_of(before) != surface_of(after):
        sys.exit("the surface has changed")


def judge(grid):
    points, tetrahedra = arrays_of(grid)
    logarithm = vtk_to_numpy(grid.GetPointData().GetArray("Logarithm")).reshape(-1, 3, 3)
    mean = of_eigenvalues(logarithm[tetrahedra].mean(axis=1), np.exp)
    around = sum(lengths(points[tetrahedra[:, j]] - points[tetrahedra[:, i]], mean) for i, j in EDGES)
    quality = 1296 * np.sqrt(2) * signed_volumes(points, tetrahedra) * np.sqrt(np.linalg.det(mean)) / around ** 3
    edges = np.unique(np.sort(tetrahedra[:, EDGES].reshape(-1, 2), axis=1), axis=0)
    metric = of_eigenvalues(logarithm, np.exp)
    a, b = (lengths(points[edges[:, 1]] - points[edges[:, 0]], metric[edges[:, end]]) for end in (0, 1))
    with np.errstate(divide="ignore", invalid="ignore"):
        length = np.where(np.abs(np.log(a / b)) < 1e-6, (a + b) / 2, (a - b) / np.log(a / b))
    return {"worst": float(quality.min()), "share": float(np.mean((length >= np.sqrt(0.5)) & (length <= np.sqrt(2))))}


def uniform_error(function, elements):
    """That of a uniform mesh with about so many elements, brought to that number with the power -2/3."""
    grid = unit_cube(elements)
    return interpolation_error(grid, function) * (grid.GetNumberOfCells() / elements) ** (2 / 3)


def slope(rows):
    return float(np.polyfit(np.log([r["cells"] for r in rows]), np.log([r["error"] for r in rows]), 1)[0])


def given_up(optimizer):
    history = optimizer.GetOutputDataObject(1)
    stages = history.GetColumnByName("Stage")
    return any(stages.GetValue(row) == "sizes given up" for row in range(history.GetNumberOfRows()))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--functions", nargs="+", choices=FUNCTIONS, default=list(FUNCTIONS))
    parser.add_argument("--elements", type=int, default=64000)
    parser.add_argument("--doublings", type=int, default=5)
    parser.add_argument("--steps", type=int, default=5)
    parser.add_argument("--surface", choices=["adapted", "uniform"], default="adapted")
    parser.add_argument("--json")
    parser.add_argument("--check", action="store_true")
    opt = parser.parse_args()
    rows, good = [], True
    print("| function | elements wanted | elements | worst quality in the metric | edges right to a factor of sqrt 2 | L2 error "
          "| that of a uniform mesh | s: surface | TetGen | optimizer |\n|---|---|---|---|---|---|---|---|---|---|")
    for name in opt.functions:
        function, found = FUNCTIONS[name], []
        for wanted in (opt.elements // 2 ** k for k in range(opt.doublings, -1, -1)):
            begin, undone = time.perf_counter(), 0
            for before, optimizer, seconds in (adapt if opt.surface == "adapted" else keep_surface)(function, wanted, opt.steps):
                undone += given_up(optimizer)
            grid = optimizer.GetOutput()
            test(before, grid)
            row = {"function": name, "wanted": wanted, "cells": grid.GetNumberOfCells(), **judge(grid),
                   "error": interpolation_error(grid, function), "uniform": uniform_error(function, grid.GetNumberOfCells()),
                   "seconds": seconds.tolist(), "all": time.perf_counter() - begin, "given_up": undone}
            found.append(row)
            print(f"| {name} | {wanted} | {row['cells']} | {row['worst']:.3f} | {row['share']:.1%} | {row['error']:.1e} "
                  f"| {row['uniform']:.1e} | {seconds[0]:.1f} | {seconds[1]:.1f} | {seconds[2]:.1f} |", flush=True)
            good &= row["worst"] >= 0.2 and row["share"] >= 0.9
        if opt.doublings > 0:
            print(f"| {name} | slope {slope(found):.2f} | | | | | | | | |", flush=True)
            good &= slope(found) <= -2 / 3
        good &= name != "tanh" or found[-1]["error"] <= 0.1 * found[-1]["uniform"]
        rows += found
    print(f"sizes given up: {sum(row['given_up'] for row in rows)} of {len(rows) * opt.steps} times")
    if opt.json:
        with open(opt.json, "w", encoding="ascii") as f:
            json.dump(rows, f, indent=1)
    sys.exit(opt.check and not good)


if __name__ == "__main__":
    main()
