// SPDX-License-Identifier: Apache-2.0
// What all shaders share.

const kTextureWidth = 2048; // the least that WebGL2 promises
const kMaxFaces = 24; // pairs of faces that a ball of a chamfer norm has
const kFront = '0.01'; // see ballShader.js; as GLSL has it

/** A lamp above the eye's left shoulder, a sky, and a little light along the outline. */
const kLighting = `
vec3 lit(vec3 color, vec3 normal, vec3 ray)
{
    vec3 towardsLamp = normalize(vec3(-0.45, 0.65, 0.75));
    float lamp = max(dot(normal, towardsLamp), 0.0);
    float sky = 0.5 + 0.5 * normal.y;
    float facing = max(-dot(normal, ray), 0.0);
    float glint = pow(max(dot(reflect(ray, normal), towardsLamp), 0.0), 40.0);
    return color * (0.42 + 0.20 * sky + 0.52 * lamp) * (0.80 + 0.20 * facing) + 0.10 * glint;
}`;
