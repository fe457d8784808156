# SPDX-License-Identifier: Apache-2.0
"""The summary, as index.html and as summary.md: pages.py PAGE STATS NAME... [-- FILE...]

The names are those of folders in PAGE and in STATS; the files are volumes that were left out.
"""
import html
import sys
from pathlib import Path

import results

STYLE = """
:root { color-scheme: light dark; --ink: #23272e; --paper: #fbfbfc; --line: #d9dde3;
  --faint: #5f6773; --good: #0b6b4f; --bad: #a33c0a; --half: #7a5c00; --link: #0b5fa5; }
@media (prefers-color-scheme: dark) { :root { --ink: #e6e8eb; --paper: #17191d; --line: #3a3f47;
  --faint: #a3abb7; --good: #5fd0a8; --bad: #ff9b66; --half: #e6c34d; --link: #7db9f0; } }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1.5rem 1rem 4rem; max-width: 72rem; background: var(--paper);
  color: var(--ink); font: 16px/1.55 system-ui, "DejaVu Sans", sans-serif; }
h1 { font-size: 1.7rem; line-height: 1.25; }
h2 { margin-top: 3rem; padding-top: 1rem; border-top: 1px solid var(--line); }
h3 { margin-top: 2rem; }
a { color: var(--link); }
p, li { max-width: 46rem; }
figure { margin: 1.5rem 0; }
figure a:has(img) { display: block; overflow-x: auto; }
figure img { display: block; width: 100%; min-width: 40rem; height: auto; background: #fff;
  border-radius: 8px; border: 1px solid var(--line); padding: .4rem; }
figcaption { color: var(--faint); font-size: .9rem; margin-top: .4rem; max-width: 46rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: .92rem; font-variant-numeric: tabular-nums; }
th, td { padding: .3rem .8rem; border-bottom: 1px solid var(--line); text-align: right;
  vertical-align: bottom; }
.verdicts td { vertical-align: top; }
th:first-child, td:first-child { text-align: left; padding-left: 0; }
th { font-weight: 600; }
table.verdicts td, table.verdicts th { text-align: left; }
.holds { color: var(--good); font-weight: 600; }
.fails { color: var(--bad); font-weight: 600; }
.partly { color: var(--half); font-weight: 600; }
dt { font-weight: 600; margin-top: .6rem; }
dd { margin: 0 0 0 1rem; color: var(--faint); font-size: .92rem; }
"""

INTRODUCTION = [
    "Sphere-trees of three kinds, at factors f = 2, 3 and 4: reversible trees, whose radii are "
    "brought to the object's resolution in one of two ways, and extended trees. Level 0 is the "
    "finest, and the same in all of them; the paper counts from the coarsest. Every tree was "
    "checked against its object.",
    "Tight scale: a sphere covers the centres of the voxels that its ball stands for, and reaches "
    "no farther than it must. Paper's scale: radii are multiplied as they are, so that they cover "
    "more; the paper's figures seem to do so. Both have the same spheres but for their radii; extended "
    "trees know no such choice.",
    "Errors are Hamming distances in percent of the object's voxels, counted at the object's "
    "resolution. The claims are about the extended tree, compared with the reversible one. At "
    "equal level the two have different numbers of spheres; so errors are compared at equal number "
    "of spheres as well, where that of the reversible tree is interpolated between its levels "
    "(linearly in the logarithms of both). Level 0 has no error, and takes no part.",
]
MARKS = {"holds": "✓", "fails": "✗", "partly": "◐"}
HEAD = ["level", "spheres, reversible", "spheres, extended", "error % reversible, tight",
        "error % reversible, paper's", "error % extended", "tight at as many spheres as extended",
        "paper's at as many spheres"]
TITLE = "The experiments of “Hierarchical Discrete Medial Axis for Sphere-Tree Construction”"
CAPTIONS = {
    "figure5": "Figure 5: number of spheres (logarithmic) and Hamming error (logarithmic above the "
               "first decade, so that 0 % shows) of each level.",
    "tradeoff": "The same errors against the number of spheres: lower is better.",
    "figure6": "Figure 6: the spheres of each level at f = 2, reversible (tight) beside extended. "
               "Spheres of one parent share a colour; all are seen from the same direction.",
}


def mark(verdict):
    return f"{MARKS.get(verdict.kind, '')} {verdict.status}".strip()


def level_rows(trees):
    """Table of one factor: a list of texts for each level."""
    rows = []
    for level in range(max(len(tree) for tree in trees.values())):
        def at(kind, values):
            return values[level] if level < len(trees[kind]) else None
        spheres = [at(k, trees[k].spheres) for k in ("reversible", "extended")]
        errors = [at(k, trees[k].hamming) for k in results.KINDS]
        same_count = [None, None]
        if level > 0 and spheres[1] is not None:
            same_count = [trees[k].hamming_at(spheres[1]) for k in ("reversible", "paper")]
        rows.append([str(level)] + [f"{n:,}" if n is not None else "–" for n in spheres]
                    + [results.percent(e) for e in errors + same_count])
    return rows


def verdict_rows(volume):
    """One row a claim, one verdict a factor."""
    columns = [results.verdicts(volume.trees[f]) for f in results.FACTORS]
    return [(row[0].claim, row) for row in zip(*columns)]


def pictures(folder, count):
    """Links to single pictures that there are: (text, file)."""
    found = [("object", "object.png")]
    for level in range(count):
        for kind in ("reversible", "extended"):
            if (folder / f"{kind}-level{level}.png").exists():
                found.append((f"level {level} {kind}", f"{kind}-level{level}.png"))
    return found


