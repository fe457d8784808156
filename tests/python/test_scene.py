# SPDX-License-Identifier: Apache-2.0
"""Scenes of many bodies, against the questions to two of them."""
import threading
import time

import numpy as np
import pytest
import spheretree
from conftest import random_poses


@pytest.fixture
def body(bone):
    return spheretree.build(bone, quality="fast", cover="balls", anisotropy=0.5).query()


def poses(count, seed=1, size=30):
    return random_poses(count, seed, size)


def scene_of(body, places):
    scene = spheretree.Scene()
    for number, place in enumerate(places):
        assert scene.add(body, place) == number
    return scene


def all_pairs(count):
    return np.array([(a, b) for a in range(count) for b in range(a + 1, count)])


def seen_from(a, b):
    return np.linalg.inv(a) @ b


def test_pairs_are_those_of_all_pairs(body):
    places = poses(14)
    scene, pairs = scene_of(body, places), all_pairs(14)
    for margin in (0, 4):
        found = scene.touching_pairs(margin=margin)
        touch = [body.collide(body, seen_from(places[a], places[b]), margin=margin).spheres == 1 for a, b in pairs]
        assert np.array_equal(found.bodies, pairs[touch])
        assert 0 < len(found.bodies) < len(pairs)
    assert (found.distance < 4).all() and (found.ids >= 0).all()
    assert np.allclose(np.linalg.norm(found.normals, axis=1), 1)
    # Where the two spheres are, in the world.
    leaves = body.tree.levels[0]
    for row, (a, b) in enumerate(found.bodies):
        centers = [places[n, :3, :3] @ leaves.centers[i - leaves.ids[0]] + places[n, :3, 3]
                   for n, i in zip((a, b), found.ids[row])]
        radii = [leaves.radii[i - leaves.ids[0]] for i in found.ids[row]]
        gap = np.linalg.norm(centers[1] - centers[0]) - sum(radii)
        assert gap == pytest.approx(found.distance[row], abs=1e-4)
        along = np.cross(centers[1] - centers[0], found.points[row] - centers[0])
        assert np.linalg.norm(along) < 1e-3 * np.linalg.norm(centers[1] - centers[0])
    certain = scene.touching_pairs(objects=True)
    assert set(certain.objects) <= {0, 1} and (certain.objects == 1).any()


def test_contacts_are_the_deepest_of_each_pair(body):
    places = poses(14)
    scene = scene_of(body, places)
    one, several = scene.touching_pairs(), scene.touching_pairs(max_contacts=5)
    assert np.array_equal(np.unique(several.bodies, axis=0), one.bodies)
    single = scene.touching_pairs(max_contacts=1)
    assert np.array_equal(single.bodies, one.bodies)
    for pair, (a, b) in enumerate(one.bodies):
        rows = (several.bodies == (a, b)).all(axis=1)
        alone = body.contacts(body, seen_from(places[a], places[b]), max_contacts=5)
        assert np.allclose(several.distance[rows], alone.distance, atol=1e-6)
        assert (np.diff(alone.distance) >= 0).all() and len(alone.distance) <= 5
        assert single.distance[pair] == several.distance[rows][0]


def test_contacts_of_poses_are_the_deepest_of_all_pairs_of_spheres(body):
    moved = poses(30, seed=2, size=12)
    leaves = body.tree.levels[0]
    found = body.contacts(body, moved.reshape(5, 6, 4, 4), max_contacts=4)
    assert found.pose.dtype == np.int64 and 0 < len(np.unique(found.pose)) < 30
    for i, pose in enumerate(moved):
        centers = leaves.centers @ pose[:3, :3].T + pose[:3, 3]
        gaps = np.linalg.norm(leaves.centers[:, None] - centers, axis=-1) - np.add.outer(leaves.radii, leaves.radii)
        deepest = np.sort(gaps[gaps <= 0])[:4]
        assert np.allclose(found.distance[found.pose == i], deepest, atol=1e-4)
    first = body.contacts(body, moved, max_contacts=1)
    assert np.array_equal(first.pose, np.unique(found.pose))
    assert np.allclose(first.distance, [found.distance[found.pose == i][0] for i in first.pose])
    near = body.contacts(body, moved, max_contacts=1, margin=3)
    assert len(near.pose) > len(first.pose) and (near.distance < 3).all()


