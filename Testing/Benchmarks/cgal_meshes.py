# SPDX-License-Identifier: BSD-3-Clause
"""Tetrahedral meshes of the surfaces that come with CGAL, for hard.py.

    apt-get download libcgal-demo && dpkg-deb -x libcgal-demo_*.deb PACKAGE
    tar xzf PACKAGE/usr/share/doc/libcgal-dev/data.tar.gz -C PACKAGE
    eval "$(./bootstrap.sh env)"
    /usr/bin/python3 Testing/Benchmarks/cgal_meshes.py PACKAGE/data/meshes FOLDER
    /usr/bin/python3 Testing/Benchmarks/hard.py FOLDER/*.vtu --kinds none --judge PROGRAM

Each .off file of the folder with triangles alone, of at most 30 000 of them, is meshed by the filter TetGen: its surface
kept, radius to edge at most 2, no optimization. Meshes of less than 1000 tetrahedra are left out. The names of those that
TetGen cannot mesh (open surfaces, and such that
cross themselves) are printed with its reason; two files with the same points and triangles are meshed once.
"""
import argparse
import hashlib
import pathlib
import sys

import numpy as np
from meshoptimize import vtkTetGenFilter
from optimize_meshes import write
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

MOST_TRIANGLES = 30000
FEWEST_TETRAHEDRA = 1000  # the time per cell of less says nothing


def read_off(path):
    """Points [n, 3] and triangles [m, 3]."""
    lines = (line.split("#")[0] for line in path.read_text(errors="replace").splitlines())
    words = " ".join(lines).split()
    if not words or not words[0].endswith("OFF") or words[0] != "OFF":
        raise ValueError("no plain OFF file")
    n, m = int(words[1]), int(words[2])
    points = np.array(words[4:4 + 3 * n], dtype=float).reshape(-1, 3)
    rows = [line.split("#")[0].split() for line in path.read_text(errors="replace").splitlines()]
    rows = [row for row in rows if row and row[0] != "OFF"][1 + n:1 + n + m]
    if len(rows) < m or any(row[0] != "3" for row in rows):
        raise ValueError("not of triangles alone")
    return points, np.array([row[1:4] for row in rows], dtype=np.int64)


def surface_of(points, triangles):
    x, cells, poly = vtkPoints(), vtkCellArray(), vtkPolyData()
    x.SetData(numpy_to_vtk(points, deep=1))
    rows = np.column_stack([np.full(len(triangles), 3), triangles]).ravel()
    cells.SetCells(len(triangles), numpy_to_vtkIdTypeArray(rows, deep=1))
    poly.SetPoints(x)
    poly.SetPolys(cells)
    return poly


def tetrahedra(surface):
    """The mesh; ValueError with TetGen's reason."""
    f, said = vtkTetGenFilter(), []
    f.AddObserver("ErrorEvent", lambda *_: said.append("refused"))
    f.SetInputData(surface)
    f.SetMaximumRadiusEdgeRatio(2.0)
    f.SetMinimumDihedralAngle(0.0)
    f.SetOptimizationLevel(0)
    f.KeepSurfaceOn()
    f.Update()
    if said or f.GetOutput().GetNumberOfCells() == 0:
        raise ValueError("TetGen cannot mesh it")
    return f.GetOutput()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("surfaces", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    opt = parser.parse_args()
    opt.folder.mkdir(parents=True, exist_ok=True)
    seen, made = set(), 0
    for path in sorted(opt.surfaces.glob("*.off")):
        try:
            points, triangles = read_off(path)
            key = hashlib.sha256(points.tobytes() + triangles.tobytes()).hexdigest()
            if len(triangles) > MOST_TRIANGLES or key in seen:
                raise ValueError("too large" if key not in seen else "there already")
            seen.add(key)
            mesh = tetrahedra(surface_of(points, triangles))
            if mesh.GetNumberOfCells() < FEWEST_TETRAHEDRA:
                raise ValueError("too small")
        except ValueError as reason:
            print(f"{path.name}: {reason}")
            continue
        write(mesh, opt.folder / f"{path.stem}.vtu")
        made += 1
        print(f"{path.name}: {mesh.GetNumberOfCells()} tetrahedra", flush=True)
    print(f"{made} meshes")
    return 0 if made else 1


if __name__ == "__main__":
    sys.exit(main())
