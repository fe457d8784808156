# SPDX-License-Identifier: Apache-2.0
"""Readers that are programs or libraries of the tools themselves: MuJoCo, urdfdom, VTK, LAMMPS, YADE."""

import os
import shutil
import subprocess
from itertools import combinations
from pathlib import Path

from spheres import Sphere, require_covered, require_near


class Missing(Exception):
    """What a test needs and is not here."""


def need(program):
    path = shutil.which(program)
    if path is None:
        raise Missing(program)
    return path


def output_of(*words, cwd):
    result = subprocess.run([*map(str, words)], cwd=cwd, capture_output=True, text=True, timeout=300)
    if result.returncode != 0:
        raise AssertionError(f"{words[0]}: exit code {result.returncode}\n{result.stdout}{result.stderr}")
    return result.stdout + result.stderr


def mass_of(trees):
    """Of the finest level, as -stats has it: volume, center, moments of inertia."""
    import json

    trees.run("-read", "turned.vdb", "-stats", "mass.json", "mass=1")
    level = json.load(open(trees.folder / "mass.json"))["levels"][0]
    return level["mass"]


def read_mujoco(trees):
    program = os.environ.get("SPHERETREE_READ_MUJOCO")
    if not program:
        raise Missing("MuJoCo (Debian: libmujoco-dev)")
    for name in ("robot.mjcf", "robot.urdf"):
        path = trees.write("turned.vdb", name, "link=große 手", "density=1000")
        lines = [line.split() for line in output_of(program, path, cwd=trees.folder).splitlines()]
        found = [Sphere(*map(float, line[1:])) for line in lines if line[0] == "sphere"]
        require_covered(found, trees.finest("turned.vdb"))
        mass = mass_of(trees)
        if name.endswith(".urdf"):
            lines = [line.split() for line in output_of(program, on_a_base(path), cwd=trees.folder).splitlines()]
        total, *numbers = (float(word) for word in next(l for l in lines if l[0] == "mass")[1:])
        require_near(total, 1000 * mass["volume"], 1e-9, "mass")
        for found, expected in zip(numbers[3:], mass["center"]):
            require_near(found, expected, 1e-9, "center of mass")
        for moment, expected in zip(sorted(numbers[:3]), sorted(mass["principal_moments"])):
            require_near(moment, 1000 * expected, 1e-6, "moment of inertia")
        # Turned back, the moments are the matrix of the body.
        for found, (row, column) in zip(numbers[6:], ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))):
            off = abs(found - 1000 * mass["inertia"][row][column])
            assert off <= 1e-6 * 1000 * max(mass["principal_moments"]), (name, row, column, off)
    require_principal(program, trees)


def require_principal(program, trees):
    """In the frame of the body the center of mass is the origin, and the axes are those of its moments, the least first."""
    path = trees.write("turned.vdb", "body.mjcf", "frame=principal", "density=1000")
    lines = [line.split() for line in output_of(program, path, cwd=trees.folder).splitlines()]
    mass = mass_of(trees)
    spread = sum(mass["principal_moments"]) / mass["volume"]
    _, *numbers = (float(word) for word in next(l for l in lines if l[0] == "mass")[1:])
    assert all(abs(value) < 1e-9 * spread ** 0.5 for value in numbers[3:6]), numbers
    for found, expected in zip(numbers[6:9], sorted(mass["principal_moments"])):
        require_near(found, 1000 * expected, 1e-6, "principal moment of inertia")
    assert all(abs(value) < 1e-6 * 1000 * max(mass["principal_moments"]) for value in numbers[9:]), numbers
    found = [Sphere(*map(float, line[1:])) for line in lines if line[0] == "sphere"]
    require_same_shape(found, trees.finest("turned.vdb"))


def volume_of(spheres, corners):
    """Six times the signed volume of a tetrahedron of centers."""
    a, *others = (spheres[i] for i in corners)
    (px, py, pz), (qx, qy, qz), (rx, ry, rz) = ([p[i] - a[i] for i in range(3)] for p in others)
    return px * (qy * rz - qz * ry) - py * (qx * rz - qz * rx) + pz * (qx * ry - qy * rx)


def require_same_shape(found, expected):
    """Turned and moved, but not mirrored: distances are the same, and what is left stays left."""
    from math import dist

    assert len(found) == len(expected)
    for a, b in zip(found, expected):
        assert abs(dist(a[:3], found[0][:3]) - dist(b[:3], expected[0][:3])) < 1e-5 * b.radius, (a, b)
    corners = combinations(range(min(12, len(expected))), 4)
    chosen = max(corners, key=lambda four: abs(volume_of(expected, four)))
    require_near(volume_of(found, chosen), volume_of(expected, chosen), 1e-4, "signed volume of four centers")


