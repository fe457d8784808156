# SPDX-License-Identifier: Apache-2.0
"""Arrays, files and grids to volumes."""
import os
import sys

import numpy as np
import pytest
import spheretree
from conftest import ball, write_vol

DTYPES = ["bool", "int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64", "float32", "float64"]


@pytest.mark.parametrize("dtype", DTYPES)
def test_every_dtype_gives_the_same_voxels(bone, dtype):
    assert np.array_equal(spheretree.volume(bone.astype(dtype)).to_array(), bone)


@pytest.mark.parametrize("dtype", ["bool", "uint8", "float64"])
@pytest.mark.parametrize("order", ["C", "F", "steps", "backwards", "unaligned", "broadcast"])
def test_arrays_of_any_layout_are_read_where_they_lie(bone, dtype, order):
    values = bone.astype(dtype)
    if order == "F":
        values = np.asfortranarray(values)
    elif order == "steps":
        wide = np.zeros([2 * n for n in values.shape], dtype)
        wide[::2, 1::2, ::2] = values
        values = wide[::2, 1::2, ::2]
    elif order == "backwards":
        values = values[::-1, :, ::-1].copy()[::-1, :, ::-1]
    elif order == "unaligned":
        room = np.zeros(values.nbytes + 1, np.uint8)
        values = np.ndarray(values.shape, dtype, buffer=room.data, offset=1)
        values[...] = bone
    elif order == "broadcast":
        values = np.broadcast_to(values[:, :, 8:9], (*values.shape[:2], 11))
    assert np.array_equal(spheretree.volume(values).to_array(), values.astype(bool))


def test_a_read_only_array_and_a_file_in_memory_are_read(bone, tmp_path):
    bone.setflags(write=False)
    assert spheretree.volume(bone).voxels == bone.sum()
    np.save(tmp_path / "bone.npy", bone)
    assert spheretree.volume(np.load(tmp_path / "bone.npy", mmap_mode="r")).voxels == bone.sum()


@pytest.mark.skipif("SPHERETREE_PRELOAD" in os.environ, reason="a sanitizer takes terabytes of addresses")
def test_no_array_is_copied(tmp_path):
    """A volume of 2 GiB with one voxel in it, in a file that takes no room, is read in a process that may have 1 GiB."""
    import resource
    import subprocess

    path = tmp_path / "large.raw"
    with open(path, "wb") as file:
        file.truncate(1 << 31)
        file.seek(1 << 30)
        file.write(b"\x05")
    program = (f"import numpy, spheretree; a = numpy.memmap({str(path)!r}, 'u1', 'r', shape=(512, 2048, 2048));"
               "print(spheretree.volume(a).coordinates())")
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True,
                         preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_DATA, (1 << 30, 1 << 30)))
    assert run.stdout.strip() == "[[256   0   0]]"


@pytest.mark.parametrize("keywords, inside", [
    ({}, lambda v: v > 0),
    ({"threshold": 3}, lambda v: v > 3),
    ({"threshold": -2.5}, lambda v: v > -2.5),
    ({"above": -3, "below": 2}, lambda v: (v > -3) & (v < 2)),
    ({"below": -1}, lambda v: v < -1),
    ({"label": 2}, lambda v: v == 2),
    ({"label": [2, -4]}, lambda v: (v == 2) | (v == -4)),
])
@pytest.mark.parametrize("dtype", ["int8", "int16", "int32", "int64", "float32", "float64"])
def test_values_are_chosen_as_numpy_would(keywords, inside, dtype):
    values = np.random.default_rng(1).integers(-5, 6, (9, 17, 10)).astype(dtype)
    assert np.array_equal(spheretree.volume(values, **keywords).to_array(), inside(values))


def test_integers_beyond_those_of_doubles_are_compared_exactly():
    values = np.array([2**60, 2**60 + 1, 2**60 + 2], np.int64).reshape(1, 1, 3)
    assert spheretree.volume(values, threshold=2**60).voxels == 2
    assert spheretree.volume(values, label=2**60 + 1).voxels == 1
    assert spheretree.volume(np.array([[[2**64 - 1, 5]]], np.uint64), threshold=2**62).voxels == 1


