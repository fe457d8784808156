// SPDX-License-Identifier: Apache-2.0
// The two layers, spheres and surface, become one picture: what is nearer lies over what is behind,
// each with its opacity. Where depth jumps, edges are shaded (eye-dome lighting, Boucheny 2009),
// which tells spheres that overlap apart.

const kCompositeVertexShader = `#version 300 es
void main()
{
    gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1);
}`;

const kCompositeFragmentShader = `#version 300 es
precision highp float;
precision highp sampler2D;
uniform sampler2D sphereColor, sphereDepth, surfaceColor, surfaceDepth;
uniform vec2 opacity;       // of spheres and of the surface
uniform vec3 top, bottom;   // of the background
uniform vec2 range;         // distances of depth 0 and 1
uniform bool shaded;
uniform vec4 ring;          // around what is selected: place, radius and width, in pixels
uniform vec3 accent;
uniform vec2 size;
out vec4 painted;

float distanceOf(float depth)
{
    return range.x * range.y / (range.y - depth * (range.y - range.x));
}

float shadeOf(sampler2D depths, ivec2 place, float depth)
{
    if (depth == 1.0 || !shaded) return 1.0;
    float own = distanceOf(depth), sum = 0.0;
    int step = max(1, int(size.y / 500.0));
    for (int i = 0; i < 4; ++i) {
        ivec2 beside = place + step * ivec2(i < 2 ? 2 * i - 1 : 0, i < 2 ? 0 : 2 * i - 5);
        float other = texelFetch(depths, clamp(beside, ivec2(0), ivec2(size) - 1), 0).r;
        sum += clamp(own - distanceOf(other), 0.0, 0.06);
    }
    return exp(-4.5 * sum);
}

void main()
{
    ivec2 place = ivec2(gl_FragCoord.xy);
    vec3 color = mix(bottom, top, gl_FragCoord.y / size.y);
    float sphere = texelFetch(sphereDepth, place, 0).r;
    float surface = texelFetch(surfaceDepth, place, 0).r;
    vec3 ofSphere = texelFetch(sphereColor, place, 0).rgb * shadeOf(sphereDepth, place, sphere);
    vec3 ofSurface = texelFetch(surfaceColor, place, 0).rgb * shadeOf(surfaceDepth, place, surface);
    float coverSphere = sphere < 1.0 ? opacity.x : 0.0;
    float coverSurface = surface < 1.0 ? opacity.y : 0.0;
    if (sphere < surface) {
        color = mix(mix(color, ofSurface, coverSurface), ofSphere, coverSphere);
    } else {
        color = mix(mix(color, ofSphere, coverSphere), ofSurface, coverSurface);
    }
    float off = abs(length(gl_FragCoord.xy - ring.xy) - ring.z);
    color = mix(accent, color, smoothstep(0.5, 1.0, off / max(ring.w, 1e-3)));
    painted = vec4(color, 1);
}`;
