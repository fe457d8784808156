#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs every command of a page of docs/tasks, in the page's order, in a folder with the files that it begins with.

usage: run_page.py PROGRAM FOLDER PAGE [NAME=VALUE ...]    exit code 77: a program of the page is not here

Blocks between ```sh and ``` are for bash, and those between ```python and ``` for Python; a block with
<!-- needs: program --> in the line before is left out where there is no such program, or module of Python. A block between ```cpp and
``` must stand in a program of examples/, which others build and run. Each NAME=VALUE is put into the environment;
SPHERETREE is the project's folder.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path


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


def make_inputs(program, folder):
    def run(*words):
        subprocess.run([program, "-quiet", *words], cwd=folder, check=True)

    write_grippers(folder)
    write_slices(folder)
    run("-generate", "terrain", "voxels=20000", "name=scan", "-write", "scan.vdb")
    run("-generate", "menger", "voxels=20000", "name=part", "-write", "part.vdb")
    for frame, voxels in ((1, 4000), (2, 5000), (3, 6000)):
        run("-generate", "ball", f"voxels={voxels}", "name=smoke", "-write", f"smoke_{frame:04}.vdb")


def blocks_of(page):
    """Language, code, and the program that it needs, of each block."""
    pattern = re.compile(r"(?:<!-- needs: (\S+) -->\n)?```(sh|python|cpp)\n(.*?)```", re.DOTALL)
    return [(language, code, needs) for needs, language, code in pattern.findall(page.read_text())]


def is_here(name, environment):
    if shutil.which(name, path=environment["PATH"]):
        return True
    return subprocess.run([sys.executable, "-c", f"import {name}"], env=environment,
                          capture_output=True).returncode == 0


def main():
    program, folder, page = (Path(word).resolve() for word in sys.argv[1:4])
    environment = dict(os.environ, PATH=f"{program.parent}:{os.environ['PATH']}")
    environment.update(word.split("=", 1) for word in sys.argv[4:])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    make_inputs(program, folder)
    blocks = blocks_of(page)
    if not blocks:
        sys.exit(f"{page}: no block of commands")
    left_out = 0
    for language, code, needs in blocks:
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
    print(f"{page.name}: {len(blocks) - left_out} blocks ran, {left_out} were left out")
    return 77 if left_out == len(blocks) else 0


if __name__ == "__main__":
    sys.exit(main())
