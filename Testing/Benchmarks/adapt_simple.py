# SPDX-License-Identifier: BSD-3-Clause
"""Plane meshes from almost nothing, by Mesh Optimize: two triangles, a disc of 14 triangles, an L; a metric that is the same everywhere.

    /usr/bin/python3 adapt_simple.py

A row for each: elements, the number predicted (5.3), worst quality (the paper's S), share of the edges that are right to a factor of
sqrt 2, seconds. The exit status says whether the counts are within 10 % of the predicted ones, the worst quality is .6 at least, the disc
is round to 1e-4 of its radius, and the metric M gives the mesh that the points mapped by M^(1/2) give without one.
"""
import os
import sys
import time

import numpy as np
from meshoptimize import vtkMeshOptimizeFilter
from vtkmodules.util.numpy_support import numpy_to_vtk

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../ParaViewPlugin/Examples"))
from adapt_function import arrays_of, make_grid, unit_square  # noqa: E402
from adapt_stress import bracket  # noqa: E402

failures = []


def check(condition, *message):
    if not condition:
        failures.append(" ".join(str(m) for m in message))


def disc(n=16):
    """Radius 1: n points on the circle, all triangles with the first of them."""
    angle = 2 * np.pi * np.arange(n) / n
    return make_grid(np.stack([np.cos(angle), np.sin(angle)], axis=1), [(0, i, i + 1) for i in range(1, n - 1)])


def mapped(grid, m):
    points, triangles = arrays_of(grid)
    return make_grid(points @ m, triangles)


def with_metric(grid, m):
    array = numpy_to_vtk(np.tile([m[0, 0], m[1, 1], 1, m[0, 1], 0, 0], (grid.GetNumberOfPoints(), 1)), deep=1)
    array.SetName("Metric")
    grid.GetPointData().AddArray(array)
    return grid


def optimize(grid, size, metric, corner):
    """(filter, seconds)"""
    optimizer = vtkMeshOptimizeFilter()
    optimizer.SetInputData(grid)
    optimizer.SetBoundaryModeToSlide()
    optimizer.SetBeta(2.0)
    optimizer.SetCornerAngle(corner)
    optimizer.SetDesiredSize(size)
    optimizer.SetMetricArray(metric)
    start = time.perf_counter()
    optimizer.Update()
    if optimizer.GetErrorCode() != 0:
        sys.exit("vtkMeshOptimizeFilter failed")
    return optimizer, time.perf_counter() - start


def shapes(points, triangles):
    sides = points[np.roll(triangles, -1, axis=1)] - points[triangles]
    double = sides[:, 0, 0] * sides[:, 1, 1] - sides[:, 0, 1] * sides[:, 1, 0]
    return 36 / np.sqrt(3) * double / 2 / np.sqrt((sides ** 2).sum(axis=2)).sum(axis=1) ** 2, double.sum() / 2


def row(name, grid, size, area, metric=None, root=None, corner=45):
    optimizer, seconds = optimize(grid, size, metric, corner)
    points, triangles = arrays_of(optimizer.GetOutput())
    quality, found = shapes(points if root is None else points @ root, triangles)
    predicted = 4 / np.sqrt(3) * area / size ** 2
    print(f"| {name} | {len(triangles)} | {predicted:.0f} | {quality.min():.3f} | {optimizer.GetEdgeLengthShare():.1%} | {seconds:.2f} |",
          flush=True)
    check(abs(len(triangles) / predicted - 1) < 0.1, name, "elements", len(triangles), "predicted", predicted)
    check(abs(found / area - 1) < 2e-3, name, "area", found, "not", area)
    return points, triangles, quality.min()


print("| mesh | elements | predicted | worst quality | edges in [.71, 1.41] | s |\n|---|---|---|---|---|---|")
for parts in (50, 200):
    worst = row(f"square from two triangles, h* = 1/{parts}", unit_square(), 1 / parts, 1.0)[2]
    check(worst >= 0.6, "two triangles: worst quality", worst)
points, triangles, worst = row("disc from 16 points, h* = R/30", disc(), 1 / 30, np.pi)
check(worst >= 0.6, "disc: worst quality", worst)
edges = np.sort(triangles[:, [(0, 1), (1, 2), (2, 0)]].reshape(-1, 2), axis=1)
edges, count = np.unique(edges, axis=0, return_counts=True)
roundness = np.abs(np.hypot(*points[np.unique(edges[count == 1])].T) - 1).max()
print(f"\nThe disc's boundary nodes are at 1 to {roundness:.1e} from its centre.\n")
check(roundness < 1e-4, "disc: roundness", roundness)
row("L from six triangles, h* = 1/50", bracket(), 1 / 50, 3.0)
for angle in (0, 25):
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    root = np.array([[c, -s], [s, c]]) @ np.diag([4.0, 0.5]) @ np.array([[c, s], [-s, c]])
    size, name = 1 / 25, f"square, edges 1/100 and 1/12.5 long, turned by {angle}"
    inside = row(name, with_metric(unit_square(), root @ root), size, 2.0, "Metric", root, corner=1)
    outside = row(name + ", mapped", mapped(unit_square(), root), size, 2.0, corner=1)
    check(abs(len(inside[1]) / len(outside[1]) - 1) < 0.02, "metric", len(inside[1]), "elements, mapped", len(outside[1]))
    check(abs(inside[2] - outside[2]) < 0.05, "metric: worst", inside[2], "mapped", outside[2])
print("\n".join(failures) or "passed")
sys.exit(len(failures) > 0)
