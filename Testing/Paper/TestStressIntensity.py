# SPDX-License-Identifier: BSD-3-Clause
"""stress_intensity.py (an example): one crack and two collinear ones in a plate, graded meshes of right triangles."""
import os
import sys

import numpy as np
from meshoptimize import vtkThermoelasticFilter
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TRIANGLE, vtkCellArray, vtkUnstructuredGrid

from two_cracks_reference import closed_form

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../ParaViewPlugin/Examples"))
from stress_intensity import (Material, Solution, Tip, displacement_extrapolation,  # noqa: E402
                              interaction_integral, near_tip_field)

failures = []


def check(condition, *message):
    if not condition:
        failures.append(" ".join(str(m) for m in message))


def graded(knots, least, growth):
    """Lines through the knots; intervals have the length `least` at knots of kind 1, and grow away from them.
    knots: (position, kind); the first and the last may be of kind 0."""
    lines = [knots[0][0]]
    for (a, kind_a), (b, kind_b) in zip(knots, knots[1:]):
        steps = []
        while sum(steps) < (b - a) / (2 if kind_a and kind_b else 1):
            steps.append(least * growth ** len(steps))
        steps = steps + steps[::-1] if kind_a and kind_b else steps if kind_a else steps[::-1]
        lines += list(a + np.cumsum(steps) * ((b - a) / sum(steps)))
        lines[-1] = b
    return np.array(lines)


def plate(tips, width, least, growth=1.25):
    """[-width, width]^2 with cracks on the x axis, from tips[0] to tips[1], tips[2] to tips[3], ...: points, triangles.
    Nodes between tips are there twice."""
    x = graded([(-width, 0)] + [(t, 1) for t in tips] + [(width, 0)], least, growth)
    y = graded([(-width, 0), (0, 1), (width, 0)], least, growth)
    points = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    ids = np.arange(len(points)).reshape(len(y), len(x))
    above, below = ids.copy(), ids
    row = np.flatnonzero(y == 0)[0]
    slit = np.zeros(len(x), dtype=bool)
    for left, right in zip(tips[::2], tips[1::2]):
        slit |= (x > left) & (x < right)
    above[row, slit] = len(points) + np.arange(slit.sum())
    points = np.concatenate([points, points[ids[row, slit]]])
    triangles = []
    for j in range(len(y) - 1):
        low, high = (above if j == row else below)[j], below[j + 1]
        a, b, c, d = low[:-1], low[1:], high[1:], high[:-1]
        odd = (np.arange(len(a)) + j) % 2 == 1
        triangles.append(np.where(odd[:, None], np.stack([a, b, d], 1), np.stack([a, b, c], 1)))
        triangles.append(np.where(odd[:, None], np.stack([b, c, d], 1), np.stack([a, c, d], 1)))
    return points, np.concatenate(triangles)


def as_grid(points, triangles):
    grid, vtk_points, cells = vtkUnstructuredGrid(), vtkPoints(), vtkCellArray()
    vtk_points.SetData(numpy_to_vtk(np.column_stack([points, np.zeros(len(points))]), deep=1))
    cells.SetData(3, numpy_to_vtkIdTypeArray(triangles.reshape(-1).astype(np.int64), deep=1))
    grid.SetPoints(vtk_points)
    grid.SetCells(VTK_TRIANGLE, cells)
    return grid


def solve(points, triangles, width, material, shear=False):
    """Unit tension across the cracks, or unit shear."""
    grid = as_grid(points, triangles)
    lines, load = [], []
    for axis, sign in ((0, -1), (0, 1), (1, -1), (1, 1)):
        nodes = np.flatnonzero(points[:, axis] == sign * width)
        nodes = nodes[np.argsort(points[nodes, 1 - axis])]
        force = [0, sign * (not shear), 0] if axis == 1 else [0, 0, 0]
        if shear:
            force = [sign, 0, 0] if axis == 1 else [0, sign, 0]
        lines += list(zip(nodes, nodes[1:]))
        load += [force] * (len(nodes) - 1)
    values = np.zeros((len(triangles) + len(lines), 3))
    values[len(triangles):] = load
    for a, b in lines:
        grid.InsertNextCell(3, 2, [int(a), int(b)])
    array = numpy_to_vtk(values, deep=1)
    array.SetName("FacetTraction")
    grid.GetCellData().AddArray(array)
    fem = vtkThermoelasticFilter()
    fem.SetInputData(grid)
    fem.SetTemperatureModeToUniform()
    fem.SetYoungsModulus(material.youngs_modulus)
    fem.SetPoissonsRatio(material.poissons_ratio)
    fem.SetPlaneState(int(material.plane_stress))
    fem.SetRigidMotionToPin()
    fem.SetSolverToDirect()
    fem.SetStressRecoveryToNone()
    fem.Update()
    if fem.GetErrorCode() != 0:
        sys.exit("vtkThermoelasticFilter failed")
    return fem.GetOutput()


