# SPDX-License-Identifier: BSD-3-Clause
"""Do the includes between the folders of Filters point one way? A test; its exit status is 1 if one points up.

    python3 Testing/Core/rooms.py

ROOMS are the folders of the core, PRIVATE those of Filters/MeshOptimize/Private, MODULES those of Filters. Each line may
include what stands above it, not what stands beside or below it.
"""
import pathlib
import re
import sys

FILTERS = pathlib.Path(__file__).resolve().parents[2] / "Filters"
ROOMS = [["Base"], ["Mesh"], ["Metric"], ["Quality"], ["Surface", "Bound"], ["Reposition"], ["Edit"], ["Operations"], ["Run"],
         ["WorstFirst", "Sizes", "Paper1996"], ["Optimize", "Thermoelastic"]]
PRIVATE = [["Request", "Ranks"], ["Grid", "QualityMinMax", "SolutionMetric"], ["Boundary"], ["OneGrid"], ["Rounds"],
           ["Tasks"], ["the filters"]]
MODULES = [["Core"], ["Bridge"], ["MeshOptimize", "Thermoelastic", "TetGen"]]
INCLUDE = re.compile(r'^\s*#\s*include\s+["<]([^">]+)[">]', re.MULTILINE)


def sources(folder):
    return sorted(p for p in folder.rglob("*") if p.suffix in (".h", ".hxx", ".cpp", ".cxx"))


def has(table, name):
    return any(name in row for row in table)


def rank(table, name):
    return next(k for k, row in enumerate(table) if name in row)


def faults_of_rooms():
    core = FILTERS / "Core"
    faults = [f"{room.name}: no place in ROOMS" for room in core.iterdir()
              if room.is_dir() and not has(ROOMS, room.name)]
    for path in sources(core):
        room = path.relative_to(core).parts[0]
        for include in INCLUDE.findall(path.read_text()):
            other = include.split("/")[0]
            if include.startswith("vtk"):
                faults.append(f"{path}: the core includes {include}")
            elif other != room and (core / other).is_dir() and rank(ROOMS, other) >= rank(ROOMS, room):
                faults.append(f"{path.relative_to(core)} includes {include}: {room} stands above or beside {other}")
    return faults


def faults_of_private():
    module = FILTERS / "MeshOptimize"
    private = module / "Private"
    home = {path.name: path.relative_to(private).parts[0] for path in sources(private)}
    home.update((path.name, "the filters") for path in sources(module) if path.parent == module)
    rooms = sorted(set(home.values()))
    faults = [f"{room}: no place in PRIVATE" for room in rooms if not has(PRIVATE, room)]
    # Includes begin with the room: of two with one name a reader would not know which is meant.
    faults += [f"{room}: the core has a room of that name" for room in rooms if has(ROOMS, room)]
    if faults:
        return faults
    for path in sources(module):
        room = home[path.name]
        for include in INCLUDE.findall(path.read_text()):
            other = home.get(pathlib.PurePosixPath(include).name)
            if other and other != room and rank(PRIVATE, other) >= rank(PRIVATE, room):
                faults.append(f"{path.relative_to(module)} includes {include}: {room} stands above or beside {other}")
    return faults


def faults_of_modules():
    home = {path.name: module for row in MODULES for module in row if (FILTERS / module).is_dir() and module != "Core"
            for path in sources(FILTERS / module)}
    faults = []
    for path in sources(FILTERS):
        module = path.relative_to(FILTERS).parts[0]
        for include in INCLUDE.findall(path.read_text()):
            other = home.get(pathlib.PurePosixPath(include).name)
            if other and other != module and rank(MODULES, other) >= rank(MODULES, module):
                faults.append(f"{path.relative_to(FILTERS)} includes {include} of {other}")
    return faults


def main():
    faults = faults_of_rooms() + faults_of_private() + faults_of_modules()
    print("\n".join(faults) or "all includes point one way")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