def on_a_base(path):
    """MuJoCo makes the first link of an .urdf part of the world, without a mass: here that is another link."""
    robot = path.read_text()
    head, link = robot.split("  <link ", 1)
    name = link.split('"')[1]
    joint = ('  <joint name="free" type="floating"><parent link="base"/>'
             f'<child link="{name}"/></joint>\n</robot>')
    moving = path.with_name("moving.urdf")
    moving.write_text(head + '  <link name="base"/>\n  <link ' + link.replace("</robot>", joint))
    return moving


def read_urdfdom(trees):
    need("check_urdf")
    text = output_of("check_urdf", trees.write("turned.vdb", "robot.urdf", "name=ärm", "link=große 手"), cwd=trees.folder)
    assert "robot name is: ärm" in text and "große 手" in text and "Error" not in text, text


def points_of(polydata):
    data = polydata.GetPointData()
    arrays = [data.GetArray(name) for name in ("radius", "level", "id", "parent")]
    return [Sphere(*polydata.GetPoint(i), arrays[0].GetValue(i), *(int(a.GetValue(i)) for a in arrays[1:]))
            for i in range(polydata.GetNumberOfPoints())]


def read_vtk(trees):
    from vtkmodules.vtkIOLegacy import vtkPolyDataReader
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

    for reader, name in ((vtkXMLPolyDataReader(), "tree.vtp"), (vtkPolyDataReader(), "tree.vtk")):
        reader.SetFileName(str(trees.write("turned.vdb", name)))
        reader.Update()
        polydata = reader.GetOutput()
        assert polydata.GetNumberOfVerts() == polydata.GetNumberOfPoints()
        require_covered(points_of(polydata), trees.spheres("turned.vdb"))
        require_none(reader, trees, "none" + name[-4:])


def require_none(reader, trees, name):
    """A frame without spheres has its arrays, without values."""
    import pyopenvdb

    pyopenvdb.write(str(trees.folder / "none.vdb"), grids=[pyopenvdb.BoolGrid()])
    trees.run("-read", "none.vdb", "-spheretree", "empty=write", "-write", name)
    reader.SetFileName(str(trees.folder / name))
    reader.Update()
    assert reader.GetErrorCode() == 0 and reader.GetOutput().GetNumberOfPoints() == 0
    assert reader.GetOutput().GetPointData().GetNumberOfArrays() == 4


