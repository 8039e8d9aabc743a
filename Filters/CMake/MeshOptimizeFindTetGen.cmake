# SPDX-License-Identifier: BSD-3-Clause
# Decides whether the module Filters/TetGen is built, and says so: TetGen is under the AGPL, all the rest is not.
#
# MESHOPTIMIZE_WITH_TETGEN  ON by default. Without TetGen (Debian: libtet1.5-dev) or fork() it is off all the same.
option(MESHOPTIMIZE_WITH_TETGEN "Build vtkTetGenFilter, which links TetGen (AGPL)" ON)
if (MESHOPTIMIZE_WITH_TETGEN)
  find_package(TetGen QUIET)
  if (NOT UNIX)
    set(MESHOPTIMIZE_WITH_TETGEN OFF)
    message(STATUS "MeshOptimize: no vtkTetGenFilter: it needs fork()")
  elseif (NOT TetGen_FOUND)
    set(MESHOPTIMIZE_WITH_TETGEN OFF)
    message(STATUS "MeshOptimize: no vtkTetGenFilter: TetGen (libtet1.5-dev) was not found")
  else ()
    message(STATUS "MeshOptimize: vtkTetGenFilter with TetGen (${TETGEN_LIBRARY}), which is under the AGPL; "
      "-DMESHOPTIMIZE_WITH_TETGEN=OFF leaves it out")
  endif ()
endif ()
