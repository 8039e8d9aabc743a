# SPDX-License-Identifier: BSD-3-Clause
"""A mesh of PyVista comes back as one. Skipped (77) where PyVista is not installed."""
import os
import sys

try:
    import pyvista
except ImportError:
    print("skipped: pyvista is not installed (pip install pyvista)")
    sys.exit(77)

import meshoptimize

before = pyvista.wrap(meshoptimize.read(os.path.join(os.environ["MESHOPTIMIZE_DATA"], "crack40.vtu")))
points = before.points.copy()
after, report = meshoptimize.optimize(before, target_quality=0.3)
assert type(after) is type(before) is pyvista.UnstructuredGrid
assert (before.points == points).all() and "MeshQuality" not in before.cell_data
assert after.cell_data["MeshQuality"].min() == report.worst_after > 0.25
