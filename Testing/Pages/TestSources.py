# SPDX-License-Identifier: BSD-3-Clause
"""Every source says its licence in its first lines; C++ has no line of more than 100 columns. A test.

    python3 Testing/Pages/TestSources.py

Testing/Consumer/Project and the examples need no licence lines: they stand for what somebody else writes.
"""
import pathlib
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
COLUMNS = 100
CPP = (".h", ".hxx", ".cpp", ".cxx")
SCRIPTS = (".py", ".cmake", ".sh")
FOR_OTHERS = ("Consumer", "Examples")


def faults_of(path):
    lines = path.read_text(encoding="utf-8").splitlines()
    name = path.relative_to(SOURCE)
    is_cpp = path.suffix in CPP
    faults = [f"{name}:{k}: {len(line)} columns" for k, line in enumerate(lines, 1) if is_cpp and len(line) > COLUMNS]
    is_script = lines and lines[0].startswith("#!")
    if not set(FOR_OTHERS) & set(name.parts) and "SPDX-License-Identifier" not in "".join(lines[:2 if is_script else 1]):
        faults.append(f"{name}: no licence in the first line")
    return faults


def main():
    sources = [path for folder in ("Filters", "ParaViewPlugin", "Testing") for path in sorted((SOURCE / folder).rglob("*"))
               if path.suffix in CPP + SCRIPTS]
    faults = [fault for path in sources for fault in faults_of(path)]
    print("\n".join(faults) or f"{len(sources)} sources")
    return 1 if faults or not sources else 0


if __name__ == "__main__":
    sys.exit(main())
