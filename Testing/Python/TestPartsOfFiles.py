# SPDX-License-Identifier: BSD-3-Clause
"""Several grids in one call: composite data of VTK come back as they are, and so do files of blocks and of pieces."""
import os
import shutil
import subprocess
import sys
import warnings

import meshoptimize
import numpy as np
from each_test import run_each
from meshoptimize._grids import grids_of, names_of_leaves, simplices, vtk_points
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import (vtkCompositeDataSet, vtkMultiBlockDataSet, vtkPartitionedDataSet,
                                           vtkPartitionedDataSetCollection, vtkPolyData, vtkUnstructuredGrid)

NAME = vtkCompositeDataSet.NAME()


def cube(x, height=0.1, size=4):
    """Tetrahedra of a cube; one layer of points lies badly."""
    axis = np.arange(size + 1.0)
    points = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), -1).reshape(-1, 3)
    points[points[:, 2] == 2, 2] = np.where((points[points[:, 2] == 2][:, :2] % size == 0).any(axis=1), 2, 1 + height)
    at = lambda i, j, k: (i * (size + 1) + j) * (size + 1) + k  # noqa: E731
    cells = []
    for i, j, k in np.ndindex(size, size, size):
        for a, b in (((1, 0, 0), (1, 1, 0)), ((1, 0, 0), (1, 0, 1)), ((0, 1, 0), (1, 1, 0)), ((0, 1, 0), (0, 1, 1)),
                     ((0, 0, 1), (1, 0, 1)), ((0, 0, 1), (0, 1, 1))):
            cells.append([at(i + u, j + v, k + w) for u, v, w in ((0, 0, 0), a, b, (1, 1, 1))])
    cells = np.array(cells)
    turned = np.linalg.det(points[cells[:, 1:]] - points[cells[:, :1]]) < 0
    cells[turned] = cells[turned][:, [1, 0, 2, 3]]
    grid = simplices(vtk_points(points + [x, 0, 0]), cells)
    material = numpy_to_vtk(np.full(len(cells), int(x)), deep=1)
    material.SetName("material")
    grid.GetCellData().AddArray(material)
    note = numpy_to_vtk(np.array([x]), deep=1)
    note.SetName("note")
    grid.GetFieldData().AddArray(note)
    return grid


def multi_block(kind=vtkMultiBlockDataSet):
    data = kind()
    data.SetBlock(0, cube(1))
    data.SetBlock(2, cube(9))  # 1 is empty
    inner = vtkMultiBlockDataSet()
    inner.SetBlock(0, cube(17))
    data.SetBlock(3, inner)
    for index, name in ((0, "fuel"), (2, "clad"), (3, "rest")):
        data.GetMetaData(index).Set(NAME, name)
    return data


def partitioned():
    data = vtkPartitionedDataSet()
    data.SetPartition(0, cube(1))
    data.SetPartition(1, cube(9))
    return data


def collection():
    data = vtkPartitionedDataSetCollection()
    data.SetPartition(0, 0, cube(1))
    data.SetPartition(1, 0, cube(9))
    data.SetPartition(1, 1, cube(17))
    for index, name in enumerate(("fuel", "clad")):
        data.GetMetaData(index).Set(NAME, name)
    return data


NAMES = {multi_block: {1: "fuel", 3: "clad", 4: "rest", 5: "rest"}, partitioned: {},
         collection: {1: "fuel", 2: "fuel", 3: "clad", 4: "clad", 5: "clad"}}


def content(data):
    return [vtk_to_numpy(array).tobytes() for grid in grids_of(data)
            for array in (grid.GetPoints().GetData(), grid.GetCells().GetConnectivityArray())]


def check_data(data, size):
    """The grids are in their order, each with its data."""
    grids = grids_of(data)
    assert len(grids) == size
    for grid, x in zip(grids, (1, 9, 17)):
        assert set(vtk_to_numpy(grid.GetCellData().GetArray("material"))) == {x}
        assert grid.GetFieldData().GetArray("note").GetValue(0) == x
        low, high = grid.GetBounds()[:2]
        assert (low, high) == (x, x + 4)


def raised(kind, call, *words):
    try:
        call()
    except kind as error:
        assert all(word in str(error) for word in words) and "\n" not in str(error), error
        return
    raise AssertionError(f"no {kind.__name__} about {words}")


def run(name, *arguments, status=0):
    done = subprocess.run([sys.executable, "-m", "meshoptimize", name, *map(str, arguments)],
                          capture_output=True, text=True)
    assert done.returncode == status and "Traceback" not in done.stderr, done
    return done


def test_calls(folder):
    class Blocks(vtkMultiBlockDataSet):  # as PyVista's
        pass

    for make in (*NAMES, lambda: multi_block(Blocks)):
        before = make()
        was = content(before)
        after, report = meshoptimize.optimize(before, target_quality=0.5)
        assert type(after) is type(before) and content(before) == was != content(after)
        assert names_of_leaves(after) == names_of_leaves(before) == NAMES.get(make, NAMES[multi_block])
        check_data(after, len(grids_of(before)))
        worst = [meshoptimize.quality(grid).minimum for grid in grids_of(after)]
        assert report.worst_before < 0.2 < 0.5 < report.worst_after == min(worst), (report, worst)
        assert report.cells_before == sum(grid.GetNumberOfCells() for grid in grids_of(before))
        assert report.cells_after == report.histogram_after["Count"].sum() == meshoptimize.quality(after).cells
        assert len(set(report.history["Block"])) == len(worst)
        assert not grids_of(before)[0].GetCellData().HasArray("MeshQuality")
    assert set(meshoptimize.quality(multi_block()).worst_cells["Block"]) <= {1, 3, 5}


