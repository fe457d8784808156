# SPDX-License-Identifier: Apache-2.0
"""A bar while a tree is built, which Ctrl-C ends within a second; then errors against spheres, in progress.png."""
import sys

import matplotlib.pyplot as plt
import numpy as np
import spheretree


def bar(done, stage):
    print(f"\r[{'#' * round(30 * done):30}] {100 * done:3.0f}% {stage:30.30}", end="", file=sys.stderr, flush=True)


x, y, z = np.mgrid[:96, :96, :96] / 9
gyroid = np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x) > 0.6
try:
    tree = spheretree.build(gyroid, [2048, 512, 128, 32, 8], quality="fast", progress=bar)
except KeyboardInterrupt:
    sys.exit("\nstopped; nothing is left behind")
print(file=sys.stderr)

spheres = [len(level) for level in tree.levels]
plt.figure(figsize=(6, 4))
plt.loglog(spheres, [level.errors["stored_hamming_percent"] for level in tree.levels], "o-")
plt.xlabel("spheres")
plt.ylabel("voxels in excess (%)")
plt.title("what more spheres are good for")
plt.grid(which="both", alpha=0.3)
plt.tight_layout()
plt.savefig("progress.png", dpi=100)
