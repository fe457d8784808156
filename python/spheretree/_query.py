# SPDX-License-Identifier: Apache-2.0
"""Questions to trees, in batches."""

from __future__ import annotations

from enum import IntEnum
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _spheretree
from ._spheretree import InputError
from ._volume import Progress, real_array, real_number, thread_count, whole_number

if TYPE_CHECKING:
    from ._tree import Tree


class Verdict(IntEnum):
    """What `Collisions` say of two trees, as numbers."""

    APART = -1
    UNDECIDED = 0
    TOUCHING = 1


class Collisions(NamedTuple):
    """Whether two trees touch, for each pose. Where they do not, numbers are NaN and ids -1.

    Attributes
    ----------
    spheres
        `Verdict.TOUCHING` (1) where leaf spheres touch, `APART` (-1) where they do not. Ask `touching` for truth.
    objects
        The same of the voxels themselves: `UNDECIDED` (0) where spheres cannot know, or were not asked to search on.
    distance
        Of the two spheres that were found: negative is how deep they meet.
    points
        The middle between them: shape (..., 3).
    normals
        From the first tree's sphere to the second's, of length 1: shape (..., 3).
    ids
        Of both spheres in their trees: shape (..., 2).
    """

    spheres: npt.NDArray[np.int8]
    objects: npt.NDArray[np.int8]
    distance: npt.NDArray[np.float64]
    points: npt.NDArray[np.float64]
    normals: npt.NDArray[np.float64]
    ids: npt.NDArray[np.int32]

    @property
    def touching(self) -> npt.NDArray[np.bool_]:
        """Whether leaf spheres touch. Where not, the voxels do not either."""
        touching: npt.NDArray[np.bool_] = self.spheres == Verdict.TOUCHING
        return touching

    def __repr__(self) -> str:
        return f"<spheretree.Collisions of shape {self.spheres.shape}: {np.count_nonzero(self.touching)} touching>"


class Contacts(NamedTuple):
    """Pairs of spheres of two trees that touch: a row each, by poses, and of a pose the deepest first.

    Attributes
    ----------
    pose
        Of which pose it is: its index, counted as numpy flattens them. Shape (n,).
    distance
        Of the two spheres: negative is how deep they meet.
    points
        The middle between them: shape (n, 3).
    normals
        From the first tree's sphere to the second's, of length 1: shape (n, 3).
    ids
        Of both spheres in their trees: shape (n, 2).
    """

    pose: npt.NDArray[np.int64]
    distance: npt.NDArray[np.float64]
    points: npt.NDArray[np.float64]
    normals: npt.NDArray[np.float64]
    ids: npt.NDArray[np.int32]

    def __repr__(self) -> str:
        return f"<spheretree.Contacts: {len(self.pose)} of {len(np.unique(self.pose))} poses>"


class FirstContacts(NamedTuple):
    """When two trees first touch, for each motion. Where they do not, numbers are NaN and ids -1.

    Attributes
    ----------
    time
        From 0 to 1 along the way. No voxels of the two meet before.
    distance
        Of the two spheres that meet, at that time.
    points
        The middle between them: shape (..., 3).
    normals
        From the first tree's sphere to the second's, of length 1: shape (..., 3).
    ids
        Of both spheres in their trees: shape (..., 2).
    """

    time: npt.NDArray[np.float64]
    distance: npt.NDArray[np.float64]
    points: npt.NDArray[np.float64]
    normals: npt.NDArray[np.float64]
    ids: npt.NDArray[np.int32]

    def __repr__(self) -> str:
        return f"<spheretree.FirstContacts of shape {self.time.shape}: {np.isfinite(self.time).sum()} meet>"


