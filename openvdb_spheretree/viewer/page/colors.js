// SPDX-License-Identifier: Apache-2.0
// Colours of spheres, as bytes of sRGB. Hues come from Oklab (Ottosson 2020), where colours of one
// lightness look equally light.

/** @returns red, green and blue, 0 to 255 */
function oklab(lightness, chroma, turns) {
    const a = chroma * Math.cos(2 * Math.PI * turns),
        b = chroma * Math.sin(2 * Math.PI * turns);
    const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
    const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
    const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
    const linear = [
        4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
        -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
        -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
    ];
    return linear.map((value) => {
        const v = clamp(value, 0, 1);
        return Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055));
    });
}

/** Numbers side by side get hues far apart: steps of the golden ratio never meet. */
function colorOfNumber(number) {
    const kGoldenRatio = 0.6180339887498949;
    return oklab(number % 2 ? 0.7 : 0.79, 0.125, 0.62 + number * kGoldenRatio);
}

/** From 0, violet and dark, to 1, yellow and light. */
function colorOfShare(share) {
    return oklab(0.42 + 0.46 * share, 0.13, 0.82 - 0.57 * share);
}

/** Place of a radius between the smallest and the largest one, by ratios. */
function radiusShare(radius, low, high) {
    return high > low && low > 0 ? clamp(Math.log(radius / low) / Math.log(high / low), 0, 1) : 0.5;
}

/** Bytes of `count` colours, computed once: spheres are many. */
function palette(count, colorAt) {
    const bytes = new Uint8Array(3 * count);
    for (let i = 0; i < count; ++i) bytes.set(colorAt(i), 3 * i);
    return (bytesOut, at, i) => {
        for (let c = 0; c < 3; ++c) bytesOut[at + c] = bytes[3 * i + c];
    };
}
const kShares = 255,
    kNumbers = 1024;
const putShare = palette(kShares + 1, (i) => colorOfShare(i / kShares));
const putNumber = palette(kNumbers, colorOfNumber);

const shareOfLevel = (tree, level) =>
    tree.levels.length > 1 ? tree.levels.indexOf(level) / (tree.levels.length - 1) : 0.5;

/**
 * Four bytes for each sphere that is shown.
 * @param by 'parent', 'level' or 'radius'. Without parents, every sphere has its own colour.
 * @param range smallest and largest radius of the scale
 */
function colorsOf(tree, shown, by, range) {
    const { spheres, ids, level } = shown;
    const bytes = new Uint8Array(4 * ids.length);
    const paint = (place) => ids.forEach((id, i) => place(4 * i, id));
    const paintShare = (share) =>
        paint((at, id) => putShare(bytes, at, Math.round(kShares * share(id))));
    if (by === 'level' && level) {
        paintShare(() => shareOfLevel(tree, level));
    } else if (by === 'level') {
        // A cut is of no level. Its spheres are as coarse as the cuts that they begin in.
        const most = Math.log(Math.max(tree.mostSpheres, 2));
        paintShare((id) => 1 - Math.log(spheres.first[id]) / most);
    } else if (by === 'radius') {
        paintShare((id) => radiusShare(spheres.radius[id], range.low, range.high));
    } else {
        const haveParents = ids.some((id) => spheres.parent[id] >= 0);
        paint((at, id) =>
            putNumber(bytes, at, Math.max(haveParents ? spheres.parent[id] : id, 0) % kNumbers),
        );
    }
    return bytes;
}
