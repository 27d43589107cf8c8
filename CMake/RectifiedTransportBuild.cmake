# SPDX-License-Identifier: BSD-3-Clause
# The module library, its Python package and the ParaView plugin, with VTK's and ParaView's own
# functions.

set(BUILD_TESTING "${RectifiedTransport_BUILD_TESTING}")
set(tests OFF)
if (RectifiedTransport_BUILD_TESTING)
  set(tests ON)
endif ()

if (RectifiedTransport_BUILD_PARAVIEW_PLUGIN)
  include("${PROJECT_SOURCE_DIR}/CMake/RectifiedTransportHelp.cmake")
endif ()

vtk_module_find_modules(module_files "${PROJECT_SOURCE_DIR}/Filters")
vtk_module_scan(
  MODULE_FILES ${module_files} "${PROJECT_SOURCE_DIR}/vtk.module"
  REQUEST_MODULES RectifiedTransport::vtkRectifiedTransport
  PROVIDES_MODULES modules
  ENABLE_TESTS "${tests}")

# A function, for the scope of CMAKE_SOURCE_DIR: relative to the folder above, all modules are
# subfolders, as vtk_module_build expects; relative to the root one would be the root itself.
function (rectified_transport_build_module)
  set(CMAKE_SOURCE_DIR "${PROJECT_SOURCE_DIR}/..")
  vtk_module_build(
    MODULES ${modules}
    PACKAGE RectifiedTransport
    VERSION "${PROJECT_VERSION}"
    SOVERSION "${PROJECT_VERSION_MAJOR}"
    INSTALL_EXPORT RectifiedTransport
    HEADERS_DESTINATION "${headers_destination}"
    CMAKE_DESTINATION "${cmake_destination}"
    TEST_DIRECTORY_NAME "Testing"
    TEST_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/Testing/Temporary")
endfunction ()
rectified_transport_build_module()

if (RectifiedTransport_WRAP_PYTHON)
  vtk_module_wrap_python(
    MODULES ${modules}
    TARGET RectifiedTransport::PythonWrapped
    INSTALL_EXPORT RectifiedTransport
    INSTALL_HEADERS OFF
    PYTHON_PACKAGE rectifiedtransport
    MODULE_DESTINATION "${RectifiedTransport_PYTHON_DIR}"
    CMAKE_DESTINATION "${cmake_destination}"
    LIBRARY_DESTINATION "${CMAKE_INSTALL_LIBDIR}")
  set(python_package "${RectifiedTransport_PYTHON_DIR}/rectifiedtransport")
  configure_file("${PROJECT_SOURCE_DIR}/Python/__init__.py.in"
    "${CMAKE_BINARY_DIR}/${python_package}/__init__.py" @ONLY)
  configure_file("${PROJECT_SOURCE_DIR}/Python/vtkRectifiedTransport.py"
    "${CMAKE_BINARY_DIR}/${python_package}/vtkRectifiedTransport.py" COPYONLY)
  set(arrays __init__.py _blends.py _data.py _maps.py _numbers.py _points.py
    _regions.py _run.py _surfaces.py)
  foreach (name IN LISTS arrays)
    configure_file("${PROJECT_SOURCE_DIR}/Python/arrays/${name}"
      "${CMAKE_BINARY_DIR}/${python_package}/arrays/${name}" COPYONLY)
  endforeach ()
  install(
    FILES "${CMAKE_BINARY_DIR}/${python_package}/__init__.py" Python/vtkRectifiedTransport.py
    DESTINATION "${python_package}"
    COMPONENT python)
  list(TRANSFORM arrays PREPEND "${PROJECT_SOURCE_DIR}/Python/arrays/")
  install(
    FILES ${arrays}
    DESTINATION "${python_package}/arrays"
    COMPONENT python)
endif ()

if (RectifiedTransport_BUILD_PARAVIEW_PLUGIN)
  set(without_help ON)
  if (RectifiedTransport_BUILD_HELP)
    set(without_help OFF)
  endif ()
  paraview_plugin_scan(
    PLUGIN_FILES "${PROJECT_SOURCE_DIR}/Plugin/paraview.plugin"
    PROVIDES_PLUGINS plugins
    ENABLE_BY_DEFAULT ON)
  paraview_plugin_build(
    PLUGINS ${plugins}
    PLUGINS_FILE_NAME rectifiedtransport.plugins.xml
    AUTOLOAD ${plugins}
    LIBRARY_SUBDIRECTORY "${PARAVIEW_PLUGIN_SUBDIR}"
    DISABLE_XML_DOCUMENTATION "${without_help}")
endif ()
