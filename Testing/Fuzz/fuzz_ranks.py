# SPDX-License-Identifier: BSD-3-Clause
"""Random small meshes in random pieces through vtkMeshOptimizeFilter on several ranks, with OptimizeBorders, beside one rank.

    eval "$(./bootstrap.sh env)"
    /usr/bin/python3 Testing/Fuzz/fuzz_ranks.py FIRST COUNT [--slide] [--ranks N] [--limit SECONDS] [--least SHARE] [--verbose]

Runs the seeds FIRST ... FIRST + COUNT - 1 on N (2) ranks of this computer; each is a mesh, a division and options of its own,
always the same. Every line of output but the last is a seed to look at. The last says how many ended at less than .98 of one
rank's worst quality (the promise of Filters/RANKS.md for larger meshes), and how many of these have reached the target all the
same: what was asked for is done then. The exit status is 1 if anything failed, or if more than 1 - SHARE (.95) are under both.
What is checked:

- the ranks end within the limit (60 s) of a seed: a watchdog ends those that wait for ever;
- no error, but that the points need global ids where a crack and a border meet, or that one rank has an error, too;
- surface, interfaces and volume are as before, no facet has three cells, on the gathered mesh; where points have no ids, this
  is seen by places, which cannot tell the sides of a crack apart where cells lie on each other;
- with --slide the meshes are triangles whose boundary slides: it stays near the lines of before (as near as in fuzz_boundary.py),
  as many lines meet at each point, and fixed points stay;
- figures are the same on all ranks; worst, mean and bound of the input are those of one rank, unless cells are inverted, flat
  or coincide: which side of a piece is up is then decided for each piece.
"""
import argparse
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np

SERIAL = ("WorstQualityBefore", "MeanQualityBefore", "QualityBound")


def divide(random, mesh, ranks):
    """A rank for each cell."""
    centers, kind = mesh["points"][mesh["cells"]].mean(axis=1), random.random()
    if kind < 0.5:  # slabs, not equal
        along = centers @ random.normal(size=3)
        cuts = np.quantile(along, np.sort(random.random(ranks - 1)))
        return np.searchsorted(cuts, along), "slabs"
    if kind < 0.8:
        seeds = centers[random.integers(len(centers), size=ranks)]
        return ((centers[:, None] - seeds) ** 2).sum(axis=2).argmin(axis=1), "blobs"
    if kind < 0.9:
        return random.integers(ranks, size=len(centers)), "scattered"
    return np.full(len(centers), random.integers(ranks)), "on one rank"


def choose_sliding(random):
    return {"BoundaryMode": 1, "BoundaryCurve": int(random.random() < 0.5),
            "CornerAngle": float(random.choice([0.0, 10.0, 45.0, 45.0, 90.0, 180.0]))}


def choose(random, mesh):
    options = {"TargetQuality": float(random.choice([0.3, 0.6, 0.6, 0.8])), "Effort": int(random.choice([0, 1, 1, 1]))}
    for name in ("MoveNodes", "Reconnect", "InsertNodes", "RemoveNodes", "LookAhead"):
        if random.random() < 0.05:
            options[name] = False
    if random.random() < 0.15:
        options["QualityMeasure"] = int(random.integers(6))
    arrays = {"RegionArray": "region"} if mesh["regions"] is not None else {}
    if mesh["fixed"] is not None:
        arrays["FixedPointArray"] = "fixed"
    return options, arrays


