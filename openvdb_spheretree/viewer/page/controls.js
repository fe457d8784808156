// SPDX-License-Identifier: Apache-2.0
// The controls of the page: what each does, and how each shows the state.

class Controls {
    constructor(viewer) {
        this.viewer = viewer;
        this.tree = viewer.tree;
        this.#listenToSets();
        this.#listenToLooks();
        this.#listenToView();
        byId('find').addEventListener('submit', (event) => {
            event.preventDefault();
            const id = Number(byId('find-id').value);
            if (Number.isInteger(id) && id >= 0 && id < viewer.choosable.size) viewer.select(id);
        });
        const { surface } = this.tree;
        byId('surface-row').hidden = !surface;
        byId('surface-note').textContent = surface
            ? surfaceSentence(surface)
            : `The object is not on this page: ${this.tree.surface_missing}.`;
        const hasCuts = Boolean(this.tree.cuts);
        byId('count-row').hidden = !hasCuts;
        byId('count-note').textContent =
            hasCuts || !this.tree.may_have_cuts
                ? ''
                : 'A tree built with cuts=1 has every number of spheres.';
    }

    #listenToSets() {
        const { viewer, tree } = this;
        const levels = [...tree.levels].reverse(); // coarse ones on the left, as in the chart
        byId('level').max = levels.length - 1;
        byId('level').addEventListener('input', (event) =>
            viewer.show({ level: levels[Number(event.target.value)].level, count: null }),
        );
        const kSteps = 1000; // of the slider, by ratios
        const most = () => Math.log(tree.mostSpheres);
        byId('count').addEventListener('input', (event) => {
            const count = Math.round(Math.exp((Number(event.target.value) / kSteps) * most()));
            viewer.show({ count: clamp(count, 1, tree.mostSpheres) });
        });
        byId('count-exact').max = tree.mostSpheres;
        byId('count-exact').addEventListener('change', (event) => {
            const count = Math.round(Number(event.target.value));
            if (count >= 1) viewer.show({ count: Math.min(count, tree.mostSpheres) });
        });
    }

    #listenToLooks() {
        const { viewer } = this;
        const slide = (id, name) =>
            byId(id).addEventListener('input', (event) =>
                viewer.show({ [name]: Number(event.target.value) }),
            );
        slide('sphere-opacity', 'sphereOpacity');
        slide('surface-opacity', 'surfaceOpacity');
        byId('color').addEventListener('change', (event) =>
            viewer.show({ color: event.target.value }),
        );
        const clip = (change) => viewer.show({ clip: { ...viewer.state.clip, ...change } });
        byId('clip-axis').addEventListener('change', (event) => clip({ axis: event.target.value }));
        byId('clip-at').addEventListener('input', (event) =>
            clip({ at: Number(event.target.value) }),
        );
        byId('clip-flip').addEventListener('change', (event) =>
            clip({ flip: event.target.checked }),
        );
        byId('theme').addEventListener('click', () =>
            viewer.show({ theme: viewer.state.isDark ? 'light' : 'dark' }),
        );
        systemIsDark.addEventListener('change', () => viewer.show({}));
    }

    #listenToView() {
        const { viewer } = this,
            { camera } = viewer;
        const moved =
            (act) =>
            (...values) => {
                act(...values);
                viewer.redraw(true);
            };
        const views = {
            home: () => camera.goHome(),
            in: () => camera.zoom(0.8),
            out: () => camera.zoom(1.25),
            x: () => camera.lookAlong(0),
            y: () => camera.lookAlong(1),
            z: () => camera.lookAlong(2),
        };
        for (const button of document.querySelectorAll('[data-view]')) {
            button.addEventListener('click', moved(views[button.dataset.view]));
        }
        new Gestures(byId('canvas'), {
            turn: moved((right, up) => camera.turn(right, up)),
            move: moved((right, up) => camera.move(right, up)),
            zoom: moved((factor) => camera.zoom(factor)),
            click: (x, y) => {
                const box = byId('canvas').getBoundingClientRect();
                viewer.pickAt(
                    (2 * (x - box.left)) / box.width - 1,
                    1 - (2 * (y - box.top)) / box.height,
                );
            },
            key: (name) => this.#key(name, moved(views.home)),
        });
    }

    /** @returns whether the key means something */
    #key(name, goHome) {
        const { viewer } = this,
            slider = byId('level');
        const step = { PageUp: -1, PageDown: 1 }[name];
        if (step) {
            slider.value = Number(slider.value) + step;
            slider.dispatchEvent(new Event('input'));
        } else if (name === 'Home') {
            goHome();
        } else if (name === 'Enter') {
            viewer.pickAt(0, 0);
        } else if (name === 'Escape') {
            viewer.select(-1);
        } else {
            return false;
        }
        return true;
    }

    /** All controls as the state has it. */
    update() {
        const { viewer, tree } = this,
            { state, shown } = viewer;
        const place =
            tree.levels.length - 1 - tree.levels.findIndex((each) => each.level === state.level);
        byId('level').value = place;
        const text = shown.level
            ? viewer.shownSentence()
            : `none: ${viewer.shownSentence().toLowerCase()}`;
        byId('level').setAttribute('aria-valuetext', text);
        byId('level-text').textContent = shown.level
            ? `${state.level}, ${plural(shown.ids.length, 'sphere', 'spheres')}`
            : 'a cut is shown';
        if (tree.cuts) {
            const share = Math.log(shown.ids.length) / Math.log(Math.max(2, tree.mostSpheres));
            byId('count').value = Math.round(1000 * share);
            byId('count').setAttribute(
                'aria-valuetext',
                plural(shown.ids.length, 'sphere', 'spheres'),
            );
            byId('count-exact').value = shown.ids.length;
        }
        const percent = (id, value) => {
            byId(id).value = value;
            byId(`${id}-text`).textContent = `${Math.round(100 * value)}%`;
        };
        percent('sphere-opacity', state.sphereOpacity);
        percent('surface-opacity', state.surfaceOpacity);
        byId('color').value = state.color;
        this.#updateClip();
        this.#updateLegend();
        byId('find-id').max = viewer.choosable.size - 1;
        if (state.selected >= 0) byId('find-id').value = state.selected;
        byId('theme').setAttribute('aria-pressed', state.isDark);
    }

    #updateClip() {
        const { axis, at, flip } = this.viewer.state.clip,
            clip = this.viewer.clipWorld();
        byId('clip-axis').value = axis;
        byId('clip-at').value = at;
        byId('clip-at').disabled = byId('clip-flip').disabled = !clip;
        byId('clip-flip').checked = flip;
        const text = clip ? `${axis} = ${short(clip.at)}` : '';
        byId('clip-text').textContent = text;
        byId('clip-at').setAttribute('aria-valuetext', text);
    }

    #updateLegend() {
        const { viewer, tree } = this,
            { state, shown } = viewer;
        const legend = byId('legend');
        const scale = (low, high) => {
            const stops = [0, 0.25, 0.5, 0.75, 1].map(
                (share) => `rgb(${colorOfShare(share).join(' ')})`,
            );
            const bar = make('span', { class: 'scale' });
            bar.style.background = `linear-gradient(90deg, ${stops.join(', ')})`;
            legend.replaceChildren(
                bar,
                make(
                    'span',
                    { class: 'ends' },
                    make('span', { text: low }),
                    make('span', { text: high }),
                ),
            );
        };
        if (state.color === 'radius') {
            const { low, high } = viewer.radiusRange();
            scale(short(low), short(high));
        } else if (state.color === 'level') {
            if (shown.level)
                scale(`level ${tree.levels[0].level}`, `level ${tree.levels.at(-1).level}`);
            else scale('leaves', 'root');
        } else {
            const haveParents = shown.ids.some((id) => shown.spheres.parent[id] >= 0);
            legend.textContent = haveParents
                ? ''
                : 'There are no parents here: every sphere has a colour.';
        }
    }
}

function surfaceSentence(surface) {
    const triangles = plural(surface.triangles, 'triangle', 'triangles');
    if (surface.factor === 1) return `The object's surface has ${triangles}.`;
    const blocks = `blocks of ${surface.factor} voxels a side`;
    const growth =
        surface.growth > 1.5 ? ` They hold ${short(surface.growth, 2)} times its volume.` : '';
    return `The object's surface is simplified to ${triangles}: ${blocks}.${growth}`;
}
