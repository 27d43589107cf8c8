#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is missing, builds, and remakes the examples' pictures in Examples/output.
source "$(dirname "${BASH_SOURCE[0]}")/../CMake/setup.sh"

if [ $# -gt 0 ]; then
  echo "usage: bash Examples/run.sh (examples take arguments themselves: see their README.md)"
  [ "$1" = --help ]
  exit
fi

need_to_build $packages_render $packages_examples
need_meshes
build_release

output="$root/Examples/output"
mkdir -p "$output"
for script in "$root"/Examples/*/run.py; do
  say "$(basename "$(dirname "$script")")"
  with_display pvpython "$script" --output "$output" < /dev/null
done
say "StippleImage in C++"
with_display "$build/bin/StippleImage" "$root/Testing/Data/raccoon.png" \
  "$output/stipple-cxx.png" < /dev/null
say "LiveStippling, driving itself"
with_display env OMP_WAIT_POLICY=passive "$build/bin/LiveStippling" --drive 300 \
  --picture "$output/live-stippling.png" < /dev/null

say "The pictures are in $output:"
ls "$output"
