# Debian 13 installs the Python modules of ParaView and its VTK as vtkX.cpython-313-x86_64-linux-gnu.so; its CMake packages name
# vtkX.so all the same, and find_package() stops: "references the file ... but this file does not exist". Other packages are right.
#
#   meshoptimize_python_targets(FOLDER PREFIX)    before find_package() reads the package in FOLDER, installed under PREFIX
#
# Where that fault is found, copies of the package's files about these modules are written into the build folder, with the names
# that exist, and read. The package's own files then find their targets defined, and leave it at that. The system stays as it is.
function (meshoptimize_python_targets folder prefix)
  set(copies "${CMAKE_BINARY_DIR}/CMakeFiles/MeshOptimizePythonTargets")
  file(GLOB location_files "${folder}/*Python*-targets-*.cmake")  # an export set and configuration each
  foreach (location_file IN LISTS location_files)
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
      get_filename_component(location_name "${location_file}" NAME)
      string(REGEX REPLACE "-targets-.*" "-targets.cmake" targets_name "${location_name}")
      file(READ "${folder}/${targets_name}" targets)
      # The package looks for its prefix from its own place, which is not that of the copy.
      string(REPLACE "\${CMAKE_CURRENT_LIST_FILE}" "${folder}/${targets_name}" targets "${targets}")
      file(WRITE "${copies}/${targets_name}" "${targets}")
      file(WRITE "${copies}/${location_name}" "${corrected}")
      include("${copies}/${targets_name}")
    endif ()
  endforeach ()
endfunction ()
