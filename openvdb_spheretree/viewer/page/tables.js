// SPDX-License-Identifier: Apache-2.0
// What the page says in numbers: the levels, the selected sphere, the object and the settings.

/** A row for each level, coarse ones first; a button in it shows the level. */
class LevelTable {
    constructor(table, levels, choose) {
        const columns = ['Level', 'Spheres', 'Radii', 'Hamming %', 'Hausdorff'];
        const percent = (level) =>
            level.hamming_percent === null ? 'unknown' : short(level.hamming_percent);
        const hausdorff = (level) =>
            level.hausdorff === null ? 'unknown' : short(level.hausdorff);
        this.rows = [...levels].reverse().map((level) => {
            const row = make(
                'tr',
                {},
                make(
                    'th',
                    { scope: 'row' },
                    make('button', {
                        type: 'button',
                        text: level.level,
                        'aria-label': `Show level ${level.level}`,
                        onclick: () => choose(level.level),
                    }),
                ),
                make('td', { text: short(level.spheres) }),
                make('td', {
                    text:
                        level.radiusMin === level.radiusMax
                            ? short(level.radiusMin, 3)
                            : `${short(level.radiusMin, 3)}\u2013${short(level.radiusMax, 3)}`,
                }),
                make('td', { text: percent(level), title: level.error_unknown }),
                make('td', { text: hausdorff(level) }),
            );
            row.level = level;
            return row;
        });
        table.append(
            make('caption', {
                class: 'hidden',
                text:
                    'Levels of the tree, coarse ones first. Radii are in world units, ' +
                    'Hausdorff distances in voxels.',
            }),
            make(
                'thead',
                {},
                make('tr', {}, ...columns.map((text) => make('th', { scope: 'col', text }))),
            ),
            make('tbody', {}, ...this.rows),
        );
    }

    mark(level) {
        for (const row of this.rows) {
            if (row.level === level) row.setAttribute('aria-current', 'true');
            else row.removeAttribute('aria-current');
        }
    }
}

/** The numbers of a sphere as the file has them, with its parent and its children as buttons. */
function showSelection(container, tree, shown, id, select) {
    if (id < 0) {
        container.replaceChildren(
            make('p', { class: 'note', text: 'None. Click a sphere, or give its number.' }),
        );
        return;
    }
    const kMostButtons = 24;
    const { spheres } = shown;
    const link = (other) =>
        make('button', { type: 'button', text: other, onclick: () => select(other) });
    const parent = spheres.parent[id],
        children = spheres.childrenOf(id);
    const more = children.length - kMostButtons;
    const own = shown.level
        ? term('Level', String(tree.levelOf(id).level))
        : term('In cuts of', `${spheres.first[id]} to ${spheres.last[id]} spheres`);
    container.replaceChildren(
        make(
            'dl',
            { id: 'sphere' },
            ...term('Number', String(id)),
            ...own,
            ...['x', 'y', 'z'].flatMap((name, axis) =>
                term(`Center ${name}`, String(spheres.center[3 * id + axis])),
            ),
            ...term('Radius', String(spheres.radius[id])),
            ...term('Parent', parent < 0 ? 'none' : link(parent)),
            ...term(
                children.length === 0 ? 'Children' : plural(children.length, 'child', 'children'),
                children.length === 0
                    ? 'none'
                    : make(
                          'span',
                          { class: 'many' },
                          ...children.slice(0, kMostButtons).map(link),
                          ...(more > 0 ? [`and ${short(more)} more`] : []),
                      ),
            ),
        ),
    );
}

/** What a screen reader says of a sphere. */
function selectionSentence(tree, shown, id) {
    if (id < 0) return 'No sphere is selected.';
    const { spheres } = shown;
    const place = spheres
        .centerOf(id)
        .map((value) => short(value))
        .join(', ');
    const of = shown.level ? ` of level ${tree.levelOf(id).level}` : '';
    const parent = spheres.parent[id] < 0 ? 'no parent' : `parent ${spheres.parent[id]}`;
    return (
        `Sphere ${id}${of}: radius ${short(spheres.radius[id])}, center ${place}, ${parent}, ` +
        `${plural(spheres.childrenOf(id).length, 'child', 'children')}.`
    );
}

/** What the tree was built from, and how. */
function describeTree(tree) {
    const { object, settings } = tree;
    const kinds = {
        tight: 'Tight tree of',
        inner: 'Spheres inside',
        fit: 'Spheres nearest to',
        extended: 'Extended tree of',
        reversible: 'Reversible tree of',
        given: 'Spheres of',
    };
    const isTight = settings.tree === 'tight' && settings.side in kinds;
    const kind = kinds[isTight ? settings.side : settings.tree] ?? 'Sphere-tree of';
    byId('name').textContent = tree.name;
    byId('kind').textContent =
        `${kind} ${object.name || 'an object'}: ` +
        `${plural(tree.nodes.size, 'sphere', 'spheres')} on ` +
        plural(tree.levels.length, 'level', 'levels');
    document.title = `${tree.name} \u2013 sphere-tree`;
    byId('object').append(
        ...term('Object', object.name || 'without a name'),
        ...term('Voxels', short(object.voxels)),
        ...term('Voxel size', String(object.voxel_size)),
        ...term('Box', `${object.bbox_min.join(', ')} to ${object.bbox_max.join(', ')}`),
    );
    byId('settings').append(
        ...Object.entries(settings).flatMap(([name, value]) =>
            term(name, Array.isArray(value) ? value.join(', ') : String(value ?? '')),
        ),
    );
}
