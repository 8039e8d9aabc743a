# SPDX-License-Identifier: BSD-3-Clause
"""Stress intensity factors of straight cracks in an infinite plane under remote load: the reference for section 5.3 of the paper.

    /usr/bin/python3 two_cracks_reference.py [GAP ...]     the two cracks at these gaps, and the gap for the ratio 1.6

Needs numpy only. Method of singular integral equations: the jump of the displacement across each crack has the derivative
g(t) = phi(t) / sqrt(1 - t^2), t from -1 to 1 along it, and the tractions that all g make on a crack cancel those of the remote
load there (M. P. Savruk, Two-dimensional problems of elasticity for bodies with cracks, 1981; the kernels are in M. Kachanov,
Adv. Appl. Mech. 30 (1993), IV). With n Gauss-Chebyshev points t_j = cos((2j-1) pi/2n) and the traction asked for at
x_i = cos(i pi/n), i = 1 .. n-1 (F. Erdogan, G. D. Gupta, Quart. Appl. Math. 29 (1972) 525-534), and no net jump, this is a linear
system; errors fall exponentially with n, slower the closer the cracks are. For two collinear cracks there is a closed form.
"""
import sys

import numpy as np


class Cracks:
    """Cracks (centre as a complex number, half-length, angle in radians) under the remote stress (xx, yy, xy)."""

    def __init__(self, cracks, stress=(0.0, 1.0, 0.0), points=128):
        self.centre, self.half, self.angle = (np.array(column)[:, None] for column in zip(*cracks))
        self.remote = np.array(stress, dtype=float)
        self.n = n = points
        self.t = np.cos((2 * np.arange(1, n + 1) - 1) * np.pi / (2 * n))
        self.phi = self._solve(np.cos(np.arange(1, n) * np.pi / n))

    def positions(self, parameter):
        """Of a parameter from -1 to 1 on each crack, complex: cracks x parameters."""
        return self.centre + self.half * np.exp(1j * self.angle) * parameter

    def _solve(self, x):
        cracks, n = len(self.centre), self.n
        sources, targets = self.positions(self.t).reshape(-1), self.positions(x).reshape(-1)
        turn = np.repeat(np.exp(1j * self.angle) * self.half, n)  # dz = turn dt
        back = np.repeat(np.exp(-2j * self.angle), n - 1)[:, None]
        d = sources[None, :] - targets[:, None]
        # normal - i shear traction at the targets = (of_g g + of_conjugate conj(g)) / n
        of_g = turn / 2 * (1 / d + back / d.conj())
        of_conjugate = turn.conj() / 2 * (1 / d.conj() - back * d / d.conj() ** 2)
        closed = np.kron(np.eye(cracks), np.ones(n))
        a = np.concatenate([of_g, closed]) / n
        b = np.concatenate([of_conjugate, 0 * closed]) / n
        right = np.concatenate([-self._load(np.repeat(self.angle, n - 1)), np.zeros(cracks)])
        system = np.block([[(a + b).real, (b - a).imag], [(a + b).imag, (a - b).real]])
        g = np.linalg.solve(system, np.concatenate([right.real, right.imag]))
        return (g[:cracks * n] + 1j * g[cracks * n:]).reshape(cracks, n)

    def _load(self, angle):
        """Normal - i shear traction of the remote stress on lines of that angle."""
        xx, yy, xy = self.remote
        return ((xx + yy) / 2 + np.exp(-2j * angle) * ((yy - xx) / 2 - 1j * xy))

    def intensity(self):
        """[crack, end, mode]: K_I and K_II at t = -1 and t = +1, axes of a tip being along and across its crack."""
        n = self.n
        j = np.arange(1, n + 1)
        half_angle = (2 * j - 1) * np.pi / (4 * n)
        right = (self.phi * (-1.0) ** (j + 1) / np.tan(half_angle)).sum(axis=1) / n
        left = (self.phi * (-1.0) ** (j + n) * np.tan(half_angle)).sum(axis=1) / n
        k = np.sqrt(np.pi * self.half) * np.stack([left, -right], axis=1)
        return np.stack([k.real, -k.imag], axis=2)

    def stress(self, z):
        """(xx, yy, xy) at points z (complex) that are not too close to a crack: farther than some 4/n of its length."""
        z = np.asarray(z)
        source, turn = self.positions(self.t).reshape(-1), np.repeat(np.exp(1j * self.angle) * self.half, self.n)
        g = self.phi.reshape(-1) * turn / (2 * self.n)
        conjugate = self.phi.reshape(-1).conj() * turn.conj() / (2 * self.n)
        d = source - z[..., None]
        # Muskhelishvili's potentials, and the derivative of the first
        first = (g / d).sum(axis=-1)
        slope = (g / d ** 2).sum(axis=-1)
        second = (conjugate / d - source.conj() * g / d ** 2).sum(axis=-1)
        mean, deviator = 2 * first.real, z.conj() * slope + second
        return self.remote + np.stack([mean - deviator.real, mean + deviator.real, deviator.imag], axis=-1)


