# SPDX-License-Identifier: BSD-3-Clause
"""The first time in the real window (first_time.py): at most 8 presses of the mouse, and the saved mesh has no bad element.

    TestFirstTime.py MESH.vtu FOLDER VERSION_OF_PARAVIEW      77, and a word, where a tool is missing, or ParaView is another
"""
import pathlib
import sys

import meshoptimize
from first_time import first_time, reason_to_skip

MOST = 8


def main():
    mesh, folder, version = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3]
    reason = reason_to_skip(version)
    if reason:
        print("skipped:", reason)
        return 77
    folder.mkdir(parents=True, exist_ok=True)
    presses = first_time(folder, mesh, with_pictures=False)
    before, after = (meshoptimize.quality(meshoptimize.read(path)) for path in (mesh, folder / "better.vtu"))
    print(f"{presses} presses of the mouse: worst quality {before.minimum:.4f} -> {after.minimum:.4f}")
    return 0 if presses <= MOST and before.minimum < 0.01 < 0.36 < after.minimum else 1


if __name__ == "__main__":
    sys.exit(main())
