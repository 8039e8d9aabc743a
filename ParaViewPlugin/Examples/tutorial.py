"""From an STL file to a picture of the stress: pvpython tutorial.py FOLDER [BRACKET.stl]

The steps of the tutorial (ParaViewPlugin/Documentation/Tutorial.md), with a picture of each in FOLDER. Without an STL file of
your own a bracket is made: an L of 100 x 100 mm, 40 mm wide, its arms 25 mm thick. It needs a display (xvfb-run), and the
plugin by PV_PLUGIN_PATH (./bootstrap.sh env).
"""
import os
import sys

from meshoptimize.paraview import compare_before_and_after, show_worst_elements
from paraview.simple import *
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkTriangleFilter
from vtkmodules.vtkFiltersModeling import vtkLinearExtrusionFilter
from vtkmodules.vtkIOGeometry import vtkSTLWriter

L = [(0, 0), (100, 0), (100, 25), (25, 25), (25, 100), (0, 100)]  # x and z


def write_bracket(path):
    points, polygon, outline = vtkPoints(), vtkCellArray(), vtkPolyData()
    polygon.InsertNextCell(len(L), [points.InsertNextPoint(x, 0, z) for x, z in L])
    outline.SetPoints(points)
    outline.SetPolys(polygon)
    solid, triangles, writer = vtkLinearExtrusionFilter(), vtkTriangleFilter(), vtkSTLWriter()
    solid.SetInputData(outline)
    solid.SetExtrusionTypeToVectorExtrusion()
    solid.SetVector(0, 40, 0)
    triangles.SetInputConnection(solid.GetOutputPort())
    writer.SetInputConnection(triangles.GetOutputPort())
    writer.SetFileName(path)
    writer.Write()


def picture(name, source, array=None):
    view = CreateView("RenderView")
    view.ViewSize = [900, 700]
    display = Show(source, view)
    display.SetRepresentationType("Surface" if array else "Surface With Edges")
    ColorBy(display, ("POINTS", array) if array else None)
    if array:
        display.SetScalarBarVisibility(view, True)
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [230, -330, 200], [50, 20, 45], [0, 0, 1]
    ResetCamera(view)
    SaveScreenshot(os.path.join(folder, name), view, OverrideColorPalette="WhiteBackground")


folder = sys.argv[1]
os.makedirs(folder, exist_ok=True)
stl = sys.argv[2] if len(sys.argv) > 2 else os.path.join(folder, "bracket.stl")
if len(sys.argv) < 3:
    write_bracket(stl)

# 1. The surface. STL has the points of each triangle apart: Clean joins them.
surface = Clean(Input=STLReader(FileNames=[stl]))
picture("1_surface.png", surface)

# 2. Tetrahedra of at most 40 mm^3, as they come; the triangles of an STL file may be cut.
mesh = TetrahedralizeTetGen(Input=surface, MaximumVolume=40, KeepSurface=0, OptimizationLevel=0)
view, table, quality = show_worst_elements(mesh)
layout = GetLayout(view)
layout.SetSize(1000, 800)
SaveScreenshot(os.path.join(folder, "2_worst_elements.png"), layout)

# 3. Better elements, in the same surface.
optimized = MeshOptimize(Input=mesh, TargetQuality=0.6)
layout = compare_before_and_after(optimized)
layout.SetSize(1200, 800)
SaveScreenshot(os.path.join(folder, "3_before_and_after.png"), layout)

# 4. What holds it, and what pulls: the end of one arm is held, that of the other is pressed down with 2 N/mm^2.
# The Calculator proposes Cell Data, as MeshQuality is: both are wanted at points.
held = Calculator(Input=optimized, ResultArrayName="Constraint", Function="if(coordsZ > 99.999, 1, 0)")
held.AttributeType = "Point Data"
loaded = Calculator(Input=held, ResultArrayName="Traction", Function="if(coordsX > 99.999, -2, 0) * kHat")
loaded.AttributeType = "Point Data"

# 5. Steel: lengths in mm, Young's modulus and stress in MPa.
solution = Thermoelastic(Input=loaded, TemperatureMode="Uniform", YoungsModulus=2.1e5, PoissonsRatio=0.3)
warped = WarpByVector(Input=solution, Vectors=["POINTS", "Displacement"], ScaleFactor=50)
picture("4_stress.png", warped, "VonMises")
SaveData(os.path.join(folder, "stress.vtu"), proxy=solution, DataMode="Binary")

for source in (optimized, solution):
    source.UpdatePropertyInformation()
print(f"worst element {optimized.WorstQualityBefore:.4f} -> {optimized.WorstQualityAfter:.4f}")
print(f"{solution.NumberOfUnknowns} unknowns, {solution.StopReason}; greatest displacement "
      f"{solution.PointData['Displacement'].GetRange(-1)[1]:.3f} mm, von Mises stress "
      f"{solution.PointData['VonMises'].GetRange()[1]:.0f} MPa; estimated error {solution.RelativeErrorEstimate:.2f}")
