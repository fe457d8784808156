# SPDX-License-Identifier: Apache-2.0
"""What tests of the Python module share."""
import os
import pathlib
import subprocess

import numpy as np
import pytest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent


def ball(radius, scale=(1, 1, 1)):
    """A ball, or an ellipsoid, as an array of bool with a rim of one voxel."""
    grid = np.mgrid[tuple(slice(-radius - 1, radius + 2) for _ in scale)]
    return sum((axis * s) ** 2 for axis, s in zip(grid, scale)) < radius**2


def random_poses(count, seed=1, size=12):
    """Rigid matrices, turned at random, that move by up to `size` along each axis: shape (count, 4, 4)."""
    random = np.random.default_rng(seed)
    made = np.tile(np.eye(4), (count, 1, 1))
    made[:, :3, :3] = [np.linalg.qr(random.normal(size=(3, 3)))[0] for _ in range(count)]
    made[:, :3, 0] *= np.linalg.det(made[:, :3, :3])[:, None]
    made[:, :3, 3] = random.uniform(-size, size, (count, 3))
    return made


@pytest.fixture
def bone():
    """An object without any symmetry, of a shape that has three different sides."""
    x, y, z = np.mgrid[:40, :24, :18]
    shaft = (y - 9) ** 2 + (z - 8) ** 2 < 20 + 0.05 * (x - 18) ** 2
    return shaft & (x > 3) & (x < 37) & (x + 2 * y + z > 18)


def run_program(*arguments, folder=None):
    """A program of this build. It has its own sanitizer, if any: not the one that Python loads first."""
    environment = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
    if "ASAN_OPTIONS" in environment:  # leaks are looked for in programs, and not in Python
        environment["ASAN_OPTIONS"] = environment["ASAN_OPTIONS"].replace("detect_leaks=0", "detect_leaks=1")
    subprocess.run(list(map(str, arguments)), check=True, cwd=folder, env=environment)


@pytest.fixture
def command(tmp_path):
    """Runs the command vdb_spheretree in a folder of the test's own."""
    program = os.environ.get("VDB_SPHERETREE")
    if not program:
        pytest.skip("VDB_SPHERETREE does not name the command")

    def run(*arguments):
        run_program(program, "-quiet", *arguments, folder=tmp_path)

    return run


def write_vol(path, values):
    """An array of uint8 of shape (x, y, z) as a .vol file."""
    x, y, z = values.shape
    header = f"X: {x}\nY: {y}\nZ: {z}\nVoxel-Size: 1\nInt-Endian: 0123\nVersion: 2\n.\n"
    path.write_bytes(header.encode() + values.astype(np.uint8).tobytes(order="F"))
