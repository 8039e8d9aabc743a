# The Python package "meshoptimize": one wrapped extension per VTK module, and an __init__ that names the classes.
set(MESHOPTIMIZE_PYTHON_BUILD_DIR "${CMAKE_BINARY_DIR}/${MESHOPTIMIZE_PYTHON_DIR}")
vtk_module_wrap_python(
  MODULES ${meshoptimize_modules}
  TARGET MeshOptimize::Python
  PYTHON_PACKAGE meshoptimize
  MODULE_DESTINATION "${MESHOPTIMIZE_PYTHON_DIR}"
  LIBRARY_DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  INSTALL_HEADERS OFF)
configure_file(
  "${PROJECT_SOURCE_DIR}/Filters/MeshOptimize/Python/__init__.py"
  "${MESHOPTIMIZE_PYTHON_BUILD_DIR}/meshoptimize/__init__.py" COPYONLY)
install(
  FILES "${PROJECT_SOURCE_DIR}/Filters/MeshOptimize/Python/__init__.py"
  DESTINATION "${MESHOPTIMIZE_PYTHON_DIR}/meshoptimize"
  COMPONENT python)
