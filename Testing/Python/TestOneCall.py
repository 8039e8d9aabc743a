# SPDX-License-Identifier: BSD-3-Clause
"""meshoptimize.optimize() and quality(): kinds of mesh, options, messages, progress, Ctrl-C, types, docstrings.

    /usr/bin/python3 Testing/Python/TestOneCall.py --write    brings the choices in __init__.pyi up to date
"""
import ast
import doctest
import inspect
import io
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import warnings
from contextlib import redirect_stderr

import meshoptimize
import numpy as np
from meshoptimize import _api, _files, _progress
from meshoptimize._properties import properties
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkUnstructuredGrid

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PELLET = os.path.join(os.environ.get("MESHOPTIMIZE_DATA", SOURCE / "Data"), "crack40.vtu")
PACKAGE = pathlib.Path(meshoptimize.__file__).parent
# pvpython names a program that is not there
PYTHON = sys.executable if os.access(sys.executable, os.X_OK) else shutil.which("python3", path="/usr/bin")
CALLS = {"optimize": meshoptimize.vtkMeshOptimizeFilter, "quality": meshoptimize.vtkMeshQualityMinMax}
SQUARE = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0.5, 0.02]]), np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])


def raised(kind, call, *words):
    """The text of what the call raises, which has these words."""
    try:
        call()
    except kind as error:
        assert type(error) is kind and all(word in str(error) for word in words), error
        return str(error)
    raise AssertionError(f"no {kind.__name__} about {words}")


def arrays_of(grid):
    """The bytes of everything in a grid."""
    arrays = [grid.GetPoints().GetData(), grid.GetCells().GetConnectivityArray(), grid.GetCells().GetOffsetsArray()]
    for attributes in (grid.GetPointData(), grid.GetCellData()):
        arrays += [attributes.GetArray(k) for k in range(attributes.GetNumberOfArrays())]
    return [vtk_to_numpy(array).tobytes() for array in arrays]


def test_grid():
    class Grid(vtkUnstructuredGrid):  # as PyVista's
        pass

    before = Grid()
    before.ShallowCopy(meshoptimize.read(PELLET))
    note = numpy_to_vtk(np.array([7.0]), deep=1)
    note.SetName("note")
    before.GetFieldData().AddArray(note)
    content, time = arrays_of(before), before.GetMTime()
    after, report = meshoptimize.optimize(before, target_quality=0.3, effort="quick")
    assert type(after) is Grid and after.GetCellData().HasArray("MeshQuality")
    assert report.worst_before < 0.01 < 0.25 < report.worst_after <= report.bound < 1
    assert not before.GetCellData().HasArray("MeshQuality")
    vtk_to_numpy(after.GetPoints().GetData())[:] = 0  # the result is the caller's own
    assert arrays_of(before) == content and before.GetMTime() == time
    unchanged, _ = meshoptimize.optimize(before, target_quality=0.001)
    for array in (unchanged.GetPoints().GetData(), unchanged.GetFieldData().GetArray("note")):
        vtk_to_numpy(array)[:] = 0
    assert arrays_of(before) == content and before.GetFieldData().GetArray("note").GetValue(0) == 7
    assert report.cells_before == before.GetNumberOfCells() and report.cells_after == after.GetNumberOfCells()
    assert report.history["Worst"][-1] == report.worst_after and report.history["Stage"][0] == "input"
    assert report.histogram_before["Count"].sum() == report.cells_before
    assert report.histogram_before["Count"][0] > 0 == report.histogram_after["Count"][0]
    assert f"{report.worst_before:.4f} -> {report.worst_after:.4f}" in str(report) and report.stop_reason in str(report)
    assert len(repr(report)) < 1000 and isinstance(report.as_dict()["history"]["Worst"], list)


def test_arrays():
    points, cells = SQUARE[0].astype(np.float32), SQUARE[1].astype(np.int32)
    (new_points, new_cells), report = meshoptimize.optimize((points, cells), insert_nodes=False)
    assert new_points.shape == (5, 2) and new_cells.shape == (4, 3) and new_cells.dtype == np.int32
    assert (new_points[:4] == points[:4]).all() and points[4, 1] == np.float32(0.02)
    assert report.stop == "target_reached" and report.worst_after > 0.6 > 0.1 > report.worst_before
    for wrong in ((np.zeros(3), cells), (points, np.zeros((2, 5), int)), (points, cells.astype(float))):
        raised(ValueError, lambda: meshoptimize.optimize(wrong), "shape")
    raised(TypeError, lambda: meshoptimize.optimize(vtkPolyData()), "vtkPolyData", "vtkUnstructuredGrid")


