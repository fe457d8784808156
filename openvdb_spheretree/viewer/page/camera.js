// SPDX-License-Identifier: Apache-2.0
// A camera on a turntable: y is upright, as in the pictures that the command draws.

const kHalfAngle = (15 * Math.PI) / 180; // from the middle of the view up

class Camera {
    /**
     * @param flatAxis 0 to 2 for a flat object, which is seen along it; else null
     * @param halfBox  half the sides of the box around the origin that the first view shows
     */
    constructor(flatAxis, halfBox) {
        this.flatAxis = flatAxis;
        this.halfBox = halfBox;
        this.aspect = 1;
        this.reach = 1; // how far anything is from the origin
        this.goHome();
    }

    goHome() {
        this.target = [0, 0, 0];
        if (this.flatAxis !== null) this.lookAlong(this.flatAxis);
        else this.turnTo(30, 20);
        this.fit();
    }

    /** So near that the box fills the view; `size` is half of what is seen of the plane through the
     *  target, the shorter way. */
    fit() {
        const { x, y, z } = this.axes();
        const kFilled = 0.94;
        let distance = 0;
        for (let corner = 0; corner < 8; ++corner) {
            const at = this.halfBox.map((half, axis) => ((corner >> axis) & 1 ? half : -half));
            const aside = Math.max(Math.abs(dot(at, x)) / this.aspect, Math.abs(dot(at, y)));
            distance = Math.max(distance, dot(at, z) + aside / Math.tan(kHalfAngle));
        }
        this.size = (distance * Math.sin(kHalfAngle) * Math.min(1, this.aspect)) / kFilled;
        this.isHome = true;
    }

    /** Angles in degrees: to the right of z, and above the plane of x and z. */
    turnTo(yaw, pitch) {
        this.yaw = (yaw * Math.PI) / 180;
        this.pitch = (pitch * Math.PI) / 180;
    }

    lookAlong(axis) {
        this.turnTo(axis === 0 ? 90 : 0, axis === 1 ? 90 : 0);
        this.isHome = false;
    }

    turn(right, up) {
        this.isHome = false;
        this.yaw += right;
        this.pitch = clamp(this.pitch + up, -Math.PI / 2, Math.PI / 2);
    }

    /** By shares of half the view. */
    move(right, up) {
        this.isHome = false;
        const { x, y } = this.axes();
        this.target = plus(
            this.target,
            plus(scaled(x, right * this.size), scaled(y, up * this.size)),
        );
    }

    zoom(factor) {
        this.isHome = false;
        this.size = clamp(this.size * factor, 1e-5, 50);
    }

    /** Unit vectors to the right, upwards, and from the target to the eye. */
    axes() {
        const [cosYaw, sinYaw] = [Math.cos(this.yaw), Math.sin(this.yaw)];
        const [cosPitch, sinPitch] = [Math.cos(this.pitch), Math.sin(this.pitch)];
        return {
            x: [cosYaw, 0, -sinYaw],
            y: [-sinYaw * sinPitch, cosPitch, -cosYaw * sinPitch],
            z: [sinYaw * cosPitch, sinPitch, cosYaw * cosPitch],
        };
    }

    /** What the renderer and the picker need. `halfHeight` is that of the view at distance 1. */
    view() {
        const { x, y, z } = this.axes();
        const distance = this.size / Math.min(1, this.aspect) / Math.sin(kHalfAngle);
        const eye = plus(this.target, scaled(z, distance));
        const eyeDistance = Math.hypot(...eye);
        const far = eyeDistance + 1.01 * this.reach;
        const near = Math.max(eyeDistance - 1.01 * this.reach, distance * 1e-2, far * 1e-5);
        const halfHeight = Math.tan(kHalfAngle);
        const matrix = [
            x[0],
            y[0],
            z[0],
            0,
            x[1],
            y[1],
            z[1],
            0,
            x[2],
            y[2],
            z[2],
            0,
            -dot(x, eye),
            -dot(y, eye),
            -dot(z, eye),
            1,
        ];
        return {
            x,
            y,
            z,
            eye,
            near,
            far,
            halfHeight,
            matrix,
            aspect: this.aspect,
            projection: this.#projection(near, far, halfHeight),
        };
    }

    #projection(near, far, halfHeight) {
        const across = 1 / (halfHeight * this.aspect),
            up = 1 / halfHeight,
            depth = far - near;
        return [
            across,
            0,
            0,
            0,
            0,
            up,
            0,
            0,
            0,
            0,
            -(far + near) / depth,
            -1,
            0,
            0,
            (-2 * far * near) / depth,
            0,
        ];
    }
}

/** The ray through a point of the view, which is -1 to 1 from left to right and from below. */
function rayThrough(view, right, up) {
    const aside = plus(
        scaled(view.x, right * view.halfHeight * view.aspect),
        scaled(view.y, up * view.halfHeight),
    );
    return { origin: view.eye, direction: unit(minus(aside, view.z)) };
}
