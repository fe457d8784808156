// SPDX-License-Identifier: Apache-2.0
// The object's surface: triangles with a normal at each point.

const kSurfaceVertexShader = `#version 300 es
precision highp float;
layout(location = 0) in vec3 point;
layout(location = 1) in vec3 normal;
uniform mat4 view, projection;
out vec3 at, outwards;

void main()
{
    at = (view * vec4(point, 1)).xyz;
    outwards = mat3(view) * normal;
    gl_Position = projection * vec4(at, 1);
}`;

const kSurfaceFragmentShader = `#version 300 es
precision highp float;
uniform vec4 clip;
uniform vec3 color;
in vec3 at, outwards;
out vec4 painted;

${kLighting}

void main()
{
    if (dot(clip.xyz, at) + clip.w < 0.0) discard;
    vec3 ray = normalize(at);
    vec3 normal = normalize(outwards);
    // Where the clip plane opens the object, its inside is seen.
    bool isInside = dot(normal, ray) > 0.0;
    painted = vec4(lit(isInside ? color * 0.62 : color, isInside ? -normal : normal, ray), 1);
}`;

/** Normals of points, from all triangles around. */
function normalsOf(points, quads) {
    const normals = new Float32Array(points.length);
    const at = (i) => [points[3 * i], points[3 * i + 1], points[3 * i + 2]];
    for (let q = 0; q < quads.length; q += 4) {
        // The cross product of its diagonals is twice the area of a quad.
        const normal = cross(
            minus(at(quads[q + 2]), at(quads[q])),
            minus(at(quads[q + 3]), at(quads[q + 1])),
        );
        for (let corner = 0; corner < 4; ++corner) {
            const i = 3 * quads[q + corner];
            for (let axis = 0; axis < 3; ++axis) normals[i + axis] += normal[axis];
        }
    }
    return normals;
}

/** Two triangles for each quad. */
function trianglesOf(quads) {
    const triangles = new Uint32Array((quads.length / 4) * 6);
    for (let q = 0, t = 0; q < quads.length; q += 4) {
        for (const corner of [0, 1, 2, 0, 2, 3]) triangles[t++] = quads[q + corner];
    }
    return triangles;
}
