# SPDX-License-Identifier: BSD-3-Clause
# The pages that ParaView's help shows of the filters, made of Documentation/ by Plugin/Help.

find_package(Python3 QUIET COMPONENTS Interpreter)
set(missing)
if (NOT PARAVIEW_USE_QT)
  list(APPEND missing "a ParaView with its window (Qt)")
elseif (PARAVIEW_QT_MAJOR_VERSION GREATER 5) # ParaView's issue 19742
  list(APPEND missing
    "a ParaView with Qt 5 (with Qt ${PARAVIEW_QT_MAJOR_VERSION} it puts no help into plugins)")
endif ()
find_program(RectifiedTransport_QHELPGENERATOR
  NAMES qhelpgenerator qhelpgenerator-qt5 qhelpgenerator6
  PATHS /usr/lib/qt5/bin /usr/lib/qt6/libexec /usr/lib/qt6/bin
  DOC "Qt's compiler of help, which makes the help in ParaView's window")
mark_as_advanced(RectifiedTransport_QHELPGENERATOR)
# Debian's qtchooser puts a qhelpgenerator into the path that fails where there is none behind it.
set(generator_runs 1)
if (RectifiedTransport_QHELPGENERATOR)
  execute_process(COMMAND "${RectifiedTransport_QHELPGENERATOR}" -v
    RESULT_VARIABLE generator_runs OUTPUT_QUIET ERROR_QUIET)
endif ()
if (NOT generator_runs EQUAL 0)
  list(APPEND missing "qhelpgenerator (Debian: qhelpgenerator-qt5)")
endif ()
foreach (module_package IN ITEMS markdown=python3-markdown PIL=python3-pil)
  string(REPLACE "=" ";" module_package "${module_package}")
  list(GET module_package 0 module)
  list(GET module_package 1 package)
  set(imported 1)
  if (Python3_Interpreter_FOUND)
    execute_process(COMMAND "${Python3_EXECUTABLE}" -c "import ${module}"
      RESULT_VARIABLE imported OUTPUT_QUIET ERROR_QUIET)
  endif ()
  if (NOT imported EQUAL 0)
    list(APPEND missing "Python's ${module} (Debian: ${package})")
  endif ()
endforeach ()
string(REPLACE ";" ", " missing "${missing}")

set(help_default ON)
if (missing)
  set(help_default OFF)
endif ()
option(RectifiedTransport_BUILD_HELP
  "Put the filters' pages into the plugin for ParaView's help, where ? opens them" "${help_default}")
if (RectifiedTransport_BUILD_HELP AND missing)
  message(FATAL_ERROR "RectifiedTransport_BUILD_HELP is on, but these are missing: ${missing}. "
    "Install them, or turn it off.")
elseif (RectifiedTransport_BUILD_HELP)
  message(STATUS "RectifiedTransport: help in ParaView's window by "
    "${RectifiedTransport_QHELPGENERATOR}")
elseif (missing)
  message(STATUS "RectifiedTransport: no help in ParaView's window, for these are missing: "
    "${missing}. -DRectifiedTransport_BUILD_HELP=ON builds it once they are installed.")
endif ()
if (NOT RectifiedTransport_BUILD_HELP)
  return ()
endif ()

# paraview_add_plugin calls these two functions of ParaView's for a help of the server manager's XML
# and embeds what the second one makes. ParaView's own need xmlpatterns and Qt's development packages,
# and know neither pictures nor links; these take their place.
function (paraview_client_documentation)
endfunction ()

function (paraview_client_generate_help)
  cmake_parse_arguments(help "" "NAME;TARGET;OUTPUT_DIR;OUTPUT_PATH" "" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS
    "${PROJECT_SOURCE_DIR}/Documentation/*.md"
    "${PROJECT_SOURCE_DIR}/Documentation/Images/*.png"
    "${CMAKE_CURRENT_BINARY_DIR}/xml/*.xml")
  set(script "${PROJECT_SOURCE_DIR}/Plugin/Help/make_help.py")
  set(compiled "${help_OUTPUT_DIR}/${help_NAME}.qch")
  add_custom_command(
    OUTPUT "${compiled}"
    COMMAND "${Python3_EXECUTABLE}" "${script}" "${PROJECT_SOURCE_DIR}"
            "${CMAKE_CURRENT_BINARY_DIR}/xml" "${help_OUTPUT_DIR}"
    COMMAND "${CMAKE_COMMAND}" -E env QT_QPA_PLATFORM=offscreen
            "${RectifiedTransport_QHELPGENERATOR}" "${help_OUTPUT_DIR}/${help_NAME}.qhp" -s
            -o "${compiled}"
    DEPENDS "${script}" ${sources}
    COMMENT "Making the help of ${help_NAME}"
    VERBATIM)
  add_custom_target("${help_TARGET}" DEPENDS "${compiled}")
  set("${help_OUTPUT_PATH}" "${compiled}" PARENT_SCOPE)
endfunction ()
