# SPDX-License-Identifier: BSD-3-Clause
"""What sliding is worth at tolerance 0: bodies with flat faces whose surfaces are badly divided, as a Markdown table.

    eval "$(./bootstrap.sh env)"
    /usr/bin/python3 Testing/Benchmarks/flat_surfaces.py [options] [SHAPE ...]

    --seeds N              how many of each shape, default 3
    --first N              the first seed, default 0
    --fine K               K times as many nodes along each edge, default 1
    --turned               turned at random, so that faces are flat and edges straight up to rounding only
    --effort quick|default|best
    --growth G             growth budget, default .15
    --limit SECONDS        time limit of one run, default 60
    --tolerance T          default 0
    --judge PROGRAM        called as  PROGRAM AFTER.vtu --before BEFORE.vtu --tolerance 1e-12 (or T); exit status 0: no fault
    --output FOLDER        where the meshes are written (default: a temporary one)

Shapes: box, plate (with square holes), round (a plate with a hole of 16 sides), hexagon (of 6), angle (an L-shaped prism), notch
(a bar with two V-shaped notches), step (a bar with rectangular ones). Their faces are divided at random: nodes are moved within
faces and along edges, others inserted anywhere, edges flipped at random, so that needles and caps come about; then TetGen fills
them without optimization. One thread, target .6. "kept" is Boundary Mode Fixed, with the bound that is certified for it; the distance is a
fraction of the diagonal. The exit status is 1 if a judge found a fault, a worst quality fell, or the surface moved by more than
rounding.
"""
import argparse
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from meshoptimize import vtkMeshOptimizeFilter
from optimize_meshes import EFFORTS, write

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../Fuzz"))
from solids import fill, grid_of

TARGET = 0.6


# ---- outlines: (points in the plane, quadrangles, height, layers) ------------------------------------------------------------------

