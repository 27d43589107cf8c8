# SPDX-License-Identifier: BSD-3-Clause
# The core alone: VTK and ParaView are not searched for, and nothing that needs them is built.
set(refused)
foreach (option IN ITEMS BUILD_PARAVIEW_PLUGIN WRAP_PYTHON BUILD_EXAMPLES)
  if (RectifiedTransport_${option})
    string(APPEND refused " -DRectifiedTransport_${option}=OFF")
  endif ()
endforeach ()
if (refused)
  message(FATAL_ERROR "RectifiedTransport_BUILD_VTK is off, but what needs VTK is on: either "
    "-DRectifiedTransport_BUILD_VTK=ON or${refused}")
endif ()
message(STATUS "RectifiedTransport: the core alone, without VTK")
