# SPDX-License-Identifier: BSD-3-Clause
"""The drawings of Filters/ARCHITECTURE.md and Filters/RANKS.md, as SVG. Needs Python alone.

    python3 Filters/Drawings/draw.py            draws them beside this script
    python3 Filters/Drawings/draw.py --check    exit status 1 if a drawing is not what this script draws (a test)

What can be read from the code is read from it: the local numbering from Core/Mesh/Types.h, the order of the operations from
Core/Run/Improver.h, the rooms from Testing/Core/rooms.py.
"""
import importlib.util
import math
import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
CORE = HERE.parent / "Core"

INK, SOFT, PALE = "#1d2733", "#6b7a89", "#f2f5f8"
BAD, BAD_LINE = "#f6b9ae", "#b5301c"
NEW, NEW_LINE = "#cfe9d0", "#23752b"
BLUE, BLUE_LINE = "#d5e4f5", "#1c4f8a"
CHUNKS = ["#cfe0f4", "#d6ecd2", "#fbe3c4", "#e5d9f0"]
HELD = "#9aa4ae"


class Svg:
    def __init__(self, width, height):
        self.size = width, height
        self.items = []

    def add(self, text):
        self.items.append(text)

    def polygon(self, points, fill=PALE, stroke=SOFT, width=1.2):
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        self.add(f'<polygon points="{path}" fill="{fill}" stroke="{stroke}" stroke-width="{width}" stroke-linejoin="round"/>')

    def line(self, a, b, stroke=SOFT, width=1.2, dash="", arrow=False):
        extra = f' stroke-dasharray="{dash}"' if dash else ""
        extra += ' marker-end="url(#arrow)"' if arrow else ""
        self.add(f'<line x1="{a[0]:.1f}" y1="{a[1]:.1f}" x2="{b[0]:.1f}" y2="{b[1]:.1f}" stroke="{stroke}" '
                 f'stroke-width="{width}" stroke-linecap="round"{extra}/>')

    def dot(self, p, fill=INK, radius=4.0, stroke="white"):
        self.add(f'<circle cx="{p[0]:.1f}" cy="{p[1]:.1f}" r="{radius}" fill="{fill}" stroke="{stroke}" stroke-width="1"/>')

    def text(self, p, words, size=13, anchor="middle", color=INK, bold=False, mono=False):
        words = words.replace("&", "&amp;").replace("<", "&lt;")
        family = "DejaVu Sans Mono, monospace" if mono else "DejaVu Sans, Helvetica, Arial, sans-serif"
        weight = ' font-weight="bold"' if bold else ""
        self.add(f'<text x="{p[0]:.1f}" y="{p[1]:.1f}" font-family="{family}" font-size="{size}" fill="{color}" '
                 f'text-anchor="{anchor}"{weight}>{words}</text>')

    def box(self, x, y, w, h, words, fill=BLUE, stroke=BLUE_LINE, size=13, bold_first=True):
        self.add(f'<rect x="{x:.1f}" y="{y:.1f}" width="{w:.1f}" height="{h:.1f}" rx="6" fill="{fill}" stroke="{stroke}" '
                 'stroke-width="1.3"/>')
        step = size + 4
        top = y + h / 2 - step * (len(words) - 1) / 2 + size * 0.36
        for k, line in enumerate(words):
            self.text((x + w / 2, top + k * step), line, size if k == 0 else size - 1.5, bold=bold_first and k == 0)

    def __str__(self):
        w, h = self.size
        marker = ('<defs><marker id="arrow" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="7" markerHeight="7" '
                  f'orient="auto-start-reverse"><path d="M0,0 L10,5 L0,10 z" fill="{SOFT}"/></marker></defs>')
        head = f'<svg xmlns="http://www.w3.org/2000/svg" width="{w}" height="{h}" viewBox="0 0 {w} {h}">'
        return "\n".join([head, marker, f'<rect width="{w}" height="{h}" fill="white"/>', *self.items, "</svg>", ""])


