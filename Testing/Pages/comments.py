# SPDX-License-Identifier: BSD-3-Clause
"""How many of the lines are comments, in headers and in sources of Filters, and where there are fewest.

    python3 Testing/Pages/comments.py [COUNT]

A line counts if nothing but a comment is on it; licence lines do not. The second share leaves out empty lines and those
with nothing but brackets: here a brace has a line of its own, in other projects it has not. Lists the COUNT files
(default 10) of more than 60 lines with the least share. Not a test: what a comment says is more than how many there are.
"""
import pathlib
import sys

FILTERS = pathlib.Path(__file__).resolve().parents[2] / "Filters"
KINDS = {"headers": (".h",), "sources": (".cpp", ".cxx", ".hxx")}


def count(path):
    """(lines, comment lines, lines with nothing but brackets) of a file."""
    comments, bare, is_open = 0, 0, False
    lines = path.read_text(encoding="utf-8").splitlines()
    for line in map(str.strip, lines):
        begins = line.startswith("/*")
        comments += is_open or begins or (line.startswith("//") and "SPDX-License-Identifier" not in line)
        bare += not is_open and not line.strip("{}();,")
        is_open = (is_open or begins) and "*/" not in line
    return len(lines), comments, bare


def main():
    listed = int(sys.argv[1]) if len(sys.argv) > 1 else 10
    files = {path: count(path) for path in sorted(FILTERS.rglob("*")) if path.suffix in sum(KINDS.values(), ())}
    for kind, suffixes in KINDS.items():
        counts = [figures for path, figures in files.items() if path.suffix in suffixes]
        lines, comments, bare = (sum(column) for column in zip(*counts))
        print(f"{kind}: {comments} of {lines} lines, {100 * comments / lines:.1f} %; "
              f"{100 * comments / (lines - bare):.1f} % without bare lines ({len(counts)} files)")
    long_ones = [(path, *figures) for path, figures in files.items() if figures[0] > 60]
    for path, lines, comments, _ in sorted(long_ones, key=lambda f: f[2] / f[1])[:listed]:
        print(f"{100 * comments / lines:5.1f} % of {lines:3}  {path.relative_to(FILTERS)}")


if __name__ == "__main__":
    main()
