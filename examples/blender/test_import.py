# SPDX-License-Identifier: Apache-2.0
"""Run by Blender: every level has its spheres, where and as large as the table says, in the colours of their parents;
renders one picture, and looks for these colours in it.

    blender -b -noaudio --factory-startup --python test_import.py -- tree.csv picture.png
"""

import colorsys
import math
import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).parent))
import import_spheretree  # noqa: E402


def clouds_shown():
    """The points that Blender would draw."""
    graph = bpy.context.evaluated_depsgraph_get()
    return [item.object.data for item in graph.object_instances
            if type(item.object.data).__name__ == "PointCloud"]


def spheres_shown():
    """Center and radius of all points."""
    return sorted((*point.co, point.radius) for cloud in clouds_shown() for point in cloud.points)


def check_colors(rows, level):
    """Siblings share a colour, and others have another one."""
    parents = {}
    for row in rows:
        if int(row["level"]) == level:
            parents[tuple(round(float(row[axis]), 4) for axis in "xyz")] = int(row["parent"])
    by_parent = {}
    for cloud in clouds_shown():
        for point, value in zip(cloud.points, cloud.attributes["sphere_color"].data):
            parent = parents[tuple(round(part, 4) for part in point.co)]
            by_parent.setdefault(parent, set()).add(tuple(round(part, 4) for part in value.color))
    assert set(by_parent) == set(parents.values()), level
    assert all(len(colors) == 1 for colors in by_parent.values()), (level, by_parent)
    different = set().union(*by_parent.values())
    assert len(different) == len(by_parent), (level, by_parent)


def check(path, tree):
    rows = import_spheretree.read_table(path)
    for level in sorted({int(row["level"]) for row in rows}):
        import_spheretree.show_level(tree, level)
        bpy.context.view_layer.update()
        expected = sorted(tuple(float(row[key]) for key in ("x", "y", "z", "radius"))
                          for row in rows if int(row["level"]) == level)
        shown = spheres_shown()
        assert len(shown) == len(expected), (level, len(shown), len(expected))
        for a, b in zip(shown, expected):
            assert all(math.isclose(p, q, rel_tol=1e-5, abs_tol=1e-5) for p, q in zip(a, b)), (a, b)
        check_colors(rows, level)


def render(tree, path):
    """A small picture by Cycles, which draws points as spheres."""
    scene = bpy.context.scene
    corners = [tree.matrix_world @ vertex.co for vertex in tree.data.vertices]
    low = [min(corner[axis] for corner in corners) for axis in range(3)]
    high = [max(corner[axis] for corner in corners) for axis in range(3)]
    middle = [(a + b) / 2 for a, b in zip(low, high)]
    size = max(b - a for a, b in zip(low, high))
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.clip_end = 100 * size
    camera.location = [m + d * size for m, d in zip(middle, (1.3, -1.7, 1.1))]
    aim = camera.constraints.new("TRACK_TO")
    aim.target = bpy.data.objects.new("middle", None)
    aim.target.location = middle
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy = 2
    sun.rotation_euler = (0.7, 0.3, 0.5)
    for thing in (camera, aim.target, sun):
        scene.collection.objects.link(thing)
    scene.camera = camera
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 8
    scene.cycles.use_denoising = False
    scene.render.resolution_x, scene.render.resolution_y = 320, 240
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)


def check_picture(path):
    """The 30 parents of the finest level have hues all around the circle, of which the lamp leaves most."""
    image = bpy.data.images.load(path)
    numbers = list(image.pixels)
    counts = [0] * 12
    for i in range(0, len(numbers), 4):
        hue, saturation, value = colorsys.rgb_to_hsv(*(min(part, 1) for part in numbers[i:i + 3]))
        if saturation > 0.3 and value > 0.1:
            counts[int(12 * hue) % 12] += 1
    assert sum(count > 50 for count in counts) >= 6, counts


def main():
    path, picture = sys.argv[sys.argv.index("--") + 1:]
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    tree = import_spheretree.load(path)
    check(path, tree)
    import_spheretree.show_level(tree, 0)
    tree.rotation_euler.x = math.pi / 2  # the picture is of something that has y up
    bpy.context.view_layer.update()
    render(tree, picture)
    check_picture(picture)
    print("all spheres are there")


if __name__ == "__main__":
    try:
        main()
    except BaseException as error:  # Blender itself ends with 0
        print(f"failed: {error!r}")
        sys.exit(1)
