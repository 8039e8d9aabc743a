# SPDX-License-Identifier: BSD-3-Clause
"""Solution Metric by its proxy: takes a solution by itself, hands on what Mesh Optimize and ParaView's tensor glyphs take."""
from paraview import simple

from paraview_case import check, jittered_box, load_plugin, source_of

load_plugin()
source = source_of(jittered_box(6))
solution = simple.Calculator(Input=source, ResultArrayName="u", Function="exp(-20*(coordsX-0.5)^2)")
both = simple.Calculator(Input=solution, ResultArrayName="v", Function="u*iHat+coordsX*coordsY*jHat")
indicator = simple.PointDatatoCellData(Input=both, PassPointData=1)

unseen = simple.SolutionMetric(Input=solution)  # before ParaView knows what arrays there are
unseen.UpdatePipeline()
check(unseen.PointData.GetArray("Metric") is not None, "the active scalars are not taken")
indicator.UpdatePipeline()
metric = simple.SolutionMetric(Input=indicator)
check(metric.SolutionArray.GetArrayName() in ("u", "v"), "no solution is taken by itself:", metric.SolutionArray)
check(metric.GetPropertyValue("ErrorIndicatorArray")[1] in ("None", ""), "error indicator grabbed")
metric.SolutionArray = ["POINTS", "u"]
metric.DesiredNumberOfElements = 3000
metric.MaximumAnisotropy = 10
metric.ComputeSizeTensor = 1
metric.UpdatePipeline()
metric.UpdatePropertyInformation()
check(abs(metric.PredictedNumberOfElements - 3000) < 3, "predicted", metric.PredictedNumberOfElements)
check(metric.DesiredSize > 0, "h*", metric.DesiredSize)
check(metric.PointData["Metric"].GetNumberOfComponents() == 6, "components of Metric")
low, high = metric.PointData["DesiredSize"].GetRange()
check(low == high == metric.DesiredSize, "array DesiredSize", low, high)

# What comes out goes in: all operations off, the mesh is measured only.
optimize = simple.MeshOptimize(Input=metric, Beta=2, MoveNodes=0, Reconnect=0, InsertNodes=0, RemoveNodes=0)
optimize.MetricArray = ["POINTS", "Metric"]
optimize.SizeArray = ["POINTS", "DesiredSize"]
optimize.UpdatePipeline()
check(optimize.CellData.GetArray("MeshQuality") is not None, "Mesh Optimize does not take the metric")

# A glyph for each point; those of the sizes are round the mesh, as long as it is at most.
points = metric.GetDataInformation().GetNumberOfPoints()
for name, scale in (("Metric", 1e-4), ("SizeTensor", 1)):
    glyphs = simple.TensorGlyph(Input=metric, GlyphType="Sphere", ScaleFactor=scale)
    check(glyphs.Tensors.GetArrayName() in ("Metric", "SizeTensor"), "glyphs take", glyphs.Tensors)
    glyphs.Tensors = ["POINTS", name]
    glyphs.UpdatePipeline()
    drawn = glyphs.GetDataInformation().GetNumberOfPoints()
    check(drawn >= 10 * points and drawn % points == 0, drawn, "points in the glyphs of", name)
    low, high = glyphs.GetDataInformation().GetBounds()[2:4]
    check(-1 < low < 0 and 1 < high < 2, "extent of the glyphs of", name, low, high)

# The other criterion, and vectors.
metric.SolutionArray = ["POINTS", "v"]
metric.Recovery = "Least Squares"
metric.UpdatePipeline()
metric.UpdatePropertyInformation()
check(abs(metric.PredictedNumberOfElements - 3000) < 3, "predicted for a vector", metric.PredictedNumberOfElements)
metric.Criterion = "Error Indicator"
metric.ErrorIndicatorArray = ["CELLS", "u"]
metric.UpdatePipeline()
metric.UpdatePropertyInformation()
low, high = metric.PointData["DesiredSize"].GetRange()
check(0 < low < high, "sizes", low, high)
check(metric.PointData.GetArray("Metric") is None and metric.DesiredSize == 0, "a metric from an error indicator")
check(metric.TotalError > 0, "total error", metric.TotalError)
print(f"sizes {low:.4f} to {high:.4f}, total error {metric.TotalError:.4f}")
