# SPDX-License-Identifier: BSD-3-Clause
"""Mesh Optimize beside the mesh optimizers that Debian packages: one run over mesh files, a table and a plot.

    eval "$(./bootstrap.sh env)"
    /usr/bin/python3 Testing/Benchmarks/peers.py [options] MESH.vtu ...

    --tools NAME ...   which ones (default: all): quick default best paper tetgen tetgen-120 gmsh gmsh-0.6 gmsh-netgen
                       gmsh-hxt gmsh-hxt-0.6 netgen cgal
    --out FOLDER       where meshes and tables go (default: peers); a tool that has a result there is not run again
    --timeout S        seconds a tool may take, reading and writing included (default: 300)
    --judge PROGRAM    called as  PROGRAM AFTER.vtu --before BEFORE.vtu  on each result; exit status 0: no fault
    --cgal FILE        cgal_remesh (default: bin/cgal_remesh in the folder build of the sources)

Packages: tetgen, python3-gmsh, python3-netgen, python3-meshio, python3-matplotlib; cgal_remesh is built by
cmake -DMESHOPTIMIZE_BENCHMARKS=ON with libcgal-dev. Tetrahedra only, without their data, go to every tool; each is a
process of its own, on one thread, and has to keep the surface. TetGen: -rYq100, by default and with -O10/7 -o/120
(-q100 asks for nothing, but without it TetGen does not optimize). Gmsh: its own optimizer, at its threshold .3 and at
.6, and Netgen's in Gmsh; HXT, which optimizes only what it has made, fills the surface anew, likewise. Netgen:
OptimizeVolumeMesh. CGAL: tetrahedral remeshing with the boundary kept, 5 rounds, at the mean edge length.

Written to FOLDER: peers.md and peers.csv (worst quality S, tetrahedra under .2, surface kept bit for bit or not, seconds
of the process and, as the tool tells them, of the optimization alone; ratios to Mesh Optimize Default), peers.png.
"""
import argparse
import csv
import importlib.util
import json
import pathlib
import re
import shutil
import subprocess
import sys
import time

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE / "peers"))
import formats  # noqa: E402


class Tool:
    """How one tool is called. `command` has {vtu}, {mesh} or {tetgen} for the input and {out} for the result."""

    def __init__(self, name, label, kind, *command, needs=""):
        self.name, self.label, self.kind, self.command, self.needs = name, label, kind, command, needs

    def missing(self, opt):
        if self.kind == "tetgen":
            return shutil.which("tetgen") is None
        if self.kind == "cgal":
            return not pathlib.Path(opt.cgal).exists()
        return importlib.util.find_spec(self.needs) is None

    def line(self, opt, folder):
        """The command line, and the file that it writes."""
        out = folder / f"{self.name}.{'mesh' if self.kind == 'cgal' else 'vtu'}"
        if self.kind == "tetgen":
            shutil.rmtree(folder / self.name, ignore_errors=True)
            shutil.copytree(folder / "tetgen-input", folder / self.name)
            return ["tetgen", *self.command, folder / self.name / "input"], folder / self.name / "input.1.ele"
        if self.kind == "cgal":
            return [opt.cgal, folder / "input.mesh", out], out
        return [sys.executable, HERE / "peers" / self.kind, folder / "input.vtu", out, *self.command], out


TOOLS = [
    Tool("quick", "Mesh Optimize Quick", "ours.py", "quick", needs="meshoptimize"),
    Tool("default", "Mesh Optimize Default", "ours.py", "default", needs="meshoptimize"),
    Tool("best", "Mesh Optimize Best", "ours.py", "best", needs="meshoptimize"),
    Tool("paper", "Mesh Optimize Paper 1996", "ours.py", "paper", needs="meshoptimize"),
    Tool("tetgen", "TetGen", "tetgen", "-rYq100"),
    Tool("tetgen-120", "TetGen -O10/7 -o/120", "tetgen", "-rYq100O10/7o/120"),
    Tool("gmsh", "Gmsh", "gmsh_optimize.py", "default", needs="gmsh"),
    Tool("gmsh-0.6", "Gmsh, threshold .6", "gmsh_optimize.py", "default", "0.6", needs="gmsh"),
    Tool("gmsh-netgen", "Netgen in Gmsh", "gmsh_optimize.py", "Netgen", needs="gmsh"),
    Tool("gmsh-hxt", "HXT in Gmsh, filled anew", "gmsh_optimize.py", "hxt", needs="gmsh"),
    Tool("gmsh-hxt-0.6", "HXT, threshold .6, filled anew", "gmsh_optimize.py", "hxt", "0.6", needs="gmsh"),
    Tool("netgen", "Netgen", "netgen_optimize.py", needs="netgen"),
    Tool("cgal", "CGAL remeshing", "cgal"),
]