def test_bodies_meet_as_two_of_them_do(body):
    start, end = poses(9, seed=3, size=60), poses(9, seed=4, size=40)
    scene, pairs = scene_of(body, start), all_pairs(9)
    found = scene.first_contacts(end=end, tolerance=1e-4)
    a, b = pairs.T
    alone = body.continuous_collide(body, start[b], end[b], own_start=start[a], own_end=end[a], tolerance=1e-4)
    meets = ~np.isnan(alone.time)
    assert np.array_equal(found.bodies, pairs[meets]) and 0 < meets.sum() < len(pairs)
    assert np.allclose(found.time, alone.time[meets])
    assert np.allclose(found.points, alone.points[meets])
    again = spheretree.Scene()
    for _ in range(9):
        again.add(body)
    other = again.first_contacts(start=start, end=end, tolerance=1e-4)
    assert all(np.allclose(x, y) for x, y in zip(found, other))  # poses were rounded on their way


def test_a_margin_is_kept_on_the_way(body):
    start, end = poses(9, seed=3, size=60), poses(9, seed=4, size=40)
    scene = scene_of(body, start)
    near, wide = scene.first_contacts(end=end), scene.first_contacts(end=end, margin=5)
    assert {tuple(pair) for pair in near.bodies} < {tuple(pair) for pair in wide.bodies}
    a, b = wide.bodies.T
    alone = body.continuous_collide(body, start[b], end[b], own_start=start[a], own_end=end[a], margin=5)
    assert np.allclose(wide.time, alone.time) and (wide.distance < 5.01).all()


def test_answers_are_told_in_a_line(body):
    scene = scene_of(body, poses(14))
    for answer in (scene.touching_pairs(), scene.first_contacts(end=poses(14, seed=2)), body.collide(body, poses(900)),
                   body.distance(body, poses(3)), body.contacts(body), body.nearest(np.zeros((0, 3))),
                   body.intersect([0, 0, 0], [1, 0, 0]), body.continuous_collide(body, poses(3), poses(3, seed=2))):
        assert repr(answer).startswith("<spheretree.") and len(repr(answer)) < 80, repr(answer)
    assert "900" in repr(body.collide(body, poses(900)))


def test_poses_may_be_given_with_the_question(body):
    places, frames = poses(10), poses(60, seed=7, size=15).reshape(2, 3, 10, 4, 4)
    scene = scene_of(body, places)
    found = scene.touching_pairs(frames, max_contacts=2)
    assert np.allclose(scene.pose(3), places[3])
    assert (scene.touching_pairs().frame == 0).all() and set(found.frame) == set(range(6))
    for number, frame in enumerate(frames.reshape(6, 10, 4, 4)):
        for body_number, place in enumerate(frame):
            scene.set_pose(body_number, place)
        alone, rows = scene.touching_pairs(max_contacts=2), found.frame == number
        assert all(np.array_equal(x[rows], y) for x, y in zip(found[1:], alone[1:]))
    assert len(scene.touching_pairs(np.zeros((0, 10, 4, 4))).frame) == 0


def test_many_ways_are_asked_about_at_once(body):
    start, ends = poses(6, seed=3, size=60), poses(24, seed=4, size=40).reshape(4, 6, 4, 4)
    scene = scene_of(body, start)
    found = scene.first_contacts(end=ends)
    assert len(set(found.frame)) > 1
    for number, end in enumerate(ends):
        alone, rows = scene.first_contacts(end=end), found.frame == number
        assert all(np.array_equal(x[rows], y) for x, y in zip(found[1:], alone[1:]))
    with pytest.raises(spheretree.InputError, match=r"cannot be broadcast: start \(3,\), end \(4,\)"):
        scene.first_contacts(start=ends[:3], end=ends)


