#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a turned and mirrored tree in the format of a tool, and reads it with that tool.

usage: check_exports.py PROGRAM FOLDER READER    exit code 77: the reader is not here
"""

import sys
from pathlib import Path

import read_programs
import read_text
import read_web
from spheres import Trees


def write_object(path):
    """A bent body of voxels, turned, mirrored, scaled and moved."""
    import pyopenvdb

    grid = pyopenvdb.BoolGrid()
    grid.fill((0, 0, 0), (19, 7, 5), True)
    grid.fill((0, 0, 0), (6, 7, 18), True)
    grid.transform = pyopenvdb.createLinearTransform([
        [-0.04, 0.0, 0.03, 0.0], [0.018, 0.04, 0.024, 0.0],
        [-0.024, 0.03, -0.032, 0.0], [3.1, -2.2, 0.7, 1.0]])
    grid.name = "bent"
    pyopenvdb.write(str(path), grids=[grid])


def main():
    program, folder, reader = sys.argv[1], Path(sys.argv[2]), sys.argv[3]
    readers = {**read_text.READERS, **read_programs.READERS, **read_web.READERS}
    folder.mkdir(parents=True, exist_ok=True)
    trees = Trees(program, folder)
    try:
        write_object(folder / "bent.vdb")
        trees.run("-read", "bent.vdb", "-spheretree", "spheres=30,6,1", "quality=fast", "-write", "turned.vdb")
        readers[reader](trees)
    except (ImportError, read_programs.Missing) as error:
        print(f"not here: {error}")
        return 77
    print(f"{reader}: all spheres are there")
    return 0


if __name__ == "__main__":
    sys.exit(main())
