// SPDX-License-Identifier: Apache-2.0
// Which balls may be seen in which tile of the view.
//
// A tile is a bundle of rays around one in its middle. Rays meet a ball the later the more they
// pass beside its center. That bounds from below where rays of a tile meet a ball and, if all of
// them do, from above; what begins behind a ball that covers the tile is left out. Tiles begin
// large, and are cut in four until they are pixels: most balls are left out before they would be
// many.

/** From where to where a ball is seen along one axis of the view, which is -1 to 1. */
function seenSpan(center, distance, radius, halfSize) {
    // Lines from the eye that touch a circle. Where it reaches the plane of the eye, it is
    // everywhere.
    const room = distance * distance - radius * radius;
    if (distance <= radius || room <= 1e-6 * distance * distance) return [-1, 1];
    const root = radius * Math.sqrt(center * center + room);
    return [
        (center * distance - root) / room / halfSize,
        (center * distance + root) / room / halfSize,
    ];
}

/** Arrays of the same length that grow together. */
class GrowingLists {
    constructor(...types) {
        this.lists = types.map((Type) => new Type(1 << 12));
        this.room = 1 << 12;
    }

    /** Makes room for so many. */
    reserve(count) {
        if (count <= this.room) return;
        while (this.room < count) this.room *= 2;
        this.lists = this.lists.map((list) => {
            const larger = new list.constructor(this.room);
            larger.set(list);
            return larger;
        });
    }
}

class Tiles {
    static kLevels = 7; // of sizes: tiles have 64 pixels a side, then 32, and so on to one
    static kBall = 8; // values of a ball: unit vector to its center, distance, outer and inner
    // radius, cosine and sine of the angle that it is seen by

    constructor() {
        this.balls = new Float64Array(0);
        this.output = new GrowingLists(Uint32Array, Float32Array); // balls; where they are met
        this.levels = Array.from(
            { length: Tiles.kLevels },
            () => new GrowingLists(Uint32Array, Float64Array),
        );
    }

    /**
     * Finds the balls of each pixel, `across` to a row of the view: those of pixel (x, y) are
     * `entries` from `ranges[2 * (y * across + x)]` to the number after it. An entry is a ball and,
     * as bits of a float, the distance from the eye from which on rays of the pixel may meet it.
     * Spheres that no plane cuts leave one entry: what is seen.
     * @param shapes four floats a ball: see Frame
     * @param look what of it decides about outlines: `reach`, `faces`, `flatNormal` and `clip`
     */
    sort(shapes, look, view, width, height) {
        Object.assign(this, { view, width, height, count: 0 });
        const high = (2 * view.halfHeight) / height,
            wide = (2 * view.halfHeight * view.aspect) / width;
        this.pixel = { wide, high }; // at distance 1
        this.front = look.clip ? Number(kFront) : 0;
        this.angles = this.levels.map((_, level) => {
            // Rays straight ahead are farthest apart.
            const angle = Math.atan(1.0001 * Math.hypot(wide, high) * 2 ** (level - 1));
            return { cosine: Math.cos(angle), sine: Math.sin(angle) };
        });
        const largest = 1 << (Tiles.kLevels - 1);
        const across = Math.ceil(width / largest),
            down = Math.ceil(height / largest);
        this.across = across << (Tiles.kLevels - 1);
        this.down = down << (Tiles.kLevels - 1);
        this.ranges = new Uint32Array(2 * this.across * this.down);
        const lists = this.#largeTiles(shapes, look, across, down);
        lists.forEach((list, tile) => {
            const top = this.levels[Tiles.kLevels - 1];
            top.reserve(list.length);
            top.lists[0].set(list);
            this.#cut(Tiles.kLevels - 1, tile % across, Math.floor(tile / across), list.length);
        });
        this.#pack();
    }

