# SPDX-License-Identifier: Apache-2.0
"""Files of arrays and pictures to volumes: the voxels that numpy sees in the same data."""
import gzip
import struct
import warnings

import numpy as np
import pytest
import spheretree
from conftest import ROOT, write_vol

SAMPLES = ROOT / "tests/data/volumes"
X, Y, Z = np.mgrid[:4, :3, :5]
NUMBERS = np.where((X + Y + Z) % 3 == 0, 0, X + 5 * Y + 20 * Z)  # of all samples: make.py beside them
PLACE = np.array([[0, -2, 0, 10], [2, 0, 0, -5], [0, 0, 2, 1], [0, 0, 0, 1]])  # of those that have one


def inside(volume, shape):
    """The voxels of a volume in an array of this shape."""
    whole = np.zeros(shape, bool)
    whole[tuple(slice(first, first + n) for first, n in zip(volume.start, volume.shape))] = volume.to_array()
    assert whole.sum() == volume.voxels
    return whole


def same(a, b):
    """Whether two volumes have the same voxels in the same place."""
    rows = [volume.coordinates()[np.lexsort(volume.coordinates().T)] for volume in (a, b)]
    return np.array_equal(*rows) and np.allclose(a.matrix, b.matrix, atol=1e-12)


def write_nii(path, values, edges=(1, 1, 1)):
    """An array of int16 of shape (x, y, z) as NIfTI-1."""
    header = bytearray(352)
    struct.pack_into("<i", header, 0, 348)
    struct.pack_into("<8h", header, 40, 3, *values.shape, 1, 1, 1, 1)
    struct.pack_into("<2h", header, 70, 4, 16)  # DT_INT16, bits
    struct.pack_into("<5f", header, 76, 1, *edges, 1)
    struct.pack_into("<f", header, 108, 352)
    header[344:348] = b"n+1\0"
    content = bytes(header) + values.astype("<i2").tobytes(order="F")
    path.write_bytes(gzip.compress(content) if path.suffix == ".gz" else content)


def write_nrrd(path, values, edges=(1, 1, 1)):
    """An array of float32 of shape (x, y, z) as NRRD."""
    words = ["NRRD0004", "type: float", "dimension: 3", "sizes: {} {} {}".format(*values.shape),
             "spacings: {} {} {}".format(*edges), "endian: little", "encoding: raw", "", ""]
    path.write_bytes("\n".join(words).encode() + values.astype("<f4").tobytes(order="F"))


def write_pgm(path, picture):
    """An array of uint8 of shape (x, y) as a picture."""
    path.write_bytes(b"P5 %d %d 255\n" % picture.shape + picture.astype(np.uint8).tobytes(order="F"))


@pytest.mark.parametrize("name", [
    "i1.npy", "u1.npy", "little_i2.npy", "big_i2.npy", "little_u8.npy", "little_f2.npy", "big_f4.npy", "little_f8.npy",
    "fortran.npy", "four_axes.npy", "raw.nrrd", "gzip.nrrd", "text.nrrd", "detached.nhdr", "sform.nii", "sform.nii.gz",
    "big.nii", "slice_%03d.png", "slice_###.png", "s%d.pgm", "s#.pgm"])
@pytest.mark.parametrize("keywords, wanted", [
    ({}, NUMBERS > 0),
    ({"threshold": 45}, NUMBERS > 45),
    ({"above": 20, "below": 64}, (NUMBERS > 20) & (NUMBERS < 64)),
    ({"label": [6, 81]}, np.isin(NUMBERS, [6, 81])),
    ({"label": [0, 81]}, np.isin(NUMBERS, [0, 81])),
    ({"below": 45}, NUMBERS < 45),
])
def test_every_format_gives_the_voxels_of_its_numbers(name, keywords, wanted):
    volume = spheretree.volume(SAMPLES / name, anisotropy=1, **keywords)
    assert np.array_equal(inside(volume, NUMBERS.shape), wanted)
    assert np.array_equal(volume.matrix, np.eye(4))


