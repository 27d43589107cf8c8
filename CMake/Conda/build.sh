#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# UNTRIED. Called by rattler-build in the folder of the sources, with the variables of conda's builds.
set -euo pipefail

# shellcheck disable=SC2086,SC2154
cmake -S . -B build-conda -G Ninja ${CMAKE_ARGS:-} \
  -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$PREFIX" \
  -DCMAKE_INSTALL_PREFIX="$PREFIX" \
  -DCMAKE_INSTALL_LIBDIR=lib \
  -DPython3_EXECUTABLE="$PREFIX/bin/python" \
  -DRectifiedTransport_BUILD_PARAVIEW_PLUGIN=ON \
  -DRectifiedTransport_BUILD_HELP=OFF \
  -DRectifiedTransport_WRAP_PYTHON=ON \
  -DRectifiedTransport_PYTHON_DIR="lib/python$PY_VER/site-packages"
cmake --build build-conda -j "${CPU_COUNT:-2}"
cmake --install build-conda

for step in activate deactivate; do
  mkdir -p "$PREFIX/etc/conda/$step.d"
  cp "CMake/Conda/$step.sh" "$PREFIX/etc/conda/$step.d/rectifiedtransport.sh"
done
