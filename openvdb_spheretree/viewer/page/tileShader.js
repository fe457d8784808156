// SPDX-License-Identifier: Apache-2.0
// Balls by pixels, for drawing in software: which one a pixel shows is known (tiles.js). Balls
// of a solid object lie hundreds deep, and triangles would draw them all.

const kTileFragmentShader = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp usampler2D;
uniform usampler2D seen;    // the number of a ball and 1; 0: none
uniform vec2 size;
out vec4 painted;

${kLighting}
${kBallFunctions}

void main()
{
    int number = int(texelFetch(seen, ivec2(gl_FragCoord.xy), 0).r) - 1;
    if (number < 0) discard;
    vec2 place = (2.0 * gl_FragCoord.xy / size - 1.0) / vec2(projection[0][0], projection[1][1]);
    vec3 ray = normalize(vec3(place, -1));
    Hit hit = Hit(1e30, vec3(0), 0.0);
    if (!meets(ballOf(number), ray, hit)) discard;
    gl_FragDepth = depthOf(hit.distance);
    painted = vec4(shown(colorOf(number), hit, ray), 1);
}`;
