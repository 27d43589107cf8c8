# SPDX-License-Identifier: BSD-3-Clause
# With RectifiedTransport_UNITY_BUILD up to eight sources of a room are compiled as one, which takes half
# as long. Its bits are those of the other build, as no flag lets the compiler change arithmetic.

# rectified_transport_declared(SOURCE RESULT): the names of functions, classes and constants that
# begin a line, as all do that stand in unnamed namespaces.
function (rectified_transport_declared source result)
  file(READ "${source}" text)
  string(REGEX MATCHALL "\n[a-zA-Z][A-Za-z0-9_:<>*&, ]*[*& ][A-Za-z0-9_]+" lines "\n${text}")
  list(FILTER lines EXCLUDE REGEX "^\n(namespace|template|using) ")
  list(TRANSFORM lines REPLACE ".*[*& ]" "")
  list(REMOVE_DUPLICATES lines) # a class is declared and defined, a function overloaded
  set(${result} "${lines}" PARENT_SCOPE)
endfunction ()

# rectified_transport_group_sources(TARGET): each source into a group of its room, which is the folder
# in that of the target, or in Bridge. Sources that declare the same name stay apart: one might call the
# other's function.
function (rectified_transport_group_sources target)
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "[.]cxx$")
  foreach (source IN LISTS sources)
    get_filename_component(path "${source}" ABSOLUTE)
    get_source_file_property(generated "${source}" GENERATED)
    set(names)
    if (NOT generated AND EXISTS "${path}")
      rectified_transport_declared("${path}" names)
    endif ()
    file(RELATIVE_PATH path "${CMAKE_CURRENT_SOURCE_DIR}" "${path}")
    string(REGEX MATCH "^([.][.]/)*(Bridge/)?[^/]+/" room "${path}")
    foreach (number RANGE 100)
      string(MAKE_C_IDENTIFIER "group${number}_${room}" group)
      set(both ${names_${group}} ${names})
      list(LENGTH both count)
      list(REMOVE_DUPLICATES both)
      list(LENGTH both different)
      list(LENGTH sources_${group} taken)
      if (taken LESS 8 AND different EQUAL count)
        break ()
      endif ()
    endforeach ()
    list(APPEND sources_${group} "${source}")
    list(APPEND names_${group} ${names})
    set_property(SOURCE "${source}" PROPERTY UNITY_GROUP "${group}")
  endforeach ()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction ()

# rectified_transport_unity(TARGET): at the end of its folder, when all of its sources are known.
function (rectified_transport_unity target)
  # The compiler takes unnamed namespaces of included sources for those of headers.
  target_compile_options("${target}" PRIVATE $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-subobject-linkage>)
  cmake_language(EVAL CODE
    "cmake_language(DEFER CALL rectified_transport_group_sources [[${target}]])")
endfunction ()
