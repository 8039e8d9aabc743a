# SPDX-License-Identifier: BSD-3-Clause
"""Other programs that mesh the unit square in a metric, for adapt.py.

    /usr/bin/python3 adapt_peers.py bamg IN.npz OUT.npz       (how adapt.py calls Gmsh: a process of its own, so that it can be ended)

Each takes the points, triangles and tensors xx, xy, yy at the points in which edges shall have the length 1, and gives
(points, triangles, seconds of the mesh generator alone).
"""
import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
import time

import numpy as np

TIMEOUT = 300

# FreeFEM's adaptmesh; no smoothing of the metric (ratio), and no limits but those that the metric has.
SCRIPT = """
mesh Th = readmesh("in.msh");
fespace Vh(Th, P1);
Vh xx, xy, yy;
{ ifstream f("metric.txt"); for (int i = 0; i < Vh.ndof; i++) f >> xx[][i] >> xy[][i] >> yy[][i]; }
real start = clock();
mesh New = adaptmesh(Th, xx, xy, yy, IsMetric = 1, nbvx = 4000000, ratio = 0, hmin = 1e-8, hmax = 10, anisomax = 1e8);
real seconds = clock() - start;
{ ofstream f("seconds.txt"); f << seconds << endl; }
savemesh(New, "out.msh");
"""


def have_freefem():
    return shutil.which("FreeFem++") is not None


def have_gmsh():
    return importlib.util.find_spec("gmsh") is not None


def boundary(triangles):
    edges = np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)])
    _, first, count = np.unique(np.sort(edges, axis=1), axis=0, return_index=True, return_counts=True)
    return edges[first[count == 1]]


def freefem(points, triangles, metric):
    edges = boundary(triangles)
    middle = points[edges].mean(axis=1)
    side = np.argmin(np.stack([middle[:, 1], 1 - middle[:, 0], 1 - middle[:, 1], middle[:, 0]], axis=1), axis=1) + 1
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "in.msh"), "w", encoding="ascii") as f:
            f.write(f"{len(points)} {len(triangles)} {len(edges)}\n")
            np.savetxt(f, np.column_stack([points, np.zeros(len(points))]), fmt="%.17g %.17g %d")
            np.savetxt(f, np.column_stack([triangles + 1, np.zeros(len(triangles), dtype=int)]), fmt="%d")
            np.savetxt(f, np.column_stack([edges + 1, side]), fmt="%d")
        np.savetxt(os.path.join(folder, "metric.txt"), metric, fmt="%.17g")
        with open(os.path.join(folder, "adapt.edp"), "w", encoding="ascii") as f:
            f.write(SCRIPT)
        done = subprocess.run(["FreeFem++", "-nw", "-v", "0", "adapt.edp"], cwd=folder, timeout=TIMEOUT,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode != 0:
            raise RuntimeError("FreeFem++: " + done.stdout[-300:])
        with open(os.path.join(folder, "out.msh"), encoding="ascii") as f:
            n, m, _ = (int(word) for word in f.readline().split())
            rows = [f.readline().split() for _ in range(n + m)]
        with open(os.path.join(folder, "seconds.txt"), encoding="ascii") as f:
            seconds = float(f.read())
    return (np.array([row[:2] for row in rows[:n]], dtype=float),
            np.array([row[:3] for row in rows[n:]], dtype=int) - 1, seconds)


def bamg(points, triangles, metric):
    """BAMG as it is in Gmsh, which meshes the sides first."""
    with tempfile.TemporaryDirectory() as folder:
        files = [os.path.join(folder, name) for name in ("in.npz", "out.npz")]
        np.savez(files[0], points=points, triangles=triangles, metric=metric)
        done = subprocess.run([sys.executable, os.path.abspath(__file__), "bamg", *files], timeout=TIMEOUT,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode != 0 or not os.path.exists(files[1]):
            raise RuntimeError("Gmsh: " + done.stdout[-300:])
        result = np.load(files[1])
        return result["points"], result["triangles"], float(result["seconds"])


def run_gmsh(source, target):
    import gmsh
    given = np.load(source)
    gmsh.initialize()
    gmsh.option.setNumber("General.NumThreads", 1)
    gmsh.option.setNumber("General.Verbosity", 2)
    gmsh.model.occ.addRectangle(0, 0, 0, 1, 1)
    gmsh.model.occ.synchronize()
    # "TT": three x, three y, three z, then nine components for each corner
    x = np.column_stack([given["points"], np.zeros(len(given["points"]))])[given["triangles"]]
    xx, xy, yy = given["metric"][given["triangles"]].transpose(2, 0, 1)
    zero, one = np.zeros_like(xx), np.sqrt(xx * yy - xy * xy)
    tensors = np.stack([xx, xy, zero, xy, yy, zero, zero, zero, one], axis=-1)
    rows = np.concatenate([x.transpose(0, 2, 1).reshape(-1, 9), tensors.reshape(-1, 27)], axis=1)
    view = gmsh.view.add("metric")
    gmsh.view.addListData(view, "TT", len(rows), rows.reshape(-1))
    field = gmsh.model.mesh.field.add("PostView")
    gmsh.model.mesh.field.setNumber(field, "ViewTag", view)
    gmsh.model.mesh.field.setNumber(field, "CropNegativeValues", 0)
    gmsh.model.mesh.field.setAsBackgroundMesh(field)
    for name, value in (("Algorithm", 7), ("AnisoMax", 1e8), ("SmoothRatio", 0), ("MeshSizeExtendFromBoundary", 0),
                        ("MeshSizeFromPoints", 0)):
        gmsh.option.setNumber("Mesh." + name, value)
    start = time.process_time()
    gmsh.model.mesh.generate(2)
    seconds = time.process_time() - start
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    place = np.zeros(int(tags.max()) + 1, dtype=np.int64)
    place[tags.astype(np.int64)] = np.arange(len(tags))
    _, nodes = gmsh.model.mesh.getElementsByType(2)
    np.savez(target, points=coordinates.reshape(-1, 3)[:, :2], seconds=seconds,
             triangles=place[nodes.astype(np.int64)].reshape(-1, 3))


if __name__ == "__main__":
    run_gmsh(*sys.argv[2:4])
