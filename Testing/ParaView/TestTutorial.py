# SPDX-License-Identifier: BSD-3-Clause
"""The tutorial from an STL file to a picture of the stress, as a user runs it: its numbers, and that its pictures show something.

The arm that is held bends under 2 N/mm^2 on 25 x 40 mm^2, 87.5 mm from its middle: 42 MPa at its faces by the theory of beams,
and 2 MPa along it.
"""
import os
import runpy
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

from paraview_case import OUTPUT, check, load_plugin

load_plugin()
folder = os.path.join(OUTPUT, "tutorial")
example = os.path.join(os.environ["MESHOPTIMIZE_SOURCE"], "ParaViewPlugin", "Examples", "tutorial.py")
sys.argv = [example, folder]
names = runpy.run_path(example)

optimized, solution = names["optimized"], names["solution"]
check(optimized.WorstQualityBefore < 0.1 and optimized.WorstQualityAfter > 0.35, "quality", optimized.WorstQualityAfter)
check(solution.StopReason == "Converged", solution.StopReason)

reader = vtkXMLUnstructuredGridReader()
reader.SetFileName(os.path.join(folder, "stress.vtu"))
reader.Update()
grid = reader.GetOutput()
x = vtk_to_numpy(grid.GetPoints().GetData())
data = {name: vtk_to_numpy(grid.GetPointData().GetArray(name)) for name in ("Displacement", "Stress")}
middle = (x[:, 2] > 55) & (x[:, 2] < 75)
for face, expected in ((0, -42 + 2), (25, 42 + 2)):
    bending = data["Stress"][middle & (abs(x[:, 0] - face) < 1e-3), 2].mean()
    check(abs(bending - expected) < 0.15 * abs(expected), "stress at x =", face, "is", bending, "and by a beam", expected)
check(data["Displacement"][x[:, 0] > 99.999, 2].max() < -0.1, "the arm does not give way")

for name in ("1_surface", "2_worst_elements", "3_before_and_after", "4_stress"):
    picture = vtkPNGReader()
    picture.SetFileName(os.path.join(folder, name + ".png"))
    picture.Update()
    pixels = vtk_to_numpy(picture.GetOutput().GetPointData().GetScalars())
    check(len(np.unique(pixels, axis=0)) > 50, name, "is empty")
