// SPDX-License-Identifier: Apache-2.0
// Which ball a ray meets first, by the same rules as ballShader.js.

/** The part of a ray inside a ball, as two distances; null if there is none. */
function insideBall(ray, shapes, i, look) {
    const apart = minus(ray.origin, shapes.subarray(4 * i, 4 * i + 3));
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

/** How near a ball is that a ray shows; of balls that the clip plane cuts, the one that the ray is
 *  deepest in is nearest, and of discs the smallest one. Infinite if the ray does not meet it. */
function orderOf(ray, kept, view, shapes, i, look) {
    const inside = insideBall(ray, shapes, i, look);
    if (!inside) return Infinity;
    const begin = Math.max(inside[0], kept[0]),
        end = Math.min(inside[1], kept[1]);
    const forward = -dot(ray.direction, view.z);
    if (begin > end || begin * forward < view.near) return Infinity;
    const radius = shapes[4 * i + 3];
    if (look.flatNormal) return begin * forward + Number(kFront) * radius;
    if (begin === inside[0]) return begin * forward;
    const hit = plus(ray.origin, scaled(ray.direction, begin));
    const apart = minus(hit, shapes.subarray(4 * i, 4 * i + 3));
    return begin * forward + Number(kFront) * (dot(apart, apart) / radius - radius);
}

/** The place among `shapes` of the ball that the ray shows; -1 if it meets none. */
function pick(ray, view, shapes, look) {
    const kept = keptBy(look.clip, ray);
    let found = -1,
        least = Infinity;
    for (let i = 0; 4 * i < shapes.length; ++i) {
        const order = orderOf(ray, kept, view, shapes, i, look);
        if (order >= least) continue;
        least = order;
        found = i;
    }
    return found;
}
