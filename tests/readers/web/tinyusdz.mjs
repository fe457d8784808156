// SPDX-License-Identifier: Apache-2.0
// What tinyusdz finds in a .usda: it checks the types of attributes, and prints the layer back.
import fs from "node:fs";
import { createRequire } from "node:module";

process.type = "renderer"; // it is made for browsers alone
globalThis.window = globalThis;
globalThis.self = globalThis;
const folder = createRequire(import.meta.url).resolve("tinyusdz/package.json").replace("package.json", "");
// Its package does not say that it is a module; node 18, which Debian has, goes by the name of the file alone.
fs.copyFileSync(`${folder}tinyusdz.js`, `${folder}tinyusdz.mjs`);
const { default: init } = await import("tinyusdz/tinyusdz.mjs");
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
const [prims, choices] = text.split('variantSet "level" =');
/// Of a sample, or of what has no time.
const levelsAt = (time) => prims.split(/def Points "level_/).slice(1).map((prim) => {
    const start = (name) => time === null ? ` ${name} =` : ` ${name}\\.timeSamples = \\{[^}]*\\s${time}:`;
    const value = (name) => numbersOf(prim.match(new RegExp(`${start(name)} \\[([^\\]]*)\\]`))[1]);
    return {
        level: Number(prim.match(/^\d+/)[0]),
        points: inThrees(value("points")),
        extent: inThrees(value("extent")),
        widths: value("widths"),
        ids: value("widths").map(() => null), // of an int64 it prints the first digit alone
        parents: value("primvars:parent"),
    };
}).sort((a, b) => a.level - b.level);
const sampled = prims.match(/points\.timeSamples = \{([^}]*)\}/);
const times = sampled ? [...sampled[1].matchAll(/(\S+): \[/g)].map((match) => match[1]) : [];
/// Which levels are seen with each choice of a level.
const shown = [...choices.matchAll(/"(level_\d+)" \{([\s\S]*?)\n {8}\}/g)].map(([, choice, overs]) => [choice,
    [...overs.matchAll(/over "(level_\d+)"\s*\{\s*token visibility = "inherited"/g)].map((match) => match[1])]);
console.log(JSON.stringify({
    defaultPrim: field("defaultPrim"),
    metersPerUnit: Number(field("metersPerUnit")),
    upAxis: field("upAxis"),
    levels: sampled ? [] : levelsAt(null),
    samples: times.map((time) => ({ time: Number(time), levels: levelsAt(time) })),
    chosen: field("string level"),
    shown: Object.fromEntries(shown),
}));
