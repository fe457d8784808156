# SPDX-License-Identifier: Apache-2.0
"""The figures: figures.py PAGE STATS NAME... draws into each folder PAGE/NAME.

figure5.svg, .png   number of spheres and Hamming error a level
tradeoff.svg, .png  Hamming error against number of spheres
figure6.png         the spheres of each level, f = 2
"""
import math
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FuncFormatter, MaxNLocator

import results

# Okabe and Ito's colours, told apart by shape and dash too.
STYLES = {
    "reversible": {"color": "#0072B2", "marker": "o", "linestyle": "-"},
    "paper": {"color": "#E69F00", "marker": "^", "linestyle": "--"},
    "extended": {"color": "#D55E00", "marker": "s", "linestyle": "-"},
}
INK, FAINT = "#23272e", "#d9dde3"

plt.rcParams.update({
    "font.family": "DejaVu Sans", "font.size": 10, "text.color": INK, "axes.labelcolor": INK,
    "axes.edgecolor": "#8a919c", "xtick.color": INK, "ytick.color": INK, "axes.grid": True,
    "grid.color": FAINT, "grid.linewidth": 0.7, "axes.axisbelow": True,
    "axes.spines.top": False, "axes.spines.right": False, "axes.titleweight": "bold",
    "lines.linewidth": 1.8, "lines.markersize": 6, "svg.hashsalt": "paper",
})


def save(figure, path):
    """No dates and no versions: the same numbers give the same files."""
    figure.savefig(path.with_suffix(".svg"), metadata={"Date": None, "Creator": None})
    figure.savefig(path.with_suffix(".png"), dpi=160, metadata={"Software": None})
    plt.close(figure)


def draw(axes, x, y, kind):
    known = [(a, b) for a, b in zip(x, y) if b is not None]
    axes.plot(*zip(*known), label=results.LABELS[kind], markeredgecolor="white",
              markeredgewidth=0.8, **STYLES[kind])


def plain_numbers(axis, unit=""):
    axis.set_major_formatter(
        FuncFormatter(lambda v, _: (f"{v:,.0f}" if v >= 1 else f"{v:g}") + unit))


def legend_below(figure, axes):
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncol=3, frameon=False)


def error_axis(axes, trees):
    """Logarithmic, but for a linear part at the bottom, so that 0 % shows."""
    errors = [h for tree in trees.values() for h in tree.hamming if h]
    lowest = 10 ** math.floor(math.log10(min(errors, default=1)))
    highest = 10 ** math.ceil(math.log10(max(errors, default=10)))
    axes.set_yscale("symlog", linthresh=lowest, linscale=0.6)
    axes.set_ylim(-0.12 * lowest, highest)
    ticks = [lowest * 10 ** k for k in range(round(math.log10(highest / lowest)) + 1)]
    axes.set_yticks([0] + ticks)
    axes.set_yticks([m * t for t in ticks[:-1] for m in range(2, 10)], minor=True)
    plain_numbers(axes.yaxis, " %")


def figure5(volume, folder):
    figure, grid = plt.subplots(2, 3, figsize=(11, 6.6), sharex="col", sharey="row")
    for column, factor in enumerate(results.FACTORS):
        trees = volume.trees[factor]
        top, bottom = grid[0][column], grid[1][column]
        # The two reversible trees have the same spheres, so the second lies on the first.
        for kind in results.KINDS:
            levels = range(len(trees[kind]))
            draw(top, levels, trees[kind].spheres, kind)
            draw(bottom, levels, trees[kind].hamming, kind)
        top.set_title(f"f = {factor}")
        top.set_yscale("log")
        plain_numbers(top.yaxis)
        bottom.xaxis.set_major_locator(MaxNLocator(integer=True))
        bottom.set_xlabel("level (0 is the finest)")
    all_trees = {(f, k): t for f, trees in volume.trees.items() for k, t in trees.items()}
    error_axis(grid[1][0], all_trees)
    grid[0][0].set_ylabel("number of spheres")
    grid[1][0].set_ylabel("Hamming error")
    figure.suptitle(f"{volume.name}: spheres and error of each level", x=0.02, ha="left", size=13)
    figure.tight_layout(rect=(0, 0.05, 1, 0.99))
    legend_below(figure, grid[0][0])
    save(figure, folder / "figure5")


