# SPDX-License-Identifier: BSD-3-Clause
"""The example of a surface that takes part, as a user runs it: what it reaches, and that the surface is the same set of points."""
import contextlib
import io
import os
import runpy
import sys

import numpy as np
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

from paraview_case import OUTPUT, check, load_plugin

load_plugin()
source = os.environ["MESHOPTIMIZE_SOURCE"]
path = os.path.join(OUTPUT, "slide_surface.vtu")
example = os.path.join(source, "ParaViewPlugin", "Examples", "slide_surface.py")
pellet = os.path.join(source, "Data", "crack40.vtu")
sys.argv = [example, pellet, path]
names = runpy.run_path(example)
kept, slid = names["kept"], names["slid"]
check(kept.WorstQualityAfter < 0.4, "with this surface nothing better is possible", kept.WorstQualityAfter)
check(slid.WorstQualityAfter >= 0.6, "with the surface taking part", slid.WorstQualityAfter)
check(0 < slid.SurfaceDistance < 1e-15, "the surface stays", slid.SurfaceDistance)


def read(name):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(name)
    reader.Update()
    grid = reader.GetOutput()
    tetrahedra = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)
    return grid, vtk_to_numpy(grid.GetPoints().GetData()).astype(float), tetrahedra


def measures(points, tetrahedra):
    """The volume, and the area of the facets that one tetrahedron has."""
    faces = np.sort(np.concatenate([np.delete(tetrahedra, i, axis=1) for i in range(4)]), axis=1)
    unique, count = np.unique(faces, axis=0, return_counts=True)
    t, x = points[unique[count == 1]], points[tetrahedra]
    area = 0.5 * np.linalg.norm(np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0]), axis=1).sum()
    return np.einsum("ij,ij->i", np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]), x[:, 3] - x[:, 0]).sum() / 6, area


(_, before, cells_before), (after_grid, after, cells_after) = read(pellet), read(path)
(volume, area), (new_volume, new_area) = measures(before, cells_before), measures(after, cells_after)
check(abs(new_volume / volume - 1) < 1e-13 and abs(new_area / area - 1) < 1e-13, "volume and area", new_volume / volume, new_area / area)
# The patch array may be chosen at points or on cells, with the association or by name alone: none of these is an error.
# (What it does is tested in C++.)
box = simple.Tetrahedralize(Input=simple.Wavelet(WholeExtent=[-3, 3, -3, 3, -3, 3]))
held = simple.Calculator(Input=box, ResultArrayName="Held", Function="if(coordsZ < -2.9 & coordsX < 0.1, 1, 0)")
numbered = simple.Calculator(Input=held, AttributeType="Cell Data", ResultArrayName="Number", ResultArrayType="Int", Function="1")
for chosen in (["POINTS", "Held"], "Held", ["CELLS", "Number"], "Number"):
    riding = simple.MeshOptimize(Input=numbered, BoundaryMode="Slide", SurfaceTolerance=0, PatchArray=chosen)
    riding.UpdatePipeline()
    riding.UpdatePropertyInformation()
    check(riding.WorstQualityAfter >= riding.WorstQualityBefore > 0, "patch array", chosen, riding.WorstQualityAfter)
    grid = servermanager.Fetch(riding)
    nodes, x = vtk_to_numpy(grid.GetPointData().GetArray("Held")), vtk_to_numpy(grid.GetPoints().GetData())
    where = x[nodes != 0]
    check((where[:, 2] == -3).all() and where[:, 0].max() < 0.1, "nodes of the set", chosen, where.max(axis=0))
places = vtk_to_numpy(after_grid.GetPointData().GetArray("BoundaryPlace"))
check(set(np.unique(places)) == {0, 1, 2, 3}, "places", np.bincount(places))

# From an STL to a good mesh, and what holds its worst elements.
if hasattr(simple, "TetrahedralizeTetGen"):  # a build may lack it
    example = os.path.join(source, "ParaViewPlugin", "Examples", "slide_stl.py")
    body = os.path.join(OUTPUT, "slide_stl.vtu")
    sys.argv = [example, os.path.join(OUTPUT, "slide_stl.stl"), body, "--make"]
    names = runpy.run_path(example)
    check(names["kept"].WorstQualityAfter < 0.4, "needles that stay", names["kept"].WorstQualityAfter)
    check(names["slid"].WorstQualityAfter >= 0.6, "from STL", names["slid"].WorstQualityAfter)
    diagonal = read(body)[0].GetLength()
    check(0 < names["slid"].SurfaceDistance <= 1.001e-3 * diagonal, "within the tolerance", names["slid"].SurfaceDistance / diagonal)
    script = os.path.join(source, "Testing", "Benchmarks", "what_holds.py")
    sys.argv = [script, body, "--below", "0.601"]
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        runpy.run_path(script, run_name="__main__")
    rows = [line.split("|")[1:-1] for line in printed.getvalue().splitlines() if line.startswith("| ")][1:]
    worst = names["slid"].WorstQualityAfter
    check(rows and abs(float(rows[0][1]) - worst) < 1e-4, "the first row is that of the worst element", rows[:1], worst)
    allowed = [float(row[k]) for row in rows for k in (5, 7) if row[k].strip()]
    check(allowed and min(allowed) >= worst - 1e-3, "no element is above what its angles allow", min(allowed, default=0))
