# SPDX-License-Identifier: BSD-3-Clause
"""Random meshes and options through vtkMeshOptimizeFilter: does what must hold hold?

    eval "$(./bootstrap.sh env)"
    /usr/bin/python3 Testing/Fuzz/fuzz_filter.py FIRST COUNT [--output FOLDER] [--limit SECONDS] [--verbose]

Runs the seeds FIRST ... FIRST + COUNT - 1; each is a mesh, options and a run of its own, always the same. Every line of output
is a failure with its seed; --output writes its mesh there, --verbose names each seed before it runs (so that one that crashes
is known). A run that takes longer than the limit (60) is a failure. The exit status is 1 if anything failed. What is checked:

- a faulty input gives one error, and empty outputs; any other none;
- the input is not touched; the output is a mesh: no facet with three cells, no cell twice, no point twice in a cell;
- the worst quality does not fall, is that of the cell array and of the paper's formula, and does not exceed the bound;
- the kept surface, volumes of regions, fixed points, other cells, and what lies outside of the zone are as before;
- the same bytes with one thread and with two.
"""
import argparse
import pathlib
import sys

import numpy as np
from fuzz_meshes import corrupted, grid_of, random_mesh
from meshoptimize import vtkMeshOptimizeFilter
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import VTK_TETRA, VTK_TRIANGLE, vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter


def set_measure_and_switches(random, options, measure, off):
    """With these probabilities another measure, each kind of change switched off."""
    if random.random() < measure:
        options["QualityMeasure"] = int(random.integers(6))
    for name in ("MoveNodes", "Reconnect", "InsertNodes", "RemoveNodes", "LookAhead"):
        if random.random() < off:
            options[name] = False


def random_options(random, mesh):
    """Setters and their values."""
    options = {"Algorithm": int(random.random() < 0.7), "TargetQuality": float(random.choice([0.3, 0.6, 0.6, 1.0])),
               "Effort": int(random.choice([0, 1, 1, 1, 2]))}
    if options["TargetQuality"] == 1.0 and len(mesh["cells"]) > 150:
        options["Effort"] = 0  # time
    set_measure_and_switches(random, options, 0.4, 0.12)
    if random.random() < 0.2:
        options["Beta"] = float(random.choice([0.1, 0.5, 2.0]))
        options["DesiredSize"] = float(np.ptp(mesh["points"], axis=0).max()) / 5.0
    if random.random() < 0.2:
        options["OptimizeBelow"] = float(random.choice([1e-3, 0.2, 0.5, 1.0]))
        options["NumberOfLayers"] = int(random.integers(0, 4))
    if random.random() < 0.1:
        options["GrowthBudget"] = float(random.choice([0.0, 1.0, 10.0]))
    if random.random() < 0.1:
        options["NeighborhoodLevel"] = int(random.integers(0, 4))
    if random.random() < 0.1:
        options["Epsilon"] = float(random.choice([1e-6, 1.0]))
    if random.random() < 0.1:
        options["MaximumNumberOfIterations"] = int(random.integers(1, 10))
    arrays = {}
    if mesh["regions"] is not None and random.random() < 0.9:
        arrays["RegionArray"] = "region"
    if mesh["fixed"] is not None:
        arrays["FixedPointArray"] = "fixed"
    if "Beta" in options and random.random() < 0.5:
        arrays["SizeArray"] = "size"
    if random.random() < 0.1:
        arrays["MetricArray"] = "metric"
        if "DesiredSize" in options:
            arrays.pop("SizeArray", None)  # has the units of the coordinates
            options["DesiredSize"] = 0.2  # a length in the metric, in which the mesh has some 1
    return options, arrays


def make_filter(grid, options, arrays, threads):
    f = vtkMeshOptimizeFilter()
    f.messages = {"ErrorEvent": [], "WarningEvent": []}
    for event, messages in f.messages.items():
        def observe(caller, name, text, messages=messages):
            messages.append(text)
        observe.CallDataType = "string0"
        f.AddObserver(event, observe)
        f.GetExecutive().AddObserver(event, observe)
    f.SetInputData(grid)
    f.SetNumberOfThreads(threads)
    for name, value in {**options, **arrays}.items():
        getattr(f, "Set" + name)(value)
    f.Update()
    return f