class Case:
    """One seed, the same on all ranks."""

    def __init__(self, seed, ranks, slides=False):
        from fuzz_boundary import plane_mesh
        from fuzz_meshes import random_mesh
        random = np.random.default_rng([seed, 3] if slides else seed)
        mesh = plane_mesh(random) if slides else random_mesh(random)
        mesh["others"] = []
        self.mesh = mesh
        self.text = mesh["text"]
        self.owner, how = divide(random, mesh, ranks) if len(mesh["cells"]) else (np.zeros(0, int), "nothing")
        self.options, self.arrays = choose(random, mesh)
        self.ids = random.random() < 0.6
        self.slides = slides
        if slides:
            self.options.update(choose_sliding(random))
        elif random.random() < 0.15:
            self.options.update(OptimizeBelow=float(random.choice([0.1, 0.3])), NumberOfLayers=int(random.integers(4)))
        self.text += f", {how}, {'ids' if self.ids else 'no ids'}, {self.options}, {self.arrays}"

    def grid(self, chosen):
        from ranks_case import add, make_grid
        from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray
        cells = self.mesh["cells"].reshape(-1, self.mesh["dimension"] + 1).astype(int)[chosen]
        used = np.unique(cells)
        grid = make_grid(self.mesh["points"][used], np.searchsorted(used, cells))
        if self.mesh["regions"] is not None:
            add(grid.GetCellData(), "region", self.mesh["regions"][chosen].astype(np.int64))
        if self.mesh["fixed"] is not None:
            add(grid.GetPointData(), "fixed", self.mesh["fixed"][used].astype(np.int8))
        for data, ids in ((grid.GetPointData(), used), (grid.GetCellData(), np.flatnonzero(chosen))):
            if self.ids and len(ids):
                array = numpy_to_vtkIdTypeArray(ids.astype(np.int64), deep=1)
                array.SetName("Id")
                data.SetGlobalIds(array)
        return grid

    def run(self, grid, everywhere):
        from ranks_case import run

        def choose_arrays(f):
            for name, array in self.arrays.items():
                getattr(f, "Set" + name)(array)
        return run(grid, everywhere, choose_arrays, **self.options)

    def is_tangled(self, serial):
        return serial.GetWorstQualityBefore() <= 0 or "at one place" in self.text


