# SPDX-License-Identifier: BSD-3-Clause
"""Tetrahedra of the unit cube adapted to a function, the surface too: mesh -> metric -> surface -> TetGen -> optimize, again and again.

    /usr/bin/python3 adapt_box.py FOLDER [--function tanh|shock|shell] [--elements 8000] [--steps 5]

(or pvpython). Mesh Optimize keeps the surface of tetrahedra, which therefore has to fit the metric before they are made. Each step
1. gets the metric of the function's second derivatives on the mesh there is, from vtkSolutionMetricFilter (L^2 norm; its other
   defaults: edges at most 20 times as long as across, sizes that grow by at most 1.5 from one to the next);
2. divides the edges of the cube into pieces of equal length in it;
3. meshes each side with these divisions kept, by vtkMeshOptimizeFilter in the metric of the plane (both: box_surface.py);
4. fills that surface by vtkTetGenFilter, with the inner nodes of the mesh before: any mesh would do;
5. optimizes the tetrahedra in the metric.
Prints a row per step. Writes FOLDER/filled_NAME.vtu and FOLDER/adapted_NAME.vtu, the last mesh before and after it was optimized, and
FOLDER/box_NAME.png, its lower half. What it reaches is measured by Testing/Benchmarks/adapt_3d.py.
"""
import argparse
import itertools
import os

import numpy as np
from box_surface import add_array, add_metric, mesh_surface, of_eigenvalues, optimize, vtk_cells, vtk_points
from meshoptimize import vtkSolutionMetricFilter, vtkTetGenFilter
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkPolyData, vtkStaticCellLocator, vtkUnstructuredGrid
from vtkmodules.vtkFiltersCore import vtkProbeFilter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

FUNCTIONS = {
    "tanh": lambda x, y, z: np.tanh(60 * (x - 0.5)),
    "shock": lambda x, y, z: np.arctan(60 * (np.sqrt((x - 1.25) ** 2 + (y + 0.25) ** 2 + (z - 0.5) ** 2) - np.pi / 3)),
    "shell": lambda x, y, z: np.exp(-800 * (np.sqrt((x - 0.5) ** 2 + (y - 0.5) ** 2 + (z - 0.5) ** 2) - 0.3) ** 2),
}
EDGES = list(itertools.combinations(range(4), 2))
FACES = [(1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1)]
SEEN = 10000  # elements of the first mesh at least, that the function shows in it
# Four points in a tetrahedron that are exact for polynomials of degree 2
_NEAR, _FAR = (5 + 3 * np.sqrt(5)) / 20, (5 - np.sqrt(5)) / 20
_POINTS = np.full((4, 4), _FAR) + (_NEAR - _FAR) * np.eye(4)


# --- meshes and arrays

def make_grid(points, tetrahedra):
    grid = vtkUnstructuredGrid()
    grid.SetPoints(vtk_points(points))
    grid.SetCells(VTK_TETRA, vtk_cells(tetrahedra))
    return grid


def arrays_of(grid):
    """(points n x 3, tetrahedra m x 4) of a grid of tetrahedra only."""
    points = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    return points, vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4).copy()


def unit_cube(elements):
    """About so many elements: equal boxes of six tetrahedra around a diagonal."""
    n = max(2, round((elements / 6) ** (1 / 3)))
    z, y, x = np.mgrid[0:n + 1, 0:n + 1, 0:n + 1] / n
    step = np.array([1, n + 1, (n + 1) ** 2])
    first = np.mgrid[0:n, 0:n, 0:n].reshape(3, -1).T @ step
    tetrahedra = []
    for order in itertools.permutations(range(3)):
        path = np.concatenate([[0], np.cumsum(step[list(order)])])
        odd = np.linalg.det(np.eye(3)[list(order)]) < 0
        tetrahedra.append(first[:, None] + path[[0, 2, 1, 3] if odd else [0, 1, 2, 3]])
    return make_grid(np.stack([x, y, z], axis=-1).reshape(-1, 3), np.concatenate(tetrahedra))


def outer_faces(tetrahedra):
    """Those of one tetrahedron only; seen from outside counterclockwise."""
    faces = tetrahedra[:, FACES].reshape(-1, 3)
    _, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    return faces[first[count == 1]]


def parts(levels):
    """A tetrahedron cut into 8^levels, in its barycentric coordinates."""
    result = np.eye(4)[None]
    for _ in range(levels):
        corner = [result[:, i] for i in range(4)]
        mid = {e: (corner[e[0]] + corner[e[1]]) / 2 for e in EDGES}
        new = [[corner[i]] + [mid[min(i, j), max(i, j)] for j in range(4) if j != i] for i in range(4)]
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
    return np.sqrt(sum(volumes @ (function(*np.einsum("k,nkx->xn", at, corners)) - values @ at) ** 2 for at in samples) / len(samples))


# --- the metric

def metric_of(grid, function, elements):
    """The logarithm of the metric at the nodes for about so many elements."""
    grid = make_grid(*arrays_of(grid))
    add_array(grid, "u", function(*arrays_of(grid)[0].T))
    metric = vtkSolutionMetricFilter()
    metric.SetInputData(grid)
    metric.SetInputArrayToProcess(0, 0, 0, vtkUnstructuredGrid.FIELD_ASSOCIATION_POINTS, "u")
    metric.SetRecoveryToLeastSquares()
    metric.SetNormOrder(2.0)  # for the L2 norm of the error
    metric.SetDesiredNumberOfElements(elements)
    metric.Update()
    if metric.GetErrorCode() != 0:
        raise RuntimeError("vtkSolutionMetricFilter failed")
    data = metric.GetOutput().GetPointData()
    tensors = vtk_to_numpy(data.GetArray("Metric"))[:, [0, 3, 5, 3, 1, 4, 5, 4, 2]].reshape(-1, 3, 3)
    return of_eigenvalues(tensors / vtk_to_numpy(data.GetArray("DesiredSize"))[:, None, None] ** 2, np.log)


