# SPDX-License-Identifier: Apache-2.0
"""Questions to trees against plain loops of numpy, and shapes of all kinds."""
import numpy as np
import pytest
import spheretree
from conftest import random_poses


@pytest.fixture
def tree(bone):
    return spheretree.build(bone, quality="fast", cover="balls", anisotropy=0.5)


def leaves(tree, pose=None):
    finest = tree.levels[0]
    centers = finest.centers if pose is None else finest.centers @ pose[:3, :3].T + pose[:3, 3]
    return centers, finest.radii.astype(float)


def gaps(tree, pose):
    """Of all pairs of leaf spheres of the tree and of itself, moved."""
    (a, ra), (b, rb) = leaves(tree), leaves(tree, pose)
    return np.linalg.norm(a[:, None] - b, axis=-1) - ra[:, None] - rb


def test_distances_are_those_of_all_pairs(tree):
    query, moved = tree.query(), random_poses(40)
    found = query.distance(query, moved, signed=True)
    for i, pose in enumerate(moved):
        all_gaps = gaps(tree, pose)
        assert found.distance[i] == pytest.approx(all_gaps.min(), abs=1e-4)
        a, b = found.ids[i] - tree.levels[0].ids[0]
        assert all_gaps[a, b] == pytest.approx(found.distance[i], abs=1e-4)
        assert found.lower[i] <= max(found.distance[i], 0) + 1e-9
        assert found.upper[i] >= found.lower[i]
    assert (found.distance > 1).any() and (found.distance < 0).any()
    apart = found.distance > 0
    between = np.linalg.norm(found.points_a - found.points_b, axis=-1)
    assert np.allclose(between[apart], found.distance[apart], atol=1e-4)
    near = query.distance(query, moved, upto=0.5)
    assert np.isinf(near.distance[found.distance > 1]).all() and np.isnan(near.points_a[found.distance > 1]).all()


def on_the_way(start, end, time):
    """A pose of a motion that does not turn."""
    return start + time * (end - start)


def test_nothing_meets_before_the_first_contact(tree):
    query = tree.query()
    start, end = np.tile(np.eye(4), (40, 1, 1)), np.tile(np.eye(4), (40, 1, 1))
    random = np.random.default_rng(5)
    start[:, :3, 3] = random.uniform(-40, 40, (40, 3))
    end[:, :3, 3] = -start[:, :3, 3] + random.uniform(-12, 12, (40, 3))
    found = query.continuous_collide(query, start, end, tolerance=1e-3)
    meets = ~np.isnan(found.time)
    assert meets.sum() > 5 and (found.ids[meets] >= 0).all() and (found.ids[~meets] == -1).all()
    for i in range(40):
        for time in np.linspace(0, 1, 9) * (found.time[i] if meets[i] else 1):
            least = gaps(tree, on_the_way(start[i], end[i], time)).min()
            assert least > -1e-4
        if meets[i]:
            assert gaps(tree, on_the_way(start[i], end[i], found.time[i])).min() < 1e-3 + 1e-4
    # Where each goes half of the way it is the same, and so it is for a tree that stands elsewhere.
    middle = 0.5 * (start - end) * [[0, 0, 0, 1]] + np.eye(4)
    half = query.continuous_collide(
        query, start, on_the_way(start, end, 0.5), own_end=middle, tolerance=1e-3)
    assert np.allclose(half.time, found.time, atol=1e-4, equal_nan=True)
    aside = np.eye(4)
    aside[:3, 3] = [100, 2, 3]
    there = query.continuous_collide(query, aside @ start, aside @ end, own_start=aside, tolerance=1e-3)
    assert np.allclose(there.time, found.time, atol=1e-4, equal_nan=True)
    turned = random_poses(1, seed=4)[0]
    assert query.continuous_collide(query, turned, turned).time.shape == ()
    assert query.continuous_collide(query, start.reshape(5, 8, 4, 4), turned).points.shape == (5, 8, 3)


