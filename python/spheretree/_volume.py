# SPDX-License-Identifier: Apache-2.0
"""What a tree is built over: the voxels of an array, a file or a grid, and where they are."""

from __future__ import annotations

import itertools
import os
import sys
import tempfile
import warnings
from collections.abc import Iterable, Sequence
from typing import Any, Callable, Literal, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _spheretree
from ._spheretree import InputError

Progress = Optional[Callable[[float, str], object]]
Axes = Literal["xyz", "zyx", "xy", "yx"]
Coverage = Literal["centers", "cubes", "whole"]
Units = Literal["mm", "cm", "m", "in", "ft", "um", "km"]
Number = Union[int, float]
Numbers = Union[Number, Sequence[Number], "npt.NDArray[Any]"]


class Volume:
    """An object: a set of voxels, sparse, with its place in the world. `volume()` makes them.

    Indices (`start`, `coordinates()`, and what `medial_axis()` returns) are in the order of the axes of the array
    that the volume was made of; for volumes of files that is x, y, z, whatever their `axes`. World space is always
    x, y, z.
    """

    __slots__ = ("_handle", "__weakref__")

    def __init__(self, handle: _spheretree.Volume) -> None:
        if not isinstance(handle, _spheretree.Volume):
            raise TypeError("spheretree.volume() makes volumes")
        self._handle = handle

    @property
    def voxels(self) -> int:
        """How many voxels the object has."""
        return self._handle.voxels

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of arrays that show the volume: of the array it was made of, or of its object's box."""
        return tuple(self._handle.shape)

    @property
    def start(self) -> tuple[int, ...]:
        """The index of the first voxel of such arrays: zeros for a volume that was made of an array."""
        return tuple(self._handle.start)

    @property
    def ndim(self) -> int:
        """3, or 2 for a volume of an array with two axes."""
        return 2 if self._handle.flat else 3

    @property
    def matrix(self) -> npt.NDArray[np.float64]:
        """Index (x, y, z, 1) to world space: shape (4, 4), for columns, as trimesh has it."""
        return self._handle.matrix

    @property
    def voxel_size(self) -> float:
        """The edge of a voxel, in world units."""
        return self._handle.voxel_size

    @property
    def name(self) -> str:
        """The name that trees of it record."""
        return self._handle.name

    def to_array(self) -> npt.NDArray[np.bool_]:
        """The voxels as an array of bool of `shape`: dense, a byte for each voxel of the box."""
        return self._handle.to_array()

    def coordinates(self) -> npt.NDArray[np.int32]:
        """The indices of the object's voxels: shape (voxels, 3), or (voxels, 2) for two axes."""
        return self._handle.coordinates()

    def __repr__(self) -> str:
        shape = " x ".join(map(str, self.shape))
        return f"<spheretree.Volume {self.name!r}: {self.voxels:,} voxels in {shape}>"


VolumeLike = Union[Volume, "npt.NDArray[Any]", str, "os.PathLike[str]", Any]


def part_of(progress: Progress, begin: float, end: float) -> Progress:
    """The part of a progress from `begin` to `end`, as a progress of its own."""
    if progress is None:
        return None
    tell = progress
    return lambda done, stage: tell(begin + (end - begin) * done, stage)


MOST_THREADS = 1024  # as of the command


def thread_count(threads: int | None) -> int:
    if threads is None:
        return 0
    if isinstance(threads, bool) or not isinstance(threads, (int, np.integer)):
        raise TypeError(f"threads must be a whole number or None, not {type(threads).__name__}")
    if not 1 <= threads <= MOST_THREADS:
        raise InputError(f"threads={threads} is out of range: it takes 1 to {MOST_THREADS}, or None for all cores")
    return int(threads)


def warn(message: str) -> None:
    """A UserWarning at the line that called this package."""
    package = os.path.dirname(__file__)
    frame, level = sys._getframe(1), 2
    while frame.f_back and os.path.dirname(frame.f_code.co_filename) == package:
        frame, level = frame.f_back, level + 1
    warnings.warn(message, stacklevel=level)


def readable(path: str | os.PathLike[str]) -> bytes:
    """The path as the system has it. Raises what open() raises: FileNotFoundError, PermissionError ... The name of a
    stack of slices is that of no file, and is taken as it is."""
    name = system_path(path)
    if not _spheretree.is_stack_name(name):
        with open(path, "rb"):
            pass
    return name


