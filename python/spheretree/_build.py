# SPDX-License-Identifier: Apache-2.0
"""Trees of volumes. The keywords are those of the command's -spheretree, which has the table of them."""

from __future__ import annotations

import inspect
from collections.abc import Sequence
from typing import Any, Literal, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _spheretree
from ._spheretree import InputError
from ._tree import Tree
from ._volume import Axes, Coverage, Number, Numbers, Progress, Units, VolumeLike, part_of, text, thread_count
from ._volume import volume as as_volume

Counts = Union[int, Sequence[int], "npt.NDArray[Any]"]
Given = Optional[tuple[npt.ArrayLike, npt.ArrayLike]]

_OTHER_NAMES = {"pyramid_origin": "origin"}  # where the command's name is taken
_READING = 0.1  # the part of a build that reading the volume is said to take


def _setting(name: str, value: object) -> str:
    """A setting as it is typed on the command line."""
    if isinstance(value, str):
        if not value:
            raise InputError(f"{name} is empty")
        return text(name, value)
    if isinstance(value, (bool, np.bool_)):
        return "1" if value else "0"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, (Sequence, np.ndarray)):
        return ",".join(_setting(name, item) for item in value)
    raise TypeError(f"{name} must not be {type(value).__name__}")


def _count_text(value: Counts) -> str:
    items = list(value) if isinstance(value, (Sequence, np.ndarray)) and np.ndim(value) == 1 else [value]
    for item in items:
        if isinstance(item, (bool, np.bool_)) or not isinstance(item, (int, np.integer)):
            raise TypeError(f"spheres must be a whole number, or several, not {type(item).__name__}")
    if not items:
        raise InputError("spheres names no number")
    return ",".join(str(int(item)) for item in items)


