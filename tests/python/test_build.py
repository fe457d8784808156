# SPDX-License-Identifier: Apache-2.0
"""Trees: built, saved, loaded, checked; the same as the command's."""
import inspect
import pickle

import numpy as np
import pytest
import spheretree
from conftest import ball, write_vol
from spheretree import _build, _spheretree

# Keywords, and the same options of the command.
KINDS = [
    ({"spheres": [64, 8, 1]}, ["spheres=64,8,1"]),
    ({}, []),
    ({"quality": "fast", "cover": "balls", "leaves": "medial"}, ["quality=fast", "cover=balls", "leaves=medial"]),
    ({"error": 40, "padding": "voxels"}, ["error=40", "padding=voxels"]),
    ({"distance": 2.5}, ["distance=2.5"]),
    ({"distance": "1.5vox", "bounds": "unpadded"}, ["distance=1.5vox", "bounds=unpadded"]),
    ({"cuts": True, "padding": 0.25, "name": "my tree"}, ["cuts=1", "padding=0.25", "name=my tree"]),
    ({"side": "inner", "spheres": np.array([16, 4]), "strict": True}, ["side=inner", "spheres=16,4", "strict=1"]),
    ({"side": "fit", "spheres": 6}, ["side=fit", "spheres=6"]),
    ({"tree": "extended", "dag": True, "edges": "intersecting"}, ["tree=extended", "dag=1", "edges=intersecting"]),
    ({"tree": "reversible", "factor": 3, "dist": "chamfer:3,4,5", "pyramid_origin": (0, 0, 0), "errors": False},
     ["tree=reversible", "factor=3", "dist=chamfer:3,4,5", "origin=0,0,0", "errors=0"]),
    ({"branching": 4, "topology": False, "memory": "1GiB"}, ["branching=4", "topology=0", "memory=1GiB"]),
]


@pytest.mark.parametrize("keywords, options", KINDS)
def test_files_have_the_bytes_of_the_commands(bone, tmp_path, command, keywords, options):
    write_vol(tmp_path / "volume.vol", bone)
    names = [f"tree.{kind}" for kind in ("vdb", "csv", "json")]
    command("-read", "volume.vol", "-spheretree", *options, "-write", *names)
    ours = tmp_path / "ours"
    ours.mkdir()
    tree = spheretree.build(bone.astype(np.uint8), **keywords)
    for name in names:
        tree.save(ours / name)
        assert (ours / name).read_bytes() == (tmp_path / name).read_bytes(), name
    assert sorted(p.name for p in ours.iterdir()) == sorted(p.name for p in tmp_path.glob("tree*"))
    from_file = spheretree.build(tmp_path / "volume.vol", **keywords)
    from_file.save(ours / "again.vdb")
    assert (ours / "again.vdb").read_bytes() == (tmp_path / "tree.vdb").read_bytes()


def test_a_tree_has_the_commands_errors(bone, tmp_path, command):
    import json
    write_vol(tmp_path / "volume.vol", bone)
    command("-read", "volume.vol", "-spheretree", "spheres=16,4", "-stats", "json=stats.json")
    stats = json.loads((tmp_path / "stats.json").read_text())
    for level, told in zip(spheretree.build(bone, [16, 4]).levels, stats["levels"]):
        assert level.errors.items() <= told.items() and level.errors["missing"] == 0


def test_arrays_are_the_columns_of_the_csv(bone, tmp_path):
    tree = spheretree.build(bone, [16, 4, 1], anisotropy=0.1, origin=(3, 2, 1))
    tree.save(tmp_path / "tree.csv")
    table = np.genfromtxt(tmp_path / "tree.csv", delimiter=",", names=True)
    assert np.array_equal(table["id"], np.arange(len(tree)))
    assert np.array_equal(np.stack([table[c] for c in "xyz"], axis=1), tree.centers)
    assert np.array_equal(table["radius"].astype(np.float32), tree.radii)
    assert np.array_equal(table["parent"], tree.parents)
    for level in tree.levels:
        rows = table[table["level"] == level.level]
        assert np.array_equal(rows["id"], level.ids) and np.array_equal(rows["x"], level.centers[:, 0])
        assert np.array_equal(rows["parent"], level.parents) and len(rows) == len(level)


def test_arrays_are_views_that_nobody_writes_to_and_that_outlive_the_tree(bone):
    tree = spheretree.build(bone, [16, 1])
    level, radii = tree.levels[0], tree.radii.copy()
    for array in (tree.centers, tree.radii, tree.parents, tree.ijk, tree.radii_sq, level.centers, level.ids):
        assert not array.flags.writeable and not array.flags.owndata
        with pytest.raises(ValueError):
            array[0] = 0
        with pytest.raises(ValueError):
            array.setflags(write=True)
    assert np.shares_memory(tree.radii, tree.radii) and np.shares_memory(level.radii, tree.radii)
    own = tree.radii
    del tree
    assert np.array_equal(own, radii) and np.array_equal(level.radii, radii[level.ids])


