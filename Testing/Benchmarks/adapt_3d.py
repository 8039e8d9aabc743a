# SPDX-License-Identifier: BSD-3-Clause
"""Tetrahedra of the unit cube in the metric of a function; the surface stays as it is.

    /usr/bin/python3 adapt_3d.py [--functions tanh shock shell] [--elements 64000] [--doublings 5] [--steps 4] [--json FILE]

For numbers of elements that double: the mesh to begin with (boxes of six tetrahedra; its surface is the one kept: that of a mesh of
--surface times as many elements, all alike, or with tanh in layers), adapted in --steps steps. Table: worst quality in the metric (the
paper's S, in the mean logarithm of the metric at its nodes), share of the edges that are right to a factor of sqrt 2 (of all edges, and
of those that are not on the surface), L2 error of the interpolation beside that of the uniform mesh of as many elements, seconds of the
optimizer.
Needs numpy and the package meshoptimize (./bootstrap.sh env).
"""
import argparse
import itertools
import json
import time

import numpy as np
from meshoptimize import vtkMeshOptimizeFilter, vtkSolutionMetricFilter
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkCellArray, vtkUnstructuredGrid

FUNCTIONS = {
    "tanh": lambda x, y, z: np.tanh(60 * (x - 0.5)),
    "shock": lambda x, y, z: np.arctan(60 * (np.sqrt((x - 1.25) ** 2 + (y + 0.25) ** 2 + (z - 0.5) ** 2) - np.pi / 3)),
    "shell": lambda x, y, z: np.exp(-800 * (np.sqrt((x - 0.5) ** 2 + (y - 0.5) ** 2 + (z - 0.5) ** 2) - 0.3) ** 2),
}
EDGES = list(itertools.combinations(range(4), 2))
# Four points that are exact for polynomials of degree 2
_NEAR, _FAR = (5 + 3 * np.sqrt(5)) / 20, (5 - np.sqrt(5)) / 20
_POINTS = np.full((4, 4), _FAR) + (_NEAR - _FAR) * np.eye(4)


def make_grid(points, tetrahedra):
    grid, vtk_points, cells = vtkUnstructuredGrid(), vtkPoints(), vtkCellArray()
    vtk_points.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=1))
    cells.SetData(4, numpy_to_vtkIdTypeArray(np.asarray(tetrahedra, dtype=np.int64).reshape(-1), deep=1))
    grid.SetPoints(vtk_points)
    grid.SetCells(VTK_TETRA, cells)
    return grid


def arrays_of(grid):
    points = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    return points, vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4).copy()


def unit_cube(n):
    return boxes(n, n, n)


def boxes(nx, ny, nz):
    """The unit cube as nx ny nz boxes of six tetrahedra around a diagonal."""
    z, y, x = np.mgrid[0:nz + 1, 0:ny + 1, 0:nx + 1]
    x, y, z = x / nx, y / ny, z / nz
    step = np.array([1, nx + 1, (nx + 1) * (ny + 1)])
    first = np.mgrid[0:nx, 0:ny, 0:nz].reshape(3, -1).T @ step
    tetrahedra = []
    for order in itertools.permutations(range(3)):
        path = np.concatenate([[0], np.cumsum(step[list(order)])])
        odd = np.linalg.det(np.eye(3)[list(order)]) < 0
        tetrahedra.append(first[:, None] + path[[0, 2, 1, 3] if odd else [0, 1, 2, 3]])
    return make_grid(np.stack([x, y, z], axis=-1).reshape(-1, 3), np.concatenate(tetrahedra))


def layered(elements, function):
    """For a function of x alone: planes across x, as dense as |f''|^(2/5) asks for (the L2 norm), four times as many of them as of
    those across y and z. The surface, which is kept, must have such layers: what stands on it cannot be finer in x than it is."""
    n = max(2, round((elements / 24) ** (1 / 3)))
    x = np.linspace(0, 1, 20001)
    dense = np.abs(np.gradient(np.gradient(function(x, 0, 0), x), x)) ** 0.4
    share = np.cumsum(dense + 0.2 * dense.mean())
    grid = boxes(4 * n, n, n)
    points = vtk_to_numpy(grid.GetPoints().GetData())
    points[:, 0] = np.interp(points[:, 0], (share - share[0]) / (share[-1] - share[0]), x)
    return grid


