# SPDX-License-Identifier: BSD-3-Clause
"""How good the elements on the worst boundary facets could be if nothing but the surface stood in the way.

    /usr/bin/python3 caps_in_sight.py MESH.vtu [--facets N]

Each boundary facet belongs to one element, whose fourth node must be seen from all of the facet. The cap that Mesh Quality Min Max
certifies lets that node be anywhere; where another part of the surface is near, as in thin walls, it is far too high. Here the node is sought by
chance, then by ever smaller steps, among places that the facet's corners and its middle see: an estimate (in sight of four points only,
so that it may be too high; sought by chance, so that it may be too low), no certificate. Needs a Python with VTK.
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


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh")
    parser.add_argument("--facets", type=int, default=1500, help="so many of the narrowest facets")
    parser.add_argument("--listed", type=int, default=10)
    arguments = parser.parse_args()
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(arguments.mesh)
    reader.Update()
    grid = reader.GetOutput()
    points = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)
    surface = vtkGeometryFilter()
    surface.SetInputData(grid)
    surface.Update()
    locator = vtkStaticCellLocator()
    locator.SetDataSet(surface.GetOutput())
    locator.BuildLocator()

    def width(entry):
        p = points[entry[0]]
        longest = max(np.linalg.norm(p[i] - p[i - 1]) for i in range(3))
        return np.linalg.norm(np.cross(p[1] - p[0], p[2] - p[0])) / longest**2

    facets = sorted(boundary(cells), key=width)[:arguments.facets]
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
