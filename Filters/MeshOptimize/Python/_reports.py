# SPDX-License-Identifier: BSD-3-Clause
"""What a run did, and how good a mesh is: plain values and numpy arrays."""
import dataclasses
import math

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from ._properties import snake_case

QUALITY_ARRAYS = ("MeshQuality", "MinimumDihedralAngle")  # degrees have a name of their own

def columns(table):
    """The columns of a vtkTable as arrays, by their names. Copies."""
    arrays = {}
    for index in range(table.GetNumberOfColumns()):
        column = table.GetColumn(index)
        if column.IsA("vtkDataArray"):
            arrays[column.GetName()] = vtk_to_numpy(column).copy()
        else:
            arrays[column.GetName()] = np.array([column.GetValue(row) for row in range(column.GetNumberOfValues())])
    return arrays


def _json_value(value):
    if isinstance(value, dict):
        return {key: _json_value(entry) for key, entry in value.items()}
    if isinstance(value, (np.ndarray, list)):
        return [_json_value(entry) for entry in (value.tolist() if isinstance(value, np.ndarray) else value)]
    return None if isinstance(value, float) and not math.isfinite(value) else value


class _Report:
    def as_dict(self):
        """All of it in lists, numbers and strings, for JSON; what is not a number is None."""
        return {field.name: _json_value(getattr(self, field.name)) for field in dataclasses.fields(self)}


def _arrays():
    """A field of arrays, which repr() leaves out."""
    return dataclasses.field(repr=False)


@dataclasses.dataclass(frozen=True, eq=False)
class OptimizeReport(_Report):
    """What `optimize` did. `print(report)` shows the main figures.

    Attributes
    ----------
    worst_before, worst_after, mean_before, mean_after : float
        Qualities before and after; 1 is the regular element, 0 a flat one, below 0 an inverted one.
    bound : float
        Certified: no mesh with this surface has a worst quality above it. 1 where none is known.
    stop_reason : str
        Why the run ended, in a sentence.
    stop : str
        The same in a word: target_reached, capped_by_surface, no_further_gain, iteration_limit, time_limit_reached,
        aborted, nothing_to_do, growth_limit.
    aborted : bool
        Ctrl-C ended the run, or the progress callback asked for it; the mesh is as good as it was by then.
    seconds : float
        Time in the optimizer.
    cells_before, cells_after, points_before, points_after : int
        Of the whole grid, cells that pass through among them.
    capped_cells, inverted_before, inverted_after, operations : int
    evaluations : int
        Qualities and gradients that were computed: what the run cost, whatever the machine.
    surface_distance : float
        A length: how far the surface may be from where it was, proved; 0 unless tetrahedra slide.
    volume_change, edge_length_share : float
        The change of the volume relative to that before; the fraction of edges that are about as long as wanted.
    history : dict of numpy arrays
        A row for each pass: Pass, Stage, Worst, Mean, BelowTarget, Cells, Points, and the operations tried and done;
        and Block where the mesh is several.
    histogram_before, histogram_after : dict of numpy arrays
        A row for each bin: BinCenter, BinLow, BinHigh, Count.
    """

    worst_before: float
    worst_after: float
    mean_before: float
    mean_after: float
    bound: float
    stop_reason: str
    stop: str
    aborted: bool
    seconds: float
    cells_before: int
    cells_after: int
    points_before: int
    points_after: int
    capped_cells: int
    inverted_before: int
    inverted_after: int
    operations: int
    evaluations: int
    surface_distance: float
    volume_change: float
    edge_length_share: float
    history: dict = _arrays()
    histogram_before: dict = _arrays()
    histogram_after: dict = _arrays()

    def __str__(self):
        bound = f", at most {self.bound:.4f} with this surface" if self.bound < 1 else ""
        lines = [f"worst quality {self.worst_before:.4f} -> {self.worst_after:.4f}{bound}",
                 f"mean quality  {self.mean_before:.4f} -> {self.mean_after:.4f}",
                 f"cells {self.cells_before} -> {self.cells_after}, points {self.points_before} -> {self.points_after}",
                 f"{self.operations} operations in {self.seconds:.2f} s; {self.stop_reason}"]
        if self.inverted_before or self.inverted_after:
            lines.insert(1, f"inverted or flat {self.inverted_before} -> {self.inverted_after}")
        return "\n".join(lines)


