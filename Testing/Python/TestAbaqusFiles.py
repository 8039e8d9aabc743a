# SPDX-License-Identifier: BSD-3-Clause
"""Abaqus input files: sets in all ways that there are, types of elements, what is left out, what cannot be read.

Skipped (77) where meshio is not installed.
"""
import os
import warnings

import numpy as np
from each_test import run_each
from TestMeshioFiles import GROUPS, POINTS, N, check_groups, volume  # which is skipped without meshio

import meshoptimize

ABAQUS = """*HEADING
a cube
*NODE, NSET=everything
{nodes}
*ELEMENT, TYPE=B31
{line}
*ELEMENT, TYPE=S3R, ELSET=bottom
{bottom}
*ELEMENT, TYPE=M3D3
{border}
*ELEMENT, TYPE=C3D4,
 ELSET=LEFT
{left}
*ELEMENT, TYPE=C3D4
{right}
*ELSET, ELSET=border, GENERATE
{border_first}, {border_last}, 1
*Elset, elset=edge
{edge_a}
*ELSET, ELSET=Edge
{edge_b}
*ELSET, ELSET=right
{right_ids}
*ELSET, ELSET=both
left, right
*NSET, NSET=held
{held}
*NSET, NSET=sensor
{sensor}
*MATERIAL, NAME=steel
*ELASTIC
210000., 0.3
"""


def abaqus_file(path):
    """Sets in all the ways that an input file has; numbers with gaps."""
    rows = {"nodes": [f"{10 * k + 10}, " + ", ".join(map(repr, map(float, p))) for k, p in enumerate(POINTS)]}
    first, ids = 1, {}
    for name, (_, nodes, group) in zip(("line", "bottom", "border", "left", "right"), GROUPS):
        ids[name] = range(first, first + len(nodes))
        rows[name] = [", ".join(map(str, (number, *(10 * cell + 10)))) for number, cell in zip(ids[name], nodes)]
        first += len(nodes) + 100
    inside = np.flatnonzero(((POINTS > 0.2) & (POINTS < 0.45)).all(axis=1))[0]
    path.write_text(ABAQUS.format(
        border_first=ids["border"][0], border_last=ids["border"][-1], edge_a=", ".join(map(str, ids["line"][:3])),
        edge_b=", ".join(map(str, ids["line"][3:])), right_ids=",\n".join(map(str, ids["right"])),
        held=",\n".join(str(10 * k + 10) for k in np.flatnonzero(POINTS[:, 2] == 0)), sensor=10 * inside + 10,
        **{name: "\n".join(lines) for name, lines in rows.items()}))
    return POINTS[inside]


def test_abaqus(folder):
    path = folder / "cube.inp"
    sensor = abaqus_file(path)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        mesh = meshoptimize.read(path)
        result, _ = meshoptimize.optimize(mesh, fixed_point_array="sensor (set)")
    assert (mesh.points == POINTS).all()
    assert (result.points[result.point_sets["sensor"]] == sensor).all() and len(result.point_sets["sensor"]) == 1
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        before = meshoptimize.read(path)
        result, report = meshoptimize.optimize(before)
        meshoptimize.write(result, folder / "out.inp")
        after = meshoptimize.read(folder / "out.inp")
    assert "*ELASTIC, *MATERIAL" in str(seen[0].message), seen[0]
    for one in (before, after):
        one.cell_sets["left"] = one.cell_sets.pop("LEFT")
    check_groups(before, after)
    assert report.worst_before < 0.2 < 0.5 < report.worst_after
    both = zip(after.cells, after.cell_sets["both"])
    assert abs(sum(volume(after.points[block.data[ids]]) for block, ids in both if block.type == "tetra") - 1) < 1e-9
    held = lambda mesh: set(map(tuple, mesh.points[mesh.point_sets["held"]]))  # noqa: E731
    assert held(before) == held(after) and len(held(after)) == (N + 1) ** 2
    assert len(after.point_sets["everything"]) == len(after.points)
    assert after.info == before.info == {"abaqus:types": ["B31", "S3R", "M3D3", "C3D4", "C3D4"]}


def test_abaqus_files_that_cannot_be_read(folder):
    path = folder / "cube.inp"
    abaqus_file(path)
    text = path.read_text()
    for old, new, word in (("TYPE=B31", "TYPE=XYZ9", "XYZ9"), ("*NODE", "*INCLUDE, INPUT=other.inp\n*NODE", "includes"),
                           ("left, right", "left, wrong", "wrong"), ("1, 10, ", "1, 11, ", "not there"),
                           ("*NODE, NSET=everything\n", "*NODE\n10, 0, 0, 0\n", "twice")):
        assert old in text, old
        path.write_text(text.replace(old, new))
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                meshoptimize.read(path)
        except meshoptimize.MeshOptimizeError as error:
            assert word in str(error), error
        else:
            raise AssertionError(f"{new} is read")


if __name__ == "__main__":
    os.environ.setdefault("NO_COLOR", "1")
    run_each(globals())