def test_an_error_names_the_block(folder):
    bad = cube(9)
    bad.GetPoints().SetPoint(62, np.nan, 0, 0)
    for data, name in ((multi_block(), "Block 3 (clad): "), (collection(), "Block 4 (clad): ")):
        leaf = grids_of(data)[1]
        leaf.ShallowCopy(bad)
        raised(meshoptimize.MeshOptimizeError, lambda: meshoptimize.optimize(data), name, "62")
    raised(TypeError, lambda: meshoptimize.optimize(vtkPolyData()), "vtkMultiBlockDataSet", "vtkPolyData")


def test_files(folder):
    for make, suffixes in ((multi_block, (".vtm", ".vtmb")), (partitioned, (".vtpd",)), (collection, (".vtpc",))):
        for suffix in suffixes:
            data, path = make(), folder / f"some{suffix}"
            meshoptimize.write(data, path)
            again = meshoptimize.read(path)
            assert isinstance(again, type(data)) and content(again) == content(data)
            assert names_of_leaves(again) == NAMES[make], (suffix, names_of_leaves(again))
            check_data(again, len(grids_of(data)))
            raised(ValueError, lambda: meshoptimize.write(data, folder / "other.vtu"), "other.vtu", suffix)
            raised(ValueError, lambda: meshoptimize.write(cube(1), path), "one grid")
    assert sorted(path.name for path in folder.iterdir()) == ["some", *(f"some{s}" for s in (
        ".vtm", ".vtmb", ".vtpc", ".vtpd"))]  # and nothing that was in between


def test_a_part_that_cannot_be_read(folder):
    meshoptimize.write(multi_block(), folder / "some.vtm")
    part = folder / "some" / "some_0.vtu"
    part.write_text("nothing of the kind\n")
    raised(meshoptimize.MeshOptimizeError, lambda: meshoptimize.read(folder / "some.vtm"), "some_0.vtu", "syntax error")
    part.unlink()
    raised(meshoptimize.MeshOptimizeError, lambda: meshoptimize.read(folder / "some.vtm"), "some_0.vtu")
    stderr = run("optimize", folder / "some.vtm", folder / "out.vtm", status=1).stderr
    assert "some.vtm" in stderr and "some_0.vtu" in stderr and len(stderr.splitlines()) == 1, stderr


def test_pieces(folder):
    """Ghosts do not count; the points of pieces are not joined."""
    path = folder / "some.pvtu"
    for x, number, file in ((1, 6, path), (5, 0, folder / "some_1.vtu")):  # they have a face in common
        grid = cube(x)
        ghosts = np.zeros(grid.GetNumberOfCells(), np.uint8)
        ghosts[:number] = 1
        array = numpy_to_vtk(ghosts, deep=1)
        array.SetName("vtkGhostType")
        grid.GetCellData().AddArray(array)
        meshoptimize.write(grid, file)
    text = path.read_text()
    path.write_text(text.replace('<Piece Source="some_0.vtu"/>', '<Piece Source="some_0.vtu"/><Piece Source="some_1.vtu"/>'))
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        again = meshoptimize.read(path)
    assert isinstance(again, vtkUnstructuredGrid) and again.GetNumberOfCells() == 2 * grid.GetNumberOfCells() - 6
    assert len(seen) == 1 and "ranks.py" in str(seen[0].message), seen
    for out in ("out.pvtu", "out.vtu"):
        result = run("optimize", path, folder / out, "--quiet")
        assert "faces between the pieces" in result.stderr and not result.stdout
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # one piece now
            after = meshoptimize.read(folder / out)
        assert meshoptimize.quality(after).minimum > 0.5
        points = vtk_to_numpy(after.GetPoints().GetData())
        middle = points[(points == [5, 2, 3]).all(axis=1)]
        assert len(middle) == 2, (out, middle)  # one of each piece, where it was


def test_commands(folder):
    source, out = folder / "in.vtm", folder / "out.vtm"
    meshoptimize.write(multi_block(), source)
    result = run("optimize", source, out)
    assert "in.vtm -> " in result.stdout and result.stdout.count("worst quality") == 1
    after = meshoptimize.read(out)
    assert names_of_leaves(after) == NAMES[multi_block] and meshoptimize.quality(after).minimum > 0.5
    check_data(after, 3)
    assert "--force" in run("optimize", source, out, status=2).stderr
    out.unlink()
    assert "out: already there" in run("optimize", source, out, status=2).stderr  # the parts are overwritten, too
    run("optimize", source, out, "--force", "--quiet")
    assert ".vtm" in run("optimize", source, folder / "out.vtu", status=2).stderr
    lines = run("quality", source, "--worst", 2).stdout.splitlines()
    assert lines[-1].split()[0] == "block" and lines[-1].split()[1] in ("1", "3", "5"), lines


def test_picture(folder):
    """A picture shows all blocks. It needs a display."""
    if not os.environ.get("DISPLAY") and not shutil.which("Xvfb"):
        print("skipped: there is no display, and no Xvfb")
        return
    meshoptimize.write(multi_block(), folder / "in.vtm")
    result = run("quality", folder / "in.vtm", "--picture", folder / "blocks.png")
    assert (folder / "blocks.png").stat().st_size > 10000, result


if __name__ == "__main__":
    run_each(globals())