def test_infinities_are_inside_or_outside():
    values = np.array([[[-np.inf, 0, np.inf]]])
    assert spheretree.volume(values, threshold=1e300).coordinates().tolist() == [[0, 0, 2]]
    assert spheretree.volume(values, below=-1e300).coordinates().tolist() == [[0, 0, 0]]


def test_axes_zyx_is_the_same_object_turned(bone):
    turned = spheretree.volume(bone.transpose(2, 1, 0), axes="zyx")
    assert np.array_equal(turned.to_array(), bone.transpose(2, 1, 0))
    tree, other = spheretree.build(bone, [32, 4]), spheretree.build(turned, [32, 4])
    assert np.array_equal(tree.centers, other.centers) and np.array_equal(tree.radii, other.radii)
    rows = turned.coordinates()
    assert bone.transpose(2, 1, 0)[tuple(rows.T)].all() and len(rows) == bone.sum()


def test_anisotropy_origin_and_matrix_say_where_voxels_are(bone):
    here = spheretree.build(bone, [16])
    there = spheretree.build(bone, [16], anisotropy=0.25, origin=(1, 2, 3))
    assert np.allclose(there.centers, here.centers * 0.25 + (1, 2, 3))
    assert np.allclose(there.radii, here.radii * 0.25, rtol=1e-6)
    matrix = np.diag([0.25, 0.25, 0.25, 1])
    matrix[:3, 3] = (1, 2, 3)
    placed = spheretree.build(bone, [16], matrix=matrix)
    assert np.allclose(placed.centers, there.centers) and np.allclose(placed.matrix, matrix)


def test_voxels_that_are_no_cubes_are_resampled():
    """A ball of slices that lie twice as far apart, given in the array's own order of axes."""
    slices = ball(20)[:, :, ::2]
    volume = spheretree.volume(slices.transpose(2, 1, 0).astype(np.float32), threshold=0.5, axes="zyx",
                               anisotropy=(2, 1, 1))
    assert volume.voxel_size == 1
    assert abs(volume.voxels / ball(20).sum() - 1) < 0.05
    center = (volume.matrix @ [*volume.coordinates()[:, ::-1].mean(axis=0), 1])[:3]
    assert np.allclose(center, 21, atol=0.1)


def test_resampling_takes_labels_by_the_nearest_and_outside_by_what_is_outside():
    values = np.full((8, 8, 8), -1000, np.int16)
    values[2:6, 2:6, 2:6] = 300
    soft = spheretree.volume(values, threshold=-500, anisotropy=(1, 1, 2))
    assert 0 < soft.voxels < 8**3
    assert spheretree.volume(values, label=300, anisotropy=(1, 1, 2)).voxels == 4 * 4 * 8


def test_coverage_of_cubes_holds_that_of_centers_which_holds_whole():
    x, y, z = np.mgrid[-8:9, -8:9, -8:9]
    values = (50 - x**2 - y**2 - z**2).astype(np.float32)
    masks = [spheretree.volume(values, coverage=c) for c in ("whole", "centers", "cubes")]
    counts = [mask.voxels for mask in masks]
    assert counts[0] < counts[1] < counts[2]


def test_largest_keeps_one_part_and_fill_leaves_no_cavity():
    shell = ball(10) & ~np.pad(ball(6), 4)
    shell[0, 0, 0] = True
    assert spheretree.volume(shell, largest=True, fill=True).voxels == ball(10).sum()


def test_a_flat_array_is_an_object_of_two_dimensions():
    disc = ball(9, (1, 2))
    volume = spheretree.volume(disc)
    assert (volume.ndim, volume.shape, volume.coordinates().shape[1]) == (2, disc.shape, 2)
    tree = spheretree.build(disc, [8, 1])
    assert tree.settings["dim"] == 2 and (tree.centers[:, 2] == 0).all()
    assert not tree.check(disc)


