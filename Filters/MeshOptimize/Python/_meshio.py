# SPDX-License-Identifier: BSD-3-Clause
"""meshio's meshes as grids and back: groups and sets are arrays in between.

- Cell data are cell arrays; a set of cells is a cell array of 0 and 1. A new cell takes the values of the cell in whose
  place it stands.
- A set of points is told by the points themselves: those that are still there are in it. A new point joins where it
  lies between points of the set; if it is inside, only a set that holds points inside: a set of the surface stays one.
- Groups of the tetrahedra (of the triangles, where there are no tetrahedra) are the regions.
"""
import warnings

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkUnstructuredGrid

from ._grids import nodes_of, vtk_points

# meshio's names of cells, in VTK's numbering
CELL_TYPES = {"vertex": 1, "line": 3, "triangle": 5, "quad": 9, "tetra": 10, "hexahedron": 12, "wedge": 13,
              "pyramid": 14, "line3": 21, "triangle6": 22, "quad8": 23, "tetra10": 24, "hexahedron20": 25,
              "wedge15": 26, "pyramid13": 27, "quad9": 28, "hexahedron27": 29}
# Cell data that number the groups of a format; the first that says something counts.
LABELS = ("gmsh:physical", "medit:ref", "nastran:ref", "gmsh:geometrical")
BLOCK, REGION, POINT = "meshoptimize:block", "meshoptimize:region", "meshoptimize:point"
BETWEEN = 0.9  # a point that slides may leave the facets of before a little
# What the nodes and entities of Gmsh's geometry are: no longer true of another mesh.
GEOMETRY = ("gmsh:dim_tags", "gmsh:bounding_entities")


def _add(attributes, name, values):
    values = np.ascontiguousarray(values)
    values = values.astype(np.uint8) if values.dtype == bool else values
    array = numpy_to_vtk(values.reshape(len(values), -1) if values.ndim > 1 else values, deep=1)
    array.SetName(name)
    attributes.AddArray(array)


def _members(indices, size):
    """A set as 0 and 1."""
    flags = np.zeros(size, np.uint8)
    flags[np.asarray([] if indices is None else indices, int)] = 1
    return flags


def _values(attributes, name, like=None):
    """An array of the grid; with the type and the shape of the one that it was made from."""
    values = vtk_to_numpy(attributes.GetArray(name))
    return values if like is None else values.reshape((-1,) + like.shape[1:]).astype(like.dtype)


def members_of_group(mesh, numbers, number, dimension):
    """The cells of this dimension that have this number, block by block."""
    return [np.flatnonzero(values == number) if block.dim == dimension else np.array([], int)
            for block, values in zip(mesh.cells, numbers)]


def _physical(mesh, name):
    """The cells of one of Gmsh's named groups."""
    return members_of_group(mesh, mesh.cell_data["gmsh:physical"], *mesh.field_data[name][:2])


def same_sets(some, others):
    """Whether two sets of cells are the same, block by block; None is empty."""
    return all(set(() if one is None else map(int, one)) == set(map(int, other)) for one, other in zip(some, others))


def _on_surface(mesh):
    """For each point whether it is on a facet that only one tetrahedron has (an edge, one triangle)."""
    kind = "tetra" if any(block.type == "tetra" for block in mesh.cells) else "triangle"
    cells = [np.asarray(block.data) for block in mesh.cells if block.type == kind]
    flags = np.zeros(len(mesh.points), bool)
    if cells:
        cells = np.concatenate(cells)
        facets = np.concatenate([np.delete(cells, corner, axis=1) for corner in range(cells.shape[1])])
        facets, counts = np.unique(np.sort(facets, axis=1), axis=0, return_counts=True)
        flags[facets[counts == 1]] = True
    return flags


