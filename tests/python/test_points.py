# SPDX-License-Identifier: Apache-2.0
"""Points of any .vdb as arrays."""
import os

import numpy as np
import pytest
import spheretree
from conftest import run_program


def test_points_of_a_tree_are_its_spheres(bone, tmp_path):
    tree = spheretree.build(bone, [32, 4], anisotropy=0.1, origin=(5, 6, 7), cuts=True)
    tree.save(tmp_path / "tree.vdb")
    grids = spheretree.read_points(tmp_path / "tree.vdb")
    assert sorted(grids) == ["spheretree", "spheretree_cuts"]
    points = grids["spheretree"]
    order = np.argsort(points["id"])
    assert np.array_equal(points["id"][order], np.arange(len(tree)))
    assert np.allclose(points["P"][order], tree.centers, atol=1e-12)
    assert np.array_equal(points["pscale"][order], tree.radii)
    assert np.array_equal(points["parent"][order], tree.parents)
    assert np.array_equal(points["ijk"][order], tree.ijk)
    assert points["cover_sq"].dtype == np.int64 and points["radius"].dtype == np.float64
    for level in tree.levels:
        assert np.array_equal(np.sort(points["id"][points[f"group:level_{level.level}"]]), level.ids)


def test_points_of_every_type_are_read(tmp_path):
    """A file that OpenVDB's own functions have made: attributes of all types, with and without codecs."""
    maker = os.environ.get("SPHERETREE_POINT_SAMPLE")
    if not maker:
        pytest.skip("SPHERETREE_POINT_SAMPLE does not name the program that makes the file")
    path = tmp_path / "points.vdb"
    run_program(maker, path)
    points = spheretree.read_points(path)["sample"]
    n = np.arange(1, 6)
    order = np.argsort(points["int32"])
    assert np.allclose(points["P"][order], np.stack([n, 10.0 * n, -0.25 * n], axis=1), atol=1e-6)
    assert points["bool"][order].tolist() == [True, False, True, False, True]
    for name in ("int8", "int16", "int32", "int64", "float", "double", "half"):
        assert np.array_equal(points[name][order], n), name
    assert points["int8"].dtype == np.int8 and points["half"].dtype == np.float32
    for name, dtype in (("vec3i", np.int32), ("vec3s", np.float32), ("vec3d", np.float64)):
        assert np.array_equal(points[name][order], np.stack([n, 2 * n, 3 * n], axis=1)) and points[name].dtype == dtype
    assert np.array_equal(points["quats"][order], np.stack([n, 0 * n, 0 * n, -n], axis=1))
    assert np.array_equal(points["mat3d"][order][1], [[2, 1, 0], [0, 2, 0], [0, 0, 2]])
    assert np.array_equal(points["mat4s"][order][1][3], [7, 0, 0, 1])
    assert np.array_equal(points["pair"][order], np.stack([n, -n], axis=1))
    assert points["uniform"].tolist() == [4] * 5
    assert [points["string"][i] for i in order] == ["odd", "even", "odd", "even", "odd"]
    assert np.array_equal(points["group:few"][order], n < 3)
    assert sorted(points) == sorted(["P", "bool", "int8", "int16", "int32", "int64", "float", "double", "half", "vec3i",
                                     "vec3s", "vec3d", "quats", "mat3d", "mat4s", "pair", "uniform", "string",
                                     "group:few"])


def test_a_file_without_points_gives_none(bone, tmp_path):
    vdb = pytest.importorskip("pyopenvdb")
    grid = vdb.BoolGrid()
    grid.copyFromArray(bone)
    vdb.write(str(tmp_path / "bone.vdb"), grids=[grid])
    assert spheretree.read_points(tmp_path / "bone.vdb") == {}


@pytest.mark.parametrize("seed", range(8))
def test_damaged_points_are_refused_or_read_and_never_more(bone, tmp_path, seed):
    random = np.random.default_rng(seed)
    path = tmp_path / "points.vdb"
    maker = os.environ.get("SPHERETREE_POINT_SAMPLE")
    if seed % 2 and maker:
        run_program(maker, path)
    else:
        spheretree.build(bone, [32, 4]).save(path)
    sound = path.read_bytes()
    refused = 0
    for _ in range(60):
        stored = bytearray(sound)
        for place in random.integers(0, len(stored), 1 + random.integers(3)):
            stored[place] ^= 1 << random.integers(8)
        path.write_bytes(stored[:random.integers(len(stored))] if random.random() < 0.1 else stored)
        try:
            for arrays in spheretree.read_points(path).values():
                assert len({len(values) for values in arrays.values()}) <= 1
        except OSError as error:
            assert "points.vdb" in str(error)
            refused += 1
    assert refused
