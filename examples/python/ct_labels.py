# SPDX-License-Identifier: Apache-2.0
"""A segmented CT volume, slices first, with voxels that are no cubes: a tree for each label, drawn in ct_labels.png."""
import matplotlib.pyplot as plt
import numpy as np
import spheretree

# A stack of slices (z, y, x) of 1.5 mm, with pixels of 0.75 mm; labels as a segmentation gives them.
z, y, x = np.mgrid[:40, :80, :80] * np.array([1.5, 0.75, 0.75]).reshape(3, 1, 1, 1)
labels = np.zeros(x.shape, np.uint8)
labels[(x - 30) ** 2 / 700 + (y - 32) ** 2 / 420 + (z - 30) ** 2 / 600 < 1] = 1  # an organ,
labels[(x - 20) ** 2 + (y - 30) ** 2 + (z - 32) ** 2 < 60] = 2  # a lesion in it,
labels[(x - 50 - 3 * np.sin(z / 9)) ** 2 + (y - 45) ** 2 < 20] = 3  # a vessel

figure = plt.figure(figsize=(8, 6))
axes = figure.add_subplot(projection="3d")
u, v = np.mgrid[0:np.pi:8j, 0:2 * np.pi:14j]
unit = np.stack([np.sin(u) * np.cos(v), np.sin(u) * np.sin(v), np.cos(u)])
for label, (name, color, alpha) in {1: ("organ", "tan", 0.15), 2: ("lesion", "crimson", 1), 3: ("vessel", "steelblue", 0.9)}.items():
    tree = spheretree.build(labels, 48, label=label, axes="zyx", anisotropy=(1.5, 0.75, 0.75), quality="fast", name=name)
    finest = tree.levels[0]
    print(f"{name}: {tree.object['voxels']} cubes of {tree.object['voxel_size']} mm, {len(finest)} spheres")
    for center, radius in zip(finest.centers, finest.radii):  # world space: x, y, z in mm
        axes.plot_surface(*(center[:, None, None] + radius * unit), color=color, alpha=alpha, linewidth=0)
axes.set(xlabel="x (mm)", ylabel="y (mm)", zlabel="z (mm)", box_aspect=(1, 1, 1), title="48 spheres for each label")
figure.savefig("ct_labels.png", dpi=100)
