# SPDX-License-Identifier: BSD-3-Clause
"""meshoptimize.paraview: worst elements, before and after, history, histogram; data, that something is drawn, trace, states."""
import os
import runpy

from meshoptimize.paraview import compare_before_and_after, show_histogram, show_history, show_worst_elements
from paraview import servermanager, simple, smstate, smtrace

from paraview_case import DATA, OUTPUT, check, jittered_box, load_plugin, source_of



def shown(display):
    """The series that a chart shows, of pairs (name, 0 or 1)."""
    pairs = list(display.SeriesVisibility)
    return sorted(name for name, switch in zip(pairs[::2], pairs[1::2]) if int(switch))


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

chart = show_history(optimized)
history = servermanager.Fetch(optimized, idx=1)
lines = simple.GetRepresentation(simple.OutputPort(optimized, 1), chart)
check(chart.GetXMLName() == "XYChartView" and shown(lines) == ["Mean", "Worst"], lines.SeriesVisibility)
check(lines.XArrayName == "Pass" and not lines.UseIndexForXAxis and history.GetNumberOfRows() > 2, "passes", history.GetNumberOfRows())
check(f"{optimized.WorstQualityAfter:.4f}" in chart.ChartTitle, chart.ChartTitle)
chart.ViewSize = [800, 500]
simple.SaveScreenshot(os.path.join(OUTPUT, "history.png"), chart)

chart, measured = show_histogram(source)
bars = simple.GetRepresentation(simple.OutputPort(measured, 2), chart)
check(chart.GetXMLName() == "XYBarChartView" and shown(bars) == ["Count"], bars.SeriesVisibility)
check(bars.XArrayName == "BinCenter" and not bars.UseIndexForXAxis, "not over the quality")
check(chart.LeftAxisLogScale == 1 and chart.LeftAxisRangeMaximum == 10000, "the axis of counts", chart.LeftAxisRangeMaximum)
counts = servermanager.Fetch(measured, idx=2).GetColumnByName("Count")
check(sum(counts.GetValue(k) for k in range(counts.GetNumberOfTuples())) == 3072, "elements in the bars")
check(f"{measured.MinimumQuality:.4f}" in chart.ChartTitle, chart.ChartTitle)
chart.ViewSize = [800, 500]
simple.SaveScreenshot(os.path.join(OUTPUT, "histogram.png"), chart)

# Each is one call in the trace, which runs.
simple.SetActiveSource(source)
smtrace.start_trace()
show_worst_elements(number=3)
simple.SetActiveSource(optimized)
show_history()
trace = smtrace.stop_trace()
check("show_worst_elements(" in trace and "number=3)" in trace and "show_history(meshOptimize1)" in trace, trace)
check("SplitVertical" not in trace and "MeshQualityMinMax(" not in trace, "more than the calls:", trace)
body = trace[trace.index("from meshoptimize.paraview import show_history"):].split("\n\n")[0]
exec(body, {"meshOptimize1": optimized})  # the two lines

for call in (lambda: show_history(source), lambda: compare_before_and_after(source), lambda: show_worst_elements(simple.Line())):
    try:
        call()
    except (ValueError, RuntimeError):
        continue
    check(False, "a wrong source is taken")

# Saved and loaded, as .pvsm and as .py, all four look the same.


def looks():
    """What each view shows: kind, title, and of each visible display its kind, port, columns and colours."""
    views = []
    for view in simple.GetViews():
        displays = []
        for display in filter(lambda d: hasattr(d, "Input") and d.Visibility, view.Representations):
            columns = (display.XArrayName, shown(display)) if hasattr(display, "XArrayName") else None
            displays.append((display.GetXMLName(), display.Input.Port, display.Input.GetXMLName(), columns,
                             list(getattr(display, "ColorArrayName", []))))
        views.append((view.GetXMLName(), getattr(view, "ChartTitle", ""), getattr(view, "LeftAxisLogScale", None),
                      list(getattr(view, "CameraPosition", [])), sorted(displays, key=str)))
    return sorted(views, key=str)


simple.ResetSession()
mesh = simple.XMLUnstructuredGridReader(FileName=[os.path.join(DATA, "crack40.vtu")])
optimized = simple.MeshOptimize(Input=mesh, TargetQuality=0.2, Effort="Quick")
show_worst_elements(mesh)
compare_before_and_after(optimized)
show_history(optimized)
show_histogram(optimized)
saved = looks()
check(sorted(view[0] for view in saved) == ["RenderView"] * 3 + ["SpreadSheetView"] + ["XYBarChartView"] * 3 + ["XYChartView"], saved)
state = os.path.join(OUTPUT, "views.pvsm")
simple.SaveState(state)
with open(state.replace(".pvsm", ".py"), "w", encoding="utf-8") as file:
    file.write(smstate.get_state())
for load, name in ((simple.LoadState, state), (runpy.run_path, state.replace(".pvsm", ".py"))):
    simple.ResetSession()
    load(name)
    check(looks() == saved, name, "shows otherwise:\n", "\n".join(map(str, looks())), "\nnot\n", "\n".join(map(str, saved)))
