# SPDX-License-Identifier: BSD-3-Clause
"""What Mesh Optimize reaches on many ranks, and what it costs there, beside one rank of the same build; a Markdown table.

    /usr/bin/python3 Testing/Benchmarks/ranks.py [options] MESH ...

    MESH             a file of VTK, or lattice:CUBES:THROW, the mesh of large.py
    --ranks N ...    numbers of ranks (default: 1 2 3 4)
    --effort NAME    quick, default or best (default: default)
    --kept           also with the borders kept (OptimizeBorders off)
    --judge TOOLS    a folder with check_mesh.py, which looks at the gathered mesh
    --output FOLDER  where the gathered meshes are written (default: a temporary one)

MeshOptimize must be found (./bootstrap.sh env), and pvbatch and mpirun.openmpi. Each rank reads the mesh and takes its
part: the cells are cut in halves across the longest side of their box, again and again. From there to the optimized
part is what the seconds count, for the slowest rank, one thread each; memory is the peak above what was held before,
of the rank that needs most; the allocator gives back at once what is freed. *In bands* is the sum over all rounds of
the cells that were optimized at borders, as a share of all. The exit status is 1 if the judge finds a fault, or if the worst quality is under .98 of that of one rank,
or there are more cells under .2 than 1.02 times as many and 5.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkCellArray, vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter

# glibc otherwise keeps what reading the mesh has freed, and a run then seems to need that much less.
GIVE_BACK = {"MALLOC_MMAP_THRESHOLD_": "1000000"}
sys.path.insert(0, str(pathlib.Path(__file__).parent))
from large import lattice  # noqa: E402

EFFORTS = {"quick": 0, "default": 1, "best": 2}


def read(path):
    """Points [n, 3] and cells [m, 4]: tetrahedra only."""
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    connectivity = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    return vtk_to_numpy(grid.GetPoints().GetData()).copy(), connectivity.reshape(-1, 4).copy()


def make_grid(points, cells):
    grid = vtkUnstructuredGrid()
    places = vtkPoints()
    places.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=1))
    grid.SetPoints(places)
    array = vtkCellArray()
    array.SetData(numpy_to_vtkIdTypeArray(4 * np.arange(len(cells) + 1, dtype=np.int64), deep=1),
                  numpy_to_vtkIdTypeArray(np.ascontiguousarray(cells, np.int64).ravel(), deep=1))
    grid.SetCells(VTK_TETRA, array)
    return grid


def divide(centers, cells, count):
    """Numbers of the cells of each of `count` parts."""
    if count == 1:
        return [cells]
    part = centers[cells]
    order = cells[np.argsort(part[:, np.ptp(part, axis=0).argmax()], kind="stable")]
    left = count // 2
    middle = len(cells) * left // count
    return divide(centers, order[:middle], left) + divide(centers, order[middle:], count - left)


def piece(path, rank, ranks):
    points, cells = read(path)
    mine = np.sort(divide(points[cells].mean(axis=1), np.arange(len(cells)), ranks)[rank])
    used = np.unique(cells[mine])
    grid = make_grid(points[used], np.searchsorted(used, cells[mine]))
    for data, ids in ((grid.GetPointData(), used), (grid.GetCellData(), mine)):
        array = numpy_to_vtkIdTypeArray(ids.astype(np.int64), deep=1)
        array.SetName("Id")
        data.SetGlobalIds(array)
    return grid


def memory(field):
    for line in pathlib.Path("/proc/self/status").read_text().splitlines():
        if line.startswith(field):
            return int(line.split()[1]) / 1024
    return 0.0


def work(mesh, folder, effort, borders):
    """On each rank: optimizes its part, and leaves it and its figures in the folder."""
    from meshoptimize import vtkMeshOptimizeFilter
    from vtkmodules.vtkParallelCore import vtkMultiProcessController
    controller = vtkMultiProcessController.GetGlobalController()
    rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
    f = vtkMeshOptimizeFilter()
    f.SetEffort(EFFORTS[effort])
    f.SetNumberOfThreads(1)
    f.SetOptimizeBorders(borders)
    f.SetInputData(piece(mesh, rank, ranks))
    pathlib.Path("/proc/self/clear_refs").write_text("5")  # from here on the peak counts
    held = memory("VmRSS")
    controller.Barrier()
    start = time.perf_counter()
    f.UpdatePiece(rank, ranks, 0)
    seconds = time.perf_counter() - start
    peak = memory("VmHWM") - held
    out = f.GetOutput()
    bands = out.GetFieldData().GetArray("NumberOfCellsInBands")
    ids = out.GetPointData().GetGlobalIds() or out.GetPointData().GetArray("Id")
    np.savez(f"{folder}/{rank}.npz", x=vtk_to_numpy(out.GetPoints().GetData()), ids=vtk_to_numpy(ids),
             cells=vtk_to_numpy(out.GetCells().GetConnectivityArray()).reshape(-1, 4),
             quality=vtk_to_numpy(out.GetCellData().GetArray("MeshQuality")))
    pathlib.Path(f"{folder}/{rank}.json").write_text(json.dumps(
        {"s": seconds, "MB": peak, "bands": bands.GetValue(0) if bands else 0, "error": f.GetErrorCode(),
         "stop": f.GetStopReasonAsString()}))


def gather(folder, ranks):
    """The mesh of all ranks, joined by ids (new points have none where borders are kept), and its qualities."""
    parts = [np.load(f"{folder}/{r}.npz") for r in range(ranks)]
    first = max(p["ids"].max() for p in parts) + 1
    ids = []
    for p in parts:
        new = p["ids"] < 0
        named = p["ids"].copy()
        named[new] = first + np.arange(new.sum())
        first += new.sum()
        ids.append(named)
    every, index = np.unique(np.concatenate(ids), return_index=True)
    x = np.concatenate([p["x"] for p in parts])[index]
    cells = np.concatenate([np.searchsorted(every, i[p["cells"]]) for i, p in zip(ids, parts)])
    return make_grid(x, cells), np.concatenate([p["quality"] for p in parts])


def write(grid, path):
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()
    writer.SetCompressorTypeToNone()
    writer.SetFileName(str(path))
    writer.Write()


def file_of(mesh, folder):
    """The file of a mesh, which is made there if it is a lattice."""
    if not mesh.startswith("lattice:"):
        return pathlib.Path(mesh)
    cubes, throw = mesh.split(":")[1:]
    path = folder / f"lattice{cubes}.vtu"
    write(make_grid(*lattice(int(cubes), float(throw))), path)
    return path


def row(opt, mesh, ranks, borders, serial):
    """One line of the table; the figures of it, and whether all is well."""
    with tempfile.TemporaryDirectory() as folder:
        command = ["mpirun.openmpi", "--oversubscribe", "-np", ranks, "pvbatch", "--symmetric", __file__, "--worker", mesh, folder,
                   opt.effort, int(borders)]
        subprocess.run(list(map(str, command)), check=True, stdout=subprocess.DEVNULL,
                       env={**os.environ, **GIVE_BACK, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"})
        said = [json.loads(pathlib.Path(f"{folder}/{r}.json").read_text()) for r in range(ranks)]
        grid, quality = gather(folder, ranks)
    path = opt.output / f"{mesh.stem}.{ranks}{'' if borders else '.kept'}.vtu"
    write(grid, path)
    fault = "-"
    if opt.judge:
        command = [sys.executable, str(opt.judge / "check_mesh.py"), str(path), "--before", str(mesh)]
        judged = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        fault = "none" if judged.returncode == 0 else judged.stdout.strip().splitlines()[-1]
    worst, low = quality.min(), int((quality < 0.2).sum())
    name = f"{ranks}" if borders or ranks == 1 else f"{ranks}, borders kept"
    print(f"| {mesh.stem} | {name} | {worst:.4f} | {low} | {len(quality)} | {max(s['s'] for s in said):.2f} | "
          f"{max(s['MB'] for s in said):.0f} | {100 * said[0]['bands'] / len(quality):.0f} % | {said[0]['stop']} | {fault} |", flush=True)
    fine = fault in ("-", "none") and not any(s["error"] for s in said)
    if serial and borders:
        fine = fine and worst >= 0.98 * serial[0] and low <= 1.02 * serial[1] + 5
    return (worst, low), fine


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="+")
    parser.add_argument("--ranks", nargs="+", type=int, default=[1, 2, 3, 4])
    parser.add_argument("--effort", choices=EFFORTS, default="default")
    parser.add_argument("--kept", action="store_true")
    parser.add_argument("--judge", type=pathlib.Path)
    parser.add_argument("--output", type=pathlib.Path)
    opt = parser.parse_args()
    opt.output = opt.output or pathlib.Path(tempfile.mkdtemp())
    opt.output.mkdir(parents=True, exist_ok=True)
    print("| mesh | ranks | worst | under .2 | cells | s | MB | in bands | stop | fault |\n" + "|---" * 10 + "|")
    good = True
    for mesh in (file_of(name, opt.output) for name in opt.meshes):
        serial = None
        for ranks in opt.ranks:
            for borders in (True, False)[:2 if opt.kept and ranks > 1 else 1]:
                figures, fine = row(opt, mesh, ranks, borders, serial)
                serial = figures if ranks == 1 else serial
                good = good and fine
    return 0 if good else 1


if __name__ == "__main__":
    if sys.argv[1:2] == ["--worker"]:
        work(*sys.argv[2:5], sys.argv[5] == "1")  # without sys.exit(): pvbatch has to end MPI
    else:
        sys.exit(main())
