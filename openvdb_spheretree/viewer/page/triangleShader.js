// SPDX-License-Identifier: Apache-2.0
// Balls as triangles that just hold their outlines, for graphics cards. One triangle for each, its
// corners made from gl_VertexID: instanced squares take several times as long in software, and
// gl.POINTS vanish where their middle leaves the view.

const kTriangleVertexShader = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
uniform float reach;        // of balls of a norm: how far corners are, in radii
out vec3 at;                // on the triangle, seen from the eye
flat out vec4 ball;
flat out vec3 color;

${kBallFunctions.replace(/struct Hit[^]*/, '')}

void main()
{
    int number = gl_VertexID / 3, corner = gl_VertexID % 3;
    ball = ballOf(number);
    color = colorOf(number);
    vec3 center = ball.xyz;
    float distance = length(center), outer = 1.0001 * ball.w * reach;
    vec2 place = corner == 0 ? vec2(0, 2) : vec2(corner == 1 ? -1.7320508 : 1.7320508, -1);
    if (distance > outer) {
        // The rays that touch a sphere do so on a circle.
        vec3 away = center / distance;
        float sine = outer / distance;
        vec3 right = normalize(cross(away, abs(away.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0)));
        vec3 up = cross(right, away);
        at = away * (distance - outer * sine)
            + outer * sqrt(1.0 - sine * sine) * (right * place.x + up * place.y);
    } else { // the eye is inside: all of the view
        vec2 whole = corner == 0 ? vec2(-1, -1) : corner == 1 ? vec2(3, -1) : vec2(-1, 3);
        gl_Position = vec4(whole, 0, 1);
        at = vec3(whole.x / projection[0][0], whole.y / projection[1][1], -1);
        return;
    }
    gl_Position = projection * vec4(at, 1);
}`;

const kTriangleFragmentShader = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
in vec3 at;
flat in vec4 ball;
flat in vec3 color;
out vec4 painted;

${kLighting}
${kBallFunctions}

void main()
{
    vec3 ray = normalize(at);
    Hit hit = Hit(1e30, vec3(0), 0.0);
    if (!meets(ball, ray, hit)) discard;
    gl_FragDepth = depthOf(hit.distance);
    painted = vec4(shown(color, hit, ray), 1);
}`;