def interpolator(grid, logarithm):
    """logarithm(points): linear in each tetrahedron."""
    source = make_grid(*arrays_of(grid))
    add_array(source, "Logarithm", logarithm.reshape(-1, 9))

    def at(points):
        target = vtkPolyData()
        target.SetPoints(vtk_points(0.5 + (1 - 1e-9) * (points - 0.5)))  # not beside the surface by rounding
        probe = vtkProbeFilter()
        probe.SetInputData(target)
        probe.SetSourceData(source)
        probe.SetCellLocatorPrototype(vtkStaticCellLocator())
        probe.SetComputeTolerance(False)
        probe.SetTolerance(1e-7)
        probe.Update()
        found = probe.GetOutput().GetPointData()
        if not vtk_to_numpy(found.GetArray(probe.GetValidPointMaskArrayName())).all():
            raise RuntimeError("a point is not in the mesh that has the metric")
        return vtk_to_numpy(found.GetArray("Logarithm")).reshape(-1, 3, 3)
    return at


# --- the cube

def fill(surface, triangles, inner):
    """The grid of tetrahedra that TetGen makes; nodes of the surface come first, as they are."""
    closed, nodes = vtkPolyData(), vtkPolyData()
    closed.SetPoints(vtk_points(surface))
    closed.SetPolys(vtk_cells(triangles))
    nodes.SetPoints(vtk_points(inner))
    tetgen = vtkTetGenFilter()
    tetgen.SetInputData(0, closed)
    tetgen.SetInputData(1, nodes)
    tetgen.SetMaximumRadiusEdgeRatio(0)  # shapes are for Mesh Optimize: here they would be those of the space as it is
    tetgen.Update()
    if tetgen.GetErrorCode() != 0:
        raise RuntimeError("vtkTetGenFilter failed")
    return make_grid(*arrays_of(tetgen.GetOutput()))


def processor_seconds():
    return sum(os.times()[:4])  # TetGen runs in a child process


def adapt(function, elements, steps):
    """Yields for each step (mesh before it was optimized, the filter that did it, seconds of the surface, of TetGen, of the optimizer)."""
    grid = unit_cube(max(elements, SEEN))
    for _ in range(steps):
        logarithm = interpolator(grid, metric_of(grid, function, elements))
        points = arrays_of(grid)[0]
        times = [processor_seconds()]
        surface = mesh_surface(logarithm)
        times.append(processor_seconds())
        filled = fill(*surface, points[((points > 0) & (points < 1)).all(axis=1)])
        add_metric(filled, logarithm(arrays_of(filled)[0]))
        times.append(processor_seconds())
        optimizer = optimize(filled, 1.0)
        times.append(processor_seconds())
        grid = optimizer.GetOutput()
        yield filled, optimizer, np.diff(times)


# --- results

def write(grid, path):
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.SetDataModeToBinary()  # Debian's VTK cannot read raw appended data
    writer.SetFileName(path)
    writer.Write()


def draw(grid, function, path):
    """The tetrahedra whose middle is in the lower half, from above."""
    try:
        import matplotlib
    except ImportError:
        print("no picture: matplotlib is not installed")
        return
    matplotlib.use("Agg")
    from matplotlib import pyplot
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection
    points, tetrahedra = arrays_of(grid)
    faces = points[outer_faces(tetrahedra[points[tetrahedra].mean(axis=1)[:, 2] < 0.5])]
    values = function(*faces.mean(axis=1).T)
    figure = pyplot.figure(figsize=(8, 7))
    axes = figure.add_subplot(projection="3d", proj_type="ortho")
    shown = Poly3DCollection(faces, linewidth=0.25, edgecolor="0.2", array=values, cmap="coolwarm")
    axes.add_collection3d(shown)
    axes.set(xlim=(0, 1), ylim=(0, 1), zlim=(0, 1), box_aspect=(1, 1, 1), xlabel="x", ylabel="y",
             title=f"lower half of {len(tetrahedra)} tetrahedra")
    axes.view_init(elev=45, azim=-65)
    figure.savefig(path, dpi=120)
    print("picture:", path)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder")
    parser.add_argument("--function", choices=FUNCTIONS, default="shock")
    parser.add_argument("--elements", type=int, default=8000)
    parser.add_argument("--steps", type=int, default=5)
    options = parser.parse_args()
    os.makedirs(options.folder, exist_ok=True)
    function = FUNCTIONS[options.function]
    uniform = unit_cube(options.elements)
    print(f"uniform mesh: {uniform.GetNumberOfCells()} elements, L2 error {interpolation_error(uniform, function):.3e}")
    print("step  elements filled  adapted  worst quality in the metric before  after  L2 error   s: surface  TetGen  optimizer")
    for step, (filled, optimizer, seconds) in enumerate(adapt(function, options.elements, options.steps), 1):
        grid = optimizer.GetOutput()
        print(f"{step:4} {filled.GetNumberOfCells():16} {grid.GetNumberOfCells():8} {optimizer.GetWorstQualityBefore():35.4f} "
              f"{optimizer.GetWorstQualityAfter():6.3f}  {interpolation_error(grid, function):.3e} {seconds[0]:12.2f} {seconds[1]:7.2f} "
              f"{seconds[2]:10.2f}", flush=True)
    write(filled, os.path.join(options.folder, f"filled_{options.function}.vtu"))
    write(grid, os.path.join(options.folder, f"adapted_{options.function}.vtu"))
    draw(grid, function, os.path.join(options.folder, f"box_{options.function}.png"))


if __name__ == "__main__":
    main()
