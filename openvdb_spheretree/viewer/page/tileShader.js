// SPDX-License-Identifier: Apache-2.0
// Balls by pixels, for drawing in software: each pixel goes through those few that it may show
// (tiles.js). Balls of a solid object lie many hundred deep, and triangles would draw them all.

const kTileFragmentShader = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp usampler2D;
uniform usampler2D tiles;   // where the list of a pixel begins and ends
uniform usampler2D entries; // a ball, and from where on a ray of the pixel may meet it
                            // (the bits of a float); ${kTextureWidth} to a row
uniform vec2 size;
out vec4 painted;

${kLighting}
${kBallFunctions}

void main()
{
    vec2 place = (2.0 * gl_FragCoord.xy / size - 1.0) / vec2(projection[0][0], projection[1][1]);
    vec3 ray = normalize(vec3(place, -1));
    Hit hit = Hit(1e30, vec3(0), 0.0);
    int found = -1;
    uvec2 range = texelFetch(tiles, ivec2(gl_FragCoord.xy), 0).rg;
    for (uint i = range.x; i < range.y; ++i) {
        uvec2 entry = texelFetch(entries, texelOf(int(i)), 0).rg;
        if (-ray.z * uintBitsToFloat(entry.g) > hit.distance) continue;
        int number = int(entry.r);
        if (meets(ballOf(number), ray, hit)) found = number;
    }
    if (found < 0) discard;
    gl_FragDepth = depthOf(hit.distance);
    painted = vec4(shown(colorOf(found), hit, ray), 1);
}`;
