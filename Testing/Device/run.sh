#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the report on an OpenCL device and runs it: on a machine with cmake, a C++ compiler,
# Eigen's headers, OpenCL's headers and a driver. Installs nothing, and needs neither VTK nor a
# network.
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
build="${BUILD:-$root/build-device}"
report="$build/report.txt"

usage()
{
  cat << 'TEXT'
usage: [EIGEN=FOLDER] [OPENCL_HEADERS=FOLDER] [CXX=COMPILER] [BUILD=FOLDER]
       bash Testing/Device/run.sh [--device NAME] [--bits | --times] [--quick] [--large]
  Builds the core alone in build-device/ and prints whether an OpenCL device computes the
  processor's bits, and the times of both. The same text is then in build-device/report.txt.
  --device NAME   the first device whose name contains it; else the first that can be used
  --bits          the comparison of bits alone
  --times         the times alone
  --quick         small cases, each once
  --large         times of 256^3, too: 2 GB of memory (without it on GPUs that have the memory)
  EIGEN           the folder that contains Eigen/Core, if it is not where systems have it
  OPENCL_HEADERS  the folder that contains CL/cl.h, likewise
TEXT
}

if [[ " $* " == *" --help "* ]]; then
  usage
  exit 0
fi

# first_with FILE FOLDER...: the first of the folders that has the file.
first_with()
{
  local file="$1" folder
  shift
  for folder in "$@"; do
    if [ -e "$folder/$file" ]; then
      echo "$folder"
      return
    fi
  done
}

# Everything that is missing at once.
missing=()
compiler="${CXX:-$(command -v g++ || command -v clang++ || command -v c++ || true)}"
eigen="$(first_with Eigen/Core ${EIGEN:+"$EIGEN"} /usr/include/eigen3 /usr/local/include/eigen3 \
  /opt/homebrew/include/eigen3 ${CONDA_PREFIX:+"$CONDA_PREFIX/include/eigen3"})"
headers="$(first_with CL/cl.h ${OPENCL_HEADERS:+"$OPENCL_HEADERS"} /usr/include /usr/local/include \
  ${CUDA_HOME:+"$CUDA_HOME/include"} /usr/local/cuda/include /opt/rocm/include \
  ${CONDA_PREFIX:+"$CONDA_PREFIX/include"})"
command -v cmake > /dev/null || missing+=("cmake, 3.22 or newer (package cmake)")
command -v "${compiler:-none}" > /dev/null ||
  missing+=("a compiler of C++17, GCC or Clang (package g++); CXX names another")
command -v make > /dev/null || command -v ninja > /dev/null ||
  missing+=("make or ninja (package make)")
[ -n "$eigen" ] || missing+=(
  "Eigen's headers (package libeigen3-dev, or unpacked: EIGEN=the folder that contains Eigen/Core)")
[ -n "$headers" ] || missing+=("OpenCL's headers (package opencl-c-headers, or unpacked:
    OPENCL_HEADERS=the folder that contains CL/cl.h)")
if [ ${#missing[@]} -gt 0 ]; then
  printf 'Missing:\n' >&2
  printf '  %s\n' "${missing[@]}" >&2
  exit 2
fi

# Headers that were only unpacked come without Eigen's package for CMake.
mkdir -p "$build/eigen"
cat > "$build/eigen/Eigen3Config.cmake" << TEXT
if (NOT TARGET Eigen3::Eigen)
  add_library(Eigen3::Eigen INTERFACE IMPORTED)
  set_target_properties(Eigen3::Eigen PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "$eigen")
endif ()
TEXT

# logged COMMAND...: what it says goes to the log; if it fails, the log's end is shown.
logged()
{
  if ! "$@" >> "$build/build.log" 2>&1 < /dev/null; then
    printf 'Failed: %s\nThe end of %s:\n' "$*" "$build/build.log" >&2
    tail -n 40 "$build/build.log" >&2
    exit 2
  fi
}

processors="$(getconf _NPROCESSORS_ONLN)"
minutes=$((1 + 8 / processors))
echo "Building in $build: about $minutes min the first time; log: $build/build.log" >&2
: > "$build/build.log"
logged cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$compiler" \
  -DEigen3_DIR="$build/eigen" -DRectifiedTransport_OPENCL=ON \
  -DRectifiedTransport_OPENCL_HEADERS="$headers" -DRectifiedTransport_BUILD_VTK=OFF \
  -DRectifiedTransport_BUILD_DEVICE_REPORT=ON
logged cmake --build "$build" --target RectifiedTransportDeviceReport -j "$processors"

commit="$(git -C "$root" describe --always --dirty 2> /dev/null || echo 'no commit')"
code=0
{
  echo "RectifiedTransport, $commit, $(uname -srm)"
  echo
  "$build/bin/RectifiedTransportDeviceReport" "$@"
} | tee "$report" || code=${PIPESTATUS[0]}
if [ "$code" = 77 ]; then
  cat >&2 << 'TEXT'

If the list above lacks the GPU, the OpenCL part of its driver is missing:
  the loader libOpenCL.so.1          package ocl-icd-libopencl1
  a file in /etc/OpenCL/vendors/     that names the driver's library: nvidia.icd, amdocl64.icd or
                                     intel.icd. In a container it is often missing; for NVIDIA:
    mkdir -p /etc/OpenCL/vendors && echo libnvidia-opencl.so.1 > /etc/OpenCL/vendors/nvidia.icd
TEXT
elif [ "$code" != 2 ]; then
  echo "Please send $report" >&2
fi
exit "$code"
