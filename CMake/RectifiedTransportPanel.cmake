# SPDX-License-Identifier: BSD-3-Clause
# Whether the plugin has widgets of its own on ParaView's panel, and what these are linked to.

set(qt_version 5)
if (PARAVIEW_QT_MAJOR_VERSION)
  set(qt_version "${PARAVIEW_QT_MAJOR_VERSION}")
endif ()
set(qt_package "qt${qt_version}-base-dev")
if (qt_version EQUAL 5)
  set(qt_package qtbase5-dev)
endif ()
# Qt 6 would walk all folders for its scripts of deployment, which nobody needs here, and never return
# from the root: vtk_module_build adds that to itself.
set_property(GLOBAL PROPERTY _qt_have_generated_deploy_support TRUE)
find_package("Qt${qt_version}" QUIET COMPONENTS Widgets)
set(has_panel OFF)
if (TARGET "Qt${qt_version}::Widgets" AND TARGET ParaView::pqComponents)
  set(has_panel ON)
endif ()
option(RectifiedTransport_BUILD_PANEL
  "Build the plugin's own widgets on ParaView's panel, which need Qt's development files"
  "${has_panel}")
if (RectifiedTransport_BUILD_PANEL)
  if (NOT has_panel)
    message(FATAL_ERROR "RectifiedTransport_BUILD_PANEL is on, but Qt ${qt_version}'s Widgets (on "
      "Debian ${qt_package}) or ParaView's pqComponents are not there. Install them, or turn it off.")
  endif ()
  # No widget includes the headers of all that ParaView's client is made of.
  set(panel_libraries ParaView::pqComponents ParaView::pqCore ParaView::pqWidgets ParaView::qttesting)
  foreach (library IN LISTS panel_libraries)
    set_target_properties("${library}" PROPERTIES
      INTERFACE_LINK_LIBRARIES "Qt${qt_version}::Widgets;ParaView::RemotingViews")
  endforeach ()
  rectified_transport_forget_private(${panel_libraries})
elseif (NOT has_panel)
  message(STATUS "RectifiedTransport: no widgets of its own on ParaView's panel, for Qt ${qt_version}'s "
    "Widgets (on Debian ${qt_package}) are missing. -DRectifiedTransport_BUILD_PANEL=ON builds them "
    "once they are installed.")
endif ()
