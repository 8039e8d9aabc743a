# SPDX-License-Identifier: BSD-3-Clause
"""The plot of peers.py."""
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as pyplot  # noqa: E402
from matplotlib.ticker import FuncFormatter  # noqa: E402

OURS = "#c0392b"
LEGEND = 0.8  # inches under the panels
# One marker per tool; tools of one family share the colour.
STYLES = {
    "Mesh Optimize Quick": ("o", OURS), "Mesh Optimize Default": ("s", OURS), "Mesh Optimize Best": ("D", OURS),
    "Mesh Optimize Paper 1996": ("P", "#e59866"), "TetGen": ("v", "#1f618d"), "TetGen -O10/7 -o/120": ("^", "#1f618d"),
    "Gmsh": ("<", "#239b56"), "Gmsh, threshold .6": (">", "#239b56"), "Netgen in Gmsh": ("d", "#239b56"),
    "HXT in Gmsh, filled anew": ("*", "#7d6608"), "HXT, threshold .6, filled anew": ("X", "#7d6608"),
    "Netgen": ("h", "#6c3483"), "CGAL remeshing": ("p", "#34495e"),
}


def draw(rows, labels, path):
    """Rows of peers.py to a PNG file. A hollow marker: the surface was not kept."""
    meshes = list(dict.fromkeys(row["mesh"] for row in rows))
    across = min(3, len(meshes))
    down = math.ceil(len(meshes) / across)
    height = 3.6 * down + LEGEND
    figure, axes = pyplot.subplots(down, across, figsize=(4.6 * across, height), squeeze=False, layout="constrained")
    figure.get_layout_engine().set(rect=(0, LEGEND / height, 1, 1 - LEGEND / height))
    handles = {}
    for mesh, panel in zip(meshes, axes.flat):
        draw_mesh(panel, [row for row in rows if row["mesh"] == mesh], handles)
    for panel in list(axes.flat)[len(meshes):]:
        panel.set_visible(False)
    for panel in axes[:, 0]:
        panel.set_ylabel("worst quality S")
    shown = [label for label in labels if label in handles]
    figure.legend([handles[label] for label in shown], shown, loc="lower center", ncols=min(across + 1, 4),
                  frameon=False, fontsize="small")
    figure.savefig(path, dpi=130)
    pyplot.close(figure)


def draw_mesh(panel, rows, handles):
    drawn = [row for row in rows if row.get("seconds") and row["status"] == "ok"]
    ours = [row for row in drawn if STYLES[row["label"]][1] == OURS]
    panel.plot([row["seconds"] for row in ours], [row["worst"] for row in ours], color=OURS, linewidth=1, zorder=1)
    for row in drawn:
        marker, color = STYLES[row["label"]]
        hollow = row["surface"] != "yes"
        dots = panel.scatter([row["seconds"]], [max(row["worst"], 0.0)], s=60, marker=marker, edgecolors=color,
                             facecolors="none" if hollow else color, linewidths=1.2, zorder=2, clip_on=False)
        handles.setdefault(row["label"], dots)
    bound = rows[0]["bound"]
    top = max([row["worst"] for row in drawn], default=1.0)
    if bound:
        panel.axhline(bound, color="0.5", linestyle="--", linewidth=1)
        panel.annotate("bound of the surface", (1, bound), xycoords=("axes fraction", "data"), xytext=(-3, 2),
                       textcoords="offset points", ha="right", va="bottom", color="0.4", fontsize="x-small")
        top = max(top, bound)
    panel.set_xscale("log")
    panel.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
    panel.set_ylim(0, 1.12 * top)
    panel.grid(True, color="0.9", linewidth=0.8)
    panel.set_axisbelow(True)
    panel.set_title(f"{rows[0]['mesh']}: {rows[0]['cells']} tetrahedra", fontsize="medium")
    panel.set_xlabel("optimizer, s")
