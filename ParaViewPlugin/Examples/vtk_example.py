"""With VTK alone: /usr/bin/python3 vtk_example.py IN.vtu OUT.vtu"""
import sys

from meshoptimize import vtkMeshOptimizeFilter, vtkMeshQualityMinMax
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter

reader = vtkXMLUnstructuredGridReader()
reader.SetFileName(sys.argv[1])

optimize = vtkMeshOptimizeFilter()
optimize.SetInputConnection(reader.GetOutputPort())
optimize.SetTargetQuality(0.3)
optimize.Update()
print(f"worst quality {optimize.GetWorstQualityBefore():.4f} -> {optimize.GetWorstQualityAfter():.4f}, "
      f"at most {optimize.GetQualityBound():.4f}; {optimize.GetStopReasonAsString()}")

quality = vtkMeshQualityMinMax()
quality.SetInputConnection(optimize.GetOutputPort())

writer = vtkXMLUnstructuredGridWriter()
writer.SetInputConnection(quality.GetOutputPort())
writer.SetDataModeToBinary()  # Debian's VTK cannot read raw appended data, the writer's default
writer.SetFileName(sys.argv[2])
if writer.Write() != 1 or optimize.GetWorstQualityAfter() < optimize.GetWorstQualityBefore():
    sys.exit("failed")
