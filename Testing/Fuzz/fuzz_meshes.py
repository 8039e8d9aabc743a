# SPDX-License-Identifier: BSD-3-Clause
"""Random small meshes for fuzz_filter.py: a function of the random generator only.

A mesh is a dictionary: dimension 2 or 3, points [n, 3], cells [m, dimension + 1], others (list of VTK type and ids),
regions [m] or None, fixed [n] or None, text (what it is).
"""
import itertools

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIntArray, vtkPoints
from vtkmodules.vtkCommonDataModel import (VTK_HEXAHEDRON, VTK_LINE, VTK_TETRA, VTK_TRIANGLE, VTK_VERTEX, vtkPolyData,
                                           vtkUnstructuredGrid)
from vtkmodules.vtkFiltersCore import vtkDelaunay2D, vtkDelaunay3D


def signed_volumes(points, cells):
    x = points[cells]
    edges = x[:, 1:] - x[:, :1]
    if cells.shape[1] == 4:
        return np.einsum("ij,ij->i", np.cross(edges[:, 0], edges[:, 1]), edges[:, 2]) / 6.0
    return np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1) / 2.0


def kuhn_grid(shape):
    """A box of shape[0] x shape[1] (x shape[2]) squares or cubes, one simplex per order in which coordinates grow."""
    dimension = len(shape)
    points = np.array(list(itertools.product(*(range(s + 1) for s in shape))), dtype=float)
    place = {tuple(p): i for i, p in enumerate(points.astype(int))}
    cells = []
    for corner in itertools.product(*(range(s) for s in shape)):
        for order in itertools.permutations(range(dimension)):
            at, ids = list(corner), [place[corner]]
            for axis in order:
                at[axis] += 1
                ids.append(place[tuple(at)])
            if sum(order[a] > order[b] for a in range(dimension) for b in range(a, dimension)) % 2:
                ids[-1], ids[-2] = ids[-2], ids[-1]
            cells.append(ids)
    if dimension == 2:
        points = np.c_[points, np.zeros(len(points))]
    return points, np.array(cells)


def delaunay(random, dimension, count):
    points = random.random((count, 3)) * random.choice([1.0, 1.0, 3.0, 0.2], size=3)
    if random.random() < 0.3:  # clustered
        points = points ** random.choice([2, 4])
    if dimension == 2:
        points[:, 2] = 0.0
    cloud, poly = vtkPoints(), vtkPolyData()
    cloud.SetData(numpy_to_vtk(points, deep=1))
    poly.SetPoints(cloud)
    algorithm = vtkDelaunay3D() if dimension == 3 else vtkDelaunay2D()
    algorithm.SetInputData(poly)
    algorithm.Update()
    out = algorithm.GetOutput()
    cells = vtk_to_numpy((out.GetCells() if dimension == 3 else out.GetPolys()).GetConnectivityArray())
    return points, cells.reshape(-1, dimension + 1).astype(int)


def jitter(random, points, dimension, amount, all_points):
    """Moves points by up to `amount`; only those inside of the box unless all_points."""
    low, high = points.min(axis=0), points.max(axis=0)
    axes = slice(0, dimension)
    inner = ((points > low) & (points < high))[:, axes].all(axis=1) | all_points
    points[inner, axes] += amount * (2.0 * random.random((inner.sum(), dimension)) - 1.0)


def valid(cells):
    """Leaves cells out until no facet has more than two and none stands twice (vtkDelaunay3D is not always exact)."""
    use, kept = {}, []
    for cell in cells:
        facets = [tuple(sorted(f)) for f in itertools.combinations(cell, len(cell) - 1)]
        if all(len(use.get(f, ())) < 2 and tuple(sorted(cell)) not in use.get(f, ()) for f in facets):
            kept.append(cell)
            for f in facets:
                use.setdefault(f, []).append(tuple(sorted(cell)))
    return np.array(kept)


def split_points(random, points, cells):
    """A crack: cells on one side of a plane get points of their own on part of it."""
    normal = random.normal(size=3)
    above = (points[cells].mean(axis=1) - points.mean(axis=0)) @ normal > 0
    shared = np.intersect1d(cells[above], cells[~above])
    shared = shared[random.random(len(shared)) < random.choice([0.3, 1.0])]
    new = np.arange(len(points))
    new[shared] = len(points) + np.arange(len(shared))
    cells = cells.copy()
    cells[above] = new[cells[above]]
    return np.r_[points, points[shared]], cells


