// SPDX-License-Identifier: Apache-2.0
// Which ball is seen in each pixel of the view.
//
// A tile is a bundle of rays around one in its middle. Rays meet a ball the later the more they
// pass beside its center. That bounds from below where rays of a tile meet a ball and, if all of
// them do, from above; what begins behind a ball that covers the tile is left out. Tiles begin
// large, and are cut in four until they are pixels: most balls are left out before they would be
// many.
//
// In a solid that is cut open, hundreds of balls may hold a point of the cut. The one that it is
// deepest in is seen. Depths of all points where rays of a tile meet the plane are bounded as well,
// from the farthest of its corners; a ball that is nowhere as deep as another is everywhere is left
// out. Without that, such a frame of dragon-512 takes three times as long.

/** From where to where a ball is seen along one axis of the view, which is -1 to 1. */
function seenSpan(center, distance, radius, halfSize) {
    // Lines from the eye that touch a circle; one that reaches the plane of the eye is everywhere.
    const room = distance * distance - radius * radius;
    if (distance <= radius || room <= 1e-6 * distance * distance) return [-1, 1];
    const root = radius * Math.sqrt(center * center + room);
    return [
        (center * distance - root) / room / halfSize,
        (center * distance + root) / room / halfSize,
    ];
}

/** Balls that may be seen in a tile, from where rays of the tile may meet each, and how deep in it
 *  they may meet the clip plane. */
class TileList {
    constructor() {
        this.balls = new Uint32Array(1 << 12);
        this.nearest = new Float64Array(1 << 12);
        this.depth = new Float64Array(1 << 12);
    }

    /** Takes over the first `count` balls. */
    take(balls, count) {
        if (this.balls.length < count) {
            const room = 2 ** Math.ceil(Math.log2(count));
            this.balls = new Uint32Array(room);
            this.nearest = new Float64Array(room);
            this.depth = new Float64Array(room);
        }
        this.balls.set(balls.length === count ? balls : balls.subarray(0, count));
    }
}

class Tiles {
    static kLevels = 7; // of sizes: tiles have 64 pixels a side, then 32, and so on to one
    // Values of a ball: unit vector to its center, distance, outer and inner radius, cosine, sine
    // of the angle that it is seen by.
    static kBall = 8;

    constructor() {
        this.balls = new Float64Array(0);
        this.levels = Array.from({ length: Tiles.kLevels }, () => new TileList());
    }