@pytest.mark.parametrize("volume, words", [
    (np.zeros(5), "has 1 axis"),
    (np.zeros((2, 2, 2, 2)), "has 4 axes"),
    (np.zeros((2, 2, 2), complex), "complex128"),
    (np.zeros((2, 2, 2), np.float16), "float16"),
    (np.zeros((2, 2, 2), object), "object"),
    (np.zeros((2, 2, 2), "U3"), "<U3"),
    (np.zeros((2, 2, 2), np.longdouble), "float128"),
    (np.zeros((2, 2, 2), ">i4"), "byte order"),
    (np.zeros((2, 2, 2)), "no value is above 0"),
    (np.zeros((2, 2, 2), bool), "False everywhere"),
    (np.zeros((0, 2, 2)), "holds no object"),
    (np.array([[[0, np.nan, 1]]]), "NaN at x=0, y=0, z=1"),
    (np.array([[[0, np.nan, 1]]], np.float32), "NaN at x=0, y=0, z=1"),
])
def test_an_array_that_is_no_volume_is_refused(volume, words):
    with pytest.raises(spheretree.InputError, match=words):
        spheretree.build(volume)


@pytest.mark.parametrize("volume", [[[[1]]], (1, 2), None, 5, np.ma.ones((2, 2, 2)), np.float32(1)])
def test_what_is_no_array_is_refused_and_not_made_one(volume):
    with pytest.raises(TypeError):
        spheretree.build(volume)


@pytest.mark.parametrize("keywords, words", [
    ({"threshold": 1, "label": 2}, "threshold and label exclude"),
    ({"threshold": 1, "below": 2}, "threshold and above exclude"),
    ({"above": 3, "below": 2}, "no value is above 3 and below 2"),
    ({"label": []}, "label names no value"),
    ({"label": 99}, "no value is a label"),
    ({"iso": 1}, "iso is for level sets"),
    ({"threshold": np.nan}, "not a finite number"),
    ({"threshold": 2**70}, "beyond 64 bits"),
    ({"label": [1, 2**70]}, "label=.* is beyond 64 bits"),
    ({"axes": "yxz"}, "axes='yxz'"),
    ({"anisotropy": (1, 2)}, "anisotropy has 2 numbers"),
    ({"anisotropy": 0}, "anisotropy=0"),
    ({"anisotropy": -1}, "anisotropy=-1"),
    ({"anisotropy": 1e-5}, "anisotropy and origin: OpenVDB has no transform"),
    ({"origin": (1, 2)}, "origin has 2 numbers"),
    ({"anisotropy": 1e160}, "anisotropy and origin: .* too large"),
    ({"origin": (1e16, 0, 0)}, "too far for voxels"),
    ({"origin": (0, 0, 2**1100)}, "origin=.* is beyond 64 bits"),
    ({"name": "\ud800"}, "name='.* half of a character"),
    ({"matrix": np.diag([1e-5, 1e-5, 1e-5, 1])}, "matrix: .* below 3e-15"),
    ({"matrix": np.diag([1e160, 1e160, 1e160, 1])}, "matrix: .* too large"),
    ({"matrix": np.eye(3)}, "shape \\(4, 4\\)"),
    ({"matrix": np.eye(4), "origin": 1}, "matrix says where"),
    ({"matrix": np.zeros((4, 4))}, "0, 0, 0, 1"),
    ({"coverage": "all"}, "coverage='all'"),
    ({"label": 1, "coverage": "cubes"}, "label excludes coverage"),
    ({"voxel": 1}, "voxel is of files"),
    ({"grid": "a"}, "grid is of files"),
    ({"threads": 0}, "threads=0"),
])
def test_a_wrong_keyword_is_named(keywords, words):
    with pytest.raises(spheretree.InputError, match=words):
        spheretree.volume(np.ones((3, 3, 3)), **keywords)


@pytest.mark.parametrize("keywords", [{"label": 1.5}, {"label": "1"}, {"threshold": "1"}, {"threads": 1.5}])
def test_a_keyword_of_another_type_is_a_type_error(keywords):
    with pytest.raises(TypeError):
        spheretree.volume(np.ones((3, 3, 3)), **keywords)


