# SPDX-License-Identifier: BSD-3-Clause
"""Does the optimizer still give the same bytes? Digests of outputs and histories, recorded once and compared later.

    eval "$(./bootstrap.sh env)"
    /usr/bin/python3 Testing/Benchmarks/digests.py record FILE.json MESH.vtu ... [options]
    /usr/bin/python3 Testing/Benchmarks/digests.py compare FILE.json MESH.vtu ... [options]

    --only PART ...   of: meshes plane two_cracks adapt adapt_3d fuzz_boundary fuzz_filter (default: all)
    --threads N ...   for the meshes and the plane meshes (default: 1 2 4)
    --seeds N         of each fuzz (default: 200)
    --jobs N          processes at a time (default: 2)
    --without-counts  without what counts tries: in the history, and NumberOfOperations

meshes: each file with Quick, Default, Best and Paper 1996. plane: generated discs whose boundary slides along straight lines and
B-splines, with and without sizes. The others run the script of that name and digest every mesh that it has optimized; adapt_3d
with 2000 elements, twice as many and four times as many.

A digest is of all points, cells, arrays and their names, of the history, the stop reason and the certified bound. Digests
of one machine mean little on another: another C library rounds logarithms and powers differently. So record with the
engine of before and compare with the engine of after on one machine. compare names what differs, and what is new or not there,
and then exits with 1.
"""
import argparse
import concurrent.futures
import hashlib
import json
import os
import runpy
import subprocess
import sys
import tempfile

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
EXAMPLES = os.path.join(HERE, "../../ParaViewPlugin/Examples")
FUZZ = os.path.join(HERE, "../Fuzz")
WITHOUT_COUNTS = "MESHOPTIMIZE_DIGESTS_WITHOUT_COUNTS"  # processes inherit it
EFFORTS = ("Quick", "Default", "Best")


def array_bytes(array):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    name = (array.GetName() or "").encode()
    if array.IsA("vtkStringArray"):
        return name + "\n".join(array.GetValue(i) for i in range(array.GetNumberOfValues())).encode()
    return name + vtk_to_numpy(array).tobytes()


def digest(optimizer):
    """Of what a filter has made, as 16 hexadecimal digits."""
    total = hashlib.sha256()
    grid = optimizer.GetOutputDataObject(0)
    if grid is not None and grid.IsA("vtkUnstructuredGrid") and grid.GetNumberOfPoints() > 0:
        total.update(array_bytes(grid.GetPoints().GetData()))
        total.update(array_bytes(grid.GetCells().GetConnectivityArray()))
        total.update(bytes(grid.GetCellType(c) for c in range(grid.GetNumberOfCells())))
        for data in (grid.GetPointData(), grid.GetCellData(), grid.GetFieldData()):
            for i in range(data.GetNumberOfArrays()):
                array = data.GetAbstractArray(i)
                if not (os.environ.get(WITHOUT_COUNTS) and array.GetName() == "NumberOfOperations"):
                    total.update(array_bytes(array))
    history = optimizer.GetOutputDataObject(1)
    if history is not None and history.IsA("vtkTable"):
        for i in range(history.GetNumberOfColumns()):
            if not (os.environ.get(WITHOUT_COUNTS) and history.GetColumnName(i).endswith(("Tried", "Done"))):
                total.update(array_bytes(history.GetColumn(i)))
    total.update(optimizer.GetStopReasonAsString().encode())
    total.update(np.float64(optimizer.GetQualityBound()).tobytes())
    return total.hexdigest()[:16]


def run_mesh(path, effort, threads):
    from meshoptimize import vtkMeshOptimizeFilter
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    f = vtkMeshOptimizeFilter()
    f.SetInputConnection(reader.GetOutputPort())
    if effort == "Paper1996":
        f.SetAlgorithm(0)
    else:
        f.SetEffort(EFFORTS.index(effort))
    f.SetNumberOfThreads(threads)
    f.Update()
    return [digest(f)]


def disc(rings):
    """Triangles of a disc whose inner points are moved at random; the same every time."""
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import VTK_TRIANGLE, vtkCellArray, vtkPolyData, vtkUnstructuredGrid
    from vtkmodules.vtkFiltersCore import vtkDelaunay2D
    random = np.random.default_rng(rings)
    points = vtkPoints()
    points.SetDataTypeToDouble()
    for k in range(rings + 1):
        for angle in 2 * np.pi * np.arange(max(1, 6 * k)) / max(1, 6 * k):
            thrown = random.uniform(-0.45, 0.45, 2) if k < rings else np.zeros(2)
            points.InsertNextPoint(k * np.cos(angle) + thrown[0], k * np.sin(angle) + thrown[1], 0.0)
    cloud = vtkPolyData()
    cloud.SetPoints(points)
    delaunay = vtkDelaunay2D()
    delaunay.SetInputData(cloud)
    delaunay.Update()
    grid = vtkUnstructuredGrid()
    grid.SetPoints(points)
    cells = vtkCellArray()
    cells.DeepCopy(delaunay.GetOutput().GetPolys())
    grid.SetCells(VTK_TRIANGLE, cells)
    return grid


