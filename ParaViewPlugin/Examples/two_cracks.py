# SPDX-License-Identifier: BSD-3-Clause
"""The two cracks of the paper (section 5.3): an adaptive computation that starts from 14 triangles.

    /usr/bin/python3 two_cracks.py FOLDER [--elements 9589] [--steps 4] [--gap 0.037] [--angle 10] [--lumped]

(or pvpython). Two collinear cracks of length 2a = 2, the right one turned about its centre, under unit tension. First mesh ->
uniform mesh of about the wanted number of elements -> vtkThermoelasticFilter -> vtkSolutionMetricFilter on the displacement ->
vtkMeshOptimizeFilter -> and again from the solution on. Prints a row per mesh with the stress intensity factors of the four tips,
and draws the paper's figures 5 to 8 and the convergence into FOLDER.

The paper does not give the size of its plate. Here it is 5a to each side, and on its sides act the tractions that there are in an
infinite plane with these cracks, by the method of singular integral equations (Testing/Paper/two_cracks_reference.py): so it is a
piece cut out of the plane, and has the plane's stress intensity factors.
"""
import argparse
import os
import sys
import time

import numpy as np
from meshoptimize import vtkMeshOptimizeFilter, vtkSolutionMetricFilter, vtkThermoelasticFilter
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import VTK_LINE, VTK_TRIANGLE, vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

from adapt_function import arrays_of, make_grid
from stress_intensity import Material, Solution, Tip, displacement_extrapolation, interaction_integral

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../Testing/Paper"))
from two_cracks_reference import two_cracks  # noqa: E402

WIDTH = 5.0  # half of the plate's side
MATERIAL = Material(1.0, 0.3)
TIPS = ("left outer", "left inner", "right inner", "right outer")


def first_mesh(cracks):
    """As simple as can be: the corners of the plate, the ends of the cracks, and a point in the middle of each face of a crack.
    (A crack with no point between its ends would be an edge like any other.)"""
    ends = cracks.positions(np.array([-1.0, 0.0, 1.0]))
    corners = WIDTH * np.array([-1 - 1j, 1 - 1j, 1 + 1j, -1 + 1j])
    (a, m, b), (c, n, d) = ends
    z = np.concatenate([corners, [a, m, m, b, c, n, n, d]])
    low_left, low_right, high_right, high_left, a, m_above, m_below, b, c, n_above, n_below, d = range(12)
    triangles = [(a, m_above, high_left), (m_above, b, high_left), (b, high_right, high_left), (b, c, high_right),
                 (c, n_above, high_right), (n_above, d, high_right), (high_right, d, low_right),
                 (d, n_below, low_right), (n_below, c, low_right), (c, low_left, low_right), (c, b, low_left),
                 (b, m_below, low_left), (m_below, a, low_left), (a, high_left, low_left)]
    x, y, w = z[np.array(triangles)].T
    if ((y - x).conj() * (w - x)).imag.min() <= 0:
        raise ValueError("the cracks are not near enough to the x axis for this first mesh")
    return make_grid(np.stack([z.real, z.imag], axis=1), triangles)


def geometry(cracks):
    """The boundary as lines, with the point array Corner: 1 at the plate's corners and at the tips. A crack is one line."""
    corners = WIDTH * np.array([-1 - 1j, 1 - 1j, 1 + 1j, -1 + 1j])
    z = np.concatenate([corners, cracks.positions(np.array([-1.0, 1.0])).reshape(-1)])
    lines = vtkPolyData()
    lines.SetPoints(make_grid(np.stack([z.real, z.imag], axis=1), []).GetPoints())
    lines.AllocateEstimate(3, 5)
    for ids in ((0, 1, 2, 3, 0), (4, 5), (6, 7)):
        lines.InsertNextCell(4, len(ids), ids)  # VTK_POLY_LINE
    flags = numpy_to_vtk(np.ones(len(z), dtype=np.uint8), deep=1)
    flags.SetName("Corner")
    lines.GetPointData().AddArray(flags)
    return lines


def tips_of(cracks):
    """Left to right, as in TIPS."""
    ends = cracks.positions(np.array([-1.0, 1.0]))
    along = np.exp(1j * cracks.angle[:, 0])
    return [Tip((z.real, z.imag), (sign * e.real, sign * e.imag))
            for crack, e in zip(ends, along) for z, sign in zip(crack, (-1, 1))]


