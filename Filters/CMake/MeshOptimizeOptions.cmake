# SPDX-License-Identifier: BSD-3-Clause
# Language, build type, warnings, sanitizers and output folders: what holds for every target.

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

option(BUILD_SHARED_LIBS "Build the VTK modules as shared libraries" ON)
if (NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif ()

find_program(MESHOPTIMIZE_CCACHE ccache)
mark_as_advanced(MESHOPTIMIZE_CCACHE)
if (MESHOPTIMIZE_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${MESHOPTIMIZE_CCACHE}")
endif ()

# The compiler collects its garbage later: up to a sixth less time for the long sources, and at most 1 GB for each.
if (CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options(--param=ggc-min-heapsize=1000000)
endif ()

set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_BINDIR}")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}")
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}")
file(RELATIVE_PATH _rpath "/${CMAKE_INSTALL_BINDIR}" "/${CMAKE_INSTALL_LIBDIR}")
list(APPEND CMAKE_INSTALL_RPATH "$ORIGIN" "$ORIGIN/${_rpath}")

set(MESHOPTIMIZE_SANITIZE "" CACHE STRING "Sanitizers, e.g. address or undefined or thread; empty: none")
option(MESHOPTIMIZE_COVERAGE "Compile for gcov" OFF)
option(MESHOPTIMIZE_WERROR "Treat warnings as errors" OFF)
if (MESHOPTIMIZE_SANITIZE)
  add_compile_options(-fsanitize=${MESHOPTIMIZE_SANITIZE} -fno-omit-frame-pointer -g)
  add_link_options(-fsanitize=${MESHOPTIMIZE_SANITIZE})
  if (MESHOPTIMIZE_SANITIZE MATCHES "undefined")
    add_compile_options(-fno-sanitize=vptr -fno-sanitize-recover=undefined)
  endif ()
endif ()
if (UNIX AND NOT APPLE AND NOT MESHOPTIMIZE_SANITIZE)
  # A symbol that is missing fails the build, not the first user.
  set(CMAKE_SHARED_LINKER_FLAGS "${CMAKE_SHARED_LINKER_FLAGS} -Wl,--no-undefined")
endif ()
if (MESHOPTIMIZE_COVERAGE)
  add_compile_options(--coverage -g)
  add_link_options(--coverage)
endif ()

# Warnings are asked for on our own targets only: VTK's generated wrappers are not ours to mend.
add_library(MeshOptimizeWarnings INTERFACE)
target_compile_options(MeshOptimizeWarnings INTERFACE
  $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Wall -Wextra>
  $<$<BOOL:${MESHOPTIMIZE_WERROR}>:-Werror>)

# For a whole build, which then costs a quarter less: headers of others that most sources read are read once, and several
# sources are compiled together. Off by default, since a source that forgets a header compiles all the same, since after an
# edit its neighbours are compiled, too, and since ccache does not keep what is compiled so.
option(MESHOPTIMIZE_COMPILE_TOGETHER "Compile several sources at a time, with precompiled headers" OFF)
set(meshoptimize_precompiled
  <Eigen/Cholesky> <Eigen/Core> <Eigen/Eigenvalues> <Eigen/Geometry> <Eigen/LU>
  <algorithm> <array> <cmath> <functional> <map> <memory> <numeric> <optional> <string> <thread> <unordered_map> <vector>)
# REUSE_FROM another target, or headers beside those above.
function (meshoptimize_compile_together target)
  if (MESHOPTIMIZE_COMPILE_TOGETHER)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 6)
    # Of a source that another one includes GCC thinks that several may: nameless namespaces then seem to be a mistake.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
    if ("${ARGV1}" STREQUAL "REUSE_FROM")
      target_precompile_headers(${target} ${ARGN})
    else ()
      target_precompile_headers(${target} PRIVATE ${ARGN} ${meshoptimize_precompiled})
    endif ()
  endif ()
endfunction ()
