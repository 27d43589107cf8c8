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
failed=()

# draw NAME COMMAND...: one that fails is named at the end, and the others are drawn.
draw()
{
  local name="$1"
  shift
  say "$name"
  with_display "$@" < /dev/null || {
    [ $? != 130 ] || exit 130 # interrupted
    failed+=("$name")
  }
}

for script in "$root"/Examples/*/run.py; do
  draw "$(basename "$(dirname "$script")")" pvpython "$script" --output "$output"
done
draw "StippleImage in C++" "$build/bin/StippleImage" "$root/Testing/Data/raccoon.png" \
  "$output/stipple-cxx.png"
draw "LiveStippling, driving itself" env OMP_WAIT_POLICY=passive "$build/bin/LiveStippling" \
  --drive 300 --picture "$output/live-stippling.png"

say "The pictures are in $output:"
ls "$output"
if [ ${#failed[@]} -gt 0 ]; then
  say "Failed, see above: $(printf '%s, ' "${failed[@]}" | sed 's/, $//')" >&2
  exit 1
fi
