# SPDX-License-Identifier: BSD-3-Clause
"""Lines on the borders between the faces of a solid, as cells with numbers: fuzz_solids.py lets them ride on the surface."""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import VTK_LINE

FIRST = 1000  # the lines' numbers in the array Face begin here: faces have others


def borders(random, triangles, faces):
    """(edges, number of each): edges where triangles of different faces meet, one number for each pair of faces; some are left out,
    and some numbers end in the middle of a border."""
    half = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    owner = np.repeat(faces, 3)
    order = np.lexsort((owner, half[:, 1], half[:, 0]))
    half, owner = half[order], owner[order]
    start = np.flatnonzero(np.r_[True, (half[1:] != half[:-1]).any(axis=1)])
    low, high = np.minimum.reduceat(owner, start), np.maximum.reduceat(owner, start)
    between = low != high
    edges, pairs = half[start][between], np.c_[low, high][between]
    numbers = FIRST + np.unique(pairs, axis=0, return_inverse=True)[1].ravel()
    if random.random() < 0.5:
        keep = np.isin(numbers, random.permutation(np.unique(numbers))[::2])
        edges, numbers = edges[keep], numbers[keep]
    if random.random() < 0.5 and len(numbers):
        numbers = numbers + (numbers.max() + 1 - FIRST) * (edges.min(axis=1) % 5 == 0)
    return edges, numbers


def add(grid, edges, numbers):
    """Adds them as lines, with their numbers in the array Face (0 for other cells, if it was not there)."""
    data = grid.GetCellData()
    count = grid.GetNumberOfCells()
    old = {data.GetArray(k).GetName(): vtk_to_numpy(data.GetArray(k)).copy() for k in range(data.GetNumberOfArrays())}
    old.setdefault("Face", np.zeros(count, dtype=np.int32))
    for a, b in edges.tolist():
        grid.InsertNextCell(VTK_LINE, 2, [a, b])
    for name, values in old.items():
        array = numpy_to_vtk(np.r_[values, numbers if name == "Face" else 0 * numbers].astype(np.int32), deep=1)
        array.SetName(name)
        data.RemoveArray(name)
        data.AddArray(array)


def of(grid):
    """(edges, number of each)"""
    types = np.array([grid.GetCellType(c) for c in range(grid.GetNumberOfCells())], dtype=int)
    ids = np.flatnonzero(types == VTK_LINE)
    offsets = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    nodes = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    return nodes[offsets[ids][:, None] + np.arange(2)], vtk_to_numpy(grid.GetCellData().GetArray("Face"))[ids]


def distances(x, points, edges):
    """From each x to the nearest of the edges."""
    a, d = points[edges[:, 0]], points[edges[:, 1]] - points[edges[:, 0]]
    t = ((x[:, None] - a) * d).sum(axis=2) / np.maximum((d * d).sum(axis=1), 1e-300)
    return np.linalg.norm(a + np.clip(t, 0, 1)[:, :, None] * d - x[:, None], axis=2).min(axis=1)


def ends(edges):
    """The points with other than two of the edges."""
    points, count = np.unique(edges, return_counts=True)
    return points[count != 2]


def faults(before, after, facets, limit):
    """What is wrong with the lines after. `before`, `after`: (points, edges, numbers); `facets`: those of the surface after."""
    p0, e0, n0 = before
    p1, e1, n1 = after
    on = {tuple(x) for x in np.sort(facets[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1).tolist()}
    keys = [tuple(x) for x in np.sort(e1, axis=1).tolist()]
    if not all(k in on for k in keys):
        yield f"{sum(k not in on for k in keys)} lines are no edges of the surface"
    if len(set(keys)) != len(keys):
        yield "a line twice"
    if set(n0) != set(n1):
        yield f"lines {sorted(set(n0) ^ set(n1))} came or went"
        return
    part = np.linspace(0, 1, 6)[:, None, None]
    for number in np.unique(n0):
        a, b = e0[n0 == number], e1[n1 == number]
        for one, other, p, q in ((a, b, p0, p1), (b, a, p1, p0)):
            x = ((1 - part) * p[one[:, 0]] + part * p[one[:, 1]]).reshape(-1, 3)
            away = distances(x, q, other).max()
            if away > limit * (1 + 1e-9):
                yield f"line {number}: {away / limit:.3g} times what is allowed from where it was"
        x, y = p0[ends(a)], p1[ends(b)]
        if len(x) != len(y) or (len(x) and np.linalg.norm(x[:, None] - y, axis=2).min(axis=1).max() > limit * (1 + 1e-9)):
            yield f"line {number}: {len(x)} ends became {len(y)}, or moved too far"
