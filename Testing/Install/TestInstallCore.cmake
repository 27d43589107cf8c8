# SPDX-License-Identifier: BSD-3-Clause
# The core without VTK, from its configuration to a program that uses what was installed. BUILD is a
# build without VTK, LIBRARIES are its shared ones. Where there is none this makes one, of the static
# library: only with that one has the package to find what the core links.
include("${CMAKE_CURRENT_LIST_DIR}/InstallChecks.cmake")

file(REMOVE_RECURSE "${WORK}")
set(configure "${CMAKE_COMMAND}" -S "${SOURCE}" -G Ninja -DCMAKE_BUILD_TYPE=Release
  "-DCMAKE_CXX_COMPILER=${COMPILER}" -DRectifiedTransport_BUILD_VTK=OFF)
if (NOT BUILD)
  set(BUILD "${WORK}/build")
  run(${configure} -B "${BUILD}" -DBUILD_SHARED_LIBS=OFF)
  run("${CMAKE_COMMAND}" --build "${BUILD}")
endif ()
file(STRINGS "${BUILD}/CMakeCache.txt" looked_for REGEX "^(VTK|ParaView)_DIR")
if (looked_for)
  message(FATAL_ERROR "it has looked for ${looked_for}")
endif ()

install_and_move("${BUILD}")
check_core(${LIBRARIES})
check_subfolder()
build_against_moved(Testing/Install/Headers Headers)
refuse("it was built without VTK" "${CMAKE_COMMAND}" -S "${SOURCE}/Testing/Install/Headers"
  -B "${WORK}/Refused" "-DCMAKE_PREFIX_PATH=${WORK}/moved" -DCOMPONENTS=VTK)
refuse("either -DRectifiedTransport_BUILD_VTK=ON or -DRectifiedTransport_BUILD_PARAVIEW_PLUGIN=OFF"
  ${configure} -B "${WORK}/NoPlugin" -DRectifiedTransport_BUILD_PARAVIEW_PLUGIN=ON)
