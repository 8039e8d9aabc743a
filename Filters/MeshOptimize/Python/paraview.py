# SPDX-License-Identifier: BSD-3-Clause
"""Views of a mesh in ParaView (pvpython, pvbatch, the window's Python Shell), with the plugin loaded.

    from meshoptimize.paraview import compare_before_and_after, show_histogram, show_history, show_worst_elements
    show_worst_elements(mesh)              # any source; without one: the active source
    show_histogram(mesh)
    compare_before_and_after(optimized)    # a Mesh Optimize filter
    show_history(optimized)

The buttons of the plugin's toolbar call them. In ParaView's trace each is one line.
"""
import contextlib
import math
import re

from paraview import servermanager, simple

BAD = 0.3  # elements under it are shown in comparisons
PALE, INK = [0.72, 0.78, 0.85], [0.12, 0.16, 0.22]


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
    display.Ambient = 0.4  # so that colours stay apart in the shade
    display.EdgeColor = INK
    display.SetScalarBarVisibility(view, True)


def _source(source):
    source = source or simple.GetActiveSource()
    if source is None:
        raise ValueError("there is no active source: choose one in the pipeline browser")
    return source


def _optimized(source, what):
    source = _source(source)
    if source.GetXMLName() != "MeshOptimize":
        raise ValueError("choose a Mesh Optimize filter " + what)
    return source


@contextlib.contextmanager
def _traced(function, source, **options):
    """What happens inside is one call in ParaView's trace, if there is one."""
    if not servermanager.vtkSMTrace.GetActiveTracer():
        yield
        return
    from paraview import smtrace

    name = str(smtrace.Trace.get_accessor(source))
    words = ", ".join([name, *(f"{option}={value!r}" for option, value in options.items())])
    text = f"from meshoptimize.paraview import {function}\n{function}({words})"
    try:
        smtrace._create_trace_item_internal("TraceText", [text])
        silence = smtrace._create_trace_item_internal("BlockTraceItems")
    except smtrace.Untraceable:  # inside of something else that is traced
        silence = None
    try:
        yield
    finally:
        del silence  # traced again


def _look(view, centre, size, flat):
    """From the front, the right and above; on a mesh in a plane from above."""
    view.CameraFocalPoint = centre
    view.CameraPosition = [centre[0] + (0 if flat else size), centre[1] - (0 if flat else 2 * size), centre[2] + size]
    view.CameraViewUp = [0, 1, 0] if flat else [0, 0, 1]


def _finish(source, *views):
    """Draws the views, which the window does not by itself; the first one and the source are the active ones."""
    for view in views:
        simple.Render(view)
    simple.SetActiveView(views[0])
    simple.SetActiveSource(source)


def _arrange(name, view, table=None):
    """Puts the view into a layout of its own, the table under it."""
    layout = simple.CreateLayout(name)
    simple.AssignViewToLayout(view, layout, 0)
    if table:
        simple.AssignViewToLayout(table, layout, layout.SplitVertical(0, 0.7) + 1)


def _show_bars(measure, chart):
    """Logarithmic, or the few bad elements could not be seen beside the many others."""
    simple.Show(simple.OutputPort(measure, 2), chart)  # its columns: ParaViewPlugin/Charts.xml
    chart.BottomAxisTitle, chart.LeftAxisTitle, chart.ShowLegend = "quality", "elements", 0
    counts = servermanager.Fetch(measure, idx=2).GetColumnByName("Count")
    elements = sum(counts.GetValue(k) for k in range(counts.GetNumberOfTuples()))
    chart.LeftAxisLogScale = chart.LeftAxisUseCustomRange = 1  # a bin without elements has no logarithm
    chart.LeftAxisRangeMinimum, chart.LeftAxisRangeMaximum = 0.5, 10 ** math.ceil(math.log10(max(elements, 2)))


def show_worst_elements(source=None, number=10):
    """The mesh translucent, its worst elements solid in it, the camera on the worst one, and a table of them.

    Returns the view, the spreadsheet and the Mesh Quality Min Max filter that both show. Rows that are selected in the
    table are selected in the view.
    """
    source = _source(source)
    with _traced("show_worst_elements", source, number=number):
        return _show_worst_elements(source, number)


