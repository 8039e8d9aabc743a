# SPDX-License-Identifier: BSD-3-Clause
"""How good the elements on the worst boundary facets could be if nothing but the surface stood in the way.

    /usr/bin/python3 caps_in_sight.py MESH.vtu [--facets N] [--prove Q]

Each boundary facet belongs to one element, whose fourth node must be seen from all of the facet. Mesh Quality Min Max certifies a bound that
counts this (Filters/Core/Bound/SightBound.h). Here the same is sought by other means, without its code. The node is sought by chance, then by
ever smaller steps, among places that the facet's corners and its middle see: an estimate (in sight of four points only, so that it may be too
high; sought by chance, so that it may be too low), no certificate. --prove gives one: it looks for a facet that cannot have an element of
quality Q, as wherever the fourth node is, the element is worse or has a facet of the surface inside. Places from which a given facet is in
the way form a convex set; so a box of places is ruled out once one facet is in the way of its eight corners, or else divided.
Needs a Python with VTK.
"""
import argparse
import collections

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import mutable
from vtkmodules.vtkCommonDataModel import vtkStaticCellLocator
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

LEVELS = (0.1, 0.2, 0.3)


def boundary(cells):
    """Facets of one cell only, and that cell's fourth node."""
    found = collections.defaultdict(list)
    for cell in cells:
        for k in range(4):
            facet = [int(p) for i, p in enumerate(cell) if i != k]
            found[tuple(sorted(facet))].append(int(cell[k]))
    return [(list(facet), fourth[0]) for facet, fourth in found.items() if len(fourth) == 1]


def shape(facet, x):
    """The paper's shape quality of tetrahedra (facet, x), x of shape (..., 3)."""
    volume = np.abs((x - facet[0]) @ np.cross(facet[1] - facet[0], facet[2] - facet[0])) / 6
    edges = sum(np.linalg.norm(facet[i] - facet[i - 1]) for i in range(3)) + sum(np.linalg.norm(x - p, axis=-1) for p in facet)
    return 6 * np.sqrt(2) * volume / (edges / 6) ** 3


def surface_of(grid):
    """The surface, and a locator of its triangles."""
    surface = vtkGeometryFilter()
    surface.SetInputData(grid)
    surface.Update()
    locator = vtkStaticCellLocator()
    locator.SetDataSet(surface.GetOutput())
    locator.BuildLocator()
    return surface.GetOutput(), locator


def sees(locator, a, b):
    """True if nothing of the surface lies between a, on it, and b."""
    t, sub, x, pc = mutable(0.0), mutable(0), [0.0] * 3, [0.0] * 3
    return not locator.IntersectWithLine(a + 1e-6 * (b - a), b, 0.0, t, x, pc, sub)


def best(facet, inside, locator, random):
    """Cap of a facet, and the best quality found in sight of it."""
    normal = np.cross(facet[1] - facet[0], facet[2] - facet[0])
    normal /= np.linalg.norm(normal)
    normal *= np.sign((inside - facet[0]) @ normal)
    length = max(np.linalg.norm(facet[i] - facet[i - 1]) for i in range(3))
    middle = facet.mean(axis=0)

    def climb(allowed):
        x, q, step = None, 0.0, 0.3
        while step > 1e-3:
            if x is None:  # heights down to a thousandth of the facet's length
                heights = length * 10 ** random.uniform(-3, 0.2, 2000)
                tries = random.dirichlet([1, 1, 1], 2000) @ facet + heights[:, None] * (normal + 0.5 * random.standard_normal((2000, 3)))
            else:
                size = step * max((x - middle) @ normal, 1e-3 * length)
                tries = x + size * random.standard_normal((60, 3))
            tries = tries[(tries - facet[0]) @ normal > 0]
            values = shape(facet, tries)
            for k in np.argsort(-values):
                if values[k] <= q:
                    step /= 2
                    break
                if allowed(tries[k]):
                    x, q = tries[k], values[k]
                    break
            else:
                step /= 2
        return q

    return climb(lambda x: True), climb(lambda x: all(sees(locator, p, x) for p in (*facet, middle)))


def is_in_the_way(triangle, tetrahedron):
    """True if part of the triangle lies inside the tetrahedron, off its faces by more than rounding."""
    size = np.ptp(tetrahedron, axis=0).max()
    polygon = triangle
    for k in range(4):
        a, b, c = tetrahedron[[i for i in range(4) if i != k]]
        normal = np.cross(b - a, c - a)
        length = np.linalg.norm(normal)
        if length < 1e-14 * size**2:
            return False
        normal *= np.sign((tetrahedron[k] - a) @ normal) / length
        d = (polygon - a) @ normal - 1e-9 * size
        kept = []
        for i in range(len(polygon)):
            if d[i - 1] * d[i] < 0:
                kept.append(polygon[i - 1] + d[i - 1] / (d[i - 1] - d[i]) * (polygon[i] - polygon[i - 1]))
            if d[i] > 0:
                kept.append(polygon[i])
        if not kept:
            return False
        polygon = np.array(kept)
    return True


