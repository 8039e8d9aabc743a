# SPDX-License-Identifier: BSD-3-Clause
"""meshoptimize.read() and write(): VTK's formats, and what is wrong with files."""
import os
import subprocess
import sys

import meshoptimize
import numpy as np
from each_test import run_each
from meshoptimize import _files
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

ONE = np.eye(4, 3), np.array([[3, 0, 1, 2]])
PELLET = os.path.join(os.environ["MESHOPTIMIZE_DATA"], "crack40.vtu")


def raised(kind, call, *words):
    try:
        call()
    except kind as error:
        assert all(word in str(error) for word in words), error
        return
    raise AssertionError(f"no {kind.__name__} about {words}")


def content(grid):
    arrays = grid.GetPoints().GetData(), grid.GetCells().GetConnectivityArray()
    return [vtk_to_numpy(array).tobytes() for array in arrays]


def test_vtk_formats(folder):
    grid = meshoptimize.read(PELLET)
    for suffix in _files.VTK_FORMATS:
        path = folder / ("pellet" + suffix)
        meshoptimize.write(grid, path)
        assert content(meshoptimize.read(path)) == content(grid), suffix
    assert sorted(path.name for path in folder.iterdir()) == ["pellet.vtk", "pellet.vtu"]  # no part is left


def test_arrays(folder):
    meshoptimize.write(ONE, folder / "one.vtu")
    assert meshoptimize.read(folder / "one.vtu").GetNumberOfCells() == 1


def test_wrong_files(folder):
    raised(FileNotFoundError, lambda: meshoptimize.read(folder / "none.vtu"), "none.vtu")
    raised(ValueError, lambda: meshoptimize.read(folder / "some.xyz"), ".xyz", ".msh")
    raised(ValueError, lambda: meshoptimize.write(ONE, folder / "some.xyz"), ".xyz")
    for name in ("bad.vtu", "bad.vtk"):
        (folder / name).write_text("nothing of the kind\n")
        raised(meshoptimize.MeshOptimizeError, lambda: meshoptimize.read(folder / name), name)
    raised((meshoptimize.MeshOptimizeError, OSError),
           lambda: meshoptimize.write(ONE, folder / "no" / "one.vtu"), "one.vtu")


def test_silence(folder):
    """Messages are in the exception, and nothing is on the standard error."""
    (folder / "bad.vtu").write_text("nothing of the kind\n")
    code = ("import sys, meshoptimize\ntry: meshoptimize.read(sys.argv[1])\n"
            "except meshoptimize.MeshOptimizeError as error: print(error)\n")
    result = subprocess.run([sys.executable, "-c", code, folder / "bad.vtu"], capture_output=True, text=True)
    assert result.stderr == "" and "syntax error" in result.stdout and len(result.stdout) < 400, result


def test_raw_appended_data(folder):
    """Debian's VTK does not read the default of its own writer; another VTK may."""
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputDataObject(meshoptimize.read(PELLET))
    writer.SetFileName(str(folder / "raw.vtu"))
    writer.EncodeAppendedDataOff()
    writer.Write()
    try:
        assert meshoptimize.read(folder / "raw.vtu").GetNumberOfCells() > 50000
    except meshoptimize.MeshOptimizeError as error:
        assert "SetDataModeToBinary" in str(error), error


def test_without_meshio(folder):
    """The message says what to install."""
    (folder / "some.msh").write_text("")
    imported, sys.modules["meshio"] = sys.modules.get("meshio"), None
    try:
        raised(meshoptimize.MeshOptimizeError, lambda: meshoptimize.read(folder / "some.msh"), "python3-meshio")
        raised(meshoptimize.MeshOptimizeError, lambda: meshoptimize.write(ONE, folder / "new.msh"), "python3-meshio")
    finally:
        del sys.modules["meshio"]
        if imported:
            sys.modules["meshio"] = imported


if __name__ == "__main__":
    run_each(globals())
