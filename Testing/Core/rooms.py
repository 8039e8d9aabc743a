# SPDX-License-Identifier: BSD-3-Clause
"""Do the includes between the folders of Filters point one way? A test; its exit status is 1 if one points up.

    python3 Testing/Core/rooms.py

Each line of ROOMS may include what stands above it, not what stands beside or below it.
"""
import pathlib
import re
import sys

FILTERS = pathlib.Path(__file__).resolve().parents[2] / "Filters"
ROOMS = [["Base"], ["Mesh"], ["Metric"], ["Quality"], ["Surface", "Bound"], ["Reposition"], ["Edit"], ["Operations"], ["Run"],
         ["WorstFirst", "Sizes", "Paper1996"], ["Optimize", "Thermoelastic"]]
MODULES = [["Core"], ["Bridge"], ["MeshOptimize", "Thermoelastic", "TetGen"]]
INCLUDE = re.compile(r'^\s*#\s*include\s+["<]([^">]+)[">]', re.MULTILINE)


def sources(folder):
    return sorted(p for p in folder.rglob("*") if p.suffix in (".h", ".hxx", ".cpp", ".cxx"))


def rank(table, name):
    return next(k for k, row in enumerate(table) if name in row)


def faults_of_rooms():
    core = FILTERS / "Core"
    faults = [f"{room.name}: no place in ROOMS" for room in core.iterdir()
              if room.is_dir() and not any(room.name in row for row in ROOMS)]
    for path in sources(core):
        room = path.relative_to(core).parts[0]
        for include in INCLUDE.findall(path.read_text()):
            other = include.split("/")[0]
            if include.startswith("vtk"):
                faults.append(f"{path}: the core includes {include}")
            elif other != room and (core / other).is_dir() and rank(ROOMS, other) >= rank(ROOMS, room):
                faults.append(f"{path.relative_to(core)} includes {include}: {room} stands above or beside {other}")
    return faults


def faults_of_modules():
    home = {path.name: module for row in MODULES for module in row if (FILTERS / module).is_dir() and module != "Core"
            for path in sources(FILTERS / module)}
    faults = []
    for path in sources(FILTERS):
        module = path.relative_to(FILTERS).parts[0]
        for include in INCLUDE.findall(path.read_text()):
            other = home.get(include)
            if other and other != module and rank(MODULES, other) >= rank(MODULES, module):
                faults.append(f"{path.relative_to(FILTERS)} includes {include} of {other}")
    return faults


def main():
    faults = faults_of_rooms() + faults_of_modules()
    print("\n".join(faults) or "all includes point one way")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
