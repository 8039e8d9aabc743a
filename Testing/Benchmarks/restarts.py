# SPDX-License-Identifier: BSD-3-Clause
"""Does the worst quality depend on where the optimizer starts?

    /usr/bin/python3 restarts.py MESH.vtu [--starts N] [--layers N]

Optimizes the mesh (Effort Best), cuts out what lies around its worst element, throws the nodes inside of that patch about by up to
half an edge, again and again, and optimizes each patch anew, its surface kept. Where all starts end at the same quality it is the
surface, not the way there, that holds the worst element. No proof: only what so many tries found.
"""
import argparse

import numpy as np
from invariance import grid_of, read
from meshoptimize import vtkMeshOptimizeFilter
from vtkmodules.util.numpy_support import vtk_to_numpy


def optimize(mesh):
    f = vtkMeshOptimizeFilter()
    f.SetInputData(mesh)
    f.SetEffortToBest()
    f.SetNumberOfThreads(1)
    f.Update()
    return f


def patch(cells, seed, layers):
    """The cells in so many layers around one."""
    nodes = np.unique(cells[seed])
    for _ in range(layers):
        zone = np.isin(cells, nodes).any(axis=1)
        nodes = np.unique(cells[zone])
    return cells[zone]


def inner(cells):
    """The points that are on no facet of one cell only."""
    facets = np.sort(np.concatenate([np.delete(cells, i, axis=1) for i in range(4)]), axis=1)
    facets, count = np.unique(facets, axis=0, return_counts=True)
    return np.setdiff1d(np.unique(cells), facets[count == 1])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", nargs="+")
    parser.add_argument("--starts", type=int, default=50)
    parser.add_argument("--layers", type=int, default=3)
    arguments = parser.parse_args()
    random = np.random.default_rng(1)
    print("| mesh | worst | cells of the patch | nodes inside | lowest of the starts | median | highest |\n|---|---|---|---|---|---|---|")
    for path in arguments.mesh:
        whole = optimize(grid_of(*read(path)))
        optimized = whole.GetOutput()
        points = vtk_to_numpy(optimized.GetPoints().GetData())
        cells = vtk_to_numpy(optimized.GetCells().GetConnectivityArray()).reshape(-1, 4)
        quality = vtk_to_numpy(optimized.GetCellData().GetArray("MeshQuality"))
        zone = patch(cells, np.argmin(quality), arguments.layers)
        used, zone = np.unique(zone, return_inverse=True)
        points, zone = points[used], zone.reshape(-1, 4)
        free = inner(zone)
        edge = np.mean(np.linalg.norm(points[zone[:, 0]] - points[zone[:, 1]], axis=1))
        reached = []
        for _ in range(arguments.starts):
            thrown = points.copy()
            thrown[free] += random.uniform(-0.5, 0.5, (len(free), 3)) * edge
            reached.append(optimize(grid_of(thrown, zone)).GetWorstQualityAfter())
        print(f"| {path} | {whole.GetWorstQualityAfter():.5f} | {len(zone)} | {len(free)} "
              f"| {min(reached):.5f} | {np.median(reached):.5f} | {max(reached):.5f} |", flush=True)


if __name__ == "__main__":
    main()
