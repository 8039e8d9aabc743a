# SPDX-License-Identifier: BSD-3-Clause
"""A large mesh, tangled at first: time and memory of Mesh Optimize for numbers of threads; a Markdown table.

    eval "$(./bootstrap.sh env)"
    /usr/bin/python3 Testing/Benchmarks/large.py [--cubes N] [--throw X] [--threads N ...] [--effort NAME]

    --cubes N       along each side, six tetrahedra in each (default: 120, which are 10.4 million; N < 5 is too small)
    --throw X       inner nodes are moved at random by up to X of a cube's side in each direction (default: 0.3)
    --threads N ... default: 1 2
    --effort NAME   quick, default or best (default: default)

Each number of threads runs in a process of its own. Time is that of Update(), from grid to grid, by the clock and of all
processors; memory is the peak above what the process held before Update(), the input included there. A bare pass
computes the quality of each tetrahedron once (bare_pass.py). The exit status is 1 if the bytes differ.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import time

import numpy as np

# Of a cube with the corners 4 x + 2 y + z: six tetrahedra around its diagonal, of positive volume.
SIX = [(0, 4, 6, 7), (0, 6, 2, 7), (0, 2, 3, 7), (0, 3, 1, 7), (0, 1, 5, 7), (0, 5, 4, 7)]


def lattice(cubes, throw):
    """Points [n, 3] and cells [m, 4]."""
    row, one = np.arange(cubes + 1), np.arange(cubes)
    x = np.stack(np.meshgrid(row, row, row, indexing="ij"), -1).reshape(-1, 3).astype(float)
    inner = ((x > 0) & (x < cubes)).all(axis=1)
    x[inner] += throw * np.random.default_rng(1).uniform(-1, 1, (np.count_nonzero(inner), 3))
    i, j, k = np.meshgrid(one, one, one, indexing="ij")
    corner = [(((i + (c >> 2)) * (cubes + 1) + j + (c >> 1 & 1)) * (cubes + 1) + k + (c & 1)).ravel() for c in range(8)]
    return x, np.stack([np.stack([corner[c] for c in four], -1) for four in SIX], 1).reshape(-1, 4)


def megabytes(name):
    """A line of the kernel's account of this process."""
    line = next(line for line in open("/proc/self/status", encoding="ascii") if line.startswith(name))
    return int(line.split()[1]) / 1024


def run(opt):
    """One process: prints its numbers."""
    from bare_pass import bare_pass
    from digests import digest
    from invariance import grid_of
    from meshoptimize import vtkMeshOptimizeFilter
    from optimize_meshes import EFFORTS
    points, cells = lattice(opt.cubes, opt.throw)
    bare, grid, tets = bare_pass(points, cells), grid_of(points, cells), len(cells)
    del points, cells
    f = vtkMeshOptimizeFilter()
    f.SetInputData(grid)
    f.SetEffort(EFFORTS[opt.effort])
    f.SetNumberOfThreads(opt.threads[0])
    pathlib.Path("/proc/self/clear_refs").write_text("5", encoding="ascii")  # the peak counts from here
    before, wall, cpu = megabytes("VmRSS"), time.perf_counter(), time.process_time()
    f.Update()
    wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
    print(json.dumps({
        "tets": tets, "wall": wall, "cpu": cpu, "bytes": (megabytes("VmHWM") - before) * 2**20 / tets, "bare": bare,
        "before": f.GetWorstQualityBefore(), "worst": f.GetWorstQualityAfter(), "bound": f.GetQualityBound(),
        "cells": f.GetOutput().GetNumberOfCells(), "stop": f.GetStopReasonAsString(), "digest": digest(f)}))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cubes", type=int, default=120)
    parser.add_argument("--throw", type=float, default=0.3)
    parser.add_argument("--threads", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--effort", choices=("quick", "default", "best"), default="default")
    parser.add_argument("--one", action="store_true", help=argparse.SUPPRESS)
    opt = parser.parse_args()
    if opt.one:
        run(opt)
        return 0
    print("| tets | threads | seconds | of processors | us/tet | bare passes | bytes/tet above the input | worst before | after "
          "| bound | cells | stopped because |\n" + "|---" * 12 + "|")
    digests = set()
    for threads in opt.threads:
        arguments = [f"--cubes={opt.cubes}", f"--throw={opt.throw}", f"--effort={opt.effort}", "--one", "--threads", str(threads)]
        done = subprocess.run([sys.executable, __file__, *arguments], stdout=subprocess.PIPE, text=True, check=True)
        r = json.loads(done.stdout.splitlines()[-1])
        digests.add(r["digest"])
        print(f"| {r['tets']} | {threads} | {r['wall']:.1f} | {r['cpu']:.1f} | {1e6 * r['wall'] / r['tets']:.2f} "
              f"| {r['wall'] / r['bare']:.0f} | {r['bytes']:.0f} | {r['before']:.3g} | {r['worst']:.4g} | {r['bound']:.4g} "
              f"| {r['cells']} | {r['stop']} |", flush=True)
    print("the same bytes" if len(digests) == 1 else "the bytes DIFFER")
    return len(digests) != 1


if __name__ == "__main__":
    sys.exit(main())
