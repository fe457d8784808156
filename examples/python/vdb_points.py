# SPDX-License-Identifier: Apache-2.0
"""Any points of a .vdb as arrays, which pyopenvdb does not read: vdb_points.py [FILE], to vdb_points.npz.

Without a file it makes one: the points of a sphere-tree.
"""
import sys

import numpy as np
import spheretree

path = sys.argv[1] if len(sys.argv) > 1 else "points.vdb"
if len(sys.argv) == 1:
    spheretree.build(np.ones((24, 16, 8), bool), [32, 4], anisotropy=0.1).save(path)

arrays = {}
for grid, attributes in spheretree.read_points(path).items():
    print(f"{grid}: {len(attributes['P']) if attributes else 0} points")
    for name, values in attributes.items():
        values = np.asarray(values)
        print(f"    {name:15} {str(values.dtype):8} {values.shape}")
        arrays[f"{grid}.{name.replace(':', '_')}"] = values
np.savez_compressed("vdb_points.npz", **arrays)