def base(random, dimension):
    if random.random() < 0.5:
        count = int(random.integers(dimension + 2, 70 if dimension == 3 else 150))
        points, cells = delaunay(random, dimension, count)
        return points, cells, f"Delaunay of {count} points"
    most = 5 if dimension == 3 else 9
    shape = [int(s) for s in random.integers(1, most, size=dimension)]
    points, cells = kuhn_grid(shape)
    amount = random.choice([0.0, 0.1, 0.25, 0.5, 1.0, 2.0])
    jitter(random, points, dimension, amount, random.random() < 0.15)
    return points, cells, f"grid {shape}, jitter {amount}"


def spoil(random, points, cells, text):
    """Holes, pinches, cracks, coinciding points, reversed cells, stretched and far away."""
    if random.random() < 0.3 and len(cells) > 4:
        cells = cells[random.random(len(cells)) < random.choice([0.5, 0.9, 0.98])]
        text += ", cells left out"
    if len(cells) == 0:
        return points, cells, text
    if random.random() < 0.2:
        points, cells = split_points(random, points, cells)
        text += ", cracked"
    if random.random() < 0.15:
        a, b = random.integers(len(points), size=2)
        points[a] = points[b]
        text += ", two points at one place"
    if random.random() < 0.15:
        cells = cells.copy()
        turned = random.random(len(cells)) < random.choice([0.05, 0.5, 1.0])
        cells[turned, :2] = cells[turned, 1::-1]
        text += ", cells reversed"
    if random.random() < 0.3:
        points = points * 10.0 ** random.integers(-9, 9) + (random.normal(size=3) * 10.0 if random.random() < 0.5 else 0.0)
        text += ", scaled"
    return points, cells, text


def tilt(random, points):
    q, _ = np.linalg.qr(random.normal(size=(3, 3)))
    return points @ q.T


def others(random, dimension, points, cells):
    """A few cells of other kinds on the points of the mesh."""
    found = []
    for _ in range(int(random.integers(1, 4))):
        cell = cells[random.integers(len(cells))]
        kinds = [(VTK_LINE, 2), (VTK_VERTEX, 1)] + ([(VTK_TRIANGLE, 3)] if dimension == 3 else [])
        if len(points) >= 8 and dimension == 3:
            kinds.append((VTK_HEXAHEDRON, 8))
        kind, count = kinds[random.integers(len(kinds))]
        ids = random.choice(len(points), 8, replace=False) if count == 8 else random.permutation(cell)[:count]
        found.append((kind, [int(p) for p in ids]))
    return found


def regions_of(random, points, cells):
    centre = points[cells].mean(axis=1)
    choice = random.random()
    if choice < 0.2:
        return random.integers(0, 3, size=len(cells))
    directions = random.normal(size=(int(random.integers(1, 4)), 3))
    sides = (centre - np.median(centre, axis=0)) @ directions.T > 0
    return sides @ (2 ** np.arange(sides.shape[1])) * (1 if choice < 0.7 else 10 ** 10) - 1


def random_mesh(random):
    dimension = 3 if random.random() < 0.75 else 2
    points, cells, text = base(random, dimension)
    cells = valid(cells)
    points, cells, text = spoil(random, points, cells, text)
    if dimension == 2 and random.random() < 0.5:
        points, text = tilt(random, points), text + ", tilted"
    mesh = {"dimension": dimension, "points": points, "cells": cells, "others": [], "regions": None, "fixed": None, "text": text}
    if len(cells) and random.random() < 0.15:
        mesh["others"] = others(random, dimension, points, cells)
        mesh["text"] += ", other cells"
    if len(cells) and random.random() < 0.35:
        mesh["regions"] = regions_of(random, points, cells)
        mesh["text"] += f", {len(np.unique(mesh['regions']))} regions"
    if random.random() < 0.2:
        mesh["fixed"] = random.random(len(points)) < random.choice([0.1, 0.5, 1.0])
        mesh["text"] += ", fixed points"
    return mesh


