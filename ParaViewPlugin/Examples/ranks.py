import sys  # mpirun -np 4 pvbatch ranks.py IN.pvtu OUT.pvtu
from paraview.simple import *
mesh = XMLPartitionedUnstructuredGridReader(FileName=[sys.argv[1]])
optimized = MeshOptimize(Input=mesh)
SaveData(sys.argv[2], proxy=optimized, DataMode="Binary")
