# SPDX-License-Identifier: BSD-3-Clause
"""A Gmsh file from one line of the shell to better elements in the same groups: a box with a sphere of another material inside.

    /usr/bin/python3 Testing/Benchmarks/gmsh_box.py FOLDER [SIZE]      needs python3-gmsh and meshio

Two physical volumes, two physical surfaces, made without Gmsh's own optimization; then mesh-optimize IN.msh OUT.msh.
"""
import pathlib
import subprocess
import sys
import time

import gmsh
import meshoptimize
import numpy as np


def make(path, size):
    gmsh.initialize()
    for name, value in (("General.Terminal", 0), ("Mesh.Optimize", 0), ("Mesh.MeshSizeMin", size), ("Mesh.MeshSizeMax", size),
                        ("Mesh.MshFileVersion", 2.2)):
        gmsh.option.setNumber(name, value)
    box, ball = gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1), gmsh.model.occ.addSphere(0.5, 0.5, 0.5, 0.3)
    parts, _ = gmsh.model.occ.fragment([(3, box)], [(3, ball)])
    gmsh.model.occ.synchronize()
    inside = min((tag for _, tag in parts), key=lambda tag: gmsh.model.occ.getMass(3, tag))
    outside = next(tag for _, tag in parts if tag != inside)
    sphere = [tag for _, tag in gmsh.model.getBoundary([(3, inside)], oriented=False)]
    walls = [tag for _, tag in gmsh.model.getBoundary(parts, combined=True, oriented=False)]
    for dimension, tags, number, name in ((3, [inside], 1, "ball"), (3, [outside], 2, "matrix"), (2, sphere, 3, "interface"),
                                          (2, walls, 4, "walls")):
        gmsh.model.addPhysicalGroup(dimension, tags, number)
        gmsh.model.setPhysicalName(dimension, number, name)
    gmsh.model.mesh.generate(3)
    gmsh.write(str(path))
    gmsh.finalize()


def groups(mesh):
    """Of each group: its number of elements, and its volume or area."""
    found = {}
    for name, (number, dimension) in mesh.field_data.items():
        count, content = 0, 0.0
        for block, values in zip(mesh.cells, mesh.cell_data["gmsh:physical"]):
            if block.dim == dimension:
                x = mesh.points[block.data[values == number]]
                edges = x[:, 1:] - x[:, :1]
                count += len(x)
                content += (np.abs(np.linalg.det(edges)).sum() / 6 if dimension == 3
                            else np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1).sum() / 2)
        found[name] = count, content
    return found


def main():
    folder, size = pathlib.Path(sys.argv[1]), float(sys.argv[2]) if len(sys.argv) > 2 else 0.06
    folder.mkdir(parents=True, exist_ok=True)
    before, after = folder / "box.msh", folder / "box_better.msh"
    make(before, size)
    start = time.perf_counter()
    subprocess.run(["mesh-optimize", str(before), str(after), "--force"], check=True)
    print(f"{time.perf_counter() - start:.1f} s for the whole command, reading and writing included")
    meshes = [meshoptimize.read(path) for path in (before, after)]
    print("| group | elements | volume or area |\n|---|---|---|")
    for name, (count, content) in groups(meshes[0]).items():
        count_after, content_after = groups(meshes[1])[name]
        print(f"| {name} | {count} -> {count_after} | {content:.6f} -> {content_after:.6f} |")


if __name__ == "__main__":
    main()
