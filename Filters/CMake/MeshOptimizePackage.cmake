# SPDX-License-Identifier: BSD-3-Clause
# The CMake package of the install tree: find_package(MeshOptimize) gives MeshOptimize::FiltersMeshOptimize.
include(CMakePackageConfigHelpers)

vtk_module_export_find_packages(
  CMAKE_DESTINATION "${MESHOPTIMIZE_CMAKE_DIR}"
  FILE_NAME MeshOptimize-vtk-module-find-packages.cmake
  MODULES ${meshoptimize_modules})
configure_package_config_file(
  "${CMAKE_CURRENT_LIST_DIR}/MeshOptimizeConfig.cmake.in"
  "${CMAKE_BINARY_DIR}/${MESHOPTIMIZE_CMAKE_DIR}/MeshOptimizeConfig.cmake"
  INSTALL_DESTINATION "${MESHOPTIMIZE_CMAKE_DIR}")
write_basic_package_version_file(
  "${CMAKE_BINARY_DIR}/${MESHOPTIMIZE_CMAKE_DIR}/MeshOptimizeConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(
  FILES
    "${CMAKE_BINARY_DIR}/${MESHOPTIMIZE_CMAKE_DIR}/MeshOptimizeConfig.cmake"
    "${CMAKE_BINARY_DIR}/${MESHOPTIMIZE_CMAKE_DIR}/MeshOptimizeConfigVersion.cmake"
    "${CMAKE_CURRENT_LIST_DIR}/MeshOptimizePythonTargets.cmake"
  DESTINATION "${MESHOPTIMIZE_CMAKE_DIR}"
  COMPONENT development)
