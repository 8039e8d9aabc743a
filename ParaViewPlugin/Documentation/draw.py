# SPDX-License-Identifier: BSD-3-Clause
"""The drawings of the pages about the filters, as SVG. Needs Python alone.

    python3 ParaViewPlugin/Documentation/draw.py            draws them into Pictures
    python3 ParaViewPlugin/Documentation/draw.py --check    exit status 1 if a drawing is not what this script draws (a test)
"""
import importlib.util
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
spec = importlib.util.spec_from_file_location("drawings", HERE.parents[1] / "Filters/Drawings/draw.py")
drawings = importlib.util.module_from_spec(spec)
spec.loader.exec_module(drawings)
from_house = ("Svg", "INK", "SOFT", "PALE", "BAD", "BAD_LINE", "NEW", "NEW_LINE", "BLUE", "BLUE_LINE")
Svg, INK, SOFT, PALE, BAD, BAD_LINE, NEW, NEW_LINE, BLUE, BLUE_LINE = (getattr(drawings, name) for name in from_house)


def quality(a, b, c):
    """The measure Shape of a triangle: 12 sqrt(3) area / (sum of edges)^2."""
    area = abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2
    return 12 * math.sqrt(3) * area / (math.dist(a, b) + math.dist(b, c) + math.dist(c, a)) ** 2


def colour(value):
    return BAD if value < 0.3 else "#fbe3c4" if value < 0.6 else NEW


def mesh(svg, triangles, shift, place_of_bad=None):
    for triangle in triangles:
        moved = [(x + shift, y) for x, y in triangle]
        value = quality(*triangle)
        svg.polygon(moved, colour(value))
        centre = sum(x for x, _ in moved) / 3, sum(y for _, y in moved) / 3 + 4
        if value < 0.3:
            svg.text(place_of_bad, f"{value:.2f}", 13, color=BAD_LINE, bold=True)
        else:
            svg.text(centre, f"{value:.2f}", 12)


def draw_mesh_optimize():
    svg = Svg(760, 270)
    ring = [(20, 120), (80, 30), (190, 40), (225, 140), (150, 215), (50, 200)]
    fan = lambda p, q=ring: [(q[k], q[(k + 1) % len(q)], p) for k in range(len(q))]  # noqa: E731
    bad, good = (203, 92), (117, 125)
    mesh(svg, fan(bad), 10, (252, 85))
    mesh(svg, fan(good), 265)
    without = [(ring[0], ring[1], ring[5]), (ring[1], ring[4], ring[5]), (ring[1], ring[2], ring[4]), (ring[2], ring[3], ring[4])]
    mesh(svg, without, 520)
    svg.dot((bad[0] + 10, bad[1]))
    svg.dot((good[0] + 265, good[1]), NEW_LINE)
    for x, words in ((130, "the worst element"), (388, "its node has moved"), (643, "or its node was removed")):
        svg.text((x, 245), words, 14)
    return svg


def draw_mesh_quality_min_max():
    svg = Svg(760, 220)
    x = 20
    for width, height in ((110, 95), (110, 60), (110, 34), (110, 17), (110, 5), (110, 0.3)):
        triangle = [(x, 150), (x + width, 150), (x + width / 2, 150 - height)]
        value = quality(*triangle)
        svg.polygon(triangle, colour(value), BAD_LINE if value < 0.3 else SOFT)
        svg.text((x + width / 2, 175), f"{value:.2f}", 14, bold=True, color=BAD_LINE if value < 0.3 else INK)
        x += 122
    svg.text((20, 205), "1: the regular element", 13, "start")
    svg.text((740, 205), "0: flat; below 0: inverted", 13, "end")
    return svg


def ellipse(svg, centre, axes, degrees, fill, stroke):
    points = []
    for k in range(48):
        t = 2 * math.pi * k / 48
        x, y, turn = axes[0] * math.cos(t), axes[1] * math.sin(t), math.radians(degrees)
        points.append((centre[0] + x * math.cos(turn) - y * math.sin(turn), centre[1] + x * math.sin(turn) + y * math.cos(turn)))
    svg.polygon(points, fill, stroke)