def first_mesh(name, elements):
    return layered(elements, FUNCTIONS[name]) if name == "tanh" else unit_cube(cubes(elements))


def cubes(elements):
    return max(2, round((elements / 6) ** (1 / 3)))


def parts(levels):
    """A tetrahedron cut into 8^levels, in its barycentric coordinates."""
    result = np.eye(4)[None]
    for _ in range(levels):
        corner = [result[:, i] for i in range(4)]
        mid = {e: (corner[e[0]] + corner[e[1]]) / 2 for e in EDGES}
        m = lambda i, j: mid[min(i, j), max(i, j)]  # noqa: E731
        new = [[corner[i]] + [m(i, j) for j in range(4) if j != i] for i in range(4)]
        ring = [(0, 2), (0, 3), (1, 3), (1, 2)]  # around the diagonal from the middle of 01 to that of 23
        new += [[mid[0, 1], mid[2, 3], mid[a], mid[b]] for a, b in zip(ring, ring[1:] + ring[:1])]
        result = np.concatenate([np.stack(part, axis=1) for part in new])
    return result


def interpolation_error(grid, function, levels=2):
    """L2 norm of the function minus its linear interpolation: each element cut into 8^levels, four points in each."""
    points, tetrahedra = arrays_of(grid)
    corners = points[tetrahedra]
    volumes = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])) / 6
    values = function(*points.T)[tetrahedra]
    samples = (_POINTS @ parts(levels)).reshape(-1, 4)
    total = 0.0
    for at in samples:
        total += volumes @ (function(*np.einsum("k,nkx->xn", at, corners)) - values @ at) ** 2
    return np.sqrt(total / len(samples))


def add_metric(grid, function, elements):
    values = numpy_to_vtk(function(*arrays_of(grid)[0].T), deep=1)
    values.SetName("u")
    grid.GetPointData().SetScalars(values)
    metric = vtkSolutionMetricFilter()
    metric.SetInputData(grid)
    metric.SetRecoveryToLeastSquares()
    metric.SetNormOrder(2.0)  # for the L2 norm of the error
    metric.SetDesiredNumberOfElements(elements)
    metric.Update()
    if metric.GetErrorCode() != 0:
        raise RuntimeError("vtkSolutionMetricFilter failed")
    grid = metric.GetOutput()
    array = numpy_to_vtk(logarithms(grid).reshape(-1, 9), deep=1)
    array.SetName("Logarithm")  # which Mesh Optimize passes on to its nodes, linearly in each element
    grid.GetPointData().AddArray(array)
    return grid


def optimize(grid):
    """(filter, seconds)"""
    optimizer = vtkMeshOptimizeFilter()
    optimizer.SetInputData(grid)
    optimizer.SetBeta(1.0)
    optimizer.SetMetricArray("Metric")
    optimizer.SetSizeArray("DesiredSize")
    start = time.perf_counter()
    optimizer.Update()
    if optimizer.GetErrorCode() != 0:
        raise RuntimeError("vtkMeshOptimizeFilter failed")
    return optimizer, time.perf_counter() - start


def logarithms(grid):
    """Of the metric in which edges shall have the length 1, at the points."""
    m = vtk_to_numpy(grid.GetPointData().GetArray("Metric"))[:, [0, 3, 5, 3, 1, 4, 5, 4, 2]].reshape(-1, 3, 3)
    values, vectors = np.linalg.eigh(m / vtk_to_numpy(grid.GetPointData().GetArray("DesiredSize"))[:, None, None] ** 2)
    return np.einsum("nij,nj,nkj->nik", vectors, np.log(np.maximum(values, 1e-300)), vectors)


def exponential(tensors):
    values, vectors = np.linalg.eigh(tensors)
    return np.einsum("nij,nj,nkj->nik", vectors, np.exp(values), vectors)


