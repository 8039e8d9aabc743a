# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of packages share: programs run without this build's environment, and one use of the commands."""
import os
import pathlib
import shutil
import subprocess
import sys

BUILD, WORK = map(pathlib.Path, sys.argv[1:3])
PVPYTHON, GENERATOR = sys.argv[3:5]  # the last one is CMake's
SOURCE = pathlib.Path(os.environ["MESHOPTIMIZE_SOURCE"])
PELLET = pathlib.Path(os.environ["MESHOPTIMIZE_DATA"]) / "crack40.vtu"
OURS = ("PYTHONPATH", "PV_PLUGIN_PATH", "MESHOPTIMIZE_PLUGIN", "LD_LIBRARY_PATH")
BARE = {name: value for name, value in os.environ.items() if name not in OURS} | {"CMAKE_GENERATOR": GENERATOR}
SKIPPED = 77


def fresh_folder():
    shutil.rmtree(WORK, ignore_errors=True)
    WORK.mkdir(parents=True)


def run(*command, **options):
    """What the command prints. Ends the test where it fails."""
    done = subprocess.run([str(word) for word in command], env=BARE, text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, cwd=WORK, check=False, **options)
    if done.returncode:
        raise SystemExit(f"FAILED ({done.returncode}): {' '.join(map(str, command))}\n{done.stdout}")
    return done.stdout


def skip(reason):
    print("skipped:", reason)
    sys.exit(SKIPPED)


def use_commands(folder):
    """mesh-optimize and mesh-quality of a bin folder, on the pellet: the worst element rises."""
    run(folder / "mesh-optimize", PELLET, WORK / "optimized.vtu", "--target-quality", "0.3", "--effort", "quick", "--quiet")
    text = run(folder / "mesh-quality", WORK / "optimized.vtu")
    worst = float(text.split("worst quality ")[1].split(",")[0])
    assert 0.2 < worst < 1, text
