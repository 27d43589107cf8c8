# SPDX-License-Identifier: BSD-3-Clause

# The warnings that hold for hand-written sources; what VTK's wrappers generate is not ours.
function (rectified_transport_warnings target)
  target_compile_options("${target}" PRIVATE
    "$<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang,AppleClang>:-Wall;-Wextra;-Wpedantic;-Wshadow;-Wconversion;-Wnon-virtual-dtor;-Woverloaded-virtual>"
    "$<$<COMPILE_LANG_AND_ID:CXX,MSVC>:/W4>")
endfunction ()
