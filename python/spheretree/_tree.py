# SPDX-License-Identifier: Apache-2.0
"""Sphere-trees as arrays, and their files."""

from __future__ import annotations

import functools
import json
import os
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _spheretree
from ._query import Query
from ._volume import Progress, VolumeLike, is_mesh_file, readable, system_path, text, thread_count, unit_of_length, whole_number
from ._volume import volume as as_volume


@dataclass(frozen=True, eq=False)
class Level:
    """The spheres of one level of a tree. All arrays are views of the tree's, and read-only.

    Row i of each array is the sphere with the id ``ids[i]``.
    """

    level: int
    """Its number: 0 is the finest."""
    centers: npt.NDArray[np.float64]
    """World space: shape (n, 3)."""
    radii: npt.NDArray[np.float32]
    """World units, padding included: shape (n,)."""
    parents: npt.NDArray[np.int32]
    """Ids of spheres of the next level, or -1 at the top: shape (n,)."""
    ids: npt.NDArray[np.int32]
    """Indices into the arrays of the tree: shape (n,)."""
    errors: dict[str, Any]
    """How far the level is from the object, in the words of -stats: ``hamming_percent``, ``stored_reach`` ...; None
    where it was not counted."""
    topology: dict[str, int] | None
    """``components``, ``tunnels`` and ``cavities`` of the level's voxels, where they were counted."""

    def __len__(self) -> int:
        return len(self.radii)

    def __repr__(self) -> str:
        return f"<spheretree.Level {self.level}: {len(self):,} spheres>"


class Fault(NamedTuple):
    """What a tree was found to break."""

    kind: str
    """Such as "coverage" or "links"."""
    sentence: str
    """What is wrong, and the first offender."""


