# SPDX-License-Identifier: BSD-3-Clause
# Installs, moves the prefix away, and then builds and runs the programs of others against it.
include("${CMAKE_CURRENT_LIST_DIR}/InstallChecks.cmake")

file(REMOVE_RECURSE "${WORK}")
install_and_move("${BUILD}" "${VTK}") # the one outside place that it has to know

set(ours vtkRectifiedTransportCommon vtkRectifiedTransportDensities RectifiedTransportCore)
if (EXISTS "${WORK}/moved/include/RectifiedTransport/Devices")
  list(APPEND ours RectifiedTransportDevices)
endif ()
foreach (example IN ITEMS Downstream LiveStippling StippleImage)
  build_against_moved("Examples/${example}" "${example}")
  check_loaded("${WORK}/${example}/${example}" ${ours})
endforeach ()
run("${WORK}/Downstream/Downstream")
run("${WORK}/StippleImage/StippleImage" "${SOURCE}/Testing/Data/ascent.png" "${WORK}/dots.png" 500)
run("${WORK}/LiveStippling/LiveStippling" --help)
set(program "${SOURCE}/Testing/Install/Program/main.cxx")
build_of_page(Readme README.md "${program}" "")
# With a VTK that the project found before, and with C, whose MPI is then CMake's own.
build_of_page(ReadmeAfterVTK README.md "${program}"
  "find_package(VTK REQUIRED COMPONENTS CommonCore OPTIONAL_COMPONENTS ParallelMPI)" "-DVTK_DIR=${VTK}")
build_of_page(ReadmeWithC README.md "${program}" "enable_language(C)")
build_against_moved(Testing/Install/Headers Headers)
check_core(RectifiedTransportCore)
check_subfolder()

file(GLOB_RECURSE libraries
  "${WORK}/moved/RectifiedTransport.so" "${WORK}/moved/vtkRectifiedTransportDensities*.so")
foreach (library IN LISTS libraries)
  check_loaded("${library}" ${ours})
endforeach ()
if (PYTHON_DIR)
  run("${CMAKE_COMMAND}" -E env
    "PYTHONPATH=${WORK}/moved/${PYTHON_DIR}:$ENV{PYTHONPATH}"
    "${PYTHON}" -c "from rectifiedtransport import vtkTransportSampler; vtkTransportSampler()")
  run("${CMAKE_COMMAND}" -E env
    "PYTHONPATH=${WORK}/moved/${PYTHON_DIR}:$ENV{PYTHONPATH}"
    "${PYTHON}" -c "print(__import__('rectifiedtransport').arrays.sample([[1, 2], [3, 4]], 5))")
endif ()
