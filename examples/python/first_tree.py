# SPDX-License-Identifier: Apache-2.0
"""From an array of numpy to a sphere-tree: first_tree.vdb, and first_tree.csv for a spreadsheet."""
import numpy as np
import spheretree

x, y, z = np.mgrid[-40:41, -40:41, -20:21]
torus = (np.hypot(x, y) - 26) ** 2 + z**2 < 12**2

tree = spheretree.build(torus, spheres=[256, 32, 4], anisotropy=0.05, quality="fast")  # voxels of 5 cm

for level in tree.levels:
    print(f"level {level.level}: {len(level)} spheres, {level.errors['stored_hamming_percent']:.1f} % more than the object")
assert not tree.check(torus, anisotropy=0.05)  # every level covers every voxel
tree.save("first_tree.vdb")
tree.save("first_tree.csv")
