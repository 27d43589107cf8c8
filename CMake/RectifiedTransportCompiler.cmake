# SPDX-License-Identifier: BSD-3-Clause
# The kernels use GCC's vector extensions and flags. Also runs as a script (cmake -P) with these
# variables set, and fails then as the configuration would.
if (NOT CMAKE_CXX_COMPILER_ID MATCHES "^(GNU|Clang|AppleClang|IntelLLVM)$" OR
    CMAKE_CXX_COMPILER_FRONTEND_VARIANT STREQUAL "MSVC")
  message(FATAL_ERROR "RectifiedTransport needs GCC or Clang, with GCC's command line, for its "
    "kernels; the C++ compiler is ${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} "
    "${CMAKE_CXX_COMPILER}. Choose one with -DCMAKE_CXX_COMPILER=g++ or clang++, on Windows those "
    "of MinGW, and a VTK that was built with it.")
endif ()