def system_path(path: str | os.PathLike[str]) -> bytes:
    """The path as the system has it. Raises what open() raises where no file can have this name."""
    name = os.fsencode(path)
    if b"\0" in name:  # the system would take what is before it
        raise ValueError("embedded null byte")
    return name


def text(name: str, value: object) -> str:
    """A text that the system and files can have."""
    if not isinstance(value, str):
        raise TypeError(f"{name} must be a str, not {type(value).__name__}")
    try:
        value.encode()
    except UnicodeEncodeError:
        raise InputError(f"{name}={value!r} holds half of a character (a lone surrogate), which UTF-8 has not") from None
    return value


def whole_number(name: str, value: object, bits: int) -> int:
    """An integer that C++ has room for."""
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, np.integer)):
        raise TypeError(f"{name} must be a whole number, not {type(value).__name__}")
    if not -(2 ** (bits - 1)) <= value < 2 ** (bits - 1):
        raise InputError(f"{name}={value} is beyond {bits} bits")
    return int(value)


def real_number(name: str, value: object) -> float:
    """A number, infinite ones too; what it may be the library says."""
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, float, np.integer, np.floating)):
        raise TypeError(f"{name} must be a number, not {type(value).__name__}")
    try:
        return float(value)
    except OverflowError:
        raise InputError(f"{name} is beyond what a double holds") from None


def _number(name: str, value: object) -> int | float:
    """A finite number as Python has it: integers stay whole."""
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value[()]
    if isinstance(value, (int, np.integer)) and not isinstance(value, bool):
        return whole_number(name, value, 64)
    number = real_number(name, value)
    if not np.isfinite(number):
        raise InputError(f"{name}={value} is not a finite number")
    return number


def _items(name: str, value: object) -> list[Any] | None:
    """What stands in a sequence or an array of one axis; None of a number."""
    if isinstance(value, (int, float, np.integer, np.floating)) or (isinstance(value, np.ndarray) and value.ndim == 0):
        return None
    if isinstance(value, (str, bytes)) or not isinstance(value, Iterable):
        raise TypeError(f"{name} must be a number or several, not {type(value).__name__}")
    return list(value)


def real_array(name: str, values: npt.ArrayLike) -> npt.NDArray[Any]:
    """The values as they are. numpy would drop the imaginary parts of complex ones, with a warning at most."""
    array = np.asarray(values)
    if array.dtype.kind == "c":
        raise TypeError(f"{name} must hold real numbers, not {array.dtype}: .real are those of a complex array")
    if array.dtype.kind in "SUVMm":
        raise TypeError(f"{name} must hold real numbers, not {array.dtype}")
    return array


def _vector(name: str, value: Numbers, length: int) -> list[float]:
    """`length` numbers; one number stands for all of them."""
    items = _items(name, value)
    if items is None:
        return [float(_number(name, value))] * length
    if len(items) != length:
        raise InputError(f"{name} has {len(items)} numbers: it takes one, or {length}")
    return [float(_number(name, item)) for item in items]


def _labels(value: int | Sequence[int]) -> list[int]:
    items = [value] if isinstance(value, (int, np.integer)) else list(value)
    if not items:
        raise InputError("label names no value")
    return [whole_number("label", item, 64) for item in items]


def _object_keywords(
    threshold: Number | None, above: Number | None, below: Number | None, label: int | Sequence[int] | None,
    iso: Number | None, coverage: str, largest: bool, fill: bool,
) -> dict[str, Any]:
    """Those that were given."""
    numbers = {"threshold": threshold, "above": above, "below": below, "iso": iso}
    given: dict[str, Any] = {name: _number(name, value) for name, value in numbers.items() if value is not None}
    if label is not None:
        given["label"] = _labels(label)
    ways = [ways for ways in (("threshold",), ("above", "below"), ("label",), ("iso",)) if set(ways) & set(given)]
    if len(ways) > 1:
        raise InputError(f"{ways[0][0]} and {ways[1][0]} exclude each other")
    if coverage != "centers":
        given["strict" if coverage == "strict" else "coverage"] = coverage
    if "coverage" in given and label is not None:
        raise InputError("label excludes coverage: nothing lies between labels")
    given.update({name: True for name, wanted in (("largest", largest), ("fill", fill)) if wanted})
    return given


def _is_inside(value: float, wanted: dict[str, Any]) -> bool:
    """Of numbers by a threshold or a range."""
    lowest = wanted.get("threshold", wanted.get("above", None if "below" in wanted else 0))
    return (lowest is None or value > lowest) and ("below" not in wanted or value < wanted["below"])


