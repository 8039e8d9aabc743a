# SPDX-License-Identifier: BSD-3-Clause
"""The example with a state file: a state is saved, and its pipeline runs on another file with the settings of the state."""
import os
import runpy
import sys

from paraview import simple
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter

from paraview_case import DATA, OUTPUT, check, jittered_box, load_plugin

load_plugin()
state, folder, box = (os.path.join(OUTPUT, name) for name in ("state.pvsm", "state_files", "state_box.vtu"))
reader = simple.XMLUnstructuredGridReader(FileName=[os.path.join(DATA, "crack40.vtu")])
simple.MeshOptimize(Input=reader, TargetQuality=0.25, Effort="Quick")
simple.SaveState(state)
simple.ResetSession()
writer = vtkXMLUnstructuredGridWriter()
writer.SetFileName(box)
writer.SetDataModeToBinary()
writer.SetInputData(jittered_box())
writer.Write()

sys.argv = ["state_file.py", state, folder, box]
names = runpy.run_path(os.path.join(os.environ["MESHOPTIMIZE_SOURCE"], "ParaViewPlugin", "Examples", "state_file.py"))
optimized = names["optimized"]
check(optimized.TargetQuality == 0.25 and optimized.Effort == "Quick", "the settings of the state are lost")
result = vtkXMLUnstructuredGridReader()
result.SetFileName(os.path.join(folder, "state_box.vtu"))
result.Update()
low, _ = result.GetOutput().GetCellData().GetArray("MeshQuality").GetRange()
check(low >= 0.25 > optimized.WorstQualityBefore, "worst of the other file", optimized.WorstQualityBefore, "->", low)
check(2000 < result.GetOutput().GetNumberOfCells() < 4000, "another mesh:", result.GetOutput().GetNumberOfCells())
