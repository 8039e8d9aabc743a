# SPDX-License-Identifier: BSD-3-Clause
"""Runs Thermoelastic on mesh files and prints time, memory and steps, as a Markdown table.

    eval "$(./bootstrap.sh env)"
    /usr/bin/python3 Testing/Benchmarks/thermoelastic.py [options] MESH.vtu ...

    --solver cg|ic|direct    conjugate gradients with diagonal (default) or incomplete Cholesky preconditioner, or factorization
    --tolerance T            relative residual, default 1e-8
    --threads N              default 0: all; --threads 1,2,0 gives a row each

The paper's cylinder: T = 2468 - 5286 r^2 about the z axis, ends in generalized plane strain, pinned against rigid motion, stress
by patch recovery. Seconds are wall time of the whole filter and of its parts; cpu is the processor time of all threads; memory is
the greatest of the process so far, with Python, VTK and the mesh in it. The exit status is 1 if a run has not converged.
"""
import argparse
import pathlib
import resource
import sys
import time

from meshoptimize import vtkThermoelasticFilter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

SOLVERS = {"cg": 0, "ic": 1, "direct": 2}


def run(path, threads, opt):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    f = vtkThermoelasticFilter()
    f.SetInputData(grid)
    f.SetTemperatureModeToRadial()
    f.SetAxisTemperature(2468)
    f.SetRadialCoefficient(5286)
    f.GeneralizedPlaneStrainOn()
    f.SetRigidMotionToPin()
    f.SetSolver(SOLVERS[opt.solver])
    f.SetTolerance(opt.tolerance)
    f.SetNumberOfThreads(threads)
    wall, cpu = time.perf_counter(), time.process_time()
    f.Update()
    wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"| {pathlib.Path(path).stem} | {grid.GetNumberOfCells()} | {f.GetNumberOfUnknowns()} | {opt.solver} | {threads or 'all'} "
          f"| {f.GetNumberOfSolverIterations()} | {f.GetRelativeResidual():.1e} | {f.GetAssemblySeconds():.2f} "
          f"| {f.GetSolveSeconds():.2f} | {f.GetRecoverySeconds():.2f} | {wall:.2f} | {cpu:.2f} | {memory:.0f} |", flush=True)
    return f.GetStopReasonAsString() == "Converged"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", nargs="+")
    parser.add_argument("--solver", choices=SOLVERS, default="cg")
    parser.add_argument("--tolerance", type=float, default=1e-8)
    parser.add_argument("--threads", default="0")
    opt = parser.parse_args()
    print("| mesh | cells | unknowns | solver | threads | steps | residual | assembly s | solve s | stress s | all s | cpu s | memory MB |")
    print("|---|---|---|---|---|---|---|---|---|---|---|---|---|")
    good = True
    for path in opt.mesh:
        for threads in opt.threads.split(","):
            good &= run(path, int(threads), opt)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
