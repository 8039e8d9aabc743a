# SPDX-License-Identifier: BSD-3-Clause
"""What the time of Mesh Optimize goes to, by operation; a Markdown table.

    eval "$(./bootstrap.sh env)"
    /usr/bin/python3 Testing/Benchmarks/profile_operations.py MESH ... [--effort NAME] [--tolerance T] [--frequency HZ]

    MESH             a file of VTK, or KIND:POINTS, one of the random meshes of hard.py, as cube:3000
    --effort NAME    quick, default or best (default: default)
    --tolerance T    the surface takes part, with this tolerance (default: it is kept)
    --frequency HZ   samples of the stack per second of processor time (default: 499)

One thread; needs `perf` (Debian: linux-perf) and the right to use it. A sample counts for the outermost operation on its
stack: the nodes that an insertion moves count for the insertion. *Schedule* is what the passes do beside operations, *bound*
the certified caps, *tables* what the filter does beside the core: reading, checks, writing. The exit status is 1 if perf
fails, or if under nine tenths of the stacks are whole, that is begin at the filter.
"""
import argparse
import collections
import subprocess
import sys
import tempfile

# A row, and what the name of a function on the stack begins with. The first row that matches counts, the outermost function
# first. Compilers put the first function of some operations into its caller: then the next one tells.
ROWS = {
    "node motion": ["NodeMotion<", "StarProblem<"],
    "edge and face removal": ["Reconnect<", "EdgeRemoval<", "FaceRemoval<"],
    "node removal": ["NodeRemoval<", "EdgeContraction<"],
    "change of the boundary": ["BoundaryChange<"],
    "cluster motion": ["ClusterMotion<"],
    "retriangulation": ["Retriangulation<"],
    "wide insertion": ["WideInsertion<"],
    "node insertion": ["NodeInsertion<", "Cavity<"],
    "surface motion": ["SurfaceMotion<"],
    "look-ahead": ["LookAhead<"],
    "untangling": ["optimizePaper1996<"],
    "division of long edges": ["divideLongEdges", "LongEdges::"],
    "coarsening": ["coarsen", "Coarsening::"],
    "bound": ["Caps<", "surfaceBound<"],
}
FILTER, ENGINE = "vtkMeshOptimizeFilter::RequestData", "worstfirst::"


def run(path, effort, tolerance):
    """The process that is looked at."""
    from hard import random_mesh
    from invariance import grid_of, read
    from meshoptimize import vtkMeshOptimizeFilter
    from optimize_meshes import EFFORTS
    kind, _, size = path.partition(":")
    points, cells = random_mesh(kind, int(size), 1, "scipy")[:2] if size else read(path)[:2]
    f = vtkMeshOptimizeFilter()
    f.SetInputData(grid_of(points, cells))
    f.SetEffort(EFFORTS[effort])
    f.SetNumberOfThreads(1)
    if tolerance is not None:
        f.SetBoundaryModeToSlide()
        f.SetSurfaceTolerance(tolerance)
    f.Update()


def row_of(stack):
    """The row of a stack of function names, innermost first; None if it is not of the filter."""
    if not any(FILTER in name for name in stack):
        return None
    for name in reversed(stack):
        plain = name.replace("meshopt::", "").replace("(anonymous namespace)::", "")
        for row, starts in ROWS.items():
            if any(plain.startswith(start) for start in starts):
                return row
    return "schedule" if any(ENGINE in name for name in stack) else "tables"


def profile(path, opt):
    """Samples by row; those of the library that have no whole stack; samples per second."""
    slides = [] if opt.tolerance is None else ["--tolerance", str(opt.tolerance)]
    with tempfile.TemporaryDirectory() as folder:
        data = f"{folder}/perf.data"
        subprocess.run(["perf", "record", "--call-graph", "dwarf,16384", "-e", "cpu-clock:u", "-F", str(opt.frequency), "-o", data,
                        sys.executable, __file__, path, "--effort", opt.effort, *slides, "--run"],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        text = subprocess.run(["perf", "script", "--no-inline", "-i", data, "-F", "ip,sym"],
                              check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout
    rows, broken = collections.Counter(), 0
    for sample in text.split("\n\n"):
        stack = [line.split(None, 1)[1] for line in sample.splitlines() if len(line.split(None, 1)) == 2]
        row = row_of(stack)
        if row:
            rows[row] += 1
        elif any("meshopt::" in name for name in stack):
            broken += 1
    return rows, broken


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", nargs="+")
    parser.add_argument("--effort", choices=("quick", "default", "best"), default="default")
    parser.add_argument("--tolerance", type=float)
    parser.add_argument("--frequency", type=int, default=499)
    parser.add_argument("--run", action="store_true", help=argparse.SUPPRESS)
    opt = parser.parse_args()
    if opt.run:
        return run(opt.mesh[0], opt.effort, opt.tolerance)
    found = {path: profile(path, opt) for path in opt.mesh}
    used = [row for row in [*ROWS, "schedule", "tables"] if any(rows[row] for rows, _ in found.values())]
    print("| seconds | " + " | ".join(path.rsplit("/", 1)[-1].removesuffix(".vtu") for path in found) + " |")
    print("|---|" + "---|" * len(found))
    for row in used:
        print(f"| {row} | " + " | ".join(f"{rows[row] / opt.frequency:.3f}" for rows, _ in found.values()) + " |")
    print("| all | " + " | ".join(f"{sum(rows.values()) / opt.frequency:.3f}" for rows, _ in found.values()) + " |")
    return max(broken / max(1, broken + sum(rows.values())) for rows, broken in found.values()) > 0.1


if __name__ == "__main__":
    sys.exit(main())
