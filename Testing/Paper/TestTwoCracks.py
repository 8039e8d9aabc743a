# SPDX-License-Identifier: BSD-3-Clause
"""two_cracks.py: stress intensity factors within 3 % of the reference, their ratio, the number of elements, the sizes at the tips."""
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../ParaViewPlugin/Examples"))
from stress_intensity import Solution  # noqa: E402
from two_cracks import intensities, loop, tip_sizes, two_cracks  # noqa: E402

ELEMENTS = 9589  # as in the paper
cracks = two_cracks(0.037)
exact = cracks.intensity().reshape(4, 2)
failures = []


def check(condition, *message):
    if not condition:
        failures.append(" ".join(str(m) for m in message))


for name, mesh, solved, seconds in loop(cracks, ELEMENTS, 4):
    solution = Solution.of_grid(solved)
    found = intensities(solution, cracks)
    sizes = tip_sizes(solution, cracks)
    print(name, mesh.GetNumberOfPoints(), mesh.GetNumberOfCells(), found[:, 0, 0] / exact[:, 0], sizes, f"{seconds:.1f} s")
    check(abs(mesh.GetNumberOfCells() / ELEMENTS - 1) < 0.1, name, "elements", mesh.GetNumberOfCells())

error = np.abs(found[:, :, 0] / exact[:, :1] - 1)
check(error[:, 0].max() < 0.03, "K_I by the interaction integral, relative error", error[:, 0])
check(error[:, 1].max() < 0.03, "K_I by the opening, relative error", error[:, 1])
check(np.abs(found[:, 0, 1] - exact[:, 1]).max() < 0.03 * exact[:, 0].max(), "K_II", found[:, 0, 1], "reference", exact[:, 1])
k = found[:, 0, 0]
check(abs((k[1] + k[2]) / (k[0] + k[3]) - 1.6) < 0.03, "ratio", (k[1] + k[2]) / (k[0] + k[3]))
check(sizes[[1, 2]].max() < sizes[[0, 3]].min(), "elements at the tips", sizes)
print("\n".join(failures) or "passed")
sys.exit(len(failures) > 0)