def cells_of(grid):
    """Corners [m, D + 1, 4]: places, and global ids or -1; and regions or zeros."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    n = grid.GetNumberOfCells()
    if n == 0:
        return None, None
    x = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    ids, region = grid.GetPointData().GetGlobalIds(), grid.GetCellData().GetArray("region")
    x = np.c_[x, vtk_to_numpy(ids) if ids else np.full(len(x), -1.0)]
    return (x[vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(n, -1)],
            vtk_to_numpy(region).astype(np.int64) if region else np.zeros(n, np.int64))


def kept_of(cells, regions):
    """
    The facets that have one cell, or cells of two regions, sorted; the most cells of a facet. By the bits of their corners, and by
    ids where there are any: by places alone the sides of a crack are one facet.
    """
    n = cells.shape[1]
    local = [[k for k in range(n) if k != i] for i in range(n)]
    facets = np.ascontiguousarray(cells[:, local].reshape(-1, n - 1, 4) + 0.0)
    facets = np.sort(facets.view("f8,f8,f8,f8").reshape(-1, n - 1), axis=1).view(f"V{32 * (n - 1)}").ravel()
    unique, inverse, count = np.unique(facets, return_inverse=True, return_counts=True)
    low, high = np.full(len(unique), 2 ** 62), np.full(len(unique), -2 ** 62)
    np.minimum.at(low, inverse, np.repeat(regions, n))
    np.maximum.at(high, inverse, np.repeat(regions, n))
    return unique[(count != 2) | (low != high)], count.max()


def lines_of(kept):
    """Kept facets of triangles as the places of their ends."""
    return kept.view("f8").reshape(-1, 2, 4)


def look_at_boundary(case, old, new):
    """What is wrong with a boundary that slides."""
    from fuzz_boundary import distance_to_lines
    old, new = lines_of(old), lines_of(new)
    x = case.mesh["points"]
    extent = np.ptp(x, axis=0).max()
    longest = np.linalg.norm(old[:, 1, :3] - old[:, 0, :3], axis=1).max()
    share = 1.2 * 0.5 * np.tan(np.radians(case.options["CornerAngle"]) / 4.0) if case.options["BoundaryCurve"] else 0.0
    away = distance_to_lines(new.reshape(-1, 4)[:, :3], old[:, :, :3]).max()
    if away > share * longest + 1e-9 * extent + 1e-13 * np.abs(x).max():
        return f"the boundary went {away} away (extent {extent})"
    meet = [np.unique(e.reshape(-1, 4), axis=0, return_counts=True)[1] for e in (old, new)]
    before, after = (sorted(m[m != 2].tolist()) for m in meet)
    if before != after and ("cracked" not in case.text or case.ids):  # by places alone both sides of a crack are one line
        return f"points where boundaries meet: {before} became {after}"
    return ""


def volume_of(cells):
    edges = cells[:, 1:, :3] - cells[:, :1, :3]
    if cells.shape[1] == 4:
        return np.abs(np.linalg.det(edges)).sum() / 6
    return np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1).sum() / 2


def look(case, f, serial, after, figures):
    """What is wrong, on the first rank; and the worst quality as a share of one rank's."""
    told, expected = " ".join(f.told), " ".join(serial.told)
    if serial.GetErrorCode() != 0:
        return "" if f.GetErrorCode() != 0 else f"no error, alone: {expected}", 1.0
    if f.GetErrorCode() != 0:
        return ("" if "give the points global ids" in told and not case.ids else told), 1.0
    if len({tuple(row) for row in np.nan_to_num(figures)}) != 1:
        return "figures differ by rank", 1.0
    tangled = case.is_tangled(serial)
    for name in SERIAL if not tangled else ():
        a, b = getattr(f, "Get" + name)(), getattr(serial, "Get" + name)()
        # Without ids a crack on a border is none, and on ranks nothing stands opposite: the bound is then higher.
        if abs(a - b) > 1e-5 * max(1.0, abs(b)) and not (name == "QualityBound" and a > b):
            return f"{name} {a}, alone {b}", 1.0
    before, mine = cells_of(case.grid(np.ones(len(case.mesh["cells"]), bool))), [p for p in after if p[0] is not None]
    if before[0] is not None:
        cells = tuple(np.concatenate(p) for p in zip(*mine))
        (old, most), (new, now) = kept_of(*before), kept_of(*cells)
        blind = "at one place" in case.text or (tangled and "cracked" in case.text and not case.ids)
        if (now > max(most, 2) or not (case.slides or np.array_equal(old, new))) and not blind:
            return f"another surface or interface, {len(old)} and {len(new)} facets, {now} cells", 1.0
        wrong = look_at_boundary(case, old, new) if case.slides and not blind else ""
        if wrong:
            return wrong, 1.0
        places = {tuple(x) for x in cells[0].reshape(-1, 4)[:, :3]}
        used = np.unique(case.mesh["cells"])
        if case.mesh["fixed"] is not None and not all(tuple(case.mesh["points"][p]) in places for p in used[case.mesh["fixed"][used]]):
            return "a fixed point is gone", 1.0
        if not tangled and not case.slides and abs(volume_of(cells[0]) - volume_of(before[0])) > 1e-9 * volume_of(before[0]):
            return "another volume", 1.0
    a, b = f.GetWorstQualityAfter(), serial.GetWorstQualityAfter()
    if a < f.GetWorstQualityBefore() and not tangled:
        return f"the worst fell to {a}", 1.0
    return "", (a / b if b > 1e-9 else 1.0 if a > b - 0.02 else 0.0)


