"""Where shapes touch: the contacts that hold a body, in closed form."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.sim.engine.collision.pair_contacts import Contacts, Placed, contacts
from urdfkit.sim.engine.collision.convex_hull import convex_hull
from urdfkit.sim.engine.collision.geometry_arrays import Geometry
from urdfkit.sim.engine.collision.support_points import BOX, CAPSULE, CYLINDER, HULL, MESH, PLANE, SPHERE, WHEEL

MARGIN = 0.01
SIZES = {
    SPHERE: (0.2, 0.0, 0.0),
    BOX: (0.2, 0.3, 0.1),
    CYLINDER: (0.2, 0.3, 0.0),
    WHEEL: (0.3, 0.05, 0.0),
    CAPSULE: (0.1, 0.25, 0.0),
    HULL: (0.0, 0.0, 0.0),
    MESH: (0.0, 0.0, 0.0),
    PLANE: (0.0, 0.0, 0.0),
}
GEOMETRY = Geometry()
_points = np.random.default_rng(5).normal(size=(20, 3)) * 0.15
DATA = {
    HULL: GEOMETRY.add_hull(convex_hull(_points)),
    MESH: GEOMETRY.add_mesh(trimesh.creation.box((0.5, 0.4, 0.3)).triangles),
}
FLAT = GEOMETRY.add_hull(
    convex_hull(np.array([[-0.2, -0.2, 0.0], [0.2, -0.2, 0.0], [0.2, 0.2, 0.0], [-0.2, 0.2, 0.0]]))
)
PAIRS = list(itertools.combinations_with_replacement(SIZES, 2))
# A wheel's contact is not its lowest point, nor the gap within a closed mesh that of its surface.
SMOOTH = [pair for pair in PAIRS if WHEEL not in pair and MESH not in pair and pair != (PLANE, PLANE)]


def about(axis: tuple[float, float, float], angle: float) -> np.ndarray:
    x, y, z = np.array(axis) / np.linalg.norm(axis)
    K = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + math.sin(angle) * K + (1.0 - math.cos(angle)) * K @ K)


def placed(kind: int, p: tuple[float, float, float] = (0.0, 0.0, 0.0), R: np.ndarray | None = None) -> Placed:
    return Placed(kind, SIZES[kind], np.eye(3) if R is None else R, np.array(p), DATA.get(kind, 0))


def touch(a: Placed, b: Placed, margin: float = MARGIN) -> Contacts:
    found = contacts(a, b, margin=margin, geometry=GEOMETRY)
    assert len(found) <= 8
    assert np.all(np.isfinite(found.points))
    assert np.all(np.isfinite(found.gaps))
    assert np.all(found.gaps < margin)
    assert np.linalg.norm(found.normals, axis=1) == pytest.approx(np.ones(len(found)), abs=1e-12)
    return found


def sorted_rows(points: np.ndarray) -> np.ndarray:
    rounded = np.round(points, 9)
    return points[np.lexsort(rounded.T[::-1])]


ON_ITS_SIDE = about((1.0, 0.0, 0.0), math.pi / 2.0)


@pytest.mark.parametrize("under", [PLANE, BOX, MESH])
@pytest.mark.parametrize(
    ("kind", "R", "height", "count"),
    [
        (SPHERE, np.eye(3), 0.2, 1),
        (BOX, np.eye(3), 0.1, 4),
        (CYLINDER, np.eye(3), 0.3, 4),
        (CYLINDER, ON_ITS_SIDE, 0.2, 2),
        (WHEEL, ON_ITS_SIDE, 0.3, 1),
        (CAPSULE, ON_ITS_SIDE, 0.1, 2),
        (CAPSULE, np.eye(3), 0.35, 1),
    ],
)
def test_a_body_rests_on_a_level_ground(under: int, kind: int, R: np.ndarray, height: float, count: int) -> None:
    ground = Placed(
        under,
        (2.0, 2.0, 0.5),
        np.eye(3),
        np.array([0.1, 0.05, 0.0 if under == PLANE else -0.5]),
        GEOMETRY.add_mesh(trimesh.creation.box((4.0, 4.0, 1.0)).triangles) if under == MESH else 0,
    )
    for depth in (-0.005, 0.0, 1e-6, 0.005):
        found = touch(placed(kind, (0.0, 0.0, height - depth), R), ground)
        assert found.normals == pytest.approx(np.tile([0.0, 0.0, 1.0], (len(found), 1)), abs=1e-7)
        assert found.gaps == pytest.approx(np.full(len(found), -depth), abs=1e-9)
        assert found.points[:, 2] == pytest.approx(np.full(len(found), -0.5 * depth), abs=1e-9)
        # A line across the edge of a triangle is touched there as well.
        assert count <= len(found) <= (count + 1 if under == MESH and count > 1 else count)
        # The middle of the contacts is below that of the body; of a rim that edges of triangles cut, nearly.
        middle = 0.5 * (found.points.min(axis=0) + found.points.max(axis=0))
        exact = 0.03 if under == MESH and kind == CYLINDER else 1e-8
        assert middle[:2] == pytest.approx([0.0, 0.0], abs=exact)


def test_features_stay_while_the_same_corners_touch() -> None:
    ground = Placed(BOX, (2.0, 2.0, 0.5), np.eye(3), np.array([0.0, 0.0, -0.5]))
    first = touch(placed(BOX, (0.0, 0.0, 0.1)), ground)
    at = dict(zip(first.features.tolist(), first.points, strict=True))
    assert len(at) == 4
    for k in range(1, 20):
        turned = about((0.3, 1.0, 2.0), 1e-4 * k)
        later = touch(placed(BOX, (0.003 * k, 0.0, 0.0999), turned), ground)
        assert set(later.features.tolist()) == set(at)
        for feature, point in zip(later.features.tolist(), later.points, strict=True):
            assert point == pytest.approx(at[feature] + [0.003 * k, 0.0, 0.0], abs=2e-3)


def test_boxes_that_cover_each_other_in_part_touch_where_they_do() -> None:
    lower = Placed(BOX, (0.5, 0.5, 0.5), np.eye(3), np.array([0.0, 0.0, -0.5]))
    upper = Placed(BOX, (0.5, 0.5, 0.5), np.eye(3), np.array([0.6, 0.7, 0.499]))
    found = touch(upper, lower)
    expected = [[0.1, 0.2], [0.1, 0.5], [0.5, 0.2], [0.5, 0.5]]
    assert sorted_rows(found.points)[:, :2] == pytest.approx(np.array(expected), abs=1e-8)
    assert found.gaps == pytest.approx(np.full(4, -0.001))


def test_crossed_edges_touch_in_a_point() -> None:
    a = placed(CAPSULE, (0.0, 0.0, 0.19), about((1.0, 0.0, 0.0), math.pi / 2.0))
    found = touch(a, placed(CAPSULE, (0.0, 0.0, 0.0), about((0.0, 1.0, 0.0), math.pi / 2.0)))
    assert found.gaps == pytest.approx([-0.01])
    assert found.normals[0] == pytest.approx([0.0, 0.0, 1.0])
    half = math.sqrt(0.5)
    roof = Placed(BOX, (0.5, 0.1, 0.1), about((1.0, 0.0, 0.0), math.pi / 4.0))
    beam = Placed(BOX, (0.1, 0.5, 0.1), about((0.0, 1.0, 0.0), math.pi / 4.0), np.array([0.0, 0.0, 0.4 * half - 0.001]))
    found = touch(beam, roof)
    assert found.gaps.min() == pytest.approx(-0.001)
    assert found.points[np.argmin(found.gaps)] == pytest.approx([0.0, 0.0, 0.2 * half - 0.0005], abs=1e-8)


@given(st.floats(-0.04, 0.04), st.floats(-1e-3, 1e-3))
@settings(max_examples=20, deadline=None)
def test_the_contact_of_a_leaning_wheel_moves_to_the_lower_edge(lean: float, depth: float) -> None:
    R = about((1.0, 0.0, 0.0), math.pi / 2.0 + lean)
    found = touch(placed(WHEEL, (0.0, 0.0, 0.3 - depth), R), placed(PLANE))
    assert len(found) == 1
    share = min(1.0, abs(math.sin(lean)) / 0.02)
    # The wheel's own z axis looks along -y.
    along = 0.05 * share if lean > 0.0 else -0.05 * share
    assert found.points[0, 1] == pytest.approx(-along, abs=0.3 * abs(math.sin(lean)) + 1e-4)


@pytest.mark.parametrize(("kind_a", "kind_b"), PAIRS)
def test_degenerate_places_give_unit_normals(kind_a: int, kind_b: int) -> None:
    for p in ((0.0, 0.0, 0.0), (0.0, 0.0, 1e-12), (1e-300, 0.0, 0.0), (0.1, 0.0, 0.0), (0.0, 0.0, 0.2)):
        for R in (np.eye(3), ON_ITS_SIDE, about((0.0, 0.0, 1.0), math.pi / 4.0), about((1.0, 1.0, 0.0), 1e-9)):
            touch(placed(kind_a, p, R), placed(kind_b))


@pytest.mark.parametrize("kind", [SPHERE, BOX, CYLINDER, WHEEL, CAPSULE, HULL, PLANE, MESH])
def test_flat_hulls_give_unit_normals(kind: int) -> None:
    for p in ((0.0, 0.0, 0.0), (0.0, 0.0, 1e-9), (0.05, 0.02, 0.1)):
        for R in (np.eye(3), about((1.0, 0.0, 0.0), math.pi / 2.0), about((1.0, 2.0, 3.0), 1.0)):
            touch(Placed(HULL, (0.0, 0.0, 0.0), R, np.array(p), FLAT), placed(kind))
    flat = Placed(HULL, (0.0, 0.0, 0.0), np.eye(3), np.zeros(3), FLAT)
    found = touch(Placed(HULL, (0.0, 0.0, 0.0), np.eye(3), np.array([0.1, 0.1, 0.001]), FLAT), flat)
    assert found.gaps == pytest.approx(np.full(4, 0.001))


angles = st.floats(-math.pi, math.pi)
places = st.tuples(st.floats(-0.5, 0.5), st.floats(-0.5, 0.5), st.floats(-0.5, 0.5))
axes = st.tuples(st.floats(-1, 1), st.floats(-1, 1), st.floats(0.1, 1))


@pytest.mark.parametrize(("kind_a", "kind_b"), SMOOTH)
@given(p=places, axis=axes, angle=angles, move=places, turn_axis=axes, turn=angles)
@settings(max_examples=10, deadline=None)
def test_moving_both_and_swapping_them_changes_nothing(
    kind_a: int, kind_b: int, p: tuple, axis: tuple, angle: float, move: tuple, turn_axis: tuple, turn: float
) -> None:
    margin = 10.0
    a, b = placed(kind_a, p, about(axis, angle)), placed(kind_b)
    found = touch(a, b, margin)
    Q = about(turn_axis, turn)
    moved = touch(
        Placed(a.kind, a.size, Q @ a.R, Q @ a.p + move, a.data),
        Placed(b.kind, b.size, Q @ b.R, Q @ b.p + move, b.data),
        margin,
    )
    swapped = touch(b, a, margin)
    assert moved.gaps.min() == pytest.approx(found.gaps.min(), abs=1e-6)
    assert swapped.gaps.min() == pytest.approx(found.gaps.min(), abs=1e-6)
    again = touch(a, b, margin)
    assert again.points.tobytes() == found.points.tobytes()
    assert again.features.tobytes() == found.features.tobytes()


@pytest.mark.parametrize(("kind_a", "kind_b"), SMOOTH)
@given(p=places, axis=axes, angle=angles, step=places)
@settings(max_examples=10, deadline=None)
def test_a_tiny_motion_changes_the_gap_a_tiny_bit(
    kind_a: int, kind_b: int, p: tuple, axis: tuple, angle: float, step: tuple
) -> None:
    R = about(axis, angle)
    found = touch(placed(kind_a, p, R), placed(kind_b), 10.0)
    small = 1e-6 * np.array(step)
    moved = touch(placed(kind_a, tuple(np.array(p) + small), R), placed(kind_b), 10.0)
    # The gap changes no faster than the shape moves.
    assert abs(moved.gaps.min() - found.gaps.min()) <= float(np.linalg.norm(small)) + 1e-7


def test_nothing_catches_on_the_edges_inside_a_floor() -> None:
    cells = np.arange(-4, 4)
    corners = np.array(
        [[[x, y, 0.0], [x + 1, y, 0.0], [x + 1, y + 1, 0.0], [x, y + 1, 0.0]] for x in cells for y in cells]
    )
    triangles = np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]]) * 0.25
    floor = Placed(MESH, (0.0, 0.0, 0.0), np.eye(3), np.zeros(3), GEOMETRY.add_mesh(triangles))
    rng = np.random.default_rng(2)
    heights = {SPHERE: 0.2, BOX: 0.1, CYLINDER: 0.3, CAPSULE: 0.35}
    for kind, height in heights.items():
        for _ in range(100):
            x, y = rng.uniform(-0.5, 0.5, 2)
            found = touch(placed(kind, (x, y, height - 1e-4), about((0.0, 0.0, 1.0), rng.uniform(0, 3))), floor)
            assert len(found) >= (1 if kind in (SPHERE, CAPSULE) else 3)
            assert found.normals == pytest.approx(np.tile([0.0, 0.0, 1.0], (len(found), 1)), abs=1e-6)
            assert found.gaps == pytest.approx(np.full(len(found), -1e-4), abs=1e-8)


def test_a_wheel_is_held_off_an_edge_that_meets_its_rim_beside_the_middle() -> None:
    """The middle of the rim stands for its lower edge, but not for what is anywhere else on the rim."""
    random = np.random.default_rng(3)
    corner = placed(BOX, (-0.2, -0.3, 0.0))
    radius, half, _ = SIZES[WHEEL]
    for _ in range(100):
        # Upright, its rim overlapping the upright edge at the origin, somewhere along its width.
        outward = random.uniform(0.1, 0.5 * math.pi - 0.1)
        yaw = outward + 0.5 * math.pi + random.uniform(-0.04, 0.04)
        axis = np.array([math.cos(yaw), math.sin(yaw), 0.0])
        away = np.array([math.cos(outward), math.sin(outward), 0.0])
        p = (radius - random.uniform(0.002, 0.008)) * away + random.uniform(-0.9, 0.9) * half * axis
        R = np.column_stack([(0.0, 0.0, 1.0), np.cross(axis, (0.0, 0.0, 1.0)), axis])
        wheel, drum = (touch(Placed(kind, SIZES[WHEEL], R, p), corner) for kind in (WHEEL, CYLINDER))
        k = int(drum.gaps.argmin())
        assert drum.gaps[k] < -1e-3
        assert wheel.gaps.min() <= drum.gaps[k] + half * abs(float(axis @ drum.normals[k])) + 1e-6


def test_a_wheel_on_a_floor_of_triangles_touches_once() -> None:
    floor = Placed(
        MESH, data=GEOMETRY.add_mesh(trimesh.creation.box((4.0, 4.0, 1.0)).triangles), p=np.array([0, 0, -0.5])
    )
    for x in (0.0, 0.013, 0.4, -0.7):
        assert len(touch(placed(WHEEL, (x, 0.2, 0.2999), ON_ITS_SIDE), floor)) == 1


@pytest.mark.parametrize("kind", [SPHERE, BOX, CYLINDER, CAPSULE, HULL])
def test_the_far_side_of_a_thin_plate_does_not_pull(kind: int) -> None:
    plate = Placed(MESH, data=GEOMETRY.add_mesh(trimesh.creation.box((2.0, 2.0, 0.002)).triangles), p=np.zeros(3))
    lowest = (
        -float(_points[:, 2].min()) if kind == HULL else {SPHERE: 0.2, BOX: 0.1, CYLINDER: 0.3, CAPSULE: 0.35}[kind]
    )
    for depth in (-0.003, 0.0005, 0.0015, 0.003):
        found = touch(placed(kind, (0.1, 0.2, 0.001 + lowest - depth)), plate)
        assert len(found) > 0
        assert found.gaps.min() == pytest.approx(-depth, abs=1e-8)
        assert np.all(found.normals[:, 2] > 0.999)
