# SPDX-License-Identifier: BSD-3-Clause
"""pvbatch, alone or with several ranks: one minimum and maximum over all ranks, and each rank optimizes its piece."""
from paraview import servermanager, simple

from paraview_case import check, load_plugin

load_plugin()
ranks = servermanager.vtkProcessModule.GetProcessModule().GetNumberOfLocalPartitions()
# A source that exists on every rank (a mesh made in the script would sit on rank 0 only).
wavelet = simple.Wavelet(WholeExtent=[-6, 6, -6, 6, -6, 6])
tetrahedra = simple.Tetrahedralize(Input=wavelet)
warped = simple.Calculator(
    Input=tetrahedra, CoordinateResults=1,
    Function="(coordsX+0.35*sin(5*coordsY))*iHat+(coordsY+0.3*sin(4*coordsZ))*jHat+(coordsZ+0.3*sin(6*coordsX))*kHat")
quality = simple.MeshQualityMinMax(Input=warped)
quality.UpdatePipeline()
quality.UpdatePropertyInformation()
low, high = quality.CellData["MeshQuality"].GetRange()  # gathered over ranks by ParaView itself
check(abs(low - quality.MinimumQuality) < 1e-6, "minimum over ranks", low, quality.MinimumQuality)
check(abs(high - quality.MaximumQuality) < 1e-6, "maximum over ranks", high, quality.MaximumQuality)
optimize = simple.MeshOptimize(Input=warped)
optimize.UpdatePipeline()
optimize.UpdatePropertyInformation()
after = simple.MeshQualityMinMax(Input=optimize)
after.UpdatePipeline()
after.UpdatePropertyInformation()
check(after.MinimumQuality >= low, "worst fell", low, after.MinimumQuality)
print(f"{ranks} ranks: worst {low:.4f} -> {after.MinimumQuality:.4f}")
