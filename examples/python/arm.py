# SPDX-License-Identifier: Apache-2.0
"""A planner's questions: thousands of configurations of an arm beside a shelf. Which are free, and is the way between
two of them free? Ends in the picture arm.png."""
import matplotlib.pyplot as plt
import numpy as np
import spheretree

LINKS, LENGTH = 4, 0.3  # metres

x, y, z = np.mgrid[-4:35, -4:5, -4:5]
bone = np.hypot(y, z) < 3 + (np.abs(x - 15) > 11)
link_tree = spheretree.build(bone, spheres=[32, 8], anisotropy=0.01, origin=(-0.04, -0.04, -0.04), quality="fast")
shelf = np.ones((40, 60, 80), dtype=bool)
shelf[:34, 2:-2, 4:37] = shelf[:34, 2:-2, 43:-4] = False  # two boards, open to the front
shelf_tree = spheretree.build(shelf, anisotropy=0.01, origin=(0.5, -0.3, -0.4), quality="fast")


def placed(joints):
    """Poses of the links, one behind the other, for joints of shape (..., LINKS): shape (..., LINKS + 1, 4, 4)."""
    poses = np.tile(np.eye(4), (*joints.shape[:-1], LINKS + 1, 1, 1))  # the last one is the shelf's
    angle, place = np.zeros(joints.shape[:-1]), np.zeros((*joints.shape[:-1], 3))
    for link in range(LINKS):
        angle = angle + joints[..., link]
        poses[..., link, 0, 0] = poses[..., link, 2, 2] = np.cos(angle)
        poses[..., link, 0, 2], poses[..., link, 2, 0] = -np.sin(angle), np.sin(angle)
        poses[..., link, :3, 3] = place
        place = place + LENGTH * np.stack([np.cos(angle), 0 * angle, np.sin(angle)], axis=-1)
    return poses


scene = spheretree.Scene()
links = [scene.add(link_tree.query()) for _ in range(LINKS)]
scene.add(shelf_tree.query())
for a, b in zip(links, links[1:]):
    scene.ignore(a, b)  # neighbours always touch

joints = np.random.default_rng(1).uniform(-1.5, 1.5, (5000, LINKS))
poses = placed(joints)
is_free = np.ones(len(joints), dtype=bool)
is_free[scene.touching_pairs(poses, margin=0.01).frame] = False
print(f"{is_free.sum()} of {len(joints)} configurations are free")

# From each free configuration to the next, in steps: links turn about joints, and so are a little off the screws of each.
start, end = joints[is_free][:-1], joints[is_free][1:]
steps = 50
ways = placed(start[:, None] + np.linspace(0, 1, steps + 1)[:, None] * (end - start)[:, None])
turn = np.abs(end - start).sum(axis=1).max() / steps
margin = 2 * turn**2 * LINKS * LENGTH / 3
hit = scene.first_contacts(start=ways[:200, :-1], end=ways[:200, 1:], margin=margin)
blocked = np.unique(np.unravel_index(hit.frame, (200, steps))[0])
print(f"{200 - len(blocked)} of 200 ways are free by {1000 * margin:.0f} mm")
assert 0 < is_free.sum() < len(joints) and 0 < len(blocked) < 200

tips = placed(joints)[..., LINKS - 1, :3, :] @ [LENGTH, 0, 0, 1]
plt.figure(figsize=(6, 6))
plt.scatter(*tips[~is_free][:, [0, 2]].T, s=2, color="0.8", label="touches the shelf or itself")
plt.scatter(*tips[is_free][:, [0, 2]].T, s=2, label="free")
plt.imshow(shelf[:, 30].T, origin="lower", cmap="Oranges", vmax=2, extent=(0.5, 0.9, -0.4, 0.4), zorder=0)
plt.axis("equal")
plt.xlabel("x of the tip (m)")
plt.ylabel("z")
plt.legend(loc="center left", markerscale=5)
plt.savefig("arm.png", dpi=80)
