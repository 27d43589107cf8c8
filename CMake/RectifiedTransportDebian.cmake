# SPDX-License-Identifier: BSD-3-Clause
# What cpack makes: a Debian package. Documentation/Packages.md says what is in it, and why.

if (NOT UNIX OR APPLE)
  return ()
endif ()
find_program(RectifiedTransport_DPKG_DEB dpkg-deb)
find_program(RectifiedTransport_DPKG dpkg)
find_program(RectifiedTransport_GZIP gzip)
mark_as_advanced(RectifiedTransport_DPKG_DEB RectifiedTransport_DPKG RectifiedTransport_GZIP)
if (NOT RectifiedTransport_DPKG_DEB OR NOT RectifiedTransport_DPKG OR NOT RectifiedTransport_GZIP)
  return ()
endif ()

set(package rectifiedtransport)
set(templates "${PROJECT_SOURCE_DIR}/CMake/Debian")
set(made "${CMAKE_BINARY_DIR}/CMakeFiles/Debian")
file(MAKE_DIRECTORY "${made}")

# Who maintains it stands in CITATION.cff, what its licence is in LICENSE.
set_property(DIRECTORY "${PROJECT_SOURCE_DIR}" APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
  "${PROJECT_SOURCE_DIR}/CITATION.cff"
  "${PROJECT_SOURCE_DIR}/CHANGELOG.md"
  "${PROJECT_SOURCE_DIR}/LICENSE")
file(STRINGS "${PROJECT_SOURCE_DIR}/CITATION.cff" maintainer REGEX "^  - name: ")
string(REGEX REPLACE "^  - name: " "" maintainer "${maintainer}")
set(CPACK_PACKAGE_CONTACT "${maintainer}" CACHE STRING
  "Who maintains the package that cpack makes: Name <address>")
set(maintainer "${CPACK_PACKAGE_CONTACT}")
file(READ "${PROJECT_SOURCE_DIR}/LICENSE" licence)
string(REGEX MATCH "Copyright \\(c\\) [^\n]*" copyright "${licence}")
string(REPLACE "Copyright (c) " "" copyright "${copyright}")
if (NOT maintainer OR NOT copyright)
  message(FATAL_ERROR "the Debian package takes its maintainer from CPACK_PACKAGE_CONTACT, or from the "
    "author's \"- name:\" in CITATION.cff, and its copyright from the line \"Copyright (c)\" in LICENSE: one is missing")
endif ()
string(REGEX REPLACE "^.*Copyright \\(c\\) [^\n]*\n+" "" licence "${licence}")
string(STRIP "${licence}" licence)
string(REPLACE "\n" "\n " licence " ${licence}")
string(REPLACE "\n \n" "\n .\n" licence "${licence}") # an empty line in a field of Debian's
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)

set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(version "${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}")
set(lib_dir "/usr/${CMAKE_INSTALL_LIBDIR}")
set(documents "${CMAKE_INSTALL_DATADIR}/doc/${package}")
set(scripts)
# What C++ programs need besides the package.
set(cxx_packages cmake g++ libeigen3-dev make)
if (RectifiedTransport_BUILD_PARAVIEW_PLUGIN)
  list(APPEND cxx_packages libopenmpi-dev paraview-dev)
elseif (RectifiedTransport_BUILD_VTK)
  list(APPEND cxx_packages libvtk9-dev)
endif ()
list(SORT cxx_packages)
list(JOIN cxx_packages " " cxx_tools)

configure_file("${templates}/copyright.in" "${made}/copyright" @ONLY)
configure_file("${templates}/changelog.in" "${made}/changelog.Debian" @ONLY)
configure_file("${PROJECT_SOURCE_DIR}/CHANGELOG.md" "${made}/changelog" COPYONLY)
foreach (name IN ITEMS changelog changelog.Debian)
  execute_process(COMMAND "${RectifiedTransport_GZIP}" -9nc "${made}/${name}"
    OUTPUT_FILE "${made}/${name}.gz" COMMAND_ERROR_IS_FATAL ANY)
