# SPDX-License-Identifier: Apache-2.0
"""Readers of text: YAML, JSON, XML, CSV and columns of numbers, each as the tools that want it take it."""

import json
import xml.etree.ElementTree as xml

from spheres import Sphere, require_covered


def of_rows(rows):
    return [Sphere(*(float(value) for value in row[:4])) for row in rows]


def read_srdf(trees):
    root = xml.parse(trees.write("turned.vdb", "robot.srdf", "link=große 手")).getroot()
    link = root.find("link_sphere_approximation")
    assert link.get("link") == "große 手"
    found = of_rows(s.get("center").split() + [s.get("radius")] for s in link.findall("sphere"))
    require_covered(found, trees.finest("turned.vdb"))


def yaml_spheres(entries):
    """PyYAML takes 1e-05 for text and 1 for a whole number, and cuRobo neither for a float."""
    for entry in entries:
        assert set(entry) == {"center", "radius"}, entry
        assert all(type(v) is float for v in [*entry["center"], entry["radius"]]), entry
    return of_rows([*entry["center"], entry["radius"]] for entry in entries)


def read_curobo(trees):
    import yaml

    # Radii down to a hundred thousandth.
    tree = yaml.safe_load(open(trees.write("turned.vdb", "robot.yml", "link=gripper", "scale=1e-4")))
    kinematics = tree["robot_cfg"]["kinematics"]
    assert kinematics["collision_link_names"] == ["gripper"]
    assert type(kinematics["collision_sphere_buffer"]) is float
    assert type(kinematics["self_collision_buffer"]["gripper"]) is float
    found = yaml_spheres(kinematics["collision_spheres"]["gripper"])
    require_covered(found, trees.finest("turned.vdb"), scale=1e-4)


def read_xrdf(trees):
    import yaml

    tree = yaml.safe_load(open(trees.write("turned.vdb", "robot.xrdf", "link=große 手", "name=ärm"), encoding="utf-8"))
    assert tree["format"] == "xrdf" and type(tree["format_version"]) is float
    geometry = tree["collision"]["geometry"]
    assert geometry == tree["self_collision"]["geometry"] == "ärm"
    require_covered(yaml_spheres(tree["geometry"][geometry]["spheres"]["große 手"]),
                    trees.finest("turned.vdb"))


def read_lula(trees):
    import yaml

    path = trees.write("turned.vdb", "lula.yaml", "format=lula", "link=gripper")
    links = yaml.safe_load(open(path))["collision_spheres"]
    assert isinstance(links, list) and list(links[0]) == ["gripper"]
    require_covered(yaml_spheres(links[0]["gripper"]), trees.finest("turned.vdb"))


def read_links(trees):
    """A robot of two links, each a tree of its own, called after their files or as it is typed."""
    import yaml

    trees.run("-read", "bent.vdb", "-spheretree", "spheres=12", "quality=fast", "-write", "palm.vdb")

    def require(links, names=("turned", "palm")):
        assert list(links) == list(names), list(links)
        for spheres, tree in zip(links.values(), ("turned.vdb", "palm.vdb")):
            require_covered(spheres, trees.finest(tree))

    def spheres_of(links):
        return {name: yaml_spheres(entries) for name, entries in links.items()}

    both = ("-read", "turned.vdb", "palm.vdb", "-write")
    trees.run(*both, "robot.yml", "robot.xrdf", "robot.srdf", "level=0")
    kinematics = yaml.safe_load(open(trees.folder / "robot.yml"))["robot_cfg"]["kinematics"]
    assert kinematics["collision_link_names"] == ["turned", "palm"] and kinematics["urdf_path"] == "robot.urdf"
    assert kinematics["self_collision_buffer"] == {"turned": 0.0, "palm": 0.0}
    require(spheres_of(kinematics["collision_spheres"]))
    xrdf = yaml.safe_load(open(trees.folder / "robot.xrdf"))
    assert xrdf["collision"]["geometry"] == "robot" and set(xrdf["collision"]["buffer_distance"]) == {"turned", "palm"}
    require(spheres_of(xrdf["geometry"]["robot"]["spheres"]))
    root = xml.parse(trees.folder / "robot.srdf").getroot()
    assert root.get("name") == "robot"
    require({link.get("link"): of_rows(s.get("center").split() + [s.get("radius")] for s in link.findall("sphere"))
             for link in root.findall("link_sphere_approximation")})
    trees.run(*both, "lula.yml", "format=lula", "link=große hand,palm")
    lula = yaml.safe_load(open(trees.folder / "lula.yml", encoding="utf-8"))["collision_spheres"]
    assert [len(entry) for entry in lula] == [1, 1]
    require(spheres_of({name: entry[name] for entry in lula for name in entry}), ("große hand", "palm"))


def read_foam(trees):
    levels = json.load(open(trees.write("turned.vdb", "foam.json", "format=foam")))
    assert all(set(level) == {"mean", "best", "worst", "spheres"} for level in levels)
    found = [Sphere(*sphere["origin"], sphere["radius"]) for level in levels
             for sphere in level["spheres"]]
    require_covered(found, trees.spheres("turned.vdb"))


