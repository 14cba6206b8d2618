"""Collisions between links, against closed forms of an arm that turns past a post."""

import re
from math import asin, pi

import numpy as np
import pytest
import trimesh

from tests.bench.bench_srdf import two_armed
from urdfkit.description import load
from urdfkit.kinematics.self_collision import collision_matrix
from urdfkit.kinematics.self_collision.box_overlap import overlapping
from urdfkit.kinematics.self_collision.collision_shapes import box_around, shapes_by_link
from urdfkit.kinematics.srdf import find_groups


def link(name, geometry="", xyz="0 0 0"):
    shape = f'<collision><origin xyz="{xyz}"/><geometry>{geometry}</geometry></collision>' if geometry else ""
    return f'<link name="{name}">{shape}</link>'


def joint(name, kind, parent, child, xyz="0 0 0", limit="", extra=""):
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{xyz}"/><axis xyz="0 0 1"/>{limit}{extra}</joint>'
    )


def test_the_box_around_shapes_has_half_their_extent_about_their_middle(tmp_path):
    text = link("a", "<box size='1 2 3'/>", "5 -7 9")
    (tmp_path / "r.urdf").write_text(f"<robot name='r'>{text}</robot>")
    middle, half = box_around(shapes_by_link(load(tmp_path / "r.urdf"))["a"])
    assert (middle.tolist(), half.tolist()) == ([5.0, -7.0, 9.0], [0.5, 1.0, 1.5])


def turning(tmp_path, post, ball_radius, length=1.0, limit=None):
    """Return an arm that turns about z with a ball at its end, and a post on the ground."""
    ball = f'<sphere radius="{ball_radius}"/>'
    kind = "continuous" if limit is None else "revolute"
    bounds = "" if limit is None else f'<limit lower="{limit[0]}" upper="{limit[1]}" effort="1" velocity="1"/>'
    path = tmp_path / "turning.urdf"
    turn = joint("turn", kind, "base", "arm", "0 0 0.5", bounds)
    path.write_text(
        f'<robot name="turning">{link("base")}{link("post", post)}{link("arm")}{link("ball", ball)}'
        f"{joint('post_joint', 'fixed', 'base', 'post', '1 0 0')}{turn}"
        f"{joint('far', 'prismatic', 'arm', 'ball', f'{length} 0 -0.5', RAIL)}</robot>"
    )
    return path


RAIL = '<limit lower="0" upper="0.0001" effort="1" velocity="1"/>'


def only_pair(path, **options):
    (pair,) = collision_matrix(path, **options).pairs
    return pair


def separated(path):
    """Give the arm a shape far away, so that its ball and the post are no neighbours."""
    text = path.read_text().replace('<link name="arm"></link>', link("arm", '<sphere radius="0.01"/>', "0 0 5"))
    path.write_text(text.replace('<link name="base"></link>', link("base", '<sphere radius="0.01"/>', "0 0 -5")))
    return next(pair for pair in collision_matrix(path).pairs if {pair.first, pair.second} == {"post", "ball"})


def test_the_rate_of_collisions_is_that_of_the_closed_form(tmp_path):
    pair = separated(turning(tmp_path, '<sphere radius="0.05"/>', 0.05))
    rate = 4.0 * asin(0.05) / (2.0 * pi)  # |2·sin(θ/2)| < 0.1
    assert pair.reason == "Default"  # the arm rests at the post
    assert pair.hits / pair.samples == pytest.approx(rate, rel=0.25)  # 200 hits: a standard deviation of 7 %
    assert rate < pair.rate_bound < 1.6 * rate
    angle = pair.collision["turn"]
    assert abs(2.0 * np.sin(angle / 2.0)) <= 0.1 + 1e-3


def test_a_collision_that_no_sample_shows_is_found_by_the_search(tmp_path):
    # The ball reaches the post only in the last 1e-6 rad before a limit, and rests at the other.
    contact = 2.0 * asin(0.05) - 2.0 * pi
    pair = separated(turning(tmp_path, '<sphere radius="0.05"/>', 0.05, limit=(contact - 1e-6, -0.3)))
    assert pair.reason is None
    assert pair.hits <= 1
    assert pair.collision["turn"] == pytest.approx(contact, abs=1e-3)
    assert pair.rate_bound < 1e-4