def _no_label(labels: Iterable[int]) -> float:
    """The least number from 0 on that is none of some labels."""
    known = set(labels)
    return next(float(number) for number in itertools.count() if number not in known)


def _outside(values: Iterable[float], wanted: dict[str, Any]) -> float | None:
    """The first of some values that is not inside the object."""
    return next((float(value) for value in values if not _is_inside(value, wanted) and abs(float(value)) <= 2**53), None)


def _background(array: npt.NDArray[Any], wanted: dict[str, Any]) -> float:
    """A value for all that is outside of the array: one that is not inside the object."""
    if array.dtype == np.bool_:
        return 0
    if "label" in wanted:
        return _no_label(wanted["label"])
    value = _outside((0, array.min(), array.max()), wanted)
    if value is None:
        raise InputError("every value of volume is inside the object, so there is nothing to interpolate to at its border: "
                         "pad it by numpy.pad()")
    return value


def _edges(anisotropy: Numbers, axes: int) -> list[float]:
    edges = _vector("anisotropy", anisotropy, axes)
    if min(edges) <= 0:
        raise InputError(f"anisotropy={anisotropy} is out of range: it takes numbers above 0")
    return edges


def _require_array(array: object) -> None:
    if isinstance(array, np.ma.MaskedArray):
        raise TypeError("volume is a masked array, whose mask would be passed over: volume.filled(0) makes a plain one")
    if isinstance(array, np.ndarray):
        return
    hint = ": numpy.asarray(volume) makes an array of it" if hasattr(array, "__array__") or isinstance(array, Sequence) else ""
    raise TypeError("volume must be a numpy array, the path of a file, a grid of pyopenvdb or a spheretree.Volume, not "
                    f"{type(array).__name__}{hint}")


def _of_array(
    array: npt.NDArray[Any], axes: str, anisotropy: Numbers | None, origin: Numbers | None,
    matrix: npt.ArrayLike | None, name: str | None, wanted: dict[str, Any], progress: Progress, threads: int | None,
) -> Volume:
    _require_array(array)
    flat = array.ndim == 2
    known = ("xy", "yx", "xyz", "zyx") if flat else ("xyz", "zyx")
    if axes not in known:
        raise InputError(f"axes={axes!r} is unknown: it takes {' or '.join(map(repr, known))}")
    is_reversed = axes in ("zyx", "yx")
    spacing = [1.0] * 3
    if anisotropy is not None:
        own = _edges(anisotropy, 2 if flat else 3)
        spacing = own[::-1] if is_reversed else own
        spacing += [min(spacing)] * (3 - len(spacing))
    place = [0.0] * 3
    if origin is not None:
        items = _items("origin", origin)
        place = _vector("origin", [*items, 0] if items is not None and flat and len(items) == 2 else origin, 3)
    rows: list[float] | None = None
    edges = np.array(spacing)
    if matrix is not None:
        if anisotropy is not None or origin is not None:
            raise InputError("matrix says where all voxels are: it excludes anisotropy and origin")
        given = real_array("matrix", matrix).astype(np.float64)
        if given.shape != (4, 4) or not np.isfinite(given).all() or (given[3] != (0, 0, 0, 1)).any():
            raise InputError("matrix must be an array of shape (4, 4) of finite numbers, with 0, 0, 0, 1 for its last row")
        rows = given.ravel().tolist()
        edges = np.linalg.norm(given[:3, :3], axis=0)
    cubes = bool(edges.max() <= edges.min() * (1 + 1e-6))
    needs_values = array.dtype.kind in "biuf" and array.size > 0 and (not cubes or {"coverage", "strict"} & set(wanted))
    place_keywords = {
        "reversed": is_reversed, "spacing": spacing, "origin": place, "matrix": rows, "cubes": cubes,
        "name": "volume" if name is None else text("name", name),
        "background": _background(array, wanted) if needs_values else 0.0,
    }
    return Volume(_spheretree.volume_of_array(array, place_keywords, wanted, progress, thread_count(threads)))


def _is_grid(volume: object) -> bool:
    """Whether it is a grid of pyopenvdb, in whichever of its versions."""
    return type(volume).__module__.partition(".")[0] in ("pyopenvdb", "openvdb") and hasattr(volume, "transform")


def _of_grid(grid: Any, wanted: dict[str, Any], progress: Progress, threads: int | None) -> Volume:
    """By way of a temporary file: bindings of OpenVDB share no types, but they share files."""
    bindings = sys.modules[type(grid).__module__.partition(".")[0]]
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "grid.vdb")
        bindings.write(path, grids=[grid])
        return Volume(_spheretree.volume_of_file(os.fsencode(path), {}, wanted, progress, thread_count(threads)))


