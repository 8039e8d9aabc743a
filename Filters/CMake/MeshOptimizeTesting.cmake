# SPDX-License-Identifier: BSD-3-Clause
# One function per kind of test. Each test stands on a line of its own in the CMakeLists.txt of its folder:
#   meshopt_core_test(Mesh/SimplexMeshTest)     Testing/Core/Mesh/SimplexMeshTest.cpp, GoogleTest, no VTK
#   meshopt_cxx_test(TestMeshOptimizeFilter)    Testing/Cxx/TestMeshOptimizeFilter.cxx, GoogleTest, VTK
#   meshopt_python_test(TestMeasures)           Testing/Python/TestMeasures.py, by python3 and by pvpython if there is one
#   meshopt_pvpython_test(TestProxies [PVBATCH] [MPI n] [RENDERS] [LOADS_PLUGIN])   Testing/ParaView/TestProxies.py
# Extra arguments: TIMEOUT seconds; ARGS for the program; SCRIPT where it is not in the folder; PYTHON_ONLY for a Python test without pvpython.

set(MESHOPTIMIZE_DATA_DIR "${PROJECT_SOURCE_DIR}/Data")
set(MESHOPTIMIZE_TEST_OUTPUT_DIR "${CMAKE_BINARY_DIR}/Testing/Output")
file(MAKE_DIRECTORY "${MESHOPTIMIZE_TEST_OUTPUT_DIR}")

set(_plugin_dir "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}/${PARAVIEW_PLUGIN_SUBDIR}/MeshOptimize")
# Where sanitizers read what is known and not ours.
set(_suppressions "${PROJECT_SOURCE_DIR}/Testing/Suppressions")
set(MESHOPTIMIZE_TEST_ENVIRONMENT
  "MESHOPTIMIZE_DATA=set:${MESHOPTIMIZE_DATA_DIR}"
  "MESHOPTIMIZE_OUTPUT=set:${MESHOPTIMIZE_TEST_OUTPUT_DIR}"
  "MESHOPTIMIZE_SOURCE=set:${PROJECT_SOURCE_DIR}"
  "MESHOPTIMIZE_PLUGIN=set:${_plugin_dir}/MeshOptimize.so"
  "PV_PLUGIN_PATH=set:${_plugin_dir}"
  "PYTHONPATH=path_list_prepend:${CMAKE_BINARY_DIR}/${MESHOPTIMIZE_PYTHON_DIR}"
  "OMPI_ALLOW_RUN_AS_ROOT=set:1"
  "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=set:1"
  "OMPI_MCA_mpi_yield_when_idle=set:1"  # more ranks than cores: those that wait must not keep the others from working
  "ASAN_OPTIONS=set:detect_leaks=1"
  "LSAN_OPTIONS=set:suppressions=${_suppressions}/lsan.txt"
  "UBSAN_OPTIONS=set:print_stacktrace=1:suppressions=${_suppressions}/ubsan.txt"
  "TSAN_OPTIONS=set:suppressions=${_suppressions}/tsan.txt")

