# SPDX-License-Identifier: BSD-3-Clause
"""Thermoelastic against CalculiX (Debian 12's calculix-ccx): the same mesh, material, temperature, constraints and loads.

    /usr/bin/python3 Testing/Paper/calculix.py [MESH.vtu] [--folder DIR] [--ccx PROGRAM]

Without a mesh: a box of two materials, held on one side with prescribed displacements, pressed on another, and heated. With one
(tetrahedra only): one material, the lowest plane held in z, three points held against rigid motion, the highest plane pressed,
a radial temperature. Prints the greatest differences of displacements, element stresses and reactions, each relative to the
greatest value. CalculiX prints seven digits. The exit status is 1 if displacements differ by more than 1e-6 or the others by
more than 1e-5, and 77 if there is no ccx.
"""
import argparse
import pathlib
import shutil
import subprocess
import sys
import tempfile

import numpy as np
from meshoptimize import vtkThermoelasticFilter
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

NO_CCX = 77
FACES = ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))  # CalculiX' P1 to P4


class Case:
    """What both programs are given. E, nu and alpha have a value per cell."""

    def __init__(self, x, cells):
        self.x, self.cells = x, cells
        self.E, self.nu, self.alpha = (np.full(len(cells), v) for v in (200e9, 0.316, 1e-5))
        self.T, self.reference = np.zeros(len(x)), 20.0
        self.fixed, self.values = np.zeros(x.shape, dtype=np.uint8), np.zeros(x.shape)
        self.pressed, self.pressure = np.zeros(len(x), dtype=bool), 5e7

    def pressed_faces(self):
        """(cell, face) pairs: faces of the pressed points that belong to one cell only."""
        found = {}
        for c, nodes in enumerate(self.cells):
            if self.pressed[nodes].sum() >= 3:
                for k, face in enumerate(FACES):
                    points = nodes[list(face)]
                    if self.pressed[points].all():
                        found.setdefault(tuple(sorted(points)), []).append((c, k))
        return [where[0] for where in found.values() if len(where) == 1]


def box_case(n=5):
    random = np.random.default_rng(1996)
    index = np.arange((n + 1) ** 3).reshape(n + 1, n + 1, n + 1)
    x = np.stack(np.meshgrid(*[np.linspace(0, 1, n + 1)] * 3, indexing="ij"), -1).reshape(-1, 3)
    inside = ((x > 1e-9) & (x < 1 - 1e-9)).all(1)
    x[inside] += random.uniform(-0.15 / n, 0.15 / n, (inside.sum(), 3))
    cells = []
    for corner in np.ndindex(n, n, n):
        for order in ((0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (1, 0, 2), (2, 1, 0)):
            at = np.array(corner)
            path = [index[corner]]
            for axis in order:
                at[axis] += 1
                path.append(index[tuple(at)])
            flip = np.linalg.det(x[path[1:]] - x[path[0]]) < 0
            cells.append([path[i] for i in ((0, 2, 1, 3) if flip else (0, 1, 2, 3))])
    case = Case(x, np.array(cells))
    upper = x[case.cells].mean(1)[:, 2] > 0.5
    case.E[upper], case.nu[upper], case.alpha[upper] = 70e9, 0.2, 2.4e-5
    case.T = 20 + 400 * x[:, 0] ** 2 - 150 * x[:, 1]
    case.fixed[x[:, 0] == 0] = 1
    case.fixed[x[:, 1] == 0, 1] = 1
    case.values = np.where(case.fixed, random.uniform(-1e-3, 1e-3, x.shape), 0.0)
    case.pressed = x[:, 2] == 1
    return case


def mesh_case(path):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    cells = [[grid.GetCell(c).GetPointId(i) for i in range(4)] for c in range(grid.GetNumberOfCells())
             if grid.GetCellType(c) == VTK_TETRA]
    x = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    case = Case(x, np.array(cells))
    low, high = x[:, 2].min(), x[:, 2].max()
    near = 1e-6 * (high - low)
    bottom = np.flatnonzero(x[:, 2] <= low + near)
    case.T = 2468 - 5286 * (x[:, 0] ** 2 + x[:, 1] ** 2)
    case.fixed[bottom, 2] = 1
    west, east = bottom[x[bottom, 0].argmin()], bottom[x[bottom, 0].argmax()]
    case.fixed[west, :2] = 1
    case.fixed[east, 1] = 1
    case.pressed = x[:, 2] >= high - near
    return case


def solve_here(case):
    grid = vtkUnstructuredGrid()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(case.x, deep=1))
    grid.SetPoints(points)
    grid.Allocate(len(case.cells))
    for nodes in case.cells:
        grid.InsertNextCell(VTK_TETRA, 4, [int(i) for i in nodes])
    pressure = np.where(case.pressed, case.pressure, 0.0)
    for data, arrays in (
            (grid.GetPointData(), {"Temperature": case.T, "Constraint": case.fixed, "PrescribedDisplacement": case.values,
                                   "Traction": pressure}),
            (grid.GetCellData(), {"YoungsModulus": case.E, "PoissonsRatio": case.nu, "ThermalExpansion": case.alpha})):
        for name, values in arrays.items():
            array = numpy_to_vtk(np.ascontiguousarray(values), deep=1)
            array.SetName(name)
            data.AddArray(array)
    f = vtkThermoelasticFilter()
    f.SetInputData(grid)
    f.SetReferenceTemperature(case.reference)
    f.SetTolerance(1e-13)
    f.SetStressRecoveryToNone()
    f.Update()
    if f.GetStopReasonAsString() != "Converged":
        sys.exit(f"Thermoelastic: {f.GetStopReasonAsString()}")
    out = f.GetOutput(0)
    stress = vtk_to_numpy(out.GetCellData().GetArray("ElementStress"))
    return (vtk_to_numpy(out.GetPointData().GetArray("Displacement")), stress,
            vtk_to_numpy(out.GetPointData().GetArray("Reaction")))


