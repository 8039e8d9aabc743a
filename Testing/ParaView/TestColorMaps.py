# SPDX-License-Identifier: BSD-3-Clause
"""Both filters are coloured by quality at once, by a map of their own: loud where bad, a range that stays, a title."""
from meshoptimize import _picture
from paraview import servermanager, simple

from paraview_case import check, load_plugin, random_mesh, source_of

load_plugin()
view = simple.CreateView("RenderView")
source = source_of(random_mesh(100))


def shown(proxy):
    display = simple.Show(proxy, view)
    display.SetScalarBarVisibility(view, True)
    return display


def points(table):
    return [table.RGBPoints[k:k + 4] for k in range(0, len(table.RGBPoints), 4)]


measure = simple.MeshQualityMinMax(Input=source)
optimize = simple.MeshOptimize(Input=source, TargetQuality=0.2)
for proxy in (measure, optimize, simple.OutputPort(measure, 3)):
    display = shown(proxy)
    check(list(display.ColorArrayName) == ["CELLS", "MeshQuality"], proxy, "is coloured by", display.ColorArrayName)
    table = display.LookupTable
    check(len(table.RGBPoints) == 4 * len(_picture.COLOURS), "points of the map", len(table.RGBPoints))
    for mine, picture in zip(points(table), _picture.COLOURS):  # the same colours in the picture of the commands
        check(max(abs(a - b) for a, b in zip(mine, picture)) < 1e-3, "the map has", mine, "and the picture", picture)
    display.RescaleTransferFunctionToDataRange(False, False)  # what Apply does
    check(table.RGBPoints[0] == 0 and table.RGBPoints[-4] == 1, "the range moves", table.RGBPoints[0], table.RGBPoints[-4])
    check(table.AutomaticRescaleRangeMode == "Never", "rescale mode", table.AutomaticRescaleRangeMode)
    check(simple.GetScalarBar(table, view).Title == "Mesh quality", "title", simple.GetScalarBar(table, view).Title)

# Degrees have an array, a map and a range of their own, beside the other.
degrees = simple.MeshQualityMinMax(Input=measure, QualityMeasure="Minimum Dihedral Angle")
display = shown(degrees)
check(list(display.ColorArrayName) == ["CELLS", "MinimumDihedralAngle"], "degrees", display.ColorArrayName)
check(abs(display.LookupTable.RGBPoints[-4] - 70.5288) < 1e-3, "degrees to", display.LookupTable.RGBPoints[-4])
check("degrees" in simple.GetScalarBar(display.LookupTable, view).Title, "the title names no unit")
check(degrees.CellData.GetArray("MeshQuality") is not None, "the quality of before is lost")
# ... but not those of cells that are there no longer.
again = simple.MeshOptimize(Input=degrees, TargetQuality=0.2)
again.UpdatePipeline()
check(again.CellData.GetArray("MinimumDihedralAngle") is None, "degrees of other cells")

# An array that the user made active stays what is shown.
chosen = simple.ProgrammableFilter(Input=source, Script="""
output.ShallowCopy(inputs[0].VTKObject)
output.CellData.append(numpy.arange(output.GetNumberOfCells(), dtype=float), "Mine")
output.GetCellData().SetActiveScalars("Mine")""")
optimized = simple.MeshOptimize(Input=chosen, TargetQuality=0.2)
check(shown(optimized).ColorArrayName[1] == "Mine", "the user's array is not shown")

# What the user has saved for an array counts more than the plugin's map.
settings = servermanager.vtkSMSettings.GetInstance()
settings.AddCollectionFromString(
    '{"array_lookup_tables": {"MeshQuality": {"PVLookupTable": {"RGBPoints": [0, 0, 0, 0, 2, 1, 1, 1]}}}}', 1.0)
simple.Delete(simple.GetColorTransferFunction("MeshQuality"))
check(simple.GetColorTransferFunction("MeshQuality").RGBPoints[-4] == 2, "the user's own map does not count")
