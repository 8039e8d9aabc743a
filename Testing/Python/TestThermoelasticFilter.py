# SPDX-License-Identifier: BSD-3-Clause
"""vtkThermoelasticFilter from Python, against a finite element program of numpy's few lines with a dense solver.

Written from the textbook, sharing no code with the filter: B matrices in engineering strains, prescribed displacements by
partition, reactions as K u - f.
"""
import sys

import numpy as np
from meshoptimize import vtkThermoelasticFilter
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkUnstructuredGrid

failures = []
random = np.random.default_rng(4)


def check(condition, *message):
    if not condition:
        failures.append(" ".join(str(m) for m in message))


def box(n):
    """n x n x n cubes of six tetrahedra, jittered inside; every cell positive."""
    index = np.arange((n + 1) ** 3).reshape(n + 1, n + 1, n + 1)
    x = np.stack(np.meshgrid(*[np.linspace(0, 1, n + 1)] * 3, indexing="ij"), -1).reshape(-1, 3)
    inside = ((x > 1e-9) & (x < 1 - 1e-9)).all(1)
    x[inside] += random.uniform(-0.1 / n, 0.1 / n, (inside.sum(), 3))
    cells = []
    for i, j, k in np.ndindex(n, n, n):
        for order in ((0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (1, 0, 2), (2, 1, 0)):
            at = np.array([i, j, k])
            path = [index[tuple(at)]]
            for axis in order:
                at = at + np.eye(3, dtype=int)[axis]
                path.append(index[tuple(at)])
            edges = x[path[1:]] - x[path[0]]
            cells.append(path if np.linalg.det(edges) > 0 else [path[0], path[2], path[1], path[3]])
    return x, np.array(cells)


def reference(x, cells, E, nu, alpha, T, fixed, values, forces):
    n = len(x)
    K = np.zeros((3 * n, 3 * n))
    f = forces.ravel().copy()
    parts = []
    for c, nodes in enumerate(cells):
        lam, mu = E[c] * nu / ((1 + nu) * (1 - 2 * nu)), E[c] / (2 * (1 + nu))
        C = np.diag([2 * mu] * 3 + [mu] * 3)
        C[:3, :3] += lam
        M = np.column_stack([np.ones(4), x[nodes]])
        g = np.linalg.inv(M)[1:]  # gradients, a column per node
        V = np.linalg.det(M) / 6
        B = np.zeros((6, 12))
        for a in range(4):
            gx, gy, gz = g[:, a]
            B[:, 3 * a:3 * a + 3] = [[gx, 0, 0], [0, gy, 0], [0, 0, gz], [gy, gx, 0], [0, gz, gy], [gz, 0, gx]]
        thermal = alpha * T[nodes].mean() * np.array([1, 1, 1, 0, 0, 0])
        dofs = (3 * nodes[:, None] + np.arange(3)).ravel()
        K[np.ix_(dofs, dofs)] += V * B.T @ C @ B
        f[dofs] += V * B.T @ C @ thermal
        parts.append((dofs, B, C, thermal, V))
    u = values.ravel().copy()
    free = ~fixed.ravel()
    u[free] = np.linalg.solve(K[np.ix_(free, free)], f[free] - K[np.ix_(free, ~free)] @ u[~free])
    reaction = np.where(fixed.ravel(), K @ u - f, 0)
    stress = np.array([C @ (B @ u[d] - t) for d, B, C, t, V in parts])
    energy = sum(0.5 * V * (B @ u[d] - t) @ C @ (B @ u[d] - t) for d, B, C, t, V in parts)
    return u.reshape(-1, 3), stress, reaction.reshape(-1, 3), energy


def grid_of(x, cells, point_arrays, cell_arrays):
    grid = vtkUnstructuredGrid()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(x, deep=1))
    grid.SetPoints(points)
    grid.Allocate(len(cells))
    for nodes in cells:
        grid.InsertNextCell(VTK_TETRA, 4, [int(i) for i in nodes])
    for data, arrays in ((grid.GetPointData(), point_arrays), (grid.GetCellData(), cell_arrays)):
        for name, values in arrays.items():
            array = numpy_to_vtk(np.ascontiguousarray(values), deep=1)
            array.SetName(name)
            data.AddArray(array)
    return grid


x, cells = box(3)
T = 20 + 300 * x[:, 0] ** 2 + 100 * x[:, 1]
E = np.where(x[cells].mean(1)[:, 2] > 0.5, 3.0, 1.0)
fixed = np.zeros(x.shape, dtype=bool)
fixed[x[:, 0] == 0] = True
fixed[x[:, 2] == 1, 2] = True
values = np.where(fixed, random.uniform(-1e-3, 1e-3, x.shape), 0)
traction = np.zeros(x.shape)
traction[x[:, 1] == 1] = [1e-3, 2e-3, -1e-3]
# Consistent forces of a constant traction: a third of each triangle's area to each of its points.
forces = np.zeros(x.shape)
for nodes in cells:
    for facet in ([0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]):
        p = nodes[facet]
        if (x[p, 1] == 1).all():
            forces[p] += 0.5 * np.linalg.norm(np.cross(x[p[1]] - x[p[0]], x[p[2]] - x[p[0]])) / 3 * traction[p[0]]

u, stress, reaction, energy = reference(x, cells, E, 0.3, 1e-4, T - 20, fixed, values, forces)
f = vtkThermoelasticFilter()
f.SetInputData(grid_of(x, cells, {"Temperature": T, "Constraint": fixed.astype(np.uint8),
                                  "PrescribedDisplacement": values, "Traction": traction}, {"YoungsModulus": E}))
f.SetPoissonsRatio(0.3)
f.SetThermalExpansion(1e-4)
f.SetReferenceTemperature(20)
f.SetTolerance(1e-14)
f.Update()
check(f.GetStopReasonAsString() == "Converged", f.GetStopReasonAsString())
points, own = f.GetOutput(0).GetPointData(), f.GetOutput(0).GetCellData()
for name, mine, its in (("Displacement", u, points), ("Reaction", reaction, points), ("ElementStress", stress, own)):
    theirs = vtk_to_numpy(its.GetArray(name))
    difference = np.abs(theirs - mine).max() / np.abs(mine).max()
    check(difference < 1e-11, name, "differs by", difference)
check(abs(f.GetStrainEnergy() / energy - 1) < 1e-11, "energy", f.GetStrainEnergy(), energy)

s = vtk_to_numpy(points.GetArray("Stress"))
tensors = np.array([[[a, d, g], [d, b, e], [g, e, c]] for a, b, c, d, e, g in s])
principal = np.linalg.eigvalsh(tensors)[:, ::-1]
check(np.allclose(vtk_to_numpy(points.GetArray("PrincipalStress")), principal, rtol=1e-12, atol=1e-14), "principal stresses")
deviator = tensors - np.trace(tensors, axis1=1, axis2=2)[:, None, None] / 3 * np.eye(3)
check(np.allclose(vtk_to_numpy(points.GetArray("VonMises")), np.sqrt(1.5 * (deviator ** 2).sum((1, 2))), rtol=1e-12),
      "von Mises")
residuals = vtk_to_numpy(f.GetOutputDataObject(1).GetColumnByName("RelativeResidual"))
check(len(residuals) == f.GetNumberOfSolverIterations() + 1 and residuals[0] == 1 and residuals[-1] <= 1e-14, "history")

for failure in failures:
    print("FAILED:", failure)
sys.exit(1 if failures else 0)