def turned_about_z(angle):
    pose = np.eye(4)
    pose[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    return pose


def test_a_turn_meets_what_its_poses_meet(tree):
    query, start = tree.query(), np.eye(4)
    start[:3, 3] = [5, -20, 0]
    found = query.continuous_collide(query, start, turned_about_z(2.5) @ start, tolerance=1e-4)
    assert 0.05 < found.time < 0.95
    at = [turned_about_z(2.5 * (found.time + step)) @ start for step in (-1e-3, 1e-3)]
    assert list(query.collide(query, np.array(at)).spheres) == [-1, 1]
    # The same, as the other one sees it.
    own = query.continuous_collide(query, np.eye(4), np.eye(4), own_start=start, own_end=turned_about_z(2.5) @ start)
    assert own.time == pytest.approx(found.time, abs=1e-3)


def test_motions_that_mean_nothing(tree):
    query = tree.query()
    with pytest.raises(spheretree.InputError, match="own_end"):
        query.continuous_collide(query, np.eye(4), np.eye(4), own_end=np.eye(3))
    with pytest.raises(spheretree.InputError, match="cannot be broadcast"):
        query.continuous_collide(query, np.tile(np.eye(4), (2, 1, 1)), np.tile(np.eye(4), (3, 1, 1)))
    with pytest.raises(spheretree.InputError, match="tolerance"):
        query.continuous_collide(query, np.eye(4), np.eye(4), tolerance=-1)
    with pytest.raises(TypeError, match="other must be"):
        query.continuous_collide(tree, np.eye(4), np.eye(4))


def test_collisions_are_those_of_all_pairs(tree):
    query, moved = tree.query(), random_poses(60, seed=2)
    least = np.array([gaps(tree, pose).min() for pose in moved])
    for margin in (0, 2):
        found = query.collide(query, moved, margin=margin)
        assert np.array_equal(found.spheres, np.where(least < margin, 1, -1))
    found = query.collide(query, moved, objects=True)
    touching = found.touching
    assert np.array_equal(touching, found.spheres == spheretree.Verdict.TOUCHING)
    assert touching.any() and not touching.all()
    assert (found.objects[~touching] == -1).all() and (found.objects[touching] >= 0).all()
    assert np.isnan(found.distance[~touching]).all() and (found.distance[touching] <= 1e-4).all()
    assert (found.ids[~touching] == -1).all() and (found.ids[touching] >= 0).all()
    assert np.allclose(np.linalg.norm(found.normals[touching], axis=-1), 1)


def test_points_are_in_the_object_just_where_its_voxels_are(bone, tree):
    points = np.random.default_rng(3).uniform(-2, 22, (5000, 3))
    voxels = np.rint(points / 0.5).astype(int)
    inside = ((voxels >= 0) & (voxels < bone.shape)).all(axis=1)
    inside[inside] = bone[tuple(voxels[inside].T)]
    query = tree.query()
    assert np.array_equal(query.contains(points), inside) and inside.any()
    centers, radii = leaves(tree)
    depths = np.linalg.norm(points[:, None] - centers, axis=-1) - radii
    found = query.nearest(points)
    assert np.allclose(found.distance, depths.min(axis=1), atol=1e-4)
    rows = np.arange(len(points))
    assert np.allclose(depths[rows, found.ids - tree.levels[0].ids[0]], found.distance, atol=1e-4)
    assert np.allclose(np.linalg.norm(found.gradients, axis=1), 1)
    near = query.nearest(points, 1)
    assert np.array_equal(near.ids >= 0, found.distance <= near.distance.clip(max=1))
    balls = np.column_stack([points, np.full(len(points), 0.25)])
    robot = query.sphere_distances(balls, 3)
    assert np.allclose(robot.distance, np.minimum(found.distance - 0.25, 3), atol=1e-4)


def test_rays_enter_the_first_sphere(tree):
    random = np.random.default_rng(4)
    origins = random.uniform(-30, 30, (400, 3))
    directions = random.uniform(0, 20, (400, 3)) - origins
    centers, radii = leaves(tree)
    ways = directions / np.linalg.norm(directions, axis=1)[:, None]
    off = centers[None] - origins[:, None]
    along = (off * ways[:, None]).sum(axis=-1)
    half = radii**2 - (off**2).sum(axis=-1) + along**2
    inside = (np.linalg.norm(off, axis=-1) < radii).any(axis=1)
    enter = np.where((half > 0) & (along > 0), along - np.sqrt(np.maximum(half, 0)), np.inf)
    expected = np.where(inside, 0, enter.min(axis=1)) / np.linalg.norm(directions, axis=1)
    query = tree.query()
    hits = query.intersect(origins, directions)
    grazes = (np.abs(half) < 1e-2).any(axis=1)
    assert np.allclose(hits.t[~grazes], expected[~grazes], atol=1e-4)
    assert np.array_equal(hits.ids >= 0, np.isfinite(hits.t))
    assert np.array_equal(query.occluded(origins, directions), hits.ids >= 0)
    assert not query.occluded(origins, directions, tfar=0.01)[hits.t > 0.02].any()


def test_answers_have_the_shape_of_the_question(tree):
    query = tree.query()
    one = query.distance(query)
    assert one.distance.shape == () and one.points_a.shape == (3,) and one.ids.shape == (2,)
    many = query.collide(query, random_poses(6).reshape(2, 3, 4, 4))
    assert many.spheres.shape == (2, 3) and many.points.shape == (2, 3, 3)
    assert query.contains(np.zeros((4, 0, 3))).shape == (4, 0)
    assert query.nearest([0, 0, 0]).distance.shape == ()
    assert query.intersect([0, 0, 0], np.ones((5, 7, 3))).t.shape == (5, 7)
    assert query.sphere_distances(np.zeros((2, 5, 8, 4)), 1).gradients.shape == (2, 5, 8, 3)


def test_answers_are_the_same_for_any_number_of_threads(tree):
    query, moved = tree.query(), random_poses(200)
    for one, two in zip(query.distance(query, moved, threads=1), query.distance(query, moved, threads=2)):
        assert one.tobytes() == two.tobytes()


def test_the_usual_trees_answer_and_are_never_too_far(bone):
    tree = spheretree.build(bone, quality="fast")
    query, exact = tree.query(), tree.query(exact=True)
    moved = random_poses(50)
    moved[:, :3, 3] *= 2
    near, least = query.distance(query, moved).distance, exact.distance(exact, moved).distance
    assert (near >= least - 1e-4).all() and (near - least).max() < 1.5
    assert query.contains(np.argwhere(bone)).all()
    coarse = tree.query(level=1)
    assert (coarse.distance(coarse, moved).lower <= query.distance(query, moved).upper).all()
    assert np.allclose(tree.query(scale=3).distance(tree.query(scale=3)).upper, 0)


def test_a_pose_that_is_not_rigid_is_an_error_that_says_how_far_off(tree):
    query = tree.query()
    with pytest.raises(spheretree.InputError, match="not rigid"):
        query.collide(query, np.diag([2, 2, 2, 1]))
    with pytest.raises(spheretree.InputError, match="not rigid|mirrors"):
        query.distance(query, np.diag([-1, 1, 1, 1]))
    with pytest.raises(spheretree.InputError, match=r"pose has shape \(3, 4\)"):
        query.collide(query, np.eye(4)[:3])
    with pytest.raises(spheretree.InputError, match="margin"):
        query.collide(query, margin=-1)
    with pytest.raises(TypeError, match="other must be a spheretree.Query"):
        query.collide(tree)


def test_bad_points_and_rays_are_errors(tree):
    query = tree.query()
    with pytest.raises(spheretree.InputError, match=r"points has shape \(2,\)"):
        query.contains([0, 1])
    with pytest.raises(spheretree.InputError, match="finite"):
        query.nearest([0, np.nan, 0])
    with pytest.raises(spheretree.InputError):
        query.nearest([0, 0, 0], -1)
    with pytest.raises(spheretree.InputError, match="direction"):
        query.intersect([0, 0, 0], [0, 0, 0])
    with pytest.raises(spheretree.InputError, match="origins and directions"):
        query.intersect(np.zeros((2, 3)), np.zeros((4, 3)))
    with pytest.raises(spheretree.InputError, match="directions has shape"):
        query.occluded(np.zeros((2, 3)), np.zeros((2, 2)))
    with pytest.raises(spheretree.InputError, match="spheres has shape"):
        query.sphere_distances(np.zeros((2, 3)), 1)


@pytest.mark.parametrize("upto", [-1, -1e-9, float("nan"), -np.inf])
def test_a_distance_below_zero_is_no_bound(tree, upto):
    query = tree.query()
    with pytest.raises(spheretree.InputError, match="upto="):
        query.distance(query, upto=upto)
    assert query.distance(query, upto=0).distance == 0


def test_complex_numbers_are_no_poses_points_or_rays(tree):
    query = tree.query()
    pose, point = np.eye(4) * (1 + 0j), np.zeros(3, dtype=complex)
    for ask in (lambda: query.collide(query, pose), lambda: query.distance(query, pose.tolist())):
        with pytest.raises(TypeError, match="pose must hold real numbers, not complex128"):
            ask()
    for ask in (lambda: query.contains(point), lambda: query.nearest(point)):
        with pytest.raises(TypeError, match="points must hold real"):
            ask()
    with pytest.raises(TypeError, match="origins must hold real"):
        query.intersect(point, [1, 0, 0])
    with pytest.raises(TypeError, match="directions must hold real"):
        query.occluded([0, 0, 0], point)


def test_trees_without_answers_are_refused_with_the_reason(bone):
    few = spheretree.build(bone, 8, quality="fast").query()
    with pytest.raises(spheretree.InputError, match="cannot say what its object is"):
        few.contains([20, 9, 8])
    with pytest.raises(spheretree.InputError, match="side=fit"):
        spheretree.build(bone, 8, side="fit").query()
    reversible = spheretree.build(bone, tree="reversible")
    with pytest.raises(spheretree.InputError, match="reversible"):
        reversible.query()
    assert reversible.query(exact=True).contains([20, 9, 8])
    with pytest.raises(spheretree.InputError, match="level"):
        few.tree.query(level=9)
    with pytest.raises(spheretree.InputError, match="level=-1"):
        few.tree.query(level=-1)
    with pytest.raises(spheretree.InputError, match="scale"):
        few.tree.query(scale=0)
