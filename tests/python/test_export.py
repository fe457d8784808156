# SPDX-License-Identifier: Apache-2.0
"""Files of other tools: the bytes of the command, warnings for what is lost, errors for what cannot be held."""
import json
import os
import warnings
import xml.etree.ElementTree as xml

import numpy as np
import pytest
import spheretree
from conftest import run_program


@pytest.fixture(scope="module")
def tree():
    return spheretree.build(np.ones((30, 14, 8), bool), [20, 4, 1], quality="fast", anisotropy=0.01)


def test_the_bytes_are_those_of_the_command(tree, tmp_path, monkeypatch):
    command = os.environ.get("VDB_SPHERETREE")
    if not command:
        pytest.skip("the command is not here")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "python").mkdir() # with the same names: robots are called after their files
    tree.save("tree.vdb")
    words = {"units": "mm", "frame": "centroid", "link": "arm", "level": 0, "density": 2700}
    for name, format in (("t.urdf", ""), ("t.usda", ""), ("t.yml", "lula"), ("t.glb", ""), ("t.csv", "deme")):
        spheretree.export(tree, "python/" + name, format=format, **words)
        options = [f"{key}={value}" for key, value in words.items()]
        run_program(command, "-quiet", "-read", "tree.vdb", "-write", name, *options,
                    *([f"format={format}"] if format else []))
        assert (tmp_path / "python" / name).read_bytes() == (tmp_path / name).read_bytes(), name


def test_what_there_is_no_room_for_is_a_warning(tree, tmp_path):
    with pytest.warns(UserWarning, match="holds one level"):
        spheretree.export(tree, tmp_path / "t.urdf")


def test_an_option_that_means_nothing_to_a_format_is_a_warning(tree, tmp_path):
    words = {"link": "arm", "mass": "spheres", "density": 5, "start": 2, "fps": 25, "up": "z"}
    what = {"link": "hold no links", "mass": "hold no mass", "density": "hold no mass",
            "start": "hold no samples over time", "fps": "hold no samples over time", "up": "say no axis that is up"}
    path = tmp_path / "t.ply"
    for name, value in words.items():
        with pytest.warns(UserWarning) as warned:
            spheretree.export(tree, path, **{name: value})
        assert [str(each.message) for each in warned] == [
            f"{path}: {name}= changes nothing, as .ply files {what[name]}"]
        assert warned[0].filename == __file__, "it names the line of the call"
    with warnings.catch_warnings():
        warnings.filterwarnings("error", message=".*changes nothing")
        spheretree.export(tree, path)
        spheretree.export(tree, tmp_path / "t.urdf", level=0, link="arm", mass="spheres", density=5)
        spheretree.export(tree, tmp_path / "t.usda", start=2, fps=25, up="z")


def test_the_mass_is_that_of_the_object_where_it_is_asked_for(tree, tmp_path):
    volume = spheretree.volume(np.ones((30, 14, 8), bool), anisotropy=0.01)

    def mass_of(name, **words):
        spheretree.export(tree, tmp_path / name, level=0, density=2000, **words)
        inertial = xml.parse(tmp_path / name).getroot().find("link/inertial")
        return (float(inertial.find("mass").get("value")),
                [float(v) for v in inertial.find("origin").get("xyz").split()],
                float(inertial.find("inertia").get("izz")))

    mass, center, izz = mass_of("o.urdf", mass="object", volume=volume)
    assert mass == pytest.approx(2000 * 30 * 14 * 8 * 1e-6)
    assert center == pytest.approx([0.145, 0.065, 0.035])
    assert izz == pytest.approx(mass * (0.3**2 + 0.14**2) / 12)
    spheres = mass_of("s.urdf")
    assert spheres[0] > 1.01 * mass, "spheres that cover it are heavier"
    assert mass_of("m.urdf", mass="spheres") == spheres


@pytest.mark.parametrize("words, why", [
    ({"mass": "object"}, "each needs the other"),
    ({"volume": np.ones((30, 14, 8), bool)}, "each needs the other"),
    ({"mass": "voxels"}, 'mass="voxels" is none of'),
    ({"mass": "object", "volume": np.ones((30, 14, 9), bool)}, "other voxels"),
])
def test_a_mass_of_nothing_or_of_another_object_is_refused(tree, tmp_path, words, why):
    with pytest.raises(spheretree.InputError, match=why):
        spheretree.export(tree, tmp_path / "t.urdf", level=0, **words)
    assert not (tmp_path / "t.urdf").exists()


def test_several_trees_are_samples_over_time(tree, tmp_path):
    spheretree.export([tree, tree], tmp_path / "t.usda", start=101, fps=25)
    stage = (tmp_path / "t.usda").read_text()
    assert "endTimeCode = 102" in stage and "framesPerSecond = 25\n" in stage
    with pytest.raises(spheretree.InputError, match="holds one sphere-tree"):
        spheretree.export([tree, tree], tmp_path / "t.ply")


