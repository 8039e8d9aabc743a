# SPDX-License-Identifier: BSD-3-Clause
"""Gmsh, Medit and Nastran files: read, optimized, written, read again. Groups and sets are as before.

Skipped (77) where meshio is not installed.
"""
import itertools
import os
import sys
import warnings

import numpy as np
from each_test import run_each

try:
    import meshio
except ImportError:
    print("skipped: meshio is not installed (Debian: python3-meshio)")
    sys.exit(77)

import meshoptimize

LEFT, RIGHT, BOTTOM, BORDER, EDGE = 1, 2, 3, 4, 5  # groups: two volumes, two surfaces, a line
NAMES = {"left": (LEFT, 3), "right": (RIGHT, 3), "bottom": (BOTTOM, 2), "border": (BORDER, 2), "edge": (EDGE, 1)}
N = 6


def cube():
    """A cube of two materials, with bad elements: points, and (type, nodes, group) for each group."""
    grid = np.stack(np.meshgrid(*3 * [np.arange(N + 1)], indexing="ij"), axis=-1).reshape(-1, 3)
    index = lambda ijk: ijk @ [(N + 1) ** 2, N + 1, 1]  # noqa: E731
    corners = grid[(grid < N).all(axis=1)]
    paths = [np.cumsum([[0, 0, 0], *np.eye(3, dtype=int)[list(order)]], axis=0)
             for order in itertools.permutations(range(3))]
    tetrahedra = np.concatenate([index(corners[:, None] + path) for path in paths])
    points = grid / N
    x = points[tetrahedra]
    swapped = np.linalg.det(x[:, 1:] - x[:, :1]) < 0
    tetrahedra[swapped] = tetrahedra[swapped][:, [0, 2, 1, 3]]
    inside = ((grid > 0) & (grid < N)).all(axis=1) & (grid[:, 0] != N // 2)
    points[inside] += np.random.default_rng(1).uniform(-0.24, 0.24, (inside.sum(), 3)) / N
    x = points[tetrahedra]
    assert (np.linalg.det(x[:, 1:] - x[:, :1]) > 0).all()
    facets = np.concatenate([np.delete(tetrahedra, k, axis=1) for k in range(4)])
    facets = np.unique(np.sort(facets, axis=1), axis=0)
    on = lambda axis, value: facets[(grid[facets][:, :, axis] == value).all(axis=1)]  # noqa: E731
    line = index(np.column_stack([np.arange(N + 1), 0 * np.arange(N + 1), 0 * np.arange(N + 1)]))
    is_left = grid[tetrahedra][:, :, 0].mean(axis=1) < N / 2
    return points, [("line", np.column_stack([line[:-1], line[1:]]), EDGE), ("triangle", on(2, 0), BOTTOM),
                    ("triangle", on(0, N // 2), BORDER), ("tetra", tetrahedra[is_left], LEFT),
                    ("tetra", tetrahedra[~is_left], RIGHT)]


POINTS, GROUPS = cube()
BLOCKS = [(kind, nodes) for kind, nodes, _ in GROUPS]


def labelled(*names):
    return {name: [np.full(len(nodes), group) for _, nodes, group in GROUPS] for name in names}


def members_of(mesh, group):
    """The cells of one group of GROUPS, in whatever way a format says so: their points, shape (m, corners, 3)."""
    name = next(name for name, (number, _) in NAMES.items() if number == group)
    kind = next(kind for kind, _, number in GROUPS if number == group)
    found = []
    for k, block in enumerate(mesh.cells):
        if block.type == kind:
            label = next((mesh.cell_data[key][k] for key in ("gmsh:physical", "medit:ref", "nastran:ref")
                          if key in mesh.cell_data), None)
            ids = mesh.cell_sets[name][k] if label is None else np.flatnonzero(label == group)
            found.append(mesh.points[block.data[np.asarray(ids, int)]])
    return np.concatenate(found)


def as_set(cells):
    """Cells as a set of sets of points, to 1e-9, whatever their order."""
    return {frozenset(map(tuple, np.round(cell, 9) + 0.0)) for cell in cells}


def volume(cells):
    return np.abs(np.linalg.det(cells[:, 1:] - cells[:, :1])).sum() / 6


def check_groups(before, after):
    for group in (BOTTOM, BORDER, EDGE):
        assert as_set(members_of(before, group)) == as_set(members_of(after, group)) != set(), group
    for group in (LEFT, RIGHT):
        assert abs(volume(members_of(after, group)) - 0.5) < 1e-9, group
    sides = [{frozenset(facet) for cell in as_set(members_of(after, group))
              for facet in itertools.combinations(cell, 3)} for group in (LEFT, RIGHT)]
    assert as_set(members_of(after, BORDER)) <= sides[0] & sides[1]  # a facet of both materials, still


def round_trip(path, lost=()):
    """Reads, optimizes, writes, reads: each warning has its word of `lost`."""
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        before = meshoptimize.read(path)
        result, report = meshoptimize.optimize(before)
        out = path.with_name("out" + path.suffix)
        meshoptimize.write(result, out)
        after = meshoptimize.read(out)
    texts = [str(warning.message) for warning in seen]
    assert len(texts) == len(lost) and all(word in text for word, text in zip(lost, texts)), texts
    assert all(warning.filename == __file__ for warning in seen)  # where the user's call is
    assert report.worst_before < 0.2 < 0.5 < report.worst_after, report
    assert abs(meshoptimize.quality(after).minimum - report.worst_after) < 1e-9
    check_groups(before, after)
    return before, after


def test_gmsh_22(folder):
    path = folder / "cube.msh"
    mesh = meshio.Mesh(POINTS, BLOCKS, cell_data=labelled("gmsh:physical", "gmsh:geometrical"),
                       field_data={name: np.array(entry) for name, entry in NAMES.items()})
    mesh.point_data["temperature"] = POINTS @ [1.0, 2.0, 3.0]
    mesh.cell_data["pressure"] = [np.full(len(nodes), 2.5 * group) for _, nodes, group in GROUPS]
    meshio.write(path, mesh, file_format="gmsh22", binary=False)
    _, after = round_trip(path, lost=["$ElementData"])
    assert {name: tuple(entry) for name, entry in after.field_data.items()} == NAMES
    assert np.allclose(after.point_data["temperature"], after.points @ [1.0, 2.0, 3.0], rtol=0, atol=1e-12)


def test_gmsh_41(folder):
    """As Gmsh writes by default: a block for each of its entities, and nodes that belong to entities."""
    mesh = meshio.Mesh(POINTS, BLOCKS, cell_data=labelled("gmsh:physical", "gmsh:geometrical"),
                       field_data={name: np.array(entry) for name, entry in NAMES.items()})
    entities = np.tile([3, LEFT], (len(POINTS), 1))
    for (kind, nodes, group), dimension in zip(GROUPS[::-1], (3, 3, 2, 2, 1)):
        entities[nodes.ravel()] = dimension, group
    mesh.point_data["gmsh:dim_tags"] = entities
    path = folder / "cube.msh"
    meshio.write(path, mesh, file_format="gmsh", binary=False)
    before, after = round_trip(path)
    assert len(before.cells) == 5 and "bottom" in before.cell_sets
    assert {name: tuple(entry) for name, entry in after.field_data.items()} == NAMES
    edge_in_group = f"\n{EDGE} 0 0 0 0 0 0 1 {EDGE} 0\n"
    assert edge_in_group in path.read_text()
    path.write_text(path.read_text().replace(edge_in_group, f"\n{EDGE} 0 0 0 0 0 0 0 0\n"))
    try:
        meshoptimize.read(path)
    except meshoptimize.MeshOptimizeError as error:  # another meshio may read it
        assert "Mesh.SaveAll" in str(error), error


def test_gmsh_several_groups(folder):
    """Cells of two groups keep the first; the other group is named."""
    mesh = meshio.Mesh(POINTS, BLOCKS, cell_data=labelled("gmsh:physical"), cell_sets={
        "solid": [np.arange(len(nodes) if kind == "tetra" else 0) for kind, nodes in BLOCKS],
        "left": [np.arange(len(nodes) if group == LEFT else 0) for _, nodes, group in GROUPS]},
        field_data={name: np.array(entry) for name, entry in (*NAMES.items(), ("solid", (9, 3)))})
    result, _ = meshoptimize.optimize(mesh)
    assert sum(map(len, result.cell_sets["solid"])) == len(result.get_cells_type("tetra"))
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        meshoptimize.write(result, folder / "out.msh")
    assert len(seen) == 1 and "the set solid" in str(seen[0].message) and "left" not in str(seen[0].message)
    assert seen[0].filename == __file__
    check_groups(mesh, meshoptimize.read(folder / "out.msh"))


def test_medit(folder):
    for suffix in (".mesh", ".meshb"):
        path = folder / ("cube" + suffix)
        mesh = meshio.Mesh(POINTS, BLOCKS, cell_data=labelled("medit:ref"),
                           point_data={"medit:ref": np.arange(len(POINTS))})
        meshio.write(path, mesh, file_format="medit")
        before, after = round_trip(path)
        kept = {tuple(point): ref for point, ref in zip(before.points, before.point_data["medit:ref"])}
        same = [kept[tuple(point)] == ref for point, ref in zip(after.points, after.point_data["medit:ref"])
                if tuple(point) in kept]
        assert len(same) > 100 and all(same)
    path = folder / "cube.mesh"
    path.write_text(path.read_text().replace("End", "Corners\n1\n1\nRidges\n1\n1\nEnd"))
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        meshoptimize.read(path)
    assert "Corners" in str(seen[0].message) and "Ridges" in str(seen[0].message)
    assert len(seen) == 2 and all(warning.filename == __file__ for warning in seen)  # meshio says it of Ridges, too


def test_nastran(folder):
    path = folder / "cube.bdf"
    meshio.write(path, meshio.Mesh(POINTS, BLOCKS, cell_data=labelled("nastran:ref")), file_format="nastran")
    round_trip(path, lost=["cube.bdf: lost or changed: CBAR", "out.bdf: lost or changed: CBAR"])
    text = path.read_text().replace("ENDDATA", "SPC1    1       123     1       2\nENDDATA")
    path.write_text("\n".join(line for line in text.splitlines() if not line.startswith("CBAR")) + "\n")
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        meshoptimize.read(path)
    assert "SPC1" in str(seen[0].message) and "CBAR" not in str(seen[0].message)


def test_sets_of_points(folder):
    """Points that go are counted in a warning. New points inside join no set of the surface."""
    sets = {"all": np.arange(len(POINTS)), "bottom": np.flatnonzero(POINTS[:, 2] == 0)}
    points = POINTS.copy()
    near = np.flatnonzero((np.round(points * N) == [4, 3, 3]).all(axis=1))
    points[near] += 0.9 * (points[near + 1] - points[near])  # these two become one
    mesh = meshio.Mesh(points, BLOCKS, point_sets=sets)
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        result, report = meshoptimize.optimize(mesh, insert_nodes=False, move_nodes=False)
    mesh.point_sets["third"] = np.arange(0, len(POINTS), 3)
    moved, _ = meshoptimize.optimize(mesh, insert_nodes=False, remove_nodes=False)
    assert (moved.points != points).any() and all(
        set(moved.point_sets[name]) == set(members) for name, members in mesh.point_sets.items())
    del mesh.point_sets["third"]
    gone = report.points_before - report.points_after
    assert gone > 0 and len(seen) == 1
    assert f"{gone} of the {len(POINTS)} points of the set 'all'" in str(seen[0].message)
    assert seen[0].filename == __file__ and len(result.point_sets["all"]) == len(result.points)
    for options in ({"target_quality": 0.7},
                    {"boundary_mode": "slide", "surface_tolerance": 0, "target_quality": 0.75}):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            result, report = meshoptimize.optimize(mesh, **options)
        assert len(result.point_sets["all"]) == len(result.points), options
        assert set(result.point_sets["bottom"]) == set(np.flatnonzero(result.points[:, 2] == 0)), options
        volumes = [volume(result.points[block.data]) for block in result.cells if block.type == "tetra"]
        assert abs(sum(volumes) - 1) < 1e-9


def test_regions(folder):
    """Groups of tetrahedra are regions, unless another array, or none, is asked for."""
    mesh = meshio.Mesh(POINTS, [block for block in BLOCKS if block[0] == "tetra"],
                       cell_data={"medit:ref": labelled("medit:ref")["medit:ref"][3:]})
    for options, halves in (({}, True), ({"region_array": "medit:ref"}, True), ({"region_array": ""}, False)):
        result, _ = meshoptimize.optimize(mesh, **options)
        half = [abs(volume(result.points[block.data]) - 0.5) < 1e-12 for block in result.cells]
        assert all(half) == halves, options
    assert type(result) is meshio.Mesh and set(mesh.cell_data) == {"medit:ref"}


def test_from_format_to_format(folder):
    """Groups go from each format to each other, over VTK's, too; what has no place is named."""
    mesh = meshio.Mesh(POINTS, BLOCKS, cell_data=labelled("gmsh:physical", "gmsh:geometrical"),
                       field_data={name: np.array(entry) for name, entry in NAMES.items()})
    for suffix, names_stay in ((".vtu", True), (".vtk", True), (".inp", True), (".mesh", False), (".bdf", False)):
        with warnings.catch_warnings(record=True) as seen:
            warnings.simplefilter("always")
            meshoptimize.write(mesh, folder / ("over" + suffix))
        assert names_stay == (not seen) and all("left" in str(warning.message) for warning in seen), suffix
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            meshoptimize.write(meshoptimize.read(folder / ("over" + suffix)), folder / "back.msh")
        back = meshoptimize.read(folder / "back.msh")
        if suffix == ".inp":  # sets are numbered anew
            assert back.field_data.keys() == NAMES.keys()
            numbers = {int(number): NAMES[name][0] for name, (number, _) in back.field_data.items()}
            back.cell_data["gmsh:physical"] = [np.vectorize(numbers.get)(values)
                                               for values in back.cell_data["gmsh:physical"]]
        check_groups(mesh, back)
        assert not names_stay or back.field_data.keys() == NAMES.keys(), suffix


def test_files_that_cannot_be_read(folder):
    for suffix in (".msh", ".mesh", ".inp", ".bdf"):
        path = folder / ("bad" + suffix)
        path.write_text("nothing of the kind\n")
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                meshoptimize.read(path)
        except meshoptimize.MeshOptimizeError as error:
            assert "bad" + suffix in str(error), error
        else:
            raise AssertionError(suffix)


if __name__ == "__main__":
    os.environ.setdefault("NO_COLOR", "1")
    run_each(globals())
