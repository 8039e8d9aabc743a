# SPDX-License-Identifier: BSD-3-Clause
"""Groups and sets in the terms of each format: Gmsh and Medit and Nastran number cells, Abaqus names sets."""
import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

from ._grids import kinds_of, nodes_of
from ._meshio import (BETWEEN, BLOCK, CELL_TYPES, GEOMETRY, LABELS, POINT, REGION, MeshioMesh, members_of_group,
                      same_sets)

QUALITY = "MeshQuality"  # a result, not data of the user: not written, and no loss
SET, GROUP = " (set)", "group "
# For cells that did not come from Abaqus
ABAQUS_TYPES = {"line": "T3D2", "triangle": "S3", "quad": "S4", "tetra": "C3D4", "pyramid": "C3D5", "wedge": "C3D6",
                "hexahedron": "C3D8", "line3": "T3D3", "triangle6": "STRI65", "quad8": "S8R", "tetra10": "C3D10",
                "wedge15": "C3D15", "hexahedron20": "C3D20"}
_NAMES = {number: name for name, number in CELL_TYPES.items()}


def is_meshio(mesh):
    meshio = sys.modules.get("meshio")
    return bool(meshio) and isinstance(mesh, meshio.Mesh)


def grid_of(mesh):
    """A meshio mesh as a grid for VTK's files: a set is an array "NAME (set)" of 0 and 1, a group's name field data."""
    grid = MeshioMesh(mesh).grid
    for name in (BLOCK, REGION):
        grid.GetCellData().RemoveArray(name)
    grid.GetPointData().RemoveArray(POINT)
    for name, entry in mesh.field_data.items():
        array = numpy_to_vtk(np.array(entry[:2], np.int32), deep=1)
        array.SetName(GROUP + name)
        grid.GetFieldData().AddArray(array)
    return grid


def _arrays(attributes):
    arrays = (attributes.GetArray(index) for index in range(attributes.GetNumberOfArrays()))
    return {array.GetName(): vtk_to_numpy(array) for array in arrays if array}  # GetArray() is None for strings


def mesh_of(grid):
    """A grid as a meshio mesh, a block for each type of cell; arrays "NAME (set)" become sets again."""
    import meshio

    kinds = kinds_of(grid)
    strange = sorted(set(kinds.tolist()) - _NAMES.keys())
    if strange:
        raise ValueError(f"cells of VTK's type {strange[0]} have no place in this format")
    members = [np.flatnonzero(kinds == kind) for kind in np.unique(kinds)]
    cells = [(_NAMES[kinds[ids[0]]], nodes_of(grid, ids, grid.GetCell(ids[0]).GetNumberOfPoints())) for ids in members]
    in_points, in_cells = _arrays(grid.GetPointData()), _arrays(grid.GetCellData())
    return meshio.Mesh(
        vtk_to_numpy(grid.GetPoints().GetData()), cells,
        point_data={name: values for name, values in in_points.items() if not name.endswith(SET)},
        cell_data={name: [values[ids] for ids in members] for name, values in in_cells.items()
                   if not name.endswith(SET)},
        point_sets={name[:-len(SET)]: np.flatnonzero(values > BETWEEN) for name, values in in_points.items()
                    if name.endswith(SET)},
        cell_sets={name[:-len(SET)]: [np.flatnonzero(values[ids]) for ids in members]
                   for name, values in in_cells.items() if name.endswith(SET)},
        field_data={name[len(GROUP):]: values for name, values in _arrays(grid.GetFieldData()).items()
                    if name.startswith(GROUP)})


class _Labels:
    """The groups of a mesh as a number for each cell; `names`: name -> (number, dimension); `lost`: what is left."""

    def __init__(self, mesh):
        self.lost, self.names = [], {}
        sets = {name: members for name, members in mesh.cell_sets.items() if name not in GEOMETRY}
        self.source = next((name for name in LABELS if name in mesh.cell_data), None)
        if self.source:
            self._take_numbers(mesh, sets)
        else:
            self.values = [np.zeros(len(block), int) for block in mesh.cells]
            for number, (name, members) in enumerate(sets.items(), 1):
                self._take_set(mesh, number, name, members)

    def _take_numbers(self, mesh, sets):
        self.values = [np.asarray(part, int) for part in mesh.cell_data[self.source]]
        self.names = {name: tuple(map(int, entry[:2])) for name, entry in mesh.field_data.items()}
        for name, members in sets.items():  # those that the numbers do not tell
            if name not in self.names or not same_sets(members, members_of_group(mesh, self.values, *self.names[name])):
                self.lost.append(f"the set {name}")

    def _take_set(self, mesh, number, name, members):
        for block, values, given in zip(mesh.cells, self.values, members):
            if given is None or not len(given):
                continue
            if values[given].any() and f"the set {name} where it overlaps others" not in self.lost:
                self.lost.append(f"the set {name} where it overlaps others")
            values[given[values[given] == 0]] = number
            in_other_dimension = self.names.get(name, (number, block.dim))[1] != block.dim
            self.names[f"{name}_{block.dim}d" if in_other_dimension else name] = (number, block.dim)