def lattice(nx, ny, fine, left_out=(), size=(1.0, 1.0)):
    nx, ny = fine * nx, fine * ny
    x, y = np.meshgrid(np.linspace(0, size[0], nx + 1), np.linspace(0, size[1], ny + 1), indexing="ij")
    quads = [[i * (ny + 1) + j, (i + 1) * (ny + 1) + j, (i + 1) * (ny + 1) + j + 1, i * (ny + 1) + j + 1]
             for i in range(nx) for j in range(ny) if (i // fine, j // fine) not in left_out]
    return np.stack([x.ravel(), y.ravel()], axis=1), np.array(quads)


def ring(sides, per_side, layers):
    """A square with a hole of so many sides: rays from the hole to the square; 8 must divide their number."""
    n = sides * per_side
    corner = np.exp(2j * np.pi * np.arange(sides + 1) / sides) * 0.25
    hole = np.array([corner[k // per_side] + (corner[k // per_side + 1] - corner[k // per_side]) * (k % per_side) / per_side for k in range(n)])
    square = []
    for k in range(n):
        t = 8 * k / n  # eighths of the outline, from (.5, 0)
        side, along = int((t + 1) // 2) % 4, (t + 1) % 2 / 2 - 0.5
        square.append([0.5 + 1j * along, -along + 0.5j, -0.5 - 1j * along, along - 0.5j][side])
    points = [hole + (np.array(square) - hole) * r / layers for r in range(layers + 1)]
    points[-1] = np.array(square)
    points = np.concatenate(points)
    quads = [[r * n + k, (r + 1) * n + k, (r + 1) * n + (k + 1) % n, r * n + (k + 1) % n] for r in range(layers) for k in range(n)]
    return np.stack([points.real, points.imag], axis=1), np.array(quads)


def outline(shape, fine):
    if shape == "box":
        return *lattice(6, 5, fine, size=(1.0, 0.8)), 0.6, 4 * fine
    if shape == "plate":
        return *lattice(9, 7, fine, {(i, j) for i in (1, 2, 5, 6) for j in (2, 3)}, (1.0, 0.75)), 0.15, fine
    if shape == "round":
        return *ring(16, fine, 3 * fine), 0.2, 2 * fine
    if shape == "hexagon":
        return *ring(6, 4 * fine, 3 * fine), 0.2, 2 * fine
    if shape == "angle":
        return *lattice(7, 7, fine, {(i, j) for i in range(3, 7) for j in range(3, 7)}), 0.5, 4 * fine
    if shape == "step":
        return *lattice(12, 3, fine, {(i, 2) for i in (3, 4, 8)}, (1.5, 0.3)), 0.3, 2 * fine
    if shape == "notch":
        points, quads = lattice(12, 3, fine, size=(1.5, 0.3))
        points[:, 1] *= np.interp(points[:, 0], 1.5 * np.arange(13) / 12, np.where(np.isin(np.arange(13), [4, 8]), 0.5, 1.0))
        return points, quads, 0.3, 2 * fine
    raise ValueError(shape)


# ---- the surface --------------------------------------------------------------------------------------------------------------------

class FlatSurface:
    """Triangles of a prism, each with the plane that it lies in; changed at random within the planes."""

    def __init__(self, shape, fine, random):
        self.random = random
        flat, quads, height, layers = outline(shape, fine)
        n, z = len(flat), height * np.arange(layers + 1) / layers
        self.points = [np.array([*x, h]) for h in z for x in flat]
        edges = {}
        for quad in quads.tolist():
            for a, b in zip(quad, quad[1:] + quad[:1]):
                edges[a, b] = 1
        walls = [e for e in edges if e[::-1] not in edges]
        faces, planes = [], {}

        def plane(key, normal):
            return planes.setdefault(key, (len(planes), np.array(normal)))[0]
        for quad in quads.tolist():
            faces.append((quad[::-1], plane("bottom", (0.0, 0.0, -1.0))))
            faces.append(([layers * n + k for k in quad], plane("top", (0.0, 0.0, 1.0))))
        for a, b in walls:
            d = (flat[b] - flat[a]) / np.linalg.norm(flat[b] - flat[a])
            key = (round(d[0], 4), round(d[1], 4), round(float(d[1] * flat[a][0] - d[0] * flat[a][1]), 4))
            key = tuple(x + 0.0 for x in key)
            k = plane(key, (d[1], -d[0], 0.0))
            for layer in range(layers):
                low, high = layer * n, (layer + 1) * n
                faces.append(([low + a, low + b, high + b, high + a], k))
        self.normals = [normal for _, normal in planes.values()]
        self.triangles, self.planes = [], []
        for (a, b, c, d), k in faces:
            self.triangles += [[a, b, c], [a, c, d]] if random.random() < 0.5 else [[a, b, d], [b, c, d]]
            self.planes += [k, k]
        self.least = 1e-3 * np.mean([self.altitude(t, k) for t, k in zip(self.triangles, self.planes)])

    def altitude(self, t, plane):
        """Smallest altitude, negative if the triangle has turned over."""
        a, b, c = (self.points[k] for k in t)
        twice = np.cross(b - a, c - a) @ self.normals[plane]
        return twice / max(np.linalg.norm(b - a), np.linalg.norm(c - b), np.linalg.norm(a - c))

    def stars(self):
        star = {}
        for k, t in enumerate(self.triangles):
            for v in t:
                star.setdefault(v, []).append(k)
        return star

    def move(self, reach):
        for v, star in self.stars().items():
            planes = sorted({self.planes[k] for k in star})
            if len(planes) > 2:
                continue
            size = min(self.altitude(self.triangles[k], self.planes[k]) for k in star)
            if len(planes) == 2:
                way = np.cross(self.normals[planes[0]], self.normals[planes[1]]) * self.random.uniform(-1, 1)
            else:
                normal = self.normals[planes[0]]
                way = self.random.uniform(-1, 1, 3)
                way = way - (way @ normal) * normal
            old = self.points[v]
            for _ in range(4):
                self.points[v] = old + reach * size * way
                if min(self.altitude(self.triangles[k], self.planes[k]) for k in star) > 4 * self.least:
                    break
                reach, self.points[v] = reach / 2, old

    def insert(self, count):
        """Nodes within random triangles, some close to an edge."""
        for _ in range(count):
            k = int(self.random.integers(len(self.triangles)))
            (a, b, c), plane = self.triangles[k], self.planes[k]
            w = self.random.uniform(0.01, 1, 3) ** self.random.choice([1, 3])
            w /= w.sum()
            old = self.points[a]
            self.points.append(old + w[1] * (self.points[b] - old) + w[2] * (self.points[c] - old))
            v = len(self.points) - 1
            new = [[a, b, v], [b, c, v], [c, a, v]]
            if min(self.altitude(t, plane) for t in new) < 4 * self.least:
                self.points.pop()
                continue
            self.triangles[k] = new[0]
            self.triangles += new[1:]
            self.planes += [plane, plane]

    def flip(self, rounds):
        """Edges within planes, as they come, wherever the two triangles stay valid."""
        for _ in range(rounds):
            sides = {}
            for k, t in enumerate(self.triangles):
                for i in range(3):
                    sides[t[i], t[(i + 1) % 3]] = k
            done = set()
            keys = sorted(e for e in sides if e[0] < e[1])
            for i in self.random.permutation(len(keys))[: len(keys) // 3]:
                a, b = keys[i]
                k, m = sides[a, b], sides[b, a]
                if self.planes[k] != self.planes[m] or k in done or m in done:
                    continue
                c = next(x for x in self.triangles[k] if x not in (a, b))
                d = next(x for x in self.triangles[m] if x not in (a, b))
                new = [[a, d, c], [d, b, c]]
                if (c, d) in sides or (d, c) in sides or min(self.altitude(t, self.planes[k]) for t in new) < self.least:
                    continue
                self.triangles[k], self.triangles[m] = new
                done |= {k, m}


def body(shape, seed, fine, is_turned):
    """A grid, its surface badly divided, filled by TetGen; by another seed if TetGen cannot."""
    while True:
        random = np.random.default_rng([seed, sum(map(ord, shape))])
        surface = FlatSurface(shape, fine, random)
        surface.move(0.8)
        surface.insert(len(surface.triangles) // 4)
        surface.flip(int(random.integers(1, 4)))
        surface.move(0.8)
        points = np.array(surface.points)
        if is_turned:
            points = points @ np.linalg.qr(random.normal(size=(3, 3)))[0].T
        filled, fault = fill(points, np.array(surface.triangles))
        if filled:
            return grid_of(*filled)
        print(f"{shape}, seed {seed}: {fault}", file=sys.stderr)
        seed += 1000


def optimize(grid, slides, opt):
    f = vtkMeshOptimizeFilter()
    f.SetInputData(grid)
    f.SetEffort(EFFORTS[opt.effort])
    f.SetGrowthBudget(opt.growth)
    f.SetTargetQuality(TARGET)
    f.SetTimeLimit(opt.limit)
    f.SetNumberOfThreads(1)
    if slides:
        f.SetBoundaryModeToSlide()
        f.SetSurfaceTolerance(opt.tolerance)
    f.Update()
    return f


def run(shape, seed, opt, folder):
    grid = body(shape, seed, opt.fine, opt.turned)
    kept, slid = optimize(grid, False, opt), optimize(grid, True, opt)
    before, after = folder / f"{shape}-{seed}-before.vtu", folder / f"{shape}-{seed}-after.vtu"
    write(grid, before)
    write(slid.GetOutput(), after)
    fault = ""
    if opt.judge:
        command = [opt.judge, after, "--before", before, "--tolerance", str(max(opt.tolerance, 1e-12))]
        said = subprocess.run(command, capture_output=True, text=True, check=False)
        fault = "none" if said.returncode == 0 else " ".join(line for line in said.stdout.splitlines() if "FAULT" in line) or "not read"
    distance = slid.GetSurfaceDistance() / grid.GetLength()
    cells = grid.GetNumberOfCells()
    print(f"| {shape} | {seed} | {cells} | {slid.GetWorstQualityBefore():.4f} | {kept.GetQualityBound():.4f} | "
          f"{kept.GetWorstQualityAfter():.4f} | {slid.GetWorstQualityAfter():.4f} | {slid.GetOutput().GetNumberOfCells()} | {distance:.1e} | "
          f"{1e6 * slid.GetOptimizeSeconds() / cells:.0f} | {slid.GetStopReasonAsString()} | {fault} |", flush=True)
    good = fault in ("", "none") and slid.GetWorstQualityAfter() >= slid.GetWorstQualityBefore()
    return good and distance <= max(opt.tolerance, 1e-14), slid.GetWorstQualityAfter()


def main():
    shapes = ["box", "plate", "round", "hexagon", "angle", "notch", "step"]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("shapes", nargs="*", default=shapes, metavar="SHAPE")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--fine", type=int, default=1)
    parser.add_argument("--turned", action="store_true")
    parser.add_argument("--effort", choices=EFFORTS, default="default")
    parser.add_argument("--growth", type=float, default=0.15)
    parser.add_argument("--limit", type=float, default=60.0)
    parser.add_argument("--tolerance", type=float, default=0.0)
    parser.add_argument("--judge")
    parser.add_argument("--output")
    opt = parser.parse_args()
    folder = pathlib.Path(opt.output or tempfile.mkdtemp())
    folder.mkdir(parents=True, exist_ok=True)
    print("| shape | seed | tets | before | kept bound | kept after | slid after | tets after | distance | us/tet | stop | fault |")
    print("|---" * 12 + "|")
    good, reached = True, []
    for shape in opt.shapes:
        for seed in range(opt.first, opt.first + opt.seeds):
            one, worst = run(shape, seed, opt, folder)
            good &= one
            reached.append(worst >= TARGET)
    print(f"\n{sum(reached)} of {len(reached)} reach {TARGET:g}")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