def volume(
    volume: VolumeLike,
    *,
    axes: Axes = "xyz",
    anisotropy: Numbers | None = None,
    origin: Numbers | None = None,
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
    name: str | None = None,
    progress: Progress = None,
    threads: int | None = None,
) -> Volume:
    """The object of an array, a file or a grid, for calls that take a volume.

    All of these make one by themselves; this is for volumes that are used more than once.

    Parameters
    ----------
    volume
        An array of shape (x, y, z), or (x, y) for a flat object: of bool, integers, float32 or float64, in C or
        Fortran order or with any strides. It is read where it lies. Or the path of a `.vdb`, `.vol`, `.longvol`,
        `.npy`, `.nrrd`, `.nhdr`, `.nii`, `.nii.gz` or mesh file; of a gray picture (`.png`, `.pgm`), or of a stack of
        them, as ``"slice_%04d.png"`` or ``"slice_####.png"``; or a grid of pyopenvdb, which goes by way of a temporary
        file.
    axes
        ``"zyx"`` for an array of shape (z, y, x), as stacks of slices are. Of arrays and `.npy` files.
    anisotropy
        The edges of a voxel in world units, one number or one for each axis *of the array*, in its order. Voxels that
        are no cubes are resampled to cubes of the shortest edge, which takes memory for a copy of the values. Of arrays;
        and of files from `.npy` to pictures, in the order x, y, z and in place of all that the file says of its place.
    origin
        The place of the center of voxel [0, 0, 0] in world space: x, y, z. Of arrays.
    matrix
        In place of both: index (x, y, z, 1) to world space, shape (4, 4), for columns. Of arrays.
    threshold
        Of numbers: the object is where the value is above this; 0 by default. (Of an array of bool, where it is True.)
    above, below
        In its place, a range: above and below these. One of them is enough.
    label
        In its place, one value or several.
    iso
        Of level sets: the object is where the value is below this; 0 by default.
    coverage
        ``"centers"``: voxels whose center is inside. ``"cubes"``: all whose cube meets the inside, so that thin parts
        stay; ``"whole"``: those whose cube is all inside. Between centers values are interpolated, which takes memory
        for a copy of the values of an array.
    largest, fill
        Keep the largest part alone; fill cavities.
    grid
        Which grid of a `.vdb` that holds several.
    units
        Of meshes: the unit that the file is in, such as ``"mm"``; its points become metres, and so does the world.
    voxel, resolution
        Of meshes: the edge of a voxel in world units; or how many voxels the longest side has, 256 by default.
    gap
        Of meshes: holes up to this width are closed, in world units.
    name
        What trees record as the name of the object: by default "volume" for arrays.
    progress
        Called some times a second with the fraction that is done, 0 to 1, and the name of the stage, by the thread that
        made the call. What it raises stops the work.
    threads
        The most that the work may run on; by default all cores.

    Raises
    ------
    InputError
        An argument is wrong, the volume holds no object, or it holds a NaN.
    OSError
        A file cannot be read, or is damaged.

    Warns
    -----
    UserWarning
        Values of a file are NaN, and count as outside; or a mesh is open, or has thin parts.

    Examples
    --------
    >>> import numpy, spheretree
    >>> block = numpy.zeros((8, 8, 8), dtype=bool)
    >>> block[1:4, 1:4, 2:3] = True
    >>> spheretree.volume(block)
    <spheretree.Volume 'volume': 9 voxels in 8 x 8 x 8>
    >>> numpy.save("block.npy", block)
    >>> spheretree.volume("block.npy")
    <spheretree.Volume 'block': 9 voxels in 3 x 3 x 1>
    >>> spheretree.volume(block, anisotropy=0.5, origin=(10, 0, 0)).matrix[0]
    array([ 0.5,  0. ,  0. , 10. ])
    """
    kind = _kind_of_file(volume)
    of_arrays = {"anisotropy": None if kind in ARRAY_FILES else anisotropy, "origin": origin, "matrix": matrix}
    of_files = {"grid": grid, "units": units, "voxel": voxel, "resolution": resolution, "gap": gap}
    of_objects = {"threshold": threshold, "above": above, "below": below, "label": label, "iso": iso}
    wanted = _object_keywords(threshold, above, below, label, iso, coverage, largest, fill)
    is_file = isinstance(volume, (str, os.PathLike))
    is_array = not is_file and not isinstance(volume, Volume) and not _is_grid(volume)
    source: Any = volume
    _refuse({} if is_array else of_arrays, "of arrays: a volume or file has its own")
    _refuse({} if is_file else of_files, "of files")
    if not (is_array or kind == "npy") and axes != "xyz":
        raise InputError(f"axes={axes!r} is of arrays and .npy files")
    if name is not None and not is_array:
        raise InputError("name is of arrays: volumes and files have their own")
    if isinstance(volume, Volume):
        _refuse(of_objects, "of arrays and files: this volume is an object already")
        if set(wanted) - {"strict"}:
            raise InputError(f"{next(iter(wanted))} is of arrays and files: this volume is an object already")
        return volume
    if is_file:
        result = _of_file(source, kind, axes, anisotropy, of_files, wanted, progress, threads)
    elif is_array:
        result = _of_array(source, axes, anisotropy, origin, matrix, name, wanted, progress, threads)
    else:
        result = _of_grid(source, wanted, progress, threads)
    for warning in result._handle.warnings:
        warn(warning)
    return result


