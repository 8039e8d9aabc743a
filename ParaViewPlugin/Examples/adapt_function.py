# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of the unit square adapted to a function: mesh -> metric -> optimize, again and again.

    /usr/bin/python3 adapt_function.py FOLDER [--function tanh|shock|ring] [--elements 10000] [--steps 5] [--doublings 5]

(or pvpython). Starts from two triangles. Each step puts the values of the function at the nodes, gets the metric of its second
derivatives from vtkSolutionMetricFilter, and has vtkMeshOptimizeFilter make the mesh that is right in that metric. Prints a row
per step, then the error of the interpolation for numbers of elements that double each time. Writes FOLDER/adapted_NAME.vtu, and
FOLDER/adapt_NAME.png: the error against the number of elements, and the mesh.
"""
import argparse
import os
import time

import numpy as np
from meshoptimize import vtkMeshOptimizeFilter, vtkSolutionMetricFilter
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TRIANGLE, vtkCellArray, vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

FUNCTIONS = {
    "tanh": lambda x, y: np.tanh(60 * (x - 0.5)),
    "shock": lambda x, y: np.arctan(60 * (np.hypot(x - 1.25, y + 0.25) - np.pi / 3)),
    "ring": lambda x, y: np.exp(-800 * (np.hypot(x - 0.5, y - 0.5) - 0.3) ** 2),
}
# Seven points in a triangle that are exact for polynomials of degree 5 (J. Radon, 1948)
_A, _B = (6 - np.sqrt(15)) / 21, (6 + np.sqrt(15)) / 21
_POINTS = np.array([[1 / 3, 1 / 3, 1 / 3]] + [np.roll([1 - 2 * c, c, c], k) for c in (_A, _B) for k in range(3)])
_WEIGHTS = np.array([9 / 40] + 3 * [(155 - np.sqrt(15)) / 1200] + 3 * [(155 + np.sqrt(15)) / 1200])


def make_grid(points, triangles):
    grid, vtk_points, cells = vtkUnstructuredGrid(), vtkPoints(), vtkCellArray()
    vtk_points.SetData(numpy_to_vtk(np.column_stack([points[:, :2], np.zeros(len(points))]), deep=1))
    cells.SetData(3, numpy_to_vtkIdTypeArray(np.asarray(triangles, dtype=np.int64).reshape(-1), deep=1))
    grid.SetPoints(vtk_points)
    grid.SetCells(VTK_TRIANGLE, cells)
    return grid


def arrays_of(grid):
    """(points n x 2, triangles m x 3) of a grid of triangles only."""
    points = vtk_to_numpy(grid.GetPoints().GetData())[:, :2].astype(float)
    return points, vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 3).copy()


def unit_square(n=1):
    """n x n squares of two triangles each."""
    y, x = np.mgrid[0:n + 1, 0:n + 1] / n
    a = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).reshape(-1)
    triangles = np.concatenate([np.stack([a, a + 1, a + n + 2], axis=1), np.stack([a, a + n + 2, a + n + 1], axis=1)])
    return make_grid(np.stack([x.reshape(-1), y.reshape(-1)], axis=1), triangles)


def interpolation_error(grid, function, levels=2):
    """L2 norm of the function minus its linear interpolation: each triangle cut into 4^levels, seven points in each."""
    points, triangles = arrays_of(grid)
    corners = points[triangles]
    edges = corners[:, 1:] - corners[:, :1]
    areas = np.abs(edges[:, 0, 0] * edges[:, 1, 1] - edges[:, 0, 1] * edges[:, 1, 0]) / 2
    parts = np.eye(3)[None]
    for _ in range(levels):
        a, b, c = (parts[:, i] for i in range(3))
        d, e, f = (b + c) / 2, (c + a) / 2, (a + b) / 2
        parts = np.concatenate([np.stack(part, axis=1) for part in ((a, f, e), (f, b, d), (e, d, c), (d, e, f))])
    values = function(*points.T)[triangles]
    total = 0.0
    for part in parts:
        for weight, at in zip(_WEIGHTS / len(parts), _POINTS @ part):
            x = at @ corners
            total += weight * areas @ (function(*x.T) - values @ at) ** 2
    return np.sqrt(total)


def add_metric(grid, function, elements, correction=1.0, norm_order=2.0):
    """(grid with the point arrays Metric and DesiredSize, number of elements that is expected of it)."""
    values = numpy_to_vtk(function(*arrays_of(grid)[0].T), deep=1)
    values.SetName("u")
    grid.GetPointData().SetScalars(values)
    metric = vtkSolutionMetricFilter()
    metric.SetInputData(grid)
    metric.SetRecoveryToLeastSquares()
    metric.SetNormOrder(norm_order)  # 2: for the L2 norm of the error
    metric.SetDesiredNumberOfElements(elements)
    metric.SetCountCorrection(correction)
    metric.Update()
    if metric.GetErrorCode() != 0:
        raise RuntimeError("vtkSolutionMetricFilter failed")
    return metric.GetOutput()


def optimize(grid, size=None, threads=0):
    """(mesh, seconds): in the grid's Metric and to its DesiredSize; if a size is given, to that size in the plane as it is."""
    optimizer = vtkMeshOptimizeFilter()
    optimizer.SetInputData(grid)
    optimizer.SetNumberOfThreads(threads)
    optimizer.SetBoundaryModeToSlide()
    optimizer.SetBeta(2.0)
    if size:
        optimizer.SetDesiredSize(size)
    else:
        optimizer.SetMetricArray("Metric")
        optimizer.SetSizeArray("DesiredSize")
    start = time.perf_counter()
    optimizer.Update()
    if optimizer.GetErrorCode() != 0:
        raise RuntimeError("vtkMeshOptimizeFilter failed")
    return optimizer.GetOutput(), time.perf_counter() - start


