# SPDX-License-Identifier: BSD-3-Clause
"""The kinds of mesh that the calls take. Each becomes a vtkUnstructuredGrid (several grids: composite data of
VTK), and a result its own kind again.

An adapter has `grid`, which shares no state with the mesh that the filter could change; `options`, which hold unless
the caller gives others; and `back(output)`.
"""
import os
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataObjectTree, vtkUnstructuredGrid

from ._grids import CELL_OF_CORNERS, shallow_copy, simplices, vtk_points
from ._meshio import MeshioMesh


class GridMesh:
    """A vtkUnstructuredGrid, composite data, or a class derived from them that can be made without arguments."""

    options = {}

    def __init__(self, mesh):
        self._kind = type(mesh)
        self.grid = shallow_copy(mesh)

    def back(self, output):
        result = self._kind()
        result.ShallowCopy(output)  # the filter's output shares no array with its input
        return result


def _array(name, values):
    try:
        return np.asarray(values)
    except ValueError:
        raise ValueError(f"{name} must be rows of the same length") from None


def _hint(cells):
    """For cells as VTK and PyVista list them: each after the number of its points."""
    listed = cells.dtype.kind in "iu" and cells.size and cells.flat[0] in (3, 4) and (
        cells.ndim == 1 or cells.ndim == 2 and cells.shape[1] == 5)
    return "; leave out the number of points before each cell: cells.reshape(-1, 5)[:, 1:] for tetrahedra" if listed else ""


class ArrayMesh:
    """A pair of arrays: points of shape (n, 3) or (n, 2), cells of shape (m, 4) for tetrahedra or (m, 3)."""

    options = {}

    def __init__(self, points, cells):
        points, cells = _array("points", points), _array("cells", cells)
        if points.ndim != 2 or points.shape[1] not in (2, 3) or points.dtype.kind not in "fiu":
            raise ValueError(f"points must be numbers of shape (n, 3) or (n, 2), and they are {points.dtype} "
                             f"of shape {points.shape}")
        if cells.ndim != 2 or cells.shape[1] not in CELL_OF_CORNERS or cells.dtype.kind not in "iu":
            raise ValueError("cells must be integers of shape (m, 4) for tetrahedra or (m, 3) for triangles, and they "
                             f"are {cells.dtype} of shape {cells.shape}{_hint(cells)}")
        low, high = (cells.min(), cells.max()) if cells.size else (0, -1)
        if low < 0 or high >= len(points):
            counted = "; are they counted from 1?" if low == 1 and high == len(points) else ""
            raise ValueError(f"cells use the points {low} to {high}, and there are {len(points)}, from 0 on{counted}")
        self._dimension, self._corners, self._index = points.shape[1], cells.shape[1], cells.dtype
        self.grid = simplices(vtk_points(points), cells)

    def back(self, output):
        points = vtk_to_numpy(output.GetPoints().GetData())
        cells = vtk_to_numpy(output.GetCells().GetConnectivityArray())
        return points[:, :self._dimension].copy(), cells.reshape(-1, self._corners).astype(self._index)


def adapter(mesh):
    """The adapter of a mesh; TypeError for what is none."""
    if isinstance(mesh, (vtkUnstructuredGrid, vtkDataObjectTree)):
        return GridMesh(mesh)
    meshio = sys.modules.get("meshio")  # who has a mesh of it has imported it
    if meshio and isinstance(mesh, meshio.Mesh):
        return MeshioMesh(mesh)
    if isinstance(mesh, (tuple, list)) and len(mesh) == 2:
        return ArrayMesh(*mesh)
    if isinstance(mesh, (str, os.PathLike)):
        raise TypeError(f"a mesh is not the name of its file: meshoptimize.read({os.fspath(mesh)!r}) gives the mesh")
    raise TypeError("a mesh is a vtkUnstructuredGrid or blocks of them (vtkMultiBlockDataSet, vtkPartitionedDataSet, "
                    "vtkPartitionedDataSetCollection), a meshio.Mesh or a pair of arrays (points, cells), and this is a "
                    f"{type(mesh).__name__}")