def _refuse(keywords: dict[str, Any], why: str) -> None:
    for name, value in keywords.items():
        if value is not None:
            raise InputError(f"{name} is {why}")


ARRAY_FILES = ("npy", "array")  # kinds of files that hold dense values


def _kind_of_file(volume: object) -> str:
    """What a path is read as, by its extension; empty for files that are not read, and what is no path."""
    return _spheretree.kind_of_file(os.fsencode(volume)) if isinstance(volume, (str, os.PathLike)) else ""


def is_array_file(volume: object) -> bool:
    """Whether it is a path, and one of an array or of pictures."""
    return _kind_of_file(volume) in ARRAY_FILES


def is_mesh_file(volume: object) -> bool:
    """Whether it is a path, and one of a file that is no volume."""
    return isinstance(volume, (str, os.PathLike)) and _kind_of_file(volume) in ("mesh", "")


def unit_of_length(units: object) -> str:
    """The name of a unit; which there are the command knows."""
    unit = text("units", units)
    if not unit:
        raise InputError("units='' names no unit")
    return unit


def _of_file(
    path: str | os.PathLike[str], kind: str, axes: str, anisotropy: Numbers | None, of_files: dict[str, Any],
    wanted: dict[str, Any], progress: Progress, threads: int | None,
) -> Volume:
    given = {name: value for name, value in of_files.items() if value is not None}
    for name in ("units", "voxel", "resolution", "gap"):
        if name not in given:
            continue
        if not is_mesh_file(path):
            raise InputError(f"{name} is of meshes, and {os.fspath(path)} is none")
        if name == "units":
            unit_of_length(given[name])
            continue
        if _number(name, given[name]) <= 0:
            raise InputError(f"{name}={given[name]} is out of range: it takes numbers above 0")
    if "voxel" in given and "resolution" in given:
        raise InputError("voxel and resolution exclude each other")
    if "grid" in given:
        text("grid", given["grid"])
        if kind != "vdb":
            raise InputError(f"grid is of .vdb files, and {os.fspath(path)} is none")
    if axes not in ("xyz", "zyx"):
        raise InputError(f"axes={axes!r} is unknown: it takes 'xyz' or 'zyx'")
    given["zyx"] = axes == "zyx"
    if anisotropy is not None:
        given["spacing"] = _edges(anisotropy, 3)
    known = readable(path)
    if kind in ARRAY_FILES and "label" in wanted:
        given["background"] = _no_label(wanted["label"])
    elif kind in ARRAY_FILES and _is_inside(0, wanted):  # what is beyond an array is outside, of a file as well
        given["background"] = _background_of_file(known, wanted, part_of(progress, 0, 0.5), threads)
        progress = part_of(progress, 0.5, 1)
    return Volume(_spheretree.volume_of_file(known, given, wanted, progress, thread_count(threads)))


def _background_of_file(path: bytes, wanted: dict[str, Any], progress: Progress, threads: int | None) -> float:
    """A value of the file that is not inside the object, as `_background()` has it of an array."""
    values = _spheretree.value_range_of_file(path, progress, thread_count(threads))
    if values is None:
        return 0
    value = _outside(values, wanted)
    if value is None:
        raise InputError(f"{os.fsdecode(path)}: every value is inside the object, so it has no border: give its array, with "
                         "one that numpy.pad() adds")
    return value
