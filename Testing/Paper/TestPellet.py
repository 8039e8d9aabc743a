# SPDX-License-Identifier: BSD-3-Clause
"""pellet.py: surfaces are closed, of the right size and of good triangles; meshes have the paper's numbers of elements."""
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

import pellet

failures = []


def check(condition, *message):
    if not condition:
        failures.append(" ".join(str(m) for m in message))


def check_surface(rings, crack):
    where = f"surface({rings}, {crack}):"
    data = pellet.surface(rings, crack)
    points = vtk_to_numpy(data.GetPoints().GetData())
    triangles = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    check(len(np.unique(triangles)) == len(points), where, "a point that no triangle uses")
    # Closed and oriented: each directed edge once, and its opposite once.
    edges = np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)])
    check(len(np.unique(edges, axis=0)) == len(edges), where, "two triangles go the same way along an edge")
    check((np.unique(edges, axis=0) == np.unique(edges[:, ::-1], axis=0)).all(), where, "not closed")
    check(len(points) - len(edges) / 2 + len(triangles) == 2, where, "not a sphere by its Euler number")
    # Volume: that of the prism over the regular polygon of the rim, without the slot.
    corners = points[triangles]
    volume = np.einsum("ij,ij->i", np.cross(corners[:, 0], corners[:, 1]), corners[:, 2]).sum() / 6
    cylinder = np.pi * pellet.RADIUS ** 2 * pellet.HEIGHT
    slot = crack * pellet.RADIUS * pellet.SLOT_WIDTH * pellet.HEIGHT
    check(abs(volume / (cylinder - slot) - 1) < 10 / (6 * rings) ** 2, where, "volume", volume, "for", cylinder - slot)
    radius = np.hypot(points[:, 0], points[:, 1])
    check(abs(radius.max() - pellet.RADIUS) < 1e-12, where, "radius", radius.max())
    check((points[:, 2].min(), points[:, 2].max()) == (0, pellet.HEIGHT), where, "height")
    if crack > 0:
        wall = points[np.abs(np.abs(points[:, 1]) - pellet.SLOT_WIDTH / 2) < 1e-12]
        wall = wall[wall[:, 0] > 0]
        check(abs(wall[:, 0].min() - pellet.RADIUS * (1 - crack)) < 1e-12, where, "the slot ends at", wall[:, 0].min())
    # Shape of the triangles: 1 is equilateral.
    lengths = pellet.edge_lengths(data)
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    shape = 12 * np.sqrt(3) * area / lengths.sum(axis=1) ** 2
    least = 0.9 if crack == 0 else 0.4 if rings > 10 else 0.2  # coarse triangles at the narrow bottom of the slot
    check(shape.min() > least and shape.mean() > 0.95, where, "shape", shape.min(), shape.mean())


for rings in (2, 5, 8):
    check_surface(rings, 0)
for rings, crack in ((5, 0.4), (11, 0.4), (12, 0.2), (12, 0.6)):
    check_surface(rings, crack)
check(pellet.rings_for_edge(2 * np.pi * pellet.RADIUS / 60) == 10, "rings_for_edge")

for name in ("A", "C", "crack20", "crack40", "crack60"):
    setup = pellet.MESHES[name]
    grid = pellet.mesh(name)
    worst, mean, bound = pellet.quality(grid)
    check(abs(grid.GetNumberOfCells() / setup["elements"] - 1) <= 0.03, name, grid.GetNumberOfCells(), "elements")
    if setup["crack"] == 0:  # the paper: worst 0.103 down to 3e-6, mean 0.68 to 0.72
        check(pellet.FLAT < worst < 0.103 and 0.67 < mean < 0.73, name, "quality", worst, mean)
    else:  # the paper: worst 0.002 to 0.004, mean 0.742 to 0.766
        check(0.001 < worst < 0.008 and 0.73 < mean < 0.78, name, "quality", worst, mean)
    check(bound > (0.7 if setup["crack"] == 0 else 0.4), name, "bound", bound)

for failure in failures:
    print("FAILED:", failure)
sys.exit(1 if failures else 0)
