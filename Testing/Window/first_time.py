# SPDX-License-Identifier: BSD-3-Clause
"""The first time with the plugin, in ParaView's real window: from opening a file to saving the better one, by mouse and keys.

    /usr/bin/python3 Testing/Window/first_time.py FOLDER [MESH.vtu]     writes pictures of the steps and better.vtu

Needs Xvfb, openbox and xdotool, and ParaView 5.11 or 5.13 (then with qt6-svg-plugins, for the icons): the buttons are pressed
where these have them in a window of 1400 x 880.
Presses of the mouse are counted; typing and shortcuts are free. PV_PLUGIN_PATH says where the plugin is (./bootstrap.sh env).
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

from screen import screen

NEEDED = ("paraview", "openbox", "xdotool", "Xvfb")
SIZE = 1400, 880
APPLY = {"5.11": (60, 466), "5.13": (56, 487)}  # by version of ParaView
BUTTONS = {"Worst elements": (800, 122), "Histogram": (900, 122), "Before and after": (1006, 122), "History": (1100, 122)}
DATA_MODE = 760, 487  # in the dialog of the writer
PATIENCE = 120  # seconds


def reason_to_skip(version):
    """Why the window cannot be driven here, or nothing; `version` of ParaView."""
    missing = [name for name in NEEDED if not shutil.which(name)]
    if missing:
        return f"not installed: {', '.join(missing)}"
    return "" if version.startswith(tuple(APPLY)) else f"buttons may be elsewhere in ParaView {version}"


class Window:
    """ParaView on a screen of its own, with the settings of a new user."""

    def __init__(self, display, home):
        self.display, self.presses = display, 0
        self.environment = dict(os.environ, DISPLAY=display.name, HOME=home, XDG_RUNTIME_DIR=home, LC_ALL="C.UTF-8")
        self.environment.pop("XDG_CONFIG_HOME", None)
        self.manager = self.start("openbox")
        self.paraview = self.start("paraview")
        self.wait_until(lambda: self.find("ParaView 5"), "the window")
        self.rest()
        self.keys("Escape")  # the welcome
        window = self.find("ParaView 5")[-1]
        self.version = self.xdotool("getwindowname", window).split()[1].rsplit(".", 1)[0]
        self.xdotool("windowsize", "--sync", window, *SIZE, "windowmove", window, 0, 0, "windowactivate", "--sync", window)
        self.rest()

    def start(self, *command):
        return subprocess.Popen(command, env=self.environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def end(self):
        for process in (self.paraview, self.manager):
            process.kill()
            process.wait()

    def xdotool(self, *words):
        done = subprocess.run(["xdotool", *map(str, words)], env=self.environment, capture_output=True, text=True, check=False)
        return done.stdout

    def find(self, title):
        return self.xdotool("search", "--onlyvisible", "--name", title).split()

    def wait_until(self, condition, what):
        end = time.monotonic() + PATIENCE
        while not condition():
            if time.monotonic() > end:
                raise SystemExit(f"FAILED: waited {PATIENCE} s for {what}")
            time.sleep(0.2)

    def rest(self):
        """Until ParaView neither works nor draws any more."""
        def state():
            fields = pathlib.Path(f"/proc/{self.paraview.pid}/stat").read_text().rsplit(")", 1)[1].split()
            return int(fields[11]) + int(fields[12]), self.display.pixels().tobytes()

        def quiet():
            before = state()
            time.sleep(0.5)
            after = state()
            return after[0] - before[0] <= 5 and before[1] == after[1]  # hundredths of a second

        time.sleep(0.3)
        self.wait_until(quiet, "ParaView to come to rest")

    def press(self, x, y):
        self.presses += 1
        self.xdotool("mousemove", x, y)
        time.sleep(0.2)
        self.xdotool("click", 1)
        self.rest()

    def apply(self):
        x, y = APPLY[self.version]
        self.press(x, y)
        pixel = self.display.pixels()[y - 8, x].astype(int)
        if pixel[1] > pixel[0] + 20:
            raise SystemExit(f"FAILED: Apply is still green: {pixel}")

    def keys(self, *names):
        self.xdotool("key", *names)
        self.rest()

    def type(self, text):
        self.xdotool("type", "--delay", 5, text)
        self.rest()

    def picture(self, path):
        self.xdotool("mousemove", SIZE[0] - 5, SIZE[1] - 5)
        self.rest()
        self.display.save(path, (0, 0, *SIZE))


def first_time(folder, mesh, with_pictures=True):
    """The path. Returns how often the mouse was pressed."""
    better = folder / "better.vtu"
    better.unlink(missing_ok=True)
    with screen(*SIZE) as display, tempfile.TemporaryDirectory() as home:
        window = Window(display, home)
        picture = (lambda name: window.picture(folder / f"{name}.png")) if with_pictures else lambda name: None
        try:
            window.keys("ctrl+o")
            window.type(str(mesh))
            window.keys("Return")
            window.apply()
            picture("1_opened")
            window.press(*BUTTONS["Worst elements"])
            picture("2_worst_elements")
            window.keys("ctrl+space")  # the search for filters
            window.type("Mesh Optimize")
            window.keys("Return")
            picture("3_mesh_optimize")
            window.apply()
            picture("4_applied")
            window.press(*BUTTONS["Before and after"])
            picture("5_before_and_after")
            if with_pictures:
                window.press(*BUTTONS["History"])
                picture("6_history")
            window.keys("ctrl+s")
            window.type(str(better))
            window.keys("Return")  # the file
            window.press(*DATA_MODE)  # Binary: Debian's VTK cannot read the default
            window.keys("b", "Return")
            picture("7_saving")
            window.keys("Return")
            window.wait_until(better.exists, "the file to be saved")
            window.rest()
            return window.presses
        finally:
            window.end()


def main():
    folder = pathlib.Path(sys.argv[1]).resolve()
    mesh = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else pathlib.Path(__file__).parents[2] / "Data/crack40.vtu").resolve()
    missing = [name for name in NEEDED if not shutil.which(name)]
    if missing:
        raise SystemExit(f"not installed: {', '.join(missing)}")
    folder.mkdir(parents=True, exist_ok=True)
    print(f"{first_time(folder, mesh)} presses of the mouse")


if __name__ == "__main__":
    main()