# ---- geometry ------------------------------------------------------------------------------------
def middle(*points):
    return sum(p[0] for p in points) / len(points), sum(p[1] for p in points) / len(points)


def towards(a, b, part):
    return a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])


def around(centre, radius, degrees):
    angle = math.radians(degrees)
    return centre[0] + radius * math.cos(angle), centre[1] - radius * math.sin(angle)


def chance(k):
    """The same numbers in [0, 1[ on all machines."""
    return (k * 2654435761 % 2**32 ^ (k * 40503 % 2**16) << 7) * 2246822519 % 2**32 / 2**32


# ---- what the code says --------------------------------------------------------------------------
def local_numbering(dimension):
    """facets and edges of Local<D>."""
    text = (CORE / "Mesh" / "Types.h").read_text()
    text = text[text.index(f"struct Local<{dimension}>"):]
    tables = []
    for name in ("facets", "edges"):
        body = re.search(rf" {name}\[\d\]\[\d\] = (.*?);", text, re.DOTALL).group(1)
        tables.append([[int(n) for n in re.findall(r"\d", row)] for row in re.findall(r"\{([\d, ]+)\}", body)])
    return tables


def operations():
    """Names and levels, in the order in which they are tried."""
    text = (CORE / "Run" / "Improver.h").read_text()
    names = re.findall(r"(\w+)<D, Shape>", re.search(r"using OperationList = std::tuple<(.*?)>;", text, re.DOTALL).group(1) + ">")
    levels = []
    for name in names:
        levels.append(re.search(r"int level = Level::(\w+);", (CORE / "Operations" / f"{name}.h").read_text()).group(1))
    return list(zip(names, levels))


