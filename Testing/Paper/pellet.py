# SPDX-License-Identifier: BSD-3-Clause
"""The fuel pellets of the paper: closed surfaces of cylinders without and with a crack, and their meshes "as generated".

    /usr/bin/python3 pellet.py list                        names, elements, worst shape, what the surface allows
    /usr/bin/python3 pellet.py write FOLDER [NAME ...]     the meshes as FOLDER/NAME.vtu
    /usr/bin/python3 pellet.py find [NAME ...]             searches the volumes of the cracked ones, and prints them

NAME: A, B, C, D (table 1), crack20, crack40, crack60 (table 2). Needs numpy and the package meshoptimize (./bootstrap.sh env).

The paper gives the radius, the height, the depth of the cracks in parts of the radius, and the numbers of elements. It does
not give the shape of the crack nor the meshes of the surface. Here the crack is a slot of constant width with a flat bottom,
in the plane y = 0, x > 0, through the whole height, and triangles have about the size of the tetrahedra:

- a cap is rings of 6, 12, 18, ... points around its centre; a side is rows of triangles, every other one shifted by half;
- the slot opens the row of ring points on the x axis, so walls are a grid of right triangles.

All lengths are in cm. Sines are those of the C library (math), the same on all machines: the last bits of NumPy's depend on its
version and on the processor, and with them the whole mesh that TetGen makes.
"""
import argparse
import math
import os
import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData, vtkUnstructuredGrid

RADIUS = 0.531
HEIGHT = 1.2
SLOT_WIDTH = 0.01
FLAT = 1e-9  # quality under which an element is taken for flat: nothing can be computed on it

# What the paper says of its meshes as generated: elements, worst quality, error of the tangential stress in percent, steps of the
# solver; depth of the crack in parts of the radius. What makes TetGen come near that (found by "pellet.py find"): rings of triangles
# from the centre of a cap to its rim; spacing and jitter of the inner points, and its seed (seeds.py); or the greatest volume.
MESHES = {
    "A": {"elements": 21369, "worst": 0.103, "error": 16, "steps": 307, "crack": 0.0, "rings": 8, "spacing": 0.0854, "jitter": 0.31, "seed": 7},
    "B": {"elements": 52464, "worst": 0.004, "error": 14, "steps": 453, "crack": 0.0, "rings": 10, "spacing": 0.0628, "jitter": 0.275, "seed": 6},
    "C": {"elements": 68868, "worst": 0.004, "error": 13.9, "steps": 518, "crack": 0.0, "rings": 11, "spacing": 0.0577, "jitter": 0.32, "seed": 7},
    "D": {"elements": 165769, "worst": 3e-6, "error": 7.5, "steps": 1593, "crack": 0.0, "rings": 15, "spacing": 0.0432, "jitter": 0.3, "seed": 3},
    "crack20": {"elements": 80887, "worst": 0.002, "crack": 0.2, "rings": 12, "volume": 2.432e-5},
    "crack40": {"elements": 74380, "worst": 0.002, "crack": 0.4, "rings": 11, "volume": 2.617e-5},
    "crack60": {"elements": 93260, "worst": 0.004, "crack": 0.6, "rings": 12, "volume": 2.084e-5},
}


