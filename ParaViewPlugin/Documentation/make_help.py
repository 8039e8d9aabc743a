# SPDX-License-Identifier: BSD-3-Clause
"""The pages of this folder as HTML for ParaView's help: the plugin takes all of ParaViewPlugin/Help. Needs Python alone.

    python3 ParaViewPlugin/Documentation/make_help.py            writes them
    python3 ParaViewPlugin/Documentation/make_help.py --check    exit status 1 if one is not what its page says (a test)

Only what the pages use of Markdown is known. Links to the reference become links to the pages of properties that ParaView makes;
other links out of this folder become plain text. CMake puts the pictures beside the pages.
"""
import html
import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
HELP = HERE.parent / "Help"
PAGES = ("FirstTime", "Tutorial", "MeshOptimize", "MeshQualityMinMax", "SolutionMetric", "TetGen", "Thermoelastic")


PROPERTIES = {"mesh-optimize": "MeshOptimize", "mesh-quality-min-max": "MeshQualityMinMax", "solution-metric": "SolutionMetric",
              "tetrahedralize-tetgen": "TetGen", "thermoelastic": "Thermoelastic"}  # headings of REFERENCE.md


def link(match):
    words, target = match.groups()
    name, _, heading = target.partition("#")
    if heading in PROPERTIES:
        return f'<a href="filters.{PROPERTIES[heading]}.html">{words}</a>'
    return f'<a href="{name[:-3]}.html">{words}</a>' if name.endswith(".md") and name[:-3] in PAGES else words


def inline(text):
    text = html.escape(text, quote=False)
    text = re.sub(r"!\[([^\]]*)\]\(([^)]*)\)", lambda m: f'<img src="{m[2].split("/")[-1]}" alt="{m[1]}">', text)
    text = re.sub(r"\[([^\]]*)\]\(([^)]*)\)", link, text)
    text = re.sub(r"`([^`]*)`", r"<code>\1</code>", text)
    text = re.sub(r"\*\*([^*]*)\*\*", r"<b>\1</b>", text)
    return re.sub(r"(?<![\w*])\*([^*\s][^*]*)\*", r"<i>\1</i>", text)


def table(lines):
    rows = [[inline(cell.strip()) for cell in line.strip("|").split("|")] for line in lines if not re.fullmatch(r"[|\- ]+", line)]
    cells = lambda row, tag: "".join(f"<{tag}>{cell}</{tag}>" for cell in row)  # noqa: E731
    body = "\n".join(f"<tr>{cells(row, 'th' if k == 0 else 'td')}</tr>" for k, row in enumerate(rows))
    return f'<table border="1" cellpadding="4" cellspacing="0">\n{body}\n</table>'


def block(text):
    lines = text.splitlines()
    heading = re.match(r"(#+) (.*)", text)
    if heading:
        return f"<h{len(heading[1])}>{inline(heading[2])}</h{len(heading[1])}>"
    if text.startswith("```"):
        return "<pre>" + html.escape("\n".join(lines[1:-1]), quote=False) + "</pre>"
    if text.startswith("|"):
        return table(lines)
    if text.startswith("- "):
        items = re.split(r"\n?^- ", text, flags=re.MULTILINE)[1:]
        return "<ul>\n" + "\n".join(f"<li>{inline(' '.join(item.split()))}</li>" for item in items) + "\n</ul>"
    return f"<p>{inline(text)}</p>"


def page(name):
    text = (HERE / f"{name}.md").read_text(encoding="utf-8")
    blocks = [block(part) for part in re.split(r"\n\s*\n", text.strip())]
    title = text.splitlines()[0].lstrip("# ")
    if name in PROPERTIES.values():
        title += ": what it is for"  # ParaView's page of properties has the other name
    return ('<!DOCTYPE html>\n<html>\n<head><meta charset="utf-8"><title>' + f"{html.escape(title)}</title></head>\n<body>\n"
            + "\n".join(blocks) + "\n</body>\n</html>\n")


def main():
    faults = []
    for name in PAGES:
        path, text = HELP / f"{name}.html", page(name)
        if "--check" not in sys.argv[1:]:
            path.write_text(text, encoding="utf-8")
        elif not path.exists() or path.read_text(encoding="utf-8") != text:
            faults.append(f"FAILED: Help/{path.name} is not what {name}.md says now: python3 {pathlib.Path(__file__).name}")
    print("\n".join(faults), end="\n" if faults else "")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
