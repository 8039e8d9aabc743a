# SPDX-License-Identifier: BSD-3-Clause
"""What each option means where borders take part: rows of the table in Filters/RANKS.md that no other test has."""
import os
import sys

import numpy as np
from meshoptimize import vtkMeshOptimizeFilter
from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkStringArray, vtkVariantArray
from vtkmodules.vtkCommonDataModel import VTK_VERTEX, vtkMultiBlockDataSet

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # pvbatch does not
from ranks_case import Mesh, add, check, compare, corners, history, make_grid, rank, ranks, run, run_tests, tell


def alone(mesh, **options):
    return run(mesh.whole(), False, **options) if rank == 0 else None


def points_of(tets):
    return set(map(tuple, tets.reshape(-1, 3)))


def test_goals():
    """Target and measure are those of the whole; with more effort more is tried, and Best goes past the target."""
    mesh = Mesh()
    before = corners(mesh.whole())
    for options in ({"TargetQuality": 0.3}, *({"QualityMeasure": k, "TargetQuality": 0.3} for k in range(1, 6))):
        f, serial = run(mesh.piece(), **options), alone(mesh, **options)
        compare(f"goals {options}", f, before, serial)
        check(f.GetStopReason() == vtkMeshOptimizeFilter.TargetReached, f"goals {options}: {f.GetStopReasonAsString()}")
        check(0.3 <= f.GetWorstQualityAfter() < 0.35, f"goals {options}: {f.GetWorstQualityAfter()}")
    evaluations, worst = [], []
    for effort in range(3):
        f = run(mesh.piece(), Effort=effort)
        compare(f"effort {effort}", f, before)
        evaluations.append(f.GetNumberOfEvaluations())
        worst.append(f.GetWorstQualityAfter())
    check(evaluations[0] < evaluations[1] < evaluations[2], f"effort: {evaluations} evaluations")
    check(min(worst) >= 0.6 and worst[2] > worst[1], f"effort: {worst}")
    # The last run: past the target as far as alone, whatever the borders of the pieces would allow.
    compare("effort Best", f, before, alone(mesh, Effort=2))


def test_switches():
    """What is switched off is not tried, in the pieces and at the borders; what is left does something."""
    mesh = Mesh()
    before = corners(mesh.whole())
    everything = ("NodeMotion", "EdgeRemoval", "FaceRemoval", "EdgeContraction", "NodeInsertion", "Retriangulation",
                  "LookAhead")

    def tries(f):
        return {name: sum(map(int, history(f)[name + "Tried"])) for name in everything}
    f = run(mesh.piece())
    check(rank > 0 or all(tries(f)[name] for name in everything), f"with all: {tries(f)}, the test is too easy")
    for switch, columns in (("MoveNodes", ["NodeMotion"]), ("LookAhead", ["LookAhead"]), ("InsertNodes", ["NodeInsertion"]),
                            ("Reconnect", ["EdgeRemoval", "FaceRemoval"]), ("RemoveNodes", ["EdgeContraction"])):
        f = run(mesh.piece(), **{switch: 0})
        after = compare(f"without {switch}", f, before)
        if rank > 0:
            continue
        tried = tries(f)
        check(not any(tried[name] for name in columns), f"without {switch}: {tried}")
        check(sum(tried.values()) > 100 and f.GetWorstQualityAfter() > f.GetWorstQualityBefore(), f"without {switch}: {tried}")
        old, new = points_of(before), points_of(after)
        if switch == "RemoveNodes":
            check(len(new) >= len(old), f"without {switch}: {len(old)} points, then {len(new)}")
        if switch == "InsertNodes":
            check(len(new) <= len(old), f"without {switch}: {len(old)} points, then {len(new)}")
    f = run(mesh.piece(), InsertNodes=0, RemoveNodes=0, MoveNodes=0)
    after = compare("reconnection alone", f, before)
    check(points_of(after) == points_of(before) and len(after) != len(before), "reconnection alone: points")
    f = run(mesh.piece(), InsertNodes=0, RemoveNodes=0, Reconnect=0, LookAhead=0)
    after = compare("motion alone", f, before)
    check(len(after) == len(before) and points_of(after) != points_of(before), "motion alone: cells")