@pytest.mark.parametrize("name", ["bool.npy", "slice.npy", "slope.nii", "slice_012.png", "text.pgm", "wide.png", "bits.png"])
def test_bools_slopes_and_single_pictures_are_read(name):
    shown = NUMBERS if name in ("bool.npy", "slope.nii") else NUMBERS[:, :, 4:]
    volume = spheretree.volume(SAMPLES / name)
    assert np.array_equal(inside(volume, shown.shape), shown > 0)
    if name == "slope.nii":  # each number is half of what is stored
        assert spheretree.volume(SAMPLES / name, threshold=22.4).voxels == (NUMBERS > 44).sum()
        assert spheretree.volume(SAMPLES / name, threshold=22.5).voxels == (NUMBERS > 45).sum()


@pytest.mark.parametrize("name", ["zyx.npy", "zyx_fortran.npy"])
def test_the_first_index_of_a_npy_is_x_or_z(name):
    array = np.load(SAMPLES / name)
    turned = spheretree.volume(SAMPLES / name, axes="zyx")
    assert np.array_equal(inside(turned, NUMBERS.shape), NUMBERS > 0)
    assert np.array_equal(inside(spheretree.volume(SAMPLES / name), array.shape), array > 0)
    edges = (1, 2, 4)  # along x, y, z for both
    assert same(spheretree.volume(SAMPLES / name, axes="zyx", anisotropy=edges),
                spheretree.volume(NUMBERS, anisotropy=edges))


@pytest.mark.parametrize("dtype", ["int8", "int16", "int64", "float32", "float64"])
@pytest.mark.parametrize("keywords", [
    {}, {"threshold": 2}, {"threshold": -3}, {"above": -3, "below": 3}, {"below": -1}, {"below": 2}, {"label": 0},
    {"label": [-5, 0, 5]}, {"coverage": "cubes"}, {"coverage": "whole", "threshold": -5}, {"coverage": "cubes", "below": 2},
    {"anisotropy": 0.5}, {"anisotropy": (1, 1, 2)}, {"anisotropy": (3, 1, 1), "threshold": -3},
    {"anisotropy": (1, 2, 1), "label": 0}, {"label": range(-6, 7)}, {"anisotropy": (1, 2, 1), "label": range(-6, 7)},
    {"largest": True, "fill": True, "threshold": -2}])
def test_a_npy_is_the_object_of_the_same_array(tmp_path, dtype, keywords):
    values = np.random.default_rng(5).integers(-6, 7, (19, 9, 12)).astype(dtype)
    np.save(tmp_path / "a.npy", values)
    from_file = spheretree.volume(tmp_path / "a.npy", **keywords)
    assert same(from_file, spheretree.volume(values, **keywords)) and from_file.name == "a"


@pytest.mark.parametrize("write, name", [(write_nii, "a.nii"), (write_nii, "a.nii.gz"), (write_nrrd, "a.nrrd")])
def test_edges_are_those_of_the_file_or_of_anisotropy(tmp_path, write, name):
    values = np.random.default_rng(6).integers(-6, 7, (7, 9, 12))
    write(tmp_path / name, values, (0.5, 0.5, 1))
    dense = values.astype(np.float32 if name == "a.nrrd" else np.int16)
    for own, keywords in ((0.5, 0.5, 1), {}), ((2, 2, 2), {"anisotropy": 2}), ((1, 3, 1), {"anisotropy": (1, 3, 1)}):
        expected = spheretree.volume(dense, anisotropy=own, threshold=1)
        assert same(spheretree.volume(tmp_path / name, threshold=1, **keywords), expected)


