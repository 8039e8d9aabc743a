# SPDX-License-Identifier: BSD-3-Clause
"""The paper's table 1: what optimizing a mesh does to the stresses of a hot cylinder and to the solver, beside the paper's numbers.

    /usr/bin/python3 table1.py FOLDER [--meshes A B C D] [--ways "target .4" best default]

Writes FOLDER/table1.csv and FOLDER/table1.md. The exit status is 1 if a claim does not hold with the last of --ways. Needs the package
meshoptimize (./bootstrap.sh env); takes three to five minutes.
"""
import sys

import numpy as np
from meshoptimize import vtkThermoelasticFilter

import study
from study import GENERATED

# Elements; then quality, error of s_rr, error of s_tt (in percent), steps: as generated, and optimized.
PAPER = {
    "A": (21369, (0.103, 8.5, 16, 307), (0.479, 8.8, 6.1, 256)),
    "B": (52464, (0.004, 15, 14, 453), (0.386, 7.8, 5.7, 326)),
    "C": (68868, (0.004, 10.1, 13.9, 518), (0.363, 7.2, 5.5, 369)),
    "D": (165769, (3e-6, 5.9, 7.5, 1593), (0.404, 4.6, 4.1, 477)),
}
RECOVERIES = {
    "patch": vtkThermoelasticFilter.Patch,
    "local patch": vtkThermoelasticFilter.LocalPatch,
    "volume average": vtkThermoelasticFilter.VolumeAverage,
}
TEXT = """\
# Table 1: a hot cylinder

A cylinder of radius 0.531 and height 1.2 cm under T = 2468 - 5286 r^2. Errors are the greatest ones at all points (centroid: at all
elements), surface included, in percent of the greatest exact value of the same component. Steps are those of the conjugate
gradients. *Changed*: elements of the generated mesh that the optimized one does not have.

What the paper does not state was chosen so:

{choices}- **Ends.** Not given. Generalized plane strain, for which the exact solution is known: u_z = 0 below, u_z = eps_z H above, sides and
  sideways free, three pins against rigid motion.
- **Which meshes.** The inner points are a body-centred cubic lattice with jitter, so that the mean quality is the paper's (0.68 to 0.72;
  TetGen's own refinement makes 0.77). The greatest error of a mesh as generated is that of one bad element in an unlucky
  place, so it differs from mesh to mesh: of 10 seeds (5 on D), the one whose error of s_tt and steps to 1e-6 as generated are nearest
  to the paper's. `seeds.py` makes this choice, by the mesh as generated alone, and shows what optimizing does on all of them: the
  claims below are about these four meshes, and *at most half* does not hold on every other one. The rule matters. By the error
  alone D would be another seed, whose steps to 1e-6 fall by .45 only: its residual goes up and down, and first passes 1e-6 by chance.
- **Stress at points.** Not given. Superconvergent patch recovery (`Patch`) is the paper's method as far as its numbers tell; the other
  measures stand beside it.
"""


def measure(name, way, mesh):
    """A row of the table."""
    f = study.solver(mesh.grid)
    f.GeneralizedPlaneStrainOn()
    points, cells = study.cells_of(mesh.grid)
    row = {"mesh": name, "state": way, "elements": mesh.elements, "worst": mesh.worst, "mean": mesh.mean, "bound": mesh.bound,
           "changed": mesh.changed, "optimizer seconds": mesh.seconds}
    for recovery, number in RECOVERIES.items():
        f.SetStressRecovery(number)
        solution = study.solve(f)
        if recovery == "patch":
            row["steps 1e-6"], row["steps 1e-8"] = solution.steps(1e-6), solution.steps(1e-8)
            centroids = points[cells].mean(1)
            row["rr centroid"], row["tt centroid"] = study.stress_errors(centroids, solution.cells("ElementStress"))
            row["displacement L2"] = study.displacement_error(points, cells, solution.points("Displacement"))
            row["stress L2"] = study.stress_l2_error(points, cells, solution.points("Stress"))
        row[f"rr {recovery}"], row[f"tt {recovery}"] = study.stress_errors(points, solution.points("Stress"))
        f.SetSolverToIncompleteCholesky()  # the same displacement, sooner
    return row