def test_arrays_of_beginners():
    """What works: any order, precision and kind of sequence. What does not: one sentence that says what to do."""
    points, cells = SQUARE
    frozen = points.copy(), cells.copy()
    for array in frozen:
        array.flags.writeable = False
    wanted = meshoptimize.optimize(SQUARE)[1].worst_after
    for given in (frozen, (points.tolist(), cells.tolist()), [points, cells.astype(np.uint64)],
                  (np.asfortranarray(points), np.asfortranarray(cells)), (points.astype(">f8"), cells.astype(">i4")),
                  (np.repeat(points, 2, axis=0)[::2], np.repeat(cells, 2, axis=0)[::2])):
        assert meshoptimize.optimize(given)[1].worst_after == wanted, given
    for call in (meshoptimize.optimize, meshoptimize.quality):
        for wrong, words in (((points, cells + 1), ("1 to 5", "counted from 1?")), ((points, cells - 1), ("-1 to 3",)),
                             ((points, cells + 2**40), ("1099511627776",)), ((points, [[0, 1, 2], [0, 1]]), ("length",)),
                             ((points, np.column_stack([np.full(4, 3), cells]).ravel()), ("shape (16,)", "leave out")),
                             ((points, np.array([[4, 0, 1, 2, 3]])), ("shape (1, 5)", "[:, 1:]")),
                             ((points.astype(str), cells), ("points must be numbers",)), ((points.T, cells), ("(2, 5)",))):
            text = raised(ValueError, lambda: call(wrong), *words)
            assert "\n" not in text, text
        broken = np.where(points == 0.02, np.nan, points), cells
        if call is meshoptimize.optimize:
            raised(meshoptimize.MeshOptimizeError, lambda: call(broken), "Point 4", "not finite")
        else:
            assert call(broken).not_measurable == 4
        raised(TypeError, lambda: call("in.vtu"), "meshoptimize.read('in.vtu')")
        raised(TypeError, lambda: call(points), "ndarray")
    raised(ValueError, lambda: meshoptimize.write((points, cells + 1), "/nowhere/none.vtu"), "counted from 1?")


def test_quality():
    report = meshoptimize.quality(meshoptimize.read(PELLET), number_of_worst_cells=4)
    assert report.worst_cells["MeshQuality"][0] == report.minimum and report.worst_cells["Center"].shape == (4, 3)
    assert report.histogram["Count"].sum() == report.cells == report.summary["Count"][-1]
    assert f"{report.minimum:.4f}" in str(report)
    try:
        report.minimum = 1.0
    except AttributeError:  # frozen
        return
    raise AssertionError("a report can be changed")


def test_triangles_beside_tetrahedra_are_not_measured():
    grid = vtkUnstructuredGrid()
    grid.DeepCopy(meshoptimize.read(PELLET))
    alone = meshoptimize.quality(grid)
    corners = grid.GetCell(0).GetPointIds()
    grid.InsertNextCell(5, 3, [corners.GetId(0), corners.GetId(1), corners.GetId(2)])
    beside = meshoptimize.quality(grid)
    assert (alone.cells, alone.mean, alone.minimum) == (beside.cells, beside.mean, beside.minimum)


def test_options():
    """Every property of both classes is an option, and reaches the filter."""
    for cls in CALLS.values():
        found = properties(cls)
        for prop in found.values():
            values = {"choice": [*prop.choices, *prop.choices.values()], "switch": [True, False, np.bool_(True)],
                      "array": ["name", None], "data": [vtkPolyData()]}.get(prop.kind, [prop.default, prop.low])
            for value in values:
                f = cls()
                prop.set(f, value)
                if prop.kind not in ("array", "data"):
                    assert getattr(f, "Get" + prop.name)() == prop.choices.get(value, value), (prop, value)
        assert {"target_quality", "quality_measure", "region_array"} <= found.keys()
        assert not {"abort_execute", "input_data", "controller", "debug"} & found.keys()
    assert {"effort", "boundary_mode", "move_nodes", "geometry", "patch_array"} <= properties(CALLS["optimize"]).keys()
    f = CALLS["optimize"]()
    for text in ("Worst First", "worst-first", "WorstFirst", "WORST_FIRST"):
        f.SetAlgorithm(0)
        properties(CALLS["optimize"])["algorithm"].set(f, text)
        assert f.GetAlgorithm() == 1, text


