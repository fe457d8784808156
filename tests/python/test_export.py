# SPDX-License-Identifier: Apache-2.0
"""Files of other tools: the bytes of the command, warnings for what is lost, errors for what cannot be held."""
import json
import os
import subprocess

import numpy as np
import pytest
import spheretree


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
        subprocess.run([command, "-quiet", "-read", "tree.vdb", "-write", name, *options,
                        *([f"format={format}"] if format else [])], check=True)
        assert (tmp_path / "python" / name).read_bytes() == (tmp_path / name).read_bytes(), name


def test_what_there_is_no_room_for_is_a_warning(tree, tmp_path):
    with pytest.warns(UserWarning, match="holds one level"):
        spheretree.export(tree, tmp_path / "t.urdf")


def test_several_trees_are_samples_over_time(tree, tmp_path):
    spheretree.export([tree, tree], tmp_path / "t.usda", start=101, fps=25)
    stage = (tmp_path / "t.usda").read_text()
    assert "endTimeCode = 102" in stage and "framesPerSecond = 25\n" in stage
    with pytest.raises(spheretree.InputError, match="holds one sphere-tree"):
        spheretree.export([tree, tree], tmp_path / "t.ply")


def test_a_level_as_numbers(tree, tmp_path):
    spheretree.export(tree, tmp_path / "t.json", format="morphit", spheres=5)
    read = json.load(open(tmp_path / "t.json"))
    level = tree.levels[1]
    assert np.allclose(read["centers"], level.centers, atol=1e-6)
    assert (np.array(read["radii"]) >= level.radii).all()


@pytest.mark.parametrize("words, why", [
    ({"path": "t.xyzw"}, "no file of another tool ends so"),
    ({"path": "t.urdf", "format": "usd"}, 'format="usd"'),
    ({"path": "t.usda", "up": "x"}, 'up="x" is none of'),
    ({"path": "t.usda", "units": "mile"}, 'units="mile"'),
    ({"path": "t.usda", "frame": "body"}, 'frame="body"'),
    ({"path": "t.usda", "level": 9}, "level 9"),
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
