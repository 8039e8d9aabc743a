# SPDX-License-Identifier: BSD-3-Clause
"""Every C++ source says its licence in the first line and has no line of more than 100 columns. A test.

    python3 Testing/Pages/TestSources.py

Testing/Consumer/Project needs no licence lines: it stands for a project of somebody else.
"""
import pathlib
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
COLUMNS = 100


def faults_of(path):
    lines = path.read_text(encoding="utf-8").splitlines()
    name = path.relative_to(SOURCE)
    faults = [f"{name}:{k}: {len(line)} columns" for k, line in enumerate(lines, 1) if len(line) > COLUMNS]
    if "Consumer" not in name.parts and "SPDX-License-Identifier" not in "".join(lines[:1]):
        faults.append(f"{name}: no licence in the first line")
    return faults


def main():
    sources = [path for folder in ("Filters", "ParaViewPlugin", "Testing") for path in sorted((SOURCE / folder).rglob("*"))
               if path.suffix in (".h", ".hxx", ".cpp", ".cxx")]
    faults = [fault for path in sources for fault in faults_of(path)]
    print("\n".join(faults) or f"{len(sources)} sources")
    return 1 if faults or not sources else 0


if __name__ == "__main__":
    sys.exit(main())