@pytest.mark.parametrize("name", ["sform.nii", "sform.nii.gz", "qform.nii", "placed.nrrd"])
def test_the_place_in_the_world_is_that_of_the_file(name):
    volume = spheretree.volume(SAMPLES / name)
    assert np.allclose(volume.matrix, PLACE, atol=1e-6) and np.array_equal(inside(volume, NUMBERS.shape), NUMBERS > 0)
    assert np.array_equal(spheretree.volume(SAMPLES / name, anisotropy=2).matrix, np.diag([2, 2, 2, 1]))


def test_values_that_are_no_numbers_are_outside_and_told(tmp_path):
    values = np.random.default_rng(7).integers(-6, 7, (9, 10, 11)).astype(np.float32)
    values[3, 4, 5:8] = np.nan
    np.save(tmp_path / "holes.npy", values)
    write_nrrd(tmp_path / "holes.nrrd", values)
    for name in "holes.npy", "holes.nrrd":
        for threshold in 0, -3:
            with pytest.warns(UserWarning, match=f"{name}: 3 values are no numbers.*outside") as told:
                volume = spheretree.volume(tmp_path / name, threshold=threshold)
            assert len(told) == 1
            assert np.array_equal(inside(volume, values.shape), values > threshold)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        spheretree.volume(SAMPLES / "little_f4.npy")


def test_a_stack_is_all_slices_of_its_name(tmp_path, monkeypatch):
    values = np.random.default_rng(8).integers(0, 9, (8, 5, 12)) * 20
    for z in range(12):
        write_pgm(tmp_path / f"scan_{z + 95:02d}.pgm", values[:, :, z])  # from two digits to three
    write_pgm(tmp_path / "other_95.pgm", values[:, :, 0] * 0)
    for name in "scan_##.pgm", "scan_%02d.pgm", "scan_%d.pgm":
        volume = spheretree.volume(tmp_path / name, threshold=70)
        assert volume.name == "scan" and np.array_equal(inside(volume, values.shape), values > 70)
    monkeypatch.chdir(tmp_path)
    assert spheretree.build("scan_##.pgm", 4, quality="fast", threshold=70).object["name"] == "scan"
    write_pgm(tmp_path / "scan_##.pgm", values[:, :, 3])  # a file of that very name is no stack
    assert np.array_equal(inside(spheretree.volume("scan_##.pgm"), (8, 5, 1)), values[:, :, 3:4] > 0)
    (tmp_path / "scan_100.pgm").unlink()
    with pytest.raises(OSError, match="there is no .*scan_100.pgm"):
        spheretree.volume("scan_%d.pgm")


@pytest.mark.parametrize("name", ["a.npy", "a.nii.gz", "a.nrrd", "a.raw", "a.png", "none/a.npy"])
def test_a_file_that_is_not_there_is_not_found(tmp_path, name):
    with pytest.raises(FileNotFoundError, match=name):
        spheretree.volume(tmp_path / name)


@pytest.mark.parametrize("name", ["a_##.png", "none/a_%d.pgm"])
def test_a_stack_without_slices_is_an_os_error(tmp_path, name):
    with pytest.raises(OSError, match=name):
        spheretree.volume(tmp_path / name)


def test_a_raw_is_refused_and_the_way_that_is_told_works():
    path = SAMPLES / "little_u2.raw"
    with pytest.raises(spheretree.InputError, match="little_u2.raw: .*numpy.memmap.*numpy.fromfile.*zyx"):
        spheretree.volume(path)
    with pytest.raises(spheretree.InputError, match="numpy.memmap"):
        spheretree.volume(path, threshold=-1)
    for array in np.memmap(path, "<u2", "r", shape=(5, 3, 4)), np.fromfile(path, "<u2").reshape(5, 3, 4):
        volume = spheretree.volume(array, axes="zyx")
        assert np.array_equal(volume.to_array().transpose(2, 1, 0), NUMBERS > 0)