def test_wrong_options():
    call = lambda **options: lambda: meshoptimize.optimize(SQUARE, **options)  # noqa: E731
    raised(TypeError, call(target_qualty=0.5), "target_qualty", "'target_quality'")
    raised(TypeError, call(zzz=0.5), "zzz")
    raised(ValueError, call(effort="bset"), "'bset'", "'quick', 'default', 'best'", "mean 'best'")
    for options, words in (({"effort": 3}, "best"), ({"target_quality": 1.5}, "0 to 1"),
                           ({"number_of_layers": 0.5}, "whole"),
                           ({"target_quality": float("nan")}, "0 to 1"), ({"move_nodes": 2}, "True or False"),
                           ({"time_limit": -1}, "from 0"), ({"beta": "much"}, "number"), ({"region_array": 7}, "array"),
                           ({"geometry": 7}, "vtkPolyData")):
        raised(ValueError, call(**options), *options, words)


def test_errors_and_warnings():
    """The filter's text, and nothing on the standard error: neither Python's nor VTK's."""
    code = ("import sys, meshoptimize\n"
            "try: meshoptimize.optimize(meshoptimize.read(sys.argv[1]), region_array='nothing')\n"
            "except meshoptimize.MeshOptimizeError as error: print(error)\n")
    result = subprocess.run([PYTHON, "-c", code, PELLET], capture_output=True, text=True)
    # Not on stderr, where others may write: hwloc does in a chroot.
    assert "region array" not in result.stderr and result.stdout.startswith("The region array 'nothing'"), result
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        meshoptimize.optimize(SQUARE, desired_size=0.1)
    assert len(seen) == 1 and "Beta is 0" in str(seen[0].message) and "0x" not in str(seen[0].message)
    assert seen[0].filename == __file__
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        _, report = meshoptimize.optimize(vtkUnstructuredGrid())
    assert report.stop == "nothing_to_do" and len(seen) <= 1, seen


def test_progress():
    seen = []
    meshoptimize.optimize(meshoptimize.read(PELLET), progress=lambda fraction, text: seen.append((fraction, text)))
    assert len(seen) > 2 and seen == sorted(seen, key=lambda entry: entry[0]) and seen[-1][0] == 1
    assert any("worst element" in text for _, text in seen)
    text = io.StringIO()
    with redirect_stderr(text):
        bars = _progress._tqdm_bar, _progress._rich_bar
        try:
            _progress._tqdm_bar = _progress._rich_bar = not_installed
            meshoptimize.optimize(meshoptimize.read(PELLET), progress_bar=True)
        finally:
            _progress._tqdm_bar, _progress._rich_bar = bars
    assert "100 % worst element" in text.getvalue()


def not_installed():
    raise ImportError


def test_progress_that_raises():
    seen = []

    def progress(fraction, text):
        seen.append(fraction)
        raise ZeroDivisionError("mine")

    raised(ZeroDivisionError, lambda: meshoptimize.optimize(meshoptimize.read(PELLET), progress=progress), "mine")
    assert len(seen) == 1  # and not again


def test_ctrl_c():
    """A signal during the run: the mesh is there, the program goes on, and the handler is as before."""
    if signal.getsignal(signal.SIGINT) is None:
        print("skipped: in pvpython the signal is not Python's")
        return
    mine = lambda number, frame: None  # noqa: E731
    before = signal.signal(signal.SIGINT, mine)
    try:
        mesh, report = meshoptimize.optimize(meshoptimize.read(PELLET), effort="best", progress=interrupt_soon())
        assert report.aborted and report.stop == "aborted" and report.worst_after >= report.worst_before
        assert mesh.GetNumberOfCells() > 50000 and not meshoptimize.quality(mesh).inverted
        assert signal.getsignal(signal.SIGINT) is mine
        raised(meshoptimize.MeshOptimizeError, lambda: meshoptimize.optimize(mesh, region_array="nothing"))
        assert signal.getsignal(signal.SIGINT) is mine
    finally:
        signal.signal(signal.SIGINT, before)


def interrupt_soon():
    calls = []

    def progress(fraction, text):
        calls.append(fraction)
        if len(calls) == 2:
            os.kill(os.getpid(), signal.SIGINT)

    return progress


def test_other_threads():
    """Only the main thread can handle signals; elsewhere a call works without."""
    results = []
    thread = threading.Thread(target=lambda: results.append(meshoptimize.optimize(SQUARE)[1]))
    thread.start()
    thread.join()
    assert results[0].worst_after > 0.6


