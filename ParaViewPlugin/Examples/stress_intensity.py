# SPDX-License-Identifier: BSD-3-Clause
"""Stress intensity factors K_I and K_II of crack tips from a finite element solution on linear triangles.

    from stress_intensity import Material, Solution, Tip, displacement_extrapolation, interaction_integral

    solution = Solution.of_grid(thermoelastic.GetOutput())
    tip = Tip(position=(1, 0), direction=(1, 0))                     # direction: along the crack, out of it
    k1, k2 = interaction_integral(solution, tip, Material(2e11, 0.3), radius=0.2)

Cracks are straight near the tip, their faces free of load, with nodes of their own on each side. The triangles lie in the xy
plane. Only `Displacement` is read: the stress is the elements' own, without thermal strain.
"""
from dataclasses import dataclass

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import VTK_TRIANGLE

# Seven points that are exact for polynomials of degree 5: barycentric coordinates and weights (J. Radon, 1948)
_A, _B = (6 - np.sqrt(15)) / 21, (6 + np.sqrt(15)) / 21
_POINTS = np.array([[1 / 3, 1 / 3, 1 / 3]] + [np.roll([1 - 2 * c, c, c], k) for c in (_A, _B) for k in range(3)])
_WEIGHTS = np.array([9 / 40] + 3 * [(155 - np.sqrt(15)) / 1200] + 3 * [(155 + np.sqrt(15)) / 1200])


@dataclass
class Material:
    youngs_modulus: float
    poissons_ratio: float
    plane_stress: bool = False

    @property
    def shear(self):
        return self.youngs_modulus / (2 * (1 + self.poissons_ratio))

    @property
    def kappa(self):
        """Kolosov's constant."""
        nu = self.poissons_ratio
        return (3 - nu) / (1 + nu) if self.plane_stress else 3 - 4 * nu

    @property
    def effective(self):
        """E' of J = (K_I^2 + K_II^2) / E'."""
        return 8 * self.shear / (1 + self.kappa)


@dataclass
class Tip:
    position: tuple
    direction: tuple  # along the crack, out of it

    def local(self, vectors):
        """Along and across the crack."""
        c, s = np.asarray(self.direction) / np.linalg.norm(self.direction)
        return np.asarray(vectors) @ np.array([[c, -s], [s, c]])


@dataclass
class Solution:
    points: np.ndarray        # n x 2
    triangles: np.ndarray     # m x 3, counter-clockwise
    displacement: np.ndarray  # n x 2

    @classmethod
    def of_grid(cls, grid):
        """The triangles of a vtkUnstructuredGrid with the point array Displacement; other cells are left out."""
        types = np.array([grid.GetCellType(i) for i in range(grid.GetNumberOfCells())])
        cells = grid.GetCells()
        start = vtk_to_numpy(cells.GetOffsetsArray())[:-1][types == VTK_TRIANGLE]
        ids = vtk_to_numpy(cells.GetConnectivityArray())[start[:, None] + np.arange(3)]
        points = vtk_to_numpy(grid.GetPoints().GetData())[:, :2].astype(float)
        a, b, c = (points[ids[:, i]] for i in range(3))
        clockwise = _cross(b - a, c - a) < 0
        ids[clockwise] = ids[clockwise][:, ::-1]
        return cls(points, ids, vtk_to_numpy(grid.GetPointData().GetArray("Displacement"))[:, :2])

    def gradients(self, cells, positions):
        """Gradients of the shape functions (cells x node x component) and areas, the nodes being at these positions."""
        x = positions[self.triangles[cells]]
        opposite = np.roll(x, -2, axis=1) - np.roll(x, -1, axis=1)
        double = _cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0])
        return np.stack([-opposite[..., 1], opposite[..., 0]], axis=-1) / double[:, None, None], double / 2

    def boundary(self):
        """Edges with one triangle, and the third node of that: three arrays of nodes."""
        a, b, c = (np.roll(self.triangles, -k, axis=1).reshape(-1) for k in range(3))
        key = np.minimum(a, b) * len(self.points) + np.maximum(a, b)
        _, first, count = np.unique(key, return_index=True, return_counts=True)
        once = first[count == 1]
        return a[once], b[once], c[once]