def test_paper():
    """The algorithm of 1996, in pieces and bands."""
    mesh = Mesh()
    kept = run(mesh.piece(), False, Algorithm=0)
    serial, f = alone(mesh, Algorithm=0), run(mesh.piece(), Algorithm=0)
    compare("paper", f, corners(mesh.whole()), serial)
    check(f.GetWorstQualityAfter() >= 0.6 > 2 * kept.GetWorstQualityAfter(),
          f"paper: {f.GetWorstQualityAfter()}, with the borders kept {kept.GetWorstQualityAfter()}")


def test_threads():
    """0 threads are those of the computer, divided by its ranks: the same bits as with one."""
    mesh = Mesh()
    one, all_of_them = run(mesh.piece()), run(mesh.piece(), NumberOfThreads=0)
    check(np.array_equal(corners(one.GetOutput()), corners(all_of_them.GetOutput())), "threads: other bits")


def test_strings():
    """Arrays of strings go with the cells that move."""
    mesh = Mesh()
    mesh.values["number"] = np.arange(len(mesh.cells))
    piece = mesh.piece()
    names, numbers = vtkStringArray(), vtk_to_numpy(piece.GetCellData().GetArray("number"))
    names.SetName("name")
    for number in numbers:
        names.InsertNextValue(f"cell {number}")
    piece.GetCellData().AddArray(names)
    f = run(piece)
    compare("strings", f, corners(mesh.whole()))
    data = f.GetOutput().GetCellData()
    wanted = [f"cell {number}" for number in vtk_to_numpy(data.GetArray("number"))]
    found = [data.GetAbstractArray("name").GetValue(k) for k in range(len(wanted))]
    check(found == wanted and len(found) > 100, "strings: they are other cells'")


def test_kept():
    """What is not built for borders: one warning that says why, and each rank optimizes its piece as with the switch off."""
    mesh = Mesh(n=4)
    mesh.points["size"] = np.full(len(mesh.x), 0.25)
    mesh.points["metric"] = np.tile([16.0, 16.0, 16.0, 0.0, 0.0, 0.0], (len(mesh.x), 1))

    def array(name):
        return {"before": lambda f: getattr(f, f"Set{name}Array")(name.lower())}

    def plain():
        return mesh.piece()

    def with_a_vertex():
        grid = mesh.piece()
        grid.InsertNextCell(VTK_VERTEX, 1, [0])
        return grid

    def with_an_array_on_one_rank():
        grid = mesh.piece()
        if rank == 0:
            add(grid.GetCellData(), "here", np.zeros(grid.GetNumberOfCells()))
        return grid

    def with_ids():
        grid = mesh.whole()  # of points only: an id of a cell on two ranks is an error
        ids = numpy_to_vtkIdTypeArray(np.arange(len(mesh.x)), deep=1)
        ids.SetName("ids")
        grid.GetPointData().SetGlobalIds(ids)
        return grid

    def with_variants():
        grid, values = mesh.piece(), vtkVariantArray()
        values.SetName("anything")
        values.SetNumberOfValues(grid.GetNumberOfCells())
        grid.GetCellData().AddArray(values)
        return grid

    for name, make, options, why in (
            ("one size", plain, {"Beta": 1.0, "DesiredSize": 0.25}, "sizes or a metric"),
            ("sizes", plain, {"Beta": 1.0, **array("Size")}, "sizes or a metric"),
            ("metric", plain, {"Beta": 1.0, "DesiredSize": 1.0, **array("Metric")}, "sizes or a metric"),
            ("vertex", with_a_vertex, {}, "other cells"),
            ("copies", mesh.whole, {}, "lie on each other"),
            ("copies with ids", with_ids, {}, "lie on each other"),
            ("array", with_an_array_on_one_rank, {}, "different arrays"),
            ("variants", with_variants, {}, "cannot be sent")):
        f = run(make(), **options)
        of_borders = [text for text in f.told if "borders between the ranks' pieces are kept" in text]
        check(f.GetErrorCode() == 0 and len(of_borders) == (rank == 0), f"kept, {name}: {f.told}")
        check(rank > 0 or why in of_borders[0], f"kept, {name}: {f.told}")
        off = run(make(), False, **options)
        count = f.GetOutput().GetNumberOfCells()
        check(0 < count == off.GetOutput().GetNumberOfCells(), f"kept, {name}: {count} cells")
        check(np.array_equal(vtk_to_numpy(f.GetOutput().GetPoints().GetData()),
                             vtk_to_numpy(off.GetOutput().GetPoints().GetData())), f"kept, {name}: other points")


