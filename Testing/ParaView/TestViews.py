# SPDX-License-Identifier: BSD-3-Clause
"""meshoptimize.paraview: the worst elements, and before and after; data first, then that something is drawn."""
import os

from meshoptimize.paraview import compare_before_and_after, show_worst_elements
from paraview import simple

from paraview_case import OUTPUT, check, jittered_box, load_plugin, source_of

load_plugin()
source = source_of(jittered_box())
optimized = simple.MeshOptimize(Input=source)

view, table, measure = show_worst_elements(source, 5)
worst = simple.OutputPort(measure, 3)
check(worst.GetDataInformation().GetNumberOfCells() == 5, "five worst elements")
check(simple.GetRepresentation(measure, view).Opacity < 0.5, "the body hides the elements")
check(simple.GetRepresentation(worst, view).ColorArrayName[1] == "MeshQuality", "the worst are not coloured")
check(simple.GetRepresentation(worst, table).Visibility == 1, "no table")
layout = simple.GetLayout(view)
layout.SetSize(800, 800)
simple.SaveScreenshot(os.path.join(OUTPUT, "worst_elements.png"), layout)

layout = compare_before_and_after(optimized)
views = simple.GetViewsInLayout(layout)
check(len(views) == 4, "four views, not", len(views))
meshes = [v for v in views if v.GetXMLName() == "RenderView"]
for mesh in meshes:
    simple.Render(mesh)
meshes[0].CameraPosition = [3.0, -4.0, 2.0]
simple.Render(meshes[0])  # a link follows when it is drawn
check(list(meshes[1].CameraPosition) == [3.0, -4.0, 2.0], "not linked:", list(meshes[1].CameraPosition))
simple.ResetCamera(meshes[0])
simple.Render(meshes[0])
titles = sorted(v.ChartTitle for v in views if v.GetXMLName() != "RenderView")
check("0 under 0.3" in titles[0] and titles[1].startswith("before"), titles)
layout.SetSize(1000, 800)
simple.SaveScreenshot(os.path.join(OUTPUT, "compare.png"), layout)

for call in (lambda: compare_before_and_after(source), lambda: show_worst_elements(simple.Line())):
    try:
        call()
    except (ValueError, RuntimeError):
        continue
    check(False, "a wrong source is taken")
