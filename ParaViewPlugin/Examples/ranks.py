import sys  # mpirun -np 4 pvbatch ranks.py IN.pvtu OUT.pvtu
from paraview.simple import *
mesh = XMLPartitionedUnstructuredGridReader(FileName=[sys.argv[1]])
optimized = MeshOptimize(Input=mesh, OptimizeBorders=1)
SaveData(sys.argv[2], proxy=optimized, DataMode="Binary")