def blockers(locator, triangles, facet, x):
    """Facets that lie between x and some points of the facet."""
    t, sub, where, pc, cell = mutable(0.0), mutable(0), [0.0] * 3, [0.0] * 3, mutable(0)
    found = []
    for weights in ((1, 1, 1), (4, 1, 1), (1, 4, 1), (1, 1, 4)):
        y = np.array(weights) @ facet / sum(weights)
        if locator.IntersectWithLine(y + 1e-6 * (x - y), x, 0.0, t, where, pc, sub, cell):
            if int(cell) not in found:
                found.append(int(cell))
    return [triangles[c] for c in found]


def is_impossible(facet, inside, q, locator, triangles, most_boxes=20000):
    """True if it is proved that no element on the facet has the quality q in sight of the surface."""
    normal = np.cross(facet[1] - facet[0], facet[2] - facet[0])
    edges = sum(np.linalg.norm(facet[i] - facet[i - 1]) for i in range(3))
    side = (inside - facet[0]) @ normal
    if abs(side) < 1e-12 * np.linalg.norm(normal) * edges:
        return False  # the element there is flat: on which side the mesh lies is not known
    normal *= np.sign(side)
    # At the distance d from the facet V <= |normal| d / 6, and the edges sum to at least 3 d: S <= 8 sqrt(2) |normal| / d^2.
    reach = np.sqrt(8 * np.sqrt(2) * np.linalg.norm(normal) / q) + edges
    middle = facet.mean(axis=0)
    boxes = [(middle, reach)]  # centre and half width
    signs = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, 8).T
    for _ in range(most_boxes):
        if not boxes:
            return True
        centre, half = boxes.pop()
        corners = centre + half * signs
        volume = ((corners - facet[0]) @ normal / 6).max()  # affine: greatest at a corner
        to_facet = sum(max(np.linalg.norm(centre - p) - np.sqrt(3) * half, 0.0) for p in facet)
        if volume <= 0 or 6 * np.sqrt(2) * volume / ((edges + to_facet) / 6) ** 3 < q:
            continue
        if any(all(is_in_the_way(triangle, np.vstack([facet, x])) for x in corners)
               for triangle in blockers(locator, triangles, facet, centre)):
            continue
        boxes += [(centre + half / 2 * s, half / 2) for s in signs]
    return False


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh")
    parser.add_argument("--facets", type=int, default=1500, help="so many of the narrowest facets")
    parser.add_argument("--listed", type=int, default=10)
    parser.add_argument("--prove", type=float, metavar="Q", help="that no mesh with this surface has a worst quality of Q")
    arguments = parser.parse_args()
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(arguments.mesh)
    reader.Update()
    grid = reader.GetOutput()
    points = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)
    shown, locator = surface_of(grid)

    def width(entry):
        p = points[entry[0]]
        longest = max(np.linalg.norm(p[i] - p[i - 1]) for i in range(3))
        return np.linalg.norm(np.cross(p[1] - p[0], p[2] - p[0])) / longest**2

    facets = sorted(boundary(cells), key=width)[:arguments.facets]
    if arguments.prove:
        corners = vtk_to_numpy(shown.GetPoints().GetData()).astype(float)
        triangles = corners[vtk_to_numpy(shown.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
        for facet, fourth in facets[:arguments.listed]:
            if is_impossible(points[facet], points[fourth], arguments.prove, locator, triangles):
                print(f"Proved: no element on the facet {' '.join(map(str, facet))} has the quality {arguments.prove}.")
                return
        print("Not proved.")
        return
    random = np.random.default_rng(1)
    rows = [(facet, *best(points[facet], points[fourth], locator, random)) for facet, fourth in facets]
    rows.sort(key=lambda row: row[2])
    print("| facet | cap | in sight |\n|---|---|---|")
    for facet, cap, seen in rows[:arguments.listed]:
        print(f"| {' '.join(map(str, facet))} | {cap:.4f} | {seen:.4f} |")
    print(f"\nOf the {len(rows)} narrowest facets:")
    for level in LEVELS:
        print(f"under {level}: {sum(r[1] < level for r in rows)} by their own shape, {sum(r[2] < level for r in rows)} in sight")


if __name__ == "__main__":
    main()