def read_morphit(trees):
    tree = json.load(open(trees.write("turned.vdb", "morphit.json", "format=morphit")))
    found = of_rows([*center, radius] for center, radius in zip(tree["centers"], tree["radii"]))
    assert len(tree["centers"]) == len(tree["radii"]) == tree["num_spheres"]
    require_covered(found, trees.finest("turned.vdb"))


def read_liggghts(trees):
    import numpy

    path = trees.write("turned.vdb", "clump.multisphere", "units=mm")
    found = of_rows(numpy.loadtxt(path))
    require_covered(found, trees.finest("turned.vdb"), scale=1000)


def read_csv(trees):
    import numpy

    for name, last in (("multisphere", "radius"), ("deme", "r")):
        path = trees.write("turned.vdb", name + ".csv", "format=" + name)
        assert open(path).readline() == f"x,y,z,{last}\n"
        require_covered(of_rows(numpy.loadtxt(path, delimiter=",", skiprows=1)),
                        trees.finest("turned.vdb"))


def read_swc(trees):
    import numpy

    rows = numpy.loadtxt(trees.write("turned.vdb", "tree.swc"))
    assert all(row[6] == -1 or row[6] < row[0] for row in rows), "parents come first"
    # Numbers begin with 1 there.
    found = [Sphere(*row[2:6], None, int(row[0]) - 1, int(row[6]) - (row[6] > 0)) for row in rows]
    require_covered(found, trees.spheres("turned.vdb"))


def read_sph(trees):
    """As the loader of the toolkit does: a complete tree in arrays, with negative radii for nothing."""
    lines = open(trees.write("turned.vdb", "tree.sph")).read().splitlines()
    levels, degree = map(int, lines[0].split())
    assert len(lines) - 1 == sum(degree ** k for k in range(levels))
    rows = [tuple(map(float, line.split())) for line in lines[1:]]
    expected = trees.spheres("turned.vdb")
    by_place, found, ids, first = {}, [], {}, 0
    for k in range(levels):
        for place in range(first, first + degree ** k):
            if rows[place][3] < 0:
                continue
            parent = (place - 1) // degree if place else None
            assert parent is None or rows[parent][3] >= 0
            by_place[place] = len(found)
            found.append(Sphere(*rows[place][:4]))
            ids[len(found) - 1] = by_place.get(parent)
        first += degree ** k
    # Children of a sphere stand together: find each sphere of the tree again, with its parent.
    order = sorted(range(len(expected)), key=lambda i: (-expected[i].level, path_to(expected, i)))
    require_covered(found, [expected[i] for i in order])
    for i, place in enumerate(order):
        parent = expected[place].parent
        assert ids[i] == (None if parent < 0 else order.index(parent))


def path_to(spheres, i):
    """Ids from the root to a sphere: ids are places in the table, the coarsest level first."""
    path = [i]
    while spheres[path[0]].parent >= 0:
        path.insert(0, spheres[path[0]].parent)
    return path


def read_xyz(trees):
    import ase.io

    atoms = ase.io.read(trees.write("turned.vdb", "tree.xyz"))
    found = [Sphere(*atom.position, *(atoms.arrays[key][atom.index]
                                      for key in ("radius", "level", "id", "parent")))
             for atom in atoms]
    require_covered(found, trees.spheres("turned.vdb"))


def read_vol(trees):
    """The format's own words: keys and values up to a point, then a zlib stream of bytes, x fastest."""
    import zlib

    import numpy
    import pyopenvdb

    trees.run("-read", "bent.vdb", "-write", "bent.vol")
    header, values = open(trees.folder / "bent.vol", "rb").read().split(b"\n.\n", 1)
    fields = dict(line.split(": ") for line in header.decode().splitlines())
    sides = [int(fields[axis]) for axis in "XYZ"]
    found = numpy.frombuffer(zlib.decompress(values), numpy.uint8).reshape(sides[::-1])
    expected = numpy.zeros(sides, bool)
    pyopenvdb.read(str(trees.folder / "bent.vdb"), "bent").copyToArray(expected)
    assert fields["Version"] == "3" and set(found.flat) == {0, 255}
    assert ((found == 255) == expected.transpose()).all()


def read_ply(trees):
    import meshio

    for options in ((), ("format=ply-ascii",)):
        mesh = meshio.read(trees.write("turned.vdb", "tree.ply", *options))
        data = mesh.point_data
        found = [Sphere(*map(float, point), float(data["radius"][i]), *(int(data[key][i])
                        for key in ("level", "id", "parent")))
                 for i, point in enumerate(mesh.points)]
        require_covered(found, trees.spheres("turned.vdb"))


def read_open3d(trees):
    import open3d

    cloud = open3d.t.io.read_point_cloud(str(trees.write("turned.vdb", "cloud.ply"))).point
    found = [Sphere(*map(float, p), float(r)) for p, r in
             zip(cloud["positions"].numpy(), cloud["radius"].numpy()[:, 0])]
    require_covered(found, trees.spheres("turned.vdb"))


READERS = {name[5:]: function for name, function in list(globals().items())
           if name.startswith("read_")}
