"""A Gmsh file with physical groups, to better elements in the same groups: /usr/bin/python3 gmsh_groups.py IN.msh OUT.msh

Physical volumes are regions: the faces between them stay. Physical surfaces and curves stay, too. Needs meshio.
"""
import sys

import meshoptimize
import numpy as np


def groups(mesh):
    """Number of elements in each physical group, by its name."""
    numbers = mesh.cell_data["gmsh:physical"]  # an array for each block of cells
    return {name: sum(np.count_nonzero(values == number) for block, values in zip(mesh.cells, numbers)
                      if block.dim == dimension)
            for name, (number, dimension) in mesh.field_data.items()}


before = meshoptimize.read(sys.argv[1])  # a meshio.Mesh
after, report = meshoptimize.optimize(before, target_quality=0.6)
meshoptimize.write(after, sys.argv[2])

print(report)
for name, count in groups(before).items():
    print(f"{name}: {count} elements -> {groups(after)[name]}")