def test_every_level_covers_every_voxel_with_its_cube(bone):
    tree = spheretree.build(bone, [32, 8, 1])
    corners = np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
    voxels = np.argwhere(bone)
    for level in tree.levels:
        reach = np.linalg.norm(voxels[:, None, :] - level.centers, axis=2)
        assert (reach.min(axis=1) < level.radii.max()).all()
        inside = np.zeros(len(voxels), bool)
        for center, radius in zip(level.centers, level.radii):
            far = np.linalg.norm(voxels[:, None, :] + corners - center, axis=2).max(axis=1)
            inside |= far <= radius
        assert inside.all()


@pytest.mark.parametrize("threads", [1, 2, 3])
def test_the_tree_is_the_same_for_any_number_of_threads(bone, threads):
    assert pickle.dumps(spheretree.build(bone, [64, 8], threads=threads)) == pickle.dumps(spheretree.build(bone, [64, 8]))


def test_a_tree_comes_back_from_its_file_and_from_pickle(bone, tmp_path):
    tree = spheretree.build(bone, [32, 4], cuts=True, name="first")
    tree.save(tmp_path / "tree.vdb")
    for other in (spheretree.load(tmp_path / "tree.vdb"), pickle.loads(pickle.dumps(tree)),
                  spheretree.load(tmp_path / "tree.vdb", "first")):
        for name in ("centers", "radii", "parents", "ijk", "radii_sq", "matrix"):
            assert np.array_equal(getattr(tree, name), getattr(other, name)), name
        assert other.settings == tree.settings and other.errors == tree.errors and other.object == tree.object
        assert len(other.cut(7)) == 7 and other.name == "first"
    with pytest.raises(spheretree.InputError, match="named 'second', but 'first'"):
        spheretree.load(tmp_path / "tree.vdb", "second")


def test_one_of_several_trees_is_chosen_by_its_name(bone, tmp_path, command):
    spheretree.build(bone, [8], name="a").save(tmp_path / "a.vdb")
    spheretree.build(bone, [4], name="b").save(tmp_path / "b.vdb")
    command("-read", "a.vdb", "b.vdb", "-write", "both.vdb")
    assert len(spheretree.load(tmp_path / "both.vdb", "b")) == 4
    with pytest.raises(spheretree.InputError, match="several"):
        spheretree.load(tmp_path / "both.vdb")


