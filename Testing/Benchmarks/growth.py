# SPDX-License-Identifier: BSD-3-Clause
"""How time and memory of Mesh Optimize grow with the mesh, and what a second thread brings; Markdown tables.

    cmake -DBUILD_TESTING=ON -DMESHOPTIMIZE_BENCHMARKS=ON build && cmake --build build
    /usr/bin/python3 Testing/Benchmarks/growth.py [options]

    --sizes N ...       cells of the generated cylinders, about (default: 20000 200000 1000000 2000000)
    --effort NAME       quick, default or best (default: default)
    --threads MESH.vtu  with the effort best: one thread against two on this mesh, and whether the result is the same
    --repeat N          runs of each, of which the fastest counts (default: 3)
    --folder FOLDER     where meshes and results are kept (default: a temporary one); what it holds is not run again
    --program FILE      BenchmarkOptimizeFilter (default: bin/BenchmarkOptimizeFilter in the folder build of the sources)

The cylinders are pellets (radius .531, height 1.2): a surface of nearly equilateral triangles, filled by the program
tetgen (Debian's) without optimization. Every run is a process of its own, on one thread unless said. "Whole" is
Update() from grid to grid, without reading and writing; memory is the peak above what the process held before it,
the input included there. A bare pass loads each cell's corners, computes S and stores it; it is measured in the same
process, and times are also given in bare passes.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from vtkmodules.vtkIOLegacy import vtkUnstructuredGridReader
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

RADIUS, HEIGHT = 0.531, 1.2
CELLS_PER_RING_CUBED = 63.0  # what tetgen makes of a cylinder of n rings: about 63 n^3 cells
SIZES = [20_000, 200_000, 1_000_000, 2_000_000]


def disc(rings, z):
    """Points of a disc of concentric rings, ring k of 6 k points; its triangles, seen from above counterclockwise."""
    points, triangles, starts = [(0.0, 0.0, z)], [], [0]
    for k in range(1, rings + 1):
        starts.append(len(points))
        angle = 2 * math.pi * np.arange(6 * k) / (6 * k)
        r = RADIUS * k / rings
        points += [(r * math.cos(a), r * math.sin(a), z) for a in angle]
    for k in range(1, rings + 1):
        def outer(i):
            return starts[k] + i % (6 * k)

        def inner(i):
            return starts[k - 1] + i % max(1, 6 * (k - 1))

        for side in range(6):
            for j in range(k):
                o, i = side * k + j, side * (k - 1) + j
                triangles.append((outer(o), outer(o + 1), inner(i)))
                if j < k - 1:
                    triangles.append((outer(o + 1), inner(i + 1), inner(i)))
    return points, triangles, [starts[rings] + i for i in range(6 * rings)]


def cylinder(rings):
    """Surface of the pellet: points [n, 3], triangles [m, 3] seen from outside counterclockwise, edge length."""
    around = 6 * rings
    edge = 2 * math.pi * RADIUS / around
    rows = max(2, 2 * round(HEIGHT / (edge * math.sqrt(3) / 2) / 2))  # even: both caps alike
    points, triangles, last = disc(rings, 0.0)
    triangles = [(a, c, b) for a, b, c in triangles]
    for row in range(1, rows + 1):
        first = len(points)
        if row < rows:
            angle = 2 * math.pi * (np.arange(around) + 0.5 * (row % 2)) / around
            points += [(RADIUS * math.cos(a), RADIUS * math.sin(a), HEIGHT * row / rows) for a in angle]
            this = list(range(first, first + around))
        else:
            cap, cap_triangles, ring = disc(rings, HEIGHT)
            points += cap
            triangles += [tuple(first + i for i in t) for t in cap_triangles]
            this = [first + i for i in ring]
        for i in range(around):
            k = (i + 1) % around
            if row % 2:  # the upper row stands half a step ahead
                triangles += [(last[i], last[k], this[i]), (last[k], this[k], this[i])]
            else:
                triangles += [(last[i], this[k], this[i]), (last[i], last[k], this[k])]
        last = this
    return np.array(points), np.array(triangles), edge


def write_poly(path, points, triangles):
    with open(path, "w", encoding="ascii") as f:
        f.write(f"{len(points)} 3 0 0\n")
        f.writelines(f"{i} {x!r} {y!r} {z!r}\n" for i, (x, y, z) in enumerate(points.tolist()))
        f.write(f"{len(triangles)} 0\n")
        f.writelines(f"1\n3 {a} {b} {c}\n" for a, b, c in triangles.tolist())
        f.write("0\n0\n")


def make_mesh(cells, path):
    """A cylinder of about `cells` tetrahedra, in the file `path`."""
    points, triangles, edge = cylinder(max(2, round((cells / CELLS_PER_RING_CUBED) ** (1 / 3))))
    volume = 1.5 * edge ** 3 / (6 * math.sqrt(2))  # at most: one and a half times the regular tetrahedron's
    with tempfile.TemporaryDirectory() as folder:
        poly = pathlib.Path(folder) / "cylinder.poly"
        write_poly(poly, points, triangles)
        # p: fill the surface; Y: keep it; q: radius to edge; O0/0: no optimization; k: VTK file; NEF: no other
        subprocess.run(["tetgen", f"-pYq1.2a{volume:.15f}O0/0kNEFQ", poly], check=True, stdout=subprocess.DEVNULL)
        reader = vtkUnstructuredGridReader()
        reader.SetFileName(str(poly.with_suffix(".1.vtk")))
        writer = vtkXMLUnstructuredGridWriter()
        writer.SetInputConnection(reader.GetOutputPort())
        writer.SetDataModeToBinary()
        writer.SetFileName(str(path))
        if writer.Write() != 1:
            raise RuntimeError(f"{path} cannot be written")


class Runs:
    """Runs the program, and remembers in FOLDER/growth.json what it said."""

    def __init__(self, program, folder, repeat):
        self.program, self.repeat = program, repeat
        self.file = folder / "growth.json"
        self.known = json.loads(self.file.read_text()) if self.file.exists() else {}

    def run(self, mesh, effort, threads):
        """The fastest of the runs; its key `digests` holds what came out of all of them."""
        key = f"{mesh.resolve()} {effort} {threads}"
        runs = self.known.setdefault(key, [])
        while len(runs) < self.repeat:
            command = [self.program, mesh, effort, str(threads)]
            runs.append(json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout))
            self.file.write_text(json.dumps(self.known, indent=1))
        best = dict(runs[0])
        for field in ("optimize_s", "whole_s", "cpu_s", "bare_s"):
            best[field] = min(r[field] for r in runs)
        best["bytes_per_tet"] = max(r["bytes_per_tet"] for r in runs)
        best["digests"] = {r["digest"] for r in runs}
        return best


def print_growth(runs, sizes, effort, folder):
    print("| tets | worst before | worst after | bare pass, ns/tet | optimizer, s | us/tet | bare passes | whole filter, s "
          "| us/tet | bare passes | memory above the input, bytes/tet |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    rows = []
    for size in sizes:
        mesh = folder / f"cylinder{size}.vtu"
        if not mesh.exists():
            make_mesh(size, mesh)
        r = runs.run(mesh, effort, 1)
        n = r["cells"]
        rows.append(r)
        print(f"| {n} | {r['worst_before']:.4f} | {r['worst_after']:.4f} | {1e9 * r['bare_s'] / n:.1f} "
              f"| {r['optimize_s']:.2f} | {1e6 * r['optimize_s'] / n:.2f} | {r['optimize_s'] / r['bare_s']:.0f} "
              f"| {r['whole_s']:.2f} | {1e6 * r['whole_s'] / n:.2f} | {r['whole_s'] / r['bare_s']:.0f} "
              f"| {r['bytes_per_tet']:.0f} |", flush=True)
    if len(rows) > 1:
        def growth(field):
            return rows[-1][field] / rows[-1]["cells"] / (rows[0][field] / rows[0]["cells"])
        print(f"\nTime per tet, {rows[-1]['cells']} tets against {rows[0]['cells']}: optimizer {growth('optimize_s'):.2f}, "
              f"whole filter {growth('whole_s'):.2f}, bare pass {growth('bare_s'):.2f}.")


def print_threads(runs, mesh):
    one, two = (runs.run(mesh, "best", n) for n in (1, 2))
    same = one["digests"] == two["digests"] and len(one["digests"]) == 1
    print("\n| mesh | tets | worst after | optimizer, 1 thread, s | us/tet | 2 threads, s | times faster | same mesh |")
    print("|---|---|---|---|---|---|---|---|")
    print(f"| {mesh.stem} | {one['cells']} | {one['worst_after']:.4f} | {one['optimize_s']:.2f} "
          f"| {1e6 * one['optimize_s'] / one['cells']:.1f} | {two['optimize_s']:.2f} "
          f"| {one['optimize_s'] / two['optimize_s']:.2f} | {'yes' if same else 'NO'} |", flush=True)
    return same


def main():
    here = pathlib.Path(__file__).resolve()
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sizes", type=int, nargs="*", default=SIZES)
    parser.add_argument("--effort", choices=("quick", "default", "best"), default="default")
    parser.add_argument("--threads", type=pathlib.Path, metavar="MESH.vtu")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--folder", type=pathlib.Path)
    parser.add_argument("--program", default=here.parents[2] / "build" / "bin" / "BenchmarkOptimizeFilter")
    opt = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = opt.folder or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        runs = Runs(opt.program, folder, opt.repeat)
        if opt.sizes:
            print_growth(runs, opt.sizes, opt.effort, folder)
        return 0 if not opt.threads or print_threads(runs, opt.threads) else 1


if __name__ == "__main__":
    sys.exit(main())
