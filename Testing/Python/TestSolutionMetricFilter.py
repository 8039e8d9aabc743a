# SPDX-License-Identifier: BSD-3-Clause
"""vtkSolutionMetricFilter against finite differences written down here in numpy, and through files and other filters."""
import os
import sys
import tempfile

import numpy as np
from meshoptimize import vtkMeshQualityMinMax, vtkSolutionMetricFilter
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TRIANGLE, vtkCellArray, vtkDataObject, vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter

failures = []
N = 40


def check(condition, message):
    if not condition:
        failures.append(message)


def square(u):
    """N x N squares of two triangles each, with the values u[j, i] at the points (i / N, j / N)."""
    j, i = np.mgrid[0:N + 1, 0:N + 1]
    x = np.stack([i / N, j / N, 0 * i], axis=-1).reshape(-1, 3).astype(float)
    a = (np.arange(N)[:, None] * (N + 1) + np.arange(N)).reshape(-1)
    cells = np.concatenate([np.stack([a, a + 1, a + N + 2], axis=1), np.stack([a, a + N + 2, a + N + 1], axis=1)])
    grid, points, array = vtkUnstructuredGrid(), vtkPoints(), vtkCellArray()
    points.SetData(numpy_to_vtk(x, deep=1))
    array.SetData(3, numpy_to_vtkIdTypeArray(cells.reshape(-1), deep=1))
    grid.SetPoints(points)
    grid.SetCells(VTK_TRIANGLE, array)
    values = numpy_to_vtk(u.reshape(-1), deep=1)
    values.SetName("u")
    grid.GetPointData().AddArray(values)
    return grid


def metric_filter(grid, **properties):
    f = vtkSolutionMetricFilter()
    f.SetInputData(grid)
    f.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "u")
    for name, value in properties.items():
        getattr(f, "Set" + name)(*([] if value is None else [value]))  # None: a SetXToY()
    f.Update()
    return f


def point_array(f, name):
    return vtk_to_numpy(f.GetOutput().GetPointData().GetArray(name))


def tensors(six):
    """2 x 2 parts."""
    m = np.empty((len(six), 2, 2))
    m[:, 0, 0], m[:, 1, 1], m[:, 0, 1], m[:, 1, 0] = six[:, 0], six[:, 1], six[:, 3], six[:, 3]
    return m


def absolute(h):
    values, vectors = np.linalg.eigh(h)
    return np.einsum("nij,nj,nkj->nik", vectors, np.abs(values), vectors)


def test_finite_differences():
    """On this mesh (5.4) is a difference stencil at each interior point."""
    y, x = np.mgrid[0:N + 1, 0:N + 1] / N
    u = np.sin(5 * x) * np.exp(y) + x * y * y
    f = metric_filter(square(u), DesiredNumberOfElements=5000, MaximumAnisotropy=0, Gradation=0)
    h = 1 / N
    c, e, w = u[1:-1, 1:-1], u[1:-1, 2:], u[1:-1, :-2]
    n, s, ne, sw = u[2:, 1:-1], u[:-2, 1:-1], u[2:, 2:], u[:-2, :-2]
    hessian = np.empty(c.shape + (2, 2))
    hessian[..., 0, 0] = (e - 2 * c + w) / h**2
    hessian[..., 1, 1] = (n - 2 * c + s) / h**2
    hessian[..., 0, 1] = hessian[..., 1, 0] = (ne + sw + 2 * c - n - s - e - w) / (2 * h**2)
    wanted = absolute(hessian.reshape(-1, 2, 2))
    found = tensors(point_array(f, "Metric").reshape(N + 1, N + 1, 6)[1:-1, 1:-1].reshape(-1, 6))
    # the metric is |H| but where the longest edge there can be is at work: at eigenvalues that are next to nothing
    least = f.GetDesiredSize()**2 / 2
    free = np.linalg.eigvalsh(wanted)[:, 0] > least
    check(free.mean() > 0.9, "limits at work in too many places")
    check(np.abs(found - wanted)[free].max() < 1e-9, f"metric off by {np.abs(found - wanted)[free].max()}")
    # (5.3) with the density at the points as its own quadrature
    density = np.sqrt(np.linalg.det(tensors(point_array(f, "Metric")))).reshape(N + 1, N + 1)
    weights = np.ones(N + 1)
    weights[[0, -1]] = 0.5
    count = 4 / np.sqrt(3) * (density * np.outer(weights, weights)).sum() / N**2 / f.GetDesiredSize()**2
    check(abs(count / 5000 - 1) < 0.01, f"{count} elements instead of 5000")
    check((point_array(f, "DesiredSize") == f.GetDesiredSize()).all(), "DesiredSize")


def test_norm_order():
    """A strong and a weak feature: in L^infinity the strong one takes all, in L^1 the weak one has its share."""
    y, x = np.mgrid[0:N + 1, 0:N + 1] / N
    u = np.exp(-100 * ((x - 0.25)**2 + (y - 0.5)**2)) + 0.01 * np.exp(-100 * ((x - 0.75)**2 + (y - 0.5)**2))
    shares = []
    for order in (0, 2, 1):
        f = metric_filter(square(u), DesiredNumberOfElements=2000, NormOrder=order, Gradation=0)
        density = np.sqrt(np.linalg.det(tensors(point_array(f, "Metric")))).reshape(N + 1, N + 1)
        shares.append(density[:, N // 2 + 1:].sum() / density.sum())
    check(shares[0] < shares[1] < shares[2], f"shares of the weak feature {shares}")


def test_with_the_others():
    """To a file and back, and measured by vtkMeshQualityMinMax: with h* as its size."""
    y, x = np.mgrid[0:N + 1, 0:N + 1] / N
    f = metric_filter(square(2 * x * x + 2 * y * y), RecoveryToLeastSquares=None)
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "metric.vtu")
        writer = vtkXMLUnstructuredGridWriter()
        writer.SetInputConnection(f.GetOutputPort())
        writer.SetFileName(path)
        writer.SetDataModeToBinary()
        check(writer.Write() == 1, "cannot write")
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(path)
        quality = vtkMeshQualityMinMax()
        quality.SetInputConnection(reader.GetOutputPort())
        quality.SetInputArrayToProcess(2, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "DesiredSize")
        quality.SetInputArrayToProcess(3, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "Metric")
        quality.SetBeta(1.0)
        quality.Update()
    # metric 4 I everywhere; all triangles are halves of squares
    h = np.sqrt(2) / N * 2
    wanted = np.sqrt(4 / np.sqrt(3) * 4 / (2 * N * N))
    check(abs(f.GetDesiredSize() / wanted - 1) < 1e-4, "h* of a constant metric")
    expected = 36 / np.sqrt(3) / 2 / (2 + np.sqrt(2))**2 * np.exp(-np.log(h / f.GetDesiredSize())**2)
    for q in (quality.GetMinimumQuality(), quality.GetMaximumQuality()):
        check(abs(q - expected) < 1e-9, f"quality {q}, expected {expected}")


def test_same_twice():
    y, x = np.mgrid[0:N + 1, 0:N + 1] / N
    grid = square(np.tanh(30 * (x * x + y - 0.7)))
    one, two = (metric_filter(grid, Gradation=1.3, NormOrder=2, ComputeSizeTensor=True) for _ in range(2))
    for name in ("Metric", "SizeTensor", "DesiredSize"):
        check((point_array(one, name) == point_array(two, name)).all(), f"{name} differs from run to run")


test_finite_differences()
test_norm_order()
test_with_the_others()
test_same_twice()
for failure in failures:
    print("FAILED:", failure)
sys.exit(1 if failures else 0)
