# SPDX-License-Identifier: BSD-3-Clause
"""Reads nodes, elements and sets of an Abaqus input file into a meshio.Mesh.

meshio's own reader takes a set that is given in several parts for its last part, gives sets of *ELEMENT lines to other
elements where not all lines have one, and forgets the types of elements and what it skips.
"""
import re
import warnings

import numpy as np

from ._run import MeshOptimizeError

# Families of element types, by what follows the name of the family
_FAMILIES = (
    (re.compile(r"(?:A|D|DC|Q)?C3D(\d+)"), {"4": "tetra", "5": "pyramid", "6": "wedge", "8": "hexahedron",
                                            "10": "tetra10", "15": "wedge15", "20": "hexahedron20"}),
    (re.compile(r"(?:CPS|CPEG|CPE|CAX|M3D|R3D|R2D|SFM3D|STRI|DC2D|DCAX|DS|S)(\d)"),
     {"3": "triangle", "4": "quad", "6": "triangle6", "8": "quad8"}),
    (re.compile(r"T[23]D(\d)"), {"2": "line", "3": "line3"}),
    (re.compile(r"B[23](\d)"), {"1": "line", "2": "line3", "3": "line"}),
)
_NODES = {"line": 2, "line3": 3, "triangle": 3, "quad": 4, "triangle6": 6, "quad8": 8, "tetra": 4, "pyramid": 5,
          "wedge": 6, "hexahedron": 8, "tetra10": 10, "wedge15": 15, "hexahedron20": 20}


def _cell_type(element_type):
    for family, cells in _FAMILIES:
        match = family.match(element_type)
        if match and match[1] in cells:
            return cells[match[1]]
    raise MeshOptimizeError(f"elements of the type {element_type} cannot be read")


def _sections(path):
    """(keyword, parameters, rows of words) for each keyword of the file."""
    keyword, parameters, rows, continues = None, {}, [], False
    with open(path, encoding="utf-8", errors="replace") as file:
        for line in file:
            line = line.strip()
            if not line or line.startswith("**"):
                continue
            words = [word.strip() for word in line.split(",")]
            if line.startswith("*"):
                if keyword:
                    yield keyword, parameters, rows
                keyword, parameters, rows = " ".join(words.pop(0)[1:].upper().split()), {}, []
            if line.startswith("*") or continues:
                pairs = (word.partition("=") for word in words if word)
                parameters.update((name.strip().upper(), value.strip()) for name, _, value in pairs)
                continues = line.endswith(",")
            else:
                rows.append([word for word in words if word])
    if keyword:
        yield keyword, parameters, rows


class _Sets:
    """Sets by name, of numbers as the file gives them. Names are the same in capitals; parts add up."""

    def __init__(self):
        self._members = {}  # name in capitals -> (name, list of numbers)

    def add(self, name, numbers):
        self._members.setdefault(name.upper(), (name, []))[1].extend(numbers)

    def add_rows(self, name, parameters, rows):
        self.add(name, [])
        for row in rows:
            if "GENERATE" in parameters:
                first, last, step = (list(map(int, row)) + [1])[:3]
                self.add(name, range(first, last + 1, step))
                continue
            for word in row:
                known = self._members.get(word.upper())
                if known is None and not word.isdigit():
                    raise MeshOptimizeError(f"the set {name} has a part {word} that is no set before it")
                self.add(name, known[1] if known else [int(word)])

    def items(self):
        return self._members.values()


def _find(numbers, wanted):
    """The indices at which the wanted numbers stand, without those that do not."""
    return np.flatnonzero(np.isin(numbers, np.fromiter(wanted, int)))


def read(path):
    """The mesh of an input file with one part; what is left out is named in a warning. `info` has the element types."""
    import meshio

    nodes, blocks, point_sets, cell_sets, lost = [], [], _Sets(), _Sets(), set()
    for keyword, parameters, rows in _sections(path):
        if keyword == "NODE":
            nodes += rows
            if "NSET" in parameters:
                point_sets.add(parameters["NSET"], [int(row[0]) for row in rows])
        elif keyword == "ELEMENT":
            kind = _cell_type(parameters.get("TYPE", "").upper())
            elements = np.array([int(word) for row in rows for word in row]).reshape(-1, 1 + _NODES[kind])
            blocks.append((parameters["TYPE"], kind, elements))
            if "ELSET" in parameters:
                cell_sets.add(parameters["ELSET"], elements[:, 0].tolist())
        elif keyword == "NSET" and "NSET" in parameters:
            point_sets.add_rows(parameters["NSET"], parameters, rows)
        elif keyword == "ELSET" and "ELSET" in parameters:
            cell_sets.add_rows(parameters["ELSET"], parameters, rows)
        elif keyword == "INCLUDE":
            raise MeshOptimizeError(f"{path} includes another file: put both into one")
        elif keyword not in ("HEADING", "PREPRINT"):
            lost.add("*" + keyword)
    if not nodes or not blocks:
        raise MeshOptimizeError(f"{path} has no *NODE or no *ELEMENT")
    if lost:
        warnings.warn(f"lost: {', '.join(sorted(lost))} of {path}", stacklevel=4)
    numbers = np.array([int(row[0]) for row in nodes])
    elements = np.concatenate([block[:, 0] for _, _, block in blocks])
    if len(np.unique(numbers)) < len(numbers) or len(np.unique(elements)) < len(elements):
        raise MeshOptimizeError(f"{path} has a node or an element twice: only one part can be read")
    order = np.argsort(numbers)
    used = np.concatenate([block[:, 1:].ravel() for _, _, block in blocks])
    if not np.isin(used, numbers).all():
        raise MeshOptimizeError(f"{path} has elements with nodes that are not there")
    return meshio.Mesh(
        np.array([[float(word) for word in row[1:4]] for row in nodes]),
        [(kind, order[np.searchsorted(numbers, block[:, 1:], sorter=order)]) for _, kind, block in blocks],
        point_sets={name: _find(numbers, members) for name, members in point_sets.items()},
        cell_sets={name: [_find(block[:, 0], members) for _, _, block in blocks]
                   for name, members in cell_sets.items()},
        info={"abaqus:types": [element_type for element_type, _, _ in blocks]})
