# SPDX-License-Identifier: Apache-2.0
"""What trees are made of: distances, medial balls, pyramids. All of it is exact."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from . import _spheretree
from ._spheretree import InputError
from ._volume import Numbers, Progress, Volume, VolumeLike, _vector, is_array_file, part_of, thread_count
from ._volume import volume as as_volume

_READING = 0.2  # the part of the work that reading the volume is said to take


def _dim(volume: Volume, dim: int | None) -> int:
    if dim is None:
        return volume.ndim
    if dim not in (2, 3):
        raise InputError(f"dim={dim} is out of range: it must be 2 or 3")
    return dim


def _touches_border(volume: Volume) -> bool:
    places = volume.coordinates() - np.array(volume.start)
    return bool((places == 0).any() or (places == np.array(volume.shape) - 1).any())


def distance_transform(
    volume: VolumeLike,
    anisotropy: Numbers | None = None,
    black_border: bool = True,
    *,
    squared: bool = False,
    dim: int | None = None,
    progress: Progress = None,
    threads: int | None = None,
    **keywords: Any,
) -> npt.NDArray[Any]:
    """The Euclidean distance of every voxel of the object to the nearest voxel outside, between centers.

    As ``edt.edt()`` and ``scipy.ndimage.distance_transform_edt()`` have it, but for one object (choose it by `label`),
    and exact: squared distances are integers.

    Parameters
    ----------
    volume
        As for `build()`, and so are further keywords: threshold, label, axes ...
    anisotropy
        The edge of a voxel in world units; edges must be equal, since distances are counted in voxels.
    black_border
        All beyond the array is outside, as in edt with black_border=True. With False the object must not touch the
        border: then it makes no difference.
    squared
        Squared distances in voxels, as exact int32, in place of float32 distances in world units.
    dim
        2 leaves out the axis along which the object is one voxel thick.
    progress, threads
        As for `build()`.

    Returns
    -------
    array of `Volume.shape`
        0 outside.

    Examples
    --------
    >>> import numpy, spheretree
    >>> spheretree.distance_transform(numpy.ones((3, 5), dtype=bool), squared=True)
    array([[1, 1, 1, 1, 1],
           [1, 4, 4, 4, 1],
           [1, 1, 1, 1, 1]], dtype=int32)
    """
    edge = 1.0
    if anisotropy is not None:
        edges = _vector("anisotropy", anisotropy, volume.ndim if isinstance(volume, np.ndarray) else 3)
        edge = edges[0]
        if min(edges) != max(edges) or not edge > 0:
            raise InputError(f"anisotropy={anisotropy}: the transform is exact for cubes only, so all edges must be equal "
                             "and above 0; spheretree.volume() resamples others")
    if squared and edge != 1:
        raise InputError("squared distances are exact integers, in voxels: leave anisotropy out")
    if is_array_file(volume):  # whose own edges the volume replaces by these
        keywords["anisotropy"], edge = anisotropy, 1.0
    own = as_volume(volume, progress=part_of(progress, 0, _READING), threads=threads, **keywords)
    if not black_border and _touches_border(own):
        raise InputError("black_border=False: the object touches the border of the volume, and what is beyond counts as "
                         "outside here; pad it by numpy.pad(volume, ..., mode=\"edge\")")
    if not isinstance(volume, np.ndarray):
        edge *= own.voxel_size
    return _spheretree.distance_transform(own._handle, _dim(own, dim), 0.0 if squared else edge,
                                          part_of(progress, _READING, 1), thread_count(threads))


def medial_axis(
    volume: VolumeLike, *, dim: int | None = None, progress: Progress = None, threads: int | None = None, **keywords: Any
) -> tuple[npt.NDArray[np.int32], npt.NDArray[np.int32]]:
    """The medial balls of the object: the fewest of the largest balls in it that rebuild it, voxel by voxel.

    The reduced discrete medial axis of Coeurjolly and Montanvert (IEEE PAMI 2007). Ball i holds the voxels q with
    ``|q - points[i]|**2 < radii_sq[i]``.

    Parameters
    ----------
    volume
        As for `build()`, and so are further keywords.
    dim, progress, threads
        As for `distance_transform()`.

    Returns
    -------
    points
        Indices of voxels in the order of the array's axes: int32, shape (n, 3), or (n, 2) for two axes.
    radii_sq
        Squared radii in voxels: int32, shape (n,).

    Examples
    --------
    >>> import numpy, spheretree
    >>> spheretree.medial_axis(numpy.ones((3, 5), dtype=bool))
    (array([[1, 1],
           [1, 2],
           [1, 3]], dtype=int32), array([4, 4, 4], dtype=int32))
    """
    own = as_volume(volume, progress=part_of(progress, 0, _READING), threads=threads, **keywords)
    return _spheretree.medial_axis(own._handle, _dim(own, dim), part_of(progress, _READING, 1), thread_count(threads))


def pyramid(
    volume: VolumeLike,
    factor: int = 2,
    *,
    dim: int | None = None,
    progress: Progress = None,
    threads: int | None = None,
    **keywords: Any,
) -> list[Volume]:
    """The volumes of ever larger voxels: one is on where any of its factor**dim voxels below is.

    Parameters
    ----------
    volume
        As for `build()`, and so are further keywords.
    factor
        Voxels of a level along a voxel of the next.
    dim, progress, threads
        As for `distance_transform()`.

    Returns
    -------
    list of Volume
        The volume itself first, a single voxel last. Each has indices and a place (`Volume.matrix`) of its own.

    Examples
    --------
    >>> import numpy, spheretree
    >>> [level.voxels for level in spheretree.pyramid(numpy.ones((5, 3), dtype=bool))]
    [15, 6, 2, 1]
    """
    own = as_volume(volume, progress=part_of(progress, 0, _READING), threads=threads, **keywords)
    levels = _spheretree.pyramid(own._handle, factor, _dim(own, dim), part_of(progress, _READING, 1), thread_count(threads))
    return [Volume(level) for level in levels]