def add_claims(rows, names, way):
    """The claims of the paper, for one way of optimizing."""
    before = {name: rows[name, GENERATED] for name in names}
    after = {name: rows[name, way] for name in names}
    claims = study.Claims()

    def each(text, values, holds):
        claims.add(text, ", ".join(f"{name} {value:.2f}" for name, value in values.items()), all(map(holds, values.values())))

    each("error of s_tt by patch recovery, optimized over generated: at most half",
         {n: after[n]["tt patch"] / before[n]["tt patch"] for n in names}, lambda v: v <= 0.5)
    each("error of s_tt at the elements, optimized over generated: at most half",
         {n: after[n]["tt centroid"] / before[n]["tt centroid"] for n in names}, lambda v: v <= 0.5)
    errors = [after[n]["tt patch"] for n in names]
    claims.add("optimized, the error of s_tt falls with each refinement", ", ".join(f"{100 * e:.1f} %" for e in errors),
               all(np.diff(errors) < 0))
    if {"A", "C"} <= set(names):
        claims.add("optimizing A beats building C", f"{100 * after['A']['tt patch']:.1f} % on A optimized, "
                   f"{100 * before['C']['tt patch']:.1f} % on C as generated", after["A"]["tt patch"] < before["C"]["tt patch"])
    for tolerance in ("1e-6", "1e-8"):
        fall = {n: 1 - after[n][f"steps {tolerance}"] / before[n][f"steps {tolerance}"] for n in names}
        each(f"steps to {tolerance} fall by at least .2", fall, lambda v: v >= 0.2)
    if "D" in names:
        fall = 1 - after["D"]["steps 1e-6"] / before["D"]["steps 1e-6"]
        claims.add("steps to 1e-6 on D fall by at least .5", f"{fall:.2f}", fall >= 0.5)
    if len(names) > 1:
        first, last = after[names[0]], after[names[-1]]
        size = np.log(last["elements"] / first["elements"]) / 3
        for text, key, least in (("displacement, L2: order 2", "displacement L2", 1.9),
                                 ("recovered stress, L2: order at least 1.5", "stress L2", 1.5)):
            order = np.log(first[key] / last[key]) / size
            claims.add(f"{text}, from {names[0]} to {names[-1]}", f"{order:.2f}", order >= least)
    return claims


def markdown(rows, names, ways):
    percent = lambda v: f"{100 * v:.1f}"  # noqa: E731
    table = []
    for name in names:
        elements, generated, optimized = PAPER[name]
        for state, values in (("generated", generated), ("optimized", optimized)):
            quality, rr, tt, steps = values
            table.append((name, f"*paper, {state}*", elements, f"{quality:g}", "", "", "", "", "", f"{rr:g}", f"{tt:g}", "", "", steps, ""))
        for way in (GENERATED, *ways):
            r = rows[name, way]
            table.append((name, way, r["elements"], f"{r['worst']:.4f}", f"{r['bound']:.3f}", f"{r['mean']:.3f}", r["changed"] or "",
                          percent(r["rr centroid"]), percent(r["tt centroid"]), percent(r["rr patch"]), percent(r["tt patch"]),
                          percent(r["tt local patch"]), percent(r["tt volume average"]), r["steps 1e-6"], r["steps 1e-8"]))
    return study.markdown_table(
        ("mesh", "state", "elements", "worst quality", "bound", "mean", "changed", "s_rr centroid", "s_tt centroid", "s_rr patch",
         "s_tt patch", "s_tt local patch", "s_tt average", "steps 1e-6", "steps 1e-8"), table)


if __name__ == "__main__":
    sys.exit(study.make_table("table1", __doc__, PAPER, measure, markdown, add_claims, TEXT))
