# SPDX-License-Identifier: Apache-2.0
"""Spheres that a file should hold, and what is asked of those that a reader found in it."""

import csv
import math
import subprocess
from collections import namedtuple
from fractions import Fraction

Sphere = namedtuple("Sphere", "x y z radius level id parent", defaults=(None, None, None))


class Trees:
    """Trees of the program under test, and the files that it makes of them."""

    def __init__(self, program, folder):
        self.program = program
        self.folder = folder

    def run(self, *words):
        result = subprocess.run([self.program, "-quiet", *map(str, words)], cwd=self.folder,
                                capture_output=True, text=True)
        if result.returncode != 0:
            raise AssertionError(f"{words}: exit code {result.returncode}: {result.stderr}")

    def write(self, tree, name, *options):
        """Writes one file of a tree, and returns its path."""
        self.run("-read", tree, "-write", name, *options)
        return self.folder / name

    def spheres(self, tree):
        """All spheres of a tree as its own table has them, the coarsest level first."""
        self.run("-read", tree, "-write", "expected.csv")
        with open(self.folder / "expected.csv", newline="") as rows:
            return [Sphere(*(float(row[key]) for key in ("x", "y", "z", "radius")),
                           *(int(row[key]) for key in ("level", "id", "parent")))
                    for row in csv.DictReader(rows)]

    def finest(self, tree):
        return [sphere for sphere in self.spheres(tree) if sphere.level == 0]


def exact(sphere):
    return [Fraction(value) for value in sphere[:4]]


def require_covered(found, expected, scale=1, tolerance=2e-6):
    """Each sphere that was read holds the one of the tree, in exact numbers, and is hardly larger."""
    if len(found) != len(expected):
        raise AssertionError(f"{len(found)} spheres were read, not {len(expected)}")
    smallest = min(sphere.radius for sphere in expected if sphere.radius > 0)
    for a, b in zip(found, expected):
        *center, radius = exact(a)
        *true_center, true_radius = (Fraction(scale) * value for value in exact(b))
        moved_sq = sum((p - q) ** 2 for p, q in zip(center, true_center))
        slack = radius - true_radius
        if slack < 0 or slack ** 2 < moved_sq:
            raise AssertionError(f"{a} does not hold {b} (scale {scale})")
        if slack > tolerance * scale * smallest + 1e-6 * true_radius:
            raise AssertionError(f"{a} is larger than {b} by {float(slack)}")
        for name in ("level", "id", "parent"):
            value = getattr(a, name)
            if value is not None and value != getattr(b, name):
                raise AssertionError(f"{a} has another {name} than {b}")


def require_near(found, expected, tolerance, what):
    if not math.isclose(found, expected, rel_tol=tolerance, abs_tol=0):
        raise AssertionError(f"{what}: {found}, not {expected}")