function (_meshopt_test_properties name label)
  cmake_parse_arguments(arg "" "TIMEOUT" "" ${ARGN})
  if (NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif ()
  set(environment "${MESHOPTIMIZE_TEST_ENVIRONMENT}")
  if (name MATCHES "\\.mpi[0-9]")
    # Open MPI closes its modules before leaks are looked for, and no suppression knows their names then.
    list(APPEND environment "ASAN_OPTIONS=set:detect_leaks=0")
  endif ()
  set_tests_properties("${name}" PROPERTIES
    LABELS "${label}"
    TIMEOUT "${arg_TIMEOUT}"
    ENVIRONMENT_MODIFICATION "${environment}")
endfunction ()

function (meshopt_core_test path)
  cmake_parse_arguments(arg "" "TIMEOUT" "ARGS" ${ARGN})
  get_filename_component(name "${path}" NAME)
  add_executable(${name} "${path}.cpp")
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/Testing/Core")
  target_link_libraries(${name} PRIVATE MeshOptimizeCore MeshOptimizeWarnings GTest::gtest GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE MESHOPTIMIZE_DATA_DIR="${MESHOPTIMIZE_DATA_DIR}")
  add_test(NAME core.${name} COMMAND ${name} ${arg_ARGS})
  _meshopt_test_properties(core.${name} core TIMEOUT ${arg_TIMEOUT})
endfunction ()

function (meshopt_cxx_test name)
  cmake_parse_arguments(arg "" "TIMEOUT" "ARGS" ${ARGN})
  add_executable(${name} "${name}.cxx")
  target_link_libraries(${name} PRIVATE ${meshoptimize_modules} MeshOptimizeWarnings GTest::gtest GTest::gtest_main)
  foreach (module IN LISTS _meshoptimize_vtk_required _meshoptimize_vtk_optional)
    if (TARGET VTK::${module} AND NOT module MATCHES "Python|TestingCore")
      target_link_libraries(${name} PRIVATE VTK::${module})
    endif ()
  endforeach ()
  target_compile_definitions(${name} PRIVATE MESHOPTIMIZE_DATA_DIR="${MESHOPTIMIZE_DATA_DIR}")
  add_test(NAME filters.${name} COMMAND ${name} ${arg_ARGS})
  _meshopt_test_properties(filters.${name} filters TIMEOUT ${arg_TIMEOUT})
endfunction ()

function (meshopt_python_test name)
  cmake_parse_arguments(arg "PYTHON_ONLY" "TIMEOUT;SCRIPT" "ARGS" ${ARGN})
  set(script "${CMAKE_CURRENT_SOURCE_DIR}/${name}.py")
  if (arg_SCRIPT)
    set(script "${arg_SCRIPT}")
  endif ()
  add_test(NAME python.${name} COMMAND "${Python3_EXECUTABLE}" "${script}" ${arg_ARGS})
  _meshopt_test_properties(python.${name} python TIMEOUT ${arg_TIMEOUT})
  if (MESHOPTIMIZE_WITH_PARAVIEW AND NOT arg_PYTHON_ONLY)
    add_test(NAME pvpython.${name} COMMAND "${MESHOPTIMIZE_PVPYTHON}" "${script}" ${arg_ARGS})
    _meshopt_test_properties(pvpython.${name} python TIMEOUT ${arg_TIMEOUT})
  endif ()
endfunction ()

function (meshopt_pvpython_test name)
  cmake_parse_arguments(arg "PVBATCH;RENDERS;LOADS_PLUGIN" "MPI;TIMEOUT;SCRIPT;SUFFIX" "ARGS" ${ARGN})
  set(script "${CMAKE_CURRENT_SOURCE_DIR}/${name}.py")
  if (arg_SCRIPT)
    set(script "${arg_SCRIPT}")
  endif ()
  set(test paraview.${name}${arg_SUFFIX})
  set(command "${MESHOPTIMIZE_PVPYTHON}")
  if (arg_PVBATCH)
    string(APPEND test .pvbatch)
    set(command "${MESHOPTIMIZE_PVBATCH}")
  endif ()
  if (arg_MPI)
    string(APPEND test .mpi${arg_MPI})
    set(command "${MESHOPTIMIZE_MPIRUN}" --oversubscribe -np ${arg_MPI} "${MESHOPTIMIZE_PVBATCH}")
  endif ()
  add_test(NAME ${test} COMMAND ${command} "${script}" ${arg_ARGS})
  _meshopt_test_properties(${test} paraview TIMEOUT ${arg_TIMEOUT})
  if (arg_LOADS_PLUGIN)  # by LoadPlugin(), not by PV_PLUGIN_PATH
    set_property(TEST ${test} APPEND PROPERTY ENVIRONMENT_MODIFICATION "PV_PLUGIN_PATH=unset:")
  endif ()
  if (arg_RENDERS)  # software rendering: not two at a time on a small machine
    set_tests_properties(${test} PROPERTIES RESOURCE_LOCK display)
  endif ()
endfunction ()

if (MESHOPTIMIZE_WITH_PARAVIEW)
  find_program(MESHOPTIMIZE_PVPYTHON pvpython REQUIRED)
  find_program(MESHOPTIMIZE_PVBATCH pvbatch REQUIRED)
  find_program(MESHOPTIMIZE_MPIRUN NAMES mpirun.openmpi mpirun REQUIRED)
endif ()
