# SPDX-License-Identifier: BSD-3-Clause
# Types of the calls. Testing/Python/TestOneCall.py holds the options, choices and defaults against the classes.
import os
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal, TypeVar

from numpy import ndarray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkPolyDataAlgorithm, vtkUnstructuredGridAlgorithm

_Mesh = TypeVar("_Mesh")  # vtkUnstructuredGrid, blocks of them, meshio.Mesh, (points, cells): the same comes back
_Path = str | os.PathLike[str]

class MeshOptimizeError(RuntimeError): ...

class _Report:
    def as_dict(self) -> dict[str, Any]: ...

@dataclass(frozen=True, eq=False)
class OptimizeReport(_Report):
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
    history: dict[str, ndarray]
    histogram_before: dict[str, ndarray]
    histogram_after: dict[str, ndarray]

@dataclass(frozen=True, eq=False)
class QualityReport(_Report):
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
    summary: dict[str, ndarray]
    histogram: dict[str, ndarray]
    worst_cells: dict[str, ndarray]

def optimize(
    mesh: _Mesh,
    *,
    progress_bar: bool = False,
    progress: Callable[[float, str], object] | None = None,
    algorithm: Literal["paper1996", "worst_first"] | int = "worst_first",
    target_quality: float = 0.6,
    quality_measure: Literal["shape", "radius_ratio", "mean_ratio", "minimum_sine", "warped_sine", "volume_length"] | int = "shape",
    beta: float = 0.0,
    desired_size: float = 0.0,
    neighborhood_level: int = 1,
    maximum_number_of_iterations: int = 0,
    epsilon: float = 0.02,
    armijo_factor: float = 0.01,
    maximum_number_of_alternations: int = 20,
    move_nodes: bool = True,
    reconnect: bool = True,
    insert_nodes: bool = True,
    remove_nodes: bool = True,
    look_ahead: bool = True,
    effort: Literal["quick", "default", "best"] | int = "default",
    number_of_threads: int = 0,
    growth_budget: float = 0.15,
    optimize_below: float = 0.0,
    number_of_layers: int = 2,
    boundary_mode: Literal["fixed", "slide"] | int = "fixed",
    boundary_curve: Literal["straight", "bspline"] | int = "bspline",
    corner_angle: float = 45.0,
    feature_angle: float = 45.0,
    keep_features: bool = True,
    surface_tolerance: float = 0.001,
    tolerance_is_absolute: bool = False,
    geometry: vtkPolyData | None = None,
    time_limit: float = 0.0,
    region_array: str | None = None,
    fixed_point_array: str | None = None,
    size_array: str | None = None,
    metric_array: str | None = None,
    corner_array: str | None = None,
    patch_array: str | None = None,
    optimize_borders: bool = True,
    number_of_ghost_levels: int = 0,
) -> tuple[_Mesh, OptimizeReport]: ...

def quality(
    mesh: Any,
    *,
    quality_measure: Literal["shape", "radius_ratio", "mean_ratio", "minimum_sine", "warped_sine", "volume_length", "minimum_dihedral_angle"] | int = "shape",
    beta: float = 0.0,
    desired_size: float = 0.0,
    number_of_worst_cells: int = 10,
    number_of_bins: int = 20,
    compute_bound: bool = True,
    target_quality: float = 0.6,
    region_array: str | None = None,
    size_array: str | None = None,
    metric_array: str | None = None,
) -> QualityReport: ...

def read(path: _Path) -> Any: ...
def write(mesh: Any, path: _Path) -> None: ...

class vtkMeshOptimizeFilter(vtkUnstructuredGridAlgorithm):
    def __getattr__(self, name: str) -> Any: ...  # SetName(), GetName() of each property
class vtkMeshQualityMinMax(vtkUnstructuredGridAlgorithm):
    def __getattr__(self, name: str) -> Any: ...  # SetName(), GetName() of each property
class vtkSolutionMetricFilter(vtkUnstructuredGridAlgorithm):
    def __getattr__(self, name: str) -> Any: ...  # SetName(), GetName() of each property
class vtkTetGenFilter(vtkUnstructuredGridAlgorithm):  # only where the module was built with TetGen
    def __getattr__(self, name: str) -> Any: ...  # SetName(), GetName() of each property
class vtkThermoelasticFilter(vtkUnstructuredGridAlgorithm):
    def __getattr__(self, name: str) -> Any: ...  # SetName(), GetName() of each property
