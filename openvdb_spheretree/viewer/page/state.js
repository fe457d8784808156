// SPDX-License-Identifier: Apache-2.0
// What is shown, and how; the address of the page may say it: tree.html#level=2&color=radius

const systemIsDark = matchMedia('(prefers-color-scheme: dark)');

class State {
    constructor(tree) {
        this.level = tree.levels[0].level;
        this.count = null; // spheres of a cut, or null for a level
        this.selected = -1;
        this.color = 'parent';
        const isInside = tree.settings.side === 'inner' || tree.settings.side === 'fit';
        const isSwollen = tree.surface?.growth > 1.5; // it would hide what is to be seen
        this.sphereOpacity = tree.surface && !isInside && !isSwollen ? 0.55 : 1;
        this.surfaceOpacity = isSwollen ? 0 : isInside ? 0.35 : 1;
        this.clip = { axis: '', at: 0.5, flip: false };
        this.drawBy = null; // 'triangles' or 'tiles'; else by the machine
        this.view = null; // yaw and pitch in degrees, and size
        this.theme = null; // 'light' or 'dark'; else the system's
    }

    get isDark() {
        return this.theme ? this.theme === 'dark' : systemIsDark.matches;
    }

    /** Takes what a text such as `level=2&clip=x,0.4` says; what it cannot mean is left out. */
    read(text, tree) {
        const values = new URLSearchParams(text);
        const number = (name, low, high) => {
            const value = Number(values.get(name));
            return values.has(name) && value >= low && value <= high ? value : undefined;
        };
        const level = tree.levels.find((each) => each.level === number('level', 0, Infinity));
        if (level) Object.assign(this, { level: level.level, count: null, selected: -1 });
        const count = number('spheres', 1, tree.mostSpheres ?? 0);
        if (count) Object.assign(this, { count: Math.floor(count), selected: -1 });
        if (['parent', 'level', 'radius'].includes(values.get('color')))
            this.color = values.get('color');
        this.sphereOpacity = number('opacity', 0, 1) ?? this.sphereOpacity;
        this.surfaceOpacity = number('surface', 0, 1) ?? this.surfaceOpacity;
        if (['triangles', 'tiles'].includes(values.get('draw'))) this.drawBy = values.get('draw');
        if (['light', 'dark'].includes(values.get('theme'))) this.theme = values.get('theme');
        const [axis, at, flip] = (values.get('clip') ?? '').split(',');
        if (['x', 'y', 'z'].includes(axis)) {
            this.clip = { axis, at: clamp(Number(at ?? 0.5) || 0, 0, 1), flip: flip === 'flip' };
        }
        const view = (values.get('view') ?? '').split(',').map(Number);
        if (view.length === 3 && view.every(Number.isFinite)) this.view = view;
        const selected = number('select', 0, tree.nodes.size - 1);
        if (selected !== undefined && Number.isInteger(selected) && this.count === null) {
            this.selected = selected;
            this.level = tree.levelOf(selected).level;
        }
    }
}