class MeshioMesh:
    """The adapter of a meshio.Mesh; see `adapter`."""

    def __init__(self, mesh):
        self._mesh, self._kind = mesh, type(mesh)
        strange = sorted({block.type for block in mesh.cells} - CELL_TYPES.keys())
        if strange:
            raise ValueError(f"cells of the type {', '.join(strange)} cannot be used")
        self._point_sets = {name + " (set)": name for name in mesh.point_sets}
        self._cell_sets = {name + " (set)": name for name in mesh.cell_sets
                           if name not in GEOMETRY and not self._is_physical(name)}
        self.grid = self._make_grid()
        self._add_arrays()
        self.options = self._add_regions()
        if getattr(mesh, "gmsh_periodic", None):
            warnings.warn("lost: which nodes Gmsh had as periodic images of each other", stacklevel=5)

    def _is_physical(self, name):
        """Whether a set only repeats what the numbers in gmsh:physical say."""
        mesh = self._mesh
        return (name in mesh.field_data and "gmsh:physical" in mesh.cell_data
                and same_sets(mesh.cell_sets[name], _physical(mesh, name)))

    def _make_grid(self):
        grid, cells = vtkUnstructuredGrid(), vtkCellArray()
        grid.SetPoints(vtk_points(self._mesh.points))
        blocks = [(CELL_TYPES[block.type], np.asarray(block.data, np.int64)) for block in self._mesh.cells]
        sizes = np.concatenate([[0]] + [np.full(len(data), data.shape[1]) for _, data in blocks])
        nodes = np.concatenate([np.empty(0, np.int64)] + [data.ravel() for _, data in blocks])
        kinds = np.concatenate([np.empty(0, np.uint8)] + [np.full(len(data), kind, np.uint8) for kind, data in blocks])
        cells.SetData(numpy_to_vtkIdTypeArray(np.cumsum(sizes).astype(np.int64), deep=1),
                      numpy_to_vtkIdTypeArray(nodes, deep=1))
        grid.SetCells(numpy_to_vtk(kinds, deep=1), cells)
        return grid

    def _add_arrays(self):
        mesh, point_data, cell_data = self._mesh, self.grid.GetPointData(), self.grid.GetCellData()
        arrays = [(point_data, name, values) for name, values in mesh.point_data.items() if name not in GEOMETRY]
        arrays += [(cell_data, name, np.concatenate(values)) for name, values in mesh.cell_data.items() if values]
        for attributes, name, values in arrays:
            if np.asarray(values).dtype.kind in "biuf":
                _add(attributes, name, values)
            else:
                warnings.warn(f"lost: {name!r}, whose values are no numbers", stacklevel=6)
        for array, name in self._point_sets.items():
            # of type double: the filter interpolates it, and between members it is 1
            _add(point_data, array, _members(mesh.point_sets[name], len(mesh.points)).astype(float))
        for array, name in self._cell_sets.items():
            _add(cell_data, array, np.concatenate([_members(indices, len(block)) for block, indices
                                                   in zip(mesh.cells, mesh.cell_sets[name])]))
        _add(cell_data, BLOCK, np.repeat(np.arange(len(mesh.cells)), [len(block) for block in mesh.cells]))
        ids = numpy_to_vtkIdTypeArray(np.arange(len(mesh.points), dtype=np.int64), deep=1)
        ids.SetName(POINT)
        point_data.SetGlobalIds(ids)  # new points will have -1

    def _array(self, name):
        return vtk_to_numpy(self.grid.GetCellData().GetArray(name))

    def _add_regions(self):
        """The cells that are optimized, numbered by their groups; the option for it, if there is more than one."""
        kinds = np.repeat([CELL_TYPES[block.type] for block in self._mesh.cells],
                          [len(block) for block in self._mesh.cells]).astype(int)
        optimized = kinds == (10 if (kinds == 10).any() else 5)
        labels = [self._array(name)[optimized] for name in LABELS if name in self._mesh.cell_data]
        groups = next(([label] for label in labels if label.any()), [])
        groups += [self._array(array)[optimized] for array in self._cell_sets]
        if not groups or not optimized.any():
            return {}
        different, numbers = np.unique(np.column_stack(groups), axis=0, return_inverse=True)
        if len(different) == 1:
            return {}
        regions = np.zeros(len(kinds), np.int64)
        regions[optimized] = numbers.ravel()
        _add(self.grid.GetCellData(), REGION, regions)
        return {"region_array": REGION}

    def back(self, output):
        mesh, point_data, cell_data = self._mesh, output.GetPointData(), output.GetCellData()
        block_of = vtk_to_numpy(cell_data.GetArray(BLOCK))
        members = [np.flatnonzero(block_of == block) for block in range(len(mesh.cells))]
        cells = [(block.type, nodes_of(output, ids, block.data.shape[1])) for block, ids in zip(mesh.cells, members)]
        in_cells = {name: [_values(cell_data, name, np.asarray(values[0]))[ids] for ids in members]
                    for name, values in mesh.cell_data.items() if values and cell_data.GetArray(name)}
        in_cells["MeshQuality"] = [_values(cell_data, "MeshQuality")[ids] for ids in members]
        result = self._kind(
            vtk_to_numpy(output.GetPoints().GetData())[:, :mesh.points.shape[1]].copy(), cells,
            point_data={name: _values(point_data, name, values) for name, values in mesh.point_data.items()
                        if point_data.GetArray(name)},
            cell_data=in_cells, field_data=dict(mesh.field_data), info=mesh.info)
        for name in mesh.cell_sets.keys() - set(GEOMETRY) - set(self._cell_sets.values()):
            result.cell_sets[name] = _physical(result, name)
        for array, name in self._cell_sets.items():
            result.cell_sets[name] = [np.flatnonzero(_values(cell_data, array)[ids]) for ids in members]
        if self._point_sets:
            result.point_sets = self._point_sets_of(result, point_data)
        return result

    def _point_sets_of(self, result, point_data):
        old = _values(point_data, POINT)  # the number that a point had, -1 for a new one
        on_surface, was_on_surface = _on_surface(result), _on_surface(self._mesh)
        sets = {}
        for array, name in self._point_sets.items():
            before = _members(self._mesh.point_sets[name], len(self._mesh.points)).astype(bool)
            holds_inside = (before & ~was_on_surface).any()
            joins = (_values(point_data, array) > BETWEEN) & (on_surface | holds_inside)
            sets[name] = np.flatnonzero(np.where(old >= 0, before[old], joins))
            gone = before.sum() - before[old[old >= 0]].sum()
            if gone:
                warnings.warn(f"{gone} of the {before.sum()} points of the set {name!r} are no longer there; "
                              f"fixed_point_array={array!r} keeps them", stacklevel=4)
        return sets
