# SPDX-License-Identifier: BSD-3-Clause
"""The commands mesh-optimize and mesh-quality. Exit status: 0 done, 1 a file failed, 2 wrong use, 130 Ctrl-C."""
import argparse
import contextlib
import functools
import json
import os
import pathlib
import sys
import warnings

import numpy as np

from . import _files, _progress
from ._api import optimize, quality
from ._meshes import adapter
from ._properties import make, nearest, properties
from ._reports import QUALITY_ARRAYS
from ._run import MeshOptimizeError
from .vtkFiltersMeshOptimize import vtkMeshOptimizeFilter, vtkMeshQualityMinMax

FORMATS = f"Formats: {', '.join(_files.SUFFIXES)}. Groups and sets of Gmsh, Medit, Abaqus and Nastran files are kept, "\
          "and groups of tetrahedra are regions. Those formats need meshio."


class _Parser(argparse.ArgumentParser):
    """Names the nearest option to one that does not exist."""

    def parse_args(self, arguments=None):
        given, strange = self.parse_known_args(arguments)
        if strange:
            self.error(f"there is no option {strange[0]}" + nearest(strange[0].split("=")[0], self._option_string_actions))
        return given


def _to_a_pipe(command):
    """A reader of the output that ends early, such as head, is no error; nor is a file name that cannot be printed."""
    @functools.wraps(command)
    def wrapped(*arguments):
        if hasattr(sys.stdout, "reconfigure"):
            sys.stdout.reconfigure(errors="backslashreplace")
        try:
            status = command(*arguments)
            sys.stdout.flush()
            return status
        except BrokenPipeError:
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # Python writes the rest when it ends
            return 1
    return wrapped


def _add_properties(parser, cls):
    """An option for each property of the filter: target_quality is --target-quality."""
    group = parser.add_argument_group("properties of the filter")
    for prop in properties(cls).values():
        names = ["--" + prop.keyword.replace("_", "-")]
        names += {"region_array": ["--region"], "number_of_worst_cells": ["--worst"]}.get(prop.keyword, [])
        kind = {"choice": {"choices": list(prop.choices)}, "whole": {"type": int, "metavar": "N"},
                "real": {"type": float, "metavar": "X"}, "array": {"metavar": "NAME"},
                "switch": {"action": argparse.BooleanOptionalAction}}.get(prop.kind)
        if kind:
            default = "" if prop.kind == "array" else f" ({prop.values}; default {prop.shown_default})"
            group.add_argument(*names, help=(prop.description + default).replace("%", "%%"), **kind)


def _options(parser, arguments, cls):
    """The properties that were given. Wrong values end the program with status 2."""
    options = {keyword: getattr(arguments, keyword, None) for keyword in properties(cls)}
    options = {keyword: value for keyword, value in options.items() if value is not None}
    try:
        make(cls, options)
    except ValueError as error:
        parser.error(str(error))
    return options


def _check_formats(parser, paths, to_read):
    for path in paths:
        try:
            _files.suffix_of(path, to_read)
        except ValueError as error:
            parser.error(str(error))


def _check_picture(parser, given):
    if given.picture and len(given.sources) > 1:
        parser.error("--picture is for one input")
    if given.picture and given.picture.suffix.lower() != ".png":
        parser.error(f"{given.picture}: a picture is a .png file")
    if given.picture and not given.picture.parent.is_dir():
        parser.error(f"the folder {given.picture.parent} is not there")


def _targets(parser, sources, out, picture, force):
    """A file to write for each input. Wrong use ends the program with status 2."""
    if len(sources) == 1 and not out.is_dir():
        targets = [out]
        _check_formats(parser, targets, False)
        if not out.parent.is_dir():
            parser.error(f"the folder {out.parent} is not there")
    elif out.exists() and not out.is_dir() or not out.exists() and out.suffix:
        parser.error(f"several inputs need a folder to write to, and {out} is none")
    else:
        targets = [out / source.name for source in sources]
    if len(set(targets)) < len(targets):
        parser.error("two inputs have the same name")
    for source, target in zip(sources, targets):
        try:
            _files.check_blocks(_files.blocks_in(source), target)
        except ValueError as error:
            parser.error(str(error))
    files = [path for target in targets for path in (target, _files.folder_of_parts(target))]
    there = [str(path) for path in (*files, picture) if path and path.exists()]
    if there and not force:
        parser.error(f"{', '.join(there)}: already there; --force overwrites")
    return targets


@contextlib.contextmanager
def _reporting(program):
    """Warnings are lines on the standard error."""
    with warnings.catch_warnings():
        warnings.simplefilter("always")
        warnings.showwarning = lambda message, *place: print(f"{program}: warning: {message}", file=sys.stderr)
        yield


def _for_each(program, sources, action):
    """Does `action` for each file, and goes on where one fails. The exit status."""
    failed = False
    with _reporting(program):
        for index, source in enumerate(sources):
            try:
                if action(index, source):
                    return 130
            except BrokenPipeError:
                raise
            except (MeshOptimizeError, OSError, ValueError) as error:
                where = "" if str(source) in str(error) else f"{source}: "
                print(f"{program}: {where}{error}", file=sys.stderr)
                failed = True
            except KeyboardInterrupt:
                print(f"{program}: interrupted", file=sys.stderr)
                return 130
    return 1 if failed else 0


