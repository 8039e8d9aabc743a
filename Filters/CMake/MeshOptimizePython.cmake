# SPDX-License-Identifier: BSD-3-Clause
# The Python package "meshoptimize": one wrapped extension per VTK module, the files of Filters/MeshOptimize/Python, and the
# commands mesh-optimize and mesh-quality.
set(MESHOPTIMIZE_PYTHON_BUILD_DIR "${CMAKE_BINARY_DIR}/${MESHOPTIMIZE_PYTHON_DIR}")
vtk_module_wrap_python(
  MODULES ${meshoptimize_modules}
  TARGET MeshOptimize::Python
  PYTHON_PACKAGE meshoptimize
  MODULE_DESTINATION "${MESHOPTIMIZE_PYTHON_DIR}"
  LIBRARY_DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  INSTALL_HEADERS OFF)
set(_source "${PROJECT_SOURCE_DIR}/Filters/MeshOptimize/Python")
set(_package "${MESHOPTIMIZE_PYTHON_BUILD_DIR}/meshoptimize")
file(GLOB _python_files RELATIVE "${_source}" CONFIGURE_DEPENDS "${_source}/*.py" "${_source}/*.pyi" "${_source}/py.typed")
foreach (_file IN LISTS _python_files)
  configure_file("${_source}/${_file}" "${_package}/${_file}" COPYONLY)
  install(FILES "${_source}/${_file}" DESTINATION "${MESHOPTIMIZE_PYTHON_DIR}/meshoptimize" COMPONENT python)
endforeach ()
# Which VTK it is built with: __init__.py refuses another.
configure_file("${_source}/_built_with.py.in" "${_package}/_built_with.py" @ONLY)
install(FILES "${_package}/_built_with.py" DESTINATION "${MESHOPTIMIZE_PYTHON_DIR}/meshoptimize" COMPONENT python)

# The commands find the package by its place beside them, in the build tree and where it is installed.
file(RELATIVE_PATH package_from_command "/${CMAKE_INSTALL_BINDIR}" "/${MESHOPTIMIZE_PYTHON_DIR}")
foreach (command IN ITEMS mesh-optimize mesh-quality)
  string(REPLACE "-" "_" function "${command}")
  configure_file("${_source}/command.py.in" "${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/${command}" @ONLY
    FILE_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
  install(PROGRAMS "${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/${command}" DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT python)
endforeach ()

# pip install BUILD/python: a wheel of what is built.
foreach (_file IN ITEMS pyproject.toml backend.py)
  configure_file("${_source}/Wheel/${_file}.in" "${CMAKE_BINARY_DIR}/python/${_file}" @ONLY)
endforeach ()
# Debian's Python looks into lib/python3/dist-packages of /usr: there it reads where the package is.
set(_pth "${CMAKE_BINARY_DIR}/python/meshoptimize.pth")
file(RELATIVE_PATH _package_from_pth "/lib/python3/dist-packages" "/${MESHOPTIMIZE_PYTHON_DIR}")
file(WRITE "${_pth}" "${_package_from_pth}\n")
install(FILES "${_pth}" DESTINATION lib/python3/dist-packages COMPONENT python)