def build(
    volume: VolumeLike,
    spheres: Counts | None = None,
    *,
    # Which voxels
    anisotropy: Numbers | None = None,
    origin: Numbers | None = None,
    axes: Axes = "xyz",
    matrix: npt.ArrayLike | None = None,
    threshold: Number | None = None,
    above: Number | None = None,
    below: Number | None = None,
    label: int | Sequence[int] | None = None,
    iso: Number | None = None,
    coverage: Coverage = "centers",
    largest: bool = False,
    fill: bool = False,
    grid: str | None = None,
    units: Units | None = None,
    voxel: Number | None = None,
    resolution: int | None = None,
    gap: Number | None = None,
    # Which tree
    tree: Literal["tight", "extended", "reversible"] = "tight",
    side: Literal["outer", "inner", "fit"] = "outer",
    dim: Literal[2, 3] | None = None,
    padding: Number | str = "cubes",
    quality: Literal["normal", "fast", "best"] = "normal",
    branching: int = 8,
    error: Number | None = None,
    distance: Number | str | None = None,
    bounds: Literal["stored", "unpadded"] = "stored",
    cover: Literal["voxels", "balls"] = "voxels",
    leaves: Literal["pruned", "medial", "given"] = "pruned",
    given: Given = None,
    strict: bool = False,
    cuts: bool = False,
    dist: str = "l2",
    factor: int = 2,
    model: str = "or",
    pyramid_origin: str | Sequence[int] | None = None,
    center: Literal["medial", "miniball"] = "medial",
    parent: Literal["centre", "dag"] = "centre",
    final_fit: bool = True,
    reconstruct: Literal["clip", "free", "none"] = "clip",
    scale: Literal["tight", "paper"] = "tight",
    dag: bool = False,
    edges: Literal["shared", "intersecting"] = "shared",
    topology: bool = True,
    errors: bool = True,
    like: Tree | None = None,
    name: str = "spheretree",
    memory: int | str = "75%",
    # How
    progress: Progress = None,
    threads: int | None = None,
) -> Tree:
    """The sphere-tree of a volume: levels of ever fewer spheres, each of which covers every voxel.

    The tree is the same, to the last bit, for any number of threads, and that of the command with the same options.

    Parameters
    ----------
    volume
        An array of shape (x, y, z), a path, a grid of pyopenvdb or a `Volume`: see `volume()`, which also has
        anisotropy, origin, axes, matrix, threshold, above, below, label, iso, coverage, largest, fill, grid, units,
        voxel, resolution and gap.
    spheres
        How many spheres levels have, at most, such as ``[512, 64, 8]``. With `error` or `distance` one number, the most
        that these may take. By default levels of 1, `branching`, `branching` squared, ... spheres, and all leaves.
    tree
        ``"tight"``: the least error for a number of spheres. ``"extended"``: spheres contain the leaf balls below them.
        ``"reversible"``: every level rebuilds its own pyramid level.
    side
        Of tight trees. ``"outer"``: spheres cover the object. ``"inner"``: they lie inside it and cover what they can.
        ``"fit"``: the nearest ones, with the fewest voxels in excess or missing.
    dim
        2 for an object one voxel thick along an axis. By default the number of axes of the array.
    padding
        Added to stored radii: ``"cubes"`` covers whole voxels, ``"voxels"`` their centers; or a number of voxels.
    quality
        Of tight trees, how much work goes into placing spheres: ``"fast"``, ``"normal"`` or ``"best"``.
    branching
        Of tight trees, in place of `spheres`.
    error
        Of tight trees: a level of few spheres whose Hamming error, as they are stored, is at most this, in %.
    distance
        The same of their reach out of the object's voxels: in world units, or in voxels, such as ``"2vox"``.
    bounds
        What these two are bounds of: ``"stored"`` spheres, or ``"unpadded"`` ones.
    cover
        Of tight trees, what spheres contain for certain: together every voxel, or each the leaf ``"balls"`` below it.
    leaves, given
        Of tight trees, what level 0 is made of: the medial balls that are needed (``"pruned"``), all (``"medial"``), or
        spheres that are ``"given"``: centers, shape (n, 3), and radii, shape (n,), in world units.
    strict
        With side="inner": spheres lie inside the solid itself, the union of voxel cubes that are wholly in it.
    cuts
        Of tight trees: also keep the spheres of every number of spheres, for `Tree.cut()`.
    dist, factor, model, pyramid_origin, center, parent, scale, dag, edges
        Of extended and reversible trees; ``vdb_spheretree -help spheretree`` explains them. `pyramid_origin` is the
        command's ``origin``.
    final_fit, reconstruct
        Of extended trees.
    topology, errors
        Count parts, tunnels and cavities of every level's voxels; count the errors of every level.
    like
        The tree of the frame before. Spheres keep their `Tree.tracks`; those of a tight tree of named counts start where
        they were. A tree without any tracks has its ids for these.
    name
        Of the tree, and of the grid it is saved in.
    memory
        What the labels of voxels may take while they are computed: bytes, a text such as ``"4GiB"``, or a share of the
        machine's memory. More of them go to a temporary file.
    progress
        Called some times a second with the fraction that is done, 0 to 1, and the name of the stage, by the thread that
        made the call. What it raises stops the work.
    threads
        The most that the work may run on; by default all cores.

    Returns
    -------
    Tree

    Raises
    ------
    InputError
        An argument is wrong, contradicts another, or would change nothing; or there is too little memory for the
        object. It is a ValueError.
    OSError
        A file cannot be read, or is damaged; or a temporary file has no room.
    KeyboardInterrupt
        Ctrl-C, within a second.

    Examples
    --------
    >>> import numpy, spheretree
    >>> x, y, z = numpy.mgrid[-10:11, -10:11, -10:11]
    >>> tree = spheretree.build(x**2 + y**2 + 2 * z**2 < 80, [16, 4, 1], quality="fast")
    >>> tree.levels[-1].centers.round()
    array([[10., 10., 10.]])
    >>> [len(level) for level in tree.levels]
    [16, 4, 1]
    """
    keywords = dict(locals())
    own = as_volume(
        volume, axes=axes, anisotropy=anisotropy, origin=origin, matrix=matrix, threshold=threshold, above=above,
        below=below, label=label, iso=iso, coverage=_coverage(coverage, strict), largest=largest, fill=fill,
        grid=grid, units=units, voxel=voxel, resolution=resolution, gap=gap, progress=part_of(progress, 0, _READING), threads=threads)
    settings = {_OTHER_NAMES.get(key, key): _setting(key, keywords[key])
                for key in _DEFAULTS if keywords[key] != _DEFAULTS[key]}
    if spheres is not None:
        settings["spheres"] = _count_text(spheres)
    if dim is None and own.ndim == 2:
        settings["dim"] = "2"
    if (leaves == "given") != (given is not None):
        raise InputError("leaves=\"given\" and given=(centers, radii) go together")
    return Tree(_spheretree.build(own._handle, settings, bool(errors), _spheres_of(given),
                                  None if like is None else like._handle, part_of(progress, _READING, 1), thread_count(threads)))


def _coverage(coverage: Coverage, strict: bool) -> Any:
    """Spheres inside the solid want voxels that are wholly in it, where there is a solid between voxels."""
    return "strict" if strict and coverage == "centers" else coverage


def _spheres_of(given: Given) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]] | None:
    if given is None:
        return None
    centers, radii = given
    return (np.ascontiguousarray(centers, dtype=np.float64), np.ascontiguousarray(radii, dtype=np.float64))


def _defaults() -> dict[str, Any]:
    """The keywords that are settings of the tree, but `spheres`."""
    parameters = inspect.signature(build).parameters
    others = {"given", "errors", "like", "progress", "threads"}
    names = list(parameters)
    return {key: parameters[key].default for key in names[names.index("tree"):] if key not in others}


_DEFAULTS = _defaults()
