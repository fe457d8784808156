// SPDX-License-Identifier: Apache-2.0
// Elements of the page. Text goes in as text, never as HTML: names come from files of strangers.

const byId = (id) => document.getElementById(id);

/** Sets attributes; `text` is the text, `on...` a listener, false and undefined leave one out. */
function withAttributes(element, attributes) {
    for (const [name, value] of Object.entries(attributes)) {
        if (name === 'text') element.textContent = value;
        else if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
        else if (value !== false && value !== undefined) element.setAttribute(name, value);
    }
    return element;
}

/** An element with attributes and children; a child may be a text. */
function make(tag, attributes = {}, ...children) {
    const element = withAttributes(document.createElement(tag), attributes);
    element.append(...children);
    return element;
}

/** The same of an SVG. */
function makeSvg(tag, attributes = {}, ...children) {
    const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
    withAttributes(element, attributes).append(...children);
    return element;
}

/** A row of a list of terms. */
const term = (name, ...value) => [make('dt', { text: name }), make('dd', {}, ...value)];

/** A number for reading, with so many digits that count; integers whole, thousands apart. */
function short(number, digits = 4) {
    if (Number.isInteger(number) && Math.abs(number) < 1e9) return number.toLocaleString('en');
    const size = Math.abs(number);
    if (size >= 1e5 || size < 1e-3) return number.toExponential(digits - 1);
    return String(Number(number.toPrecision(digits)));
}

const plural = (count, one, many) => `${short(count)} ${count === 1 ? one : many}`;

/** A colour of the style, as three shares. */
function styleColor(name) {
    const hex = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
    return [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255);
}
