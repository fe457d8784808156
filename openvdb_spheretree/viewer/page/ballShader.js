// SPDX-License-Identifier: Apache-2.0
// Where a ray meets a ball, for both ways of drawing them. The ray of each pixel is cut with the
// ball itself and with the clip plane: what is seen is exact from any distance, and a ball that is
// cut open is solid inside. Balls of norms are polyhedra between pairs of parallel faces, those of
// flat trees are discs. All is seen from the eye: it is at the origin and looks along -z.

const kBallFunctions = `
uniform sampler2D spheres;  // x, y, z, radius; ${kTextureWidth} to a row
uniform sampler2D colors;
uniform mat4 view, projection;
uniform float near;
uniform float pixel;        // how large one is at distance 1
uniform bool isKnown;       // that every ray meets the ball that it is tried with
uniform int selected;       // -1: none
uniform vec3 accent;
uniform vec4 clip;          // kept is where dot(clip.xyz, p) + clip.w >= 0
uniform int faceCount;      // pairs of faces of a norm's ball; 0: a sphere
uniform vec3 faces[${kMaxFaces}];
uniform vec3 flatNormal;    // of discs; 0: there are none

ivec2 texelOf(int number)
{
    return ivec2(number & ${kTextureWidth - 1}, number >> ${Math.log2(kTextureWidth)});
}

// Never so small that it is invisible.
vec4 ballOf(int number)
{
    vec4 stored = texelFetch(spheres, texelOf(number), 0);
    vec3 center = (view * vec4(stored.xyz, 1)).xyz;
    return vec4(center, max(stored.w, 0.75 * pixel * -center.z));
}

vec3 colorOf(int number)
{
    vec3 color = texelFetch(colors, texelOf(number), 0).rgb;
    return number == selected ? mix(color, accent, 0.75) : color;
}

// Distances along the ray from where to where it is inside; the second is smaller if it never is.
vec2 insidePolyhedron(vec4 ball, vec3 apart, vec3 ray, out vec3 normal)
{
    vec2 span = vec2(-1e30, 1e30);
    for (int i = 0; i < faceCount; ++i) {
        float speed = dot(faces[i], ray), middle = -dot(faces[i], apart);
        if (abs(speed) < 1e-12) {
            if (abs(middle) > ball.w) return vec2(1, 0);
            continue;
        }
        float entry = (middle - sign(speed) * ball.w) / speed;
        span.y = min(span.y, (middle + sign(speed) * ball.w) / speed);
        if (entry <= span.x) continue;
        span.x = entry;
        normal = normalize(-sign(speed) * faces[i]);
    }
    return span;
}

vec2 insideDisc(vec4 ball, vec3 apart, vec3 ray, out vec3 normal)
{
    float speed = dot(flatNormal, ray);
    normal = -sign(speed) * flatNormal;
    float t = -dot(flatNormal, apart) / speed;
    vec3 aside = apart + t * ray;
    return dot(aside, aside) <= ball.w * ball.w ? vec2(t) : vec2(1, 0);
}

// How far in front of itself a ball may be met where the clip plane cuts it, in radii.
const float kFront = ${kFront};

struct Hit {
    float distance; // from the plane of the eye; a little off where that decides what is in front
    vec3 normal;
    float light;    // 0: by the normal
};

// Whether the ray meets the ball in front of best, which is then where.
bool meets(vec4 ball, vec3 ray, inout Hit best)
{
    vec3 apart = -ball.xyz;
    float along = -dot(apart, ray);
    vec3 aside = apart + along * ray;
    float half2 = ball.w * ball.w - dot(aside, aside);
    if (isKnown) half2 = max(half2, 0.0); // whatever rounding says
    // Nearly all balls are done with here.
    float least = best.distance + kFront * ball.w;
    if (faceCount == 0 && (half2 < 0.0 || (sqrt(half2) - along) * ray.z >= least)) return false;
    vec2 span;
    vec3 normal;
    bool isDisc = flatNormal != vec3(0);
    if (faceCount > 0) {
        span = insidePolyhedron(ball, apart, ray, normal);
    } else if (isDisc) {
        span = insideDisc(ball, apart, ray, normal);
    } else {
        float half1 = sqrt(half2);
        span = vec2(along - half1, along + half1);
        normal = (aside - half1 * ray) / ball.w;
    }
    float speed = dot(clip.xyz, ray), height = clip.w;
    if (speed == 0.0 && height < 0.0) return false;
    float cut = -height / speed;
    bool isCut = speed > 0.0 && cut > span.x;
    if (isCut) span.x = cut;
    else if (speed < 0.0) span.y = min(span.y, cut);
    vec3 hit = span.x * ray;
    float distance = -hit.z;
    if (!isKnown && (span.x > span.y || distance < near)) return false;
    // Of faces in one plane, in front is the ball that a point is deepest in, and the smallest
    // disc.
    if (isCut) distance += kFront * (dot(hit - ball.xyz, hit - ball.xyz) / ball.w - ball.w);
    if (isDisc) distance += kFront * ball.w;
    if (distance >= best.distance) return false;
    best.distance = distance;
    best.normal = isCut ? -clip.xyz : normal;
    best.light = isCut ? 0.78 : 0.0;
    if (isDisc) { // with a rim, to tell them apart
        float inwards = (ball.w - length(hit - ball.xyz)) / pixel;
        best.light = mix(0.55, 1.0, smoothstep(0.0, 2.0, inwards));
    }
    return true;
}

vec3 shown(vec3 color, Hit hit, vec3 ray)
{
    return hit.light > 0.0 ? color * hit.light : lit(color, hit.normal, ray);
}

float depthOf(float distance)
{
    vec2 position = mat2(projection[2].zw, projection[3].zw) * vec2(-distance, 1);
    return clamp(0.5 * position.x / position.y + 0.5, 0.0, 1.0);
}`;