endforeach ()
set(files copyright changelog.gz changelog.Debian.gz)

set(depends)
if (RectifiedTransport_BUILD_PARAVIEW_PLUGIN)
  set(plugin_dir "${lib_dir}/${PARAVIEW_PLUGIN_SUBDIR}")
  list(APPEND depends python3-paraview)
  if (ParaView_DIR MATCHES "^/usr/lib/")
    # Beside the executables of ParaView: where they look for lists of plugins, and nowhere else.
    file(WRITE "${made}/paraview.conf" "${plugin_dir}/rectifiedtransport.plugins.xml\n")
    install(FILES "${made}/paraview.conf"
      DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT debian EXCLUDE_FROM_ALL)
    configure_file("${templates}/README.Debian.in" "${made}/README.Debian" @ONLY)
    list(APPEND files README.Debian)
    list(APPEND scripts preinst)
  endif ()
elseif (RectifiedTransport_WRAP_PYTHON)
  list(APPEND depends python3-vtk9)
endif ()
if (RectifiedTransport_WRAP_PYTHON)
  find_package(Python3 QUIET COMPONENTS Interpreter)
  math(EXPR next "${Python3_VERSION_MINOR} + 1")
  list(APPEND depends python3-numpy
    "python3 (>= ${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}~)" "python3 (<< 3.${next}~)")
  list(APPEND scripts postinst prerm)
endif ()
list(TRANSFORM files PREPEND "${made}/")
install(FILES ${files} DESTINATION "${documents}" COMPONENT debian EXCLUDE_FROM_ALL)

execute_process(COMMAND "${RectifiedTransport_DPKG}" --print-architecture
  OUTPUT_VARIABLE CPACK_DEBIAN_PACKAGE_ARCHITECTURE OUTPUT_STRIP_TRAILING_WHITESPACE
  COMMAND_ERROR_IS_FATAL ANY)
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME "${package}")
set(CPACK_PACKAGE_VENDOR "${maintainer}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
# All in one package; all but the licence, which Debian wants in the file copyright.
set(CPACK_COMPONENTS_ALL runtime development python Unspecified debian)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_NAME "${package}")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
if (RectifiedTransport_BUILD_PARAVIEW_PLUGIN)
  set(parts "A plugin for ParaView, a Python package and C++ libraries")
elseif (RectifiedTransport_BUILD_VTK)
  set(parts "A Python package and C++ libraries")
else ()
  set(parts "A C++ library of algorithms")
endif ()
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
  "${parts} that move mass between
densities: particles that are distributed like an image, displacement
fields, cells of equal mass, morphs of images and solids.")
if (scripts MATCHES "preinst")
  string(APPEND CPACK_DEBIAN_PACKAGE_DESCRIPTION "

ParaView loads the plugin when it starts; its filters are in the menu
Filters, Transport.")
endif ()
string(APPEND CPACK_DEBIAN_PACKAGE_DESCRIPTION "

C++ programs also need the packages that are suggested.")
list(JOIN depends ", " CPACK_DEBIAN_PACKAGE_DEPENDS)
list(JOIN cxx_packages ", " CPACK_DEBIAN_PACKAGE_SUGGESTS)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
foreach (script IN LISTS scripts ITEMS triggers)
  list(APPEND CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA "${templates}/${script}")
endforeach ()
set(CPACK_SOURCE_GENERATOR TGZ)
set(CPACK_SOURCE_IGNORE_FILES "/[.]git/" "/build[^/]*/" "/install[^/]*/" "/Examples/output/"
  "__pycache__" "/CMakeUserPresets[.]json$")

configure_file("${templates}/checks.cmake.in" "${made}/checks.cmake" @ONLY)
set(CPACK_PROJECT_CONFIG_FILE "${made}/checks.cmake")
include(CPack)