def draw_solution_metric():
    svg = Svg(760, 270)
    for k in range(9):  # lines of equal value: close together where the solution bends
        offset = (0, 30, 50, 62, 70, 78, 90, 110, 140)[k]
        svg.line((30 + offset, 215), (150 + offset, 30), BLUE_LINE)
    svg.text((165, 245), "a solution: lines of equal value", 14)
    turn = -57
    for centre, axes in (((330, 160), (26, 24)), ((400, 125), (46, 9)), ((475, 95), (26, 24))):
        ellipse(svg, centre, axes, turn, BLUE, BLUE_LINE)
    svg.text((400, 245), "the wanted lengths", 14)
    c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    def corner(i, j):  # a grid of regular triangles, stretched as the ellipse in the middle
        u, v = 80 * (i + 0.5 * j), 80 * math.sqrt(0.75) * j * 9 / 46
        return 560 + u * c - v * s, 190 + u * s + v * c

    for i in range(2):
        for j in range(5):
            svg.polygon([corner(i - j // 2, j), corner(i + 1 - j // 2, j), corner(i - j // 2, j + 1)], NEW)
            svg.polygon([corner(i + 1 - j // 2, j), corner(i + 1 - j // 2, j + 1), corner(i - j // 2, j + 1)], NEW)
    svg.text((628, 245), "elements that are regular in them", 14)
    return svg


def draw_tetgen():
    svg = Svg(760, 250)
    outer = [(30, 40), (200, 30), (230, 130), (150, 205), (40, 180)]
    inner = [(95, 85), (150, 80), (160, 125), (105, 135)]
    outer, inner = ([(x + 30, y) for x, y in points] for points in (outer, inner))
    for shift in (0, 380):
        moved = [(x + shift, y) for x, y in outer]
        svg.polygon(moved, PALE if not shift else BLUE, INK, 2)
    centre = lambda points: (sum(x for x, _ in points) / len(points), sum(y for _, y in points) / len(points))  # noqa: E731
    for k in range(5):  # between the surfaces
        a, b = outer[k], outer[(k + 1) % 5]
        near = lambda p: min(inner, key=lambda q: math.dist(p, q))  # noqa: E731
        middle = near(((a[0] + b[0]) / 2, (a[1] + b[1]) / 2))
        svg.polygon([(x + 380, y) for x, y in (a, b, middle)], BLUE, SOFT)
        for end in (a, b):
            svg.line((end[0] + 380, end[1]), (near(end)[0] + 380, near(end)[1]))
    svg.polygon(inner, "white", INK, 2)
    svg.polygon([(x + 380, y) for x, y in inner], NEW, INK, 2)
    hub = centre(inner)
    for corner in inner:
        svg.line((corner[0] + 380, corner[1]), (hub[0] + 380, hub[1]))
    svg.dot(hub, NEW_LINE)
    svg.text((hub[0] + 8, hub[1] + 4), "2", 13, "start")
    svg.dot((90, 150), BLUE_LINE)
    svg.text((98, 154), "1", 13, "start")
    svg.line((290, 115), (400, 115), INK, 1.6, arrow=True)
    svg.text((160, 235), "surfaces, and a point in each compartment", 14)
    svg.text((545, 235), "elements, with the number as Region", 14)
    return svg


def draw_thermoelastic():
    svg = Svg(760, 270)
    for shift, words in ((60, "held below, heated above, loaded"), (430, "what it does, and where it is strained")):
        svg.line((shift - 30, 215), (shift + 190, 215), INK, 2)
        for k in range(11):
            svg.line((shift - 30 + 20 * k, 228), (shift - 18 + 20 * k, 215), SOFT)
        svg.text((shift + 80, 255), words, 14)
    for k in range(4):
        svg.polygon([(60, 215 - 40 * k), (220, 215 - 40 * k), (220, 175 - 40 * k), (60, 175 - 40 * k)],
                    (BLUE, PALE, "#fbe3c4", BAD)[k], SOFT)
    for x in (90, 140, 190):
        svg.line((x, 15), (x, 48), INK, 1.6, arrow=True)
    side = lambda k, sign: (510 + sign * (80 + 7 * k * (k + 1) / 2 / 1.6), 215 - 42 * k)  # noqa: E731
    for k in range(4):
        svg.polygon([side(k, -1), side(k, 1), side(k + 1, 1), side(k + 1, -1)], (BAD, "#fbe3c4", PALE, BLUE)[k], SOFT)
    svg.polygon([(430, 215), (590, 215), (590, 55), (430, 55)], "none", SOFT)
    return svg


DRAWINGS = {"mesh_optimize": draw_mesh_optimize, "mesh_quality_min_max": draw_mesh_quality_min_max,
            "solution_metric": draw_solution_metric, "tetgen": draw_tetgen, "thermoelastic": draw_thermoelastic}


def main():
    faults = []
    for name, draw in DRAWINGS.items():
        path, text = HERE / "Pictures" / f"{name}.svg", str(draw())
        if "--check" not in sys.argv[1:]:
            path.parent.mkdir(exist_ok=True)
            path.write_text(text, encoding="utf-8")
        elif not path.exists() or path.read_text(encoding="utf-8") != text:
            faults.append(f"{path.name} is not what draw.py draws")
    for fault in faults:
        print("FAILED:", fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
