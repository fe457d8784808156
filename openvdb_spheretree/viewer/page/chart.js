// SPDX-License-Identifier: Apache-2.0
// The curve of Hamming error against number of spheres, both by ratios. An error of 0 has a line of
// its own below.

class ErrorChart {
    static kSize = { width: 328, height: 200, left: 54, right: 14, top: 14, bottom: 34 };

    /** @param choose is called with the number of a level that is clicked */
    constructor(container, levels, choose) {
        this.container = container;
        this.levels = levels.filter((level) => level.hamming_percent !== null);
        if (this.levels.length === 0) {
            const reasons = levels.map((level) => level.error_unknown).filter(Boolean);
            container.append(
                make('p', {
                    class: 'note',
                    text: `No errors are known: ${reasons[0] ?? 'none were counted'}.`,
                }),
            );
            return;
        }
        this.choose = choose;
        this.#setScales(levels);
        this.#draw();
    }

    #setScales(levels) {
        const { width, height, left, right, top, bottom } = ErrorChart.kSize;
        const errors = this.levels.map((level) => level.hamming_percent).filter((e) => e > 0);
        this.hasZero = this.levels.some((level) => level.hamming_percent === 0);
        const low = Math.floor(Math.log10(Math.min(...errors, 100)) - 1e-9);
        const high = Math.max(low + 1, Math.ceil(Math.log10(Math.max(...errors, low))));
        this.decades = [low, high];
        this.most = Math.max(...levels.map((level) => level.spheres), 2);
        const floor = height - bottom - (this.hasZero ? 16 : 0);
        this.x = (spheres) =>
            left + ((width - left - right) * Math.log(spheres)) / Math.log(this.most);
        this.y = (error) =>
            error > 0
                ? floor - ((floor - top) * (Math.log10(error) - low)) / (high - low)
                : height - bottom;
    }

    #draw() {
        const points = [...this.levels].sort((a, b) => a.spheres - b.spheres || b.level - a.level);
        const path = points.map(
            (level) => `${this.x(level.spheres)},${this.y(level.hamming_percent)}`,
        );
        const [first, last] = [points[0], points[points.length - 1]];
        this.now = makeSvg('line', { class: 'now', visibility: 'hidden' });
        this.value = makeSvg('text', { class: 'value' });
        this.points = points.map((level) => this.#point(level));
        this.container.replaceChildren(
            makeSvg(
                'svg',
                {
                    viewBox: `0 0 ${ErrorChart.kSize.width} ${ErrorChart.kSize.height}`,
                    role: 'img',
                    'aria-label':
                        `Hamming error: ${short(first.hamming_percent)}% with ` +
                        `${plural(first.spheres, 'sphere', 'spheres')}, ` +
                        `${short(last.hamming_percent)}% with ` +
                        `${short(last.spheres)}. The table of levels has all numbers.`,
                },
                ...this.#grid(),
                makeSvg('polyline', { class: 'curve', points: path.join(' ') }),
                this.now,
                ...this.points,
                this.value,
            ),
        );
    }

    #point(level) {
        const circle = makeSvg('circle', {
            class: 'point',
            r: 4.5,
            cx: this.x(level.spheres),
            cy: this.y(level.hamming_percent),
            onclick: () => this.choose(level.level),
        });
        circle.append(
            makeSvg('title', {
                text:
                    `Level ${level.level}: ${short(level.hamming_percent)}% with ` +
                    plural(level.spheres, 'sphere', 'spheres'),
            }),
        );
        circle.level = level;
        return circle;
    }

    #grid() {
        const { width, height, left, right, top, bottom } = ErrorChart.kSize;
        const lines = [];
        const label = (x, y, text, anchor) =>
            lines.push(makeSvg('text', { x, y, text, 'text-anchor': anchor }));
        const across = (y, text) => {
            lines.push(
                makeSvg('line', { class: 'grid', x1: left, x2: width - right, y1: y, y2: y }),
            );
            label(left - 6, y + 4, text, 'end');
        };
        const [low, high] = this.decades,
            step = Math.ceil((high - low) / 5);
        for (let e = low; e <= high; e += step) across(this.y(10 ** e), `${decimal(e)}%`);
        if (this.hasZero) across(this.y(0), '0%');
        const most = Math.log10(this.most),
            wide = Math.ceil((most + 0.3) / 6);
        for (let e = 0; e <= most; e += wide) {
            const x = this.x(10 ** e);
            lines.push(
                makeSvg('line', { class: 'grid', x1: x, x2: x, y1: top, y2: height - bottom }),
            );
            label(x, height - bottom + 15, decimal(e), 'middle');
        }
        label((left + width - right) / 2, height - 4, 'spheres', 'middle');
        return lines;
    }

    /** @param level the entry that is shown, null for a cut of `spheres` */
    mark(level, spheres) {
        if (!this.points) return;
        const { width, height, top, bottom } = ErrorChart.kSize;
        const x = this.x(spheres);
        withAttributes(this.now, {
            x1: x,
            x2: x,
            y1: top,
            y2: height - bottom,
            visibility: 'visible',
        });
        for (const point of this.points) {
            const isCurrent = point.level === level;
            point.classList.toggle('current', isCurrent);
            point.setAttribute('r', isCurrent ? 6 : 4.5);
        }
        const isKnown = level && level.hamming_percent !== null;
        const onRight = x < width / 2;
        withAttributes(this.value, {
            x: x + (onRight ? 9 : -9),
            y: top + 9,
            'text-anchor': onRight ? 'start' : 'end',
            text: isKnown ? `${short(level.hamming_percent)}%` : '',
        });
    }
}

/** A power of ten: 0.01, 1, 1000, 1e6. */
const decimal = (exponent) =>
    exponent >= 5 || exponent < -3 ? `1e${exponent}` : String(Number(`1e${exponent}`));