    /** Places the balls around the eye.
     *  @returns for each of the largest tiles, those that may be in it */
    #largeTiles(shapes, look, across, down) {
        const { eye, x, y, z, halfHeight, aspect, near } = this.view;
        const { kBall } = Tiles,
            count = shapes.length / 4;
        if (this.balls.length < kBall * count) this.balls = new Float64Array(kBall * count);
        const lists = Array.from({ length: across * down }, () => []);
        const least = (1.5 * halfHeight) / this.height;
        const areSpheres = look.faces.length === 0 && !look.flatNormal;
        this.areSpheres = areSpheres && !look.clip;
        const large = 1 << (Tiles.kLevels - 1);
        const tileAt = (share, pixels, most) =>
            clamp(Math.floor((((share + 1) / 2) * pixels) / large), 0, most - 1);
        for (let i = 0; i < count; ++i) {
            const center = [shapes[4 * i], shapes[4 * i + 1], shapes[4 * i + 2]];
            const radius = shapes[4 * i + 3],
                apart = minus(center, eye);
            const right = dot(apart, x),
                above = dot(apart, y),
                ahead = -dot(apart, z);
            const outer = 1.0001 * look.reach * Math.max(radius, least * ahead);
            if (ahead + outer < near) continue;
            const wide = seenSpan(right, ahead, outer, halfHeight * aspect);
            const high = seenSpan(above, ahead, outer, halfHeight);
            if (wide[1] < -1 || wide[0] > 1 || high[1] < -1 || high[0] > 1) continue;
            const length = Math.hypot(right, above, ahead) || 1e-30;
            // Only what is whole hides what is behind.
            const isWhole =
                areSpheres &&
                ahead - radius > near &&
                (!look.clip || dot(look.clip.normal, center) + look.clip.offset >= radius);
            const sine = Math.min(1, outer / length);
            this.balls.set(
                [
                    right / length,
                    above / length,
                    ahead / length,
                    length,
                    outer,
                    isWhole ? 0.9999 * radius : 0,
                    Math.sqrt(1 - sine * sine),
                    sine,
                ],
                kBall * i,
            );
            const last = tileAt(wide[1], this.width, across),
                top = tileAt(high[1], this.height, down);
            for (let row = tileAt(high[0], this.height, down); row <= top; ++row) {
                for (let column = tileAt(wide[0], this.width, across); column <= last; ++column) {
                    lists[row * across + column].push(i);
                }
            }
        }
        return lists;
    }

    /** Looks through the first `count` balls of a level's list for its tile (column, row), and goes
     *  on with the quarters of the tile. */
    #cut(level, column, row, count) {
        if (count === 0 || column << level >= this.width || row << level >= this.height) return;
        if (level === 0 && this.areSpheres) {
            this.#addNearest(column, row, count);
            return;
        }
        const kept = this.#keep(level, column, row, count);
        if (level === 0) {
            this.#add(column, row, kept);
            return;
        }
        const below = this.levels[level - 1];
        below.reserve(kept);
        for (let quarter = 0; quarter < 4; ++quarter) {
            below.lists[0].set(this.levels[level].lists[0].subarray(0, kept));
            this.#cut(level - 1, 2 * column + (quarter & 1), 2 * row + (quarter >> 1), kept);
        }
    }

    /** The direction of the ray in the middle of a tile. */
    #middleOf(level, column, row) {
        const side = 1 << level;
        return unit([
            ((column + 0.5) * side - this.width / 2) * this.pixel.wide,
            ((row + 0.5) * side - this.height / 2) * this.pixel.high,
            1,
        ]);
    }

    /** Moves balls that may be seen in a tile to the front of the list.
     *  @returns how many there are */
    #keep(level, column, row, count) {
        const [balls, nearest] = this.levels[level].lists,
            values = this.balls;
        const { cosine, sine } = this.angles[level];
        const [x, y, z] = this.#middleOf(level, column, row);
        let covered = Infinity,
            met = 0;
        for (let i = 0; i < count; ++i) {
            const ball = balls[i],
                at = Tiles.kBall * ball;
            const length = values[at + 3],
                outer = values[at + 4],
                inner = values[at + 5];
            const cosineOf = x * values[at] + y * values[at + 1] + z * values[at + 2];
            const isInside = length <= outer;
            if (!isInside && cosineOf < values[at + 6] * cosine - values[at + 7] * sine) continue;
            const sineOf = Math.sqrt(Math.max(0, 1 - cosineOf * cosineOf));
            // The rays nearest to the center.
            const towards = cosineOf >= cosine ? 1 : cosineOf * cosine + sineOf * sine;
            const room = Math.max(0, outer * outer - length * length * (1 - towards * towards));
            balls[met] = ball;
            nearest[met++] = isInside
                ? -1e6
                : length * towards - Math.sqrt(room) - this.front * outer;
            if (isInside || inner < length * sine) continue;
            // Those farthest from it.
            const away = cosineOf * cosine - sineOf * sine;
            const hiding = inner * inner - length * length * (1 - away * away);
            if (hiding > 0) covered = Math.min(covered, length * away - Math.sqrt(hiding));
        }
        let kept = 0;
        for (let i = 0; i < met; ++i) {
            if (nearest[i] > covered) continue;
            balls[kept] = balls[i];
            nearest[kept++] = nearest[i];
        }
        return kept;
    }

    /** Adds the sphere that the ray through a pixel meets first. */
    #addNearest(column, row, count) {
        const balls = this.levels[0].lists[0],
            values = this.balls;
        const [x, y, z] = this.#middleOf(0, column, row);
        let found = -1,
            least = Infinity;
        for (let i = 0; i < count; ++i) {
            const at = Tiles.kBall * balls[i];
            const cosine = x * values[at] + y * values[at + 1] + z * values[at + 2];
            if (cosine < values[at + 6]) continue;
            const length = values[at + 3],
                outer = values[at + 4];
            const begin =
                length * cosine -
                Math.sqrt(outer * outer - length * length * (1 - cosine * cosine));
            if (begin >= least || begin * z < this.view.near) continue;
            least = begin;
            found = balls[i];
        }
        if (found < 0) return;
        this.output.reserve(this.count + 1);
        this.output.lists[0][this.count] = found;
        this.output.lists[1][this.count] = least;
        this.ranges.set([this.count, this.count + 1], 2 * (row * this.across + column));
        ++this.count;
    }

    /** Adds all balls of a pixel. */
    #add(column, row, count) {
        this.output.reserve(this.count + count);
        this.levels[0].lists.forEach((list, i) =>
            this.output.lists[i].set(list.subarray(0, count), this.count),
        );
        this.ranges.set([this.count, this.count + count], 2 * (row * this.across + column));
        this.count += count;
    }

    #pack() {
        const rows = Math.max(1, Math.ceil(this.count / kTextureWidth));
        this.entries = new Uint32Array(2 * rows * kTextureWidth);
        const distances = new Float32Array(this.entries.buffer);
        const [balls, nearest] = this.output.lists;
        for (let i = 0; i < this.count; ++i) {
            this.entries[2 * i] = balls[i];
            distances[2 * i + 1] = nearest[i];
        }
    }
}