def tractions(cracks, a, b):
    """On edges from a to b (n x 2) of the plate's sides: the mean of what the plane has at Gauss's two points. Corrected by what
    the sum of the forces and of the moments is not quite zero."""
    middle, half = (a + b) / 2, (b - a) / 2
    normal = np.where(np.abs(middle) > WIDTH * (1 - 1e-9), np.sign(middle), 0.0)
    xx, yy, xy = np.mean([cracks.stress((middle + s * half) @ [1, 1j]) for s in (-3 ** -0.5, 3 ** -0.5)], axis=0).T
    traction = np.stack([xx * normal[:, 0] + xy * normal[:, 1], xy * normal[:, 0] + yy * normal[:, 1]], axis=1)
    one, zero = np.ones(len(a)), np.zeros(len(a))
    motions = np.array([[one, zero], [zero, one], [-middle[:, 1], middle[:, 0]]])
    weighted = motions * np.hypot(*half.T)
    excess = np.linalg.solve(np.einsum("ike,jke->ij", weighted, motions), np.einsum("ike,ek->i", weighted, traction))
    return traction - np.einsum("i,ike->ek", excess, motions)


def solve(grid, cracks):
    """The filter, updated."""
    points, triangles = arrays_of(grid)
    edges = np.stack(Solution(points, triangles, None).boundary()[:2], axis=1)
    edges = edges[np.abs(points[edges].mean(axis=1)).max(axis=1) > WIDTH * (1 - 1e-9)]
    loaded = vtkUnstructuredGrid()
    loaded.DeepCopy(grid)
    for edge in edges.tolist():
        loaded.InsertNextCell(VTK_LINE, 2, edge)
    traction = np.zeros((loaded.GetNumberOfCells(), 3))
    traction[len(triangles):, :2] = tractions(cracks, *points[edges].transpose(1, 0, 2))
    array = numpy_to_vtk(traction, deep=1)
    array.SetName("FacetTraction")
    loaded.GetCellData().Initialize()
    loaded.GetCellData().AddArray(array)
    fem = vtkThermoelasticFilter()
    fem.SetInputData(loaded)
    fem.SetTemperatureModeToUniform()
    fem.SetYoungsModulus(MATERIAL.youngs_modulus)
    fem.SetPoissonsRatio(MATERIAL.poissons_ratio)
    fem.SetRigidMotionToPin()
    fem.SetSolverToDirect()
    fem.Update()
    if fem.GetErrorCode() != 0:
        sys.exit("vtkThermoelasticFilter failed")
    return fem


def triangles_only(grid):
    """Without the lines that solve() has added."""
    types = np.array([grid.GetCellType(i) for i in range(grid.GetNumberOfCells())])
    ids = vtk_to_numpy(grid.GetCells().GetConnectivityArray())[:3 * np.count_nonzero(types == VTK_TRIANGLE)]
    result = make_grid(vtk_to_numpy(grid.GetPoints().GetData()), ids.reshape(-1, 3))
    result.GetPointData().ShallowCopy(grid.GetPointData())
    return result


def optimize(grid, lines, size=None):
    """In the grid's metric, or to one size. The boundary follows the lines in every step, not what the last mesh had of them."""
    optimizer = vtkMeshOptimizeFilter()
    optimizer.SetInputData(grid)
    optimizer.SetGeometryData(lines)
    optimizer.SetCornerArray("Corner")
    optimizer.SetBoundaryModeToSlide()
    optimizer.SetBeta(2.0)
    if size:
        optimizer.SetDesiredSize(size)
    else:
        optimizer.SetMetricArray("Metric")
        optimizer.SetSizeArray("DesiredSize")
    optimizer.Update()
    if optimizer.GetErrorCode() != 0:
        sys.exit("vtkMeshOptimizeFilter failed")
    return optimizer.GetOutput()


def metric_of(solution, elements, correction, least, lumped=False):
    """Of the displacement, with the paper's (5.2); as there, sizes may grow as fast as they like. Second derivatives at the tips, which
    are on the boundary, come by least squares from the elements around them; with the paper's (5.4) from the nodes inside, so that
    it takes more steps until the elements there are small."""
    metric = vtkSolutionMetricFilter()
    metric.SetInputData(triangles_only(solution))
    metric.SetSolutionArray("Displacement")
    metric.SetDesiredNumberOfElements(elements)
    metric.SetCountCorrection(correction)
    metric.SetMinimumSize(least)
    metric.SetGradation(0)
    metric.SetRecovery(metric.LumpedMass if lumped else metric.LeastSquares)
    metric.Update()
    if metric.GetErrorCode() != 0:
        sys.exit("vtkSolutionMetricFilter failed")
    return metric.GetOutput()