def write_tetgen(folder, points, cells):
    """Every face of the surface gets a marker of its own: TetGen flips edges between faces of one marker."""
    folder.mkdir(exist_ok=True)
    tables = {"node": (points, "3 0 0"), "ele": (cells, "4 0"), "face": (formats.boundary(cells), "1")}
    for suffix, (rows, header) in tables.items():
        with open(folder / f"input.{suffix}", "w", encoding="ascii") as f:
            f.write(f"{len(rows)} {header}\n")
            for i, row in enumerate(rows.tolist()):
                marker = f" {i + 1}" if suffix == "face" else ""
                f.write(f"{i} {' '.join(map(repr, row))}{marker}\n")


def prepare(path, folder):
    """The mesh in the formats of the tools: points and tetrahedra that all of them read."""
    if not (folder / "input.vtu").exists():
        folder.mkdir(parents=True, exist_ok=True)
        points, cells = formats.read(path)
        write_tetgen(folder / "tetgen-input", points, cells)
        formats.write(folder / "input.mesh", points, cells)
        formats.write(folder / "input.vtu", points, cells)
    return formats.read(folder / "input.vtu")


def judge(before, after, result, opt, folder):
    """Fills in what is to be said of mesh `after`, and writes it as a .vtu file if the tool did not."""
    points, cells = formats.read(after)
    quality = formats.shape(points, cells)
    if quality.sum() < 0:  # numbered the other way round throughout
        cells = cells[:, [0, 1, 3, 2]]
        quality = -quality
    if after.suffix != ".vtu":
        after = folder / f"{result['tool']}.vtu"
        formats.write(after, points, cells)
    kept = [formats.surface(*mesh) for mesh in (before, (points, cells))]
    result.update(cells=len(cells), worst=float(quality.min()), under=int((quality < 0.2).sum()),
                  surface="yes" if np.array_equal(*kept) else "NO")
    if opt.judge:
        done = subprocess.run([opt.judge, after, "--before", folder / "input.vtu"], stdout=subprocess.PIPE, text=True)
        faults = [line for line in done.stdout.splitlines() if line.startswith("FAULT")]
        result["fault"] = "none" if done.returncode == 0 else "; ".join(faults) or "FAULT"


def last_words(text):
    """What a tool said last that is worth a cell of the table."""
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    return lines[-1][:100].replace("|", "/") if lines else "no message"


def run(tool, mesh, opt, folder):
    """One tool on one mesh: a row of the table."""
    result = {"tool": tool.name, "status": "ok"}
    if tool.missing(opt):
        return {**result, "status": "not installed"}
    command, out = tool.line(opt, folder)
    out.unlink(missing_ok=True)
    start = time.perf_counter()
    try:
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=opt.timeout)
    except subprocess.TimeoutExpired:
        return {**result, "status": f"stopped after {opt.timeout:g} s"}
    result["wall"] = time.perf_counter() - start
    said = done.stdout.decode(errors="replace")
    (folder / f"{tool.name}.log").write_text(said)
    if done.returncode != 0 or not out.exists():
        return {**result, "status": f"failed: {last_words(said)}"}
    for key, pattern in (("seconds", r"^(?:Optimization )?seconds:?\s+(\S+)$"), ("bound", r"^bound (\S+)$")):
        found = re.findall(pattern, said, re.MULTILINE)
        if found:
            result[key] = float(found[-1])
    judge(mesh, out, result, opt, folder)
    return result


