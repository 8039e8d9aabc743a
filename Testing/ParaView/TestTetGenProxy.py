# SPDX-License-Identifier: BSD-3-Clause
"""Tetrahedralize (TetGen) by its proxy: without and with interior points, regions, holes; what a state file carries."""
from paraview import servermanager, simple

from paraview_case import check, load_plugin

load_plugin()


def cells_of(proxy):
    proxy.UpdatePipeline()
    return proxy.GetDataInformation().GetNumberOfCells()


outer = simple.Sphere(Radius=1.0, ThetaResolution=16, PhiResolution=16)
inner = simple.Sphere(Radius=0.4, ThetaResolution=16, PhiResolution=16)
both = simple.AppendGeometry(Input=[outer, inner])
tetgen = simple.TetrahedralizeTetGen(Input=both)
check(tetgen.KeepSurface == 1 and tetgen.OptimizationLevel == 2 and tetgen.MaximumVolume == 0, "defaults")
check(tetgen.InteriorPoints is None and len(tetgen.Regions) == 0 and len(tetgen.Holes) == 0, "nothing grabbed")
plain = cells_of(tetgen)
check(plain > 100, "cells", plain)
check(tetgen.CellData["Region"].GetRange() == (1.0, 2.0), "two compartments", tetgen.CellData["Region"].GetRange())

tetgen.MaximumVolume = 0.002
check(cells_of(tetgen) > 1.2 * plain, "finer", plain, cells_of(tetgen))
tetgen.MaximumVolume = 0
tetgen.Regions = [0, 0, 0, 7, 0, 0, 0, 0.7, -3, 0.001]
fine = cells_of(tetgen)
check(fine > 1.5 * plain, "finer in one region", fine)
check(tetgen.CellData["Region"].GetRange() == (-3.0, 7.0), "regions", tetgen.CellData["Region"].GetRange())
tetgen.Regions = []
tetgen.Holes = [0, 0, 0]
hollow = cells_of(tetgen)
check(tetgen.CellData["Region"].GetRange() == (1.0, 1.0), "a hole", tetgen.CellData["Region"].GetRange())
tetgen.Holes = []
check(cells_of(tetgen) == plain and hollow < plain, "the hole is filled again", plain, hollow)

nodes = simple.Sphere(Radius=0.2)
tetgen.InteriorPoints = nodes
tetgen.OptimizationLevel = 0
check(cells_of(tetgen) > plain + 100, "interior points", plain, cells_of(tetgen))

quality = simple.MeshQualityMinMax(Input=simple.MeshOptimize(Input=tetgen, TargetQuality=0.2))
quality.UpdatePipeline()
check(servermanager.Fetch(quality, idx=0).GetNumberOfCells() > 0, "the pipeline goes on")