def test_faces_alone():
    """A rank that has got nothing but faces of the mesh leaves them as they are, whatever the switch is: they are no plane mesh."""
    mesh = Mesh(n=5)
    face = mesh.cells[:, [0, 1, 2]][(mesh.node[mesh.cells[:, [0, 1, 2]]][:, :, 2] == 0).all(axis=1)]
    face = np.concatenate([face, [[0, 1, 7]]]) if len(face) == 0 else face
    grid = make_grid(mesh.x, face) if rank == 1 else mesh.whole()
    for everywhere in (True, False):
        f = run(grid, everywhere) if everywhere else filter_on_pieces(grid)
        check(f.GetErrorCode() == 0, f"faces alone: {f.told}")
        check(all("borders between the ranks' pieces are kept" in text for text in f.told), f"faces alone: {f.told}")
        if rank == 1:
            out = f.GetOutput()
            same = np.array_equal(vtk_to_numpy(out.GetPoints().GetData()), mesh.x) and out.GetNumberOfCells() == len(face)
            check(same, f"faces alone: {len(face)} cells, then {out.GetNumberOfCells()}, and other points")
            check(np.isnan(vtk_to_numpy(out.GetCellData().GetArray("MeshQuality"))).all(), "faces alone: they have been measured")
        else:
            check(f.GetWorstQualityAfter() > 0.5, f"faces alone: {f.GetWorstQualityAfter()}")


def filter_on_pieces(grid):
    """With the switch off, but asked for pieces."""
    f = vtkMeshOptimizeFilter()
    f.SetOptimizeBorders(False)
    f.SetInputData(grid)
    f.told = tell(f)
    f.UpdatePiece(rank, ranks, 0)
    return f


def test_slide():
    """Not built for tetrahedra: an error on every rank and no output, told once, whether the switch is on or off, in blocks too."""
    mesh = Mesh(n=4)
    empty = mesh.grid(np.zeros(len(mesh.cells), bool))

    def block(grid):
        data = vtkMultiBlockDataSet()
        data.SetBlock(0, grid)
        return data

    for name, grid in (("pieces", mesh.piece()), ("all on one rank", mesh.whole() if rank == 0 else empty),
                       ("blocks", block(mesh.piece()))):
        for everywhere in (True, False):
            f = vtkMeshOptimizeFilter()
            f.SetOptimizeBorders(everywhere)
            f.SetBoundaryMode(vtkMeshOptimizeFilter.Slide)
            f.SetInputDataObject(grid)
            told = tell(f)
            f.UpdatePiece(rank, ranks, 0)
            check(f.GetErrorCode() != 0, f"slide, {name}: no error")
            check(f.GetOutputDataObject(0).GetNumberOfElements(1) == 0, f"slide, {name}: cells come out")
            check(len(told) == (rank == 0), f"slide, {name}: {told}")
            reason = "tetrahedra slides on one rank only" if everywhere else "Slide needs the whole mesh in one piece"
            check(all(reason in text for text in told), f"slide, {name}: {told}")


run_tests(globals())
