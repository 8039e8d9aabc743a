# SPDX-License-Identifier: BSD-3-Clause
"""Bodies that are hard for a surface that takes part (Boundary Mode Slide), and what must stay of each, as a Markdown table.

    eval "$(./bootstrap.sh env)"
    /usr/bin/python3 Testing/Benchmarks/sliding_bodies.py [options] [BODY ...]

    --tolerance T ...      default 0 1e-4 1e-3 1e-2
    --effort quick|default|best   default: default
    --growth G             growth budget, default .15
    --limit SECONDS        time limit of one run, default 30
    --seed N               of the perturbed nodes, default 0
    --judge FOLDER         with check_surface.py and check_patches.py
    --output FOLDER        where the meshes are written (default: a temporary one)

Gmsh makes the bodies (python3-gmsh), TetGen fills them without optimization. Checked for all: the worst quality does not fall,
no cell is inverted, the distance is within the tolerance, the judges. And for

- sectors, lens: three regions meet in a straight line, or (and the outside) in circles: volume of each, by the judge;
- crack, curved: a closed crack with doubled nodes, plane in a cylinder from its curved side, or itself part of a cylinder: the
  facets of both lips are the same, as many as before up to the growth, and of the same area; its front stays;
- plate, shell: 4e-4 of the diagonal thick: the volume within area x tolerance / 2, and of what it was by a quarter;
- heated: triangles number the faces; one is held (point array Constraint), one loaded (point array Traction, and FacetTraction at
  its triangles): held area and total load within the tolerance times the length of the border.

One thread. The exit status is 1 if anything is wrong.
"""
import argparse
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from meshoptimize import vtkMeshOptimizeFilter
from optimize_meshes import EFFORTS, write
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../Fuzz"))
from fuzz_filter import cell_lists, coordinates, shape
from fuzz_solids import area, border_length
from fuzz_surface import FACES, surface, volumes
from solids import fill, grid_of, in_child, is_missing, mesh_of_surface


# ---- solids: called with Gmsh's OpenCASCADE, give the volumes ----------------------------------------------------------------------

def sectors(occ):
    body = [(3, occ.addCylinder(0, 0, 0, 0, 0, 1, 0.5))]
    tools = [(3, occ.addBox(0, -1, -1, 2, 1, 3)), (3, occ.addBox(0, 0, -1, 2, 2, 3))]
    return split(occ, body, tools)


def lens(occ):
    return split(occ, [(3, occ.addSphere(0, 0, 0, 0.5)), (3, occ.addSphere(0.45, 0.1, 0.05, 0.4))], [])


def crack(occ):
    return split(occ, [(3, occ.addCylinder(0, 0, 0, 0, 0, 1, 0.5))], [(3, occ.addBox(0, -1, -1, 2, 2, 3))])


def curved(occ):
    return split(occ, [(3, occ.addCylinder(0, 0, 0, 0, 0, 1, 0.5))], [(3, occ.addCylinder(0, 0, -1, 0, 0, 3, 0.3))])


def plate(occ):
    return [(3, occ.addBox(0, 0, 0, 1, 0.7, 4e-4 * 1.49 ** 0.5))]


def heated(occ):
    body = occ.cut([(3, occ.addBox(0, 0, 0, 1, 0.8, 0.5))], [(3, occ.addCylinder(0.5, 0.4, -1, 0, 0, 3, 0.2))])[0]
    return occ.fuse(body, [(3, occ.addCylinder(0.85, 0.65, 0.4, 0, 0, 0.3, 0.1))])[0]


def split(occ, body, tools):
    out, origin = occ.fragment(body, tools)
    keep = sorted({x for one in origin[:len(body)] for x in one})
    occ.remove([x for x in out if x not in keep], recursive=True)
    return keep


# name: (solid, triangles, perturbed by how much of the shortest edge)
BODIES = {"sectors": (sectors, 900, 0.0), "sectors-thrown": (sectors, 900, 0.1), "lens": (lens, 900, 0.0), "lens-thrown": (lens, 900, 0.1),
          "crack": (crack, 900, 0.0), "crack-thrown": (crack, 900, 0.05), "curved": (curved, 900, 0.0), "curved-thrown": (curved, 900, 0.05),
          "plate": (plate, 900, 0.0), "plate-thrown": (plate, 900, 1e-4), "shell": (plate, 900, 0.0), "heated": (heated, 900, 0.0),
          "heated-thrown": (heated, 900, 0.05)}