@pytest.mark.parametrize("name, keywords, words", [
    ("sform.nii", {"axes": "zyx"}, "axes='zyx' is of arrays and .npy files"),
    ("slice_%03d.png", {"axes": "zyx"}, "axes='zyx' is of arrays and .npy files"),
    ("i1.npy", {"axes": "yxz"}, "axes='yxz' is unknown: it takes 'xyz' or 'zyx'"),
    ("i1.npy", {"origin": 0}, "origin is of arrays"),
    ("i1.npy", {"matrix": np.eye(4)}, "matrix is of arrays"),
    ("i1.npy", {"name": "a"}, "name is of arrays"),
    ("i1.npy", {"anisotropy": 0}, "anisotropy=0 is out of range"),
    ("i1.npy", {"anisotropy": (1, 1, -1)}, "anisotropy=.* is out of range"),
    ("i1.npy", {"anisotropy": (1, 2)}, "anisotropy has 2 numbers: it takes one, or 3"),
    ("i1.npy", {"anisotropy": np.nan}, "anisotropy=nan is not a finite number"),
    ("i1.npy", {"anisotropy": 1e-5}, "^anisotropy: OpenVDB has no transform"),
    ("i1.npy", {"anisotropy": 1e160}, "^anisotropy: OpenVDB has no transform"),
    ("i1.npy", {"units": "mm"}, "units is of meshes, and .*i1.npy is none"),
    ("slice_%03d.png", {"voxel": 1}, "voxel is of meshes, and .*slice_%03d.png is none"),
    ("sform.nii.gz", {"grid": "a"}, "grid is of .vdb files, and .*sform.nii.gz is none"),
    ("bool.npy", {"threshold": 1}, "bool.npy: threshold is for volumes of numbers"),
    ("bool.npy", {"threshold": -1}, "bool.npy: threshold is for volumes of numbers"),
    ("i1.npy", {"iso": 1}, "i1.npy: iso is for level sets.*use threshold"),
    ("i1.npy", {"threshold": 200}, "i1.npy: .* holds no object: it has no value above 200"),
    ("i1.npy", {"threshold": -1}, "i1.npy: every value is inside the object.*numpy.pad"),
    ("i1.npy", {"threshold": 1, "label": 2}, "threshold and label exclude"),
])
def test_what_does_not_suit_a_file_is_refused(name, keywords, words):
    with pytest.raises(spheretree.InputError, match=words):
        spheretree.volume(SAMPLES / name, **keywords)


