# SPDX-License-Identifier: BSD-3-Clause
"""A pvserver of several ranks and pvpython as its client: the borders take part, figures come back, ghosts are made on request.

    pvpython TestClientServerRanks.py RANKS
"""
import os
import sys

from paraview import simple
from paraview_case import DATA, check, pvserver

ranks = int(sys.argv[1])
# What MPI has set for the client is not for the server, which would take itself for a part of the client's run.
environment = {k: v for k, v in os.environ.items() if not k.startswith(("OMPI_", "PMIX_", "ORTE_"))}
environment.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_mpi_yield_when_idle="1")
mpirun = os.environ.get("MESHOPTIMIZE_MPIRUN", "mpirun.openmpi")
with pvserver(mpirun, "--oversubscribe", "-np", str(ranks), environment=environment):
    mesh = simple.XMLUnstructuredGridReader(FileName=[DATA + "/crack40.vtu"])
    optimized = simple.MeshOptimize(Input=mesh, OptimizeBorders=1)
    optimized.UpdatePipeline()
    optimized.UpdatePropertyInformation()
    print("worst", optimized.WorstQualityBefore, "->", optimized.WorstQualityAfter, optimized.StopReason)
    # One rank ends at .3654; with the borders kept they stay far below.
    check(optimized.WorstQualityAfter > 0.36, "not as good as one rank:", optimized.WorstQualityAfter)
    # The pieces of all ranks, each with a share.
    numbered = simple.ProcessIds(Input=optimized) if hasattr(simple, "ProcessIds") else simple.ProcessIdScalars(Input=optimized)
    numbered.UpdatePipeline()
    name = next(n for n in numbered.PointData.keys() if n in ("PointProcessIds", "ProcessId"))
    check(tuple(numbered.PointData[name].GetRange()) == (0, ranks - 1), "not on all ranks", numbered.PointData[name].GetRange())
    measured = simple.MeshQualityMinMax(Input=optimized)
    measured.UpdatePipeline()
    measured.UpdatePropertyInformation()
    check(abs(measured.MinimumQuality - optimized.WorstQualityAfter) < 1e-12, "measured", measured.MinimumQuality)
    check(abs(measured.QualityBound - optimized.QualityBound) < 1e-6, "bound", measured.QualityBound, optimized.QualityBound)
    mean = measured.MeanQuality
    optimized.NumberOfGhostLevels = 1
    measured.UpdatePipeline()
    measured.UpdatePropertyInformation()
    check(abs(measured.MeanQuality - mean) < 1e-12, "ghosts were counted", measured.MeanQuality, mean)
    optimized.UpdatePipeline()
    check("vtkGhostType" in optimized.CellData.keys(), "no ghosts", optimized.CellData.keys())
    check(abs(measured.QualityBound - optimized.QualityBound) < 1e-6, "bound with ghosts", measured.QualityBound)
