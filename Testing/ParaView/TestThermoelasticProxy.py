# SPDX-License-Identifier: BSD-3-Clause
"""Thermoelastic by its proxy, from a file, on one rank and on several: no array grabbed, results that can be read, a warped picture's data.

A bar (a box of tetrahedra) held at x = 0 and heated: with the sides free it grows by alpha dT in length, and away from the
held end nothing is stressed.
"""
import os

from paraview import servermanager, simple
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

from paraview_case import OUTPUT, check, jittered_box, load_plugin

load_plugin()
ranks = servermanager.vtkProcessModule.GetProcessModule().GetNumberOfLocalPartitions()
path = os.path.join(OUTPUT, f"thermoelastic_box_{ranks}.vtu")
writer = vtkXMLUnstructuredGridWriter()
writer.SetFileName(path)
writer.SetDataModeToBinary()
writer.SetInputData(jittered_box(6))
check(writer.Write() == 1, "cannot write", path)
mesh = simple.XMLUnstructuredGridReader(FileName=[path])
held = simple.Calculator(Input=mesh, ResultArrayName="Constraint", Function="(coordsX<1e-9)*(iHat+jHat+kHat)")
hot = simple.Calculator(Input=held, ResultArrayName="Temperature", Function="100")

solve = simple.Thermoelastic(Input=hot)
for name in ("TemperatureArray", "YoungsModulusArray", "PoissonsRatioArray", "ThermalExpansionArray", "RegionArray",
             "ConstraintArray", "PrescribedDisplacementArray", "TractionArray", "FacetTractionArray"):
    check(solve.GetPropertyValue(name)[1] in ("None", ""), name, "grabbed", solve.GetPropertyValue(name))
solve.UpdatePipeline()
solve.UpdatePropertyInformation()
check(solve.StopReason == "Converged", solve.StopReason)
check(solve.NumberOfSolverIterations > 10, "iterations", solve.NumberOfSolverIterations)
check(0 < solve.RelativeResidual <= 1e-8, "residual", solve.RelativeResidual)
check(solve.NumberOfUnknowns == 3 * (7 ** 3 - 7 ** 2), "unknowns", solve.NumberOfUnknowns)
check(solve.StrainEnergy > 0 and 0 < solve.RelativeErrorEstimate < 1, "energy and error")
for name, components in (("Displacement", 3), ("Stress", 6), ("VonMises", 1), ("PrincipalStress", 3), ("Reaction", 3)):
    check(solve.PointData[name].GetNumberOfComponents() == components, name)
for name, components in (("ElementStress", 6), ("StrainEnergyDensity", 1), ("ErrorEstimate", 1)):
    check(solve.CellData[name].GetNumberOfComponents() == components, name)
longest = solve.PointData["Displacement"].GetRange(0)[1]
check(0.95e-3 < longest < 1.5e-3, "alpha dT L is 1e-3, the end moves by", longest)

warped = simple.WarpByVector(Input=solve, Vectors=["POINTS", "Displacement"], ScaleFactor=100)
warped.UpdatePipeline()
check(warped.GetDataInformation().GetBounds()[1] > 1.05, "not warped", warped.GetDataInformation().GetBounds())

residuals = simple.OutputPort(solve, 1)
residuals.UpdatePipeline()
check(residuals.GetDataInformation().GetNumberOfRows() == solve.NumberOfSolverIterations + 1, "history")

# Settings by their names, as a state file carries them.
solve.TemperatureMode = "Radial"
solve.AxisTemperature = 50
solve.RadialCoefficient = 10
solve.RigidMotion = "Project"
solve.ConstraintArray = ["POINTS", "Constraint"]
solve.StressRecovery = "None"
solve.Solver = "Incomplete Cholesky"
solve.UpdatePipeline()
solve.UpdatePropertyInformation()
check(solve.StopReason == "Converged" and solve.PointData.GetArray("Stress") is None, "settings")
check(solve.PointData["Temperature"].GetRange()[1] == 50, "temperature", solve.PointData["Temperature"].GetRange())

# What was forgotten is said, and nothing crashes.
free = simple.Thermoelastic(Input=simple.Calculator(Input=mesh, ResultArrayName="Temperature", Function="100"))
free.UpdatePipeline()
check(free.GetDataInformation().GetNumberOfCells() == 0, "a result without constraints")
if ranks > 1:
    spread = simple.Tetrahedralize(Input=simple.Wavelet(WholeExtent=[0, 4, 0, 4, 0, 8]))
    check(spread.GetDataInformation() is not None, "no data")
    everywhere = simple.Thermoelastic(Input=spread, TemperatureMode="Uniform", RigidMotion="Pin")
    everywhere.UpdatePipeline()
    check(everywhere.GetDataInformation().GetNumberOfCells() == 0, "a result on pieces")
    together = simple.Thermoelastic(Input=simple.AggregateDataset(Input=spread), TemperatureMode="Uniform", RigidMotion="Pin")
    together.UpdatePipeline()
    check(together.GetDataInformation().GetNumberOfCells() == 640, "aggregated")
print(f"{ranks} ranks: end moves by {longest:.4g}, {solve.NumberOfSolverIterations} iterations")