def _cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def near_tip_field(z, k, material):
    """Williams' first term for k = K_I - i K_II: stress (.. x 2 x 2) and du/dx (.. x 2) at z = x + i y from the tip, the crack
    being on the negative x axis (Muskhelishvili's potentials)."""
    phi = k / (2 * np.sqrt(2 * np.pi * z))
    omega = k / (2 * np.sqrt(2 * np.pi * z.conj()))  # the same function, at the mirrored point
    slope = (z - z.conj()) * (-phi / (2 * z)).conj()
    across = phi + omega + slope                     # yy - i xy
    along = 4 * phi.real - across.real
    stress = np.stack([along, -across.imag, -across.imag, across.real], axis=-1).reshape(z.shape + (2, 2))
    derivative = (material.kappa * phi - omega - slope) / (2 * material.shear)
    return stress, np.stack([derivative.real, derivative.imag], axis=-1)


def interaction_integral(solution, tip, material, radius, core=0.25):
    """(K_I, K_II) by the domain form of the interaction integral (J. F. Yau, S. S. Wang, H. T. Corten 1980; B. Moran, C. F. Shih
    1987). The weight is 1 up to core * radius from the tip, falls to 0 at the radius, and is linear in each triangle.

    radius: within it there must be nothing but the body and this straight crack; at least four elements should lie along it.
    """
    position = tip.local(solution.points - np.asarray(tip.position, dtype=float))
    r = np.hypot(*position.T)
    weight = np.clip((radius - r) / (radius * (1 - core)), 0, 1)
    corner_weights = weight[solution.triangles]
    cells = np.flatnonzero(np.ptp(corner_weights, axis=1) > 0)
    if len(cells) < 8:
        raise ValueError(f"only {len(cells)} triangles within the radius {radius:g} of the tip at {tip.position}")
    shape, area = solution.gradients(cells, position)
    slope = np.einsum("ci,cij->cj", corner_weights[cells], shape)
    # derivative[c, i, j] = d u_i / d x_j
    derivative = np.einsum("cki,ckj->cij", tip.local(solution.displacement)[solution.triangles[cells]], shape)
    strain = (derivative + derivative.transpose(0, 2, 1)) / 2
    mu, kappa = material.shear, material.kappa
    trace = mu * (3 - kappa) / (kappa - 1) * np.trace(strain, axis1=1, axis2=2)
    stress = 2 * mu * strain + trace[:, None, None] * np.eye(2)

    at = np.einsum("gk,ckj->cgj", _POINTS, position[solution.triangles[cells]])
    factors = []
    for k in (1, -1j):
        other, other_derivative = near_tip_field(at[..., 0] + 1j * at[..., 1], k, material)
        energy = np.einsum("cgij,cij->cg", other, strain)  # of either state in the strain of the other one
        flux = (np.einsum("cij,cgi,cj->cg", stress, other_derivative, slope)
                + np.einsum("cgij,ci,cj->cg", other, derivative[:, :, 0], slope) - energy * slope[:, None, 0])
        factors.append(material.effective / 2 * np.einsum("cg,g,c->", flux, _WEIGHTS, area))
    return tuple(factors)


def displacement_extrapolation(solution, tip, material, radii):
    """(K_I, K_II) from the jump of the displacement across the crack at these distances from the tip.

    What the first term of the field would have at each is fitted by K + a r + b / r: the field's next term is a r; and as linear
    elements at the tip are too stiff, the crack opens as if its tip were a part of an element further back, which is b / r.
    Radii: three at least, several elements away from the tip.
    """
    radii = np.asarray(radii, dtype=float)
    at_radii = opening_factors(solution, tip, material, radii)
    return tuple(np.linalg.lstsq(np.stack([np.ones_like(radii), radii, 1 / radii], axis=1), at_radii, rcond=None)[0][0])


def opening_factors(solution, tip, material, radii):
    """radii x (K_I, K_II), as the first term of the field would have it at each distance."""
    position = tip.local(solution.points - np.asarray(tip.position, dtype=float))
    displacement = tip.local(solution.displacement)
    a, b, third = solution.boundary()
    tolerance = 1e-6 * np.max(radii)
    on = np.all([np.abs(position[n, 1]) <= tolerance for n in (a, b)], axis=0)
    on &= np.all([position[n, 0] <= tolerance for n in (a, b)], axis=0)
    jump = 0
    for side in (1, -1):
        face = on & (side * position[third, 1] > 0)
        nodes = np.unique(np.concatenate([a[face], b[face]]))
        nodes = nodes[np.argsort(-position[nodes, 0])]
        distance = -position[nodes, 0]
        if len(nodes) < 2 or distance[0] > np.min(radii) or distance[-1] < np.max(radii):
            raise ValueError(f"no crack face of length {np.max(radii):g} at the tip at {tip.position}")
        jump = jump + side * np.stack([np.interp(radii, distance, displacement[nodes, i]) for i in (1, 0)], axis=1)
    return material.effective / 8 * np.sqrt(2 * np.pi / radii)[:, None] * jump