class Tree:
    """A sphere-tree. `build()` and `load()` make them; they never change.

    Spheres are ordered from the top level to level 0, and the index of a sphere is its id: a parent stands before its
    children. Arrays are read-only views, and keep the tree alive. Trees can be pickled.
    """

    __slots__ = ("_handle", "__dict__", "__weakref__")

    def __init__(self, handle: _spheretree.Tree) -> None:
        if not isinstance(handle, _spheretree.Tree):
            raise TypeError("spheretree.build() and spheretree.load() make trees")
        self._handle = handle

    @property
    def centers(self) -> npt.NDArray[np.float64]:
        """World space: shape (n, 3)."""
        return self._handle.centers

    @property
    def radii(self) -> npt.NDArray[np.float32]:
        """World units, padding included, rounded so that what spheres cover stays covered: shape (n,)."""
        return self._handle.radii

    @property
    def parents(self) -> npt.NDArray[np.int32]:
        """The id of each sphere's parent, or -1: shape (n,)."""
        return self._handle.parents

    @property
    def tracks(self) -> npt.NDArray[np.int32]:
        """What each sphere is called in all frames of a sequence, of a tree built with `like`: shape (n,); else empty."""
        return self._handle.tracks

    @property
    def ijk(self) -> npt.NDArray[np.int32]:
        """The center voxel of each digital ball, x, y, z in the grid of its level: shape (n, 3)."""
        return self._handle.ijk

    @property
    def radii_sq(self) -> npt.NDArray[np.int32]:
        """The squared radius of each digital ball, in voxels of its level, or -1 for a sphere that is none: (n,)."""
        return self._handle.radii_sq

    @property
    def edges(self) -> npt.NDArray[np.int32]:
        """The edges of the Sphere-DAG, with dag=True: pairs of ids (parent, child), shape (edges, 2)."""
        return self._handle.edges

    @functools.cached_property
    def levels(self) -> tuple[Level, ...]:
        """The levels, the finest first."""
        ids = np.arange(len(self), dtype=np.int32)
        ids.setflags(write=False)
        centers, radii, parents = self.centers, self.radii, self.parents
        levels = []
        for about in self._about["levels"]:
            own = slice(about["begin"], about["end"])
            levels.append(Level(about["level"], centers[own], radii[own], parents[own], ids[own], about["errors"],
                                about["topology"]))
        return tuple(levels)

    @property
    def errors(self) -> list[dict[str, Any]]:
        """`Level.errors` of all levels, the finest first."""
        return [level.errors for level in self.levels]

    @property
    def settings(self) -> dict[str, Any]:
        """What the tree was built with, by the names of the command's options."""
        return dict(self._about["settings"])

    @property
    def object(self) -> dict[str, Any]:
        """What the tree was built over: its name, voxels, bounding box and so on."""
        return dict(self._about["object"])

    @property
    def name(self) -> str:
        """Of the tree, and of the grid it is stored in."""
        return str(self._about["name"])

    @property
    def matrix(self) -> npt.NDArray[np.float64]:
        """Index (x, y, z, 1) to world space: shape (4, 4), for columns."""
        return self._handle.matrix

    def level(self, level: int) -> Tree:
        """One level as a tree of its own, with ids from 0."""
        return Tree(self._handle.level(whole_number("level", level, 32)))

    def cut(self, spheres: int) -> Tree:
        """The tree of one level with at most so many spheres, of a tree that was built with cuts=True."""
        return Tree(self._handle.cut(whole_number("spheres", spheres, 64)))

    def query(self, *, exact: bool = False, level: int | None = None, scale: float = 1) -> Query:
        """The tree made ready for questions: collision, distance, points, rays.

        Parameters
        ----------
        exact
            Answers are exactly those of the leaf spheres, for any tree; else of a tight tree with cover="voxels" they
            are nearer to the voxels themselves, and faster.
        level
            Whose spheres are asked; by default those of the finest level.
        scale
            The tree is larger by this factor, about the origin of the world.

        Raises
        ------
        InputError
            The tree has no answers: it is of a norm, of side="fit", or reversible without `exact`.

        Examples
        --------
        >>> import numpy, spheretree
        >>> spheretree.build(numpy.ones((8, 8, 8), dtype=bool), [8, 1]).query()
        <spheretree.Query of 8 spheres>
        """
        return Query(self, exact, level, scale)

    def save(self, path: str | os.PathLike[str], *, progress: Progress = None) -> None:
        """Write the tree to a file; its extension says how.

        The file is there whole or as it was before, and its bytes are those that the command writes.

        Parameters
        ----------
        path
            `.vdb`: points of OpenVDB, which `load()` reads without loss. `.csv`: a row a sphere; the edges of a
            Sphere-DAG go to `NAME_dag.csv`. `.json`: everything, as text.
        progress
            As for `build()`.

        Raises
        ------
        InputError
            The extension is of no kind that trees are saved as.
        OSError
            The file cannot be written.
        """
        _spheretree.save(self._handle, system_path(path), progress)

    def export(self, path: str | os.PathLike[str], **options: Any) -> None:
        """`spheretree.export()` of this tree: the files of other tools.

        >>> import numpy, spheretree
        >>> spheretree.build(numpy.ones((9, 9, 9), bool), spheres=8, quality="fast").export("cube.ply")
        """
        from ._export import export  # which knows trees

        export(self, path, **options)

    def write_html(
        self, path: str | os.PathLike[str], volume: VolumeLike | None = None, *, triangles: int = 200000,
        progress: Progress = None,
    ) -> None:
        """Write one page that shows the tree in a browser, and needs nothing else: no network, no library.

        The file is there whole or as it was before, and its bytes are those that the command writes.

        Parameters
        ----------
        path
            `.html` or `.htm`.
        volume
            What the tree was built over: its surface is shown, too. Where that took keywords, as of meshes, it is the
            `volume()` that was made with them.
        triangles
            The most that the surface has. It is made of blocks of voxels where it would have more; 0: there is none.
        progress
            As for `build()`.

        Raises
        ------
        InputError
            The name is not that of a page, the volume is not that of the tree, or there are more spheres than browsers
            show in good time.
        OSError
            The file cannot be written.

        Examples
        --------
        >>> import numpy, spheretree
        >>> cube = numpy.ones((8, 8, 8), dtype=bool)
        >>> spheretree.build(cube, [8, 1]).write_html("cube.html", cube)
        """
        own = None if volume is None else as_volume(volume)._handle
        _spheretree.write_html(self._handle, system_path(path), own, whole_number("triangles", triangles, 64), progress)

    def check(self, volume: VolumeLike, **keywords: Any) -> list[Fault]:
        """`check()` of this tree."""
        return check(self, volume, **keywords)

    def check_mesh(self, path: str | os.PathLike[str], volume: VolumeLike | None = None, **keywords: Any) -> list[Fault]:
        """`check_mesh()` of this tree."""
        return check_mesh(self, path, volume, **keywords)

    @functools.cached_property
    def _about(self) -> dict[str, Any]:
        about: dict[str, Any] = json.loads(self._handle.description)
        return about

    def __len__(self) -> int:
        return len(self._handle.radii)

    def __repr__(self) -> str:
        counts = ", ".join(f"{len(level):,}" for level in self.levels)
        return f"<spheretree.Tree {self.name!r}: {counts} spheres on {len(self.levels)} levels>"

    def __reduce__(self) -> tuple[Any, ...]:
        return _tree_of_bytes, (_spheretree.bytes_of_tree(self._handle),)


def _tree_of_bytes(stored: bytes) -> Tree:
    return Tree(_spheretree.tree_of_bytes(stored))