def work(first, count, report, slides):
    """On each rank: runs the seeds, and the first rank writes a line for each."""
    sys.path.insert(0, str(pathlib.Path(__file__).parent))
    sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "ParaView"))
    import pickle

    import ranks_case as rc
    sys.excepthook = rc.fail
    for seed in range(first, first + count):
        case = Case(seed, rc.ranks, slides)
        serial = case.run(case.grid(np.ones(len(case.mesh["cells"]), bool)), False) if rc.rank == 0 else None
        f = case.run(case.grid(case.owner == rc.rank), True)
        path = f"{rc.folder}/fuzz.{rc.ranks}.{{}}.pickle"
        figures = [f.GetWorstQualityAfter(), f.GetMeanQualityAfter(), f.GetQualityBound(), float(f.GetStopReason())]
        pathlib.Path(path.format(rc.rank)).write_bytes(pickle.dumps((cells_of(f.GetOutput()), figures)))
        rc.controller.Barrier()
        if rc.rank == 0:
            every = [pickle.loads(pathlib.Path(path.format(r)).read_bytes()) for r in range(rc.ranks)]
            wrong, share = look(case, f, serial, [e[0] for e in every], [e[1] for e in every])
            with open(report, "a", encoding="utf-8") as lines:
                lines.write(repr((seed, wrong, share, case.is_tangled(serial), f.GetWorstQualityAfter(), serial.GetWorstQualityAfter(),
                                  f.GetTargetQuality(), case.text)) + "\n")
        rc.controller.Barrier()


def run_seeds(opt, first, last, report):
    """The seeds that are done: all, or those before one that hangs or crashes."""
    command = ["mpirun.openmpi", "--oversubscribe", "-np", opt.ranks, "pvbatch", "--symmetric", __file__, "--worker",
               first, last - first, report, int(opt.slide)]
    environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                   "OMPI_MCA_mpi_yield_when_idle": "1",  # ranks that wait take the time of those that work, where cores are few
                   "MESHOPTIMIZE_OUTPUT": str(report.parent)}
    with open(report.parent / "said", "wb") as said:
        process = subprocess.Popen(list(map(str, command)), env=environment, stdout=said, stderr=said)
        seen, since = 0, time.monotonic()
        while process.poll() is None:
            time.sleep(0.2)
            size = report.stat().st_size if report.exists() else 0
            if size != seen:
                seen, since = size, time.monotonic()
            elif time.monotonic() - since > opt.limit:
                process.terminate()  # mpirun ends its ranks
                process.wait()
    return [eval(line) for line in report.read_text(encoding="utf-8").splitlines()] if report.exists() else []  # our own


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("first", type=int)
    parser.add_argument("count", type=int)
    parser.add_argument("--slide", action="store_true")
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--limit", type=float, default=60.0)
    parser.add_argument("--least", type=float, default=0.95)
    parser.add_argument("--verbose", action="store_true")
    opt = parser.parse_args()
    failed, low, low_tangled, low_done, tangled_ones, first, last = 0, 0, 0, 0, 0, opt.first, opt.first + opt.count
    while first < last:
        with tempfile.TemporaryDirectory() as folder:
            rows = run_seeds(opt, first, last, pathlib.Path(folder) / "report")
            said = (pathlib.Path(folder) / "said").read_text(encoding="utf-8", errors="replace").strip()
        for seed, wrong, share, tangled, worst, serial, target, text in rows:
            failed, low, done = failed + bool(wrong), low + (share < 0.98), share < 0.98 and worst >= target
            low_done += done
            low_tangled, tangled_ones = low_tangled + (tangled and share < 0.98), tangled_ones + tangled
            if wrong or share < 0.98 or opt.verbose:
                kind = (", tangled" if tangled else "") + (", at its target" if done else "")
                print(f"{seed}: {wrong or 'worst'} {worst:.4f}, alone {serial:.4f}{kind}: {text}", flush=True)
        first += len(rows)
        if first < last:
            failed += 1
            print(f"{first}: hangs or crashes: {said[-2000:]}", flush=True)
            first += 1
    print(f"{opt.count} seeds on {opt.ranks} ranks: {failed} failed, {low} under .98 of one rank, {low_done} of these at their "
          f"target, {low_tangled} among the {tangled_ones} with inverted, flat or coinciding cells", flush=True)
    return 1 if failed or low - low_done > (1 - opt.least) * opt.count else 0


if __name__ == "__main__":
    if sys.argv[1:2] == ["--worker"]:
        work(int(sys.argv[2]), int(sys.argv[3]), sys.argv[4], sys.argv[5] == "1")  # without sys.exit(): pvbatch has to end MPI
    else:
        sys.exit(main())
