# SPDX-License-Identifier: Apache-2.0
"""Readers of the web: tinyusdz, three.js and the validator of glTF, by node."""

import json
import math
import os
import struct
import subprocess
from pathlib import Path

from read_programs import Missing, need, output_of
from spheres import Sphere, require_covered

HERE = Path(__file__).resolve().parent


def node(trees, script, *arguments):
    """Runs a module with the packages of package.json, which are installed once."""
    need("node")
    need("npm")
    modules = Path(os.environ.get("SPHERETREE_NODE_MODULES", trees.folder))
    if not (modules / "node_modules" / "three").exists():
        modules.mkdir(parents=True, exist_ok=True)
        (modules / "package.json").write_text((HERE / "web" / "package.json").read_text())
        try:
            output_of("npm", "install", "--no-audit", "--no-fund", "--loglevel=error", cwd=modules)
        except (AssertionError, subprocess.TimeoutExpired) as error:
            raise Missing(f"packages of npm: {error}") from error
    # Modules find packages from where they are.
    copy = modules / script
    copy.write_text((HERE / "web" / script).read_text())
    return json.loads(output_of("node", copy, *arguments, cwd=modules))


def as_float(number):
    return struct.unpack("f", struct.pack("f", number))[0]


def spheres_of_usd(levels):
    """Spheres of a stage, the coarsest level first; numbers are text: the floats are those nearest to it."""
    for level in levels:
        level["points"] = [[as_float(v) for v in point] for point in level["points"]]
        level["extent"] = [[as_float(v) for v in point] for point in level["extent"]]
        level["widths"] = [as_float(v) for v in level["widths"]]
        for point, width in zip(level["points"], level["widths"]):
            for axis in range(3):
                low, high = (corner[axis] for corner in level["extent"])
                assert low <= point[axis] - width / 2 and point[axis] + width / 2 <= high
    return [Sphere(*point, width / 2, level["level"], id, parent)
            for level in reversed(levels)
            for point, width, id, parent in
            zip(level["points"], level["widths"], level["ids"], level["parents"])]


def read_usd(trees):
    path = trees.write("turned.vdb", "tree.usda", "up=z", "name=a tree")
    for script in ("tinyusdz.mjs", "three_usd.mjs"):
        stage = node(trees, script, path)
        assert stage["upAxis"] == "Z" and stage["metersPerUnit"] == 1, stage
        assert stage["defaultPrim"] == "a_tree"
        require_covered(spheres_of_usd(stage["levels"]), trees.spheres("turned.vdb"))
    stage = node(trees, "tinyusdz.mjs", path)
    assert stage["chosen"] == "level_0" and stage["shown"] == {f"level_{k}": [f"level_{k}"] for k in range(3)}, stage
    read_usd_samples(trees)


def read_usd_samples(trees):
    frames = {5: "first.vdb", 6: "second.vdb"}
    for scale, frame in zip((1, 1.5), frames.values()):
        trees.run("-read", "bent.vdb", f"scale={scale}", "-spheretree", "spheres=9,1", "quality=fast", "-write", frame)
    trees.run("-read", *frames.values(), "-write", "walk.usda", "start=5")
    stage = node(trees, "tinyusdz.mjs", trees.folder / "walk.usda")
    assert [sample["time"] for sample in stage["samples"]] == list(frames), stage
    for sample in stage["samples"]:
        require_covered(spheres_of_usd(sample["levels"]), trees.spheres(frames[sample["time"]]))


def read_gltf(trees):
    for options, triangles in ((("up=z",), None), (("format=mesh", "up=z"), 320)):
        path = trees.write("turned.vdb", "tree.glb", *options)
        report = node(trees, "validate.mjs", path)
        assert report["errors"] == 0 and report["warnings"] == 0, report
        scenes = node(trees, "three_gltf.mjs", path)
        all_spheres = trees.spheres("turned.vdb")
        finest = [sphere for sphere in all_spheres if sphere.level == 0]
        if triangles:
            (scene,) = scenes
            require_corners(scene["corners"], finest, triangles)
            continue
        # A scene is a level; the finest is shown.
        assert len(scenes) == 1 + max(sphere.level for sphere in all_spheres) == 3, len(scenes)
        for level, scene in enumerate(scenes):
            require_level(scene, [sphere for sphere in all_spheres if sphere.level == level])


def with_y_up(spheres):
    """What is up along z in the tree is so along y in glTF."""
    return [sphere._replace(y=sphere.z, z=-sphere.y) for sphere in spheres]


def require_corners(corners, spheres, triangles):
    """Three corners a triangle, on its sphere."""
    assert len(corners) == 3 * triangles * len(spheres), len(corners)
    for i, sphere in enumerate(with_y_up(spheres)):
        for corner in corners[3 * triangles * i:3 * triangles * (i + 1)]:
            off = abs(math.dist(corner, sphere[:3]) - sphere.radius)
            assert off <= 1e-6 * (sphere.radius + max(map(abs, sphere[:3]))), (corner, sphere)


def require_level(scene, spheres):
    found = [Sphere(*sphere) for sphere in scene["spheres"]]
    turned = with_y_up(spheres)
    assert len(found) == len(turned)
    for a, b in zip(found, turned):
        assert all(abs(a[i] - b[i]) < 1e-5 for i in range(4)), (a, b)
    assert scene["ids"] == [sphere.id for sphere in spheres]
    assert scene["parents"] == [sphere.parent for sphere in spheres]


READERS = {name[5:]: function for name, function in list(globals().items())
           if name.startswith("read_")}