def _show_worst_elements(source, number):
    measure = _measured(source, NumberOfWorstCells=number)
    worst = simple.OutputPort(measure, 3)
    view, table = simple.CreateView("RenderView"), simple.CreateView("SpreadSheetView")
    _show_body(measure, view)
    _show_bad(worst, view)
    table.FieldAssociation = "Cell Data"
    simple.Show(worst, table)
    bounds = measure.GetDataInformation().GetBounds()
    centre = servermanager.Fetch(measure, idx=3).GetCellData().GetArray("Center").GetTuple3(0)
    size = math.dist(bounds[::2], bounds[1::2])
    view.CenterOfRotation = centre
    _look(view, centre, size, bounds[4] == bounds[5])
    view.CameraParallelProjection = 1
    view.CameraParallelScale = 0.3 * size
    _arrange("Worst elements", view, table)
    _finish(measure, view, table)
    return view, table, measure


def compare_before_and_after(optimized=None):
    """The mesh before and after a Mesh Optimize filter: bad elements in the translucent body, and both histograms.

    The two cameras move together. Measured as the filter measures, sizes and metric left out. Returns the layout.
    """
    optimized = _optimized(optimized, "to compare its input with its output")
    with _traced("compare_before_and_after", optimized):
        return _compare_before_and_after(optimized)


def _compare_before_and_after(optimized):
    views, charts = [], []
    for name, source in (("before", optimized.Input), ("after", optimized)):
        measure = _measured(simple.MeshQualityMinMax(Input=source), QualityMeasure=optimized.QualityMeasure)
        view, chart = simple.CreateView("RenderView"), simple.CreateView("XYBarChartView")
        _show_body(measure, view)
        bad = simple.Threshold(Input=measure, Scalars=["CELLS", "MeshQuality"], LowerThreshold=BAD,
                               ThresholdMethod="Below Lower Threshold")
        bad.UpdatePipeline()
        count = bad.GetDataInformation().GetNumberOfCells()
        if count:
            _show_bad(bad, view)
        _show_bars(measure, chart)
        _title(chart, f"{name}: worst {measure.MinimumQuality:.4f}, {count} under {BAD}")
        views.append(view)
        charts.append(chart)
    bounds = measure.GetDataInformation().GetBounds()
    _look(views[0], [(low + high) / 2 for low, high in zip(bounds[::2], bounds[1::2])],
          math.dist(bounds[::2], bounds[1::2]), bounds[4] == bounds[5])
    layout = simple.CreateLayout("Before and after")
    right = layout.SplitHorizontal(0, 0.5) + 1
    places = [layout.SplitVertical(place, 0.65) for place in (right - 1, right)]
    for view, chart, place in zip(views, charts, places):
        simple.AssignViewToLayout(view, layout, place)
        simple.AssignViewToLayout(chart, layout, place + 1)
    simple.ResetCamera(views[0])
    simple.AddCameraLink(views[0], views[1], "Before and after")
    for name in ("CameraPosition", "CameraFocalPoint", "CameraViewUp", "CameraParallelScale", "CenterOfRotation"):
        setattr(views[1], name, getattr(views[0], name))
    _finish(optimized, views[1], views[0], *charts)
    return layout


def _title(chart, text):
    """In letters of which a hundred fit into 800 pixels; a longer line is cut off on both sides."""
    chart.ChartTitle, chart.ChartTitleFontSize = text, 14


def show_histogram(source=None):
    """How many elements have which quality, as bars. Returns the view and the Mesh Quality Min Max filter."""
    source = _source(source)
    with _traced("show_histogram", source):
        measure = _measured(source)
        chart = simple.CreateView("XYBarChartView")
        _show_bars(measure, chart)
        _title(chart, f"worst {measure.MinimumQuality:.4f}, mean {measure.MeanQuality:.4f}")
        _arrange("Histogram", chart)
        _finish(measure, chart)
        return chart, measure


def show_history(optimized=None):
    """The worst and the mean quality after each pass of a Mesh Optimize filter, as lines. Returns the view."""
    optimized = _optimized(optimized, "to see what its passes did")
    with _traced("show_history", optimized):
        optimized.UpdatePipeline()
        optimized.UpdatePropertyInformation()
        chart = simple.CreateView("XYChartView")
        simple.Show(simple.OutputPort(optimized, 1), chart)  # its columns: ParaViewPlugin/Charts.xml
        reason = re.split("[;:]", optimized.StopReason)[0]  # what holds the worst cell has no room here
        _title(chart, f"worst {optimized.WorstQualityBefore:.4f} -> {optimized.WorstQualityAfter:.4f}: {reason}")
        chart.BottomAxisTitle, chart.LeftAxisTitle = "pass", "quality"
        chart.LeftAxisUseCustomRange, chart.LeftAxisRangeMinimum, chart.LeftAxisRangeMaximum = 1, 0, 1
        chart.LegendLocation = "TopLeft"
        _arrange("History", chart)
        _finish(optimized, chart)
        return chart
