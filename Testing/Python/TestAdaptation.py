# SPDX-License-Identifier: BSD-3-Clause
"""Adapted meshes of the unit square: the L2 error of the interpolation falls with slope -1 over five doublings, edges are right in the
metric, no element is bad in it; with tanh the error is at most a tenth of the uniform mesh's. Judged by Testing/Benchmarks/adapt.py."""
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../Benchmarks"))
from adapt import Background, judge, structured  # noqa: E402
from adapt_function import FUNCTIONS, adapt, interpolation_error, slope  # noqa: E402

failures = []


def check(condition, *message):
    if not condition:
        failures.append(" ".join(str(m) for m in message))


for name, function in FUNCTIONS.items():
    rows = []
    for elements in (312, 625, 1250, 2500, 5000, 10000):
        mesh, background, _ = list(adapt(function, elements, 4, first=structured))[-1]
        row = judge(mesh, Background(background), function)
        rows.append((row["cells"], row["error"]))
        check(abs(row["cells"] / elements - 1) < 0.1, name, "wanted", elements, "elements", row["cells"])
        check(row["share"] >= 0.9, name, elements, "share of edges", row["share"])
        check(row["worst"] >= 0.4, name, elements, "worst quality", row["worst"])
    found = slope(*np.transpose(rows))
    print(name, "slope", found, "at", *rows[-1], row)
    check(found < -0.95, name, "slope", found)
    uniform = interpolation_error(structured(10000)[0], function)
    check(name != "tanh" or rows[-1][1] < 0.1 * uniform, name, "error", rows[-1][1], "uniform", uniform)
print("\n".join(failures) or "passed")
sys.exit(len(failures) > 0)
