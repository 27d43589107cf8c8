#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# UNTRIED. Builds the plugin for Kitware's own ParaView: first ParaView's development kit with Kitware's
# superbuild, which takes hours and 30 GB, then the project against it. Documentation/Packages.md says
# where to run it, and what must agree.
set -euo pipefail
source="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"

if [ $# != 2 ] || ! [[ "$1" =~ ^[0-9]+\.[0-9]+\.[0-9]+$ ]]; then
  echo "usage: bash CMake/Kitware/build.sh VERSION FOLDER: the version of Kitware's ParaView, as 5.11.0," \
    "and a folder to build in" >&2
  exit 2
fi
for program in git cmake ninja c++; do
  if ! command -v "$program" > /dev/null; then
    echo "$program is needed and not there" >&2
    exit 1
  fi
done
version="$1"
mkdir -p "$2"
folder="$(cd "$2" && pwd)"
kit="$folder/paraviewsdk"

if [ ! -d "$folder/superbuild" ]; then
  git clone --recursive --branch "v$version" \
    https://gitlab.kitware.com/paraview/paraview-superbuild.git "$folder/superbuild"
fi
cmake -S "$folder/superbuild" -B "$folder/superbuild-build" -G Ninja \
  -DCMAKE_BUILD_TYPE_paraview=Release \
  -DCMAKE_INSTALL_PREFIX="$kit" \
  -DSUPERBUILD_DEFAULT_INSTALL=paraviewsdk/TGZ \
  -Dparaview_SOURCE_SELECTION="$version" \
  -DENABLE_paraview=ON -DENABLE_paraviewsdk=ON \
  -DENABLE_mpi=ON -DENABLE_python3=ON -DENABLE_numpy=ON
cmake --build "$folder/superbuild-build" --target install

package="$(dirname "$(find "$kit" -name paraview-config.cmake | head -n 1)")"
if [ ! -f "$package/paraview-config.cmake" ]; then
  echo "The superbuild has put no paraview-config.cmake into $kit" >&2
  exit 1
fi
cmake -S "$source" -B "$folder/rectifiedtransport-build" -G Ninja \
  -DCMAKE_BUILD_TYPE=Release \
  -DParaView_DIR="$package" \
  -DCMAKE_INSTALL_PREFIX="$folder/rectifiedtransport" \
  -DCMAKE_INSTALL_LIBDIR=lib \
  -DRectifiedTransport_BUILD_PARAVIEW_PLUGIN=ON \
  -DRectifiedTransport_BUILD_HELP=OFF
cmake --build "$folder/rectifiedtransport-build" --target install
echo "Start Kitware's ParaView $version with PV_PLUGIN_PATH=$(
  dirname "$(find "$folder/rectifiedtransport" -name RectifiedTransport.so | head -n 1)")"
