# SPDX-License-Identifier: BSD-3-Clause
# Installs, moves the prefix away, and then builds and runs the programs of others against it.

function (run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result)
  if (NOT result EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "failed (${result}): ${command}")
  endif ()
endfunction ()

# Whether the libraries that a program or library loads come from the moved prefix.
function (check_loaded file)
  execute_process(COMMAND ldd "${file}" OUTPUT_VARIABLE loaded COMMAND_ERROR_IS_FATAL ANY)
  if (NOT loaded MATCHES "libvtkRectifiedTransport[^\n]* => ${WORK}/moved/")
    message(FATAL_ERROR "${file} does not load the library of the moved prefix:\n${loaded}")
  endif ()
endfunction ()

file(REMOVE_RECURSE "${WORK}")
run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${WORK}/first")
file(RENAME "${WORK}/first" "${WORK}/moved")

file(GLOB_RECURSE texts "${WORK}/moved/*.cmake" "${WORK}/moved/*.h" "${WORK}/moved/*.py")
foreach (text IN LISTS texts)
  file(READ "${text}" content)
  string(REPLACE "${VTK}" "" content "${content}") # the one outside place that it has to know
  foreach (place IN ITEMS "${WORK}/first" "${SOURCE}" "${BUILD}")
    string(FIND "${content}" "${place}" found)
    if (NOT found EQUAL -1)
      message(FATAL_ERROR "${text} names ${place}")
    endif ()
  endforeach ()
endforeach ()

foreach (example IN ITEMS Downstream StippleImage)
  run("${CMAKE_COMMAND}" -S "${SOURCE}/Examples/${example}" -B "${WORK}/${example}" -G Ninja
    -DCMAKE_BUILD_TYPE=Release "-DCMAKE_PREFIX_PATH=${WORK}/moved")
  run("${CMAKE_COMMAND}" --build "${WORK}/${example}")
  check_loaded("${WORK}/${example}/${example}")
endforeach ()
run("${WORK}/Downstream/Downstream")
run("${WORK}/StippleImage/StippleImage" "${SOURCE}/Testing/Data/ascent.png" "${WORK}/dots.png" 500)

file(GLOB_RECURSE libraries
  "${WORK}/moved/RectifiedTransport.so" "${WORK}/moved/vtkRectifiedTransport.so")
foreach (library IN LISTS libraries)
  check_loaded("${library}")
endforeach ()
if (PYTHON_DIR)
  run("${CMAKE_COMMAND}" -E env
    "PYTHONPATH=${WORK}/moved/${PYTHON_DIR}:$ENV{PYTHONPATH}"
    "${PYTHON}" -c "from rectifiedtransport import vtkTransportSampler; vtkTransportSampler()")
endif ()
