"""Runs Mesh Optimize on mesh files and prints what it reached, as a Markdown table.

    eval "$(./bootstrap.sh env)"
    /usr/bin/python3 Testing/Benchmarks/optimize_meshes.py [options] MESH.vtu ...

    --algorithm paper|worst-first   default: both, one row each
    --target Q                      target quality, default .6
    --judge PROGRAM                 called as  PROGRAM AFTER.vtu --before BEFORE.vtu; exit status 0: no fault
    --output FOLDER                 where the optimized meshes are written (default: a temporary one)

One thread. Seconds are those inside the optimizer (GetOptimizeSeconds). Every mesh is optimized twice, and
the two results are compared byte by byte. The exit status is 1 if a judge found a fault, if the worst quality
fell, or if the two results differ.
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile

from meshoptimize import vtkMeshOptimizeFilter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter

ALGORITHMS = {"paper": ("Paper 1996", 0), "worst-first": ("Worst First", 1)}


def optimize(grid, algorithm, target):
    f = vtkMeshOptimizeFilter()
    f.SetInputData(grid)
    f.SetAlgorithm(algorithm)
    f.SetTargetQuality(target)
    f.SetNumberOfThreads(1)
    f.Update()
    return f


def write(grid, path):
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetFileName(str(path))
    writer.SetDataModeToBinary()
    writer.SetInputData(grid)
    writer.Write()
    return path.read_bytes()


def run(path, name, algorithm, opt, folder):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    f = optimize(grid, algorithm, opt.target)
    stem = f"{pathlib.Path(path).stem}-{algorithm}"
    after = folder / f"{stem}.vtu"
    first = write(f.GetOutput(0), after)
    again = optimize(grid, algorithm, opt.target)
    same = write(again.GetOutput(0), folder / f"{stem}-again.vtu") == first
    fault = "not judged"
    if opt.judge:
        fault = "none"
        if subprocess.run([opt.judge, after, "--before", path], stdout=subprocess.DEVNULL).returncode != 0:
            fault = "FAULT"
    before, now = f.GetWorstQualityBefore(), f.GetWorstQualityAfter()
    seconds = f.GetOptimizeSeconds()
    cells = grid.GetNumberOfCells()
    print(f"| {pathlib.Path(path).stem} | {name} | {cells} | {before:.4f} | {now:.4f} | {f.GetQualityBound():.4f} "
          f"| {f.GetOutput(0).GetNumberOfCells()} | {seconds:.2f} | {1e6 * seconds / cells:.2f} "
          f"| {f.GetStopReasonAsString()} | {fault} | {'yes' if same else 'NO'} |", flush=True)
    return fault != "FAULT" and same and now >= before


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", nargs="+")
    parser.add_argument("--algorithm", choices=ALGORITHMS)
    parser.add_argument("--target", type=float, default=0.6)
    parser.add_argument("--judge")
    parser.add_argument("--output")
    opt = parser.parse_args()
    print("| mesh | algorithm | cells | worst before | worst after | bound | cells after | s | us/cell | stopped because "
          "| fault | same bytes twice |")
    print("|---|---|---|---|---|---|---|---|---|---|---|---|")
    good = True
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(opt.output or temporary)
        folder.mkdir(parents=True, exist_ok=True)
        for path in opt.mesh:
            for key in [opt.algorithm] if opt.algorithm else ALGORITHMS:
                good &= run(path, *ALGORITHMS[key], opt, folder)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