def test_near_tip_field():
    """Against finite differences of the field's displacement, in the forms that textbooks print."""
    material, h = Material(3.0, 0.3), 1e-6
    r, t = np.array([0.5, 1.0, 2.0]), np.array([2.9, 0.4, -2.0])
    z = r * np.exp(1j * t)
    root = 1 / np.sqrt(2 * np.pi * r)
    first = root * np.cos(t / 2) * np.array([1 - np.sin(t / 2) * np.sin(1.5 * t), 1 + np.sin(t / 2) * np.sin(1.5 * t),
                                             np.sin(t / 2) * np.cos(1.5 * t)])
    second = root * np.array([-np.sin(t / 2) * (2 + np.cos(t / 2) * np.cos(1.5 * t)),
                              np.sin(t / 2) * np.cos(t / 2) * np.cos(1.5 * t),
                              np.cos(t / 2) * (1 - np.sin(t / 2) * np.sin(1.5 * t))])

    def displacement(z, mode):
        r, t, kappa = np.abs(z), np.angle(z), material.kappa
        u = ([np.cos(t / 2) * (kappa - np.cos(t)), np.sin(t / 2) * (kappa - np.cos(t))] if mode == 0 else
             [np.sin(t / 2) * (kappa + 2 + np.cos(t)), -np.cos(t / 2) * (kappa - 2 + np.cos(t))])
        return np.sqrt(r / (2 * np.pi)) / (2 * material.shear) * np.array(u)

    for mode, wanted in enumerate((first, second)):
        stress, derivative = near_tip_field(z, (1, -1j)[mode], material)
        found = np.stack([stress[:, 0, 0], stress[:, 1, 1], stress[:, 0, 1]])
        check(np.abs(found - wanted).max() < 1e-12, "stress of mode", mode + 1)
        difference = (displacement(z + h, mode) - displacement(z - h, mode)) / (2 * h)
        check(np.abs(derivative.T - difference).max() < 1e-8, "displacement of mode", mode + 1)


def judge(name, found, wanted, tolerance, unit):
    """Both modes, in parts of `unit`."""
    error = np.abs(np.asarray(found) - wanted) / unit
    check(error.max() <= tolerance, name, "found", found, "wanted", wanted)
    print("%s: K_I %.4f, K_II %.4f; wanted %.4f, %.4f" % (name, *(np.array([found, wanted]) / unit).reshape(-1)))


def test_one_crack():
    """The plate is 100 half-lengths wide, which is the infinite plane but for a tenth of a percent."""
    width, unit = 50.0, np.sqrt(np.pi)
    points, triangles = plate([-1, 1], width, 0.004)
    for shear, plane_stress in ((False, False), (False, True), (True, False)):
        material = Material(2e11, 0.3, plane_stress)
        solution = Solution.of_grid(solve(points, triangles, width, material, shear))
        wanted = np.array([0, 1] if shear else [1, 0]) * unit
        name = f"one crack, {'shear' if shear else 'tension'}, plane {'stress' if plane_stress else 'strain'}"
        for tip in (Tip((1, 0), (1, 0)), Tip((-1, 0), (-1, 0))):
            several = [interaction_integral(solution, tip, material, radius) for radius in (0.1, 0.2, 0.4, 0.8)]
            for k in several:
                judge(name, k, wanted, 0.01, unit)
            spread = np.ptp(several, axis=0).max() / unit
            check(spread < 0.003, name, "the integral depends on its path:", spread)
            judge(name + ", by opening", displacement_extrapolation(solution, tip, material, np.linspace(0.05, 0.25, 9)),
                  wanted, 0.02, unit)


def test_two_cracks():
    gap, width = 0.05, 50.0
    points, triangles = plate([-gap - 2, -gap, gap, gap + 2], width, 0.001)
    material = Material(1.0, 0.3)
    solution = Solution.of_grid(solve(points, triangles, width, material))
    inner, outer = closed_form(gap)
    for x, k in ((-gap - 2, outer), (-gap, inner), (gap, inner), (gap + 2, outer)):
        tip = Tip((x, 0), (1 if x in (-gap, gap + 2) else -1, 0))
        judge(f"two cracks, x = {x}", interaction_integral(solution, tip, material, 0.08), (k, 0), 0.012, k)
        judge(f"two cracks, x = {x}, by opening",
              displacement_extrapolation(solution, tip, material, np.linspace(0.006, 0.03, 9)), (k, 0), 0.02, k)


for name, test in list(globals().items()):
    if name.startswith("test_"):
        test()
print("\n".join(failures) or "passed")
sys.exit(len(failures) > 0)