def judge(grid):
    points, tetrahedra = arrays_of(grid)
    logarithm = vtk_to_numpy(grid.GetPointData().GetArray("Logarithm")).reshape(-1, 3, 3)
    corners = points[tetrahedra]
    mean = exponential(logarithm[tetrahedra].mean(axis=1))
    volume = np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6 * np.sqrt(np.linalg.det(mean))
    around = sum(np.sqrt(np.einsum("ni,nij,nj->n", e, mean, e)) for e in (corners[:, j] - corners[:, i] for i, j in EDGES))
    quality = 1296 * np.sqrt(2) * np.abs(volume) / around ** 3
    faces = np.sort(tetrahedra[:, [(1, 2, 3), (0, 2, 3), (0, 1, 3), (0, 1, 2)]].reshape(-1, 3), axis=1)
    faces, count = np.unique(faces, axis=0, return_counts=True)
    n = len(points)
    outer = faces[count == 1][:, [(0, 1), (0, 2), (1, 2)]].reshape(-1, 2) @ [n, 1]
    edges = np.unique(np.sort(tetrahedra[:, EDGES].reshape(-1, 2), axis=1), axis=0)
    inside = ~np.isin(edges @ [n, 1], outer)
    metric = exponential(logarithm)
    along = points[edges[:, 1]] - points[edges[:, 0]]
    a, b = (np.sqrt(np.einsum("ni,nij,nj->n", along, metric[edges[:, end]], along)) for end in (0, 1))
    with np.errstate(divide="ignore", invalid="ignore"):
        length = np.where(np.abs(np.log(a / b)) < 1e-6, (a + b) / 2, (a - b) / np.log(a / b))
    right = (length >= np.sqrt(0.5)) & (length <= np.sqrt(2))
    return {"worst": float(quality.min()), "under": int(np.count_nonzero(quality < 0.2)), "share": float(right.mean()),
            "inside": float(right[inside].mean())}


def slope(numbers, errors):
    return float(np.polyfit(np.log(numbers), np.log(errors), 1)[0])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--functions", nargs="+", choices=FUNCTIONS, default=list(FUNCTIONS))
    parser.add_argument("--elements", type=int, default=64000)
    parser.add_argument("--doublings", type=int, default=5)
    parser.add_argument("--steps", type=int, default=4)
    parser.add_argument("--surface", type=float, default=0.5)
    parser.add_argument("--json")
    opt = parser.parse_args()
    rows = []
    print("| function | elements wanted | elements | worst quality | under .2 | edges in [.71, 1.41] | those inside | L2 error | uniform | s |\n"
          "|---|---|---|---|---|---|---|---|---|---|")
    for name in opt.functions:
        function, found = FUNCTIONS[name], []
        for wanted in (opt.elements // 2 ** k for k in range(opt.doublings, -1, -1)):
            grid = first_mesh(name, opt.surface * wanted)
            for _ in range(opt.steps):
                optimizer, seconds = optimize(add_metric(grid, function, wanted))
                grid = optimizer.GetOutput()
            plain = unit_cube(cubes(grid.GetNumberOfCells()))
            row = {"function": name, "wanted": wanted, "cells": grid.GetNumberOfCells(), **judge(grid),
                   "error": interpolation_error(grid, function),
                   "uniform": interpolation_error(plain, function) * (plain.GetNumberOfCells() / grid.GetNumberOfCells()) ** (2 / 3),
                   "seconds": seconds}
            found.append(row)
            print("| {function} | {wanted} | {cells} | {worst:.3f} | {under} | {share:.1%} | {inside:.1%} | {error:.2e} | {uniform:.2e} "
                  "| {seconds:.2f} |".format(**row), flush=True)
        print(f"| {name} | slope | {slope([r['cells'] for r in found], [r['error'] for r in found]):.2f} | | | | | | |")
        rows += found
    if opt.json:
        with open(opt.json, "w", encoding="ascii") as f:
            json.dump(rows, f, indent=1)


if __name__ == "__main__":
    main()
