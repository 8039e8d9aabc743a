# SPDX-License-Identifier: BSD-3-Clause
"""What it is worth to let the surface of tetrahedra take part, for several tolerances, as a Markdown table.

    eval "$(./bootstrap.sh env)"
    /usr/bin/python3 Testing/Benchmarks/slide_surface.py [options] MESH.vtu ...

    --tolerance T ...            fractions of the diagonal (default: 0 1e-4 1e-3 1e-2); "kept" is always the first row
    --effort quick|default|best  default: quick
    --growth G                   growth budget, default .15
    --limit SECONDS              time limit of one run, default 60
    --scan                       KeepFeatures off: ridges and corners count as surface only
    --angle A                    feature angle, default 45
    --judge PROGRAM              called as  PROGRAM AFTER.vtu --before BEFORE.vtu --tolerance T --angle A; exit status 0: no fault
                                 (A: the feature angle; with --scan 180: no edge must stay)
    --output FOLDER              where the optimized meshes are written (default: a temporary one)

One thread. The distance is the one that the filter proves (SurfaceDistance), as a fraction of the diagonal. The exit status
is 1 if a judge found a fault, if the worst quality fell, or if the distance is greater than the tolerance.
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from meshoptimize import vtkMeshOptimizeFilter
from optimize_meshes import EFFORTS, write
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader


def optimize(grid, tolerance, arguments):
    f = vtkMeshOptimizeFilter()
    f.SetInputData(grid)
    f.SetEffort(EFFORTS[arguments.effort])
    f.SetGrowthBudget(arguments.growth)
    f.SetTimeLimit(arguments.limit)
    f.SetNumberOfThreads(1)
    if tolerance is not None:
        f.SetBoundaryModeToSlide()
        f.SetSurfaceTolerance(tolerance)
        f.SetKeepFeatures(not arguments.scan)
        f.SetFeatureAngle(arguments.angle)
    f.Update()
    return f


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("meshes", nargs="+")
    parser.add_argument("--tolerance", nargs="+", type=float, default=[0.0, 1e-4, 1e-3, 1e-2])
    parser.add_argument("--effort", choices=EFFORTS, default="quick")
    parser.add_argument("--growth", type=float, default=0.15)
    parser.add_argument("--limit", type=float, default=60.0)
    parser.add_argument("--scan", action="store_true")
    parser.add_argument("--angle", type=float, default=45.0)
    parser.add_argument("--judge")
    parser.add_argument("--output")
    arguments = parser.parse_args()
    folder = pathlib.Path(arguments.output or tempfile.mkdtemp())
    folder.mkdir(parents=True, exist_ok=True)
    faults = 0
    print("| mesh | tolerance | worst before | worst after | under .2 | cells | distance | seconds | stop |")
    print("|---|---|---|---|---|---|---|---|---|")
    for path in arguments.meshes:
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(path)
        reader.Update()
        grid = reader.GetOutput()
        diagonal = grid.GetLength()
        for tolerance in [None, *arguments.tolerance]:
            f = optimize(grid, tolerance, arguments)
            quality = vtk_to_numpy(f.GetOutput().GetCellData().GetArray("MeshQuality"))
            print(f"| {pathlib.Path(path).stem} | {'kept' if tolerance is None else f'{tolerance:g}'} | "
                  f"{f.GetWorstQualityBefore():.4f} | {f.GetWorstQualityAfter():.4f} | {np.count_nonzero(quality < 0.2)} | "
                  f"{f.GetOutput().GetNumberOfCells()} | {f.GetSurfaceDistance() / diagonal:.2g} | {f.GetOptimizeSeconds():.3g} | "
                  f"{f.GetStopReasonAsString()} |", flush=True)
            limit = max(tolerance or 0.0, 1e-14)
            faults += f.GetWorstQualityAfter() < f.GetWorstQualityBefore() or f.GetSurfaceDistance() > limit * diagonal
            after = folder / f"{pathlib.Path(path).stem}-{'kept' if tolerance is None else f'{tolerance:g}'}.vtu"
            if arguments.output or arguments.judge:
                write(f.GetOutput(), after)
            if arguments.judge and tolerance is not None:
                judged = subprocess.run([arguments.judge, after, "--before", path, "--tolerance", str(max(tolerance, 1e-12)),
                                         "--angle", "180" if arguments.scan else f"{arguments.angle:g}"],
                                        capture_output=True, text=True, check=False)
                if judged.returncode:
                    print("\n".join(line for line in judged.stdout.splitlines() if "FAULT" in line), file=sys.stderr)
                faults += judged.returncode != 0
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
