// SPDX-License-Identifier: Apache-2.0
// The scene that three.js makes of a .glb: its instances as spheres, or how many triangles it has.
import fs from "node:fs";

globalThis.self = globalThis; // the loader is made for browsers
const { Matrix4, Vector3 } = await import("three");
const { GLTFLoader } = await import("three/examples/jsm/loaders/GLTFLoader.js");

const file = fs.readFileSync(process.argv[2]);
const bytes = file.buffer.slice(file.byteOffset, file.byteOffset + file.byteLength);
const gltf = await new Promise((resolve, reject) => new GLTFLoader().parse(bytes, "", resolve, reject));
const result = { spheres: [], ids: [], triangles: 0 };
gltf.scene.updateMatrixWorld(true);
gltf.scene.traverse((node) => {
    if (!node.isMesh) return;
    if (!node.isInstancedMesh) {
        result.triangles += node.geometry.index.count / 3;
        return;
    }
    const matrix = new Matrix4();
    for (let i = 0; i < node.count; ++i) {
        node.getMatrixAt(i, matrix);
        matrix.premultiply(node.matrixWorld);
        const center = new Vector3().setFromMatrixPosition(matrix);
        result.spheres.push([...center.toArray(), new Vector3().setFromMatrixScale(matrix).x]);
        result.ids.push(node.geometry.getAttribute("_ID").getX(i));
    }
});
console.log(JSON.stringify(result));