class Distances(NamedTuple):
    """How far two trees are apart, for each pose. Where nothing is near enough, points are NaN and ids -1.

    Attributes
    ----------
    distance
        Of the nearest leaf spheres; infinite where nothing is within `upto`.
    lower
        The voxels themselves are no nearer.
    upper
        The voxels themselves are no farther.
    points_a
        Where the first tree's sphere is nearest to the second's: shape (..., 3).
    points_b
        And the other way round.
    ids
        Of both spheres in their trees: shape (..., 2).
    """

    distance: npt.NDArray[np.float64]
    lower: npt.NDArray[np.float64]
    upper: npt.NDArray[np.float64]
    points_a: npt.NDArray[np.float64]
    points_b: npt.NDArray[np.float64]
    ids: npt.NDArray[np.int32]

    def __repr__(self) -> str:
        least = f": {self.distance.min():.6g} at least" if self.distance.size else ""
        return f"<spheretree.Distances of shape {self.distance.shape}{least}>"


class Nearest(NamedTuple):
    """The leaf sphere nearest to each point, or to each sphere.

    Attributes
    ----------
    distance
        Negative inside; the cut-off where nothing is nearer.
    gradients
        In which direction the distance grows fastest, of length 1: shape (..., 3); 0 where nothing is nearer.
    ids
        Of the spheres in the tree, or -1.
    """

    distance: npt.NDArray[Any]
    gradients: npt.NDArray[Any]
    ids: npt.NDArray[np.int32]

    def __repr__(self) -> str:
        return f"<spheretree.Nearest of shape {self.ids.shape}: {np.count_nonzero(self.ids >= 0)} found>"


class Hits(NamedTuple):
    """Where rays enter the leaf spheres.

    Attributes
    ----------
    t
        Counted by the length of the direction; infinite without a hit.
    ids
        Of the spheres in the tree, or -1.
    """

    t: npt.NDArray[np.float64]
    ids: npt.NDArray[np.int32]

    def __repr__(self) -> str:
        return f"<spheretree.Hits of shape {self.ids.shape}: {np.count_nonzero(self.ids >= 0)} hit>"


def rows_of(name: str, values: npt.ArrayLike, columns: tuple[int, ...], dtype: Any = np.float64) -> tuple[Any, Any]:
    """The values as rows that C++ takes, and the shape in front of the columns."""
    array = np.ascontiguousarray(real_array(name, values), dtype=dtype)
    if array.shape[array.ndim - len(columns):] != columns or array.ndim < len(columns):
        wanted = ", ".join(["...", *map(str, columns)])
        raise InputError(f"{name} has shape {array.shape}: it takes ({wanted})")
    return array.reshape(-1, int(np.prod(columns))), array.shape[: array.ndim - len(columns)]


def _bound(name: str, value: object) -> float:
    """A number from 0 on, infinity too."""
    number = real_number(name, value)
    if not number >= 0:
        raise InputError(f"{name}={value} is out of range: it takes numbers from 0 on")
    return number


MOST_CONTACTS = 1_000_000  # as of the command


def contact_count(contacts: int) -> int:
    if not 1 <= whole_number("max_contacts", contacts, 64) <= MOST_CONTACTS:
        raise InputError(f"max_contacts={contacts} is out of range: it takes 1 to {MOST_CONTACTS}")
    return int(contacts)


def broadcast_rows(given: dict[str, tuple[Any, tuple[int, ...]]], each: int = 1) -> dict[str, Any]:
    """Rows of 16 numbers, `each` for every place of the shape in front of them, with all shapes broadcast to one."""
    try:
        shape = np.broadcast_shapes(*(front for _, front in given.values()))
    except ValueError:
        told = ", ".join(f"{name} {front}" for name, (_, front) in given.items())
        raise InputError(f"shapes in front of the poses cannot be broadcast: {told}") from None
    return {name: np.ascontiguousarray(np.broadcast_to(rows.reshape(*front, each, 16), (*shape, each, 16))).reshape(-1, 16)
            for name, (rows, front) in given.items()}


def _shaped(shape: tuple[int, ...], arrays: tuple[Any, ...]) -> list[Any]:
    return [array.reshape(shape + array.shape[1:]) for array in arrays]


def _require_query(other: object) -> None:
    if not isinstance(other, Query):
        raise TypeError(f"other must be a spheretree.Query, not {type(other).__name__}")


