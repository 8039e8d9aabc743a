# SPDX-License-Identifier: BSD-3-Clause
"""A mesh on which stresses have the wanted error: sizes from the error estimate of Zienkiewicz and Zhu.

    /usr/bin/python3 adapt_stress.py OUT.vtu [--error 0.03] [--steps 6]

(or pvpython). An L-shaped bracket, held below and pulled sideways at the end of its arm; the stress is singular at its inner corner.
Solve (vtkThermoelasticFilter) -> sizes by which all elements have the same error, and the whole the wanted one
(vtkSolutionMetricFilter, Criterion ErrorIndicator) -> mesh (vtkMeshOptimizeFilter) -> and again. Prints a row per step, and what a
uniform mesh of as many elements has.
"""
import argparse
import sys

import numpy as np
from meshoptimize import vtkMeshOptimizeFilter, vtkSolutionMetricFilter, vtkThermoelasticFilter
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

from adapt_function import make_grid


def bracket():
    """Six triangles: three squares with a corner in common, that in (1, 1)."""
    points = np.array([(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (1, 2), (0, 2), (0, 1)], dtype=float)
    return make_grid(points, [(0, 1, 2), (0, 2, 7), (2, 3, 4), (2, 4, 5), (2, 5, 6), (2, 6, 7)])


def optimize(grid, size=None):
    """To the grid's DesiredSize, or to one size everywhere."""
    optimizer = vtkMeshOptimizeFilter()
    optimizer.SetInputData(grid)
    optimizer.SetBoundaryModeToSlide()
    optimizer.SetBeta(2.0)
    if size:
        optimizer.SetDesiredSize(size)
    else:
        optimizer.SetSizeArray("DesiredSize")
    optimizer.Update()
    if optimizer.GetErrorCode() != 0:
        sys.exit("vtkMeshOptimizeFilter failed")
    return optimizer.GetOutput()


def solve(grid):
    """The filter, updated. Held at y = 0, traction (0, 1) on x = 2."""
    points = vtk_to_numpy(grid.GetPoints().GetData())
    for name, where, value in (("Constraint", points[:, 1] < 1e-9, (1, 1, 1)), ("Traction", points[:, 0] > 2 - 1e-9, (0, 1, 0))):
        array = numpy_to_vtk(where[:, None] * np.array(value, dtype=float), deep=1)
        array.SetName(name)
        grid.GetPointData().AddArray(array)
    fem = vtkThermoelasticFilter()
    fem.SetInputData(grid)
    fem.SetTemperatureModeToUniform()
    fem.SetYoungsModulus(1.0)
    fem.SetPoissonsRatio(0.3)
    fem.SetSolverToDirect()
    fem.Update()
    if fem.GetErrorCode() != 0:
        sys.exit("vtkThermoelasticFilter failed")
    return fem


def sizes(fem, wanted):
    metric = vtkSolutionMetricFilter()
    metric.SetInputData(fem.GetOutput())
    metric.SetCriterionToErrorIndicator()
    metric.SetErrorIndicatorArray("ErrorEstimate")
    metric.SetDesiredErrorFraction(wanted / fem.GetRelativeErrorEstimate())
    metric.Update()
    if metric.GetErrorCode() != 0:
        sys.exit("vtkSolutionMetricFilter failed")
    return metric.GetOutput()


def uniform(elements):
    return optimize(bracket(), np.sqrt(4 / np.sqrt(3) * 3 / elements))


def adapt(wanted, steps):
    """Yields the solution on each mesh, until its error is within 5 % of the wanted one."""
    fem = solve(uniform(200))
    yield fem
    for _ in range(steps):
        if abs(fem.GetRelativeErrorEstimate() / wanted - 1) < 0.05:
            return
        fem = solve(optimize(sizes(fem, wanted)))
        yield fem


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out")
    parser.add_argument("--error", type=float, default=0.03, help="wanted relative error of the stress, in the energy norm")
    parser.add_argument("--steps", type=int, default=6)
    options = parser.parse_args()
    print("step  elements  relative error")
    for step, fem in enumerate(adapt(options.error, options.steps)):
        elements, error = fem.GetOutput().GetNumberOfCells(), fem.GetRelativeErrorEstimate()
        print(f"{step:4}  {elements:8}  {error:.4f}", flush=True)
    plain = solve(uniform(elements))
    print(f"uniform: {plain.GetOutput().GetNumberOfCells()}  {plain.GetRelativeErrorEstimate():.4f}")
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(fem.GetOutput())
    writer.SetDataModeToBinary()  # Debian's VTK cannot read raw appended data
    writer.SetFileName(options.out)
    if writer.Write() != 1 or abs(error / options.error - 1) > 0.05 or plain.GetRelativeErrorEstimate() < 1.5 * error:
        sys.exit("failed")


if __name__ == "__main__":
    main()
