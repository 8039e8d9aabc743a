# SPDX-License-Identifier: BSD-3-Clause
"""The kinds of mesh that the calls take. Each becomes a vtkUnstructuredGrid (several grids: composite data of
VTK), and a result its own kind again.

An adapter has `grid`, which shares no state with the mesh that the filter could change; `options`, which hold unless
the caller gives others; and `back(output)`.
"""
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


class ArrayMesh:
    """A pair of arrays: points of shape (n, 3) or (n, 2), cells of shape (m, 4) for tetrahedra or (m, 3)."""

    options = {}

    def __init__(self, points, cells):
        points, cells = np.asarray(points), np.asarray(cells)
        if points.ndim != 2 or points.shape[1] not in (2, 3) or points.dtype.kind not in "fiu":
            raise ValueError(f"points must be numbers of shape (n, 3) or (n, 2), and they are {points.dtype} "
                             f"of shape {points.shape}")
        if cells.ndim != 2 or cells.shape[1] not in CELL_OF_CORNERS or cells.dtype.kind not in "iu":
            raise ValueError("cells must be integers of shape (m, 4) for tetrahedra or (m, 3) for triangles, and they "
                             f"are {cells.dtype} of shape {cells.shape}")
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
    raise TypeError("a mesh is a vtkUnstructuredGrid or blocks of them (vtkMultiBlockDataSet, vtkPartitionedDataSet, "
                    "vtkPartitionedDataSetCollection), a meshio.Mesh or a pair of arrays (points, cells), and this is a "
                    f"{type(mesh).__name__}")
