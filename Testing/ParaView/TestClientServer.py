# SPDX-License-Identifier: BSD-3-Clause
"""pvpython as a client of a pvserver: the plugin is loaded on both sides, the filters run on the server."""
import os
import socket
import subprocess

from paraview import simple

from paraview_case import check, connect

with socket.socket() as probe:  # a free port
    probe.bind(("127.0.0.1", 0))  # by number: a bare system may not know "localhost"
    port = probe.getsockname()[1]
environment = {k: v for k, v in os.environ.items() if k != "PV_PLUGIN_PATH"}
server = subprocess.Popen(["pvserver", f"--server-port={port}", "--disable-xdisplay-test"], env=environment,
                          stdout=subprocess.PIPE, text=True)
try:
    connect(server, port)
    mesh = simple.Tetrahedralize(Input=simple.Wavelet(WholeExtent=[0, 4, 0, 4, 0, 4]))
    optimized = simple.MeshOptimize(Input=mesh, TargetQuality=0.9)
    optimized.UpdatePipeline()
    optimized.UpdatePropertyInformation()
    print("worst", optimized.WorstQualityBefore, "->", optimized.WorstQualityAfter, optimized.StopReason)
    check(optimized.WorstQualityAfter >= optimized.WorstQualityBefore > 0.1, "results did not come back")
    simple.Disconnect()
finally:
    server.kill()
