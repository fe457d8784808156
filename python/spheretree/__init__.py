# SPDX-License-Identifier: Apache-2.0
"""Sphere-trees of volumes: ever fewer spheres that cover every voxel of an object.

>>> import numpy, spheretree
>>> x, y, z = numpy.mgrid[-20:21, -20:21, -20:21]
>>> torus = (numpy.hypot(x, y) - 13) ** 2 + z**2 < 25
>>> tree = spheretree.build(torus, spheres=[32, 8], anisotropy=0.1, quality="fast")
>>> tree
<spheretree.Tree 'spheretree': 32, 8 spheres on 2 levels>
>>> finest = tree.levels[0]
>>> finest.centers.shape, finest.radii.shape, finest.errors["missing"]
((32, 3), (32,), 0)
>>> tree.save("torus.vdb")

Volumes are arrays of numpy, which are read where they lie, files, or grids of pyopenvdb: see `volume()`. Errors are
exceptions: `InputError`, which is a ValueError, for arguments; OSError for files; MemoryError.
"""

from ._build import build
from ._export import ExportFormat, export, export_formats
from ._query import Collisions, Contacts, Distances, FirstContacts, Hits, Nearest, Query, Verdict
from ._scene import MeetingPairs, Scene, TouchingPairs
from ._spheretree import InputError
from ._spheretree import version as __version__
from ._transforms import distance_transform, medial_axis, pyramid
from ._tree import Fault, Level, Tree, check, check_mesh, load, read_points
from ._volume import Volume, volume

__all__ = [
    "Collisions", "Contacts", "Distances", "ExportFormat", "Fault", "FirstContacts", "Hits", "InputError", "Level",
    "MeetingPairs", "Nearest", "Query", "Scene", "TouchingPairs", "Tree", "Verdict", "Volume", "build", "check",
    "check_mesh", "distance_transform", "export", "export_formats", "load", "medial_axis", "pyramid", "read_points", "volume",
    "__version__",
]
for _type in (
    Collisions, Contacts, Distances, ExportFormat, Fault, FirstContacts, Hits, Level, MeetingPairs, Nearest, Query, Scene,
    TouchingPairs, Tree, Verdict, Volume,
):
    _type.__module__ = __name__
