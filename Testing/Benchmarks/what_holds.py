# SPDX-License-Identifier: BSD-3-Clause
"""What holds the worst elements of a mesh whose surface took part (Boundary Mode Slide)? As a Markdown table.

    /usr/bin/python3 what_holds.py AFTER.vtu [--tolerance T] [--below Q]

    --tolerance T   that of the run, as a fraction of the diagonal (default 1e-3)
    --below Q       elements under this quality (default .4); those that share a node are one group, a row each

AFTER.vtu is an output of Mesh Optimize: it has MeshQuality and BoundaryPlace. For the worst element of each group: how its
nodes are held; its shortest edge, in tolerances; the sharpest angle of its faces on the surface, and what a face with that
angle allows (the best tetrahedron on it); its sharpest dihedral angle between two such faces, and what that allows. An
element near what its angle allows is held by that angle: only other places of its nodes on the surface help, and the
tolerance or a corner holds these.
"""
import argparse
import collections

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import VTK_TETRA
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

PLACES = ("inside", "patch", "curve", "corner")
FACES = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])
EDGES = ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))
CONSTANT = 1296 * np.sqrt(2)


def shape(x):
    edges = sum(np.linalg.norm(x[b] - x[a]) for a, b in EDGES)
    return CONSTANT * abs(np.linalg.det(x[1:] - x[0])) / 6 / edges**3


def best(make, most):
    """The greatest shape of make(r, h) by a search that shrinks."""
    p, step = np.array([0.7, 0.7])[:most], 0.5
    value = shape(make(*p))
    while step > 1e-6:
        for direction in np.vstack([np.eye(most), -np.eye(most)]):
            q = p + step * direction
            other = shape(make(*q)) if q.min() > 0 else -1
            if other > value:
                p, value = q, other
                break
        else:
            step /= 2
    return value


def cap_of_face(angle):
    """The best element with this angle of a face: its sides have length 1, the apex is above the bisector."""
    half = np.array([np.cos(angle / 2), np.sin(angle / 2), 0])
    return best(lambda r, h: np.array([[0, 0, 0], [1, 0, 0], [np.cos(angle), np.sin(angle), 0], r * half + [0, 0, h]]), 2)


def cap_of_ridge(angle):
    """The best element with this dihedral angle, at an edge of length 1."""
    return best(lambda r: np.array([[0, 0, 0], [1, 0, 0], [.5, r, 0], [.5, r * np.cos(angle), r * np.sin(angle)]]), 1)


def angle_between(u, v):
    return np.arctan2(np.linalg.norm(np.cross(u, v)), u @ v)


def groups_of(cells):
    """Lists of cells (by number) that are connected by nodes."""
    owner = list(range(len(cells)))

    def root(k):
        while owner[k] != k:
            k = owner[k]
        return k

    at = collections.defaultdict(list)
    for k, cell in enumerate(cells):
        for p in cell:
            at[p].append(k)
    for same in at.values():
        for k in same[1:]:
            owner[root(k)] = root(same[0])
    groups = collections.defaultdict(list)
    for k in range(len(cells)):
        groups[root(k)].append(k)
    return list(groups.values())


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("mesh")
    parser.add_argument("--tolerance", type=float, default=1e-3)
    parser.add_argument("--below", type=float, default=0.4)
    arguments = parser.parse_args()
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(arguments.mesh)
    reader.Update()
    grid = reader.GetOutput()
    points = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    quality = vtk_to_numpy(grid.GetCellData().GetArray("MeshQuality"))
    place = vtk_to_numpy(grid.GetPointData().GetArray("BoundaryPlace")).astype(int)
    length = arguments.tolerance * grid.GetLength()
    types = np.array([grid.GetCellType(c) for c in range(grid.GetNumberOfCells())])
    offsets = vtk_to_numpy(grid.GetCells().GetOffsetsArray())[:-1][types == VTK_TETRA]
    cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray())[offsets[:, None] + np.arange(4)]
    quality = quality[types == VTK_TETRA]
    keys, inverse, count = np.unique(np.sort(cells[:, FACES].reshape(-1, 3), axis=1), axis=0, return_inverse=True, return_counts=True)
    outer = (count[inverse.reshape(-1)] == 1).reshape(-1, 4)
    bad = np.flatnonzero(quality < arguments.below)
    print(f"{len(bad)} of {len(cells)} elements under {arguments.below:g}\n")
    print("| elements | worst | nodes | shortest edge | sharpest angle of a face | allows | sharpest ridge | allows |")
    print("|---|---|---|---|---|---|---|---|")
    for group in sorted(groups_of(cells[bad].tolist()), key=lambda g: quality[bad[g]].min()):
        cell = bad[min(group, key=lambda k: quality[bad[k]])]
        x = points[cells[cell]]
        nodes = ", ".join(f"{n} {PLACES[p]}" for p, n in sorted(collections.Counter(place[cells[cell]]).items(), reverse=True))
        shortest = min(np.linalg.norm(x[b] - x[a]) for a, b in EDGES) / length
        facial = [angle_between(x[f[(k + 1) % 3]] - x[f[k]], x[f[(k + 2) % 3]] - x[f[k]])
                  for f in FACES[outer[cell]] for k in range(3)]
        ridges = []
        for a, b in EDGES:
            c, d = (i for i in range(4) if i not in (a, b))
            if outer[cell][c] and outer[cell][d]:
                t = x[b] - x[a]
                ridges.append(angle_between(np.cross(t, x[c] - x[a]), np.cross(t, x[d] - x[a])))
        row = [str(len(group)), f"{quality[cell]:.4f}", nodes, f"{shortest:.2f}"]
        for angles, cap in ((facial, cap_of_face), (ridges, cap_of_ridge)):
            row += [f"{np.degrees(min(angles)):.1f}", f"{cap(min(angles)):.3f}"] if angles else ["", ""]
        print("| " + " | ".join(row) + " |")


if __name__ == "__main__":
    main()
