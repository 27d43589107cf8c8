# SPDX-License-Identifier: BSD-3-Clause
# The package that find_package(RectifiedTransport) finds, in the build tree and installed.
include(CMakePackageConfigHelpers)

set(package_folder "${CMAKE_BINARY_DIR}/${cmake_destination}")
set(libraries Core Surfaces)
if (TARGET RectifiedTransportDevices)
  list(APPEND libraries Devices)
endif ()
foreach (component IN LISTS libraries)
  export(
    EXPORT RectifiedTransport${component}
    NAMESPACE RectifiedTransport::
    FILE "${package_folder}/RectifiedTransport${component}-targets.cmake")
  install(
    EXPORT RectifiedTransport${component}
    NAMESPACE RectifiedTransport::
    FILE RectifiedTransport${component}-targets.cmake
    DESTINATION "${cmake_destination}"
    COMPONENT development)
endforeach ()

# Private dependencies are in the link interface of static libraries only.
get_target_property(core_links RectifiedTransportCore INTERFACE_LINK_LIBRARIES)
set(core_dependencies)
if (core_links MATCHES "Eigen3::")
  string(APPEND core_dependencies "find_dependency(Eigen3 NO_MODULE)\n")
endif ()
if (core_links MATCHES "OpenMP::")
  string(APPEND core_dependencies "find_dependency(OpenMP COMPONENTS CXX)\n")
endif ()
set(components ${libraries})
if (RectifiedTransport_BUILD_VTK)
  list(APPEND components VTK)
endif ()
configure_package_config_file(
  "${PROJECT_SOURCE_DIR}/CMake/RectifiedTransportConfig.cmake.in"
  "${package_folder}/RectifiedTransportConfig.cmake"
  INSTALL_DESTINATION "${cmake_destination}"
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(
  "${package_folder}/RectifiedTransportConfigVersion.cmake"
  COMPATIBILITY SameMajorVersion)
install(
  FILES
    "${package_folder}/RectifiedTransportConfig.cmake"
    "${package_folder}/RectifiedTransportConfigVersion.cmake"
  DESTINATION "${cmake_destination}"
  COMPONENT development)
install(
  FILES LICENSE
  DESTINATION "${CMAKE_INSTALL_DATADIR}/licenses/RectifiedTransport"
  COMPONENT license)
