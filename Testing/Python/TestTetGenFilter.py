# SPDX-License-Identifier: BSD-3-Clause
"""vtkTetGenFilter from Python: a sphere is filled, kept and then optimized; errors come as errors, not as the end."""
import sys

import numpy as np
from meshoptimize import vtkMeshOptimizeFilter, vtkTetGenFilter
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkPlatonicSolidSource, vtkSphereSource

failures = []


def check(condition, message):
    if not condition:
        failures.append(message)


def arrays(grid):
    points = vtk_to_numpy(grid.GetPoints().GetData())
    return points, vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)


def volumes(points, cells):
    a, b, c, d = (points[cells[:, i]] for i in range(4))
    return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6


def run(source, **options):
    tetgen = vtkTetGenFilter()
    tetgen.SetInputConnection(source.GetOutputPort())
    for name, value in options.items():
        getattr(tetgen, "Set" + name)(value)
    errors = []
    def note(_, __, text):
        errors.append(text)
    note.CallDataType = "string0"
    tetgen.AddObserver("ErrorEvent", note)
    tetgen.Update()
    return tetgen, errors


ball = vtkSphereSource()
ball.SetThetaResolution(24)
ball.SetPhiResolution(17)
ball.SetRadius(1)
tetgen, errors = run(ball, MaximumVolume=2e-3, OptimizationLevel=0)
check(not errors, errors)
points, cells = arrays(tetgen.GetOutput())
surface = vtk_to_numpy(ball.GetOutput().GetPoints().GetData())
check((points[:len(surface)] == surface.astype(np.float64)).all(), "points of the surface come first and are kept")
triangles = vtk_to_numpy(ball.GetOutput().GetPolys().GetConnectivityArray()).reshape(-1, 3)
corners = surface.astype(np.float64)[triangles]
inside = np.einsum("ij,ij->i", np.cross(corners[:, 0], corners[:, 1]), corners[:, 2]).sum() / 6
check(abs(volumes(points, cells).sum() - inside) < 1e-12, "volume of the mesh is that inside the surface")
faces = np.sort(np.concatenate([np.delete(cells, i, axis=1) for i in range(4)]), axis=1)
faces, count = np.unique(faces, axis=0, return_counts=True)
check(count.max() == 2, "a face has two cells at most")
check((faces[count == 1] == np.unique(np.sort(triangles, axis=1), axis=0)).all(), "triangles are the boundary of the mesh")

optimize = vtkMeshOptimizeFilter()
optimize.SetInputConnection(tetgen.GetOutputPort())
optimize.SetRegionArray("Region")
optimize.SetTargetQuality(0.3)
optimize.Update()
check(optimize.GetErrorCode() == 0 and optimize.GetWorstQualityAfter() > optimize.GetWorstQualityBefore(),
      f"optimized {optimize.GetWorstQualityBefore()} -> {optimize.GetWorstQualityAfter()}")

tetgen, errors = run(vtkCubeSource())  # six squares that share no points
check(len(errors) == 1 and "lie on each other" in errors[0], errors)
check(tetgen.GetOutput().GetNumberOfCells() == 0 and tetgen.GetErrorCode() != 0, "an error has no output")

solid = vtkPlatonicSolidSource()
solid.SetSolidTypeToDodecahedron()  # pentagons
tetgen, errors = run(solid)
points, cells = arrays(tetgen.GetOutput())
corner_radius = np.linalg.norm(points[0])
edge = 4 * corner_radius / (np.sqrt(3) * (1 + np.sqrt(5)))
check(not errors and abs(volumes(points, cells).sum() / ((15 + 7 * np.sqrt(5)) / 4 * edge ** 3) - 1) < 1e-5,
      "volume of a dodecahedron")

for failure in failures:
    print("FAILED:", failure)
sys.exit(1 if failures else 0)
