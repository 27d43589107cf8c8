# SPDX-License-Identifier: BSD-3-Clause
# What the VTK modules in Filters/ have in common.

# The mathematics comes first: with it where this project is built, here where VTK builds the modules.
get_filename_component(filters "${CMAKE_CURRENT_LIST_DIR}/../Filters" ABSOLUTE)
if (NOT TARGET RectifiedTransportCore)
  foreach (library IN ITEMS Core Surfaces Devices)
    add_subdirectory("${filters}/${library}" "${CMAKE_CURRENT_BINARY_DIR}/${library}")
  endforeach ()
endif ()

# rectified_transport_module(LIBRARY CLASSES CLASS... BRIDGE SOURCE...): the module of the current folder,
# with sources of Filters/Bridge, on a library of the mathematics.
function (rectified_transport_module library)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "" "CLASSES;BRIDGE")
  list(TRANSFORM ARG_BRIDGE PREPEND "../Bridge/")
  vtk_module_add_module("${_vtk_build_module}"
    CLASSES ${ARG_CLASSES}
    SOURCES ${ARG_BRIDGE})
  string(REGEX REPLACE "^.*::" "" target "${_vtk_build_module}")
  target_link_libraries(${target} PRIVATE RectifiedTransport::${library})
  target_compile_features(${target} PUBLIC cxx_std_17)
  # As in Core: results have the same bits on every processor.
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  # Modules use each other's functions of Bridge.
  set_target_properties(${target} PROPERTIES
    CXX_VISIBILITY_PRESET default
    WINDOWS_EXPORT_ALL_SYMBOLS ON)
  if (COMMAND rectified_transport_warnings) # not where VTK itself builds the module
    rectified_transport_warnings(${target})
  endif ()
endfunction ()
