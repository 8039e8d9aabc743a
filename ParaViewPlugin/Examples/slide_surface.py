"""A surface that takes part, and stays the same: pvpython slide_surface.py MESH.vtu OUT.vtu [PICTURE.png]

    Mesh Optimize twice: with the surface kept, and sliding with tolerance 0; for example with Data/crack40.vtu

With tolerance 0 nodes slide in the flat parts of the surface and along its straight edges only: it stays the same set of points.
With PV_PLUGIN_PATH set (./bootstrap.sh env) the filter is there; otherwise call first
LoadPlugin(".../MeshOptimize.so", ns=globals()). The picture needs a display (xvfb-run).
"""
import sys

from paraview.simple import *

mesh = XMLUnstructuredGridReader(FileName=[sys.argv[1]])
kept = MeshOptimize(Input=mesh)
slid = MeshOptimize(Input=mesh, BoundaryMode="Slide", SurfaceTolerance=0)
SaveData(sys.argv[2], proxy=slid, DataMode="Binary")

for name, source in (("kept", kept), ("sliding", slid)):
    source.UpdatePipeline()
    source.UpdatePropertyInformation()
    print(f"surface {name}: worst element {source.WorstQualityBefore:.4f} -> {source.WorstQualityAfter:.4f}, "
          f"surface moved by {source.SurfaceDistance:.1e}: {source.StopReason}")

if len(sys.argv) > 3:
    layout = CreateLayout("Kept and sliding")
    for place, source in enumerate((kept, slid)):
        view = CreateView("RenderView")
        AssignViewToLayout(view, layout, 2 * place)
        body = Show(source, view)  # translucent, with the bad elements inside
        body.SetRepresentationType("Surface")
        body.Opacity = 0.15
        body.ColorArrayName = ["POINTS", ""]
        bad = Threshold(Input=source, Scalars=["CELLS", "MeshQuality"], LowerThreshold=0.61, ThresholdMethod="Below Lower Threshold")
        display = Show(bad, view)
        display.SetRepresentationType("Surface With Edges")
        display.SetScalarBarVisibility(view, True)
        view.OrientationAxesVisibility = 0
        view.CameraFocalPoint, view.CameraPosition, view.CameraViewUp = [0, 0, 0.6], [0.7, -1.2, 1.5], [0, 0, 1]
        ResetCamera(view)
        if place == 0:
            layout.SplitHorizontal(0, 0.5)
    layout.SetSize(1400, 800)
    SaveScreenshot(sys.argv[3], layout, OverrideColorPalette="WhiteBackground")
