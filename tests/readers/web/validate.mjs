// SPDX-License-Identifier: Apache-2.0
// The validator of glTF: how many errors and warnings a file has.
import fs from "node:fs";
import validator from "gltf-validator";

const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[2])));
const { numErrors: errors, numWarnings: warnings, messages } = report.issues;
console.log(JSON.stringify({ errors, warnings, messages }));
