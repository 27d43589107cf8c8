# SPDX-License-Identifier: BSD-3-Clause
# What the tests of installed packages share. WORK is theirs, SOURCE is the project's.

function (run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result)
  if (NOT result EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "failed (${result}): ${command}")
  endif ()
endfunction ()

# refuse(MESSAGE COMMAND...): the command has to fail, with these words.
function (refuse message)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE text)
  string(REGEX REPLACE "[ \n]+" " " text "${text}") # CMake breaks lines
  string(FIND "${text}" "${message}" found)
  if (result EQUAL 0 OR found EQUAL -1)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "not refused with '${message}' (${result}): ${command}\n${text}")
  endif ()
endfunction ()

# Configures and builds a project of others against the moved prefix, in a folder of WORK.
function (build_against_moved project folder)
  run("${CMAKE_COMMAND}" -S "${SOURCE}/${project}" -B "${WORK}/${folder}" -G Ninja
    -DCMAKE_BUILD_TYPE=Release "-DCMAKE_PREFIX_PATH=${WORK}/moved" ${ARGN})
  run("${CMAKE_COMMAND}" --build "${WORK}/${folder}")
endfunction ()

# build_of_page(FOLDER PAGE PROGRAM FIRST): a project of C++ alone with the first lines that a page of the
# documentation gives for CMake, after FIRST, which come before it defines my_program by the source PROGRAM.
# Checks that it runs.
function (build_of_page folder page program first)
  file(READ "${SOURCE}/${page}" text)
  if (NOT text MATCHES "```cmake\n([^`]+)```")
    message(FATAL_ERROR "${page} does not say how it is linked")
  endif ()
  file(WRITE "${WORK}/${folder}Source/CMakeLists.txt" "cmake_minimum_required(VERSION 3.22)
project(${folder} LANGUAGES CXX)
${first}
add_executable(my_program \"${program}\")
${CMAKE_MATCH_1}")
  run("${CMAKE_COMMAND}" -S "${WORK}/${folder}Source" -B "${WORK}/${folder}" -G Ninja
    -DCMAKE_BUILD_TYPE=Release "-DCMAKE_PREFIX_PATH=${WORK}/moved" ${ARGN})
  run("${CMAKE_COMMAND}" --build "${WORK}/${folder}")
  run("${WORK}/${folder}/my_program")
endfunction ()

# Installs a build and moves the prefix away. What is there may name no place of this machine but
# those in ARGN.
function (install_and_move build)
  run("${CMAKE_COMMAND}" --install "${build}" --prefix "${WORK}/first")
  file(RENAME "${WORK}/first" "${WORK}/moved")
  file(GLOB_RECURSE texts "${WORK}/moved/*.cmake" "${WORK}/moved/*.h" "${WORK}/moved/*.py")
  foreach (text IN LISTS texts)
    file(READ "${text}" content)
    foreach (place IN LISTS ARGN)
      string(REPLACE "${place}" "" content "${content}")
    endforeach ()
    foreach (place IN ITEMS "${WORK}/first" "${SOURCE}" "${build}")
      string(FIND "${content}" "${place}" found)
      if (NOT found EQUAL -1)
        message(FATAL_ERROR "${text} names ${place}")
      endif ()
    endforeach ()
  endforeach ()
endfunction ()

# Whether a program or library loads our libraries from the moved prefix.
function (check_loaded file)
  execute_process(COMMAND ldd "${file}" OUTPUT_VARIABLE loaded COMMAND_ERROR_IS_FATAL ANY)
  foreach (library IN LISTS ARGN)
    if (NOT loaded MATCHES "lib${library}[^\n]* => ${WORK}/moved/")
      message(FATAL_ERROR "${file} does not load ${library} of the moved prefix:\n${loaded}")
    endif ()
  endforeach ()
  set(loaded "${loaded}" PARENT_SCOPE)
endfunction ()

# The core as a subfolder of another project compiles what includes it; its libraries are not built.
function (check_subfolder)
  run("${CMAKE_COMMAND}" -S "${SOURCE}/Testing/Install/Subfolder" -B "${WORK}/Subfolder" -G Ninja
    "-DSOURCE=${SOURCE}")
  run("${CMAKE_COMMAND}" --build "${WORK}/Subfolder" --target Subfolder)
endfunction ()

# The core of the moved prefix, for those who have no VTK. ARGN are our libraries, if shared.
function (check_core)
  set(without_vtk -DCMAKE_DISABLE_FIND_PACKAGE_VTK=ON -DCMAKE_DISABLE_FIND_PACKAGE_ParaView=ON)
  build_against_moved(Examples/Downstream/Core DownstreamCore ${without_vtk})
  set(program "${WORK}/DownstreamCore/DownstreamCore")
  run("${program}")
  check_loaded("${program}" ${ARGN})
  if (loaded MATCHES "vtk|ParaView")
    message(FATAL_ERROR "${program} loads VTK:\n${loaded}")
  endif ()
  set(pages Core)
  if (EXISTS "${WORK}/moved/include/RectifiedTransport/Devices") # built where OpenCL's header is
    list(APPEND pages Devices)
  else ()
    refuse("it was built without OpenCL's header" "${CMAKE_COMMAND}"
      -S "${SOURCE}/Testing/Install/Headers" -B "${WORK}/Refused" -G Ninja
      "-DCMAKE_PREFIX_PATH=${WORK}/moved" -DCOMPONENTS=Devices ${without_vtk})
  endif ()
  foreach (name IN LISTS pages)
    file(READ "${SOURCE}/Documentation/${name}.md" page)
    string(REGEX MATCH "```cpp\n([^`]+)```" found "${page}")
    file(WRITE "${WORK}/${name}.cxx" "${CMAKE_MATCH_1}")
    build_of_page(Of${name} Documentation/${name}.md "${WORK}/${name}.cxx" "" ${without_vtk})
    check_loaded("${WORK}/Of${name}/my_program" ${ARGN})
  endforeach ()
  file(STRINGS "${SOURCE}/Documentation/Core.md" lines REGEX "(Core|Surfaces)/[A-Za-z]+/[A-Za-z]+[.]h")
  string(REGEX MATCHALL "(Core|Surfaces)/[A-Za-z]+/[A-Za-z]+[.]h" documented "${lines}")
  foreach (header IN LISTS documented)
    if (NOT EXISTS "${WORK}/moved/include/RectifiedTransport/${header}")
      message(FATAL_ERROR "Documentation/Core.md names ${header}, which is not installed")
    endif ()
  endforeach ()
  refuse("it has no component Tables, but Core, Surfaces, Devices and VTK" "${CMAKE_COMMAND}"
    -S "${SOURCE}/Testing/Install/Headers" -B "${WORK}/Refused" -G Ninja
    "-DCMAKE_PREFIX_PATH=${WORK}/moved" "-DCOMPONENTS=Core\;Tables" ${without_vtk})
endfunction ()
