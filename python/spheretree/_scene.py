# SPDX-License-Identifier: Apache-2.0
"""Many bodies, and which of them touch."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _spheretree
from ._query import Query, broadcast_rows, contact_count, rows_of
from ._spheretree import InputError
from ._volume import Progress, real_number, thread_count, whole_number


class TouchingPairs(NamedTuple):
    """Bodies of a scene that touch: a row for each pair, or for each contact of a pair, sorted by frames and bodies.

    Attributes
    ----------
    frame
        In which of many poses of the scene: its index, counted as numpy flattens what is in front. Shape (n,).
    bodies
        Their numbers, the smaller one first: shape (n, 2).
    objects
        1 where the voxels themselves touch for certain; 0 where spheres cannot know, or were not asked to search on.
    distance
        Of the two spheres that were found: negative is how deep they meet.
    points
        The middle between them, in the world: shape (n, 3).
    normals
        From the first body's sphere to the second's, of length 1: shape (n, 3).
    ids
        Of both spheres in their trees: shape (n, 2).
    """

    frame: npt.NDArray[np.int64]
    bodies: npt.NDArray[np.int32]
    objects: npt.NDArray[np.int8]
    distance: npt.NDArray[np.float64]
    points: npt.NDArray[np.float64]
    normals: npt.NDArray[np.float64]
    ids: npt.NDArray[np.int32]

    def __repr__(self) -> str:
        return _summary(self)


class MeetingPairs(NamedTuple):
    """Bodies of a scene that meet on their ways: a row for each pair, sorted by frames and bodies.

    Attributes
    ----------
    frame
        On which of many ways of the scene: its index, counted as numpy flattens what is in front. Shape (n,).
    bodies
        Their numbers, the smaller one first: shape (n, 2).
    time
        When they first touch, from 0 to 1 along their ways. No voxels of the two meet before.
    distance
        Of the two spheres that meet, at that time.
    points
        The middle between them, in the world: shape (n, 3).
    normals
        From the first body's sphere to the second's, of length 1: shape (n, 3).
    ids
        Of both spheres in their trees: shape (n, 2).
    """

    frame: npt.NDArray[np.int64]
    bodies: npt.NDArray[np.int32]
    time: npt.NDArray[np.float64]
    distance: npt.NDArray[np.float64]
    points: npt.NDArray[np.float64]
    normals: npt.NDArray[np.float64]
    ids: npt.NDArray[np.int32]

    def __repr__(self) -> str:
        return _summary(self)


class Scene:
    """Rigid bodies that move, and which of them touch: a robot's links, say, and what is around it.

    Bodies have numbers, 0, 1, 2 ... as they are added. Only pairs that are near are asked about, and those that are
    ignored never are. What is said to be apart is so of the voxels themselves, as of `Query`.

    Examples
    --------
    >>> import numpy, spheretree
    >>> cube = spheretree.build(numpy.ones((8, 8, 8), dtype=bool), quality="fast").query()
    >>> scene = spheretree.Scene()
    >>> for x in 0, 9, 40:
    ...     pose = numpy.eye(4)
    ...     pose[0, 3] = x
    ...     number = scene.add(cube, pose)
    >>> scene.touching_pairs().bodies
    array([[0, 1]], dtype=int32)
    >>> scene.ignore(0, 1)
    >>> len(scene.touching_pairs().bodies)
    0
    """

    __slots__ = ("_handle", "_bodies")

    def __init__(self) -> None:
        self._handle = _spheretree.make_scene()
        self._bodies: dict[int, Query] = {}

    def __len__(self) -> int:
        """How many bodies were added. Those that were removed count."""
        return self._handle.size

    def __repr__(self) -> str:
        return f"<spheretree.Scene of {len(self._bodies)} bodies>"

    def __contains__(self, body: object) -> bool:
        """Whether there is a body of this number, which was not removed."""
        return body in self._bodies

    def add(self, body: Query, pose: npt.ArrayLike | None = None) -> int:
        """Adds a body, and returns its number.

        Parameters
        ----------
        body
            Of `Tree.query()`. Bodies of one shape share it.
        pose
            Where it is in the world: a rigid 4 x 4 matrix for columns. By default where it was stored.
        """
        if not isinstance(body, Query):
            raise TypeError(f"body must be a spheretree.Query, not {type(body).__name__}")
        number = self._handle.add(body._handle, _pose(pose))
        self._bodies[number] = body
        return number

    def remove(self, body: int) -> None:
        """Takes a body out. Its number is not given again."""
        self._handle.remove(_number("body", body))
        del self._bodies[body]

    def query(self, body: int) -> Query:
        """What was added under a number: `ids` are of its tree."""
        self._handle.pose(_number("body", body))  # which is an error where there is none
        return self._bodies[body]

    def pose(self, body: int) -> npt.NDArray[np.float64]:
        """Where a body is: shape (4, 4)."""
        return self._handle.pose(_number("body", body))

    def set_pose(self, body: int, pose: npt.ArrayLike) -> None:
        """Moves a body to a pose in the world."""
        self._handle.set_pose(_number("body", body), _pose(pose))

    def ignore(self, a: int, b: int, ignored: bool = True) -> None:
        """Leaves a pair out of all answers, such as neighbouring links; or, with `ignored=False`, takes it in again."""
        self._handle.ignore(_number("a", a), _number("b", b), bool(ignored))

    def is_ignored(self, a: int, b: int) -> bool:
        """Whether a pair is left out."""
        return self._handle.is_ignored(_number("a", a), _number("b", b))

    def touching_pairs(
        self, poses: npt.ArrayLike | None = None, *, margin: float = 0, objects: bool = False,
        max_contacts: int | None = None, progress: Progress = None, threads: int | None = None,
    ) -> TouchingPairs:
        """All pairs of bodies that touch.

        Parameters
        ----------
        poses
            Where the bodies are, in place of their own poses, which stay: one a body, shape (n, 4, 4), or many times, shape
            (..., n, 4, 4), where n is `len(scene)`. Those of bodies that were removed take no part.
        margin, objects
            As of `Query.collide()`.
        max_contacts
            Rows are up to so many pairs of spheres of each pair of bodies, the deepest first. By default any one of them.
        progress, threads
            As for `build()`.
        """
        places = None if poses is None else self._poses("poses", poses)[0]
        most = 0 if max_contacts is None else contact_count(max_contacts)
        return TouchingPairs(*self._handle.touching_pairs(
            places, real_number("margin", margin), bool(objects), most, progress, thread_count(threads)))

    def first_contacts(
        self, *, end: npt.ArrayLike, start: npt.ArrayLike | None = None, margin: float = 0, tolerance: float = 0,
        progress: Progress = None, threads: int | None = None,
    ) -> MeetingPairs:
        """All pairs of bodies that meet as all of them move at the same time. Nothing is sampled.

        Each body goes its own way. Links of an arm whose joints turn evenly do not move so: those beyond the first would
        leave their joints. Give such a way in steps, shape (steps, n, 4, 4) of `start` and `end`. A link is then off by less
        than a third of S**2 * R, where S is what all joints together turn in a step, in radians, and R is how far the arm
        reaches: take that for `margin`, and twice that where two links may meet.

        Parameters
        ----------
        end, start
            Poses as of `touching_pairs()`: each body goes from the one to the other along a line, or where it turns along a
            screw, by half a turn at most. By default bodies start where they are. Shapes in front are broadcast.
        margin, tolerance
            As of `Query.continuous_collide()`.
        progress, threads
            As for `build()`.
        """
        starts = {} if start is None else {"start": self._poses("start", start)}
        rows = broadcast_rows({**starts, "end": self._poses("end", end)}, len(self))
        answers = self._handle.first_contacts(
            rows.get("start"), rows["end"], real_number("margin", margin), real_number("tolerance", tolerance), progress,
            thread_count(threads))
        return MeetingPairs(*answers)

    def _poses(self, name: str, poses: npt.ArrayLike) -> tuple[Any, tuple[int, ...]]:
        """Rows of 16 numbers, one a body, and the shape in front of these."""
        places, shape = rows_of(name, poses, (4, 4))
        if shape[-1:] != (len(self),):
            raise InputError(f"{name} has shape {(*shape, 4, 4)}: it takes one pose for each of {len(self)} bodies, "
                             f"(..., {len(self)}, 4, 4)")
        return places, shape[:-1]


def _summary(pairs: TouchingPairs | MeetingPairs) -> str:
    """What is printed of them."""
    return f"<spheretree.{type(pairs).__name__}: {len(pairs.bodies)} in {len(np.unique(pairs.frame))} frames>"


def _number(name: str, body: int) -> int:
    return whole_number(name, body, 32)


def _pose(pose: npt.ArrayLike | None) -> Any:
    """A row of 16 numbers."""
    place, shape = rows_of("pose", np.eye(4) if pose is None else pose, (4, 4))
    if shape:
        raise InputError(f"pose has shape {(*shape, 4, 4)}: it takes (4, 4)")
    return place
