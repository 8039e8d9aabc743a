# SPDX-License-Identifier: BSD-3-Clause
"""Random solids whose surface takes part (Boundary Mode Slide), through vtkMeshOptimizeFilter: does what must hold hold?

    eval "$(./bootstrap.sh env)"
    /usr/bin/python3 Testing/Fuzz/fuzz_surface.py FIRST COUNT [--output FOLDER] [--verbose]

Runs the seeds FIRST ... FIRST + COUNT - 1; each is a solid made of lattice boxes (with holes, steps, regions), its nodes thrown
inside, in the faces and along the edges, then turned, bent or twisted, or rounded to single precision; and random options.
Every line of output is a failure with its seed; --output writes input and output there. The exit status is 1 if anything
failed. What is checked:

- no message; the input is not touched; the output is a mesh of positive cells, no facet with three cells;
- the worst quality does not fall;
- points sampled on the surface of before, interfaces included, are within the tolerance of that of after, and the other way
  round; what the filter proves (SurfaceDistance) is within the tolerance;
- the volume of each region changes by no more than the area of its surface times the tolerance;
- the same bytes with one thread and with two.
"""
import argparse
import pathlib
import sys
import time

import numpy as np
from fuzz_filter import bytes_of, make_filter
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import mutable, vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkCellArray, vtkPolyData, vtkStaticCellLocator, vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

FACES = np.array([[1, 3, 2], [0, 2, 3], [0, 3, 1], [0, 1, 2]])
PATHS = ((0, 1, 2), (1, 2, 0), (2, 0, 1), (1, 0, 2), (2, 1, 0), (0, 2, 1))  # orders of the axes; the first three are even
ROUNDING = 1e-14  # of the diagonal


def lattice(random):
    """(points, cells, boxes of the cells, text) of a solid made of boxes."""
    n = random.integers(1, 7, 3) + 1
    keep = np.ones(n, dtype=bool)
    text = "box"
    kind = random.integers(4)
    if kind == 1:  # a step
        keep[n[0] // 2:, :, n[2] // 2:] = False
        text = "step"
    elif kind == 2:  # a hole from side to side
        keep[n[0] // 3: max(n[0] // 3 + 1, 2 * n[0] // 3), n[1] // 3: max(n[1] // 3 + 1, 2 * n[1] // 3), :] = n.min() < 3
        text = "hole"
    elif kind == 3:  # bites
        for _ in range(3):
            corner = random.integers(0, n)
            keep[tuple(slice(c, c + random.integers(1, 3)) for c in corner)] = False
        text = "bites"
    if not keep.any():
        keep[:] = True
    axes = [np.arange(m + 1) * random.uniform(0.3, 1.0) / m for m in n]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    strides = np.array([(n[1] + 1) * (n[2] + 1), n[2] + 1, 1])
    cells, boxes = [], []
    for box in np.argwhere(keep):
        for k, path in enumerate(PATHS):
            nodes = [int(box @ strides)]
            for axis in path:
                nodes.append(nodes[-1] + int(strides[axis]))
            cells.append(nodes if k < 3 else [nodes[0], nodes[2], nodes[1], nodes[3]])
            boxes.append(box)
    return points, np.array(cells), np.array(boxes), f"{text} {n.tolist()}"


def surface(points, cells, regions):
    """Facets with one cell or between two regions, each once, and whether any has more than two cells."""
    facets = np.sort(cells[:, FACES].reshape(-1, 3), axis=1)
    owners = np.repeat(regions, 4)
    unique, inverse, count = np.unique(facets, axis=0, return_inverse=True, return_counts=True)
    low, high = np.full(len(unique), owners.max()), np.full(len(unique), owners.min())
    np.minimum.at(low, inverse.ravel(), owners)
    np.maximum.at(high, inverse.ravel(), owners)
    return unique[(count == 1) | (low != high)], count.max() > 2


def throw(random, points, cells, regions):
    """Displaces nodes; those of the surface only along the axes in which all its facets there lie."""
    facets = surface(points, cells, regions)[0]
    free = np.ones(points.shape, dtype=bool)
    t = points[facets]
    normal = np.abs(np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0])).argmax(axis=1)
    for k in range(3):
        free[facets[:, k], normal] = False
    # The ends of edges of the surface along an axis stay, too: where not all edges of the lattice go on.
    spacing = [np.diff(np.unique(points[:, d])).min() for d in range(3)]
    return points + random.uniform(0.0, 0.3) * random.uniform(-1, 1, points.shape) * free * spacing


