#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a tree in the format of a tool, turned, mirrored and moved in several ways, and reads it with that tool.

usage: check_exports.py PROGRAM FOLDER READER    exit code 77: the reader is not here
"""

import sys
from pathlib import Path

import read_programs
import read_text
import read_web
from spheres import Trees


def turned_by(w, x, y, z):
    """Rows of the turn by a quaternion, times 0.05."""
    length = w * w + x * x + y * y + z * z
    return [[0.05 * value / length for value in row] for row in (
        (w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)),
        (2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)),
        (2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z))]


# Where the axes of index space are in the world, for row vectors, and where its origin is.
PLACES = {
    "turned and mirrored": ([[-0.04, 0.0, 0.03], [0.018, 0.04, 0.024], [-0.024, 0.03, -0.032]], (3.1, -2.2, 0.7)),
    "turned": (turned_by(1, 2, -3, 4), (-0.4, 1.5, 2.25)),
    "axes swapped": ([[0, 0.05, 0], [0.05, 0, 0], [0, 0, 0.05]], (0, 0, -1.5)),
    "as it is": ([[0.05, 0, 0], [0, 0.05, 0], [0, 0, 0.05]], (0, 0, 0)),
}


def write_object(path, place):
    """A bent body of voxels."""
    import pyopenvdb

    grid = pyopenvdb.BoolGrid()
    grid.fill((0, 0, 0), (19, 7, 5), True)
    grid.fill((0, 0, 0), (6, 7, 18), True)
    axes, origin = PLACES[place]
    grid.transform = pyopenvdb.createLinearTransform([[*axis, 0.0] for axis in axes] + [[*origin, 1.0]])
    grid.name = "bent"
    pyopenvdb.write(str(path), grids=[grid])


def main():
    program, folder, reader = sys.argv[1], Path(sys.argv[2]), sys.argv[3]
    readers = {**read_text.READERS, **read_programs.READERS, **read_web.READERS}
    folder.mkdir(parents=True, exist_ok=True)
    trees = Trees(program, folder)
    try:
        for place in PLACES:
            print(place)
            write_object(folder / "bent.vdb", place)
            trees.run("-read", "bent.vdb", "-spheretree", "spheres=30,6,1", "quality=fast", "-write", "turned.vdb")
            readers[reader](trees)
    except (ImportError, read_programs.Missing) as error:
        print(f"not here: {error}")
        return 77
    print(f"{reader}: all spheres are there")
    return 0


if __name__ == "__main__":
    sys.exit(main())
