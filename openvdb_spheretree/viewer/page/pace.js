// SPDX-License-Identifier: Apache-2.0
// How many pixels a frame has. While something moves, no more than can be drawn fluently; at rest
// more than the screen has, where there is time for it: edges are smooth then.

class Pace {
    static kFluent = 60; // milliseconds a frame, while something moves
    static kPatience = 350; // milliseconds for a frame at rest
    static kRest = 180; // milliseconds without a change until a view is at rest

    /** @param draw is called with a scale for the pixels of the screen, and with what to call when
     *  the frame is there */
    constructor(draw) {
        this.drawFrame = draw;
        this.millisecondsAtOne = 30; // of a frame with a pixel for each of the screen; a guess
    }

    /** Draws soon; @param moving whether more frames are likely to follow at once */
    request(moving) {
        this.isWanted = true;
        this.isMoving = moving;
        clearTimeout(this.timer);
        this.#next();
    }

    #next() {
        if (this.isDrawing || !this.isWanted) return;
        this.isWanted = false;
        this.isDrawing = true;
        requestAnimationFrame(() =>
            this.#draw(this.isMoving ? this.#scaleFor(Pace.kFluent, 0.25, 1) : 1),
        );
    }

    /** Times are about proportional to pixels. */
    #scaleFor(milliseconds, least, most) {
        return clamp(Math.sqrt(milliseconds / this.millisecondsAtOne), least, most);
    }

    #draw(scale) {
        const begin = performance.now();
        this.drawFrame(scale, () => {
            this.milliseconds = performance.now() - begin;
            const atOne = this.milliseconds / (scale * scale);
            this.millisecondsAtOne = 0.5 * (this.millisecondsAtOne + atOne);
            this.isDrawing = false;
            this.#next();
            if (!this.isDrawing) this.#refine(scale);
        });
    }

    #refine(scale) {
        const finer = this.#scaleFor(Pace.kPatience, 1, 2);
        if (scale >= finer) return;
        this.timer = setTimeout(() => {
            this.isDrawing = true;
            this.#draw(finer);
        }, Pace.kRest);
    }
}