class Query:
    """A tree made ready for questions: `Tree.query()` makes it. It never changes, and threads may share it.

    Answers are certain of the voxels themselves, in one direction: what is said to be apart, outside or not hit is so.
    docs/queries.md has what holds for which tree, and why. All lengths are in world units.
    """

    __slots__ = ("_handle", "tree")

    def __init__(self, tree: Tree, exact: bool, level: int | None, scale: float) -> None:
        if level is not None and whole_number("level", level, 32) < 0:
            raise InputError(f"level={level}: levels are counted from 0, the finest")
        self.tree = tree
        self._handle = _spheretree.make_query(tree._handle, bool(exact), -1 if level is None else level, float(scale))

    def __repr__(self) -> str:
        return f"<spheretree.Query of {self._handle.leaf_count:,} spheres>"

    def _pair(self, other: Query, pose: npt.ArrayLike | None) -> tuple[Any, Any]:
        _require_query(other)
        return rows_of("pose", np.eye(4) if pose is None else pose, (4, 4))

    def collide(
        self, other: Query, pose: npt.ArrayLike | None = None, *, margin: float = 0, objects: bool = False,
        progress: Progress = None, threads: int | None = None,
    ) -> Collisions:
        """Whether two trees touch, and where.

        Parameters
        ----------
        other
            The tree that is moved.
        pose
            Where it is in the world of this one: a rigid 4 x 4 matrix for columns, or many of them, shape
            (..., 4, 4). All answers have the shape in front.
        margin
            Spheres nearer than this touch.
        objects
            Search on until it is known whether the voxels themselves touch, or no spheres can know.
        progress, threads
            As for `build()`.

        Examples
        --------
        >>> import numpy, spheretree
        >>> cube = spheretree.build(numpy.ones((8, 8, 8), dtype=bool), quality="fast").query()
        >>> poses = numpy.tile(numpy.eye(4), (3, 1, 1))
        >>> poses[:, 0, 3] = [2, 9, 20]
        >>> cube.collide(cube, poses).spheres
        array([ 1,  1, -1], dtype=int8)
        """
        poses, shape = self._pair(other, pose)
        answers = self._handle.collide(
            other._handle, poses, real_number("margin", margin), bool(objects), progress, thread_count(threads))
        return Collisions(*_shaped(shape, answers))

    def contacts(
        self, other: Query, pose: npt.ArrayLike | None = None, *, max_contacts: int = 10, margin: float = 0,
        progress: Progress = None, threads: int | None = None,
    ) -> Contacts:
        """The deepest pairs of spheres of two trees that touch.

        Spheres that reach beyond those above them, where no object is, are found by `query(exact=True)` alone.

        Parameters
        ----------
        other, pose, margin, progress, threads
            As for `collide()`.
        max_contacts
            So many of a pose, at most.

        Examples
        --------
        >>> import numpy, spheretree
        >>> cube = spheretree.build(numpy.ones((8, 8, 8), dtype=bool), quality="fast").query(exact=True)
        >>> poses = numpy.tile(numpy.eye(4), (3, 1, 1))
        >>> poses[:, 0, 3] = [2, 20, 4]
        >>> found = cube.contacts(cube, poses, max_contacts=2)
        >>> found.pose, bool(found.distance[0] <= found.distance[1] < 0)
        (array([0, 0, 2, 2]), True)
        """
        poses, _ = self._pair(other, pose)
        answers = self._handle.contacts(
            other._handle, poses, contact_count(max_contacts), real_number("margin", margin), progress, thread_count(threads))
        return Contacts(*answers)

    def continuous_collide(
        self, other: Query, start: npt.ArrayLike, end: npt.ArrayLike, *, own_start: npt.ArrayLike | None = None,
        own_end: npt.ArrayLike | None = None, margin: float = 0, tolerance: float = 0,
        progress: Progress = None, threads: int | None = None,
    ) -> FirstContacts:
        """When two trees first touch, as one or both move. Nothing is sampled.

        Links of an arm whose joints turn do not move so: see `Scene.first_contacts()`.

        Parameters
        ----------
        other
            The tree that moves.
        start, end
            Its poses in the world, as of `collide()`: it goes from the one to the other along a line, or where it
            turns along a screw, by half a turn at most.
        own_start, own_end
            The same of this tree, at the same time. By default it stands still where it was stored, or at `own_start`.
            Shapes in front of all these poses are broadcast, as numpy does it.
        margin
            Spheres nearer than this touch.
        tolerance
            How far apart the spheres may be at the time that is found. 0: a ten-thousandth of the smaller tree's radius.
        progress, threads
            As for `build()`.

        Examples
        --------
        >>> import numpy, spheretree
        >>> cube = spheretree.build(numpy.ones((8, 8, 8), dtype=bool), quality="fast").query()
        >>> start, end = numpy.eye(4), numpy.eye(4)
        >>> start[0, 3], end[0, 3] = -30, 30
        >>> bool(0.25 < cube.continuous_collide(cube, start, end).time < 22 / 60)
        True
        """
        _require_query(other)
        own_start = np.eye(4) if own_start is None else own_start
        own_end = own_start if own_end is None else own_end
        ways = {"own_start": own_start, "own_end": own_end, "start": start, "end": end}
        given = {name: rows_of(name, poses, (4, 4)) for name, poses in ways.items()}
        rows = broadcast_rows(given)
        shape = np.broadcast_shapes(*(front for _, front in given.values()))
        answers = self._handle.continuous_collide(
            other._handle, rows["own_start"], rows["own_end"], rows["start"], rows["end"],
            real_number("margin", margin), real_number("tolerance", tolerance), progress, thread_count(threads))
        return FirstContacts(*_shaped(shape, answers))

    def distance(
        self, other: Query, pose: npt.ArrayLike | None = None, *, signed: bool = False, upto: float = np.inf,
        progress: Progress = None, threads: int | None = None,
    ) -> Distances:
        """How far two trees are apart, and where they are nearest.

        Parameters
        ----------
        other, pose, progress, threads
            As for `collide()`.
        signed
            Of trees that meet, the depth of their deepest two spheres as a negative number, in place of 0.
        upto
            Look for nothing that is farther.

        Examples
        --------
        >>> import numpy, spheretree
        >>> cube = spheretree.build(numpy.ones((8, 8, 8), dtype=bool), quality="fast").query()
        >>> pose = numpy.eye(4)
        >>> pose[0, 3] = 20
        >>> far = cube.distance(cube, pose)
        >>> bool(far.lower <= 12 <= far.upper)
        True
        """
        poses, shape = self._pair(other, pose)
        answers = self._handle.distance(
            other._handle, poses, bool(signed), _bound("upto", upto), progress, thread_count(threads))
        return Distances(*_shaped(shape, answers))

    def contains(
        self, points: npt.ArrayLike, *, progress: Progress = None, threads: int | None = None
    ) -> npt.NDArray[np.bool_]:
        """Whether points, shape (..., 3), lie in the object: exactly.

        Raises
        ------
        InputError
            The tree does not have all leaf balls of its object: build it without `spheres=`, or use `nearest()`.

        Examples
        --------
        >>> import numpy, spheretree
        >>> cube = spheretree.build(numpy.ones((8, 8, 8), dtype=bool), quality="fast").query()
        >>> cube.contains([[0, 0, 0], [7.4, 7.4, 7.4], [7.6, 0, 0]])
        array([ True,  True, False])
        """
        places, shape = rows_of("points", points, (3,))
        inside: npt.NDArray[np.bool_] = self._handle.contains(places, progress, thread_count(threads))
        return inside.reshape(shape)

    def nearest(
        self, points: npt.ArrayLike, cutoff: float = np.inf, *, progress: Progress = None, threads: int | None = None
    ) -> Nearest:
        """The leaf sphere nearest to each point, shape (..., 3), its signed distance and the direction away from it.

        What is farther than `cutoff` is not looked for, which takes a part of the time.
        """
        places, shape = rows_of("points", points, (3,))
        return Nearest(*_shaped(shape, self._handle.nearest(
            places, real_number("cutoff", cutoff), progress, thread_count(threads))))

    def intersect(
        self, origins: npt.ArrayLike, directions: npt.ArrayLike, *, tfar: float = np.inf, leaves_start: bool = False,
        progress: Progress = None, threads: int | None = None,
    ) -> Hits:
        """Where rays enter the leaf spheres first.

        Parameters
        ----------
        origins, directions
            Shape (..., 3), of one shape or broadcast to one. A direction may have any length above 0.
        tfar
            How far rays go, by the length of their directions.
        leaves_start
            Spheres that hold the origin do not count, as for rays that leave a surface.
        progress, threads
            As for `build()`.

        Examples
        --------
        >>> import numpy, spheretree
        >>> cube = spheretree.build(numpy.ones((8, 8, 8), dtype=bool), quality="fast").query()
        >>> hits = cube.intersect([-10, 3, 3], [[1, 0, 0], [-1, 0, 0]])
        >>> hits.ids >= 0, bool(8 < hits.t[0] <= 9.5)
        (array([ True, False]), True)
        """
        rays, shape = self._rays(origins, directions)
        answers = self._handle.intersect(
            *rays, _bound("tfar", tfar), bool(leaves_start), progress, thread_count(threads))
        return Hits(*_shaped(shape, answers))

    def occluded(
        self, origins: npt.ArrayLike, directions: npt.ArrayLike, *, tfar: float = np.inf, leaves_start: bool = False,
        progress: Progress = None, threads: int | None = None,
    ) -> npt.NDArray[np.bool_]:
        """Whether rays hit anything: as `intersect()`, in less time."""
        rays, shape = self._rays(origins, directions)
        blocked: npt.NDArray[np.bool_] = self._handle.occluded(
            *rays, _bound("tfar", tfar), bool(leaves_start), progress, thread_count(threads))
        return blocked.reshape(shape)

    def sphere_distances(
        self, spheres: npt.ArrayLike, activation: float, *, progress: Progress = None, threads: int | None = None
    ) -> Nearest:
        """The signed distance of spheres to the leaf spheres, as planners ask for it.

        Parameters
        ----------
        spheres
            x, y, z and radius, as float32: shape (..., 4), such as (batch, horizon, n, 4). A radius below 0 switches
            a sphere off.
        activation
            What is farther is not looked for.
        progress, threads
            As for `build()`.

        Examples
        --------
        >>> import numpy, spheretree
        >>> cube = spheretree.build(numpy.ones((8, 8, 8), dtype=bool), quality="fast").query()
        >>> robot = numpy.zeros((5, 2, 4), dtype=numpy.float32)
        >>> robot[..., 0], robot[..., 3] = [[12, 30]], 1
        >>> near = cube.sphere_distances(robot, activation=5)
        >>> near.distance.shape, near.distance[0] < 5
        ((5, 2), array([ True, False]))
        """
        balls, shape = rows_of("spheres", spheres, (4,), np.float32)
        answers = self._handle.sphere_distances(
            balls, real_number("activation", activation), progress, thread_count(threads))
        return Nearest(*_shaped(shape, answers))

    @staticmethod
    def _rays(origins: npt.ArrayLike, directions: npt.ArrayLike) -> tuple[tuple[Any, Any], Any]:
        for name, array in (("origins", real_array("origins", origins)), ("directions", real_array("directions", directions))):
            if array.shape[-1:] != (3,):
                raise InputError(f"{name} has shape {array.shape}: it takes (..., 3)")
        try:
            starts, ways = np.broadcast_arrays(np.asarray(origins, np.float64), np.asarray(directions, np.float64))
        except ValueError as error:
            raise InputError(f"origins and directions: {error}") from None
        rows = np.ascontiguousarray(starts).reshape(-1, 3), np.ascontiguousarray(ways).reshape(-1, 3)
        return rows, starts.shape[:-1]
