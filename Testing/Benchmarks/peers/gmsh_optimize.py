# SPDX-License-Identifier: BSD-3-Clause
"""gmsh_optimize.py IN.vtu OUT.vtu METHOD [THRESHOLD]: Gmsh on a mesh whose surface is kept; prints the seconds.

METHOD: default (Gmsh's own), Netgen, or hxt: HXT makes the interior anew, within the same surface, and optimizes it.
THRESHOLD: quality under which Gmsh's optimizer works (Mesh.OptimizeThreshold, by default .3).
"""
import sys
import time

import formats
import gmsh
import numpy as np


def main():
    source, target, method = sys.argv[1:4]
    points, cells = formats.read(source)
    triangles = formats.boundary(cells)
    on_surface = np.unique(triangles)
    inside = np.setdiff1d(np.unique(cells), on_surface)
    gmsh.initialize()
    gmsh.option.setNumber("General.NumThreads", 1)
    gmsh.option.setNumber("General.Verbosity", 2)
    if len(sys.argv) > 4:
        gmsh.option.setNumber("Mesh.OptimizeThreshold", float(sys.argv[4]))
    face = gmsh.model.addDiscreteEntity(2)
    gmsh.model.mesh.addNodes(2, face, on_surface + 1, points[on_surface].ravel())
    gmsh.model.mesh.addElementsByType(face, 2, [], triangles.ravel() + 1)
    start = time.perf_counter()
    if method == "hxt":
        loop = gmsh.model.geo.addSurfaceLoop([face])
        gmsh.model.geo.addVolume([loop])
        gmsh.model.geo.synchronize()
        gmsh.option.setNumber("Mesh.Algorithm3D", 10)
        gmsh.option.setNumber("Mesh.MeshOnlyEmpty", 1)
        start = time.perf_counter()
        gmsh.model.mesh.generate(3)
    else:
        body = gmsh.model.addDiscreteEntity(3, boundary=[face])
        if len(inside):
            gmsh.model.mesh.addNodes(3, body, inside + 1, points[inside].ravel())
        gmsh.model.mesh.addElementsByType(body, 4, [], cells.ravel() + 1)
        start = time.perf_counter()
        gmsh.model.mesh.optimize("" if method == "default" else method, force=True)
    seconds = time.perf_counter() - start
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    place = np.empty(int(tags.max()) + 1, dtype=np.int64)
    place[tags.astype(np.int64)] = np.arange(len(tags))
    _, nodes = gmsh.model.mesh.getElementsByType(4)
    formats.write(target, coordinates.reshape(-1, 3), place[nodes.astype(np.int64)].reshape(-1, 4))
    print("seconds", seconds)


if __name__ == "__main__":
    main()