def deform(random, points):
    kind = random.integers(5)
    if kind == 1:
        q = np.linalg.qr(random.normal(size=(3, 3)))[0]
        q *= np.sign(np.linalg.det(q))
        return points @ q.T + random.normal(size=3) * random.choice([0, 10]), "turned", True
    if kind == 2:
        angle, radius = random.uniform(0.2, 2.0) * points[:, 0], random.uniform(0.3, 2.0) + points[:, 2]
        return np.c_[radius * np.cos(angle), points[:, 1], radius * np.sin(angle)] * [-1, 1, 1], "bent", False
    if kind == 3:
        angle = random.uniform(0.2, 1.5) * points[:, 2]
        c, s = np.cos(angle), np.sin(angle)
        return np.c_[c * points[:, 0] - s * points[:, 1], s * points[:, 0] + c * points[:, 1], points[:, 2]], "twisted", False
    if kind == 4:
        return points.astype(np.float32).astype(float), "single precision", False
    return points, "as it is", True


def volumes(points, cells):
    x = points[cells]
    return np.einsum("ij,ij->i", np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]), x[:, 3] - x[:, 0]) / 6.0


def farthest(points, facets, other_points, other_facets, samples=5):
    """Greatest distance of sampled points of facets from the other facets."""
    mesh, x, polys = vtkPolyData(), vtkPoints(), vtkCellArray()
    x.SetData(numpy_to_vtk(np.ascontiguousarray(other_points), deep=1))
    polys.SetData(numpy_to_vtkIdTypeArray(np.arange(0, 3 * len(other_facets) + 1, 3, dtype=np.int64), deep=1),
                  numpy_to_vtkIdTypeArray(np.ascontiguousarray(other_facets, dtype=np.int64).ravel(), deep=1))
    mesh.SetPoints(x)
    mesh.SetPolys(polys)
    locator = vtkStaticCellLocator()
    locator.SetDataSet(mesh)
    locator.BuildLocator()
    worst, at, cell, sub, square = 0.0, [0.0] * 3, mutable(0), mutable(0), mutable(0.0)
    t = points[facets]
    for i in range(samples + 1):
        for j in range(samples + 1 - i):
            for y in (i * t[:, 0] + j * t[:, 1] + (samples - i - j) * t[:, 2]) / samples:
                locator.FindClosestPoint(y, at, cell, sub, square)
                worst = max(worst, float(square))
    return worst ** 0.5


def grid_of(points, cells, regions):
    grid, x, tets = vtkUnstructuredGrid(), vtkPoints(), vtkCellArray()
    x.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=1))
    tets.SetData(numpy_to_vtkIdTypeArray(np.arange(0, 4 * len(cells) + 1, 4, dtype=np.int64), deep=1),
                 numpy_to_vtkIdTypeArray(np.ascontiguousarray(cells, dtype=np.int64).ravel(), deep=1))
    grid.SetPoints(x)
    grid.SetCells(VTK_TETRA, tets)
    array = numpy_to_vtk(np.ascontiguousarray(regions, dtype=np.int32), deep=1)
    array.SetName("Region")
    grid.GetCellData().AddArray(array)
    return grid


def arrays_of(grid):
    points = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4).astype(np.int64)
    return points, cells, vtk_to_numpy(grid.GetCellData().GetArray("Region"))


