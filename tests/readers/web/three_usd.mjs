// SPDX-License-Identifier: Apache-2.0
// What the USD parser of three.js finds in a .usda.
import fs from "node:fs";
import { USDAParser } from "three/examples/jsm/loaders/usd/USDAParser.js";

const { specsByPath } = new USDAParser().parseData(fs.readFileSync(process.argv[2], "utf8"));
const specOf = (path) => specsByPath[path].fields;
const root = specOf("/");
const levels = Object.keys(specsByPath)
    .filter((path) => /^\/[^/.]*\/level_\d+$/.test(path))
    .map((path) => {
        const value = (name) => specOf(`${path}.${name}`).default;
        const inThrees = (numbers) => (Array.isArray(numbers[0]) ? numbers
            : Array.from({ length: numbers.length / 3 }, (_, i) => [...numbers.slice(3 * i, 3 * i + 3)]));
        return {
            level: Number(path.split("_").pop()),
            points: inThrees([...value("points")]),
            extent: inThrees([...value("extent")]),
            widths: [...value("widths")],
            ids: [...value("ids")].map(Number),
            parents: [...value("primvars:parent")],
        };
    })
    .sort((a, b) => a.level - b.level);
const { defaultPrim, metersPerUnit, upAxis } = root;
console.log(JSON.stringify({ defaultPrim, metersPerUnit, upAxis, levels }));
