# SPDX-License-Identifier: BSD-3-Clause
"""Every C++ source says its licence in the first line and has no line of more than 100 columns. A test."""
import pathlib
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
COLUMNS = 100


def main():
    faults = []
    for folder in ("Filters", "Testing"):
        for path in sorted((SOURCE / folder).rglob("*")):
            if path.suffix not in (".h", ".hxx", ".cpp", ".cxx"):
                continue
            lines = path.read_text(encoding="utf-8").splitlines()
            name = path.relative_to(SOURCE)
            if not lines or "SPDX-License-Identifier" not in lines[0]:
                faults.append(f"{name}: no licence in the first line")
            faults += [f"{name}:{k}: {len(line)} columns" for k, line in enumerate(lines, 1) if len(line) > COLUMNS]
    print("\n".join(faults) or f"all lines have at most {COLUMNS} columns, all sources a licence")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