class Html:
    """The blocks of the page, as HTML."""

    def __init__(self):
        self.parts = ["<!DOCTYPE html>", '<html lang="en"><head><meta charset="utf-8">',
                      '<meta name="generator" content="reproduce.sh">',
                      '<meta name="viewport" content="width=device-width, initial-scale=1">',
                      f"<title>Sphere-trees: the paper’s experiments</title><style>{STYLE}</style>",
                      "</head><body>"]

    def heading(self, level, text):
        self.parts.append(f"<h{level}>{html.escape(text)}</h{level}>")

    def text(self, text):
        self.parts.append(f"<p>{html.escape(text)}</p>")

    def figure(self, folder, name, suffixes, caption):
        links = ", ".join(f'<a href="{folder}/{name}{s}">{s[1:].upper()}</a>' for s in suffixes)
        image = f'<img src="{folder}/{name}{suffixes[0]}" alt="{html.escape(caption)}">'
        self.parts.append(f'<figure><a href="{folder}/{name}{suffixes[0]}">{image}</a>'
                          f"<figcaption>{html.escape(caption)} ({links})</figcaption></figure>")

    def links(self, lead, folder, links):
        listed = ", ".join(f'<a href="{folder}/{file}">{text}</a>' for text, file in links)
        self.parts.append(f"<p>{html.escape(lead)} {listed}.</p>")

    def table(self, head, rows):
        self.parts.append('<div class="wide"><table><tr>')
        self.parts += [f"<th>{html.escape(h)}</th>" for h in head]
        for row in rows:
            self.parts.append("</tr><tr>" + "".join(f"<td>{html.escape(c)}</td>" for c in row))
        self.parts.append("</tr></table></div>")

    def verdicts(self, rows):
        factors = "".join(f"<th>f = {f}</th>" for f in results.FACTORS)
        self.parts.append('<div class="wide"><table class="verdicts"><tr><th>extended tree has</th>'
                          + factors)
        for claim, columns in rows:
            cells = "".join(f'<td class="{v.kind}">{mark(v)}</td>' for v in columns)
            self.parts.append(f"</tr><tr><td>{html.escape(claim)}</td>{cells}")
        self.parts.append("</tr></table></div>")

    def evidence(self, verdicts):
        self.parts.append("<dl>")
        for v in verdicts:
            self.parts.append(f'<dt>{html.escape(v.claim)}: <span class="{v.kind}">{mark(v)}</span>'
                              f"</dt>")
            if v.numbers:
                self.parts.append(f"<dd>{html.escape(v.numbers)}</dd>")
        self.parts.append("</dl>")

    def finish(self):
        return "\n".join(self.parts + ["</body></html>", ""])


class Markdown:
    """The same blocks, as Markdown."""

    def __init__(self):
        self.parts = []

    def heading(self, level, text):
        self.parts.append("#" * level + " " + text)

    def text(self, text):
        self.parts.append(text)

    def figure(self, folder, name, suffixes, caption):
        self.parts.append(f"![{caption}]({folder}/{name}{suffixes[0]})\n\n{caption}")

    def links(self, lead, folder, links):
        listed = ", ".join(f"[{text}]({folder}/{file})" for text, file in links)
        self.parts.append(f"{lead} {listed}.")

    def table(self, head, rows):
        lines = [head, ["---:"] * len(head)] + rows
        self.parts.append("\n".join("| " + " | ".join(line) + " |" for line in lines))

    def verdicts(self, rows):
        head = ["extended tree has"] + [f"f = {f}" for f in results.FACTORS]
        lines = [head, ["---"] * len(head)] + [[c] + [mark(v) for v in vs] for c, vs in rows]
        self.parts.append("\n".join("| " + " | ".join(line) + " |" for line in lines))

    def evidence(self, verdicts):
        lines = [f"- {v.claim}: **{mark(v)}**. {v.numbers}".rstrip() for v in verdicts]
        self.parts.append("\n".join(lines))

    def finish(self):
        return "\n\n".join(self.parts) + "\n"


def write_page(out, page, volumes, left_out):
    out.heading(1, TITLE)
    for text in INTRODUCTION:
        out.text(text)
    if left_out:
        out.text("Left out, as the program refused them: " + ", ".join(left_out) + ".")
    for volume in volumes:
        out.heading(2, volume.name)
        out.text(f"{volume.voxels:,} voxels in a box of "
                 + " × ".join(f"{side:,}" for side in volume.box) + ".")
        out.verdicts(verdict_rows(volume))
        out.figure(volume.name, "figure6", [".png"], CAPTIONS["figure6"])
        most = max(len(tree) for tree in volume.trees[2].values())
        out.links("Single pictures:", volume.name, pictures(page / volume.name, most))
        out.figure(volume.name, "figure5", [".svg", ".png"], CAPTIONS["figure5"])
        out.figure(volume.name, "tradeoff", [".svg", ".png"], CAPTIONS["tradeoff"])
        for factor, trees in volume.trees.items():
            out.heading(3, f"f = {factor}")
            out.table(HEAD, level_rows(trees))
            out.evidence(results.verdicts(trees))
    return out.finish()


def main(page, stats, *arguments):
    split = arguments.index("--") if "--" in arguments else len(arguments)
    names, left_out = arguments[:split], arguments[split + 1:]
    page = Path(page)
    volumes = results.load(stats, names)
    for name, out in (("index.html", Html()), ("summary.md", Markdown())):
        (page / name).write_text(write_page(out, page, volumes, left_out), encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