def cell_lists(grid, kind):
    """Points of all cells of one type as an array; ids of these cells."""
    types = np.array([grid.GetCellType(c) for c in range(grid.GetNumberOfCells())], dtype=int)
    ids = np.flatnonzero(types == kind)
    if len(ids) == 0:
        return np.zeros((0, 4 if kind == VTK_TETRA else 3), dtype=np.int64), ids
    offsets = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    nodes = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    return nodes[offsets[ids][:, None] + np.arange(4 if kind == VTK_TETRA else 3)], ids


def coordinates(grid):
    return vtk_to_numpy(grid.GetPoints().GetData()).astype(float) if grid.GetNumberOfPoints() else np.zeros((0, 3))


def bytes_of(grid):
    arrays = [grid.GetPoints().GetData(), grid.GetCells().GetConnectivityArray()] if grid.GetNumberOfPoints() else []
    for data in (grid.GetPointData(), grid.GetCellData()):
        arrays += [data.GetArray(i) for i in range(data.GetNumberOfArrays())]
    return b"".join(vtk_to_numpy(a).tobytes() for a in arrays)


def signed_measure(x):
    """Volumes; in the plane areas, signed by the side that most of the area is seen from."""
    edges = x[:, 1:] - x[:, :1]
    if x.shape[1] == 4:
        return np.einsum("ij,ij->i", np.cross(edges[:, 0], edges[:, 1]), edges[:, 2]) / 6.0
    area = np.cross(edges[:, 0], edges[:, 1]) / 2.0
    largest = area[np.argmax(np.linalg.norm(area, axis=1))]
    length = np.linalg.norm(largest)
    return area @ (largest / length) if length > 0 else np.zeros(len(area))


def shape(x):
    """The paper's S (2.3) without the sign of areas."""
    n = x.shape[1]
    perimeter = sum(np.linalg.norm(x[:, i] - x[:, j], axis=1) for i in range(n) for j in range(i))
    measure = signed_measure(x)
    with np.errstate(all="ignore"):
        if n == 4:
            return 1296.0 * np.sqrt(2.0) * measure / perimeter ** 3
        return 36.0 / np.sqrt(3.0) * measure / perimeter ** 2


def kept_facets(points, cells, regions):
    """Sorted coordinates of the facets with one cell, or between two regions."""
    use = {}
    for c, cell in enumerate(cells):
        for left_out in range(len(cell)):
            facet = tuple(sorted(np.delete(cell, left_out)))
            use.setdefault(facet, []).append(regions[c])
    most = max((len(u) for u in use.values()), default=0)
    kept = sorted(tuple(sorted(tuple(points[p]) for p in facet)) for facet, u in use.items() if len(u) == 1 or len(set(u)) > 1)
    return kept, most


class Checks:
    """What is wrong with one seed."""

    def check(self, condition, text):
        if not condition:
            self.failures.append(text)

    def check_two_threads(self):
        second = make_filter(self.grid, self.options, self.arrays, 2)
        self.check(bytes_of(second.GetOutput()) == bytes_of(self.f.GetOutput()), "two threads give other bytes")