class _Builder:
    """Points and triangles of a pellet. Walls of the slot are told apart by the sign of y: +1, -1."""

    def __init__(self, rings, crack, radius, height, width):
        self.rings, self.radius, self.height = rings, radius, height
        self.around = 6 * rings
        edge = 2 * np.pi * radius / self.around
        # Even, so that both caps are alike and the slot's edges end in points of theirs.
        self.rows = 2 * max(1, round(height / (np.sqrt(3) / 2 * edge) / 2))
        self.half = width / 2
        self.tip = rings + 1 if crack == 0 else min(max(round(rings * (1 - crack)), 1), rings - 1)
        # Ring `tip` lies exactly where the slot ends; rings inside and outside of it are evenly spaced.
        self.radii = np.linspace(0, radius, rings + 1)
        if crack > 0:
            end = radius * (1 - crack)
            self.radii = np.concatenate((np.linspace(0, end, self.tip + 1),
                                         np.linspace(end, radius, rings - self.tip + 1)[1:]))
        self.points, self.triangles, self.ids = [], [], {}

    def cracked(self, ring):
        return ring >= self.tip

    def node(self, key, position):
        """The point of that name; made by position() when it is asked for the first time."""
        if key not in self.ids:
            self.ids[key] = len(self.points)
            self.points.append(position())
        return self.ids[key]

    def z(self, row):
        return self.height * row / self.rows

    def slot(self, ring, row, sign):
        """On the wall of the slot at y = sign * width / 2."""
        def position():
            x = self.radii[ring]
            if ring == self.rings:
                x = np.sqrt(self.radius ** 2 - self.half ** 2)  # on the circle of the rim
            return (x, sign * self.half, self.z(row))
        return self.node(("slot", ring, row, sign), position)

    def ring(self, ring, i, row):
        """Point i of 6 * ring on a cap, counted from the x axis. i = 6 * ring is the first one again, seen from below."""
        count = max(6 * ring, 1)
        if self.cracked(ring) and i in (0, count):
            return self.slot(ring, row, 1 if i == 0 else -1)
        angle = 2 * np.pi * (i % count) / count
        return self.node(("ring", ring, i % count, row) if ring < self.rings else ("side", i % count, row), lambda: (
            self.radii[ring] * math.cos(angle), self.radii[ring] * math.sin(angle), self.z(row)))

    def side(self, i, row):
        """Point i of a row of the side. Odd rows are shifted by half."""
        if row % 2 == 0:
            return self.ring(self.rings, i, row)
        angle = 2 * np.pi * (i % self.around + 0.5) / self.around
        return self.node(("side", i % self.around, row), lambda: (
            self.radius * math.cos(angle), self.radius * math.sin(angle), self.z(row)))

    def cap(self, row):
        """Between each two rings; sector by sector, since a ring has one segment more per sector than the one inside it."""
        turn = -1 if row == 0 else 1  # outward is down, or up
        for inner in range(self.rings):
            outer = inner + 1
            for sector in range(6):
                a = [self.ring(inner, sector * inner + k, row) for k in range(inner + 1)]
                b = [self.ring(outer, sector * outer + k, row) for k in range(outer + 1)]
                for k in range(outer):
                    self.triangles.append((a[k], b[k], b[k + 1])[::turn])
                for k in range(inner):
                    self.triangles.append((a[k], b[k + 1], a[k + 1])[::turn])
            if self.cracked(outer) and not self.cracked(inner):  # in front of the bottom of the slot
                self.triangles.append((self.ring(inner, 0, row), self.slot(outer, row, -1), self.slot(outer, row, 1))[::turn])

    def mantle(self):
        for row in range(self.rows):
            low = [self.side(i, row) for i in range(self.around + 1)]
            high = [self.side(i, row + 1) for i in range(self.around + 1)]
            even = row % 2 == 0
            for i in range(self.around):
                last = i == self.around - 1 and self.cracked(self.rings)
                if even:
                    self.triangles.append((low[i], low[i + 1], high[i]))
                    one, two = low[i + 1], high[i + 1]
                    next_to_slot = (low[0], high[0], self.slot(self.rings, row + 1, 1)) if last else None
                else:
                    self.triangles.append((low[i], high[i + 1], high[i]))
                    one, two = low[i + 1], high[i + 1]
                    next_to_slot = (self.slot(self.rings, row, 1), low[0], high[0]) if last else None
                if not last:
                    self.triangles.append((one, two, high[i]) if even else (low[i], one, two))
                    continue
                # The triangle that the slot would cut is two, one on either side.
                self.triangles.append(next_to_slot)
                self.triangles.append((one, self.slot(self.rings, row + 1, -1), high[i]) if even
                                      else (low[i], self.slot(self.rings, row, -1), two))

    def walls(self):
        for row in range(self.rows):
            for ring in range(self.tip, self.rings):
                for sign in (1, -1):
                    a, b = self.slot(ring, row, sign), self.slot(ring + 1, row, sign)
                    c, d = self.slot(ring + 1, row + 1, sign), self.slot(ring, row + 1, sign)
                    self.triangles += [(a, b, c)[::sign], (a, c, d)[::sign]]
            a, b = self.slot(self.tip, row, -1), self.slot(self.tip, row, 1)
            c, d = self.slot(self.tip, row + 1, 1), self.slot(self.tip, row + 1, -1)
            self.triangles += [(a, b, c), (a, c, d)]

    def build(self):
        self.cap(0)
        self.cap(self.rows)
        self.mantle()
        if self.cracked(self.rings):
            self.walls()
        return np.array(self.points), np.array(self.triangles)


