# SPDX-License-Identifier: BSD-3-Clause
"""Optimizes a mesh as it is, and rotated, mirrored, scaled and renumbered: the worst quality must hardly depend on that.

    eval "$(./bootstrap.sh env)"
    /usr/bin/python3 Testing/Benchmarks/invariance.py [options] MESH.vtu ...

    --algorithm paper|worst-first   default: worst-first
    --effort quick|default|best     default: default
    --target Q                      target quality, default .6
    --seeds N                       so many rotations and renumberings, default 1
    --allowed D                     greatest difference of the worst quality, default .02
    --threads N                     default 1

Prints a row for each mesh, the worst quality of each variant, and the greatest difference. Scaled by a power of two, the
result must be the same bit for bit but for the scale. The exit status is 1 if a difference is greater than allowed, if
the bits differ, or if some worst quality fell. Tetrahedra only.
"""
import argparse
import pathlib
import sys

import numpy as np
from meshoptimize import vtkMeshOptimizeFilter
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkCellArray, vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

ALGORITHMS = {"paper": vtkMeshOptimizeFilter.Paper1996, "worst-first": vtkMeshOptimizeFilter.WorstFirst}
EFFORTS = {"quick": vtkMeshOptimizeFilter.Quick, "default": vtkMeshOptimizeFilter.Default,
           "best": vtkMeshOptimizeFilter.Best}


def read(path):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)
    return vtk_to_numpy(grid.GetPoints().GetData()).astype(float), cells.astype(np.int64)


def grid_of(points, cells):
    grid, p, array = vtkUnstructuredGrid(), vtkPoints(), vtkCellArray()
    p.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=1))
    array.SetData(4, numpy_to_vtkIdTypeArray(np.ascontiguousarray(cells).ravel(), deep=1))
    grid.SetPoints(p)
    grid.SetCells(VTK_TETRA, array)
    return grid


def optimize(points, cells, opt):
    f = vtkMeshOptimizeFilter()
    f.SetInputData(grid_of(points, cells))
    f.SetAlgorithm(ALGORITHMS[opt.algorithm])
    f.SetEffort(EFFORTS[opt.effort])
    f.SetTargetQuality(opt.target)
    f.SetNumberOfThreads(opt.threads)
    f.Update()
    return f


def rotation(random):
    q, r = np.linalg.qr(random.normal(size=(3, 3)))
    q *= np.sign(np.diag(r))
    return q if np.linalg.det(q) > 0 else -q


def renumbered(points, cells, random):
    """Points and cells in another order, and the nodes of each cell, evenly permuted."""
    order = random.permutation(len(points))  # new point i is old point order[i]
    place = np.empty(len(points), dtype=np.int64)
    place[order] = np.arange(len(points))
    even = np.array([[0, 1, 2, 3], [1, 0, 3, 2], [2, 3, 0, 1], [3, 2, 1, 0], [0, 2, 3, 1], [1, 2, 0, 3]])
    cells = place[cells[random.permutation(len(cells))]]
    turn = even[random.integers(len(even), size=len(cells))]
    return points[order], np.take_along_axis(cells, turn, axis=1)


def variants(points, cells, seeds):
    yield "as it is", points, cells
    for seed in range(seeds):
        yield f"rotated {seed}", points @ rotation(np.random.default_rng(seed)).T, cells
    yield "mirrored", points * [-1.0, 1.0, 1.0], cells[:, [0, 1, 3, 2]]
    yield "scaled by 1/3", points / 3.0, cells
    yield "moved", points + 10.0 * np.ptp(points, axis=0), cells
    for seed in range(seeds):
        yield (f"renumbered {seed}", *renumbered(points, cells, np.random.default_rng(100 + seed)))


def same_when_scaled(points, cells, first, opt):
    second = optimize(1024.0 * points, cells, opt).GetOutput()
    return all((vtk_to_numpy(a) * scale).tobytes() == vtk_to_numpy(b).tobytes() for a, b, scale in (
        (first.GetPoints().GetData(), second.GetPoints().GetData(), 1024.0),
        (first.GetCells().GetConnectivityArray(), second.GetCells().GetConnectivityArray(), 1),
        (first.GetCellData().GetArray("MeshQuality"), second.GetCellData().GetArray("MeshQuality"), 1.0)))


def run(path, opt):
    points, cells = read(path)
    reached, good, seconds = {}, True, 0.0
    for name, x, c in variants(points, cells, opt.seeds):
        f = optimize(x, c, opt)
        reached[name] = f.GetWorstQualityAfter()
        good &= f.GetErrorCode() == 0 and f.GetWorstQualityAfter() >= f.GetWorstQualityBefore()
        seconds += f.GetOptimizeSeconds()
        if name == "as it is":
            same = same_when_scaled(points, cells, f.GetOutput(), opt)
    difference = max(reached.values()) - min(reached.values())
    values = "; ".join(f"{name} {value:.4f}" for name, value in reached.items())
    print(f"| {pathlib.Path(path).stem} | {values} | {difference:.4f} | {'yes' if same else 'NO'} | {seconds:.1f} |", flush=True)
    return good and same and difference <= opt.allowed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", nargs="+")
    parser.add_argument("--algorithm", choices=ALGORITHMS, default="worst-first")
    parser.add_argument("--effort", choices=EFFORTS, default="default")
    parser.add_argument("--target", type=float, default=0.6)
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--allowed", type=float, default=0.02)
    parser.add_argument("--threads", type=int, default=1)
    opt = parser.parse_args()
    print("| mesh | worst quality | greatest difference | scaled by 1024: same bits | s |")
    print("|---|---|---|---|---|")
    good = [run(path, opt) for path in opt.mesh]
    return 0 if all(good) else 1


if __name__ == "__main__":
    sys.exit(main())
