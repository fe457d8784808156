#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs every command of a page of docs/tasks, in the page's order, in a folder with the files that it begins with.

usage: run_page.py PROGRAM FOLDER PAGE [NAME=VALUE ...]    exit code 77: a program of the page is not here

Blocks between ```sh and ```, and whole commands within a sentence, are for bash; those between ```python and ``` are for
Python. A block with <!-- needs: program --> in the line before is left out where there is no such program, or module of
Python. A block between ```cpp and ``` must stand in a program of examples/, which others build and run. Each NAME=VALUE is
put into the environment; SPHERETREE is the project's folder. A page with a command that would not be run, or that is longer than
a screen, fails before anything is run: task_page.py says what is looked for.
"""

import os
import shutil
import struct
import subprocess
import sys
from pathlib import Path

import task_page


def write_box(out, low, high):
    """Twelve triangles, whose normals a reader finds itself."""
    corner = [[(low, high)[i >> axis & 1][axis] for axis in range(3)] for i in range(8)]
    for a, b, c, d in ((0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)):
        for triangle in ((a, b, c), (a, c, d)):
            out.write("facet normal 0 0 0\nouter loop\n")
            for i in triangle:
                out.write("vertex {} {} {}\n".format(*corner[i]))
            out.write("endloop\nendfacet\n")


def write_boxes(path, *boxes):
    with open(path, "w") as out:
        out.write("solid boxes\n")
        for low, high in boxes:
            write_box(out, low, high)
        out.write("endsolid boxes\n")


def write_grippers(folder):
    """A palm and two fingers, in millimetres: in one mesh, where parts overlap as they do in models of parts, and as links."""
    palm = ((-40, -15, 0), (40, 15, 20))
    write_boxes(folder / "gripper.stl", palm, ((-40, -8, 10), (-28, 8, 70)), ((28, -8, 10), (40, 8, 70)))
    (folder / "links").mkdir()
    write_boxes(folder / "links" / "palm.stl", palm)
    write_boxes(folder / "links" / "finger.stl", ((-6, -8, 0), (6, 8, 60)))
    # As another tool would cover the gripper, in metres.
    (folder / "spheres.csv").write_text("x,y,z,radius\n0,0,0.01,0.046\n-0.034,0,0.04,0.034\n0.034,0,0.04,0.034\n")


def write_slices(folder):
    """A stack of pictures in grey: a bright grain with a dark pore in it."""
    size = 40
    for z in range(size):
        rows = bytearray()
        for y in range(size):
            for x in range(size):
                grain = (x - 20) ** 2 + (y - 20) ** 2 + 2 * (z - 20) ** 2 < 17 ** 2
                pore = (x - 24) ** 2 + (y - 20) ** 2 + (z - 20) ** 2 < 4 ** 2
                rows.append(200 if grain and not pore else 20)
        with open(folder / f"slice_{z:04}.pgm", "wb") as out:
            out.write(b"P5\n%d %d\n255\n" % (size, size) + rows)


def write_array(path, kind, bytes_of_values, shape):
    """An array of numpy in C order; kind is its name for the type."""
    head = f"{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}"
    head = head.ljust(117) + "\n"  # with the ten bytes before it, a multiple of 64
    with open(path, "wb") as out:
        out.write(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head.encode() + bytes_of_values)


def write_labels(folder):
    """Three boxes side by side, of labels 1 to 3, slices first."""
    size = 24
    slab = bytes(1 + x // 8 if x % 8 and y in range(4, 20) else 0 for y in range(size) for x in range(size))
    write_array(folder / "labels.npy", "|u1", bytes(4 * size * size) + 16 * slab + bytes(4 * size * size), (size,) * 3)


def write_smoke(program, folder):
    """Three frames of fog, of which the first is too thin to be an object."""
    size = 24
    for frame, densest in ((1, 0.05), (2, 0.8), (3, 1)):
        values = []
        for z in range(size):
            for y in range(size):
                for x in range(size):
                    swirl = (x - 12) * (y - 12) // 3 % (3 + frame)
                    values.append(densest * max(0, 1 - ((x - 12) ** 2 + 2 * (y - 12) ** 2 + (z - 12) ** 2 + 9 * swirl) / 120))
        write_array(folder / "smoke.npy", "<f4", struct.pack(f"<{size ** 3}f", *values), (size,) * 3)
        subprocess.run([program, "-quiet", "-read", "smoke.npy", "-write", f"smoke_{frame:04}.vdb"], cwd=folder, check=True)
    (folder / "smoke.npy").unlink()


def make_inputs(program, folder):
    def run(*words):
        subprocess.run([program, "-quiet", *words], cwd=folder, check=True)

    write_grippers(folder)
    write_slices(folder)
    write_labels(folder)
    write_smoke(program, folder)
    run("-generate", "terrain", "voxels=20000", "name=scan", "-write", "scan.vdb")
    run("-generate", "menger", "voxels=20000", "name=part", "-write", "part.vdb")


def is_here(name, environment):
    if shutil.which(name, path=environment["PATH"]):
        return True
    return subprocess.run([sys.executable, "-c", f"import {name}"], env=environment,
                          capture_output=True).returncode == 0


def main():
    program, folder, page = (Path(word).resolve() for word in sys.argv[1:4])
    text = page.read_text()
    pieces, faults = task_page.pieces_of(text), list(task_page.faults_of(text))
    if faults or not pieces:
        sys.exit("\n".join(f"{page.name}: {fault}" for fault in faults or ["no command"]))
    environment = dict(os.environ, PATH=f"{program.parent}:{os.environ['PATH']}")
    environment.update(word.split("=", 1) for word in sys.argv[4:])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    make_inputs(program, folder)
    left_out = 0
    for language, code, needs in pieces:
        if needs and not is_here(needs, environment):
            left_out += 1
            continue
        if language == "cpp":
            examples = (Path(environment["SPHERETREE"]) / "examples").glob("*.cc")
            if not any(code in example.read_text() for example in examples):
                sys.exit(f"{page.name}: no program of examples/ has this code:\n{code}")
            continue
        words = ["bash", "-euo", "pipefail", "-c"] if language == "sh" else [sys.executable, "-c"]
        result = subprocess.run([*words, code], cwd=folder, env=environment, capture_output=True, text=True)
        if result.returncode != 0:
            sys.exit(f"{page.name}:\n{code}\nexit code {result.returncode}\n{result.stdout}{result.stderr}")
    print(f"{page.name}: {len(pieces) - left_out} blocks and commands ran, {left_out} were left out")
    return 77 if left_out == len(pieces) else 0


if __name__ == "__main__":
    sys.exit(main())
