# SPDX-License-Identifier: BSD-3-Clause
"""What the paraview tests share: the plugin, a mesh made in the script, and a check that speaks."""
import contextlib
import itertools
import os
import shutil
import subprocess
import threading

from paraview import simple
from vtkmodules.vtkCommonCore import vtkMinimalStandardRandomSequence, vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkFiltersCore import vtkDelaunay3D
from vtkmodules.vtkImagingCore import vtkImageDifference
from vtkmodules.vtkIOImage import vtkPNGReader

OUTPUT = os.environ["MESHOPTIMIZE_OUTPUT"]
DATA = os.environ["MESHOPTIMIZE_DATA"]
TOLERANCE = 25.0  # vtkImageDifference's thresholded error, as VTK's own regression tests use it


def load_plugin():
    """The plugin is there by PV_PLUGIN_PATH; without that variable it is loaded by LoadPlugin."""
    if "PV_PLUGIN_PATH" not in os.environ:
        simple.LoadPlugin(os.environ["MESHOPTIMIZE_PLUGIN"], remote=False, ns=simple.__dict__)
    check(hasattr(simple, "MeshOptimize"), "the plugin is not loaded")


@contextlib.contextmanager
def pvserver(*launcher, environment=None):
    """Starts a pvserver, connects to it, and loads the plugin on both sides; at the end the server is gone."""
    environment = {k: v for k, v in (environment or os.environ).items() if k != "PV_PLUGIN_PATH"}
    server = None
    for attempt in range(20):
        # Below the ports that the system gives away by itself (from 32768): a free one of those may be taken, by MPI for
        # its own talk or by another test, before the server has it.
        port = 12000 + (os.getpid() * 20 + attempt) % 20000
        server = subprocess.Popen([*launcher, "pvserver", f"--server-port={port}", "--disable-xdisplay-test"],
                                  env=environment, stdout=subprocess.PIPE, text=True)
        if any(line.startswith("Accepting") for line in server.stdout):
            break
        server.wait()  # it has ended: the port is taken
    watchdog = threading.Timer(240, lambda: (server.terminate(), print("FAILED: the server hangs", flush=True), os._exit(1)))
    watchdog.daemon = True
    watchdog.start()
    try:
        check(server.poll() is None, "no server")
        check(simple.Connect("127.0.0.1", port) is not None, "no connection")
        plugin = os.environ["MESHOPTIMIZE_PLUGIN"]
        simple.LoadPlugin(plugin, remote=True, ns=simple.__dict__)
        simple.LoadPlugin(plugin, remote=False, ns=simple.__dict__)
        yield
        simple.Disconnect()
    finally:
        server.terminate()
        server.wait()


def random_mesh(points=300, seed=1996):
    """Delaunay tetrahedra of seeded points in the unit cube, slivers included; volumes positive."""
    sequence = vtkMinimalStandardRandomSequence()
    sequence.SetSeed(seed)
    cloud = vtkPoints()
    cloud.SetDataTypeToDouble()
    for _ in range(points):
        xyz = []
        for _ in range(3):
            xyz.append(sequence.GetValue())
            sequence.Next()
        cloud.InsertNextPoint(xyz)
    for corner in range(8):
        cloud.InsertNextPoint(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1)
    poly = vtkPolyData()
    poly.SetPoints(cloud)
    delaunay = vtkDelaunay3D()
    delaunay.SetInputData(poly)
    delaunay.Update()
    grid = vtkUnstructuredGrid()
    grid.DeepCopy(delaunay.GetOutput())
    return grid


def jittered_box(n=8, seed=1996):
    """n x n x n cubes of six tetrahedra with interior points pushed about: bad inside, good on the surface."""
    sequence = vtkMinimalStandardRandomSequence()
    sequence.SetSeed(seed)
    points = vtkPoints()
    points.SetDataTypeToDouble()
    for k in range(n + 1):
        for j in range(n + 1):
            for i in range(n + 1):
                xyz = [i / n, j / n, k / n]
                if 0 < i < n and 0 < j < n and 0 < k < n:
                    for axis in range(3):
                        xyz[axis] += 0.55 / n * (sequence.GetValue() - 0.5)
                        sequence.Next()
                points.InsertNextPoint(xyz)
    grid = vtkUnstructuredGrid()
    grid.SetPoints(points)
    grid.Allocate(6 * n ** 3)
    step = (1, n + 1, (n + 1) ** 2)
    for k in range(n):
        for j in range(n):
            for i in range(n):
                corner = i + j * step[1] + k * step[2]
                for order in itertools.permutations(range(3)):
                    path = [corner]
                    for axis in order:
                        path.append(path[-1] + step[axis])
                    if order in ((0, 2, 1), (1, 0, 2), (2, 1, 0)):  # odd: turn it round
                        path[1], path[2] = path[2], path[1]
                    grid.InsertNextCell(VTK_TETRA, 4, path)
    return grid


def source_of(grid):
    """A pipeline source that gives `grid`."""
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(grid)
    source.UpdatePipeline()
    return source


def check(condition, *message):
    if not condition:
        raise SystemExit("FAILED: " + " ".join(str(m) for m in message))


def compare_picture(picture, name):
    """A PNG file against Data/Baseline/name. MESHOPTIMIZE_ACCEPT_BASELINES=1 takes it over: look at it first."""
    def image(path):
        reader = vtkPNGReader()
        reader.SetFileName(path)
        reader.Update()
        return reader.GetOutput()

    baseline = os.path.join(DATA, "Baseline", name)
    if os.environ.get("MESHOPTIMIZE_ACCEPT_BASELINES") == "1":
        os.makedirs(os.path.dirname(baseline), exist_ok=True)
        shutil.copyfile(picture, baseline)
        print("accepted", baseline)
        return
    difference = vtkImageDifference()
    difference.SetInputData(image(picture))
    difference.SetImageData(image(baseline))
    difference.Update()
    error = difference.GetThresholdedError()
    print(f"difference {error:.2f}, allowed {TOLERANCE}")
    check(error <= TOLERANCE, "the picture changed: compare", picture, "with", baseline)