def test_several_trees_are_links_of_one_robot(tree, tmp_path):
    palm = spheretree.build(np.ones((9, 9, 9), bool), spheres=3, quality="fast", name="palm")
    path = tmp_path / "robot.yml"
    spheretree.export([tree, palm], path, level=0)
    assert f'collision_link_names: ["{tree.name}", "palm"]' in path.read_text()
    assert '"robot.urdf"' in path.read_text()
    spheretree.export([palm, palm], path, link=["left", "right"])
    assert 'collision_link_names: ["left", "right"]' in path.read_text()
    long = ["é" * 30 + "x", "a" + "é" * 30]  # messages have the start of them
    with pytest.warns(UserWarning, match="link 'éé"):
        spheretree.export([tree, palm], path, level=0, link=long, scale=1e-6)
    assert all(name in path.read_text() for name in long)
    spheretree.export((each for each in (palm,)), path)
    assert 'collision_link_names: ["palm"]' in path.read_text()
    for link, why in (("left", "link= has 1 name for 2 sphere-trees"), (["left"], "has 1 name"), (None, "the link 'palm'"),
                      (["left", "left"], "the link 'left'"), ([], "link names no link")):
        with pytest.raises(spheretree.InputError, match=why):
            spheretree.export([palm, palm], path, link=link)
    for link in 5, [5], ["left", None]:
        with pytest.raises(TypeError):
            spheretree.export([palm, palm], path, link=link)
    for trees in [palm, None], {"palm": palm}, 5:
        with pytest.raises(TypeError, match="trees must be" if trees != 5 else ""):
            spheretree.export(trees, path)
    assert 'collision_link_names: ["palm"]' in path.read_text()


def test_a_warning_points_to_the_line_that_called(tree, tmp_path):
    for write in (lambda: spheretree.export(tree, tmp_path / "t.urdf"), lambda: tree.export(tmp_path / "t.urdf")):
        with pytest.warns(UserWarning, match="holds one level") as caught:
            write()
        assert {warning.filename for warning in caught} == {__file__}


def test_what_belongs_to_another_function_is_said(tree, tmp_path):
    with pytest.raises(spheretree.InputError, match=r"export\(\) writes .urdf"):
        tree.save(tmp_path / "t.urdf")
    tree.save(tmp_path / "t.csv")
    with pytest.raises(spheretree.InputError, match="loaded from a .vdb"):
        spheretree.load(tmp_path / "t.csv")


def test_a_level_as_numbers(tree, tmp_path):
    spheretree.export(tree, tmp_path / "t.json", format="morphit", spheres=5)
    read = json.load(open(tmp_path / "t.json"))
    level = tree.levels[1]
    assert np.allclose(read["centers"], level.centers, atol=1e-6)
    assert (np.array(read["radii"]) >= level.radii).all()


@pytest.mark.parametrize("words, why", [
    ({"path": "t.xyzw"}, "no file of another tool ends so"),
    ({"path": "t.csv"}, r"Tree.save\(\) writes .csv"),
    ({"path": "t.html"}, r"Tree.write_html\(\) writes pages"),
    ({"path": "t.urdf", "format": "usd"}, 'format="usd"'),
    ({"path": "t.usda", "up": "x"}, 'up="x" is none of'),
    ({"path": "t.usda", "units": "mile"}, 'units="mile"'),
    ({"path": "t.usda", "frame": "body"}, 'frame="body"'),
    ({"path": "t.usda", "level": 9}, "level 9"),
    ({"path": "t.usda", "level": 2**70}, "level=.* is beyond 32 bits"),
    ({"path": "t.usda", "spheres": 2**70}, "spheres=.* is beyond 64 bits"),
    ({"path": "t.usda", "name": "\ud800"}, "name='.* half of a character"),
    ({"path": "t.usda", "scale": 0}, "scale=0"),
])
def test_what_is_wrong_is_said_and_leaves_the_old_file(tree, tmp_path, words, why):
    words = dict(words)
    path = tmp_path / words.pop("path")
    path.write_text("precious")
    with pytest.raises(spheretree.InputError, match=why):
        spheretree.export(tree, path, **words)
    assert path.read_text() == "precious"
    assert list(tmp_path.iterdir()) == [path]


def test_a_tree_exports_itself(tmp_path):
    tree = spheretree.build(np.ones((9, 9, 9), bool), spheres=[8, 1], quality="fast")
    spheretree.export(tree, tmp_path / "a.ply", level=1)
    tree.export(tmp_path / "b.ply", level=1)
    assert (tmp_path / "a.ply").read_bytes() == (tmp_path / "b.ply").read_bytes()