def test_other_vtk():
    with tempfile.TemporaryDirectory() as folder:
        package = pathlib.Path(folder) / "meshoptimize"
        package.mkdir()
        shutil.copy(PACKAGE / "__init__.py", package)
        (package / "_built_with.py").write_text('VTK_VERSION = "1.2.3"\n')
        result = subprocess.run([PYTHON, "-c", "import meshoptimize"], capture_output=True, text=True,
                                env={**os.environ, "PYTHONPATH": folder})
    from meshoptimize._built_with import VTK_VERSION

    last = result.stderr.strip().splitlines()[-1]
    assert result.returncode == 1 and last.startswith("ImportError: ") and "1.2.3" in last and VTK_VERSION in last, last


def choices(prop):
    return f"Literal[{prop.values}] | int"


def write_choices():
    """Writes the choices that the classes have to where __init__.pyi has others."""
    page = SOURCE / "Filters/MeshOptimize/Python/__init__.pyi"
    parts = re.split(r"(?=^def )", page.read_text(), flags=re.MULTILINE)
    for k, part in enumerate(parts):
        for name, cls in CALLS.items():
            for prop in properties(cls).values() if part.startswith(f"def {name}(") else ():
                part = re.sub(rf"(?<= {prop.keyword}: )Literal\[.*\] \| int", lambda _: choices(prop).replace("'", '"'), part)
        parts[k] = part
    page.write_text("".join(parts))


def test_types():
    """__init__.pyi has the options, choices, defaults, report fields and names that there are."""
    tree = ast.parse((PACKAGE / "__init__.pyi").read_text())
    functions = {node.name: node for node in tree.body if isinstance(node, ast.FunctionDef)}
    classes = {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}
    for name, cls in CALLS.items():
        given = functions[name].args
        shown = {a.arg: (ast.unparse(a.annotation), ast.literal_eval(default))
                 for a, default in zip(given.kwonlyargs, given.kw_defaults)}
        signature = inspect.signature(getattr(meshoptimize, name)).parameters
        assert [a.arg for a in (*given.args, *given.kwonlyargs)] == list(signature), name
        for prop in properties(cls).values():
            annotation, default = shown[prop.keyword]
            assert default == prop.shown_default == signature[prop.keyword].default, prop
            expected = {"switch": "bool", "whole": "int", "real": "float", "array": "str | None",
                        "data": "vtkPolyData | None"}.get(prop.kind, choices(prop))
            assert annotation == expected, (prop, annotation)
    for report in (meshoptimize.OptimizeReport, meshoptimize.QualityReport):
        fields = [node.target.id for node in classes[report.__name__].body if isinstance(node, ast.AnnAssign)]
        assert fields == list(report.__dataclass_fields__), report
    public = {name for name, value in vars(meshoptimize).items() if not name.startswith("_")
              and getattr(value, "__module__", "").startswith("meshoptimize")}
    assert public | {"vtkTetGenFilter"} == {*functions, *classes} - {"_Report"} | {"vtkTetGenFilter"}


def test_types_of_views():
    """paraview.pyi has the public names, parameters and defaults of paraview.py, and what it returns. Read, not imported."""
    def public(name):
        nodes = ast.parse((PACKAGE / name).read_text()).body
        functions = {node.name: node for node in nodes if isinstance(node, ast.FunctionDef) and node.name[0] != "_"}
        assigned = [node for node in nodes if isinstance(node, (ast.Assign, ast.AnnAssign))]
        names = {part.id for node in assigned for target in getattr(node, "targets", [getattr(node, "target", None)])
                 for part in ast.walk(target) if isinstance(part, ast.Name)}
        return functions, {name for name in names if name[0] != "_"}

    (functions, names), (shown, shown_names) = public("paraview.py"), public("paraview.pyi")
    assert functions.keys() == shown.keys() and names == shown_names, (functions.keys() ^ shown.keys(), names ^ shown_names)
    for name, function in functions.items():
        given, typed = function.args, shown[name].args
        assert [a.arg for a in given.args] == [a.arg for a in typed.args], name
        assert [ast.dump(d) for d in given.defaults] == [ast.dump(d) for d in typed.defaults], name
        assert all(a.annotation for a in typed.args) and shown[name].returns, name


def test_docstrings():
    if not hasattr(sys.stdout, "encoding"):
        print("skipped: doctest does not work in pvpython")
        return
    for module in (_api, _files):
        result = doctest.testmod(module)
        assert result.attempted >= 5 and not result.failed, result
    for prop in properties(CALLS["optimize"]).values():
        assert f"{prop.keyword} : {prop.values}" in meshoptimize.optimize.__doc__


if __name__ == "__main__":
    if "--write" in sys.argv[1:]:
        write_choices()
        sys.exit(0)
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            print(name, flush=True)
            test()
    sys.exit(0)
