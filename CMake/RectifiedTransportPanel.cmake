# SPDX-License-Identifier: BSD-3-Clause
# Whether the plugin has widgets of its own on ParaView's panel, and what these are linked to.

set(qt_version 5)
if (PARAVIEW_QT_MAJOR_VERSION)
  set(qt_version "${PARAVIEW_QT_MAJOR_VERSION}")
endif ()
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
      "Debian qtbase5-dev) or ParaView's pqComponents are not there. Install them, or turn it off.")
  endif ()
  # These would require the development files of all that ParaView's client is made of, down to
  # HDF5 and Boost, whose headers no widget includes.
  foreach (part IN ITEMS pqComponents pqCore pqWidgets qttesting)
    set_target_properties("ParaView::${part}" PROPERTIES
      INTERFACE_LINK_LIBRARIES "Qt${qt_version}::Widgets;ParaView::RemotingViews")
    get_target_property(configurations "ParaView::${part}" IMPORTED_CONFIGURATIONS)
    foreach (configuration IN LISTS configurations)
      set_property(TARGET "ParaView::${part}"
        PROPERTY "IMPORTED_LINK_DEPENDENT_LIBRARIES_${configuration}")
    endforeach ()
  endforeach ()
  set(panel_libraries ParaView::pqComponents ParaView::pqCore ParaView::pqWidgets ParaView::qttesting)
elseif (NOT has_panel)
  message(STATUS "RectifiedTransport: no widgets of its own on ParaView's panel, for Qt ${qt_version}'s "
    "Widgets (on Debian qtbase5-dev) are missing. -DRectifiedTransport_BUILD_PANEL=ON builds them "
    "once they are installed.")
endif ()