def surface(rings, crack=0.0, radius=RADIUS, height=HEIGHT, width=SLOT_WIDTH):
    """The closed surface as vtkPolyData, normals outward, points of type double.

    rings: triangles from the centre of a cap to its rim, at least 2; the edges are about 2 pi radius / (6 rings) long.
    crack: depth of the slot in parts of the radius, in [0, 1[; 0 makes none.
    """
    if rings < 2 or not 0 <= crack < 1:
        raise ValueError(f"rings {rings} must be 2 or more, crack {crack} in [0, 1[")
    points, triangles = _Builder(rings, crack, radius, height, width).build()
    data = vtkPolyData()
    vtk_points = vtkPoints()
    vtk_points.SetData(numpy_to_vtk(points, deep=1))
    data.SetPoints(vtk_points)
    cells = vtkCellArray()
    for triangle in triangles:
        cells.InsertNextCell(3, [int(i) for i in triangle])
    data.SetPolys(cells)
    return data


def rings_for_edge(edge, radius=RADIUS):
    """The number of rings whose edges come nearest to this length."""
    return max(2, round(2 * np.pi * radius / (6 * edge)))


def lattice(rings, spacing, jitter, seed):
    """Points inside the cylinder without crack: a body-centred cubic lattice, each point moved at random.

    The lattice has 12 tetrahedra per cube of edge `spacing`. jitter: how far a point moves in each direction at most, in parts of
    the spacing. Points keep off the surface by 0.6 edges of it.
    """
    gap = 0.6 * 2 * np.pi * RADIUS / (6 * rings)
    across, up = int(RADIUS / spacing) + 2, int(HEIGHT / spacing) + 2
    cubes = np.stack(np.meshgrid(np.arange(-across, across), np.arange(-across, across), np.arange(-1, up), indexing="ij"), -1)
    cubes = cubes.reshape(-1, 3).astype(float)
    points = np.concatenate([cubes, cubes + 0.5])
    points += jitter * (2 * np.random.default_rng(seed).random(points.shape) - 1)
    points *= spacing
    inside = ((np.hypot(points[:, 0], points[:, 1]) < RADIUS - gap)
              & (points[:, 2] > gap) & (points[:, 2] < HEIGHT - gap))
    return points[inside]


def tetrahedralize(closed_surface, maximum_volume=0, interior=None):
    """TetGen's mesh as generated: its surface kept, its optimization off. A vtkUnstructuredGrid.

    Refined until no element is larger than the volume; or, with interior points, on these alone.
    """
    from meshoptimize import vtkTetGenFilter
    tetgen = vtkTetGenFilter()
    tetgen.SetInputData(closed_surface)
    tetgen.SetKeepSurface(True)
    tetgen.SetOptimizationLevel(0)
    tetgen.SetMaximumVolume(maximum_volume)
    if interior is not None:
        points = vtkPoints()
        points.SetData(numpy_to_vtk(np.ascontiguousarray(interior), deep=1))
        cloud = vtkPolyData()
        cloud.SetPoints(points)
        tetgen.SetInteriorPointsData(cloud)
        tetgen.SetMaximumRadiusEdgeRatio(0)
    tetgen.Update()
    if tetgen.GetErrorCode() != 0:
        raise RuntimeError("TetGen failed")
    grid = vtkUnstructuredGrid()
    grid.ShallowCopy(tetgen.GetOutput())
    return grid