    /**
     * Finds `seen`: for each pixel, by rows from below, the ball that is seen there plus one, or 0.
     * @param shapes four floats a ball: see Frame
     * @param look what of it decides about outlines: `reach`, `faces`, `flatNormal` and `clip`
     */
    find(shapes, look, view, width, height) {
        Object.assign(this, { shapes, look, view, width, height });
        const high = (2 * view.halfHeight) / height,
            wide = (2 * view.halfHeight * view.aspect) / width;
        this.pixel = { wide, high }; // at distance 1
        this.angles = this.levels.map((_, level) => {
            // Rays straight ahead are farthest apart.
            const angle = Math.atan(1.0001 * Math.hypot(wide, high) * 2 ** (level - 1));
            return { cosine: Math.cos(angle), sine: Math.sin(angle) };
        });
        // The clip plane in the coordinates of balls: to the right, upwards and ahead.
        this.plane = look.clip && seenPlane(view, look.clip);
        if (this.plane) this.plane[2] *= -1;
        this.areSpheres = look.faces.length === 0 && !look.flatNormal;
        this.seen = new Uint32Array(width * height);
        const largest = 1 << (Tiles.kLevels - 1),
            across = Math.ceil(width / largest);
        this.#largeTiles(across, Math.ceil(height / largest)).forEach((list, tile) => {
            this.levels[Tiles.kLevels - 1].take(list, list.length);
            this.#cut(Tiles.kLevels - 1, tile % across, Math.floor(tile / across), list.length);
        });
    }

    /** How large a sphere a ball of radius 1 holds: none, if it is a disc. */
    #innerRadius() {
        if (this.look.flatNormal) return 0;
        return this.look.faces.reduce((least, face) => Math.min(least, 1 / Math.hypot(...face)), 1);
    }

    /** Places the balls around the eye.
     *  @returns for each of the largest tiles, those that may be in it */
    #largeTiles(across, down) {
        const { eye, x, y, z, halfHeight, aspect, near } = this.view;
        const { kBall } = Tiles,
            count = this.shapes.length / 4;
        if (this.balls.length < kBall * count) this.balls = new Float64Array(kBall * count);
        const lists = Array.from({ length: across * down }, () => []);
        const least = (1.5 * halfHeight) / this.height,
            innerRadius = this.#innerRadius();
        const large = 1 << (Tiles.kLevels - 1);
        const tileAt = (share, pixels, most) =>
            clamp(Math.floor((((share + 1) / 2) * pixels) / large), 0, most - 1);
        for (let i = 0; i < count; ++i) {
            const radius = this.shapes[4 * i + 3],
                apart = minus(this.shapes.subarray(4 * i, 4 * i + 3), eye);
            const right = dot(apart, x),
                above = dot(apart, y),
                ahead = -dot(apart, z);
            const outer = 1.0001 * this.look.reach * Math.max(radius, least * ahead);
            if (ahead + outer < near) continue;
            const wide = seenSpan(right, ahead, outer, halfHeight * aspect);
            const high = seenSpan(above, ahead, outer, halfHeight);
            if (wide[1] < -1 || wide[0] > 1 || high[1] < -1 || high[0] > 1) continue;
            const length = Math.hypot(right, above, ahead) || 1e-30,
                sine = Math.min(1, outer / length);
            const at = kBall * i;
            this.balls[at] = right / length;
            this.balls[at + 1] = above / length;
            this.balls[at + 2] = ahead / length;
            this.balls[at + 3] = length;
            this.balls[at + 4] = outer;
            this.balls[at + 5] = ahead - radius > near ? 0.9999 * innerRadius * radius : 0;
            this.balls[at + 6] = Math.sqrt(1 - sine * sine);
            this.balls[at + 7] = sine;
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
        if (level === 0) {
            const found = this.areSpheres
                ? this.#nearestSphere(column, row, count)
                : this.#nearestShape(column, row, count);
            this.seen[row * this.width + column] = found + 1;
            return;
        }
        const kept = this.#keep(level, column, row, count);
        for (let quarter = 0; quarter < 4; ++quarter) {
            this.levels[level - 1].take(this.levels[level].balls, kept);
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

    /** Where rays of a tile come into the half-space that is kept, at least and at most, and where
     *  they leave it at least. */
    #keptSpan(level, ray) {
        if (!this.plane) return { enterMin: -Infinity, enterMax: -Infinity, leaveMin: Infinity };
        const { cosine, sine } = this.angles[level];
        const speed = dot(this.plane, ray),
            height = this.plane[3];
        const beside = Math.sqrt(Math.max(0, 1 - speed * speed)) * sine;
        const low = speed * cosine - beside,
            high = Math.max(speed, speed * cosine + beside);
        if (height < 0) {
            return {
                enterMin: high > 0 ? -height / high : Infinity,
                enterMax: low > 0 ? -height / low : Infinity,
                leaveMin: Infinity,
            };
        }
        const leaveMin = low < 0 ? -height / Math.min(low, speed) : Infinity;
        return { enterMin: -Infinity, enterMax: -Infinity, leaveMin };
    }

    /** Where rays of a tile come into the half-space that is kept: the distance along the one in the
     *  middle, and how far apart from there others do at most. Null if not all of them do. */
    #cutOf(level, column, row, ray) {
        const { plane, pixel, width, height } = this;
        if (!plane || plane[3] >= 0) return null;
        const speed = dot(plane, ray),
            distance = -plane[3] / speed;
        if (speed <= 0) return null;
        let spread = 0;
        for (let corner = 0; corner < 4; ++corner) {
            const right = (((column + (corner & 1)) << level) - width / 2) * pixel.wide,
                above = (((row + (corner >> 1)) << level) - height / 2) * pixel.high;
            const ahead = -plane[3] / (plane[0] * right + plane[1] * above + plane[2]);
            if (!(ahead >= this.view.near)) return null;
            spread = Math.max(
                spread,
                Math.hypot(
                    ahead * right - distance * ray[0],
                    ahead * above - distance * ray[1],
                    ahead - distance * ray[2],
                ),
            );
        }
        return { distance, spread: 1.0001 * spread };
    }

    /** Moves balls that may be seen in a tile to the front of the list.
     *  @returns how many there are */
    #keep(level, column, row, count) {
        const { balls, nearest, depth } = this.levels[level],
            values = this.balls;
        const { cosine, sine } = this.angles[level];
        const ray = this.#middleOf(level, column, row),
            [x, y, z] = ray;
        const { enterMin, enterMax, leaveMin } = this.#keptSpan(level, ray);
        const front = this.plane ? Number(kFront) : 0;
        const cut = this.areSpheres ? this.#cutOf(level, column, row, ray) : null;
        let covered = Infinity,
            deepest = -Infinity,
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
            const half = Math.sqrt(
                Math.max(0, outer * outer - length * length * (1 - towards * towards)),
            );
            if (!isInside && length * towards + half < enterMin) continue;
            balls[met] = ball;
            const begin = isInside ? -1e6 : length * towards - half;
            if (cut) {
                // At a point p it is (r^2 - |p - c|^2) / r.
                const { distance, spread } = cut;
                const away2 = length * length + distance * (distance - 2 * length * cosineOf);
                const away = Math.sqrt(Math.max(0, away2)),
                    least = Math.max(0, away - spread),
                    most = away + spread;
                depth[met] = 1e-9 + outer - (least * least) / outer;
                if (most < outer) deepest = Math.max(deepest, outer - (most * most) / outer);
            }
            nearest[met++] = Math.max(begin, enterMin) - front * outer;
            if (isInside || inner < length * sine) continue;
            // Those farthest from it.
            const away = cosineOf * cosine - sineOf * sine;
            const hiding = inner * inner - length * length * (1 - away * away);
            if (hiding <= 0 || length * away + Math.sqrt(hiding) < enterMax) continue;
            const end = Math.max(length * away - Math.sqrt(hiding), enterMax);
            if (end <= leaveMin) covered = Math.min(covered, end);
        }
        let kept = 0;
        for (let i = 0; i < met; ++i) {
            if (nearest[i] > covered || (cut && depth[i] < deepest)) continue;
            balls[kept] = balls[i];
            nearest[kept++] = nearest[i];
        }
        return kept;
    }

    /** The sphere that the ray through a pixel shows; -1 if there is none. As in ballShader.js. */
    #nearestSphere(column, row, count) {
        const { balls } = this.levels[0],
            values = this.balls,
            { plane } = this;
        const ray = this.#middleOf(0, column, row),
            [x, y, z] = ray;
        const speed = plane ? dot(plane, ray) : 0,
            height = plane ? plane[3] : 1;
        if (speed <= 0 && height < 0) return -1;
        const cut = -height / speed;
        const enter = speed > 0 ? cut : -Infinity,
            leave = speed < 0 ? cut : Infinity;
        const from = this.view.near / z;
        let found = -1,
            least = Infinity;
        for (let i = 0; i < count; ++i) {
            const at = Tiles.kBall * balls[i];
            const cosine = x * values[at] + y * values[at + 1] + z * values[at + 2];
            const length = values[at + 3],
                outer = values[at + 4];
            if (cosine < values[at + 6] && length > outer) continue;
            const room = outer * outer - length * length * (1 - cosine * cosine);
            const half = Math.sqrt(Math.max(0, room));
            let begin = length * cosine - half;
            if (begin > leave || length * cosine + half < enter) continue;
            if (begin < enter) {
                const apart = enter - length * cosine; // along the ray, from beside the center
                begin = enter;
                if (begin < from) continue;
                begin += (Number(kFront) * (apart * apart - half * half)) / outer / z;
            } else if (begin < from) continue;
            if (begin >= least) continue;
            least = begin;
            found = balls[i];
        }
        return found;
    }

    /** The same of discs and of balls of norms. */
    #nearestShape(column, row, count) {
        const ray = rayThrough(
            this.view,
            (2 * (column + 0.5)) / this.width - 1,
            (2 * (row + 0.5)) / this.height - 1,
        );
        const kept = keptBy(this.look.clip, ray),
            { balls } = this.levels[0];
        let found = -1,
            least = Infinity;
        for (let i = 0; i < count; ++i) {
            const order = orderOf(ray, kept, this.view, this.shapes, balls[i], this.look);
            if (order >= least) continue;
            least = order;
            found = balls[i];
        }
        return found;
    }
}