def key_of(points, facet):
    return tuple(sorted(map(tuple, points[facet].tolist())))


def open_crack(points, cells, cut):
    """Doubles nodes such that the facets of `cut` (sorted nodes) have a facet of their own on each side."""
    cut = {tuple(x) for x in np.sort(cut, axis=1).tolist()}
    points, cells = list(points), cells.copy()
    around = {}
    for c, cell in enumerate(cells.tolist()):
        for v in cell:
            around.setdefault(v, []).append(c)
    before = cells.copy()
    for v in sorted({x for facet in cut for x in facet}):
        left = set(around[v])
        first = True
        while left:
            todo = [left.pop()]
            group = set(todo)
            while todo:
                c = todo.pop()
                mine = [tuple(sorted(before[c][f])) for f in FACES if v in before[c][f]]
                mine = {x for x in mine if x not in cut}
                for d in list(left):
                    if any(tuple(sorted(before[d][f])) in mine for f in FACES):
                        left.discard(d)
                        group.add(d)
                        todo.append(d)
            if not first:
                points.append(points[v])
                for c in group:
                    cells[c][cells[c] == v] = len(points) - 1
            first = False
    return np.array(points), cells


class Body:
    def __init__(self, name, seed):
        solid, count, thrown = BODIES[name]
        done, fault = in_child(lambda: mesh_of_surface(solid, count), 60)
        if fault:
            sys.exit(f"{name}: Gmsh {fault}")
        points, triangles, faces = done
        random = np.random.default_rng(seed)
        if name == "shell":  # the plate, bent
            angle, radius = points[:, 0] / 4, 4 + points[:, 2]
            points = np.stack([radius * np.sin(angle), points[:, 1], radius * np.cos(angle)], axis=1)
        if thrown:
            edges = np.linalg.norm(points[triangles] - points[np.roll(triangles, 1, axis=1)], axis=2)
            points = points + thrown * np.quantile(edges, 0.1) * random.uniform(-1, 1, points.shape)
        filled, fault = fill(points, triangles)
        if fault:
            sys.exit(f"{name}: {fault}")
        self.points, self.cells, self.regions = filled
        if volumes(self.points, self.cells).sum() < 0:
            self.cells[:, [0, 1]] = self.cells[:, [1, 0]]
        self.name, self.kind = name, solid.__name__
        self.region_array = "Region" if self.kind in ("sectors", "lens") else None
        riding = ()
        if self.kind in ("crack", "curved"):
            wall = triangles[np.isin(faces, self.wall_of(triangles, faces))]
            centre = points[wall].mean(axis=1)
            inside = (centre[:, 1] > -0.1) & (centre[:, 2] > 0.3) & (centre[:, 2] < (0.7 if self.kind == "crack" else 2.0))
            self.points, self.cells = open_crack(self.points, self.cells, wall[inside])
            self.regions[:] = 1
        if self.kind == "heated":
            riding = (triangles, faces)
        self.grid = grid_of(self.points, self.cells, self.regions, *riding)
        if self.kind == "heated":
            self.heat(points, triangles, faces)

    def wall_of(self, triangles, faces):
        """The faces between the two compartments."""
        count = {}
        for r in (1, 2):
            own = surface(self.points, self.cells[self.regions == r], self.regions[self.regions == r])[0]
            for facet in own.tolist():
                count[tuple(facet)] = count.get(tuple(facet), 0) + 1
        return np.unique(faces[[count.get(tuple(sorted(t)), 0) == 2 for t in triangles.tolist()]])

    def heat(self, points, triangles, faces):
        low = [f for f in np.unique(faces) if np.ptp(points[triangles[faces == f]][..., 0]) < 0.2 and points[triangles[faces == f]][..., 0].max() < 0.2]
        high = [f for f in np.unique(faces) if points[triangles[faces == f]][..., 2].min() > 0.6]
        self.held, self.loaded = low[0], high[0]
        n = self.grid.GetNumberOfPoints()
        x = self.points
        constraint, traction = np.zeros(n), np.zeros((n, 3))
        constraint[np.unique(triangles[faces == self.held])] = 1
        traction[np.unique(triangles[faces == self.loaded])] = [0, 1.0, -2.0]
        on_facets = np.zeros((self.grid.GetNumberOfCells(), 3))
        on_facets[len(self.cells):][faces == self.loaded] = [0, 1.0, -2.0]
        node_set = constraint.astype(np.int32)
        for data, name, values in ((self.grid.GetPointData(), "Temperature", 100 * x[:, 0]), (self.grid.GetPointData(), "Constraint", constraint),
                                   (self.grid.GetPointData(), "Traction", traction), (self.grid.GetPointData(), "NodeSet", node_set),
                                   (self.grid.GetCellData(), "FacetTraction", on_facets)):
            array = numpy_to_vtk(np.ascontiguousarray(values), deep=1)
            array.SetName(name)
            data.AddArray(array)

    def loads(self, grid):
        """Held area, by the array of floats and by that of integers; total load by points and by triangles; length of the borders."""
        points, (cells, _), (triangles, ids) = coordinates(grid), cell_lists(grid, 10), cell_lists(grid, 5)
        facets = surface(points, cells, np.zeros(len(cells), dtype=int))[0]
        data = {n: vtk_to_numpy(grid.GetPointData().GetArray(n)) for n in ("Constraint", "NodeSet", "Traction")}
        held = [area(points, facets[(data[n][facets] != 0).all(axis=1)]) for n in ("Constraint", "NodeSet")]
        t = data["Traction"][facets]
        on = (t != 0).any(axis=2).all(axis=1)
        a = np.array([area(points, f[None]) for f in facets[on]])
        load = (t[on].mean(axis=1) * a[:, None]).sum(axis=0)
        a = np.array([area(points, f[None]) for f in triangles])
        of_triangles = (vtk_to_numpy(grid.GetCellData().GetArray("FacetTraction"))[ids] * a[:, None]).sum(axis=0)
        faces = vtk_to_numpy(grid.GetCellData().GetArray("Face"))[ids]
        borders = [border_length(points, triangles[faces == f]) for f in (self.held, self.loaded)]
        return held, load, of_triangles, borders

    def special(self, out, limit):
        """What is wrong with what this body is here for, and what it measures."""
        points, cells = coordinates(out), cell_lists(out, 10)[0]
        if self.kind in ("crack", "curved"):
            found = []
            for p, c in ((self.points, self.cells), (points, cells)):
                facets = surface(p, c, np.zeros(len(c), dtype=int))[0]
                keys, count = {}, {}
                for f in facets:
                    keys.setdefault(key_of(p, f), []).append(f)
                pairs = [v for v in keys.values() if len(v) == 2]
                a = sum(area(p, v[0][None]) for v in pairs)
                for v in pairs:
                    for x in v:
                        for i in range(3):
                            e = tuple(sorted((tuple(p[x[i]]), tuple(p[x[(i + 1) % 3]]))))
                            count[e] = count.get(e, 0) + 1
                near = [v for v in keys.values() if len(v) > 2]
                found.append((len(pairs), a, len(near)))
            text = f"{found[0][0]} pairs of lips of area {found[0][1]:.6g} became {found[1][0]} of {found[1][1]:.6g}"
            return abs(found[0][1] - found[1][1]) > 1e-9 + 2 * limit or found[0][0] == 0, text
        if self.kind == "plate":
            v0, v1 = volumes(self.points, self.cells).sum(), volumes(points, cells).sum()
            swept = 0.5 * area(self.points, surface(self.points, self.cells, np.zeros(len(self.cells), dtype=int))[0]) * limit
            return abs(v1 - v0) > max(swept, 1e-13) or not 0.75 < v1 / v0 < 4 / 3, f"volume {v0:.6g} became {v1:.6g}"
        if self.kind == "heated":
            (held0, load0, cell0, borders), (held1, load1, cell1, _) = self.loads(self.grid), self.loads(out)
            small = 1e-9
            wrong = abs(held1[0] - held0[0]) > limit * borders[0] + small or abs(held1[1] - held0[1]) > limit * borders[0] + small
            wrong |= np.abs(load1 - load0).max() > 2 * (limit * borders[1] + small)
            wrong |= np.abs(cell1 - cell0).max() > 2 * (limit * borders[1] + small)
            return wrong, (f"held {held0[0]:.6g} became {held1[0]:.6g} (integers: {held1[1]:.6g}), load {load0.round(6).tolist()} became "
                           f"{load1.round(6).tolist()} (at triangles: {cell1.round(6).tolist()})")
        v0, v1 = ([float(volumes(p, c)[r == k].sum().round(7)) for k in np.unique(r)] for p, c, r in (
            (self.points, self.cells, self.regions), (points, cells, vtk_to_numpy(out.GetCellData().GetArray("Region"))[cell_lists(out, 10)[1]])))
        return False, f"volumes {v0} became {v1}"