def _data_lost(mesh, point_data, labels=None):
    """The arrays that a format has no place for: all but these point data and the numbers of the groups."""
    lost = [f"the array {name}" for name in mesh.point_data if name not in (*point_data, *GEOMETRY)]
    for name, values in mesh.cell_data.items():
        if name in LABELS:
            if labels and not all(map(np.array_equal, values, labels)):
                lost.append(f"the numbers {name}")
        elif name != QUALITY:
            lost.append(f"the array {name}")
    return lost


def _for_gmsh(mesh):
    """Version 2.2 in ASCII: nodes have no entities there, which would not be true of new nodes. Values at cells could
    be written, but meshio could not read that file again."""
    labels = _Labels(mesh)
    point_data = {name: values for name, values in mesh.point_data.items()
                  if name not in GEOMETRY and np.shape(values)[1:] in ((), (1,), (3,), (9,))}
    lost = labels.lost + _data_lost(mesh, point_data) + [f"the set {name}" for name in mesh.point_sets]
    only_geometry = labels.source == "gmsh:geometrical"
    cell_data = {"gmsh:physical": [0 * values for values in labels.values] if only_geometry else labels.values,
                 "gmsh:geometrical": mesh.cell_data.get("gmsh:geometrical", labels.values)}
    names = {name: np.array(entry) for name, entry in labels.names.items()}
    return (_copy(mesh, point_data=point_data, cell_data=cell_data, field_data=names),
            {"file_format": "gmsh22", "binary": False}, lost)


def _for_numbers(mesh, label, file_format, point_label=None):
    """Formats that hold one number for each cell, and no names."""
    labels = _Labels(mesh)
    point_data = {name: values for name, values in mesh.point_data.items() if name == point_label}
    lost = labels.lost + _data_lost(mesh, point_data, labels.values) + [f"the set {name}" for name in mesh.point_sets]
    lost += [f"the name {name} of the group {number}" for name, (number, _) in labels.names.items()]
    return _copy(mesh, point_data=point_data, cell_data={label: labels.values}), {"file_format": file_format}, lost


def _for_medit(mesh):
    return _for_numbers(mesh, "medit:ref", "medit", point_label="medit:ref")


def _for_nastran(mesh):
    return _for_numbers(mesh, "nastran:ref", "nastran")


def _for_abaqus(mesh):
    """Groups that are numbers become sets, under their names where they have some."""
    cell_sets = {name: [np.array([], int) if part is None else part for part in members]
                 for name, members in mesh.cell_sets.items() if name not in GEOMETRY}
    label = next((name for name in LABELS
                  if name in mesh.cell_data and any(map(np.any, mesh.cell_data[name]))), None)
    if label:
        _add_numbered(mesh, label, cell_sets)
    types = (mesh.info or {}).get("abaqus:types") or [ABAQUS_TYPES.get(block.type) for block in mesh.cells]
    if None in types:
        raise ValueError(f"cells of the type {mesh.cells[types.index(None)].type} have no place in this format")
    prepared = _copy(mesh, point_sets=mesh.point_sets, cell_sets=cell_sets)
    for block, element_type in zip(prepared.cells, [kind for kind, block in zip(types, mesh.cells) if len(block)]):
        block.type = element_type  # which meshio then writes as it is
    lost = _data_lost(mesh, {}, mesh.cell_data.get(label))
    return prepared, {"file_format": "abaqus", "translate_cell_names": False}, lost


def _add_numbered(mesh, label, cell_sets):
    """A set for each number of each dimension."""
    names = {tuple(map(int, entry[:2])): name for name, entry in mesh.field_data.items()}
    for k, (block, values) in enumerate(zip(mesh.cells, mesh.cell_data[label])):
        for number in np.unique(values[values != 0]):
            name = names.get((number, block.dim), f"{label.split(':')[1]}_{number}_{block.dim}d")
            members = cell_sets.setdefault(name, [np.array([], int)] * len(mesh.cells))
            members[k] = np.flatnonzero(values == number)


def _copy(mesh, **parts):
    """The points and cells of a mesh, with these parts alone. Blocks without cells are left out."""
    filled = [k for k, block in enumerate(mesh.cells) if len(block)]
    for name in ("cell_data", "cell_sets"):
        parts[name] = {key: [values[k] for k in filled] for key, values in parts.get(name, {}).items()}
    return type(mesh)(mesh.points, [(mesh.cells[k].type, mesh.cells[k].data) for k in filled], **parts)


# For each format: mesh -> what meshio is to write, how, and what is lost
PREPARE = {"gmsh": _for_gmsh, "medit": _for_medit, "nastran": _for_nastran, "abaqus": _for_abaqus}
