# SPDX-License-Identifier: BSD-3-Clause
# The package that find_package(RectifiedTransport) finds, in the build tree and installed.
include(CMakePackageConfigHelpers)

set(package_folder "${CMAKE_BINARY_DIR}/${cmake_destination}")
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
  COMPONENT runtime)
