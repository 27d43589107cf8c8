# SPDX-License-Identifier: BSD-3-Clause
# What the libraries without VTK have in common: those of Filters/Core, Surfaces and Devices.
include("${CMAKE_CURRENT_LIST_DIR}/RectifiedTransportCompiler.cmake")

# Those that an exported target names are found by its package:
# CMake/RectifiedTransportPackage.cmake.
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(OpenMP QUIET COMPONENTS CXX)

# rectified_transport_mathematics(NAME PUBLIC_HEADERS HEADER... SOURCES SOURCE...): the library
# RectifiedTransport::NAME of the current folder. Its public headers are installed with their folders:
# #include <RectifiedTransport/NAME/HEADER>.
function (rectified_transport_mathematics name)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "" "PUBLIC_HEADERS;SOURCES")
  set(target "RectifiedTransport${name}")
  add_library(${target} ${ARG_SOURCES})
  add_library(RectifiedTransport::${name} ALIAS ${target})
  target_compile_features(${target} PUBLIC cxx_std_17)
  set_target_properties(${target} PROPERTIES
    POSITION_INDEPENDENT_CODE ON
    CXX_VISIBILITY_PRESET default
    WINDOWS_EXPORT_ALL_SYMBOLS ON)
  # Contraction to FMA stays off, so that every machine computes the same bits.
  target_compile_options(${target} PRIVATE -ffp-contract=off)

  target_link_libraries(${target} PUBLIC Eigen3::Eigen)

  if (PROJECT_NAME STREQUAL "RectifiedTransport")
    set(include_destination "${CMAKE_INSTALL_INCLUDEDIR}")
    rectified_transport_warnings(${target} -Wpedantic)
    set_target_properties(${target} PROPERTIES
      VERSION "${PROJECT_VERSION}"
      SOVERSION "${PROJECT_VERSION_MAJOR}"
      EXPORT_NAME "${name}")
    install(TARGETS ${target} EXPORT ${target}
      ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development
      LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT runtime NAMELINK_COMPONENT development
      RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT runtime)
  else () # VTK builds the module, and this with it: named, installed and exported as its libraries
    set(include_destination "${_vtk_build_HEADERS_DESTINATION}")
    vtk_module_find_package(PACKAGE Eigen3 CONFIG_MODE) # VTK's package finds it, too
    if (OpenMP_CXX_FOUND)
      vtk_module_find_package(PACKAGE OpenMP COMPONENTS CXX)
    endif ()
    _vtk_module_apply_properties(${target})
    _vtk_module_install(${target})
  endif ()
  # The second folder is for programs of the old form, <Core/Flow/RectifiedFlow.h>.
  target_include_directories(${target} PUBLIC
    "$<INSTALL_INTERFACE:${include_destination}>"
    "$<INSTALL_INTERFACE:${include_destination}/RectifiedTransport>")
  # In the build tree, as for projects that have this one as a subfolder, headers that include those of
  # the sources have the installed ones' places.
  get_filename_component(filters "${CMAKE_CURRENT_SOURCE_DIR}" DIRECTORY)
  set(includes "${CMAKE_CURRENT_BINARY_DIR}/include")
  target_include_directories(${target}
    PUBLIC "$<BUILD_INTERFACE:${filters}>"
    INTERFACE "$<BUILD_INTERFACE:${includes}>")
  foreach (header IN LISTS ARG_PUBLIC_HEADERS)
    get_filename_component(folder "${header}" DIRECTORY)
    install(FILES "${header}"
      DESTINATION "${include_destination}/RectifiedTransport/${name}/${folder}" COMPONENT development)
    file(CONFIGURE OUTPUT "${includes}/RectifiedTransport/${name}/${header}"
      CONTENT "#include \"${CMAKE_CURRENT_SOURCE_DIR}/${header}\"\n" @ONLY)
  endforeach ()
endfunction ()

# Flags of kernels, and of the sources beside them that compute as much.
set(kernel_flags -O3 -fopenmp-simd -ffp-contract=off -fno-math-errno -fno-trapping-math -Wno-psabi)

# rectified_transport_kernels(TARGET "FLAG;..." "SET;..." KERNELS...): one kernel source, which
# KERNELSSSE2.cxx and so on compile once for each instruction set; KERNELS.cxx chooses at run time.
# SSE2 stands for what the compiler gives without further flags.
function (rectified_transport_kernels target flags sets)
  set(flags_SSE2)
  set(flags_AVX2 -mavx2)
  set(flags_AVX512 -mavx2 -mavx512f -mavx512dq -mavx512vl -mprefer-vector-width=512)
  if (CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64|amd64")
    target_compile_definitions(${target} PRIVATE RECTIFIEDTRANSPORT_X86)
  else ()
    set(sets SSE2)
  endif ()
  foreach (kernels IN LISTS ARGN)
    target_sources(${target} PRIVATE "${kernels}.cxx")
    foreach (set IN LISTS sets)
      target_sources(${target} PRIVATE "${kernels}${set}.cxx")
      set_source_files_properties("${kernels}${set}.cxx"
        PROPERTIES COMPILE_OPTIONS "${flags};${flags_${set}}")
    endforeach ()
  endforeach ()
endfunction ()
