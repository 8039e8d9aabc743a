# SPDX-License-Identifier: BSD-3-Clause
"""The calls optimize() and quality()."""
import contextlib
import inspect
import textwrap

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import VTK_QUADRATIC_TETRA, VTK_QUADRATIC_TRIANGLE, VTK_TETRA, VTK_TRIANGLE

from . import _progress
from ._grids import grids_of, kinds_of, shallow_copy
from ._meshes import adapter
from ._properties import make, properties
from ._reports import columns, report_of_quality, report_of_run
from ._run import run
from .vtkFiltersMeshOptimize import vtkMeshOptimizeFilter, vtkMeshQualityMinMax


def _elements_only(data):
    """Flags triangles as hidden, so that they do not count, where there are tetrahedra: those are what is optimized."""
    for grid in grids_of(data):
        _tetrahedra_only(grid)


def _tetrahedra_only(grid):
    kinds = kinds_of(grid)
    beside = np.isin(kinds, (VTK_TRIANGLE, VTK_QUADRATIC_TRIANGLE))
    if beside.any() and np.isin(kinds, (VTK_TETRA, VTK_QUADRATIC_TETRA)).any():
        flags = grid.GetCellData().GetArray("vtkGhostType")
        flags = vtk_to_numpy(flags).copy() if flags else np.zeros(len(kinds), np.uint8)
        flags[beside] |= 32  # vtkDataSetAttributes::HIDDENCELL
        array = numpy_to_vtk(flags, deep=1)
        array.SetName("vtkGhostType")
        grid.GetCellData().AddArray(array)


def _histogram(mesh, options):
    """Measured as the run measures: with those of its options that measuring has."""
    grid = shallow_copy(mesh)
    _elements_only(grid)
    shared = {key: value for key, value in options.items() if key in properties(vtkMeshQualityMinMax)
              and key not in ("region_array", "target_quality")}
    measure = make(vtkMeshQualityMinMax, {**shared, "compute_bound": False})
    measure.SetInputDataObject(grid)
    if run(measure, warn=False):  # the run itself has warned
        raise KeyboardInterrupt
    return columns(measure.GetOutputDataObject(2))


def _prepare(cls, mesh, options):
    """The adapter of the mesh, and the filter with its input."""
    make(cls, options)  # a wrong option is said before the mesh is looked at
    adapted = adapter(mesh)
    algorithm = make(cls, {**adapted.options, **options})
    algorithm.SetInputDataObject(adapted.grid)
    return adapted, algorithm