def _draw(grids, path):
    from ._picture import draw  # needs VTK's rendering, which nothing else here does

    draw(grids, path)


def _progress_of(quiet):
    if quiet:
        return {}
    return {"progress_bar": True} if sys.stderr.isatty() else {"progress": _progress.plain_bar()[0]}


@_to_a_pipe
def mesh_optimize(arguments=None, program="mesh-optimize"):
    """Raises the worst element quality of mesh files. Returns the exit status."""
    parser = _Parser(
        program, usage="%(prog)s [options] IN [IN ...] OUT", epilog=FORMATS,
        description="Raise the worst element quality of meshes of tetrahedra or triangles.")
    parser.add_argument("sources", metavar="IN", nargs="+", type=pathlib.Path, help="mesh files")
    parser.add_argument("out", metavar="OUT", type=pathlib.Path, help="the file to write; for several inputs a folder")
    parser.add_argument("--force", action="store_true", help="overwrite files")
    parser.add_argument("--quiet", action="store_true", help="print warnings and errors only")
    parser.add_argument("--picture", metavar="FILE.png", type=pathlib.Path, help="draw before and after; of one input")
    _add_properties(parser, vtkMeshOptimizeFilter)
    given = parser.parse_args(arguments)
    _check_formats(parser, given.sources, True)
    options = _options(parser, given, vtkMeshOptimizeFilter)
    _check_picture(parser, given)
    targets = _targets(parser, given.sources, given.out, given.picture, given.force)

    def action(index, source):
        mesh = _files.read(source)
        result, report = optimize(mesh, **_progress_of(given.quiet), **options)
        if len(given.sources) > 1:
            given.out.mkdir(parents=True, exist_ok=True)
        _files.write(result, targets[index])
        if not given.quiet:
            print(f"{source} -> {targets[index]}\n  " + str(report).replace("\n", "\n  "), flush=True)
        if given.picture:
            _draw([("before", adapter(mesh).grid), ("after", adapter(result).grid)], given.picture)
        return report.aborted

    return _for_each(program, given.sources, action)


def _bars(histogram):
    """A histogram in letters. Logarithmic, so that a few bad elements are seen beside many good ones."""
    counts = histogram["Count"].astype(float)
    lengths = np.ceil(50 * np.log1p(counts) / np.log1p(counts.max(initial=1.0))).astype(int)
    return "\n".join(f"  {low:8.4g} to {high:8.4g} {count:10.0f} {'#' * length}" for low, high, count, length
                     in zip(histogram["BinLow"], histogram["BinHigh"], counts, lengths))


def _worst(cells):
    values = next((cells[name] for name in QUALITY_ARRAYS if name in cells), [])
    blocks = [f"  block {block:4d}" for block in cells["Block"]] if "Block" in cells else [""] * len(values)
    rows = zip(blocks, cells.get("OriginalCellIds", []), values, cells.get("Center", []))
    return "\n".join(f"{block}  cell {cell:8d}  quality {value:9.4f}  at ({x:.6g}, {y:.6g}, {z:.6g})"
                     for block, cell, value, (x, y, z) in rows)


@_to_a_pipe
def mesh_quality(arguments=None, program="mesh-quality"):
    """Measures mesh files. Returns the exit status."""
    parser = _Parser(
        program, usage="%(prog)s [options] IN [IN ...]", epilog=FORMATS,
        description="Measure the quality of meshes of tetrahedra or triangles.")
    parser.add_argument("sources", metavar="IN", nargs="+", type=pathlib.Path, help="mesh files")
    parser.add_argument("--histogram", action="store_true", help="print the histogram, too; bars are logarithmic")
    parser.add_argument("--json", action="store_true", help="print all as JSON: a list with an entry for each file")
    parser.add_argument("--picture", metavar="FILE.png", type=pathlib.Path, help="draw the mesh; of one input")
    _add_properties(parser, vtkMeshQualityMinMax)
    given = parser.parse_args(arguments)
    _check_formats(parser, given.sources, True)
    options = _options(parser, given, vtkMeshQualityMinMax)
    _check_picture(parser, given)
    results = []

    def action(index, source):
        mesh = _files.read(source)
        report = quality(mesh, **options)
        results.append({"file": str(source), **report.as_dict()})
        if not given.json:
            print(f"{source}\n  " + str(report).replace("\n", "\n  "))
            if given.histogram:
                print(_bars(report.histogram))
            if given.number_of_worst_cells is not None:
                print(_worst(report.worst_cells))
        if given.picture:
            _draw([(source.name, adapter(mesh).grid)], given.picture)

    status = _for_each(program, given.sources, action)
    if given.json:
        print(json.dumps(results, indent=1))
    return status


def main():
    """python3 -m meshoptimize optimize|quality ..."""
    commands = {"optimize": mesh_optimize, "quality": mesh_quality}
    if len(sys.argv) > 1 and sys.argv[1] in commands:
        return commands[sys.argv[1]](sys.argv[2:], "python3 -m meshoptimize " + sys.argv[1])
    asked = sys.argv[1:2] in (["-h"], ["--help"])
    print("python3 -m meshoptimize optimize|quality --help", file=sys.stdout if asked else sys.stderr)
    return 0 if asked else 2
