// SPDX-License-Identifier: BSD-3-Clause
// Makes a cartogram with go-cart-wasm, the program of Gastner, Seguy and More (2018), and notes its
// processor time and memory, in a process of its own. It raises small masses itself: it gets `people`
// where the map has them.
//
// usage: npm install go-cart-wasm; node go_cart.mjs map.geojson out.geojson
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";

const require = createRequire(join(process.cwd(), "package.json"));
const program = require.resolve("go-cart-wasm");
const makeProgram = require(program);
const [source, target] = process.argv.slice(2);
const wasm = join(dirname(program), "cart.wasm");
const goCart = await makeProgram({ locateFile: () => wasm });
const map = JSON.parse(readFileSync(source, "utf-8"));
const field = "people" in map.features[0].properties ? "people" : "mass";
const before = process.cpuUsage();
const made = goCart.makeCartogram(map, field);
const { user, system } = process.cpuUsage(before);
const { maxRSS } = process.resourceUsage();
made.seconds = (user + system) / 1e6;
made.megabytes = maxRSS * 1024 / 1e6;
writeFileSync(target, JSON.stringify(made));
console.log(`${made.seconds.toFixed(1)} s, ${made.megabytes.toFixed(0)} MB`);
