#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is missing, builds the plugin, and draws the examples' pictures in Examples/output.
source "$(dirname "${BASH_SOURCE[0]}")/../CMake/setup.sh"

# The main job, and what else a newcomer should see. None needs the meshes that are fetched.
usual=(StippleImage SampleVolume WarpedPhotograph Cartogram Districts PlumeEnsemble)

usage()
{
  cat << TEXT
usage: bash Examples/run.sh [--all | EXAMPLE...]
  Draws ${usual[*]}.
  --all    draws all examples
  EXAMPLE  draws these: names of folders in Examples, such as Morph3D
Examples take arguments themselves: see their README.md.
TEXT
}

all=0 chosen=()
while [ $# -gt 0 ]; do
  case "$1" in
    --all) all=1 ;;
    --help) usage; exit 0 ;;
    *)
      if [ ! -f "$root/Examples/$1/run.py" ]; then
        echo "There is no example '$1' that this command can draw." >&2
        usage >&2
        exit 2
      fi
      chosen+=("$1")
      ;;
  esac
  shift
done

if [ $all = 1 ]; then
  chosen=(StippleImage)
  for script in "$root"/Examples/*/run.py; do
    name="$(basename "$(dirname "$script")")"
    [ "$name" = StippleImage ] || chosen+=("$name")
  done
elif [ ${#chosen[@]} = 0 ]; then
  chosen=("${usual[@]}")
fi

need_to_build $packages_render $packages_examples
if [ "${chosen[*]}" != "${usual[*]}" ]; then
  need_meshes
fi
targets=(RectifiedTransport)
if [ $all = 1 ]; then
  targets+=(StippleImage LiveStippling)
fi
target="${targets[*]}" build_release

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

for name in "${chosen[@]}"; do
  draw "$name" pvpython "$root/Examples/$name/run.py" --output "$output"
  if [ "$name" = StippleImage ]; then
    echo "The photograph in dots is $output/stipple-raccoon.png"
  fi
done
if [ $all = 1 ]; then
  draw "StippleImage in C++" "$build/bin/StippleImage" "$root/Testing/Data/raccoon.png" \
    "$output/stipple-cxx.png"
  draw "LiveStippling, driving itself" env OMP_WAIT_POLICY=passive "$build/bin/LiveStippling" \
    --drive 300 --picture "$output/live-stippling.png"
fi

say "The pictures are in $output:"
ls "$output"
if [ ${#failed[@]} -gt 0 ]; then
  say "Failed, see above: $(printf '%s, ' "${failed[@]}" | sed 's/, $//')" >&2
  exit 1
fi
if [ $all = 0 ]; then
  echo "bash Examples/run.sh --all draws the other examples, too."
fi
