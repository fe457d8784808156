// SPDX-License-Identifier: Apache-2.0
// The scenes that three.js makes of a .glb, the one that is shown first: instances as spheres, or the corners of triangles.
import fs from "node:fs";

globalThis.self = globalThis; // the loader is made for browsers
const { Matrix4, Vector3 } = await import("three");
const { GLTFLoader } = await import("three/examples/jsm/loaders/GLTFLoader.js");

const file = fs.readFileSync(process.argv[2]);
const bytes = file.buffer.slice(file.byteOffset, file.byteOffset + file.byteLength);
const gltf = await new Promise((resolve, reject) => new GLTFLoader().parse(bytes, "", resolve, reject));
const numbersOf = (scene) => {
    const result = { name: scene.name, spheres: [], ids: [], parents: [], corners: [] };
    scene.updateMatrixWorld(true);
    scene.traverse((node) => {
        if (!node.isMesh) return;
        if (!node.isInstancedMesh) {
            const points = node.geometry.getAttribute("position");
            for (const corner of node.geometry.index.array) {
                const point = new Vector3().fromBufferAttribute(points, corner);
                result.corners.push(point.applyMatrix4(node.matrixWorld).toArray());
            }
            return;
        }
        const matrix = new Matrix4();
        for (let i = 0; i < node.count; ++i) {
            node.getMatrixAt(i, matrix);
            matrix.premultiply(node.matrixWorld);
            const center = new Vector3().setFromMatrixPosition(matrix);
            result.spheres.push([...center.toArray(), new Vector3().setFromMatrixScale(matrix).x]);
            result.ids.push(node.geometry.getAttribute("_ID").getX(i));
            result.parents.push(node.geometry.getAttribute("_PARENT").getX(i));
        }
    });
    return result;
};
const others = gltf.scenes.filter((scene) => scene !== gltf.scene);
console.log(JSON.stringify([gltf.scene, ...others].map(numbersOf)));
