# SPDX-License-Identifier: BSD-3-Clause
"""The demo's picture on a small mesh, against Data/Baseline/demo_picture.png.

The mesh is a box of tetrahedra with its inner points pushed about, made here, so that the test takes seconds. MESHOPTIMIZE_ACCEPT_BASELINES=1 takes the
new picture over as the baseline: look at it first.
"""
import os
import runpy
import sys

from paraview import simple

from paraview_case import OUTPUT, compare_picture, jittered_box, load_plugin, source_of

load_plugin()
folder = os.path.join(OUTPUT, "demo_picture")
os.makedirs(folder, exist_ok=True)
mesh = os.path.join(folder, "box.vtu")
source = source_of(jittered_box())
simple.SaveData(mesh, proxy=source, DataMode="Binary")
simple.Delete(source)
demo = os.path.join(os.environ["MESHOPTIMIZE_SOURCE"], "ParaViewPlugin", "Examples", "demo.py")
sys.argv = [demo, mesh, folder]
runpy.run_path(demo)

compare_picture(os.path.join(folder, "before_after.png"), "demo_picture.png")