def test_a_damaged_tree_is_refused(bone, tmp_path):
    spheretree.build(bone, [32, 4]).save(tmp_path / "tree.vdb")
    stored = bytearray((tmp_path / "tree.vdb").read_bytes())
    stored[len(stored) // 2] ^= 1
    (tmp_path / "tree.vdb").write_bytes(stored)
    with pytest.raises(OSError, match="tree.vdb"):
        spheretree.load(tmp_path / "tree.vdb")


def test_a_tree_that_cannot_be_written_leaves_what_was_there(bone, tmp_path):
    tree = spheretree.build(bone, [4])
    with pytest.raises(OSError, match="none"):
        tree.save(tmp_path / "none" / "tree.vdb")
    for name in ("tree", "tree.xyz123", "tree.obj"):
        with pytest.raises(spheretree.InputError, match="\\.vdb, \\.csv, \\.json"):
            tree.save(tmp_path / name)
    assert not list(tmp_path.iterdir())


def test_a_path_with_a_null_byte_is_no_other_file(bone, tmp_path):
    tree = spheretree.build(bone, [4])
    kept = tmp_path / "kept"
    kept.write_text("precious")
    for write, name in ((tree.save, "kept\0.vdb"), (tree.save, "kept\0.csv"), (tree.export, "kept\0.urdf")):
        with pytest.raises(ValueError, match="null byte"):
            write(f"{tmp_path}/{name}")
    assert kept.read_text() == "precious"
    assert list(tmp_path.iterdir()) == [kept]


def test_check_finds_nothing_in_a_sound_tree_and_something_in_another_object(bone):
    tree = spheretree.build(bone, [16, 2])
    assert tree.check(bone) == [] and spheretree.check(tree, bone) == []
    other = bone.copy()
    other[tuple(np.argwhere(bone)[0])] = False
    faults = tree.check(other)
    assert faults and faults[0].kind == "counts" and faults[0].sentence
    assert "place" in [fault.kind for fault in tree.check(bone, anisotropy=2)]


TETRAHEDRON = "v 0 0 0\nv 10 0 0\nv 0 15 0\nv 0 0 30\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"


def test_a_mesh_lies_in_the_spheres_of_every_level_or_is_told_where_not(tmp_path):
    path = tmp_path / "t.obj"
    path.write_text(TETRAHEDRON)
    read = {"resolution": 40, "coverage": "cubes"}
    tree = spheretree.build(path, [16, 2], quality="fast", units="mm", **read)
    assert tree.check_mesh(path, units="mm") == []
    assert tree.check_mesh(path, path, units="mm", **read) == [] == spheretree.check_mesh(tree, path, units="mm")
    assert tree.check_mesh(path, spheretree.volume(path, units="mm", **read), units="mm") == []
    # Cubes of another object are no proof.
    assert tree.check_mesh(path, path, units="mm", resolution=60, coverage="cubes")
    (tmp_path / "more.obj").write_text(TETRAHEDRON + "v 0 0 -9\nf 1 2 5\n")
    faults = tree.check_mesh(tmp_path / "more.obj", units="mm")
    assert [fault.kind for fault in faults] == ["surface"] * 2 and "level 0" in faults[0].sentence
    assert tree.check_mesh(path)  # in metres


def test_proofs_of_meshes_that_cannot_be_made(tmp_path, bone):
    path = tmp_path / "t.obj"
    path.write_text(TETRAHEDRON)
    tree = spheretree.build(bone, [8], quality="fast")
    with pytest.raises(spheretree.InputError, match="units="):
        tree.check_mesh(path, units="inch")
    with pytest.raises(TypeError, match="coverage is of a volume"):
        tree.check_mesh(path, coverage="cubes")
    with pytest.raises(TypeError, match="tree must be"):
        spheretree.check_mesh(bone, path)
    with pytest.raises(FileNotFoundError):
        tree.check_mesh(tmp_path / "none.obj")
    (tmp_path / "bad.obj").write_text("v 0 0\n")
    with pytest.raises(OSError, match="bad.obj"):
        tree.check_mesh(tmp_path / "bad.obj")
    with pytest.raises(spheretree.InputError, match="side=outer"):
        spheretree.build(bone, [8], side="inner").check_mesh(path)


def test_a_level_and_a_cut_are_trees(bone):
    tree = spheretree.build(bone, [32, 8, 1], cuts=True)
    level = tree.level(1)
    assert np.array_equal(level.radii, tree.levels[1].radii) and (level.parents == -1).all()
    assert len(tree.cut(5)) == 5
    for ask in tree.level, tree.cut, lambda number: tree.query(level=number):
        with pytest.raises(spheretree.InputError, match="=1180591620717411303424 is beyond"):
            ask(2**70)
    with pytest.raises(spheretree.InputError):
        tree.level(9)
    with pytest.raises(spheretree.InputError):
        level.cut(3)


def test_given_spheres_are_the_leaves():
    block = np.ones((4, 4, 4), bool)
    given = ([[1.5, 1.5, 1.5], [50, 50, 50]], [4.0, 1.0])
    tree = spheretree.build(block, [1], leaves="given", given=given)
    assert np.array_equal(tree.centers[0], (1.5, 1.5, 1.5))
    with pytest.raises(spheretree.InputError, match="leave.*bare|cover"):
        spheretree.build(block, [1], leaves="given", given=([[0, 0, 0]], [1]))
    for wrong in (([[1, 2]], [1]), ([[1, 2, 3]], [1, 2]), ([[1, 2, 3]], [-1]), ([[1, 2, np.nan]], [1])):
        with pytest.raises(spheretree.InputError, match="given"):
            spheretree.build(block, [1], leaves="given", given=wrong)
    with pytest.raises(spheretree.InputError, match="go together"):
        spheretree.build(block, [1], leaves="given")


def test_strict_spheres_are_of_voxels_that_are_whole():
    x, y, z = np.mgrid[-8:9, -8:9, -8:9]
    values = (50 - x**2 - y**2 - z**2).astype(np.float32)
    tree = spheretree.build(values, [8], side="inner", strict=True)
    assert tree.object["voxels"] == spheretree.volume(values, coverage="whole").voxels
    by_cubes = spheretree.volume(values, coverage="cubes")
    with pytest.raises(spheretree.InputError, match="wholly"):
        spheretree.build(by_cubes, [8], side="inner", strict=True)
    assert len(spheretree.build(values > 0, [8], side="inner", strict=True)) == 8


@pytest.mark.parametrize("keywords, words", [
    ({"quality": "slow"}, "quality=slow is unknown: it takes normal, fast, best"),
    ({"tree": "oak"}, "tree=oak"),
    ({"spheres": 0}, "spheres"),
    ({"spheres": []}, "spheres names no number"),
    ({"spheres": [8, 2**70]}, "spheres='8,1180591620717411303424' is out of range: a level has 1 to"),
    ({"name": "\ud800"}, "name='.* half of a character"),
    ({"spheres": [8, 4], "error": 5}, "spheres"),
    ({"spheres": 8, "branching": 4}, "branching"),
    ({"tree": "extended", "quality": "fast"}, "quality=fast is for tree=tight, not for tree=extended"),
    ({"tree": "extended", "spheres": 8}, "spheres=8 is for tree=tight"),
    ({"dag": True}, "dag=1 is for tree=extended and tree=reversible"),
    ({"side": "fit", "cuts": True}, "cuts=1"),
    ({"side": "inner", "padding": 1}, "padding=1"),
    ({"strict": True}, "strict=1 is for side=inner"),
    ({"bounds": "unpadded"}, "bounds"),
    ({"factor": 1}, "factor=1"),
    ({"error": -1}, "error=-1"),
    ({"error": float("nan")}, "error=nan"),
    ({"distance": "5mm"}, "distance='5mm': nobody knows what unit"),
    ({"distance": "far"}, "distance"),
    ({"dim": 2}, "flat|one voxel"),
    ({"dim": 4}, "dim=4"),
    ({"memory": "lots"}, "memory"),
    ({"name": ""}, "name is empty"),
    ({"padding": "squares"}, "padding"),
    ({"pyramid_origin": (1, 2), "tree": "extended"}, "origin"),
])
def test_a_wrong_setting_is_named(bone, keywords, words):
    with pytest.raises(spheretree.InputError, match=words) as error:
        spheretree.build(bone, **keywords)
    assert "-build" not in str(error.value) and "-read" not in str(error.value)


@pytest.mark.parametrize("keywords", [{"spheres": 1.5}, {"spheres": "8"}, {"spheres": [True]}, {"quality": None},
                                      {"sphere": 8}, {"progress": 5}])
def test_a_setting_of_another_type_is_a_type_error(bone, keywords):
    with pytest.raises(TypeError):
        spheretree.build(bone, **keywords)


def test_keywords_are_the_options_of_the_command_with_their_defaults():
    parameters = inspect.signature(spheretree.build).parameters
    own = {_build._OTHER_NAMES.get(name, name): value for name, value in _build._DEFAULTS.items()}
    own["spheres"] = parameters["spheres"].default
    table = {row["name"]: row for row in _spheretree.settings_table()}
    assert own.keys() == table.keys()
    for name, row in table.items():
        default = "" if own[name] is None else _build._setting(name, own[name])
        assert default == ("" if name == "dim" else row["default"]), name


def test_choices_in_the_signature_are_those_of_the_table():
    hints = {name: parameter.annotation for name, parameter in inspect.signature(spheretree.build).parameters.items()}
    for row in _spheretree.settings_table():
        if row["choices"]:
            assert hints[row["name"]] == f"Literal[{', '.join(map(repr, row['choices']))}]"


def test_the_docstring_tells_of_every_keyword():
    for name in inspect.signature(spheretree.build).parameters:
        assert name in spheretree.build.__doc__, name
    for name in inspect.signature(spheretree.volume).parameters:
        assert name in spheretree.volume.__doc__, name


def test_spheres_keep_their_tracks_from_frame_to_frame(bone, tmp_path, command):
    first = spheretree.build(bone, [16, 4, 1], quality="fast")
    assert first.tracks.size == 0
    same = spheretree.build(bone, [16, 4, 1], quality="fast", like=first)
    np.testing.assert_array_equal(same.tracks, np.arange(len(same)))
    more = spheretree.build(bone, [20, 4, 1], quality="fast", like=same)
    kept = more.tracks[more.tracks < len(same)]
    assert len(set(kept)) == len(kept) == len(same) and len(set(more.tracks)) == len(more)
    same.save(tmp_path / "same.vdb")
    np.testing.assert_array_equal(spheretree.load(tmp_path / "same.vdb").tracks, same.tracks)
    write_vol(tmp_path / "volume.vol", bone)
    command("-read", "same.vdb", "-read", "volume.vol", "-spheretree", "spheres=20,4,1", "quality=fast", "like=1",
            "-write", "more.csv")
    more.save(tmp_path / "ours.csv")
    assert (tmp_path / "ours.csv").read_bytes() == (tmp_path / "more.csv").read_bytes()
