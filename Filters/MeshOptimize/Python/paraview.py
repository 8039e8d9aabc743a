# SPDX-License-Identifier: BSD-3-Clause
"""Views of a mesh in ParaView (pvpython, pvbatch, the window's Python Shell), with the plugin loaded.

    from meshoptimize.paraview import compare_before_and_after, show_worst_elements
    show_worst_elements(mesh)              # any source; without one: the active source
    compare_before_and_after(optimized)    # a Mesh Optimize filter
"""
import math

from paraview import servermanager, simple

BAD = 0.3  # elements under it are shown in comparisons
PALE = [0.72, 0.78, 0.85]


def _measured(source, **options):
    if source.GetXMLName() != "MeshQualityMinMax":
        source = simple.MeshQualityMinMax(Input=source)
    for name, value in options.items():
        source.SetPropertyWithName(name, value)
    source.UpdatePipeline()
    source.UpdatePropertyInformation()
    if not simple.OutputPort(source, 3).GetDataInformation().GetNumberOfCells():
        raise ValueError("there are no triangles or tetrahedra to show")
    return source


def _show_body(source, view):
    display = simple.Show(source, view)
    display.SetRepresentationType("Surface")
    display.ColorArrayName = ["POINTS", ""]
    display.AmbientColor = display.DiffuseColor = PALE
    display.Opacity = 0.2


def _show_bad(source, view):
    display = simple.Show(source, view)  # coloured by quality: the active scalars
    display.SetRepresentationType("Surface With Edges")
    display.SetScalarBarVisibility(view, True)


def _source(source):
    source = source or simple.GetActiveSource()
    if source is None:
        raise ValueError("there is no active source")
    return source


def show_worst_elements(source=None, number=10):
    """The mesh translucent, its worst elements solid in it, the camera on the worst one, and a table of them.

    Returns the view, the spreadsheet and the Mesh Quality Min Max filter that both show. Rows that are selected in the
    table are selected in the view.
    """
    measure = _measured(_source(source), NumberOfWorstCells=number)
    worst = simple.OutputPort(measure, 3)
    layout = simple.CreateLayout("Worst elements")
    view, table = simple.CreateView("RenderView"), simple.CreateView("SpreadSheetView")
    simple.AssignViewToLayout(view, layout, 0)
    simple.AssignViewToLayout(table, layout, layout.SplitVertical(0, 0.7) + 1)
    _show_body(measure, view)
    _show_bad(worst, view)
    table.FieldAssociation = "Cell Data"
    simple.Show(worst, table)
    bounds = measure.GetDataInformation().GetBounds()
    centre = servermanager.Fetch(measure, idx=3).GetCellData().GetArray("Center").GetTuple3(0)
    size = math.dist(bounds[::2], bounds[1::2])
    flat = bounds[4] == bounds[5]
    view.CameraFocalPoint = view.CenterOfRotation = centre
    view.CameraPosition = [centre[0] + (0 if flat else size), centre[1] - (0 if flat else 2 * size), centre[2] + size]
    view.CameraViewUp = [0, 1, 0] if flat else [0, 0, 1]
    view.CameraParallelProjection = 1
    view.CameraParallelScale = 0.3 * size
    simple.SetActiveView(view)
    simple.SetActiveSource(measure)
    return view, table, measure


def compare_before_and_after(optimized=None):
    """The mesh before and after a Mesh Optimize filter: bad elements in the translucent body, and both histograms.

    The two cameras move together. Measured as the filter measures, sizes and metric left out. Returns the layout.
    """
    optimized = _source(optimized)
    if optimized.GetXMLName() != "MeshOptimize":
        raise ValueError("choose a Mesh Optimize filter to compare its input with its output")
    layout = simple.CreateLayout("Before and after")
    right = layout.SplitHorizontal(0, 0.5) + 1
    places = [layout.SplitVertical(place, 0.65) for place in (right - 1, right)]
    views = []
    for name, source, place in (("before", optimized.Input, places[0]), ("after", optimized, places[1])):
        measure = _measured(simple.MeshQualityMinMax(Input=source), QualityMeasure=optimized.QualityMeasure)
        view, chart = simple.CreateView("RenderView"), simple.CreateView("XYBarChartView")
        simple.AssignViewToLayout(view, layout, place)
        simple.AssignViewToLayout(chart, layout, place + 1)
        _show_body(measure, view)
        bad = simple.Threshold(Input=measure, Scalars=["CELLS", "MeshQuality"], LowerThreshold=BAD,
                               ThresholdMethod="Below Lower Threshold")
        bad.UpdatePipeline()
        count = bad.GetDataInformation().GetNumberOfCells()
        if count:
            _show_bad(bad, view)
        bars = simple.Show(simple.OutputPort(measure, 2), chart)
        bars.UseIndexForXAxis, bars.XArrayName, bars.SeriesVisibility = 0, "BinCenter", ["Count"]
        chart.ChartTitle = f"{name}: worst {measure.MinimumQuality:.4f}, {count} under {BAD}"
        chart.BottomAxisTitle, chart.LeftAxisTitle, chart.ShowLegend = "quality", "elements", 0
        views.append(view)
    simple.ResetCamera(views[0])
    simple.AddCameraLink(views[0], views[1], "Before and after")
    for name in ("CameraPosition", "CameraFocalPoint", "CameraViewUp", "CameraParallelScale", "CenterOfRotation"):
        setattr(views[1], name, getattr(views[0], name))
    simple.SetActiveView(views[1])
    simple.SetActiveSource(optimized)
    return layout
