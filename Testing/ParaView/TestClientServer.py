# SPDX-License-Identifier: BSD-3-Clause
"""pvpython as a client of a pvserver: the plugin is loaded on both sides, the filters run on the server."""
from paraview import simple

from paraview_case import check, pvserver

with pvserver():
    mesh = simple.Tetrahedralize(Input=simple.Wavelet(WholeExtent=[0, 4, 0, 4, 0, 4]))
    optimized = simple.MeshOptimize(Input=mesh, TargetQuality=0.9)
    optimized.UpdatePipeline()
    optimized.UpdatePropertyInformation()
    print("worst", optimized.WorstQualityBefore, "->", optimized.WorstQualityAfter, optimized.StopReason)
    check(optimized.WorstQualityAfter >= optimized.WorstQualityBefore > 0.1, "results did not come back")
