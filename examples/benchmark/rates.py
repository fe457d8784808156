# SPDX-License-Identifier: Apache-2.0
"""Draws what the benchmark measured: rates.py NUMBERS.json PICTURE.png [THREADS]

Above, a panel a stage: million active voxels a second over active voxels, for each family of generated
objects; level lines are time that is linear in voxels. Below, for all other objects, each stage's rate in
percent of that of the plain copy. THREADS (the fewest) is which of the numbers of threads to draw.
"""
import json
import math
import sys
from collections import Counter
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, NullFormatter

# Okabe and Ito's colours, told apart by shape too.
COLORS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#7a5230"]
MARKERS = "os^Dvp<h"
COLUMNS = 5
INK, FAINT = "#23272e", "#d9dde3"

plt.rcParams.update({
    "font.family": "DejaVu Sans", "font.size": 10, "text.color": INK, "axes.labelcolor": INK,
    "axes.edgecolor": "#8a919c", "xtick.color": INK, "ytick.color": INK, "axes.grid": True,
    "grid.color": FAINT, "grid.linewidth": 0.7, "axes.axisbelow": True,
    "axes.spines.top": False, "axes.spines.right": False,
    "lines.linewidth": 1.6, "lines.markersize": 5.5,
})


def unique(values):
    return list(dict.fromkeys(values))


def stages_of(rows):
    """In the order of the program: not every object has every stage, so those that have most come first."""
    counts = Counter(m["object"] for m in rows)
    return unique(m["stage"] for m in sorted(rows, key=lambda m: -counts[m["object"]]))


def styles(names):
    return {name: {"color": COLORS[i % len(COLORS)], "marker": MARKERS[i % len(MARKERS)]}
            for i, name in enumerate(names)}


def plain(value, _):
    return f"{value:,.0f}" if value >= 1 else f"{value:g}"


def power_of_ten(value, _):
    return f"$10^{{{round(math.log10(value))}}}$"


def draw_stage(axes, rows, stage, style):
    for family, look in style.items():
        points = sorted((m["voxels"], m["mvoxels_per_second"])
                        for m in rows if m["family"] == family and m["stage"] == stage)
        if points:
            axes.plot(*zip(*points), markeredgecolor="white", markeredgewidth=0.6, **look)
    axes.set_title(stage, fontsize=10)
    axes.set(xscale="log", yscale="log")
    axes.xaxis.set_major_locator(LogLocator(numticks=12))
    axes.xaxis.set_major_formatter(FuncFormatter(power_of_ten))
    axes.yaxis.set_major_locator(LogLocator(numticks=12))
    axes.yaxis.set_major_formatter(FuncFormatter(plain))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.minorticks_off()


def legend(axes, style, title, dash, **where):
    handles = [Line2D([], [], linestyle=dash, label=name, **look) for name, look in style.items()]
    axes.legend(handles=handles, title=title, frameon=False, alignment="left", **where)


def draw_families(figure, rows, stages, threads):
    style = styles(unique(m["family"] for m in rows))
    count = math.ceil((len(stages) + 1) / COLUMNS)
    panels = figure.subplots(count, COLUMNS, sharex=True, sharey=True, squeeze=False)
    flat = list(panels.flat)
    for axes, stage in zip(flat, stages):
        draw_stage(axes, rows, stage, style)
    for i, axes in enumerate(flat[len(stages):], start=len(stages)):
        axes.axis("off")
        flat[i - COLUMNS].tick_params(axis="x", labelbottom=True)
    legend(flat[len(stages)], style, "objects by rule", "-", loc="center left")
    figure.supxlabel("active voxels", fontsize=10)
    figure.supylabel("million active voxels a second", fontsize=10)
    figure.suptitle(f"Rate on {threads} thread{'s' * (threads > 1)}: level lines are time linear in voxels",
                    fontsize=11)


def draw_others(figure, rows, stages):
    style = styles(unique(m["object"] for m in rows))
    axes = figure.subplots()
    for i, (name, look) in enumerate(style.items()):
        shift = 0.6 * ((i + 0.5) / len(style) - 0.5) # so that equal values do not hide each other
        points = [(100 * m["of_copy"], stages.index(m["stage"]) + shift)
                  for m in rows if m["object"] == name]
        axes.plot(*zip(*points), linestyle="", markeredgecolor="white", markeredgewidth=0.6, **look)
    axes.set(xscale="log", xlabel="rate in % of that of a plain copy of as many leaves of int32",
             ylim=(len(stages) - 0.4, -0.6))
    axes.set_yticks(range(len(stages)), stages)
    axes.yaxis.set_minor_locator(FixedLocator([i + 0.5 for i in range(len(stages) - 1)]))
    axes.grid(axis="y", which="major", visible=False)
    axes.grid(axis="y", which="minor")
    axes.tick_params(axis="y", which="both", length=0)
    axes.xaxis.set_major_formatter(FuncFormatter(plain))
    legend(axes, style, "objects", "", loc="center left", bbox_to_anchor=(1, 0.5))


def parts(figure, rows, threads):
    families = [m for m in rows if "family" in m]
    others = [m for m in rows if "family" not in m]
    stages = [stages_of(part) for part in (families, others)]
    if families and others:
        above, below = figure.subfigures(2, 1, height_ratios=(7.2, 0.8 + 0.36 * len(stages[1])))
    else:
        above = below = figure
    if families:
        draw_families(above, families, stages[0], threads)
    if others:
        draw_others(below, others, stages[1])


def main(numbers, picture, threads=None):
    measured = json.loads(Path(numbers).read_text(encoding="utf-8"))["measurements"]
    measured = [m for m in measured if "seconds" in m]
    if threads is None:
        threads = min((m["threads"] for m in measured), default=1)
    rows = [m for m in measured if m["threads"] == int(threads)]
    if not rows:
        sys.exit(f"rates.py: nothing was measured on so many threads: {threads}")
    figure = plt.figure(figsize=(10.5, 13), layout="constrained")
    parts(figure, rows, int(threads))
    # No dates and no versions: the same numbers give the same file.
    figure.savefig(picture, dpi=100, metadata={"Software": None})


if __name__ == "__main__":
    main(*sys.argv[1:])
