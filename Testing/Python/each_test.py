# SPDX-License-Identifier: BSD-3-Clause
"""Runs the functions of a test that are named test_..., each with an empty folder of its own."""
import pathlib
import sys
import tempfile


def run_each(names):
    """`names`: globals() of the test. The first that fails ends the process with its traceback."""
    for name, test in list(names.items()):
        if name.startswith("test_"):
            print(name, flush=True)
            with tempfile.TemporaryDirectory() as folder:
                test(pathlib.Path(folder))
    sys.exit(0)
