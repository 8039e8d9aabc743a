# SPDX-License-Identifier: BSD-3-Clause
"""What many ranks would cost, predicted from the costs measured on a few; a Markdown table.

    python3 Testing/Benchmarks/ranks_predict.py [--cells N] [--ranks N ...] [--COST VALUE ...]

Nothing is run. The model: each rank has a compact piece of the mesh and neighbours all around; bands are `layer` of its cells
to the power 2/3, in `rounds` rounds. All costs below may be set; the defaults and where they come from stand beside them. The
machine's latency and bandwidth are assumptions. Not in the model: pieces of unequal work, waiting, reading and writing.
"""
import argparse

COSTS = {  # name: default, what it is, where it comes from
    "work": (1.5, "us a cell, the optimizer with effort Default on one thread", "README: the finer cylinder, 170 k in .25 s"),
    "handling": (1.5, "us a cell, numbering, joining and checks of a piece", "Filters/RANKS.md: about as much as the work"),
    "pack": (1.0, "us a cell that moves, packing, sorting and joining", "shared with vtkRedistributeDataSetFilter: .7 to 1.8"),
    "layer": (41.0, "cells of two layers all around, by cells^(2/3) of a piece", "17 % of 15 M, 40 % of 1 M"),
    "rounds": (1.3, "rounds, as a sum of their bands by the first", "RESULTS.md: bands over all rounds"),
    "bytes": (104.0, "a cell that is sent, with its points, ids and one double", "Pack() in vtkMeshRanksPart.cxx"),
    "memory": (205.0, "bytes a cell that a rank takes at most beside its piece", "RESULTS.md: 203 MB for 1 M"),
    "exchanges": (40.0, "meetings of all ranks in a run of two rounds", "counted in vtkMeshOptimizeRounds.cxx"),
    "latency": (5.0, "us a step of a meeting", "assumed: a cluster's network"),
    "bandwidth": (2.0, "GB/s of a rank", "assumed"),
}


def predict(cells, ranks, cost):
    """A row: share in bands, seconds of its parts, bytes, memory."""
    piece = cells / ranks
    share = min(1.0, cost["layer"] * piece ** (-1 / 3)) if ranks > 1 else 0.0
    moved = share * piece * cost["rounds"]
    sent = 2.0 * moved * cost["bytes"]  # to the band's rank, and home
    steps = 1
    while steps < ranks:
        steps *= 2
    inside = 1e-6 * piece * (cost["work"] + (cost["handling"] if ranks > 1 else 0.0))
    bands = 1e-6 * moved * (cost["work"] + 2.0 * cost["pack"])
    wire = sent / (1e9 * cost["bandwidth"]) + 2e-6 * cost["exchanges"] * (steps - 1) * cost["latency"]
    return {"cells a rank": f"{piece / 1e6:.2f} M", "in a band": f"{100 * share:.0f} %", "pieces": f"{inside:.1f} s",
            "bands": f"{bands:.1f} s", "network": f"{wire:.1f} s", "all": f"{inside + bands + wire:.1f} s",
            "sent by a rank": f"{sent / 1e9:.2f} GB", "memory of a rank": f"{piece * (1 + share) * cost['memory'] / 1e9:.2f} GB"}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", type=float, default=1e9)
    parser.add_argument("--ranks", type=int, nargs="+", default=[64, 1024])
    for name, (value, what, where) in COSTS.items():
        parser.add_argument("--" + name, type=float, default=value, help=f"{what} ({value}; {where})")
    opt = parser.parse_args()
    rows = [predict(opt.cells, ranks, vars(opt)) for ranks in opt.ranks]
    print("| ranks | " + " | ".join(rows[0]) + " |\n" + "|---" * (len(rows[0]) + 1) + "|")
    for ranks, row in zip(opt.ranks, rows):
        print(f"| {ranks} | " + " | ".join(row.values()) + " |")


if __name__ == "__main__":
    main()