def intensities(solution, cracks):
    """[tip, method, mode]: by the interaction integral, by the opening of the crack; nan where the mesh is too coarse.
    The radius: less than half of the way to the other crack."""
    tips = tips_of(cracks)
    result = np.full((4, 2, 2), np.nan)
    for i, tip in enumerate(tips):
        other = cracks.positions(np.linspace(-1, 1, 201))[1 - i // 2]
        radius = 0.45 * min(np.abs(other - complex(*tip.position)).min(), 1.0)
        try:
            result[i, 0] = interaction_integral(solution, tip, MATERIAL, radius)
            result[i, 1] = displacement_extrapolation(solution, tip, MATERIAL, np.linspace(0.1, 0.5, 9) * radius)
        except ValueError:
            pass
    return result


def tip_sizes(solution, cracks):
    """Mean length of the edges at each tip."""
    sizes = []
    for tip in tips_of(cracks):
        node = np.argmin(np.hypot(*(solution.points - tip.position).T))
        around = np.unique(solution.triangles[(solution.triangles == node).any(axis=1)])
        distance = np.hypot(*(solution.points[around] - tip.position).T)
        sizes.append(distance[distance > 0].mean())
    return np.array(sizes)


def loop(cracks, elements, steps, least=1e-4, lumped=False):
    """Yields (name, mesh, solution grid, seconds so far): the uniform mesh and each adapted one."""
    start, correction, lines = time.perf_counter(), 1.0, geometry(cracks)
    mesh = optimize(first_mesh(cracks), lines, np.sqrt(4 / np.sqrt(3) * (2 * WIDTH) ** 2 / elements))
    for step in range(steps + 1):
        solved = solve(mesh, cracks).GetOutput()
        yield "uniform" if step == 0 else f"step {step}", mesh, solved, time.perf_counter() - start
        if step < steps:
            mesh = optimize(metric_of(solved, elements, correction, least, lumped), lines)
            correction = min(max(correction * mesh.GetNumberOfCells() / elements, 0.2), 5.0)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder")
    parser.add_argument("--elements", type=int, default=9589)
    parser.add_argument("--steps", type=int, default=4)
    parser.add_argument("--gap", type=float, default=0.037, help="between the inner tips before the turn, in parts of 2a")
    parser.add_argument("--angle", type=float, default=10.0, help="degrees")
    parser.add_argument("--least", type=float, default=1e-4, help="shortest edge to be wanted, in parts of a")
    parser.add_argument("--lumped", action="store_true", help="second derivatives by the paper's (5.4)")
    options = parser.parse_args()
    os.makedirs(options.folder, exist_ok=True)
    cracks = two_cracks(options.gap, options.angle)
    exact = cracks.intensity().reshape(4, 2)

    print("K_I over that of the reference, by the interaction integral and by the opening; size of the elements at the tip\n"
          "mesh     nodes  elements " + "".join(f"{name:>24}" for name in TIPS) + "  sizes outer/inner  seconds")
    meshes, rows = [first_mesh(cracks)], []
    for name, mesh, solved, seconds in loop(cracks, options.elements, options.steps, options.least, options.lumped):
        solution = Solution.of_grid(solved)
        found, sizes = intensities(solution, cracks), tip_sizes(solution, cracks)
        rows.append(found[:, :, 0] / exact[:, :1])
        meshes.append(mesh)
        print(f"{name:8} {mesh.GetNumberOfPoints():5}  {mesh.GetNumberOfCells():8} "
              + "".join(f"{k[0]:9.4f} {k[1]:6.3f} {size:7.5f}" for k, size in zip(rows[-1], sizes))
              + f"  {(sizes[0] + sizes[3]) / (sizes[1] + sizes[2]):17.2f}  {seconds:7.1f}", flush=True)
    k = found[:, 0, 0]
    print(f"K_I at the inner tips over that at the outer ones: {(k[1] + k[2]) / (k[0] + k[3]):.3f}; "
          f"reference {exact[1:3, 0].sum() / exact[[0, 3], 0].sum():.3f}")
    print("K_II found:", ", ".join(f"{v:.4f}" for v in found[:, 0, 1]), "reference:", ", ".join(f"{v:.4f}" for v in exact[:, 1]))
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(triangles_only(solved))
    writer.SetDataModeToBinary()  # Debian's VTK cannot read raw appended data
    writer.SetFileName(os.path.join(options.folder, "two_cracks.vtu"))
    writer.Write()
    try:
        from two_cracks_figures import draw
    except ImportError as missing:
        sys.exit(f"no figures: {missing}")
    draw(meshes, solved, cracks, WIDTH, tips_of(cracks), np.array(rows), options.folder)


if __name__ == "__main__":
    main()
