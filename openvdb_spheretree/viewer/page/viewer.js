// SPDX-License-Identifier: Apache-2.0
// Ties all together: the state, the view, and the controls that change it.

class Viewer {
    constructor(tree) {
        this.tree = tree;
        this.state = new State(tree);
        this.state.read(location.hash.slice(1), tree);
        this.frame = new Frame(tree.nodes, tree.levels[0], tree.surface);
        this.camera = new Camera(tree.flat_axis, this.frame.halfBox());
        const chooseLevel = (level) => this.show({ level, count: null });
        this.table = new LevelTable(byId('levels'), tree.levels, chooseLevel);
        this.chart = new ErrorChart(byId('chart'), tree.levels, chooseLevel);
        describeTree(tree);
        this.#startRenderer();
        this.controls = new Controls(this);
        this.#resize();
        this.#applyView();
        this.#show();
        new ResizeObserver(() => this.#resize()).observe(byId('canvas'));
        addEventListener('hashchange', () => {
            this.state.read(location.hash.slice(1), tree);
            this.#show();
            this.#applyView();
        });
    }

    /** Without WebGL2 the numbers are still worth reading. */
    #startRenderer() {
        const canvas = byId('canvas'),
            failure = byId('failure');
        const fail = (reason) => {
            failure.textContent = `The spheres cannot be drawn: ${reason}. All numbers are beside.`;
            failure.hidden = false;
            this.renderer = null;
        };
        try {
            this.renderer = new Renderer(canvas, this.state.drawBy);
            const { surface } = this.tree;
            if (surface)
                this.renderer.setSurface(
                    this.frame.points(surface.points, surface.origin),
                    surface.quads,
                );
        } catch (error) {
            fail(error.message);
        }
        canvas.addEventListener('webglcontextlost', () =>
            fail('the graphics card stopped; reload'),
        );
        this.pace = new Pace((scale, whenDone) => this.#draw(scale, whenDone));
        this.camera.reach = this.#farthest();
    }

    /** How far anything is from the middle. */
    #farthest() {
        let farthest = 1;
        const reach = (values, step, radiusOf) => {
            for (let i = 0; i < values.length; i += step) {
                farthest = Math.max(
                    farthest,
                    Math.hypot(values[i], values[i + 1], values[i + 2]) + radiusOf(i),
                );
            }
        };
        for (const spheres of [this.tree.nodes, this.tree.cuts].filter(Boolean)) {
            const all = Int32Array.from({ length: spheres.size }, (_, id) => id);
            const shapes = this.frame.shapes(spheres, all);
            reach(shapes, 4, (i) => this.tree.reach * shapes[i + 3]);
        }
        const { surface } = this.tree;
        if (surface) reach(this.frame.points(surface.points, surface.origin), 3, () => 0);
        return farthest;
    }

