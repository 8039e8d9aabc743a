# SPDX-License-Identifier: BSD-3-Clause
"""ours.py IN.vtu OUT.vtu quick|default|best|paper: vtkMeshOptimizeFilter on one thread; prints its seconds."""
import sys

from meshoptimize import vtkMeshOptimizeFilter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter


def main():
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(sys.argv[1])
    optimize = vtkMeshOptimizeFilter()
    optimize.SetInputConnection(reader.GetOutputPort())
    optimize.SetNumberOfThreads(1)
    if sys.argv[3] == "paper":
        optimize.SetAlgorithmToPaper1996()
    else:
        optimize.SetAlgorithmToWorstFirst()
        {"quick": optimize.SetEffortToQuick, "default": optimize.SetEffortToDefault,
         "best": optimize.SetEffortToBest}[sys.argv[3]]()
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputConnection(optimize.GetOutputPort(0))
    writer.SetDataModeToBinary()
    writer.SetFileName(sys.argv[2])
    if writer.Write() != 1 or optimize.GetErrorCode() != 0:
        sys.exit("failed")
    print("seconds", optimize.GetOptimizeSeconds())
    print("bound", optimize.GetQualityBound())


if __name__ == "__main__":
    main()
