"""In ParaView's Python: pvpython paraview_example.py IN.vtu OUT.vtu

With PV_PLUGIN_PATH set (./bootstrap.sh env) the filters are there; otherwise call first
LoadPlugin(".../MeshOptimize.so", ns=globals()).
"""
import sys

from paraview.simple import *

mesh = XMLUnstructuredGridReader(FileName=[sys.argv[1]])
optimized = MeshOptimize(Input=mesh, TargetQuality=0.3)
optimized.UpdatePipeline()
optimized.UpdatePropertyInformation()
print(f"worst quality {optimized.WorstQualityBefore:.4f} -> {optimized.WorstQualityAfter:.4f}, "
      f"at most {optimized.QualityBound:.4f}; {optimized.StopReason}")

quality = MeshQualityMinMax(Input=optimized, NumberOfWorstCells=5)
worst = OutputPort(quality, 3)
worst.UpdatePipeline()
print("worst cells:", worst.CellData["MeshQuality"].GetRange())
SaveData(sys.argv[2], proxy=quality, DataMode="Binary")