def run(body, tolerance, opt, folder):
    f = vtkMeshOptimizeFilter()
    f.SetInputData(body.grid)
    f.SetEffort(EFFORTS[opt.effort])
    f.SetGrowthBudget(opt.growth)
    f.SetTimeLimit(opt.limit)
    f.SetNumberOfThreads(1)
    f.SetBoundaryModeToSlide()
    f.SetSurfaceTolerance(tolerance)
    if body.region_array:
        f.SetRegionArray(body.region_array)
    if body.kind == "heated":
        f.SetPatchArray("Face")
    f.Update()
    out = f.GetOutput()
    points, cells = coordinates(out), cell_lists(out, 10)[0]
    diagonal = np.linalg.norm(np.ptp(body.points, axis=0))
    limit = max(tolerance, 1e-14) * diagonal
    faults = []
    if f.GetWorstQualityAfter() < f.GetWorstQualityBefore():
        faults.append("worst quality fell")
    if volumes(points, cells).min() <= 0 < volumes(body.points, body.cells).min():
        faults.append("inverted cells")
    if abs(shape(points[cells]).min() - f.GetWorstQualityAfter()) > 1e-9:
        faults.append("worst quality is not that reported")
    if f.GetSurfaceDistance() > limit:
        faults.append("proved more than the tolerance")
    wrong, text = body.special(out, limit)
    if wrong:
        faults.append(text)
    stem = f"{body.name}-{opt.seed}-{opt.effort}"
    before, after = folder / f"{stem}-before.vtu", folder / f"{stem}-{tolerance:g}.vtu"
    write(body.grid, before)
    write(out, after)
    if opt.judge:
        judged = [after, "--before", before, "--tolerance", max(tolerance, 1e-12)]
        commands = [[opt.judge / "check_surface.py", *judged, *(["--region", body.region_array] if body.region_array else [])]]
        if body.kind == "heated":
            commands.append([opt.judge / "check_patches.py", *judged, "--array", "Face"])
        for command in commands:
            said = subprocess.run([sys.executable, *map(str, command)], capture_output=True, text=True, check=False)
            faults += [line for line in said.stdout.splitlines() if line.startswith("FAULT")
                       and not (body.kind in ("crack", "curved") and "look the other way" in line)]  # says the same of the input
            if said.returncode > 1:
                faults.append(said.stderr[-200:])
    print(f"| {body.name} | {tolerance:g} | {len(body.cells)} | {f.GetWorstQualityBefore():.4f} | {f.GetWorstQualityAfter():.4f} | {len(cells)} | "
          f"{f.GetSurfaceDistance() / diagonal:.2g} | {f.GetOptimizeSeconds():.2f} | {f.GetStopReasonAsString()} | {text} | "
          f"{'; '.join(faults) or 'none'} |", flush=True)
    return not faults


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bodies", nargs="*", default=list(BODIES), metavar="BODY")
    parser.add_argument("--tolerance", nargs="+", type=float, default=[0.0, 1e-4, 1e-3, 1e-2])
    parser.add_argument("--effort", choices=EFFORTS, default="default")
    parser.add_argument("--growth", type=float, default=0.15)
    parser.add_argument("--limit", type=float, default=30.0)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--judge", type=pathlib.Path)
    parser.add_argument("--output")
    opt = parser.parse_args()
    if is_missing():
        sys.exit(is_missing())
    folder = pathlib.Path(opt.output or tempfile.mkdtemp())
    folder.mkdir(parents=True, exist_ok=True)
    print("| body | tolerance | tets | before | after | tets after | distance | s | stop | what stays | fault |")
    print("|---" * 11 + "|")
    good = True
    for name in opt.bodies:
        body = Body(name, opt.seed)
        for tolerance in opt.tolerance:
            good &= run(body, tolerance, opt, folder)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
