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
assert after.active_scalars_name == "MeshQuality"
assert after.cell_data["MeshQuality"].min() == report.worst_after > 0.25

# As PyVista's users come to a mesh: by its reader, and by its filters.
read = pyvista.read(os.path.join(os.environ["MESHOPTIMIZE_DATA"], "crack40.vtu"))
measured = meshoptimize.quality(read)
assert measured.minimum == report.worst_before < 0.01 and measured.cells == read.n_cells, measured
part = read.extract_cells(range(5000))
part.cell_data["number"] = range(5000)
better, report = meshoptimize.optimize(part, effort="quick")
assert type(better) is pyvista.UnstructuredGrid and "number" in better.cell_data and report.worst_after > report.worst_before
blocks = pyvista.MultiBlock({"whole": read, "part": part})
improved, report = meshoptimize.optimize(blocks, effort="quick")
assert type(improved) is pyvista.MultiBlock and improved.keys() == ["whole", "part"], improved.keys()
assert report.cells_before == read.n_cells + part.n_cells and report.worst_after > report.worst_before
assert all("MeshQuality" in block.cell_data for block in improved) and "number" in improved["part"].cell_data
assert "MeshQuality" not in blocks["whole"].cell_data
