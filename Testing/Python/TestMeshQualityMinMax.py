# SPDX-License-Identifier: BSD-3-Clause
"""vtkMeshQualityMinMax against formulas written down here in numpy, and against VTK's own vtkMeshQuality."""
import sys

import numpy as np
from meshoptimize import vtkMeshQualityMinMax
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, VTK_TRIANGLE, vtkDataObject, vtkUnstructuredGrid
from vtkmodules.vtkFiltersVerdict import vtkMeshQuality

failures = []


def check(condition, message):
    if not condition:
        failures.append(message)


def make_grid(x, cells, cell_type):
    grid = vtkUnstructuredGrid()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(x), deep=1))
    grid.SetPoints(points)
    grid.Allocate(len(cells))
    for cell in cells:
        grid.InsertNextCell(cell_type, len(cell), [int(i) for i in cell])
    return grid


random = np.random.default_rng(1)
N = 3000


def random_elements(nodes):
    x = random.random((N * nodes, 3))
    if nodes == 3:
        x[:, 2] = 0.5
    cells = np.arange(N * nodes).reshape(N, nodes)
    return x, cells


def cross(a, b):
    return np.cross(a, b)


def norm(a):
    return np.sqrt((a * a).sum(axis=-1))


def edges(c):
    n = c.shape[1]
    return [(i, j) for i in range(n) for j in range(i + 1, n)]


def size(c):
    """Signed volume or area."""
    if c.shape[1] == 4:
        return np.einsum("ij,ij->i", cross(c[:, 1] - c[:, 0], c[:, 2] - c[:, 0]), c[:, 3] - c[:, 0]) / 6
    return cross(c[:, 1] - c[:, 0], c[:, 2] - c[:, 0])[:, 2] / 2


def lengths(c):
    return np.array([norm(c[:, i] - c[:, j]) for i, j in edges(c)])


def angles(c):
    """Dihedral (corner) angles, unsigned."""
    out = []
    if c.shape[1] == 3:
        for i in range(3):
            u, v = c[:, (i + 1) % 3] - c[:, i], c[:, (i + 2) % 3] - c[:, i]
            out.append(np.arccos((u * v).sum(axis=1) / norm(u) / norm(v)))
        return np.array(out)
    for i, j in edges(c):
        k, m = [q for q in range(4) if q not in (i, j)]
        e = c[:, j] - c[:, i]
        u, v = cross(e, c[:, k] - c[:, i]), cross(e, c[:, m] - c[:, i])
        out.append(np.arccos(np.clip((u * v).sum(axis=1) / norm(u) / norm(v), -1, 1)))
    return np.array(out)


def radius_ratio(c):
    v, l = np.abs(size(c)), lengths(c)
    if c.shape[1] == 3:
        s = l.sum(axis=0) / 2
        return 2 * (v / s) / (l.prod(axis=0) / (4 * v))
    faces = sum(norm(cross(c[:, b] - c[:, a], c[:, d] - c[:, a])) / 2
                for a, b, d in ((0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3)))
    p, q, r = l[0] * l[5], l[1] * l[4], l[2] * l[3]  # products of opposite edges
    circumradius = np.sqrt((p + q + r) * (p + q - r) * (p - q + r) * (q + r - p)) / (24 * v)
    return 3 * (3 * v / faces) / circumradius


def warped(c):
    a = angles(c)
    return np.where(a > np.pi / 2, 0.75 * np.sin(a), np.sin(a)).min(axis=0)


