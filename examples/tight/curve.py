# SPDX-License-Identifier: Apache-2.0
"""The error of each level against its number of spheres: curve.py [--times] NAME OUTPUT FOLDER KIND...

Reads FOLDER/KIND.*.json, the statistics of one tree or more, and writes OUTPUT.png, .svg and .csv. Levels
without an error, which are on no logarithmic scale, and those of one sphere are left out. With --times, what
the trees of a kind took stands beside it: the seconds of all of them against the geometric mean of the
levels' errors.
"""
import json
import math
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FuncFormatter

# Okabe and Ito's colours, told apart by shape and dash too.
STYLES = {
    "alone": ("tight, quality=best, one level a tree", "#000000", "X", ":"),
    "best": ("tight, quality=best", "#009E73", "D", "-"),
    "normal": ("tight (the default)", "#0072B2", "o", "-"),
    "fast": ("tight, quality=fast", "#56B4E9", "v", "--"),
    "miniball": ("extended, center=miniball", "#CC79A7", "P", "--"),
    "extended": ("extended", "#D55E00", "s", "-"),
    "reversible": ("reversible", "#E69F00", "^", "-"),
}
INK, FAINT = "#23272e", "#d9dde3"

plt.rcParams.update({
    "font.family": "DejaVu Sans", "font.size": 10, "text.color": INK, "axes.labelcolor": INK,
    "axes.edgecolor": "#8a919c", "xtick.color": INK, "ytick.color": INK, "axes.grid": True,
    "grid.color": FAINT, "grid.linewidth": 0.7, "axes.axisbelow": True,
    "axes.spines.top": False, "axes.spines.right": False,
    "lines.linewidth": 1.8, "lines.markersize": 6, "svg.hashsalt": "tight",
})


def statistics_of(folder, kind):
    return [json.loads(path.read_text(encoding="utf-8")) for path in folder.glob(f"{kind}.*.json")]


def levels_of(trees):
    points = [(level["spheres"], level["hamming_percent"])
              for tree in trees for level in tree["levels"]]
    return sorted(((n, error) for n, error in points if error and n > 1), reverse=True)


def seconds_of(trees):
    return sum(seconds for tree in trees for stage, seconds in tree["seconds"].items()
               if stage not in ("read", "error", "write", "total"))


def mean_error(points):
    return math.exp(sum(math.log(error) for _, error in points) / len(points))


def plain(value, _):
    return f"{value:,.0f}" if value >= 1 else f"{value:g}"


def draw_times(axes, curves, times):
    for kind, seconds in times.items():
        _, color, marker, _ = STYLES[kind]
        axes.plot(seconds, mean_error(curves[kind]), color=color, marker=marker, linestyle="none",
                  markersize=9, markeredgecolor="white", markeredgewidth=0.8)
    axes.margins(x=0.12)
    axes.set(xscale="log", ylim=(0, 1.15 * max(mean_error(curves[kind]) for kind in times)),
             xlabel="seconds for all levels",
             ylabel="mean Hamming error of the levels, %", title="what tight trees take")
    axes.xaxis.set_major_formatter(FuncFormatter(plain))
    axes.xaxis.set_minor_formatter(FuncFormatter(lambda *_: ""))


def draw(name, curves, times):
    panels = 2 if times else 1
    figure, all_axes = plt.subplots(
        1, panels, figsize=(7.2 if panels == 1 else 10.4, 4.6), layout="constrained", squeeze=False,
        width_ratios=[1.6, 1][:panels])
    axes = all_axes[0][0]
    if times:
        draw_times(all_axes[0][1], curves, times)
    for kind, points in curves.items():
        label, color, marker, dash = STYLES[kind]
        axes.plot(*zip(*points), label=label, color=color, marker=marker, linestyle=dash,
                  markeredgecolor="white", markeredgewidth=0.8)
    axes.set(xscale="log", yscale="log", xlabel="spheres",
             ylabel="Hamming error, % of the object", title=name)
    axes.xaxis.set_major_formatter(FuncFormatter(plain))
    axes.yaxis.set_major_formatter(FuncFormatter(plain))
    axes.legend(frameon=False)
    return figure


def main(*arguments):
    with_times = arguments[0] == "--times"
    name, output, folder, *kinds = arguments[with_times:]
    trees = {kind: statistics_of(Path(folder), kind) for kind in kinds}
    curves = {kind: levels_of(trees[kind]) for kind in kinds}
    curves = {kind: points for kind, points in curves.items() if points}
    if not curves:
        sys.exit("curve.py: no tree has a level that can be drawn")
    rows = [f"{kind},{n},{error:.6g}\n" for kind, points in curves.items() for n, error in points]
    Path(output + ".csv").write_text("tree,spheres,hamming_percent\n" + "".join(rows))
    # Of trees with the same numbers of spheres: else means say nothing.
    timed = [kind for kind in curves if with_times and STYLES[kind][0].startswith("tight")]
    times = {kind: seconds_of(trees[kind]) for kind in timed}
    figure = draw(name, curves, times)
    # No dates and no versions: the same numbers give the same files.
    figure.savefig(output + ".svg", metadata={"Date": None, "Creator": None})
    figure.savefig(output + ".png", dpi=110, metadata={"Software": None})


if __name__ == "__main__":
    main(*sys.argv[1:])
