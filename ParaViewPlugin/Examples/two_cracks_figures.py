# SPDX-License-Identifier: BSD-3-Clause
"""The figures of two_cracks.py, numbered as in the paper, and the convergence of the stress intensity factors."""
import os

import matplotlib

matplotlib.use("Agg")
import numpy as np  # noqa: E402
from matplotlib import pyplot  # noqa: E402
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402

from adapt_function import arrays_of  # noqa: E402

INK = "#1f2937"
LEVELS = np.concatenate([np.arange(0.2, 2, 0.2), np.arange(2, 6.1, 0.5)])  # of the stress over the tension


def draw(meshes, solved, cracks, width, tips, errors, folder):
    """meshes: first, uniform, adapted ...; solved: on the last one; errors[step, tip, method]: K_I over the reference."""
    pictures = {"figure_5": domain(cracks, width), "figure_6": three_meshes([meshes[0], meshes[1], meshes[-1]], width),
                "figure_7": details(meshes[-1], tips), "figure_8": von_mises(solved, cracks),
                "overview": overview(meshes, solved, cracks, width, tips), "convergence": convergence(errors)}
    for name, figure in pictures.items():
        figure.savefig(os.path.join(folder, f"two_cracks_{name}.png"), dpi=120)
        pyplot.close(figure)


def plain(panel, title=""):
    panel.set(aspect="equal", xticks=[], yticks=[], title=title)
    for side in panel.spines.values():
        side.set_visible(False)


def domain(cracks, width):
    figure, panel = pyplot.subplots(figsize=(5, 5.6), layout="constrained")
    plain(panel)
    panel.add_patch(pyplot.Rectangle((-width, -width), 2 * width, 2 * width, facecolor="0.95", edgecolor=INK))
    for crack in cracks.positions(np.array([-1.0, 1.0])):
        panel.plot(crack.real, crack.imag, color="#c0392b", linewidth=2.5)
    for x in np.linspace(-width, width, 9):
        for sign in (-1, 1):
            panel.annotate("", (x, 1.2 * sign * width), (x, 1.02 * sign * width), arrowprops={"arrowstyle": "->", "color": INK})
    centre = cracks.centre[:, 0].real
    panel.annotate(f"{np.degrees(cracks.angle[1, 0]):g}°", (centre[1] + 1.15, 0.15), color=INK)
    panel.plot([centre[1] - 1, centre[1] + 1.1], [0, 0], color=INK, linewidth=0.6, linestyle="--")
    panel.annotate("2a", (centre[0], 0.15), ha="center", color=INK)
    panel.set(xlim=(-1.05 * width, 1.05 * width), ylim=(-1.25 * width, 1.25 * width))
    return figure


def whole(panel, mesh, width, letter):
    points, triangles = arrays_of(mesh)
    plain(panel, f"{letter}{len(points)} nodes, {len(triangles)} elements")
    panel.triplot(*points.T, triangles, color=INK, linewidth=0.9 if len(triangles) < 100 else 0.2)
    panel.set(xlim=(-1.01 * width, 1.01 * width), ylim=(-1.01 * width, 1.01 * width))


def three_meshes(meshes, width):
    figure, panels = pyplot.subplots(1, 3, figsize=(15, 5.3), layout="constrained")
    for panel, mesh, letter in zip(panels, meshes, "abc"):
        whole(panel, mesh, width, f"({letter}) ")
    return figure


def part(panel, mesh, tips, centre, half, title):
    points, triangles = arrays_of(mesh)
    shown = (np.abs(points - centre).max(axis=1) < 2 * half)[triangles].any(axis=1)
    plain(panel, title)
    panel.triplot(*points.T, triangles[shown], color=INK, linewidth=0.4)
    for crack in zip(tips[::2], tips[1::2]):
        panel.plot(*np.transpose([tip.position for tip in crack]), color="#c0392b", linewidth=1.2)
    panel.set(xlim=(centre[0] - half, centre[0] + half), ylim=(centre[1] - half, centre[1] + half))


def overview(meshes, solved, cracks, width, tips):
    """First mesh, last mesh, the inner tips in it, the stress there: one row."""
    figure, panels = pyplot.subplots(1, 4, figsize=(16, 4.2), layout="constrained")
    whole(panels[0], meshes[0], width, "")
    whole(panels[1], meshes[-1], width, "")
    middle = np.mean([tips[1].position, tips[2].position], axis=0)
    part(panels[2], meshes[-1], tips, middle, 0.3, "the inner tips, 0.6 a across")
    drawn = isolines(panels[3], solved, cracks, middle, 0.3)
    panels[3].set_title("von Mises stress there, over the tension")
    figure.colorbar(drawn, ax=panels[3], shrink=0.7)
    return figure


def details(mesh, tips):
    """All cracks, the gap between them, and each tip. The colour of a crack is that of its faces: edges with one triangle."""
    points, triangles = arrays_of(mesh)
    middle = np.mean([tips[1].position, tips[2].position], axis=0)
    views = [((0, 0), 2.3, "the cracks"), (middle, 0.35, "the inner tips")]
    views += [(tips[i].position, 0.02, f"{name} tip") for i, name in enumerate(("left outer", "left inner", "right inner", "right outer"))]
    figure, panels = pyplot.subplots(2, 3, figsize=(14, 9.6), layout="constrained")
    for panel, (centre, half, title) in zip(panels.flat, views):
        part(panel, mesh, tips, centre, half, f"{title}, {2 * half:g} a across")
    return figure


def von_mises(solved, cracks):
    figure, panels = pyplot.subplots(1, 2, figsize=(14, 7), layout="constrained")
    for panel, (centre, half) in zip(panels, (((0, 0), 2.6), ((0, -0.09), 0.4))):
        drawn = isolines(panel, solved, cracks, centre, half)
        panel.set_title(f"von Mises stress over the tension, {2 * half:g} a across")
    figure.colorbar(drawn, ax=panels, shrink=0.8)
    return figure


def isolines(panel, solved, cracks, centre, half):
    points = vtk_to_numpy(solved.GetPoints().GetData())
    triangles = vtk_to_numpy(solved.GetCells().GetConnectivityArray())
    count = sum(solved.GetCellType(i) == 5 for i in range(solved.GetNumberOfCells()))
    triangles = triangles[:3 * count].reshape(-1, 3)
    stress = vtk_to_numpy(solved.GetPointData().GetArray("VonMises"))
    plain(panel)
    drawn = panel.tricontour(*points[:, :2].T, triangles, stress, levels=LEVELS, cmap="viridis", linewidths=0.9)
    for crack in cracks.positions(np.array([-1.0, 1.0])):
        panel.plot(crack.real, crack.imag, color="#c0392b", linewidth=1.5)
    panel.set(xlim=(centre[0] - half, centre[0] + half), ylim=(centre[1] - half, centre[1] + half))
    return drawn


def convergence(errors):
    figure, panel = pyplot.subplots(figsize=(6.4, 4.4), layout="constrained")
    for tip, (name, color) in enumerate(zip(("left outer", "left inner", "right inner", "right outer"),
                                            ("#1f618d", "#c0392b", "#e59866", "#239b56"))):
        for method, style in enumerate(("-o", "--s")):
            panel.plot(errors[:, tip, method], style, color=color, markersize=4,
                       label=name + (", opening" if method else ", integral"))
    panel.axhspan(0.97, 1.03, color="0.93")
    panel.set(xticks=range(len(errors)), xlabel="adaptive step", ylabel="K_I over the reference", ylim=(0.7, 1.15))
    panel.legend(fontsize="x-small", ncols=2)
    panel.grid(True, color="0.9")
    return figure
