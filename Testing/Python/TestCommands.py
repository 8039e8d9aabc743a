# SPDX-License-Identifier: BSD-3-Clause
"""The commands mesh-optimize and mesh-quality, as a shell runs them.

    python3 TestCommands.py FOLDER    the folder with the commands; without: python3 -m meshoptimize
"""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

import meshoptimize
import numpy as np
from each_test import run_each

PELLET = pathlib.Path(os.environ["MESHOPTIMIZE_DATA"]) / "crack40.vtu"
FOLDER = sys.argv[1] if len(sys.argv) > 1 else None


def command(name):
    return [f"{FOLDER}/mesh-{name}"] if FOLDER else [sys.executable, "-m", "meshoptimize", name]


def run(name, *arguments, status=0, environment=None):
    """What the command prints. The commands find their package themselves."""
    variables = {key: value for key, value in os.environ.items() if not (FOLDER and key == "PYTHONPATH")}
    result = subprocess.run([*command(name), *map(str, arguments)], capture_output=True, text=True, env={
        **variables, **(environment or {})})
    assert result.returncode == status, (arguments, result)
    assert "Traceback" not in result.stderr, result.stderr
    return result


def test_one_file(folder):
    out = folder / "out.vtu"
    result = run("optimize", PELLET, out, "--target-quality", ".3", "--effort", "quick", "--no-insert-nodes")
    assert "worst quality 0.0039 -> " in result.stdout and "100 %" in result.stderr and "\r" not in result.stderr
    assert meshoptimize.quality(meshoptimize.read(out)).minimum > 0.25
    written = out.read_bytes()
    result = run("optimize", PELLET, out, "--target-quality", ".1", status=2)
    assert "--force" in result.stderr and out.read_bytes() == written
    result = run("optimize", PELLET, out, "--target-quality", ".1", "--force", "--quiet")
    assert (result.stdout, result.stderr) == ("", "") and out.read_bytes() != written
    run("optimize", out, out, "--force", "--quiet")  # in its own place
    assert [path.name for path in folder.iterdir()] == ["out.vtu"]


def test_several_files(folder):
    copy = shutil.copy(PELLET, folder / "copy.vtu")
    (folder / "bad.vtu").write_text("nothing of the kind\n")
    result = run("optimize", copy, folder / "bad.vtu", PELLET, folder / "results", "--target-quality", ".1", status=1)
    assert "bad.vtu" in result.stderr and result.stdout.count("worst quality") == 2  # it goes on after a failure
    assert sorted(path.name for path in (folder / "results").iterdir()) == ["copy.vtu", "crack40.vtu"]
    assert "same name" in run("optimize", copy, copy, folder / "results", "--force", status=2).stderr
    assert "folder" in run("optimize", copy, PELLET, folder / "results.vtu", status=2).stderr
    assert "one input" in run("optimize", copy, PELLET, folder / "r", "--picture", "p.png", status=2).stderr
    run("optimize", PELLET, folder / "results", "--force", "--quiet", "--target-quality", ".1")  # the folder is there


def test_wrong_use(folder):
    out = folder / "out.vtu"
    for arguments, word in (((PELLET, out, "--effort", "much"), "quick"),
                            ((PELLET, out, "--target-quality", "2"), "0 to 1"),
                            ((PELLET, out, "--nothing", "2"), "--nothing"), ((PELLET,), "OUT"),
                            ((PELLET, out, "--target-qualty", ".3"), "'--target-quality'"),
                            ((PELLET, out, "--picture", "picture.jpg"), ".png"),
                            ((PELLET, out, "--picture", folder / "no" / "picture.png"), "no"),
                            ((folder / "in.stl", out), "filled"), ((PELLET, folder / "out.stl"), "the format .stl"),
                            ((PELLET, folder / "out.xyz"), ".msh"), ((folder / "in.xyz", out), ".msh"),
                            ((PELLET, folder / "no" / "out.vtu"), "no")):
        result = run("optimize", *arguments, status=2)
        assert word in result.stderr and not result.stdout and len(result.stderr) < 400, result.stderr
    missing = run("optimize", folder / "none.vtu", out, status=1).stderr
    assert "not there" in missing and missing.count("none.vtu") == 1
    assert "'nothing'" in run("optimize", PELLET, out, "--region", "nothing", status=1).stderr
    assert not list(folder.iterdir())
    for name in ("optimize", "quality"):
        text = run(name, "--help").stdout
        assert "--target-quality" in text and "default 0.6" in text and ".msh" in text


