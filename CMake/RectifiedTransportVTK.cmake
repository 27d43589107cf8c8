# SPDX-License-Identifier: BSD-3-Clause
# Which VTK: ParaView's own where the plugin is built, else the one that VTK_DIR or the system
# gives.

enable_language(C) # for the MPI targets that ParaView's package names

if (NOT DEFINED RectifiedTransport_BUILD_PARAVIEW_PLUGIN AND NOT VTK_DIR)
  find_package(ParaView QUIET COMPONENTS RemotingCore)
endif ()
option(RectifiedTransport_BUILD_PARAVIEW_PLUGIN
  "Build the ParaView plugin, and everything else against ParaView's VTK" "${ParaView_FOUND}")

# rectified_transport_forget_private(LIBRARY...): what ParaView's shared libraries are made of
# privately is none of ours; CMake would require its development files, down to HDF5 and Boost.
function (rectified_transport_forget_private)
  foreach (library IN LISTS ARGN)
    get_target_property(configurations "${library}" IMPORTED_CONFIGURATIONS)
    foreach (configuration IN LISTS configurations)
      set_property(TARGET "${library}"
        PROPERTY "IMPORTED_LINK_DEPENDENT_LIBRARIES_${configuration}")
    endforeach ()
  endforeach ()
endfunction ()

set(vtk_place)
if (RectifiedTransport_BUILD_PARAVIEW_PLUGIN)
  # Without components ParaView's package requires all dependencies of its client, Qt included.
  find_package(ParaView REQUIRED COMPONENTS RemotingViews)
  rectified_transport_forget_private(ParaView::RemotingServerManager ParaView::RemotingViews)
  include(CMake/RectifiedTransportPanel.cmake)
  set(vtk_place PATHS "${ParaView_DIR}/vtk" NO_DEFAULT_PATH)
endif ()

set(vtk_components CommonCore CommonDataModel CommonExecutionModel FiltersCore FiltersGeometry)
set(vtk_optional ParallelMPI WrappingPythonCore WrappingTools)
if (RectifiedTransport_BUILD_TESTING)
  list(APPEND vtk_components
    FiltersGeneral FiltersParallel FiltersSources ImagingCore IOGeometry IOImage IOLegacy IOPLY IOXML
    TestingCore)
endif ()
if (RectifiedTransport_BUILD_EXAMPLES)
  list(APPEND vtk_components
    CommonSystem FiltersSources ImagingCore InteractionStyle InteractionWidgets IOImage RenderingCore
    RenderingFreeType RenderingOpenGL2 RenderingUI)
endif ()
find_package(VTK 9.1 REQUIRED COMPONENTS ${vtk_components} OPTIONAL_COMPONENTS ${vtk_optional}
  ${vtk_place})

option(RectifiedTransport_WRAP_PYTHON "Wrap the classes for Python" "${VTK_WRAP_PYTHON}")
if (RectifiedTransport_WRAP_PYTHON AND NOT VTK_WRAP_PYTHON)
  message(FATAL_ERROR "RectifiedTransport_WRAP_PYTHON is on, but the VTK in ${VTK_DIR} was built "
    "without Python. Turn it off, or give a VTK_DIR that has Python.")
endif ()
set(RectifiedTransport_PYTHON_DIR "${VTK_PYTHONPATH}" CACHE STRING
  "Where the Python package goes, relative to the install prefix")
if (RectifiedTransport_WRAP_PYTHON AND NOT RectifiedTransport_PYTHON_DIR)
  vtk_module_python_default_destination(RectifiedTransport_PYTHON_DIR)
endif ()

message(STATUS "RectifiedTransport: VTK ${VTK_VERSION} in ${VTK_DIR}, ParaView plugin "
  "${RectifiedTransport_BUILD_PARAVIEW_PLUGIN}, Python ${RectifiedTransport_WRAP_PYTHON}")