def run_plane(rings, curve, size, threads):
    from meshoptimize import vtkMeshOptimizeFilter
    f = vtkMeshOptimizeFilter()
    f.SetInputData(disc(rings))
    f.SetBoundaryMode(1)
    f.SetBoundaryCurve(curve)
    f.SetTargetQuality(0.9)
    if size > 0.0:
        f.SetDesiredSize(size)
    f.SetNumberOfThreads(threads)
    f.Update()
    return [digest(f)]


def run_script(script, arguments):
    """Runs a script as it is; every vtkMeshOptimizeFilter that it updates is digested."""
    import meshoptimize
    digests = []

    class Digested(meshoptimize.vtkMeshOptimizeFilter):
        def Update(self, *ports):
            super().Update(*ports)
            digests.append(digest(self))

    meshoptimize.vtkMeshOptimizeFilter = Digested
    sys.path.insert(0, os.path.dirname(script))
    sys.argv = [script] + arguments
    with tempfile.TemporaryDirectory() as folder:
        sys.argv = [a.replace("{folder}", folder) for a in sys.argv]
        try:
            runpy.run_path(script, run_name="__main__")
        except SystemExit:
            pass
    return digests


def tasks(opt):
    """Name -> what a process of its own is to do."""
    result = {}
    for path in opt.mesh:
        for effort in EFFORTS + ("Paper1996",):
            for threads in opt.threads:
                name = os.path.splitext(os.path.basename(path))[0]
                result[f"meshes {name} {effort} threads {threads}"] = ["mesh", path, effort, threads]
    for rings in (8, 60):
        for curve in (0, 1):
            for size in (0.0, 0.7):
                for threads in opt.threads:
                    name = f"plane {rings} rings {'splines' if curve else 'lines'} size {size} threads {threads}"
                    result[name] = ["plane", rings, curve, size, threads]
    scripts = {"two_cracks": (os.path.join(EXAMPLES, "two_cracks.py"), ["{folder}"]),
               "adapt": (os.path.join(HERE, "adapt.py"), ["--tools", "ours"]),
               "adapt_3d": (os.path.join(HERE, "adapt_3d.py"), ["--elements", "2000", "--doublings", "2"])}
    for name, (script, arguments) in scripts.items():
        result[name] = ["script", script, arguments]
    for fuzz in ("fuzz_boundary", "fuzz_filter"):
        for first in range(0, opt.seeds, 50):
            count = min(50, opt.seeds - first)
            result[f"{fuzz} {first} {count}"] = ["script", os.path.join(FUZZ, fuzz + ".py"), [str(first), str(count)]]
    return {name: task for name, task in result.items() if name.split()[0] in opt.only}


def run_task(task):
    kind, arguments = task[0], task[1:]
    return {"mesh": run_mesh, "plane": run_plane, "script": run_script}[kind](*arguments)


def in_process(task):
    with tempfile.NamedTemporaryFile("r", suffix=".json") as answer:
        status = subprocess.run([sys.executable, os.path.abspath(__file__), "--task", json.dumps(task), answer.name],
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode
        text = answer.read()
    return json.loads(text) if text else [f"exit status {status}"]


def run_all(opt):
    wanted = tasks(opt)
    found = {}
    with concurrent.futures.ThreadPoolExecutor(opt.jobs) as pool:
        for name, digests in zip(wanted, pool.map(in_process, wanted.values())):
            found[name] = digests
            print(f"{name}: {len(digests)} {digests[-1] if digests else ''}", flush=True)
    return found


def compare(before, now):
    """Prints what differs; true if nothing does."""
    same = True
    for name, digests in now.items():
        old = before.get(name)
        if old is None:
            print(f"NEW {name}")
        elif old != digests:
            at = [k for k in range(min(len(old), len(digests))) if old[k] != digests[k]]
            print(f"DIFFERS {name}: {len(at)} of {len(old)} meshes, at first number {at[0] if at else min(len(old), len(digests))}")
        same = same and old == digests
    return same


def main():
    if len(sys.argv) == 4 and sys.argv[1] == "--task":
        task, answer = json.loads(sys.argv[2]), sys.argv[3]
        digests = run_task(task)
        with open(answer, "w") as f:
            json.dump(digests, f)
        return 0
    parts = ["meshes", "plane", "two_cracks", "adapt", "adapt_3d", "fuzz_boundary", "fuzz_filter"]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["record", "compare"])
    parser.add_argument("file")
    parser.add_argument("mesh", nargs="*")
    parser.add_argument("--only", nargs="+", choices=parts, default=parts)
    parser.add_argument("--threads", nargs="+", type=int, default=[1, 2, 4])
    parser.add_argument("--seeds", type=int, default=200)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--without-counts", action="store_true")
    opt = parser.parse_intermixed_args()
    if opt.without_counts:
        os.environ[WITHOUT_COUNTS] = "1"
    found = run_all(opt)
    if opt.what == "record":
        with open(opt.file, "w") as f:
            json.dump(found, f, indent=0, sort_keys=True)
        return 0
    with open(opt.file) as f:
        same = compare(json.load(f), found)
    print("all the same" if same else "not all the same")
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main())
