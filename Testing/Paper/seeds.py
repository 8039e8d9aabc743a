# SPDX-License-Identifier: BSD-3-Clause
"""How typical the meshes of table 1 are: error of s_tt by patch recovery, and steps to 1e-6, over seeds of the inner points' jitter.

    /usr/bin/python3 seeds.py [--meshes A B C D] [--seeds N] [--ways default]

Per mesh: median and range as generated and optimized, and the seed whose error and steps as generated are nearest to the paper's (in
their logarithms), which is the one that pellet.MESHES holds. Takes six minutes.
"""
import argparse
import sys

import numpy as np

import pellet
import study

SEEDS = {"A": 10, "B": 10, "C": 10, "D": 5}


def measure(grid):
    """Error in percent, steps."""
    f = study.solver(grid)
    f.GeneralizedPlaneStrainOn()
    solution = study.solve(f)
    return 100 * study.stress_errors(study.cells_of(grid)[0], solution.points("Stress"))[1], solution.steps(1e-6)


def spread(values, form):
    return f"{np.median(values):{form}}, {values.min():{form}} to {values.max():{form}}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--meshes", nargs="+", choices=SEEDS, default=list(SEEDS))
    parser.add_argument("--seeds", type=int)
    parser.add_argument("--ways", nargs="+", choices=study.WAYS, default=["default"])
    options = parser.parse_args()
    rows = []
    for name in options.meshes:
        paper, found, seeds = pellet.MESHES[name], [], []
        for seed in range(1, (options.seeds or SEEDS[name]) + 1):
            grid = pellet.mesh(name, seed)
            if pellet.quality(grid)[0] <= pellet.FLAT:
                print(f"{name}, seed {seed}: a flat element, left out", flush=True)
                continue
            seeds.append(seed)
            found.append([measure(grid)] + [measure(study.optimize(grid, way).grid) for way in options.ways])
            print(f"{name}, seed {seed}: " + ", ".join(f"{e:.1f} % {n}" for e, n in found[-1]), flush=True)
        found = np.array(found)  # seed, state, (error, steps)
        distance = np.linalg.norm(np.log(found[:, 0] / (paper["error"], paper["steps"])), axis=1)
        for k, state in enumerate(("as generated", *options.ways)):
            ratios = [f"{np.median(found[:, k, i] / found[:, 0, i]):.2f}" if k else "" for i in (0, 1)]
            rows.append((name, len(seeds), state, spread(found[:, k, 0], ".1f"), ratios[0], spread(found[:, k, 1], ".0f"), ratios[1],
                         "" if k else seeds[distance.argmin()]))
    print(study.markdown_table(("mesh", "seeds", "state", "error %: median, range", "over generated", "steps: median, range", "over generated",
                                "nearest to the paper"), rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
