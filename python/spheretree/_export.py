# SPDX-License-Identifier: Apache-2.0
"""Sphere-trees as files of other tools."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, Optional, Union

from . import _spheretree
from ._volume import Progress, VolumeLike, system_path, text, warn, whole_number
from ._volume import volume as as_volume

if TYPE_CHECKING:
    from ._tree import Tree


class ExportFormat(NamedTuple):
    """A format that trees are exported to."""

    name: str
    """What `format` takes."""
    extensions: list[str]
    by_extension: bool
    """Whether its extensions mean it without `format`."""
    readers: str
    """Tools that read it."""
    keeps: str
    """What of a tree it has room for."""


def export_formats() -> list[ExportFormat]:
    """All formats of `export()`.

    >>> import spheretree
    >>> [f.name for f in spheretree.export_formats() if ".urdf" in f.extensions]
    ['urdf']
    """
    return [ExportFormat(*row) for row in _spheretree.export_formats()]


def export(
    trees: Tree | Iterable[Tree],
    path: str | os.PathLike[str],
    *,
    format: str = "",
    level: Optional[int] = None,
    spheres: Optional[int] = None,
    units: str = "m",
    scale: float = 1.0,
    frame: str = "world",
    up: Optional[str] = None,
    link: Union[str, Sequence[str], None] = None,
    name: str = "",
    mass: Optional[str] = None,
    volume: Optional[VolumeLike] = None,
    density: Optional[float] = None,
    start: Optional[float] = None,
    fps: Optional[float] = None,
    progress: Progress = None,
) -> None:
    """Write a tree, or several, as a file of another tool, with the same bytes as the command's -write.

    What the format has no room for is a UserWarning, and so is an option that means nothing to it. The file is there
    whole or as it was before.

    Parameters
    ----------
    trees
        A tree; of USD also several, which are samples over time; of `.yml`, `.xrdf` and `.srdf` several, each the
        spheres of a link.
    path
        The extension says which format: `export_formats()` lists them.
    format
        Its name, where several have the extension.
    level, spheres
        The level to write, or the finest with at most so many spheres (of a tree with cuts, so many). Without
        them: all levels, or the finest where there is room for one.
    units
        Of the numbers of the file, such as "mm"; the tree is in metres.
    scale
        Makes all larger.
    frame
        "world"; "centroid": around the center of mass of the spheres; "principal": turned to their principal
        axes, too.
    up
        "y" (the default) or "z": which axis of the tree is up, for USD and glTF.
    link
        The link of a robot that the spheres belong to; of several trees that of each. By default the name of the tree, in
        formats that hold several links, or "object".
    name
        The name of the robot, model or prim, by default that of the tree, or of a robot that of the file where the tree
        has none of its own or there are several.
    mass, volume
        For formats with a mass. "spheres" (the default): mass, center of mass and inertia are those of the union of
        the spheres; "object": those of the voxels of `volume`, which the tree was built over.
    density
        Mass of a cubed unit of the file, for formats with a mass: 1000 by default, that of water in metres.
    start, fps
        The time of the first of several trees, each a frame, by default 1; and how many frames a second has, by
        default 24.
    progress
        As for `build()`.

    Raises
    ------
    InputError
        The format cannot hold what is asked for, or the volume is not that of the tree.
    OSError
        The file cannot be written.

    >>> import numpy, spheretree
    >>> tree = spheretree.build(numpy.ones((9, 9, 9), bool), spheres=[8, 1], quality="fast")
    >>> spheretree.export(tree, "cube.urdf", level=0, link="cube")
    """
    if mass not in (None, "spheres", "object"):
        raise _spheretree.InputError(f'mass="{mass}" is none of "spheres", "object"')
    if (mass == "object") != (volume is not None):
        raise _spheretree.InputError('mass="object" is the mass of volume=, and each needs the other')
    several = _several(trees)
    defaults = {"up": "y", "mass": "spheres", "density": 1000.0, "start": 1.0, "fps": 24.0}
    wanted: dict[str, Any] = {"up": up, "link": link, "mass": mass, "density": density, "start": start,
                              "fps": fps}
    if name:
        wanted["name"] = name
    given = {key: float(value) if key in ("density", "start", "fps") else value
             for key, value in wanted.items() if value is not None}
    words: dict[str, Any] = {
        "level": None if level is None else whole_number("level", level, 32),
        "spheres": None if spheres is None else whole_number("spheres", spheres, 64),
        "units": units, "scale": float(scale), "frame": frame, "name": name, **defaults, **given, "links": _links(link),
    }
    for key in ("units", "frame", "name", "up"):
        text(key, words[key])
    own = None if volume is None else as_volume(volume)._handle
    handles = [tree._handle for tree in several]
    for note in _spheretree.export(handles, system_path(path), text("format", format), words, list(given), own, progress):
        warn(f"{os.fspath(path)}: {note}")


def _several(trees: Tree | Iterable[Tree]) -> list[Tree]:
    from ._tree import Tree  # which knows this module

    several = [trees] if isinstance(trees, Tree) else list(trees)
    for tree in several:
        if not isinstance(tree, Tree):
            raise TypeError(f"trees must be a spheretree.Tree, or several, not {type(tree).__name__}")
    return several


def _links(link: Union[str, Sequence[str], None]) -> list[str]:
    """Those that are given; none: the trees' names are taken."""
    if link is None:
        return []
    links = [text("link", word) for word in ([link] if isinstance(link, str) else link)]
    if not links:
        raise _spheretree.InputError("link names no link")
    return links
