# SPDX-License-Identifier: Apache-2.0
"""Opens a sphere-tree in Blender (3.4 and later), as points with radii.

    vdb_spheretree -read object.vdb -spheretree spheres=512,64,8,1 -write tree.csv
    blender --python import_spheretree.py -- tree.csv [level] [y-up]

Makes an object with a mesh of points, which have the attributes radius, level, id and parent, and a Geometry
Nodes modifier that turns the points of one level into spheres: its input Level switches. Spheres have the
colour of their parent. With y-up, what is up along y in the tree stands upright. In a script of your own: `import_spheretree.load("tree.csv", level=0)`.
"""

import colorsys
import csv
import math
import sys
from pathlib import Path

import bpy

NUMBERS = {"radius": "FLOAT", "level": "INT", "id": "INT", "parent": "INT"}


def read_table(path):
    """The rows of a tree as `-write x.csv` has them."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
    except (UnicodeDecodeError, csv.Error):  # another file, such as the .vdb
        rows = []
    if not rows or not {"x", "y", "z", *NUMBERS} <= rows[0].keys():
        raise ValueError(f"{path}: no table of a sphere-tree (vdb_spheretree -read tree.vdb -write tree.csv)")
    return rows


def color_of(parent):
    """Neighbours in the numbering are far apart on the circle of hues."""
    hue = (parent * 0.61803398875) % 1.0
    return (*colorsys.hsv_to_rgb(hue, 0.7, 0.8), 1.0)


def make_mesh(name, rows):
    """A point a sphere, with all its numbers as attributes."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([tuple(float(row[axis]) for axis in "xyz") for row in rows], [], [])
    for key, kind in NUMBERS.items():
        values = [float(row[key]) if kind == "FLOAT" else int(row[key]) for row in rows]
        mesh.attributes.new(key, kind, "POINT").data.foreach_set("value", values)
    # The root has no parent: it takes the colour of its own number.
    parents = [int(row["parent"]) if int(row["parent"]) >= 0 else int(row["id"]) for row in rows]
    colors = [part for parent in parents for part in color_of(parent)]
    mesh.attributes.new("sphere_color", "FLOAT_COLOR", "POINT").data.foreach_set("color", colors)
    return mesh


def add_socket(group, name, kind, is_input):
    """Blender 4 has moved the sockets of a group into its interface."""
    if hasattr(group, "interface"):
        return group.interface.new_socket(name, in_out="INPUT" if is_input else "OUTPUT", socket_type=kind)
    return (group.inputs if is_input else group.outputs).new(kind, name)


def named_attribute(group, name, kind):
    """A node that gives an attribute, and the output of it that is in use."""
    node = group.nodes.new("GeometryNodeInputNamedAttribute")
    node.data_type = kind
    node.inputs["Name"].default_value = name
    return next(output for output in node.outputs if output.enabled and output.name == "Attribute")


def make_material():
    material = bpy.data.materials.new("spheretree")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    attribute = nodes.new("ShaderNodeAttribute")
    attribute.attribute_name = "sphere_color"
    shader = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    material.node_tree.links.new(attribute.outputs["Color"], shader.inputs["Base Color"])
    return material


def make_node_group(material):
    """Points of the level that is asked for -> spheres."""
    group = bpy.data.node_groups.new("Sphere-tree level", "GeometryNodeTree")
    add_socket(group, "Geometry", "NodeSocketGeometry", is_input=True)
    add_socket(group, "Level", "NodeSocketInt", is_input=True)
    add_socket(group, "Geometry", "NodeSocketGeometry", is_input=False)
    nodes, link = group.nodes, group.links.new
    source, target = nodes.new("NodeGroupInput"), nodes.new("NodeGroupOutput")
    is_level = nodes.new("FunctionNodeCompare")
    is_level.data_type = "INT"
    is_level.operation = "EQUAL"
    numbers = [socket for socket in is_level.inputs if socket.enabled]
    link(named_attribute(group, "level", "INT"), numbers[0])
    link(source.outputs["Level"], numbers[1])
    to_points = nodes.new("GeometryNodeMeshToPoints")
    link(source.outputs["Geometry"], to_points.inputs["Mesh"])
    link(is_level.outputs["Result"], to_points.inputs["Selection"])
    link(named_attribute(group, "radius", "FLOAT"), to_points.inputs["Radius"])
    set_material = nodes.new("GeometryNodeSetMaterial")
    set_material.inputs["Material"].default_value = material
    link(to_points.outputs["Points"], set_material.inputs["Geometry"])
    link(set_material.outputs["Geometry"], target.inputs["Geometry"])
    return group


def level_input(modifier):
    """The name under which the modifier has its input Level."""
    group = modifier.node_group
    sockets = group.interface.items_tree if hasattr(group, "interface") else group.inputs
    return next(socket.identifier for socket in sockets if socket.name == "Level")


def show_level(tree, level):
    """Switches to another level of an object that load() has made."""
    modifier = tree.modifiers["Sphere-tree level"]
    modifier[level_input(modifier)] = int(level)
    tree.update_tag()


def load(path, level=None, up="Z"):
    """@return the new object; shows the finest level, or the one that is asked for.

    up: the axis of the tree that is upright, "Y" or "Z"
    """
    rows = read_table(path)
    levels = sorted({int(row["level"]) for row in rows})
    if level is not None and level not in levels:
        raise ValueError(f"{path}: there is no level {level}, but {levels}")
    name = Path(path).stem
    tree = bpy.data.objects.new(name, make_mesh(name, rows))
    bpy.context.collection.objects.link(tree)
    if up == "Y":
        tree.rotation_euler.x = math.pi / 2
    modifier = tree.modifiers.new("Sphere-tree level", "NODES")
    modifier.node_group = make_node_group(make_material())
    show_level(tree, levels[0] if level is None else level)
    return tree


def main():
    words = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    up = "Y" if "y-up" in words else "Z"
    words = [word for word in words if word != "y-up"]
    if len(words) not in (1, 2):
        sys.exit(__doc__)
    try:
        tree = load(words[0], int(words[1]) if len(words) == 2 else None, up)
        levels = {value.value for value in tree.data.attributes["level"].data}
        print(f"import_spheretree: object {tree.name!r} has {len(tree.data.vertices)} spheres on {len(levels)} levels")
    except (OSError, ValueError) as error:
        sys.exit(f"import_spheretree: {error}")


if __name__ == "__main__":
    main()