def test_quality(folder):
    assert "worst quality 0.0039" in run("quality", PELLET).stdout
    result = run("quality", PELLET, "--histogram", "--worst", "3", "--number-of-bins", "4")
    assert result.stdout.count("  cell ") == 3 and result.stdout.count(" to ") == 4
    assert "0.75 to        1" in result.stdout
    result = run("quality", PELLET, folder / "none.vtu", "--json", "--worst", "2", status=1)
    (entry,) = json.loads(result.stdout)
    assert entry["file"] == str(PELLET) and 0 < entry["minimum"] < 0.004 and len(entry["worst_cells"]["Center"]) == 2
    assert "minimum_dihedral_angle" in run("quality", PELLET, "--quality-measure", "angle", status=2).stderr


def one_tetrahedron(path):
    meshoptimize.write((np.eye(4, 3), np.array([[3, 0, 1, 2]])), path)
    return path


def test_files_of_beginners(folder):
    """One line that names the file and what is wrong with it; no other file is written."""
    path = one_tetrahedron(folder / "one.vtk")
    surface, cut, is_folder = folder / "surface.vtk", folder / "cut.vtu", folder / "folder.vtu"
    surface.write_bytes(path.read_bytes().replace(b"UNSTRUCTURED_GRID", b"POLYDATA"))
    cut.write_bytes(PELLET.read_bytes()[:3000])
    is_folder.mkdir()
    for file, word in ((surface, "has to be filled"), (cut, "no element found"), (is_folder, "is a folder")):
        for name, out in (("optimize", [folder / "out.vtu"]), ("quality", [])):
            text = run(name, file, *out, status=1).stderr
            (line,) = [line for line in text.splitlines() if "%" not in line]
            assert str(file) in line and word in line, text
    assert not (folder / "out.vtu").exists()


def test_names_and_pipes(folder):
    """File names that are no text, or none of the terminal's, and a reader that ends before the output does."""
    odd = os.fsdecode(bytes(one_tetrahedron(folder / "one.vtu").parent) + b"/m\xe4sh.vtu")
    os.rename(folder / "one.vtu", odd)
    run("optimize", odd, folder / "ünicode.vtu", "--quiet")
    for path in (odd, folder / "ünicode.vtu"):
        assert "worst quality" in run("quality", path, environment={"PYTHONIOENCODING": "ascii"}).stdout
    for options in (["--json"], ["--histogram"]):
        with subprocess.Popen([*command("quality"), odd, *options, "--number-of-bins", "99999"], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE) as process:
            process.stdout.read(1)
            process.stdout.close()
            text = process.stderr.read().decode()
        assert process.returncode == 1 and not text, text


def test_warnings(folder):
    result = run("optimize", PELLET, folder / "out.vtu", "--desired-size", "1", "--target-quality", ".1")
    assert "warning: " in result.stderr and "Beta is 0" in result.stderr


def test_ctrl_c(folder):
    """The mesh is written as good as it is, and the exit status says what happened."""
    running = subprocess.Popen([*command("optimize"), PELLET, folder / "out.vtu", "--effort", "best"],
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    while "%" not in running.stderr.readline():
        time.sleep(0.01)
    running.send_signal(signal.SIGINT)
    out, errors = running.communicate(timeout=60)
    assert running.returncode == 130 and "aborted" in out and "Traceback" not in errors, (out, errors)
    assert meshoptimize.read(folder / "out.vtu").GetNumberOfCells() > 50000


def test_picture(folder):
    """On a display of its own, if there is none and Xvfb is there; else a message, and the mesh is written."""
    picture, environment = folder / "picture.png", {"DISPLAY": ""}
    picture.touch()
    assert "--force" in run("optimize", PELLET, folder / "out.vtu", "--picture", picture, status=2).stderr
    picture.unlink()
    has_x = bool(shutil.which("Xvfb"))
    result = run("optimize", PELLET, folder / "out.vtu", "--target-quality", ".3", "--picture", picture,
                 status=0 if has_x else 1, environment=environment)
    assert (folder / "out.vtu").exists()
    if not has_x:
        assert "Xvfb" in result.stderr
        print("the picture itself: skipped, Xvfb is not installed")
        return
    run("quality", PELLET, "--picture", folder / "one.png", environment=environment)
    for path, width in ((picture, 1600), (folder / "one.png", 800)):
        reds, shades = look(path, width)
        assert reds > 10000 and shades > 10000, (path, reds, shades)


def look(path, width):
    """The bad elements are seen: how many pixels of the picture are red, and how many colours it has."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOImage import vtkPNGReader

    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    assert reader.GetOutput().GetDimensions() == (width, 800, 1)
    red, green, blue = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).astype(int).T[:3]
    is_red = (red > 90) & (red > 2 * green) & (red > 2 * blue)
    return np.count_nonzero(is_red), len(np.unique(red << 16 | green << 8 | blue))


if __name__ == "__main__":
    run_each(globals())
