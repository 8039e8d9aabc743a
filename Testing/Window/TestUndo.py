# SPDX-License-Identifier: BSD-3-Clause
"""Undo, redo and states in the real window: what is undone and done again, and what is saved and loaded, looks the same.

    TestUndo.py MESH.vtu FOLDER VERSION_OF_PARAVIEW      77, and a word, where a tool is missing, or ParaView is another

Apply and a press of History are one step each; a press of a button that shows several views ends what can be undone. Pictures of what differs are left in FOLDER. ParaView 5.11 only: menus
are elsewhere in others.
"""
import pathlib
import sys
import tempfile

import numpy as np
from first_time import BUTTONS, SIZE, Window, reason_to_skip
from screen import screen

VIEWS = slice(190, 840), slice(305, SIZE[0] - 5)  # their place in the window
FILE_MENU, LOAD_STATE, SAVE_STATE = (20, 10), (75, 112), (75, 137)
ALIKE = 0.002  # of the pixels may differ
FRAME = 0.008  # have the frame of the active view, which may be another one


class Looks:
    """What the views show, and whether they do so again."""

    def __init__(self, window, folder):
        self.window, self.folder, self.faults = window, folder, 0

    def now(self):
        self.window.xdotool("mousemove", SIZE[0] - 5, SIZE[1] - 5)
        self.window.rest()
        return self.window.display.pixels()[VIEWS].astype(int)

    def differ(self, wanted):
        return (np.abs(self.now() - wanted).max(axis=-1) > 32).mean()

    def check(self, wanted, what, alike=ALIKE):
        differing = self.differ(wanted)
        print(f"{what}: {differing:.2%} of the picture differ")
        if differing > alike:
            self.faults += 1
            self.window.picture(self.folder / f"{what.replace(' ', '_')}.png")

    def step(self, what, act, undo=True):
        """It changes the picture; undone and done again it looks as before and after. Or it cannot be undone."""
        before = self.now()
        act()
        self.window.wait_until(lambda: self.differ(before) > ALIKE, f"something to be seen of {what}")
        after = self.now()
        self.window.keys("ctrl+z")
        self.check(before if undo else after, f"{what} undone" if undo else f"{what}, not undone")
        self.window.keys("ctrl+y")
        self.check(after, f"{what} done again")


def undo_and_states(folder, mesh):
    """Returns the number of faults."""
    state = folder / "window.pvsm"
    state.unlink(missing_ok=True)
    with screen(*SIZE) as display, tempfile.TemporaryDirectory() as home:
        window = Window(display, home)
        looks = Looks(window, folder)
        try:
            window.keys("ctrl+o")
            window.type(str(mesh))
            window.keys("Return")
            window.apply()
            looks.step("Worst elements", lambda: window.press(*BUTTONS["Worst elements"]), undo=False)
            window.keys("ctrl+space")
            window.type("Mesh Optimize")
            window.keys("Return")
            looks.step("Apply", window.apply)
            looks.step("History", lambda: window.press(*BUTTONS["History"]))
            looks.step("Before and after", lambda: window.press(*BUTTONS["Before and after"]), undo=False)
            wanted = looks.now()
            window.press(*FILE_MENU)
            window.press(*SAVE_STATE)
            window.type(str(state))
            window.keys("Return")
            window.wait_until(state.exists, "the state to be saved")
            window.keys("ctrl+r")
            window.keys("Return")  # yes, reset
            window.press(*FILE_MENU)
            window.press(*LOAD_STATE)
            window.type(str(state))
            window.keys("Return")
            window.keys("Return")  # the files as they are
            looks.check(wanted, "state loaded", ALIKE + FRAME)
        finally:
            window.end()
    return looks.faults


def main():
    mesh, folder, version = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3]
    reason = reason_to_skip(version) or ("" if version.startswith("5.11") else "menus are elsewhere")
    if reason:
        print("skipped:", reason)
        return 77
    folder.mkdir(parents=True, exist_ok=True)
    return 1 if undo_and_states(folder, mesh) else 0


if __name__ == "__main__":
    sys.exit(main())
