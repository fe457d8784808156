# SPDX-License-Identifier: Apache-2.0
"""The numbers of the experiments, and what they say about the paper's claims.

Two ways to compare the errors of two trees: at equal level, where the trees have different numbers
of spheres; and at equal number of spheres, where the reversible tree's error is interpolated
between its levels, linearly in the logarithms of both.
"""
import json
import math
from pathlib import Path

FACTORS = (2, 3, 4)
KINDS = ("reversible", "paper", "extended")
LABELS = {
    "reversible": "reversible, tight scale",
    "paper": "reversible, the paper's scale",
    "extended": "extended",
}


class Tree:
    """Spheres and Hamming error (percent; None where not counted) of each level, from 0 on."""

    def __init__(self, stats):
        self.spheres = [level["spheres"] for level in stats["levels"]]
        self.hamming = [level["hamming_percent"] for level in stats["levels"]]

    def __len__(self):
        return len(self.spheres)

    def hamming_at(self, count):
        """The error at a number of spheres; None where no two levels above 0 enclose it.

        Level 0 is no end: 0 % has no logarithm. Of levels with as many spheres, the best counts.
        """
        best = {}
        for spheres, hamming in list(zip(self.spheres, self.hamming))[1:]:
            if hamming:
                best[spheres] = min(hamming, best.get(spheres, hamming))
        if count in best:
            return best[count]
        below = max((n for n in best if n < count), default=None)
        above = min((n for n in best if n > count), default=None)
        if below is None or above is None:
            return None
        weight = math.log(count / below) / math.log(above / below)
        return math.exp((1 - weight) * math.log(best[below]) + weight * math.log(best[above]))


class Volume:
    """What was measured for one object: trees[factor][kind]."""

    def __init__(self, folder):
        self.name = folder.name
        self.trees = {}
        for factor in FACTORS:
            self.trees[factor] = {}
            for kind in KINDS:
                stats = json.loads((folder / f"{kind}-{factor}.json").read_text(encoding="utf-8"))
                self.trees[factor][kind] = Tree(stats)
        self.voxels = stats["object"]["voxels"]
        low, high = stats["object"]["bbox_min"], stats["object"]["bbox_max"]
        self.box = [h - l + 1 for l, h in zip(low, high)]


def load(stats, names):
    return [Volume(Path(stats) / name) for name in names]


def percent(value):
    if value is None:
        return "–"
    if value == 0:
        return "0"
    return f"{value:,.0f}" if value >= 99.95 else f"{value:.1f}"


class Verdict:
    """Whether a claim holds, and the numbers: pairs (level, of extended, of the other tree)."""

    def __init__(self, claim, pairs, unit, shown):
        known = [p for p in pairs if None not in p]
        # Two single spheres are no evidence: fewer than one there cannot be.
        decisive = [p for p in known if unit == " %" or p[1:] != (1, 1)]
        won = [p for p in decisive if p[1] < p[2]]
        self.claim = claim
        if not decisive:
            self.status = "nothing to compare"
        elif len(won) == len(decisive):
            self.status = "holds"
        elif not won:
            self.status = "fails"
        else:
            self.status = f"at {len(won)} of {len(decisive)} levels"
        self.kind = "partly" if self.status.startswith("at ") else self.status.split(maxsplit=1)[0]
        self.numbers = "; ".join(
            f"level {level}: {shown(a)} {'<' if a < b else '=' if a == b else '>'} {shown(b)}{unit}"
            for level, a, b in known)


def fewer_levels(extended, reversible):
    verdict = Verdict("fewer levels", [(0, len(extended), len(reversible))], "", str)
    verdict.status += f", {len(extended)} against {len(reversible)}"
    verdict.numbers = ""
    return verdict


def smaller_error(extended, other, reading):
    common = range(1, min(len(extended), len(other)))
    at_level = [(k, extended.hamming[k], other.hamming[k]) for k in common]
    at_count = [(k, extended.hamming[k], other.hamming_at(extended.spheres[k]))
                for k in range(1, len(extended))]
    return [
        Verdict(f"smaller error, {reading}, at equal level", at_level, " %", percent),
        Verdict(f"smaller error, {reading}, at equal number of spheres", at_count, " %", percent),
    ]


def verdicts(trees):
    """What the numbers of one factor say. Level 0 is the same in all trees and takes no part."""
    extended, reversible = trees["extended"], trees["reversible"]
    common = range(1, min(len(extended), len(reversible)))
    spheres = [(k, extended.spheres[k], reversible.spheres[k]) for k in common]
    return [
        Verdict("fewer spheres, at equal level", spheres, "", lambda n: f"{n:,}"),
        fewer_levels(extended, reversible),
        *smaller_error(extended, reversible, "tight scale"),
        *smaller_error(extended, trees["paper"], "paper's scale"),
    ]