def test_edges_and_axes_of_other_files_stay_their_own(tmp_path, bone):
    write_vol(tmp_path / "a.vol", bone)
    (tmp_path / "a.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
    spheretree.build(bone, 1, quality="fast").save(tmp_path / "a.vdb")
    for name in "a.vol", "a.obj", "a.vdb":
        with pytest.raises(spheretree.InputError, match="^anisotropy is of arrays: a volume or file has its own"):
            spheretree.volume(tmp_path / name, anisotropy=1)
        with pytest.raises(spheretree.InputError, match="^axes='zyx' is of arrays"):
            spheretree.volume(tmp_path / name, axes="zyx")


@pytest.mark.parametrize("name", ["complex.npy", "objects.npy", "records.npy", "hex.nrrd", "nifti2.nii", "color.png"])
def test_what_is_not_read_of_a_format_is_an_os_error(name):
    with pytest.raises(OSError, match=f"{name}: "):
        spheretree.volume(SAMPLES / name)


@pytest.mark.parametrize("name", ["i1.npy", "sform.nii", "sform.nii.gz", "gzip.nrrd", "slice_012.png", "s8.pgm"])
def test_a_file_that_is_cut_is_an_os_error(tmp_path, name):
    (tmp_path / name).write_bytes((SAMPLES / name).read_bytes()[:-12])
    for keywords in {}, {"threshold": -1}:
        with pytest.raises(OSError, match=f"{name}: "):
            spheretree.volume(tmp_path / name, **keywords)


def test_other_arrays_are_refused_with_what_is_read(tmp_path):
    for name in "a.npz", "a.tif", "a.mha", "a.gz", "a.jpg":
        (tmp_path / name).write_bytes(b"whatever")
        with pytest.raises(spheretree.InputError, match=f"{name}: volumes are read from .*.npy, .*as arrays"):
            spheretree.volume(tmp_path / name)


@pytest.mark.parametrize("write, name, keywords, read, mask", [
    (write_nii, "bone.nii.gz", {}, [], []),
    (write_nii, "bone.nii.gz", {"threshold": 90, "anisotropy": 0.25}, ["spacing=0.25"], ["-mask", "threshold=90"]),
    (write_nrrd, "bone.nrrd", {"above": 20, "below": 200}, [], ["-mask", "above=20", "below=200"]),
    (write_nrrd, "bone.nrrd", {"threshold": -1}, ["background=-9"], ["-mask", "threshold=-1"])])
def test_trees_have_the_bytes_of_the_commands(bone, tmp_path, command, write, name, keywords, read, mask):
    values = np.random.default_rng(9).integers(0, 250, bone.shape) * bone - 9 * ~bone
    write(tmp_path / name, values)
    command("-read", name, *read, *mask, "-spheretree", "spheres=16,4", "quality=fast", "-write", "theirs.vdb")
    tree = spheretree.build(tmp_path / name, [16, 4], quality="fast", **keywords)
    tree.save(tmp_path / "ours.vdb")
    assert (tmp_path / "ours.vdb").read_bytes() == (tmp_path / "theirs.vdb").read_bytes()
    assert not tree.check(tmp_path / name, **keywords)


@pytest.mark.parametrize("labels", [[0, 1, 3], [0, 3], [3], [0, 1, 2, 3]])
def test_labels_may_be_the_least_value_and_the_largest(tmp_path, monkeypatch, labels):
    values = (np.arange(4 * 5 * 6) % 4).astype(np.uint8).reshape(4, 5, 6)
    np.save(tmp_path / "a.npy", values)
    monkeypatch.setattr(spheretree._spheretree, "value_range_of_file", None)  # it is read once
    wanted = np.isin(values, labels)
    assert np.array_equal(inside(spheretree.volume(tmp_path / "a.npy", label=labels), values.shape), wanted)
    assert np.array_equal(spheretree.volume(values, label=labels).to_array(), wanted)


@pytest.mark.parametrize("labels", [[1], [0], [0, 1]])
def test_bools_have_no_labels(labels):
    with pytest.raises(spheretree.InputError, match="bool.npy: label is for volumes of numbers"):
        spheretree.volume(SAMPLES / "bool.npy", label=labels)


def test_progress_of_a_file_that_is_read_twice_never_falls(monkeypatch):
    read = spheretree._spheretree.volume_of_file

    def read_for_long(path, file, wanted, progress, threads):
        progress(0.1, "Reading volume")
        return read(path, file, wanted, progress, threads)

    monkeypatch.setattr(spheretree._spheretree, "volume_of_file", read_for_long)
    done = []
    spheretree.volume(SAMPLES / "i1.npy", below=45, progress=lambda fraction, stage: done.append(fraction))
    assert done == [0.5, 0.55, 1]


def test_distances_have_the_edges_of_the_file_or_those_that_are_given(tmp_path, bone):
    write_nii(tmp_path / "bone.nii", bone, (0.5, 0.5, 0.5))
    array = spheretree.distance_transform(bone)
    own = tuple(slice(first, first + n) for first, n in
                zip(spheretree.volume(tmp_path / "bone.nii").start, spheretree.volume(tmp_path / "bone.nii").shape))
    assert np.allclose(spheretree.distance_transform(tmp_path / "bone.nii"), 0.5 * array[own])
    assert np.allclose(spheretree.distance_transform(tmp_path / "bone.nii", anisotropy=2), 2 * array[own])