@pytest.mark.parametrize("name", ["anisotropy", "origin"])
@pytest.mark.parametrize("value", [object(), "one", 1j, (1, 2, "3"), [[1, 2, 3]], {1: 2}.__len__, np.array("a")])
def test_where_voxels_are_is_said_by_numbers_and_the_argument_is_named(name, value):
    for shape in (3, 3, 3), (3, 3):
        with pytest.raises((TypeError, spheretree.InputError), match=name):
            spheretree.volume(np.ones(shape), **{name: value})


@pytest.mark.parametrize("two", [2, 2.0, np.int8(2), np.float32(2), np.array(2), np.array(2.0)])
def test_one_number_of_any_type_stands_for_all(two):
    for shape in (3, 3, 3), (3, 3):
        place = spheretree.volume(np.ones(shape), anisotropy=two, origin=two).matrix
        assert np.array_equal(place[:3, :3], 2 * np.eye(3)) and np.array_equal(place[:3, 3], [2, 2, 2])


def test_a_complex_matrix_is_refused():
    with pytest.raises(TypeError, match="matrix must hold real"):
        spheretree.volume(np.ones((3, 3, 3)), matrix=np.eye(4, dtype=complex))


def test_threshold_of_a_bool_array_is_refused(bone):
    with pytest.raises(spheretree.InputError, match="dtype bool"):
        spheretree.volume(bone, threshold=1)


def test_a_vol_file_is_the_array_in_it(bone, tmp_path):
    write_vol(tmp_path / "bone.vol", bone * 7)
    volume = spheretree.volume(tmp_path / "bone.vol")
    assert volume.name == "bone" and volume.voxels == bone.sum()
    begin = volume.start
    own = bone[tuple(slice(b, b + n) for b, n in zip(begin, volume.shape))]
    assert np.array_equal(volume.to_array(), own)
    assert spheretree.volume(tmp_path / "bone.vol", label=7).voxels == bone.sum()


