# SPDX-License-Identifier: BSD-3-Clause
"""Tetrahedra as arrays, from and to the files that the tools of peers.py read and write."""
import meshio
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import VTK_TETRA
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

# Faces seen from outside counterclockwise, for a tetrahedron of positive volume.
FACES = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])
EDGES = np.array([[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]])


def read(path):
    """Points [n, 3], tetrahedra [m, 4]."""
    if str(path).endswith(".vtu"):
        points, cells = read_vtu(path)
    else:
        mesh = meshio.read(path)
        points, cells = mesh.points, mesh.cells_dict.get("tetra", [])
    if len(cells) == 0:
        raise ValueError(f"{path}: no tetrahedra")
    return np.ascontiguousarray(points, dtype=float), np.asarray(cells, dtype=np.int64)


def read_vtu(path):
    """By VTK: meshio refuses files with strings in them."""
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    if grid.GetNumberOfCells() == 0:
        return np.empty((0, 3)), []
    tetrahedra = np.flatnonzero(vtk_to_numpy(grid.GetCellTypesArray()) == VTK_TETRA)
    first = vtk_to_numpy(grid.GetCells().GetOffsetsArray())[tetrahedra]
    nodes = vtk_to_numpy(grid.GetCells().GetConnectivityArray())[first[:, None] + np.arange(4)]
    return vtk_to_numpy(grid.GetPoints().GetData()), nodes


def write(path, points, cells, **options):
    meshio.write(path, meshio.Mesh(points, [("tetra", cells)]), **options)


def boundary(cells):
    """The faces of one tetrahedron only, [k, 3], outside counterclockwise."""
    faces = cells[:, FACES].reshape(-1, 3)
    order = np.sort(faces, axis=1)
    key = np.lexsort(order.T[::-1])
    order = order[key]
    same = (order[1:] == order[:-1]).all(axis=1)
    single = np.ones(len(order), dtype=bool)
    single[1:] &= ~same
    single[:-1] &= ~same
    return faces[key[single]]


def shape(points, cells):
    """The paper's S: 1296 sqrt(2) V / P^3, signed."""
    x = points[cells]
    a, b, c = x[:, 1] - x[:, 0], x[:, 2] - x[:, 0], x[:, 3] - x[:, 0]
    volume = np.einsum("ij,ij->i", np.cross(a, b), c) / 6
    perimeter = sum(np.linalg.norm(x[:, i] - x[:, j], axis=1) for i, j in EDGES)
    return 1296 * np.sqrt(2) * volume / np.maximum(perimeter, 1e-300) ** 3


def surface(points, cells):
    """The faces of the boundary as a sorted array of their coordinates: equal for equal surfaces, bit for bit."""
    x = points[boundary(cells)] + 0.0  # -0 becomes 0
    corner = np.lexsort((x[..., 2], x[..., 1], x[..., 0]), axis=1)
    x = np.take_along_axis(x, corner[..., None], axis=1).reshape(-1, 9)
    return x[np.lexsort(x.T[::-1])]
