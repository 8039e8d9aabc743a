# SPDX-License-Identifier: BSD-3-Clause
"""two_cracks_reference.py: against the closed form, one inclined crack, and what a field of stress must satisfy."""
import sys

import numpy as np

from two_cracks_reference import Cracks, closed_form, elliptic_integrals, gap_for_ratio, two_cracks

failures = []


def check(condition, *message):
    if not condition:
        failures.append(" ".join(str(m) for m in message))


def test_closed_form():
    first, second = elliptic_integrals(0.5)
    check(abs(first - 1.8540746773013719) < 1e-14 and abs(second - 1.3506438810476755) < 1e-14, "elliptic", first, second)
    # the ratios of the literature, to the digits given
    for gap, wanted in ((0.1, 1.329), (0.05, 1.560), (0.0452, 1.600), (0.03, 1.787), (0.02, 2.009)):
        inner, outer = closed_form(gap)
        check(abs(inner / outer - wanted) < 1e-3, "ratio at", gap, inner / outer)
    for gap in (1.0, 0.1, 0.05, 0.037, 0.02):
        inner, outer = closed_form(gap, half_length=2.5)
        k = two_cracks(gap, angle=0, half_length=2.5).intensity()
        found = np.abs(k[:, :, 0] / [[outer, inner], [inner, outer]] - 1).max()
        check(found < 1e-6, "collinear at", gap, found)
        check(np.abs(k[:, :, 1]).max() < 1e-9, "K_II of collinear cracks", np.abs(k[:, :, 1]).max())


def test_one_crack():
    angle, half = np.radians(35), 1.7
    k = Cracks([(2 - 1j, half, angle)], points=16).intensity()[0] / np.sqrt(np.pi * half)
    check(np.abs(k - [np.cos(angle) ** 2, np.sin(angle) * np.cos(angle)]).max() < 1e-12, "inclined crack", k)
    k = Cracks([(0, 1.0, 0)], stress=(0, 0, 1), points=16).intensity()[0] / np.sqrt(np.pi)
    check(np.abs(k - [0, 1]).max() < 1e-12, "crack in shear", k)


def test_converged():
    for gap in (0.1, 0.037, 0.02):
        change = np.abs(two_cracks(gap).intensity() - two_cracks(gap, points=256).intensity()).max()
        check(change < 1e-6, "not converged at gap", gap, change)


def test_turned_as_a_whole():
    """Cracks and load turned together: nothing changes along and across the cracks."""
    turn = 0.7
    c, s = np.cos(turn), np.sin(turn)
    stress = (s * s, c * c, -s * c)  # tension along what was the y axis
    whole = two_cracks(0.05)
    cracks = [(complex(z) * np.exp(1j * turn), float(a), float(angle) + turn)
              for z, a, angle in zip(whole.centre[:, 0], whole.half[:, 0], whole.angle[:, 0])]
    change = np.abs(Cracks(cracks, stress).intensity() - whole.intensity()).max()
    check(change < 1e-9, "turned as a whole", change)


def test_stress():
    """In equilibrium, the trace harmonic, no traction on the cracks, the remote stress far away."""
    cracks = two_cracks(0.1, angle=25, points=700)
    z = np.array([0.05j, 0.3 + 0.4j, -2.3 + 0.2j, 1 - 0.5j])
    h = 3e-4
    east, west, north, south, here = (cracks.stress(z + d) for d in (h, -h, 1j * h, -1j * h, 0))
    force = np.abs((east - west)[:, [0, 2]] + (north - south)[:, [2, 1]]).max() / (2 * h)
    trace = np.abs((east + west + north + south - 4 * here)[:, :2].sum(axis=1)).max() / h**2
    check(force < 1e-3 and trace < 0.05, "stress not that of an elastic plane: force", force, "Laplacian of the trace", trace)
    for crack in range(2):
        normal = 1j * np.exp(1j * cracks.angle[crack, 0])
        face = cracks.positions(np.linspace(-0.6, 0.6, 7))[crack]
        for side in (1, -1):
            near = []
            for distance in (0.01, 0.02, 0.03):
                xx, yy, xy = cracks.stress(face + side * distance * normal).T
                near.append((xx * normal.real + xy * normal.imag) + 1j * (xy * normal.real + yy * normal.imag))
            traction = np.abs(3 * near[0] - 3 * near[1] + near[2]).max()  # a quadratic, taken to the face
            check(traction < 5e-3, "traction on a face of crack", crack, traction)
    far = np.abs(cracks.stress(np.array([1e4, 1e4j])) - [0, 1, 0]).max()
    check(far < 1e-7, "far away", far)


def test_paper():
    gap = gap_for_ratio(1.6)
    check(abs(gap - 0.037) < 5e-4, "gap for the ratio 1.6, turned by 10 degrees", gap)
    gap = gap_for_ratio(1.6, angle=0)
    check(abs(gap - 0.0452) < 5e-5, "gap for the ratio 1.6, collinear", gap)


for name, test in list(globals().items()):
    if name.startswith("test_"):
        test()
print("\n".join(failures) or "passed")
sys.exit(len(failures) > 0)