def require_corners_on(spheres, polydata, triangles):
    """The triangles of the first sphere come first, and so on; floats move a corner by less than its place."""
    from math import dist

    for cell in range(polydata.GetNumberOfPolys()):
        sphere = spheres[cell // triangles]
        points = polydata.GetCell(cell).GetPoints()
        for i in range(3):
            corner = points.GetPoint(i)
            off = abs(dist(corner, sphere[:3]) - sphere.radius)
            assert off <= 1e-6 * (sphere.radius + max(map(abs, sphere[:3]))), (cell, corner, sphere)


def read_mesh(trees):
    """Corners lie on the spheres; each sphere is closed, and as large as a polyhedron in it can be."""
    from vtkmodules.vtkFiltersCore import vtkMassProperties, vtkPolyDataConnectivityFilter
    from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader

    spheres = trees.finest("turned.vdb")
    for reader, name in ((vtkOBJReader(), "mesh.obj"), (vtkSTLReader(), "mesh.stl")):
        reader.SetFileName(str(trees.write("turned.vdb", name)))
        reader.Update()
        polydata = reader.GetOutput()
        assert polydata.GetNumberOfPolys() == 320 * len(spheres)
        require_corners_on(spheres, polydata, 320)
        mass = vtkMassProperties()
        mass.SetInputData(polydata)
        mass.Update()
        volume = sum(4 / 3 * 3.141592653589793 * s.radius ** 3 for s in spheres)
        assert 0.95 * volume < mass.GetVolume() < volume, (mass.GetVolume(), volume)
    unreal = trees.write("turned.vdb", "u.obj", "format=unreal", "name=arm")
    reader = vtkOBJReader()
    reader.SetFileName(str(unreal))
    reader.Update()
    require_corners_on(spheres, reader.GetOutput(), 320)
    names = [line.split()[1] for line in open(unreal) if line.startswith("o ")]
    assert names == [f"USP_arm_{i + 1:02}" for i in range(len(spheres))], names


def read_lammps(trees):
    need("lmp")
    trees.write("turned.vdb", "clump.mol", "frame=centroid", "density=2500")
    (trees.folder / "in.clump").write_text(
        "atom_style hybrid sphere molecular\nregion box block -9 9 -9 9 -9 9\ncreate_box 1 box\ncomm_modify cutoff 9\n"
        "molecule clump clump.mol\ncreate_atoms 0 single 0 0 0 mol clump 1234 rotate 0 0 0 1\n"
        "dump all all custom 1 out.dump id x y z radius\ndump_modify all sort id format float %.17g\n"
        "thermo_style custom step\nfix move all rigid/small molecule mol clump\n"
        "compute body all rigid/local move mass\ndump bodies all local 1 out.body c_body\n"
        "dump_modify bodies format float %.17g\nrun 0\n")
    text = output_of("lmp", "-in", "in.clump", cwd=trees.folder)
    assert "ERROR" not in text, text
    (total,) = map(float, (trees.folder / "out.body").read_text().split("c_body")[1].split())
    require_near(total, 2500 * mass_of(trees)["volume"], 1e-9, "mass")
    rows = (trees.folder / "out.dump").read_text().split("radius\n")[1].splitlines()
    found = [Sphere(*map(float, row.split()[1:])) for row in rows]
    expected = trees.finest("turned.vdb")
    assert len(found) == len(expected)
    shift = [a - b for a, b in zip(found[0][:3], expected[0][:3])]  # it puts the molecule where it likes
    for a, b in zip(found, expected):
        for axis in range(3):
            assert abs(a[axis] - (b[axis] + shift[axis])) < 1e-6, (a, b)
        assert b.radius <= a.radius < b.radius * 1.001


def read_yade(trees):
    need("yade")
    trees.write("turned.vdb", "clump.txt", "format=yade")
    script = ("from yade import ymport\nids = ymport.textClumps('clump.txt')\n"
              "for b in O.bodies:\n"
              "    if b.isClumpMember: print('sphere', *map(repr, [*b.state.pos, b.shape.radius]))\n")
    (trees.folder / "clump.py").write_text(script)
    text = output_of("yade", "-n", "-x", "clump.py", cwd=trees.folder)
    found = [Sphere(*map(float, line.split()[1:])) for line in text.splitlines()
             if line.startswith("sphere")]
    expected = trees.finest("turned.vdb")
    assert len(found) == len(expected), text
    for a, b in zip(found, expected):
        assert all(abs(a[i] - b[i]) <= 1e-6 for i in range(4)), (a, b)


def read_nanovdb(trees):
    """Points by NanoVDB's own headers, grids by its program that makes them OpenVDB's again."""
    program = os.environ.get("SPHERETREE_READ_NANOVDB")
    if not program:
        raise Missing("NanoVDB (Debian: libnanovdb-dev)")
    need("nanovdb_validate")
    path = trees.write("turned.vdb", "tree.nvdb")
    text = output_of("nanovdb_validate", path, cwd=trees.folder)
    assert "PASSED" in text or not text.strip(), text
    rows = [line.split() for line in output_of(program, path, cwd=trees.folder).splitlines()]
    found = [Sphere(*map(float, row[:4]), *map(int, row[4:])) for row in rows]
    require_covered(sorted(found, key=lambda sphere: sphere.id), trees.spheres("turned.vdb"))

    import pyopenvdb

    for name, action in (("voxels", []), ("surface", ["-spheres2ls", "level=0"])):
        source = ["-read", "turned.vdb"] if action else ["-read", "bent.vdb"]
        trees.run(*source, *action, "-write", f"{name}.vdb", f"{name}.nvdb", "vdb=0")
        output_of("nanovdb_convert", "-f", f"{name}.nvdb", f"{name}_back.vdb", cwd=trees.folder)
        a, b = (pyopenvdb.readAll(str(trees.folder / f))[0][0] for f in (f"{name}.vdb", f"{name}_back.vdb"))
        assert a.name == b.name and a.activeVoxelCount() == b.activeVoxelCount() > 100
        # The program turns transforms the wrong way; NanoVDB itself does not.
        place = output_of(program, f"{name}.nvdb", "transform", cwd=trees.folder).split()
        expected = a.transform.indexToWorld((5, 6, 7))
        assert all(abs(float(p) - q) < 1e-12 for p, q in zip(place, expected)), (place, expected)
        values = a.getConstAccessor(), b.getConstAccessor()
        for item in a.iterOnValues():
            if item.count == 1:
                assert values[0].getValue(item.min) == values[1].getValue(item.min)


READERS = {name[5:]: function for name, function in list(globals().items())
           if name.startswith("read_")}
