# SPDX-License-Identifier: BSD-3-Clause
"""vtkMeshOptimizeFilter from Python: the real pellet, numpy in and out, files, events, enums."""
import os
import sys
import tempfile

import numpy as np
from meshoptimize import vtkMeshOptimizeFilter
from vtkmodules.numpy_interface import dataset_adapter as dsa
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkIntArray, vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkCellArray, vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkFiltersCore import vtkDelaunay3D
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

PELLET = os.path.join(os.environ["MESHOPTIMIZE_DATA"], "crack40.vtu")


def read(path):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    assert reader.GetOutput().GetNumberOfCells() > 0, path
    return reader.GetOutput()


def shape(grid):
    """The paper's S (2.3) of all cells, straight from its definition."""
    x = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)[cells(grid)]
    a, b, c = x[:, 1] - x[:, 0], x[:, 2] - x[:, 0], x[:, 3] - x[:, 0]
    volume = np.einsum("ij,ij->i", np.cross(a, b), c) / 6.0
    edges = sum(np.linalg.norm(x[:, i] - x[:, j], axis=1) for i in range(4) for j in range(i))
    return 1296.0 * np.sqrt(2.0) * volume / edges**3


def cells(grid):
    return vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)


def two_tetrahedra():
    """Built from numpy: 64-bit connectivity that belongs to Python."""
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1.0]])
    grid = vtkUnstructuredGrid()
    p, array = vtkPoints(), vtkCellArray()
    p.SetData(numpy_to_vtk(points, deep=1))
    array.SetData(4, numpy_to_vtkIdTypeArray(np.array([0, 1, 2, 3, 1, 2, 3, 4]), deep=1))
    grid.SetPoints(p)
    grid.SetCells(VTK_TETRA, array)
    return grid


def test_pellet():
    before = read(PELLET)
    coordinates = vtk_to_numpy(before.GetPoints().GetData()).copy()
    f = vtkMeshOptimizeFilter()
    f.SetInputData(before)
    f.SetTargetQuality(0.3)
    f.Update()
    after = f.GetOutput()
    s = shape(after)
    assert abs(s.min() - f.GetWorstQualityAfter()) < 1e-12
    assert abs(shape(before).min() - f.GetWorstQualityBefore()) < 1e-12
    assert f.GetWorstQualityAfter() > 0.25 > 0.01 > f.GetWorstQualityBefore()
    quality = vtk_to_numpy(after.GetCellData().GetArray("MeshQuality"))
    assert np.allclose(quality, s, rtol=0, atol=1e-12)
    assert (vtk_to_numpy(before.GetPoints().GetData()) == coordinates).all()
    history = f.GetOutputDataObject(1)
    worst = vtk_to_numpy(history.GetColumnByName("Worst"))
    assert worst[0] == f.GetWorstQualityBefore() and worst[-1] == f.GetWorstQualityAfter()
    assert (np.diff(worst) >= 0).all()
    assert history.GetColumnByName("Stage").GetValue(0) == "input"

    # To a file and back: the same numbers.
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "optimized.vtu")
        writer = vtkXMLUnstructuredGridWriter()
        writer.SetFileName(path)
        writer.SetInputConnection(f.GetOutputPort())
        writer.SetDataModeToBinary()
        assert writer.Write() == 1
        again = read(path)
    assert (cells(again) == cells(after)).all()
    assert (vtk_to_numpy(again.GetPoints().GetData()) == vtk_to_numpy(after.GetPoints().GetData())).all()
    assert again.GetFieldData().GetAbstractArray("StopReason").GetValue(0) == f.GetStopReasonAsString()


def test_stuck_cells_spoil_no_others():
    """Random points and their hull: many cells are stuck at the hull. They rise as far as it allows, and the rest is not spoilt for them."""
    before = after = tried = cells = 0
    reached = []
    for seed in range(6):
        points, cloud, delaunay = vtkPoints(), vtkPolyData(), vtkDelaunay3D()
        points.SetData(numpy_to_vtk(np.random.default_rng(seed).normal(size=(200, 3)), deep=1))
        cloud.SetPoints(points)
        delaunay.SetInputData(cloud)
        f = vtkMeshOptimizeFilter()
        f.SetInputConnection(delaunay.GetOutputPort())
        f.Update()
        reached.append(f.GetWorstQualityAfter() / f.GetQualityBound())
        before += np.count_nonzero(shape(f.GetInput()) < f.GetTargetQuality())
        after += np.count_nonzero(shape(f.GetOutput()) < f.GetTargetQuality())
        history = f.GetOutputDataObject(1)
        tried += sum(history.GetColumnByName("NodeMotionTried").GetValue(row) for row in range(history.GetNumberOfRows()))
        cells += f.GetInput().GetNumberOfCells()
    # One alone may end a few hundredths lower: which one, any change of the order of tries decides.
    assert min(reached) > 0.96 and np.mean(reached) > 0.99, reached
    # Passes that creep end: before they did, such a mesh took more than 44 tries to move a node for each cell.
    assert tried < 35 * cells, f"{tried} tries to move a node"
    # They would be fewer if a small mesh might waste more (CostModel.h): .6 with five times as much.
    assert after < 0.75 * before, f"{before} cells under the target before, {after} after"


