# SPDX-License-Identifier: BSD-3-Clause
"""README's example for several ranks, from .pvtu to .pvtu: as good as one rank. pvbatch without --symmetric, so that only the
first rank runs this script."""
import os
import runpy
import sys

from paraview.simple import *

folder, source = os.environ["MESHOPTIMIZE_OUTPUT"], os.environ["MESHOPTIMIZE_SOURCE"]
before, after = f"{folder}/ranks_before.pvtu", f"{folder}/ranks_after.pvtu"
SaveData(before, proxy=XMLUnstructuredGridReader(FileName=[os.environ["MESHOPTIMIZE_DATA"] + "/crack40.vtu"]), DataMode="Binary")
sys.argv = ["ranks.py", before, after]
example = runpy.run_path(source + "/ParaViewPlugin/Examples/ranks.py")
optimized = example["optimized"]
optimized.UpdatePropertyInformation()
again = MeshQualityMinMax(Input=XMLPartitionedUnstructuredGridReader(FileName=[after]))
again.UpdatePipeline()
again.UpdatePropertyInformation()
print(optimized.WorstQualityBefore, optimized.WorstQualityAfter, optimized.QualityBound, again.MinimumQuality)
# One rank ends at .3654; with the borders kept two ranks stay far below.
if not (optimized.WorstQualityAfter > 0.36 and abs(again.MinimumQuality - optimized.WorstQualityAfter) < 1e-12):
    print("FAILED: not as good as one rank")
    os._exit(1)