@dataclasses.dataclass(frozen=True, eq=False)
class QualityReport(_Report):
    """How good a mesh is. `print(report)` shows the main figures.

    Attributes
    ----------
    minimum, maximum, mean, standard_deviation : float
        Over all triangles and tetrahedra; NaN if there are none.
    bound : float
        Certified: no mesh with this surface has a worst quality above it.
    cells, inverted, not_measurable, other_cells, capped_cells : int
        Measured cells and those of them that are inverted; cells with coordinates that are not finite; cells that are
        neither triangles nor tetrahedra; cells that the surface keeps under `target_quality`.
    summary : dict of numpy arrays
        A row for each region, and a last one for all.
    histogram : dict of numpy arrays
        A row for each bin: BinCenter, BinLow, BinHigh, Count.
    worst_cells : dict of numpy arrays
        Worst first: OriginalCellIds, MeshQuality (MinimumDihedralAngle if that is measured), Center of shape (n, 3);
        and Block where the mesh is several.
    """

    minimum: float
    maximum: float
    mean: float
    standard_deviation: float
    bound: float
    cells: int
    inverted: int
    not_measurable: int
    other_cells: int
    capped_cells: int
    summary: dict = _arrays()
    histogram: dict = _arrays()
    worst_cells: dict = _arrays()

    def __str__(self):
        lines = [f"worst quality {self.minimum:.4f}, mean {self.mean:.4f}, best {self.maximum:.4f}; "
                 f"with this surface the worst is at most {self.bound:.4f}",
                 f"{self.cells} elements, {self.inverted} inverted or flat, "
                 f"{self.capped_cells} kept low by the surface"]
        if self.not_measurable or self.other_cells:
            lines.append(f"not measured: {self.other_cells} other cells, "
                         f"{self.not_measurable} without finite coordinates")
        return "\n".join(lines)


def _stop_word(algorithm):
    names = {int(value): name for name, value in vars(type(algorithm)).items()
             if isinstance(value, type(algorithm).StopReasonType)}
    return snake_case(names[algorithm.GetStopReason()])


def report_of_run(algorithm, interrupted, before, after, histogram_before, histogram_after):
    """The report of a vtkMeshOptimizeFilter that has run from the grid `before` to the grid `after`."""
    stop = _stop_word(algorithm)
    return OptimizeReport(
        worst_before=algorithm.GetWorstQualityBefore(), worst_after=algorithm.GetWorstQualityAfter(),
        mean_before=algorithm.GetMeanQualityBefore(), mean_after=algorithm.GetMeanQualityAfter(),
        bound=algorithm.GetQualityBound(), stop_reason=algorithm.GetStopReasonAsString(), stop=stop,
        aborted=interrupted or stop == "aborted", seconds=algorithm.GetOptimizeSeconds(),
        cells_before=before.GetNumberOfCells(), cells_after=after.GetNumberOfCells(),
        points_before=before.GetNumberOfPoints(), points_after=after.GetNumberOfPoints(),
        capped_cells=algorithm.GetNumberOfCappedCells(),
        inverted_before=algorithm.GetNumberOfInvertedCellsBefore(),
        inverted_after=algorithm.GetNumberOfInvertedCellsAfter(),
        operations=algorithm.GetNumberOfOperations(), evaluations=algorithm.GetNumberOfEvaluations(),
        surface_distance=algorithm.GetSurfaceDistance(),
        volume_change=algorithm.GetVolumeChange(), edge_length_share=algorithm.GetEdgeLengthShare(),
        history=columns(algorithm.GetOutputDataObject(1)),
        histogram_before=histogram_before, histogram_after=histogram_after)


def report_of_quality(algorithm):
    """The report of a vtkMeshQualityMinMax that has run."""
    worst = algorithm.GetOutputDataObject(3).GetCellData()
    return QualityReport(
        minimum=algorithm.GetMinimumQuality(), maximum=algorithm.GetMaximumQuality(), mean=algorithm.GetMeanQuality(),
        standard_deviation=algorithm.GetStandardDeviation(), bound=algorithm.GetQualityBound(),
        cells=algorithm.GetNumberOfMeasuredCells(), inverted=algorithm.GetNumberOfInvertedCells(),
        not_measurable=algorithm.GetNumberOfNotMeasurableCells(), other_cells=algorithm.GetNumberOfOtherCells(),
        capped_cells=algorithm.GetNumberOfCappedCells(),
        summary=columns(algorithm.GetOutputDataObject(1)), histogram=columns(algorithm.GetOutputDataObject(2)),
        worst_cells={name: vtk_to_numpy(worst.GetArray(name)).copy()
                     for name in ("Block", "OriginalCellIds", *QUALITY_ARRAYS, "Center") if worst.GetArray(name)})
