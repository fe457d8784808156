# SPDX-License-Identifier: Apache-2.0
"""The page for a browser: the bytes of the command, and errors that leave the old file."""
import numpy as np
import pytest
import spheretree
from conftest import write_vol

SURFACE = b'id="surface-quads"'

@pytest.mark.parametrize("keywords", [{}, {"triangles": 0}, {"triangles": 400}, {"triangles": 10_000_000}])
def test_the_bytes_are_those_of_the_command(bone, tmp_path, command, keywords):
    write_vol(tmp_path / "volume.vol", bone)
    options = [f"{key}={value}" for key, value in keywords.items()]
    command("-read", "volume.vol", "-spheretree", "spheres=32,4", "cuts=1", "-write", "t.vdb", "built.html", *options)
    command("-read", "t.vdb", "-write", "alone.html", *options)
    built, alone = ((tmp_path / name).read_bytes() for name in ("built.html", "alone.html"))
    assert (SURFACE in built) == (keywords.get("triangles") != 0) and SURFACE not in alone
    page = tmp_path / "ours.html"
    for tree in spheretree.build(bone, [32, 4], cuts=True), spheretree.load(tmp_path / "t.vdb"):
        for volume in bone, tmp_path / "volume.vol", spheretree.volume(bone):
            tree.write_html(page, volume, **keywords)
            assert page.read_bytes() == built
        tree.write_html(page, **keywords)
        assert page.read_bytes() == alone


@pytest.mark.parametrize("length", [222, 223])  # voxels have 199,792 and 200,684 triangles
def test_the_surface_has_as_many_triangles_as_the_commands_by_default(tmp_path, command, length):
    plate = np.ones((length, 221, 2), bool)
    write_vol(tmp_path / "volume.vol", plate)
    command("-read", "volume.vol", "-spheretree", "spheres=8", "quality=fast", "-write", "theirs.htm")
    spheretree.build(plate, 8, quality="fast").write_html(tmp_path / "ours.htm", plate)
    assert (tmp_path / "ours.htm").read_bytes() == (tmp_path / "theirs.htm").read_bytes()


BLOCK = np.ones((20, 14, 8), bool)
TURNED = np.ones((14, 20, 8), bool)


@pytest.mark.parametrize("name, arguments, keywords, words", [
    ("t.html", [TURNED], {}, "t.html: the volume has other voxels than those that the tree was built of"),
    ("t.html", [spheretree.volume(BLOCK, anisotropy=2)], {}, "t.html: the volume has other voxels"),
    ("t.html", [TURNED], {"triangles": 0}, "t.html: the volume has other voxels"),
    ("t.html", [], {"triangles": -1}, "t.html: triangles=-1 is out of range: it takes 0 to 10000000"),
    ("t.html", [], {"triangles": 10_000_001}, "t.html: triangles=10000001 is out of range"),
    ("t.html", [], {"triangles": 2**70}, "triangles=.* is beyond 64 bits"),
    ("t.vdb", [], {}, "t.vdb: a page is named .html or .htm"),
    ("t", [], {}, "t: a page is named .html or .htm"),
])
def test_what_is_wrong_is_said_and_leaves_the_old_file(tmp_path, name, arguments, keywords, words):
    path = tmp_path / name
    path.write_text("precious")
    tree = spheretree.build(BLOCK, [4, 1], quality="fast")
    with pytest.raises(spheretree.InputError, match=words):
        tree.write_html(path, *arguments, **keywords)
    assert path.read_text() == "precious" and list(tmp_path.iterdir()) == [path]


def test_wrong_types_and_places_are_the_usual_errors(tmp_path):
    tree = spheretree.build(BLOCK, [4, 1], quality="fast")
    for keywords in {"triangles": 1.5}, {"triangles": True}, {"volume": [[[1]]]}, {"progress": 5}:
        with pytest.raises(TypeError):
            tree.write_html(tmp_path / "t.html", **keywords)
    with pytest.raises(OSError, match="none"):
        tree.write_html(tmp_path / "none" / "t.html")
    with pytest.raises(ValueError, match="null byte"):
        tree.write_html("t\0.html")
    assert not list(tmp_path.iterdir())


def test_an_exception_of_progress_leaves_the_old_file(tmp_path):
    """Of a surface that takes more than a second: progress is told after a tenth of one."""
    class Enough(Exception):
        pass

    def progress(done, stage):
        raise Enough(stage)

    grains = np.indices((90,) * 3).sum(axis=0) % 2 == 0
    tree = spheretree.build(grains, 1, quality="fast")
    volume = spheretree.volume(grains)
    path = tmp_path / "t.html"
    path.write_text("precious")
    with pytest.raises(Enough):
        tree.write_html(path, volume, triangles=10_000_000, progress=progress)
    assert path.read_text() == "precious" and list(tmp_path.iterdir()) == [path]
