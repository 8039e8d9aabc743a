# SPDX-License-Identifier: BSD-3-Clause
"""What the tables and the figures of the paper share: optimize a mesh, solve on it, compare with the exact solution, write tables.

The hot cylinder of the paper's section 3 has an exact solution (Timoshenko and Goodier, Theory of Elasticity, the long
cylinder under a radial temperature): with T = T0 - T1 r^2 and k = alpha E T1 / (4 (1 - nu)),

    s_rr = -k (R^2 - r^2),   s_tt = -k (R^2 - 3 r^2),   u_r as in Cylinder.displacement().

Lengths are in cm, stresses in Pa.
"""
import argparse
import csv
import pathlib
import time

import numpy as np
from meshoptimize import vtkMeshOptimizeFilter, vtkThermoelasticFilter
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid

import pellet

# Temperature of the paper's section 4. It gives no constants of the material: these are round numbers for uranium dioxide.
# Relative errors and steps of the conjugate gradients depend on Poisson's ratio alone.
AXIS_TEMPERATURE = 2468.0
RADIAL_COEFFICIENT = 5286.0
YOUNGS_MODULUS = 200e9
POISSONS_RATIO = 0.316
THERMAL_EXPANSION = 1e-5

CHOICES = """\
- **Meshes.** The paper gives the numbers of elements and says that the meshes are Delaunay; it gives neither surfaces nor a
  program. Here: TetGen without its optimization, the surface of even triangles and kept (`pellet.py`), numbers of elements
  within 3 %.
- **Material.** Not given. E = 200 GPa, nu = 0.316, alpha = 1e-5 / K. Relative errors and steps depend on nu alone.
- **Tolerance of the conjugate gradients.** Not given. Steps to a relative residual of 1e-6 and of 1e-8, from zero, with the diagonal
  as preconditioner, as in the paper.
"""

GENERATED = "as generated"
# The paper ended near quality .4; Best goes on until nothing helps; last what the filter does by default, towards .6.
WAYS = {
    "target .4": {"target": 0.4, "effort": "Default"},
    "best": {"target": 0.6, "effort": "Best"},
    "default": {"target": 0.6, "effort": "Default"},
}
EFFORTS = {"Quick": 0, "Default": 1, "Best": 2}


class Optimized:
    """A mesh and what is known of it. As generated: seconds is None."""

    def __init__(self, grid, seconds=None, changed=0):
        self.grid, self.seconds, self.changed = grid, seconds, changed
        self.worst, self.mean, self.bound = pellet.quality(grid)
        self.elements = grid.GetNumberOfCells()


def cells_of(grid):
    """Points (n, 3) and the corners of the tetrahedra (m, 4)."""
    points = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    return points, vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)


def count_changed(before, after):
    """Elements of `before` that `after` does not have: those whose four corners are not, bit for bit, an element there."""
    (x, a), (y, b) = cells_of(before), cells_of(after)
    ids = np.unique(np.concatenate([x, y]), axis=0, return_inverse=True)[1].ravel()
    keys = [np.sort(part, axis=1) for part in (ids[:len(x)][a], ids[len(x):][b])]
    return len(a) - len(set(map(tuple, keys[0])) & set(map(tuple, keys[1])))


def optimize(grid, way, threads=0):
    """vtkMeshOptimizeFilter's mesh; its surface is that of the input."""
    f = vtkMeshOptimizeFilter()
    f.SetInputData(grid)
    f.SetEffort(EFFORTS[WAYS[way]["effort"]])
    f.SetTargetQuality(WAYS[way]["target"])
    f.SetNumberOfThreads(threads)
    start = time.perf_counter()
    f.Update()
    seconds = time.perf_counter() - start
    result = vtkUnstructuredGrid()
    result.ShallowCopy(f.GetOutput())
    return Optimized(result, seconds, count_changed(grid, result))


class Solution:
    """Displacement, stresses, and steps of the solver."""

    def __init__(self, f):
        if f.GetStopReasonAsString() != "Converged":
            raise RuntimeError(f"Thermoelastic: {f.GetStopReasonAsString()}")
        self.grid = vtkUnstructuredGrid()
        self.grid.ShallowCopy(f.GetOutput(0))
        self.residuals = vtk_to_numpy(f.GetOutputDataObject(1).GetColumnByName("RelativeResidual"))
        self.seconds = f.GetAssemblySeconds() + f.GetSolveSeconds() + f.GetRecoverySeconds()

    def steps(self, tolerance):
        return int(np.argmax(self.residuals <= tolerance))

    def points(self, name):
        return vtk_to_numpy(self.grid.GetPointData().GetArray(name))

    def cells(self, name):
        return vtk_to_numpy(self.grid.GetCellData().GetArray(name))


def solver(grid):
    """The temperature and the material of the paper; constraints are the caller's."""
    f = vtkThermoelasticFilter()
    f.SetInputData(grid)
    f.SetTemperatureModeToRadial()
    f.SetAxisTemperature(AXIS_TEMPERATURE)
    f.SetRadialCoefficient(RADIAL_COEFFICIENT)
    f.SetYoungsModulus(YOUNGS_MODULUS)
    f.SetPoissonsRatio(POISSONS_RATIO)
    f.SetThermalExpansion(THERMAL_EXPANSION)
    f.SetRigidMotionToPin()
    f.SetTolerance(1e-8)
    return f


def solve(f):
    f.Update()
    return Solution(f)