def number(value):
    """CalculiX reads 20 characters at most."""
    return f"{float(value):.13e}"


def write_input(case, path):
    """Ids of CalculiX start at 1."""
    used = np.unique(case.cells)
    materials, of_cell = np.unique(np.column_stack([case.E, case.nu, case.alpha]), axis=0, return_inverse=True)
    of_cell = of_cell.ravel()
    with open(path, "w", encoding="ascii") as f:
        f.write("*NODE, NSET=ALL\n")
        for i in used:
            f.write(f"{i + 1}, {number(case.x[i, 0])}, {number(case.x[i, 1])}, {number(case.x[i, 2])}\n")
        for m in range(len(materials)):
            f.write(f"*ELEMENT, TYPE=C3D4, ELSET=PART{m}\n")
            for c in np.flatnonzero(of_cell == m):
                f.write(f"{c + 1}, " + ", ".join(str(i + 1) for i in case.cells[c]) + "\n")
        for m, (E, nu, alpha) in enumerate(materials):
            f.write(f"*MATERIAL, NAME=M{m}\n*ELASTIC\n{number(E)}, {number(nu)}\n"
                    f"*EXPANSION, ZERO={number(case.reference)}\n{number(alpha)}\n"
                    f"*SOLID SECTION, ELSET=PART{m}, MATERIAL=M{m}\n")
        f.write(f"*INITIAL CONDITIONS, TYPE=TEMPERATURE\nALL, {number(case.reference)}\n*STEP\n*STATIC\n*BOUNDARY\n")
        for i in used:
            for k in np.flatnonzero(case.fixed[i]):
                f.write(f"{i + 1}, {k + 1}, {k + 1}, {number(case.values[i, k])}\n")
        f.write("*TEMPERATURE\n")
        for i in used:
            f.write(f"{i + 1}, {number(case.T[i])}\n")
        faces = case.pressed_faces()
        if faces:
            f.write("*DLOAD\n")
            for c, k in faces:
                f.write(f"{c + 1}, P{k + 1}, {number(case.pressure)}\n")
        f.write("*NODE PRINT, NSET=ALL\nU, RF\n")
        for m in range(len(materials)):
            f.write(f"*EL PRINT, ELSET=PART{m}\nS\n")
        f.write("*END STEP\n")


def read_output(case, path):
    """The .dat file: blocks of rows behind a headline each."""
    u, reaction = np.zeros(case.x.shape), np.zeros(case.x.shape)
    stress = np.zeros((len(case.cells), 6))
    target = None
    for line in open(path, encoding="ascii"):
        words = line.split()
        if line.startswith(" displacements"):
            target = u
        elif line.startswith(" forces"):
            target = reaction
        elif line.startswith(" stresses"):
            target = stress
        elif words and words[0].isdigit():
            numbers = [float(w) for w in words[-target.shape[1]:]]
            target[int(words[0]) - 1] = numbers
    return u, stress[:, [0, 1, 2, 3, 5, 4]], reaction  # its order: XX YY ZZ XY XZ YZ


def solve_there(case, ccx, folder):
    write_input(case, folder / "case.inp")
    run = subprocess.run([ccx, "case"], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if run.returncode != 0 or "*ERROR" in run.stdout or not (folder / "case.dat").exists():
        sys.exit(f"ccx failed:\n{run.stdout[-2000:]}")
    return read_output(case, folder / "case.dat")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", nargs="?")
    parser.add_argument("--folder", help="where the files of CalculiX stay (default: a temporary folder)")
    parser.add_argument("--ccx", default=shutil.which("ccx"))
    opt = parser.parse_args()
    if not opt.ccx:
        print("there is no ccx (Debian 12: calculix-ccx); nothing compared")
        return NO_CCX
    case = mesh_case(opt.mesh) if opt.mesh else box_case()
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(opt.folder or temporary)
        folder.mkdir(parents=True, exist_ok=True)
        here, there = solve_here(case), solve_there(case, opt.ccx, folder)
    good = True
    print(f"{len(case.cells)} tetrahedra, {case.fixed.sum()} components prescribed, {len(case.pressed_faces())} facets pressed")
    for name, a, b, limit in zip(("displacement", "element stress", "reaction"), here, there, (1e-6, 1e-5, 1e-5)):
        if name == "reaction":  # CalculiX prints reaction and load together where there are both
            only = case.fixed * ~case.pressed[:, None]
            a, b = a * only, b * only
        difference = np.abs(a - b).max() / np.abs(b).max()
        good &= bool(difference < limit and np.abs(b).max() > 0)
        print(f"{name}: greatest {np.abs(b).max():.4g}, greatest difference relative to it {difference:.1e}, limit {limit:g}")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
