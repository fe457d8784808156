// SPDX-License-Identifier: Apache-2.0
// Mouse, fingers, wheel and keys on the view become calls: turn, move, zoom, click.

class Gestures {
    /** @param actions turn(right, up), move(right, up), zoom(factor), click(x, y) and key(name) */
    constructor(canvas, actions) {
        this.canvas = canvas;
        this.actions = actions;
        this.pointers = new Map(); // by id: where each finger or the mouse is
        const listen = (name, act) => canvas.addEventListener(name, act);
        listen('pointerdown', (event) => this.#press(event));
        listen('pointermove', (event) => this.#drag(event));
        listen('pointerup', (event) => this.#release(event));
        listen('pointercancel', (event) => this.pointers.delete(event.pointerId));
        listen('contextmenu', (event) => event.preventDefault());
        canvas.addEventListener(
            'wheel',
            (event) => {
                event.preventDefault();
                const lines = event.deltaMode === 1 ? 16 : 1;
                actions.zoom(Math.exp(clamp(event.deltaY * lines, -300, 300) * 0.0015));
            },
            { passive: false },
        );
        listen('keydown', (event) => this.#key(event));
    }

    #press(event) {
        try {
            this.canvas.setPointerCapture(event.pointerId);
        } catch {
            /* a pointer made by a script */
        }
        this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
        this.travelled = this.pointers.size > 1 ? Infinity : 0;
    }

    #drag(event) {
        const pointer = this.pointers.get(event.pointerId);
        if (!pointer) return;
        const right = event.clientX - pointer.x,
            down = event.clientY - pointer.y;
        const before = this.#spread();
        Object.assign(pointer, { x: event.clientX, y: event.clientY });
        this.travelled += Math.abs(right) + Math.abs(down);
        const half = Math.min(this.canvas.clientWidth, this.canvas.clientHeight) / 2;
        const share = 1 / this.pointers.size;
        if (this.pointers.size > 1) {
            if (before > 0) this.actions.zoom(before / this.#spread());
            this.actions.move((-right * share) / half, (down * share) / half);
        } else if (event.shiftKey || event.buttons & 6) {
            this.actions.move(-right / half, down / half);
        } else {
            this.actions.turn(-right / half, down / half);
        }
    }

    #release(event) {
        if (!this.pointers.delete(event.pointerId)) return;
        const kStill = 5; // pixels
        if (this.travelled <= kStill && event.button === 0)
            this.actions.click(event.clientX, event.clientY);
    }

    /** How far two fingers are apart. */
    #spread() {
        const [a, b] = this.pointers.values();
        return b ? Math.hypot(a.x - b.x, a.y - b.y) : 0;
    }

    #key(event) {
        const kStep = 0.1;
        const arrows = {
            ArrowLeft: [-1, 0],
            ArrowRight: [1, 0],
            ArrowUp: [0, 1],
            ArrowDown: [0, -1],
        };
        const arrow = arrows[event.key]?.map((way) => way * kStep);
        if (event.ctrlKey || event.altKey || event.metaKey) return;
        if (arrow && event.shiftKey) this.actions.move(...arrow);
        else if (arrow) this.actions.turn(...arrow);
        else if (event.key === '+' || event.key === '=') this.actions.zoom(0.9);
        else if (event.key === '-') this.actions.zoom(1 / 0.9);
        else if (!this.actions.key(event.key)) return;
        event.preventDefault();
    }
}