def load(path: str | os.PathLike[str], name: str | None = None, *, progress: Progress = None) -> Tree:
    """The sphere-tree of a `.vdb` that the command or `Tree.save()` wrote, without loss.

    Parameters
    ----------
    path
        The file. Damage is found by its checksum.
    name
        Which tree, of a file that holds several.
    progress
        As for `build()`.

    Raises
    ------
    InputError
        The file holds no such tree, or is a `.csv` or `.json`, which hold less than a tree.
    OSError
        The file cannot be read, or is damaged.

    Examples
    --------
    >>> import numpy, spheretree
    >>> tree = spheretree.build(numpy.ones((8, 8, 8), dtype=bool), [8, 1])
    >>> tree.save("cube.vdb")
    >>> spheretree.load("cube.vdb")
    <spheretree.Tree 'spheretree': 8, 1 spheres on 2 levels>
    """
    return Tree(_spheretree.load(readable(path), "" if name is None else text("name", name), progress))


def read_points(path: str | os.PathLike[str], *, progress: Progress = None) -> dict[str, dict[str, Any]]:
    """All point grids of a `.vdb`, whoever wrote it: name of the grid -> name of the attribute -> array.

    `P` is the place of points in world space: float64, shape (n, 3). Other attributes have the type that they are
    stored as, and shape (n,), (n, 3) for vectors, (n, 4) for quaternions (x, y, z, w), (n, 3, 3) or (n, 4, 4) for
    matrices; strings are a list. Groups are arrays of bool under the name `group:NAME`. All arrays of a grid are in
    the same order, that of the file.

    Raises
    ------
    OSError
        The file cannot be read, or is damaged.

    Examples
    --------
    >>> import numpy, spheretree
    >>> spheretree.build(numpy.ones((8, 8, 8), dtype=bool), [8, 1]).save("cube.vdb")
    >>> points = spheretree.read_points("cube.vdb")["spheretree"]
    >>> points["P"].shape, points["pscale"].dtype, points["group:level_0"].sum()
    ((9, 3), dtype('float32'), 8)
    """
    return _spheretree.read_points(readable(path), progress)


def check(
    tree: Tree, volume: VolumeLike, *, progress: Progress = None, threads: int | None = None, **keywords: Any
) -> list[Fault]:
    """Whether a tree keeps all that it promises, recounted from the volume that it was built over.

    Parameters
    ----------
    tree
        Any tree, built or loaded.
    volume
        As for `build()`, and so are further keywords.
    progress, threads
        As for `build()`.

    Returns
    -------
    list of Fault
        What is wrong; empty if all holds. It takes longer than building the tree.

    Examples
    --------
    >>> import numpy, spheretree
    >>> cube = numpy.ones((8, 8, 8), dtype=bool)
    >>> spheretree.check(spheretree.build(cube, [8, 1]), cube)
    []
    """
    _require_tree(tree)
    own = as_volume(volume, threads=threads, **keywords)
    return _faults(_spheretree.check(tree._handle, own._handle, progress, thread_count(threads)))


def check_mesh(
    tree: Tree, path: str | os.PathLike[str], volume: VolumeLike | None = None, *, units: str | None = None,
    progress: Progress = None, threads: int | None = None, **keywords: Any,
) -> list[Fault]:
    """Whether every point of every triangle of a mesh lies in the stored spheres of a tree, on every level.

    Parameters
    ----------
    tree
        Any tree, built or loaded, but those inside the object.
    path
        A mesh file, as for `volume()`.
    volume
        What the tree was built over, and further keywords, as for `build()`. Then all of `check()` is made first, and
        voxel cubes count that spheres are known to hold. Without it spheres must hold the triangles by themselves.
    units
        That the file is in, such as ``"mm"``: its points become metres; and so do those of a volume that is a mesh
        file, too.
    progress, threads
        As for `build()`.

    Returns
    -------
    list of Fault
        A level that leaves some of the mesh uncovered, with how much and where, and what `check()` finds; empty if there
        is nothing, which is a proof.
    """
    _require_tree(tree)
    own = None
    if volume is not None:
        if units is not None and is_mesh_file(volume):
            keywords = {"units": units, **keywords}
        own = as_volume(volume, threads=threads, **keywords)
    elif keywords:
        raise TypeError(f"{next(iter(keywords))} is of a volume, and there is none")
    unit = "" if units is None else unit_of_length(units)
    handle = None if own is None else own._handle
    return _faults(_spheretree.check_mesh(tree._handle, readable(path), unit, handle, progress, thread_count(threads)))


def _require_tree(tree: object) -> None:
    if not isinstance(tree, Tree):
        raise TypeError(f"tree must be a spheretree.Tree, not {type(tree).__name__}")


def _faults(pairs: list[tuple[str, str]]) -> list[Fault]:
    return [Fault(kind, sentence) for kind, sentence in pairs]