def two_cracks(gap, angle=10.0, half_length=1.0, points=128):
    """The paper's two cracks under unit tension along y: the left one on the x axis, the right one turned by `angle`
    degrees about its centre. gap: between the inner tips before the turn, in parts of the cracks' length 2a."""
    distance = half_length * (1 + gap)
    return Cracks([(-distance, half_length, 0.0), (distance, half_length, np.radians(angle))], points=points)


def closed_form(gap, half_length=1.0):
    """(K at the inner tips, K at the outer tips) of two collinear cracks under unit tension, by elliptic integrals."""
    b = gap * half_length
    c = b + 2 * half_length
    first, second = elliptic_integrals(1 - (b / c) ** 2)
    square = c * c * second / first
    root = np.sqrt(c * c - b * b)
    return np.sqrt(np.pi / b) * (square - b * b) / root, np.sqrt(np.pi / c) * (c * c - square) / root


def elliptic_integrals(m):
    """Complete ones, (K, E), of the parameter m = k^2, by the arithmetic-geometric mean."""
    a, g, total, weight = 1.0, np.sqrt(1 - m), m / 2, 0.5
    while abs(a - g) > 1e-15 * a:
        c = (a - g) / 2
        a, g, weight = (a + g) / 2, np.sqrt(a * g), 2 * weight
        total += weight * c * c
    return np.pi / (2 * a), np.pi / (2 * a) * (1 - total)


def ratio(cracks):
    """Of the mean K_I at the two inner tips to that at the two outer ones."""
    k = cracks.intensity()[:, :, 0]
    return (k[0, 1] + k[1, 0]) / (k[0, 0] + k[1, 1])


def gap_for_ratio(wanted, angle=10.0):
    """The gap, in parts of 2a, at which the ratio is the wanted one. It falls as the gap grows."""
    low, high = 0.01, 1.0
    for _ in range(24):
        middle = np.sqrt(low * high)
        low, high = (middle, high) if ratio(two_cracks(middle, angle)) > wanted else (low, middle)
    return np.sqrt(low * high)


def main():
    print("gap/2a  angle    left outer          left inner          right inner         right outer     K_I ratio")
    for gap in [float(text) for text in sys.argv[1:]] or [0.1, 0.05, 0.037, 0.03, 0.02]:
        for angle in (0.0, 10.0):
            cracks = two_cracks(gap, angle)
            tips = cracks.intensity().reshape(-1, 2) / np.sqrt(np.pi)
            print(f"{gap:6g}  {angle:5g}  " + "  ".join("%8.5f %+8.5f" % tuple(tip) for tip in tips) + f"  {ratio(cracks):8.5f}")
    print("K_I, K_II over sigma sqrt(pi a). The ratio 1.6 needs gap/2a =",
          ", ".join(f"{gap_for_ratio(1.6, angle):.5f} at {angle:g} degrees" for angle in (0.0, 10.0)))


if __name__ == "__main__":
    main()
