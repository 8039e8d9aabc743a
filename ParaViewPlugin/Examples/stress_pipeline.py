"""From a closed surface to the stress in a hot body: pvpython stress_pipeline.py OUT.vtu [PICTURE.png]

    Box -> Triangulate -> Clean -> Subdivide -> Tetrahedralize (TetGen) -> Mesh Optimize -> Thermoelastic -> Warp By Vector

With PV_PLUGIN_PATH set (./bootstrap.sh env) the filters are there; otherwise call first
LoadPlugin(".../MeshOptimize.so", ns=globals()). The picture needs a display (xvfb-run).
"""
import sys

from paraview.simple import *

# A closed surface of small, even triangles: a block of 100 mm. Clean joins the points that the faces of a box have each
# for themselves. Instead: your own STL or PLY file, with Clean behind it.
block = Clean(Input=Triangulate(Input=Box(XLength=100, YLength=100, ZLength=100, Center=[50, 50, 50])))
surface = Subdivide(Input=block, NumberofSubdivisions=4)

# Tetrahedra, as TetGen makes them without its own optimization; then without bad elements. The surface stays as it is.
mesh = TetrahedralizeTetGen(Input=surface, MaximumVolume=100, OptimizationLevel=0)
optimized = MeshOptimize(Input=mesh)

# What is known at the points, under the names that Thermoelastic looks for: the block is hot on top, and its bottom is held.
heated = Calculator(Input=optimized, ResultArrayName="Temperature", Function="20 + 0.05 * coordsZ^2")
held = Calculator(Input=heated, ResultArrayName="Constraint", Function="if(coordsZ < 0.001, 1, 0)")

# Steel. Lengths are in mm and Young's modulus is in MPa = N/mm^2, so stresses are in MPa.
solution = Thermoelastic(Input=held, ReferenceTemperature=20, YoungsModulus=2.1e5, PoissonsRatio=0.3, ThermalExpansion=1.2e-5)

# The deformed body, displacements fifty times as large as they are.
warped = WarpByVector(Input=solution, Vectors=["POINTS", "Displacement"], ScaleFactor=50)
SaveData(sys.argv[1], proxy=warped, DataMode="Binary")

# Numbers about a run have to be asked for.
for source in (optimized, solution):
    source.UpdatePropertyInformation()
print(f"worst element {optimized.WorstQualityBefore:.4f} -> {optimized.WorstQualityAfter:.4f}, "
      f"{optimized.QualityBound:.4f} at most with this surface")
print(f"{solution.NumberOfUnknowns} unknowns, {solution.NumberOfSolverIterations} steps: {solution.StopReason}")
print(f"greatest displacement {solution.PointData['Displacement'].GetRange(-1)[1]:.3f} mm, "
      f"greatest von Mises stress {solution.PointData['VonMises'].GetRange()[1]:.0f} MPa")

if len(sys.argv) > 2:
    view = CreateView("RenderView")
    view.ViewSize = [1000, 800]
    display = Show(warped, view)
    display.SetRepresentationType("Surface With Edges")
    ColorBy(display, ("POINTS", "VonMises"))
    display.SetScalarBarVisibility(view, True)
    view.CameraFocalPoint, view.CameraPosition, view.CameraViewUp = [50, 50, 50], [-120, -350, 220], [0, 0, 1]
    ResetCamera(view)
    SaveScreenshot(sys.argv[2], view, OverrideColorPalette="WhiteBackground")
