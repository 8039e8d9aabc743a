# SPDX-License-Identifier: BSD-3-Clause
"""Runs Mesh Optimize on mesh files and prints what it reached, as a Markdown table.

    eval "$(./bootstrap.sh env)"
    /usr/bin/python3 Testing/Benchmarks/optimize_meshes.py [options] MESH.vtu ...

    --algorithm paper|worst-first   default: both, one row each
    --effort quick|default|best     of Worst First, default: default; also several: --effort default best
    --measure NAME                  Shape (default), RadiusRatio, MeanRatio, MinimumSine, WarpedSine, VolumeLength; also several
    --target Q                      target quality, default .6
    --dihedral                      also the smallest and largest dihedral angle after, in degrees, and before
    --once                          no second run
    --judge PROGRAM                 called as  PROGRAM AFTER.vtu --before BEFORE.vtu; exit status 0: no fault
    --output FOLDER                 where the optimized meshes are written (default: a temporary one)

One thread. Qualities are those of the measure. Seconds are those inside the optimizer (GetOptimizeSeconds). Every mesh is
optimized twice, and the two results are compared byte by byte. The exit status is 1 if a judge found a fault, if the worst
quality fell, or if the two results differ.
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from meshoptimize import vtkMeshOptimizeFilter
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter

ALGORITHMS = {"paper": ("Paper 1996", 0), "worst-first": ("Worst First", 1)}
EFFORTS = {"quick": 0, "default": 1, "best": 2}
MEASURES = ("Shape", "RadiusRatio", "MeanRatio", "MinimumSine", "WarpedSine", "VolumeLength")


def optimize(grid, algorithm, effort, measure, target):
    f = vtkMeshOptimizeFilter()
    f.SetInputData(grid)
    f.SetAlgorithm(algorithm)
    f.SetEffort(EFFORTS[effort])
    f.SetQualityMeasure(getattr(vtkMeshOptimizeFilter, measure))
    f.SetTargetQuality(target)
    f.SetNumberOfThreads(1)
    f.Update()
    return f


def dihedral_angles(grid):
    """Smallest and largest dihedral angle of all tetrahedra, in degrees."""
    x = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    t = x[vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)]
    normals = [np.cross(t[:, j] - t[:, i], t[:, k] - t[:, i]) for i, j, k in ((1, 3, 2), (0, 2, 3), (0, 3, 1), (0, 1, 2))]
    normals = [n / np.linalg.norm(n, axis=1)[:, None] for n in normals]
    cosines = np.array([-np.einsum("ij,ij->i", normals[i], normals[j]) for i in range(4) for j in range(i)])
    angles = np.degrees(np.arccos(np.clip(cosines, -1, 1)))
    return angles.min(), angles.max()


def write(grid, path):
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetFileName(str(path))
    writer.SetDataModeToBinary()
    writer.SetInputData(grid)
    writer.Write()
    return path.read_bytes()


def run(path, algorithm, effort, measure, opt, folder):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    name, number = ALGORITHMS[algorithm]
    f = optimize(grid, number, effort, measure, opt.target)
    stem = f"{pathlib.Path(path).stem}-{algorithm}-{effort}-{measure}"
    after = folder / f"{stem}.vtu"
    first = write(f.GetOutput(0), after)
    same = "not tried"
    if not opt.once:
        again = optimize(grid, number, effort, measure, opt.target)
        same = "yes" if write(again.GetOutput(0), folder / f"{stem}-again.vtu") == first else "NO"
    fault = "not judged"
    if opt.judge:
        fault = "none"
        if subprocess.run([opt.judge, after, "--before", path], stdout=subprocess.DEVNULL).returncode != 0:
            fault = "FAULT"
    before, now = f.GetWorstQualityBefore(), f.GetWorstQualityAfter()
    seconds = f.GetOptimizeSeconds()
    cells = grid.GetNumberOfCells()
    row = [pathlib.Path(path).stem, name + (f", {effort}" if algorithm == "worst-first" else ""), measure, cells, f"{before:.4f}",
           f"{now:.4f}", f"{f.GetQualityBound():.4f}"]
    if opt.dihedral:
        row += ["{:.2f} - {:.2f}".format(*dihedral_angles(mesh)) for mesh in (grid, f.GetOutput(0))]
    row += [f.GetOutput(0).GetNumberOfCells(), f"{seconds:.2f}", f"{1e6 * seconds / cells:.2f}", f.GetStopReasonAsString(), fault, same]
    print("| " + " | ".join(str(value) for value in row) + " |", flush=True)
    return fault != "FAULT" and same != "NO" and now >= before


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", nargs="+")
    parser.add_argument("--algorithm", choices=ALGORITHMS)
    parser.add_argument("--effort", choices=EFFORTS, nargs="+", default=["default"])
    parser.add_argument("--measure", choices=MEASURES, nargs="+", default=["Shape"])
    parser.add_argument("--target", type=float, default=0.6)
    parser.add_argument("--dihedral", action="store_true")
    parser.add_argument("--once", action="store_true")
    parser.add_argument("--judge")
    parser.add_argument("--output")
    opt = parser.parse_args()
    columns = ["mesh", "algorithm", "measure", "cells", "worst before", "worst after", "bound"]
    columns += ["dihedral angles before", "after"] if opt.dihedral else []
    columns += ["cells after", "s", "us/cell", "stopped because", "fault", "same bytes twice"]
    print("| " + " | ".join(columns) + " |\n" + "|---" * len(columns) + "|")
    good = True
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(opt.output or temporary)
        folder.mkdir(parents=True, exist_ok=True)
        for path in opt.mesh:
            for algorithm in [opt.algorithm] if opt.algorithm else ALGORITHMS:
                for effort in opt.effort if algorithm == "worst-first" else ["default"]:
                    for measure in opt.measure:
                        good &= run(path, algorithm, effort, measure, opt, folder)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
