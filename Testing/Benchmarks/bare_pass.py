# SPDX-License-Identifier: BSD-3-Clause
"""The bare pass of BarePass.h from Python: the quality of each tetrahedron computed once, on one thread.

Compiled when it is first needed, by $CXX or c++, with Eigen's headers. GCC 12 vectorizes this loop in some surroundings,
and it then takes twice as long; so it is told not to, which gives about the time that BenchmarkOptimizeFilter measures.
"""
import ctypes
import functools
import os
import pathlib
import subprocess
import tempfile

import numpy as np

SOURCE = """
#include "BarePass.h"
extern "C" double barePass(const double* x, std::int64_t points, const std::int64_t* ids, std::int64_t cells, int repeats)
{
  return measureBarePass({ x, x + 3 * points }, { ids, ids + 4 * cells }, repeats).Seconds;
}
"""


def eigen():
    try:
        return subprocess.run(["pkg-config", "--cflags", "eigen3"], check=True, capture_output=True, text=True).stdout.split()
    except (OSError, subprocess.CalledProcessError):
        return ["-I/usr/include/eigen3"]


@functools.lru_cache(maxsize=None)
def program():
    """The compiled function. OSError or CalledProcessError if there is no compiler, or no Eigen."""
    here = pathlib.Path(__file__).resolve().parent
    with tempfile.TemporaryDirectory() as folder:
        source, library = pathlib.Path(folder) / "bare.cpp", pathlib.Path(folder) / "bare.so"
        source.write_text(SOURCE, encoding="ascii")
        flags = ["-std=c++17", "-O3", "-DNDEBUG", "-fno-math-errno", "-fno-tree-vectorize", "-shared", "-fPIC", *eigen()]
        folders = [f"-I{here}", f"-I{here.parents[1] / 'Filters' / 'Core'}"]
        subprocess.run([os.environ.get("CXX", "c++"), *flags, *folders, source, "-o", library], check=True, capture_output=True)
        function = ctypes.CDLL(str(library)).barePass
    function.restype = ctypes.c_double
    function.argtypes = [ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p, ctypes.c_int64, ctypes.c_int]
    return function


def bare_pass(points, cells):
    """Processor seconds of a bare pass over tetrahedra, the best of several: points [n, 3], cells [m, 4]."""
    x, ids = np.ascontiguousarray(points, dtype=np.float64), np.ascontiguousarray(cells, dtype=np.int64)
    repeats = min(200, max(5, 2_000_000 // len(ids)))
    return program()(x.ctypes.data, len(x), ids.ctypes.data, len(ids), repeats)
