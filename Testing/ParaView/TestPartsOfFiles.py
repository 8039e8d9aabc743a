# SPDX-License-Identifier: BSD-3-Clause
"""Files of several parts: the calls and commands say in one error what to do, and what they say works (.vtm to .vtm).

.pvtu to .pvtu is TestRanksExample.
"""
import os
import subprocess
import sys

import meshoptimize
from paraview import simple
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet, vtkUnstructuredGrid

from paraview_case import OUTPUT, check, jittered_box, load_plugin, random_mesh, source_of

load_plugin()
blocks = vtkMultiBlockDataSet()
for number, mesh in enumerate((jittered_box(5), random_mesh())):
    grid = vtkUnstructuredGrid()
    grid.ShallowCopy(mesh)
    blocks.SetBlock(number, grid)
os.chdir(OUTPUT)
simple.SaveData("blocks.vtm", proxy=source_of(blocks), DataMode="Binary")


def said(kind, call):
    try:
        call()
    except kind as error:
        return str(error)
    check(False, f"no {kind.__name__}")


check("vtkMeshOptimizeFilter" in said(TypeError, lambda: meshoptimize.optimize(blocks)), "no word on blocks")
check("mpirun -np 4 pvbatch ranks.py in.pvtu OUT.pvtu" in said(ValueError, lambda: meshoptimize.read("in.pvtu")), "pieces")
check("pvbatch" in said(ValueError, lambda: meshoptimize.write(jittered_box(), "out.pvtu")), "pieces written")
text = said(ValueError, lambda: meshoptimize.read("blocks.vtm"))
done = subprocess.run(["/usr/bin/python3", "-m", "meshoptimize", "optimize", "blocks.vtm", "OUT.vtm"],
                      capture_output=True, text=True, check=False)
check(done.returncode in (1, 2) and text in done.stderr and len(done.stderr.splitlines()) < 4, done.stderr)

exec(text.split("In pvpython: ")[1], {})  # what the error says
before, after = (simple.MeshQualityMinMax(Input=simple.OpenDataFile(name)) for name in ("blocks.vtm", "OUT.vtm"))
for measure in (before, after):
    measure.UpdatePipeline()
    measure.UpdatePropertyInformation()
check(after.MinimumQuality > before.MinimumQuality,
      "worst", before.MinimumQuality, "->", after.MinimumQuality)
check(simple.servermanager.Fetch(simple.OpenDataFile("OUT.vtm")).GetNumberOfBlocks() == 2, "the blocks are lost")
