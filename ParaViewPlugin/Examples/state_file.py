"""A pipeline made in the window, run on other files: pvpython state_file.py STATE.pvsm OUT_FOLDER IN.vtu ...

STATE.pvsm is what *File > Save State* wrote, with one reader and one Mesh Optimize. All settings are those of the state.
The plugin has to be known: PV_PLUGIN_PATH (./bootstrap.sh env), or LoadPlugin(".../MeshOptimize.so") first.
"""
import os
import sys

from paraview.simple import *

state, folder, files = sys.argv[1], sys.argv[2], sys.argv[3:]
os.makedirs(folder, exist_ok=True)
LoadState(state)
sources = GetSources().values()
reader, = (source for source in sources if source.GetXMLName() == "XMLUnstructuredGridReader")
optimized, = (source for source in sources if source.GetXMLName() == "MeshOptimize")

for path in files:
    reader.FileName = [path]
    optimized.UpdatePipeline()
    optimized.UpdatePropertyInformation()
    out = os.path.join(folder, os.path.basename(path))
    SaveData(out, proxy=optimized, DataMode="Binary")
    print(f"{path}: worst {optimized.WorstQualityBefore:.4f} -> {optimized.WorstQualityAfter:.4f}, {optimized.StopReason}; {out}")