class Case:
    def __init__(self, seed):
        random = np.random.default_rng(seed)
        points, cells, boxes, self.text = lattice(random)
        regions = np.zeros(len(cells), dtype=int)
        if random.random() < 0.4:
            axis = random.integers(3)
            regions = (boxes[:, axis] >= boxes[:, axis].max() / 2).astype(int)
            regions += (random.random() < 0.5) * 2 * (boxes[:, (axis + 1) % 3] >= boxes[:, (axis + 1) % 3].max() / 2)
            self.text += f", {len(np.unique(regions))} regions"
        points = throw(random, points, cells, regions)
        points, how, is_flat = deform(random, points)
        self.text += ", " + how
        used = np.unique(cells)
        self.points, self.cells, self.regions = points[used], np.searchsorted(used, cells), regions
        if volumes(self.points, self.cells).sum() < 0:
            self.cells[:, [0, 1]] = self.cells[:, [1, 0]]
        tolerance = float(random.choice([0.0, 1e-4, 1e-3, 1e-2] if is_flat else [1e-7, 1e-4, 1e-3, 1e-2]))
        self.options = {"Algorithm": 1, "SurfaceTolerance": tolerance, "Effort": int(random.choice([0, 0, 1])), "BoundaryMode": 1,
                        "QualityMeasure": int(random.choice([0, 0, 0, 2, 5])), "FeatureAngle": float(random.choice([45, 45, 20, 80])),
                        "TargetQuality": float(random.choice([0.5, 0.6, 0.7])), "GrowthBudget": float(random.choice([0.15, 0.5]))}
        self.grid = grid_of(self.points, self.cells, self.regions)
        self.failures = []

    def check(self, good, text):
        if not good:
            self.failures.append(text)

    def run(self):
        before = bytes_of(self.grid)
        start = time.time()
        f = self.optimized(1)
        self.seconds = time.time() - start
        self.check(not f.messages["ErrorEvent"], f"error {f.messages['ErrorEvent'][:1]}")
        self.check(bytes_of(self.grid) == before, "the input changed")
        self.check(bytes_of(f.GetOutput()) == bytes_of(self.optimized(2).GetOutput()), "two threads, other bytes")
        self.output = f.GetOutput()
        points, cells, regions = arrays_of(self.output)
        tangled = volumes(self.points, self.cells).min() <= 0
        self.check(tangled or volumes(points, cells).min() > 0, "an inverted cell")
        self.check(f.GetWorstQualityAfter() >= f.GetWorstQualityBefore(), "the worst quality fell")
        old, new = surface(self.points, self.cells, self.regions), surface(points, cells, regions)
        self.check(not new[1], "a facet with three cells")
        diagonal = np.linalg.norm(np.ptp(self.points, axis=0))
        limit = max(self.options["SurfaceTolerance"], ROUNDING * (1 + np.abs(self.points).max() / diagonal)) * diagonal
        self.check(f.GetSurfaceDistance() <= limit, f"proved {f.GetSurfaceDistance() / diagonal:.3g}")
        there = farthest(points, new[0], self.points, old[0])
        back = farthest(self.points, old[0], points, new[0])
        self.check(max(there, back) <= 1.0001 * limit, f"distance {there / diagonal:.3g} there, {back / diagonal:.3g} back")
        for region in np.unique(self.regions):
            own = surface(self.points, self.cells[self.regions == region], self.regions[self.regions == region])[0]
            t = self.points[own]
            area = 0.5 * np.linalg.norm(np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0]), axis=1).sum()
            change = volumes(points, cells[regions == region]).sum() - volumes(self.points, self.cells[self.regions == region]).sum()
            self.check(abs(change) <= area * limit, f"volume of region {region} changed by {change:.3g}, {area * limit:.3g} allowed")
        self.changed = {tuple(map(tuple, self.points[x])) for x in old[0]} != {tuple(map(tuple, points[x])) for x in new[0]}

    def optimized(self, threads):
        return make_filter(self.grid, self.options, {"RegionArray": "Region"}, threads)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("first", type=int)
    parser.add_argument("count", type=int)
    parser.add_argument("--output")
    parser.add_argument("--verbose", action="store_true")
    opt = parser.parse_args()
    failed, changed, slowest = 0, 0, (0.0, opt.first)
    for seed in range(opt.first, opt.first + opt.count):
        case = Case(seed)
        if opt.verbose:
            print(f"seed {seed}: {case.text}; {len(case.cells)} cells; {case.options}", flush=True)
        case.run()
        slowest = max(slowest, (case.seconds, seed))
        changed += case.changed
        failed += bool(case.failures)
        for failure in case.failures[:3]:
            print(f"FAILED seed {seed} ({case.text}; {case.options}): {failure}", flush=True)
        for name, grid in (("before", case.grid), ("after", case.output)) if case.failures and opt.output else ():
            writer = vtkXMLUnstructuredGridWriter()
            pathlib.Path(opt.output).mkdir(parents=True, exist_ok=True)
            writer.SetFileName(str(pathlib.Path(opt.output) / f"seed{seed}-{name}.vtu"))
            writer.SetDataModeToBinary()
            writer.SetInputData(grid)
            writer.Write()
    print(f"{opt.count} seeds, {failed} failed, surface changed in {changed}, slowest {slowest[0]:.1f} s (seed {slowest[1]})")
    return 1 if failed or 2 * changed < opt.count else 0


if __name__ == "__main__":
    sys.exit(main())