def tradeoff(volume, folder):
    figure, row = plt.subplots(1, 3, figsize=(11, 4.2), sharey=True)
    for axes, factor in zip(row, results.FACTORS):
        for kind in results.KINDS:
            tree = volume.trees[factor][kind]
            pairs = [(n, h) for n, h in zip(tree.spheres, tree.hamming) if h]
            if pairs:
                draw(axes, *zip(*pairs), kind)
        axes.set_title(f"f = {factor}")
        axes.set_xscale("log")
        axes.set_yscale("log")
        plain_numbers(axes.xaxis)
        plain_numbers(axes.yaxis, " %")
        axes.set_xlabel("number of spheres")
    row[0].set_ylabel("Hamming error")
    figure.suptitle(f"{volume.name}: what the same number of spheres achieves", x=0.02, ha="left",
                    size=13)
    figure.tight_layout(rect=(0, 0.07, 1, 0.99))
    legend_below(figure, row[0])
    save(figure, folder / "tradeoff")


def panel(figure, cell, path, caption):
    axes = figure.add_subplot(cell)
    axes.set_axis_off()
    axes.text(0.5, -0.03, caption, transform=axes.transAxes, ha="center", va="top", size=12)
    if path and path.exists():
        axes.imshow(plt.imread(path), interpolation="antialiased")
    return axes


def heading(axes, text):
    axes.set_title(text, size=14, pad=7, loc="left")


def pairs_beside(count):
    """How many levels stand side by side, for a sheet that is nearly as wide as a slide."""
    def aspect(pairs):
        return (1 + 2 * pairs) * 2.5 / (math.ceil(count / pairs) * 3.2)
    return min(range(1, count + 1), key=lambda pairs: abs(math.log(aspect(pairs) / (16 / 9))))


def caption_of(tree, kind, level):
    if level >= len(tree):
        return f"{kind}:\nno level {level}"
    spheres, error = tree.spheres[level], results.percent(tree.hamming[level])
    return f"{kind}: {spheres:,} sphere{'s' * (spheres != 1)}\nerror {error} %"


def figure6(volume, folder, cameras):
    """One column for the object, then a pair of columns for the two trees, with gaps between."""
    trees = volume.trees[2]
    pairs = pairs_beside(len(cameras))
    rows = math.ceil(len(cameras) / pairs)
    widths = [1] + [0.1, 1, 1] * pairs
    width, height = 2.5 * sum(widths), 3.3 * rows
    figure = plt.figure(figsize=(width, height))
    grid = figure.add_gridspec(rows, len(widths), width_ratios=widths, left=0.15 / width,
                               right=1 - 0.15 / width, bottom=0.6 / height,
                               top=1 - 0.4 / height, wspace=0.03, hspace=0.36)
    legend = "f = 2\nspheres of one parent\nshare a colour"
    axes = panel(figure, grid[0, 0], folder / "object.png",
                 f"{volume.voxels:,} voxels\n\n{legend}")
    heading(axes, volume.name)
    for level, times in enumerate(cameras):
        row, column = level % rows, 2 + 3 * (level // rows)
        for side, kind in enumerate(("reversible", "extended")):
            path = folder / f"{kind}-level{level}.png"
            axes = panel(figure, grid[row, column + side], path,
                         caption_of(trees[kind], kind, level))
            if side == 0:
                far = "" if times == "1" else f"   (from {times} times as far)"
                heading(axes, f"level {level}{far}")
    figure.savefig(folder / "figure6.png", dpi=160, metadata={"Software": None})
    plt.close(figure)


def main(page, stats, *names):
    for volume in results.load(stats, names):
        folder = Path(page) / volume.name
        lines = (Path(stats) / volume.name / "cameras.txt").read_text(encoding="utf-8")
        figure5(volume, folder)
        tradeoff(volume, folder)
        figure6(volume, folder, [line.split()[1] for line in lines.splitlines()])


if __name__ == "__main__":
    main(*sys.argv[1:])