class Cylinder:
    """The exact solution in generalized plane strain, the lowest end at z = 0."""

    R, T0, T1 = pellet.RADIUS, AXIS_TEMPERATURE, RADIAL_COEFFICIENT
    nu, alpha = POISSONS_RATIO, THERMAL_EXPANSION
    k = alpha * YOUNGS_MODULUS * T1 / (4 * (1 - nu))

    @classmethod
    def stress(cls, x):
        """Radial and tangential stress at the points."""
        r2 = x[:, 0] ** 2 + x[:, 1] ** 2
        return -cls.k * (cls.R ** 2 - r2), -cls.k * (cls.R ** 2 - 3 * r2)

    # Greatest absolute values, to which errors are relative: on the axis, and at the rim.
    GREATEST = (k * R ** 2, 2 * k * R ** 2)

    @classmethod
    def displacement(cls, x):
        nu, R = cls.nu, cls.R
        r2 = x[:, 0] ** 2 + x[:, 1] ** 2
        over_r2 = cls.T0 / 2 - cls.T1 * r2 / 4  # integral of T r dr, from 0 to r, over r^2
        of_rim = cls.T0 / 2 - cls.T1 * R ** 2 / 4
        radial = cls.alpha * ((1 + nu) * over_r2 + (1 - 3 * nu) * of_rim) / (1 - nu)  # u_r / r
        return np.column_stack([radial * x[:, 0], radial * x[:, 1], 2 * cls.alpha * of_rim * x[:, 2]])


def cylindrical(x, stress):
    """Radial and tangential components of stresses XX YY ZZ XY YZ XZ at the points x."""
    angle = np.arctan2(x[:, 1], x[:, 0])
    c, s = np.cos(angle), np.sin(angle)
    mixed = 2 * c * s * stress[:, 3]
    return (c * c * stress[:, 0] + s * s * stress[:, 1] + mixed,
            s * s * stress[:, 0] + c * c * stress[:, 1] - mixed)


def stress_errors(x, stress):
    """Greatest errors of the radial and of the tangential stress, each relative to its greatest exact value."""
    return tuple(np.abs(a - b).max() / greatest
                 for a, b, greatest in zip(cylindrical(x, stress), Cylinder.stress(x), Cylinder.GREATEST))


# Four points of a quadrature that is exact for quadratics on a tetrahedron, in barycentric coordinates.
_QUADRATURE = np.full((4, 4), (5 - np.sqrt(5)) / 20) + np.eye(4) * np.sqrt(5) / 5


def l2_norm(points, cells, at_nodes, exact):
    """Of the difference between the linear interpolation of at_nodes and exact(x), over the norm of exact(x)."""
    corners = points[cells]
    volume = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])) / 6
    difference = size = 0.0
    for weights in _QUADRATURE:
        value = np.einsum("i,cik->ck", weights, at_nodes[cells])
        truth = exact(np.einsum("i,cik->ck", weights, corners))
        difference += (volume * ((value - truth) ** 2).sum(1)).sum()
        size += (volume * (truth ** 2).sum(1)).sum()
    return np.sqrt(difference / size)


def displacement_error(points, cells, u):
    """In the L2 norm, without the rigid motion that the pins have chosen: in x, in y, and about the axis."""
    difference = u - Cylinder.displacement(points)
    n, zero = np.ones(len(points)), np.zeros(len(points))
    motions = np.stack([[n, zero, zero], [zero, n, zero], [-points[:, 1], points[:, 0], zero]])
    motions = motions.transpose(2, 1, 0).reshape(-1, 3)
    best = np.linalg.lstsq(motions, difference.ravel(), rcond=None)[0]
    return l2_norm(points, cells, u - (motions @ best).reshape(-1, 3), Cylinder.displacement)


def stress_l2_error(points, cells, stress):
    """Of the recovered radial and tangential stress together, in the L2 norm."""
    return l2_norm(points, cells, np.column_stack(cylindrical(points, stress)),
                   lambda x: np.column_stack(Cylinder.stress(x)))


def write_csv(path, rows):
    with open(path, "w", newline="", encoding="utf-8") as f:
        writer = csv.DictWriter(f, fieldnames=list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)


def markdown_table(columns, rows):
    lines = ["| " + " | ".join(columns) + " |", "|" + "---|" * len(columns)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]) + "\n"


class Claims:
    """What must hold, as measured; written below the table."""

    def __init__(self):
        self.rows = []

    def add(self, text, measured, holds):
        self.rows.append((text, measured, "yes" if holds else "**no**"))

    def markdown(self):
        return markdown_table(("claim", "measured", "holds"), self.rows)

    def all_hold(self):
        return all(holds == "yes" for _, _, holds in self.rows)


def write(folder, name, rows, text):
    """Writes folder/name.csv and folder/name.md, and prints the latter."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    write_csv(folder / f"{name}.csv", rows)
    (folder / f"{name}.md").write_text(text, encoding="utf-8")
    print(text)


def make_table(name, description, meshes, measure, markdown, add_claims, text):
    """What a table's script does: optimizes, measures, writes; the exit status is 1 if a claim does not hold with the last of --ways."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--meshes", nargs="+", choices=meshes, default=list(meshes))
    parser.add_argument("--ways", nargs="+", choices=WAYS, default=list(WAYS))
    options = parser.parse_args()
    rows = {}
    for mesh in options.meshes:
        grid = pellet.mesh(mesh)
        rows[mesh, GENERATED] = measure(mesh, GENERATED, Optimized(grid))
        for way in options.ways:
            rows[mesh, way] = measure(mesh, way, optimize(grid, way))
            print(mesh, way, "done", flush=True)
    text = text.format(choices=CHOICES) + "\n" + markdown(rows, options.meshes, options.ways)
    for way in options.ways:
        claims = add_claims(rows, options.meshes, way)
        text += f"\n## Claims, optimized: {way}\n\n{claims.markdown()}"
    write(options.folder, name, list(rows.values()), text)
    return 0 if claims.all_hold() else 1
