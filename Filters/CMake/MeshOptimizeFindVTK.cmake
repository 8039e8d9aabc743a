# SPDX-License-Identifier: BSD-3-Clause
# Finds ParaView with its own VTK (then the plugin is built) or, without ParaView, a VTK.
#
# MESHOPTIMIZE_WITH_PARAVIEW  ON by default when ParaView >= 5.11 is found. OFF: plain VTK >= 9.1 (VTK_DIR).
# MESHOPTIMIZE_WITH_PYTHON    ON by default when that VTK wraps Python.

include(MeshOptimizePythonTargets)

# A python3 that comes first on the PATH is often not the one VTK was built with.
if (NOT Python3_EXECUTABLE AND EXISTS "/usr/bin/python3")
  set(Python3_EXECUTABLE "/usr/bin/python3" CACHE FILEPATH "The Python that VTK was built with")
endif ()

# Everything that a vtk.module here names in DEPENDS, PRIVATE_DEPENDS or TEST_DEPENDS.
set(_meshoptimize_vtk_required
  CommonCore CommonDataModel CommonExecutionModel CommonMath CommonSystem FiltersCore ParallelCore)
# What the wrapping and the tests take when it is there.
set(_meshoptimize_vtk_optional
  Python WrappingPythonCore PythonInterpreter FiltersGeneral FiltersExtraction FiltersSources
  FiltersVerdict IOXML IOParallelXML IOLegacy ParallelMPI TestingCore)

if (NOT DEFINED MESHOPTIMIZE_WITH_PARAVIEW OR MESHOPTIMIZE_WITH_PARAVIEW)
  set(_required QUIET)
  if (MESHOPTIMIZE_WITH_PARAVIEW)
    set(_required REQUIRED)
  endif ()
  meshoptimize_python_targets(ParaView)
  # Bare find_package(ParaView) would ask for every Qt component: name what a plugin needs.
  find_package(ParaView 5.11 ${_required} COMPONENTS
    RemotingCore RemotingServerManager RemotingClientServerStream VTKExtensionsCore PythonInitializer)
endif ()
option(MESHOPTIMIZE_WITH_PARAVIEW "Build against ParaView, and its plugin" ${ParaView_FOUND})

meshoptimize_python_targets(VTK)
find_package(VTK 9.1 REQUIRED
  COMPONENTS ${_meshoptimize_vtk_required}
  OPTIONAL_COMPONENTS ${_meshoptimize_vtk_optional})

set(_wrap_python OFF)
if (TARGET VTK::WrappingPythonCore AND TARGET VTK::WrapPython)
  set(_wrap_python ON)
endif ()
option(MESHOPTIMIZE_WITH_PYTHON "Wrap the filters in Python" ${_wrap_python})
if (MESHOPTIMIZE_WITH_PYTHON)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
endif ()

if (MESHOPTIMIZE_WITH_PARAVIEW)
  message(STATUS "MeshOptimize: ParaView ${ParaView_VERSION} with its VTK ${VTK_VERSION}")
else ()
  message(STATUS "MeshOptimize: VTK ${VTK_VERSION}, no ParaView")
endif ()
