# SPDX-License-Identifier: BSD-3-Clause
"""The example from a surface to stress, as a user runs it: what it writes, and its numbers.

The block's bottom is held and its temperature rises as 0.05 z^2. Far from the bottom its mean rise in height is the free one,
alpha 0.05 h^3 / 3; the rest was seen in a first run and looked at as a picture.
"""
import os
import runpy
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

from paraview_case import OUTPUT, check, load_plugin

load_plugin()
path = os.path.join(OUTPUT, "stress_pipeline.vtu")
example = os.path.join(os.environ["MESHOPTIMIZE_SOURCE"], "ParaViewPlugin", "Examples", "stress_pipeline.py")
sys.argv = [example, path]
names = runpy.run_path(example)

optimized, solution = names["optimized"], names["solution"]
check(optimized.WorstQualityBefore < 0.1 and optimized.WorstQualityAfter >= 0.6, "quality", optimized.WorstQualityAfter)
check(solution.StopReason == "Converged" and solution.NumberOfUnknowns > 9000, solution.StopReason, solution.NumberOfUnknowns)

reader = vtkXMLUnstructuredGridReader()
reader.SetFileName(path)
reader.Update()
grid = reader.GetOutput()
data = {name: vtk_to_numpy(grid.GetPointData().GetArray(name)) for name in ("Displacement", "VonMises", "Temperature")}
warped = vtk_to_numpy(grid.GetPoints().GetData())
u = data["Displacement"]
x = warped - 50 * u
check(np.allclose(data["Temperature"], 20 + 0.05 * x[:, 2] ** 2, atol=0.01), "the temperature, and the factor of the warp")
bottom, top = x[:, 2] < 0.001, x[:, 2] > 99.999
check(bottom.sum() == top.sum() == 17 * 17 and (u[bottom] == 0).all(), "bottom held, surface kept", bottom.sum(), top.sum())
middle = top & (np.hypot(x[:, 0] - 50, x[:, 1] - 50) < 60)
rise, free = u[middle, 2].mean(), 1.2e-5 * 0.05 * 100 ** 3 / 3
check(0.8 * free < rise < 1.5 * free, "the top rises by", rise, "freely by", free)
greatest = np.linalg.norm(u, axis=1).max()
check(abs(greatest / 0.401 - 1) < 0.02, "greatest displacement", greatest)
check(abs(data["VonMises"].max() / 428 - 1) < 0.2, "greatest von Mises stress", data["VonMises"].max())
