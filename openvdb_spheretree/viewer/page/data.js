// SPDX-License-Identifier: Apache-2.0
// The tree as the page holds it: a description as JSON, and arrays as base64 of little-endian
// numbers, each in an element of its own.

/** The bytes of a text without line breaks. A part at a time: the whole as one
 *  more string would double the memory. */
function decodeBase64(text) {
    const kPart = 1 << 20; // whole groups of four characters
    const clean = text.trim();
    const padding = clean.endsWith('==') ? 2 : clean.endsWith('=') ? 1 : 0;
    const bytes = new Uint8Array((clean.length / 4) * 3 - padding);
    let at = 0;
    for (let begin = 0; begin < clean.length; begin += kPart) {
        const part = atob(clean.slice(begin, begin + kPart));
        for (let i = 0; i < part.length; ++i) bytes[at++] = part.charCodeAt(i);
    }
    return bytes.buffer;
}

/** An array of the page, as `Type`; the element is emptied, so that its text does not stay. */
function readArray(name, Type) {
    const element = document.getElementById(name);
    const array = new Type(decodeBase64(element.textContent));
    element.remove();
    return array;
}

/** Spheres with parents, as the library has them: `center` has three world coordinates each. */
class SphereArrays {
    constructor(prefix) {
        this.center = readArray(`${prefix}-center`, Float64Array);
        this.radius = readArray(`${prefix}-radius`, Float32Array);
        this.parent = readArray(`${prefix}-parent`, Int32Array);
        this.size = this.radius.length;
    }

    centerOf(id) {
        return Array.from(this.center.subarray(3 * id, 3 * id + 3));
    }

    /** Ids of all spheres whose parent this is, ascending. */
    childrenOf(id) {
        this.children ??= this.#linkChildren();
        const { first, ids } = this.children;
        return Array.from(ids.subarray(first[id], first[id + 1]));
    }

    /** Children by parent: those of `id` are ids[first[id]] to ids[first[id + 1] - 1]. */
    #linkChildren() {
        const first = new Int32Array(this.size + 2);
        for (const parent of this.parent) if (parent >= 0) ++first[parent + 2];
        for (let i = 2; i < first.length; ++i) first[i] += first[i - 1];
        const ids = new Int32Array(first[first.length - 1]);
        this.parent.forEach((parent, id) => {
            if (parent >= 0) ids[first[parent + 1]++] = id;
        });
        return { first, ids };
    }
}

/** All that the page was written with. */
class SphereTree {
    constructor() {
        Object.assign(this, JSON.parse(document.getElementById('tree').textContent));
        this.nodes = new SphereArrays('nodes');
        if (this.has_cuts) {
            this.cuts = new SphereArrays('cuts');
            this.cuts.first = readArray('cuts-first', Int32Array);
            this.cuts.last = readArray('cuts-last', Int32Array);
            this.mostSpheres = this.cuts.last.reduce((most, last) => Math.max(most, last), 1);
        }
        if (this.surface) {
            this.surface.points = readArray('surface-points', Float32Array);
            this.surface.quads = readArray('surface-quads', Uint32Array);
        }
        for (const level of this.levels) this.#addRadii(level);
    }

    #addRadii(level) {
        level.spheres = level.end - level.begin;
        level.radiusMin = Infinity;
        level.radiusMax = 0;
        for (const radius of this.nodes.radius.subarray(level.begin, level.end)) {
            level.radiusMin = Math.min(level.radiusMin, radius);
            level.radiusMax = Math.max(level.radiusMax, radius);
        }
    }

    /** The entry of `levels` that a node belongs to. */
    levelOf(id) {
        return this.levels.find((level) => id >= level.begin && id < level.end);
    }

    /** Ids of the cut with so many spheres. */
    cutNodes(count) {
        const { first, last, size } = this.cuts;
        const ids = [];
        for (let id = 0; id < size; ++id) if (first[id] <= count && count <= last[id]) ids.push(id);
        return Int32Array.from(ids);
    }
}