def uniform(elements):
    """(mesh, seconds): from two triangles, edges of one length."""
    return optimize(unit_square(), np.sqrt(4 / np.sqrt(3) / elements))


def adapt(function, elements, steps, first=uniform, mesher=optimize):
    """Yields for each step (mesh, the grid with the metric that it was made in, seconds of the mesher)."""
    grid, seconds = first(elements)
    yield grid, None, seconds
    correction = 1.0
    for _ in range(steps):
        background = add_metric(grid, function, elements, correction)
        grid, seconds = mesher(background)
        correction = min(max(correction * grid.GetNumberOfCells() / elements, 0.2), 5.0)
        yield grid, background, seconds


def slope(numbers, errors):
    return np.polyfit(np.log(numbers), np.log(errors), 1)[0]


def draw(grid, uniform_rows, adapted_rows, name, path):
    try:
        import matplotlib
    except ImportError:
        print("no picture: matplotlib is not installed")
        return
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(11, 5), layout="constrained")
    for rows, label, marker in ((uniform_rows, "uniform", "s"), (adapted_rows, "adapted", "o")):
        left.loglog(*np.transpose(rows), marker=marker, label=f"{label}, slope {slope(*np.transpose(rows)):.2f}")
    left.set(xlabel="elements", ylabel="L2 error of the interpolation", title=name)
    left.grid(True, which="both", color="0.9")
    left.legend()
    points, triangles = arrays_of(grid)
    right.triplot(*points.T, triangles, linewidth=0.3, color="0.2")
    right.set(aspect="equal", title=f"{len(triangles)} elements", xlim=(0, 1), ylim=(0, 1))
    figure.savefig(path, dpi=110)
    print("picture:", path)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder")
    parser.add_argument("--function", choices=FUNCTIONS, default="tanh")
    parser.add_argument("--elements", type=int, default=10000)
    parser.add_argument("--steps", type=int, default=5)
    parser.add_argument("--doublings", type=int, default=5)
    options = parser.parse_args()
    os.makedirs(options.folder, exist_ok=True)
    function = FUNCTIONS[options.function]

    print("step  nodes  elements  L2 error   seconds")
    for step, (grid, _, seconds) in enumerate(adapt(function, options.elements, options.steps)):
        print(f"{step:4} {grid.GetNumberOfPoints():6} {grid.GetNumberOfCells():9}  {interpolation_error(grid, function):.3e}"
              f"  {seconds:8.2f}", flush=True)
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.SetDataModeToBinary()  # Debian's VTK cannot read raw appended data
    writer.SetFileName(os.path.join(options.folder, f"adapted_{options.function}.vtu"))
    writer.Write()

    rows = {"uniform": [], "adapted": []}
    for doubling in range(options.doublings, -1, -1):
        meshes = list(adapt(function, options.elements // 2 ** doubling, options.steps))
        for kind, mesh in (("uniform", meshes[0][0]), ("adapted", meshes[-1][0])):
            rows[kind].append((mesh.GetNumberOfCells(), interpolation_error(mesh, function)))
    print("\nuniform             adapted\nelements  L2 error   elements  L2 error")
    for one, other in zip(*rows.values()):
        print(f"{one[0]:8}  {one[1]:.3e}  {other[0]:8}  {other[1]:.3e}")
    print("slopes: " + ", ".join(f"{kind} {slope(*np.transpose(row)):.2f}" for kind, row in rows.items()))
    path = os.path.join(options.folder, f"adapt_{options.function}.png")
    draw(grid, rows["uniform"], rows["adapted"], options.function, path)


if __name__ == "__main__":
    main()
