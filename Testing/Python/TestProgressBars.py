# SPDX-License-Identifier: BSD-3-Clause
"""progress_bar=True with the bars of tqdm and rich. Skipped (77) where neither is installed."""
import io
import os
import sys
from contextlib import redirect_stderr, redirect_stdout
from importlib.util import find_spec

import meshoptimize
from meshoptimize import _progress

PELLET = os.path.join(os.environ["MESHOPTIMIZE_DATA"], "crack40.vtu")
BARS = {"tqdm": _progress._tqdm_bar, "rich": _progress._rich_bar}
INSTALLED = {name: bar for name, bar in BARS.items() if find_spec(name)}

if not INSTALLED:
    print("skipped: neither tqdm nor rich is installed (Debian: python3-tqdm, python3-rich)")
    sys.exit(77)

mesh, seen = meshoptimize.read(PELLET), []
for name, make in INSTALLED.items():
    print(name, flush=True)
    show, close = make()
    meshoptimize.optimize(mesh, target_quality=0.3,
                          progress=lambda fraction, text: (seen.append(fraction), show(fraction, text)))
    close()
text = io.StringIO()
with redirect_stderr(text), redirect_stdout(text):
    _, report = meshoptimize.optimize(mesh, target_quality=0.3, progress_bar=True)
sys.exit(0 if len(seen) >= 2 * len(INSTALLED) and report.worst_after > 0.25 else 1)