def optimize(mesh, *, progress_bar=False, progress=None, **options):
    """Raise the worst element quality of a mesh of tetrahedra or triangles.

    Parameters
    ----------
    mesh : vtkUnstructuredGrid, blocks of them, meshio.Mesh or a pair of arrays (points, cells)
        Blocks are a vtkMultiBlockDataSet, vtkPartitionedDataSet or vtkPartitionedDataSetCollection; faces that two
        blocks share stay. Also a class derived from these that can be made without arguments, such as PyVista's.
        Points are of shape (n, 3) or (n, 2), in any unit; cells are integers of shape (m, 4) for tetrahedra or (m, 3) for
        triangles. Triangles lie in one plane. The mesh is not changed.
    progress_bar : bool, default False
        Show a bar: tqdm's or rich's where one is installed, else a plain one.
    progress : callable, optional
        progress(fraction, text) is called during the run, fraction from 0 to 1. What it raises ends the run.
    **options
        See below. More about them: Filters/REFERENCE.md, and help(meshoptimize.vtkMeshOptimizeFilter). A meshio mesh
        with several groups of tetrahedra has `region_array` set to them, unless it is given.

    Returns
    -------
    mesh
        Of the kind of the input, with the cell array MeshQuality if it can have arrays.
    report : OptimizeReport

    Raises
    ------
    TypeError
        An option that does not exist, or a mesh of another kind.
    ValueError
        A value that is not allowed, arrays of another shape, or cells of points that are not there.
    MeshOptimizeError
        The mesh or an array cannot be used; the text is the filter's.

    Warns
    -----
    UserWarning
        What the filter warns of, and what a meshio mesh loses.

    Notes
    -----
    Ctrl-C ends the run, not the program: the mesh comes back as good as it is by then, and `report.aborted` is True.
    This is so in the main thread, and not in pvpython, which has a handler of its own.

    Examples
    --------
    A square of four triangles whose inner point lies badly:

    >>> import numpy as np
    >>> import meshoptimize
    >>> points = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0.5, 0.02]])
    >>> cells = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    >>> (new_points, new_cells), report = meshoptimize.optimize((points, cells), insert_nodes=False)
    >>> print(f"{report.worst_before:.2f} -> {report.worst_after:.2f}, {report.stop}")
    0.05 -> 0.71, target_reached
    >>> new_points.shape, new_cells.shape
    ((5, 2), (4, 3))

    Choices are words, and what is wrong is said:

    >>> meshoptimize.optimize((points, cells), effort="bests")
    Traceback (most recent call last):
    ValueError: effort is 'bests'; it must be 'quick', 'default', 'best'; did you mean 'best'?
    >>> meshoptimize.optimize((points, cells), target=0.6)
    Traceback (most recent call last):
    TypeError: there is no option 'target'; did you mean 'target_quality'?
    """
    adapted, algorithm = _prepare(vtkMeshOptimizeFilter, mesh, options)
    with _progress.bar() if progress_bar else contextlib.nullcontext() as bar:
        interrupted = run(algorithm, _both(progress, bar))
    output = algorithm.GetOutputDataObject(0)
    report = report_of_run(algorithm, interrupted, adapted.grid, output,
                           _histogram(adapted.grid, options), _histogram(output, options))
    return adapted.back(output), report


def _both(first, second):
    calls = [call for call in (first, second) if call]
    return (lambda fraction, text: [call(fraction, text) for call in calls]) if calls else None


def quality(mesh, **options):
    """Measure the quality of every element of a mesh: of the tetrahedra, or of triangles where there are none.

    Parameters
    ----------
    mesh : vtkUnstructuredGrid, blocks of them, meshio.Mesh or a pair of arrays (points, cells)
        As for `optimize`.
    **options
        See below.

    Returns
    -------
    report : QualityReport

    Raises
    ------
    TypeError, ValueError, MeshOptimizeError
        As `optimize`.

    Examples
    --------
    >>> import numpy as np
    >>> import meshoptimize
    >>> points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
    >>> report = meshoptimize.quality((points, np.array([[0, 1, 2, 3]])), quality_measure="minimum_dihedral_angle")
    >>> print(f"{report.minimum:.2f} degrees")
    54.74 degrees
    """
    adapted, algorithm = _prepare(vtkMeshQualityMinMax, mesh, options)
    _elements_only(adapted.grid)
    if run(algorithm):
        raise KeyboardInterrupt
    return report_of_quality(algorithm)


def _describe(function, cls):
    """Brings the filter's properties into the signature and the docstring of the function."""
    given = [parameter for parameter in inspect.signature(function).parameters.values()
             if parameter.kind is not inspect.Parameter.VAR_KEYWORD]
    known = properties(cls).values()
    function.__signature__ = inspect.Signature(given + [
        inspect.Parameter(prop.keyword, inspect.Parameter.KEYWORD_ONLY, default=prop.shown_default) for prop in known])
    lines = ["", "    Other Parameters", "    ----------------"]
    for prop in known:
        lines += [f"    {prop.keyword} : {prop.values}, default {prop.shown_default!r}",
                  *textwrap.wrap(prop.description, 100, initial_indent=8 * " ", subsequent_indent=8 * " ")]
    function.__doc__ += "\n".join(lines) + "\n    "


_describe(optimize, vtkMeshOptimizeFilter)
_describe(quality, vtkMeshQualityMinMax)
