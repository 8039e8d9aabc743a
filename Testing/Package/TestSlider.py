# SPDX-License-Identifier: BSD-3-Clause
"""The example with a window and a slider, built against the install tree, run, and pulled with the mouse where xdotool is:
no bad triangle is to be seen at a target of .6, and yellow ones are at a low one. It is one file, of a length that is held."""
import pathlib
import shutil
import subprocess
import sys
import time

import meshoptimize
import numpy as np
from package_case import BARE, BUILD, SOURCE, WORK, fresh_folder, run, skip

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "Window"))
from screen import screen  # noqa: E402


def main():
    example = SOURCE / "ParaViewPlugin/Examples/Slider"
    sources = [path.name for path in example.iterdir() if path.suffix in (".cxx", ".h")]
    assert sources == ["slider.cxx"], sources
    lines = (example / "slider.cxx").read_text(encoding="utf-8").count("\n")
    assert lines < 40, f"slider.cxx has {lines} lines"
    fresh_folder()
    meshoptimize.write(jittered_square(), WORK / "square.vtu")
    run("cmake", "--install", BUILD, "--prefix", WORK / "install")
    configured = subprocess.run(
        ["cmake", "-S", example, "-B", WORK / "build", f"-DCMAKE_PREFIX_PATH={WORK}/install"],
        env=BARE, text=True, capture_output=True, check=False)
    if configured.returncode:
        if "GLEW" in configured.stderr:
            skip("VTK's rendering needs GLEW (Debian: apt-get install libglew-dev)")
        raise SystemExit(configured.stdout + configured.stderr)
    run("cmake", "--build", WORK / "build")
    program = WORK / "build/slider"
    if not shutil.which("Xvfb"):
        skip("there is no display (Debian: apt-get install xvfb)")
    with screen(800, 800) as display:
        BARE["DISPLAY"] = display.name
        with subprocess.Popen([program, WORK / "square.vtu"], env=BARE) as window:
            try:
                until(display, lambda pixels: warm(pixels) == 0 and coloured(pixels) > 20, "the window")
                display.save(WORK / "optimized.png")
                if not shutil.which("xdotool"):
                    print("not pulled with the mouse: there is no xdotool")
                    return
                x, y = KNOB
                run("xdotool", "mousemove", x, y, "mousedown", 1, "mousemove", x - 380, y, "mouseup", 1)
                until(display, lambda pixels: warm(pixels) > 500, "the bad triangles of the mesh as it was")
                display.save(WORK / "as_it_was.png")
            finally:
                window.kill()


def jittered_square(size=20):
    """Triangles of a square, some of which are nearly flat."""
    places = np.mgrid[0:size + 1, 0:size + 1].reshape(2, -1).T.astype(float)
    inside = ((places > 0) & (places < size)).all(axis=1)
    places[inside] += np.random.default_rng(2).uniform(-0.38, 0.38, (inside.sum(), 2))
    first = (np.arange(size)[:, None] * (size + 1) + np.arange(size)).ravel()
    return places, np.concatenate([first[:, None] + [0, size + 1, 1], first[:, None] + [1, size + 1, size + 2]])


def warm(pixels):
    """How much of the picture is from yellow to red, as triangles of little quality are."""
    r, g, b = (pixels[..., k].astype(int) for k in range(3))
    return int(((r > 200) & (b < 60)).sum())


def coloured(pixels):
    return int((np.ptp(pixels.astype(int), axis=-1) > 60).sum())


def until(display, condition, what):
    end = time.monotonic() + 60
    while not condition(display.pixels()):
        if time.monotonic() > end:
            display.save(WORK / "failed.png")
            raise SystemExit(f"FAILED: waited 60 s for {what}: {WORK / 'failed.png'}")
        time.sleep(0.3)
    return display.pixels()


KNOB = 462, 720  # where the slider stands at a target of .6

if __name__ == "__main__":
    main()
