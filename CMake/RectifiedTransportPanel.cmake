# SPDX-License-Identifier: BSD-3-Clause
# Whether the plugin has widgets of its own on ParaView's panel, and what these are linked to.

set(qt_version 5)
if (PARAVIEW_QT_MAJOR_VERSION)
  set(qt_version "${PARAVIEW_QT_MAJOR_VERSION}")
endif ()
set(missing)
# Qt 6 would walk all folders for its scripts of deployment, which nobody needs here, and never return
# from the root: vtk_module_build adds that to itself.
set_property(GLOBAL PROPERTY _qt_have_generated_deploy_support TRUE)
find_package("Qt${qt_version}" QUIET COMPONENTS Widgets)
if (NOT TARGET "Qt${qt_version}::Widgets")
  set(qt_package "qt${qt_version}-base-dev")
  if (qt_version EQUAL 5)
    set(qt_package qtbase5-dev)
  endif ()
  list(APPEND missing "Qt ${qt_version}'s Widgets (Debian: ${qt_package})")
endif ()
if (NOT TARGET ParaView::pqComponents)
  list(APPEND missing "a ParaView with its window")
endif ()
find_path(RectifiedTransport_VTK_QT_HEADERS vtkEventQtSlotConnect.h
  PATHS "${ParaView_PREFIX_PATH}/include" NO_DEFAULT_PATH
  PATH_SUFFIXES "paraview-${ParaView_VERSION_MAJOR}.${ParaView_VERSION_MINOR}"
    "vtk-${VTK_MAJOR_VERSION}.${VTK_MINOR_VERSION}"
  DOC "VTK's headers for Qt, which the widgets on ParaView's panel include")
mark_as_advanced(RectifiedTransport_VTK_QT_HEADERS)
if (NOT RectifiedTransport_VTK_QT_HEADERS)
  list(APPEND missing "VTK's headers for Qt (Debian: libvtk9-qt-dev)")
endif ()
string(REPLACE ";" ", " missing "${missing}")
set(has_panel ON)
if (missing)
  set(has_panel OFF)
endif ()
option(RectifiedTransport_BUILD_PANEL
  "Build the plugin's own widgets on ParaView's panel, which need Qt's development files"
  "${has_panel}")
if (RectifiedTransport_BUILD_PANEL)
  if (missing)
    message(FATAL_ERROR "RectifiedTransport_BUILD_PANEL is on, but these are missing: ${missing}. "
      "Install them, or turn it off.")
  endif ()
  # No widget includes the headers of all that ParaView's client is made of.
  set(panel_libraries ParaView::pqApplicationComponents ParaView::pqComponents ParaView::pqCore
    ParaView::pqWidgets ParaView::qttesting)
  foreach (library IN LISTS panel_libraries)
    set_target_properties("${library}" PROPERTIES
      INTERFACE_LINK_LIBRARIES "Qt${qt_version}::Widgets;ParaView::RemotingViews")
  endforeach ()
  rectified_transport_forget_private(${panel_libraries})
elseif (missing)
  message(STATUS "RectifiedTransport: no widgets of its own on ParaView's panel, for these are missing: "
    "${missing}. -DRectifiedTransport_BUILD_PANEL=ON builds them once they are installed.")
endif ()