def test_pairs_are_ignored_and_bodies_removed(body):
    scene = spheretree.Scene()
    assert len(scene) == 0 and len(scene.touching_pairs().bodies) == 0
    for _ in range(3):
        scene.add(body)
    assert np.array_equal(scene.touching_pairs().bodies, all_pairs(3))
    scene.ignore(2, 0)
    assert scene.is_ignored(0, 2) and np.array_equal(scene.touching_pairs().bodies, [(0, 1), (1, 2)])
    scene.ignore(0, 2, ignored=False)
    assert len(scene.touching_pairs().bodies) == 3
    scene.remove(1)
    assert len(scene) == 3 and 1 not in scene and 2 in scene and 5 not in scene
    there = np.tile(np.eye(4), (3, 1, 1))
    there[1] = np.nan  # of the body that is gone
    assert np.array_equal(scene.touching_pairs(there).bodies, [(0, 2)])
    assert np.array_equal(scene.first_contacts(end=there).bodies, [(0, 2)])
    assert np.array_equal(scene.first_contacts(end=np.tile(np.eye(4), (3, 1, 1))).bodies, [(0, 2)])
    assert scene.query(0) is body and repr(scene) == "<spheretree.Scene of 2 bodies>"
    assert "arm" not in scene and 2**40 not in scene
    with pytest.raises(spheretree.InputError, match="body 1 of the scene was removed"):
        scene.set_pose(1, np.eye(4))


def test_answers_are_the_same_for_any_number_of_threads(body):
    scene = scene_of(body, poses(40))
    for one, two in zip(scene.touching_pairs(max_contacts=3, threads=1), scene.touching_pairs(max_contacts=3, threads=2)):
        assert one.tobytes() == two.tobytes()


def test_a_scene_may_change_while_it_is_asked(body):
    scene, stop = spheretree.Scene(), threading.Event()
    for _ in range(12):
        scene.add(body)

    def change():
        while not stop.is_set():
            scene.ignore(0, 1)
            scene.ignore(0, 1, ignored=False)

    thread = threading.Thread(target=change)
    thread.start()
    try:
        counts, end = set(), time.monotonic() + 60
        while len(counts) < 2 and time.monotonic() < end:
            counts.add(len(scene.touching_pairs().bodies))
    finally:
        stop.set()
        thread.join()
    assert counts == {65, 66}


def test_what_is_wrong_is_named(body):
    scene = scene_of(body, poses(3))
    with pytest.raises(spheretree.InputError, match="the scene has no body 3: it has 3"):
        scene.pose(3)
    for ask in (lambda: scene.ignore(0, -1), lambda: scene.query(-1), lambda: scene.remove(7)):
        with pytest.raises(spheretree.InputError, match="the scene has no body"):
            ask()
    with pytest.raises(TypeError, match="body must be a spheretree.Query, not Tree"):
        scene.add(body.tree)
    with pytest.raises(TypeError, match="a must be a whole number, not str"):
        scene.ignore("arm", 1)
    with pytest.raises(spheretree.InputError, match=r"poses has shape \(2, 4, 4\): it takes one pose for each of 3"):
        scene.touching_pairs(poses(2))
    with pytest.raises(spheretree.InputError, match=r"end has shape \(4, 4\)"):
        scene.first_contacts(end=np.eye(4))
    with pytest.raises(spheretree.InputError, match=r"pose has shape \(1, 4, 4\): it takes \(4, 4\)"):
        scene.set_pose(0, poses(1))
    with pytest.raises(spheretree.InputError, match="pose: .*not rigid"):
        scene.add(body, np.diag([2, 2, 2, 1]))
    bad = poses(6).reshape(2, 3, 4, 4)
    bad[1, 1, :3, :3] *= 2
    with pytest.raises(spheretree.InputError, match="poses of frame 1, body 1: .*not rigid"):
        scene.touching_pairs(bad)
    with pytest.raises(spheretree.InputError, match="end of frame 1, body 1: .*not rigid"):
        scene.first_contacts(end=bad)
    with pytest.raises(spheretree.InputError, match="poses of body 2: .*not rigid"):
        scene.touching_pairs(bad[1][[0, 2, 1]])
    with pytest.raises(spheretree.InputError, match="margin"):
        scene.touching_pairs(margin=-1)
    with pytest.raises(TypeError, match="margin must be a number, not str"):
        scene.touching_pairs(margin="2mm")
    with pytest.raises(TypeError, match="progress must be a function or None, not int"):
        scene.touching_pairs(progress=5)
    with pytest.raises(TypeError, match="pose must hold real numbers, not <U4"):
        scene.set_pose(0, "pose")
    for wrong in (0, -3, 10**7):
        for ask in (scene.touching_pairs, lambda **given: body.contacts(body, **given)):
            with pytest.raises(spheretree.InputError, match=f"max_contacts={wrong} is out of range"):
                ask(max_contacts=wrong)
    assert len(scene) == 3
