# SPDX-License-Identifier: BSD-3-Clause
"""The example with a window and a slider, built against the install tree; run, and pulled with the mouse where xdotool is."""
import pathlib
import select
import shutil
import subprocess
import sys
import time

from package_case import BARE, BUILD, PELLET, SOURCE, WORK, fresh_folder, run, skip

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "Window"))
from screen import screen  # noqa: E402


def next_line(stream):
    ready, _, _ = select.select([stream], [], [], 20)
    return stream.readline() if ready else "nothing within 20 s"


def main():
    fresh_folder()
    run("cmake", "--install", BUILD, "--prefix", WORK / "install")
    configured = subprocess.run(
        ["cmake", "-S", SOURCE / "ParaViewPlugin/Examples/Slider", "-B", WORK / "build", f"-DCMAKE_PREFIX_PATH={WORK}/install"],
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
        text = run(program, PELLET, "0.2")
        assert text.startswith("target 0.2: worst 0.2"), text
        if not shutil.which("xdotool"):
            print("not pulled with the mouse: there is no xdotool")
            return
        with subprocess.Popen([program, PELLET], env=BARE, stdout=subprocess.PIPE, text=True) as window:
            first = next_line(window.stdout)
            time.sleep(1)
            display.save(WORK / "before.png")
            x, y = KNOB
            run("xdotool", "mousemove", x, y, "mousedown", 1, "mousemove", x + 300, y, "mouseup", 1)
            second = next_line(window.stdout)
            time.sleep(1)
            display.save(WORK / "after.png")
            window.kill()
        assert "worst" in first and "worst" in second, (first, second)
        worst = [float(line.split("worst ")[1]) for line in (first, second)]
        assert worst[0] < 0.05 < 0.1 < worst[1], (first, second)


KNOB = 88, 720  # where the slider is at its least value

if __name__ == "__main__":
    main()
