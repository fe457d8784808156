// SPDX-License-Identifier: Apache-2.0
// Which sphere a ray meets first, by the same rules as the shader.

/** The part of a ray inside a ball, as two distances; null if there is none. */
function insideBall(ray, shapes, i, look) {
    const apart = minus(ray.origin, [shapes[4 * i], shapes[4 * i + 1], shapes[4 * i + 2]]);
    const radius = shapes[4 * i + 3];
    const along = dot(apart, ray.direction);
    const outer = radius * look.reach;
    const half2 = outer * outer - Math.max(0, dot(apart, apart) - along * along);
    if (half2 < 0) return null;
    if (look.flatNormal) {
        const t = -dot(look.flatNormal, apart) / dot(look.flatNormal, ray.direction);
        return Math.hypot(...plus(apart, scaled(ray.direction, t))) <= radius ? [t, t] : null;
    }
    if (look.faces.length === 0) return [-along - Math.sqrt(half2), -along + Math.sqrt(half2)];
    let [begin, end] = [-Infinity, Infinity];
    for (const face of look.faces) {
        const speed = dot(face, ray.direction),
            middle = -dot(face, apart);
        if (Math.abs(speed) < 1e-12) {
            if (Math.abs(middle) > radius) return null;
            continue;
        }
        begin = Math.max(begin, (middle - Math.sign(speed) * radius) / speed);
        end = Math.min(end, (middle + Math.sign(speed) * radius) / speed);
    }
    return begin <= end ? [begin, end] : null;
}

/** The same of the half-space that the clip plane keeps. */
function keptBy(plane, ray) {
    if (!plane) return [-Infinity, Infinity];
    const speed = dot(plane.normal, ray.direction);
    const height = dot(plane.normal, ray.origin) + plane.offset;
    if (speed === 0) return height >= 0 ? [-Infinity, Infinity] : [1, 0];
    return speed > 0 ? [-height / speed, Infinity] : [-Infinity, -height / speed];
}

/** The place among `shapes` of the ball that the ray meets first; -1 if it meets none. Where the
 *  clip plane cuts several open, it is the one that the ray is deepest in. */
function pick(ray, view, shapes, look) {
    const kept = keptBy(look.clip, ray);
    let found = -1,
        first = Infinity,
        power = Infinity;
    for (let i = 0; 4 * i < shapes.length; ++i) {
        const inside = insideBall(ray, shapes, i, look);
        if (!inside) continue;
        const begin = Math.max(inside[0], kept[0]),
            end = Math.min(inside[1], kept[1]);
        if (begin > end || begin < view.near || begin > first) continue;
        const hit = plus(ray.origin, scaled(ray.direction, begin));
        const radius = shapes[4 * i + 3];
        const apart = minus(hit, [shapes[4 * i], shapes[4 * i + 1], shapes[4 * i + 2]]);
        const own = look.flatNormal ? radius : (dot(apart, apart) / (radius * radius) - 1) * radius;
        if (begin === first && own >= power) continue;
        [found, first, power] = [i, begin, own];
    }
    return found;
}