def rooms():
    path = HERE.parents[1] / "Testing" / "Core" / "rooms.py"
    spec = importlib.util.spec_from_file_location("rooms", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.ROOMS, module.MODULES, module.PRIVATE


# ---- numbering -----------------------------------------------------------------------------------
def draw_numbering():
    s = Svg(900, 330)
    facets, edges = local_numbering(2)
    corner = [(60, 240), (300, 240), (180, 60)]
    s.text((180, 26), "Triangle", 15, bold=True)
    s.polygon(corner)
    for i, nodes in enumerate(facets):
        a, b = (corner[n] for n in nodes)
        place = towards(middle(*corner), middle(a, b), 1.3)
        anchor = "start" if place[0] > 190 else "end" if place[0] < 170 else "middle"
        s.text((place[0], place[1] + 5), f"facet {i}", 13, anchor, color=BLUE_LINE)
    for i, p in enumerate(corner):
        s.dot(p)
        out = towards(middle(*corner), p, 1.16)
        s.text((out[0], out[1] + 5), str(i), 16, bold=True)
    s.text((180, 300), "facet i lies opposite to node i", 12, color=SOFT)

    facets, edges = local_numbering(3)
    corner = [(390, 225), (560, 262), (610, 180), (500, 62)]
    s.text((500, 26), "Tetrahedron", 15, bold=True)
    hidden = {0, 2}
    s.polygon([corner[0], corner[1], corner[3]])
    s.polygon([corner[1], corner[2], corner[3]], fill="#e6ecf2")
    for e, (a, b) in enumerate(edges):
        back = {a, b} == hidden
        s.line(corner[a], corner[b], SOFT, 1.2, "5,4" if back else "")
        m = towards(corner[a], corner[b], 0.5)
        s.add(f'<circle cx="{m[0]:.1f}" cy="{m[1]:.1f}" r="9" fill="white" stroke="{SOFT}" stroke-width="0.8"/>')
        s.text((m[0], m[1] + 4), str(e), 12, color=SOFT)
    for i, p in enumerate(corner):
        s.dot(p)
        out = towards(middle(*corner), p, 1.17)
        s.text((out[0], out[1] + 5), str(i), 16, bold=True)
    s.text((500, 300), "edges in circles; x1 - x0, x2 - x0, x3 - x0 are right-handed", 12, color=SOFT)

    s.text((780, 60), "nodes of facet i", 13, bold=True)
    for i, nodes in enumerate(facets):
        s.text((780, 92 + 26 * i), f"{i}: " + " ".join(map(str, nodes)), 14, mono=True, color=BLUE_LINE)
    for k, line in enumerate(("(facet nodes, node i) is an even", "permutation: a point on the same",
                              "side as node i makes a simplex", "of positive volume with them.")):
        s.text((780, 216 + 19 * k), line, 12, color=SOFT)
    return s


# ---- star, link, ring ----------------------------------------------------------------------------
def draw_star():
    s = Svg(900, 370)
    # star of a free node
    c = (150, 200)
    spread = [12, 66, 118, 182, 236, 300]
    rim = [around(c, r, a) for a, r in zip(spread, [105, 112, 108, 100, 112, 106])]
    s.text((150, 28), "Star and link of a node", 15, bold=True)
    for k, p in enumerate(rim):
        s.polygon([c, p, rim[(k + 1) % len(rim)]], fill=BLUE)
    for k, p in enumerate(rim):
        s.line(p, rim[(k + 1) % len(rim)], BLUE_LINE, 3.5)
    for p in rim:
        s.dot(p)
    s.dot(c, BAD_LINE, 5.5)
    s.text((c[0] + 2, c[1] + 26), "v", 15, bold=True)
    s.text((150, 342), "star: the cells of v", 12, color=SOFT)
    s.text((150, 359), "link, blue: the facets opposite to v", 12, color=SOFT)

    # ring of an edge, seen along it
    c = (450, 200)
    rim = [around(c, 108, a) for a in (20, 92, 164, 236, 308)]
    s.text((450, 28), "Ring of an edge", 15, bold=True)
    for k, p in enumerate(rim):
        s.polygon([c, p, rim[(k + 1) % 5]], fill=NEW)
        s.text(middle(c, p, rim[(k + 1) % 5]), f"cell {k}", 12, color=NEW_LINE)
    for p in rim:
        s.dot(p)
    s.dot(c, BAD_LINE, 6.5)
    s.text((c[0], c[1] + 26), "a b", 13, bold=True)
    s.text((450, 342), "seen along the edge a b: edge removal fills the", 12, color=SOFT)
    s.text((450, 359), "ring without it. Closed: no kept facet in it", 12, color=SOFT)

    # an open ring at the surface
    c = (750, 215)
    rim = [around(c, 112, a) for a in (0, 48, 98, 140, 180)]
    s.text((750, 28), "Ring at a kept facet", 15, bold=True)
    for k in range(4):
        s.polygon([c, rim[k], rim[k + 1]], fill=PALE)
        s.text(middle(c, rim[k], rim[k + 1]), f"cell {k}", 12, color=SOFT)
    for p in (rim[0], rim[-1]):
        s.line(c, p, INK, 5)
    for p in rim:
        s.dot(p)
    s.dot(c, INK, 6.5)
    s.text((c[0], c[1] + 28), "edge a b on the surface", 12, bold=True)
    s.text((c[0], c[1] + 48), "thick: kept facets", 12, color=SOFT)
    s.text((750, 342), "open: it ends at kept facets. Such an edge", 12, color=SOFT)
    s.text((750, 359), "stays, unless the surface takes part", 12, color=SOFT)
    return s


# ---- cavity --------------------------------------------------------------------------------------
def draw_cavity():
    s = Svg(900, 350)
    nodes = {"a": (40, 250), "b": (110, 110), "c": (245, 60), "d": (370, 130), "e": (390, 260), "f": (230, 300),
             "g": (180, 190), "h": (292, 196)}
    outline = ["a", "b", "c", "d", "e", "f"]
    old = ["abg", "bcg", "cgh", "cdh", "deh", "ehf", "fhg", "agf"]
    bad, cavity = "cgh", ["bcg", "cgh", "cdh", "ehf", "fhg", "deh"]

    def at(name, shift):
        return nodes[name][0] + shift, nodes[name][1]

    s.text((215, 28), "Before: the cavity of a bad cell", 15, bold=True)
    for cell in old:
        fill = BAD if cell == bad else BLUE if cell in cavity else PALE
        s.polygon([at(n, 0) for n in cell], fill=fill)
    s.text((230, 150), "bad", 13, bold=True, color=BAD_LINE)
    s.text((665, 28), "After: its boundary joined to a node", 15, bold=True)
    for cell in old:
        if cell not in cavity:
            s.polygon([at(n, 450) for n in cell])
    new = (707, 178)
    boundary = ["bc", "cd", "de", "ef", "fg", "gb"]
    for a, b in boundary:
        s.polygon([new, at(a, 450), at(b, 450)], fill=NEW, stroke=NEW_LINE)
    for shift in (0, 450):
        for a, b in boundary:
            s.line(at(a, shift), at(b, shift), BLUE_LINE, 3.5)
        for k, a in enumerate(outline):
            s.line(at(a, shift), at(outline[(k + 1) % 6], shift), INK, 4.5)
        for name in nodes:
            if not (shift and name == "h"):
                s.dot(at(name, shift))
    s.dot(new, NEW_LINE, 6)
    s.text((new[0] + 14, new[1] - 10), "p", 15, bold=True)
    s.line((408, 180), (462, 180), SOFT, 2, arrow=True)
    s.text((215, 338), "blue line: boundary of the cavity.  thick: kept facets", 12, color=SOFT)
    s.text((665, 338), "a free node has gone; the boundary of the cavity is as it was", 12, color=SOFT)
    return s


# ---- chunks --------------------------------------------------------------------------------------
def grid_of_triangles(nx, ny, width, height):
    points, cells = [], []
    for j in range(ny + 1):
        for i in range(nx + 1):
            k = j * (nx + 1) + i
            inside = 0 < i < nx and 0 < j < ny
            dx, dy = ((chance(2 * k + 1) - 0.5) * 0.6, (chance(2 * k + 2) - 0.5) * 0.6) if inside else (0, 0)
            points.append(((i + dx) * width / nx, (j + dy) * height / ny))
    for j in range(ny):
        for i in range(nx):
            a = j * (nx + 1) + i
            b, c, d = a + 1, a + nx + 1, a + nx + 2
            cells += [(a, b, d), (a, d, c)] if (i + j) % 2 else [(a, b, c), (b, d, c)]
    return points, cells


def owners(points, n, shift):
    """Chunks::assign(): bisection at the median along the longest extent, borders moved by `shift` of a chunk."""
    owner = [0] * len(points)

    def split(ids, first, count):
        if count == 1:
            for p in ids:
                owner[p] = first
            return
        extent = [max(points[p][i] for p in ids) - min(points[p][i] for p in ids) for i in range(2)]
        axis = 1 if extent[1] > extent[0] else 0
        left = count // 2
        ids = sorted(ids, key=lambda p: (points[p][axis], p))
        border = int(len(ids) * (left + shift) / count)
        split(ids[:border], first, left)
        split(ids[border:], first + left, count - left)

    split(list(range(len(points))), 0, n)
    return owner


def draw_chunks():
    s = Svg(900, 340)
    points, cells = grid_of_triangles(14, 9, 390, 240)
    for x0, shift, title in ((30, 0.0, "One pass: four chunks"), (480, 0.3, "Next pass: borders moved by 0.3 of a chunk")):
        owner = owners(points, 4, shift)
        s.text((x0 + 195, 28), title, 15, bold=True)
        for cell in cells:
            mine = {owner[p] for p in cell}
            fill = CHUNKS[mine.pop()] if len(mine) == 1 else HELD
            s.polygon([(points[p][0] + x0, points[p][1] + 45) for p in cell], fill=fill, stroke="white", width=1)
    s.text((450, 312), "A point has an owner. A cell belongs to a chunk if all its points do; grey cells, across a border, wait for the next pass.",
           12, color=SOFT)
    s.text((450, 330), "Chunks see only themselves and are worked on in sequence: the result is the same for any number of threads.",
           12, color=SOFT)
    return s


# ---- many ranks ------------------------------------------------------------------------------------
def draw_band():
    s = Svg(900, 350)
    points, cells = grid_of_triangles(14, 9, 390, 240)
    side = [sum(points[p][0] for p in cell) > 3 * 195 for cell in cells]
    here = [{p for cell, right in zip(cells, side) if right == half for p in cell} for half in (False, True)]
    border = here[0] & here[1]
    band = set(border)  # two layers of cells: those with a point of the border, and those that share points with these
    band |= {p for cell in cells if border & set(cell) for p in cell}
    for x0, title, in ((30, "Round 0: each rank its piece"), (480, "Round 1: the band goes to rank 0")):
        s.text((x0 + 195, 28), title, 15, bold=True)
        for cell, right in zip(cells, side):
            moved = x0 > 30 and band & set(cell)
            fill = NEW if moved else CHUNKS[2 if right else 0]
            s.polygon([(points[p][0] + x0, points[p][1] + 45) for p in cell], fill=fill, stroke="white", width=1)
        kept = border if x0 == 30 else {
            p for cell in cells if band & set(cell) for p in cell} & {p for cell in cells if not band & set(cell) for p in cell}
        for p in sorted(kept):
            s.dot((points[p][0] + x0, points[p][1] + 45), fill=BAD_LINE, radius=3.5)
    s.text((450, 312), "Blue: rank 0. Sand: rank 1. Red nodes are on the border of what a rank optimizes: they are kept.", 12, color=SOFT)
    s.text((450, 332), "The green cells move to one rank and are optimized there: the old border lies inside them, and its nodes are free.",
           12, color=SOFT)
    return s


# ---- the life of a run ---------------------------------------------------------------------------
def draw_run():
    s = Svg(900, 622)
    draw_stages(s)
    draw_pass(s, 227)
    draw_change(s, 362)
    s.text((450, 605), "Only the judge accepts a change, and only the editor makes it.", 12, color=SOFT)
    return s


def draw_stages(s):
    s.text((20, 28), "The stages of a run", 15, "start", bold=True)
    stages = [("import", "grid to SimplexMesh"), ("untangle", "if cells are inverted"), ("sizes", "if lengths are wanted"),
              ("worst first", "up to the target"), ("polish", "the worst few cells"), ("export", "SimplexMesh to grid")]
    w, gap, middle_of = 130, 18, {}
    for k, (name, what) in enumerate(stages):
        x = 20 + k * (w + gap)
        middle_of[name] = x + w / 2
        outside = name in ("import", "export")
        s.box(x, 45, w, 54, [name, what], fill=PALE if outside else BLUE, stroke=SOFT if outside else BLUE_LINE, size=13)
        if k:
            s.line((x - gap + 1, 72), (x - 1, 72), SOFT, 1.8, arrow=True)
    left, right = middle_of["worst first"] - w / 2, middle_of["polish"] + w / 2
    s.box(left, 124, right - left, 66, ["long edges divided", "if the surface takes part, up to the target,",
                                          "as long as the worst quality rises"])
    s.line((middle_of["polish"], 100), (middle_of["polish"], 122), SOFT, 1.8, arrow=True)
    s.line((middle_of["worst first"], 124), (middle_of["worst first"], 101), SOFT, 1.8, arrow=True)
    for k, line in enumerate(("grey: Filters/Bridge and Filters/MeshOptimize", "blue: Filters/Core",
                              "Paper 1996 runs its own stages instead of the blue ones.")):
        s.text((20, 138 + 20 * k), line, 12, "start", color=SOFT)


def draw_pass(s, y):
    s.text((20, y), "One pass", 15, "start", bold=True)
    s.box(20, y + 17, 190, 66, ["collect", "cells under the target", "that no cap holds"], size=13)
    s.box(250, y + 17, 190, 66, ["chunked pass", "cells shared out,", "a queue for each chunk"], size=13)
    s.box(480, y + 17, 190, 66, ["improver", "the worst cell of the queue:", "operations, one by one"], size=13)
    for x in (212, 442):
        s.line((x, y + 50), (x + 36, y + 50), SOFT, 1.8, arrow=True)
    s.line((575, y + 17), (575, y + 3), SOFT, 1.8)
    s.line((575, y + 3), (345, y + 3), SOFT, 1.8)
    s.line((345, y + 3), (345, y + 15), SOFT, 1.8, arrow=True)
    s.text((460, y - 5), "changed cells come back to the queue", 12, color=SOFT)

    s.text((692, y), "in the order tried", 12, "start", bold=True)
    s.text((888, y), "least level", 11, "end", color=SOFT)
    for k, (name, level) in enumerate(operations()):
        s.text((692, y + 25 + 21 * k), name, 12.5, "start")
        s.text((888, y + 25 + 21 * k), level, 11, "end", color=SOFT)


def draw_change(s, y):
    s.text((20, y), "One change", 15, "start", bold=True)
    s.box(20, y + 20, 190, 66, ["operation", "looks for a better", "filling or place"], fill=NEW, stroke=NEW_LINE)
    s.box(250, y + 20, 190, 66, ["proposal", "cavity, cells or moves,", "worst before and after"], fill=NEW, stroke=NEW_LINE)
    s.box(480, y + 20, 190, 66, ["judge", "quality, topology, surface,", "growth, guard"], fill=NEW, stroke=NEW_LINE)
    for x in (212, 442):
        s.line((x, y + 53), (x + 36, y + 53), SOFT, 1.8, arrow=True)
    s.box(480, y + 140, 190, 66, ["editor", "replaces or moves,", "writes the journal"], fill=NEW, stroke=NEW_LINE)
    s.line((575, y + 88), (575, y + 138), SOFT, 1.8, arrow=True)
    s.text((585, y + 118), "accepted", 12, "start", color=NEW_LINE)
    s.line((480, y + 75), (458, y + 75), SOFT, 1.8)
    s.line((458, y + 75), (458, y + 173), SOFT, 1.8)
    s.line((458, y + 173), (212, y + 173), SOFT, 1.8, arrow=True)
    s.text((335, y + 164), "refused: the mesh is as it was", 12, color=BAD_LINE)
    s.box(20, y + 140, 190, 66, ["next operation", "or the cell is stamped:", "failed at this time"], fill=PALE, stroke=SOFT)
    s.line((672, y + 173), (716, y + 173), SOFT, 1.8, arrow=True)
    s.box(718, y + 140, 165, 66, ["mesh", "cells, places, metric:", "undone bit for bit"], fill=PALE, stroke=SOFT)


# ---- rooms ---------------------------------------------------------------------------------------
STEP, HEIGHT = 54, 40
MODULE_WORDS = {"ParaViewPlugin": "XML, icons, help", "MeshOptimize": "see on the right", "Thermoelastic": "its filter",
                "TetGen": "AGPL, optional", "Bridge": "between grid and core"}
CORE_WORDS = {"Optimize": "optimize()", "Thermoelastic": "analyse()", "WorstFirst": "fast engine", "Sizes": "wanted lengths",
              "Paper1996": "the paper's", "Run": "options, report, chunked pass", "Operations": "a file each; they only propose",
              "Edit": "proposal, judge", "Reposition": "where to put nodes", "Surface": "curves, patches", "Bound": "caps, bounds",
              "Quality": "the measures", "Metric": "tensors, sizes", "Mesh": "SimplexMesh, MeshEditor", "Base": "control, clock"}
PRIVATE_WORDS = {"the filters": "classes, properties, requests of VTK", "Tasks": "all grids of the input; warnings",
                 "Rounds": "one mesh on many ranks", "OneGrid": "one grid through the optimizer",
                 "Boundary": "what a boundary slides along, what rides on it", "Grid": "grid to core, back",
                 "QualityMinMax": "work of this filter", "SolutionMetric": "work of this filter",
                 "Request": "what is asked for", "Ranks": "a mesh divided among them"}


def draw_ladder(s, x, y, width, rows):
    """Rows of rooms, each a list of names, a table of words, a fill and a stroke. Returns the lower end."""
    for k, (names, words, fill, stroke) in enumerate(rows):
        w = width / len(names)
        for i, name in enumerate(names):
            s.box(x + i * w + 4, y + k * STEP, w - 8, HEIGHT, [name, *([words[name]] if name in words else [])], fill, stroke, 12)
        if k + 1 < len(rows):
            s.line((x + width / 2, y + k * STEP + HEIGHT + 1), (x + width / 2, y + (k + 1) * STEP - 1), SOFT, 1.6, arrow=True)
    return y + len(rows) * STEP - (STEP - HEIGHT)


def draw_bracket(s, x, y, end, words, stroke):
    s.line((x, y), (x, end), stroke, 2)
    for k, line in enumerate(words):
        s.text((x - 9, (y + end) / 2 + 4 - 10 * (len(words) - 1) + 20 * k), line, 13 if k == 0 else 12, "end", bold=k == 0,
               color=stroke if k == 0 else SOFT)


def draw_rooms():
    levels, modules, private = rooms()
    above = [(["ParaViewPlugin"], MODULE_WORDS, PALE, SOFT)] + [(row, MODULE_WORDS, BLUE, BLUE_LINE) for row in reversed(modules[1:])]
    core = [(row, CORE_WORDS, NEW, NEW_LINE) for row in reversed(levels)]
    inside = [(row, PRIVATE_WORDS, BLUE, BLUE_LINE) for row in reversed(private)]
    top = 74
    s = Svg(900, top + STEP * (len(above) + len(core)) + 22)
    s.text((450, 28), "Who may include whom: what stands below, never what stands above or beside", 15, bold=True)
    s.text((296, 60), "Modules, and rooms of the core", 13, bold=True, color=SOFT)
    draw_bracket(s, 107, top + STEP, top + STEP * len(above) - (STEP - HEIGHT), ["Filters"], BLUE_LINE)
    end = draw_ladder(s, 114, top, 366, above + core)
    draw_bracket(s, 107, top + STEP * len(above), end, ["Filters/Core", "no VTK"], NEW_LINE)

    s.text((704, 60), "Inside Filters/MeshOptimize", 13, bold=True, color=SOFT)
    below = draw_ladder(s, 520, top, 370, inside)
    s.text((705, below + 26), "All but the filters stand in Private.", 12, color=SOFT)
    s.text((705, below + 46), "Each may include Filters/Bridge and Filters/Core.", 12, color=SOFT)
    s.text((297, end + 24), "Testing/Core/rooms.py holds both.", 12, color=SOFT)
    return s


DRAWINGS = {"numbering": draw_numbering, "star": draw_star, "cavity": draw_cavity, "chunks": draw_chunks, "band": draw_band, "run": draw_run,
            "rooms": draw_rooms}


def main():
    stale = []
    for name, draw in DRAWINGS.items():
        path, text = HERE / f"{name}.svg", str(draw())
        if "--check" not in sys.argv[1:]:
            path.write_text(text, encoding="utf-8")
        elif not path.exists() or path.read_text(encoding="utf-8") != text:
            stale.append(path.name)
    for name in stale:
        print(f"FAILED: {name} is not what the code says now: python3 Filters/Drawings/draw.py, and look at it")
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
