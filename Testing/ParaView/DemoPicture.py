"""The demo's picture on a small mesh, against Data/Baseline/demo_picture.png.

The mesh is a box of tetrahedra with its inner points pushed about, made here, so that the test takes seconds. MESHOPTIMIZE_ACCEPT_BASELINES=1 takes the
new picture over as the baseline: look at it first.
"""
import os
import runpy
import shutil
import sys

from paraview import simple
from vtkmodules.vtkImagingCore import vtkImageDifference
from vtkmodules.vtkIOImage import vtkPNGReader

from paraview_case import DATA, OUTPUT, check, jittered_box, load_plugin, source_of

TOLERANCE = 25.0  # vtkImageDifference's thresholded error, as VTK's own regression tests use it

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

picture = os.path.join(folder, "before_after.png")
baseline = os.path.join(DATA, "Baseline", "demo_picture.png")


def image(path):
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


if os.environ.get("MESHOPTIMIZE_ACCEPT_BASELINES") == "1":
    os.makedirs(os.path.dirname(baseline), exist_ok=True)
    shutil.copyfile(picture, baseline)
    print("accepted", baseline)
else:
    difference = vtkImageDifference()
    difference.SetInputData(image(picture))
    difference.SetImageData(image(baseline))
    difference.Update()
    error = difference.GetThresholdedError()
    print(f"difference {error:.2f}, allowed {TOLERANCE}")
    check(error <= TOLERANCE, "the picture changed: compare", picture, "with", baseline)
