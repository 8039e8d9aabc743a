# SPDX-License-Identifier: BSD-3-Clause
# MESHOPTIMIZE_WITH_WINDOW   What the plugin has for ParaView's window is built: icons, help, and the way to the toolbar. On by
#                            default where ParaView has a window. OFF: a plugin without Qt, for servers; filters and proxies only.
# MESHOPTIMIZE_WITH_TOOLBAR  The toolbar in ParaView's window is built: on by default where the window is, and the headers of the
#                            widgets that it is made of are installed. Nothing else needs them.
set(_has_window OFF)
if (MESHOPTIMIZE_WITH_PARAVIEW AND PARAVIEW_USE_QT)
  set(_has_window ON)
endif ()
option(MESHOPTIMIZE_WITH_WINDOW "Build what the plugin has for ParaView's window" ${_has_window})
set(_has_widgets OFF)
if (MESHOPTIMIZE_WITH_WINDOW AND TARGET VTK::PythonInterpreter)
  set(_qt Qt5)  # ParaView 5.11 does not say
  if (PARAVIEW_QT_MAJOR_VERSION)
    set(_qt "Qt${PARAVIEW_QT_MAJOR_VERSION}")
  endif ()
  find_package(${_qt} QUIET COMPONENTS Widgets)
  set(_has_widgets "${${_qt}_FOUND}")
  set(MESHOPTIMIZE_QT_WIDGETS "${_qt}::Widgets")
endif ()
option(MESHOPTIMIZE_WITH_TOOLBAR "Build the toolbar for ParaView's window" ${_has_widgets})
if (NOT MESHOPTIMIZE_WITH_WINDOW)
  set(MESHOPTIMIZE_WITH_TOOLBAR OFF)
endif ()
