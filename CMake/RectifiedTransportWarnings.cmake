# SPDX-License-Identifier: BSD-3-Clause

# The warnings for hand-written sources, not for those that VTK's wrappers generate. Further
# arguments are flags, too. Clang's -Wconversion includes -Wsign-conversion, GCC's does not.
function (rectified_transport_warnings target)
  set(flags -Wall -Wextra -Wshadow -Wconversion -Wnon-virtual-dtor -Woverloaded-virtual ${ARGN})
  target_compile_options("${target}" PRIVATE
    "$<$<COMPILE_LANGUAGE:CXX>:${flags}>"
    "$<$<COMPILE_LANG_AND_ID:CXX,Clang,AppleClang,IntelLLVM>:-Wno-sign-conversion>")
  if (RectifiedTransport_UNITY_BUILD)
    rectified_transport_unity("${target}")
  endif ()
endfunction ()