def run_all(path, opt):
    """The rows of one mesh; those that FOLDER has already are read."""
    folder = opt.out / path.stem
    mesh = prepare(path, folder)
    quality = formats.shape(*mesh)
    rows = [{"tool": "", "status": "ok", "cells": len(mesh[1]), "worst": float(quality.min()),
             "under": int((quality < 0.2).sum()), "surface": "yes"}]
    for tool in TOOLS:
        if tool.name not in opt.tools:
            continue
        file = folder / f"{tool.name}.json"
        if not file.exists():
            row = run(tool, mesh, opt, folder)
            if row["status"] != "not installed":
                file.write_text(json.dumps(row, indent=1))
            print(f"{path.stem}: {tool.label}: {row['status']}", row.get("worst", ""), file=sys.stderr, flush=True)
        else:
            row = json.loads(file.read_text())
        rows.append(row)
    for row in rows:
        row.update(mesh=path.stem, label=next((t.label for t in TOOLS if t.name == row["tool"]), "input"))
        row["bound"] = next((r["bound"] for r in rows if "bound" in r), None)
    add_ratios(rows)
    return rows


def add_ratios(rows):
    ours = next((r for r in rows if r["tool"] == "default" and "worst" in r), None)
    for row in rows:
        if ours and row["tool"] and "worst" in row:
            row["quality ratio"] = row["worst"] / ours["worst"]
            for key in ("seconds", "wall"):
                if row.get(key) and ours.get(key):
                    row[f"{key} ratio"] = row[key] / ours[key]


COLUMNS = [("mesh", "mesh", "{}"), ("label", "tool", "{}"), ("cells", "cells", "{}"), ("worst", "worst S", "{:.4f}"),
           ("under", "under .2", "{}"), ("surface", "surface kept", "{}"), ("seconds", "optimizer, s", "{:.3f}"),
           ("wall", "process, s", "{:.2f}"), ("quality ratio", "worst S, ratio", "{:.2f}"),
           ("seconds ratio", "optimizer, ratio", "{:.3g}"), ("wall ratio", "process, ratio", "{:.3g}")]


def write_tables(rows, opt):
    columns = COLUMNS + ([("fault", "judge", "{}")] if opt.judge else [])
    lines = ["| " + " | ".join(title for _, title, _ in columns) + " |", "|" + "---|" * len(columns)]
    for row in rows:
        if row["status"] != "ok":  # said instead of the numbers
            lines.append(f"| {row['mesh']} | {row['label']} | {row['status']} |" + " |" * (len(columns) - 3))
            continue
        texts = [pattern.format(row[key]) if row.get(key) is not None else "" for key, _, pattern in columns]
        lines.append("| " + " | ".join(texts) + " |")
    text = "\n".join(lines) + "\n"
    (opt.out / "peers.md").write_text(text)
    print(text)
    with open(opt.out / "peers.csv", "w", newline="", encoding="utf-8") as f:
        names = ["tool", "status", "bound"] + [key for key, _, _ in columns]
        writer = csv.DictWriter(f, names, extrasaction="ignore")
        writer.writeheader()
        writer.writerows(rows)


def draw(rows, opt):
    """Worst quality against the seconds of the optimization, one panel per mesh, one marker per tool."""
    if importlib.util.find_spec("matplotlib") is None:
        print("no plot: python3-matplotlib is not installed", file=sys.stderr)
        return
    import plot
    plot.draw(rows, [tool.label for tool in TOOLS], opt.out / "peers.png")


def main():
    build = HERE.parents[1] / "build" / "bin"
    names = [tool.name for tool in TOOLS]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", nargs="+", type=pathlib.Path)
    parser.add_argument("--tools", nargs="+", choices=names, default=names, metavar="NAME")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("peers"))
    parser.add_argument("--timeout", type=float, default=300)
    parser.add_argument("--judge")
    parser.add_argument("--cgal", default=build / "cgal_remesh")
    opt = parser.parse_args()
    opt.out = opt.out.resolve()
    rows = [row for path in opt.mesh for row in run_all(path, opt)]
    write_tables(rows, opt)
    draw(rows, opt)
    return 0


if __name__ == "__main__":
    sys.exit(main())