    #applyView() {
        const { view } = this.state;
        if (!view) return;
        this.camera.turnTo(view[0], view[1]);
        this.camera.fit();
        this.camera.zoom(1 / view[2]);
        this.redraw(false);
    }

    /** Changes the state, and shows it. */
    show(change) {
        const sameSet = !('level' in change) && !('count' in change);
        if (!sameSet && !('selected' in change)) change.selected = -1;
        Object.assign(this.state, change);
        this.#show();
        if (!sameSet) this.announce(this.shownSentence());
    }

    /** Selects a sphere of the nodes or, where a cut is shown, of the cuts. */
    select(id) {
        const { state, tree } = this;
        const change = { selected: id };
        if (id >= 0 && state.count === null) change.level = tree.levelOf(id).level;
        if (id >= 0 && state.count !== null) {
            // The nearest cut that has it.
            change.count = clamp(state.count, tree.cuts.first[id], tree.cuts.last[id]);
        }
        Object.assign(state, change);
        this.#show();
        this.announce(selectionSentence(tree, this.shown, id));
    }

    /** The spheres there are to choose from, for a number typed in. */
    get choosable() {
        return this.state.count === null ? this.tree.nodes : this.tree.cuts;
    }

    announce(text) {
        byId('announcement').textContent = text;
    }

    shownSentence() {
        const { level, ids } = this.shown;
        const spheres = plural(ids.length, 'sphere', 'spheres');
        if (!level) return `The cut of ${spheres}`;
        const error = level.hamming_percent;
        return (
            `Level ${level.level}: ${spheres}` +
            (error === null ? '' : `, Hamming error ${short(error)}%`)
        );
    }

    #show() {
        const { state, tree } = this;
        const key = state.count === null ? `level ${state.level}` : `cut ${state.count}`;
        const isNew = this.shown?.key !== key;
        if (isNew) this.#setShown(key);
        const color = `${key} ${state.color}`;
        if (this.renderer && this.colored !== color) {
            this.colors = colorsOf(tree, this.shown, state.color, this.radiusRange());
            this.renderer.setColors(this.colors);
            this.colored = color;
        }
        document.documentElement.dataset.theme = state.isDark ? 'dark' : 'light';
        this.table.mark(this.shown.level);
        this.chart.mark(this.shown.level, this.shown.ids.length);
        showSelection(byId('selection'), tree, this.shown, state.selected, (id) => this.select(id));
        byId('shown').textContent = this.shownSentence();
        this.controls.update();
        this.redraw(false);
    }

    #setShown(key) {
        const { state, tree } = this;
        if (state.count === null) {
            const level = tree.levels.find((each) => each.level === state.level);
            const ids = Int32Array.from({ length: level.spheres }, (_, i) => level.begin + i);
            this.shown = { key, level, ids, spheres: tree.nodes };
        } else {
            this.shown = { key, level: null, ids: tree.cutNodes(state.count), spheres: tree.cuts };
        }
        this.shapes = this.frame.shapes(this.shown.spheres, this.shown.ids);
        this.renderer?.setSpheres(this.shapes);
    }

    /** Of what is shown, for colours by radius. */
    radiusRange() {
        let [low, high] = [Infinity, 0];
        for (const id of this.shown.ids) {
            low = Math.min(low, this.shown.spheres.radius[id]);
            high = Math.max(high, this.shown.spheres.radius[id]);
        }
        return { low, high };
    }

    /** The clip plane in world units: its axis, and where it is. */
    clipWorld() {
        const { axis, at } = this.state.clip;
        const number = ['x', 'y', 'z'].indexOf(axis);
        if (number < 0) return null;
        const { low, high } = this.frame;
        return { number, at: low[number] + at * (high[number] - low[number]) };
    }

    /** How spheres are drawn now: opacities, colours, the clip plane, the shape of balls and what
     *  is selected. */
    currentLook() {
        const { state, tree } = this;
        const selected = this.shown.ids.indexOf(state.selected);
        return {
            reach: tree.reach,
            faces: tree.faces,
            flatNormal: tree.flat_axis === null ? null : tree.axes[tree.flat_axis],
            clip: this.#clipPlane(),
            sphereOpacity: state.sphereOpacity,
            surfaceOpacity: tree.surface ? state.surfaceOpacity : 0,
            selected,
            selectedShape:
                selected < 0
                    ? null
                    : Array.from(this.shapes.subarray(4 * selected, 4 * selected + 4)),
            accent: styleColor('--mark'),
            top: styleColor('--view-top'),
            bottom: styleColor('--view-bottom'),
            surfaceColor: [0.8, 0.77, 0.73],
        };
    }

    /** What is kept, in the space that is drawn in: dot(normal, p) + offset >= 0. */
    #clipPlane() {
        const clip = this.clipWorld(),
            way = this.state.clip.flip ? 1 : -1;
        if (!clip) return null;
        const normal = [0, 0, 0];
        normal[clip.number] = way;
        return { normal, offset: -way * this.frame.along(clip.number, clip.at) };
    }

    redraw(moving) {
        if (this.renderer && this.shown) this.pace.request(moving);
    }

    #resize() {
        const canvas = byId('canvas');
        this.camera.aspect = canvas.clientWidth / Math.max(1, canvas.clientHeight);
        if (this.camera.isHome) this.camera.fit();
        this.redraw(false);
    }

    #draw(scale, whenDone) {
        const canvas = byId('canvas');
        if (!this.renderer || canvas.clientWidth === 0) {
            whenDone();
            return;
        }
        const pixels = scale * Math.min(devicePixelRatio || 1, 2);
        canvas.width = Math.max(1, Math.round(canvas.clientWidth * pixels));
        canvas.height = Math.max(1, Math.round(canvas.clientHeight * pixels));
        this.renderer.draw(this.camera.view(), this.currentLook());
        this.renderer.whenDone(whenDone);
    }

    /** Selects what is at a point of the view, -1 to 1 from left to right and from below. */
    pickAt(right, up) {
        const view = this.camera.view();
        const found = pick(rayThrough(view, right, up), view, this.shapes, this.currentLook());
        this.select(found < 0 ? -1 : this.shown.ids[found]);
    }
}
