# SPDX-License-Identifier: BSD-3-Clause
"""Between numpy arrays and the points and cells of a vtkUnstructuredGrid."""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, VTK_TRIANGLE, vtkCellArray, vtkUnstructuredGrid

CELL_OF_CORNERS = {3: VTK_TRIANGLE, 4: VTK_TETRA}


def vtk_points(points):
    """Points of shape (n, 2) or (n, 3) as vtkPoints; single precision stays, all else becomes double."""
    points = np.asarray(points)
    spatial = np.zeros((len(points), 3), np.float32 if points.dtype == np.float32 else float)
    spatial[:, :points.shape[1]] = points
    result = vtkPoints()
    result.SetData(numpy_to_vtk(spatial, deep=1))
    return result


def simplices(points, cells):
    """A grid of vtkPoints and cells of shape (m, 4), tetrahedra, or (m, 3), triangles."""
    grid, array = vtkUnstructuredGrid(), vtkCellArray()
    array.SetData(cells.shape[1], numpy_to_vtkIdTypeArray(np.ascontiguousarray(cells, np.int64).ravel(), deep=1))
    grid.SetPoints(points)
    grid.SetCells(CELL_OF_CORNERS[cells.shape[1]], array)
    return grid


def kinds_of(grid):
    """VTK's type of each cell."""
    number = grid.GetNumberOfCells()
    if number and grid.IsHomogeneous():
        return np.full(number, grid.GetCellType(0))
    return np.array([grid.GetCellType(cell) for cell in range(number)], int)


def nodes_of(grid, ids, corners):
    """The points of these cells, which all have so many: shape (len(ids), corners)."""
    starts = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    nodes = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    return nodes[starts[ids][:, None] + np.arange(corners)]