def test_a_mesh_becomes_its_solid(tmp_path):
    (tmp_path / "tetra.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
    path = tmp_path / "tetra.obj"
    centers = spheretree.volume(path, voxel=0.01)
    assert abs(centers.voxels * 0.01**3 - 1 / 6) < 0.012
    assert spheretree.volume(str(path), resolution=100, coverage="cubes").voxels > centers.voxels
    with pytest.raises(spheretree.InputError, match="exclude"):
        spheretree.volume(path, voxel=1, resolution=5)
    with pytest.raises(spheretree.InputError, match="voxel=-1"):
        spheretree.volume(path, voxel=-1)


@pytest.mark.parametrize("units", ["mm", "cm", "m", "in", "ft", "um", "km"])
def test_units_of_a_mesh_are_those_of_the_command(tmp_path, command, units):
    (tmp_path / "t.obj").write_text("v 0 0 0\nv 1e4 0 0\nv 0 1.5e4 0\nv 0 0 3e4\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
    command("-read", "t.obj", f"units={units}", "-mesh2ls", "dim=32", "-spheretree", "spheres=8,1", "quality=fast",
            "-write", "theirs.vdb")
    theirs = spheretree.load(tmp_path / "theirs.vdb")
    ours = spheretree.build(tmp_path / "t.obj", [8, 1], quality="fast", units=units, resolution=32)
    for mine, other in zip(ours.levels, theirs.levels):
        assert np.array_equal(mine.centers, other.centers) and np.array_equal(mine.radii, other.radii)


def test_units_that_are_none_are_refused(tmp_path, bone):
    (tmp_path / "t.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
    for units in "inch", "", "MM":
        with pytest.raises(spheretree.InputError, match="units="):
            spheretree.volume(tmp_path / "t.obj", units=units)
    with pytest.raises(TypeError, match="units must be a str"):
        spheretree.volume(tmp_path / "t.obj", units=0.001)
    with pytest.raises(spheretree.InputError, match="units is of files"):
        spheretree.volume(bone, units="mm")
    write_vol(tmp_path / "bone.vol", bone * 7)
    with pytest.raises(spheretree.InputError, match="units is of meshes"):
        spheretree.volume(tmp_path / "bone.vol", units="mm")


def test_an_open_mesh_is_warned_of(tmp_path):
    (tmp_path / "open.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
                                       "v 5 5 5\nv 6 5 5\nv 5 6 5\nf 5 6 7\n")
    with pytest.warns(UserWarning, match="not closed"):
        spheretree.volume(tmp_path / "open.obj", voxel=0.1)


def test_files_that_are_not_there_or_damaged_are_os_errors(tmp_path):
    with pytest.raises(FileNotFoundError):
        spheretree.volume(tmp_path / "none.vdb")
    with pytest.raises(IsADirectoryError):
        spheretree.load(tmp_path)
    (tmp_path / "bad.vdb").write_bytes(b"not a vdb file")
    for read in (spheretree.volume, spheretree.load, spheretree.read_points):
        with pytest.raises(OSError, match="bad.vdb"):
            read(tmp_path / "bad.vdb")
    (tmp_path / "text.txt").write_text("hello")
    with pytest.raises(spheretree.InputError, match="as arrays"):
        spheretree.volume(tmp_path / "text.txt")


def test_values_of_files_that_are_no_numbers_are_told(tmp_path):
    vdb = pytest.importorskip("pyopenvdb")
    grid = vdb.FloatGrid()
    grid.copyFromArray(np.ones((9, 9, 9), dtype=np.float32))
    voxels = grid.getAccessor()
    for z in (3, 4):
        voxels.setValueOn((4, 4, z), np.nan)
    path = tmp_path / "holes.vdb"
    vdb.write(str(path), grids=[grid])
    with pytest.warns(UserWarning, match="holes.vdb: 2 values are no numbers"):
        assert spheretree.volume(path).voxels == 9**3 - 2


def test_a_grid_from_the_first_coordinate_to_the_last_is_as_wide_as_it_is(tmp_path):
    vdb = pytest.importorskip("pyopenvdb")
    grid = vdb.BoolGrid()
    for x in (-2**31, 2**31 - 1):
        grid.getAccessor().setValueOn((x, 0, 0), True)
    vdb.write(str(tmp_path / "ends.vdb"), grids=[grid])
    volume = spheretree.volume(tmp_path / "ends.vdb")
    assert (volume.shape, volume.start) == ((2**32, 1, 1), (-2**31, 0, 0))
    assert volume.coordinates()[:, 0].tolist() == [-2**31, 2**31 - 1]


def test_a_grid_of_pyopenvdb_is_taken(bone, tmp_path):
    vdb = pytest.importorskip("pyopenvdb")
    grid = vdb.BoolGrid()
    grid.copyFromArray(bone)
    grid.name = "bone"
    grid.transform = vdb.createLinearTransform(0.5)
    volume = spheretree.volume(grid)
    assert (volume.name, volume.voxel_size, volume.voxels) == ("bone", 0.5, bone.sum())
    sphere = vdb.createLevelSetSphere(radius=9.5, voxelSize=1.0)
    assert spheretree.volume(sphere).voxels == (np.mgrid[-10:11, -10:11, -10:11] ** 2).sum(axis=0).__lt__(9.5**2).sum()
    assert spheretree.volume(sphere, iso=1).voxels > spheretree.volume(sphere).voxels
    with pytest.raises(spheretree.InputError, match="use iso"):
        spheretree.volume(sphere, threshold=1)
    sphere.name = "sphere"
    vdb.write(str(tmp_path / "two.vdb"), grids=[grid, sphere])
    with pytest.raises(spheretree.InputError, match="several grids.*'bone', 'sphere'"):
        spheretree.volume(tmp_path / "two.vdb")
    assert spheretree.volume(tmp_path / "two.vdb", grid="bone").voxels == bone.sum()
    with pytest.raises(spheretree.InputError, match="named 'x'"):
        spheretree.volume(tmp_path / "two.vdb", grid="x")


def test_a_volume_is_taken_as_it_is(bone):
    volume = spheretree.volume(bone)
    assert spheretree.volume(volume) is volume
    with pytest.raises(spheretree.InputError, match="threshold"):
        spheretree.build(volume, threshold=1)
    with pytest.raises(spheretree.InputError, match="anisotropy"):
        spheretree.build(volume, anisotropy=1)