class Case(Checks):
    """One seed: the mesh, the run, and what is wrong with it."""

    def __init__(self, seed, limit=60.0):
        random = np.random.default_rng(seed)
        self.mesh = random_mesh(random)
        self.grid = grid_of(self.mesh, random)
        self.options, self.arrays = random_options(random, self.mesh)
        self.options["TimeLimit"] = limit
        self.fault = corrupted(random, self.grid) if random.random() < 0.08 else None
        self.failures = []

    def run(self):
        before = vtkUnstructuredGrid()
        before.DeepCopy(self.grid)
        f = make_filter(self.grid, self.options, self.arrays, 1)
        self.f, self.seconds = f, f.GetOptimizeSeconds()
        errors, warnings = f.messages["ErrorEvent"], f.messages["WarningEvent"]
        self.check(bytes_of(before) == bytes_of(self.grid), "the input changed")
        if self.fault:
            self.check(len(errors) == 1 and f.GetErrorCode() != 0, f"{len(errors)} errors for {self.fault}")
            self.check(f.GetOutput().GetNumberOfCells() == 0 and f.GetOutput().GetNumberOfPoints() == 0, "output is not empty")
            return
        self.check(not errors and f.GetErrorCode() == 0, f"error: {errors[:1]}")
        if errors:
            return
        self.check(len(warnings) <= 2, "more than two warnings")
        if f.GetStopReason() == vtkMeshOptimizeFilter.TimeLimitReached:
            self.failures.append("too slow")
            return
        self.check_two_threads()
        if len(self.mesh["cells"]):
            self.check_figures()
            self.check_mesh()
            self.check_kept()

    def check_figures(self):
        f = self.f
        worst, now = f.GetWorstQualityBefore(), f.GetWorstQualityAfter()
        least = min(worst, self.options["TargetQuality"]) if self.options.get("Beta") else worst  # sizes may lower it
        self.check(now >= least, f"the worst quality fell from {worst} to {now}")
        self.check(now <= f.GetQualityBound() + 1e-9, f"worst {now} above the bound {f.GetQualityBound()}")
        quality = vtk_to_numpy(f.GetOutput().GetCellData().GetArray("MeshQuality"))
        self.check(np.nanmin(quality) == now, f"least MeshQuality {np.nanmin(quality)}, reported {now}")
        self.check((quality <= 0).sum() == f.GetNumberOfInvertedCellsAfter(), "inverted cells are miscounted")
        self.check((f.GetNumberOfInvertedCellsAfter() > 0) == any("inverted or flat" in w for w in f.messages["WarningEvent"]),
                   "warning about inverted cells")
        history = f.GetOutputDataObject(1)
        rows = vtk_to_numpy(history.GetColumnByName("Worst"))
        stages = [history.GetColumnByName("Stage").GetValue(k) for k in range(len(rows))]
        falls = [k for k in np.flatnonzero(np.diff(rows) < 0) if not stages[k + 1].startswith("sizes")]  # those may lower it
        self.check(rows[0] == worst and not falls and rows[-1] <= now, f"history {rows}")
        if self.options.get("QualityMeasure", 0) == 0 and not self.arrays.get("MetricArray") and not self.options.get("Beta"):
            cells, ids = cell_lists(f.GetOutput(), VTK_TETRA if self.mesh["dimension"] == 3 else VTK_TRIANGLE)
            own = shape(coordinates(f.GetOutput())[cells])
            reported = quality[ids]
            if self.mesh["dimension"] == 2:  # the side from which the plane is seen is the filter's choice
                own, reported = np.abs(own), np.abs(reported)
            x = coordinates(f.GetOutput())
            smallest = np.ptp(x[cells], axis=1).max(axis=1).min()
            unit = np.abs(x).max() / max(smallest, 1e-300)
            self.check(np.nan_to_num(np.abs(own - reported)).max() < 1e-12 * max(unit, 1.0) + 1e-9, "MeshQuality is not the paper's S")

    def check_mesh(self):
        cells, _ = cell_lists(self.f.GetOutput(), VTK_TETRA if self.mesh["dimension"] == 3 else VTK_TRIANGLE)
        ordered = np.sort(cells, axis=1)
        self.check((np.diff(ordered, axis=1) > 0).all(), "a point twice in a cell")
        self.check(len(np.unique(ordered, axis=0)) == len(cells), "a cell twice")
        self.check(cells.min() >= 0 and cells.max() < self.f.GetOutput().GetNumberOfPoints(), "no such point")

    def check_kept(self):
        kind = VTK_TETRA if self.mesh["dimension"] == 3 else VTK_TRIANGLE
        found = []
        for grid in (self.grid, self.f.GetOutput()):
            cells, ids = cell_lists(grid, kind)
            x = coordinates(grid)
            regions = np.zeros(len(ids), dtype=np.int64)
            if "RegionArray" in self.arrays:
                regions = vtk_to_numpy(grid.GetCellData().GetArray("region"))[ids]
            kept, most = kept_facets(x, cells, regions)
            self.check(most <= 2, "a facet with three cells")
            volumes = {r: signed_measure(x[cells])[regions == r].sum() for r in np.unique(regions)}
            found.append((kept, volumes, {tuple(p) for p in x}, self.other_cells(grid, kind)))
        before, after = found
        self.check(before[0] == after[0], "the kept surface changed")
        self.check(before[3] == after[3], "other cells changed")
        if not any("numbered the wrong way" in w for w in self.f.messages["WarningEvent"]) and self.mesh["dimension"] == 3:
            x = coordinates(self.grid)
            scale = np.ptp(x, axis=0).max() * max(np.ptp(x, axis=0).max(), np.abs(x).max()) ** 2
            for region, volume in before[1].items():
                self.check(abs(after[1].get(region, 0.0) - volume) <= 1e-11 * scale, f"volume of region {region} changed")
        if "FixedPointArray" in self.arrays:
            used = np.unique(self.mesh["cells"])
            fixed = coordinates(self.grid)[used[self.mesh["fixed"][used]]]
            self.check(all(tuple(p) in after[2] for p in fixed), "a fixed point moved")
        if self.options.get("OptimizeBelow"):
            self.check_zone(kind)

    @staticmethod
    def other_cells(grid, kind):
        x = coordinates(grid)
        return [(grid.GetCellType(c), [tuple(x[grid.GetCell(c).GetPointId(i)]) for i in range(grid.GetCell(c).GetNumberOfPoints())])
                for c in range(grid.GetNumberOfCells()) if grid.GetCellType(c) != kind]

    def check_zone(self, kind):
        """Cells that are farther from every changed one than the layers are all there; at least those without bad neighbours."""
        measure = make_filter(self.grid, {**self.options, **dict.fromkeys(("MoveNodes", "Reconnect", "InsertNodes", "RemoveNodes"), False),
                                          "OptimizeBelow": 0.0}, self.arrays, 1)
        quality = vtk_to_numpy(measure.GetOutput().GetCellData().GetArray("MeshQuality"))
        cells, ids = cell_lists(self.grid, kind)
        same_order, _ = cell_lists(measure.GetOutput(), kind)
        inside = (quality[ids] < self.options["OptimizeBelow"]) | (same_order != cells).any(axis=1)
        for _ in range(self.options["NumberOfLayers"]):
            inside |= np.isin(cells, cells[inside]).any(axis=1)
        out = self.f.GetOutput()
        point, cell = (vtk_to_numpy(d.GetArray(n)) for d, n in ((out.GetPointData(), "point"), (out.GetCellData(), "cell")))
        after, after_ids = cell_lists(out, kind)
        x, y = coordinates(self.grid), coordinates(out)
        place = {}
        for k in range(len(after_ids) - 1, -1, -1):
            place[cell[after_ids[k]]] = k
        for c in np.flatnonzero(~inside):
            k = place.get(ids[c])
            self.check(k is not None and (point[after[k]] == cells[c]).all() and (y[after[k]] == x[cells[c]]).all(),
                       f"cell {ids[c]} outside of the zone changed")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("first", type=int)
    parser.add_argument("count", type=int)
    parser.add_argument("--output")
    parser.add_argument("--limit", type=float, default=60.0)
    parser.add_argument("--verbose", action="store_true")
    opt = parser.parse_args()
    failed, slowest, faults, operations = 0, (0.0, opt.first), 0, 0
    for seed in range(opt.first, opt.first + opt.count):
        case = Case(seed, opt.limit)
        if opt.verbose:
            print(f"seed {seed}: {case.mesh['text']}; {len(case.mesh['cells'])} cells; {case.options} {case.arrays} "
                  f"{case.fault or ''}", flush=True)
        case.run()
        slowest = max(slowest, (case.seconds, seed))
        faults += case.fault is not None
        operations += case.f.GetNumberOfOperations()
        for failure in case.failures[:3]:
            print(f"FAILED seed {seed} ({case.mesh['text']}; {case.options} {case.arrays}): {failure}", flush=True)
        failed += bool(case.failures)
        if case.failures and opt.output:
            writer = vtkXMLUnstructuredGridWriter()
            pathlib.Path(opt.output).mkdir(parents=True, exist_ok=True)
            writer.SetFileName(str(pathlib.Path(opt.output) / f"seed{seed}.vtu"))
            writer.SetDataModeToBinary()
            writer.SetInputData(case.grid)
            writer.Write()
    print(f"{opt.count} seeds, {failed} failed, {faults} faulty inputs, {operations} operations, "
          f"slowest {slowest[0]:.1f} s (seed {slowest[1]})")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