def test_the_closest_approach_of_a_pair_that_never_collides(tmp_path):
    pair = separated(turning(tmp_path, '<sphere radius="0.05"/>', 0.05, length=0.7))
    assert (pair.reason, pair.hits, pair.collision) == ("Never", 0, None)
    assert pair.distance == pytest.approx(0.3 - 0.1 - 1e-4, abs=2e-4)
    assert pair.rate_bound == pytest.approx(3.0 / 100_000)


@pytest.mark.slow
def test_a_finger_that_touches_its_shoulder_in_a_narrow_range_is_found(tmp_path):
    # Nine joints lie between the links; descents from random starts alone end 1 mm apart and more.
    text = two_armed(tmp_path).read_text()
    kept = ("right_arm_1", "right_arm_4", "right_finger_1_2")
    path = tmp_path / "arm.urdf"
    path.write_text(re.sub(r'<link name="(\w+)">.*?</link>', lambda m: m[0] if m[1] in kept else link(m[1]), text))
    for seed in range(2):
        pairs = {(pair.first, pair.second): pair for pair in collision_matrix(path, samples=1000, seed=seed).pairs}
        assert (pairs[kept[0], kept[2]].hits, pairs[kept[0], kept[2]].reason) == (0, None)


def test_links_that_overlap_in_each_sample_always_collide(tmp_path):
    pair = separated(turning(tmp_path, '<sphere radius="2.5"/>', 0.05))
    assert pair.reason == "Always"
    assert pair.hits == pair.samples >= 1000


def test_a_ball_inside_of_a_ring_touches_its_hull_only(tmp_path):
    ring = trimesh.creation.torus(1.0, 0.05)
    ring.export(tmp_path / "ring.stl")
    pair = separated(turning(tmp_path, '<mesh filename="ring.stl"/>', 0.05, length=1.0, limit=(-0.2, 0.2)))
    assert pair.reason == "Never"
    assert pair.distance == pytest.approx(1.0 - 0.05 - 0.05 - 2.0 * np.sin(0.1), abs=5e-3)  # the torus has facets


def test_neighbours_are_adjacent_also_through_links_without_shapes(tmp_path):
    pair = only_pair(turning(tmp_path, '<sphere radius="0.05"/>', 0.05), samples=10)
    assert pair.reason == "Adjacent"


def test_the_same_seed_gives_the_same_matrix():
    first, second = (collision_matrix("rrbot", samples=500, seed=3) for _ in range(2))
    assert first == second


def test_boxes_overlap_where_a_fine_search_says_so():
    random = np.random.default_rng(5)
    rotation = np.linalg.qr(random.normal(size=(300, 3, 3)))[0]
    translation = random.uniform(-1.5, 1.5, (300, 3))
    first, second = np.array([0.5, 0.3, 0.7]), np.array([0.2, 0.6, 0.4])
    kept = set(overlapping(rotation, translation, first, second).tolist())
    grid = np.stack(np.meshgrid(*[np.linspace(-1.0, 1.0, 13)] * 3), axis=-1).reshape(-1, 3) * second
    inside = {i for i in range(300) if (np.abs(grid @ rotation[i].T + translation[i]) <= first).all(axis=1).any()}
    assert inside <= kept
    assert 50 < len(inside) <= len(kept) < 1.3 * len(inside)


def test_arms_and_grippers_are_found_by_themselves():
    groups, effectors = find_groups(load("seven_dof_arm"))
    assert [(group.name, group.base, group.tip, len(group.joints)) for group in groups] == [
        ("arm", "base_link", "gripper_roll_link", 7),
        ("gripper", "", "", 2),
    ]
    assert [(each.parent, each.group, each.parent_group) for each in effectors] == [
        ("gripper_roll_link", "gripper", "arm")
    ]
    assert find_groups(load("simpleton")) == ([], [])
