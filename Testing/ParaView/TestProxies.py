# SPDX-License-Identifier: BSD-3-Clause
"""Both filters by their proxies: defaults that have no surprise, results that can be read, ports that hold what they say."""
from paraview import servermanager, simple

from paraview_case import check, load_plugin, random_mesh, source_of

load_plugin()

# Without an input (a script's first line, before there is a source) a filter can be made, and no array is chosen.
for name in ("MeshOptimize", "MeshQualityMinMax", "SolutionMetric", "Thermoelastic"):
    proxy = getattr(simple, name)()
    for array in (p for p in proxy.ListProperties() if p.endswith("Array") and p != "SolutionArray"):
        check(proxy.GetPropertyValue(array)[1] == "None", name, array, "is", proxy.GetPropertyValue(array))
    simple.Delete(proxy)
    del proxy

source = source_of(random_mesh())
cells_before = source.GetDataInformation().GetNumberOfCells()

quality = simple.MeshQualityMinMax(Input=source)
for name in ("RegionArray", "SizeArray", "MetricArray"):
    check(quality.GetPropertyValue(name)[1] in ("None", ""), name, "grabbed", quality.GetPropertyValue(name))
quality.UpdatePipeline()
quality.UpdatePropertyInformation()
check(quality.CellData.GetArray("MeshQuality") is not None, "no cell array MeshQuality")
low, high = quality.CellData["MeshQuality"].GetRange()
check(abs(low - quality.MinimumQuality) < 1e-12 and abs(high - quality.MaximumQuality) < 1e-12,
      "minimum and maximum", low, high, quality.MinimumQuality, quality.MaximumQuality)
check(low <= quality.MeanQuality <= high, "mean", quality.MeanQuality)
check(0 < quality.QualityBound <= 1, "bound", quality.QualityBound)
for port, kind in ((1, "vtkTable"), (2, "vtkTable"), (3, "vtkUnstructuredGrid")):
    data = servermanager.Fetch(quality, idx=port)
    check(data.IsA(kind), "port", port, "holds", data.GetClassName())
check(servermanager.Fetch(quality, idx=3).GetNumberOfCells() == 10, "ten worst cells")
quality.NumberOfWorstCells = 3
quality.UpdatePipeline()
check(servermanager.Fetch(quality, idx=3).GetNumberOfCells() == 3, "three worst cells")

optimize = simple.MeshOptimize(Input=source)
for name in ("RegionArray", "FixedPointArray", "SizeArray", "MetricArray"):
    check(optimize.GetPropertyValue(name)[1] in ("None", ""), name, "grabbed", optimize.GetPropertyValue(name))
check(optimize.Algorithm == "Worst First" and optimize.Effort == "Default", "defaults", optimize.Algorithm, optimize.Effort)
optimize.TargetQuality = 0.3
optimize.Algorithm = "Paper 1996"
optimize.UpdatePipeline()
optimize.UpdatePropertyInformation()
check(optimize.WorstQualityAfter > 2 * max(low, 0), "hardly better with Paper 1996:", low, optimize.WorstQualityAfter)
optimize.Algorithm = "Worst First"
optimize.UpdatePipeline()
optimize.UpdatePropertyInformation()
check(abs(optimize.WorstQualityBefore - low) < 1e-12, "worst before", optimize.WorstQualityBefore, low)
check(optimize.WorstQualityAfter >= optimize.WorstQualityBefore, "worst fell")
check(optimize.WorstQualityAfter > 2 * max(low, 0), "hardly better:", low, optimize.WorstQualityAfter)
check(optimize.WorstQualityAfter <= optimize.QualityBound + 1e-12, "above its bound")
check(len(optimize.StopReason) > 3, "stop reason", repr(optimize.StopReason))
history = servermanager.Fetch(optimize, idx=1)
check(history.IsA("vtkTable") and history.GetNumberOfRows() > 0, "history is empty")
check(source.GetDataInformation().GetNumberOfCells() == cells_before, "the input changed")

after = simple.MeshQualityMinMax(Input=optimize)
after.UpdatePipeline()
after.UpdatePropertyInformation()
check(abs(after.MinimumQuality - optimize.WorstQualityAfter) < 1e-12, "both filters measure the same")

# The window: the results stand in the panel without the gear; tables do not open by themselves, since the next filter's
# mesh would go into the spreadsheet, which is the active view then.
controller = servermanager.vtkSMParaViewPipelineControllerWithRendering()
solver = simple.Thermoelastic(Input=source)
for proxy, results, tables in ((optimize, ("WorstQualityBefore", "WorstQualityAfter", "QualityBound", "StopReason"), (1,)),
                               (quality, ("MinimumQuality", "MaximumQuality", "QualityBound"), (1, 2)),
                               (solver, ("StopReason", "RelativeErrorEstimate"), (1,))):
    for result in results:
        visibility = proxy.SMProxy.GetProperty(result).GetPanelVisibility()
        check(visibility == "default", result, "is", visibility)
    for port in tables:
        check(controller.GetPreferredViewType(proxy.SMProxy, port) == "None", proxy.GetXMLName(), port, "opens a view")

# Settings that a state file would carry come back.
optimize.QualityMeasure = "Mean Ratio"
check(optimize.QualityMeasure == "Mean Ratio", "enumeration")
optimize.RegionArray = ["CELLS", "MeshQuality"]
check(optimize.RegionArray.GetArrayName() == "MeshQuality", "array picker")
print(f"worst {low:.4f} -> {after.MinimumQuality:.4f}, bound {optimize.QualityBound:.4f}, {optimize.StopReason}")