def test_no_stage_is_past_a_low_target():
    """Also where the worst cells are polished and repaired again and again."""
    points, cloud, delaunay = vtkPoints(), vtkPolyData(), vtkDelaunay3D()
    points.SetData(numpy_to_vtk(np.random.default_rng(5).normal(size=(200, 3)), deep=1))
    cloud.SetPoints(points)
    delaunay.SetInputData(cloud)
    f = vtkMeshOptimizeFilter()
    f.SetInputConnection(delaunay.GetOutputPort())
    f.SetTargetQuality(0.1)
    f.Update()
    names = f.GetOutputDataObject(1).GetColumnByName("Stage")
    stages = [names.GetValue(row) for row in range(names.GetNumberOfValues())]
    assert f.GetWorstQualityAfter() >= 0.1
    assert not [stage for stage in stages if "towards 0.30" in stage], stages


def test_reproducible():
    """The same bytes twice, from another filter object."""
    grid = read(PELLET)
    outputs = []
    for threads in (0, 1):
        f = vtkMeshOptimizeFilter()
        f.SetInputData(grid)
        f.SetTargetQuality(0.2)
        f.SetNumberOfThreads(threads)
        f.Update()
        o = f.GetOutput()
        outputs.append(vtk_to_numpy(o.GetPoints().GetData()).tobytes() + cells(o).tobytes()
                       + vtk_to_numpy(o.GetCellData().GetArray("MeshQuality")).tobytes())
    assert outputs[0] == outputs[1]


def test_names():
    f = vtkMeshOptimizeFilter()
    assert f.GetAlgorithm() == vtkMeshOptimizeFilter.WorstFirst and f.GetEffort() == vtkMeshOptimizeFilter.Default
    f.SetAlgorithmToPaper1996()
    assert f.GetAlgorithm() == vtkMeshOptimizeFilter.Paper1996 == 0
    f.SetAlgorithmToWorstFirst()
    assert f.GetAlgorithm() == vtkMeshOptimizeFilter.WorstFirst == 1
    for value, name in enumerate(("Shape", "RadiusRatio", "MeanRatio", "MinimumSine", "WarpedSine", "VolumeLength")):
        getattr(f, "SetQualityMeasureTo" + name)()
        assert f.GetQualityMeasure() == getattr(vtkMeshOptimizeFilter, name) == value
    for value, name in enumerate(("Quick", "Default", "Best")):
        getattr(f, "SetEffortTo" + name)()
        assert f.GetEffort() == getattr(vtkMeshOptimizeFilter, name) == value
    assert f.GetStopReason() == vtkMeshOptimizeFilter.NotRun
    assert "WorstQualityAfter: 0" in str(f)


def test_small_meshes_and_arrays():
    grid = two_tetrahedra()
    adapted = dsa.WrapDataObject(grid)
    adapted.PointData.append(np.arange(5.0), "number")
    adapted.CellData.append(np.array([1, 2]), "region")
    f = vtkMeshOptimizeFilter()
    f.SetInputData(grid)
    f.SetRegionArray("region")
    f.Update()
    out = dsa.WrapDataObject(f.GetOutput())
    assert (out.PointData["number"] == np.arange(5.0)).all()
    assert list(out.CellData["region"]) == [1, 2]
    assert (out.Points == adapted.Points).all()
    f.SetInputArrayToProcess(0, 0, 0, 1, "region")  # the same, as ParaView does it
    f.Update()
    assert list(dsa.WrapDataObject(f.GetOutput()).CellData["region"]) == [1, 2]


def test_errors():
    """One message, seen by an observer; the output is empty and the error code tells."""
    grid = two_tetrahedra()
    region = vtkDoubleArray()
    region.SetName("region")
    for _ in range(2):
        region.InsertNextValue(1.5)
    grid.GetCellData().AddArray(region)
    messages = []
    f = vtkMeshOptimizeFilter()
    observer = lambda caller, event, text: messages.append(text)  # noqa: E731
    observer.CallDataType = "string0"
    f.AddObserver("ErrorEvent", observer)
    f.GetExecutive().AddObserver("ErrorEvent", observer)
    f.SetInputData(grid)
    f.SetRegionArray("region")
    f.Update()
    assert len(messages) == 1 and "region" in messages[0] and "double" in messages[0], messages
    assert f.GetErrorCode() != 0
    assert f.GetOutput().GetNumberOfCells() == 0
    good = vtkIntArray()
    good.SetName("region")
    good.InsertNextValue(1)
    good.InsertNextValue(1)
    grid.GetCellData().AddArray(good)
    grid.Modified()
    f.Update()
    assert len(messages) == 1 and f.GetErrorCode() == 0
    assert f.GetOutput().GetNumberOfCells() >= 2


def test_progress_and_abort():
    grid = read(PELLET)
    f = vtkMeshOptimizeFilter()
    f.SetInputData(grid)
    seen = []

    def on_progress(caller, event):
        seen.append(caller.GetProgress())
        if len(seen) == 2:
            caller.SetAbortExecute(1)

    f.AddObserver("ProgressEvent", on_progress)
    f.Update()
    assert f.GetStopReason() == vtkMeshOptimizeFilter.Aborted
    assert seen == sorted(seen)
    assert f.GetOutput().GetNumberOfCells() > 50000
    assert shape(f.GetOutput()).min() >= shape(grid).min()


if __name__ == "__main__":
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            print(name, flush=True)
            test()
    sys.exit(0)
