#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes the maps of the cartograms' benchmarks in a folder, with the cartograms of go-cart-wasm in its
# subfolder go-cart (ten minutes). Needs npm, the network and Python with NumPy.
#
# usage: make.sh FOLDER; then run.py --cartograms --maps FOLDER PROGRAM
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
python="${PYTHON:-/usr/bin/python3}"
mkdir -p "$1/packages" "$1/go-cart"
cd "$1"
npm install --silent --no-save --prefix packages world-atlas@2.0.2 us-atlas@3.0.1 go-cart-wasm@0.5.0
atlases=packages/node_modules
"$python" "$here/world_map.py" --least-masses $atlases/world-atlas/countries-110m.json world.geojson
"$python" "$here/county_map.py" $atlases/us-atlas/counties-albers-10m.json counties.geojson
"$python" "$here/square_maps.py" .
cp "$here/../../Data/us-states.geojson" packages
ln -sf ../world.geojson ../16-squares.geojson ../144-squares.geojson packages
cd packages
for map in us-states world 16-squares 144-squares; do
  echo "$map: $(node "$here/go_cart.mjs" $map.geojson ../go-cart/$map.geojson)"
done
