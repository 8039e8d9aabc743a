# SPDX-License-Identifier: BSD-3-Clause
# Debian 13 installs the Python modules of ParaView and its VTK as vtkX.cpython-313-x86_64-linux-gnu.so; its CMake packages name
# vtkX.so all the same, and find_package() stops: "references the file ... but this file does not exist". Other packages are right.
#
#   meshoptimize_python_targets(PACKAGE)    before find_package(PACKAGE), which is ParaView or VTK
#
# Where that fault is found, copies of the package's files about these modules are written into the build folder, with the names
# that exist, and read. The package's own files then find their targets defined, and leave it at that. The system stays as it is.
function (meshoptimize_python_targets package)
  # Where the package is, without reading it: this file of it says where it is installed, and no more.
  set(place "MeshOptimize${package}Place")
  string(TOLOWER "${package}" lower)
  find_package(${place} QUIET NAMES ${package} CONFIGS ${lower}-prefix.cmake
    HINTS ${${package}_DIR} ${${package}_ROOT} $ENV{${package}_DIR} $ENV{${package}_ROOT})
  set(folder "${${place}_DIR}")
  unset(${place}_DIR CACHE)
  if (NOT ${place}_FOUND)
    return()
  endif ()

  set(prefix "${_vtk_module_import_prefix}")
  set(copies "${CMAKE_BINARY_DIR}/CMakeFiles/MeshOptimizePythonTargets")
  file(GLOB of_vtk "${folder}/vtk/*Python*-targets-*.cmake")  # ParaView's VTK, which comes first
  file(GLOB of_package "${folder}/*Python*-targets-*.cmake")
  foreach (location_file IN LISTS of_vtk of_package)
    file(READ "${location_file}" locations)
    set(corrected "${locations}")
    string(REGEX MATCHALL "/[^\"]+\\.so\"" modules "${locations}")
    list(REMOVE_DUPLICATES modules)
    foreach (quoted IN LISTS modules)
      string(REGEX REPLACE "\\.so\"$" "" module "${quoted}")
      file(GLOB existing RELATIVE "${prefix}" "${prefix}${module}.*.so")
      if (existing AND NOT EXISTS "${prefix}${module}.so")
        string(REPLACE "${quoted}" "/${existing}\"" corrected "${corrected}")
      endif ()
    endforeach ()
    if (NOT corrected STREQUAL locations)
      string(REGEX REPLACE "-targets-[^/]*$" "-targets.cmake" targets_file "${location_file}")
      file(READ "${targets_file}" targets)
      # It looks for the prefix from its own place, which is not that of the copy.
      string(REPLACE "\${CMAKE_CURRENT_LIST_FILE}" "${targets_file}" targets "${targets}")
      get_filename_component(location_name "${location_file}" NAME)
      get_filename_component(targets_name "${targets_file}" NAME)
      file(WRITE "${copies}/${location_name}" "${corrected}")
      file(WRITE "${copies}/${targets_name}" "${targets}")
      include("${copies}/${targets_name}")
    endif ()
  endforeach ()
endfunction ()
