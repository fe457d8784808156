// SPDX-License-Identifier: Apache-2.0
// What tinyusdz finds in a .usda: it checks the types of attributes, and prints the layer back.
import fs from "node:fs";
import { createRequire } from "node:module";

process.type = "renderer"; // it is made for browsers alone
globalThis.window = globalThis;
globalThis.self = globalThis;
const folder = createRequire(import.meta.url).resolve("tinyusdz/package.json").replace("package.json", "");
const { default: init } = await import("tinyusdz/tinyusdz.js");
const module = await init({ wasmBinary: fs.readFileSync(`${folder}tinyusdz.wasm`) });
const bytes = fs.readFileSync(process.argv[2]);
const checker = new module.TinyUSDZLoaderNative();
if (!checker.loadFromBinary(bytes, "tree.usda")) throw new Error(checker.error());
const loader = new module.TinyUSDZLoaderNative();
if (!loader.loadAsLayerFromBinary(bytes, "tree.usda")) throw new Error(loader.error());
const text = loader.layerToString();

const field = (name) => text.match(new RegExp(`${name} = "?([^"\\n]*)"?`))[1];
const numbersOf = (list) => list.match(/-?[\d.]+(e[-+]?\d+)?/g).map(Number);
const inThrees = (numbers) =>
    Array.from({ length: numbers.length / 3 }, (_, i) => numbers.slice(3 * i, 3 * i + 3));
const levels = text.split(/def Points "level_/).slice(1).map((prim) => {
    const value = (name) => numbersOf(prim.match(new RegExp(` ${name} = \\[([^\\]]*)\\]`))[1]);
    return {
        level: Number(prim.match(/^\d+/)[0]),
        points: inThrees(value("points")),
        extent: inThrees(value("extent")),
        widths: value("widths"),
        ids: value("widths").map(() => null), // of an int64 it prints the first digit alone
        parents: value("primvars:parent"),
    };
});
levels.sort((a, b) => a.level - b.level);
console.log(JSON.stringify({
    defaultPrim: field("defaultPrim"),
    metersPerUnit: Number(field("metersPerUnit")),
    upAxis: field("upAxis"),
    levels,
}));
