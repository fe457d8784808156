# SPDX-License-Identifier: Apache-2.0
"""Where the pictures of Figure 6 are taken from.

    camera.py REVERSIBLE.csv EXTENDED.csv STATS.json UP

One line a level: the level, how many times as far away the camera stands as for level 0, eye, and
the point it looks at. All cameras look in one direction: along the shorter horizontal side of the
object, a little from the side and from above. A level whose spheres would not fit is seen from
farther away, in both trees alike.
"""
import csv
import json
import math
import sys

import numpy as np

HALF_ANGLE = math.radians(15)  # half the command's default angle of view
AZIMUTH, ELEVATION = math.radians(-25), math.radians(12)
STEPS = (1, 1.5, 2, 3, 4, 6, 8, 12, 16)


def spheres_by_level(path, smallest):
    """Rows x, y, z, radius; pictures show no radius below the smallest."""
    levels = {}
    with open(path, newline="", encoding="utf-8") as table:
        for row in csv.DictReader(table):
            sphere = [float(row[c]) for c in ("x", "y", "z", "radius")]
            sphere[3] = max(sphere[3], smallest)
            levels.setdefault(int(row["level"]), []).append(sphere)
    return {level: np.array(rows) for level, rows in levels.items()}


def view_direction(extent, up):
    """Unit vector from the object to the camera."""
    up = up / np.linalg.norm(up)
    axis = np.array([1.0, 0, 0]) if abs(up[0]) < 0.9 else np.array([0, 1.0, 0])
    right = axis - axis.dot(up) * up
    right /= np.linalg.norm(right)
    front = np.cross(right, up)
    if np.abs(right).dot(extent) < np.abs(front).dot(extent):
        front, right = right, np.cross(up, right)
    side = math.cos(AZIMUTH) * front + math.sin(AZIMUTH) * right
    return math.cos(ELEVATION) * side + math.sin(ELEVATION) * up


def fits(spheres, eye, toward):
    """Whether all spheres are within the cone that fills the picture, and before the camera."""
    offset = spheres[:, :3] - eye
    distance = np.linalg.norm(offset, axis=1)
    if (distance <= spheres[:, 3]).any():
        return False
    off_axis = np.arccos(np.clip(offset.dot(toward) / distance, -1, 1))
    return (off_axis + np.arcsin(spheres[:, 3] / distance) <= HALF_ANGLE).all()


def main(reversible, extended, stats, up):
    with open(stats, encoding="utf-8") as file:
        half_voxel = json.load(file)["object"]["voxel_size"] / 2
    trees = [spheres_by_level(path, half_voxel) for path in (reversible, extended)]
    leaves = trees[0][0]
    reach = leaves[:, 3:] + half_voxel  # radii reach the centres of voxels
    low = (leaves[:, :3] - reach).min(axis=0)
    high = (leaves[:, :3] + reach).max(axis=0)
    middle, extent = (low + high) / 2, high - low
    direction = view_direction(extent, np.array([float(u) for u in up.split(",")]))
    distance = np.linalg.norm(extent) / 2 / math.sin(HALF_ANGLE)
    text = ",".join
    for level in sorted(set(trees[0]) | set(trees[1])):
        spheres = np.concatenate([tree[level] for tree in trees if level in tree])
        for step in STEPS:
            eye = middle + step * distance * direction
            if level == 0 or fits(spheres, eye, -direction):
                break
        print(level, f"{step:g}", text(f"{e:.6g}" for e in eye), text(f"{m:.6g}" for m in middle))


if __name__ == "__main__":
    main(*sys.argv[1:])
