# SPDX-License-Identifier: BSD-3-Clause
"""The bound of a thin plate: an element ends at the other side, so it is far below that of its facets alone.

Against places sought by chance, without a line of the bound's code (Testing/Benchmarks/caps_in_sight.py).
"""
import pathlib
import sys

import numpy as np

from meshoptimize import vtkMeshOptimizeFilter, vtkMeshQualityMinMax

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "Benchmarks"))
from caps_in_sight import best, boundary, surface_of  # noqa: E402
from hard import random_mesh  # noqa: E402
from invariance import grid_of  # noqa: E402


def bound_of(grid):
    measure = vtkMeshQualityMinMax()
    measure.SetInputData(grid)
    measure.Update()
    return measure.GetQualityBound()


points, cells, _ = random_mesh("slab", 60, 5, "vtk")
grid = grid_of(points, cells)
optimize = vtkMeshOptimizeFilter()
optimize.SetInputData(grid)
optimize.SetEffortToQuick()
optimize.Update()
bound, worst = optimize.GetQualityBound(), optimize.GetWorstQualityAfter()

_, locator = surface_of(grid)
random = np.random.default_rng(1)


def area(entry):
    a, b, c = points[entry[0]]
    return np.linalg.norm(np.cross(b - a, c - a))


# Here the facet that sets the bound is one of the smallest.
rows = [best(points[facet], points[fourth], locator, random) for facet, fourth in sorted(boundary(cells), key=area)[:20]]
alone, seen = (min(row[k] for row in rows) for k in (0, 1))
print(f"worst {worst:.3g}, bound {bound:.3g}, by chance {seen:.3g} in sight and {alone:.3g} by the facets' own shape")
assert worst <= bound, "above the bound"
assert 0.9 * bound <= seen <= bound, "not what was found by chance"
assert bound < 0.5 * alone, "what stands opposite was not seen"
assert abs(bound_of(optimize.GetOutput()) - bound) <= 0.01 * bound, "Mesh Quality Min Max says otherwise"
assert bound_of(grid) >= worst, "the input's bound does not hold"
