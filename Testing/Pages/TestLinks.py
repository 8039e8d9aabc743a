# SPDX-License-Identifier: BSD-3-Clause
"""The pages are consistent: links lead somewhere, files they name exist, README.md is short. A test.

    python3 Testing/Pages/TestLinks.py

Held for every page (*.md) of the repository:
- a relative link names a file or folder that is there, and an anchor names a heading of that page;
- so do paths from the top of the repository (Filters/..., Testing/...), in the text and in commands;
- no path of somebody's machine;
- no line over 120 columns, but for tables; README.md has at most 200 lines.
"""
import pathlib
import re
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
MOST_LINES, MOST_COLUMNS = {"README.md": 200}, 120
LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
PATH = re.compile(r"(?<![\w/.-])(?:Filters|Testing|ParaViewPlugin|Data)/[\w./-]*\w")
MACHINE = re.compile(r"(?<![\w.~-])/(?:home|work|tmp|root|mnt)/\S*")
HEADING = re.compile(r"^#+ +(.*)$", re.MULTILINE)
CODE = re.compile(r"^```.*?^```$", re.DOTALL | re.MULTILINE)


def pages():
    hidden = lambda path: any(part.startswith((".", "build")) for part in path.relative_to(SOURCE).parts)
    return [path for path in sorted(SOURCE.rglob("*.md")) if not hidden(path)]


def anchors(text):
    """As GitHub makes them: small letters, what is no word left out, hyphens for blanks."""
    headings = HEADING.findall(CODE.sub("", text))
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def fault_of_link(page, text, link):
    if re.match(r"[a-z]+:", link):
        return None  # somewhere else in the world
    name, _, anchor = link.partition("#")
    target = (page.parent / name).resolve() if name else page
    if not target.exists() or SOURCE not in target.parents:
        return f"dead link {link}"
    if anchor and anchor not in anchors(target.read_text(encoding="utf-8") if name else text):
        return f"no heading #{anchor} in {name or page.name}"
    return None


def faults_of(page):
    text = page.read_text(encoding="utf-8")
    lines = text.splitlines()
    faults = [fault for link in LINK.findall(CODE.sub("", text)) if (fault := fault_of_link(page, text, link))]
    faults += [f"names {path}, which is not there" for path in PATH.findall(text)
               if not (SOURCE / path).exists() and not (page.parent / path).exists()]
    faults += [f"names a path of a machine: {path}" for path in MACHINE.findall(text)]
    faults += [f"line {k} has {len(line)} columns" for k, line in enumerate(lines, 1)
               if len(line) > MOST_COLUMNS and not line.startswith("|")]
    most = MOST_LINES.get(str(page.relative_to(SOURCE)))
    if most and len(lines) > most:
        faults.append(f"has {len(lines)} lines, and {most} are the most")
    return faults


def main():
    faults = [f"{page.relative_to(SOURCE)}: {fault}" for page in pages() for fault in faults_of(page)]
    for fault in faults:
        print("FAILED:", fault)
    return 1 if faults or len(pages()) < 5 else 0


if __name__ == "__main__":
    sys.exit(main())
