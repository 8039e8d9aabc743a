# SPDX-License-Identifier: BSD-3-Clause
# `cpack` in the build folder makes a Debian package and a .tar.gz of all that is installed: plugin, modules, headers, the CMake
# package, the Python package and the commands. Testing/Package unpacks and uses them.
set(_doc "${CMAKE_INSTALL_DATAROOTDIR}/doc/meshoptimize")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${_doc}" RENAME copyright COMPONENT documentation)
install(FILES "${PROJECT_SOURCE_DIR}/CHANGELOG.md" DESTINATION "${_doc}" COMPONENT documentation)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/ParaViewPlugin/Examples" DESTINATION "${_doc}" COMPONENT documentation
  PATTERN "__pycache__" EXCLUDE)
if (MESHOPTIMIZE_WITH_TETGEN)  # its licence is another
  install(FILES "${PROJECT_SOURCE_DIR}/Filters/TetGen/README.md" DESTINATION "${_doc}" RENAME TetGen.md
    COMPONENT documentation)
endif ()

set(CPACK_PACKAGE_NAME "meshoptimize")
set(CPACK_PACKAGE_VENDOR "the MeshOptimize authors")
set(CPACK_PACKAGE_CONTACT "the MeshOptimize authors <nobody@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Raises the worst element quality of triangle and tetrahedral meshes")
set(CPACK_PACKAGE_DESCRIPTION "A plugin for ParaView, a VTK module, a Python package and the commands mesh-optimize and mesh-quality.")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_RESOURCE_FILE_README "${PROJECT_SOURCE_DIR}/README.md")
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_GENERATOR TGZ)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_FILE_NAME "meshoptimize-${PROJECT_VERSION}-${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR}")

find_program(MESHOPTIMIZE_DPKG dpkg)
mark_as_advanced(MESHOPTIMIZE_DPKG)
if (MESHOPTIMIZE_DPKG)
  list(PREPEND CPACK_GENERATOR DEB)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_PACKAGE_SUGGESTS "paraview-dev, libeigen3-dev, cmake, python3-tqdm")
  set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-meshio, xvfb")
  # The plugin and the modules fit the ParaView, the VTK and the Python that they were built with, and no others.
  set(_depends)
  if (MESHOPTIMIZE_WITH_PARAVIEW)
    math(EXPR _next "${ParaView_VERSION_MINOR} + 1")
    foreach (_package IN ITEMS paraview python3-paraview)
      list(APPEND _depends
        "${_package} (>= ${ParaView_VERSION_MAJOR}.${ParaView_VERSION_MINOR})" "${_package} (<< ${ParaView_VERSION_MAJOR}.${_next}~)")
    endforeach ()
  endif ()
  if (MESHOPTIMIZE_WITH_PYTHON)
    math(EXPR _next "${Python3_VERSION_MINOR} + 1")
    list(APPEND _depends "python3-numpy"
      "python3 (>= ${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR})" "python3 (<< ${Python3_VERSION_MAJOR}.${_next}~)")
  endif ()
  # dpkg-shlibdeps (of dpkg-dev) finds what the libraries need. Without it: what they need on Debian 12 and 13.
  find_program(MESHOPTIMIZE_SHLIBDEPS dpkg-shlibdeps)
  mark_as_advanced(MESHOPTIMIZE_SHLIBDEPS)
  if (MESHOPTIMIZE_SHLIBDEPS AND MESHOPTIMIZE_WITH_PARAVIEW)  # a plain VTK may be no package
    set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
    set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")
  else ()
    list(APPEND _depends libc6 libstdc++6)
    if (MESHOPTIMIZE_WITH_TETGEN)
      list(APPEND _depends libtet1.5)
    endif ()
  endif ()
  list(JOIN _depends ", " CPACK_DEBIAN_PACKAGE_DEPENDS)
endif ()
include(CPack)