def expected(measure, c):
    solid = c.shape[1] == 4
    v, l = np.abs(size(c)), lengths(c)
    rms = np.sqrt((l ** 2).mean(axis=0))
    value = {
        "Shape": lambda: 1832.8207768355312 * v / l.sum(axis=0) ** 3 if solid else 36 / np.sqrt(3) * v / l.sum(axis=0) ** 2,
        "RadiusRatio": lambda: radius_ratio(c),
        "MeanRatio": lambda: 12 * (3 * v) ** (2 / 3) / (l ** 2).sum(axis=0) if solid else 4 * np.sqrt(3) * v / (l ** 2).sum(axis=0),
        "MinimumSine": lambda: np.sin(angles(c)).min(axis=0),
        "WarpedSine": lambda: warped(c),
        "VolumeLength": lambda: 6 * np.sqrt(2) * v / rms ** 3 if solid else 4 * v / np.sqrt(3) / rms ** 2,
        "MinimumDihedralAngle": lambda: np.degrees(angles(c).min(axis=0)),
    }[measure]()
    return np.sign(size(c)) * value


def measured(grid, **options):
    f = vtkMeshQualityMinMax()
    f.SetInputData(grid)
    for name, value in options.items():
        getattr(f, "Set" + name)(value)
    f.Update()
    data, degrees = f.GetOutput().GetCellData(), f.GetQualityMeasure() == f.MinimumDihedralAngle
    array = data.GetArray("MinimumDihedralAngle" if degrees else "MeshQuality")
    check(data.GetScalars() == array, "the quality is not the active scalars")
    return f, vtk_to_numpy(array)


