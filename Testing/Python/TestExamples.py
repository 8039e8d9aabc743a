# SPDX-License-Identifier: BSD-3-Clause
"""Examples of the Python package that need an input of their own or more than numpy: run as a user does, and their results.

    TestExamples.py gmsh_groups | parameter_study      77, and a word, where meshio or matplotlib is not installed
"""
import os
import pathlib
import subprocess
import sys

import meshoptimize
import numpy as np

EXAMPLES = pathlib.Path(os.environ["MESHOPTIMIZE_SOURCE"]) / "ParaViewPlugin/Examples"
OUTPUT = pathlib.Path(os.environ["MESHOPTIMIZE_OUTPUT"])
PELLET = pathlib.Path(os.environ["MESHOPTIMIZE_DATA"]) / "crack40.vtu"


def run(name, *arguments):
    done = subprocess.run([sys.executable, str(EXAMPLES / name), *map(str, arguments)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def gmsh_groups():
    from TestMeshioFiles import BLOCKS, NAMES, POINTS, check_groups, labelled, meshio  # 77 where there is no meshio

    mesh = meshio.Mesh(POINTS, BLOCKS, cell_data=labelled("gmsh:physical", "gmsh:geometrical"),
                       field_data={name: np.array(group) for name, group in NAMES.items()})
    before, after = OUTPUT / "groups.msh", OUTPUT / "groups_optimized.msh"
    meshio.write(before, mesh, file_format="gmsh22", binary=False)
    text = run("gmsh_groups.py", before, after)
    check_groups(meshoptimize.read(before), meshoptimize.read(after))
    assert meshoptimize.quality(meshoptimize.read(after)).minimum > 0.5
    assert "bottom: 72 elements -> 72" in text and "left: 648 elements -> " in text, text


def parameter_study():
    try:
        import matplotlib.image
    except ImportError:
        print("skipped: matplotlib is not installed (Debian: python3-matplotlib)")
        sys.exit(77)
    picture = OUTPUT / "parameter_study.png"
    text = run("parameter_study.py", PELLET, picture)
    worst = [float(line.split("worst ")[1].split()[0]) for line in text.splitlines()]
    assert len(worst) == 12 and all(abs(worst[k] - (0.1, 0.2, 0.3)[k % 6]) < 0.01 for k in (0, 1, 2, 6, 7, 8)), text
    colours = np.unique(matplotlib.image.imread(picture).reshape(-1, 4).round(2), axis=0)
    assert len(colours) > 20, "the picture is empty"


if __name__ == "__main__":
    globals()[sys.argv[1]]()