def mesh(name, seed=None):
    """The mesh of that name in MESHES, as generated; without a crack, also with another seed."""
    setup = MESHES[name]
    closed = surface(setup["rings"], setup["crack"])
    if setup["crack"] > 0:
        return tetrahedralize(closed, setup["volume"])
    seed = setup["seed"] if seed is None else seed
    return tetrahedralize(closed, interior=lattice(setup["rings"], setup["spacing"], setup["jitter"], seed))


def _rounded(volume):
    return float(f"{volume:.4g}")


def find_volume(name, tolerance=0.002):
    """For a cracked pellet: (volume, elements, worst quality) that come near to the paper's, the volume to 4 digits.

    First a bisection, until the number of elements is the paper's within tolerance; it is no smooth function of the volume, so the
    nearest one seen is taken. Then steps of 0.1 % to either side: of the meshes within 3 % of that number, the one whose worst
    quality is nearest to the paper's (in its logarithm).
    """
    setup = MESHES[name]
    closed = surface(setup["rings"], setup["crack"])
    mean = np.pi * RADIUS ** 2 * HEIGHT / setup["elements"]
    low, high = 0.5 * mean, 8 * mean
    best, error = None, np.inf
    for _ in range(16):
        volume = _rounded(np.sqrt(low * high))
        elements = tetrahedralize(closed, volume).GetNumberOfCells()
        if abs(elements / setup["elements"] - 1) < error:
            best, error = volume, abs(elements / setup["elements"] - 1)
        if error <= tolerance:
            break
        low, high = (volume, high) if elements > setup["elements"] else (low, volume)
    found = []
    for step in range(-8, 9):
        volume = _rounded(best * (1 + 0.001 * step))
        grid = tetrahedralize(closed, volume)
        worst = quality(grid)[0]
        if abs(grid.GetNumberOfCells() / setup["elements"] - 1) <= 0.03 and worst > FLAT:
            found.append((abs(np.log(worst / setup["worst"])), volume, grid.GetNumberOfCells(), worst))
    if not found:
        raise RuntimeError(f"no volume found for {name}")
    return min(found)[1:]


def quality(grid):
    """(worst, mean, bound): the paper's shape quality, and what the worst element cannot exceed while the surface is kept."""
    from meshoptimize import vtkMeshQualityMinMax
    measure = vtkMeshQualityMinMax()
    measure.SetInputData(grid)
    measure.Update()
    return measure.GetMinimumQuality(), measure.GetMeanQuality(), measure.GetQualityBound()


def edge_lengths(data):
    """Of the triangles of a surface: three per triangle."""
    points = vtk_to_numpy(data.GetPoints().GetData())
    triangles = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    corners = points[triangles]
    return np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)


def write(grid, path):
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.SetDataModeToBinary()  # Debian's VTK cannot read raw appended data
    writer.SetFileName(path)
    if writer.Write() != 1:
        raise OSError(f"cannot write {path}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    commands = parser.add_subparsers(dest="command", required=True)
    for command in ("list", "find", "write"):
        sub = commands.add_parser(command)
        if command == "write":
            sub.add_argument("folder")
        sub.add_argument("names", nargs="*", metavar="NAME")
    options = parser.parse_args()
    unknown = set(options.names) - set(MESHES)
    if unknown:
        parser.error(f"no mesh {', '.join(sorted(unknown))}; there are {', '.join(MESHES)}")
    for name in options.names or MESHES:
        wanted = MESHES[name]["elements"]
        if options.command == "find":
            if MESHES[name]["crack"] == 0:
                print(f"{name}: see seeds.py")
                continue
            volume, elements, worst = find_volume(name)
            print(f"{name}: volume {volume:g}, {elements} elements (the paper has {wanted}), worst {worst:.2g}", flush=True)
            continue
        grid = mesh(name)
        worst, mean, bound = quality(grid)
        elements = grid.GetNumberOfCells()
        print(f"{name}: {grid.GetNumberOfPoints()} nodes, {elements} elements ({elements / wanted - 1:+.2%} of the paper's), "
              f"worst {worst:.2g}, mean {mean:.3f}, bound {bound:.3f}", flush=True)
        if options.command == "write":
            os.makedirs(options.folder, exist_ok=True)
            write(grid, os.path.join(options.folder, name + ".vtu"))


if __name__ == "__main__":
    sys.exit(main())
