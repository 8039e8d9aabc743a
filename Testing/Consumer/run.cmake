# SPDX-License-Identifier: BSD-3-Clause
# Installs BUILD into WORK/install, builds CONSUMER against it, runs its programs.
function (step)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result)
  if (result)
    message(FATAL_ERROR "failed (${result}): ${ARGN}")
  endif ()
endfunction ()

file(REMOVE_RECURSE "${WORK}")
file(MAKE_DIRECTORY "${WORK}")
step("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${WORK}/install")
set(flags "${FLAGS}")
if (SANITIZE)
  string(APPEND flags " -fsanitize=${SANITIZE}")
endif ()
step("${CMAKE_COMMAND}" -G "${GENERATOR}" -S "${CONSUMER}" -B "${WORK}/build"
  "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_FLAGS=${flags}" -DCMAKE_BUILD_TYPE=Release
  "-DMeshOptimize_DIR=${WORK}/install/${LIBDIR}/cmake/MeshOptimize")
step("${CMAKE_COMMAND}" --build "${WORK}/build")
step("${WORK}/build/consumer")
step("${WORK}/build/adapt")
