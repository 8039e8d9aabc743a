# SPDX-License-Identifier: BSD-3-Clause
"""The example with a window and a slider, built against the install tree, run, and pulled with the mouse where xdotool is:
no bad element is to be seen at a target of .6, and red ones are at a low one. Its length is held: an example is short."""
import pathlib
import shutil
import subprocess
import sys
import time

import numpy as np
from package_case import BARE, BUILD, PELLET, SOURCE, WORK, fresh_folder, run, skip

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "Window"))
from screen import screen  # noqa: E402


def main():
    example = SOURCE / "ParaViewPlugin/Examples/Slider"
    lines = (example / "slider.cxx").read_text(encoding="utf-8").count("\n")
    assert lines < 40, f"slider.cxx has {lines} lines"
    fresh_folder()
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
        with subprocess.Popen([program, PELLET], env=BARE) as window:
            try:
                until(display, lambda pixels: red(pixels) == 0 and coloured(pixels) > 20, "the window")
                display.save(WORK / "optimized.png")
                if not shutil.which("xdotool"):
                    print("not pulled with the mouse: there is no xdotool")
                    return
                x, y = KNOB
                run("xdotool", "mousemove", x, y, "mousedown", 1, "mousemove", x - 350, y, "mouseup", 1)
                until(display, lambda pixels: red(pixels) > 50, "the worst elements of the mesh as it was")
                display.save(WORK / "as_it_was.png")
            finally:
                window.kill()


def red(pixels):
    """How much of the picture is as red as elements of nearly no quality are."""
    r, g, b = (pixels[..., k].astype(int) for k in range(3))
    return int(((r > 120) & (3 * g < r) & (3 * b < r)).sum())


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
