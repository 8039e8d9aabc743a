# SPDX-License-Identifier: BSD-3-Clause
"""Between numpy arrays and the points and cells of a vtkUnstructuredGrid; grids and data of several grids."""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (VTK_TETRA, VTK_TRIANGLE, vtkCellArray, vtkCompositeDataSet,
                                           vtkPartitionedDataSet, vtkUnstructuredGrid)

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


def leaves(data):
    """The iterator of composite data at each of its leaves."""
    iterator = data.NewIterator()
    iterator.InitTraversal()
    while not iterator.IsDoneWithTraversal():
        yield iterator
        iterator.GoToNextItem()


def grids_of(data):
    """The grids of composite data, or the one grid that `data` is."""
    if isinstance(data, vtkUnstructuredGrid):
        return [data]
    found = (leaf.GetCurrentDataObject() for leaf in leaves(data))
    return [leaf for leaf in found if isinstance(leaf, vtkUnstructuredGrid)]


def shallow_copy(data):
    """A grid or composite data of VTK's own class, which share their arrays with `data` and nothing else."""
    if isinstance(data, vtkUnstructuredGrid):
        copy = vtkUnstructuredGrid()
        copy.ShallowCopy(data)
        return copy
    copy = data.NewInstance()
    copy.CopyStructure(data)
    copy.GetFieldData().ShallowCopy(data.GetFieldData())
    for leaf in leaves(data):
        own = leaf.GetCurrentDataObject().NewInstance()
        own.ShallowCopy(leaf.GetCurrentDataObject())
        copy.SetDataSet(leaf, own)
    return copy


def names_of_leaves(data):
    """The names of the blocks that have one, by the numbers that the filters call them by."""
    if not isinstance(data, vtkCompositeDataSet):
        return {}
    return dict(_names(data, 0, "")[1])


def _names(data, number, name):
    """The number after those of a block, and the pairs (number, name) in it. Leaves are counted with their parents."""
    found = [(number, name)] if name else []
    if not isinstance(data, vtkCompositeDataSet):
        return number + 1, found
    is_partitioned = isinstance(data, vtkPartitionedDataSet)
    has_blocks = hasattr(data, "GetNumberOfBlocks")
    size = (data.GetNumberOfPartitions() if is_partitioned else data.GetNumberOfBlocks() if has_blocks
            else data.GetNumberOfPartitionedDataSets())
    get = (data.GetPartitionAsDataObject if is_partitioned else data.GetBlock if has_blocks
           else data.GetPartitionedDataSet)
    number += 1
    for k in range(size):
        own = data.GetMetaData(k).Get(vtkCompositeDataSet.NAME()) if data.HasMetaData(k) else None
        number, inner = _names(get(k), number, own or name)
        found += inner
    return number, found
