# SPDX-License-Identifier: Apache-2.0
"""Distances and medial balls of a flat object, drawn in medial_axis.png."""
import matplotlib.pyplot as plt
import numpy as np
import spheretree

y, x = np.mgrid[:160, :240]
angle, radius = np.arctan2(y - 80, x - 120), np.hypot(x - 120, y - 80)
flower = (radius < 50 + 24 * np.cos(5 * angle)) & ~((x - 120) ** 2 + (y - 80) ** 2 < 15**2)

distances = spheretree.distance_transform(flower, axes="yx")  # of the array's shape, and exact
points, radii_sq = spheretree.medial_axis(flower, axes="yx")  # rows are indices of the array
assert np.array_equal(np.rint(distances[tuple(points.T)] ** 2), radii_sq)  # which are whole numbers

figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4), sharex=True, sharey=True)
image = left.imshow(distances, cmap="magma")
figure.colorbar(image, ax=left, label="distance (voxels)")
left.set_title("distance_transform()")
right.imshow(flower, cmap="gray_r", alpha=0.25)
for (row, column), radius_sq in zip(points[::9], radii_sq[::9]):
    right.add_patch(plt.Circle((column, row), radius_sq**0.5, fill=False, color="steelblue", linewidth=0.4))
right.scatter(points[:, 1], points[:, 0], s=1, color="crimson")
right.set_title(f"medial_axis(): {len(points)} balls, a ninth of them drawn")
figure.savefig("medial_axis.png", dpi=100)