MEASURES = ["Shape", "RadiusRatio", "MeanRatio", "MinimumSine", "WarpedSine", "VolumeLength", "MinimumDihedralAngle"]
for nodes, cell_type in ((4, VTK_TETRA), (3, VTK_TRIANGLE)):
    x, cells = random_elements(nodes)
    if nodes == 3 and size(x[cells]).sum() < 0:
        cells = cells[:, [0, 2, 1]]  # the side up is that for which most of the area is positive
    grid = make_grid(x, cells, cell_type)
    corners = x[cells]
    good = np.abs(size(corners)) > 1e-4  # numpy's arccos loses digits in slivers
    for number, measure in enumerate(MEASURES):
        f, q = measured(grid, QualityMeasure=number)
        e = expected(measure, corners)
        scale = 90.0 if measure == "MinimumDihedralAngle" else 1.0
        check(np.abs(q - e)[good].max() < 1e-8 * scale, f"{measure}, {nodes} nodes: {np.abs(q - e)[good].max()}")
        check(f.GetMinimumQuality() == q.min() and f.GetMaximumQuality() == q.max(), f"{measure}: extremes")
        check(abs(f.GetMeanQuality() - q.mean()) < 1e-13 * scale, f"{measure}: mean")
        check(abs(f.GetStandardDeviation() - q.std()) < 1e-13 * scale, f"{measure}: standard deviation")
        check(f.GetNumberOfInvertedCells() == (q < 0).sum(), f"{measure}: inverted")
        check(f.GetWorstCellId() == q.argmin(), f"{measure}: worst cell")

        histogram = f.GetOutputDataObject(2)
        low, high, count = (vtk_to_numpy(histogram.GetColumnByName(n)) for n in ("BinLow", "BinHigh", "Count"))
        check(count.sum() == N, f"{measure}: histogram adds up to {count.sum()}")
        check(np.array_equal(low[1:], high[:-1]) and low[0] == min(0, q.min()), f"{measure}: bins")
        counts = np.histogram(q, np.append(low, high[-1]))[0]
        check(np.abs(counts - count).sum() <= 2, f"{measure}: histogram")

        worst = f.GetOutputDataObject(3)
        ids = vtk_to_numpy(worst.GetCellData().GetArray("OriginalCellIds"))
        check(np.array_equal(ids, np.argsort(q, kind="stable")[:10]), f"{measure}: worst ten")
        centre = vtk_to_numpy(worst.GetCellData().GetArray("Center"))
        check(np.abs(centre - corners[ids].mean(axis=1)).max() < 1e-14, f"{measure}: centres")

    # VTK's own: radius ratio is the reciprocal, of the unsigned element
    verdict = vtkMeshQuality()
    verdict.SetInputData(grid)
    verdict.SetTetQualityMeasureToRadiusRatio()
    verdict.SetTriangleQualityMeasureToRadiusRatio()
    verdict.Update()
    theirs = vtk_to_numpy(verdict.GetOutput().GetCellData().GetArray("Quality"))
    _, ours = measured(grid, QualityMeasure=1)
    keep = good & (size(corners) > 0)
    check(np.abs(ours * theirs - 1)[keep].max() < 1e-6, f"radius ratio of vtkMeshQuality, {nodes} nodes")

    # size factor, constant and by array; the metric as the mesh mapped by M^(1/2)
    h = lengths(corners).max(axis=0)
    s = expected("Shape", corners)
    factor = np.exp(-0.64 * np.log(h / 0.4) ** 2)
    _, q = measured(grid, Beta=0.8, DesiredSize=0.4)
    check(np.abs(q - np.where(s > 0, s * factor, s)).max() < 1e-12, "size factor")
    sizes = random.random(len(x)) + 0.1
    array = numpy_to_vtk(sizes, deep=1)
    array.SetName("size")
    grid.GetPointData().AddArray(array)
    f = vtkMeshQualityMinMax()
    f.SetInputData(grid)
    f.SetBeta(0.8)
    f.SetInputArrayToProcess(2, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "size")
    f.Update()
    q = vtk_to_numpy(f.GetOutput().GetCellData().GetArray("MeshQuality"))
    wanted = np.exp(np.log(sizes[cells]).mean(axis=1))
    check(np.abs(q - np.where(s > 0, s * np.exp(-0.64 * np.log(h / wanted) ** 2), s)).max() < 1e-12, "size array")

    root = np.array([[2.0, 0.3, 0.0], [0.3, 1.0, 0.0], [0.0, 0.0, 1.5]])
    if nodes == 4:
        root[0, 2] = root[2, 0] = 0.2
    m = root @ root
    for name, values in (("six", [m[0, 0], m[1, 1], m[2, 2], m[0, 1], m[1, 2], m[0, 2]]), ("nine", m.ravel())):
        tensors = numpy_to_vtk(np.tile(values, (len(x), 1)), deep=1)
        tensors.SetName(name)
        grid.GetPointData().AddArray(tensors)
        f = vtkMeshQualityMinMax()
        f.SetInputData(grid)
        f.SetInputArrayToProcess(3, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, name)
        f.Update()
        q = vtk_to_numpy(f.GetOutput().GetCellData().GetArray("MeshQuality"))
        mapped = (x @ root)[cells]
        check(np.abs(q - expected("Shape", mapped)).max() < 1e-11, f"metric of {name} components, {nodes} nodes")

    # regions: numbers per row
    region = random.integers(-2, 3, N).astype(np.int64)
    array = numpy_to_vtk(region, deep=1)
    array.SetName("region")
    grid.GetCellData().AddArray(array)
    f = vtkMeshQualityMinMax()
    f.SetInputData(grid)
    f.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_CELLS, "region")
    f.Update()
    table = f.GetOutputDataObject(1)
    names = [table.GetColumnByName("Region").GetValue(r) for r in range(table.GetNumberOfRows())]
    check(names == ["-2", "-1", "0", "1", "2", "all"], f"rows {names}")
    for r, name in enumerate(names):
        part = s if name == "all" else s[region == int(name)]
        row = {c: table.GetColumnByName(c).GetTuple1(r) for c in ("Count", "Minimum", "Mean", "Maximum", "StandardDeviation", "Inverted")}
        e = [len(part), part.min(), part.mean(), part.max(), part.std(), (part < 0).sum()]
        check(np.allclose(list(row.values()), e, rtol=1e-11, atol=1e-12), f"row {name}: {row} and not {e}")

for failure in failures:
    print("FAILED:", failure)
sys.exit(1 if failures else 0)
