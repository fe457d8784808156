// SPDX-License-Identifier: Apache-2.0
// From world space to the space that is drawn in. There the box of the finest spheres and of the
// object has its middle at the origin and half its diagonal is 1, so that floats are good for any
// object, however large, small or far away.

class Frame {
    /**
     * @param spheres SphereArrays; those of `level` make the box, and
     * @param surface the object's, if it is there
     */
    constructor(spheres, level, surface) {
        const low = [Infinity, Infinity, Infinity],
            high = [-Infinity, -Infinity, -Infinity];
        for (let id = level.begin; id < level.end; ++id) {
            for (let axis = 0; axis < 3; ++axis) {
                const at = spheres.center[3 * id + axis],
                    radius = spheres.radius[id];
                low[axis] = Math.min(low[axis], at - radius);
                high[axis] = Math.max(high[axis], at + radius);
            }
        }
        for (let i = 0; i < (surface?.points.length ?? 0); ++i) {
            const at = surface.origin[i % 3] + surface.points[i];
            low[i % 3] = Math.min(low[i % 3], at);
            high[i % 3] = Math.max(high[i % 3], at);
        }
        this.low = low;
        this.high = high;
        this.middle = low.map((value, axis) => (value + high[axis]) / 2);
        this.scale = Math.hypot(...low.map((value, axis) => high[axis] - value)) / 2 || 1;
    }

    /** Half the sides of the box. */
    halfBox() {
        return this.low.map((low, axis) => (this.high[axis] - low) / 2 / this.scale);
    }

    /** A world coordinate along an axis, in the space that is drawn in. */
    along(axis, world) {
        return (world - this.middle[axis]) / this.scale;
    }

    /** Spheres `ids` as x, y, z and radius, each a float. */
    shapes(spheres, ids) {
        const shapes = new Float32Array(4 * ids.length);
        for (let i = 0; i < ids.length; ++i) {
            const id = ids[i];
            for (let axis = 0; axis < 3; ++axis) {
                shapes[4 * i + axis] = this.along(axis, spheres.center[3 * id + axis]);
            }
            shapes[4 * i + 3] = spheres.radius[id] / this.scale;
        }
        return shapes;
    }

    /** Points relative to `origin`, in world units. */
    points(points, origin) {
        return points.map((value, i) => this.along(i % 3, origin[i % 3] + value));
    }
}