def grid_of(mesh, random):
    """The mesh as a grid, with its arrays, ids of points and cells, and arrays of sizes and of metric tensors."""
    grid, p = vtkUnstructuredGrid(), vtkPoints()
    p.SetData(numpy_to_vtk(np.ascontiguousarray(mesh["points"], dtype=float), deep=1))
    grid.SetPoints(p)
    grid.Allocate(1)
    simplex = VTK_TETRA if mesh["dimension"] == 3 else VTK_TRIANGLE
    for cell in mesh["cells"]:
        grid.InsertNextCell(simplex, len(cell), [int(i) for i in cell])
    for kind, ids in mesh["others"]:
        grid.InsertNextCell(kind, len(ids), ids)
    count = len(mesh["points"])

    def add(to, name, values):
        array = numpy_to_vtk(np.ascontiguousarray(values), deep=1)
        array.SetName(name)
        to.AddArray(array)

    add(grid.GetCellData(), "cell", np.arange(grid.GetNumberOfCells()))
    add(grid.GetPointData(), "point", np.arange(count))
    if mesh["regions"] is not None:
        add(grid.GetCellData(), "region", np.r_[mesh["regions"], np.zeros(len(mesh["others"]), dtype=np.int64)])
    if mesh["fixed"] is not None:
        add(grid.GetPointData(), "fixed", mesh["fixed"].astype(np.int8))
    extent = max(np.ptp(mesh["points"], axis=0).max(), 1e-300) if count else 1.0
    # smooth, or noise from point to point
    where = mesh["points"] @ random.normal(size=3) / extent if count else np.zeros(0)
    noise = random.random() < 0.3
    add(grid.GetPointData(), "size", extent * (0.05 + random.random(count) if noise else 0.2 * np.exp(np.sin(where))))
    basis = random.normal(size=(count if noise else 1, 3, 3)) / extent
    tensor = np.einsum("pij,pkj->pik", basis, basis) + np.eye(3) / extent ** 2
    add(grid.GetPointData(), "metric", (np.exp(0.0 * where if noise else np.sin(where))[:, None, None] * tensor).reshape(count, 9))
    return grid


def corrupted(random, grid):
    """Makes a fault that must be an error. Returns its name, or None if the grid is too small for it."""
    points, n = grid.GetPoints(), grid.GetNumberOfPoints()
    if grid.GetNumberOfCells() == 0:
        return None
    cell = [grid.GetCell(0).GetPointId(i) for i in range(grid.GetCell(0).GetNumberOfPoints())]
    kind, count = grid.GetCellType(0), len(cell)
    fault = random.choice(["a cell twice", "a point twice", "no such point", "a coordinate", "three at a facet", "a short array"])
    if fault == "a cell twice":
        grid.InsertNextCell(kind, count, cell[1:] + cell[:1])
    elif fault == "a point twice":
        grid.InsertNextCell(kind, count, cell[:-1] + cell[:1])
    elif fault == "no such point":
        grid.InsertNextCell(kind, count, cell[:-1] + [int(random.choice([-1, n, 2 ** 40]))])
    elif fault == "a coordinate":
        x = list(points.GetPoint(cell[0]))
        x[int(random.integers(3))] = float(random.choice([np.nan, np.inf, -np.inf]))
        points.SetPoint(cell[0], x)
    elif fault == "three at a facet":
        for k in range(2):
            q = points.InsertNextPoint(*(np.mean([points.GetPoint(p) for p in cell], axis=0) + 0.1 * k))
            grid.InsertNextCell(kind, count, cell[:-1] + [q])
    else:
        short = vtkIntArray()
        short.SetName("short")
        short.SetNumberOfValues(grid.GetNumberOfCells() - 1)
        grid.GetCellData().AddArray(short)
        return fault
    for data, length in ((grid.GetCellData(), grid.GetNumberOfCells()), (grid.GetPointData(), grid.GetNumberOfPoints())):
        for i in range(data.GetNumberOfArrays()):
            data.GetArray(i).Resize(length)
            data.GetArray(i).SetNumberOfTuples(length)
    return fault
