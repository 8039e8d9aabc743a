# SPDX-License-Identifier: BSD-3-Clause
"""The surface of the unit cube as triangles that are right in a metric, so that tetrahedra on it can be: mesh_surface().

In the metric edges shall have the length 1. It is given as a function: its logarithm (n x 3 x 3) at n points.
Used by adapt_box.py.
"""
import itertools

import numpy as np
from adapt_function import arrays_of, make_grid
from meshoptimize import vtkMeshOptimizeFilter
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray

SAMPLES = 2000  # along an edge of the cube
RINGS, ROUNDS = 8, 5  # of triangles on a side, to begin with; of its optimization


def vtk_points(points):
    result = vtkPoints()
    result.SetData(numpy_to_vtk(np.ascontiguousarray(points, dtype=float), deep=1))
    return result


def vtk_cells(cells):
    result = vtkCellArray()
    result.SetData(cells.shape[1], numpy_to_vtkIdTypeArray(np.ascontiguousarray(cells, dtype=np.int64).reshape(-1), deep=1))
    return result


def add_array(grid, name, values):
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=1)
    array.SetName(name)
    grid.GetPointData().AddArray(array)


def of_eigenvalues(tensors, function):
    values, vectors = np.linalg.eigh(tensors)
    return np.einsum("nij,nj,nkj->nik", vectors, function(values), vectors)


def lengths(vectors, metric):
    return np.sqrt(np.einsum("ni,nij,nj->n", vectors, metric, vectors))


def add_metric(grid, logarithm):
    """The metric and its logarithm, which Mesh Optimize passes on to the nodes of the result, as point arrays."""
    add_array(grid, "Logarithm", logarithm.reshape(-1, 9))
    add_array(grid, "Metric", of_eigenvalues(logarithm, np.exp).reshape(-1, 9)[:, [0, 4, 8, 1, 5, 2]])


def optimize(grid, beta):
    """The filter, after it has made edges of length 1 in the array Metric."""
    optimizer = vtkMeshOptimizeFilter()
    optimizer.SetInputData(grid)
    optimizer.SetBeta(beta)
    optimizer.SetMetricArray("Metric")
    optimizer.SetDesiredSize(1.0)
    optimizer.Update()
    if optimizer.GetErrorCode() != 0:
        raise RuntimeError("vtkMeshOptimizeFilter failed")
    return optimizer


def divide_edge(logarithm, a, b):
    """Points between a and b, which cut the edge into pieces of about the length 1, all equally long."""
    middles = (np.arange(SAMPLES) + 0.5) / SAMPLES
    along = np.tile(b - a, (SAMPLES, 1))
    length = np.concatenate([[0], np.cumsum(lengths(along, of_eigenvalues(logarithm(a + middles[:, None] * along), np.exp)))]) / SAMPLES
    pieces = max(1, round(length[-1]))
    cuts = np.interp(np.arange(1, pieces) / pieces * length[-1], length, np.arange(SAMPLES + 1) / SAMPLES)
    return a + cuts[:, None] * (b - a)


def rings(loop):
    """(points, triangles) that fill a loop of points around the unit square: the loop, made smaller again and again, and the middle."""
    n = len(loop)
    points = np.concatenate([loop] + [0.5 + (1 - k / RINGS) * (loop - 0.5) for k in range(1, RINGS)] + [[[0.5, 0.5]]])
    here, after = np.arange(n), np.roll(np.arange(n), -1)
    triangles = [np.stack(t, axis=1) + k * n for k in range(RINGS - 1) for t in ((here, after, after + n), (here, after + n, here + n))]
    last = (RINGS - 1) * n
    return points, np.concatenate(triangles + [np.stack([here + last, after + last, np.full(n, last + n)], axis=1)])


def mesh_side(logarithm, loop, lift, axes):
    """(points, triangles) in the plane of these two axes; the points of the loop come first, as they were.

    Several rounds, since the metric is taken at the nodes there are.
    """
    points, triangles = rings(loop)
    for _ in range(ROUNDS):
        grid = make_grid(points, triangles)
        metric = np.tile(np.eye(3), (len(points), 1, 1))
        metric[:, :2, :2] = of_eigenvalues(logarithm(lift(points)), np.exp)[:, axes][:, :, axes]
        add_metric(grid, of_eigenvalues(metric, np.log))
        before = points
        points, triangles = arrays_of(optimize(grid, 2.0).GetOutput())
        if np.array_equal(points, before):
            break
    if not np.array_equal(points[:len(loop)], loop):
        raise RuntimeError("the boundary of a side has changed")
    return points, triangles


def mesh_surface(logarithm):
    """(points, triangles) of the surface of the unit cube in that metric; two sides have the nodes of their edge in common."""
    points = np.array([[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)], dtype=float)
    edges, triangles = {}, []
    for a, axis in itertools.product(range(8), range(3)):
        b = a | 1 << axis
        if a != b:
            new = divide_edge(logarithm, points[a], points[b])
            edges[a, b] = list(range(len(points), len(points) + len(new)))
            edges[b, a] = edges[a, b][::-1]
            points = np.concatenate([points, new])
    for axis, side in itertools.product(range(3), range(2)):
        plane = [(axis + 1) % 3, (axis + 2) % 3]
        corners = [side << axis | i << plane[0] | j << plane[1] for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
        loop = [p for a, b in zip(corners, corners[1:] + corners[:1]) for p in [a, *edges[a, b]]]

        def lift(x):
            result = np.full((len(x), 3), float(side))
            result[:, plane] = x
            return result
        new, cells = mesh_side(logarithm, points[loop][:, plane], lift, plane)
        ids = np.concatenate([loop, np.arange(len(points), len(points) + len(new) - len(loop))])
        points = np.concatenate([points, lift(new[len(loop):])])
        triangles.append(ids[cells if side else cells[:, ::-1]])
    return points, np.concatenate(triangles)
