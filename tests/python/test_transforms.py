# SPDX-License-Identifier: Apache-2.0
"""Distances, medial balls and pyramids against scipy and plain loops."""
import numpy as np
import pytest
import spheretree
from conftest import ball, write_vol


def padded(array):
    return np.pad(array, 1)


def inner(array):
    return array[(slice(1, -1),) * array.ndim]


@pytest.mark.parametrize("shape", [(7, 9, 11), (1, 1, 1), (8, 8, 8), (30, 4, 17), (13, 21)])
def test_distances_are_those_of_scipy(shape):
    ndimage = pytest.importorskip("scipy.ndimage")
    volume = np.random.default_rng(2).random(shape) < 0.9
    volume[(0,) * volume.ndim] = True
    expected = inner(ndimage.distance_transform_edt(padded(volume)))
    squared = spheretree.distance_transform(volume, squared=True)
    assert squared.dtype == np.int32 and squared.shape == shape
    assert np.array_equal(squared, np.rint(expected**2).astype(np.int32))
    assert np.array_equal(spheretree.distance_transform(volume), expected.astype(np.float32))
    assert np.allclose(spheretree.distance_transform(volume, 0.25), 0.25 * expected)


def test_distances_have_the_axes_of_the_array(bone):
    expected = spheretree.distance_transform(bone, squared=True)
    turned = spheretree.distance_transform(bone.transpose(2, 1, 0), axes="zyx", squared=True)
    assert np.array_equal(turned.transpose(2, 1, 0), expected)
    fortran = spheretree.distance_transform(np.asfortranarray(bone), squared=True)
    assert np.array_equal(fortran, expected)


def test_distances_of_one_label():
    labels = np.zeros((6, 6, 6), np.uint8)
    labels[1:4] = 3
    labels[4:] = 5
    assert np.array_equal(spheretree.distance_transform(labels, label=3), spheretree.distance_transform(labels == 3))


def test_without_a_black_border_the_object_must_not_touch_it(bone):
    assert np.array_equal(spheretree.distance_transform(bone, None, False), spheretree.distance_transform(bone))
    with pytest.raises(spheretree.InputError, match="touches the border"):
        spheretree.distance_transform(np.ones((3, 3, 3)), black_border=False)


def test_distances_in_voxels_that_are_no_cubes_are_refused(bone):
    with pytest.raises(spheretree.InputError, match="cubes only"):
        spheretree.distance_transform(bone, (1, 1, 2))
    with pytest.raises(spheretree.InputError, match="squared"):
        spheretree.distance_transform(bone, 2, squared=True)
    with pytest.raises(spheretree.InputError, match="dim=4"):
        spheretree.distance_transform(bone, dim=4)


def test_distances_in_voxels_that_were_made_cubes(bone):
    volume = spheretree.volume(bone, anisotropy=(0.5, 0.5, 1))
    cubes = volume.to_array()
    assert volume.voxel_size == 0.5 and cubes.shape[2] > bone.shape[2]
    assert np.array_equal(spheretree.distance_transform(volume), spheretree.distance_transform(cubes, 0.5))


def test_distances_of_a_file_fill_the_box_of_its_object(bone, tmp_path):
    write_vol(tmp_path / "bone.vol", bone)
    volume = spheretree.volume(tmp_path / "bone.vol")
    box = tuple(slice(b, b + n) for b, n in zip(volume.start, volume.shape))
    assert np.array_equal(spheretree.distance_transform(volume), spheretree.distance_transform(bone)[box])


@pytest.mark.parametrize("flat", [False, True])
@pytest.mark.parametrize("axes", ["xyz", "zyx"])
def test_medial_balls_rebuild_the_object(bone, flat, axes):
    volume = bone[:, :, 8] if flat else bone
    points, radii_sq = spheretree.medial_axis(volume, axes=axes)
    assert points.dtype == np.int32 and points.shape == (len(radii_sq), volume.ndim)
    rebuilt = np.zeros(volume.shape, bool)
    grid = np.indices(volume.shape)
    for point, radius_sq in zip(points, radii_sq):
        rebuilt |= sum((g - p) ** 2 for g, p in zip(grid, point)) < radius_sq
    assert np.array_equal(rebuilt, volume)
    distances = spheretree.distance_transform(volume, squared=True, axes=axes)
    assert np.array_equal(distances[tuple(points.T)], radii_sq)


@pytest.mark.parametrize("factor", [2, 3])
def test_pyramids_are_those_of_plain_blocks(bone, factor):
    levels = spheretree.pyramid(bone, factor)
    expected = bone
    for level in levels:
        rows = level.coordinates()
        assert level.voxels == expected.sum() == len(rows)
        assert np.array_equal(np.sort(rows, axis=0), np.sort(np.argwhere(expected), axis=0))
        shape = [-(-n // factor) for n in expected.shape]
        grown = np.zeros([n * factor for n in shape], bool)
        grown[tuple(map(slice, expected.shape))] = expected
        blocks = grown.reshape(shape[0], factor, shape[1], factor, shape[2], factor)
        expected = blocks.any(axis=(1, 3, 5))
    assert levels[-1].voxels == 1


def test_levels_of_a_pyramid_lie_where_their_voxels_are():
    block = np.zeros((16, 16, 16), bool)
    block[4:12, 4:12, 4:12] = True
    for k, level in enumerate(spheretree.pyramid(block, anisotropy=0.5, origin=(1, 0, 0))):
        assert level.voxel_size == 0.5 * 2**k
        if level.voxels > 1:
            center = level.matrix @ [*level.coordinates().mean(axis=0), 1]
            assert np.allclose(center[:3], (1 + 3.75, 3.75, 3.75))


def test_what_is_made_of_a_flat_array_is_flat():
    disc = ball(6, (1, 1))
    levels = spheretree.pyramid(disc)
    assert [level.ndim for level in levels] == [2] * len(levels) and levels[0].shape == disc.shape
    assert levels[1].to_array().ndim == 2
